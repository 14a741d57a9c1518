/* solve_cache.c - what was computed of a state is used again where the same state is looked at.
 *
 * Around an event one state is looked at again and again: at the end of a step, before the blow, after the modes are
 * found, when the next phase begins.  Where forces depend on the configuration alone, accelerations and reactions follow
 * from positions, velocities and the active constraints; where all of these are the same to the last bit, so are they. */
#include "equations/solve_cache.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "numerics/lanes.h"
#include "state/arena.h"
#include "state/workspace.h"

int pm_solve_cache_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->cache)) return PM_NO_MEMORY;
    pm_solve_cache *r = w->cache;
    const pm_array array[] = {
        PM_ARRAY(r->pose, m->nq),
        PM_ARRAY(r->velocity, m->nq),
        PM_ARRAY(r->a, m->nq),
        PM_ARRAY(r->q, m->nq),
        PM_ARRAY(r->lambda, m->nconstraint),
        PM_ARRAY(r->memory, m->nmemory),
        PM_ARRAY(r->constraint, m->nconstraint),
        PM_ARRAY(r->slot, m->nslot),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

void pm_solve_cache_forget(pm_solve_cache *cache)
{
    cache->known = 0;
    cache->built = PM_NONE;
}

/* Nothing but the configuration, the velocities and the constraints makes the accelerations.  Where nothing holds the bodies, and
 * nothing but weight acts, to find them again costs less than to look them up. */
static int applies(const pm_workspace *w)
{
    if (w->active.n == 0 && w->model->rows[PM_TABLE_FORCE] == 0) return 0;
    return w->model->programs.cacheable && !w->active.asymmetric && !w->numbers.massless;
}

static int same_place(const pm_frame *frame, const pm_solve_cache *r)
{
    for (int i = 0; i < frame->model->nbody; i++)
        for (int k = 0; k < 3; k++) {
            if (r->pose[3 * i + k] != frame->pose[5 * i + k]) return 0;
            if (r->velocity[3 * i + k] != frame->velocity[3 * i + k]) return 0;
        }
    return 1;
}

static int same_memory(const pm_frame *frame, const pm_solve_cache *cache)
{
    const size_t bytes = (size_t)frame->model->nmemory * sizeof(pm_memory);
    return bytes == 0 || memcmp(cache->memory, frame->memory, bytes) == 0;
}

static void keep_evaluated(pm_evaluated *x, const pm_constraint *c)
{
    memcpy(x->j, c->j, sizeof x->j);
    x->g = c->g;
    x->rate = c->rate;
    x->gamma = c->gamma;
}

static void put_evaluated(pm_constraint *c, const pm_evaluated *x)
{
    memcpy(c->j, x->j, sizeof x->j);
    c->g = x->g;
    c->rate = x->rate;
    c->gamma = x->gamma;
}

int pm_solve_cache_take_constraints(pm_workspace *w)
{
    const pm_solve_cache *r = w->cache;
    if (!r->known || r->active_version != w->active.version || !applies(w) ||
        !same_place(&w->frame, w->cache) || !same_memory(&w->frame, w->cache))
        return 0;
    for (int i = 0; i < w->active.n; i++) put_evaluated(&w->active.constraint[i], &r->constraint[i]);
    return 1;
}

int pm_solve_cache_take(pm_workspace *w)
{
    const pm_solve_cache *r = w->cache;
    if (!pm_solve_cache_take_constraints(w)) return 0;
    pm_lanes_copy_threes(w->frame.a, r->a, w->model->nbody);
    for (int i = 0; i < w->active.n; i++) w->frame.lambda[i] = r->lambda[i];
    pm_force_all(w);
    w->frame.level = PM_LEVEL_DYNAMIC;
    return 1;
}

void pm_solve_cache_keep(pm_workspace *w)
{
    pm_solve_cache *r = w->cache;
    if (r->closed) return;
    r->known = applies(w);
    if (!r->known) return;
    r->active_version = w->active.version;
    for (int i = 0; i < w->model->nbody; i++) pm_lanes_copy_threes(r->pose + 3 * i, w->frame.pose + 5 * i, 1);
    pm_lanes_copy_threes(r->velocity, w->frame.velocity, w->model->nbody);
    pm_lanes_copy_threes(r->a, w->frame.a, w->model->nbody);
    memcpy(r->lambda, w->frame.lambda, (size_t)w->active.n * sizeof(double));
    for (int i = 0; i < w->active.n; i++) keep_evaluated(&r->constraint[i], &w->active.constraint[i]);
    memcpy(r->memory, w->frame.memory, (size_t)w->model->nmemory * sizeof(pm_memory));
}

int pm_solve_cache_is_built(const pm_workspace *w)
{
    const pm_solve_cache *r = w->cache;
    const pm_model *m = w->model;
    if (r->built != w->active.version || memcmp(r->q, w->state.q, (size_t)m->nq * sizeof(double)) != 0)
        return 0;
    for (int i = 0; i < m->nslot; i++) {
        const pm_slot *s = &w->state.slot[i];
        if (r->slot[i].mode != s->mode) return 0;
        if (s->mode != PM_OPEN && r->slot[i].member != s->member) return 0;
    }
    return 1;
}

/* Where elements come and go, or pairs are held as they were caught, or friction holds joints, or teeth have flanks,
 * constraints are always built. */
void pm_solve_cache_built(pm_workspace *w)
{
    pm_solve_cache *r = w->cache;
    const pm_model *m = w->model;
    if (m->acts || m->nkept > 0 || m->nfriction > 0 || m->nteeth > 0) return;
    r->built = w->active.version;
    memcpy(r->q, w->state.q, (size_t)m->nq * sizeof(double));
    memcpy(r->slot, w->state.slot, (size_t)m->nslot * sizeof(pm_slot));
}
