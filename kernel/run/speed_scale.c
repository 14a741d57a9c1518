/* speed_scale.c - the speed that speeds of a scene are measured by, where it begins at rest: what its forces would make of its
 * size.  Joints are not solved for; what they hold moves no faster than it would without them. */
#include "run/run.h"

#include <math.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "elements/turning_plane.h"
#include "equations/case.h"
#include "numerics/lanes.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* m, how far from its mass centre joints hold a body, at the farthest. */
static double arm_of(const pm_workspace *w, int body)
{
    double most = 0;
    for (int i = 0; i < w->model->njoint_constraint; i++) {
        const pm_constraint *c = &w->numbers.of_joint[i];
        if (c->body[0] == body) most = pm_max(pm_length(c->a), most);
        if (c->body[1] == body) most = pm_max(pm_length(c->b), most);
    }
    return most;
}

/* Of coordinate i.  A small body at the end of a long arm does not turn about itself: its mass goes round where it is held. */
static double inverse_mass(const pm_workspace *w, int i)
{
    const double inverse = w->numbers.inverse_mass[i];
    if (i % 3 != 2 || w->frame.f[i] == 0) return inverse;
    const double arm = arm_of(w, i / 3), round = w->numbers.mass[i / 3] * arm * arm;
    return inverse * round > PM_SPEED_ARM ? 1 / round : inverse;
}

/* What the forces at the frame would make of the scene's size. */
static double speed_by_forces(pm_workspace *w)
{
    double fastest = 0;
    pm_force_all(w);
    for (int i = 0; i < w->model->nq; i++) {
        const double length = i % 3 == 2 ? w->numbers.size : 1;
        if (w->numbers.stand_in[i] > 0) continue;
        fastest = pm_max(sqrt(fabs(inverse_mass(w, i) * w->frame.f[i]) * length * w->numbers.size), fastest);
    }
    return fastest;
}

/* Where bodies rest in places where springs are free their forces are nothing, or rounding: what they would be as far away as the
 * scene is large tells its speed. */
static double speed_by_stiffness(pm_workspace *w)
{
    pm_state_copy(&w->probe, &w->state);
    for (int i = 0; i < w->model->nq; i++)
        w->probe.q[i] += PM_SHIFT * (i % 2 ? -1 : 1) * pm_numbers_length(&w->numbers, i);
    pm_frame_look_state(&w->frame, &w->probe);
    const double fastest = speed_by_forces(w);
    pm_frame_look_state(&w->frame, &w->state);
    return fastest;
}

/* A scene at rest has no speed yet: what its forces would make of its size is the scale. */
void pm_speed_scale(pm_workspace *w)
{
    double fastest = speed_by_forces(w);
    const int by_place = w->model->rows[PM_TABLE_FORCE] > 0 || pm_turning_plane_omega(&w->frame) != 0;
    const double shifted = by_place ? speed_by_stiffness(w) : fastest;
    if (pm_max(fastest, w->numbers.speed) <= PM_SPEED_ROUNDING * shifted) fastest = shifted / sqrt(PM_SHIFT);
    fastest = pm_max(fabs(pm_turning_plane_omega(&w->frame)) * w->numbers.size, fastest);
    if (fastest > w->numbers.speed) w->numbers.speed = fastest;
    /* nothing to speak of acts or moves: as what crosses the scene, or next to nothing of it, while the run lasts */
    const double crossing = w->numbers.size / pm_case_max_time(w->model, &w->numbers);
    if (w->numbers.speed == 0) w->numbers.speed = crossing;
    w->numbers.speed = pm_max(PM_NO_SPEED * crossing, w->numbers.speed);
}
