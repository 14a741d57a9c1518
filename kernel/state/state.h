/* state.h - where a case is: the time, the coordinates, the running integrals, and what the constraints remember.
 *
 * A state is one block of memory: it is copied by one memcpy, which is how a run restarts and how both sides of an event are
 * kept.  SI and radians. */
#ifndef PM_STATE_H
#define PM_STATE_H

#include "state/model.h"

/* How a closed contact moves. */
enum pm_contact_mode {
    PM_OPEN = 0,
    PM_SMOOTH = 1,
    PM_STICK = 2,
    PM_SLIDE_FORWARD = 3,
    PM_SLIDE_BACKWARD = 4,
    PM_CAPTURED = 5
};

typedef struct pm_slot {
    int32_t mode;   /* enum pm_contact_mode */
    int32_t member; /* of a pattern, else 0 */
} pm_slot;

/* A no-slip constraint is holonomic with memory: its constant, and the last unwrapped direction of a strand. */
typedef struct pm_memory {
    double anchor;
    double direction;
    double foot;         /* s of the place on a curve that a constraint stands on */
    double other[2];     /* of two curves that touch, on the first of them: as foot, as direction */
    double time;         /* up to which the way of a drive is part of the anchor */
    double behind, slip; /* of a cord over a rim: direction of its second strand, anchor of its slip */
} pm_memory;

/* Where a captured pair is held, in the axes of both bodies, and its relative angle (capture.c). */
typedef struct pm_kept {
    double a[2], b[2], angle;
} pm_kept;

typedef struct pm_state {
    double t;
    double *q, *v, *z;     /* [nq], [nq], [nz], behind each other: one vector for those who integrate it */
    pm_kept *kept;         /* [nkept] */
    pm_memory *memory;     /* [nmemory]: joints, then slots */
    pm_slot *slot;         /* [nslot] */
    int32_t *friction;     /* [nfriction] enum pm_contact_mode of the frictions of joints */
    unsigned char *absent; /* [nelement] removed, or not there yet (action.h) */
    size_t bytes;          /* of all arrays, from q on */
} pm_state;

/* Whether it is not there in state s. */
static inline int pm_state_is_absent(const pm_model *m, const pm_state *s, int table, int row)
{
    return s->absent[pm_model_element(m, table, row)];
}

/* Memory of a state of the model, zeroed; PM_NO_MEMORY. */
int pm_state_create(pm_arena *arena, const pm_model *model, pm_state *s);
void pm_state_copy(pm_state *to, const pm_state *from);

#endif
