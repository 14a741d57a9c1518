/* contact_springs.c - steps of Verlet's scheme, extrapolated in h^2 (Gragg, Bulirsch, Stoer), from one event to the next.
 *
 * Units: velocities of the greatest before the blow, responses of the greatest, stiffnesses of the greatest; time and x such
 * that nothing else is left.  Inside a step each contact stays compressed, released or open, so that its equations are
 * smooth; a step ends where that changes.  What changes and changes back inside a step shows in its slopes.
 * [E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, ch. II.9 and II.14] */
#include "impact/contact_springs.h"

#include <math.h>
#include <string.h>

#include "numerics/bracket.h"
#include "numerics/tolerances.h"
#include "planemotion.h"

enum { OPEN, LOADS, RELEASES };
/* Whose zero ends a step: the velocity of a contact, or its x where it is released. */
enum { VELOCITY, PLACE, KINDS };
#define COLUMNS PM_SPRINGS_COLUMNS

int pm_contact_springs_create(pm_contact_springs *x, pm_arena *arena, int most)
{
    const size_t n = most, two = 2 * n;
    const pm_array array[] = {
        PM_ARRAY(x->spring, n), PM_ARRAY(x->response, n * n), PM_ARRAY(x->now, n),
        PM_ARRAY(x->zero, two), PM_ARRAY(x->next, two),       PM_ARRAY(x->table, COLUMNS * two),
    };
    x->no_velocity = PM_COURSE_ROUNDING;
    x->tolerance = PM_SPRINGS_TOLERANCE;
    return pm_arena_take(arena, PM_ARRAYS(array));
}

/* ---- the equations; y: by how much x and P have grown since the step began ---- */
static double velocity(const pm_contact_springs *x, int i, const double *y)
{
    const double *p = y + x->n;
    double u = x->spring[i].start;
    for (int k = 0; k < x->n; k++) u += x->response[i * x->n + k] * p[k];
    return u;
}

/* Beyond the zero of x it goes on smoothly: a step may look there. */
static double force(const pm_contact_springs *x, int i, const double *y)
{
    const pm_contact_spring *c = &x->spring[i];
    if (c->phase == OPEN) return 0;
    const double place = x->now[i] + y[i];
    const double size = x->exponent == 1 ? fabs(place) : pow(fabs(place), x->exponent);
    return c->stiffness / x->stiffest * copysign(size, place);
}

static double rate_of_velocity(const pm_contact_springs *x, int i, const double *y)
{
    double a = 0;
    for (int k = 0; k < x->n; k++) a += x->response[i * x->n + k] * force(x, k, y);
    return a;
}

static double rate_of_place(const pm_contact_springs *x, int i, const double *y)
{
    const pm_contact_spring *c = &x->spring[i];
    if (c->phase == OPEN) return 0;
    const double faster = c->phase == RELEASES ? 1 / (c->restitution * c->restitution) : 1;
    return -velocity(x, i, y) * faster;
}

/* ---- a step ---- */
static void move_impulses(const pm_contact_springs *x, double *y, double h)
{
    for (int i = 0; i < x->n; i++) y[x->n + i] += h * force(x, i, y);
}

/* m steps of Verlet's scheme: increments, so that rounding shrinks with the step. */
static void divide(const pm_contact_springs *x, double h, int m, double *y)
{
    memset(y, 0, 2 * (size_t)x->n * sizeof *y);
    for (int s = 0; s < m; s++) {
        move_impulses(x, y, 0.5 * h / m);
        for (int i = 0; i < x->n; i++) y[i] += h / m * rate_of_place(x, i, y);
        move_impulses(x, y, 0.5 * h / m);
    }
}

/* x->next after h; the estimated error over what is allowed. */
static double step(pm_contact_springs *x, double h)
{
    const int two = 2 * x->n;
    double *table = x->table, worst = 0;
    for (int k = 0; k < COLUMNS; k++) divide(x, h, k + 1, table + k * two);
    for (int j = 1; j < COLUMNS; j++)
        for (int k = COLUMNS - 1; k >= j; k--) {
            const double ratio = (double)(k + 1) / (k + 1 - j);
            for (int i = 0; i < two; i++)
                table[k * two + i] += (table[k * two + i] - table[(k - 1) * two + i]) / (ratio * ratio - 1);
        }
    for (int i = 0; i < two; i++) {
        const double found = table[(COLUMNS - 1) * two + i],
                     error = fabs(found - table[(COLUMNS - 2) * two + i]);
        x->next[i] = found;
        const double unit = i < x->n ? x->spring[i].largest : fmax(1, fabs(found));
        worst = fmax(worst, isfinite(error) ? error / (x->tolerance * unit) : INFINITY);
    }
    return worst;
}

/* ---- events ---- */
/* Not negative while a contact stays in its phase. */
static double room(const pm_contact_springs *x, int i, int kind, const double *y)
{
    const int phase = x->spring[i].phase;
    if (kind == PLACE) return phase == RELEASES ? x->now[i] + y[i] : 1;
    return phase == LOADS ? -velocity(x, i, y) : velocity(x, i, y);
}

static double nothing_of(const pm_contact_springs *x, int i, int kind)
{
    return kind == PLACE ? x->tolerance * x->spring[i].largest : x->no_velocity;
}

static int is_left(const pm_contact_springs *x, int i, int kind, const double *y)
{
    return room(x, i, kind, y) < -nothing_of(x, i, kind);
}

/* Of the function that is looked for. */
static double slope_of(const pm_contact_springs *x, const double *y)
{
    if (x->kind == PLACE) return rate_of_place(x, x->event, y);
    const double a = rate_of_velocity(x, x->event, y);
    return x->spring[x->event].phase == LOADS ? -a : a;
}

static double room_after(void *of, double h, void *context, double *slope)
{
    pm_contact_springs *x = of;
    (void)context;
    step(x, h);
    *slope = slope_of(x, x->next);
    return room(x, x->event, x->kind, x->next);
}

/* Where function number i, which has left after h, does so: at once if it was never inside. */
static double leaves_at(pm_contact_springs *x, int i, double h)
{
    double a = 0, slope, at;
    x->event = i / KINDS;
    x->kind = i % KINDS;
    const double nothing = nothing_of(x, x->event, x->kind), last = room_after(x, h, NULL, &slope);
    double first = room(x, x->event, x->kind, x->zero);
    for (int k = 1; first <= nothing && k <= PM_SPRINGS_LOOKS; k++) {
        a = ldexp(h, -2 * k);
        first = room_after(x, a, NULL, &slope);
    }
    if (!(first > 0)) return 0;
    return pm_bracket_newton(room_after, x, NULL, a, first, h, last, &at) == PM_SEARCH_NO_NUMBER ? h : at;
}

/* Where what is looked for is nearest to its zero inside a step of h, at whose ends its slopes are d[0] and d[1]; or where it
 * has left. */
static double nearest(pm_contact_springs *x, double h, const double d[2])
{
    double a = 0, b = h, low = d[0], high = d[1], slope = 0, at = 0;
    for (int k = 0, last = 0, side; k < PM_SPRINGS_LOOKS && !is_left(x, x->event, x->kind, x->next); k++) {
        at = a + (b - a) * (low / (low - high));
        room_after(x, at, NULL, &slope);
        side = slope > 0;
        *(side ? &b : &a) = at;
        *(side ? &high : &low) = slope;
        if (k > 0 && side == last) *(side ? &low : &high) *= 0.5; /* Illinois */
        last = side;
    }
    return at;
}

/* How far a step of h, after which x->next is known, goes at most before function number i has left; 0: it does not.  What
 * leaves inside it and is back at its end has come nearer at first and goes away at last. */
static double leaves_before(pm_contact_springs *x, int i, double h)
{
    const int of = i / KINDS, kind = i % KINDS;
    x->event = of;
    x->kind = kind;
    const double d[2] = {slope_of(x, x->zero), slope_of(x, x->next)};
    if (is_left(x, of, kind, x->next)) return h;
    if (!(d[0] < 0 && d[1] > 0)) return 0;
    const double at = nearest(x, h, d);
    const int left = is_left(x, of, kind, x->next);
    step(x, h);
    return left ? at : 0;
}

/* The first end of a phase inside a step of h: how far it is there, and whose it is (PM_NONE: none). */
static double first_event(pm_contact_springs *x, double h, int *who, int *kind)
{
    double first = h;
    *who = PM_NONE;
    for (int i = 0; i < KINDS * x->n; i++) {
        const double until = leaves_before(x, i, h);
        if (until == 0) continue;
        const double at = leaves_at(x, i, until);
        step(x, h);
        if (*who != PM_NONE && at >= first) continue;
        first = at;
        *who = i / KINDS;
        *kind = i % KINDS;
    }
    return first;
}

/* Goes on from where the step ends: what was given so far does not blur what is still to come. */
static void accept(pm_contact_springs *x)
{
    for (int i = 0; i < x->n; i++) x->table[i] = velocity(x, i, x->next);
    for (int i = 0; i < x->n; i++) {
        pm_contact_spring *c = &x->spring[i];
        c->start = x->table[i];
        c->impulse += x->next[x->n + i];
        x->now[i] += x->next[i];
        c->largest = fmax(c->largest, fabs(x->now[i]));
    }
}

/* Contact i ends its phase: what is compressed is released, or lost; what is released, or open, is compressed again. */
static void next_phase(pm_contact_springs *x, int i, int kind)
{
    pm_contact_spring *c = &x->spring[i];
    const int loses = kind == PLACE || (c->phase == LOADS && c->restitution == 0);
    c->phase = loses ? OPEN : c->phase == LOADS ? RELEASES : LOADS;
    if (loses) x->now[i] = 0;
    if (kind == VELOCITY) c->start = 0;
}

/* ---- the blow ---- */
/* The units, and what approaches. */
static double begin(pm_contact_springs *x, double *response)
{
    double speed = 0;
    *response = x->stiffest = 0;
    memset(x->now, 0, (size_t)x->n * sizeof *x->now);
    for (int i = 0; i < x->n; i++) {
        speed = fmax(speed, fabs(x->spring[i].before));
        *response = fmax(*response, x->response[i * (x->n + 1)]);
        x->stiffest = fmax(x->stiffest, x->spring[i].stiffness);
    }
    for (int i = 0; i < x->n * x->n; i++) x->response[i] /= *response;
    for (int i = 0; i < x->n; i++) {
        pm_contact_spring *c = &x->spring[i];
        c->start = c->before / speed;
        c->impulse = 0;
        c->largest = pow(x->stiffest / c->stiffness, 1 / (x->exponent + 1));
        c->phase = OPEN;
    }
    return speed;
}

/* Energy that could give no velocity to speak of. */
static int holds_nothing(const pm_contact_springs *x, int i)
{
    const double energy = force(x, i, x->zero) * x->now[i] / (x->exponent + 1);
    return energy <= 0.5 * x->no_velocity * x->no_velocity;
}

/* What approaches is compressed; 0 if nothing does, nor holds energy. */
static int goes_on(pm_contact_springs *x)
{
    int any = 0;
    for (int i = 0; i < x->n; i++) {
        pm_contact_spring *c = &x->spring[i];
        const int approaches = c->start < -x->no_velocity;
        if (c->phase == OPEN && approaches) c->phase = LOADS;
        any |= approaches || !holds_nothing(x, i);
    }
    return any;
}

/* One step, no longer than *h, to the next event; *h is what the next one may be. */
static void advance(pm_contact_springs *x, double *h)
{
    int who = PM_NONE, kind = VELOCITY;
    const double error = step(x, *h), least = error <= 1 ? 1 : PM_SPRINGS_SHORTER;
    const double other = PM_SPRINGS_SAFE * pow(fmax(error, PM_SPRINGS_EXACT), -1. / (2 * COLUMNS - 1));
    const double next = *h * fmax(least, fmin(PM_SPRINGS_LONGER, other));
    if (error <= 1) {
        step(x, first_event(x, *h, &who, &kind));
        accept(x);
        if (who != PM_NONE) next_phase(x, who, kind);
    }
    *h = next;
}

int pm_contact_springs_follow(pm_contact_springs *x)
{
    double response, h = PM_SPRINGS_FIRST;
    const double speed = begin(x, &response);
    for (int i = 0; goes_on(x); i++) {
        if (i == PM_SPRINGS_STEPS) return 0;
        advance(x, &h);
    }
    for (int i = 0; i < x->n; i++) {
        pm_contact_spring *c = &x->spring[i];
        c->before = fabs(c->start) <= x->no_velocity ? 0 : c->start * speed;
        c->impulse *= speed / response;
    }
    return 1;
}
