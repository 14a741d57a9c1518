/* ida_root.h - the event functions of a phase in IDA's root finding. */
#ifndef PM_IDA_ROOT_H
#define PM_IDA_ROOT_H

#include "routes/ida/ida.h"

int pm_ida_root_create(pm_workspace *w);
void pm_ida_root_free(pm_workspace *w);
/* A phase begins at w->state with accelerations a; the frame is DYNAMIC there.  Shortens *first, the first
 * step, where an event function asks for it. */
int pm_ida_root_begin(pm_workspace *w, const double *a, double *first);
/* After a step from w->step_begin to *t (`found`: a root of IDA's): marks w->event->root and moves *t to
 * the first root, if there is one. */
int pm_ida_root_step(pm_workspace *w, int found, double *t);

#endif
