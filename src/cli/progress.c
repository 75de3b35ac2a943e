/* progress.c - see progress.h. */
#include "progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#define REDRAW_SECONDS 0.1
#define ESTIMATE_SECONDS 1.0 /* before that the time left is a guess */

double clock_seconds(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int progress_is_visible(void)
{
    const char *terminal = getenv("TERM");

    return isatty(STDERR_FILENO) && (!terminal || strcmp(terminal, "dumb") != 0);
}

void progress_begin(progress *bar)
{
    bar->begun = clock_seconds();
    bar->drawn = 0;
    bar->width = 0;
}

static int terminal_columns(void)
{
    struct winsize size;

    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return 80;
    return size.ws_col > 100 ? 100 : size.ws_col;
}

/* "12 s left", "3 min 20 s left" */
static void describe_rest(double seconds, char *text, size_t size)
{
    long rest = lround(ceil(seconds));

    if (rest >= 60)
        snprintf(text, size, "%ld min %02ld s left", rest / 60, rest % 60);
    else
        snprintf(text, size, "%ld s left", rest);
}

void progress_draw(progress *bar, double fraction)
{
    double now = clock_seconds(), elapsed = now - bar->begun;
    char rest[48] = "", line[128], blocks[104];
    int room, filled, width;

    if (now - bar->drawn < REDRAW_SECONDS)
        return;
    if (elapsed > ESTIMATE_SECONDS && fraction > 0)
        describe_rest(elapsed * (1 - fraction) / fraction, rest, sizeof rest);
    room = terminal_columns() - 30; /* for the percentage before the bar and the time behind it */
    room = room < 0 ? 0 : room > 60 ? 60 : room;
    filled = (int)(fraction * room);
    memset(blocks, ' ', sizeof blocks);
    memset(blocks, '#', (size_t)filled);
    width = snprintf(line, sizeof line, "%3d %% [%.*s] %s", (int)(100 * fraction), room, blocks, rest);
    fprintf(stderr, "\r%s%*s", line, bar->width > width ? bar->width - width : 0, "");
    fflush(stderr);
    bar->drawn = now;
    bar->width = width;
}

void progress_clear(progress *bar)
{
    if (bar->width)
        fprintf(stderr, "\r%*s\r", bar->width, "");
    fflush(stderr);
    bar->width = 0;
}
