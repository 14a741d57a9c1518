/* path_step.c - one step of the path: its places, T there, and whether such a step can be taken.
 *
 * A step is tried at 9 nodes, and at 17 where these do not resolve what is made of them; it is halved where those do not
 * either.  It ends where T vanishes: there the motion reverses. */
#include <float.h>
#include <math.h>

#include "expression/program_class.h"
#include "numerics/bracket.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "state/workspace.h"

/* ---- places ---- */
/* From one node to the next, in the arrays of places. */
static int stride_of(const pm_path *p, const double *first, const double *second)
{
    return p->every * (int)(second - first);
}

/* A guess of the coordinates at node k: the cubic through the two nodes before it and their slopes, or the tangent. */
static void guess_node(pm_path *p, int k, double *y)
{
    const double *at = p->nodes->at;
    const pm_place *b = pm_path_node(p, k - 1);
    const double step = p->sense * p->h * (at[k] - at[k - 1]);
    if (k == 1) {
        for (int i = 0; i < p->n; i++) y[i] = b->y[i] + step * b->slope[i];
        return;
    }
    const pm_place *a = pm_path_node(p, k - 2);
    const double width = p->sense * p->h * (at[k - 1] - at[k - 2]), x = step / width;
    for (int i = 0; i < p->n; i++) {
        const double rise = (b->y[i] - a->y[i]) / width, da = a->slope[i] - rise, db = b->slope[i] - rise;
        y[i] = b->y[i] + step * (b->slope[i] + x * (da + 2 * db + x * (da + db)));
    }
}

/* The running integrals at the fraction s of the step: works go by the way of the driver, distances by its length. */
void pm_path_integrals(const pm_model *model, const pm_path *p, double s, double *z)
{
    const int stride = stride_of(p, p->node[0].rate, p->node[1].rate);
    for (int i = 0; i < model->nz_controlled; i++) {
        const double way = i < model->nz_work ? p->sense * p->h : p->h;
        z[i] = p->weight[i] + way * pm_chebyshev_integral(p->nodes, p->node[0].rate + i, stride, s);
    }
}

double pm_path_work(const pm_model *model, const double *z)
{
    double sum = 0;
    for (int i = 0; i < model->rows[PM_TABLE_FORCE]; i++)
        if (model->force_z[i] != PM_NONE) sum += z[model->force_z[i]];
    return sum;
}

static int rates_resolved(const pm_model *model, const pm_path *p)
{
    double value[PM_NODES_MOST];
    for (int i = 0; i < model->nz_controlled; i++) {
        for (int k = 0; k < p->nodes->n; k++) value[k] = p->node[k * p->every].rate[i];
        if (pm_chebyshev_tail(p->nodes, value) > PM_WORK_TAIL) return 0;
    }
    return 1;
}

/* Where T is least between the nodes is found by a polynomial.  The mass is computed at each place; only the clock takes it
 * from a polynomial, and looks to that itself. */
static int motion_resolved(const pm_path *p)
{
    double kinetic[PM_NODES_MOST];
    for (int k = 0; k < p->nodes->n; k++) kinetic[k] = p->node[k * p->every].kinetic;
    return pm_chebyshev_tail(p->nodes, kinetic) <= PM_PATH_FORM_TAIL;
}

/* A trigger that depends on the speed as such, and may fire wherever that is. */
static int watches_speed(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        if (e[PM_TRIGGER_KIND] > PM_TRIGGER_EVERY) continue;
        const int growth = m->programs.energy[e[PM_TRIGGER_PROGRAM]];
        if (growth > PM_ENERGY_CLASS_ROOT ||
            (growth == PM_ENERGY_CLASS_ROOT && e[PM_TRIGGER_KIND] == PM_TRIGGER_EVERY))
            return 1;
    }
    return 0;
}

/* The root of T is no polynomial where T comes near to zero: over a barrier it may be much less between the nodes than at
 * them. */
static int speed_resolved(const pm_path *p)
{
    double speed[PM_NODES_MOST];
    for (int k = 0; k < p->nodes->n; k++) {
        const pm_place *x = &p->node[k * p->every];
        if (!(x->kinetic > 0)) return 1; /* it reverses there */
        speed[k] = sqrt(x->kinetic / x->mass);
    }
    return pm_chebyshev_tail(p->nodes, speed) <= PM_PATH_SPEED_TAIL;
}

/* By the energy. */
static double kinetic_at(const pm_model *model, pm_path *p, const pm_place *x, double s)
{
    if (model->nz_work == 0) return p->energy - x->potential;
    pm_path_integrals(model, p, s, p->work);
    return p->energy - x->potential + pm_path_work(model, p->work);
}

/* Small differences of large potentials are lost in their rounding; the work over a short way is not, where the nodes
 * resolve the forces. */
static int work_is_better(const pm_path *p)
{
    const double rounding = DBL_EPSILON * pm_max(fabs(p->energy), fabs(p->node[0].potential));
    return pm_chebyshev_high(p->nodes, p->force) * p->h <= rounding;
}

/* Forces and T at the nodes, whose places are known. */
static void set_kinetics(const pm_model *model, pm_path *p)
{
    const int n = p->nodes->n;
    double work[PM_NODES_MOST];
    for (int k = 0; k < n; k++) p->force[k] = p->sense * pm_path_node(p, k)->force;
    p->by_work = work_is_better(p);
    if (!p->by_work) {
        for (int k = 1; k < n; k++)
            pm_path_node(p, k)->kinetic = kinetic_at(model, p, pm_path_node(p, k), p->nodes->at[k]);
        return;
    }
    pm_chebyshev_integrals(p->nodes, p->force, work);
    for (int k = 1; k < n; k++) pm_path_node(p, k)->kinetic = p->node[0].kinetic + p->h * work[k];
}

/* The nodes of a step of length h from node 0: every second one. */
static int fill(pm_workspace *w, double h)
{
    pm_path *p = w->path;
    p->h = h;
    p->nodes = &pm_chebyshev_nodes_9;
    p->every = 2;
    for (int k = 1; k < p->nodes->n; k++) {
        pm_place *x = pm_path_node(p, k);
        if (p->n > 1) guess_node(p, k, x->y);
        const int status = pm_path_place(w, p->u0 + p->sense * (h * p->nodes->at[k]), x);
        if (status) return status;
    }
    set_kinetics(w->model, w->path);
    return PM_OK;
}

/* The others. */
static int fill_between(pm_workspace *w)
{
    pm_path *p = w->path;
    const double *at = pm_chebyshev_nodes_17.at;
    const int stride = stride_of(p, p->node[0].y, p->node[1].y);
    for (int k = 1; k < pm_chebyshev_nodes_17.n; k += 2) {
        pm_place *x = &p->node[k];
        for (int i = 0; i < p->n; i++)
            if (i != p->driver) x->y[i] = pm_chebyshev_value(p->nodes, p->node[0].y + i, stride, at[k]);
        const int status = pm_path_place(w, p->u0 + p->sense * (p->h * at[k]), x);
        if (status) return status;
    }
    p->nodes = &pm_chebyshev_nodes_17;
    p->every = 1;
    set_kinetics(w->model, w->path);
    return PM_OK;
}

/* The place at the fraction s of the filled step, in p->spare. */
int pm_path_inside(pm_workspace *w, double s)
{
    pm_path *p = w->path;
    const int stride = stride_of(p, p->node[0].y, p->node[1].y);
    for (int k = 0; k < p->n; k++)
        if (k != p->driver) p->spare.y[k] = pm_chebyshev_value(p->nodes, p->node[0].y + k, stride, s);
    const int status = pm_path_place(w, p->u0 + p->sense * p->h * s, &p->spare);
    if (status) return status;
    if (p->by_work) {
        double kinetic[PM_NODES_MOST];
        for (int k = 0; k < p->nodes->n; k++) kinetic[k] = pm_path_node(p, k)->kinetic;
        p->spare.kinetic = pm_chebyshev_value(p->nodes, kinetic, 1, s);
    } else {
        p->spare.kinetic = kinetic_at(w->model, w->path, &p->spare, s);
    }
    return PM_OK;
}

/* T on the exact place at the fraction s of the filled step; its slope is the force. */
static double exact_kinetic(void *of, double s, void *context, double *slope)
{
    pm_workspace *w = of;
    const pm_path *p = w->path;
    (void)context;
    if (pm_path_inside(w, s)) return NAN;
    *slope = p->h * p->sense * p->spare.force;
    return p->spare.kinetic;
}

/* The motion comes to rest at the end of the step, as far as rounding tells: the next step could not begin there. */
static int ends_at_rest(const pm_path *p)
{
    const pm_place *end = &p->node[PM_NODES_MOST - 1];
    return end->force * p->sense < 0 && end->kinetic <= pm_path_error_after(p, end->kinetic);
}

/* From rest, and back to rest before the first node: it is pushed off, and at the node back. */
static int turns_before(const pm_path *p, int k) { return p->force[0] > 0 && p->force[k] < 0; }

/* The way to the first place of the step where T vanishes; INFINITY if there is none. */
static int find_reversal(pm_workspace *w, double *way)
{
    pm_path *p = w->path;
    const pm_chebyshev_nodes *nodes = p->nodes;
    double s, slope;
    p->least = *way = INFINITY;
    for (int k = 1; k < nodes->n; k++) {
        const double after = pm_path_node(p, k)->kinetic;
        double low = nodes->at[k], lowest = after;
        if (after > 0 && p->force[k - 1] < 0 && p->force[k] > 0) { /* a dip between the nodes */
            const int status = pm_fail_search(&w->result, pm_chebyshev_root(nodes, p->force, nodes->at[k - 1],
                                                                            p->force[k - 1], nodes->at[k],
                                                                            p->force[k], &low, &slope));
            if (status || (lowest = exact_kinetic(w, low, NULL, &slope), isnan(lowest))) return status;
            pm_path_error_barrier(&w->evidence, w->path, lowest);
        }
        p->least = pm_min(lowest, p->least);
        if (lowest > 0) continue;
        const double before = pm_path_node(p, k - 1)->kinetic;
        const int status =
            before > 0
                ? pm_fail_search(&w->result, pm_bracket_newton(exact_kinetic, w, NULL, nodes->at[k - 1],
                                                               before, low, lowest, &s))
                : PM_OK;
        *way = before > 0 ? s * p->h : turns_before(p, k) ? nodes->at[k] * p->h : 0;
        return status;
    }
    const pm_place *end = &p->node[PM_NODES_MOST - 1];
    if (!p->at_rest && ends_at_rest(p)) *way = p->h + end->kinetic / fabs(end->force);
    return PM_OK;
}

/* T vanishes at the end; where the work of the forces tells it, that is counted from there. */
static void end_at_rest(pm_path *p)
{
    const double left = p->node[PM_NODES_MOST - 1].kinetic;
    for (int k = 0; k < p->nodes->n && p->by_work; k++) pm_path_node(p, k)->kinetic -= left;
    p->node[PM_NODES_MOST - 1].kinetic = 0;
}

/* Half the step; more of it if the motion would come to rest right behind its end, so that this place is inside the next step
 * and not right behind all that follow, each half as long as the one before. */
static double shorter(const pm_path *p)
{
    const pm_place *end = &p->node[PM_NODES_MOST - 1];
    const int turns_soon = end->kinetic > 0 && end->force * p->sense < 0 &&
                           end->kinetic < PM_PATH_TURNS_SOON * fabs(end->force) * p->h;
    return (turns_soon ? PM_PATH_SHORT_OF_TURN : 0.5) * p->h;
}

/* Is the filled step one that can be taken?  *next is a shorter one to try instead, or 0. */
static int judge(pm_workspace *w, int reverses, double *next)
{
    pm_path *p = w->path;
    const int half = p->every > 1 || p->h > p->safe; /* else what is not smooth is sampled as it is */
    const double less = shorter(p);
    *next = 0;
    p->halved = 0;
    if ((w->model->nz_controlled > 0 && !rates_resolved(w->model, w->path)) || (half && !motion_resolved(p)))
        *next = less;
    if (!p->at_rest && !reverses && watches_speed(w->model) && !speed_resolved(p)) *next = less;
    if (reverses) {
        end_at_rest(p);
    } else if (*next == 0) {
        double way;
        const int status = find_reversal(w, &way);
        if (status) return status;
        if (way < INFINITY) *next = p->at_rest ? 0.5 * way : way; /* each root needs a step of its own */
    }
    p->halved = *next == less;
    if (*next > 0) return PM_OK;
    const int watched = w->model->programs.read_time || w->record.history;
    const int clock = !watched || p->balanced ? PM_CLOCK_NONE
                      : p->at_rest            ? PM_CLOCK_LEAVES
                      : reverses              ? PM_CLOCK_RESTS
                                              : PM_CLOCK_PLAIN;
    const double most = pm_max(PM_PATH_TIME_TAIL * w->numbers.tolerance, PM_CLOCK_TAIL);
    if (!pm_path_clock_set(p, clock, pm_min(most, PM_PATH_TIME_LOOSE))) {
        *next = less;
        p->halved = 1;
    }
    return PM_OK;
}

/* Tries a step of length h, with more nodes if few do not resolve it; *next as above. */
static int try_step(pm_workspace *w, double h, int reverses, double *next)
{
    pm_path *p = w->path;
    int status = p->filled ? PM_OK : fill(w, h);
    p->filled = 0;
    if (!status) status = judge(w, reverses, next);
    if (!status && p->halved && p->every > 1) {
        status = fill_between(w);
        if (!status) status = judge(w, reverses, next);
    }
    if (status != PM_SINGULAR && status != PM_ASSEMBLY) return status;
    *next = 0.5 * h;
    p->halved = 1;
    return PM_OK;
}

int pm_path_take_step(pm_workspace *w, double full)
{
    pm_path *p = w->path;
    double h = full, next, refused = INFINITY; /* the shortest step that was not resolved */
    int reverses = 0, halved = 0, parted = 0;
    p->clock.tail = p->clock.length = p->clock.longer = INFINITY;
    for (;;) {
        const int status = try_step(w, h, reverses, &next);
        if (status) return status;
        if (next == 0) break;
        reverses = !p->halved && !p->at_rest; /* not a halving: the way to a turning point */
        if (p->halved) refused = pm_min(h, refused);
        /* behind an end that is at rest but for rounding lies what was too long */
        if (reverses && next >= refused) next = h;
        if (reverses && w->numbers.coarse > 1 && !parted &&
            next > PM_PATH_PART * full) { /* other steps in a coarse run */
            next *= 0.5;
            reverses = 0;
            parted = 1;
        }
        halved |= p->halved;
        h = next;
        if (!(h > PM_PATH_SHORTEST * full))
            return pm_fail(&w->result, PM_STEP_TOO_SMALL, PM_NONE, PM_NONE, h, PM_PATH_SHORTEST * full);
    }
    if (halved)
        p->most = h;
    else if (p->every > 1)
        p->most *= PM_PATH_LENGTHEN;
    w->step.reverses = reverses;
    p->lowest = pm_min(reverses ? 0 : p->least, p->lowest);
    return PM_OK;
}
