/* Arrays of one block: in their order, apart, aligned, zeroed; pointers of any type may be used right after they are set. */
#include "state/arena.h"

#include <stdint.h>
#include <stdlib.h>

#include "check.h"
#include "planemotion.h"

typedef struct parts {
    double *number, *further;
    int *index;
    unsigned char *flag;
    void *block;
} parts;

static int create(parts *x, int n)
{
    const pm_array array[] = {
        PM_ARRAY(x->flag, n),
        PM_ARRAY(x->number, 2 * n),
        PM_ARRAY(x->index, n),
    };
    const int status = pm_arena_create(&x->block, PM_ARRAYS(array));
    x->further = x->number + n; /* seen here already, though the pointers were NULL a line before */
    return status;
}

static void is_laid_out(int n)
{
    parts *x = calloc(1, sizeof *x);
    EQUAL(create(x, n), PM_OK);
    CHECK(x->flag && x->further == x->number + n);
    CHECK((unsigned char *)x->number >= x->flag + n && (double *)(void *)x->index >= x->number + 2 * n);
    EQUAL((uintptr_t)x->number % sizeof(double), 0);
    EQUAL((uintptr_t)x->index % sizeof(int), 0);
    for (int i = 0; i < n; i++) CHECK(x->flag[i] == 0 && x->index[i] == 0 && x->further[i] == 0);
    free(x->block);
    free(x);
}

int main(void)
{
    is_laid_out(0);
    is_laid_out(1);
    is_laid_out(7);
    return check_failures();
}
