/* workspace.c - memory of a thread: allocated once, most of it carved from one block. */
#include <stdlib.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/joint.h"
#include "equations/fixed_bodies.h"
#include "equations/gap_bounds.h"
#include "equations/row_order.h"
#include "equations/solve_cache.h"
#include "events/ask.h"
#include "events/event.h"
#include "events/watched_samples.h"
#include "expression/program_fold.h"
#include "routes/path/repeat_record.h"
#include "routes/start/perturbation.h"
#include "state/route.h"
#include "state/workspace.h"
#include "tree/tree.h"

/* Adds an array of n doubles (or things no larger) to the plan of the block; filled in by place(). */
typedef struct pm_part_of_block {
    void **where;
    size_t bytes;
} pm_part_of_block;

static size_t aligned(size_t bytes) { return (bytes + 63) & ~(size_t)63; }

static int carve(void **block, const pm_part_of_block *part, size_t nparts)
{
    size_t total = 0;
    for (size_t i = 0; i < nparts; i++) total += aligned(part[i].bytes);
    char *p = *block = calloc(1, total + 64);
    if (!p) return PM_NO_MEMORY;
    for (size_t i = 0; i < nparts; i++) {
        *part[i].where = p;
        p += aligned(part[i].bytes);
    }
    return PM_OK;
}

#define PART(pointer, count)                                             \
    {                                                                    \
        (void **)(void *)&(pointer), (size_t)(count) * sizeof *(pointer) \
    }

int pm_workspace_create(const pm_model *m, pm_workspace **workspace)
{
    pm_workspace *w = calloc(1, sizeof *w);
    *workspace = NULL;
    if (!w) return PM_NO_MEMORY;
    w->model = w->frame.model = m;
    w->frame.numbers = &w->numbers;
    w->numbers.coarse = 1;
    const int nforce = m->rows[PM_TABLE_FORCE], nrow = m->nrow, nq = m->nq;
    const pm_part_of_block part[] = {
        PART(w->numbers.value, m->nvalue),
        PART(w->numbers.folded, m->programs.fold->nnumber),
        PART(w->numbers.mass, m->nbody),
        PART(w->numbers.fixed, m->nbody + 1),
        PART(w->numbers.inverse_mass, nq),
        PART(w->numbers.inverse_root, nq),
        PART(w->numbers.stand_in, nq),
        PART(w->saddle.previous, nq),
        PART(w->hinge, m->nbody + 1),
        PART(w->saddle.wanted, nrow),
        PART(w->numbers.of_joint, m->njoint_row),
        PART(w->active.row, nrow + 1),
        PART(w->active.of_joint, m->njoint_row),
        PART(w->active.slot_normal, m->nslot),
        PART(w->active.slot_tangent, m->nslot),
        PART(w->active.friction_row, m->nfriction),
        PART(w->active.friction_load, m->nfriction),
        PART(w->active.slot_held, PM_JOINT_CONSTRAINTS * m->nslot),
        PART(w->saddle.schur, (size_t)nrow * (size_t)nrow),
        PART(w->saddle.pivot, nrow),
        PART(w->saddle.first_row, m->nbody),
        PART(w->active.body_place, m->nbody),
        PART(w->active.joint_order, m->rows[PM_TABLE_JOINT]),
        PART(w->saddle.basis_range, 2 * (nq + 1)),
        PART(w->saddle.rhs, nrow),
        PART(w->saddle.basis, (size_t)(nq + 1) * (size_t)nq),
        PART(w->frame.pose, 5 * (m->nbody + 1)),
        PART(w->frame.velocity, 3 * (m->nbody + 1)),
        PART(w->frame.turn, 3 * m->nbody),
        PART(w->frame.f, nq),
        PART(w->frame.power, nforce),
        PART(w->frame.a, nq),
        PART(w->frame.lambda, nrow),
        PART(w->impulses.joint, m->njoint_row),
        PART(w->impulses.slot, 2 * m->nslot),
        PART(w->impulses.slot_direction, 4 * m->nslot),
        PART(w->instant.slot_before, m->nslot),
        PART(w->instant.friction_before, m->nfriction),
        PART(w->instant.slot_released, m->nslot),
        PART(w->ledger.force_energy_start, nforce),
        PART(w->step.reversed, nq),
        PART(w->impulses.applied, nq),
        PART(w->scratch, 8 * (nq + nrow + m->nslot)),
    };
    int status = carve(&w->block, part, sizeof part / sizeof *part);
    if (!status) status = pm_state_create(m, &w->state);
    if (!status) status = pm_state_create(m, &w->start);
    if (!status) status = pm_state_create(m, &w->probe);
    if (!status) status = pm_state_create(m, &w->ahead);
    if (!status) pm_joint_compose(&w->frame); /* which bodies they fasten is known before any case */
    if (!status) status = pm_solve_cache_create(w);
    if (!status) status = pm_fixed_bodies_create(w);
    if (!status) status = pm_event_create(w);
    if (!status) status = pm_ask_create(w);
    if (!status) status = pm_watched_samples_create(w);
    if (!status) status = pm_tree_create(w);
    if (!status) status = pm_repeat_record_create(w);
    if (!status) status = pm_routes_create(w);
    if (!status) status = pm_perturbation_create(w);
    if (status) {
        pm_workspace_free(w);
        return status;
    }
    pm_row_order_find(w); /* of all joints, whichever a case begins without */
    *workspace = w;
    return PM_OK;
}

void pm_workspace_free(pm_workspace *w)
{
    if (!w) return;
    pm_perturbation_free(w);
    pm_routes_free(w);
    pm_repeat_record_free(w);
    pm_tree_free(w);
    pm_watched_samples_free(w);
    pm_ask_free(w);
    pm_event_free(w);
    pm_solve_cache_free(w);
    pm_fixed_bodies_free(w);
    pm_state_free(&w->ahead);
    pm_state_free(&w->probe);
    pm_state_free(&w->start);
    pm_state_free(&w->state);
    free(w->block);
    free(w);
}
