/* path_error_time.c - errors along paths at a given time.
 *
 * At a place the time t is off by dt, and T by dT.  So at a given time the motion is late by dt: an answer f(place, T, t) of
 * then is known to
 *
 *   |df/dT| dT + |df/dt| dt'      d/dt along the motion, t itself kept;   dt' = dt + tau (sqrt(1 + dT/T) - 1)
 *
 * tau = 2T / |dT/dt|, the time to where it would rest, or that since the step began if this is less: in steps that begin or
 * end at rest dt is the error of the times of rest, whose place dT moves by dT / F.  Next to there both terms are large, and
 * cancel: T at a place is off because the place of rest is.  At the same distance from it T is not, so that in these steps
 *
 *   |df/du| dT / |F| + |df/dt| dt    d/du along the path, T kept
 *
 * holds, too, with what rounds T at the one place, and the lesser of both is the error.  All are differences to a state of the
 * step beside.  Where the motion turns back, and no time sets the instant, the place itself is off by dT / |F|.  Functions that
 * have not fired by then are as far off as that makes them; those of the time alone are, at places that are met exactly. */
#include "routes/path/path.h"

#include <math.h>
#include <string.h>

#include "elements/joint_friction.h"
#include "elements/trigger.h"
#include "equations/saddle.h"
#include "equations/solve_cache.h"
#include "expression/program.h"
#include "expression/program_class.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/route.h"

int pm_path_aside_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_path_aside *x = &w->path->aside;
    const pm_array array[] = {
        PM_ARRAY(x->y, m->nq),
        PM_ARRAY(x->own.pose, 5 * (m->nbody + 1)),
        PM_ARRAY(x->own.velocity, 3 * (m->nbody + 1)),
        PM_ARRAY(x->own.f, m->nq),
        PM_ARRAY(x->own.power, m->rows[PM_TABLE_FORCE]),
        PM_ARRAY(x->own.a, m->nq),
        PM_ARRAY(x->own.lambda, m->nconstraint),
    };
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    return status ? status : pm_state_create(&w->memory, m, &x->state);
}

/* ---- what the time has set ---- */
static int may_be_due(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++)
        if (pm_trigger_on_time(m, i)) return 1;
    return 0;
}

/* An extreme may be where the time ends the run; where it is inside, the motion beside is none of it.  A phase that has ended, and
 * not at rest, has done so at a place. */
int pm_path_aside_is_timed(const pm_workspace *w, int ask)
{
    const int32_t *row = PM_ASK_ROW(w->model, ask);
    if (row[PM_ASK_KIND] == PM_ASK_GRID)
        return w->model->programs.class[row[PM_ASK_PROGRAM_2]] == PM_CLASS_TIME;
    if (pm_model_ask_is_extreme(row)) return !(w->path->ended > 0) && may_be_due(w->model);
    return pm_trigger_time_is_due(w);
}

/* ---- the state beside ---- */
/* Where in the step the frame looks; NaN: elsewhere. */
static double place_in_step(pm_workspace *w)
{
    pm_path *p = w->path;
    pm_tree_read(w->tree, &w->frame, p->aside.y);
    const double x = p->sense * (p->aside.y[p->driver] - p->u0),
                 off = PM_ERROR_ASIDE_OFF * (p->h + fabs(p->u0));
    return x > -off && x < p->h + off ? fmin(fmax(x, 0), p->h) : NAN;
}

/* The place beside x: away from where the motion rests, else back. */
static double beside(const pm_path *p, double x)
{
    const double left = p->clock.kind == PM_CLOCK_LEAVES  ? x
                        : p->clock.kind == PM_CLOCK_RESTS ? p->h - x
                                                          : p->h;
    const double by =
        fmax(PM_ERROR_ASIDE * left, PM_ERROR_ASIDE_LEAST * p->h + PM_ERROR_ASIDE_PLACE * fabs(p->u0));
    const int forth = p->clock.kind == PM_CLOCK_LEAVES ? x + by <= p->h : x < by;
    return forth ? x + by : x - by;
}

/* Its arrays are others, its bodies stand where they stood. */
static void swap_frame(pm_workspace *w)
{
    const pm_frame *own = &w->path->aside.own;
    pm_frame *const f = &w->frame;
    const size_t n = (size_t)w->model->nbody + 1;
    w->path->aside.kept = *f;
    memcpy(own->pose, f->pose, 5 * n * sizeof *own->pose);
    memcpy(own->velocity, f->velocity, 3 * n * sizeof *own->velocity);
    f->pose = own->pose;
    f->velocity = own->velocity;
    f->f = own->f;
    f->power = own->power;
    f->a = own->a;
    f->lambda = own->lambda;
    w->cache->closed = 1;
}

void pm_path_aside_back(pm_workspace *w)
{
    w->frame = w->path->aside.kept;
    w->cache->closed = 0;
    pm_tree_marks(w->tree, &w->frame);
    if (w->path->aside.own.level == PM_LEVEL_DYNAMIC) pm_saddle_evaluate(&w->active, &w->frame);
}

/* From the state that is looked at to the one beside. */
typedef struct pm_path_beside {
    double way;           /* of the driver */
    double dt;            /* s */
    double before, after; /* J, T here and there */
    double late;          /* s, dt' - dt */
} pm_path_beside;

/* By how much more the time of the place is off than the clock, given how the time goes there. */
static double late_by(const pm_path *p, double t, const pm_path_beside *x)
{
    if (p->clock.kind == PM_CLOCK_PLAIN || !(x->before > 0))
        return 0; /* where it rests it does, whatever T is elsewhere */
    const double to_rest = 2 * x->before * x->dt / fabs(x->after - x->before);
    return fmin(to_rest, fabs(t - p->clock.t0)) * (sqrt(1 + p->error / x->before) - 1);
}

/* The frame looks at the place `there` of the step, at its own time; 0: it stays where it is. */
static int look_at(pm_workspace *w, double there)
{
    pm_state *s = &w->path->aside.state;
    const double t = w->frame.t;
    swap_frame(w);
    w->path->aside.own.level = PM_LEVEL_KINEMATIC;
    if (pm_route_path.at(w, there, s)) {
        pm_path_aside_back(w);
        return 0;
    }
    pm_frame_look(&w->frame, t, s->q, s->v, s->z, w->state.memory);
    return 1;
}

/* The frame looks beside, at its own time; 0: it stays where it is. */
static int look_beside(pm_workspace *w, pm_path_beside *x)
{
    pm_path *p = w->path;
    const double t = w->frame.t, here = place_in_step(w), there = beside(p, here);
    if (isnan(here) || p->clock.kind == PM_CLOCK_NONE) return 0;
    x->before = p->ended > 0 ? p->ended : pm_frame_kinetic(&w->frame, PM_NONE); /* before a blow */
    x->way = fabs(there - here);
    x->dt = fabs(pm_path_clock_between(p, here / p->h, there / p->h));
    if (!(x->dt > 0) || !look_at(w, there)) return 0;
    x->after = pm_frame_kinetic(&w->frame, PM_NONE);
    x->late = late_by(p, t, x);
    return 1;
}

/* Inside a step nothing has jumped. */
static int accelerate(pm_workspace *w)
{
    w->path->aside.own.level = PM_LEVEL_DYNAMIC;
    return pm_joint_friction_by_load(&w->frame, &w->state) ? PM_SINGULAR : pm_path_react(w);
}

/* ---- errors ---- */
double pm_path_aside_clock(pm_workspace *w)
{
    pm_path_beside x;
    if (!look_beside(w, &x)) return w->path->clock.error;
    pm_path_aside_back(w);
    return w->path->clock.error + x.late;
}

/* The value of the program where the frame looks, with all velocities times `faster`. */
static double value_at(pm_workspace *w, int program, double faster)
{
    for (int i = 0; i < w->model->nq; i++) w->frame.velocity[i] = faster * w->frame.v[i];
    if (w->model->programs.level[program] == PM_LEVEL_DYNAMIC && accelerate(w)) return NAN;
    return pm_program_run(w, program);
}

/* The clock's error is what the steps allow if all err to one side.  What the nodes leave out, and what rounds T, is of either
 * side: many steps leave a part of the sum. */
static double likely_error(const pm_workspace *w)
{
    const pm_clock *c = &w->path->clock;
    const double few = 1 / (double)w->result.count[PM_COUNT_STEPS];
    return pm_path_error_unresolved(c) + pm_max(PM_ERROR_LIKELY, few) * (c->error - c->unresolved);
}

/* J: T at the place that the frame looked at is rounded by itself, as the energies that make it and the place. */
static double rounded_kinetic(const pm_path *p, const pm_path_beside *x)
{
    const double of_place = fabs(x->after - x->before) / x->way * (fabs(p->u0) + p->h);
    return PM_ERROR_ENERGY_ROUNDINGS * (fabs(p->energy) + fabs(p->energy - x->before) + of_place);
}

/* How far the frame is in the time from where the program, of the time alone, has this value, s. */
static double off_from(pm_workspace *w, int program, double wanted)
{
    const double here = pm_program_run(w, program);
    return fabs((here - wanted) / pm_trigger_time_slope(w, program, here));
}

/* How far it is from the time that it stands for, s. */
static double off_by(pm_workspace *w, int ask, int column)
{
    const pm_model *m = w->model;
    const int32_t *row = PM_ASK_ROW(m, ask);
    double off = 0;
    if (row[PM_ASK_KIND] == PM_ASK_GRID)
        return off_from(w, row[PM_ASK_PROGRAM_2],
                        w->numbers.value[row[PM_ASK_FIRST_VALUE] + column - row[PM_ASK_OUT]]);
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++)
        if (w->firing.fired[i] && pm_trigger_on_time(m, i))
            off = pm_max(off_from(w, PM_TRIGGER_ROW(m, i)[PM_TRIGGER_PROGRAM], 0), off);
    return off;
}

/* What the time dt makes of a value next to rest, that changes by `all` to the state beside, by `along` of it with the place alone:
 * the speed goes as the time, the place as speed dt + acceleration dt^2 / 2. */
static double by_time(const pm_path_beside *x, double all, double along, double dt)
{
    const double s = sqrt(x->before / x->after), r = dt / x->dt;
    return fabs(along * (2 * s * r + fabs(1 - s) * r * r) / (1 + s) + (all - along) * r);
}

/* In a step that begins or ends at rest; dt: the error of the time, s. */
static double error_near_rest(pm_workspace *w, int program, double value, double by_kinetic,
                              const pm_path_beside *x, double all, double dt)
{
    const pm_path *p = w->path;
    const double along = value_at(w, program, sqrt(x->before / x->after)) - value,
                 by_place = fabs(along) * p->error / fabs(x->after - x->before),
                 by_rounding = x->before > 0 ? by_kinetic * fmin(rounded_kinetic(p, x) / p->error, 1) : 0;
    return fmin(by_kinetic + by_time(x, all, along, dt + x->late),
                by_place + by_rounding + by_time(x, all, along, dt));
}

double pm_path_aside_turn(pm_workspace *w, int program, double value)
{
    const pm_path *p = w->path;
    const double there = beside(p, p->h), stops = fabs(p->node[PM_NODES_MOST - 1].force);
    if (!w->step.reverses || pm_frame_kinetic(&w->frame, PM_NONE) > 0 || !look_at(w, there)) return 0;
    const double along = value_at(w, program, 0) - value;
    pm_path_aside_back(w);
    return fabs(along) / (p->h - there) * p->error / stops;
}

double pm_path_aside_error(pm_workspace *w, int ask, int column, double value, double by_kinetic)
{
    const int program = PM_ASK_ROW(w->model, ask)[PM_ASK_PROGRAM];
    pm_path_beside x;
    if (w->model->programs.energy[program] == PM_ENERGY_CLASS_UNKNOWN || !look_beside(w, &x)) return NAN;
    const double dt = likely_error(w) + PM_ERROR_TIME_ROUNDINGS * fabs(w->frame.t) + off_by(w, ask, column);
    const double all = value_at(w, program, 1) - value;
    const double error = w->path->clock.kind != PM_CLOCK_PLAIN && x.after > 0
                             ? error_near_rest(w, program, value, by_kinetic, &x, all, dt)
                             : by_kinetic + fabs(all) / x.dt * (dt + x.late);
    pm_path_aside_back(w);
    return error;
}

/* A decision whose error is not known leaves all open; as do those that the log has no room for. */
static double is_unsure(pm_workspace *w)
{
    w->evidence.present->unsure = 1;
    return 0;
}

double pm_path_aside_look(pm_workspace *w, int level, int on_time)
{
    pm_path_beside x;
    if (!w->evidence.active || !w->evidence.by_places || pm_trigger_time_is_due(w) == on_time) return 0;
    if (w->result.count[PM_COUNT_STEPS] == 0) return 0; /* the start is at its time */
    if (w->evidence.present->log.stride > 1 || !look_beside(w, &x)) return is_unsure(w);
    if (on_time) w->frame.t += x.dt;
    if (level == PM_LEVEL_DYNAMIC && accelerate(w)) {
        pm_path_aside_back(w);
        return is_unsure(w);
    }
    return (w->path->clock.error + x.late + PM_ERROR_TIME_ROUNDINGS * fabs(w->frame.t)) / x.dt;
}
