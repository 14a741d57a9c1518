/* unused.c - functions of the standard that this FMU does not offer, as its model description says: it has real variables
 * alone, and its state can be neither kept nor differentiated.  Lists of no variables are right for any type. */
#include "fmi2.h"

static fmi2Status none_of(size_t n) { return n ? fmi2Error : fmi2OK; }

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference reference[], size_t n,
                          fmi2Integer value[])
{
    (void)c, (void)reference, (void)value;
    return none_of(n);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference reference[], size_t n,
                          fmi2Boolean value[])
{
    (void)c, (void)reference, (void)value;
    return none_of(n);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference reference[], size_t n, fmi2String value[])
{
    (void)c, (void)reference, (void)value;
    return none_of(n);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference reference[], size_t n,
                          const fmi2Integer value[])
{
    (void)c, (void)reference, (void)value;
    return none_of(n);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference reference[], size_t n,
                          const fmi2Boolean value[])
{
    (void)c, (void)reference, (void)value;
    return none_of(n);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference reference[], size_t n,
                         const fmi2String value[])
{
    (void)c, (void)reference, (void)value;
    return none_of(n);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    (void)c, (void)state;
    return fmi2Error;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    (void)c, (void)state;
    return fmi2Error;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    (void)c, (void)state;
    return fmi2Error;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    (void)c, (void)state, (void)size;
    return fmi2Error;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    (void)c, (void)state, (void)bytes, (void)size;
    return fmi2Error;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    (void)c, (void)state, (void)bytes, (void)size;
    return fmi2Error;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t nunknown,
                                        const fmi2ValueReference known[], size_t nknown,
                                        const fmi2Real change[], fmi2Real derivative[])
{
    (void)c, (void)unknown, (void)nunknown, (void)known, (void)nknown, (void)change, (void)derivative;
    return fmi2Error;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference reference[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    (void)c, (void)reference, (void)order, (void)value;
    return none_of(n);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference reference[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[])
{
    (void)c, (void)reference, (void)order, (void)value;
    return none_of(n);
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)c, (void)kind, (void)value;
    return fmi2Discard;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)c, (void)kind, (void)value;
    return fmi2Discard;
}
