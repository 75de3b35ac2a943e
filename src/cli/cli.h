/* cli.h - what the subcommands of `prefenv` share: exit codes, messages, the description of a command. */
#ifndef CLI_H
#define CLI_H

#include "prefenv.h"

#include <stddef.h>

/* Exit codes, documented in prefenv(1).  A signal that stops the command shows as 128 + its number in the shell. */
enum {
    CLI_SUCCESS = 0,
    CLI_ABOVE_LIMIT = 1, /* diff: the pictures differ by more than allowed */
    CLI_FAILURE = 2      /* wrong usage, bad input, or something that cannot be read or written */
};

/* "prefenv: COMMAND: MESSAGE" on standard error, on one line whatever the message holds.  `command` may be NULL. */
__attribute__((format(printf, 2, 3))) void cli_error(const char *command, const char *format, ...);
__attribute__((format(printf, 2, 3))) void cli_warning(const char *command, const char *format, ...);

/* Reads an environment image as pe_env_read does, but not a maps file. */
pe_status cli_read_environment(const char *path, pe_env **env, pe_error *error);

/* One warning if the environment read from `path` is doubtful. */
void cli_warn_of_flaws(const char *command, const char *path, const pe_env *env);

/* The word among `count` that is nearest to what was typed, or NULL if none is near enough to be meant. */
const char *cli_nearest(const char *typed, const char *const *words, size_t count);

/* Writes out what waits in stdout.  CLI_FAILURE, with its error printed, if any of the output was lost. */
int cli_flush(const char *command);

/* Do two names mean one file, be it there or still to be written? */
int cli_is_same_file(const char *a, const char *b);

/* Can `output` be written?  Its folder must exist, it must not be a folder itself, and it must be none of
 * `inputs` (ended by NULL).  CLI_FAILURE, with its error printed, if not. */
int cli_check_output(const char *command, const char *output, const char *const *inputs);

/* The same of a file that is not there and has a name. */
int cli_check_new(const char *command, const char *output);

/* As cli_check_output, for what is written as an OpenEXR, whose name must not end like a picture of another kind. */
int cli_check_exr_output(const char *command, const char *output, const char *const *inputs);

#endif
