/* repeat_match.c - whether a phase begins like the last segment.
 *
 * The contacts that are closed are the same, in the same modes, the member of each pattern so many further on; every body
 * has moved by the same way b and rotated by an angle of its own,
 *
 *   q = q_0 + b,    v = sqrt(T / T_0) v_0      q_0, v_0, T_0 at the begin of the last segment */
#include <math.h>

#include "elements/contact.h"
#include "numerics/tolerances.h"
#include "routes/path/repeat.h"
#include "state/workspace.h"

/* The contacts are closed in the same modes, each with a member that is as many further on; or with none at all. */
static int same_modes(pm_workspace *w)
{
    const pm_model *m = w->model;
    const pm_slot *then = w->repeat->begin.slot, *now = w->state.slot;
    int found = 0, member = 0;
    for (int c = 0; c < m->rows[PM_TABLE_CONTACT]; c++) {
        const int first = m->contact_slot[c], n = pm_contact_slots(m, c);
        int a = PM_NONE, b = PM_NONE, na = 0, nb = 0;
        for (int i = first; i < first + n; i++) {
            if (then[i].mode != PM_OPEN) a = i, na++;
            if (now[i].mode != PM_OPEN) b = i, nb++;
        }
        if (na != nb || na > 1) return 0; /* several members closed at once: not looked into */
        if (na == 0) continue;
        if (then[a].mode != now[b].mode) return 0;
        if (PM_CONTACT_ROW(m, c)[PM_CONTACT_KIND] != PM_CONTACT_PATTERN) continue;
        const int step = now[b].member - then[a].member;
        if (found && step != member) return 0;
        found = 1;
        member = step;
    }
    w->repeat->member = member;
    return 1;
}

/* The way that goes with the members, or, where none is passed, that of the first body; 0 if patterns of several steps, or
 * moving ones, are in touch. */
static int find_way(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_repeat *l = w->repeat;
    int found = 0;
    l->by[0] = l->by[1] = 0;
    if (l->member == 0) {
        for (int k = 0; k < 2; k++) l->by[k] = w->state.q[k] - l->begin.q[k];
        if (fmax(fabs(l->by[0]), fabs(l->by[1])) <= PM_REPEAT_SAME_PLACE * pm_contact_reach(w))
            l->by[0] = l->by[1] = 0;
        return 1;
    }
    for (int c = 0; c < m->rows[PM_TABLE_CONTACT]; c++) {
        const int32_t *e = PM_CONTACT_ROW(m, c);
        if (e[PM_CONTACT_KIND] != PM_CONTACT_PATTERN) continue;
        const int32_t *pattern = PM_PATTERN_ROW(m, e[PM_CONTACT_B]);
        if (PM_POINT_ROW(m, pattern[PM_PATTERN_POINT])[PM_POINT_BODY] != PM_GROUND) return 0;
        const double x = l->member * w->numbers.value[pattern[PM_PATTERN_STEP_X]],
                     y = l->member * w->numbers.value[pattern[PM_PATTERN_STEP_Y]];
        if (found && (x != l->by[0] || y != l->by[1])) return 0;
        found = 1;
        l->by[0] = x;
        l->by[1] = y;
    }
    return found;
}

static int same_place_and_motion(pm_workspace *w, double kinetic)
{
    pm_repeat *l = w->repeat;
    const double place = PM_REPEAT_SAME_PLACE * pm_contact_reach(w),
                 motion = PM_REPEAT_SAME_MOTION * w->numbers.speed;
    const double faster = l->kinetic > 0 ? sqrt(kinetic / l->kinetic) : 0;
    for (int i = 0; i < w->model->nbody; i++) {
        const double *q = w->state.q + 3 * i, *v = w->state.v + 3 * i;
        const double *q0 = l->begin.q + 3 * i, *v0 = l->begin.v + 3 * i;
        for (int k = 0; k < 2; k++) {
            if (fabs(q[k] - q0[k] - l->by[k]) > place) return 0;
            if (fabs(v[k] - faster * v0[k]) > motion) return 0;
        }
        if (fabs(v[2] - faster * v0[2]) * w->numbers.size > motion) return 0;
        l->rotation[i] = q[2] - q0[2];
        const double number = l->rotation[i] / (2 * M_PI);
        if (fabs(number - round(number)) <= PM_REPEAT_SAME_PLACE * fmax(1, fabs(number)))
            l->rotation[i] = 2 * M_PI * round(number);
    }
    return 1;
}

int pm_repeat_match(pm_workspace *w, double kinetic)
{
    return same_modes(w) && find_way(w) && same_place_and_motion(w, kinetic);
}
