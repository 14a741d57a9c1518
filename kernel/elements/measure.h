/* measure.h - what can be read off a state: the table of measure kinds. */
#ifndef PM_MEASURE_H
#define PM_MEASURE_H

#include "elements/measure_kinds.h"
#include "state/workspace.h"

enum pm_measure_flag {
    PM_MEASURE_OR_ALL = 1,          /* of a body, or with PM_NONE of all there is */
    PM_MEASURE_OF_ALL = 2,          /* of all that there is, or of the last jump, wherever it was */
    PM_MEASURE_DYNAMIC = 4,         /* of accelerations or reactions: the frame must be PM_LEVEL_DYNAMIC */
    PM_MEASURE_STARTS_POSITION = 8, /* may be written in the start table */
    PM_MEASURE_STARTS_VELOCITY = 16
};

/* One kind: what it is of, what is known of it before it is measured (expression/program_class.h), how it is read off. */
typedef struct pm_measure_ops {
    int of;     /* the table that `a` points into; -1: none */
    int class;  /* enum pm_program_class; of a plane that turns: where no couple acts on it */
    int energy; /* enum pm_program_energy; of a vector: of its components */
    int degree; /* enum pm_program_degree, unless what it is of says otherwise (scene/program_degree.c) */
    int flags;  /* enum pm_measure_flag */
    double (*scalar)(const pm_measure_args *x);
    void (*vector)(const pm_measure_args *x, double out[2]); /* of which a part is read */
    /* Adds its derivative by positions and velocities, times `weight` (of a vector weight[2], one for each component); 0: here it
     * has none in closed form.  NULL: it has none anywhere. */
    int (*slope)(const pm_measure_args *x, const double weight[2], struct pm_slope *to);
} pm_measure_ops;

const pm_measure_ops *pm_measure_kind(int kind);
const pm_measure_ops *pm_measure_ops_of(const pm_model *m, int i);
/* enum pm_level to which the frame must be filled. */
int pm_measure_level(const pm_model *m, int i);

/* Value of measure i at the frame, which must be filled to pm_measure_level.  Not a number where it has none. */
double pm_measure(pm_workspace *w, int i);
/* The same; where it is the size of something, that with its sign (what programs read: pm_workspace.read_measure). */
double pm_measure_signed(pm_workspace *w, int i);
/* The same of a measure that is read at many places: what its row says is looked up once. */
typedef struct pm_measure_reader {
    double (*read)(const pm_measure_args *x);
    pm_measure_args of;
} pm_measure_reader;
pm_measure_reader pm_measure_reader_of(pm_workspace *w, int i);
static inline double pm_measure_read(const pm_measure_reader *x) { return x->read(&x->of); }
/* Its derivative by positions and velocities is not 0 everywhere. */
int pm_measure_moves(const pm_model *m, int i);
/* Adds `weight` times that derivative at the frame, running integrals as they are: in closed form, or where there is none by
 * differences. */
void pm_measure_slope(pm_workspace *w, int i, double weight, struct pm_slope *to);
int pm_measure_validate(const pm_model *m, pm_where *where);
/* 1 if measure i may be written in the start table at this level (its value is linear in v, or its rate is). */
int pm_measure_can_start(const pm_model *m, int i, int level);
/* Gradient of a start value with respect to v: coefficient[nq] of d(measure)/dt (POSITION) or of the measure itself
 * (VELOCITY). */
void pm_measure_start_gradient(pm_workspace *w, int i, int level, double *coefficient);

#endif
