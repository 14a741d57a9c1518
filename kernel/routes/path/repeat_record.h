/* repeat_record.h - what is known of the last leg, as the parts of repeat.c share it, and what legs that were passed over can be given
 * back to. */
#ifndef PM_REPEAT_RECORD_H
#define PM_REPEAT_RECORD_H

#include "state/workspace.h"

#define PM_MOST_REPEATS 100000000

/* What legs that were passed over may have to be given back to. */
typedef struct pm_repeat_saved {
    pm_state begin, last;           /* begin of the first leg passed over, and of the leg before it */
    double kinetic, before, lowest; /* of the leg before */
    int end_kind, end_mark;
    pm_ledger ledger;
    double speed, error;
    int64_t count[PM_COUNT_COLUMNS], count_before[PM_COUNT_COLUMNS];
    int64_t *event_count, *event_before; /* [nevent] */
    double *event_time, *out, *ask;      /* [nevent], [nout], numbers of the asks */
    double *range;                       /* least and greatest of the triggers in the leg before */
    unsigned char *ask_flags;
} pm_repeat_saved;

typedef struct pm_repeat {
    int known;                                     /* `begin` is the begin of the last leg */
    pm_state begin;                                /* of the last leg */
    double kinetic;                                /* T there */
    double before;                                 /* T at its end, before the blow */
    double lowest;                                 /* least T on it */
    double end;                                    /* place in the step at which it ended */
    int64_t steps;                                 /* of which it consisted */
    int end_kind, end_mark;                        /* what ended it: kind of function, contact */
    int64_t count[PM_COUNT_COLUMNS], *event_count; /* at its begin */
    /* from one leg to the next */
    double by[2], *turn; /* the shift; [nbody] */
    int member;          /* so many members on in a row */
    double work, ratio;  /* repeat_energy.c */
    /* legs passed over and not yet confirmed by the one that is computed */
    int64_t pending, most;
    int expected_kind, expected_mark;
    pm_repeat_saved saved;
    void *block;
} pm_repeat;

int pm_repeat_record_create(pm_workspace *w);
void pm_repeat_record_free(pm_workspace *w);

/* A leg begins at w->state. */
void pm_repeat_record_begin(pm_workspace *w);
/* The legs from w->state on may be passed over: all that changes with them is saved. */
void pm_repeat_record_save(pm_workspace *w);
/* The ranges of the triggers alone. */
void pm_repeat_record_save_range(pm_workspace *w);
/* They have not happened.  The frame looks at w->state, the rows are built for it. */
int pm_repeat_record_restore(pm_workspace *w);
/* How often an event has fired since the begin of the last leg. */
int64_t pm_repeat_record_fires(const pm_workspace *w, int event);

#endif
