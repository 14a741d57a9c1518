/* waves.h - whether the samples of a step show what triggers and asks do between them.
 *
 * Measures are smooth along a step, which is no longer than the motion allows.  An expression of them need not be: cos(100 x)
 * has many waves in a step, exp(-(x / d)^2) a narrow peak.  Where an operation can do so, the expression is enclosed
 * (expression/enclosure.h) along the polynomials through the samples of its measures, and compared with its own samples. */
#ifndef PM_WAVES_H
#define PM_WAVES_H

#include "expression/enclosure.h"
#include "state/workspace.h"

/* All watched programs are known (watched_samples.h). */
int pm_waves_create(pm_workspace *w);
/* 1 if a program may have waves along a step, by an operation that is neither a sum, a product nor a switch. */
int pm_waves_may_be(const pm_workspace *w, int program);
/* The same but for the corners of distances that it reads. */
int pm_waves_beyond_distances(const pm_workspace *w, int program);
/* 1 if something that is watched in the phase might have waves. */
int pm_waves_possible(const pm_workspace *w, int functions, int watched);
/* 1 if there are none for sure, by samples at any nodes. */
int pm_waves_are_excluded(pm_workspace *w, int functions, int watched);
/* 1 if the samples at the nodes of the step, which are spectral, show all triggers and asks that were sampled. */
int pm_waves_are_shown(pm_workspace *w, int functions, int watched);
/* Where in the step that was sampled so (0 to 1) something first switches, of what is not looked at branch by branch; INFINITY if
 * nothing does, or that is not told. */
double pm_waves_first_switch(pm_workspace *w, int functions, int watched);
/* Nothing has been sampled that tells a program's law. */
void pm_waves_forget(pm_workspace *w);
/* 1 if the samples of all measures that a program reads, which may have waves by them, show these along the step: a program of
 * triggers or of asks (PM_SAMPLE_TRIGGERS, PM_SAMPLE_ASKS). */
int pm_waves_tell_law(const pm_workspace *w, int program, int who);
/* The program at s (0 to 1) of the step by its law: what it makes of its measures there; of the branch with these signs, or
 * (NULL) of the one that is taken. */
pm_jet pm_waves_law(const pm_workspace *w, int program, const signed char *sign, double s);
/* What the program cannot leave over the part [from, to] of the step, by its law. */
pm_enclosure pm_waves_enclosed(const pm_workspace *w, int program, double from, double to);
/* 1 if samples at few nodes, as routes have them, would show these, too. */
int pm_waves_are_shown_by_few(pm_workspace *w, int functions, int watched);

#endif
