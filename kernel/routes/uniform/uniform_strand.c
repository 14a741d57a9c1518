/* uniform_strand.c - when of a taut strand nothing is left, in a phase with constant accelerations.
 *
 * A strand that is steady keeps its direction, and its length is a parabola of the time, l + l' t + l'' t^2/2.  Where that
 * falls to what counts as nothing the strand ends, however soon after it the motion would come to rest. */
#include <math.h>

#include "elements/constraint.h"
#include "events/event.h"
#include "events/event_search.h"
#include "routes/uniform/uniform.h"
#include "state/frame.h"
#include "state/workspace.h"

/* At the frame, which looks at the begin of the phase: of how much is left until nothing is. */
static void course_of(const pm_frame *frame, const pm_uniform *u, int strand, double course[3])
{
    pm_constraint c;
    const double nothing = pm_event_strand_constraint(frame, strand, &c);
    pm_constraint_strand_course(frame, &c, &u->curve, course);
    course[0] = fmax(0, course[0] - nothing);
}

/* One of which nothing is left when the phase begins ends at once, unless it grows. */
static double end_of(const double course[3])
{
    const int grows = course[1] > 0 || (course[1] == 0 && course[2] >= 0);
    if (course[0] == 0 && !grows) return 0;
    return pm_uniform_gap_first_root(course[0], course[1], course[2]);
}

void pm_uniform_strand_begin(pm_workspace *w)
{
    for (int i = 0; i < w->model->nslot; i++)
        for (int k = 0; k < 2; k++) {
            const int mode = w->state.slot[i].mode;
            const int taut = mode != PM_OPEN && mode != PM_CAPTURED && k < pm_event_strands(w->model, i);
            double course[3];
            w->uniform->strand_end[2 * i + k] = INFINITY;
            if (!taut) continue;
            course_of(&w->frame, w->uniform, 2 * i + k, course);
            w->uniform->strand_end[2 * i + k] = end_of(course);
        }
}

double pm_uniform_strand_first(const pm_workspace *w, double end)
{
    for (int i = 0; i < 2 * w->model->nslot; i++) end = fmin(w->uniform->strand_end[i], end);
    return end;
}

void pm_uniform_strand_note(pm_workspace *w, int function)
{
    pm_event_function *f = &w->event->function[function];
    const pm_uniform *u = w->uniform;
    double course[3];
    pm_uniform_look(w, 0);
    course_of(&w->frame, u, f->index, course);
    const double shortest = course[2] > 0 ? -course[1] / course[2] : INFINITY;
    if (w->event->root[function]) pm_event_evidence_rate(w, function, course[1] + u->end * course[2]);
    if (!(shortest > u->begin && shortest < u->end)) return;
    f->near = course[0] + 0.5 * course[1] * shortest;
    f->near_reach = course[0];
}
