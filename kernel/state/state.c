/* state.c - memory of states. */
#include "state/state.h"

#include <stdlib.h>
#include <string.h>

int pm_state_create(const pm_model *m, pm_state *s)
{
    const size_t ndouble = 2 * (size_t)m->nq + (size_t)m->nz, nmemory = (size_t)m->nmemory,
                 nslot = (size_t)m->nslot, nkept = (size_t)m->nkept, nfriction = (size_t)m->nfriction;
    s->t = 0;
    s->bytes = ndouble * sizeof(double) + nkept * sizeof(pm_kept) + nmemory * sizeof(pm_memory) +
               nslot * sizeof(pm_slot) + nfriction * sizeof(int32_t) + (size_t)m->nelement;
    s->block = calloc(1, s->bytes + 1);
    if (!s->block) return PM_NO_MEMORY;
    s->q = s->block;
    s->v = s->q + m->nq;
    s->z = s->v + m->nq;
    s->kept = (pm_kept *)(void *)(s->z + m->nz);
    s->memory = (pm_memory *)(void *)(s->kept + m->nkept);
    s->slot = (pm_slot *)(void *)(s->memory + m->nmemory);
    s->friction = (int32_t *)(void *)(s->slot + m->nslot);
    s->absent = (unsigned char *)(s->friction + m->nfriction);
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
