/* ida_root.c - which event functions IDA watches, and what it cannot see.
 *
 * IDA looks for changes of sign from step to step.  A function that is zero when the phase begins would
 * fire at once: IDA is shown 1 in its place (it is not armed) until the function has left zero, and from
 * then on its value times the side to which it went.  A function that leaves zero and returns within one
 * step, or that dips to zero and back, changes no sign either: steps in which this can be are sampled here
 * and such roots located on the dense output. */
#include "routes/ida/ida.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "equations/case.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "numerics/bracket.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

#define ON_ZERO 1e-12   /* of a trigger's size: zero */
#define STILL_ZERO 1e-3 /* of its size: so far off may a trigger be that has just fired */
#define CLEAR 10        /* times the value after the firing: now it has left */
#define AHEAD 0.1       /* of the motion's own time: over it a trigger changes by its size */
#define RATE_TIME 1e-4  /* of the motion's own time: distance of the differences at the begin of a phase */
#define RATE_STEP 1e-3  /* of a step: distance of the differences in it */
#define FLIGHT 0.05     /* of a bounce, as a first step */
#define SHORTEST 1e-4   /* of the first step that would be taken without it */
#define REACH 4         /* changes in a step within which a function may dip to zero */
#define SAME_TIME 1e-11 /* of a step: roots closer than this are one instant */
#define HALVINGS 30     /* of a step, to find the top of a short bounce */

typedef struct pm_ida_roots {
    int most;       /* functions that IDA knows of; those that the phase has not are 1 */
    int *direction; /* [most] as IDA sees them */
    int *side;      /* [most] 1, -1; 0: not armed */
    int *suspect;   /* [most] may have a root inside the step */
    int *info;      /* [most] IDA's roots */
    int news;       /* directions that IDA has not been told */
    double *zero;   /* [most] not armed: this or less is zero */
    double *latest; /* [most] values at the last evaluation */
    double *node;   /* [PM_NODES][most] values in the step, those at its begin known */
    double *last;   /* [most] values at the begin of the step before */
    double length;  /* of that step */
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
    const int status = w->phase.route->at(w, t, &w->probe);
    if (status) return status;
    pm_frame_look(&w->frame, t, w->probe.q, w->probe.v, w->probe.z, w->state.memory);
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
    pm_frame_look(&w->frame, t, q, q + nq, q + 2 * nq, w->state.memory);
    const int status = values(w, x->latest);
    if (status) {
        w->ida->status = status;
        return -1;
    }
    for (int i = 0; i < x->most; i++)
        g[i] = i < w->event->nfunction && x->side[i] ? x->side[i] * x->latest[i] : 1;
    return 0;
}

int pm_ida_root_create(pm_workspace *w)
{
    const size_t most = (size_t)w->event->most;
    pm_ida_roots *x = w->ida->roots = calloc(1, sizeof *x);
    if (!x) return PM_NO_MEMORY;
    double *p = x->block = calloc((3 + PM_NODES) * most + 1, sizeof *p);
    x->direction = calloc(4 * most + 1, sizeof *x->direction);
    if (!p || !x->direction) return PM_NO_MEMORY;
    x->most = w->event->most;
    x->zero = p;
    x->latest = x->zero + most;
    x->last = x->latest + most;
    x->node = x->last + most;
    x->side = x->direction + most;
    x->suspect = x->side + most;
    x->info = x->suspect + most;
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
    x->news = 1;
}

static int tell_directions(pm_workspace *w)
{
    pm_ida_roots *x = w->ida->roots;
    if (!x->news) return PM_OK;
    x->news = 0;
    const int flag = IDASetRootDirection(w->ida->memory, x->direction);
    return flag == IDA_SUCCESS ? PM_OK : pm_fail(w, PM_SOLVER, PM_NONE, PM_NONE, flag, 0);
}

/* ---- the begin of a phase ---- */
/* Values a little later or earlier on a course of constant acceleration. */
static int values_on_course(pm_workspace *w, const double *a, double time, double *g)
{
    pm_state *s = &w->probe;
    pm_state_copy(s, &w->state);
    for (int i = 0; i < w->model->nq; i++) {
        s->q[i] += time * (s->v[i] + 0.5 * time * a[i]);
        s->v[i] += time * a[i];
    }
    pm_frame_look(&w->frame, s->t + time, s->q, s->v, s->z, w->state.memory);
    return values(w, g);
}

/* Whether function i is armed, and what is zero for it until then, from its value, rate and second rate;
 * *first is made short enough for a contact that leaves to be seen to come back. */
static void begin_one(pm_workspace *w, int i, double g, double rate, double second, double scale,
                      double least, double *first)
{
    pm_ida_roots *x = w->ida->roots;
    const pm_event_function *f = &w->event->function[i];
    if (f->slack > 0) { /* of a contact */
        x->zero[i] = f->slack;
        if (!f->held && g > 0) arm(w, i, g);
        if (x->side[i]) return;
        if (rate > 0 && second < 0) *first = fmin(*first, fmax(least, FLIGHT * 2 * rate / -second));
        return;
    }
    const double time = AHEAD * scale;
    const double size = fmax(fabs(g), fmax(fabs(rate) * time, 0.5 * fabs(second) * time * time));
    x->zero[i] = ON_ZERO * size;
    if (f->held && fabs(g) <= STILL_ZERO * size) x->zero[i] = fmax(x->zero[i], CLEAR * fabs(g));
    if (fabs(g) > x->zero[i]) arm(w, i, g);
}

int pm_ida_root_begin(pm_workspace *w, const double *a, double *first)
{
    pm_ida_roots *x = w->ida->roots;
    const int n = w->event->nfunction;
    const double longest = pm_case_max_time(w); /* even at rest */
    const double scale = fmin(pm_case_time_scale(w, w->state.v, a), longest), d = RATE_TIME * scale;
    const double least = SHORTEST * *first;
    double *later = x->node + x->most, *earlier = later + x->most;
    x->length = 0;
    memset(x->side, 0, (size_t)x->most * sizeof *x->side);
    memset(x->direction, 0, (size_t)x->most * sizeof *x->direction);
    if (n == 0) return PM_OK;
    pm_event_values(w, x->node);
    if (values_on_course(w, a, d, later) || values_on_course(w, a, -d, earlier)) { /* then as if at rest */
        memcpy(later, x->node, (size_t)n * sizeof *later);
        memcpy(earlier, x->node, (size_t)n * sizeof *earlier);
    }
    for (int i = 0; i < n; i++) {
        const double g = x->node[i], rate = (later[i] - earlier[i]) / (2 * d);
        const double second = (later[i] - 2 * g + earlier[i]) / (d * d);
        begin_one(w, i, g, isfinite(rate) ? rate : 0, isfinite(second) ? second : 0, scale, least, first);
    }
    return tell_directions(w);
}

/* ---- one step ---- */
typedef struct pm_search {
    int function;
    double d; /* > 0: the rate by differences instead */
} pm_search;

static double value_at(pm_workspace *w, double t, int i)
{
    return values_inside(w, t, w->ida->roots->latest) ? NAN : w->ida->roots->latest[i];
}

static double along(void *of, double t, void *context)
{
    pm_workspace *w = of;
    const pm_search *x = context;
    if (x->d > 0)
        return (value_at(w, t + x->d, x->function) - value_at(w, t - x->d, x->function)) / (2 * x->d);
    return value_at(w, t, x->function);
}

static int crosses(const pm_event_function *f, double a, double b)
{
    return (f->direction <= 0 && a > 0 && b <= 0) || (f->direction >= 0 && a < 0 && b >= 0);
}

typedef struct pm_ida_bracket {
    double a, ga, b, gb;
} pm_ida_bracket;

/* Whether |g| may turn between nodes k and k + 1, by the changes before and after; unknown ones may be
 * anything. */
static int may_turn(const double *g, int k)
{
    const double s = g[k] > 0 ? 1 : -1;
    return (k == 0 || s * (g[k] - g[k - 1]) < 0) && (k + 2 >= PM_NODES || s * (g[k + 2] - g[k + 1]) > 0);
}

/* Between two nodes of one sign: does the function turn back there, beyond zero?  A turn is where its rate
 * is zero. */
static int dips(pm_workspace *w, int i, pm_ida_bracket *x)
{
    const int direction = w->event->function[i].direction;
    const double s = x->ga > 0 ? 1 : -1, h = x->b - x->a;
    pm_search rate = {i, RATE_STEP * h};
    double turn;
    if (!(x->ga * x->gb > 0) || direction * s > 0) return 0;
    const double ra = along(w, x->a, &rate), rb = along(w, x->b, &rate);
    if (!(s * ra < 0 && s * rb > 0)) return 0;
    /* no lower than where the tangents meet */
    const double meet = (x->gb - x->ga - rb * h) / (ra - rb);
    if (s * (x->ga + ra * meet) > 0) return 0;
    if (pm_bracket_find(w->event->solver, along, w, &rate, x->a, ra, x->b, rb, &turn)) return 0;
    x->b = turn;
    x->gb = value_at(w, turn, i);
    return s * x->gb <= 0;
}

/* A contact's function is on the wrong side by begin + span: it has bounced in between, or the event is
 * now. */
static void bounce(pm_workspace *w, int i, double begin, double span, double g, pm_ida_bracket *x)
{
    *x = (pm_ida_bracket){.a = begin, .b = begin};
    for (int k = 0; k < HALVINGS; k++) {
        const double t = begin + ldexp(span, -1 - k), value = value_at(w, t, i);
        if (t <= begin) return;
        if (value > 0) {
            *x = (pm_ida_bracket){.a = t, .ga = value, .b = begin + ldexp(span, -k), .gb = g};
            return;
        }
        g = value;
    }
}

/* The first bracket of function i among the nodes; arms it if it has left zero for good. */
static int scan(pm_workspace *w, int i, const double *t, pm_ida_bracket *x)
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
            if (f->slack > 0 ? g[k + 1] > r->zero[i] : fabs(g[k + 1]) > r->zero[i])
                side = g[k + 1] > 0 ? 1 : -1;
            continue;
        }
        *x = (pm_ida_bracket){t[k], g[k], t[k + 1], g[k + 1]};
        if (crosses(f, g[k], g[k + 1]) || (may_turn(g, k) && dips(w, i, x))) return 1;
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
        t[k] = k == PM_NODES - 1 ? end : w->step.begin + (end - w->step.begin) * k / (PM_NODES - 1);
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
    const double same = SAME_TIME * (end - w->step.begin);
    double node[PM_NODES];
    int status = sample(w, end, node);
    for (int i = 0; i < e->nfunction && !status; i++) {
        pm_ida_bracket b;
        if (!x->suspect[i] || !scan(w, i, node, &b)) continue;
        double root = b.a;
        pm_search search = {i, 0};
        if (b.b > b.a)
            status =
                pm_fail_search(w, pm_bracket_find(e->solver, along, w, &search, b.a, b.ga, b.b, b.gb, &root));
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
    const int status = values_inside(w, t + SAME_TIME * (t - w->step.begin), x->latest);
    for (int i = 0; i < e->nfunction && !status; i++)
        if (x->side[i] && crosses(&e->function[i], x->node[i], x->latest[i])) e->root[i] = 1;
    return status;
}

static int roots_of_ida(pm_workspace *w)
{
    pm_ida_roots *x = w->ida->roots;
    const int flag = IDAGetRootInfo(w->ida->memory, x->info);
    if (flag != IDA_SUCCESS) return pm_fail(w, PM_SOLVER, PM_NONE, PM_NONE, flag, 0);
    for (int i = 0; i < w->event->nfunction; i++) w->event->root[i] |= x->info[i] != 0;
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
    const double end = *t, step = end - w->step.begin;
    double first = INFINITY;
    int any = 0, status = PM_OK;
    if (n == 0) return PM_OK;
    for (int i = 0; i < n; i++) w->event->function[i].side = x->side[i];
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
