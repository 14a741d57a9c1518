/* constraint_kind.c - the table of the kinds of constraints, and what is worked out by it. */
#include "elements/constraint.h"
#include "elements/drive.h"
#include "state/workspace.h"

const pm_constraint_ops *pm_constraint_kind(int kind)
{
    static const pm_constraint_ops *const kinds[PM_CONSTRAINT_KINDS] = {
        [PM_CONSTRAINT_POINT_X] = &pm_constraint_point_x,
        [PM_CONSTRAINT_POINT_Y] = &pm_constraint_point_y,
        [PM_CONSTRAINT_LINE_NORMAL] = &pm_constraint_line_normal,
        [PM_CONSTRAINT_LINE_TANGENT] = &pm_constraint_line_tangent,
        [PM_CONSTRAINT_DISTANCE] = &pm_constraint_distance,
        [PM_CONSTRAINT_CIRCLE_TANGENT] = &pm_constraint_circle_tangent,
        [PM_CONSTRAINT_ANGLE] = &pm_constraint_angle,
        [PM_CONSTRAINT_STRAND] = &pm_constraint_strand,
        [PM_CONSTRAINT_DRIVE] = &pm_constraint_drive,
        [PM_CONSTRAINT_RATIO] = &pm_constraint_ratio,
        [PM_CONSTRAINT_CURVE_NORMAL] = &pm_constraint_curve_normal,
        [PM_CONSTRAINT_CURVE_TANGENT] = &pm_constraint_curve_tangent,
        [PM_CONSTRAINT_TEETH] = &pm_constraint_teeth,
        [PM_CONSTRAINT_RACK] = &pm_constraint_rack,
        [PM_CONSTRAINT_PAIR_NORMAL] = &pm_constraint_pair_normal,
        [PM_CONSTRAINT_PAIR_TANGENT] = &pm_constraint_pair_tangent,
        [PM_CONSTRAINT_CORD] = &pm_constraint_cord,
        [PM_CONSTRAINT_TEETH_SLIP] = &pm_constraint_teeth_slip,
        [PM_CONSTRAINT_CORD_SLIP] = &pm_constraint_cord_slip,
        [PM_CONSTRAINT_BELT] = &pm_constraint_belt,
    };
    return kinds[kind];
}

/* By the lines of its strands. */
static double rate_of_cord(const pm_frame *frame, const pm_constraint *c)
{
    pm_constraint strand[2];
    double tension[2];
    pm_constraint_cord_strands(c, strand);
    pm_constraint_cord_tensions(c, tension);
    return tension[0] * pm_constraint_rate(frame, &strand[0]) +
           tension[1] * pm_constraint_rate(frame, &strand[1]);
}

double pm_constraint_rate(const pm_frame *frame, const pm_constraint *c)
{
    pm_line_of_action x;
    if (c->over) return rate_of_cord(frame, c);
    pm_constraint_kind(c->kind)->act(frame, c, &x);
    double u[2];
    const double *va = frame->velocity + 3 * c->body[0], *vb = frame->velocity + 3 * c->body[1];
    const double *pa = frame->pose + 5 * c->body[0], *pb = frame->pose + 5 * c->body[1];
    u[0] = (va[0] - va[2] * (x.at[1] - pa[1])) - (vb[0] - vb[2] * (x.at[1] - pb[1]));
    u[1] = (va[1] + va[2] * (x.at[0] - pa[0])) - (vb[1] + vb[2] * (x.at[0] - pb[0]));
    return pm_dot(u, x.direction) + x.couple[0] * va[2] + x.couple[1] * vb[2];
}

double pm_constraint_slip(const pm_frame *frame, const pm_constraint *c)
{
    return pm_constraint_rate(frame, c) - pm_drive_rate(frame, c);
}

/* Active constraints, and behind them the tangents that sliding normals carry, closed by an entry without normal. */
int pm_constraint_all_steady(const pm_frame *frame, const pm_active_set *active, const pm_constant_motion *x)
{
    const pm_constraint *c = active->constraint;
    for (int i = 0; i < active->n || c[i].normal != PM_NONE; i++) {
        const pm_constraint_ops *ops = pm_constraint_kind(c[i].kind);
        if (!ops->steady || !ops->steady(frame, &c[i], x)) return 0;
    }
    return 1;
}
