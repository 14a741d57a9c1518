/* force.h - forces: weight, springs, dampers, applied forces and couples, friction of joints; one table of kinds. */
#ifndef PM_FORCE_H
#define PM_FORCE_H

#include "state/workspace.h"

/* The action of force i: `force` on its first partner at `at` (the opposite at `at_b` on body_b), and a couple. */
typedef struct pm_action {
    int body_a, body_b; /* nbody: the ground */
    double at_a[2], at_b[2], force[2], couple;
    double stretch,
        rate;      /* of springs and dampers: length - free length (or angle), and d/dt of the length */
    double power;  /* on the bodies, W */
    double energy; /* stored */
} pm_action;

/* What a number of a force is. */
enum pm_force_number { PM_FORCE_NO_NUMBER = 0, PM_FORCE_ANY = 1, PM_FORCE_NOT_NEGATIVE = 2 };

struct pm_constant_motion;

/* One kind.  `place` says what the frame alone tells of an action: bodies, points, stretch and rate, the direction of a force
 * along a line (NULL: nothing); `law` completes it.  `steady`: its generalised forces stay the same along a motion with constant
 * accelerations (constant_motion.h); NULL: they never do. */
typedef struct pm_force_ops {
    int a, b;      /* the tables of its partners */
    int number[2]; /* enum pm_force_number of PM_FORCE_VALUE_1 and _2 */
    int programs;  /* 0, 1 or 2 */
    int stores;    /* energy, by place alone: the ledger has its potential instead of its work */
    void (*place)(const pm_frame *frame, const int32_t *e, pm_action *x);
    void (*law)(pm_workspace *w, const int32_t *e, pm_action *x);
    int (*steady)(const pm_frame *frame, const int32_t *e, const struct pm_constant_motion *x);
} pm_force_ops;

const pm_force_ops *pm_force_kind(int kind);
const pm_force_ops *pm_force_of(const pm_model *m, int force);
/* Programs that a row of the table refers to: those of its law, or the side of a one-sided spring. */
int pm_force_programs(const int32_t *e);

/* What the frame alone tells of force i: its stretch and rate are known before any force is. */
pm_action pm_force_place(const pm_frame *frame, int i);
pm_action pm_force_action(pm_workspace *w, int i);
/* A one-sided spring that does not act, with this stretch. */
int pm_force_is_slack(pm_workspace *w, const int32_t *e, double stretch);
/* Fills frame.f (all applied forces on q, weight included) and frame.power. */
void pm_force_all(pm_workspace *w);
double pm_force_potential(pm_workspace *w);
/* All forces of the scene stay the same along the curve: in a plane that turns none does. */
int pm_force_all_steady(const pm_frame *frame, const pm_state *state, const struct pm_constant_motion *x);

#endif
