/* uniform.h - a phase with constant accelerations, as route_uniform.c and its parts share it. */
#ifndef PM_UNIFORM_H
#define PM_UNIFORM_H

#include "elements/constant_motion.h"
#include "state/workspace.h"

/* The search for the first closing of one contact: times from the begin of the phase. */
typedef struct pm_closing {
    double safe;              /* open until here at least */
    double root;              /* closes here; INFINITY: not found yet */
    int exact;                /* that is the root of a parabola, and no rounding of positions in it */
    double looked, g, rate;   /* where it was looked at last, the smallest gap there, and its rate */
    int begun;                /* it has one member alone, and that was looked at as the phase began: */
    double first, first_rate; /* its gap there, and the rate of it */
    double near, near_reach;  /* least gap where it came close and reversed, or INFINITY; gap around there */
} pm_closing;

/* Blows of one contact that follow each other like a geometric series: zeno.c. */
typedef struct pm_series {
    int contact;           /* struck by the last blow, or PM_NONE */
    int alike;             /* successive blows that were the one before, times e */
    double flight;         /* time from the blow before to the last one; 0: not known */
    double *change;        /* [nq] of the velocities by it */
    double *spare;         /* [nq] */
    int pending;           /* contact whose closing ended the last step, or PM_NONE; then: */
    double pending_end;    /* when */
    double pending_flight; /* how long after the begin of its phase */
    double *before;        /* [nq] velocities there */
    int64_t phase, jumps;  /* counts there */
} pm_series;

/* Blows of two contacts by turns, without a loss: turns.c. */
typedef struct pm_turns {
    int n;               /* so many in a row */
    int contact[2];      /* of the last one and the one before */
    double time[3];      /* s, of the last ones */
    double *along, *off; /* [nq] each, of the wedge */
} pm_turns;

/* A watched program that is a parabola of the time, or whose square is one. */
typedef struct pm_parabola {
    int program, squared;
} pm_parabola;

typedef struct pm_uniform {
    /* the phase: q = q0 + v t + a t^2/2 */
    double t0;
    double *q0, *v, *a; /* [nq + 3]: the ground's follow */
    double *lambda;     /* [nconstraint] */
    unsigned char *rotates, *locked;
    pm_constant_motion curve;
    pm_closing *closing;    /* [ncontact] */
    double *slip_end;       /* [nslot] when a sliding contact stops, from the begin of the phase */
    double *edge_end;       /* [nslot] when what touches an edge comes to its end */
    double *strand_end;     /* [2 nslot] when a strand ends: two of each slot */
    double *joint_slip_end; /* [ngrip] when the slip of a joint does */
    int irregular;          /* a contact touches and does neither leave nor rest */
    int status;             /* of looks */
    /* the last step, from the begin of the phase */
    double begin, end;
    /* what the shared machinery samples */
    int sampled;          /* greatest degree (program_degree.h) of all that is watched; -1: nothing is */
    pm_parabola *watched; /* [ntrigger + nask] */
    int nwatched;
    double stride; /* longest next step, s */
    /* integrals */
    double *rate; /* [3][nz] at begin, middle and end */
    double *z0;   /* [nz] at the begin of the step */
    int rests;    /* nothing acts: none of them changes in the phase */
    double *v_look,
        *q_look;   /* [nq + 3], [nq] of the place that is looked at; the ground's velocities follow */
    double looked; /* its time by pm_uniform_look; NaN: it is another place */
    pm_series series;
    pm_turns turns;
} pm_uniform;

/* uniform_motion.c: the frame looks at `t` seconds after the begin of the phase; the same with all accelerations and
 * reactions known. */
void pm_uniform_look(pm_workspace *w, double t);
void pm_uniform_look_at_forces(pm_workspace *w, double t);
/* The same at q_look, v_look, whatever is there. */
void pm_uniform_look_there(pm_workspace *w, double t);
/* q and v, both [nq], `t` seconds after the begin of the phase. */
void pm_uniform_place(const pm_model *model, const pm_uniform *u, double t, double *q, double *v);
/* The frame has the accelerations and reactions of the phase; the same, by a solution where they may change. */
void pm_uniform_know_forces(pm_frame *frame, const pm_uniform *u);
int pm_uniform_react(pm_workspace *w);

/* uniform_motion.c: rates[nz] of all running integrals at q_look, v_look; `t` seconds after the begin of the phase. */
void pm_uniform_rates(pm_workspace *w, double *rate);
void pm_uniform_rates_after(pm_workspace *w, double t, double *rate);
/* z[nz] at t, in the step whose first rates are known. */
void pm_uniform_integrate(pm_workspace *w, double t, double *z);

/* uniform_gap.c: first positive root of g + rate s + bend s^2/2, or INFINITY; g >= 0, and rate > 0 where g = 0. */
double pm_uniform_gap_first_root(double g, double rate, double bend);
/* uniform_gap.c: at the begin of the phase (the frame looks there): nothing is known yet, but whether a touching contact
 * leaves or rests: else it is irregular. */
void pm_uniform_gap_begin(pm_workspace *w, int contact);
/* Goes on until the time `end` is safe, or the contact closes before or then, or for long enough. */
void pm_uniform_gap(pm_workspace *w, int contact, double end);

/* The last step has ended, at u->end: how near the contact came to closing without doing so. */
void pm_uniform_gap_note(pm_workspace *w, int contact);

/* uniform_edge.c: of every contact with an edge that ends a polynomial of the time says all. */
int pm_uniform_edge_hold(const pm_workspace *w);
/* At the begin of the phase: when it closes, or comes to its end, if ever. */
void pm_uniform_edge_begin(pm_workspace *w, int contact);
/* As pm_uniform_gap_note, whether it is open or something touches it. */
void pm_uniform_edge_note(pm_workspace *w, int contact);

/* uniform_strand.c: at the begin of the phase: when of each taut strand nothing is left. */
void pm_uniform_strand_begin(pm_workspace *w);
/* The first of these times that is not after `end`. */
double pm_uniform_strand_first(const pm_workspace *w, double end);
/* The last step has ended, at u->end: how short the strand of this function became and grew again; how fast one ends. */
void pm_uniform_strand_note(pm_workspace *w, int function);

/* The contact has just closed, and bounces too low for positions to resolve would still be told from rest. */
int pm_uniform_resolves(const pm_workspace *w, int contact);

/* zeno.c: a new case has no series yet; the phase that begins may follow a blow of the series; it ends with a blow of
 * contact `contact` (PM_NONE: with anything else). */
void pm_zeno_reset(pm_uniform *uniform);
void pm_zeno_begin(pm_workspace *w);
void pm_zeno_end(pm_workspace *w, int contact);
/* Right after a blow of a series that has shown itself. */
int pm_zeno_may_leap(const pm_uniform *uniform);
/* If the rest of the series of `contact`, which strikes next after `flight` seconds, can be taken at once before t_limit:
 * w->state goes to its limit. */
int pm_zeno_leap(pm_workspace *w, int contact, double flight, double t_limit, int *taken);

/* turns.c: nothing has been struck; the instant before this phase was one blow of the contact and nothing else, at the velocities
 * before[nq]. */
void pm_turns_reset(pm_uniform *uniform);
void pm_turns_follow(pm_workspace *w, int contact, const double *before);
/* `contact` would be struck next, after `flight` s: if two contacts are struck by turns without a loss, w->state goes to right before
 * one of their blows to come, before t_limit. */
int pm_turns_leap(pm_workspace *w, int contact, double flight, double t_limit, int *taken);

#endif
