/* reference.h - which columns of the tables point into which other tables. */
#ifndef PM_REFERENCE_H
#define PM_REFERENCE_H

#include "state/model.h"

#define PM_REFERENCES 18 /* most of one row */

typedef struct pm_reference {
    int column, of, index; /* the entry of this column is row `index` of table `of` */
} pm_reference;

extern const int pm_reference_columns[PM_TABLES];

/* Every reference lies in its table; kinds of joints, contacts and forces are known. */
int pm_reference_check(const pm_model *m, pm_where *where);
/* A row of table `of`, or the ground where that is a body. */
int pm_reference_in_range(const pm_model *m, int of, int index);
/* The references of a row of a checked model, but those of a program to its code; how many. */
int pm_reference_of(const pm_model *m, int table, int row, pm_reference out[PM_REFERENCES]);
/* The bodies of those that are bodies or marks; how many. */
int pm_reference_bodies(const pm_model *m, int table, int row, int body[PM_REFERENCES]);
/* The k-th program of the scene that prescribes a rate, with its table and row; PM_NONE after the last. */
int pm_reference_drive(const pm_model *m, int k, int *table, int *row);

#endif
