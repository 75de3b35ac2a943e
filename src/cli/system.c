/* system.c - what the command asks the operating system before it starts to work. */
#include "cli.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* The folder of `path`, to be freed; NULL if memory is out. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');

    if (!slash)
        return strdup(".");
    return slash == path ? strdup("/") : strndup(path, (size_t)(slash - path));
}

/* A file that is not there yet has a folder that is, and its name in it. */
static int is_same_new_file(const char *a, const char *b)
{
    const char *slash_a = strrchr(a, '/'), *slash_b = strrchr(b, '/');
    char *folder_a = folder_of(a), *folder_b = folder_of(b);
    struct stat in_a, in_b;
    int same = folder_a && folder_b && strcmp(slash_a ? slash_a + 1 : a, slash_b ? slash_b + 1 : b) == 0 &&
               stat(folder_a, &in_a) == 0 && stat(folder_b, &in_b) == 0 && in_a.st_dev == in_b.st_dev &&
               in_a.st_ino == in_b.st_ino;

    free(folder_a);
    free(folder_b);
    return same;
}

int cli_is_same_file(const char *a, const char *b)
{
    struct stat of_a, of_b;
    int has_a = stat(a, &of_a) == 0, has_b = stat(b, &of_b) == 0;

    if (has_a && has_b)
        return of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
    return !has_a && !has_b && is_same_new_file(a, b);
}

static int check_folder(const char *command, const char *output)
{
    struct stat status;
    int result = CLI_FAILURE;
    char *folder = folder_of(output);

    if (!folder)
        cli_error(command, "out of memory");
    else if (stat(folder, &status) != 0)
        cli_error(command, "%s: cannot write into %s: %s", output, folder, strerror(errno));
    else if (!S_ISDIR(status.st_mode))
        cli_error(command, "%s: %s is not a folder", output, folder);
    else if (access(folder, W_OK | X_OK) != 0)
        cli_error(command, "%s: cannot write into its folder: %s", output, strerror(errno));
    else
        result = CLI_SUCCESS;
    free(folder);
    return result;
}

int cli_check_new(const char *command, const char *output)
{
    struct stat link;

    if (lstat(output, &link) != 0)
        return check_folder(command, output);
    cli_error(command, "%s: is a link to nothing; remove it or make what it points to", output);
    return CLI_FAILURE;
}

/* Of a link, what it points to is replaced, in a folder that may be another. */
static int check_replaced(const char *command, const char *output)
{
    char *target = realpath(output, NULL);
    int result = check_folder(command, target ? target : output);

    free(target);
    return result;
}

int cli_check_output(const char *command, const char *output, const char *const *inputs)
{
    struct stat target;
    const int is_new = stat(output, &target) != 0;

    if (!*output) {
        cli_error(command, "the output's name is empty; give a file after -o");
        return CLI_FAILURE;
    }
    if (!is_new && S_ISDIR(target.st_mode)) {
        cli_error(command, "%s: is a folder; name a file in it", output);
        return CLI_FAILURE;
    }
    if (!is_new && !S_ISREG(target.st_mode)) /* a device or a pipe is written straight */
        return CLI_SUCCESS;
    for (; *inputs; inputs++)
        if (cli_is_same_file(*inputs, output)) {
            cli_error(command, "%s: is the input %s itself; give another name after -o", output, *inputs);
            return CLI_FAILURE;
        }
    return is_new ? cli_check_new(command, output) : check_replaced(command, output);
}

/* What a name that ends so promises to be. */
static const char *const other_formats[] = { ".png",  ".hdr", ".pic", ".jpg", ".jpeg", ".tif", ".tiff",
                                             ".webp", ".tga", ".bmp", ".pfm", ".gif",  ".ini", ".pov" };

int cli_check_exr_output(const char *command, const char *output, const char *const *inputs)
{
    size_t length = strlen(output);

    if (cli_check_output(command, output, inputs) != CLI_SUCCESS)
        return CLI_FAILURE;
    for (size_t k = 0; k < sizeof other_formats / sizeof *other_formats; k++) {
        size_t end = strlen(other_formats[k]);

        if (length > end && strcasecmp(output + length - end, other_formats[k]) == 0) {
            cli_error(command, "%s: what is written is an OpenEXR; name it so, %.*s.exr", output, (int)(length - end),
                      output);
            return CLI_FAILURE;
        }
    }
    return CLI_SUCCESS;
}
