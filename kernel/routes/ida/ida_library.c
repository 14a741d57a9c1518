/* ida_library.c - the only file that knows which SUNDIALS it is compiled for. */
#include "routes/ida/ida.h"

#include <sundials/sundials_config.h>

#if SUNDIALS_VERSION_MAJOR >= 7

int pm_ida_library_open(SUNContext *context)
{
    *context = NULL;
    const int code = SUNContext_Create(SUN_COMM_NULL, context);
    return code ? code : SUNContext_ClearErrHandlers(*context); /* the first handler prints */
}

int pm_ida_library_silence(void *memory)
{
    (void)memory; /* messages belong to the context */
    return IDA_SUCCESS;
}

#else

int pm_ida_library_open(SUNContext *context)
{
    *context = NULL;
    return SUNContext_Create(NULL, context);
}

static void say_nothing(int code, const char *module, const char *function, char *message, void *data)
{
    (void)code;
    (void)module;
    (void)function;
    (void)message;
    (void)data;
}

int pm_ida_library_silence(void *memory) { return IDASetErrHandlerFn(memory, say_nothing, NULL); }

#endif
