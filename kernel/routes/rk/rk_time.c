/* rk_time.c - how far a step is off by what time does to forces and drives within it.
 *
 * The error that the stages tell (rk_formula.c) is divided by that of order 3, which measures what is strong and smooth in a step.  A
 * pulse that begins beside that shows in the last stages alone, is rough, and would count for next to nothing.  Programs of the time
 * can be read anywhere, though: the quadrature by the stages is compared with one that reads four more places, and is exact for
 * polynomials four degrees higher.  Their difference is the error of an impulse, and over the mass that it acts on one of a velocity. */
#include <math.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "events/time_course.h"
#include "expression/program.h"
#include "expression/program_class.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/rk/dop853.h"
#include "routes/rk/rk.h"
#include "scene/reference.h"
#include "state/frame.h"

#define STAGE_PLACES (1 + STAGES - STEP_FROM) /* of the stages that the formula weighs */
#define PLACES (STAGE_PLACES + 4)

static const double others[PLACES - STAGE_PLACES] = {0.1, 0.46, 0.76, 0.95};
/* Weights of the interpolatory quadrature over the stages' places and the others, less those of the formula. */
static const double weight[PLACES] = {-0.027586378827262774, -6.896452417368646,    -2.3659478331248187,
                                      8.571184517127772,     0.3799381246557484,    -0.4663612778295542,
                                      -0.04901450169605576,  -0.026692901796672015, 0.17737243130385447,
                                      0.7016122333694835,    -0.0619085783271041,   0.06385658251325552};

/* ---- which programs ---- */
static void add(pm_workspace *w, int program, int derivative, double gain)
{
    struct pm_rk *r = w->rk;
    const int class = w->model->programs.class[program];
    if (class == PM_CLASS_CONSTANT || class == PM_CLASS_TIME || gain == 0) return;
    if (!pm_program_class_reads_time_alone(w->model, program)) return;
    r->timed[r->ntimed++] = (pm_rk_timed){program, derivative, gain};
}

/* What a unit of a force, or of a couple over the size of the scene, makes of a velocity in a unit of time: by the lightest of the
 * bodies that it acts on. */
static double mobility_of(const pm_workspace *w, int force)
{
    const int is_couple = PM_FORCE_ROW(w->model, force)[PM_FORCE_KIND] == PM_FORCE_COUPLE;
    const double size = w->numbers.size;
    int body[PM_REFERENCES];
    const int n = pm_reference_bodies(w->model, PM_TABLE_FORCE, force, body);
    double most = 0;
    for (int k = 0; k < n; k++) {
        if (body[k] == w->model->nbody) continue;
        const double *inverse = w->numbers.inverse_mass + 3 * body[k];
        if (!w->numbers.light[3 * body[k]]) most = pm_max(is_couple ? inverse[2] * size : inverse[0], most);
    }
    return most;
}

static void add_forces(pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++) {
        const int32_t *row = PM_FORCE_ROW(m, i);
        if (pm_state_is_absent(m, &w->state, PM_TABLE_FORCE, i)) continue;
        for (int k = 0; k < pm_force_of(m, i)->programs; k++)
            add(w, row[PM_FORCE_PROGRAM_X + k], 0, mobility_of(w, i));
    }
}

static void add_drives(pm_workspace *w)
{
    for (int i = 0; i < w->active.n; i++) {
        const pm_constraint *c = &w->active.constraint[i];
        if (c->drive == PM_NONE) continue;
        const double length = pm_constraint_is_angle(c) ? w->numbers.size : 1;
        add(w, c->drive, c->prescribes == PM_PRESCRIBES_PLACE ? 2 : 1, length);
    }
}

void pm_rk_time_begin(pm_workspace *w)
{
    w->rk->ntimed = 0;
    if (!pm_time_course_is_any(w)) return;
    add_forces(w);
    add_drives(w);
}

/* ---- of a step ---- */
/* Of the step. */
static double place_of(int i)
{
    if (i >= STAGE_PLACES) return others[i - STAGE_PLACES];
    return i == 0 ? stage_time[0] : stage_time[STEP_FROM + i - 1];
}

/* That of the program which acts at the time t, and what rounding of that time and of the value makes of it. */
static double value_at(const pm_workspace *w, const pm_rk_timed *x, double t, double h, double *rounded)
{
    double d[3];
    d[0] = pm_program_of_time(w->model, x->program, w->numbers.param, w->numbers.value,
                              pm_frame_side_time(&w->frame, t), d + 1);
    const double value = d[x->derivative], rate = x->derivative < 2 ? d[x->derivative + 1] : value / h;
    *rounded = PM_RK_TIME_ROUNDED * (fabs(value) + fabs(t * rate));
    return value;
}

static double off_by(const pm_workspace *w, const pm_rk_timed *x, double h)
{
    double sum = 0, rounding = 0, rounded;
    for (int i = 0; i < PLACES; i++) {
        sum += weight[i] * value_at(w, x, w->rk->t0 + place_of(i) * h, h, &rounded);
        rounding += fabs(weight[i]) * rounded;
    }
    return h * x->gain * fmax(fabs(sum) - rounding, 0);
}

double pm_rk_time_error(const pm_workspace *w, double h)
{
    double most = 0;
    for (int i = 0; i < w->rk->ntimed; i++) most = pm_max(off_by(w, &w->rk->timed[i], h), most);
    return most / (w->rk->tolerance * w->numbers.speed);
}

double pm_rk_time_rounding(const pm_workspace *w, double h)
{
    double most = 0, rounded;
    for (int i = 0; i < w->rk->ntimed; i++)
        for (int k = 0; k < STAGE_PLACES; k++) {
            value_at(w, &w->rk->timed[i], w->rk->t0 + place_of(k) * h, h, &rounded);
            if (isfinite(rounded)) most = pm_max(w->rk->timed[i].gain * rounded, most);
        }
    return h * most / (w->rk->tolerance * w->numbers.speed);
}
