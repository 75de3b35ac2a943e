/* interrupt.h - SIGINT, SIGTERM and SIGHUP wait while several threads write files, so that no part of one is left
 * behind: the library has them wait in a thread that writes, but they would come by another. */
#ifndef CLI_INTERRUPT_H
#define CLI_INTERRUPT_H

/* From here on the signals wait.  A device or a pipe is written straight, so there is nothing to guard, and its reader
 * may take for ever: they do not wait for it.  To be called when all other threads have ended. */
void interrupt_hold(const char *output);

/* The signals take effect as before; one that came meanwhile does so now. */
void interrupt_release(void);

/* Has one come that is held?  Non-zero if so: what takes long ought to be ended. */
int interrupt_waits(void);

#endif
