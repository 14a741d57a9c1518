/* drive.c - what acts on the motion in time: programs of forces; prescribed rates w(t) and places p(t).
 *
 * A driven constraint has  G v = w(t),  and so  G a = dw/dt - (dG/dt) v.  Of a prescribed place w is dp/dt, by the program's
 * own derivatives: place, rate and acceleration agree to rounding, and nothing is integrated.  Where the rate is prescribed
 * the residual needs the way, the integral of w: its anchor holds it up to the last accepted step, and from there on it is
 * taken by Gauss' formula, exact to rounding over one step of a smooth w. */
#include "elements/drive.h"

#include "elements/constraint.h"
#include "expression/program.h"
#include "expression/program_class.h"
#include "state/frame.h"
#include "state/workspace.h"

#define GAUSS 5 /* pairs of nodes: exact for polynomials up to degree 19 */

static const double gauss_at[GAUSS] = {0.14887433898163122, 0.43339539412924719, 0.67940956829902441,
                                       0.86506336668898451, 0.97390652851717172};
static const double gauss_weight[GAUSS] = {0.29552422471475287, 0.26926671930999636, 0.21908636251598204,
                                           0.14945134915058059, 0.06667134430868814};

/* The program at the time t; derivative: its first and second by the time. */
static double at(const pm_frame *frame, int program, double t, double derivative[2])
{
    return pm_program_of_time(frame->model, program, frame->numbers->param, frame->numbers->value,
                              pm_frame_side_time(frame, t), derivative);
}

static double rate_at(const pm_frame *frame, int program, double t)
{
    double derivative[2];
    return at(frame, program, t, derivative);
}

double pm_drive_program(pm_workspace *w, int program)
{
    const double t = w->frame.t;
    w->frame.t = pm_frame_side_time(&w->frame, t + w->frame.time_off);
    const double x = pm_program_run(w, program);
    w->frame.t = t;
    return x;
}

pm_drive_motion pm_drive_of(const pm_frame *frame, const pm_constraint *c)
{
    double derivative[2];
    const pm_memory *memory = c->memory == PM_NONE ? NULL : &frame->memory[c->memory];
    if (c->drive == PM_NONE) return (pm_drive_motion){.place = memory ? memory->anchor : 0};
    const double x = at(frame, c->drive, frame->t, derivative);
    if (c->prescribes == PM_PRESCRIBES_PLACE) return (pm_drive_motion){x, derivative[0], derivative[1]};
    return (pm_drive_motion){memory->anchor + pm_drive_way(frame, c->drive, memory), x, derivative[0]};
}

double pm_drive_rate(const pm_frame *frame, const pm_constraint *c)
{
    double derivative[2];
    if (c->drive == PM_NONE) return 0;
    const double x = at(frame, c->drive, frame->t, derivative);
    return c->prescribes == PM_PRESCRIBES_PLACE ? derivative[0] : x;
}

double pm_drive_jump(const pm_frame *frame, const pm_constraint *c)
{
    double derivative[2];
    if (c->drive == PM_NONE || c->prescribes != PM_PRESCRIBES_PLACE) return 0;
    const double before = pm_program_of_time(frame->model, c->drive, frame->numbers->param,
                                             frame->numbers->value, frame->t, derivative);
    return at(frame, c->drive, frame->t, derivative) - before;
}

double pm_drive_way(const pm_frame *frame, int program, const pm_memory *memory)
{
    if (program == PM_NONE) return 0;
    const double half = 0.5 * (frame->t - memory->time), middle = memory->time + half;
    if (frame->model->programs.class[program] == PM_CLASS_CONSTANT)
        return 2 * half * rate_at(frame, program, middle);
    double sum = 0;
    for (int i = 0; i < GAUSS; i++)
        sum += gauss_weight[i] * (rate_at(frame, program, middle - half * gauss_at[i]) +
                                  rate_at(frame, program, middle + half * gauss_at[i]));
    return half * sum;
}

void pm_drive_follow(const pm_frame *frame, int program, pm_memory *memory)
{
    if (program == PM_NONE) return;
    memory->anchor += pm_drive_way(frame, program, memory);
    memory->time = frame->t;
}
