/* contact_course_stretch.c - one stretch of the course of a blow: who may push, how fast its velocities change. */
#include <math.h>
#include <string.h>

#include "impact/contact_course_parts.h"
#include "planemotion.h"
#include "state/state.h"

static void set_pace(pm_contact_course_contact *c, double normal, int compresses)
{
    if (compresses)
        c->pace = normal < 0 ? -normal : 0;
    else
        c->pace = c->rebounds ? -c->restitution * c->before : 0;
}

/* The contacts that may push; how fast their normal velocities are to grow at least. */
static void list(pm_contact_course *x, int compresses)
{
    pm_contact_problem *s = &x->stretch;
    s->n = 0;
    for (int i = 0; i < x->n; i++) {
        pm_contact_course_contact *c = &x->contact[i];
        const double *u = x->velocity + 2 * i;
        set_pace(c, u[0], compresses);
        memset(c->share, 0, sizeof c->share);
        if (u[0] > 0 && c->pace == 0) continue;
        pm_contact_problem_contact *p = &s->contact[s->n];
        *p = c->friction;
        p->bias[0] = -c->pace;
        p->bias[1] = 0;
        if (p->friction == PM_FRICTION_COULOMB && fabs(u[1]) > x->no_slip) p->slips = u[1] > 0 ? 1 : -1;
        x->of[s->n++] = i;
    }
}

/* Place among all of direction r of the listed ones. */
static int place_of(const pm_contact_course *x, int r)
{
    const int n = 2 * x->stretch.n;
    return r < n ? 2 * x->of[r / 2] + r % 2 : 2 * x->n + r - n;
}

/* The listed contacts, and all joints: those that slip go on. */
void pm_contact_course_pose(pm_contact_course *x)
{
    const int n = 2 * x->stretch.n, all = n + x->m;
    double *response = x->m > 0 ? x->joints.response : x->stretch.response;
    for (int r = 0; r < all; r++)
        for (int k = 0; k < all; k++)
            response[r * all + k] = x->response[place_of(x, r) * pm_contact_course_size(x) + place_of(x, k)];
    for (int r = 0; r < 2 * x->m; r++)
        for (int k = 0; k < all; k++)
            x->joints.reaction[r * all + k] = x->reaction[r * pm_contact_course_size(x) + place_of(x, k)];
    for (int r = 0; r < n && x->m > 0; r++) x->joints.bias[r] = x->stretch.contact[r / 2].bias[r % 2];
    x->joints.m = x->m;
    for (int k = 0; k < x->m; k++) {
        const double slip = x->velocity[2 * x->n + k];
        x->joints.joint[k] = (pm_contact_problem_joint){.coefficient = x->joint[k].coefficient,
                                                        .nload = x->joint[k].nload,
                                                        .slips = (slip > 0) - (slip < 0)};
    }
}

int pm_contact_course_solve(pm_contact_course *x)
{
    const int found =
        x->m > 0 ? pm_contact_problem_joints_solve(&x->joints) : pm_contact_problem_solve(&x->stretch);
    const int differs = x->m > 0 ? x->joints.differs : x->stretch.differs;
    if (found > 1 && differs != PM_NONE) x->differs = x->of[differs];
    if (found == 0 && x->stretch.n > 0) x->differs = x->of[0];
    return found;
}

/* What closed contacts and joints that hold do is known exactly. */
static void set_rates(pm_contact_course *x)
{
    const pm_contact_problem *s = &x->stretch;
    for (int i = 0; i < pm_contact_course_size(x); i++) {
        double sum = 0;
        for (int j = 0; j < 2 * x->n; j++)
            sum += x->response[i * pm_contact_course_size(x) + j] * x->contact[j / 2].share[j % 2];
        for (int k = 0; k < x->m; k++)
            sum += x->response[i * pm_contact_course_size(x) + 2 * x->n + k] * x->joint[k].share;
        *(i < 2 * x->n ? &x->contact[i / 2].rate[i % 2] : &x->joint[i - 2 * x->n].rate) = sum;
    }
    for (int i = 0; i < s->n; i++) {
        pm_contact_course_contact *c = &x->contact[x->of[i]];
        if (s->mode[i] == PM_OPEN) continue;
        c->rate[0] = c->pace;
        if (s->mode[i] == PM_STICK) c->rate[1] = 0;
    }
    for (int k = 0; k < x->m; k++)
        if (x->joints.joint[k].mode == PM_STICK) x->joint[k].rate = 0;
}

int pm_contact_course_find_rates(pm_contact_course *x, int compresses)
{
    pm_contact_problem *s = &x->stretch;
    list(x, compresses);
    pm_contact_course_pose(x);
    const int found = pm_contact_course_solve(x);
    for (int i = 0; i < s->n && found == 1; i++) {
        x->contact[x->of[i]].share[0] = fmax(0, s->load[2 * i]);
        x->contact[x->of[i]].share[1] = s->load[2 * i + 1];
    }
    for (int k = 0; k < x->m && found == 1; k++) x->joint[k].share = x->joints.joint[k].friction;
    if (found == 1) set_rates(x);
    return found;
}
