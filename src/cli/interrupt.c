/* interrupt.c - see interrupt.h. */
#include "interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <sys/stat.h>

static sigset_t waiting(void)
{
    sigset_t set;

    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGHUP);
    return set;
}

void interrupt_hold(const char *output)
{
    sigset_t set = waiting();
    struct stat target;

    if (stat(output, &target) != 0 || S_ISREG(target.st_mode))
        pthread_sigmask(SIG_BLOCK, &set, NULL);
}

void interrupt_release(void)
{
    sigset_t set = waiting();

    pthread_sigmask(SIG_UNBLOCK, &set, NULL);
}

int interrupt_waits(void)
{
    const int signals[] = { SIGINT, SIGTERM, SIGHUP };
    sigset_t held, pending;
    int waits = 0;

    if (pthread_sigmask(SIG_SETMASK, NULL, &held) != 0 || sigpending(&pending) != 0)
        return 0;
    for (size_t k = 0; k < sizeof signals / sizeof *signals; k++)
        waits |= sigismember(&held, signals[k]) == 1 && sigismember(&pending, signals[k]) == 1;
    return waits;
}
