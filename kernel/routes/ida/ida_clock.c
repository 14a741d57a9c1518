/* ida_clock.c - the time that IDA's steps sum up to.
 *
 * IDA adds each step to its clock and rounds the sum, but it integrates over the step as it is: the state belongs to the sum
 * without rounding.  The clock runs away from that, where steps are alike to one side, by some tens of roundings in all.
 * A narrow pulse late in a run would move beside the motion, in every run alike.  What rounding takes from a sum is known
 * exactly (O. Moller, BIT 5, 1965), and kept here: forces are taken at the time of the steps, and runs end at it. */
#include "routes/ida/ida.h"

/* By how much `shown` is more than clock + step. */
static double over(double clock, double step, double shown)
{
    const double sum = clock + step, added = sum - clock;
    const double lost = (clock - (sum - added)) + (step - added);
    return (shown - sum) - lost;
}

void pm_ida_clock_begin(pm_ida *ida, double t, int matters)
{
    ida->clock = (pm_ida_clock){.now = t, .matters = matters};
}

int pm_ida_clock_follow(pm_ida *ida)
{
    double now, step;
    int flag = IDAGetCurrentTime(ida->memory, &now);
    if (flag == IDA_SUCCESS) flag = IDAGetLastStep(ida->memory, &step);
    if (flag != IDA_SUCCESS || now == ida->clock.now) return flag;
    if (ida->clock.matters) ida->clock.ahead += over(ida->clock.now, step, now);
    ida->clock.now = now;
    return flag;
}

double pm_ida_clock_tried(const pm_ida *ida, double shown)
{
    double step;
    if (!ida->clock.matters || IDAGetCurrentStep(ida->memory, &step) != IDA_SUCCESS) return shown;
    return shown - (ida->clock.ahead + over(ida->clock.now, step, shown));
}

double pm_ida_clock_until(const pm_ida *ida, double shown, double t)
{
    return -over(t, ida->clock.ahead, shown);
}
