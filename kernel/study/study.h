/* study.h - a workspace with what whole studies of a model need beside a run. */
#ifndef PM_STUDY_H
#define PM_STUDY_H

#include "state/workspace.h"

/* pm_workspace_create, and memory for estimates of errors (accuracy.h) and for what is sought (find.h). */
int pm_study_create(const pm_model *model, pm_workspace **workspace);
void pm_study_free(pm_workspace *w);

#endif
