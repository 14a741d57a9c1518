/* order.c - in which order the joints' rows stand, so that the saddle-point system has a narrow envelope.
 *
 * Bodies are numbered by breadth-first levels from one that hangs at an end (Cuthill and McKee, Proc. 24th ACM National
 * Conf., 1969), joints by the later of their bodies. */
#include "order.h"

#include "row.h"

#define SMALL 10 /* bodies; below it the order of the file is as good, and what depends on it stays */

/* The greatest number of a joint's bodies; PM_GROUND if all are the ground. */
static int last_place(const pm_workspace *w, int joint)
{
    pm_row row[PM_JOINT_ROWS];
    int last = PM_GROUND;
    const int n = pm_row_of_joint(w, joint, row);
    for (int k = 0; k < n; k++)
        for (int p = 0; p < 2; p++)
            if (row[k].body[p] != w->model->nbody && w->body_place[row[k].body[p]] > last)
                last = w->body_place[row[k].body[p]];
    return last;
}

/* The body that a joint fastens to this one, or the body itself. */
static int partner(const pm_workspace *w, int joint, int body)
{
    pm_row row[PM_JOINT_ROWS];
    const int n = pm_row_of_joint(w, joint, row);
    for (int k = 0; k < n; k++)
        for (int p = 0; p < 2; p++)
            if (row[k].body[p] == body && row[k].body[1 - p] != w->model->nbody) return row[k].body[1 - p];
    return body;
}

/* Numbers the bodies from `first` on, and from the next that is left wherever the scene falls apart; the last one. */
static int number_bodies(pm_workspace *w, int first)
{
    const int nbody = w->model->nbody, njoint = w->model->rows[PM_TABLE_JOINT];
    int *place = w->body_place, *queue = w->first_row, n = 0;
    for (int i = 0; i < nbody; i++) place[i] = PM_NONE;
    for (int next = 0, start = first; n < nbody; next++) {
        if (next == n) {
            for (int i = 0; i < nbody && place[start] != PM_NONE; i++) start = i;
            place[start] = n;
            queue[n++] = start;
        }
        for (int i = 0; i < njoint; i++) {
            const int other = partner(w, i, queue[next]);
            if (place[other] != PM_NONE) continue;
            place[other] = n;
            queue[n++] = other;
        }
    }
    return queue[nbody - 1];
}

void pm_order_find(pm_workspace *w)
{
    const int nbody = w->model->nbody, njoint = w->model->rows[PM_TABLE_JOINT];
    for (int i = 0; i < njoint; i++) w->joint_order[i] = i;
    if (nbody <= SMALL) return;
    number_bodies(w, number_bodies(w, 0)); /* the last of all hangs at an end */
    for (int place = PM_GROUND, n = 0; place < nbody; place++)
        for (int i = 0; i < njoint; i++)
            if (last_place(w, i) == place) w->joint_order[n++] = i;
}
