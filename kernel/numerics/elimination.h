/* elimination.h - elimination of rows that have few entries, near each other; they determine all columns but some. */
#ifndef PM_ELIMINATION_H
#define PM_ELIMINATION_H

/* Memory of whoever runs it. */
typedef struct pm_elimination {
    int *low, *high; /* [rows] between which columns each row has entries: given before, and left after */
    int *place;      /* [n] place[column[k]] = k */
    /* scratch */
    int *first, *last; /* [rows] between which columns a row, and those after it, have entries */
    int *filled;       /* [n] */
} pm_elimination;

/* Row after row of a[rows][n], rows <= n, looking only at what is not zero: the pivot of row i is its greatest entry in a
 * column that is no pivot's, and that column is column[i]; what is right of it is in the columns that follow there.  The
 * least pivot over the greatest, 0 where a row depends on those before it. */
double pm_elimination_run(int rows, int n, double *a, int *column, pm_elimination *x);

#endif
