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
#include "expression/program.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- by the state ---- */
static int look_at_programs(pm_workspace *w, const pm_state *s, double *ask, double *trigger)
{
    const pm_model *m = w->model;
    pm_frame_look(&w->frame, s->t, s->q, s->v, s->z, w->state.memory);
    const int status = pm_saddle_accelerate(w);
    if (status) return status;
    for (int i = 0; i < m->nask; i++) ask[i] = pm_program_run(w, PM_ASK_ROW(m, i)[PM_ASK_PROGRAM]);
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

/* The greatest that there was in the run of what a measure of this kind reads; 0: it has no error. */
static double greatest(const pm_workspace *w, int kind)
{
    const pm_numbers *n = &w->numbers;
    const double acceleration = hypot(n->gravity[0], n->gravity[1]) + n->speed * n->speed / n->size;
    switch ((enum pm_measure_kind)kind) {
    case PM_MEASURE_TIME:
    case PM_MEASURE_EVENT_TIME: return w->state.t;
    case PM_MEASURE_VELOCITY:
    case PM_MEASURE_CONTACT_SLIP: return n->speed;
    case PM_MEASURE_ACCELERATION: return acceleration;
    case PM_MEASURE_ALPHA: return acceleration / n->size;
    case PM_MEASURE_KINETIC:
    case PM_MEASURE_TOTAL:
    case PM_MEASURE_LOST:
    case PM_MEASURE_FORCE_WORK: return most_energy(w);
    case PM_MEASURE_MOMENTUM:
    case PM_MEASURE_JOINT_IMPULSE:
    case PM_MEASURE_CONTACT_IMPULSE: return most_momentum(w);
    case PM_MEASURE_ANGULAR_MOMENTUM: return most_momentum(w) * n->size;
    case PM_MEASURE_JOINT_FORCE:
    case PM_MEASURE_JOINT_NORMAL:
    case PM_MEASURE_JOINT_FRICTION:
    case PM_MEASURE_CONTACT_NORMAL:
    case PM_MEASURE_CONTACT_FRICTION:
    case PM_MEASURE_CONTACT_FORCE: return all_forces(w);
    case PM_MEASURE_JOINT_COUPLE: return all_forces(w) * n->size;
    default: return 0; /* the state says how large it is */
    }
}

enum {
    AS_THEY_ARE,
    ALIKE,
    UNLIKE,
    PATTERNS
}; /* the quantities of a program: where one cancels the other adds up */

/* Part of its size by which a quantity is shifted: no two are alike, however near to each other they stand in the table. */
static double part_of(int pattern, int measure)
{
    const double turn = 0.6180339887498949 * measure; /* golden section: their differences keep far from 0 */
    return pattern == AS_THEY_ARE ? 0 : pattern == ALIKE ? 1 : 2 * (turn - floor(turn)) - 1;
}

static double read_shifted(pm_workspace *w, int measure)
{
    const double value = pm_measure_signed(w, measure),
                 size = greatest(w, PM_MEASURE_ROW(w->model, measure)[PM_MEASURE_KIND]);
    return value + PM_SHIFT * part_of(w->evidence.pattern, measure) * size;
}

static double run_shifted(pm_workspace *w, int ask, int pattern)
{
    w->evidence.pattern = pattern;
    return pm_program_run(w, PM_ASK_ROW(w->model, ask)[PM_ASK_PROGRAM]);
}

/* The frame looks at the state. */
static void find_terms(pm_workspace *w, double *terms)
{
    double (*const read)(pm_workspace * w, int measure) = w->read_measure;
    w->read_measure = read_shifted;
    for (int i = 0; i < w->model->nask; i++) {
        const double value = run_shifted(w, i, AS_THEY_ARE);
        for (int k = ALIKE; k < PATTERNS; k++)
            terms[i] = fmax(size_of(run_shifted(w, i, k), value, PM_SHIFT), terms[i]);
    }
    w->read_measure = read;
}

/* Of an integral the end says little, and nothing where its program switches: its terms are those of the whole run. */
static void take_integral(const pm_workspace *w, pm_natural_size *x, int ask)
{
    const int summed = PM_ASK_ROW(w->model, ask)[PM_ASK_KIND] == PM_ASK_INTEGRAL;
    if (w->ask->switches[ask] > 0) x->ask[ask] = x->terms[ask] = 0;
    if (summed) x->ask[ask] *= w->state.t, x->terms[ask] *= w->state.t;
    x->terms[ask] = fmax(x->terms[ask], pm_integral_terms(w, ask));
}

/* Asks that read others, which stand before them. */
static void add_derived(pm_workspace *w, pm_natural_size *x)
{
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        if (e[PM_ASK_KIND] == PM_ASK_END && pm_derived_is(w->model, e[PM_ASK_PROGRAM]))
            x->terms[i] += pm_derived_terms(w, e[PM_ASK_PROGRAM], x->largest);
        x->largest[i] = fmax(x->ask[i], x->terms[i]);
    }
}

void pm_natural_size_find(pm_workspace *w, pm_natural_size *x, double *ask, double *trigger)
{
    const int nask = w->model->nask, ntrigger = w->model->rows[PM_TABLE_TRIGGER];
    memset(x->ask, 0, (size_t)nask * sizeof(double));
    memset(x->terms, 0, (size_t)nask * sizeof(double));
    memset(x->trigger, 0, (size_t)ntrigger * sizeof(double));
    if (look_at_programs(w, &w->state, ask, trigger)) return;
    find_terms(w, x->terms);
    const double part = pm_case_shift(w, &w->probe);
    if (look_at_programs(w, &w->probe, x->ask, x->trigger)) return;
    for (int i = 0; i < nask; i++) x->ask[i] = size_of(x->ask[i], ask[i], part);
    for (int i = 0; i < nask; i++)
        if (pm_model_ask_is_integral(PM_ASK_ROW(w->model, i))) take_integral(w, x, i);
    add_derived(w, x);
    for (int i = 0; i < ntrigger; i++) x->trigger[i] = size_of(x->trigger[i], trigger[i], part);
}
