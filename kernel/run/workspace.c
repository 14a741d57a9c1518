/* workspace.c - memory of a thread: allocated once, most of it carved from one block. */
#include <math.h>
#include <stdlib.h>

#include "elements/constraint.h"
#include "elements/contact_curve.h"
#include "elements/joint.h"
#include "elements/measure.h"
#include "equations/case_values.h"
#include "equations/constraint_order.h"
#include "equations/fixed_bodies.h"
#include "equations/gap_bounds.h"
#include "equations/saddle.h"
#include "equations/shared_loads.h"
#include "equations/shared_reading.h"
#include "equations/solve_cache.h"
#include "events/ask.h"
#include "events/blows_left.h"
#include "events/event.h"
#include "events/flight_firings.h"
#include "events/motion_course.h"
#include "events/time_course.h"
#include "events/watched_samples.h"
#include "events/waves.h"
#include "expression/program_fold.h"
#include "impact/impact.h"
#include "routes/path/repeat.h"
#include "routes/path/repeat_rest.h"
#include "routes/start/equilibrium.h"
#include "routes/start/perturbation.h"
#include "state/arena.h"
#include "state/route.h"
#include "state/workspace.h"
#include "tree/small_motion.h"
#include "tree/tree.h"

/* The arrays of the parts of the workspace; those of the rooms are theirs. */
static int create_arrays(pm_workspace *w)
{
    const pm_model *m = w->model;
    const int nforce = m->rows[PM_TABLE_FORCE], nconstraint = m->nconstraint, nq = m->nq;
    const pm_array array[] = {
        PM_ARRAY(w->numbers.value, m->nvalue),
        PM_ARRAY(w->numbers.folded, m->programs.fold->nnumber),
        PM_ARRAY(w->numbers.mass, m->nbody),
        PM_ARRAY(w->numbers.fixed, m->nbody + 1),
        PM_ARRAY(w->numbers.inverse_mass, nq),
        PM_ARRAY(w->numbers.inverse_root, nq),
        PM_ARRAY(w->numbers.stand_in, nq),
        PM_ARRAY(w->numbers.light, nq),
        PM_ARRAY(w->reach.hinge, m->nbody + 1),
        PM_ARRAY(w->numbers.of_joint, m->njoint_constraint),
        PM_ARRAY(w->numbers.of_contact, m->rows[PM_TABLE_CONTACT]),
        PM_ARRAY(w->numbers.course, pm_contact_curve_looked_at(m) ? m->rows[PM_TABLE_CURVE] : 0),
        PM_ARRAY(w->active.constraint, nconstraint + 1),
        PM_ARRAY(w->active.of_joint, m->njoint_constraint),
        PM_ARRAY(w->active.slot_normal, m->nslot),
        PM_ARRAY(w->active.slot_tangent, m->nslot),
        PM_ARRAY(w->active.friction_constraint, m->nfriction),
        PM_ARRAY(w->active.friction_load, m->nfriction),
        PM_ARRAY(w->active.slot_held, PM_JOINT_CONSTRAINTS * m->nslot),
        PM_ARRAY(w->active.body_place, m->nbody),
        PM_ARRAY(w->active.joint_order, m->rows[PM_TABLE_JOINT]),
        PM_ARRAY(w->frame.pose, 5 * (m->nbody + 1)),
        PM_ARRAY(w->frame.velocity, 3 * (m->nbody + 1)),
        PM_ARRAY(w->frame.f, nq),
        PM_ARRAY(w->frame.power, nforce),
        PM_ARRAY(w->frame.a, nq),
        PM_ARRAY(w->frame.lambda, nconstraint),
        PM_ARRAY(w->impulses.joint, m->njoint_constraint),
        PM_ARRAY(w->impulses.flank, m->rows[PM_TABLE_JOINT]),
        PM_ARRAY(w->impulses.friction, m->nfriction),
        PM_ARRAY(w->impulses.slot, 2 * m->nslot),
        PM_ARRAY(w->impulses.slot_direction, 4 * m->nslot),
        PM_ARRAY(w->instant.slot_before, m->nslot),
        PM_ARRAY(w->instant.place, m->nq),
        PM_ARRAY(w->instant.velocity, m->nq),
        PM_ARRAY(w->instant.friction_before, m->nfriction),
        PM_ARRAY(w->instant.slot_released, m->nslot),
        PM_ARRAY(w->firing.fired, m->rows[PM_TABLE_TRIGGER]),
        PM_ARRAY(w->firing.before, m->rows[PM_TABLE_TRIGGER]),
        PM_ARRAY(w->firing.size, m->rows[PM_TABLE_TRIGGER]),
        PM_ARRAY(w->firing.count, m->rows[PM_TABLE_EVENT]),
        PM_ARRAY(w->firing.seen, m->rows[PM_TABLE_EVENT]),
        PM_ARRAY(w->firing.counted, m->rows[PM_TABLE_EVENT]),
        PM_ARRAY(w->firing.time, m->rows[PM_TABLE_EVENT]),
        PM_ARRAY(w->firing.side, m->rows[PM_TABLE_EVENT]),
        PM_ARRAY(w->ledger.force_energy_start, nforce),
        PM_ARRAY(w->step.reversed, nq),
        PM_ARRAY(w->impulses.applied, nq),
        PM_ARRAY(w->scratch, 8 * (nq + nconstraint + m->nslot)),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

/* The arrays of the linear system (equations/saddle.h). */
static int create_saddle(pm_workspace *w)
{
    const size_t nq = w->model->nq, nconstraint = w->model->nconstraint, all = nq + nconstraint;
    const pm_array array[] = {
        PM_ARRAY(w->saddle.previous, nq),
        PM_ARRAY(w->saddle.wanted, nconstraint),
        PM_ARRAY(w->saddle.schur, nconstraint * nconstraint),
        PM_ARRAY(w->saddle.pivot, nconstraint),
        PM_ARRAY(w->saddle.factored, nconstraint),
        PM_ARRAY(w->saddle.first_constraint, w->model->nbody),
        PM_ARRAY(w->saddle.basis_range, 2 * (nq + 1)),
        PM_ARRAY(w->saddle.rhs, nconstraint),
        PM_ARRAY(w->saddle.light.at, nq),
        PM_ARRAY(w->saddle.light.matrix, all * all),
        PM_ARRAY(w->saddle.light.pivot, all),
        PM_ARRAY(w->saddle.light.scale, all),
        PM_ARRAY(w->saddle.light.unknown, all),
        PM_ARRAY(w->saddle.light.force, nq),
        PM_ARRAY(w->saddle.light.response, nq),
        PM_ARRAY(w->saddle.basis, (nq + 1) * nq),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

/* Memory of the states and of the rooms, from the bottom to the top. */
static int create_rooms(pm_workspace *w)
{
    int status = create_saddle(w);
    if (!status) status = pm_frame_rotations_create(&w->frame, &w->memory);
    if (!status) status = pm_case_values_create(w);
    if (!status) status = pm_state_create(&w->memory, w->model, &w->state);
    if (!status) status = pm_state_create(&w->memory, w->model, &w->start);
    if (!status) status = pm_state_create(&w->memory, w->model, &w->probe);
    if (!status) status = pm_state_create(&w->memory, w->model, &w->ahead);
    if (!status) pm_joint_compose(&w->frame); /* which bodies they fasten is known before any case */
    if (!status) status = pm_solve_cache_create(w);
    if (!status) status = pm_shared_create(w);
    if (!status) status = pm_fixed_bodies_create(w);
    if (!status) status = pm_watched_samples_create(w);
    if (!status) status = pm_time_course_create(w);
    if (!status) status = pm_event_create(w);
    if (!status) status = pm_blows_left_create(w);
    if (!status) status = pm_flight_firings_create(w);
    if (!status) status = pm_ask_create(w);
    if (!status) status = pm_waves_create(w);
    if (!status) status = pm_motion_course_create(w);
    if (!status) status = pm_impact_create(w);
    if (!status) status = pm_tree_create(w);
    if (!status) status = pm_small_motion_create(w);
    if (!status) status = pm_repeat_create(w);
    if (!status) status = pm_repeat_rest_create(w);
    if (!status) status = pm_routes_create(w);
    if (!status) status = pm_perturbation_create(w);
    if (!status) status = pm_equilibrium_create(w);
    return status;
}

int pm_workspace_create(const pm_model *m, pm_workspace **workspace)
{
    pm_workspace *w = calloc(1, sizeof *w);
    *workspace = NULL;
    if (!w) return PM_NO_MEMORY;
    w->model = w->frame.model = m;
    w->frame.numbers = &w->numbers;
    w->frame.patience = &w->patience;
    pm_patience_begin(&w->patience);
    w->frame.side = (pm_side){-INFINITY, INFINITY};
    w->saddle = (pm_saddle){.model = m, .numbers = &w->numbers, .active = &w->active};
    w->numbers.coarse = 1;
    w->read_measure =
        PM_SETTING(m, PM_SETTING_SHARED) == PM_SHARED_LEAST ? pm_shared_read_least : pm_measure_signed;
    int status = create_arrays(w);
    if (!status) status = create_rooms(w);
    if (status) {
        pm_workspace_free(w);
        return status;
    }
    pm_constraint_order_find(w); /* of all joints, whichever a case begins without */
    *workspace = w;
    return PM_OK;
}

void pm_workspace_free(pm_workspace *w)
{
    if (!w) return;
    pm_arena_free(&w->memory);
    free(w);
}
