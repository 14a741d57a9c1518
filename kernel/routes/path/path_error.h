/* path_error.h - what rounding makes of the answers of a run along paths: no companion run is needed. */
#ifndef PM_PATH_ERROR_H
#define PM_PATH_ERROR_H

#include "state/evidence.h"
#include "state/workspace.h"

/* The error of T at the begin of a path phase, from that at the end of the phase before it. */
void pm_path_error_begin(const pm_result *result, struct pm_path *p, double kinetic);
/* After a step that ends with `kinetic`. */
void pm_path_error_step(pm_workspace *w, double kinetic);
/* T passed a barrier at `distance` above it, or turned back as much below. */
void pm_path_error_barrier(pm_evidence *evidence, const struct pm_path *path, double distance);
/* Tells the error of out[column], the value of the program at the frame, if it is known. */
void pm_path_error_answer(pm_workspace *w, int ask, int column, int program, double value);

/* A step has been sampled: how near to zero the functions come that do not fire by place. */
void pm_path_error_sampled(pm_workspace *w);
/* The margin of these in a pass; trigger_scale[ntrigger] natural sizes. */
double pm_path_error_margin(const pm_model *model, const pm_pass *pass, const double *trigger_scale);

/* Once per model: do places alone decide when what matters to the answers happens, but for events that are counted and no
 * more? */
int pm_path_error_by_places(const pm_model *m);

#endif
