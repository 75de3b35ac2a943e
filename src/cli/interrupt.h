/* interrupt.h - SIGINT, SIGTERM and SIGHUP are noted, so that work stops where nothing is left behind. */
#ifndef CLI_INTERRUPT_H
#define CLI_INTERRUPT_H

/* From here on the signals are noted instead of ending the process; a signal that the caller ignores stays ignored. */
void interrupt_catch(void);

/* The signal that came first, or 0. */
int interrupt_signal(void);

/* Ends the process by the signal that came, as its convention is: the shell sees 128 + its number.  Returns if none
 * came. */
void interrupt_die(void);

#endif
