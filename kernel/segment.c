/* segment.c - a circle (or a point: radius 0) beside a straight edge that ends.
 *
 * Along the edge s, from its front h, beyond its nearer end by o > 0 (o < 0: within), R the radius:
 *   beyond    in front   sqrt(o^2 + h^2) - R, the gap to the corner;   behind it no more than o
 *   within    h - R, but on the back, where nothing touches, not below o
 * so that it is continuous where nothing overlaps, and falls through zero also where a mark passes under an end: that is
 * no contact (pm_segment_behind).  A corner is a circle of radius 0: where a circle goes over to it from the face both
 * have the same normal. */
#include "segment.h"

#include <math.h>

#include "body.h"
#include "contact.h"
#include "row.h"

typedef struct pm_beside_edge {
    double height, radius;
    double from, to; /* beyond these ends, negative within */
} pm_beside_edge;

int pm_segment_is(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW_OF(m, contact)[PM_CONTACT_KIND] == PM_CONTACT_SEGMENT;
}

static double end_of(const pm_workspace *w, int contact, int column)
{
    return w->value[PM_CONTACT_ROW_OF(w->model, contact)[column]];
}

static pm_beside_edge beside(const pm_workspace *w, int contact)
{
    const pm_model *m = w->model;
    const int32_t *e = PM_CONTACT_ROW_OF(m, contact);
    const int32_t *circle = PM_CIRCLE_ROW(m, e[PM_CONTACT_A]), *line = PM_LINE_ROW(m, e[PM_CONTACT_B]);
    const pm_point a = pm_point_of(w, circle[PM_CIRCLE_POINT]), b = pm_point_of(w, line[PM_LINE_POINT]);
    const double angle = w->frame.pose[5 * b.body + 2] + w->value[line[PM_LINE_ANGLE]];
    const double t[2] = {cos(angle), sin(angle)}, d[2] = {a.p[0] - b.p[0], a.p[1] - b.p[1]};
    const double along = pm_dot(d, t), reach = pm_contact_length(w);
    return (pm_beside_edge){.height = pm_cross(t, d),
                            .radius = w->value[circle[PM_CIRCLE_RADIUS]],
                            .from = end_of(w, contact, PM_CONTACT_FROM) - along - reach,
                            .to = along - end_of(w, contact, PM_CONTACT_TO) - reach};
}

double pm_segment_gap(const pm_workspace *w, int contact, int *member)
{
    const pm_beside_edge x = beside(w, contact);
    const double beyond = fmax(x.from, x.to);
    *member = PM_SEGMENT_FACE;
    if (beyond <= 0) return fmax(x.height - x.radius, beyond);
    if (x.radius > 0) *member = x.from > x.to ? PM_SEGMENT_FROM : PM_SEGMENT_TO;
    const double gap = hypot(beyond, x.height) - x.radius;
    return x.height < 0 ? fmin(gap, beyond) : gap;
}

int pm_segment_behind(const pm_workspace *w, int contact)
{
    const pm_beside_edge x = beside(w, contact);
    return fmax(x.from, x.to) <= 0 && x.height < -pm_contact_length(w);
}

double pm_segment_room(const pm_workspace *w, int contact, int member)
{
    const pm_beside_edge x = beside(w, contact);
    if (member == PM_SEGMENT_FACE) return -fmax(x.from, x.to);
    return (member == PM_SEGMENT_FROM ? x.from : x.to) + pm_contact_length(w);
}

int pm_segment_next(const pm_workspace *w, int contact, int member)
{
    const pm_beside_edge x = beside(w, contact);
    if (member != PM_SEGMENT_FACE) return PM_SEGMENT_FACE;
    if (!(x.radius > 0)) return PM_NONE;
    return x.from > x.to ? PM_SEGMENT_FROM : PM_SEGMENT_TO;
}

void pm_segment_corner(const pm_workspace *w, int contact, int member, double at[2])
{
    const pm_model *m = w->model;
    const int32_t *line = PM_LINE_ROW(m, PM_CONTACT_ROW_OF(m, contact)[PM_CONTACT_B]);
    const int32_t *point = PM_POINT_ROW(m, line[PM_LINE_POINT]);
    const double angle = w->value[line[PM_LINE_ANGLE]];
    const double along = end_of(w, contact, member == PM_SEGMENT_FROM ? PM_CONTACT_FROM : PM_CONTACT_TO);
    at[0] = w->value[point[PM_POINT_X]] + along * cos(angle);
    at[1] = w->value[point[PM_POINT_Y]] + along * sin(angle);
}

int pm_segment_way(const pm_model *m, int contact, int member)
{
    return pm_segment_is(m, contact) && member != PM_SEGMENT_FACE ? -1 : 1;
}

int pm_segment_any(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++)
        if (pm_segment_is(m, i)) return 1;
    return 0;
}
