/* program_degree.h - programs that are polynomials in the time while accelerations are constant. */
#ifndef PM_PROGRAM_DEGREE_H
#define PM_PROGRAM_DEGREE_H

#include "elements/constant_motion.h"
#include "expression/program_class.h"
#include "state/workspace.h"

/* enum pm_program_degree of a program, along the curve. */
int pm_program_degree_of(const pm_frame *frame, const pm_constant_motion *x, int program);
/* The program is the size of a vector whose components are linear in the time: its square is a parabola. */
int pm_program_degree_is_size(const pm_frame *frame, const pm_constant_motion *x, int program);

#endif
