/* interrupt.c - see interrupt.h. */
#include "interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

static volatile sig_atomic_t noted; /* a signal handler can reach nothing else */

static const int caught[] = { SIGINT, SIGTERM, SIGHUP };

static void note_signal(int number)
{
    if (!noted)
        noted = number;
}

void interrupt_catch(void)
{
    for (size_t i = 0; i < sizeof caught / sizeof caught[0]; i++) {
        struct sigaction old, action = { .sa_handler = note_signal, .sa_flags = SA_RESTART };

        sigemptyset(&action.sa_mask);
        if (sigaction(caught[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN)
            sigaction(caught[i], &action, NULL);
    }
}

int interrupt_signal(void)
{
    return noted;
}

void interrupt_die(void)
{
    int number = noted;

    if (!number)
        return;
    fflush(stdout);
    signal(number, SIG_DFL);
    raise(number);
    exit(128 + number);
}
