/* constraint_marks.c - the two marks of a row (points, lines, circles of the model's tables) with the numbers of the case. */

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "state/workspace.h"

pm_constraint pm_constraint_marks_blank(int kind)
{
    pm_constraint row;
    memset(&row, 0, sizeof row);
    row.kind = kind;
    row.sign = row.ratio = 1;
    row.memory = row.joint = row.slot = row.normal = row.drive = PM_NONE;
    return row;
}

static void mark(const pm_frame *frame, int point, int *body, double at[2])
{
    const int32_t *e = PM_POINT_ROW(frame->model, point);
    *body = pm_body_index(frame->model, e[PM_POINT_BODY]);
    at[0] = frame->numbers->value[e[PM_POINT_X]];
    at[1] = frame->numbers->value[e[PM_POINT_Y]];
}

void pm_constraint_marks_points(const pm_frame *frame, pm_constraint *row, int a, int b)
{
    mark(frame, a, &row->body[0], row->a);
    mark(frame, b, &row->body[1], row->b);
}

void pm_constraint_marks_point_and_line(const pm_frame *frame, pm_constraint *row, int point, int line)
{
    const int32_t *e = PM_LINE_ROW(frame->model, line);
    pm_constraint_marks_points(frame, row, point, e[PM_LINE_POINT]);
    row->value = frame->numbers->value[e[PM_LINE_ANGLE]];
    row->axis[0] = cos(row->value);
    row->axis[1] = sin(row->value);
}

void pm_constraint_marks_circle_and_line(const pm_frame *frame, pm_constraint *row, int circle, int line)
{
    const int32_t *e = PM_CIRCLE_ROW(frame->model, circle);
    pm_constraint_marks_point_and_line(frame, row, e[PM_CIRCLE_POINT], line);
    row->radius_a = frame->numbers->value[e[PM_CIRCLE_RADIUS]];
}

/* Signs of the radii by side: outside each other (+, +); a inside b (-, +); b inside a (+, -). */
void pm_constraint_marks_radii(pm_constraint *row, double radius_a, double radius_b, double side)
{
    row->radius_a = side == -1 ? -radius_a : radius_a;
    row->radius_b = side == -2 ? -radius_b : radius_b;
    row->value = row->radius_a + row->radius_b;
    row->sign = side < 0 ? -1 : 1;
}

void pm_constraint_marks_circles(const pm_frame *frame, pm_constraint *row, int a, int b, double side)
{
    const int32_t *ea = PM_CIRCLE_ROW(frame->model, a), *eb = PM_CIRCLE_ROW(frame->model, b);
    pm_constraint_marks_points(frame, row, ea[PM_CIRCLE_POINT], eb[PM_CIRCLE_POINT]);
    pm_constraint_marks_radii(row, frame->numbers->value[ea[PM_CIRCLE_RADIUS]],
                              frame->numbers->value[eb[PM_CIRCLE_RADIUS]], side);
}

/* A strand from circle a to circle b; which way round each it goes is the sign of its radius. */
void pm_constraint_marks_strand(const pm_frame *frame, pm_constraint *row, int a, int b, double sense_a,
                                double sense_b)
{
    const int32_t *ea = PM_CIRCLE_ROW(frame->model, a), *eb = PM_CIRCLE_ROW(frame->model, b);
    row->kind = PM_CONSTRAINT_STRAND;
    pm_constraint_marks_points(frame, row, ea[PM_CIRCLE_POINT], eb[PM_CIRCLE_POINT]);
    row->radius_a = sense_a * frame->numbers->value[ea[PM_CIRCLE_RADIUS]];
    row->radius_b = sense_b * frame->numbers->value[eb[PM_CIRCLE_RADIUS]];
}

void pm_constraint_marks_member(const pm_frame *frame, pm_constraint *row, int circle, int of, int member)
{
    const int32_t *ec = PM_CIRCLE_ROW(frame->model, circle), *er = PM_ROW_ROW(frame->model, of);
    pm_constraint_marks_points(frame, row, ec[PM_CIRCLE_POINT], er[PM_ROW_POINT]);
    row->b[0] += member * frame->numbers->value[er[PM_ROW_STEP_X]];
    row->b[1] += member * frame->numbers->value[er[PM_ROW_STEP_Y]];
    pm_constraint_marks_radii(row, frame->numbers->value[ec[PM_CIRCLE_RADIUS]], 0, 1);
}
