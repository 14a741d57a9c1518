/* constraint_marks.c - the two marks of a constraint (points, lines, circles of the model's tables) with the numbers of
 * the case. */

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "numerics/lanes.h"
#include "state/workspace.h"

void pm_constraint_marks_blank(pm_constraint *c, int kind)
{
    memset(c, 0, sizeof *c);
    c->kind = kind;
    c->sign = c->ratio = 1;
    c->memory = c->curve = c->foot = c->other = c->joint = c->slot = c->normal = c->drive = PM_NONE;
}

static void mark(const pm_frame *frame, int point, int *body, double at[2])
{
    const int32_t *e = PM_POINT_ROW(frame->model, point);
    *body = pm_model_body_index(frame->model, e[PM_POINT_BODY]);
    at[0] = frame->numbers->value[e[PM_POINT_X]];
    at[1] = frame->numbers->value[e[PM_POINT_Y]];
}

void pm_constraint_marks_points(const pm_frame *frame, pm_constraint *c, int a, int b)
{
    mark(frame, a, &c->body[0], c->a);
    mark(frame, b, &c->body[1], c->b);
}

void pm_constraint_marks_point_and_line(const pm_frame *frame, pm_constraint *c, int point, int line)
{
    const int32_t *e = PM_LINE_ROW(frame->model, line);
    pm_constraint_marks_points(frame, c, point, e[PM_LINE_POINT]);
    c->value = frame->numbers->value[e[PM_LINE_ANGLE]];
    pm_lanes_store(c->axis, pm_lanes_axis(c->value));
}

void pm_constraint_marks_circle_and_line(const pm_frame *frame, pm_constraint *c, int circle, int line)
{
    const int32_t *e = PM_CIRCLE_ROW(frame->model, circle);
    pm_constraint_marks_point_and_line(frame, c, e[PM_CIRCLE_POINT], line);
    c->radius_a = frame->numbers->value[e[PM_CIRCLE_RADIUS]];
}

/* Signs of the radii by side: outside each other (+, +); a inside b (-, +); b inside a (+, -). */
void pm_constraint_marks_radii(pm_constraint *c, double radius_a, double radius_b, double side)
{
    c->radius_a = side == -1 ? -radius_a : radius_a;
    c->radius_b = side == -2 ? -radius_b : radius_b;
    c->value = c->radius_a + c->radius_b;
    c->sign = side < 0 ? -1 : 1;
}

void pm_constraint_marks_circles(const pm_frame *frame, pm_constraint *c, int a, int b, double side)
{
    const int32_t *ea = PM_CIRCLE_ROW(frame->model, a), *eb = PM_CIRCLE_ROW(frame->model, b);
    pm_constraint_marks_points(frame, c, ea[PM_CIRCLE_POINT], eb[PM_CIRCLE_POINT]);
    pm_constraint_marks_radii(c, frame->numbers->value[ea[PM_CIRCLE_RADIUS]],
                              frame->numbers->value[eb[PM_CIRCLE_RADIUS]], side);
}

void pm_constraint_marks_curve(const pm_frame *frame, pm_constraint *c, int point, int curve)
{
    pm_constraint_marks_points(frame, c, point, PM_CURVE_ROW(frame->model, curve)[PM_CURVE_POINT]);
    c->curve = curve;
}

void pm_constraint_marks_circle_and_curve(const pm_frame *frame, pm_constraint *c, int circle, int curve)
{
    const int32_t *e = PM_CIRCLE_ROW(frame->model, circle);
    pm_constraint_marks_curve(frame, c, e[PM_CIRCLE_POINT], curve);
    c->radius_a = frame->numbers->value[e[PM_CIRCLE_RADIUS]];
}

void pm_constraint_marks_curves(const pm_frame *frame, pm_constraint *c, int first, int curve)
{
    pm_constraint_marks_curve(frame, c, PM_CURVE_ROW(frame->model, first)[PM_CURVE_POINT], curve);
    c->other = first;
}

/* A strand from circle a to circle b; which way round each it goes is the sign of its radius. */
void pm_constraint_marks_strand(const pm_frame *frame, pm_constraint *c, int a, int b, double sense_a,
                                double sense_b)
{
    const int32_t *ea = PM_CIRCLE_ROW(frame->model, a), *eb = PM_CIRCLE_ROW(frame->model, b);
    c->kind = PM_CONSTRAINT_STRAND;
    pm_constraint_marks_points(frame, c, ea[PM_CIRCLE_POINT], eb[PM_CIRCLE_POINT]);
    c->radius_a = sense_a * frame->numbers->value[ea[PM_CIRCLE_RADIUS]];
    c->radius_b = sense_b * frame->numbers->value[eb[PM_CIRCLE_RADIUS]];
}

void pm_constraint_marks_cord(const pm_frame *frame, pm_constraint *c, const int circle[3],
                              const int32_t sense[3])
{
    const int32_t *rim = PM_CIRCLE_ROW(frame->model, circle[2]);
    pm_constraint_marks_strand(frame, c, circle[0], circle[1], sense[0], sense[1]);
    mark(frame, rim[PM_CIRCLE_POINT], &c->body[2], c->rim);
    c->kind = PM_CONSTRAINT_CORD;
    c->over = 1;
    c->radius_rim = sense[2] * frame->numbers->value[rim[PM_CIRCLE_RADIUS]];
}

void pm_constraint_marks_pressure(pm_constraint *c, double angle)
{
    c->teeth[0] = cos(angle);
    c->teeth[1] = sin(angle);
}

void pm_constraint_marks_pattern(const pm_frame *frame, pm_constraint *c, int circle, int of)
{
    const int32_t *ec = PM_CIRCLE_ROW(frame->model, circle), *er = PM_PATTERN_ROW(frame->model, of);
    pm_constraint_marks_points(frame, c, ec[PM_CIRCLE_POINT], er[PM_PATTERN_POINT]);
    pm_constraint_marks_radii(c, frame->numbers->value[ec[PM_CIRCLE_RADIUS]], 0, 1);
}
