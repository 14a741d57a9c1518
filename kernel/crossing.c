/* crossing.c - finds and locates the zeros of the functions of a phase.
 *
 * Every function is sampled at the nodes of each step.  A change of sign between two nodes, or a dip between three that
 * goes through zero, is bracketed, located on the route's dense output, and then polished on exact states, so that an
 * event is as accurate as the trajectory and never only as good as an interpolant. */
#include "crossing.h"

#include <math.h>

#include "ask.h"
#include "body.h"
#include "capture.h"
#include "contact.h"
#include "decision.h"
#include "error.h"
#include "root.h"
#include "route.h"
#include "saddle.h"
#include "sample.h"
#include "series.h"

#define ON_ZERO 1e-12  /* of a function's greatest size in the step: zero when the phase begins */
#define RATE_STEP 1e-4 /* of the step: distance of the differences that make a rate */
#define NEAR 0.3       /* of a function's greatest size in the step: below it there may be a dip to zero */
#define FAR 0.5        /* of a function's greatest size in the step: above it there is none */
#define CLOSE 0.1      /* of the values beside it: a dip that is worth a closer look */
#define DIP_STEP 1e-3  /* of the nodes' distance: distance of the differences at the bottom of a dip */
#define DIP_STEPS 3    /* of Newton's method to the bottom */
#define RESOLVED 1e-6  /* highest coefficients of a function that its samples tell */
#define SMOOTH 1e-3    /* the same of one that has no waves between the nodes */
#define UNTOLD 10.0    /* times these: how far it may be from the polynomial */
#define PASSES 1e-5    /* of the scene's size: two points farther apart where they are nearest do not meet */
#define ROUNDING 1e-15 /* of the step */
#define TOLD 1e-14     /* the same of the polynomial through samples that tell a function to rounding */
#define OFF 1e-9       /* of a function's values next to its zero: not on it */
#define HALVINGS 30    /* of a step, to find the top of a short bounce */
#define LEAVING \
    20 /* halvings of a step: a trigger has left its zero at the first place where it is seen off it */

/* A route that finds roots itself knows on which side its functions are. */
static void note_sides(pm_workspace *w)
{
    pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        if (f->owned) continue;
        const double x = pm_event_of_sample(f, e->value[i]);
        f->side = f->held ? 0 : (x > 0) - (x < 0);
    }
}

double pm_crossing_node(const pm_workspace *w, int node)
{
    const pm_nodes *nodes = w->nodes;
    return node == nodes->n - 1 ? w->sampled_end
                                : w->step_begin + (w->sampled_end - w->step_begin) * nodes->at[node];
}

static int is_quiet(const pm_workspace *w, const pm_event_function *f)
{
    return f->kind == FUNCTION_GAP && w->event->clear.quiet[f->index];
}

/* As pm_event_sample has it; where the circle is beside the row is kept: sample_member may need it. */
static double sample_row(pm_workspace *w, const pm_event_function *f, int node)
{
    pm_beside *x = w->event->beside + f->row * PM_NODES_MOST + node;
    int member;
    *x = pm_contact_beside(w, f->index);
    const double gap = pm_contact_nearest_beside(w, &w->state, f->index, x, &member);
    return isinf(gap) ? w->size : gap;
}

/* The functions of contacts and grips that are sampled, but for contacts out of reach, at a node of the step; the frame
 * looks there. */
static void sample_contacts(pm_workspace *w, int node)
{
    pm_event_set *e = w->event;
    double *value = e->value + node * e->nfunction;
    for (int i = e->ntrigger; i < e->nfunction; i++) {
        const pm_event_function *f = &e->function[i];
        if (f->owned || is_quiet(w, f)) continue;
        value[i] = f->row == PM_NONE ? pm_event_sample(w, f) : sample_row(w, f, node);
    }
}

/* The triggers that are sampled, at all nodes, which have been read. */
static void sample_triggers(pm_workspace *w)
{
    pm_event_set *e = w->event;
    double value[PM_NODES_MOST];
    for (int i = 0; i < e->ntrigger; i++) {
        const pm_event_function *f = &e->function[i];
        if (f->owned) continue;
        pm_sample_run(w, PM_TRIGGER_ROW(w->model, f->index)[PM_TRIGGER_PROGRAM], value);
        double least = e->least[f->index], greatest = e->greatest[f->index];
        for (int k = 0; k < w->nodes->n; k++) {
            e->value[k * e->nfunction + i] = value[k];
            if (value[k] < least) least = value[k];
            if (value[k] > greatest) greatest = value[k];
        }
        e->least[f->index] = least;
        e->greatest[f->index] = greatest;
    }
}

/* The step came closer to contacts than was expected: they are looked at, too. */
static int sample_reached(pm_workspace *w)
{
    for (int k = 0; k < w->nodes->n; k++) {
        const int status = pm_route_look(w, pm_crossing_node(w, k), w->event->level);
        if (status) return status;
        sample_contacts(w, k);
    }
    return PM_OK;
}

/* How far the contacts that were looked at are: some can be left alone in the next steps. */
static void keep_gaps(pm_workspace *w)
{
    const pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++)
        if (e->function[i].kind == FUNCTION_GAP && !e->function[i].owned && !is_quiet(w, &e->function[i]))
            pm_clear_keep(w, e->function[i].index, e->value[i]);
}

/* Nothing is known of the step's zeros yet. */
static void begin_samples(pm_workspace *w)
{
    pm_event_set *e = w->event;
    for (int k = 0; k < w->nodes->n; k++) e->place[k] = pm_crossing_node(w, k);
    for (int i = 0; i < e->nfunction; i++) {
        e->function[i].search = SEARCH_NONE;
        e->function[i].tail = -1;
    }
    pm_clear_step(w);
}

int pm_crossing_sample(pm_workspace *w, int with_functions)
{
    pm_event_set *e = w->event;
    const int functions = with_functions && e->nsampled > 0;
    const int watched = w->ask->nobserver > 0;
    w->sampled_end = w->step_end;
    if (!functions && !watched) return PM_OK;
    int level = PM_LEVEL_KINEMATIC;
    if (functions && e->level > level) level = e->level;
    if (watched && w->ask->level > level) level = w->ask->level;
    const int who = (functions ? PM_SAMPLE_TRIGGERS : 0) | (watched ? PM_SAMPLE_ASKS : 0);
    if (functions) begin_samples(w);
    for (int k = 0; k < w->nodes->n; k++) {
        const int status = pm_route_look(w, pm_crossing_node(w, k), level);
        if (status) return status;
        if (functions) {
            pm_clear_node(w, k);
            sample_contacts(w, k);
        }
        pm_sample_read(w, k, who);
    }
    if (watched) pm_ask_sample(w);
    if (!functions) return PM_OK;
    sample_triggers(w);
    const int status = pm_clear_check(w) ? sample_reached(w) : PM_OK;
    keep_gaps(w);
    note_sides(w);
    return status;
}

static double along(pm_workspace *w, double x, void *context)
{
    const pm_event_function *f = context;
    if (pm_route_look(w, x, f->level)) return NAN;
    return pm_event_value(w, f);
}

/* The course of a function in the step. */
typedef struct pm_course {
    double g[PM_NODES_MOST];
    double biggest, low, high; /* of their sizes; of them */
    int n;
} pm_course;

static void take_samples(const pm_workspace *w, int i, pm_course *x)
{
    const pm_event_set *e = w->event;
    const double *value = e->value + i;
    x->n = w->nodes->n;
    x->low = INFINITY;
    x->high = -INFINITY;
    for (int k = 0; k < x->n; k++, value += e->nfunction) {
        x->g[k] = pm_event_of_sample(&e->function[i], *value);
        if (x->g[k] < x->low) x->low = x->g[k];
        if (x->g[k] > x->high) x->high = x->g[k];
    }
    x->biggest = x->high > -x->low ? x->high : -x->low;
}

/* How far the samples x of function i do not tell it. */
static double tail_of(const pm_workspace *w, int i, const pm_course *x)
{
    pm_event_function *f = &w->event->function[i];
    if (!pm_nodes_spectral(w->nodes)) return INFINITY;
    if (f->tail < 0) {
        f->tail = pm_series_tail(w->nodes, x->g);
        f->biggest = x->biggest;
    }
    return f->tail;
}

/* The nodes of a spectral route resolve the function, unless it has a corner (the nearest of several members). */
int pm_crossing_resolves(const pm_workspace *w, int i)
{
    const pm_event_function *f = &w->event->function[i];
    if (f->tail >= 0 || !pm_nodes_spectral(w->nodes)) return f->tail >= 0 && f->tail < RESOLVED;
    pm_course x;
    take_samples(w, i, &x);
    return tail_of(w, i, &x) < RESOLVED;
}

/* Sign with which a function enters the interval after a node: a held zero has none yet. */
static int crosses(const pm_event_function *f, double a, double b)
{
    if (isnan(a) || isnan(b)) return 0;
    if (f->direction <= 0 && a > 0 && b <= 0) return 1;
    if (f->direction >= 0 && a < 0 && b >= 0) return 1;
    return 0;
}

/* From near the bottom of a dip to it, by Newton's method on differences; s is the side of zero. */
static double bottom(pm_workspace *w, pm_event_function *f, double s, double low, double high, double *where)
{
    const double d = DIP_STEP * (high - low);
    double value = s * along(w, *where, f);
    for (int i = 0; i < DIP_STEPS && value > 0; i++) {
        const double a = s * along(w, *where - d, f), b = s * along(w, *where + d, f),
                     bend = a - 2 * value + b;
        if (!(bend > 0)) break;
        const double next = fmin(fmax(*where + 0.5 * d * (a - b) / bend, low), high),
                     there = s * along(w, next, f);
        if (!(there < value)) break;
        *where = next;
        value = there;
    }
    return value;
}

/* A function that came close to zero at `where` goes through it there, or has turned back: a decision to be noted. */
static int reaches(pm_workspace *w, pm_event_function *f, double s, double around, double low, double high,
                   double *where, double *value)
{
    const double least = bottom(w, f, s, low, high, where);
    *value = s * least;
    if (least > 0 && least < f->near && f->kind != FUNCTION_MEETING) {
        f->near = least;
        f->near_reach = around;
    }
    return least <= 0;
}

static int may_cross(const pm_event_function *f, double s)
{
    return !(f->direction > 0 && s > 0) && !(f->direction < 0 && s < 0);
}

/* A dip of three nodes towards zero: the vertex of their parabola, if the function goes through zero there. */
static int dips(pm_workspace *w, pm_event_function *f, const double *g, double biggest, const double *x,
                double *where, double *value)
{
    if (fabs(g[1]) > FAR * biggest) return 0;
    const double s = g[1] > 0 ? 1 : -1, a = s * g[0], b = s * g[1], c = s * g[2];
    if (!(b < a && b < c) || !(a > 0 && b > 0 && c > 0) || !may_cross(f, s)) return 0;
    const double left = (a - b) / (x[1] - x[0]), right = (c - b) / (x[2] - x[1]);
    const double bend = (left + right) / (x[2] - x[0]);
    const double slope = (right * (x[1] - x[0]) - left * (x[2] - x[1])) / (x[2] - x[0]);
    if (b - slope * slope / (4 * bend) > CLOSE * b) return 0;
    *where = x[1] - slope / (2 * bend);
    return reaches(w, f, s, fmax(a, c), x[0], x[2], where, value);
}

/* Slope at a node of the polynomial through the values there. */
static double slope_at(const pm_workspace *w, const double *g, int k)
{
    return pm_series_slope_at(w->nodes, g, k) / (w->step_end - w->step_begin);
}

/* A dip between node k and the next, told by the slopes there: also one beside an end of the step, where three nodes do
 * not show it.  The bottom of the cubic through both values and slopes. */
static int turns(pm_workspace *w, pm_event_function *f, const double *g, int k, const double *x,
                 double *where, double *value)
{
    const double s = g[k] > 0 ? 1 : -1, a = s * g[k], b = s * g[k + 1], h = x[1] - x[0];
    if (!(a > 0 && b > 0) || !may_cross(f, s)) return 0;
    const double p = s * slope_at(w, g, k) * h;
    if (!(p < 0)) return 0;
    const double q = s * slope_at(w, g, k + 1) * h;
    if (!(q > 0)) return 0;
    const double c2 = 3 * (b - a) - 2 * p - q, c3 = 2 * (a - b) + p + q;
    const double t = -p / (c2 + sqrt(fmax(c2 * c2 - 3 * c3 * p, 0)));
    if (!(t > 0 && t < 1) || a + t * (p + t * (c2 + t * c3)) > CLOSE * fmin(a, b)) return 0;
    *where = x[0] + t * h;
    return reaches(w, f, s, fmax(a, b), x[0], x[1], where, value);
}

/* A function held at zero is negative at b: it has gone up and come back (a short bounce), or it went the wrong way at
 * once and the event is now. */
static int leaves_and_returns(pm_workspace *w, const pm_event_function *f, double a, double b, double gb,
                              pm_span *x)
{
    *x = (pm_span){a, a, 0, 0};
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (a + b), g = along(w, middle, (void *)(uintptr_t)f);
        if (middle <= a) break;
        if (g > 0) {
            *x = (pm_span){middle, b, g, gb};
            break;
        }
        b = middle;
        gb = g;
    }
    if (f->kind == FUNCTION_GAP && x->a == x->b) w->event->spent[f->index] = 1;
    return 1;
}

/* A trigger that was on zero at a: where it has definitely left tells its side; it may have come back before b.  The
 * samples tell that where they resolve it, as far as it is beyond their error. */
static int leaves_and_crosses(pm_workspace *w, int i, const pm_course *of, double a, double b, double gb,
                              double noise, pm_span *x)
{
    pm_event_function *f = &w->event->function[i];
    const double begin = w->step_begin, h = w->step_end - begin;
    const int resolved = tail_of(w, i, of) < RESOLVED;
    for (int k = LEAVING; k > 0; k--) {
        const double place = a + ldexp(b - a, -k);
        if (place <= a) continue;
        double g = resolved ? pm_series_value(w->nodes, of->g, 1, (place - begin) / h) : 0;
        if (!(fabs(g) > fmax(noise, UNTOLD * f->tail * of->biggest))) g = along(w, place, f);
        if (!(fabs(g) > noise)) continue;
        *x = (pm_span){place, b, g, gb};
        return crosses(f, g, gb);
    }
    return 0;
}

/* All samples are on one side: where the function may not cross from there, or where it stays so far from zero that no
 * parabola of three nodes (of which one interval is at most three times the other) comes near to it. */
static int stays_away(const pm_event_function *f, const pm_course *x)
{
    const double least = x->low > 0 ? x->low : -x->high;
    return least > (may_cross(f, x->low > 0 ? 1 : -1) ? FAR * x->biggest : 0);
}

/* A dip between node k and the next shows at one of them, unless the function is not smooth: it is lower there than beside
 * it, or at an end of the step. */
static int shows_dip(const pm_course *x, int k)
{
    const double *g = x->g, a = fabs(g[k]), b = fabs(g[k + 1]);
    return b < a ? k + 2 >= x->n || !(fabs(g[k + 2]) < b) : k == 0 || !(fabs(g[k - 1]) < a);
}

/* The first bracket of function i in the step after `from`, if any. */
static int bracket(pm_workspace *w, int i, double from, pm_span *x)
{
    pm_event_set *e = w->event;
    pm_event_function *f = &e->function[i];
    const int n = w->nodes->n;
    const double *place = e->place;
    pm_course of;
    take_samples(w, i, &of);
    double *g = of.g, biggest = of.biggest;
    int first = 0;
    if (e->at_root && fabs(g[n - 1]) <= ON_ZERO * biggest) g[n - 1] = 0; /* there the phase ends */
    while (first + 1 < n && place[first + 1] <= from) first++;
    if (first == n - 1) return 0;
    const int changes_sign = pm_event_changes_sign(f);
    if (e->first_step && from == place[0] && changes_sign && fabs(g[0]) <= ON_ZERO * biggest) {
        f->held = 1;
        f->since = from;
    }
    if (f->held && changes_sign) { /* enters on the side where it goes */
        const double since = fmax(f->since, place[0]);
        while (first < n - 1 && place[first] <= since) first++;
        if (leaves_and_crosses(w, i, &of, since, place[first], g[first], ON_ZERO * biggest, x)) return 1;
    } else if (
        f->held) { /* a contact starts on the open side, and counts again from where it has left its zero */
        for (first = 1; first < n && fabs(g[first]) <= f->slack;) first++;
        if (first == n) return 0;
        if (g[first] < 0) return leaves_and_returns(w, f, place[first - 1], place[first], g[first], x);
    } else if (!changes_sign && g[0] <= 0) { /* the last step ended on its zero */
        *x = (pm_span){place[0], place[0], 0, 0};
        return 1;
    }
    if (stays_away(f, &of)) return 0;
    const double close = NEAR * biggest;
    for (int k = first; k + 1 < n; k++) {
        const int near = fabs(g[k]) < close || fabs(g[k + 1]) < close, dip = shows_dip(&of, k);
        if (g[k] * g[k + 1] > 0 && !dip && !(near && tail_of(w, i, &of) >= SMOOTH)) continue;
        double where, value;
        if (crosses(f, g[k], g[k + 1])) {
            *x = (pm_span){place[k], place[k + 1], g[k], g[k + 1]};
            return 1;
        }
        const int turned = near && turns(w, f, g, k, place + k, &where, &value);
        if ((turned || (k + 2 < n && dips(w, f, g + k, biggest, place + k, &where, &value))) &&
            where > from) {
            *x = (pm_span){place[k], where, g[k], value};
            return 1;
        }
    }
    return 0;
}

static int exactly(pm_workspace *w, double x, void *context, double *value)
{
    const pm_event_function *f = context;
    const pm_state *s = &w->probe;
    int status = w->route->exact(w, x, &w->probe);
    if (status) return status;
    pm_frame_look(w, s->t, s->q, s->v, s->z, w->state.memory);
    if (f->level == PM_LEVEL_DYNAMIC) status = pm_saddle_accelerate(w);
    *value = pm_event_value(w, f);
    return status;
}

static double slope_of_samples(const pm_workspace *w, int i, double place)
{
    const double h = w->step_end - w->step_begin;
    double here;
    pm_course x;
    take_samples(w, i, &x);
    return pm_series_slope(w->nodes, x.g, (place - w->step_begin) / h, &here) / h;
}

/* The member that is met at x, of those that are open; 0 if there is none. */
static int member_at(pm_workspace *w, const pm_event_function *f, double x, int *member)
{
    const pm_event_set *e = w->event;
    for (int k = 0; k < w->nodes->n; k++)
        if (e->place[k] == x)
            return !isinf(pm_contact_nearest_beside(w, &w->state, f->index,
                                                    e->beside + f->row * PM_NODES_MOST + k, member));
    return !pm_route_look(w, x, PM_LEVEL_KINEMATIC) && !isinf(pm_contact_gap(w, &w->state, f->index, member));
}

/* The gap to the nearest member of a row has corners, that to one member has none: from now on the samples are those of
 * the member that is met at x.  Whether it is the nearest at the root is seen there (polish). */
static void sample_member(pm_workspace *w, int i, double x)
{
    pm_event_set *e = w->event;
    pm_event_function *f = &e->function[i];
    int member;
    if (f->row == PM_NONE || !pm_nodes_spectral(w->nodes) || !member_at(w, f, x, &member)) return;
    for (int k = 0; k < w->nodes->n; k++)
        e->value[k * e->nfunction + i] =
            pm_contact_gap_beside(e->beside + f->row * PM_NODES_MOST + k, member);
    f->tail = -1;
}

/* How fast the function goes through its zero: a decision, for it might not have reached it.  slope: of the polynomial
 * there, if its samples tell it. */
static void take_rate(pm_workspace *w, int function, double x, double slope)
{
    if (!w->error->active) return;
    pm_event_function *f = &w->event->function[function];
    const double d = RATE_STEP * (w->step_end - w->step_begin);
    pm_decision_rate(w, function, isnan(slope) ? (along(w, x + d, f) - along(w, x - d, f)) / (2 * d) : slope);
}

/* The polynomial through the samples, and its slope where it was read last. */
typedef struct pm_polynomial {
    const pm_nodes *nodes;
    const double *g;
    double slope;
} pm_polynomial;

static double polynomial_at(pm_workspace *w, double s, void *context, double *slope)
{
    pm_polynomial *p = context;
    double here;
    (void)w;
    *slope = p->slope = pm_series_slope(p->nodes, p->g, s, &here);
    return here;
}

/* Where it has its root, and its slope there. */
static int root_of_samples(pm_workspace *w, int i, const pm_span *x, double *place)
{
    const double begin = w->step_begin, h = w->step_end - begin;
    double s;
    pm_course of;
    take_samples(w, i, &of);
    pm_polynomial p = {w->nodes, of.g, NAN};
    const int status =
        pm_root_newton(w, polynomial_at, &p, (x->a - begin) / h, x->ga, (x->b - begin) / h, x->gb, &s);
    *place = begin + s * h;
    w->event->function[i].slope = p.slope / h;
    return status;
}

static int root_in(pm_workspace *w, int i, const pm_span *x, double *place)
{
    pm_event_set *e = w->event;
    *place = x->a;
    e->function[i].slope = NAN;
    if (!(x->b > x->a)) return PM_OK;
    if (!pm_crossing_resolves(w, i)) sample_member(w, i, x->b);
    if (pm_crossing_resolves(w, i)) return root_of_samples(w, i, x, place);
    return pm_root_find(w, e->solver, along, &e->function[i], x->a, x->ga, x->b, x->gb, place);
}

/* Where what the route looks at is exact, one step of Newton's method from the root of the polynomial leads to the zero
 * itself, but for the error of the slope: *near, if that is nothing. */
static int step_onto(pm_workspace *w, int i, double slope, double size, double *place, int *near)
{
    pm_event_function *f = &w->event->function[i];
    const double h = w->step_end - w->step_begin, n = w->nodes->n, value = along(w, *place, f);
    const double shift = -value / slope, next = *place + shift;
    const double error = n * n * fmax(f->tail, ROUNDING) * f->biggest / fabs(slope * h); /* of the slope */
    *near = fabs(value) <= OFF * size && next > w->step_begin && next < w->step_end &&
            fabs(shift) * (error + n * n * fabs(shift) / h) <= ROUNDING * h;
    if (*near) *place = next;
    return isnan(value) ? PM_SOLVER : PM_OK;
}

/* The samples tell where a trigger is zero as well as any look would.  (What closes a gap is met to the last bit.) */
static int is_told(const pm_workspace *w, const pm_event_function *f, double slope)
{
    const double h = w->step_end - w->step_begin;
    return f->kind == FUNCTION_TRIGGER && w->route->look &&
           UNTOLD * f->tail * f->biggest <= TOLD * fabs(slope * h);
}

/* A function with a corner is no polynomial: where the polished place is not on its zero it is looked for once more. */
static int polish(pm_workspace *w, int i, const pm_span *x, double slope, double *first, double *taken)
{
    pm_event_function *f = &w->event->function[i];
    const int spectral = !isnan(slope);
    const double size = fmax(fabs(x->ga), fabs(x->gb));
    double off;
    int near = spectral && is_told(w, f, slope), status = PM_OK;
    if (spectral && w->route->look && !near) status = step_onto(w, i, slope, size, first, &near);
    if (near) {
        *taken = *first;
        return status ? status : w->route->exact(w, *first, &w->probe);
    }
    if (!status) status = pm_root_polish(w, along, exactly, f, slope, first, taken, &off);
    if (status || !(fabs(off) > OFF * size) || !spectral) return status;
    status = pm_root_find(w, w->event->solver, along, f, x->a, x->ga, x->b, x->gb, first);
    return status ? status : pm_root_polish(w, along, exactly, f, NAN, first, taken, &off);
}

/* Two points go by each other at a distance: nothing happens. */
static int goes_by(pm_workspace *w, int i, double place)
{
    pm_event_function *f = &w->event->function[i];
    if (f->kind != FUNCTION_MEETING) return 0;
    along(w, place, f);
    return pm_capture_distance(w, f->index) > PASSES * w->size;
}

/* The first place of the step, after `from`, where something happens to function i; *x brackets it; or INFINITY.  What
 * was found from an earlier place on still holds, as long as the function has not fired. */
static int first_of(pm_workspace *w, int i, double from, double not_after, pm_span *x, double *place)
{
    pm_event_function *f = &w->event->function[i];
    *place = INFINITY;
    for (;;) {
        if (f->search == SEARCH_NONE)
            f->search = bracket(w, i, from, &f->bracket) ? SEARCH_BRACKETED : SEARCH_NO_ZERO;
        if (f->search == SEARCH_NO_ZERO || f->bracket.a > not_after) return PM_OK;
        *x = f->bracket;
        if (f->search == SEARCH_BRACKETED) {
            const int status = root_in(w, i, x, &f->found);
            if (status) return status;
            f->search = SEARCH_LOCATED;
        }
        if (!goes_by(w, i, f->found)) break;
        f->held = 1; /* as what has fired: it must be left first */
        f->since = from = f->found;
        f->search = SEARCH_NONE;
    }
    *place = f->found;
    return PM_OK;
}

int pm_crossing_first(pm_workspace *w, double from, double *first, double *taken)
{
    pm_event_set *e = w->event;
    const double same = PM_SAME_PLACE * (w->step_end - w->step_begin);
    pm_span x = {0, 0, 0, 0}, of_first = x;
    int earliest = PM_NONE;
    *first = INFINITY;
    for (int i = 0; i < e->nfunction; i++) {
        e->hit[i] = 0;
        if (e->function[i].owned || is_quiet(w, &e->function[i])) continue;
        double place;
        const int status = first_of(w, i, from, *first, &x, &place);
        if (status) return status;
        if (place == INFINITY) continue;
        if (place < *first - same)
            for (int k = 0; k < i; k++) e->hit[k] = 0;
        if (place > *first + same) continue;
        e->hit[i] = 1;
        e->function[i].located = place;
        if (place < *first) {
            *first = place;
            earliest = i;
            of_first = x;
        }
    }
    if (earliest == PM_NONE || *first <= w->step_begin) return PM_OK;
    const int at_end = *first >= w->step_end && of_first.gb == 0; /* exactly there: nothing to polish */
    if (at_end && !w->error->active) return PM_OK;
    double slope = NAN;
    if (pm_crossing_resolves(w, earliest)) slope = e->function[earliest].slope;
    if (pm_crossing_resolves(w, earliest) && isnan(slope)) slope = slope_of_samples(w, earliest, *first);
    if (!at_end || !w->turns) take_rate(w, earliest, *first, slope);
    if (at_end) return PM_OK;
    return polish(w, earliest, &of_first, slope, first, taken);
}

void pm_crossing_leave(pm_workspace *w)
{
    pm_event_set *e = w->event;
    const double *last = e->value + (w->nodes->n - 1) * e->nfunction;
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        if (f->owned || is_quiet(w, f)) continue;
        if (fabs(pm_event_of_sample(f, last[i])) > f->slack) f->held = 0;
        f->since = 0;
    }
}
