/* path_begin.c - whether a phase is one along a path, and its first place.
 *
 * One degree of freedom, forces that depend on the place alone, nothing driven.  The rate of the driver is the part of the
 * velocities along the path,   u' = t . M v / t . M t,   t = dq/du. */
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/turning_plane.h"
#include "equations/active_set.h"
#include "equations/ledger.h"
#include "events/bounce_series.h"
#include "expression/program.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"

/* Rate of the driver from given velocities: their part along the path. */
static double rate_of(const pm_frame *frame, const pm_place *x, const double *v)
{
    double sum = 0;
    for (int i = 0; i < frame->model->nbody; i++)
        sum +=
            frame->numbers->mass[i] * (v[3 * i] * x->tangent[3 * i] + v[3 * i + 1] * x->tangent[3 * i + 1]) +
            pm_frame_inertia(frame, i) * v[3 * i + 2] * x->tangent[3 * i + 2];
    return sum / x->mass;
}

double pm_path_force_size(const pm_frame *frame, const pm_place *x)
{
    double size = 0;
    for (int i = 0; i < frame->model->nbody; i++) {
        const double *f = frame->f + 3 * i, *t = x->tangent + 3 * i;
        size += pm_length(f) * pm_length(t) + fabs(f[2] * t[2]);
    }
    return size + pm_turning_plane_force_size(frame, x->tangent);
}

double pm_path_requested(pm_workspace *w, const double *velocity)
{
    memcpy(w->frame.velocity, velocity, (size_t)w->model->nq * sizeof *velocity);
    return pm_program_run(w, w->request.program);
}

/* Out of an equilibrium: the side that is asked for, or 0. */
static double requested_side(pm_workspace *w, const pm_place *x)
{
    const double side = w->request.program == PM_NONE ? 0 : pm_path_requested(w, x->tangent);
    return side > 0 ? 1 : side < 0 ? -1 : 0;
}

static int is_balanced(const pm_frame *frame, const pm_place *x)
{
    return !(fabs(x->force) > PM_PATH_BALANCED * pm_path_force_size(frame, x));
}

/* At rest the forces tell which way it goes; 0: it stays. */
static int leave_rest(pm_workspace *w, const pm_place *x)
{
    pm_path *p = w->path;
    p->balanced = is_balanced(&w->frame, x);
    p->sense = p->balanced ? requested_side(w, x) : (x->force > 0 ? 1 : -1);
    return p->sense != 0;
}

/* A prescribed rate makes the motion one in time; steps along the path are none that integrals over the time can be made of. */
int pm_path_applies(const pm_workspace *w)
{
    return w->model->programs.forces_by_place && !w->model->programs.integrals && !w->active.asymmetric &&
           !w->numbers.massless && !w->phase.path_left && !pm_active_set_is_driven(&w->active) &&
           pm_bounce_series_next(w) == INFINITY;
}

/* Against its forces it comes so little far that the differences of energies do not show where it turns. */
static int turns_at_once(const pm_workspace *w, const pm_place *x, double sense)
{
    return x->force * sense < 0 && x->kinetic < PM_PATH_TURNS * w->numbers.size * fabs(x->force);
}

/* The tree of the phase and its first place; 0: more than one freedom, no direction there, it turns at once or stays at rest. */
int pm_path_prepare(pm_workspace *w)
{
    pm_path *p = w->path;
    pm_place *x = &p->begin;
    pm_tree_build(w);
    if (w->tree->n - w->tree->nloop != 1) return 0;
    p->n = w->tree->n;
    pm_tree_loops_unknown(w->tree, &p->loop);
    p->driver = PM_NONE;
    pm_path_bridge_forget(p);
    p->sense = 1;
    pm_frame_look_state(&w->frame, &w->state);
    pm_tree_read(w->tree, &w->frame, x->y);
    pm_path_open_begin(w);
    if (pm_path_look(w, x) || pm_path_drive(w, x)) return 0;
    /* an equilibrium stays where it is: forces do no work beside it */
    if (!is_balanced(&w->frame, x) && pm_path_meet(w, x)) return 0;
    const double rate = rate_of(&w->frame, x, w->state.v);
    x->kinetic = 0.5 * x->mass * rate * rate;
    p->sense = rate > 0 ? 1 : -1;
    p->balanced = 0;
    p->at_rest = !(2 * x->kinetic > PM_PATH_STILL * PM_PATH_STILL * pm_frame_total_mass(&w->frame) *
                                        w->numbers.speed * w->numbers.speed);
    /* the contacts are met anew, to rounding: what the forces do on that way is not lost */
    for (int i = 0; i < w->model->nq; i++) x->kinetic += w->frame.f[i] * (x->q[i] - w->state.q[i]);
    if (p->at_rest) x->kinetic = 0;
    if (!p->at_rest && turns_at_once(w, x, p->sense)) return 0;
    return !p->at_rest || leave_rest(w, x);
}

int pm_path_begin(pm_workspace *w)
{
    pm_path *p = w->path;
    const pm_place *x = &p->begin;
    const double *ledger = w->state.z + pm_ledger_ledger(w->model);
    double momentum[PM_LEDGER];
    p->fresh = 1;
    p->most = INFINITY;
    pm_path_error_begin(w);
    p->way = 0;
    p->lowest = x->kinetic;
    p->energy = x->kinetic + x->potential - pm_path_work(w->model, w->state.z);
    pm_frame_look_state(&w->frame, &w->state);
    pm_frame_momentum(&w->frame, PM_NONE, momentum);
    for (int i = 0; i < PM_LEDGER; i++) p->impulse[i] = ledger[i] - momentum[i];
    return PM_OK;
}
