/* tables.c - tables in memory, and a corpus of them. */
#include "tables.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fenced.h"
#include "planemotion.h"
#include "scene/reference.h"

#define MOST_CELLS 10000000 /* of an array in a file */

static void *copy_of(const void *x, int64_t n, int64_t size)
{
    void *y = fenced_room(n, size);
    if (n > 0) memcpy(y, x, (size_t)(n * size));
    return y;
}

tables tables_copy(const tables *x)
{
    tables y = *x;
    y.table = copy_of(x->table, x->ntable, sizeof *x->table);
    y.constant = copy_of(x->constant, x->nconstant, sizeof *x->constant);
    y.param = copy_of(x->param, x->nparam, sizeof *x->param);
    return y;
}

void tables_free(tables *x)
{
    fenced_leave(x->table);
    fenced_leave(x->constant);
    fenced_leave(x->param);
}

int tables_rows(const tables *x, int table)
{
    if (x->ntable < 2 * PM_TABLES) return 0;
    const int64_t first = x->table[2 * table], rows = x->table[2 * table + 1];
    return first < 0 || rows < 0 || first + rows * pm_reference_columns[table] > x->ntable ? 0 : (int)rows;
}

int32_t *tables_row(const tables *x, int table, int row)
{
    return x->table + x->table[2 * table] + (ptrdiff_t)row * pm_reference_columns[table];
}

void corpus_add(corpus *c, tables x)
{
    c->model = realloc(c->model, (size_t)(c->n + 1) * sizeof *c->model);
    if (!c->model) abort();
    c->model[c->n++] = x;
}

void corpus_free(corpus *c)
{
    for (int i = 0; i < c->n; i++) tables_free(&c->model[i]);
    free(c->model);
}

static int read_array(FILE *stream, void **array, int64_t n, int64_t size)
{
    if (n < 0 || n > MOST_CELLS) return 1;
    *array = fenced_room(n, size);
    return n > 0 && fread(*array, (size_t)size, (size_t)n, stream) != (size_t)n;
}

int corpus_read(corpus *c, const char *file)
{
    FILE *stream = fopen(file, "rb");
    int64_t n[3];
    int bad = !stream;
    while (!bad && fread(n, sizeof *n, 3, stream) == 3) {
        tables x = {.ntable = n[0], .nconstant = n[1], .nparam = n[2]};
        bad = read_array(stream, (void **)&x.table, n[0], sizeof *x.table) ||
              read_array(stream, (void **)&x.constant, n[1], sizeof *x.constant) ||
              read_array(stream, (void **)&x.param, n[2], sizeof *x.param);
        corpus_add(c, x);
    }
    if (stream) fclose(stream);
    return bad || c->n == 0;
}
