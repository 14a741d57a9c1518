/* workspace.h - everything that one thread needs to run cases of a model, in parts by who fills and who reads them.
 *
 * It is allocated once (run/workspace.c): nothing is allocated inside a case.  Rooms keep what only they read in structs of
 * their own, to which the workspace only points. */
#ifndef PM_WORKSPACE_H
#define PM_WORKSPACE_H

#include "state/frame.h"
#include "state/numbers.h"
#include "state/patience.h"
#include "state/state.h"

typedef struct pm_workspace pm_workspace;
typedef struct pm_constraint pm_constraint; /* elements/constraint.h */
struct pm_route_ops;
struct pm_chebyshev_nodes;

/* The active constraints: joints first, then captured pairs, then normals, then tangents (equations/active_set.h). */
typedef struct pm_active_set {
    pm_constraint *constraint; /* [nconstraint] */
    int n;
    int njoint;               /* of these the first are the joints' */
    pm_constraint *redundant; /* [nconstraint] those that depend on the active ones */
    int nredundant;
    unsigned char *doubtful; /* [nconstraint] active, and dependent here but not nearby */
    int *aside;    /* [nconstraint] scratch of active_set.c: places of those that are taken out for a while */
    double *share; /* [nconstraint] reactions of redundant ones: 0, or by shared_reading.h */
    int asymmetric;      /* some contact slides: H differs from G */
    int clear;           /* no constraint comes near to depending on others */
    double independence; /* the most that the kept ones had so far, where joints share loads; else 0 */
    int evaluated;       /* the last projection, or building, has left the frame where it evaluated them */
    int64_t version;     /* counts the sets */
    /* places: of an active constraint >= 0; of redundant[k] PM_REDUNDANT_PLACE(k) < PM_NONE; else PM_NONE */
    int *of_joint;            /* [njoint_constraint] of each constraint of a joint */
    int *slot_normal;         /* [nslot] */
    int *slot_tangent;        /* [nslot] */
    int *slot_held;           /* [nslot][PM_JOINT_CONSTRAINTS] of a captured pair */
    int *friction_constraint; /* [nfriction] that of the friction of a joint that holds */
    double *friction_load;    /* [nfriction] friction that goes with the load of its joint, N or N m */
    int *joint_order;         /* [njoint] in which their constraints stand (equations/constraint_order.h) */
    int *body_place;          /* [nbody] scratch of constraint_order.c, and of active_set.c */
    struct pm_shared *shared; /* what the redundant ones share with active ones (equations/shared_loads.h) */
} pm_active_set;

/* The same with light coordinates as unknowns (equations/saddle_light.h); N: constraints and these. */
typedef struct pm_saddle_light {
    int is_used;      /* the present factors are these */
    int n, *at;       /* [nq] light coordinates that active constraints move */
    double *matrix;   /* [N][N] scaled, then its factors */
    int *pivot;       /* [N] */
    double *scale;    /* [N] of rows and columns */
    double *unknown;  /* [N] scratch */
    double *force;    /* [nq] scratch: on all coordinates */
    double *response; /* [nq] of the light coordinates, to what was solved for last */
} pm_saddle_light;

/* The factored system on the active set, and its right-hand side (equations/saddle.h). */
typedef struct pm_saddle {
    const pm_model *model;
    const pm_numbers *numbers;
    const pm_active_set *active;
    double *schur;            /* [nconstraint][nconstraint] S = G M^-1 H^T, then its factors */
    int *pivot;               /* [nconstraint] */
    double *rhs;              /* [nconstraint] right-hand side, then the solution */
    double *wanted;           /* [nconstraint] rates that a response is to have */
    double *previous;         /* [nq] scratch: the response of the round before */
    int *first_constraint;    /* [nbody] scratch */
    int nfactored;            /* the factors are of so many constraints; 0: of none */
    struct pm_hold *factored; /* [nconstraint] which take hold here */
    double *basis;            /* [nq + 1][nq] orthonormal rows (equations/orthonormal_rows.h) */
    int *basis_range;         /* [nq + 1][2] coordinates between which each is not zero */
    pm_saddle_light light;
} pm_saddle;

/* What the last blow did (impact/impact.h). */
typedef struct pm_impulses {
    double *joint;          /* [njoint_constraint] N s, N m s */
    int *flank;             /* [njoint] of teeth: which flank had it (teeth.h) */
    double *friction;       /* [nfriction] N s, N m s: of joints that rub by their load, along their slip */
    double *slot;           /* [2 nslot] N s: normal, tangential; of a captured pair x, y */
    double *slot_direction; /* [nslot][4] normal x, y, tangent x, y on the first partner */
    double *applied;        /* [nq] N s, N m s: by the actions of an event */
    int nshared;            /* ways in which the impulses might be others, with the same motion */
    double *shared;         /* [nconstraint][njoint_constraint + 2 nslot] what each adds to joint and slot */
    double energy_lost;     /* J, kinetic */
} pm_impulses;

/* What the audit keeps from the start on (equations/ledger.h). */
typedef struct pm_ledger {
    double energy_start, energy_lost, energy_scale; /* J */
    double momentum_start[PM_LEDGER];               /* N s, N s, N m s */
    double momentum_scale;                          /* N s */
    double *force_energy_start;                     /* [nforce] J, of springs */
    double constraint_worst; /* greatest residual of a constraint, of the scene's size */
    double evidence;         /* worst relative disagreement that the path route found */
} pm_ledger;

enum pm_stiffness { PM_NOT_STIFF = 0, PM_STIFF = 1, PM_STIFF_IN_VAIN = 2 /* no other route goes on */ };

/* How the present phase is computed (run/plan.c). */
typedef struct pm_phase {
    const struct pm_route_ops *route;
    int kinematic;   /* the run needs no accelerations */
    int rule, price; /* why the route was chosen; cost of the dearest so far */
    int lap;         /* the path may have closed at the end of the step */
    int path_left;   /* the path route has given up in this case */
    int singular;    /* the route ida has come near a singular position */
    int stiff;       /* enum pm_stiffness of the case so far */
} pm_phase;

/* A perturbation that waits for the next phase: to which side that leaves a rest or a steady motion.  A setting or an action
 * asks for it, routes/start/perturbation.h carries it out. */
typedef struct pm_request {
    int program;    /* > 0 for velocities on that side; PM_NONE: nothing waits */
    int table, row; /* where it is written */
} pm_request;

/* The last accepted step, by the route's progress coordinate; the state is at its end (state/route.h). */
typedef struct pm_step {
    double begin, end;                      /* of what is looked at of it: all, or a window */
    double whole_begin, whole_end;          /* of the route's step; the state is at its end */
    double least_window, reach, stuck;      /* events/step_window.h */
    int shown;                              /* the samples show what is watched, but for corners and jumps */
    double sampled_end;                     /* where the step ended when it was sampled */
    const struct pm_chebyshev_nodes *nodes; /* where it is sampled */
    struct pm_time_course *course;          /* how far it may go (events/time_course.h) */
    struct pm_motion_course *motion;        /* the same by what forces read (events/motion_course.h) */
    int reverses;                           /* the motion reverses at the end of the step */
    double *reversed;                       /* [nq] the velocities with which it does, at the scene's speed */
} pm_step;

/* The step of a route, or what is left of it. */
static inline void pm_step_set(pm_step *step, double begin, double end)
{
    step->begin = step->whole_begin = begin;
    step->end = step->whole_end = end;
}

/* The modes when the present instant began, and what it let go (impact/contact_modes.h). */
typedef struct pm_instant {
    pm_slot *slot_before;         /* [nslot] */
    int32_t *friction_before;     /* [nfriction] */
    unsigned char *slot_released; /* [nslot] let go at this instant: not closed again at it */
    double *place, *velocity;     /* [nq] each: those of the state, while modes are tried */
    double since;       /* s: since then instants have followed each other with no time between them */
    int64_t at_once;    /* so many */
    int let_go;         /* at one of these the load of a rough contact vanished */
    double switched;    /* s: when a force switched last */
    int64_t to_and_fro; /* so many times running it did so again at once */
    int jams;           /* it begins with an impact without collision: no step led on */
} pm_instant;

/* Which triggers have fired, and how often and when events did (elements/trigger.h). */
typedef struct pm_firing {
    unsigned char *fired;   /* [ntrigger] enum pm_fired, at this instant */
    double *before;         /* [ntrigger] values of their programs before the jump */
    double *size;           /* [ntrigger] greatest of these values, and of those after jumps, so far */
    int64_t *count;         /* [nevent] how often it has fired */
    int64_t *seen;          /* [nevent] how often its triggers were marked */
    unsigned char *counted; /* [nevent] enum pm_counted, at this instant */
    double *time;           /* [nevent] s, when it fired last; not a number before */
    double *side;           /* [nevent] of a switch: 1 where its program is positive; of a table: the piece */
    double jumped; /* s, when velocities jumped last at an instant that was located; not a number before */
} pm_firing;

/* Where bounds came to their end before they told whether something fires. */
typedef struct pm_unseen {
    double t;       /* s, of the first; NaN: never */
    int table, row; /* whose it is */
} pm_unseen;

/* Whether errors and margins are estimated, and the pass that notes them (state/evidence.h). */
typedef struct pm_evidence {
    int active;                    /* the present case is run for its errors too */
    int seeks;                     /* a pass is a find with all its runs */
    int by_places;                 /* the path route knows its own errors (routes/path/path.h) */
    const unsigned char *discrete; /* [nask] integers and yes or no: they have no error, but a margin */
    uint64_t noise;                /* state of the generator of disturbances */
    int calm;                      /* the steps of a coarse run are not disturbed, only its phases */
    int pattern;                   /* by which what is read is shifted (study/natural_size.c) */
    double late;                   /* of the main pass, in its coarse run: that of pm_pass */
    double most_steps;             /* of a pass: what takes longer does not pay */
    double loosest;   /* tolerance that is enough for the present run of a find; 0: that of the pass */
    pm_unseen unseen; /* in the present run, whether its errors are estimated or not */
    struct pm_pass *present;
} pm_evidence;

/* What a case answers; the arrays are the caller's (study/batch.c). */
typedef struct pm_result {
    double *out;     /* [nout] */
    int32_t *reason; /* [nask] enum pm_reason */
    double *audit;   /* [PM_AUDITS] */
    int64_t count[PM_COUNT_COLUMNS];
    pm_where where;   /* of a failure */
    pm_where ordered; /* the first blow of PM_COUNT_ORDERED_BLOWS: contact, member: the other contact; s */
} pm_result;

/* Where bodies can be, and which contacts are out of reach because of it (equations/gap_bounds.h). */
typedef struct pm_reach {
    struct pm_hinge_bounds *hinge; /* [nbody + 1] of each body; last: the ground */
    int ncontact;                  /* contacts that can never close */
} pm_reach;

/* What is written down of one case that is recorded; NULL in a batch. */
typedef struct pm_record {
    struct pm_history *history;     /* events/history.h */
    struct pm_phase_report *phases; /* run/run.h */
} pm_record;

struct pm_workspace {
    const pm_model *model;
    pm_patience patience;
    double (*read_measure)(pm_workspace *w,
                           int i); /* what programs read: pm_measure_signed (elements/measure.h) */
    pm_numbers numbers;
    pm_state state, start; /* now; at t = 0 after the assembly */
    pm_state probe;        /* a state inside a step */
    pm_state ahead;        /* the end of a step while an instant inside it is marked */
    pm_frame frame;
    pm_active_set active;
    pm_saddle saddle;
    pm_impulses impulses;
    pm_ledger ledger;
    pm_phase phase;
    pm_request request;
    pm_step step;
    pm_instant instant;
    pm_firing firing;
    pm_evidence evidence;
    pm_result result;
    /* what single rooms keep */
    struct pm_fixed_bodies *fixed;
    struct pm_solve_cache *cache;
    pm_reach reach;
    struct pm_tree *tree;
    struct pm_event_set *event;
    struct pm_ask_set *ask;
    struct pm_watched_samples *watched;
    struct pm_blow *blow;
    struct pm_path *path;
    struct pm_repeat *repeat;
    struct pm_uniform *uniform;
    struct pm_rk *rk;
    struct pm_ida *ida;
    struct pm_perturbation *perturbation; /* NULL where the scene has none */
    struct pm_find *find;                 /* NULL where nothing is sought */
    struct pm_accuracy *accuracy;
    pm_record record;
    double *scratch; /* [8 (nq + nconstraint + nslot)] of a start: nothing is kept in it */
    pm_arena memory; /* owns all that is above */
};

/* Place of the redundant constraint k, and the k of such a place (pm_active_set). */
#define PM_REDUNDANT_PLACE(k) (PM_NONE - 1 - (k))

/* Reaction at a place of the active set; 0 where nothing acts. */
static inline double pm_reaction(const pm_workspace *w, int place)
{
    return place >= 0         ? w->frame.lambda[place]
           : place == PM_NONE ? 0
                              : w->active.share[PM_REDUNDANT_PLACE(place)];
}

/* Memory of a workspace for the model, and of all rooms; PM_NO_MEMORY, and *workspace is NULL then. */
int pm_workspace_create(const pm_model *model, pm_workspace **workspace);
void pm_workspace_free(pm_workspace *w);
/* Notes where the case failed, and by which numbers; returns the status. */
int pm_fail(pm_result *result, int status, int table, int row, double value, double bound);
/* The same with a member of the row: of a pattern, an edge, or a column of the table. */
int pm_fail_member(pm_result *result, int status, int table, int row, int member, double value, double bound);
/* PM_OK, or the status of a case that is given up (pm_patience_ends). */
int pm_fail_early(pm_result *result, pm_patience *patience);
/* The same where a search of numerics/bracket.h has ended: PM_OK if it has found, else PM_SOLVER. */
int pm_fail_search(pm_result *result, int search_end);

#endif
