/* natural_size.c - how large the terms of an answer are, whatever they leave of each other.
 *
 * An answer that is zero, or next to it, is the sum of terms that cancel; its error is a part of the terms.  Two sizes are
 * found at the end of a run:
 *
 *   scale   what the ask would change by if the state changed by its own size
 *   terms   what it would change by if each quantity that it reads changed by the greatest that was of its kind in the run
 *
 * The second is there for impulses, losses and times of events, which the state at the end knows nothing of. */
#include "study/natural_size.h"

#include <math.h>
#include <string.h>

#include "elements/measure.h"
#include "elements/trigger.h"
#include "equations/case.h"
#include "equations/saddle.h"
#include "events/ask.h"
#include "events/derived.h"
#include "events/integral.h"
#include "expression/operation.h"
#include "expression/program.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- by the state ---- */
static int look_at_asks(pm_workspace *w, int level, const pm_state *s, double *ask)
{
    const pm_model *m = w->model;
    pm_frame_look(&w->frame, s->t, s->q, s->v, s->z, w->state.memory);
    const int status = level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
    if (status) return status;
    for (int i = 0; i < m->nask; i++) ask[i] = pm_program_run(w, PM_ASK_ROW(m, i)[PM_ASK_PROGRAM]);
    return PM_OK;
}

static int look_at_programs(pm_workspace *w, int level, const pm_state *s, double *ask, double *trigger)
{
    const pm_model *m = w->model;
    const int status = look_at_asks(w, level, s, ask);
    if (status) return status;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++)
        trigger[i] = PM_TRIGGER_ROW(m, i)[PM_TRIGGER_PROGRAM] >= 0 ? pm_trigger_program(w, i) : 0;
    return PM_OK;
}

static double size_of(double changed, double value, double part)
{
    const double size = fabs(changed - value) / part;
    return isfinite(size) ? size : 0;
}

/* ---- by what is read ---- */
/* J, and N s by it: of all momenta together, sum m |v| <= sqrt(sum m  sum m v^2). */
static double most_energy(const pm_workspace *w)
{
    return fmax(w->ledger.energy_scale, w->ledger.momentum_scale * w->numbers.speed);
}

static double most_momentum(const pm_workspace *w)
{
    double mass = 0;
    for (int i = 0; i < w->model->nbody; i++)
        if (!w->numbers.fixed[i]) mass += w->numbers.mass[i];
    return sqrt(2 * mass * w->ledger.energy_scale);
}

/* N: of all loads and of what they move, at the frame. */
static double all_forces(const pm_workspace *w)
{
    double sum = 0;
    for (int i = 0; i < w->model->nbody; i++) {
        const double *f = w->frame.f + 3 * i, *a = w->frame.a + 3 * i;
        if (!w->numbers.fixed[i]) sum += hypot(f[0], f[1]) + w->numbers.mass[i] * hypot(a[0], a[1]);
    }
    return sum;
}

static double whole_time(const pm_workspace *w) { return w->state.t; }
static double greatest_speed(const pm_workspace *w) { return w->numbers.speed; }
static double acceleration(const pm_workspace *w) { return pm_case_acceleration(&w->numbers); }
static double alpha(const pm_workspace *w) { return acceleration(w) / w->numbers.size; }
static double most_angular(const pm_workspace *w) { return most_momentum(w) * w->numbers.size; }
static double all_couples(const pm_workspace *w) { return all_forces(w) * w->numbers.size; }

/* The greatest that there was in the run of what a measure of this kind reads; NULL: the state says how large it is. */
static double (*const greatest[PM_MEASURE_KINDS])(const pm_workspace *w) = {
    [PM_MEASURE_TIME] = whole_time,
    [PM_MEASURE_EVENT_TIME] = whole_time,
    [PM_MEASURE_VELOCITY] = greatest_speed,
    [PM_MEASURE_CONTACT_SLIP] = greatest_speed,
    [PM_MEASURE_JOINT_SLIP] = greatest_speed,
    [PM_MEASURE_ACCELERATION] = acceleration,
    [PM_MEASURE_ALPHA] = alpha,
    [PM_MEASURE_KINETIC] = most_energy,
    [PM_MEASURE_TOTAL] = most_energy,
    [PM_MEASURE_LOST] = most_energy,
    [PM_MEASURE_FORCE_WORK] = most_energy,
    [PM_MEASURE_MOMENTUM] = most_momentum,
    [PM_MEASURE_JOINT_IMPULSE] = most_momentum,
    [PM_MEASURE_CONTACT_IMPULSE] = most_momentum,
    [PM_MEASURE_CONTACT_TENSION_IMPULSE] = most_momentum,
    [PM_MEASURE_ANGULAR_MOMENTUM] = most_angular,
    [PM_MEASURE_JOINT_FORCE] = all_forces,
    [PM_MEASURE_JOINT_NORMAL] = all_forces,
    [PM_MEASURE_JOINT_FRICTION] = all_forces,
    [PM_MEASURE_CONTACT_NORMAL] = all_forces,
    [PM_MEASURE_CONTACT_FRICTION] = all_forces,
    [PM_MEASURE_CONTACT_TENSION] = all_forces,
    [PM_MEASURE_CONTACT_FORCE] = all_forces,
    [PM_MEASURE_CONTACT_COUPLE] = all_couples,
    [PM_MEASURE_JOINT_COUPLE] = all_couples,
};

static int kind_of(const pm_model *m, int measure) { return PM_MEASURE_ROW(m, measure)[PM_MEASURE_KIND]; }

static int has_greatest(const pm_model *m, int measure) { return greatest[kind_of(m, measure)] != NULL; }

enum { ALIKE, UNLIKE, PATTERNS }; /* the quantities of a program: where one cancels the other adds up */

/* Part of its size by which a quantity is shifted: no two are alike, however near to each other they stand in the table. */
static double part_of(int pattern, int measure)
{
    const double turn = 0.6180339887498949 * measure; /* golden section: their differences keep far from 0 */
    return pattern == ALIKE ? 1 : 2 * (turn - floor(turn)) - 1;
}

static double read_shifted(pm_workspace *w, int measure)
{
    const double value = pm_measure_signed(w, measure);
    if (!has_greatest(w->model, measure)) return value;
    return value + PM_SHIFT * part_of(w->evidence.pattern, measure) * greatest[kind_of(w->model, measure)](w);
}

static double run_shifted(pm_workspace *w, int ask, int pattern)
{
    w->evidence.pattern = pattern;
    return pm_program_run(w, PM_ASK_ROW(w->model, ask)[PM_ASK_PROGRAM]);
}

/* The frame looks at the state, where the asks have these values. */
static void find_terms(pm_workspace *w, const pm_natural_size *x, const double *ask)
{
    double (*const read)(pm_workspace * w, int measure) = w->read_measure;
    w->read_measure = read_shifted;
    for (int i = 0; i < w->model->nask; i++) {
        for (int k = ALIKE; x->shifts[i] && k < PATTERNS; k++)
            x->terms[i] = pm_max(size_of(run_shifted(w, i, k), ask[i], PM_SHIFT), x->terms[i]);
    }
    w->read_measure = read;
}

/* Of an integral the end says little, and nothing where its program switches: its terms are those of the whole run. */
static void take_integral(const pm_workspace *w, pm_natural_size *x, int ask)
{
    const int summed = PM_ASK_ROW(w->model, ask)[PM_ASK_KIND] == PM_ASK_INTEGRAL;
    if (w->ask->switches[ask] > 0) x->ask[ask] = x->terms[ask] = 0;
    if (summed) x->ask[ask] *= w->state.t, x->terms[ask] *= w->state.t;
    x->terms[ask] = pm_max(pm_integral_terms(w, ask), x->terms[ask]);
}

/* Asks that read others, which stand before them. */
static void add_derived(pm_workspace *w, pm_natural_size *x)
{
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        if (e[PM_ASK_KIND] == PM_ASK_END && pm_derived_is(w->model, e[PM_ASK_PROGRAM]))
            x->terms[i] += pm_derived_terms(w, e[PM_ASK_PROGRAM], x->largest);
        x->largest[i] = pm_max(x->ask[i], x->terms[i]);
    }
}

static int level_needed(const pm_workspace *w)
{
    int level = w->ask->instant_level;
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int program = PM_TRIGGER_ROW(w->model, i)[PM_TRIGGER_PROGRAM];
        if (program >= 0 && w->model->programs.level[program] > level)
            level = w->model->programs.level[program];
    }
    return level;
}

int pm_natural_size_create(pm_workspace *w, pm_natural_size *x)
{
    const pm_model *m = w->model;
    const pm_array array[] = {
        PM_ARRAY(x->ask, m->nask),     PM_ARRAY(x->terms, m->nask),
        PM_ARRAY(x->largest, m->nask), PM_ARRAY(x->trigger, m->rows[PM_TABLE_TRIGGER]),
        PM_ARRAY(x->rate, m->nask),    PM_ARRAY(x->shifts, m->nask),
    };
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    x->level = level_needed(w);
    for (int i = 0; i < m->nask && !status; i++)
        x->shifts[i] = pm_program_walk_reads(m, PM_ASK_ROW(m, i)[PM_ASK_PROGRAM], has_greatest) != PM_NONE;
    return status;
}

void pm_natural_size_find(pm_workspace *w, pm_natural_size *x, double *ask, double *trigger)
{
    const int nask = w->model->nask, ntrigger = w->model->rows[PM_TABLE_TRIGGER];
    memset(x->ask, 0, (size_t)nask * sizeof(double));
    memset(x->terms, 0, (size_t)nask * sizeof(double));
    memset(x->trigger, 0, (size_t)ntrigger * sizeof(double));
    if (look_at_programs(w, x->level, &w->state, ask, trigger)) return;
    find_terms(w, x, ask);
    const double part = pm_case_shift(w, &w->probe);
    if (look_at_programs(w, x->level, &w->probe, x->ask, x->trigger)) return;
    for (int i = 0; i < nask; i++) x->ask[i] = size_of(x->ask[i], ask[i], part);
    for (int i = 0; i < nask; i++)
        if (pm_model_ask_is_integral(PM_ASK_ROW(w->model, i))) take_integral(w, x, i);
    add_derived(w, x);
    for (int i = 0; i < ntrigger; i++) x->trigger[i] = size_of(x->trigger[i], trigger[i], part);
}

/* ---- by the motion ---- */
/* Accelerations are those at w->state. */
static double move_on(const pm_workspace *w, const double *a, pm_state *moved)
{
    const double h = PM_SHIFT * w->numbers.size / w->numbers.speed;
    pm_state_copy(moved, &w->state);
    for (int i = 0; i < w->model->nq; i++) {
        moved->q[i] += h * moved->v[i];
        moved->v[i] += h * a[i];
    }
    moved->t += h;
    return h;
}

void pm_natural_size_find_rates(pm_workspace *w, pm_natural_size *x, double *ask)
{
    const size_t bytes = (size_t)w->model->nask * sizeof(double);
    memset(x->rate, 0, bytes);
    if (look_at_asks(w, PM_LEVEL_DYNAMIC, &w->state, ask)) return;
    const double h = move_on(w, w->frame.a, &w->probe);
    if (look_at_asks(w, x->level, &w->probe, x->rate)) {
        memset(x->rate, 0, bytes);
        return;
    }
    for (int i = 0; i < w->model->nask; i++) x->rate[i] = size_of(x->rate[i], ask[i], h);
}
