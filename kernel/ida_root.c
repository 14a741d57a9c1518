/* ida_root.c - which event functions IDA watches, and what it cannot see.
 *
 * IDA looks for changes of sign from step to step.  A function that is zero when the phase begins would fire at once: IDA
 * is shown 1 in its place (it is not armed) until the function has left zero, and from then on its value times the side
 * to which it went.  A function that leaves zero and returns within one step, or that dips to zero and back, changes no
 * sign either: steps in which this can be are sampled here and such roots located on the dense output. */
#include "ida_root.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body.h"
#include "event.h"
#include "ida_system.h"
#include "root.h"
#include "route.h"
#include "saddle.h"

#define ON_ZERO 1e-12    /* of a trigger's size: zero */
#define STILL_ZERO 1e-3  /* of its size: a trigger that has just fired may be this far off, and not yet armed */
#define CLEAR 10         /* times the value after the firing: now it has left */
#define AHEAD 0.1        /* of the motion's own time: how far ahead a trigger's size is looked up */
#define REACH 4          /* changes in a step within which a function may dip to zero */
#define SAME_TIME 1e-11  /* of a step: roots closer than this are one instant */
#define HALVINGS 30      /* of a step, to find the top of a short bounce */

typedef struct pm_ida_roots {
    int most;         /* functions that IDA knows of; those that the phase has not are 1 */
    int *direction;   /* [most] as IDA sees them */
    int *side;        /* [most] 1, -1; 0: not armed */
    int *index;       /* [most] 0, 1, 2 ..: contexts of root searches */
    int *suspect;     /* [most] may have a root inside the step */
    int *info;        /* [most] IDA's roots */
    double *zero;     /* [most] not armed: this or less is zero */
    double *latest;   /* [most] values at the last evaluation */
    double *node;     /* [PM_NODES][most] values in the step, those at its begin known */
    double *last;     /* [most] values at the begin of the step before */
    double length;    /* of that step */
    void *block;
} pm_ida_roots;

/* All functions at the frame, brought to the level that they need. */
static int values(pm_workspace *w, double *g)
{
    const int status = w->event->level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
    if (!status) pm_event_values(w, g);
    return status;
}

static int values_inside(pm_workspace *w, double t, double *g)
{
    const int status = w->route->at(w, t, &w->probe);
    if (status) return status;
    pm_frame_look(w, t, w->probe.q, w->probe.v, w->probe.z, w->state.memory);
    return values(w, g);
}

/* What IDA sees. */
static int shown(double t, N_Vector y, N_Vector yp, double *g, void *workspace)
{
    pm_workspace *w = workspace;
    const pm_ida_roots *x = w->ida->roots;
    const int nq = w->model->nq;
    const double *q = N_VGetArrayPointer(y);
    (void)yp;
    pm_frame_look(w, t, q, q + nq, q + 2 * nq, w->state.memory);
    const int status = values(w, x->latest);
    if (status) {
        w->ida->status = status;
        return -1;
    }
    for (int i = 0; i < x->most; i++) g[i] = i < w->event->nfunction && x->side[i] ? x->side[i] * x->latest[i] : 1;
    return 0;
}

int pm_ida_root_create(pm_workspace *w)
{
    const size_t most = (size_t)w->event->most;
    pm_ida_roots *x = w->ida->roots = calloc(1, sizeof *x);
    if (!x) return PM_NO_MEMORY;
    double *p = x->block = calloc((3 + PM_NODES) * most + 1, sizeof *p);
    x->direction = calloc(5 * most + 1, sizeof *x->direction);
    if (!p || !x->direction) return PM_NO_MEMORY;
    x->most = w->event->most;
    x->zero = p;
    x->latest = x->zero + most;
    x->last = x->latest + most;
    x->node = x->last + most;
    x->side = x->direction + most;
    x->index = x->side + most;
    x->suspect = x->index + most;
    x->info = x->suspect + most;
    for (int i = 0; i < x->most; i++) x->index[i] = i;
    if (x->most == 0) return PM_OK;
    int flag = IDARootInit(w->ida->memory, x->most, shown);
    if (flag == IDA_SUCCESS) flag = IDASetNoInactiveRootWarn(w->ida->memory);
    return flag == IDA_SUCCESS ? PM_OK : pm_fail(w, PM_SOLVER, PM_NONE, PM_NONE, flag, 0);
}

void pm_ida_root_free(pm_workspace *w)
{
    pm_ida_roots *x = w->ida->roots;
    if (!x) return;
    free(x->block);
    free(x->direction);
    free(x);
    w->ida->roots = NULL;
}

static void arm(pm_workspace *w, int i, double value)
{
    pm_ida_roots *x = w->ida->roots;
    x->side[i] = value > 0 ? 1 : -1;
    x->direction[i] = w->event->function[i].direction * x->side[i];
}

static int tell_directions(pm_workspace *w)
{
    const int flag = w->ida->roots->most ? IDASetRootDirection(w->ida->memory, w->ida->roots->direction) : IDA_SUCCESS;
    return flag == IDA_SUCCESS ? PM_OK : pm_fail(w, PM_SOLVER, PM_NONE, PM_NONE, flag, 0);
}

/* A trigger's size: the greater of its values now and a little ahead on the present course. */
static void look_ahead(pm_workspace *w, const double *a, const double *now, double *size)
{
    const int nq = w->model->nq;
    const double time = AHEAD * pm_ida_system_time_scale(w, w->state.v, a);
    pm_state *s = &w->probe;
    memcpy(size, now, (size_t)w->event->nfunction * sizeof *now);
    if (!isfinite(time)) return;
    pm_state_copy(s, &w->state);
    for (int i = 0; i < nq; i++) {
        s->q[i] += time * (s->v[i] + 0.5 * time * a[i]);
        s->v[i] += time * a[i];
    }
    pm_frame_look(w, s->t + time, s->q, s->v, s->z, w->state.memory);
    if (values(w, size)) return;
    for (int i = 0; i < w->event->nfunction; i++)
        size[i] = isfinite(size[i]) ? fmax(fabs(size[i]), fabs(now[i])) : fabs(now[i]);
}

int pm_ida_root_begin(pm_workspace *w, const double *a)
{
    pm_ida_roots *x = w->ida->roots;
    const pm_event_set *e = w->event;
    double *size = x->latest;
    x->length = 0;
    memset(x->side, 0, (size_t)x->most * sizeof *x->side);
    memset(x->direction, 0, (size_t)x->most * sizeof *x->direction);
    pm_event_values(w, x->node);
    look_ahead(w, a, x->node, size);
    for (int i = 0; i < e->nfunction; i++) {
        const pm_event_function *f = &e->function[i];
        const double g = x->node[i];
        x->zero[i] = f->slack > 0 ? f->slack : ON_ZERO * fabs(size[i]);
        if (f->held && f->slack == 0 && fabs(g) <= STILL_ZERO * fabs(size[i])) x->zero[i] = fmax(x->zero[i], CLEAR * fabs(g));
        if (!(f->held && f->slack > 0) && fabs(g) > x->zero[i]) arm(w, i, g);
    }
    return tell_directions(w);
}

/* ---- one step ---- */
static double along(pm_workspace *w, double t, void *context)
{
    const int i = *(const int *)context;
    return values_inside(w, t, w->ida->roots->latest) ? NAN : w->ida->roots->latest[i];
}

static int crosses(const pm_event_function *f, double a, double b)
{
    return (f->direction <= 0 && a > 0 && b <= 0) || (f->direction >= 0 && a < 0 && b >= 0);
}

typedef struct pm_bracket {
    double a, ga, b, gb;
} pm_bracket;

/* Three nodes dip towards zero: 1 if the function goes through zero at the vertex of their parabola. */
static int dips(pm_workspace *w, int i, const double g[3], const double t[3], pm_bracket *x)
{
    const int direction = w->event->function[i].direction;
    const double s = g[1] > 0 ? 1 : -1, a = s * g[0], b = s * g[1], c = s * g[2];
    if (!(b < a && b < c && b > 0) || direction * s > 0) return 0;
    const double bend = a - 2 * b + c, shift = 0.5 * (a - c) / bend, low = b - 0.125 * (a - c) * (a - c) / bend;
    if (low > 0.1 * b) return 0;
    *x = (pm_bracket){.a = t[0], .ga = g[0], .b = t[1] + shift * (t[2] - t[1])};
    x->gb = along(w, x->b, &w->ida->roots->index[i]);
    return s * x->gb <= 0;
}

/* A contact's function goes from zero to the wrong side by t[0] + span: it has bounced in between, or the event is now. */
static void bounce(pm_workspace *w, int i, double begin, double span, double g, pm_bracket *x)
{
    *x = (pm_bracket){.a = begin, .b = begin};
    for (int k = 0; k < HALVINGS; k++) {
        const double t = begin + ldexp(span, -1 - k), value = along(w, t, &w->ida->roots->index[i]);
        if (t <= begin) return;
        if (value > 0) {
            *x = (pm_bracket){.a = t, .ga = value, .b = begin + ldexp(span, -k), .gb = g};
            return;
        }
        g = value;
    }
}

/* The first bracket of function i among the nodes; arms it if it has left zero for good. */
static int scan(pm_workspace *w, int i, const double *t, pm_bracket *x)
{
    const pm_ida_roots *r = w->ida->roots;
    const pm_event_function *f = &w->event->function[i];
    int side = r->side[i];
    double g[PM_NODES];
    for (int k = 0; k < PM_NODES; k++) g[k] = r->node[k * r->most + i];
    for (int k = 0; k + 1 < PM_NODES; k++) {
        if (side == 0) {
            if (f->slack > 0 && g[k + 1] < -r->zero[i]) {
                bounce(w, i, t[0], t[k + 1] - t[0], g[k + 1], x);
                return 1;
            }
            if (fabs(g[k + 1]) > r->zero[i]) side = g[k + 1] > 0 ? 1 : -1;
            continue;
        }
        *x = (pm_bracket){t[k], g[k], t[k + 1], g[k + 1]};
        if (crosses(f, g[k], g[k + 1])) return 1;
        if (k + 2 < PM_NODES && dips(w, i, g + k, t + k, x)) return 1;
    }
    if (r->side[i] == 0 && side) arm(w, i, g[PM_NODES - 1]);
    return 0;
}

/* Whether function i may have a root inside the step that its ends do not show. */
static int suspect(const pm_ida_roots *x, int i, double step)
{
    const double a = x->node[i], b = x->latest[i];
    if (x->side[i] == 0) return 1;
    const double change = fmax(fabs(b - a), x->length > 0 ? fabs(a - x->last[i]) * step / x->length : 0);
    return !(fmin(fabs(a), fabs(b)) > REACH * change);
}

static int sample(pm_workspace *w, double end, double *t)
{
    pm_ida_roots *x = w->ida->roots;
    for (int k = 0; k < PM_NODES; k++) {
        t[k] = k == PM_NODES - 1 ? end : w->step_begin + (end - w->step_begin) * k / (PM_NODES - 1);
        const int status = k > 0 ? values_inside(w, t[k], x->node + k * x->most) : PM_OK;
        if (status) return status;
    }
    return PM_OK;
}

/* Roots that IDA has not seen before the end of the step: marks the first; *first is its time or INFINITY. */
static int unseen(pm_workspace *w, double end, double *first)
{
    pm_ida_roots *x = w->ida->roots;
    pm_event_set *e = w->event;
    const double same = SAME_TIME * (end - w->step_begin);
    double node[PM_NODES];
    int status = sample(w, end, node);
    for (int i = 0; i < e->nfunction && !status; i++) {
        pm_bracket b;
        if (!x->suspect[i] || !scan(w, i, node, &b)) continue;
        double root = b.a;
        if (b.b > b.a) status = pm_root_find(w, e->solver, along, &x->index[i], b.a, b.ga, b.b, b.gb, &root);
        if (status || root > *first + same) continue;
        if (root < *first - same)
            for (int k = 0; k < i; k++) e->root[k] = 0;
        e->root[i] = 1;
        *first = fmin(*first, root);
    }
    return status;
}

/* Functions that cross zero right after the event belong to it. */
static int same_instant(pm_workspace *w, double t)
{
    const pm_ida_roots *x = w->ida->roots;
    pm_event_set *e = w->event;
    const int status = values_inside(w, t + SAME_TIME * (t - w->step_begin), x->latest);
    for (int i = 0; i < e->nfunction && !status; i++)
        if (x->side[i] && crosses(&e->function[i], x->node[i], x->latest[i])) e->root[i] = 1;
    return status;
}

static int roots_of_ida(pm_workspace *w)
{
    pm_ida_roots *x = w->ida->roots;
    const int flag = IDAGetRootInfo(w->ida->memory, x->info);
    if (flag != IDA_SUCCESS) return pm_fail(w, PM_SOLVER, PM_NONE, PM_NONE, flag, 0);
    for (int i = 0; i < w->event->nfunction; i++) w->event->root[i] = x->info[i] != 0;
    return PM_OK;
}

/* The next step begins where this one ends. */
static int carry_over(pm_workspace *w, const double *end, double step)
{
    pm_ida_roots *x = w->ida->roots;
    const size_t bytes = (size_t)w->event->nfunction * sizeof *end;
    memcpy(x->last, x->node, bytes);
    memcpy(x->node, end, bytes);
    x->length = step;
    return tell_directions(w);
}

int pm_ida_root_step(pm_workspace *w, int found, double *t)
{
    pm_ida_roots *x = w->ida->roots;
    const int n = w->event->nfunction;
    const double end = *t, step = end - w->step_begin;
    double first = INFINITY;
    int any = 0, status = PM_OK;
    if (n == 0) return PM_OK;
    for (int i = 0; i < n; i++) any |= x->suspect[i] = found || suspect(x, i, step);
    if (any) status = unseen(w, end, &first);
    if (!status && found && first >= end - SAME_TIME * step) {
        first = end;
        status = roots_of_ida(w);
    }
    if (status) return status;
    if (first <= end) {
        *t = first;
        return same_instant(w, first);
    }
    return carry_over(w, any ? x->node + (PM_NODES - 1) * x->most : x->latest, step);
}
