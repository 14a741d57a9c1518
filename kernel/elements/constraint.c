/* constraint.c - the table of row kinds, and what all rows share. */
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
        [PM_CONSTRAINT_DRIVE_X] = &pm_constraint_drive_x,
        [PM_CONSTRAINT_DRIVE_Y] = &pm_constraint_drive_y,
        [PM_CONSTRAINT_RATIO] = &pm_constraint_ratio,
    };
    return kinds[kind];
}

pm_marks pm_constraint_marks(const pm_frame *frame, const pm_constraint *row)
{
    pm_marks x = {.a = pm_frame_point(frame, row->body[0], row->a[0], row->a[1]),
                  .b = pm_frame_point(frame, row->body[1], row->b[0], row->b[1])};
    x.omega_a = frame->velocity[3 * row->body[0] + 2];
    x.omega_b = frame->velocity[3 * row->body[1] + 2];
    for (int k = 0; k < 2; k++) {
        x.d[k] = x.a.p[k] - x.b.p[k];
        x.u[k] = x.a.v[k] - x.b.v[k];
        x.quad[k] = -x.omega_a * x.omega_a * x.a.r[k] + x.omega_b * x.omega_b * x.b.r[k];
    }
    return x;
}

/* Greatest size of omega^2 and alpha together while omega grows by alpha. */
static double hardest_turn(double omega, double alpha, double h)
{
    const double fastest = fabs(omega) + fabs(alpha) * h;
    return hypot(fastest * fastest, alpha);
}

pm_constraint_reach pm_constraint_reach_of(const pm_constraint *row, const pm_marks *x, const double *a,
                                           double h)
{
    const double *aa = a + 3 * row->body[0], *ab = a + 3 * row->body[1];
    pm_constraint_reach r = {.apart = {aa[0] - ab[0], aa[1] - ab[1]}};
    r.turn = fabs(x->omega_b) + fabs(ab[2]) * h;
    r.spin = hardest_turn(x->omega_b, ab[2], h);
    r.swing = pm_length(x->a.r) * hardest_turn(x->omega_a, aa[2], h) + pm_length(x->b.r) * r.spin;
    const double speed = pm_length(x->u);
    r.rate = speed + (pm_length(r.apart) + r.swing) * h;
    r.distance = pm_length(x->d) + r.rate * h;
    return r;
}

void pm_constraint_along(pm_constraint *row, const pm_marks *x, const double n[2], double factor)
{
    row->j[0] = factor * n[0];
    row->j[1] = factor * n[1];
    row->j[2] = factor * pm_cross(x->a.r, n);
    row->j[3] = -factor * n[0];
    row->j[4] = -factor * n[1];
    row->j[5] = -factor * pm_cross(x->b.r, n);
}

double pm_constraint_rate(const pm_frame *frame, const pm_constraint *row)
{
    pm_line_of_action x;
    pm_constraint_kind(row->kind)->act(frame, row, &x);
    double u[2];
    const double *va = frame->velocity + 3 * row->body[0], *vb = frame->velocity + 3 * row->body[1];
    const double *pa = frame->pose + 5 * row->body[0], *pb = frame->pose + 5 * row->body[1];
    u[0] = (va[0] - va[2] * (x.at[1] - pa[1])) - (vb[0] - vb[2] * (x.at[1] - pb[1]));
    u[1] = (va[1] + va[2] * (x.at[0] - pa[0])) - (vb[1] + vb[2] * (x.at[0] - pb[0]));
    return pm_dot(u, x.direction) + x.couple[0] * va[2] + x.couple[1] * vb[2];
}

double pm_constraint_slip(const pm_frame *frame, const pm_constraint *row)
{
    return pm_constraint_rate(frame, row) - pm_drive_rate(frame, row->drive);
}
