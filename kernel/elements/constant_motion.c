/* constant_motion.c - the curve, and the rules by which constraints and forces judge whether they stay the same along it. */
#include "elements/constant_motion.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "expression/program_class.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

static double length_of(const pm_frame *frame, int i) { return i % 3 == 2 ? frame->numbers->size : 1; }

/* Rounding is judged by the forces before the reactions cancel them, too: a block at rest on an incline has none left. */
static double acceleration_scale(const pm_frame *frame)
{
    double scale = 0;
    for (int i = 0; i < frame->model->nq; i++) {
        const double applied =
            frame->numbers->stand_in[i] > 0 ? 0 : frame->numbers->inverse_mass[i] * frame->f[i];
        scale = pm_max(pm_max(fabs(applied), fabs(frame->a[i])) * length_of(frame, i), scale);
    }
    return scale;
}

/* From the ground along angle constraints, as far as they reach. */
static void find_locked(const pm_model *model, const pm_active_set *active, pm_constant_motion *x)
{
    memset(x->locked, 0, (size_t)model->nbody);
    x->locked[model->nbody] = 1;
    x->levers = 0;
    for (int more = 1; more;) {
        more = 0;
        for (int i = 0; i < active->n; i++) {
            const int *body = active->constraint[i].body;
            if (active->constraint[i].kind != PM_CONSTRAINT_ANGLE || x->locked[body[0]] == x->locked[body[1]])
                continue;
            x->locked[body[0]] = x->locked[body[1]] = 1;
            x->levers = more = 1;
        }
    }
}

void pm_constant_motion_curve(const pm_workspace *w, double *v, double *a, unsigned char *rotates,
                              unsigned char *locked, pm_constant_motion *x)
{
    const int nq = w->model->nq, nbody = w->model->nbody;
    *x = (pm_constant_motion){.v = v, .a = a, .rotates = rotates, .locked = locked};
    x->speed = PM_STEADY_ROUNDING * w->numbers.speed;
    x->acceleration = PM_STEADY_ROUNDING * acceleration_scale(&w->frame);
    const double length[3] = {1, 1, w->frame.numbers->size};
    for (int i = 0; i < nq; i += 3)
        for (int k = 0; k < 3; k++) {
            v[i + k] = fabs(w->state.v[i + k]) * length[k] <= x->speed ? 0 : w->state.v[i + k];
            a[i + k] = fabs(w->frame.a[i + k]) * length[k] <= x->acceleration ? 0 : w->frame.a[i + k];
        }
    for (int k = nq; k < nq + 3; k++) v[k] = a[k] = 0;
    for (int i = 0; i <= nbody; i++) rotates[i] = v[3 * i + 2] != 0 || a[3 * i + 2] != 0;
    find_locked(w->model, &w->active, x);
}

int pm_constant_motion_mark(const pm_frame *frame, const pm_constant_motion *x, int body, const double at[2])
{
    return !x->rotates[body] || fabs(at[0]) + fabs(at[1]) <= PM_CENTRED * frame->numbers->size;
}

int pm_constant_motion_point(const pm_frame *frame, const pm_constant_motion *x, int index)
{
    const int32_t *e = PM_POINT_ROW(frame->model, index);
    const double at[2] = {frame->numbers->value[e[PM_POINT_X]], frame->numbers->value[e[PM_POINT_Y]]};
    return pm_constant_motion_mark(frame, x, pm_model_body_index(frame->model, e[PM_POINT_BODY]), at);
}

int pm_constant_motion_marks(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    return pm_constant_motion_mark(frame, x, c->body[0], c->a) &&
           pm_constant_motion_mark(frame, x, c->body[1], c->b);
}

int pm_constant_motion_drive(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    (void)x;
    if (c->drive == PM_NONE) return 1;
    const int class = frame->model->programs.class[c->drive];
    return class == PM_CLASS_CONSTANT || (class == PM_CLASS_TIME && c->prescribes == PM_PRESCRIBES_PLACE);
}

int pm_constant_motion_together(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    if (!pm_constant_motion_marks(frame, c, x)) return 0;
    for (int k = 0; k < 2; k++) {
        const int a = 3 * c->body[0] + k, b = 3 * c->body[1] + k;
        if (fabs(x->v[a] - x->v[b]) > x->speed || fabs(x->a[a] - x->a[b]) > x->acceleration) return 0;
    }
    return 1;
}
