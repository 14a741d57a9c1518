/* A mark that is sunk into an edge by a little: it has not come through.  Where other contacts come to rest bodies are put by a hair to
 * where these hold them, again and again, and marks beside go deeper than what touching allows. */
#include "check.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "events/event.h"
#include "impact/impact.h"
#include "numerics/tolerances.h"
#include "scene.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

#define HIGH 1.0 /* m, where it starts */

static pm_workspace *above_an_edge(scene *s, double radius)
{
    const int b = scene_body(s, 1, 0.1, check_random(-0.9, 0.9), HIGH + radius, 0);
    scene_segment(s, scene_circle(s, scene_point(s, b, 0, 0), radius),
                  scene_line(s, scene_point(s, PM_GROUND, 0, 0), 0), -1, 1, 0.5, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    EQUAL(scene_begin(s), PM_OK);
    s->w->phase.route = &pm_route_path;
    return s->w;
}

static void sink(pm_workspace *w, double radius, double depth, double rate)
{
    w->state.q[1] = radius - depth;
    w->state.v[1] = rate;
    pm_frame_look_state(&w->frame, &w->state);
}

static const pm_event_function *gap_of(const pm_workspace *w)
{
    for (int i = 0; i < w->event->nfunction; i++)
        if (w->event->function[i].kind == FUNCTION_GAP) return &w->event->function[i];
    CHECK(0);
    return NULL;
}

/* It parts: it is met again where it comes back to its depth, and is not taken for what comes up from below, unless it is deeper. */
static void parts(double radius, double part)
{
    scene *s = scene_create();
    pm_workspace *w = above_an_edge(s, radius);
    const double length = pm_contact_length(&w->frame), depth = part * PM_EDGE_SUNK * length;
    sink(w, radius, depth, check_random(1e-6, 1));
    pm_event_begin(w);
    const pm_event_function *f = gap_of(w);
    EQUAL(f->below, part > 1);
    if (part < 1) {
        NEAR(pm_event_sample(w, f), 0, 1e-3 * length);
        sink(w, radius, depth - length, 0);
        NEAR(pm_event_sample(w, f), length, 1e-3 * length);
    }
    scene_free(s);
}

/* It comes down: it strikes, unless it is as deep. */
static void strikes(double part)
{
    scene *s = scene_create();
    pm_workspace *w = above_an_edge(s, 0);
    const double depth = part * PM_EDGE_SUNK * pm_contact_length(&w->frame);
    int jumped;
    sink(w, 0, depth, -check_random(0.5, 1));
    EQUAL(pm_impact(w, &jumped), PM_OK);
    EQUAL(jumped, part < 1);
    EQUAL(w->state.v[1] > 0, part < 1);
    scene_free(s);
}

int main(void)
{
    for (int i = 0; i < 100; i++) {
        parts(0, check_random(0.02, 0.95));
        parts(0, check_random(1.05, 3));
        parts(0.3, check_random(0.02, 0.95));
        parts(0.3, check_random(1.05, 3));
        strikes(check_random(0.02, 0.95));
        strikes(check_random(1.05, 3));
    }
    return check_failures();
}
