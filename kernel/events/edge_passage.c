/* edge_passage.c - marks that go through an edge near one of its ends, between two nodes of a step.
 *
 * Past the end the gap is positive again: no sample tells of it, or only of what the mark does later.  What tells it is
 * the way of the mark beside the edge, from a place (u, h) along it and over it at one node to that at the next.  The way
 * deviates from its chord by
 *   delta <= max |second difference| / 4
 * of the three nodes about either end, as far as they resolve it.  A chord that keeps a distance of more than R + delta
 * from the edge, R the radius of the mark, excludes a passage.  Else the way is looked at in its middle, where its
 * deviation is seen, and each half is judged again. */
#include "events/edge_passage.h"

#include <math.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* From one place of the mark beside its edge to another: where in the step, the gaps there, and how far its way may
 * deviate from the chord between them. */
typedef struct pm_chord {
    double x[2], u[2], h[2], gap[2];
    double deviation, length, radius;
} pm_chord;

/* ---- distances ---- */
/* Of the place (u, h) from the edge from (0, 0) to (length, 0). */
static double to_edge(double u, double h, double length) { return hypot(fmax(fmax(-u, u - length), 0), h); }

/* Of the corner (u, 0) from the chord. */
static double to_chord(const pm_chord *c, double u)
{
    const double along[2] = {c->u[1] - c->u[0], c->h[1] - c->h[0]}, from[2] = {u - c->u[0], -c->h[0]};
    const double whole = pm_dot(along, along);
    const double part = whole > 0 ? fmin(fmax(pm_dot(from, along) / whole, 0), 1) : 0;
    return hypot(from[0] - part * along[0], from[1] - part * along[1]);
}

static int crosses(const pm_chord *c)
{
    if (!(c->h[0] * c->h[1] <= 0) || c->h[0] == c->h[1]) return 0;
    const double u = c->u[0] + (c->u[1] - c->u[0]) * c->h[0] / (c->h[0] - c->h[1]);
    return u >= 0 && u <= c->length;
}

static double distance(const pm_chord *c)
{
    if (crosses(c)) return 0;
    const double ends = fmin(to_edge(c->u[0], c->h[0], c->length), to_edge(c->u[1], c->h[1], c->length));
    return fmin(ends, fmin(to_chord(c, 0), to_chord(c, c->length)));
}

static double way(const pm_chord *c) { return hypot(c->u[1] - c->u[0], c->h[1] - c->h[0]); }

/* ---- places ---- */
static double along_of(const pm_edge_place *x) { return -x->from; }

/* By how far the place at node k deviates from the chord of its neighbours, for a chord between two nodes at the distance
 * `apart`. */
static double bend_at(const pm_event_set *e, const pm_edge_place *x, int k, double apart)
{
    const double before = e->place[k] - e->place[k - 1], after = e->place[k + 1] - e->place[k];
    const double u = (along_of(x + k + 1) - along_of(x + k)) / after -
                     (along_of(x + k) - along_of(x + k - 1)) / before,
                 h = (x[k + 1].height - x[k].height) / after - (x[k].height - x[k - 1].height) / before;
    return 0.25 * apart * apart * hypot(u, h) / (before + after);
}

static pm_chord chord_between(pm_workspace *w, int i, int k)
{
    const pm_event_set *e = w->event;
    const pm_event_function *f = &e->function[i];
    const double *gap = pm_event_samples(w->event, i);
    const pm_edge_place *x = e->beside_edge + f->edge * PM_NODES_MOST;
    const double apart = e->place[k + 1] - e->place[k];
    double deviation = 0;
    if (k > 0) deviation = bend_at(e, x, k, apart);
    if (k + 2 < w->step.nodes->n) deviation = fmax(bend_at(e, x, k + 1, apart), deviation);
    return (pm_chord){.x = {e->place[k], e->place[k + 1]},
                      .u = {along_of(x + k), along_of(x + k + 1)},
                      .h = {x[k].height, x[k + 1].height},
                      .gap = {gap[k], gap[k + 1]},
                      .deviation = PM_PASSAGE_BEND * deviation,
                      .length = -x[k].from - x[k].to,
                      .radius = x[k].radius};
}

/* ---- passages ---- */
static int is_excluded(const pm_chord *c) { return distance(c) > c->radius + c->deviation; }

/* All along the chord the mark is over the edge, or under it: its gap is its height. */
static int is_within(const pm_chord *c)
{
    return fmin(c->u[0], c->u[1]) > c->deviation && fmax(c->u[0], c->u[1]) < c->length - c->deviation;
}

static void halve(pm_workspace *w, pm_event_function *f, pm_event_at *gap_at, const pm_chord *c,
                  pm_chord half[2])
{
    const double middle = 0.5 * (c->x[0] + c->x[1]), gap = gap_at(w, middle, f);
    const pm_edge_place at = pm_edge_beside(&w->frame, f->index);
    const double u = along_of(&at), h = at.height;
    half[0] = half[1] = *c;
    half[0].x[1] = half[1].x[0] = middle;
    half[0].u[1] = half[1].u[0] = u;
    half[0].h[1] = half[1].h[0] = h;
    half[0].gap[1] = half[1].gap[0] = gap;
    half[0].deviation = half[1].deviation =
        hypot(u - 0.5 * (c->u[0] + c->u[1]), h - 0.5 * (c->h[0] + c->h[1]));
}

/* The first part of the chord along which the gap falls through zero; 0: along none. */
static int passes(pm_workspace *w, pm_event_function *f, pm_event_at *gap_at, const pm_chord *c, int *looks,
                  pm_span *x)
{
    const int through = c->gap[1] <= 0, short_way = way(c) + c->deviation <= pm_contact_length(&w->frame);
    if (is_excluded(c) || short_way || (through && is_within(c)) || --*looks < 0) {
        *x = (pm_span){c->x[0], c->x[1], c->gap[0], c->gap[1]};
        return through;
    }
    pm_chord half[2];
    halve(w, f, gap_at, c, half);
    return passes(w, f, gap_at, half, looks, x) || passes(w, f, gap_at, half + 1, looks, x);
}

int pm_edge_passage_between(pm_workspace *w, int i, int k, pm_event_at *gap_at, pm_span *x)
{
    pm_event_function *f = &w->event->function[i];
    const pm_chord c = chord_between(w, i, k);
    int looks = PM_PASSAGE_LOOKS;
    return passes(w, f, gap_at, &c, &looks, x);
}

static int is_over(const pm_chord *c, int end) { return c->u[end] > 0 && c->u[end] < c->length; }

/* The chord from its middle, which begins `rest`, on to its end. */
static pm_chord cut_first(const pm_chord *c, const pm_chord *rest)
{
    pm_chord cut = *c;
    cut.x[0] = rest->x[0];
    cut.u[0] = rest->u[0];
    cut.h[0] = rest->h[0];
    cut.gap[0] = rest->gap[0];
    return cut;
}

int pm_edge_passage_after(pm_workspace *w, int i, int k, pm_event_at *gap_at, pm_span *x)
{
    pm_event_function *f = &w->event->function[i];
    const pm_chord whole = chord_between(w, i, k);
    pm_chord first = whole, half[2];
    int looks = PM_PASSAGE_LOOKS;
    for (int n = 0; n < PM_BOUNCE_HALVINGS && !is_within(&whole); n++) {
        halve(w, f, gap_at, &first, half);
        first = half[0];
        if (!is_over(&first, 1) || fabs(first.gap[1]) <= f->slack) continue;
        const pm_chord rest = cut_first(&whole, half + 1);
        *x = (pm_span){whole.x[0], first.x[1], 0, first.gap[1]};
        return first.gap[1] < 0 || passes(w, f, gap_at, &rest, &looks, x);
    }
    return 0;
}
