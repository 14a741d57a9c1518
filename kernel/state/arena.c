/* arena.c - many arrays in one block of memory. */
#include "state/arena.h"

#include <stdlib.h>
#include <string.h>

#include "planemotion.h"

#define ALIGNMENT 16 /* bytes: what calloc gives, and enough for two doubles in one register */

static size_t aligned(size_t bytes) { return (bytes + ALIGNMENT - 1) & ~(size_t)(ALIGNMENT - 1); }

size_t pm_arena_size(const pm_array *array, size_t narrays)
{
    size_t total = 0;
    for (size_t i = 0; i < narrays; i++) total += aligned(array[i].count * array[i].size);
    return total;
}

void *pm_arena_place(const pm_array *array, size_t narrays, void *at)
{
    char *p = at;
    for (size_t i = 0; i < narrays; i++) {
        memcpy(array[i].where, &p, sizeof p); /* a pointer of another type: see pm_array */
        p += aligned(array[i].count * array[i].size);
    }
    return p;
}

int pm_arena_create(void **block, const pm_array *array, size_t narrays)
{
    *block = calloc(1, pm_arena_size(array, narrays) + ALIGNMENT); /* never of 0 bytes */
    if (!*block) return PM_NO_MEMORY;
    pm_arena_place(array, narrays, *block);
    return PM_OK;
}
