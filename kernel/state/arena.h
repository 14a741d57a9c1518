/* arena.h - many arrays in one block of memory.
 *
 * A list says for each array the pointer that is to point to it, how many entries it has and how large one is; all are
 * then taken from one block, in this order and each aligned for any type of entry, zeroed.  The block has one owner, which frees it
 * with free(); the pointers own nothing.  An array of 0 entries gets an address that nobody may read.
 *
 *     const pm_array array[] = {PM_ARRAY(x->mass, n), PM_ARRAY(x->is_held, n + 1)};
 *     status = pm_arena_create(&x->block, PM_ARRAYS(array)); */
#ifndef PM_ARENA_H
#define PM_ARENA_H

#include <stddef.h>

typedef struct pm_array {
    void *
        where; /* the pointer that is set: of any type, so its bytes are copied (a store as void * could go unseen) */
    size_t count; /* entries */
    size_t size;  /* bytes of one */
} pm_array;

#define PM_ARRAY(pointer, count)                               \
    {                                                          \
        (void *)&(pointer), (size_t)(count), sizeof *(pointer) \
    }
#define PM_ARRAYS(list) (list), sizeof(list) / sizeof *(list)

/* Bytes that the arrays take. */
size_t pm_arena_size(const pm_array *array, size_t narrays);
/* Points the arrays into memory that is there already (at least pm_arena_size bytes from `at`); returns what is behind them. */
void *pm_arena_place(const pm_array *array, size_t narrays, void *at);
/* Points the arrays into a new block of zeros; PM_NO_MEMORY, and *block is NULL and no pointer is set then. */
int pm_arena_create(void **block, const pm_array *array, size_t narrays);

#endif
