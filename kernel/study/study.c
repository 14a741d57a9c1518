/* study.c - memory of a thread that runs the cases of a study. */
#include "study/study.h"

#include "study/accuracy.h"
#include "study/find.h"

int pm_study_create(const pm_model *model, pm_workspace **workspace)
{
    int status = pm_workspace_create(model, workspace);
    if (!status) status = pm_accuracy_create(*workspace);
    if (!status) status = pm_find_create(*workspace);
    if (!status) return PM_OK;
    pm_study_free(*workspace);
    *workspace = NULL;
    return status;
}

void pm_study_free(pm_workspace *w)
{
    if (!w) return;
    pm_find_free(w);
    pm_accuracy_free(w);
    pm_workspace_free(w);
}
