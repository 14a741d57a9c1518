/* switch_course.c - derivatives of a program along the motion, by differences at one instant.
 *
 * Of an argument g(t, q, v) they are
 *
 *   g'  = g_t + g_q v + g_v a        g'' = g_q a + (d/dt + v d/dq)^2 g      if it reads no velocities
 *
 * Each part has a difference of its own: what a force does in the time of a look does not enter g_q v, however strong it is. */
#include "impact/switch_course.h"

#include <math.h>

#include "expression/program.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"

/* From the state: t, q along the velocities and along the accelerations, v along the accelerations. */
typedef struct pm_shift {
    double time, along, bent, turned;
} pm_shift;

static double shifted(pm_workspace *w, int program, pm_shift by, double h)
{
    const double *v = w->state.v, *a = w->frame.a;
    pm_state_copy(&w->probe, &w->state);
    w->probe.t += h * by.time;
    for (int i = 0; i < w->model->nq; i++) {
        w->probe.q[i] += h * (by.along * v[i] + by.bent * a[i]);
        w->probe.v[i] += h * by.turned * a[i];
    }
    pm_frame_look_state(&w->frame, &w->probe);
    return pm_program_run(w, program);
}

static void look_back(pm_workspace *w, int level)
{
    pm_frame_look_state(&w->frame, &w->state);
    w->frame.level = level; /* forces, accelerations and reactions are still those of this state */
}

/* ---- rounding ---- */
/* A sign for each coordinate that follows no order of the bodies. */
static double sign_of(int i, int pattern)
{
    return ((unsigned)i * 2654435761u + (unsigned)pattern * 40503u) >> 16 & 1 ? 1 : -1;
}

/* Places and velocities are each off by a small part of themselves, and of what is natural. */
static double scattered(pm_workspace *w, int program, int pattern)
{
    pm_state_copy(&w->probe, &w->state);
    for (int i = 0; i < w->model->nq; i++) {
        const double length = pm_numbers_length(&w->numbers, i), rate = w->numbers.speed / w->numbers.size;
        const double off = PM_SWITCH_LOOK * sign_of(i, pattern);
        w->probe.q[i] += off * (fabs(w->state.q[i]) + length);
        w->probe.v[i] += off * (fabs(w->state.v[i]) + length * rate);
    }
    pm_frame_look_state(&w->frame, &w->probe);
    return pm_program_run(w, program);
}

pm_switch_course pm_switch_course_begin(pm_workspace *w, int program)
{
    const int level = w->frame.level;
    pm_switch_course x = {program, pm_program_run(w, program), 0, 0};
    for (int pattern = 0; pattern < PM_SWITCH_PATTERNS; pattern++) {
        const double change = fabs(scattered(w, program, pattern) - x.here);
        if (isfinite(change)) x.scale = pm_max(change / PM_SWITCH_LOOK, x.scale);
    }
    x.rounding = PM_SWITCH_ROUNDINGS * PM_EPSILON * x.scale;
    look_back(w, level);
    return x;
}

/* ---- derivatives ---- */
/* The greatest of velocities or accelerations, m/s or m/s^2. */
static double greatest(const pm_workspace *w, const double *of)
{
    double most = 0;
    for (int i = 0; i < w->model->nq; i++)
        most = pm_max(fabs(of[i]) * (w->numbers.size / pm_numbers_length(&w->numbers, i)), most);
    return most;
}

/* d/dh; what does not show beyond rounding is looked at farther off, where the fastest bodies are not those that are read. */
static double slope(pm_workspace *w, const pm_switch_course *x, pm_shift by, double h)
{
    for (int i = 0; i < PM_SWITCH_LOOKS; i++, h *= PM_SWITCH_FARTHER) {
        const double change = shifted(w, x->program, by, h) - shifted(w, x->program, by, -h);
        if (isnan(change)) return 0;
        if (fabs(change) > x->rounding) return change / (2 * h);
    }
    return 0;
}

/* d2/dt2 along straight lines. */
static double bend(pm_workspace *w, const pm_switch_course *x, double h)
{
    const pm_shift on = {.time = 1, .along = 1};
    const double change =
        shifted(w, x->program, on, h) - x->here + (shifted(w, x->program, on, -h) - x->here);
    return fabs(change) > x->rounding ? change / (h * h) : 0; /* not a number: none */
}

typedef struct pm_rates {
    double first, second; /* derivatives by the time; second: 0 where velocities are read */
} pm_rates;

static pm_rates rates(pm_workspace *w, const pm_switch_course *x)
{
    const double size = w->numbers.size, fast = greatest(w, w->state.v), strong = greatest(w, w->frame.a);
    const double natural = size / w->numbers.speed,
                 of_time = slope(w, x, (pm_shift){.time = 1}, PM_SWITCH_LOOK * natural);
    const double pass = fast > 0 ? size / fast : natural, wait = of_time == 0 ? pass : pm_min(pass, natural);
    const double along = fast > 0 ? slope(w, x, (pm_shift){.along = 1}, PM_SWITCH_LOOK * pass) : 0;
    double turned = 0, second = fast > 0 || of_time != 0 ? bend(w, x, PM_SWITCH_BEND * wait) : 0;
    if (strong > 0) turned = slope(w, x, (pm_shift){.turned = 1}, PM_SWITCH_LOOK * w->numbers.speed / strong);
    if (strong > 0) second += slope(w, x, (pm_shift){.bent = 1}, PM_SWITCH_LOOK * size / strong);
    return (pm_rates){of_time + along + turned, turned == 0 ? second : 0};
}

static int sign(double x) { return (x > 0) - (x < 0); }

int pm_switch_course_way(pm_workspace *w, const pm_switch_course *x)
{
    const int level = w->frame.level;
    const pm_rates r = rates(w, x);
    const int turns = r.first * r.second < 0 && r.first * r.first <= 2 * fabs(r.second) * x->rounding;
    look_back(w, level);
    return r.first == 0 || turns ? sign(r.second) : sign(r.first);
}
