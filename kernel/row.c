/* row.c - the table of row kinds, and which rows a joint or a closed contact contributes. */
#include "row.h"

#include <string.h>

#include "drive.h"
#include "segment.h"

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
    return pm_dot(u, x.direction) + x.couple * (va[2] - vb[2]);
}

double pm_row_slip(const pm_workspace *w, const pm_row *row)
{
    return pm_row_rate(w, row) - pm_drive_rate(w, row->drive);
}

static pm_row blank(int kind)
{
    pm_row row;
    memset(&row, 0, sizeof row);
    row.kind = kind;
    row.sign = 1;
    row.memory = row.joint = row.slot = row.normal = row.drive = PM_NONE;
    return row;
}

static void mark(const pm_workspace *w, int point, int *body, double at[2])
{
    const int32_t *e = PM_POINT_ROW(w->model, point);
    *body = pm_body_index(w->model, e[PM_POINT_BODY]);
    at[0] = w->value[e[PM_POINT_X]];
    at[1] = w->value[e[PM_POINT_Y]];
}

static void two_points(const pm_workspace *w, pm_row *row, int a, int b)
{
    mark(w, a, &row->body[0], row->a);
    mark(w, b, &row->body[1], row->b);
}

static void point_and_line(const pm_workspace *w, pm_row *row, int point, int line)
{
    const int32_t *e = PM_LINE_ROW(w->model, line);
    two_points(w, row, point, e[PM_LINE_POINT]);
    row->value = w->value[e[PM_LINE_ANGLE]];
    row->axis[0] = cos(row->value);
    row->axis[1] = sin(row->value);
}

static void circle_and_line(const pm_workspace *w, pm_row *row, int circle, int line)
{
    const int32_t *e = PM_CIRCLE_ROW(w->model, circle);
    point_and_line(w, row, e[PM_CIRCLE_POINT], line);
    row->radius_a = w->value[e[PM_CIRCLE_RADIUS]];
}

/* Signs of the radii by side: outside each other (+, +); a inside b (-, +); b inside a (+, -). */
static void two_circles(pm_row *row, double radius_a, double radius_b, double side)
{
    row->radius_a = side == -1 ? -radius_a : radius_a;
    row->radius_b = side == -2 ? -radius_b : radius_b;
    row->value = row->radius_a + row->radius_b;
    row->sign = side < 0 ? -1 : 1;
}

static void circles(const pm_workspace *w, pm_row *row, int a, int b, double side)
{
    const int32_t *ea = PM_CIRCLE_ROW(w->model, a), *eb = PM_CIRCLE_ROW(w->model, b);
    two_points(w, row, ea[PM_CIRCLE_POINT], eb[PM_CIRCLE_POINT]);
    two_circles(row, w->value[ea[PM_CIRCLE_RADIUS]], w->value[eb[PM_CIRCLE_RADIUS]], side);
}

/* A strand from circle a to circle b; which way round each it goes is the sign of its radius. */
static void strand(const pm_workspace *w, pm_row *row, int a, int b, double sense_a, double sense_b)
{
    const int32_t *ea = PM_CIRCLE_ROW(w->model, a), *eb = PM_CIRCLE_ROW(w->model, b);
    *row = blank(PM_ROW_STRAND);
    two_points(w, row, ea[PM_CIRCLE_POINT], eb[PM_CIRCLE_POINT]);
    row->radius_a = sense_a * w->value[ea[PM_CIRCLE_RADIUS]];
    row->radius_b = sense_b * w->value[eb[PM_CIRCLE_RADIUS]];
}

static void member_of_row(const pm_workspace *w, pm_row *row, int circle, int of, int member)
{
    const int32_t *ec = PM_CIRCLE_ROW(w->model, circle), *er = PM_ROW_ROW(w->model, of);
    two_points(w, row, ec[PM_CIRCLE_POINT], er[PM_ROW_POINT]);
    row->b[0] += member * w->value[er[PM_ROW_STEP_X]];
    row->b[1] += member * w->value[er[PM_ROW_STEP_Y]];
    two_circles(row, w->value[ec[PM_CIRCLE_RADIUS]], 0, 1);
}

static void corner_of_segment(const pm_workspace *w, pm_row *row, int contact, int member)
{
    pm_segment_corner(w, contact, member, row->b);
    two_circles(row, row->radius_a, 0, 1);
}

int pm_row_of_joint(const pm_workspace *w, int joint, pm_row row[PM_JOINT_ROWS])
{
    if (pm_is_absent(w->model, &w->state, PM_TABLE_JOINT, joint)) return 0;
    return pm_row_of_any_joint(w, joint, row);
}

int pm_row_of_any_joint(const pm_workspace *w, int joint, pm_row row[PM_JOINT_ROWS])
{
    const int32_t *e = PM_JOINT_ROW(w->model, joint);
    const int a = e[PM_JOINT_A], b = e[PM_JOINT_B], kind = e[PM_JOINT_KIND];
    int n = 0;
    switch ((enum pm_joint_kind)kind) {
    case PM_JOINT_PIN:
    case PM_JOINT_WELD:
        row[0] = blank(PM_ROW_POINT_X);
        row[1] = blank(PM_ROW_POINT_Y);
        two_points(w, &row[0], a, b);
        two_points(w, &row[1], a, b);
        n = 2;
        break;
    case PM_JOINT_SLIDER:
    case PM_JOINT_SLIDER_FIXED:
        row[0] = blank(PM_ROW_LINE_NORMAL);
        point_and_line(w, &row[0], a, b);
        n = 1;
        break;
    case PM_JOINT_LINK:
        row[0] = blank(PM_ROW_DISTANCE);
        two_points(w, &row[0], a, b);
        row[0].value = w->value[e[PM_JOINT_VALUE]];
        n = 1;
        break;
    case PM_JOINT_ROLLING_LINE:
        row[0] = blank(PM_ROW_LINE_NORMAL);
        row[1] = blank(PM_ROW_LINE_TANGENT);
        circle_and_line(w, &row[0], a, b);
        circle_and_line(w, &row[1], a, b);
        n = 2;
        break;
    case PM_JOINT_ROLLING_CIRCLE:
        row[0] = blank(PM_ROW_DISTANCE);
        row[1] = blank(PM_ROW_CIRCLE_TANGENT);
        circles(w, &row[0], a, b, w->value[e[PM_JOINT_VALUE]]);
        circles(w, &row[1], a, b, w->value[e[PM_JOINT_VALUE]]);
        n = 2;
        break;
    case PM_JOINT_GEARS:
        row[0] = blank(PM_ROW_CIRCLE_TANGENT);
        circles(w, &row[0], a, b, w->value[e[PM_JOINT_VALUE]]);
        n = 1;
        break;
    case PM_JOINT_BELT: /* the strand that leaves a counterclockwise, the one that leaves it clockwise */
        for (n = 0; n < 2; n++) {
            const double sense = n == 0 ? 1 : -1;
            strand(w, &row[n], a, b, sense, w->value[e[PM_JOINT_VALUE]] * sense);
        }
        break;
    case PM_JOINT_RATE:
        row[0] = blank(PM_ROW_TURN);
        row[0].body[0] = pm_body_index(w->model, a);
        row[0].body[1] = pm_body_index(w->model, b);
        row[0].drive = e[PM_JOINT_PROGRAM_X];
        n = 1;
        break;
    case PM_JOINT_DRIVE:
        for (n = 0; n < 2; n++) {
            row[n] = blank(n == 0 ? PM_ROW_DRIVE_X : PM_ROW_DRIVE_Y);
            two_points(w, &row[n], a, b);
            row[n].drive = e[n == 0 ? PM_JOINT_PROGRAM_X : PM_JOINT_PROGRAM_Y];
        }
        break;
    case PM_JOINT_KINDS: break;
    }
    if (kind == PM_JOINT_WELD || kind == PM_JOINT_SLIDER_FIXED) {
        row[n] = blank(PM_ROW_ANGLE);
        row[n].body[0] = row[0].body[0];
        row[n].body[1] = row[0].body[1];
        row[n++].value = w->value[e[PM_JOINT_VALUE]];
    }
    const int memory = w->model->joint_memory[joint];
    for (int k = 0; k < n; k++) {
        row[k].joint = joint;
        if (memory != PM_NONE && pm_row_kind(row[k].kind)->remember)
            row[k].memory = memory + k - (n - pm_model_memories(kind));
    }
    return n;
}

void pm_row_of_contact(const pm_workspace *w, int contact, int slot, int member, pm_row *normal,
                       pm_row *tangent)
{
    const pm_model *m = w->model;
    const int32_t *e = PM_CONTACT_ROW_OF(m, contact);
    const int a = e[PM_CONTACT_A], b = e[PM_CONTACT_B];
    switch ((enum pm_contact_kind)e[PM_CONTACT_KIND]) {
    case PM_CONTACT_LINE:
        *normal = blank(PM_ROW_LINE_NORMAL);
        circle_and_line(w, normal, a, b);
        break;
    case PM_CONTACT_SEGMENT:
        *normal = blank(member == PM_SEGMENT_FACE ? PM_ROW_LINE_NORMAL : PM_ROW_DISTANCE);
        circle_and_line(w, normal, a, b);
        if (member != PM_SEGMENT_FACE) corner_of_segment(w, normal, contact, member);
        break;
    case PM_CONTACT_CIRCLE:
        *normal = blank(PM_ROW_DISTANCE);
        circles(w, normal, a, b, w->value[e[PM_CONTACT_SIDE]]);
        break;
    case PM_CONTACT_POINT:
        *normal = blank(PM_ROW_DISTANCE);
        circles(w, normal, a, b, 1);
        break;
    case PM_CONTACT_CORD: strand(w, normal, a, b, e[PM_CONTACT_SENSE_A], e[PM_CONTACT_SENSE_B]); break;
    case PM_CONTACT_ROW:
    case PM_CONTACT_KINDS:
        *normal = blank(PM_ROW_DISTANCE);
        member_of_row(w, normal, a, b, member);
        break;
    }
    normal->slot = slot;
    *tangent = *normal;
    tangent->memory = m->nmemory - m->nslot + slot;
    if (normal->kind == PM_ROW_STRAND) { /* nothing acts across a cord: it is smooth */
        normal->memory = tangent->memory;
        return;
    }
    tangent->kind = normal->kind == PM_ROW_LINE_NORMAL ? PM_ROW_LINE_TANGENT : PM_ROW_CIRCLE_TANGENT;
    if (tangent->kind == PM_ROW_LINE_TANGENT) tangent->drive = e[PM_CONTACT_SPEED]; /* corners do not run */
}
