/* frames.h - the files of a sequence: a pattern such as street_%04d.exr, and the numbers that take the %04d's place. */
#ifndef CLI_FRAMES_H
#define CLI_FRAMES_H

/* first, first + step, … up to last. */
typedef struct frames {
    int first, last, step;
} frames;

/* From FIRST-LAST or a single number, and I/N: every N-th from the I-th on, or NULL: all.  CLI_FAILURE, with its error
 * printed, if they are something else. */
int frames_parse(const char *command, const char *range, const char *shard, frames *out);

int frames_count(const frames *f);

/* A pattern has one %d or %0Nd; %% stands for a percent sign.  CLI_FAILURE, with its error printed, if not so. */
int frames_check_pattern(const char *command, const char *pattern);

/* Is there no such file, and could its name be a pattern? */
int frames_look_missing(const char *name);

/* A frame's file name, by a pattern that was checked; to be freed.  NULL if memory is out. */
char *frames_name(const char *pattern, int frame);

/* Would a frame be written over what a frame is read from?  CLI_FAILURE, with its error printed, if so. */
int frames_check_overwriting(const char *command, const char *inputs, const char *outputs, const frames *f);

#endif
