/* main.c - the command `prefenv`: finds the subcommand and runs it. */
#include "cli.h"
#include "commands.h"
#include "prefenv.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const cli_command *const commands[] = { &bake_command, &info_command, &eval_command,   &exact_command,
                                               &diff_command, &ndf_command,  &surface_command };

enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

/* A standard stream that the caller closed is filled by something that fails when used: else the next file opened
 * would take its place and be written to as if it were the output. */
static void hold_standard_streams(void)
{
    static const int modes[] = { O_WRONLY, O_RDONLY, O_RDONLY };

    for (int fd = 0; fd < 3; fd++)
        if (fcntl(fd, F_GETFD) == -1 && errno == EBADF && open("/dev/null", modes[fd]) != fd)
            _exit(CLI_FAILURE);
}

static const cli_command *find_command(const char *name)
{
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(commands[i]->name, name) == 0)
            return commands[i];
    return NULL;
}

static int refuse_command(const char *name)
{
    const char *names[COMMAND_COUNT + 3] = { "help", "--help", "--version" }, *nearest;
    const char *what = *name == '-' ? "option" : "command";

    for (int i = 0; i < COMMAND_COUNT; i++)
        names[i + 3] = commands[i]->name;
    nearest = cli_nearest(name, names, COMMAND_COUNT + 3);
    if (nearest)
        cli_error(NULL, "unknown %s '%s'; did you mean '%s'?", what, name, nearest);
    else
        cli_error(NULL, "unknown %s '%s'; see 'prefenv --help'", what, name);
    return CLI_FAILURE;
}

static int print_overview(void)
{
    puts("Usage: prefenv COMMAND [ARGUMENT]...\n");
    cli_wrap("Filters an environment image by a surface's normal distribution beforehand, so that a glossy reflection "
             "costs one lookup; looks such maps up, computes the exact answer, and compares pictures.",
             0, 0);
    puts("\nCommands:");
    for (int i = 0; i < COMMAND_COUNT; i++)
        printf("  %-8s%s\n", commands[i]->name, commands[i]->summary);
    puts("\n  prefenv COMMAND --help    a command's options; also: prefenv help COMMAND\n"
         "  prefenv --version         the version\n\n"
         "Exit codes: 0 done, 1 the pictures differ by more than diff's limit,\n"
         "2 wrong usage, bad input or an output that cannot be written.");
    return cli_flush(NULL);
}

static int refuse_more(const char *word)
{
    cli_error(NULL, "'%s' is one argument too many; see 'prefenv --help'", word);
    return CLI_FAILURE;
}

static int print_version(void)
{
    puts("prefenv " PE_VERSION);
    return cli_flush(NULL);
}

/* `prefenv help` and `prefenv help COMMAND` */
static int run_help(int argc, char **argv)
{
    const cli_command *command;

    if (argc < 2)
        return print_overview();
    command = find_command(argv[1]);
    if (!command)
        return refuse_command(argv[1]);
    if (argc > 2)
        return refuse_more(argv[2]);
    cli_help(command);
    return cli_flush(NULL);
}

int main(int argc, char **argv)
{
    const cli_command *command;

    hold_standard_streams();
    signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is an error as any other */
    if (argc < 2) {
        cli_error(NULL, "no command given; see 'prefenv --help'");
        return CLI_FAILURE;
    }
    if (strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "--help") == 0)
        return argc > 2 ? refuse_more(argv[2]) : print_overview();
    if (strcmp(argv[1], "--version") == 0)
        return argc > 2 ? refuse_more(argv[2]) : print_version();
    if (strcmp(argv[1], "help") == 0)
        return run_help(argc - 1, argv + 1);
    command = find_command(argv[1]);
    return command ? command->run(argc - 1, argv + 1) : refuse_command(argv[1]);
}
