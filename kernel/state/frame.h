/* frame.h - what a state says of bodies and their points: positions, velocities, masses, momenta. */
#ifndef PM_FRAME_H
#define PM_FRAME_H

#include <string.h>

#include "numerics/lanes.h"
#include "state/arena.h"
#include "state/numbers.h"
#include "state/patience.h"
#include "state/state.h"

/* A stretch of time between two instants where programs of forces or drives switch (events/time_course.h). */
typedef struct pm_side {
    double from, to; /* s */
} pm_side;

/* An angle, its cosine and its sine. */
typedef struct pm_rotation {
    double angle, cosine, sine;
} pm_rotation;
enum { PM_ROTATIONS_OF_BODY = 16 }; /* for each body at least so many are kept */

/* A state looked at: positions of marks, forces, accelerations, reactions; filled as far as `level` says. */
typedef struct pm_frame {
    const pm_model *model;
    const pm_numbers *numbers; /* of the case */
    pm_patience *patience;     /* likewise: long searches ask it whether to go on */
    double t;
    pm_side side; /* programs of forces and drives are taken as they are within it, at its ends too */
    double
        time_off; /* s: what a coarse run adds to the time of forces, in each step another (events/time_course.h) */
    const double *q, *v, *z;
    const pm_memory *memory;
    int level;
    double *pose;          /* [nbody + 1][5]: x, y, angle, cos, sin; last: the ground */
    double *velocity;      /* [nbody + 1][3]; last: zero */
    pm_rotation *rotation; /* [2^(64 - shift)] angles that were looked at last (pm_frame_rotation) */
    int rotation_shift;
    double *f;              /* [nq] applied forces */
    double *power;          /* [nforce] of forces without potential */
    double *a;              /* [nq] accelerations */
    double *lambda;         /* [nconstraint] reactions of the active constraints */
    struct pm_modes *modes; /* of small motion (state/modes.h); NULL where nothing asks for them */
} pm_frame;

/* The time, s, at which programs of forces and drives are run. */
static inline double pm_frame_side_time(const pm_frame *frame, double t)
{
    return t < frame->side.from ? frame->side.from : t > frame->side.to ? frame->side.to : t;
}

/* A point of a body in the frame: r from the body's mass centre, p in the scene, v its velocity. */
typedef struct pm_point {
    int body; /* nbody: the ground */
    double r[2], p[2], v[2];
} pm_point;

/* Cosine and sine: the same angles are asked for again and again, around an event and where bodies rotate together. */
const pm_rotation *pm_frame_rotation_found(pm_rotation *x, double angle);
static inline const pm_rotation *pm_frame_rotation(const pm_frame *frame, double angle)
{
    uint64_t bits;
    memcpy(&bits, &angle, sizeof bits);
    pm_rotation *x = frame->rotation + (bits * 0x9E3779B97F4A7C15u >> frame->rotation_shift);
    return x->angle == angle ? x : pm_frame_rotation_found(x, angle);
}
/* Their memory. */
int pm_frame_rotations_create(pm_frame *frame, pm_arena *memory);

/* Looks at (t, q, v, z): poses and velocities of all bodies; level KINEMATIC. */
void pm_frame_look(pm_frame *frame, double t, const double *q, const double *v, const double *z,
                   const pm_memory *memory);
void pm_frame_look_state(pm_frame *frame, const pm_state *s);
/* The same with q and v in the place of those of s, where the poses are there already: the tree has just placed the bodies
 * at q. */
void pm_frame_look_placed(pm_frame *frame, const pm_state *s, const double *q, const double *v);

/* Poses [nbody][5] that are known. */
static inline void pm_frame_take_poses(pm_frame *frame, const double *pose)
{
    double *to = frame->pose;
    for (const double *end = pose + 5 * frame->model->nbody; pose < end; pose += 5, to += 5) {
        pm_lanes_store_three(to, pm_lanes_load(pose), pose[2]);
        pm_lanes_store(to + 3, pm_lanes_load(pose + 3));
    }
}

/* Looks at s, whose poses [nbody][5] are known, and whose velocities are `rate` times a direction [nq]: all in one pass, for
 * routes that look at many places.  q and v of s become those. */
void pm_frame_look_along(pm_frame *frame, pm_state *s, const pm_memory *memory, const double *pose,
                         double rate, const double *direction);

/* A mark at body axes (x, y) of `body` (nbody: the ground).  Here, so that nothing is worked out that nobody reads. */
static inline pm_point pm_frame_point(const pm_frame *frame, int body, double x, double y)
{
    const double *pose = frame->pose + 5 * body, *velocity = frame->velocity + 3 * body;
    pm_point point = {.body = body};
    point.r[0] = pose[3] * x - pose[4] * y;
    point.r[1] = pose[4] * x + pose[3] * y;
    point.p[0] = pose[0] + point.r[0];
    point.p[1] = pose[1] + point.r[1];
    point.v[0] = velocity[0] - velocity[2] * point.r[1];
    point.v[1] = velocity[1] + velocity[2] * point.r[0];
    return point;
}
/* Point `index` of the point table. */
pm_point pm_frame_point_of(const pm_frame *frame, int index);
/* Acceleration of a point; the frame must be DYNAMIC. */
void pm_frame_acceleration(const pm_frame *frame, const pm_point *p, double a[2]);

/* Kinetic energy and momenta (about the origin) of body i, or of all with PM_NONE. */
double pm_frame_kinetic(const pm_frame *frame, int i);
void pm_frame_momentum(const pm_frame *frame, int i, double momentum[3]);
double pm_frame_inertia(const pm_frame *frame, int i);
/* kg, of all bodies. */
double pm_frame_total_mass(const pm_frame *frame);
/* Potential energy of weight (zero at the origin). */
double pm_frame_weight_energy(const pm_frame *frame);

/* Ground gets the index behind the bodies. */
static inline int pm_model_body_index(const pm_model *m, int body)
{
    return body == PM_GROUND ? m->nbody : body;
}

#endif
