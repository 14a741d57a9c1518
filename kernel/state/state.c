/* state.c - memory of states. */
#include "state/state.h"

#include <stdlib.h>
#include <string.h>

#include "state/arena.h"

int pm_state_create(const pm_model *m, pm_state *s)
{
    const pm_array array[] = {
        PM_ARRAY(s->q, 2 * m->nq + m->nz),   PM_ARRAY(s->kept, m->nkept),
        PM_ARRAY(s->memory, m->nmemory),     PM_ARRAY(s->slot, m->nslot),
        PM_ARRAY(s->friction, m->nfriction), PM_ARRAY(s->absent, m->nelement),
    };
    s->t = 0;
    s->bytes = pm_arena_size(PM_ARRAYS(array));
    const int status = pm_arena_create(&s->block, PM_ARRAYS(array));
    if (status) return status;
    s->v = s->q + m->nq;
    s->z = s->v + m->nq;
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
