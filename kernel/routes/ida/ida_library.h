/* ida_library.h - what differs between SUNDIALS 6 and 7: contexts and messages. */
#ifndef PM_IDA_LIBRARY_H
#define PM_IDA_LIBRARY_H

#include <ida/ida.h>

/* A context of its own for each thread; *context = NULL on failure.  Returns SUNDIALS' code. */
int pm_ida_library_open(SUNContext *context);
/* Nothing that IDA has to say is printed: what went wrong comes back as a code. */
int pm_ida_library_silence(void *memory);

#endif
