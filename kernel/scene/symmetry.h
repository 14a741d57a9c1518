/* symmetry.h - whether a scene looks the same after a shift of all bodies: what was computed once may then be used again. */
#ifndef PM_SYMMETRY_H
#define PM_SYMMETRY_H

#include "state/workspace.h"

/* All bodies move by the same way, each rotates by an angle of its own. */
typedef struct pm_symmetry_shift {
    double by[2];
    const double *rotation; /* [nbody] */
} pm_symmetry_shift;

/* 1 if joints, contacts and forces act after the shift as they did before, rotated marks included. */
int pm_symmetry_holds(const pm_frame *frame, const pm_symmetry_shift *shift);
/* 1 if the program's value changes by the constant *change with the shift, wherever the bodies are. */
int pm_symmetry_program(const pm_frame *frame, const pm_symmetry_shift *shift, int program, double *change);

#endif
