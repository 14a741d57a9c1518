/* model.h - the structure of a scene (immutable, shared by threads), its state and a thread's workspace.
 *
 * model      tables and sizes; no number of any case
 * state      t, q, v, running integrals, and what the rows remember; copied as one block
 * workspace  everything that one thread needs, allocated once: nothing is allocated inside a case
 */
#ifndef PM_MODEL_H
#define PM_MODEL_H

#include <stddef.h>
#include <stdint.h>

#include "planemotion.h"

#define PM_ROW_SLOTS 4         /* members of one periodic row that may be closed at once */
#define PM_JOINT_CONSTRAINTS 3 /* most rows of one joint */
#define PM_LEDGER 3            /* impulses of the outer world: x, y, moment about the origin */

struct pm_program_fold;

typedef struct pm_model {
    const int32_t *table[PM_TABLES]; /* first row of each table, in the caller's array */
    int rows[PM_TABLES];
    const double *constant;
    int nconstant;
    int nparam;
    int nbody, nq; /* nq = 3 nbody: x, y, angle of each mass centre */
    int nvalue, nask, nout;
    int njoint_row;           /* rows of all joints */
    int nslot;                /* places for closed contacts: 1 per contact, PM_ROW_SLOTS per periodic row */
    int nsegment;             /* contacts with edges that end */
    int nmemory;              /* joints and slots: what their no-slip and driven rows and strands remember */
    int nkept;                /* slots of contacts that capture */
    int nrow;                 /* most active rows: njoint_row + 2 nslot + nkept */
    int ngrip;                /* frictions of joints */
    int grip_memory;          /* first of their memories */
    int *grip_force;          /* [ngrip] row of each in the table of forces */
    int nz;                   /* running integrals: forces' work, paths, then PM_LEDGER audit entries */
    int nz_work;              /* of these the first are works of forces */
    int nz_controlled;        /* of these the first are under error control */
    int spin_z, spin_angle_z; /* running integrals of the spin's momentum and rate, or PM_NONE */
    int uses_time;            /* some force or trigger depends on t: rest does not last, or is waited out */
    int *contact_slot;        /* [ncontact] first slot */
    int *contact_kept;        /* [ncontact] first kept place, or PM_NONE */
    int *joint_row;           /* [njoint] first row among the joint rows */
    int *joint_memory;        /* [njoint] first, or PM_NONE */
    int *force_z;             /* [nforce] running integral of its work, or PM_NONE: it has a potential */
    int *path_z;              /* [nmeasure] running integral of a path measure, or PM_NONE */
    int *path;                /* [npath] the measures of paths: their integrals follow the works */
    int npath;
    unsigned char *program_level;  /* [nprogram] enum pm_level that its measures need */
    unsigned char *program_nature; /* [nprogram] enum pm_program_class */
    unsigned char *program_growth; /* [nprogram] enum pm_program_energy */
    int forces_by_place;           /* all forces depend on the configuration alone */
    int recalls; /* and so do accelerations on given rows, but for the velocities: nothing drives, holds by load, acts */
    int reads_time;     /* some program reads the time */
    int samples_time;   /* some trigger, extreme or grid does */
    int nelement;       /* joints, contacts and forces */
    int acts;           /* some event does something, or not whenever its triggers fire */
    int watches_counts; /* what is watched in a step reads the count or time of an event */
    struct pm_program_fold *fold;
    int32_t *reduced;             /* own tables of a model without what no answer needs (prune.h), or NULL */
    int32_t *original[PM_TABLES]; /* then: the caller's row of each row */
} pm_model;

/* What must be known of a state before a program can be run on it. */
enum pm_level { PM_LEVEL_NONE = 0, PM_LEVEL_KINEMATIC = 1, PM_LEVEL_DYNAMIC = 2 };

static inline const int32_t *pm_table_row(const pm_model *m, int table, int row, int columns)
{
    return m->table[table] + (ptrdiff_t)row * columns;
}
#define PM_BODY_ROW(m, i) pm_table_row(m, PM_TABLE_BODY, i, PM_BODY_COLUMNS)
#define PM_POINT_ROW(m, i) pm_table_row(m, PM_TABLE_POINT, i, PM_POINT_COLUMNS)
#define PM_LINE_ROW(m, i) pm_table_row(m, PM_TABLE_LINE, i, PM_LINE_COLUMNS)
#define PM_CIRCLE_ROW(m, i) pm_table_row(m, PM_TABLE_CIRCLE, i, PM_CIRCLE_COLUMNS)
#define PM_ROW_ROW(m, i) pm_table_row(m, PM_TABLE_ROW, i, PM_ROW_COLUMNS)
#define PM_JOINT_ROW(m, i) pm_table_row(m, PM_TABLE_JOINT, i, PM_JOINT_COLUMNS)
#define PM_CONTACT_ROW_OF(m, i) pm_table_row(m, PM_TABLE_CONTACT, i, PM_CONTACT_COLUMNS)
#define PM_FORCE_ROW(m, i) pm_table_row(m, PM_TABLE_FORCE, i, PM_FORCE_COLUMNS)
#define PM_MEASURE_ROW(m, i) pm_table_row(m, PM_TABLE_MEASURE, i, PM_MEASURE_COLUMNS)
#define PM_START_ROW(m, i) pm_table_row(m, PM_TABLE_START, i, PM_START_COLUMNS)
#define PM_TRIGGER_ROW(m, i) pm_table_row(m, PM_TABLE_TRIGGER, i, PM_TRIGGER_COLUMNS)
#define PM_UNTIL_ROW(m, i) pm_table_row(m, PM_TABLE_UNTIL, i, PM_UNTIL_COLUMNS)
#define PM_ASK_ROW(m, i) pm_table_row(m, PM_TABLE_ASK, i, PM_ASK_COLUMNS)
#define PM_FIND_ROW(m, i) pm_table_row(m, PM_TABLE_FIND, i, PM_FIND_COLUMNS)
#define PM_VARY_ROW(m, i) pm_table_row(m, PM_TABLE_VARY, i, PM_VARY_COLUMNS)
#define PM_SECOND_ROW(m, i) pm_table_row(m, PM_TABLE_SECOND, i, PM_SECOND_COLUMNS)
#define PM_CONDITION_ROW(m, i) pm_table_row(m, PM_TABLE_CONDITION, i, PM_CONDITION_COLUMNS)
#define PM_EVENT_ROW(m, i) pm_table_row(m, PM_TABLE_EVENT, i, PM_EVENT_COLUMNS)
#define PM_ACTION_ROW(m, i) pm_table_row(m, PM_TABLE_ACTION, i, PM_ACTION_COLUMNS)
#define PM_SETTING(m, column) ((m)->table[PM_TABLE_SETTING][column])

/* How a closed contact moves. */
enum pm_contact_mode {
    PM_OPEN = 0,
    PM_SMOOTH = 1,
    PM_STICK = 2,
    PM_SLIDE_FORWARD = 3,
    PM_SLIDE_BACKWARD = 4,
    PM_CAPTURED = 5
};

typedef struct pm_slot {
    int32_t mode;   /* enum pm_contact_mode */
    int32_t member; /* of a periodic row, else 0 */
} pm_slot;

/* A no-slip row is holonomic with memory: its constant, and the last unwrapped direction of a strand. */
typedef struct pm_memory {
    double anchor;
    double direction;
    double time; /* up to which the way of a drive is part of the anchor */
} pm_memory;

/* Where a captured pair is held, in the axes of both bodies, and its relative angle (capture.c). */
typedef struct pm_kept {
    double a[2], b[2], angle;
} pm_kept;

typedef struct pm_state {
    double t;
    double *q, *v, *z;     /* [nq], [nq], [nz] */
    pm_kept *kept;         /* [nkept] */
    pm_memory *memory;     /* [nmemory]: joints, then slots */
    pm_slot *slot;         /* [nslot] */
    int32_t *grip;         /* [ngrip] enum pm_contact_mode of the frictions of joints */
    unsigned char *absent; /* [nelement] removed, or not there yet (action.h) */
    void *block;
    size_t bytes;
} pm_state;

/* Place of a joint, contact or force among the elements. */
static inline int pm_model_element(const pm_model *m, int table, int row)
{
    const int joints = m->rows[PM_TABLE_JOINT], contacts = m->rows[PM_TABLE_CONTACT];
    return row + (table == PM_TABLE_JOINT ? 0 : table == PM_TABLE_CONTACT ? joints : joints + contacts);
}

/* Whether it is not there in state s. */
static inline int pm_state_is_absent(const pm_model *m, const pm_state *s, int table, int row)
{
    return s->absent[pm_model_element(m, table, row)];
}

/* One scalar constraint row of the active set; which formula is constraint.c's table of kinds. */
typedef struct pm_constraint {
    int kind;                  /* enum pm_constraint_kind */
    int body[2];               /* body index, or nbody for the ground */
    double a[2], b[2];         /* marks in body axes */
    double radius_a, radius_b; /* signed: see constraint_distance.c, constraint_strand.c */
    double value;              /* length, angle, or direction of a line in its body */
    double axis[2];            /* cosine and sine of that direction */
    double sign;               /* distance rows: which way is positive */
    double ratio;              /* turn rows: so many turns of b count against one of a */
    int memory;                /* index of its memory, or PM_NONE */
    int joint, slot;           /* owner: one of both is PM_NONE */
    int normal;   /* sliding rows and friction: index of the active row of its normal, else PM_NONE */
    double slide; /* normal row of a sliding contact: -mu sgn(slip) rides on it; else 0 */
    double j[6];  /* Jacobian on (x, y, angle) of body[0] and body[1], at the frame's state */
    double h[6];  /* direction of the force: j, but for sliding contacts */
    double g;     /* residual, m or rad */
    int drive;    /* program of its prescribed rate, or PM_NONE */
    double rate;  /* prescribed at the frame: G v = rate */
    double gamma; /* -(dG/dt) v */
} pm_constraint;

/* A state looked at: positions of marks, forces, accelerations, reactions; filled as far as `level` says. */
typedef struct pm_frame {
    double t;
    const double *q, *v, *z;
    const pm_memory *memory;
    int level;
    double *pose;     /* [nbody + 1][5]: x, y, angle, cos, sin; last: the ground */
    double *velocity; /* [nbody + 1][3]; last: zero */
    double *turn;     /* [nbody][3] an angle of the case, its cosine and its sine (pm_frame_look) */
    double *f;        /* [nq] applied forces */
    double *power;    /* [nforce] of forces without potential */
    double *a;        /* [nq] accelerations */
    double *lambda;   /* [nrow] reactions of the active rows */
} pm_frame;

typedef struct pm_where {
    int table, row, member;
    double value, bound;
} pm_where;

/* The axis about which the plane turns, and what the case says of it (turning_plane.c). */
typedef struct pm_turning_plane {
    double through[2], angle;
    double normal[2]; /* to the left of the axis */
    double inertia;   /* of whatever else turns along */
    double momentum;  /* at the start */
} pm_turning_plane;

struct pm_route_ops;
struct pm_event_set;
struct pm_ask_set;
struct pm_watched_samples;
struct pm_find;
struct pm_accuracy;
struct pm_perturbation;
struct pm_solve_cache;
struct pm_fixed_bodies;

typedef struct pm_workspace {
    const pm_model *model;
    const volatile int32_t *stop; /* raised by another thread, or NULL */
    /* the case */
    const double *param;
    double *value;  /* [nvalue] */
    double *number; /* of the programs, the same throughout the case (program_fold.h) */
    int has_numbers;
    double *mass;         /* [nbody] */
    double *stand_in;     /* [nq] what stands for a mass or inertia of 0 in inverse_mass; else 0 */
    int massless;         /* some coordinate has such */
    double *wanted;       /* [nrow] rates that a response is to have: see saddle.h */
    double *previous;     /* [nq] */
    double *inverse_mass; /* [nq] inverse of the diagonal of M; 0: held (a particle's angle) */
    double *inverse_root; /* [nq] its square root */
    double gravity[2];
    pm_turning_plane spin;
    double size;      /* length scale of the scene, m */
    double speed;     /* speed scale, m/s, grows with the motion */
    double accuracy;  /* asked, relative, of the answers */
    double tolerance; /* relative tolerance of integration */
    double coarse;    /* factor on steps and on what counts as nothing: 1, but in a companion (accuracy.c) */
    pm_state state, start;   /* now; at t = 0 after the assembly */
    pm_state probe;          /* a state inside a step */
    pm_state ahead;          /* the end of a step while an instant inside it is marked */
    pm_constraint *of_joint; /* [njoint_row] rows of all joints with the numbers of the case (joint.h) */
    /* active rows: joints first, then captured pairs, then normals, then tangents */
    pm_constraint *row; /* [nrow] */
    int nactive;
    int njoint_active;
    int *joint_active; /* [njoint_row] active row of each joint row, or PM_NONE (redundant) */
    int *slot_normal;  /* [nslot] active row, or PM_NONE */
    int *slot_tangent; /* [nslot] */
    int *grip_row;     /* [ngrip] active row where it holds, or PM_NONE */
    double *grip_load; /* [ngrip] friction that goes with the load of its joint, N or N m */
    int *slot_held;    /* [nslot][PM_JOINT_CONSTRAINTS] of a captured pair, or PM_NONE */
    int64_t row_set;   /* counts the sets of rows */
    int rows_here; /* the last projection, or building, has left the frame where the rows were evaluated */
    struct pm_solve_cache *recall;
    int nredundant;
    int asymmetric; /* some contact slides: H differs from G */
    /* saddle.c */
    double *schur;    /* [nrow][nrow] */
    int *pivot;       /* [nrow] */
    int *first_row;   /* [nbody] scratch */
    int *joint_order; /* [njoint] in which their rows stand (row_order.h) */
    int *body_place;  /* [nbody] scratch of it */
    double *rhs;      /* [nrow] */
    double *basis;    /* [nq + 1][nq] orthonormal rows */
    int *basis_range; /* [nq + 1][2] coordinates between which each is not zero */
    pm_frame frame;
    /* the last jump */
    double *joint_impulse;      /* [njoint_row] */
    double *slot_impulse;       /* [2 nslot] normal, tangential; of a captured pair x, y */
    double *force_energy_start; /* [nforce] energy of springs at the start */
    double *slot_direction;     /* [nslot][4] normal x, y, tangent x, y on the first partner at the jump */
    double lost;                /* kinetic energy, J */
    double *impulse;            /* [nq] applied by the actions of an event */
    /* ledger */
    double energy_start, energy_lost, energy_scale, momentum_scale, constraint_worst;
    double momentum_start[PM_LEDGER];
    int64_t count[PM_COUNT_COLUMNS];
    /* route */
    const struct pm_route_ops *route; /* of the present phase */
    int kinematic;                    /* the run needs no accelerations (plan.h) */
    int rule, price;                  /* why it was chosen (plan.c); cost of the dearest so far */
    double evidence;                  /* worst relative disagreement that the path route found */
    struct pm_tree *tree;
    struct pm_path *path;
    struct pm_repeat *leg;
    int lap;       /* the path may have closed at the end of the step */
    int path_left; /* the path route has given up in this case */
    int singular;  /* the route ida has come near a singular position: see plan.c */
    struct pm_uniform *uniform;
    struct pm_rk *rk;
    struct pm_ida *ida;
    double step_begin,
        step_end;       /* the last accepted step, by its progress coordinate: state is at step_end */
    double sampled_end; /* where the step ended when it was sampled */
    const struct pm_chebyshev_nodes *nodes; /* where the step is sampled */
    int turns;                              /* the motion turns back at the end of the step */
    double *turn;                           /* [nq] the velocities with which it does, at the scene's speed */
    struct pm_event_set *event;
    struct pm_ask_set *ask;
    struct pm_watched_samples *readings;
    struct pm_hinge_bounds *hang; /* [nbody + 1] where each body can be (gap_bounds.h); last: the ground */
    int unreached;                /* contacts that can never close */
    struct pm_find *find;         /* NULL where nothing is sought */
    struct pm_accuracy *error;
    struct pm_fixed_bodies *still;
    struct pm_perturbation *nudge; /* NULL where the scene has none */
    pm_where where;
    pm_slot *slot_before;         /* [nslot] modes when the instant began */
    int32_t *grip_before;         /* [ngrip] likewise */
    unsigned char *slot_released; /* [nslot] let go at this instant: not closed again at it */
    /* scratch for start, jump, mode */
    double *scratch; /* [8 (nq + nrow)] */
    double *out;     /* [nout] of the case */
    int32_t *reason; /* [nask] */
    double *audit;   /* [PM_AUDITS] */
    /* trace: NULL in a batch */
    struct pm_history *trace;
    struct pm_phase_report *phases; /* likewise */
    void *block;                    /* owns the arrays above */
} pm_workspace;

/* build.c */
int pm_model_create(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant,
                    int64_t nparam, pm_model **model, pm_where *where);
void pm_model_free(pm_model *model);
/* Something has a prescribed motion. */
int pm_model_is_driven(const pm_model *model);

/* workspace.c */
int pm_workspace_create(const pm_model *model, pm_workspace **workspace);
void pm_workspace_free(pm_workspace *w);
int pm_state_create(const pm_model *model, pm_state *state);
void pm_state_free(pm_state *state);
void pm_state_copy(pm_state *to, const pm_state *from);
int pm_fail(pm_workspace *w, int status, int table, int row, double value, double bound);

#endif
