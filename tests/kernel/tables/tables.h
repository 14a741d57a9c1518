/* tables.h - the tables of a scene as the kernel takes them, each in memory of its own length (fenced.h); and changes of them at
 * random.  Used by fuzz.c. */
#ifndef TABLES_H
#define TABLES_H

#include <stdint.h>

typedef struct tables {
    int64_t ntable, nconstant, nparam;
    int32_t *table;
    double *constant, *param;
} tables;

typedef struct corpus {
    int n;
    tables *model;
} corpus;

tables tables_copy(const tables *x);
void tables_free(tables *x);
/* Rows of a table by its directory, 0 where that does not lie in the tables; the row's first cell. */
int tables_rows(const tables *x, int table);
int32_t *tables_row(const tables *x, int table, int row);

/* Models one after the other in a file: three lengths (int64), then the arrays.  Returns 1 where it cannot be read. */
int corpus_read(corpus *c, const char *file);
/* Models built by hand: those of scenes.c. */
void corpus_build(corpus *c);
void corpus_add(corpus *c, tables x);
void corpus_free(corpus *c);

/* Some changes that follow from the number alone: of cells, rows, lengths, the directory and numbers. */
void tables_mutate(tables *x, uint64_t number);
/* The next of a row of random numbers; below n. */
uint64_t tables_random(uint64_t *state);
int64_t tables_below(uint64_t *state, int64_t n);

#endif
