/* told.h - whether samples of a stretch tell what a program does between them.
 *
 * They do if its bend f'' stays, everywhere in between, within what it is at the samples: a pulse between two of them bends it
 * much more.  Parts of the stretch whose enclosure does not show that are halved. */
#ifndef PM_TOLD_H
#define PM_TOLD_H

#include "expression/enclosure.h"
#include "state/workspace.h"

#define PM_TOLD_SAMPLES 9 /* of a stretch, its ends included */

typedef struct pm_told {
    pm_enclosure (*enclose)(const struct pm_told *x, double from,
                            double to); /* of the program, over a part */
    const pm_workspace *w;
    int program;
    const pm_measure_series *along; /* its measures along a step; NULL: it is a program of the time */
    double *size;                   /* greatest value that an enclosure has shown in the run, so far */
} pm_told;

int pm_told_between(const pm_told *x, double from, double to);

#endif
