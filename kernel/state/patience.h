/* patience.h - when a case is given up: another thread has raised the stop flag, or its computing time is spent. */
#ifndef PM_PATIENCE_H
#define PM_PATIENCE_H

#include <stdint.h>

typedef struct pm_patience {
    const int32_t *stop; /* raised by another thread, or NULL */
    double limit;        /* s of this thread's time for a case with all its passes; INFINITY: none */
    double begun, last;  /* s, when the case began, and when the clock was read last */
    int span, left;      /* questions from one look at the clock to the next, and those left */
    int over;            /* PM_OK, or how the case ends: it stays so until the next one begins */
} pm_patience;

/* Another case begins; its limit is not known before its numbers are. */
void pm_patience_begin(pm_patience *p);
void pm_patience_limit(pm_patience *p, double limit);
/* PM_OK, PM_CANCELLED or PM_LIMIT_CPU.  To be asked in every loop whose length the scene decides: a look at a flag, and now and
 * then at the clock where there is a limit. */
int pm_patience_ends(pm_patience *p);
static inline int pm_patience_is_stopped(const int32_t *stop)
{
    return stop && __atomic_load_n(stop, __ATOMIC_RELAXED) != 0;
}

#endif
