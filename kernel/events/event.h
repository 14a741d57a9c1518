/* event.h - what ends a phase: triggers of the scene, gaps that close, contact forces that vanish, slip that starts or
 * stops; found in each step and located to the accuracy of the trajectory.
 *
 * A step is run through by a progress coordinate x: the time on routes that step in time, the way along the path on the
 * path route. */
#ifndef PM_EVENT_H
#define PM_EVENT_H

#include "elements/contact.h"
#include "elements/contact_pattern.h"
#include "elements/edge.h"
#include "events/gap_culling.h"
#include "numerics/chebyshev_nodes.h"
#include "state/workspace.h"

enum pm_function_kind {
    FUNCTION_TRIGGER,
    FUNCTION_GAP,
    FUNCTION_NORMAL,
    FUNCTION_STICK,
    FUNCTION_SLIP,
    FUNCTION_MEETING, /* of two points: where they are nearest, they may meet */
    FUNCTION_END,     /* of an edge, an open curve or a piece of one, that something touches */
    FUNCTION_WRAP, /* of a taut cord on a rim that it may slip on: it leaves the rim where nothing is left of its wrap */
    FUNCTION_STRAND, /* of a taut cord: where it is shortest, nothing may be left of it between its circles */
    FUNCTION_JOINT_STICK, /* friction of a joint that holds: what is left of it */
    FUNCTION_JOINT_SLIP,  /* its slip where it slides */
    FUNCTION_FLANK,       /* of teeth: how the flank is pressed that is loaded */
    FUNCTION_TRACK /* of a joint on a curve that is open or has pieces: how far its foot is from the nearer end */
};

/* What is known of the next zero of a function in the step that was sampled last. */
enum pm_zero_search { SEARCH_NONE = 0, SEARCH_BRACKETED = 1, SEARCH_LOCATED = 2, SEARCH_NO_ZERO = 3 };

/* Two places of a step, and a function's values there. */
typedef struct pm_span {
    double a, b, ga, gb;
} pm_span;

/* A place of a step, and there the program of a trigger that counts multiples. */
typedef struct pm_multiple_place {
    double place, value;
} pm_multiple_place;

/* What is kept of such a trigger. */
typedef struct pm_multiples {
    double low, high; /* multiples below and above it; not a number: not known yet */
    pm_multiple_place
        turn[PM_NODES_MOST]; /* where it turns back beside the nodes of the step; not a number: nowhere */
} pm_multiples;

typedef struct pm_event_function {
    int kind;      /* enum pm_function_kind */
    int index;     /* trigger, contact, slot, joint; of a strand: slot and side */
    int direction; /* 0: either way, 1: rising, -1: falling */
    int level;     /* enum pm_level it needs */
    int owned;     /* the route itself finds its roots: not sampled */
    int held;      /* zero when the phase began, or just fired: must first be left */
    int sense;     /* of a friction that holds, 1 or -1: what is left of it against a force that way */
    int every; /* its samples are places along multiples, its values count from one of them (event_multiple.h) */
    int side;       /* 1, -1: its sign when the step began; 0: not known, or it was on zero */
    int born;       /* of a gap beside a foot that is closed: another foot may come to be at any distance */
    int below;      /* of a gap: the mark was below its edge when the phase began */
    int over_end;   /* of a gap: the mark was a corner that goes over an end of its edge */
    double sunk;    /* of a gap: by how much it was below zero as it parted; from there it counts */
    double since;   /* x from which it is held */
    double left;    /* last sample beyond rounding in a step before, or where it went as it fired; 0: none */
    double ends;    /* where it comes from as the step ends on its zero; 0: it does not, or not known */
    int falls;      /* towards zero, and close to it, at the end of the step before */
    double rested;  /* of a trigger: its greatest size in the last step before the phase */
    double located; /* x of the zero that was located, on the dense output: not quite where it is exactly */
    double slack;   /* of a held function: crossed only below -slack; of a held trigger: no more is zero */
    double natural; /* its natural size; of a trigger 1 */
    double near;    /* least value where it came close and went back, since the last instant */
    double near_reach; /* its value on both sides of there */
    double multiple;   /* `every`: from which multiple its values are counted */
    int turned;        /* likewise: where it turns back in the step is known */
    int pattern;       /* of a gap to a pattern: its place among these, else PM_NONE */
    int edge;          /* of a gap to an edge: its place among those that may be gone through, else PM_NONE */
    int search; /* enum pm_zero_search: it holds until the function has fired, or another step is sampled */
    pm_span bracket; /* of its next zero */
    double found;    /* where that is */
    double slope;    /* of its samples there; NaN: not known */
    int ranged;      /* `least` and `most` of its values at the nodes are known */
    double least, most;
    double tail;    /* of its samples (chebyshev.h); negative: not known yet */
    double biggest; /* of their sizes, where the tail is known */
} pm_event_function;

/* The last blows of a contact (events/bounce_series.h). */
#define PM_SERIES_LONGEST 8  /* blows in the longest order that is looked for */
#define PM_SERIES_EXPECTED 5 /* likewise where its end is expected before its ratio has settled */
#define PM_SERIES_BLOWS (3 * PM_SERIES_LONGEST + 1) /* three cycles, and one blow before them */
typedef struct pm_bounce_series {
    int known;                      /* of these times */
    double struck[PM_SERIES_BLOWS]; /* s, the latest first */
    double approach[2];             /* m/s: how fast, the last two times */
    double ratio;                   /* of the flights of one cycle to those of the one before; 0: not known */
    int several;                    /* others have their part in the cycle */
    double known_at;                /* s: the blow that told it */
    double left;                    /* s: sum of the flights that come after that blow */
    double expected; /* s: the end of a series whose ratio has only nearly settled; -INFINITY: not known */
    int own;  /* its last blows one after the other, with none at another contact of its bodies: at most 4 */
    int ends; /* its last blow was held: it is one of those that are not followed */
    double over; /* s: it bounces until then; -INFINITY: it does not */
} pm_bounce_series;

/* The last blows of several contacts, the latest first. */
typedef struct pm_blow_order {
    int n, contact[PM_SERIES_BLOWS];
    double time[PM_SERIES_BLOWS]; /* s */
    int near, *beside;            /* [ncontact] of which contacts they are */
} pm_blow_order;

typedef struct pm_event_set {
    pm_event_function *function;
    int nfunction;
    int ntrigger;                /* of them triggers: they come first */
    int nsampled;                /* of them those that the route does not find */
    int npattern;                /* of them gaps to patterns */
    int nedge;                   /* of them gaps to edges that are open */
    int level;                   /* highest level of all */
    double *value;               /* [most functions][PM_NODES_MOST] samples */
    double place[PM_NODES_MOST]; /* x of the nodes */
    pm_beside *beside;           /* [patterns that are watched][PM_NODES_MOST] at the nodes */
    pm_near *near;               /* [patterns that are watched] at the node that was sampled last */
    pm_edge_place *beside_edge;  /* [edges that are watched][PM_NODES_MOST] likewise */
    int *hit;                    /* [most functions] fired at this instant */
    int *root;                   /* [most functions] roots that the route itself found, or 0 */
    int at_root;                 /* the step ends at one of these */
    int at_due;                  /* it ends when a trigger on time is due */
    double *due;                /* [ntrigger] time at which a trigger on time alone fires next, or INFINITY */
    unsigned char *spent;       /* [ncontact] left its zero by less than rounding: the bounce is over */
    unsigned char *vain;        /* [ncontact] at how many instants at once it closed and was left open */
    pm_bounce_series *series;   /* [ncontact] */
    struct pm_blows_left *left; /* of them, though they are no longer followed (events/blows_left.h) */
    struct pm_flight_firings *firings; /* the last of the run (events/flight_firings.h) */
    int *body; /* [ncontact][PM_REFERENCES + 1] whom a contact touches but the ground; PM_NONE ends them */
    int *beside_struck;       /* [ncontact] those that share a body with one that is struck */
    int *ordered;             /* [ncontact] of each of these, its blows that are in their order already */
    pm_blow_order order;      /* of their blows, as far as they were looked at */
    double *next;             /* [ncontact] and s, the latest of the others; -INFINITY: there is none */
    double *least, *greatest; /* [ntrigger] of the samples in the phase */
    struct pm_multiples *multiples; /* [ntrigger] of those that count multiples */
    double *last;         /* [ntrigger] greatest size of the samples of the last step; INFINITY: of none */
    double *came;         /* [ntrigger] `left` where the last phase ended; 0: of none, or it has just fired */
    int64_t came_jumps;   /* PM_COUNT_JUMPS then */
    unsigned char *acted; /* [nevent] its actions are carried out at this instant */
    void *solver;         /* gsl_root_fsolver */
    pm_gap_culling culling; /* contacts out of reach of the step */
    double
        soonest; /* s: two points that may meet need so long by their distance and speed at one of few nodes, at the least */
    int first_step; /* of the phase */
    int most;       /* size of the function array */
} pm_event_set;

/* In the phase friction holds something: a force that grows makes rounding of what was exactly zero. */
static inline int pm_event_set_sticks(const pm_event_set *e)
{
    int sticks = 0;
    for (int i = e->ntrigger; i < e->nfunction; i++)
        sticks |= e->function[i].kind == FUNCTION_STICK || e->function[i].kind == FUNCTION_JOINT_STICK;
    return sticks;
}

/* What has fired at `since`, or was passed there, must be left before it fires again. */
static inline void pm_event_hold(pm_event_function *f, double since)
{
    f->held = 1;
    f->since = since;
    f->search = SEARCH_NONE;
}

/* A trigger has fired at the zero that was bracketed last: it is on the other side now (event_sides.c). */
void pm_event_sides_fired(pm_event_function *f);

/* Value of a function (pm_event_function) of the workspace at x; the frame looks there. */
typedef double pm_event_at(void *workspace, double x, void *function);

/* It goes through zero from a value a to b, the way that counts. */
static inline int pm_event_way_crosses(const pm_event_function *f, double a, double b)
{
    return (f->direction <= 0 && a > 0 && b <= 0) || (f->direction >= 0 && a < 0 && b >= 0);
}

/* It goes through zero from the side s the way that counts; else it may come back that way. */
static inline int pm_event_way_may_cross(const pm_event_function *f, double s)
{
    return !(f->direction > 0 && s > 0) && !(f->direction < 0 && s < 0);
}

int pm_event_create(pm_workspace *w);

/* The phase's functions, from triggers, contacts and modes; the frame looks at w->state (DYNAMIC). */
void pm_event_begin(pm_workspace *w);
/* A function of the phase at a state, where the frame looks then; not a number where it has no value. */
double pm_event_value_at(pm_workspace *w, const pm_event_function *f, const pm_state *s);
/* Triggers that are zero now, but for the rounding of the state, are held until they have left their zero.  The frame looks
 * elsewhere then. */
void pm_event_hold_on_zero(pm_workspace *w);
/* How many strands the cord of a slot has; 0: it is none.  A strand is told by twice its slot, and one more for the second. */
int pm_event_strands(const pm_model *m, int slot);
/* Its constraint, as a cord between two circles; of these radii how much length is nothing, m. */
double pm_event_strand_constraint(const pm_frame *frame, int strand, pm_constraint *c);
/* Length of the strand of a cord, m, and of its circles' radii how much is nothing. */
double pm_event_strand_left(const pm_workspace *w, int strand, double *nothing);
/* Whether the cord of a slot lies on a rim that it may slip on. */
int pm_event_wraps(const pm_frame *frame, int slot);
/* Along how much of its rim the cord of a slot lies, rad. */
double pm_event_wrap(const pm_frame *frame, int slot);
/* l l' of it (constraint.h). */
double pm_event_strand_approach(const pm_frame *frame, int strand);
/* Where a run failed close to the end of a taut cord's strand that is why: PM_STRAND_ENDS, else `status`. */
int pm_event_explain_strand(pm_workspace *w, int status);
/* PM_STRAND_ENDS, where = contact: at this instant a strand has no length left. */
int pm_event_check_strands(pm_workspace *w);
/* PM_NOT_UNIQUE, where = trigger: an event waits for a reaction that is not unique in this phase. */
int pm_event_check_unique(pm_workspace *w);
/* Samples of function i at the nodes of the step. */
static inline double *pm_event_samples(pm_event_set *event, int i)
{
    return event->value + i * PM_NODES_MOST;
}

/* Value of one function at the frame; what is sampled of it there, and its value from a sample. */
double pm_event_value(pm_workspace *w, const pm_event_function *f);
double pm_event_sample(pm_workspace *w, const pm_event_function *f);
double pm_event_of_sample(const pm_event_function *f, double sample);
/* The function may have either sign in a phase, as that of a contact has not. */
static inline int pm_event_changes_sign(const pm_event_function *f)
{
    return f->kind == FUNCTION_TRIGGER || f->kind == FUNCTION_MEETING || f->kind == FUNCTION_STRAND;
}
/* The table and the row of what it belongs to: an event, a contact, a joint, or the force of a joint's friction. */
int pm_event_owner(const pm_model *m, const pm_event_function *f, int32_t *row);
/* What a located function means for its contact (function.index is then a slot): PM_TRIGGER_OPEN, SLIP, STICK, or
 * PM_NONE. */
static inline int pm_event_contact_change(const pm_event_set *event, int function)
{
    switch (event->function[function].kind) {
    case FUNCTION_NORMAL: return PM_TRIGGER_OPEN;
    case FUNCTION_STICK: return PM_TRIGGER_SLIP;
    case FUNCTION_SLIP: return PM_TRIGGER_STICK;
    default: return PM_NONE;
    }
}

#endif
