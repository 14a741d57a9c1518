/* gap_culling.c - how far bodies move in a step, against the gaps of open contacts.
 *
 * The gap of a circle beside a fixed line or fixed points, or beside another circle, changes by no more than their centres
 * move.  A centre moves by no more than its body's origin does, plus its distance from there times the angle of rotation.  So a
 * gap that was g once is at least g - s after its bodies have moved by s together, whatever the way: it is looked at again when
 * s has come to a part of g.  What is not looked at could neither have closed nor have come near to it. */
#include "events/gap_culling.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "elements/edge.h"
#include "events/event.h"
#include "numerics/lanes.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* A curve of a body reaches so far from its origin. */
static void reach(pm_gap_culling *x, const pm_model *m, int body, double far)
{
    if (body < m->nbody) x->radius[body] = pm_max(far, x->radius[body]);
}

void pm_gap_culling_begin(pm_gap_culling *x, const pm_frame *frame)
{
    const pm_model *m = frame->model;
    memset(x->left, 0, (size_t)m->rows[PM_TABLE_CONTACT] * sizeof(double));
    memset(x->skipped, 0, (size_t)m->rows[PM_TABLE_CONTACT]);
    memset(x->moved, 0, ((size_t)m->nbody + 1) * sizeof(double));
    memset(x->radius, 0, (size_t)m->nbody * sizeof(double));
    for (int i = 0; i < m->rows[PM_TABLE_CIRCLE]; i++) {
        const int32_t *p = PM_POINT_ROW(m, PM_CIRCLE_ROW(m, i)[PM_CIRCLE_POINT]);
        const int body = p[PM_POINT_BODY];
        const double at[2] = {frame->numbers->value[p[PM_POINT_X]], frame->numbers->value[p[PM_POINT_Y]]};
        if (body != PM_GROUND) x->radius[body] = pm_max(pm_length(at), x->radius[body]);
    }
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        const pm_constraint *c = &frame->numbers->of_contact[i];
        if (!pm_contact_curve_is(m, i)) continue;
        reach(x, m, c->body[1], pm_length(c->b) + frame->numbers->course[c->curve].far);
        if (c->other != PM_NONE)
            reach(x, m, c->body[0], pm_length(c->a) + frame->numbers->course[c->other].far);
    }
}

static int body_of_curve(const pm_model *m, int curve)
{
    return pm_model_body_index(m, pm_model_body_of(m, PM_TABLE_CURVE, curve));
}

static int body_of_circle(const pm_model *m, int circle)
{
    return pm_model_body_index(m, PM_POINT_ROW(m, PM_CIRCLE_ROW(m, circle)[PM_CIRCLE_POINT])[PM_POINT_BODY]);
}

int pm_gap_culling_bodies(const pm_model *m, int contact, int body[2])
{
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    int point;
    const int curves = e[PM_CONTACT_KIND] == PM_CONTACT_CURVES;
    body[0] = curves ? body_of_curve(m, e[PM_CONTACT_A]) : body_of_circle(m, e[PM_CONTACT_A]);
    body[1] = m->nbody;
    switch (e[PM_CONTACT_KIND]) {
    case PM_CONTACT_LINE: point = PM_LINE_ROW(m, e[PM_CONTACT_B])[PM_LINE_POINT]; break;
    case PM_CONTACT_PATTERN: point = PM_PATTERN_ROW(m, e[PM_CONTACT_B])[PM_PATTERN_POINT]; break;
    case PM_CONTACT_CIRCLE: body[1] = body_of_circle(m, e[PM_CONTACT_B]); return 1;
    case PM_CONTACT_CURVES:
        if (body[0] != m->nbody && pm_curve_is_endless(m, e[PM_CONTACT_A])) return 0;
        body[1] = body_of_curve(m, e[PM_CONTACT_B]);
        return 1;
    case PM_CONTACT_CURVE: body[1] = body_of_curve(m, e[PM_CONTACT_B]); return 1;
    default: return 0;
    }
    return PM_POINT_ROW(m, point)[PM_POINT_BODY] == PM_GROUND;
}

static double moved(const pm_gap_culling *x, const int body[2])
{
    return x->moved[body[0]] + x->moved[body[1]];
}

void pm_gap_culling_step(pm_gap_culling *x, const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        int body[2];
        x->skipped[i] = x->left[i] > 0 && pm_gap_culling_bodies(m, i, body) &&
                        x->left[i] > PM_CULLING_LIKE_BEFORE * PM_CULLING_BETWEEN * moved(x, body);
    }
    memset(x->moved, 0, ((size_t)m->nbody + 1) * sizeof(double));
}

void pm_gap_culling_node(pm_gap_culling *x, const pm_frame *frame, int node)
{
    if (frame->model->rows[PM_TABLE_CONTACT] == 0) return;
    for (int i = 0; i < frame->model->nbody; i++) {
        const double *pose = frame->pose + 5 * i, *from = x->pose + 3 * i;
        pm_lanes_copy_threes(x->pose + 3 * (node * frame->model->nbody + i), pose, 1);
        if (node == 0) continue;
        const double way[2] = {pose[0] - from[0], pose[1] - from[1]};
        x->moved[i] = pm_max(pm_length(way) + x->radius[i] * fabs(pose[2] - from[2]), x->moved[i]);
    }
}

int pm_gap_culling_check(pm_gap_culling *x, const pm_model *m)
{
    int reached = 0;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        int body[2];
        if (!x->skipped[i] || !pm_gap_culling_bodies(m, i, body)) continue;
        x->left[i] -= PM_CULLING_BETWEEN * moved(x, body);
        x->nskipped += x->left[i] > 0;
        if (x->left[i] > 0) continue;
        x->skipped[i] = 0;
        reached++;
    }
    return reached;
}

void pm_gap_culling_keep(pm_gap_culling *x, const pm_model *m, int contact, double gap)
{
    int body[2];
    if (pm_gap_culling_bodies(m, contact, body))
        x->left[contact] = PM_CULLING_PART * gap - PM_CULLING_BETWEEN * moved(x, body);
}
