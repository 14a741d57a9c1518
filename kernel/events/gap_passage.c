/* gap_passage.c - how far what meets circles moves between two nodes of a step, against the radii.
 *
 * Circles that meet circles part again behind each other.  A step that is expected to move them by more than their gap moves them
 * from node to node by no more than their radii, so that one of the nodes finds them together.  What is expected is a motion
 * of constant acceleration; where forces have grown since, the nodes tell how far they moved: gaps a and b at two of them
 * and a way s < a + b between leave them apart. */
#include "events/gap_passage.h"

#include <math.h>

#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "events/event.h"
#include "events/gap_culling.h"
#include "numerics/tolerances.h"

static double through_curve(const pm_numbers *numbers, int curve)
{
    return fmin(numbers->course[curve].fine, PM_CULLING_CURVE * numbers->course[curve].size);
}

/* The sum of the radii of two circles, or of a circle and a member of a pattern (a point); 0 of what cannot be gone
 * through. */
static double through(const pm_model *m, const pm_numbers *numbers, int contact)
{
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_CURVES)
        return fmin(through_curve(numbers, e[PM_CONTACT_A]), through_curve(numbers, e[PM_CONTACT_B]));
    const double radius = numbers->value[PM_CIRCLE_ROW(m, e[PM_CONTACT_A])[PM_CIRCLE_RADIUS]];
    switch (e[PM_CONTACT_KIND]) {
    case PM_CONTACT_PATTERN: return radius;
    case PM_CONTACT_CIRCLE: /* side 1: outside each other; what has come through from inside stays there */
        return numbers->value[e[PM_CONTACT_SIDE]] == 1
                   ? radius + numbers->value[PM_CIRCLE_ROW(m, e[PM_CONTACT_B])[PM_CIRCLE_RADIUS]]
                   : 0;
    case PM_CONTACT_CURVE: return through_curve(numbers, e[PM_CONTACT_B]);
    default: return 0;
    }
}

/* How fast the origin of a body goes against that of another, and the circles about them: rates are velocities or
 * accelerations. */
static double against(const pm_model *model, const pm_event_set *event, const double *rate, const int body[2])
{
    static const double zero[3] = {0, 0, 0};
    const double *part[2], *radius = event->culling.radius;
    double rotation = 0;
    for (int i = 0; i < 2; i++) {
        const int moves = body[i] < model->nbody;
        part[i] = moves ? rate + 3 * body[i] : zero;
        if (moves) rotation += radius[body[i]] * fabs(part[i][2]);
    }
    return hypot(part[0][0] - part[1][0], part[0][1] - part[1][1]) + rotation;
}

double pm_gap_passage_time(const pm_workspace *w, const double *v, const double *a)
{
    const pm_event_set *e = w->event;
    double time = INFINITY;
    for (int i = 0; i < e->nfunction; i++) {
        const int contact = e->function[i].index;
        int body[2], member;
        if (e->function[i].kind != FUNCTION_GAP || e->function[i].owned) continue;
        const double radii = through(w->model, &w->numbers, contact);
        if (!(radii > 0) || !pm_gap_culling_bodies(w->model, contact, body)) continue;
        const double safe = (w->step.nodes->n - 1) * radii, left = e->culling.left[contact];
        const double free =
            left > safe ? left : PM_CULLING_WITHIN * pm_contact_gap(&w->frame, &w->state, contact, &member);
        const double way = fmax(free, safe);
        const double speed = against(w->model, w->event, v, body),
                     rate = against(w->model, w->event, a, body);
        time =
            fmin(time, 2 * way / (speed + sqrt(speed * speed + 2 * rate * way))); /* v t + a t^2 / 2 = way */
    }
    return time;
}

/* How far the bodies of a contact move against each other from one node to the next, circles about them with them. */
static double way_between(const pm_gap_culling *x, const pm_model *m, const int body[2], int node)
{
    double way[3] = {0, 0, 0};
    for (int i = 0; i < 2; i++) {
        if (body[i] == m->nbody) continue;
        const double *from = x->pose + 3 * (node * m->nbody + body[i]), *to = from + 3 * m->nbody;
        for (int k = 0; k < 2; k++) way[k] += (i ? -1 : 1) * (to[k] - from[k]);
        way[2] += x->radius[body[i]] * fabs(to[2] - from[2]);
    }
    return pm_length(way) + way[2];
}

static int is_shown(const pm_workspace *w, int i)
{
    const pm_event_set *e = w->event;
    const pm_event_function *f = &e->function[i];
    int body[2];
    if (f->kind != FUNCTION_GAP || f->owned || e->culling.skipped[f->index]) return 1;
    const double radii = through(w->model, &w->numbers, f->index), *gap = pm_event_samples(w->event, i);
    if (!(radii > 0) || !pm_gap_culling_bodies(w->model, f->index, body)) return 1;
    for (int k = 0; k + 1 < w->step.nodes->n; k++) {
        const double way = way_between(&e->culling, w->model, body, k);
        if (way > radii && PM_PASSAGE_BETWEEN * way > gap[k] + gap[k + 1]) return 0;
    }
    return 1;
}

int pm_gap_passage_is_shown(const pm_workspace *w)
{
    for (int i = 0; i < w->event->nfunction; i++)
        if (!is_shown(w, i)) return 0;
    return 1;
}
