/* commands.h - the subcommands, one file each. */
#ifndef CLI_COMMANDS_H
#define CLI_COMMANDS_H

#include "options.h"

extern const cli_command bake_command;
extern const cli_command info_command;
extern const cli_command eval_command;
extern const cli_command exact_command;
extern const cli_command diff_command;
extern const cli_command ndf_command;
extern const cli_command surface_command;

#endif
