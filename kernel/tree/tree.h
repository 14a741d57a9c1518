/* tree.h - explicit coordinates of a phase: bodies placed one after the other, outward from the ground.
 *
 * Many active constraints can be solved body by body: a pin leaves its body an angle, a weld nothing, a slider that keeps
 * the direction a length, rolling an angle, a link its own direction and the angle of a body that rotates.  What closes a loop
 * stays as a loop constraint. */
#ifndef PM_TREE_H
#define PM_TREE_H

#include "numerics/elimination.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

typedef struct pm_tree_node pm_tree_node;

/* Kinds of coordinates: x or along a line, y, the angle of a body, the direction of a link. */
enum { PM_TREE_LENGTH = 0, PM_TREE_ANGLE = 2, PM_TREE_DIRECTION = 3 };
enum { PM_TREE_ARM = 6 }; /* numbers that give the levers of the reactions on a body */

/* What stays the same in the equations of a phase, and the directions and rates of a solve: see tree_augmented.c. */
typedef struct pm_tree_augmented {
    int on, most;
    int forced; /* there are other forces than weights */
    int shifts; /* some e_k is not zero */
    int *owner; /* [n] the body whose direction, or whose link's, it is, or PM_NONE: it rotates nothing */
    double *same, *cross, *level; /* [n][n] C, S, T of coordinates i >= k that move one body */
    double *lower, *upper;        /* [n][n][2] P, Q */
    double *fixed;                /* [n][2] e_k */
    double *weight;               /* [n][2] of e_k alone */
    double *arm;                  /* [2] for each entry of moved_by: d_bk */
    double *direction, *square;   /* [n][2] cosine and sine; [n] ydot^2 */
} pm_tree_augmented;

/* Loop constraints on the coordinates of the tree: entry[nloop][n], zero but between low[nloop] and high[nloop]. */
typedef struct pm_loops {
    double *entry;
    int *low, *high;
} pm_loops;

/* Coordinates in two parts: the dependent ones follow from the independent ones through the loop constraints
 * (tree_partition.c). */
typedef struct pm_tree_part {
    int few;       /* coordinates are partitioned */
    int *column;   /* [nq] the dependent coordinates, nloop of them, then the independent ones */
    double open;   /* m, what pm_tree_close has left of loops at the worst place since this was set to 0 */
    double known;  /* of that, what its user knows already */
    int *position; /* [nq] of each coordinate in column */
    int *left, *bottom, *right; /* [nconstraint] where J_v may differ from zero: tree_band.c, dense.h */
    double *jacobian;           /* [nconstraint][n] of the loop constraints, where pm_tree_accelerate was */
    double *motion;             /* [few][nq] velocities at a unit rate of each independent coordinate */
    double independence;        /* least square of what a loop constraint adds to those before it */
    double steepest;            /* rate of a dependent coordinate, lengths by the scene's size */
    double least_regular,
        most_regular; /* least pivot of J_v over its greatest, 0 in a singular position: range since
                                           pm_tree_forget_regular */
} pm_tree_part;

/* ---- trees of a few coordinates (tree_small.c) ---- */
#define PM_TREE_SMALL_MOST 4 /* coordinates: each number of them has code of its own */

/* a cos y + b sin y */
typedef struct pm_tree_small_wave {
    double a, b;
} pm_tree_small_wave;

/* A loop constraint  g = constant + sum_k (shift_k y_k + wave_k), and its Jacobian's square in the metric of M^-1 if
 * nothing held its bodies: with the levers of its own marks. */
typedef struct pm_tree_small_loop {
    double constant;
    double shift[PM_TREE_SMALL_MOST];
    pm_tree_small_wave wave[PM_TREE_SMALL_MOST];
    double square;
    int rotates[2]; /* the coordinates that rotate its bodies, or PM_NONE */
    pm_tree_small_wave lever[2];
    double inverse_inertia[2];
} pm_tree_small_loop;

typedef struct pm_tree_small {
    int on, n, nloop;
    /* coordinates i > k: see tree_augmented.c */
    double same[PM_TREE_SMALL_MOST][PM_TREE_SMALL_MOST], cross[PM_TREE_SMALL_MOST][PM_TREE_SMALL_MOST],
        level[PM_TREE_SMALL_MOST][PM_TREE_SMALL_MOST];
    int shifts;
    pm_tree_small_wave fixed[PM_TREE_SMALL_MOST][PM_TREE_SMALL_MOST]; /* e_i . R_k d_k, summed */
    double weight[PM_TREE_SMALL_MOST];
    pm_tree_small_wave rotated_weight[PM_TREE_SMALL_MOST];
    int owner[PM_TREE_SMALL_MOST];      /* the body whose direction it is, or PM_NONE */
    double rotates[PM_TREE_SMALL_MOST]; /* 1, or 0 where it rotates nothing */
    pm_tree_small_loop loop[PM_TREE_SMALL_MOST - 1];
    /* where directions were computed last */
    double y[PM_TREE_SMALL_MOST], cosine[PM_TREE_SMALL_MOST], sine[PM_TREE_SMALL_MOST];
} pm_tree_small;

typedef struct pm_tree {
    const pm_model *model;
    pm_constraint *constraint; /* the active constraints */
    int nfixed;                /* the first nodes are fixed bodies */
    int n;                     /* coordinates */
    int nloop;                 /* active constraints that are not solved */
    int *loop;                 /* [nconstraint] their places in w->active.constraint */
    int *kind;          /* [nq] of each coordinate: PM_TREE_LENGTH, or one more for y; ANGLE, DIRECTION */
    pm_tree_node *node; /* [nbody] in the order of placing */
    int *from, *to;     /* [nconstraint] of each loop: the coordinates that L^-1 J^T has, from .. to - 1 */
    int *first_loop;    /* [nconstraint] the first loop constraint that shares some of them */
    int whole; /* accelerations come cheaper from all constraints than from the coordinates (saddle.h) */
    unsigned char *used; /* [nconstraint] */
    int *placed;         /* [nbody] 1 + index of its node */
    int *weight, *top;   /* [nbody] coordinates of a node and of all that it carries; scratch */
    pm_elimination elimination;
    int *moved_by;      /* the coordinates that move each body: node->list, node->nlist */
    int *first_coupled; /* [nq] the first coordinate to which the mass matrix couples each */
    double *influence;  /* [3] for each entry of moved_by: velocity of the body at a unit rate */
    double *jacobian;   /* [nconstraint][n] of the loop constraints */
    double *residual;   /* [2 nconstraint] */
    double *mass;       /* [n][n] lower triangle of B^T M B, then its factor */
    double *reduced; /* [nconstraint][n] L^-1 of each row of the Jacobian, L the factor of the mass matrix */
    double *schur;   /* [nconstraint][nconstraint] */
    double *force, *bias, *rate, *wrench; /* [nq] */
    double *q, *v;                        /* [nq] where pm_tree_look looks */
    int *pivot;                           /* [nq + nconstraint] */
    pm_tree_augmented augmented;
    pm_tree_part part;
    pm_tree_small small;
} pm_tree;

int pm_tree_create(pm_workspace *w);
/* From the active constraints; called when a phase begins. */
void pm_tree_build(pm_workspace *w);
int pm_tree_is_angle(const pm_tree *t, int coordinate);
/* Its natural size: 1 rad, or the length of the scene. */
static inline double pm_tree_scale(const pm_tree *t, const pm_numbers *numbers, int coordinate)
{
    return pm_tree_is_angle(t, coordinate) ? 1 : numbers->size;
}
void pm_tree_forget_regular(pm_tree *t);
/* Fails: loop constraint number `loop` depends on those before it. */
int pm_tree_singular_loop(pm_workspace *w, int loop);

/* Coordinates y[n] of a configuration q[nq] that meets the solved constraints (the frame looks at it); and back. */
void pm_tree_read(const pm_tree *t, const pm_frame *frame, double *y);
void pm_tree_place(const pm_tree *t, pm_frame *frame, const pm_memory *memory, const double *y, double *q);
/* All that follows is at the pose where pm_tree_read, pm_tree_place or pm_tree_look has looked last. */
/* Rates ydot[n] of velocities that meet the solved constraints. */
void pm_tree_read_rates(const pm_tree *t, const double *v, double *ydot);
/* The same from the poses of the frame, which meet the solved constraints; no coordinates are wanted. */
void pm_tree_marks(const pm_tree *t, const pm_frame *frame);
/* The frame looks at coordinates y with rates ydot: positions and velocities are in t->q, t->v. */
void pm_tree_look(pm_workspace *w, double t, const double *y, const double *ydot, const double *z);
/* Velocities v[nq] from rates ydot[n]. */
void pm_tree_spread(const pm_tree *t, const double *ydot, double *v);
/* At the frame's velocities: accelerations at yddot = 0. */
void pm_tree_bias(const pm_tree *t, const pm_frame *frame, double *a);
/* The first and the last coordinate that move a body of the constraint; n and -1 if none does. */
void pm_tree_loop_ends(const pm_tree *t, const pm_constraint *c, int *low, int *high);
void pm_tree_evaluate_loops(const pm_tree *t, const pm_frame *frame);
/* The loop constraints' Jacobian on the coordinates, [nloop][n]; the constraints are evaluated. */
void pm_tree_loops(const pm_tree *t, const pm_frame *frame, const pm_loops *x);
/* Anything may be in x. */
void pm_tree_loops_unknown(const pm_tree *t, const pm_loops *x);

/* Once a phase, where the frame looks and pm_tree_read has been: sums for faster solves, where the tree allows. */
void pm_tree_sum_up(pm_workspace *w);
/* After pm_tree_look: accelerations yddot[n] of the coordinates. */
int pm_tree_accelerate(pm_workspace *w, double *yddot);
/* The same at (t, y, ydot), which the frame need not look at. */
int pm_tree_accelerate_at(pm_workspace *w, double time, const double *y, const double *ydot, const double *z,
                          double *yddot);
/* After pm_tree_look and pm_tree_accelerate: forces, accelerations of the bodies and reactions in the frame, which is
 * DYNAMIC then (the constraints are not evaluated). */
void pm_tree_tell(pm_workspace *w, const double *yddot);
/* Reactions alone, with forces and accelerations in the frame. */
void pm_tree_react(pm_workspace *w);
/* The same once tree->wrench holds M a - f: inward along an open tree, by arm[nbody][PM_TREE_ARM], or (NULL) by the levers
 * that the nodes hold. */
void pm_tree_react_inward(pm_workspace *w, const double *arm);

/* One freedom, n = nloop + 1: coordinate `held` is the independent one. */
void pm_tree_hold(pm_tree *t, int held);
/* Few freedoms: chooses the coordinates that the loop constraints determine best, at the pose of the frame, unless they
 * are singular there; t->few says whether there is a choice. */
void pm_tree_partition(const pm_frame *frame, pm_tree *t);
/* The choice is a bad one where pm_tree_accelerate was last. */
int pm_tree_is_steep(const pm_tree *tree);
/* Not partitioned, and the loop constraints nearly depended on each other, or are so many that a partition is cheaper. */
int pm_tree_is_flat(const pm_tree *t);
/* Meets the loop constraints by Newton's method with the independent coordinates kept.  Leaves q, the poses of the frame,
 * and the Jacobian of the loop constraints there.  PM_SINGULAR or PM_ASSEMBLY if it does not converge. */
int pm_tree_close(pm_workspace *w, double *y, double *q, const pm_loops *loops);
/* Rates of all coordinates at a unit rate of the first independent one, by that Jacobian; PM_SINGULAR if it does not
 * determine them. */
int pm_tree_slope(pm_workspace *w, const pm_loops *loops, double *slope);
/* Like pm_tree_look at coordinates and rates of which the dependent ones are made to meet the loop constraints. */
int pm_tree_settle(pm_workspace *w, double t, double *y, double *ydot, const double *z);
/* Meets them by the least corrections in the metric of M, of coordinates and rates; the frame looks there. */
int pm_tree_project(pm_workspace *w, double t, double *y, double *ydot, const double *z);

/* ---- small trees: accelerations from coordinates and rates alone ---- */
/* Once a phase, after pm_tree_sum_up, where the frame looks and the loop constraints are evaluated. */
void pm_tree_small_sum_up(pm_workspace *w);
/* Whether the functions below may be called. */
int pm_tree_small_applies(const pm_workspace *w);
/* Directions are computed at y; near it they are rotated on from there. */
void pm_tree_small_refer(const pm_frame *frame, pm_tree *tree, const double *y);
/* Of y[2 n], coordinates and their rates: rates and accelerations.  The frame stays where it is. */
int pm_tree_small_derivative(pm_workspace *w, const double *y, double *rate);
/* pm_tree_project without the last look. */
int pm_tree_small_project(pm_workspace *w, double *y, double *ydot);

/* ---- for the tree's own files ---- */
/* Directions and rates of the rotating coordinates from the frame; or from coordinates and rates alone. */
void pm_tree_augmented_read(const pm_frame *frame, const pm_tree *t);
void pm_tree_augmented_set(const pm_tree *t, const double *y, const double *ydot);
/* The lower triangle of B^T M B in t->mass, and right-hand side -B^T M c + weights (unless there are other forces: then all
 * of frame.f). */
void pm_tree_augmented_equations(const pm_numbers *numbers, pm_tree *t, double *x);
/* Velocities of the bodies that loop constraints or forces need, by unit rates (t->influence), and their c (t->bias). */
void pm_tree_augmented_influence(pm_tree *t);
/*  Partitioned: accelerations; reactions of the loop constraints from t->wrench. */
int pm_tree_accelerate_few(pm_workspace *w, double *yddot);
void pm_tree_react_loops(pm_frame *frame, pm_tree *t);
/*  Columns of all bodies' velocities. */
void pm_tree_influence(const pm_tree *t);
/* Accelerations of the bodies from those of the coordinates, and back; velocities are in the frame. */
void pm_tree_spread_accelerations(const pm_tree *t, const pm_frame *frame, const double *yddot, double *a);
void pm_tree_read_accelerations(const pm_tree *t, const pm_frame *frame, const double *a, double *yddot);
/* Accelerations come cheaper from all constraints than from the coordinates; the tree is built (tree_cost.c). */
int pm_tree_is_whole(const pm_workspace *w);
/* After a choice of t->column: orders it, and finds where J_v may differ from zero. */
void pm_tree_arrange(pm_tree *t);
/* The factors of J_v, from the loop constraints' Jacobian of which only what moves a constraint, and the independent
 * coordinates, count; J_v^-1 x and J_v^-T x in place. */
int pm_tree_factor_dependent(pm_workspace *w, const double *jacobian);
void pm_tree_solve_dependent(const pm_tree *t, double *x);
void pm_tree_solve_dependent_transposed(const pm_tree *t, double *x);
/* Numbers the coordinates of all placed bodies, and lists what moves them and the loop constraints (tree_order.c). */
void pm_tree_order(const pm_active_set *active, pm_tree *t);
/* Zeros what of a loop constraint's Jacobian counts. */
void pm_tree_loop_zero(const pm_tree *t, const pm_constraint *c, double *on_coordinates);
/* Adds a constraint's Jacobian on the coordinates. */
void pm_tree_loop_add(const pm_tree *t, const pm_constraint *c, double *on_coordinates);

#endif
