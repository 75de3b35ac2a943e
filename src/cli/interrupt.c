/* interrupt.c - see interrupt.h. */
#include "interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <sys/stat.h>

static const int signals[] = { SIGINT, SIGTERM, SIGHUP };

/* Those that would end the command: an ignored one would be pending all the same while it is blocked. */
static sigset_t waiting(void)
{
    sigset_t set;

    sigemptyset(&set);
    for (size_t k = 0; k < sizeof signals / sizeof *signals; k++) {
        struct sigaction now;

        if (sigaction(signals[k], NULL, &now) == 0 && now.sa_handler != SIG_IGN)
            sigaddset(&set, signals[k]);
    }
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
    sigset_t set = waiting(), held, pending;
    int waits = 0;

    if (pthread_sigmask(SIG_SETMASK, NULL, &held) != 0 || sigpending(&pending) != 0)
        return 0;
    for (size_t k = 0; k < sizeof signals / sizeof *signals; k++)
        waits |= sigismember(&set, signals[k]) == 1 && sigismember(&held, signals[k]) == 1 &&
                 sigismember(&pending, signals[k]) == 1;
    return waits;
}
