/* row.c - the table of row kinds, and what all rows share. */
#include "row.h"

#include "drive.h"

const pm_row_ops *pm_row_kind(int kind)
{
    static const pm_row_ops *const kinds[PM_ROW_KINDS] = {
        [PM_ROW_POINT_X] = &pm_row_point_x,
        [PM_ROW_POINT_Y] = &pm_row_point_y,
        [PM_ROW_LINE_NORMAL] = &pm_row_line_normal,
        [PM_ROW_LINE_TANGENT] = &pm_row_line_tangent,
        [PM_ROW_DISTANCE] = &pm_row_distance,
        [PM_ROW_CIRCLE_TANGENT] = &pm_row_circle_tangent,
        [PM_ROW_ANGLE] = &pm_row_angle,
        [PM_ROW_STRAND] = &pm_row_strand,
        [PM_ROW_DRIVE_X] = &pm_row_drive_x,
        [PM_ROW_DRIVE_Y] = &pm_row_drive_y,
        [PM_ROW_TURN] = &pm_row_turn,
    };
    return kinds[kind];
}

pm_marks pm_row_marks(const pm_workspace *w, const pm_row *row)
{
    pm_marks x = {.a = pm_point_at(w, row->body[0], row->a[0], row->a[1]),
                  .b = pm_point_at(w, row->body[1], row->b[0], row->b[1])};
    x.omega_a = w->frame.velocity[3 * row->body[0] + 2];
    x.omega_b = w->frame.velocity[3 * row->body[1] + 2];
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

pm_row_reach pm_row_reach_of(const pm_row *row, const pm_marks *x, const double *a, double h)
{
    const double *aa = a + 3 * row->body[0], *ab = a + 3 * row->body[1];
    pm_row_reach r = {.apart = {aa[0] - ab[0], aa[1] - ab[1]}};
    r.turn = fabs(x->omega_b) + fabs(ab[2]) * h;
    r.spin = hardest_turn(x->omega_b, ab[2], h);
    r.swing = pm_length(x->a.r) * hardest_turn(x->omega_a, aa[2], h) + pm_length(x->b.r) * r.spin;
    const double speed = pm_length(x->u);
    r.rate = speed + (pm_length(r.apart) + r.swing) * h;
    r.distance = pm_length(x->d) + r.rate * h;
    return r;
}

void pm_row_along(pm_row *row, const pm_marks *x, const double n[2], double factor)
{
    row->j[0] = factor * n[0];
    row->j[1] = factor * n[1];
    row->j[2] = factor * pm_cross(x->a.r, n);
    row->j[3] = -factor * n[0];
    row->j[4] = -factor * n[1];
    row->j[5] = -factor * pm_cross(x->b.r, n);
}

double pm_row_rate(const pm_workspace *w, const pm_row *row)
{
    pm_line_of_action x;
    pm_row_kind(row->kind)->act(w, row, &x);
    double u[2];
    const double *va = w->frame.velocity + 3 * row->body[0], *vb = w->frame.velocity + 3 * row->body[1];
    const double *pa = w->frame.pose + 5 * row->body[0], *pb = w->frame.pose + 5 * row->body[1];
    u[0] = (va[0] - va[2] * (x.at[1] - pa[1])) - (vb[0] - vb[2] * (x.at[1] - pb[1]));
    u[1] = (va[1] + va[2] * (x.at[0] - pa[0])) - (vb[1] + vb[2] * (x.at[0] - pb[0]));
    return pm_dot(u, x.direction) + x.couple[0] * va[2] + x.couple[1] * vb[2];
}

double pm_row_slip(const pm_workspace *w, const pm_row *row)
{
    return pm_row_rate(w, row) - pm_drive_rate(w, row->drive);
}
