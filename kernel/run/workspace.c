/* workspace.c - memory of states and of a thread: allocated once, carved from one block each. */
#include <stdlib.h>
#include <string.h>

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
#include "state/model.h"
#include "state/route.h"
#include "study/accuracy.h"
#include "study/find.h"
#include "tree/tree.h"

int pm_state_create(const pm_model *m, pm_state *s)
{
    const size_t ndouble = 2 * (size_t)m->nq + (size_t)m->nz, nmemory = (size_t)m->nmemory,
                 nslot = (size_t)m->nslot, nkept = (size_t)m->nkept, ngrip = (size_t)m->ngrip;
    s->t = 0;
    s->bytes = ndouble * sizeof(double) + nkept * sizeof(pm_kept) + nmemory * sizeof(pm_memory) +
               nslot * sizeof(pm_slot) + ngrip * sizeof(int32_t) + (size_t)m->nelement;
    s->block = calloc(1, s->bytes + 1);
    if (!s->block) return PM_NO_MEMORY;
    s->q = s->block;
    s->v = s->q + m->nq;
    s->z = s->v + m->nq;
    s->kept = (pm_kept *)(void *)(s->z + m->nz);
    s->memory = (pm_memory *)(void *)(s->kept + m->nkept);
    s->slot = (pm_slot *)(void *)(s->memory + m->nmemory);
    s->grip = (int32_t *)(void *)(s->slot + m->nslot);
    s->absent = (unsigned char *)(s->grip + m->ngrip);
    return PM_OK;
}

void pm_state_free(pm_state *s)
{
    free(s->block);
    s->block = NULL;
}

void pm_state_copy(pm_state *to, const pm_state *from)
{
    to->t = from->t;
    memcpy(to->block, from->block, from->bytes);
}

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
    w->model = m;
    const int nforce = m->rows[PM_TABLE_FORCE], nrow = m->nrow, nq = m->nq;
    const pm_part_of_block part[] = {
        PART(w->value, m->nvalue),
        PART(w->number, m->fold->nnumber),
        PART(w->mass, m->nbody),
        PART(w->inverse_mass, nq),
        PART(w->inverse_root, nq),
        PART(w->stand_in, nq),
        PART(w->previous, nq),
        PART(w->hang, m->nbody + 1),
        PART(w->wanted, nrow),
        PART(w->of_joint, m->njoint_row),
        PART(w->row, nrow + 1),
        PART(w->joint_active, m->njoint_row),
        PART(w->slot_normal, m->nslot),
        PART(w->slot_tangent, m->nslot),
        PART(w->grip_row, m->ngrip),
        PART(w->grip_load, m->ngrip),
        PART(w->slot_held, PM_JOINT_CONSTRAINTS * m->nslot),
        PART(w->schur, (size_t)nrow * (size_t)nrow),
        PART(w->pivot, nrow),
        PART(w->first_row, m->nbody),
        PART(w->body_place, m->nbody),
        PART(w->joint_order, m->rows[PM_TABLE_JOINT]),
        PART(w->basis_range, 2 * (nq + 1)),
        PART(w->rhs, nrow),
        PART(w->basis, (size_t)(nq + 1) * (size_t)nq),
        PART(w->frame.pose, 5 * (m->nbody + 1)),
        PART(w->frame.velocity, 3 * (m->nbody + 1)),
        PART(w->frame.turn, 3 * m->nbody),
        PART(w->frame.f, nq),
        PART(w->frame.power, nforce),
        PART(w->frame.a, nq),
        PART(w->frame.lambda, nrow),
        PART(w->joint_impulse, m->njoint_row),
        PART(w->slot_impulse, 2 * m->nslot),
        PART(w->slot_direction, 4 * m->nslot),
        PART(w->slot_before, m->nslot),
        PART(w->grip_before, m->ngrip),
        PART(w->slot_released, m->nslot),
        PART(w->force_energy_start, nforce),
        PART(w->turn, nq),
        PART(w->impulse, nq),
        PART(w->scratch, 8 * (nq + nrow + m->nslot)),
    };
    int status = carve(&w->block, part, sizeof part / sizeof *part);
    if (!status) status = pm_state_create(m, &w->state);
    if (!status) status = pm_state_create(m, &w->start);
    if (!status) status = pm_state_create(m, &w->probe);
    if (!status) status = pm_state_create(m, &w->ahead);
    if (!status) pm_joint_compose(w); /* which bodies they fasten is known before any case */
    if (!status) status = pm_solve_cache_create(w);
    if (!status) status = pm_fixed_bodies_create(w);
    if (!status) status = pm_event_create(w);
    if (!status) status = pm_ask_create(w);
    if (!status) status = pm_watched_samples_create(w);
    if (!status) status = pm_accuracy_create(w);
    if (!status) status = pm_tree_create(w);
    if (!status) status = pm_repeat_record_create(w);
    if (!status) status = pm_routes_create(w);
    if (!status) status = pm_find_create(w);
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
    pm_find_free(w);
    pm_routes_free(w);
    pm_accuracy_free(w);
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

int pm_fail(pm_workspace *w, int status, int table, int row, double value, double bound)
{
    w->where = (pm_where){table, row, PM_NONE, value, bound};
    return status;
}
