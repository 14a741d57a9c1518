/* calls.h - tables through all that planemotion.h offers. */
#ifndef CALLS_H
#define CALLS_H

#include "tables.h"

enum calls_outcome { CALLS_OK, CALLS_EARLY, CALLS_FAILED, CALLS_REFUSED, CALLS_OUTCOMES };

/* The outcome of one case; `fault`: what must not be, or NULL.  `stop` [1] is given to the kernel. */
int calls_all(const tables *x, uint64_t number, const int32_t *stop, const char **fault);

/* One batch of `ncase` cases, all alike, over `workers` threads: 1 where their answers differ in a bit. */
int calls_batch_differs(const tables *x, int ncase, int workers);

#endif
