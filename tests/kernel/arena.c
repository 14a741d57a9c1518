/* arena - many arrays in one block: all within it, aligned, apart from each other, zeroed; objects of others; the order in
 * which all is given back. */
#include "state/arena.h"

#include <stdint.h>

#include "check.h"
#include "planemotion.h"

typedef struct arrays {
    double *mass;
    unsigned char *is_held;
    int32_t *pivot;
    double *empty, *last;
} arrays;

static void check_arrays(void)
{
    pm_arena arena = {NULL};
    arrays *a = NULL;
    CHECK(PM_ARENA_NEW(&arena, a) == PM_OK);
    const pm_array array[] = {PM_ARRAY(a->mass, 3), PM_ARRAY(a->is_held, 5), PM_ARRAY(a->pivot, 7),
                              PM_ARRAY(a->empty, 0), PM_ARRAY(a->last, 1)};
    const size_t bytes = pm_arena_size(PM_ARRAYS(array));
    CHECK(pm_arena_take(&arena, PM_ARRAYS(array)) == PM_OK);
    const char *begin = (const char *)a->mass;
    CHECK((char *)a->is_held >= (char *)(a->mass + 3));
    CHECK((char *)a->pivot >= (char *)(a->is_held + 5));
    CHECK((char *)a->last >= (char *)(a->pivot + 7));
    CHECK((char *)(a->last + 1) <= begin + bytes);
    CHECK((uintptr_t)begin % 16 == 0 && (uintptr_t)a->pivot % 16 == 0 && (uintptr_t)a->last % 16 == 0);
    for (size_t i = 0; i < bytes; i++) CHECK(begin[i] == 0);
    pm_arena_free(&arena);
    CHECK(!arena.last);
}

/* More than there is: nothing is set, and nothing has been taken. */
static void check_want(void)
{
    pm_arena arena = {NULL};
    double *huge = NULL;
    const pm_array much[] = {PM_ARRAY(huge, SIZE_MAX / 32)};
    CHECK(pm_arena_take(&arena, PM_ARRAYS(much)) == PM_NO_MEMORY && !huge && !arena.last);
}

static int given_back[2], ngiven;

static void give_back(void *object) { given_back[ngiven++] = *(int *)object; }

static void check_objects(void)
{
    pm_arena arena = {NULL};
    int first = 1, second = 2;
    CHECK(pm_arena_keep(&arena, NULL, give_back) == PM_NO_MEMORY);
    CHECK(pm_arena_keep(&arena, &first, give_back) == PM_OK);
    CHECK(pm_arena_keep(&arena, &second, give_back) == PM_OK);
    pm_arena_free(&arena);
    CHECK(ngiven == 2 && given_back[0] == 2 && given_back[1] == 1);
}

int main(void)
{
    check_arrays();
    check_want();
    check_objects();
    return check_failures();
}
