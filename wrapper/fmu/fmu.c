/* fmu.c - a scene as an FMU for co-simulation (FMI 2.0).  Its inputs are parameters, which are set before the
 * initialisation ends; value references: first the parameters, then the outputs.  A run that has come to its end
 * discards the step that leads beyond it, as the standard says, and tells the time of its end. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2.h"
#include "planemotion.h"
#include "recorded.h"
#include "scene_file.h"

#define LONGEST_TEXT 512
/* Part of a step that counts as none where a run ends at a communication point. */
#define ROUNDING 1e-9

typedef struct pm_instance {
    pm_scene_file scene;
    pm_recorded record;
    double *first; /* the parameters as the scene has them */
    char *name;
    const fmi2CallbackFunctions *call;
    double start, t;
    int runs, terminated;
} pm_instance;

/* ---- messages ---- */

static void tell(const pm_instance *x, fmi2Status status, const char *text)
{
    if (x->call && x->call->logger)
        x->call->logger(x->call->componentEnvironment, x->name, status,
                        status == fmi2Error ? "logStatusError" : "logStatusWarning", "%s", text);
}

static fmi2Status fail(const pm_instance *x, const char *text)
{
    tell(x, fmi2Error, text);
    return fmi2Error;
}

static fmi2Status fail_run(const pm_instance *x)
{
    char text[LONGEST_TEXT];
    int8_t words[LONGEST_TEXT / 2] = {0};
    pm_status_text(x->record.status, sizeof words - 1, words);
    snprintf(text, sizeof text, "the run failed at t = %g s: %s", x->record.end, (const char *)words);
    return fail(x, text);
}

/* ---- an instance from its begin to its end ---- */

fmi2String fmi2GetTypesPlatform(void) { return "default"; }

fmi2String fmi2GetVersion(void) { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    (void)c, (void)on, (void)n, (void)categories;
    return fmi2OK;
}

static int keep(pm_instance *x, fmi2String name)
{
    const size_t size = (size_t)x->scene.nparam * sizeof *x->first;
    x->first = malloc(size + 1);
    x->name = strdup(name ? name : "");
    if (!x->first || !x->name) return -1;
    memcpy(x->first, x->scene.value, size);
    return 0;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *call, fmi2Boolean visible, fmi2Boolean logging)
{
    pm_instance *x = calloc(1, sizeof *x);
    (void)visible, (void)logging;
    if (!x) return NULL;
    x->call = call;
    if (type != fmi2CoSimulation)
        fail(x, "this FMU is for co-simulation");
    else if (pm_scene_file_read(resources, &x->scene))
        fail(x, "resources/scene.bin cannot be read");
    else if (!guid || strcmp(guid, x->scene.guid))
        fail(x, "the GUID is not that of resources/scene.bin");
    else if (keep(x, name))
        fail(x, "there is no memory");
    else
        return x;
    fmi2FreeInstance(x);
    return NULL;
}

void fmi2FreeInstance(fmi2Component c)
{
    pm_instance *x = c;
    if (!x) return;
    pm_recorded_free(&x->record);
    pm_scene_file_free(&x->scene);
    free(x->first);
    free(x->name);
    free(x);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop)
{
    pm_instance *x = c;
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
    x->start = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

/* The run on a grid of `every` s. */
static fmi2Status run(pm_instance *x, double every)
{
    if (pm_recorded_make(&x->record, &x->scene, every))
        return fail(x, "there is no memory, or the steps are too small for this run");
    return x->record.rows > 0 ? fmi2OK : fail_run(x);
}

/* The first grid is as coarse as can be: the steps that the master takes are not known. */
fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    pm_instance *x = c;
    x->t = 0;
    x->terminated = 0;
    x->runs = 1;
    return run(x, 1e9);
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    pm_instance *x = c;
    memcpy(x->scene.value, x->first, (size_t)x->scene.nparam * sizeof *x->first);
    x->runs = x->terminated = 0;
    x->t = 0;
    return fmi2OK;
}

/* ---- values ---- */

static double value_of(const pm_instance *x, fmi2ValueReference reference)
{
    if (reference < (uint64_t)x->scene.nparam) return x->scene.value[reference];
    return pm_recorded_at(&x->record, &x->scene, x->t)[reference - x->scene.nparam];
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference reference[], size_t n, fmi2Real value[])
{
    pm_instance *x = c;
    for (size_t i = 0; i < n; i++)
        if (reference[i] >= (uint64_t)(x->scene.nparam + x->scene.noutput))
            return fail(x, "there is no such variable");
    if (!x->runs && fmi2ExitInitializationMode(c) != fmi2OK) return fmi2Error;
    for (size_t i = 0; i < n; i++) value[i] = value_of(x, reference[i]);
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference reference[], size_t n,
                       const fmi2Real value[])
{
    pm_instance *x = c;
    if (x->t > 0) return fail(x, "parameters are set before the first step");
    for (size_t i = 0; i < n; i++) {
        if (reference[i] >= (uint64_t)x->scene.nparam) return fail(x, "only parameters can be set");
        x->scene.value[reference[i]] = value[i];
    }
    x->runs = 0;
    return fmi2OK;
}

/* ---- steps ---- */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real current, fmi2Real step, fmi2Boolean no_way_back)
{
    pm_instance *x = c;
    const double t = current - x->start + step;
    (void)no_way_back;
    if (x->terminated) return fmi2Discard;
    if (!x->runs && fmi2ExitInitializationMode(c) != fmi2OK) return fmi2Error;
    if (step < 0 || t < 0) return fail(x, "a step leads forward");
    if (step > 0 && t > 0 && !pm_recorded_has(&x->record, t)) {
        const double steps = t / step, whole = (double)(int64_t)(steps + 0.5);
        const int on_grid = steps - whole < 1e-6 && whole - steps < 1e-6;
        if (run(x, on_grid ? step : t) != fmi2OK) return fmi2Error;
    }
    if (t <= x->record.end + ROUNDING * step) {
        x->t = t;
        return fmi2OK;
    }
    x->t = x->record.end;
    if (x->record.status < PM_OK) return fail_run(x);
    x->terminated = 1;
    return fmi2Discard;
}

fmi2Status fmi2CancelStep(fmi2Component c) { return fail(c, "no step is pending"); }

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    pm_instance *x = c;
    if (kind != fmi2DoStepStatus) return fmi2Discard;
    *value = x->terminated ? fmi2Discard : fmi2OK;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    pm_instance *x = c;
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = x->start + x->t;
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    pm_instance *x = c;
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = x->terminated;
    return fmi2OK;
}
