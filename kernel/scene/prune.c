/* prune.c - writes the tables once more, with the needed rows alone, in their order. */
#include "scene/prune.h"

#include <stdlib.h>
#include <string.h>

#include "scene/build.h"
#include "scene/dependency.h"
#include "scene/reference.h"

typedef struct pm_reduction {
    const pm_model *m;
    const pm_dependency *needed;
    int32_t *place[PM_TABLES];    /* row of each row that stays */
    int32_t *original[PM_TABLES]; /* and back */
    int rows[PM_TABLES];
    int64_t ntable;
    int32_t *table;
} pm_reduction;

static int cuts_anything(const pm_model *m, const pm_dependency *x)
{
    int bodies = 0, cut = 0;
    for (int i = 0; i < m->nbody; i++) bodies += x->row[PM_TABLE_BODY][i] != 0;
    for (int of = 0; of < PM_TABLES && !cut; of++)
        for (int i = 0; i < m->rows[of] && !cut; i++) cut = !x->row[of][i];
    return cut && bodies > 0; /* a scene has a body */
}

/* The tables first, so that one block holds all and begins with them. */
static int create(const pm_model *m, const pm_dependency *needed, pm_reduction *x)
{
    int64_t all = 0;
    *x = (pm_reduction){.m = m, .needed = needed, .ntable = 2 * PM_TABLES};
    for (int of = 0; of < PM_TABLES; of++) {
        for (int i = 0; i < m->rows[of]; i++) x->rows[of] += needed->row[of][i] != 0;
        x->ntable += (int64_t)x->rows[of] * pm_reference_columns[of];
        all += m->rows[of];
    }
    x->table = calloc((size_t)(x->ntable + 2 * all), sizeof *x->table);
    if (!x->table) return PM_NO_MEMORY;
    int32_t *next = x->table + x->ntable;
    for (int of = 0; of < PM_TABLES; of++) {
        x->place[of] = next;
        x->original[of] = next + m->rows[of];
        next += 2 * m->rows[of];
    }
    return PM_OK;
}

static void number(pm_reduction *x)
{
    for (int of = 0; of < PM_TABLES; of++)
        for (int i = 0, n = 0; i < x->m->rows[of]; i++) {
            if (!x->needed->row[of][i]) continue;
            x->original[of][n] = i;
            x->place[of][i] = n++;
        }
}

static void write_row(const pm_reduction *x, int of, int row, int32_t *out)
{
    const int32_t *e = pm_model_row(x->m, of, row, pm_reference_columns[of]);
    pm_reference ref[PM_REFERENCES];
    const int n = pm_reference_of(x->m, of, row, ref);
    memcpy(out, e, (size_t)pm_reference_columns[of] * sizeof *e);
    for (int k = 0; k < n; k++) out[ref[k].column] = x->place[ref[k].of][ref[k].index];
    if (of == PM_TABLE_PROGRAM) out[PM_PROGRAM_FIRST] = x->place[PM_TABLE_CODE][e[PM_PROGRAM_FIRST]];
}

static void write_tables(const pm_reduction *x)
{
    int32_t first = 2 * PM_TABLES;
    for (int of = 0; of < PM_TABLES; of++) {
        x->table[2 * of] = first;
        x->table[2 * of + 1] = x->rows[of];
        for (int i = 0; i < x->rows[of]; i++, first += pm_reference_columns[of])
            write_row(x, of, x->original[of][i], x->table + first);
    }
}

/* The model of fewer tables in the place of `*model`. */
static int replace(const pm_dependency *needed, pm_model **model, pm_where *where)
{
    pm_reduction x;
    pm_model *whole = *model;
    int status = create(whole, needed, &x);
    if (status) return status;
    number(&x);
    write_tables(&x);
    status =
        pm_model_create(x.ntable, x.table, whole->nconstant, whole->constant, whole->nparam, model, where);
    if (status) {
        *model = whole;
        free(x.table);
        return status;
    }
    (*model)->prune.table = x.table;
    memcpy((*model)->prune.original, x.original, sizeof x.original);
    pm_model_free(whole);
    return PM_OK;
}

int pm_prune_create(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant,
                    int64_t nparam, pm_model **model, pm_where *where)
{
    pm_dependency needed = {.block = NULL};
    int status = pm_model_create(ntable, table, nconstant, constant, nparam, model, where);
    if (status) return status;
    status = pm_dependency_find(*model, &needed);
    if (!status && cuts_anything(*model, &needed)) status = replace(&needed, model, where);
    pm_dependency_free(&needed);
    if (!status) return PM_OK;
    pm_model_free(*model);
    *model = NULL;
    return status;
}

int pm_prune_original(const pm_model *m, int table, int row)
{
    const int known = m->prune.table && table >= 0 && table < PM_TABLES && row >= 0 && row < m->rows[table];
    return known ? m->prune.original[table][row] : row;
}
