/* shown.h - whether samples of a stretch show what a program does between them.
 *
 * They do if its second derivative stays, everywhere in between, within what it is at the samples: a pulse between two of them
 * has a much greater one.  Where the enclosure of a part by intervals is too wide to say so, series of high order are asked, and
 * the part is halved. */
#ifndef PM_SHOWN_H
#define PM_SHOWN_H

#include "expression/enclosure.h"
#include "state/workspace.h"

#define PM_SHOWN_SAMPLES 9 /* of a stretch, its ends included */

typedef struct pm_shown {
    pm_enclosure (*enclose)(const struct pm_shown *x, double from,
                            double to); /* of the program, over a part */
    const pm_workspace *w;
    int program;
    const pm_measure_series *along; /* its measures along a step; NULL: it is a program of the time */
    double *size;                   /* greatest value that an enclosure has shown in the run, so far */
} pm_shown;

int pm_shown_between(const pm_shown *x, double from, double to);

#endif
