/* options.c - arguments to settings, by the command's table; getopt_long does the splitting. */
#include "options.h"
#include "cli.h"
#include "prefenv.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define OPTIONS_MAX 40 /* as many as cli_given has bits, at most */
#define LONG_VALUE 256 /* getopt_long's value of option i is LONG_VALUE + i; letters lie below */
#define HELP_VALUE 'h'

const cli_choice cli_weights[] = { { "ndf", PE_WEIGHT_NDF }, { "microfacet", PE_WEIGHT_MICROFACET }, { NULL, 0 } };

typedef struct getopt_tables {
    struct option longs[OPTIONS_MAX + 2];
    char letters[2 * OPTIONS_MAX + 4];
    size_t count;
} getopt_tables;

/* Fills tables of zeros.  -h and --help are understood everywhere. */
static void fill_tables(const cli_command *command, getopt_tables *tables)
{
    char *letter = tables->letters;
    size_t i = 0;

    *letter++ = ':'; /* tells a missing value from an unknown option */
    *letter++ = HELP_VALUE;
    for (const cli_option *option = command->options; option->name && i < OPTIONS_MAX; option++, i++) {
        tables->longs[i].name = option->name;
        tables->longs[i].has_arg = option->type == CLI_SWITCH ? no_argument : required_argument;
        tables->longs[i].val = LONG_VALUE + (int)i;
        if (option->letter) {
            *letter++ = (char)option->letter;
            if (option->type != CLI_SWITCH)
                *letter++ = ':';
        }
    }
    tables->longs[i].name = "help";
    tables->longs[i].val = HELP_VALUE;
    tables->count = i + 1;
}

/* The row that getopt_long's result stands for; NULL if none. */
static const cli_option *find_row(const cli_command *command, int value)
{
    for (size_t i = 0; command->options[i].name; i++)
        if (value == LONG_VALUE + (int)i || (value && value == command->options[i].letter))
            return &command->options[i];
    return NULL;
}

/* A beginning that several options share; prints its error if so. */
static int is_ambiguous(const cli_command *command, const getopt_tables *tables, const char *typed, size_t length)
{
    const char *first = NULL;

    for (size_t i = 0; i < tables->count; i++) {
        if (strncmp(tables->longs[i].name, typed, length) != 0)
            continue;
        if (first) {
            cli_error(command->name, "--%.*s could be --%s or --%s; write it out", (int)length, typed, first,
                      tables->longs[i].name);
            return 1;
        }
        first = tables->longs[i].name;
    }
    return 0;
}

static void report_unknown(const cli_command *command, const getopt_tables *tables, const char *argument)
{
    const char *names[OPTIONS_MAX + 2], *nearest;
    size_t length;
    char typed[40];

    if (optopt) { /* a letter; getopt_long leaves 0 there for a word */
        cli_error(command->name, "unknown option -%c; see 'prefenv %s --help'", optopt, command->name);
        return;
    }
    length = strcspn(argument + 2, "=");
    if (is_ambiguous(command, tables, argument + 2, length))
        return;
    for (size_t i = 0; i < tables->count; i++)
        names[i] = tables->longs[i].name;
    snprintf(typed, sizeof typed, "%.*s", (int)(length < sizeof typed ? length : sizeof typed), argument + 2);
    nearest = cli_nearest(typed, names, tables->count);
    if (nearest)
        cli_error(command->name, "unknown option --%s; did you mean --%s?", typed, nearest);
    else
        cli_error(command->name, "unknown option --%s; see 'prefenv %s --help'", typed, command->name);
}

/* What getopt_long stumbled over: `found` is ':' or '?'. */
static void report_stumble(const cli_command *command, const getopt_tables *tables, int found, char **argv)
{
    const cli_option *row = find_row(command, optopt);

    if (found == ':' && row)
        cli_error(command->name, "%s needs a value: --%s %s", argv[optind - 1], row->name, row->placeholder);
    else if (row && optopt >= LONG_VALUE)
        cli_error(command->name, "--%s takes no value", row->name);
    else if (optopt == HELP_VALUE)
        cli_error(command->name, "--help takes no value");
    else
        report_unknown(command, tables, argv[optind - 1]);
}

static int store_presets(const cli_command *command, void *settings)
{
    for (const cli_option *option = command->options; option->name; option++)
        if (option->preset && cli_store(command, option, option->preset, settings) != CLI_SUCCESS)
            return CLI_FAILURE;
    return CLI_PROCEED;
}

static int store_operands(const cli_command *command, int count, char **words, void *settings)
{
    const cli_operand *operand = command->operands;

    for (int i = 0; i < count; i++, operand++) {
        if (!operand->name) {
            cli_error(command->name, "'%s' is one argument too many; see 'prefenv %s --help'", words[i], command->name);
            return CLI_FAILURE;
        }
        *(const char **)((char *)settings + operand->offset) = words[i];
    }
    if (!operand->name)
        return CLI_PROCEED;
    cli_error(command->name, "%s is missing (%s); see 'prefenv %s --help'", operand->name, operand->help,
              command->name);
    return CLI_FAILURE;
}

static int check_required(const cli_command *command, const void *settings)
{
    for (const cli_option *option = command->options; option->name; option++)
        if (option->required && !*(const char *const *)((const char *)settings + option->offset)) {
            cli_error(command->name, "%s%c%s %s is missing; see 'prefenv %s --help'", option->letter ? "-" : "--",
                      option->letter ? option->letter : option->name[0], option->letter ? "" : option->name + 1,
                      option->placeholder, command->name);
            return CLI_FAILURE;
        }
    return CLI_PROCEED;
}

int cli_parse(const cli_command *command, int argc, char **argv, void *settings, cli_given *given)
{
    getopt_tables tables = { 0 };
    cli_given rows = 0;
    int found;

    fill_tables(command, &tables);
    if (store_presets(command, settings) != CLI_PROCEED)
        return CLI_FAILURE;
    opterr = 0;
    optind = 0; /* glibc: start afresh, and let options follow operands */
    while ((found = getopt_long(argc, argv, tables.letters, tables.longs, NULL)) != -1) {
        const cli_option *row = find_row(command, found);

        if (found == HELP_VALUE) {
            cli_help(command);
            return cli_flush(command->name);
        }
        if (found == ':' || found == '?' || !row) {
            report_stumble(command, &tables, found, argv);
            return CLI_FAILURE;
        }
        if (cli_store(command, row, optarg, settings) != CLI_SUCCESS)
            return CLI_FAILURE;
        rows |= 1ULL << (row - command->options);
    }
    if (given)
        *given = rows;
    if (store_operands(command, argc - optind, argv + optind, settings) != CLI_PROCEED)
        return CLI_FAILURE;
    return check_required(command, settings);
}
