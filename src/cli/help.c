/* help.c - a command's help, out of the table that parses its arguments. */
#include "cli.h"
#include "options.h"

#include <stdio.h>
#include <string.h>

enum { COLUMNS = 79, LABEL_COLUMNS = 28 };

void cli_wrap(const char *text, int column, int indent)
{
    while (*text) {
        int length = (int)strcspn(text, " ");

        if (column > indent && column + 1 + length > COLUMNS) {
            printf("\n%*s", indent, "");
            column = indent;
        } else if (column > indent) {
            putchar(' ');
            column++;
        }
        fwrite(text, 1, (size_t)length, stdout);
        column += length;
        text += length;
        text += strspn(text, " ");
    }
    putchar('\n');
}

/* The label starts the line, the sentence stands beside it, or under it if the label is long. */
static void print_row(const char *label, const char *sentence)
{
    int length = printf("  %s", label);

    if (length + 2 > LABEL_COLUMNS)
        printf("\n%*s", LABEL_COLUMNS, "");
    else
        printf("%*s", LABEL_COLUMNS - length, "");
    cli_wrap(sentence, LABEL_COLUMNS, LABEL_COLUMNS);
}

static void print_option(const cli_option *option)
{
    char label[80], letter[8] = "    ", sentence[512], range[CLI_RANGE_BYTES];
    int used;

    if (option->letter)
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    snprintf(label, sizeof label, "%s--%s%s%s", letter, option->name, option->placeholder ? " " : "",
             option->placeholder ? option->placeholder : "");
    cli_describe_range(option, range);
    used = snprintf(sentence, sizeof sentence, "%s", option->help);
    if (*range)
        used += snprintf(sentence + used, sizeof sentence - (size_t)used, " (%s)", range);
    if (option->preset)
        snprintf(sentence + used, sizeof sentence - (size_t)used, " [%s]", option->preset);
    else if (option->required)
        snprintf(sentence + used, sizeof sentence - (size_t)used, " (required)");
    print_row(label, sentence);
}

static void print_usage(const cli_command *command)
{
    printf("Usage: prefenv %s", command->name);
    for (const cli_operand *operand = command->operands; operand->name; operand++)
        printf(" %s", operand->name);
    for (const cli_option *option = command->options; option->name; option++)
        if (option->required)
            printf(" -%c %s", option->letter, option->placeholder);
    puts(" [OPTION]...");
}

void cli_help(const cli_command *command)
{
    print_usage(command);
    putchar('\n');
    cli_wrap(command->about, 0, 0);
    putchar('\n');
    for (const cli_operand *operand = command->operands; operand->name; operand++)
        print_row(operand->name, operand->help);
    puts("\nOptions [default]:");
    for (const cli_option *option = command->options; option->name; option++)
        print_option(option);
    print_row("-h, --help", "print this help and stop");
}
