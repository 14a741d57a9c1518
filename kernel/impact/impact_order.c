/* impact_order.c - whether a blow of several contacts would leave another motion if its contacts were struck one by one.
 *
 * Each contact that approaches is struck first once, alone and from the velocities before the blow; after it always the one
 * that approaches fastest, until none does: the order of the contacts in the file does not matter.  The velocities at the
 * contacts are compared with those after the blow.  A blow whose speeds are rounding has no order. */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "events/last_bounce.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"
#include "state/workspace.h"

/* Velocities at the listed contacts with those of the bodies; the greatest of them. */
static double read(const pm_workspace *w, const pm_contact_system *x, const double *v, double *u)
{
    double size = 0;
    for (int i = 0; i < 2 * x->problem.n; i++) {
        const pm_constraint *c = i % 2 == 0 ? &x->normal[i / 2] : &x->tangent[i / 2];
        u[i] = pm_constraint_times(&w->frame, c, v) - c->rate;
        size = fmax(size, fabs(u[i]));
    }
    return size;
}

/* The course of listed contact i alone; 0 if its law has none. */
static int follow(pm_workspace *w, pm_blow *b, int i, const double *u)
{
    pm_contact_course *c = &b->course;
    const int n = 2 * b->system.problem.n, contact = pm_contact_of_slot(w->model, b->system.slot[i]);
    c->n = 1;
    c->m = 0;
    c->exponent = 0;
    c->no_slip = pm_contact_speed(&w->frame);
    for (int k = 0; k < 4; k++)
        c->response[k] = b->system.problem.response[(2 * i + k / 2) * n + 2 * i + k % 2];
    memcpy(c->velocity, u, 2 * sizeof *u);
    c->contact[0] = (pm_contact_course_contact){
        .friction = b->system.problem.contact[i],
        .law = pm_contact_law(w->model, contact),
        .restitution = pm_last_bounce_restitution(w, contact, u[0]),
    };
    return pm_contact_course_follow(c) == 1;
}

/* The same with a restitution along the contact: one problem, the slip after the blow decides. */
static int rebound(pm_workspace *w, pm_blow *b, int i, const double *u)
{
    pm_contact_course *c = &b->course;
    pm_contact_problem *p = &c->stretch;
    const int contact = pm_contact_of_slot(w->model, b->system.slot[i]);
    const double e = pm_last_bounce_restitution(w, contact, u[0]);
    p->n = 1;
    memcpy(p->response, c->response, 4 * sizeof *p->response);
    p->contact[0] = b->system.problem.contact[i];
    p->contact[0].bias[0] = (1 + e) * u[0];
    p->contact[0].bias[1] = u[1] + (e > 0 ? pm_contact_tangential(&w->frame, contact) * u[1] : 0);
    if (pm_contact_problem_solve(p) != 1) return 0;
    memcpy(c->impulse, p->load, 2 * sizeof *p->load);
    return 1;
}

/* Strikes listed contact i alone. */
static int strike(pm_workspace *w, pm_blow *b, int i, double *u)
{
    const pm_contact_problem *x = &b->system.problem;
    const int contact = pm_contact_of_slot(w->model, b->system.slot[i]);
    if (!follow(w, b, i, u + 2 * i)) return 0;
    if (PM_CONTACT_ROW(w->model, contact)[PM_CONTACT_TANGENTIAL] != PM_NONE && !rebound(w, b, i, u + 2 * i))
        return 0;
    for (int r = 0; r < 2 * x->n; r++)
        for (int k = 0; k < 2; k++) u[r] += x->response[r * 2 * x->n + 2 * i + k] * b->course.impulse[k];
    return 1;
}

static int fastest(const double *u, int n)
{
    int i = 0;
    for (int k = 1; k < n; k++)
        if (u[2 * k] < u[2 * i]) i = k;
    return i;
}

/* Blows one by one, listed contact `first` first; 1: they leave another motion.  *second: who is struck after it. */
static int differs(pm_workspace *w, pm_blow *b, int first, double size, int *second)
{
    const int n = b->system.problem.n;
    const double slow = fmax(pm_contact_speed(&w->frame), PM_ORDER_SLOW * size);
    double *u = b->order.now;
    memcpy(u, b->order.before, 2 * (size_t)n * sizeof *u);
    *second = PM_NONE;
    for (int k = 0, i = first; u[2 * i] < -slow && k < PM_ORDER_STRIKES * n; k++, i = fastest(u, n)) {
        if (k == 1) *second = i;
        if (!strike(w, b, i, u)) return 1;
    }
    for (int k = 0; k < 2 * n; k++)
        if (fabs(u[k] - b->order.after[k]) > PM_ORDER_SAME * size) return 1;
    return 0;
}

/* The first such blow of a run is told, with who is struck second, or else pushes all at once. */
static void tell(pm_workspace *w, const pm_contact_system *x, int first, int second)
{
    if (w->result.count[PM_COUNT_ORDERED_BLOWS]++ > 0) return;
    for (int i = 0; i < x->problem.n && second == PM_NONE; i++)
        if (i != first && w->impulses.slot[2 * x->slot[i]] > 0) second = i;
    const int other = second == PM_NONE ? first : second;
    w->result.ordered = (pm_where){PM_TABLE_CONTACT, pm_contact_of_slot(w->model, x->slot[first]),
                                   pm_contact_of_slot(w->model, x->slot[other]), w->state.t, NAN};
}

void pm_impact_order_look(pm_workspace *w, pm_blow *b)
{
    const pm_contact_system *x = &b->system;
    const double slow = pm_contact_speed(&w->frame), size = read(w, x, b->before, b->order.before);
    read(w, x, b->after, b->order.after);
    for (int i = 0, second; i < x->problem.n; i++)
        if (b->order.before[2 * i] < -slow && differs(w, b, i, size, &second)) {
            tell(w, x, i, second);
            return;
        }
}
