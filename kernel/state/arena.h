/* arena.h - memory with one owner: blocks of arrays, and objects of libraries, taken one by one and given back together.
 *
 * A list says for each array the pointer that is to point to it, how many entries it has and how large one is; all are
 * then taken from one block, in this order and each aligned for any type of entry, zeroed.  The pointers own nothing.  An
 * array of 0 entries gets an address that nobody may read.
 *
 *     if (PM_ARENA_NEW(arena, x)) return PM_NO_MEMORY;
 *     const pm_array array[] = {PM_ARRAY(x->mass, n), PM_ARRAY(x->is_held, n + 1)};
 *     return pm_arena_take(arena, PM_ARRAYS(array)); */
#ifndef PM_ARENA_H
#define PM_ARENA_H

#include <stddef.h>

typedef struct pm_array {
    void *
        where; /* the pointer that is set: of any type, so its bytes are copied (a store as void * could go unseen) */
    size_t count; /* entries */
    size_t size;  /* bytes of one */
} pm_array;

/* All zero: nothing has been taken. */
typedef struct pm_arena {
    struct pm_arena_part *last;
} pm_arena;

#define PM_ARRAY(pointer, count)                               \
    {                                                          \
        (void *)&(pointer), (size_t)(count), sizeof *(pointer) \
    }
#define PM_ARRAYS(list) (list), sizeof(list) / sizeof *(list)
/* The pointer points to one new zeroed struct. */
#define PM_ARENA_NEW(arena, pointer) pm_arena_take((arena), &(const pm_array)PM_ARRAY(pointer, 1), 1)

/* Bytes that the arrays take. */
size_t pm_arena_size(const pm_array *array, size_t narrays);
/* Points the arrays into a new block of zeros; PM_NO_MEMORY, and no pointer is set then. */
int pm_arena_take(pm_arena *arena, const pm_array *array, size_t narrays);
/* The arena owns the object, and gives it back by this function.  PM_NO_MEMORY if the object is NULL, or given back at once
 * for want of memory. */
int pm_arena_keep(pm_arena *arena, void *object, void (*give_back)(void *object));
/* Gives all back, what was taken last first; the arena is empty then. */
void pm_arena_free(pm_arena *arena);

#endif
