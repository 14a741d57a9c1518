/* wave_kinds.h - what a program may have along a step that the measures it reads have not. */
#ifndef PM_WAVE_KINDS_H
#define PM_WAVE_KINDS_H

#include "state/model.h"

/* Nothing; corners and jumps of switches; nearly corners, where a distance that it reads is small for a moment; anything. */
enum { PM_WAVES_NONE = 0, PM_WAVES_SWITCHES_ONLY = 1, PM_WAVES_DISTANCES = 2, PM_WAVES_ANY = 3 };

/* What a measure is made of is small for a moment, and has nearly a corner there, however long the step is. */
int pm_wave_kinds_distance(const pm_model *m, int measure);
/* The most that it may have. */
int pm_wave_kinds_of(const pm_model *m, int program);

#endif
