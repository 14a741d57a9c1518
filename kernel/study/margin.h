/* margin.h - how far the decisions of a run were from being taken otherwise. */
#ifndef PM_MARGIN_H
#define PM_MARGIN_H

#include "state/evidence.h"

/* Least distance over difference of the decisions that both passes took; trigger_scale[ntrigger]: natural sizes of the
 * trigger programs. */
double pm_margin_of_logs(const pm_evidence_log *a, const pm_evidence_log *b, const double *trigger_scale);

#endif
