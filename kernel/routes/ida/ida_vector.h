/* ida_vector.h - vectors of SUNDIALS with our own operations. */
#ifndef PM_IDA_VECTOR_H
#define PM_IDA_VECTOR_H

#include <sundials/sundials_nvector.h>

/* A vector with room for `most` numbers, all 0, of which *length count at any time; `length` must outlive
 * it and all its clones.  NULL: out of memory. */
N_Vector pm_ida_vector_create(SUNContext context, const int *length, int most);

#endif
