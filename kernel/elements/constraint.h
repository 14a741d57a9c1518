/* constraint.h - scalar constraints: one table of kinds, each with residual, Jacobian, gamma and line of action. */
#ifndef PM_CONSTRAINT_H
#define PM_CONSTRAINT_H

#include <math.h>

#include "state/frame.h"
#include "state/workspace.h"

#define PM_CONSTRAINT_BODIES 3 /* most that one constraint holds */
#define PM_CONSTRAINT_COORDINATES (3 * PM_CONSTRAINT_BODIES)

/* One scalar constraint of the active set; which formula is constraint.c's table of kinds. */
struct pm_constraint {
    int kind;                              /* enum pm_constraint_kind */
    int body[PM_CONSTRAINT_BODIES];        /* body index, or nbody for the ground */
    int over;                              /* 1: of a cord over the rim of body[2]; 0: it has two bodies */
    double a[2], b[2], rim[2];             /* marks in body axes */
    double radius_a, radius_b, radius_rim; /* signed: see constraint_distance.c, constraint_strand.c */
    double turns;                          /* of a cord about its rim: full turns beyond what is drawn */
    double value;   /* length, angle, direction of a line in its body, coefficient of a rim, lever of teeth */
    double axis[2]; /* cosine and sine of that direction; of a drive: its axis of the scene */
    double sign;    /* distance constraints: which way is positive */
    double ratio;   /* ratio constraints: angle(a) - ratio angle(b) */
    double teeth[2]; /* of teeth: cosine and sine of their pressure angle */
    int flank;       /* of teeth: 1, -1, or 0: the one that is loaded now (teeth.h) */
    int memory;      /* index of the memory of its anchor, or PM_NONE */
    int curve, foot; /* of constraints on curves: which, and the memory of its foot; or PM_NONE */
    int other;       /* of two curves that touch: the first of them; else PM_NONE */
    double near[2];  /* without that memory: s of places near the feet, on `curve` and on `other` */
    int joint, slot; /* owner: one of both is PM_NONE */
    int normal; /* sliding constraints and friction: index of the active constraint of its normal, else PM_NONE */
    double slide; /* normal constraint of a sliding contact: -mu sgn(slip) rides on it; else 0 */
    double j[PM_CONSTRAINT_COORDINATES]; /* Jacobian on (x, y, angle) of its bodies, at the frame's state */
    double h[PM_CONSTRAINT_COORDINATES]; /* direction of the force: j, but for sliding contacts */
    double g;                            /* residual, m or rad */
    int drive;                           /* program of what is prescribed, or PM_NONE */
    int prescribes;                      /* enum pm_prescribes */
    double rate;                         /* prescribed at the frame: G v = rate */
    double gamma;                        /* -(dG/dt) v */
};

enum pm_constraint_kind {
    PM_CONSTRAINT_POINT_X = 0,
    PM_CONSTRAINT_POINT_Y = 1,
    PM_CONSTRAINT_LINE_NORMAL = 2,
    PM_CONSTRAINT_LINE_TANGENT = 3,
    PM_CONSTRAINT_DISTANCE = 4,
    PM_CONSTRAINT_CIRCLE_TANGENT = 5,
    PM_CONSTRAINT_ANGLE = 6,
    PM_CONSTRAINT_STRAND = 7,
    PM_CONSTRAINT_DRIVE = 8,
    PM_CONSTRAINT_RATIO = 9,
    PM_CONSTRAINT_CURVE_NORMAL = 10,
    PM_CONSTRAINT_CURVE_TANGENT = 11,
    PM_CONSTRAINT_TEETH = 12,
    PM_CONSTRAINT_RACK = 13,
    PM_CONSTRAINT_PAIR_NORMAL = 14,
    PM_CONSTRAINT_PAIR_TANGENT = 15,
    PM_CONSTRAINT_CORD = 16,
    PM_CONSTRAINT_CORD_SLIP = 17,
    PM_CONSTRAINT_TEETH_SLIP = 18,
    PM_CONSTRAINT_BELT = 19,
    PM_CONSTRAINT_KINDS = 20
};

/* What the program of a driven constraint gives: its rate, or that which the rate is of, a length or an angle. */
enum pm_prescribes { PM_PRESCRIBES_RATE = 0, PM_PRESCRIBES_PLACE = 1 };

/* Where a unit reaction acts on body[0], from geometry alone: the audit uses it instead of the Jacobian.  On body[1] the
 * opposite force acts in the same line, and couple[1], which is the opposite couple unless something else takes a share:
 * the housing of a gear box, which is the ground. */
typedef struct pm_line_of_action {
    double at[2], direction[2], couple[2];
} pm_line_of_action;

typedef struct pm_constant_motion pm_constant_motion; /* constant_motion.h */

/* Bounds over the next h seconds of a motion with constant accelerations. */
typedef struct pm_constraint_bounds {
    double bend; /* the second rate of the residual is not below it */
    double rate; /* its first rate is not beyond it, either way */
    int exact;   /* the second rate *is* bend, throughout */
} pm_constraint_bounds;

/* One kind: `evaluate` fills j, g, gamma at the frame; `gap` (NULL: no gap of this kind is watched) gives the same g, and j v with
 * the velocities of the frame where rate is not NULL; `act` gives the line of action; `remember` (no-slip constraints) sets or
 * refreshes the memory (of the anchor, else of the foot) from the frame: anchor_too = 1 closes the constraint here. `steady`:
 * the Jacobian stays the same along the curve (NULL: it never does); `bound` (constraints that are gaps): of the constraint as
 * evaluated at the frame, with the accelerations a[nq + 3]; `bend` adds its second derivatives to zeros where that is less work
 * than constraint_bend.c has with `evaluate` (NULL: it is not). */
typedef struct pm_constraint_ops {
    void (*evaluate)(const pm_frame *frame, pm_constraint *c);
    double (*gap)(const pm_frame *frame, const pm_constraint *c, double *rate);
    void (*act)(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x);
    void (*remember)(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too);
    int (*steady)(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x);
    void (*bound)(const pm_frame *frame, const pm_constraint *c, const double *a, double h,
                  pm_constraint_bounds *x);
    void (*bend)(const pm_frame *frame, const pm_constraint *c,
                 double out[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES]);
} pm_constraint_ops;

extern const pm_constraint_ops pm_constraint_point_x, pm_constraint_point_y, pm_constraint_line_normal,
    pm_constraint_line_tangent, pm_constraint_distance, pm_constraint_circle_tangent, pm_constraint_angle,
    pm_constraint_strand, pm_constraint_drive, pm_constraint_ratio, pm_constraint_curve_normal,
    pm_constraint_curve_tangent, pm_constraint_teeth, pm_constraint_rack, pm_constraint_pair_normal,
    pm_constraint_pair_tangent, pm_constraint_cord, pm_constraint_cord_slip, pm_constraint_teeth_slip,
    pm_constraint_belt;

const pm_constraint_ops *pm_constraint_kind(int kind);

/* The constraints that joint i holds, with the numbers of the case; returns how many. */
int pm_joint_constraints(const pm_frame *frame, const pm_state *state, int joint,
                         pm_constraint c[PM_JOINT_CONSTRAINTS]);
/* The same, whether the joint is there or not, and whether it or its friction alone holds them. */
int pm_joint_constraints_of_any(const pm_frame *frame, int joint, pm_constraint c[PM_JOINT_CONSTRAINTS]);
/* The normal constraints of all contacts, with the numbers of the case: pm_contact_constraint_normal copies them. */
void pm_contact_compose(const pm_frame *frame);
/* The normal constraint alone of a contact that is closed (or may close) in `slot` with `member`. */
void pm_contact_constraint_normal(const pm_frame *frame, int contact, int slot, int member,
                                  pm_constraint *normal);
/* The same as it is read: that of the case where the member has no numbers of its own, else *own; its slot is not told. */
const pm_constraint *pm_contact_constraint_read(const pm_frame *frame, int contact, int member,
                                                pm_constraint *own);
/* Its tangential constraint, from the normal one. */
void pm_contact_constraint_tangent(const pm_frame *frame, int contact, const pm_constraint *normal,
                                   pm_constraint *tangent);
/* Both. */
void pm_contact_constraint_both(const pm_frame *frame, int contact, int slot, int member,
                                pm_constraint *normal, pm_constraint *tangent);
/* 1 where the first body of a member's constraints is that of the contact, -1 where it is the second, whose corner touches. */
double pm_contact_constraint_side(const pm_frame *frame, int contact, const pm_constraint *normal);

/* How many bodies it holds, the ground among them. */
static inline int pm_constraint_bodies(const pm_constraint *c) { return 2 + c->over; }

/* Whether its bodies act on each other and on nothing else. */
static inline int pm_constraint_is_inner(const pm_numbers *numbers, const pm_constraint *c)
{
    const unsigned char *fixed = numbers->fixed;
    return !fixed[c->body[0]] && !fixed[c->body[1]] && !(c->over && fixed[c->body[2]]) && c->ratio == 1;
}

/* Its residual is an angle. */
static inline int pm_constraint_is_angle(const pm_constraint *c)
{
    return c->kind == PM_CONSTRAINT_ANGLE || c->kind == PM_CONSTRAINT_RATIO;
}

/* j x on two bodies; x[nq]: velocities, accelerations, a direction. */
static inline double pm_constraint_pair_times(const pm_frame *frame, const int *body, const double *j,
                                              const double *x)
{
    const int ground = frame->model->nbody;
    double sum = 0;
    for (int p = 0; p < 2; p++) {
        if (body[p] == ground) continue;
        const double *y = x + 3 * body[p], *g = j + 3 * p;
        sum += g[0] * y[0] + g[1] * y[1] + g[2] * y[2];
    }
    return sum;
}
/* j x on all bodies of a constraint. */
static inline double pm_constraint_jacobian_times(const pm_frame *frame, const pm_constraint *c,
                                                  const double *j, const double *x)
{
    const double sum = pm_constraint_pair_times(frame, c->body, j, x);
    if (!c->over || c->body[2] == frame->model->nbody) return sum;
    const double *y = x + 3 * c->body[2];
    return sum + j[6] * y[0] + j[7] * y[1] + j[8] * y[2];
}
/* The same of a constraint that is evaluated. */
static inline double pm_constraint_times(const pm_frame *frame, const pm_constraint *c, const double *x)
{
    return pm_constraint_jacobian_times(frame, c, c->j, x);
}
/* j M^-1 j^T of an evaluated constraint: a reaction l moves the scene like l sqrt(this) in the metric of M. */
double pm_constraint_square(const pm_frame *frame, const pm_constraint *c);
/* What evaluated constraints are missed by, off[n], and the greatest of it: -g, or the prescribed rate less that of
 * velocities v[nq].  which[n]: places of these constraints; NULL: the first n. */
double pm_constraint_openings(const pm_constraint *c, int n, const int *which, double *off);
double pm_constraint_slips(const pm_frame *frame, const pm_constraint *c, int n, const int *which,
                           const double *v, double *off);
/* Second derivatives of a constraint by (x, y, angle) of its bodies, which are those of its Jacobian: symmetric.  The
 * frame is as it was afterwards. */
void pm_constraint_bend(pm_frame *frame, const pm_constraint *c,
                        double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES]);
/* out = bend v: how its rate changes with positions at the velocities v[nq]. */
void pm_constraint_bend_along(const pm_frame *frame, const pm_constraint *c,
                              double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES],
                              const double *v, double out[PM_CONSTRAINT_COORDINATES]);
/* That of a constraint which is linear in positions. */
void pm_constraint_straight(const pm_frame *frame, const pm_constraint *c,
                            double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES]);
/* All active constraints keep their Jacobian along the curve. */
int pm_constraint_all_steady(const pm_frame *frame, const pm_active_set *active, const pm_constant_motion *x);
/* Rate of a constraint from the geometry of its line of action (equals j v). */
double pm_constraint_rate(const pm_frame *frame, const pm_constraint *c);
/* The same relative to its prescribed rate: how a surface slips on a moving belt. */
double pm_constraint_slip(const pm_frame *frame, const pm_constraint *c);

/* The two marks of a constraint in the frame, and what all kinds share. */
typedef struct pm_marks {
    pm_point a, b;
    double d[2];    /* a - b */
    double u[2];    /* velocity of a - velocity of b */
    double quad[2]; /* relative acceleration of the marks when the coordinates do not accelerate */
    double omega_a, omega_b;
} pm_marks;
static inline pm_marks pm_constraint_marks(const pm_frame *frame, const pm_constraint *c)
{
    pm_marks x = {.a = pm_frame_point(frame, c->body[0], c->a[0], c->a[1]),
                  .b = pm_frame_point(frame, c->body[1], c->b[0], c->b[1])};
    x.omega_a = frame->velocity[3 * c->body[0] + 2];
    x.omega_b = frame->velocity[3 * c->body[1] + 2];
    for (int k = 0; k < 2; k++) {
        x.d[k] = x.a.p[k] - x.b.p[k];
        x.u[k] = x.a.v[k] - x.b.v[k];
        x.quad[k] = -x.omega_a * x.omega_a * x.a.r[k] + x.omega_b * x.omega_b * x.b.r[k];
    }
    return x;
}
/* No overflow is possible at the scale of scenes: a plain root is an eighth of hypot's price. */
static inline double pm_length(const double a[2]) { return sqrt(a[0] * a[0] + a[1] * a[1]); }
static inline double pm_dot(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }
static inline double pm_cross(const double a[2], const double b[2]) { return a[0] * b[1] - a[1] * b[0]; }

/* j = (n, r_a x n) on a, -(n, r_b x n) on b. */
static inline void pm_constraint_along(double j[6], const pm_marks *x, const double n[2], double factor)
{
    j[0] = factor * n[0];
    j[1] = factor * n[1];
    j[2] = factor * pm_cross(x->a.r, n);
    j[3] = -factor * n[0];
    j[4] = -factor * n[1];
    j[5] = -factor * pm_cross(x->b.r, n);
}

/* How far, how fast and how hard (beyond the constant accelerations of their mass centres) two marks part at most over the
 * next h seconds; `omega`, `spin`: how fast and how hard body[1] rotates. */
typedef struct pm_constraint_reach {
    double apart[2]; /* accelerations of the mass centres, relative */
    double swing;    /* of accelerations by rotation: rho sqrt(omega^4 + alpha^2), both marks */
    double distance, rate;
    double omega, spin;
} pm_constraint_reach;
pm_constraint_reach pm_constraint_reach_of(const pm_constraint *c, const pm_marks *x, const double *a,
                                           double h);

/* ---- marks: points, lines and circles of the tables, with the numbers of the case (constraint_marks.c) ---- */
/* A constraint of a kind that belongs to nothing yet. */
void pm_constraint_marks_blank(pm_constraint *c, int kind);

void pm_constraint_marks_points(const pm_frame *frame, pm_constraint *c, int a, int b);
void pm_constraint_marks_point_and_line(const pm_frame *frame, pm_constraint *c, int point, int line);
void pm_constraint_marks_circle_and_line(const pm_frame *frame, pm_constraint *c, int circle, int line);
/* Side 1: outside each other; -1: a inside b; -2: b inside a. */
void pm_constraint_marks_circles(const pm_frame *frame, pm_constraint *c, int a, int b, double side);
void pm_constraint_marks_radii(pm_constraint *c, double radius_a, double radius_b, double side);
/* Length l of a strand, m, and l l', m^2/s: it is least where that is zero. */
double pm_constraint_strand_left(const pm_frame *frame, const pm_constraint *c, double *approach);
/* Length of a steady strand, m, its rate and the rate of that: it changes as a parabola, which goes on below zero. */
void pm_constraint_strand_course(const pm_frame *frame, const pm_constraint *c,
                                 const struct pm_constant_motion *x, double course[3]);
/* A point and a curve. */
void pm_constraint_marks_curve(const pm_frame *frame, pm_constraint *c, int point, int curve);
/* A circle and a curve. */
void pm_constraint_marks_circle_and_curve(const pm_frame *frame, pm_constraint *c, int circle, int curve);
/* Two curves. */
void pm_constraint_marks_curves(const pm_frame *frame, pm_constraint *c, int first, int curve);
/* The s of the foot of a constraint on a curve. */
double pm_constraint_curve_foot(const pm_frame *frame, const pm_constraint *c);
/* Its memory, from wherever it is near: of two curves both places. */
void pm_constraint_curve_find(const pm_frame *frame, const pm_constraint *c, pm_memory *memory);
/* How far the foot of a constraint on a curve is from the nearer end of it, or of its piece, m (curve.h, curve_piece.h). */
double pm_constraint_curve_room(const pm_frame *frame, const pm_constraint *c);
/* Its memory: the foot is on the piece into which s moves `way`; what is no farther than `nothing` from a knot is on it. */
void pm_constraint_curve_go_on(const pm_frame *frame, const pm_constraint *c, double way, double nothing,
                               pm_memory *memory);
/* A strand from circle a to circle b; which way round each it goes is the sign of its radius. */
void pm_constraint_marks_strand(const pm_frame *frame, pm_constraint *c, int a, int b, double sense_a,
                                double sense_b);
/* A cord from circle a over a rim to circle b, with the senses in which it passes them. */
void pm_constraint_marks_cord(const pm_frame *frame, pm_constraint *c, const int circle[3],
                              const int32_t sense[3]);
/* Its strands, from a to the rim and from there to b: each is a constraint of its own. */
void pm_constraint_cord_strands(const pm_constraint *c, pm_constraint strand[2]);
/* What a unit reaction of it is as the tensions of the two. */
void pm_constraint_cord_tensions(const pm_constraint *c, double tension[2]);
/* The angle along which the rim is wrapped, counted on past full turns. */
double pm_constraint_cord_wrap(const pm_frame *frame, const pm_constraint *c);
/* The greatest friction of a rim over the mean tension of the cord. */
double pm_constraint_cord_grip(double coefficient, double wrap);
/* As evaluate of a strand, but for its anchor: the direction next to `reference` is left in *direction. */
void pm_constraint_strand_look(const pm_frame *frame, pm_constraint *c, double reference, double *direction);
void pm_constraint_marks_pressure(pm_constraint *c, double angle);
/* A circle and member 0 of a pattern. */
void pm_constraint_marks_pattern(const pm_frame *frame, pm_constraint *c, int circle, int of);

#endif
