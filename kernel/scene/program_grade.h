/* program_grade.h - finds what kind of function each program is, once per scene. */
#ifndef PM_PROGRAM_GRADE_H
#define PM_PROGRAM_GRADE_H

#include "state/model.h"

/* enum pm_program_class, enum pm_program_energy of a program. */
int pm_program_grade_class(const pm_model *m, int program);
int pm_program_grade_energy(const pm_model *m, int program);
/* Notes both, and the level that its measures need, of all programs in m->programs. */
void pm_program_grade_all(pm_model *m);

#endif
