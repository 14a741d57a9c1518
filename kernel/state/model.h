/* model.h - the structure of a scene: its tables, their sizes, and what follows from them alone.
 *
 * A model holds no number of any case.  It is built once (scene/build.h), never changes, and all threads share it. */
#ifndef PM_MODEL_H
#define PM_MODEL_H

#include <stddef.h>
#include <stdint.h>

#include "planemotion.h"
#include "state/arena.h"

#define PM_PATTERN_SLOTS 4     /* members of one pattern that may be closed at once */
#define PM_JOINT_CONSTRAINTS 3 /* most constraints of one joint */
#define PM_LEDGER 3            /* impulses of the outer world: x, y, moment about the origin */

struct pm_program_fold;

/* What the programs of the scene read, and what the planner may skip because of it (scene/). */
typedef struct pm_model_programs {
    unsigned char *level;  /* [nprogram] enum pm_level that its measures need */
    unsigned char *class;  /* [nprogram] enum pm_program_class */
    unsigned char *energy; /* [nprogram] enum pm_program_energy */
    int forces_by_place;   /* all forces depend on the configuration alone */
    int cacheable; /* and so do accelerations on given constraints, but for the velocities: nothing drives, holds by load, acts */
    int use_time;  /* some force or trigger depends on t: rest does not last, or is waited out */
    int read_time; /* some program reads the time */
    int sample_time;              /* some trigger, extreme or grid does */
    int watch_counts;             /* what is watched in a step reads the count or time of an event */
    int wait_for_counts;          /* some trigger does */
    int read_impulses;            /* some measure reads the impulse of a contact as a vector */
    int integrals;                /* some ask is an integral over the time */
    struct pm_program_fold *fold; /* the programs as they are run within a case */
} pm_model_programs;

/* The tables of a model that was made without what no answer needs (scene/prune.h). */
typedef struct pm_model_prune {
    int32_t *table;               /* its own tables, or NULL */
    int32_t *original[PM_TABLES]; /* then: the caller's row of each row */
} pm_model_prune;

typedef struct pm_model {
    const int32_t *table[PM_TABLES]; /* first row of each table, in the caller's array */
    int rows[PM_TABLES];
    const double *constant; /* [nconstant] of the programs, SI */
    int nconstant;
    int nparam;
    int nbody, nq; /* nq = 3 nbody: x, y, angle of each mass centre */
    int nvalue, nask, nout;
    int nelement;          /* joints, contacts and forces */
    int njoint_constraint; /* constraints of all joints */
    int nslot;       /* places for closed contacts: 1 per contact, PM_PATTERN_SLOTS per pattern or curve */
    int nedge;       /* contacts with edges that end */
    int nmemory;     /* joints and slots: what their no-slip and driven constraints and strands remember */
    int nkept;       /* slots of contacts that capture */
    int nconstraint; /* most active constraints: njoint_constraint + 2 nslot + nkept */
    int nfriction;   /* frictions of joints */
    int nteeth;      /* joints by teeth */
    int friction_memory;      /* first of their memories */
    int *friction_force;      /* [nfriction] row of each in the table of forces */
    int nz;                   /* running integrals: forces' work, paths, then PM_LEDGER audit entries */
    int nz_work;              /* of these the first are works of forces */
    int nz_controlled;        /* of these the first are under error control */
    int spin_z, spin_angle_z; /* running integrals of the spin's momentum and rate, or PM_NONE */
    int acts;                 /* some event does something, or not whenever its triggers fire */
    int *contact_slot;        /* [ncontact + 1] first slot; last: nslot */
    int *contact_of_slot;     /* [nslot] */
    int *contact_kept;        /* [ncontact] first kept place, or PM_NONE */
    int *joint_constraint;    /* [njoint] first constraint among those of the joints */
    int *joint_memory;        /* [njoint] first, or PM_NONE */
    int *force_z;             /* [nforce] running integral of its work, or PM_NONE: it has a potential */
    int *path_z;              /* [nmeasure] running integral of a path measure, or PM_NONE */
    int *path;                /* [npath] the measures of paths: their integrals follow the works */
    int npath;
    pm_arena memory; /* owns the arrays above, and of `programs` the first three */
    pm_model_programs programs;
    pm_model_prune prune;
} pm_model;

/* What must be known of a state before a program can be run on it. */
enum pm_level { PM_LEVEL_NONE = 0, PM_LEVEL_KINEMATIC = 1, PM_LEVEL_DYNAMIC = 2 };

static inline const int32_t *pm_model_row(const pm_model *m, int table, int row, int columns)
{
    return m->table[table] + (ptrdiff_t)row * columns;
}
#define PM_BODY_ROW(m, i) pm_model_row(m, PM_TABLE_BODY, i, PM_BODY_COLUMNS)
#define PM_POINT_ROW(m, i) pm_model_row(m, PM_TABLE_POINT, i, PM_POINT_COLUMNS)
#define PM_LINE_ROW(m, i) pm_model_row(m, PM_TABLE_LINE, i, PM_LINE_COLUMNS)
#define PM_CIRCLE_ROW(m, i) pm_model_row(m, PM_TABLE_CIRCLE, i, PM_CIRCLE_COLUMNS)
#define PM_PATTERN_ROW(m, i) pm_model_row(m, PM_TABLE_PATTERN, i, PM_PATTERN_COLUMNS)
#define PM_CURVE_ROW(m, i) pm_model_row(m, PM_TABLE_CURVE, i, PM_CURVE_COLUMNS)
#define PM_JOINT_ROW(m, i) pm_model_row(m, PM_TABLE_JOINT, i, PM_JOINT_COLUMNS)
#define PM_CONTACT_ROW(m, i) pm_model_row(m, PM_TABLE_CONTACT, i, PM_CONTACT_COLUMNS)
#define PM_FORCE_ROW(m, i) pm_model_row(m, PM_TABLE_FORCE, i, PM_FORCE_COLUMNS)
#define PM_MEASURE_ROW(m, i) pm_model_row(m, PM_TABLE_MEASURE, i, PM_MEASURE_COLUMNS)
#define PM_START_ROW(m, i) pm_model_row(m, PM_TABLE_START, i, PM_START_COLUMNS)
#define PM_TRIGGER_ROW(m, i) pm_model_row(m, PM_TABLE_TRIGGER, i, PM_TRIGGER_COLUMNS)
#define PM_UNTIL_ROW(m, i) pm_model_row(m, PM_TABLE_UNTIL, i, PM_UNTIL_COLUMNS)
#define PM_ASK_ROW(m, i) pm_model_row(m, PM_TABLE_ASK, i, PM_ASK_COLUMNS)
#define PM_FIND_ROW(m, i) pm_model_row(m, PM_TABLE_FIND, i, PM_FIND_COLUMNS)
#define PM_VARY_ROW(m, i) pm_model_row(m, PM_TABLE_VARY, i, PM_VARY_COLUMNS)
#define PM_SECOND_ROW(m, i) pm_model_row(m, PM_TABLE_SECOND, i, PM_SECOND_COLUMNS)
#define PM_CONDITION_ROW(m, i) pm_model_row(m, PM_TABLE_CONDITION, i, PM_CONDITION_COLUMNS)
#define PM_READING_ROW(m, i) pm_model_row(m, PM_TABLE_READING, i, PM_READING_COLUMNS)
#define PM_EVENT_ROW(m, i) pm_model_row(m, PM_TABLE_EVENT, i, PM_EVENT_COLUMNS)
#define PM_ACTION_ROW(m, i) pm_model_row(m, PM_TABLE_ACTION, i, PM_ACTION_COLUMNS)
#define PM_SETTING(m, column) ((m)->table[PM_TABLE_SETTING][column])

/* Kinds of an ask, by its row.  It watches the whole run, and not its end or events alone; it sums over the time of the run; it
 * is the greatest or least value. */
static inline int pm_model_ask_watches(const int32_t *e)
{
    return e[PM_ASK_KIND] >= PM_ASK_MAX && e[PM_ASK_KIND] != PM_ASK_EACH;
}
static inline int pm_model_ask_is_integral(const int32_t *e) { return e[PM_ASK_KIND] >= PM_ASK_INTEGRAL; }
static inline int pm_model_ask_is_extreme(const int32_t *e)
{
    return pm_model_ask_watches(e) && !pm_model_ask_is_integral(e) && e[PM_ASK_KIND] != PM_ASK_GRID;
}

/* Place of a joint, contact or force among the elements. */
static inline int pm_model_element(const pm_model *m, int table, int row)
{
    const int joints = m->rows[PM_TABLE_JOINT], contacts = m->rows[PM_TABLE_CONTACT];
    return row + (table == PM_TABLE_JOINT ? 0 : table == PM_TABLE_CONTACT ? joints : joints + contacts);
}

/* The body of entry `index` of table `of`: a body itself, or a mark (a point, or what is given by one). */
static inline int pm_model_body_of(const pm_model *m, int of, int index)
{
    const int point = of == PM_TABLE_LINE      ? PM_LINE_ROW(m, index)[PM_LINE_POINT]
                      : of == PM_TABLE_CIRCLE  ? PM_CIRCLE_ROW(m, index)[PM_CIRCLE_POINT]
                      : of == PM_TABLE_PATTERN ? PM_PATTERN_ROW(m, index)[PM_PATTERN_POINT]
                      : of == PM_TABLE_CURVE   ? PM_CURVE_ROW(m, index)[PM_CURVE_POINT]
                                               : index;
    return of >= PM_TABLE_POINT && of <= PM_TABLE_CURVE ? PM_POINT_ROW(m, point)[PM_POINT_BODY] : index;
}

/* Whether some event adds or removes a joint, contact or force. */
static inline int pm_model_is_changed(const pm_model *m, int table, int row)
{
    for (int i = 0; i < m->rows[PM_TABLE_ACTION]; i++) {
        const int32_t *e = PM_ACTION_ROW(m, i);
        if (e[PM_ACTION_KIND] <= PM_ACTION_REMOVE && e[PM_ACTION_TABLE] == table && e[PM_ACTION_A] == row)
            return 1;
    }
    return 0;
}

/* Where a case fails: a row of a table (PM_NONE: nowhere in particular), and the numbers of the message. */
typedef struct pm_where {
    int table, row, member;
    double value, bound;
} pm_where;

/* PM_BAD_TABLE at that row. */
static inline int pm_bad_table(pm_where *where, int table, int row, double value, double bound)
{
    *where = (pm_where){table, row, PM_NONE, value, bound};
    return PM_BAD_TABLE;
}

#endif
