/* arena - many arrays in one block: all within it, aligned, apart from each other, zeroed. */
#include "state/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "planemotion.h"

typedef struct arrays {
    double *mass;
    unsigned char *is_held;
    int32_t *pivot;
    double *empty, *last;
    void *block;
} arrays;

#define LIST(a)                                                                                          \
    {                                                                                                    \
        PM_ARRAY((a).mass, 3), PM_ARRAY((a).is_held, 5), PM_ARRAY((a).pivot, 7), PM_ARRAY((a).empty, 0), \
            PM_ARRAY((a).last, 1)                                                                        \
    }

static void check_places(const arrays *a)
{
    const char *begin = a->block;
    CHECK((char *)a->mass == begin);
    CHECK((char *)a->is_held >= (char *)(a->mass + 3));
    CHECK((char *)a->pivot >= (char *)(a->is_held + 5));
    CHECK((char *)a->last >= (char *)(a->pivot + 7));
    CHECK((uintptr_t)a->pivot % sizeof(double) == 0 && (uintptr_t)a->last % sizeof(double) == 0);
}

int main(void)
{
    arrays a;
    const pm_array array[] = LIST(a);
    const size_t bytes = pm_arena_size(PM_ARRAYS(array));
    CHECK(pm_arena_create(&a.block, PM_ARRAYS(array)) == PM_OK);
    check_places(&a);
    CHECK((char *)(a.last + 1) <= (char *)a.block + bytes);
    for (size_t i = 0; i < bytes; i++) CHECK(((unsigned char *)a.block)[i] == 0);

    /* the same list in memory that is there */
    void *mine = malloc(bytes);
    arrays b = {.block = mine};
    const pm_array again[] = LIST(b);
    CHECK(pm_arena_place(PM_ARRAYS(again), mine) == (char *)mine + bytes);
    check_places(&b);
    free(mine);
    free(a.block);

    /* more than there is */
    double *huge = NULL;
    void *block = &huge;
    const pm_array much[] = {PM_ARRAY(huge, SIZE_MAX / 32)};
    CHECK(pm_arena_create(&block, PM_ARRAYS(much)) == PM_NO_MEMORY && !block && !huge);
    return check_failures();
}
