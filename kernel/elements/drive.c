/* drive.c - prescribed rates w(t).
 *
 * A driven row has  G v = w(t),  and so  G a = dw/dt - (dG/dt) v.  Its residual needs the way, the integral of w: its anchor
 * holds it up to the last accepted step, and from there on it is taken by Gauss' formula, exact to rounding over one step
 * of a smooth w. */
#include "elements/drive.h"

#include "expression/program.h"
#include "scene/program_class.h"
#include "state/workspace.h"

#define GAUSS 5 /* pairs of nodes: exact for polynomials up to degree 19 */

static const double gauss_at[GAUSS] = {0.14887433898163122, 0.43339539412924719, 0.67940956829902441,
                                       0.86506336668898451, 0.97390652851717172};
static const double gauss_weight[GAUSS] = {0.29552422471475287, 0.26926671930999636, 0.21908636251598204,
                                           0.14945134915058059, 0.06667134430868814};

static double rate_at(const pm_workspace *w, int program, double t)
{
    double change;
    return pm_program_of_time(w->model, program, w->numbers.param, w->numbers.value, t, &change);
}

double pm_drive_rate(const pm_workspace *w, int program)
{
    return program == PM_NONE ? 0 : rate_at(w, program, w->frame.t);
}

double pm_drive_change(const pm_workspace *w, int program)
{
    double change = 0;
    if (program != PM_NONE)
        pm_program_of_time(w->model, program, w->numbers.param, w->numbers.value, w->frame.t, &change);
    return change;
}

double pm_drive_way(const pm_workspace *w, int program, const pm_memory *memory)
{
    if (program == PM_NONE) return 0;
    const double half = 0.5 * (w->frame.t - memory->time), middle = memory->time + half;
    if (w->model->programs.class[program] == PM_CLASS_CONSTANT) return 2 * half * rate_at(w, program, middle);
    double sum = 0;
    for (int i = 0; i < GAUSS; i++)
        sum += gauss_weight[i] * (rate_at(w, program, middle - half * gauss_at[i]) +
                                  rate_at(w, program, middle + half * gauss_at[i]));
    return half * sum;
}

void pm_drive_follow(const pm_workspace *w, int program, pm_memory *memory)
{
    if (program == PM_NONE) return;
    memory->anchor += pm_drive_way(w, program, memory);
    memory->time = w->frame.t;
}
