/* mutate.c - changes of tables at random: most leave them sound but for one thing, so that they come far into the kernel. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fenced.h"
#include "planemotion.h"
#include "scene/reference.h"
#include "tables.h"

/* splitmix64 */
uint64_t tables_random(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

int64_t tables_below(uint64_t *state, int64_t n)
{
    return n > 0 ? (int64_t)(tables_random(state) % (uint64_t)n) : 0;
}

/* ---- cells ---- */
static int32_t odd_integer(uint64_t *r)
{
    static const int32_t odd[] = {
        0, 1, 2, -1, -2, -3, 3, 63, 64, 65, 4096, INT32_MAX, INT32_MIN, INT32_MAX / 8, 1 << 16};
    return odd[tables_below(r, sizeof odd / sizeof *odd)];
}

/* A table that has rows; PM_TABLES where none has. */
static int some_table(const tables *x, uint64_t *r)
{
    for (int i = 0; i < 8 * PM_TABLES; i++) {
        const int table = (int)tables_below(r, PM_TABLES);
        if (tables_rows(x, table) > 0) return table;
    }
    return PM_TABLES;
}

/* What might stand in a cell: another's of its column, one more or less, an index of some table, something odd. */
static int32_t another(const tables *x, int table, int column, int32_t old, uint64_t *r)
{
    switch (tables_below(r, 6)) {
    case 0: return old + (old < INT32_MAX);
    case 1: return old - (old > INT32_MIN);
    case 2: return odd_integer(r);
    case 3: return tables_row(x, table, (int)tables_below(r, tables_rows(x, table)))[column];
    case 4: return (int32_t)tables_below(r, 50);
    default: return (int32_t)tables_below(r, tables_rows(x, (int)tables_below(r, PM_TABLES)));
    }
}

static void change_cell(tables *x, uint64_t *r)
{
    const int table = some_table(x, r);
    if (table == PM_TABLES) return;
    const int column = (int)tables_below(r, pm_reference_columns[table]);
    int32_t *cell = tables_row(x, table, (int)tables_below(r, tables_rows(x, table))) + column;
    *cell = another(x, table, column, *cell, r);
}

static void copy_row(tables *x, uint64_t *r)
{
    const int table = some_table(x, r);
    if (table == PM_TABLES) return;
    const int rows = tables_rows(x, table);
    const int32_t *from = tables_row(x, table, (int)tables_below(r, rows));
    memmove(tables_row(x, table, (int)tables_below(r, rows)), from,
            (size_t)pm_reference_columns[table] * sizeof *from);
}

static void swap_cells(tables *x, uint64_t *r)
{
    const int table = some_table(x, r);
    if (table == PM_TABLES) return;
    const int rows = tables_rows(x, table), column = (int)tables_below(r, pm_reference_columns[table]);
    int32_t *a = tables_row(x, table, (int)tables_below(r, rows)) + column,
            *b = tables_row(x, table, (int)tables_below(r, rows)) + column;
    const int32_t kept = *a;
    *a = *b;
    *b = kept;
}

/* ---- rows and lengths ---- */
static void remove_last_row(tables *x, uint64_t *r)
{
    const int table = some_table(x, r);
    if (table < PM_TABLES) x->table[2 * table + 1]--;
}

/* One more row, a copy of another; tables that begin behind it move. */
static void add_row(tables *x, uint64_t *r)
{
    const int table = some_table(x, r);
    if (table == PM_TABLES) return;
    const int columns = pm_reference_columns[table], rows = tables_rows(x, table);
    const int64_t end = x->table[2 * table] + (int64_t)rows * columns;
    int32_t *longer = fenced_room(x->ntable + columns, sizeof *longer);
    memcpy(longer, x->table, (size_t)end * sizeof *longer);
    memcpy(longer + end, tables_row(x, table, (int)tables_below(r, rows)), (size_t)columns * sizeof *longer);
    memcpy(longer + end + columns, x->table + end, (size_t)(x->ntable - end) * sizeof *longer);
    for (int i = 0; i < PM_TABLES; i++)
        if (i != table && longer[2 * i] >= end && longer[2 * i] < x->ntable) longer[2 * i] += columns;
    longer[2 * table + 1]++;
    fenced_leave(x->table);
    x->table = longer;
    x->ntable += columns;
}

static void change_directory(tables *x, uint64_t *r)
{
    if (x->ntable < 2 * PM_TABLES) return;
    int32_t *cell = x->table + tables_below(r, 2 * PM_TABLES);
    *cell = tables_below(r, 2) ? odd_integer(r) : (int32_t)tables_below(r, x->ntable + 2);
}

static void cut(tables *x, uint64_t *r)
{
    int64_t *const length[] = {&x->ntable, &x->nconstant, &x->nparam};
    int64_t *n = length[tables_below(r, 3)];
    *n = tables_below(r, 3) ? *n - (*n > 0) : tables_below(r, *n + 1);
    tables shorter = tables_copy(x);
    tables_free(x);
    *x = shorter;
}

/* ---- numbers ---- */
static double odd_number(double old, uint64_t *r)
{
    static const double odd[] = {
        0,       -0.,    1,      -1,    NAN,    INFINITY, -INFINITY,         DBL_MAX,
        DBL_MIN, 5e-324, 1e-320, 1e308, -1e308, 1e154,    2147483648.,       1e18,
        1e-9,    1e9,    0.5,    2,     3,      1e-17,    4503599627370497., -1e-300};
    static const double factor[] = {-1, 1e-12, 1e-6, 1e-3, 0.5, 0.999999, 1.000001, 2, 10, 1e3, 1e6, 1e12};
    if (tables_below(r, 2)) return odd[tables_below(r, sizeof odd / sizeof *odd)];
    return old * factor[tables_below(r, sizeof factor / sizeof *factor)];
}

static void change_constant(tables *x, uint64_t *r)
{
    if (x->nconstant == 0) return;
    double *number = x->constant + tables_below(r, x->nconstant);
    *number = odd_number(*number, r);
}

static void change_parameter(tables *x, uint64_t *r)
{
    if (x->nparam == 0) return;
    double *number = x->param + tables_below(r, x->nparam);
    *number = odd_number(*number, r);
}

/* ---- */
typedef void change(tables *x, uint64_t *r);

void tables_mutate(tables *x, uint64_t number)
{
    static change *const changes[] = {
        change_cell,      change_cell, change_cell,      change_cell,     change_cell,     swap_cells,
        copy_row,         add_row,     remove_last_row,  change_constant, change_constant, change_constant,
        change_parameter, cut,         change_directory, change_parameter};
    uint64_t r = number;
    do changes[tables_below(&r, sizeof changes / sizeof *changes)](x, &r);
    while (tables_below(&r, 5) < 2);
}
