/* constraint_order.c - in which order the joints' constraints stand, so that the saddle-point system has a narrow envelope.
 *
 * Bodies are numbered by breadth-first levels from one that hangs at an end (Cuthill and McKee, Proc. 24th ACM National
 * Conf., 1969), joints by the later of their bodies. */
#include "equations/constraint_order.h"

#include "elements/constraint.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* The two bodies that a joint fastens; PM_GROUND for the ground. */
static void find_bodies(const pm_frame *frame, const pm_state *state, int joint, int body[2])
{
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    body[0] = body[1] = PM_GROUND;
    if (pm_joint_constraints(frame, state, joint, c) == 0) return;
    for (int p = 0; p < 2; p++)
        if (c[0].body[p] != frame->model->nbody) body[p] = c[0].body[p];
}

/* The greatest number of a joint's bodies; PM_GROUND if all are the ground. */
static int last_place(const pm_active_set *active, const int body[2])
{
    int last = PM_GROUND;
    for (int p = 0; p < 2; p++)
        if (body[p] != PM_GROUND && active->body_place[body[p]] > last) last = active->body_place[body[p]];
    return last;
}

/* Numbers the bodies from `first` on, and from the next that is left wherever the scene falls apart; the last one. */
static int number_bodies(pm_active_set *active, pm_saddle *saddle, const int *bodies, int first)
{
    const int nbody = saddle->model->nbody, njoint = saddle->model->rows[PM_TABLE_JOINT];
    int *place = active->body_place, *queue = saddle->first_constraint, n = 0;
    for (int i = 0; i < nbody; i++) place[i] = PM_NONE;
    for (int next = 0, start = first; n < nbody; next++) {
        if (next == n) {
            for (int i = 0; i < nbody && place[start] != PM_NONE; i++) start = i;
            place[start] = n;
            queue[n++] = start;
        }
        for (int i = 0; i < njoint; i++) {
            const int *body = bodies + 2 * i;
            if (body[0] != queue[next] && body[1] != queue[next]) continue;
            const int other = body[body[0] == queue[next] ? 1 : 0];
            if (other == PM_GROUND || place[other] != PM_NONE) continue;
            place[other] = n;
            queue[n++] = other;
        }
    }
    return queue[nbody - 1];
}

void pm_constraint_order_find(pm_workspace *w)
{
    const int nbody = w->model->nbody, njoint = w->model->rows[PM_TABLE_JOINT];
    for (int i = 0; i < njoint; i++) w->active.joint_order[i] = i;
    if (nbody <= PM_ORDERED_AS_WRITTEN) return;
    int *bodies = (int *)(void *)w->scratch; /* [njoint][2] */
    for (int i = 0; i < njoint; i++) find_bodies(&w->frame, &w->state, i, bodies + 2 * i);
    number_bodies(&w->active, &w->saddle, bodies,
                  number_bodies(&w->active, &w->saddle, bodies, 0)); /* the last of all hangs at an end */
    for (int place = PM_GROUND, n = 0; place < nbody; place++)
        for (int i = 0; i < njoint; i++)
            if (last_place(&w->active, bodies + 2 * i) == place) w->active.joint_order[n++] = i;
}
