/* options.h - one table describes a command; parsing and help both come from it. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include <stddef.h>

/* How an option's value is written, and what it fills at `offset` of the command's settings. */
typedef enum cli_type {
    CLI_SWITCH,  /* nothing written; int, 1 if given */
    CLI_INTEGER, /* 42; int */
    CLI_NUMBER,  /* 0.5; double */
    CLI_WIDTHS,  /* A, which stands for A,A, or A,B, and 0; or a range A-B: A, A and B; double[3] */
    CLI_LENGTH,  /* 1.5um: a number and nm, um, mm, cm, m or in, um if none; double, in um */
    CLI_LENGTHS, /* A, which stands for A,A, or A,B; double[2] */
    CLI_VECTOR,  /* X,Y,Z, not all zero; double[3] */
    CLI_TRIPLE,  /* R,G,B, any; double[3] */
    CLI_SIZE,    /* 400x200, or 64, which stands for 64x64; int[2] */
    CLI_CHOICE,  /* one of `choices`; int */
    CLI_TEXT     /* any; const char * */
} cli_type;

typedef struct cli_choice {
    const char *name; /* NULL ends a list */
    int value;
} cli_choice;

typedef struct cli_option {
    const char *name;        /* without the dashes; NULL ends a table */
    int letter;              /* the short form, or 0 */
    const char *placeholder; /* what the help calls the value; NULL for a switch */
    cli_type type;
    size_t offset;             /* of the member in the settings */
    double low, high;          /* range of each number, INFINITY: no upper end; both 0: any */
    const cli_choice *choices; /* CLI_CHOICE */
    const char *preset;        /* the default as a user would write it, stored before parsing; NULL: none */
    int required;
    const char *help; /* a sentence without its stop */
} cli_option;

typedef struct cli_operand {
    const char *name; /* NULL ends a list */
    size_t offset;    /* of a const char * in the settings */
    const char *help;
} cli_operand;

typedef struct cli_command {
    const char *name;
    const char *summary; /* for the list of commands */
    const char *about;   /* a paragraph for the command's own help */
    const cli_operand *operands;
    const cli_option *options;
    int (*run)(int argc, char **argv); /* argv[0] is the command's name; returns the exit code */
} cli_command;

enum { CLI_RANGE_BYTES = 64 };

/* What cli_parse returns when the command is to go on. */
enum { CLI_PROCEED = -1 };

/* Which options were given, be it with the value that they have anyway: bit i stands for the table's i-th. */
typedef unsigned long long cli_given;

/* Fills *settings, which must be zeros, from the table's presets and the arguments, and *given unless it is NULL.
 * Returns CLI_PROCEED; or an exit code: the help was asked for and printed, or something is wrong and one error was
 * printed. */
int cli_parse(const cli_command *command, int argc, char **argv, void *settings, cli_given *given);

/* Whether an option of the command's table was given. */
int cli_is_given(const cli_command *command, cli_given given, const char *option);

/* An option that says nothing where `allowed` is 0: so that none is ignored in silence. */
typedef struct cli_rule {
    const char *option; /* without the dashes */
    int allowed;
    const char *why; /* what is said after it, with the way out */
} cli_rule;

/* CLI_FAILURE, with its error printed, if an option was given that one of the rules does not allow. */
int cli_check_rules(const cli_command *command, cli_given given, const cli_rule *rules, size_t count);

/* Stores the value `text` of an option.  CLI_FAILURE, with its error printed, if it is not acceptable. */
int cli_store(const cli_command *command, const cli_option *option, const char *text, void *settings);

/* "0.001 to 2", "0 or more"; "" if there is no range. */
void cli_describe_range(const cli_option *option, char text[CLI_RANGE_BYTES]);

/* Prints the help of a command to standard output, 80 columns wide at most. */
void cli_help(const cli_command *command);

/* Prints `text` in lines of at most 79 columns, each but the first indented; the first starts at `column`. */
void cli_wrap(const char *text, int column, int indent);

extern const cli_choice cli_weights[];

/* Rows that several tables share. */
#define CLI_OPTION_THREADS(settings) \
    { \
        "threads", 0, "N", CLI_INTEGER, offsetof(settings, threads), 1, 256, NULL, NULL, 0, \
            "how many threads work; the result is the same for any number. Default: one a processor" \
    }
#define CLI_OPTION_JSON(settings) \
    { \
        "json", 0, NULL, CLI_SWITCH, offsetof(settings, json), 0, 0, NULL, NULL, 0, \
            "print one JSON object instead of text" \
    }
#define CLI_OPTION_QUIET(settings) \
    { \
        "quiet", 'q', NULL, CLI_SWITCH, offsetof(settings, quiet), 0, 0, NULL, NULL, 0, \
            "print errors only: no progress, no summary, no warnings" \
    }
#define CLI_OPTION_NDF(settings) \
    { \
        "ndf", 0, "NAME|FILE", CLI_TEXT, offsetof(settings, surface.ndf), 0, 0, NULL, "beckmann", 0, \
            "the surface's normal distribution: beckmann, ggx or phong; or a file of a measured one, *.exr" \
    }
#define CLI_OPTION_ALPHA(settings) \
    { \
        "alpha", 0, "A|AX,AY|LO-HI", CLI_WIDTHS, offsetof(settings, surface.alpha), PE_ALPHA_MIN, PE_ALPHA_MAX, NULL, \
            NULL, 0, \
            "width of beckmann, ggx or phong; two numbers: along and across the brush direction; a range: roughness " \
            "that varies, said at each lookup. Default: 0.1" \
    }
#define CLI_OPTION_ASPECT(settings) \
    { \
        "aspect", 0, "R", CLI_NUMBER, offsetof(settings, surface.aspect), 0.01, 100, NULL, NULL, 0, \
            "with --alpha of one number or a range, which is along the brush direction then: how many times the " \
            "width " \
            "across it that is. Default: 1" \
    }
#define CLI_OPTION_WEIGHT(settings) \
    { \
        "weight", 0, "NAME", CLI_CHOICE, offsetof(settings, surface.weight), 0, 0, cli_weights, "ndf", 0, \
            "ndf: the mean of what the normal distribution mirrors; microfacet: what a metal reflects, with its " \
            "colour, masking and shadowing" \
    }
#define CLI_OPTION_MATERIAL(settings) \
    { \
        "material", 0, "METAL", CLI_TEXT, offsetof(settings, surface.material), 0, 0, NULL, NULL, 0, \
            "for microfacet: aluminium, chromium, copper, gold, iron, nickel, palladium, silver or titanium. " \
            "Default: reflects all" \
    }
#define CLI_OPTION_IOR(settings) \
    { \
        "ior", 0, "R,G,B", CLI_VECTOR, offsetof(settings, surface.eta), 0, 0, NULL, NULL, 0, \
            "or the real part of its index of refraction, for red, green and blue" \
    }
#define CLI_OPTION_K(settings) \
    { \
        "k", 0, "R,G,B", CLI_TRIPLE, offsetof(settings, surface.k), 0, 0, NULL, NULL, 0, "and the imaginary part" \
    }
#define CLI_OPTION_WINDOW(settings) \
    { \
        "window", 0, "U", CLI_NUMBER, offsetof(settings, window), 0.1, 100, NULL, "6.2", 0, \
            "how many voxels wide a lobe is that lambda stands for" \
    }
#define CLI_OPTION_LEVELS(settings) \
    { \
        "levels", 0, "I", CLI_NUMBER, offsetof(settings, levels), 2, 1000000, NULL, "256", 0, \
            "the shades of a picture: what falls below 1/I of a lobe's peak is not to be seen" \
    }
#define CLI_OPTION_DIRECTION(settings) \
    { \
        "direction", 0, "X,Y,Z", CLI_VECTOR, offsetof(settings, direction), 0, 0, NULL, "0,1,0", 0, \
            "the brush direction, which a width of two numbers refers to" \
    }

#endif
