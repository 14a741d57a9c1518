/* state.c - memory of states. */
#include "state/state.h"

#include <string.h>

int pm_state_create(pm_arena *arena, const pm_model *m, pm_state *s)
{
    const pm_array array[] = {
        PM_ARRAY(s->q, 2 * m->nq + m->nz),   PM_ARRAY(s->kept, m->nkept),
        PM_ARRAY(s->memory, m->nmemory),     PM_ARRAY(s->slot, m->nslot),
        PM_ARRAY(s->friction, m->nfriction), PM_ARRAY(s->absent, m->nelement),
    };
    s->t = 0;
    s->bytes = pm_arena_size(PM_ARRAYS(array));
    const int status = pm_arena_take(arena, PM_ARRAYS(array));
    if (status) return status;
    s->v = s->q + m->nq;
    s->z = s->v + m->nq;
    return PM_OK;
}

void pm_state_copy(pm_state *to, const pm_state *from)
{
    to->t = from->t;
    memcpy(to->q, from->q, from->bytes); /* the first of its arrays */
}
