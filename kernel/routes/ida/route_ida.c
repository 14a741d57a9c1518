/* route_ida.c - SUNDIALS IDA on the stabilised index-2 system of ida_system.c: the reference; stiff forces.
 *
 * One instance per thread, made for the most active constraints that the scene can have; each phase is a restart
 * with its own number of unknowns (ida_vector.c), from values that the saddle-point system makes
 * consistent.  The state after a step is projected on the constraints; IDA's own history is not touched: the constraints
 * are among its equations.
 *
 * Near a singular position (one constraint depends on the others: reactions without bound) steps shrink to nothing: there
 * the phase is handed over, by w->singular (plan.c). */
#include <math.h>
#include <string.h>

#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "equations/case.h"
#include "equations/saddle.h"
#include "events/ask.h"
#include "events/event.h"
#include "events/gap_passage.h"
#include "events/time_course.h"
#include "numerics/tolerances.h"
#include "routes/ida/ida.h"
#include "scene/build.h"
#include "state/route.h"
#include "state/workspace.h"

#define ORDER 5

static int failed(pm_result *result, int flag)
{
    return pm_fail(result, PM_SOLVER, PM_NONE, PM_NONE, flag, 0);
}

/* What IDA returned, or what the kernel found inside one of IDA's calls. */
static int status_of(pm_result *result, const pm_ida *ida, int flag)
{
    if (flag >= 0) return PM_OK;
    return ida->status ? ida->status : failed(result, flag);
}

/* > 0: IDA may try a smaller step. */
static int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void *workspace)
{
    pm_workspace *w = workspace;
    return pm_ida_system_residual(w, pm_ida_clock_tried(w->ida, t), N_VGetArrayPointer(y),
                                  N_VGetArrayPointer(yp), N_VGetArrayPointer(r))
               ? 0
               : 1;
}

static int weigh(N_Vector y, N_Vector weight, void *workspace)
{
    pm_workspace *w = workspace;
    pm_ida_system_weights(w->model, w->ida, N_VGetArrayPointer(y), N_VGetArrayPointer(weight));
    return 0;
}

/* ---- memory ---- */
static int create_vectors(const pm_model *model, pm_ida *r)
{
    r->y =
        PM_IDA_STOCK ? N_VNew_Serial(r->most, r->context) : pm_ida_vector_create(r->context, &r->n, r->most);
    if (!r->y) return PM_NO_MEMORY;
    N_VConst(0, r->y);
    r->yp = N_VClone(r->y);
    r->dense = N_VClone(r->y);
    r->id = N_VClone(r->y);
    if (!r->yp || !r->dense || !r->id) return PM_NO_MEMORY;
    N_VConst(0, r->yp);
    N_VConst(0, r->id);
    /* the work of drives varies with their reactions, not with the speeds alone */
    const int controlled = 2 * model->nq + model->nz_controlled + pm_model_is_driven(model);
    for (int i = 0; i < controlled; i++) N_VGetArrayPointer(r->id)[i] = 1;
    return PM_OK;
}

static int create_solver(pm_workspace *w)
{
    pm_ida *r = w->ida;
    r->matrix =
        PM_IDA_STOCK ? SUNDenseMatrix(r->most, r->most, r->context) : pm_ida_linear_matrix(r->context);
    if (!r->matrix) return PM_NO_MEMORY;
    r->solver =
        PM_IDA_STOCK ? SUNLinSol_Dense(r->y, r->matrix, r->context) : pm_ida_linear_solver(w, r->context);
    if (!r->solver) return PM_NO_MEMORY;
    int flag = IDASetLinearSolver(r->memory, r->solver, r->matrix);
    if (flag == IDA_SUCCESS && !PM_IDA_STOCK) flag = IDASetJacFn(r->memory, pm_ida_linear_jacobian);
    return status_of(&w->result, w->ida, flag);
}

static int set_up(pm_workspace *w)
{
    pm_ida *r = w->ida;
    int flag = pm_ida_library_silence(r->memory);
    if (flag == IDA_SUCCESS) flag = IDASetUserData(r->memory, w);
    if (flag == IDA_SUCCESS) flag = IDAInit(r->memory, residual, 0, r->y, r->yp);
    if (flag == IDA_SUCCESS) flag = IDAWFtolerances(r->memory, weigh);
    if (flag == IDA_SUCCESS) flag = IDASetId(r->memory, r->id);
    if (flag == IDA_SUCCESS) flag = IDASetSuppressAlg(r->memory, SUNTRUE);
    if (flag == IDA_SUCCESS) flag = IDASetMaxOrd(r->memory, ORDER);
    if (flag == IDA_SUCCESS) flag = IDASetMaxErrTestFails(r->memory, PM_IDA_TRIES);
    if (flag == IDA_SUCCESS) flag = IDASetMaxConvFails(r->memory, PM_IDA_TRIES);
    return status_of(&w->result, w->ida, flag);
}

/* Objects of SUNDIALS: of a struct pm_ida. */
static void destroy(void *ida)
{
    pm_ida *r = ida;
    if (r->memory) IDAFree(&r->memory);
    if (PM_IDA_STOCK) {
        if (r->solver) SUNLinSolFree(r->solver);
        if (r->matrix) SUNMatDestroy(r->matrix);
    } else {
        pm_ida_linear_free(r->matrix, r->solver);
    }
    if (r->newton) SUNNonlinSolFree(r->newton);
    N_Vector vector[] = {r->y, r->yp, r->dense, r->id};
    for (int i = 0; i < 4; i++)
        if (vector[i]) N_VDestroy(vector[i]);
    if (r->context) SUNContext_Free(&r->context);
}

static int create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->ida) || pm_arena_keep(&w->memory, w->ida, destroy)) return PM_NO_MEMORY;
    pm_ida *r = w->ida;
    r->n = r->most = 2 * m->nq + m->nz + 2 * m->nconstraint;
    if (pm_ida_library_open(&r->context)) return PM_NO_MEMORY;
    r->memory = IDACreate(r->context);
    if (!r->memory) return PM_NO_MEMORY;
    const pm_array array[] = {PM_ARRAY(r->weight, r->most + 1)};
    int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (!status) status = pm_ida_rounding_create(&w->memory, &r->rounding, w->model, r->most);
    if (!status) status = pm_ida_jacobian_create(&w->memory, &r->jacobian, m);
    if (!status) status = create_vectors(w->model, w->ida);
    if (!status) status = set_up(w);
    if (!status) status = create_solver(w);
    if (!status) status = pm_ida_newton_create(w);
    if (!status) status = pm_ida_sparse_create(w);
    return status;
}

/* ---- a phase ---- */
static double *accelerations(const pm_model *model, pm_ida *ida)
{
    return N_VGetArrayPointer(ida->yp) + model->nq;
}

/* A step that is sampled may not outrun the motion, and not carry circles through each other between two samples.  IDA
 * applies it one step later: hence well below the motion's own time, and a part of the way to what is met. */
static int limit_step(pm_workspace *w)
{
    const int watched = w->event->nfunction > 0 || w->ask->nobserver > 0;
    const double *v = w->state.v, *a = accelerations(w->model, w->ida);
    double longest =
        watched ? PM_IDA_LONGEST_STEP * pm_case_time_scale(w->model, &w->numbers, v, a) : INFINITY;
    if (w->event->nfunction > 0) longest = fmin(longest, PM_IDA_TO_MEETING * pm_gap_passage_time(w, v, a));
    return IDASetMaxStep(w->ida->memory, isfinite(longest) ? longest : 0); /* 0: no limit */
}

/* Where a couple has just overcome what held, accelerations are rounding and give no time: the scene's own does. */
static double time_to_begin_with(const pm_frame *frame, const pm_state *state)
{
    const double scale = pm_case_time_scale(frame->model, frame->numbers, state->v, frame->a);
    return isfinite(scale) ? fmin(scale, frame->numbers->size / frame->numbers->speed) : scale;
}

/* The gap of a contact a little later or earlier on a course of constant acceleration. */
static double gap_on_course(pm_workspace *w, const pm_event_function *f, double time)
{
    const double *a = accelerations(w->model, w->ida);
    pm_state_copy(&w->probe, &w->state);
    for (int i = 0; i < w->model->nq; i++) w->probe.q[i] += time * (w->state.v[i] + 0.5 * time * a[i]);
    return pm_event_value_at(w, f, &w->probe);
}

/* Time until a contact that is left now is back; the first step, which is of order 1, must show that. */
static double flight(pm_workspace *w, const pm_event_function *f)
{
    const double scale =
        pm_case_time_scale(w->model, &w->numbers, w->state.v, accelerations(w->model, w->ida));
    const double d = PM_IDA_RATE_TIME * fmin(scale, pm_case_max_time(w->model, &w->numbers));
    const double earlier = gap_on_course(w, f, -d), now = gap_on_course(w, f, 0),
                 later = gap_on_course(w, f, d);
    const double rate = (later - earlier) / (2 * d), second = (later - 2 * now + earlier) / (d * d);
    return rate > 0 && second < 0 ? 2 * rate / -second : INFINITY;
}

/* What is on its zero when the phase begins; returns the time until the first of the contacts that are left now is back. */
static double begin_functions(pm_workspace *w)
{
    double back = INFINITY;
    pm_event_hold_on_zero(w);
    for (int i = 0; i < w->event->nfunction; i++) {
        pm_event_function *f = &w->event->function[i];
        if (f->kind == FUNCTION_GAP && f->held) back = fmin(back, flight(w, f));
    }
    return back;
}

static int begin(pm_workspace *w)
{
    pm_ida *r = w->ida;
    r->status = PM_OK;
    r->jacobian.known = 0;
    r->jacobian.fresh = 1;
    r->jacobian.independence = 1;
    pm_ida_system_layout(w);
    int status = pm_ida_system_start(w, N_VGetArrayPointer(r->y), N_VGetArrayPointer(r->yp));
    if (status) return status;
    pm_ida_system_scale(w);
    double first = PM_IDA_FIRST_STEP * sqrt(r->tolerance) * time_to_begin_with(&w->frame, &w->state);
    w->step.nodes = w->phase.route->nodes;
    int flag = IDAReInit(r->memory, w->state.t, r->y, r->yp);
    if (flag == IDA_SUCCESS) flag = limit_step(w);
    if (flag != IDA_SUCCESS) return failed(&w->result, flag);
    first = fmin(first, fmax(PM_IDA_SHORTEST * first, PM_IDA_FLIGHT * begin_functions(w)));
    flag = IDASetInitStep(r->memory, isfinite(first) ? first : 0); /* 0: as IDA thinks fit */
    pm_ida_clock_begin(r, w->state.t, pm_time_course_is_any(w) || pm_model_is_driven(w->model));
    r->first = r->last = w->state.t;
    return flag == IDA_SUCCESS ? PM_OK : failed(&w->result, flag);
}

/* y and y' inside the last step, beyond its begin on the tangent there. */
static int look_up(pm_workspace *w, double t, double *y)
{
    pm_ida *r = w->ida;
    const double inside = fmax(t, r->first);
    const int n = 2 * w->model->nq + w->model->nz;
    const double *value = N_VGetArrayPointer(r->dense);
    const double shown = pm_ida_clock_at(r, inside);
    int flag = IDAGetDky(r->memory, shown, 0, r->dense);
    memcpy(y, value, (size_t)n * sizeof *y);
    if (flag == IDA_SUCCESS && t < inside) {
        flag = IDAGetDky(r->memory, shown, 1, r->dense);
        for (int i = 0; i < n; i++) y[i] += (t - inside) * value[i];
    }
    return flag == IDA_SUCCESS ? PM_OK : failed(&w->result, flag);
}

static int at(pm_workspace *w, double t, pm_state *s)
{
    s->t = t;
    return look_up(w, t, s->q); /* q, v, z lie together */
}

static int exact(pm_workspace *w, double t, pm_state *s)
{
    if (s != &w->state) pm_state_copy(s, &w->state);
    const int status = at(w, t, s);
    return status ? status : pm_ida_linear_project(w, s);
}

static int too_small(pm_result *result, double length, double bound)
{
    return pm_fail(result, PM_STEP_TOO_SMALL, PM_NONE, PM_NONE, length, bound);
}

/* The state to which IDA has come, and so much later: the time is rounded. */
static void take_end(pm_workspace *w, double later)
{
    const double *y = N_VGetArrayPointer(w->ida->y), *yp = N_VGetArrayPointer(w->ida->yp);
    const int n = 2 * w->model->nq + w->model->nz;
    for (int i = 0; i < n; i++) w->state.q[i] = y[i] + later * yp[i]; /* q, v, z lie together */
}

/* One step of IDA, up to t_limit at the most.  Returns a status; *end: the time that it has come to. */
static int solve(pm_workspace *w, double t_limit, double *end)
{
    pm_ida *r = w->ida;
    const double least = PM_IDA_LEAST_STEP * fabs(w->state.t), stop = pm_ida_clock_at(r, t_limit);
    double shown, length;
    r->status = PM_OK;
    int flag = IDASetStopTime(r->memory, stop);
    if (flag == IDA_SUCCESS) flag = IDASolve(r->memory, stop, &shown, r->y, r->yp, IDA_ONE_STEP);
    const int status = status_of(&w->result, w->ida, flag);
    if (status) return status;
    if ((flag = pm_ida_clock_follow(r)) || (flag = IDAGetLastStep(r->memory, &length)))
        return failed(&w->result, flag);
    if (!(length > least)) return too_small(&w->result, length, least); /* IDA itself would go on for ever */
    r->last = r->clock.now - r->clock.ahead;
    r->first = r->last - length;
    *end = shown >= stop ? t_limit : fmin(r->last, t_limit);
    take_end(w, pm_ida_clock_until(r, shown, *end));
    return PM_OK;
}

static int one_step(pm_workspace *w, double t_limit)
{
    double end = w->state.t;
    int flag;
    const double room = t_limit - w->state.t;
    if (!(room > PM_IDA_LEAST_ROOM * fabs(t_limit)))
        return too_small(&w->result, room, PM_IDA_LEAST_ROOM * fabs(t_limit));
    if (room < PM_IDA_SHORT_ROOM * fabs(t_limit))
        IDASetInitStep(w->ida->memory, room); /* all of it at once */
    int status = solve(w, t_limit, &end);
    if (status) return status;
    if (w->ask->nobserver > 0) w->step.nodes = &pm_chebyshev_nodes_equal;
    pm_step_set(&w->step, w->state.t, end);
    w->state.t = end;
    status = pm_ida_linear_project(w, &w->state);
    w->result.count[PM_COUNT_STEPS]++;
    if (!status && pm_case_speed(w->model, &w->numbers, w->state.v)) pm_ida_system_scale(w);
    if (!status && (flag = limit_step(w))) status = failed(&w->result, flag);
    return status;
}

/* How far off a singular position is: at the last matrix; in long chains, where one step may lead over it to another branch,
 * where the step has come to, too. */
static double independence(pm_workspace *w, int status)
{
    const pm_ida_jacobian *j = &w->ida->jacobian;
    if (!j->sparse || status) return j->independence;
    return fmin(j->independence, pm_saddle_independence_there(w, &w->state));
}

/* Whatever goes wrong near a singular position, a new matrix has been made there. */
static int step(pm_workspace *w, double t_limit)
{
    const int status = one_step(w, t_limit), lost = w->ida->jacobian.sparse && status;
    w->phase.lap = w->phase.singular =
        !w->active.asymmetric && independence(w, status) < (lost ? PM_IDA_LOST : PM_IDA_NEAR_SINGULAR);
    return status;
}

/* It divides by masses. */
static int applies(const pm_workspace *w) { return !w->numbers.massless; }

const pm_route_ops pm_route_ida = {
    .route = PM_ROUTE_IDA,
    .create = create,
    .applies = applies,
    .begin = begin,
    .step = step,
    .at = at,
    .exact = exact,
    .finest = PM_IDA_FINEST,
    .steps_by_tolerance = PM_IDA_POWER / (ORDER + 1),
    .spread = 30, /* its order changes on the way; 20 tells more errors too small, 60 needlessly much */
    .sees_ends = 1,
    .in_time = 1,
    .when_lost = PM_LOST_TO_PASSAGE,
    .price = 4,
    .nodes = &pm_chebyshev_nodes_halves, /* steps are short beside the motion's own time */
};
