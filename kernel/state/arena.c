/* arena.c - a chain of blocks and objects, from the last one taken to the first. */
#include "state/arena.h"

#include <stdlib.h>
#include <string.h>

#include "planemotion.h"

#define ALIGNMENT 16 /* bytes: what calloc gives, and enough for two doubles in one register */

/* A block of arrays follows its part. */
typedef struct pm_arena_part {
    struct pm_arena_part *before;
    void *object; /* of a library, or NULL */
    void (*give_back)(void *object);
} pm_arena_part;

static size_t aligned(size_t bytes) { return (bytes + ALIGNMENT - 1) & ~(size_t)(ALIGNMENT - 1); }

size_t pm_arena_size(const pm_array *array, size_t narrays)
{
    size_t total = 0;
    for (size_t i = 0; i < narrays; i++) total += aligned(array[i].count * array[i].size);
    return total;
}

/* A new last part with so many bytes behind it, which begin at the address returned; NULL: there is no memory. */
static char *add_part(pm_arena *arena, size_t bytes, void *object, void (*give_back)(void *))
{
    const size_t head = aligned(sizeof(pm_arena_part));
    pm_arena_part *part = calloc(1, head + bytes);
    if (!part) return NULL;
    *part = (pm_arena_part){arena->last, object, give_back};
    arena->last = part;
    return (char *)part + head;
}

int pm_arena_take(pm_arena *arena, const pm_array *array, size_t narrays)
{
    char *p = add_part(arena, pm_arena_size(array, narrays), NULL, NULL);
    if (!p) return PM_NO_MEMORY;
    for (size_t i = 0; i < narrays; i++) {
        memcpy(array[i].where, &p, sizeof p); /* a pointer of another type: see pm_array */
        p += aligned(array[i].count * array[i].size);
    }
    return PM_OK;
}

int pm_arena_keep(pm_arena *arena, void *object, void (*give_back)(void *object))
{
    if (!object) return PM_NO_MEMORY;
    if (add_part(arena, 0, object, give_back)) return PM_OK;
    give_back(object);
    return PM_NO_MEMORY;
}

void pm_arena_free(pm_arena *arena)
{
    while (arena->last) {
        pm_arena_part *part = arena->last;
        if (part->object) part->give_back(part->object);
        arena->last = part->before;
        free(part);
    }
}
