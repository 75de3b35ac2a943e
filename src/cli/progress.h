/* progress.h - a progress bar on standard error, while that is a terminal. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

typedef struct progress {
    double begun; /* seconds, by clock_seconds */
    double drawn; /* when the bar was last drawn */
    int width;    /* of the line drawn, 0 if none is */
} progress;

/* Seconds since some moment that does not move. */
double clock_seconds(void);

/* Starts the clock; draws nothing yet. */
void progress_begin(progress *bar);

/* Draws the bar with the time left, a few times a second at most.  Pair with progress_clear. */
void progress_draw(progress *bar, double fraction);

/* Wipes the bar away. */
void progress_clear(progress *bar);

/* Is standard error a terminal that can show a bar? */
int progress_is_visible(void);

#endif
