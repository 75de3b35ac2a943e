/* file.c - files read whole and written whole. */
#include "status.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static pe_status file_error(pe_error *error, const char *path, const char *verb)
{
    return pe_fail(error, PE_ERROR_FILE, "%s: cannot %s: %s", path, verb, strerror(errno));
}

/* Reads until the end of fd into a growing buffer: the size a file reports is only a first guess. */
static pe_status read_all(int fd, const char *path, size_t guess, unsigned char **bytes, size_t *size, pe_error *error)
{
    size_t capacity = guess + 1, used = 0;
    unsigned char *buffer = malloc(capacity);

    while (buffer) {
        ssize_t got = read(fd, buffer + used, capacity - used);

        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0) {
            free(buffer);
            return file_error(error, path, "read");
        }
        if (got == 0) {
            *bytes = buffer;
            *size = used;
            return PE_OK;
        }
        used += (size_t)got;
        if (used > PE_FILE_SIZE_MAX) {
            free(buffer);
            return pe_fail(error, PE_ERROR_LIMIT, "%s: larger than %zu bytes", path, PE_FILE_SIZE_MAX);
        }
        if (used == capacity) {
            unsigned char *larger = realloc(buffer, capacity *= 2);

            if (!larger)
                free(buffer);
            buffer = larger;
        }
    }
    return pe_fail(error, PE_ERROR_MEMORY, "%s: not enough memory to read it", path);
}

pe_status pe_file_read(const char *path, unsigned char **bytes, size_t *size, pe_error *error)
{
    struct stat about;
    pe_status status;
    size_t guess = 1 << 16;
    int fd = open(path, O_RDONLY | O_CLOEXEC);

    if (fd < 0)
        return file_error(error, path, "open");
    if (fstat(fd, &about) != 0) {
        file_error(error, path, "read");
        close(fd);
        return PE_ERROR_FILE;
    }
    if (S_ISDIR(about.st_mode)) {
        close(fd);
        return pe_fail(error, PE_ERROR_FILE, "%s: is a folder, not a file", path);
    }
    if (about.st_size > 0 && (size_t)about.st_size <= PE_FILE_SIZE_MAX)
        guess = (size_t)about.st_size;
    status = read_all(fd, path, guess, bytes, size, error);
    close(fd);
    return status;
}

static int write_all(int fd, const unsigned char *bytes, size_t size)
{
    while (size) {
        ssize_t put = write(fd, bytes, size);

        if (put < 0 && errno == EINTR)
            continue;
        if (put <= 0)
            return -1;
        bytes += put;
        size -= (size_t)put;
    }
    return 0;
}

static pe_status write_device(const char *path, const void *bytes, size_t size, pe_error *error)
{
    int fd = open(path, O_WRONLY | O_CLOEXEC);

    if (fd < 0)
        return file_error(error, path, "open for writing");
    if (write_all(fd, bytes, size) < 0) {
        file_error(error, path, "write");
        close(fd);
        return PE_ERROR_FILE;
    }
    return close(fd) < 0 ? file_error(error, path, "write") : PE_OK;
}

/* Opens a new file in the folder of `path`, under a name nobody else has; the name is left in `temporary`. */
static int open_beside(const char *path, char *temporary, size_t room)
{
    int folder = (int)(pe_base_name(path) - path), fd = -1;

    errno = EEXIST;
    for (int attempt = 0; attempt < 100 && fd < 0 && errno == EEXIST; attempt++) {
        snprintf(temporary, room, "%.*s.prefenv-%ld-%d.tmp", folder, path, (long)getpid(), attempt);
        fd = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    return fd;
}

/* `replaced` describes the file that is there already, or is NULL: its mode is kept. */
static pe_status write_and_rename(const char *path, const struct stat *replaced, char *temporary, size_t room,
                                  const void *bytes, size_t size, pe_error *error)
{
    int fd = open_beside(path, temporary, room);
    int whole;

    if (fd < 0)
        return file_error(error, path, "create a file beside it");
    whole =
        (!replaced || fchmod(fd, replaced->st_mode & 07777) == 0) && write_all(fd, bytes, size) == 0 && fsync(fd) == 0;
    if (!whole)
        file_error(error, path, "write");
    if (close(fd) < 0 && whole) {
        file_error(error, path, "write");
        whole = 0;
    }
    if (whole && rename(temporary, path) < 0) {
        file_error(error, path, "replace");
        whole = 0;
    }
    if (!whole)
        unlink(temporary);
    return whole ? PE_OK : PE_ERROR_FILE;
}

static pe_status write_file(const char *path, const struct stat *replaced, const void *bytes, size_t size,
                            pe_error *error)
{
    size_t room = strlen(path) + 64;
    char *temporary = malloc(room);
    pe_status status;

    if (!temporary)
        return pe_fail_memory(error, "a file name");
    status = write_and_rename(path, replaced, temporary, room, bytes, size, error);
    free(temporary);
    return status;
}

/* The thread's signals that end a program wait meanwhile, so that no part of a file stays behind. */
static pe_status write_guarded(const char *path, const struct stat *replaced, const void *bytes, size_t size,
                               pe_error *error)
{
    sigset_t ends, before;
    pe_status status;

    sigemptyset(&ends);
    sigaddset(&ends, SIGINT);
    sigaddset(&ends, SIGTERM);
    sigaddset(&ends, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &ends, &before);
    status = write_file(path, replaced, bytes, size, error);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return status;
}

pe_status pe_file_write(const char *path, const void *bytes, size_t size, pe_error *error)
{
    struct stat about;
    pe_status status;
    char *target;

    if (stat(path, &about) != 0) {
        if (lstat(path, &about) == 0)
            return pe_fail(error, PE_ERROR_FILE, "%s: is a link to nothing; remove it or make what it points to", path);
        return write_guarded(path, NULL, bytes, size, error);
    }
    if (S_ISDIR(about.st_mode))
        return pe_fail(error, PE_ERROR_FILE, "%s: is a folder, not a file", path);
    if (!S_ISREG(about.st_mode))
        return write_device(path, bytes, size, error);
    /* A link stays a link: what it points to is replaced. */
    target = realpath(path, NULL);
    if (!target)
        return file_error(error, path, "follow");
    status = write_guarded(target, &about, bytes, size, error);
    free(target);
    return status;
}
