/* rules.c - which options go with each other. */
#include "cli.h"
#include "options.h"

#include <string.h>

int cli_is_given(const cli_command *command, cli_given given, const char *option)
{
    for (size_t i = 0; command->options[i].name; i++)
        if (strcmp(command->options[i].name, option) == 0)
            return (int)(given >> i & 1);
    return 0;
}

int cli_check_rules(const cli_command *command, cli_given given, const cli_rule *rules, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (!rules[k].allowed && cli_is_given(command, given, rules[k].option)) {
            cli_error(command->name, "--%s %s", rules[k].option, rules[k].why);
            return CLI_FAILURE;
        }
    return CLI_SUCCESS;
}
