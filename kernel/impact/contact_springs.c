/* contact_springs.c - steps of Verlet's scheme, extrapolated in h^2 (Gragg, Bulirsch, Stoer), from one event to the next.
 *
 * Units: velocities of the greatest before the blow, responses of the greatest, stiffnesses of the greatest; time and x such
 * that nothing else is left.  Inside a step each contact stays compressed, released or open, so that its equations are
 * smooth; a step ends where that changes.  What changes and changes back inside a step shows in its slopes.
 * [E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, ch. II.9 and II.14] */
#include "impact/contact_springs_parts.h"

#include <math.h>
#include <string.h>

#include "numerics/bracket.h"
#include "numerics/tolerances_impact.h"
#include "planemotion.h"

enum {
    OPEN = PM_CONTACT_SPRING_OPEN,
    LOADS = PM_CONTACT_SPRING_LOADS,
    RELEASES = PM_CONTACT_SPRING_RELEASES
};
/* Whose zero ends a step: the velocity of a contact; its x where it is released; its slip; what its friction holds, to either
 * side. */
enum { VELOCITY, PLACE, SLIP, FORWARD, BACKWARD, KINDS };
#define COLUMNS PM_SPRINGS_COLUMNS

int pm_contact_springs_create(pm_contact_springs *x, pm_arena *arena, int most)
{
    const size_t n = most, two = 2 * n;
    const pm_array array[] = {
        PM_ARRAY(x->spring, n),    PM_ARRAY(x->response, two * two), PM_ARRAY(x->now, n),
        PM_ARRAY(x->zero, two),    PM_ARRAY(x->next, two),           PM_ARRAY(x->table, COLUMNS * two),
        PM_ARRAY(x->ratio, n * n), PM_ARRAY(x->course, two * n),     PM_ARRAY(x->system, two * two),
        PM_ARRAY(x->load, n),      PM_ARRAY(x->held, two),           PM_ARRAY(x->pivot, two),
        PM_ARRAY(x->begun, two),
    };
    x->no_velocity = PM_COURSE_ROUNDING;
    x->tolerance = PM_SPRINGS_TOLERANCE;
    return pm_arena_take(arena, PM_ARRAYS(array));
}

/* ---- the equations; y: by how much x and P have grown since the step began ---- */
/* By how much direction r changes. */
static double change(const pm_contact_springs *x, int r, const double *y)
{
    double sum = 0;
    for (int k = 0; k < x->n; k++) sum += x->course[r * x->n + k] * y[x->n + k];
    return sum;
}

static double velocity(const pm_contact_springs *x, int i, const double *y)
{
    return x->spring[i].start + change(x, 2 * i, y);
}

/* Beside the stiffest. */
double pm_contact_springs_stiffness(const pm_contact_springs *x, int i)
{
    return x->spring[i].stiffness / x->stiffest;
}

/* Beyond the zero of x it goes on smoothly: a step may look there. */
double pm_contact_springs_force(const pm_contact_springs *x, int i, const double *y)
{
    const pm_contact_spring *c = &x->spring[i];
    if (c->phase == OPEN) return 0;
    const double place = x->now[i] + y[i];
    const double size = x->exponent == 1 ? fabs(place) : pow(fabs(place), x->exponent);
    return pm_contact_springs_stiffness(x, i) * copysign(size, place);
}

/* Of direction r. */
static double rate_of(const pm_contact_springs *x, int r, const double *y)
{
    double a = 0;
    for (int k = 0; k < x->n; k++) a += x->course[r * x->n + k] * pm_contact_springs_force(x, k, y);
    return a;
}

static double rate_of_place(const pm_contact_springs *x, int i, const double *y)
{
    const pm_contact_spring *c = &x->spring[i];
    if (c->phase == OPEN) return 0;
    const double faster = c->phase == RELEASES ? 1 / (c->restitution * c->restitution) : 1;
    return -velocity(x, i, y) * faster;
}

double pm_contact_springs_rate_of_force(const pm_contact_springs *x, int i, const double *y)
{
    const pm_contact_spring *c = &x->spring[i];
    if (c->phase == OPEN) return 0;
    const double place = fabs(x->now[i] + y[i]);
    return pm_contact_springs_stiffness(x, i) * x->exponent * pow(place, x->exponent - 1) *
           rate_of_place(x, i, y);
}

/* ---- a step ---- */
static void move_impulses(const pm_contact_springs *x, double *y, double h)
{
    for (int i = 0; i < x->n; i++) y[x->n + i] += h * pm_contact_springs_force(x, i, y);
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
static int slips(const pm_contact_springs *x, int i)
{
    return x->spring[i].phase != OPEN && x->spring[i].hold > 0 && x->spring[i].sense != 0;
}

/* Not negative while a contact stays in its phase, and as it slips or is held. */
static double room(const pm_contact_springs *x, int i, int kind, const double *y)
{
    const pm_contact_spring *c = &x->spring[i];
    switch (kind) {
    case PLACE: return c->phase == RELEASES ? x->now[i] + y[i] : 1;
    case SLIP: return slips(x, i) ? c->sense * (c->slip + change(x, 2 * i + 1, y)) : 1;
    case FORWARD: return pm_contact_springs_room(x, i, 1, y);
    case BACKWARD: return pm_contact_springs_room(x, i, -1, y);
    default: return c->phase == LOADS ? -velocity(x, i, y) : velocity(x, i, y);
    }
}

static double nothing_of(const pm_contact_springs *x, int i, int kind)
{
    if (kind == VELOCITY || kind == SLIP) return x->no_velocity;
    return kind == PLACE ? x->tolerance * x->spring[i].largest : PM_SPRINGS_HOLDS;
}

static int is_left(const pm_contact_springs *x, int i, int kind, const double *y)
{
    return room(x, i, kind, y) < -nothing_of(x, i, kind);
}

/* Of the function that is looked for. */
static double slope_of(const pm_contact_springs *x, const double *y)
{
    const pm_contact_spring *c = &x->spring[x->event];
    switch (x->kind) {
    case PLACE: return rate_of_place(x, x->event, y);
    case SLIP: return slips(x, x->event) ? c->sense * rate_of(x, 2 * x->event + 1, y) : 0;
    case FORWARD: return pm_contact_springs_slope_of_room(x, x->event, 1, y);
    case BACKWARD: return pm_contact_springs_slope_of_room(x, x->event, -1, y);
    default: return (c->phase == LOADS ? -1 : 1) * rate_of(x, 2 * x->event, y);
    }
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
    const int n = x->n;
    for (int i = 0; i < n; i++) {
        pm_contact_spring *c = &x->spring[i];
        c->start += change(x, 2 * i, x->next);
        c->slip += change(x, 2 * i + 1, x->next);
        c->impulse[0] += x->next[n + i];
        for (int k = 0; k < n; k++) c->impulse[1] += x->ratio[i * n + k] * x->next[n + k];
        x->now[i] += x->next[i];
        c->largest = fmax(c->largest, fabs(x->now[i]));
    }
}

/* Contact i ends its phase: what is compressed is released, or lost; what is released, or open, is compressed again.  Or it
 * begins or ends to slip. */
static void turn(pm_contact_springs *x, int i, int kind)
{
    pm_contact_spring *c = &x->spring[i];
    const int loses = kind == PLACE || (c->phase == LOADS && c->restitution == 0);
    x->swings = kind == VELOCITY && !loses ? x->swings + 1 : 0;
    if (kind == VELOCITY || kind == PLACE) {
        c->phase = loses ? OPEN : c->phase == LOADS ? RELEASES : LOADS;
        if (loses) x->now[i] = 0;
        if (kind == VELOCITY) c->start = 0;
    } else {
        c->slip = 0;
        c->sense = kind == SLIP ? 0 : kind == FORWARD ? -1 : 1;
    }
    pm_contact_springs_settle(x);
}

/* ---- the blow ---- */
/* The units, and what approaches. */
static double begin(pm_contact_springs *x, double *response)
{
    double speed = 0;
    *response = x->stiffest = 0;
    x->swings = 0;
    memset(x->now, 0, (size_t)x->n * sizeof *x->now);
    for (int i = 0; i < x->n; i++) {
        speed = fmax(speed, fabs(x->spring[i].before));
        *response = fmax(*response, x->response[2 * i * (2 * x->n + 1)]);
        x->stiffest = fmax(x->stiffest, x->spring[i].stiffness);
    }
    for (int i = 0; i < 4 * x->n * x->n; i++) x->response[i] /= *response;
    for (int i = 0; i < x->n; i++) {
        pm_contact_spring *c = &x->spring[i];
        c->start = c->before / speed;
        c->slip /= speed;
        x->begun[2 * i] = c->start;
        x->begun[2 * i + 1] = c->slip;
        c->sense = 0;
        c->impulse[0] = c->impulse[1] = 0;
        c->largest = pow(x->stiffest / c->stiffness, 1 / (x->exponent + 1));
        c->phase = OPEN;
    }
    return speed;
}

/* Energy that could give no velocity to speak of. */
static int holds_nothing(const pm_contact_springs *x, int i)
{
    const double energy = pm_contact_springs_force(x, i, x->zero) * x->now[i] / (x->exponent + 1);
    return energy <= 0.5 * x->no_velocity * x->no_velocity;
}

/* What approaches is compressed; 0 if nothing does, nor holds energy. */
static int goes_on(pm_contact_springs *x)
{
    int any = 0, begun = 0;
    for (int i = 0; i < x->n; i++) {
        pm_contact_spring *c = &x->spring[i];
        const int approaches = c->start < -x->no_velocity;
        if (c->phase == OPEN && approaches) {
            c->phase = LOADS;
            if (fabs(c->slip) <= x->no_velocity) c->slip = 0;
            c->sense = 0;
            x->swings = 0;
            begun = 1;
        }
        any |= approaches || !holds_nothing(x, i);
    }
    if (begun) pm_contact_springs_settle(x);
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
        if (who != PM_NONE) turn(x, who, kind);
    }
    *h = next;
}

int pm_contact_springs_follow(pm_contact_springs *x)
{
    double response, h = PM_SPRINGS_FIRST;
    const double speed = begin(x, &response);
    for (int i = 0; goes_on(x) && !pm_contact_springs_end_wedged(x); i++) {
        if (i == PM_SPRINGS_STEPS) return 0;
        advance(x, &h);
    }
    pm_contact_springs_share_friction(x);
    for (int i = 0; i < x->n; i++) {
        pm_contact_spring *c = &x->spring[i];
        c->before = fabs(c->start) <= x->no_velocity ? 0 : c->start * speed;
        c->slip = fabs(c->slip) <= x->no_velocity ? 0 : c->slip * speed;
        for (int k = 0; k < 2; k++) c->impulse[k] *= speed / response;
    }
    return 1;
}
