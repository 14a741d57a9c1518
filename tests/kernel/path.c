/* The path route agrees with rk and ida on scenes of many kinds, and its evidence tells what it does not know. */
#include "routes/path/path.h"

#include "check.h"
#include "elements/constraint.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "path_scenes.h"
#include "scene.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

enum { ANSWERS = 10 };

/* Several swings; extremes of speed and force, marks on angle and speed on the way. */
static scene *swings(void)
{
    scene *s = scene_create();
    const int b = pendulum_rod(s, -0.3), angle = scene_measure(s, PM_MEASURE_ANGLE, b),
              omega = omega_of(s, b);
    const int low = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, angle, -1.5)),
              turns = scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega)),
              fast = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, omega, 2));
    scene_until(s, low, 7);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, omega);
    scene_ask_count(s, turns);
    scene_ask_count(s, fast);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_TIME, turns));
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, omega), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, angle), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, angle), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_NORM)),
                      PM_NONE);
    scene_ask_extreme(s, PM_ASK_AT_MIN, scene_read(s, angle), scene_read(s, omega));
    return s;
}

/* A rod slides down between a wall and a floor, held on both: an ellipse trammel. */
static scene *trammel(void)
{
    scene *s = scene_create();
    const double a = 1.1;
    const int b = scene_body(s, 3, 0.25, 0.5 * cos(a), 0.5 * sin(a), PI - a);
    const int top = scene_point(s, b, 0.5, 0), foot = scene_point(s, b, -0.5, 0);
    scene_joint(s, PM_JOINT_SLIDER, top, scene_line(s, ground(s, 0, 0), -0.5 * PI), 0);
    scene_joint(s, PM_JOINT_SLIDER, foot, scene_floor(s, 0), 0);
    const int y = part(s, top, PM_PART_Y), omega = omega_of(s, b);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, y, 0.5)), 1);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, omega);
    scene_ask_measure(s, part(s, foot, PM_PART_X));
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, y), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, omega), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_NORM)),
                      PM_NONE);
    return s;
}

/* A slider-crank that turns fully three times and passes its dead centres. */
static scene *slider_crank(void)
{
    scene *s = scene_create();
    const double r = 0.15, l = 0.5, a = 0.7, d = -asin(r / l * sin(a));
    const int crank = scene_body(s, 2, 0.02, 0, 0, a),
              rod = scene_body(s, 1.5, 0.04, r * cos(a) + 0.5 * l * cos(d), 0.5 * r * sin(a), d),
              piston = scene_body(s, 0.8, 0, r * cos(a) + l * cos(d), 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, crank, 0, 0), ground(s, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5 * l, 0), scene_point(s, crank, r, 0), 0);
    const int pin = scene_point(s, piston, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, 0.5 * l, 0), pin, 0);
    scene_joint(s, PM_JOINT_SLIDER, pin, scene_floor(s, 0), 0);
    scene_start_omega(s, crank, 9);
    const int x = part(s, pin, PM_PART_X), turned = scene_measure(s, PM_MEASURE_TURNED, crank);
    const int dead =
        scene_when(s, PM_TRIGGER_CROSS, scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, pin, PM_PART_X)));
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, 20)), 1);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, omega_of(s, crank));
    scene_ask_measure(s, x);
    scene_ask_count(s, dead);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, x), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, omega_of(s, crank)), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_NORM)),
                      PM_NONE);
    return s;
}

/* A hoop with a mass on its rim side rolls down a slope, rocking: it turns over, speeds up. */
static scene *hoop(void)
{
    scene *s = scene_create();
    const double r = 0.3, slope = -0.08;
    const int b = scene_body(s, 3, 0.15, -sin(slope) * r, cos(slope) * r, 0.4);
    const int rim = scene_point(s, b, -0.1, 0.05);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, rim, r), scene_floor(s, slope), 0);
    scene_start_omega(s, b, -9);
    const int x = part(s, rim, PM_PART_X);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, x, 6)), 1);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, omega_of(s, b));
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, omega_of(s, b)), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, scene_measure(s, PM_MEASURE_JOINT_NORMAL, 0)), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_measure(s, PM_MEASURE_JOINT_FRICTION_NEEDED, 0)),
                      PM_NONE);
    return s;
}

/* Springs: one that stretches, one that twists, both beyond their free lengths at the turning points. */
static scene *springs(void)
{
    scene *s = scene_create();
    const int b = pendulum_rod(s, 0.2);
    scene_force(s, PM_FORCE_SPRING, scene_point(s, b, 0.3, 0.1), ground(s, 0.1, 0.9), 60, 0.4);
    scene_force(s, PM_FORCE_TORSION, b, PM_GROUND, 4, -0.5);
    scene_start_omega(s, b, 3);
    const int omega = omega_of(s, b);
    const int turn = scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega));
    scene_until(s, turn, 5);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, b));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, 0));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, 1));
    scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_FORCE_ENERGY, 0)), turn, 2, 0);
    scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_ALPHA, b)), turn, 3, 0);
    return s;
}

/* A force that follows the body and a couple, both functions of the place: work without a potential. */
static scene *driven(void)
{
    scene *s = scene_create();
    const int b = pendulum_rod(s, -1.2), tip = scene_point(s, b, 0.5, 0);
    const int angle = scene_measure(s, PM_MEASURE_ANGLE, b);
    scene_applied(s, tip, b, SCENE_PROGRAM(s, scene_k(s, 3)),
                  SCENE_PROGRAM(s, scene_k(s, 6), scene_m(part(s, tip, PM_PART_X)), scene_op(PM_OP_MUL)));
    scene_couple(s, b, PM_GROUND, SCENE_PROGRAM(s, scene_m(angle), scene_op(PM_OP_SIN)));
    const int turn = scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega_of(s, b)));
    scene_until(s, turn, 4);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, angle);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, 0));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, 1));
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_measure(s, PM_MEASURE_FORCE_POWER, 0)), PM_NONE);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_PATH, tip));
    return s;
}

/* Marks at multiples of the angle, forwards and back: those at a turn count once. */
static scene *multiples(void)
{
    scene *s = scene_create();
    const int b = pendulum_rod(s, -0.55), angle = scene_measure(s, PM_MEASURE_ANGLE, b);
    const int every = scene_when(s, PM_TRIGGER_EVERY,
                                 SCENE_PROGRAM(s, scene_m(angle), scene_k(s, 0.2), scene_op(PM_OP_DIV)));
    scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega_of(s, b))), 4);
    scene_ask(s, PM_ASK_EACH, scene_read(s, scene_time(s)), every, 1, 0, PM_NONE, PM_NONE, 3);
    scene_ask_count(s, every);
    scene_ask_event(s, scene_read(s, angle), every, 13, 0);
    scene_ask_event(s, scene_read(s, omega_of(s, b)), every, 14, 0);
    return s;
}

/* A sphere over a row of bars that it just passes: blows, and the speeds after them. */
static scene *bars(void)
{
    scene *s = scene_create();
    const double r = 0.1, d = 0.04, lean = asin(0.5 * d / r);
    const int b = scene_body(s, 1, 0.4 * r * r, -0.5 * d, r * cos(lean), 0);
    const int row = SCENE_ROW(s, PM_TABLE_PATTERN, ground(s, -d, 0), scene_value(s, d), scene_value(s, 0),
                              scene_value(s, -1));
    const int g = scene_point(s, b, 0, 0);
    const int c =
        scene_contact(s, PM_CONTACT_PATTERN, scene_circle(s, g, r), row, 0, 0, PM_FRICTION_ROUGH, 0);
    scene_start_omega(s, b, -5.5);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, c);
    scene_until(s, strike, 9);
    scene_ask(s, PM_ASK_EACH, scene_read(s, omega_of(s, b)), strike, 1, 0, PM_NONE, PM_NONE, 5);
    scene_ask_measure(s, scene_time(s));
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, omega_of(s, b)), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, c)), PM_NONE);
    scene_ask_measure(s, part(s, g, PM_PART_X));
    return s;
}

/* A particle on a smooth circle, then off it: two phases, the second of two degrees of freedom. */
static scene *lifts(void)
{
    scene *s = scene_create();
    const double a = 0.1;
    const int p = scene_point(s, scene_body(s, 1, 0, sin(a), cos(a), 0), 0, 0), y = part(s, p, PM_PART_Y);
    const int c = scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, p, 0),
                                scene_circle(s, ground(s, 0, 0), 1), 1, 0, PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, p, 0.5 * cos(a), -0.5 * sin(a));
    const int opens = scene_on(s, PM_TRIGGER_OPEN, c);
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_read(s, y)), 1);
    scene_ask_event(s, scene_read(s, y), opens, 1, 0);
    scene_ask_event(s, scene_read(s, scene_time(s)), opens, 1, 0);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, part(s, p, PM_PART_X));
    return s;
}

/* A disk rolls off a round edge: its grip gives way before it lifts. */
static scene *slips(void)
{
    scene *s = scene_create();
    const double r = 0.2, a = 0.1;
    const int b = scene_body(s, 1, 0.5 * r * r, (1 + r) * sin(a), (1 + r) * cos(a), 0),
              g = scene_point(s, b, 0, 0);
    const int c = scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, g, r),
                                scene_circle(s, ground(s, 0, 0), 1), 1, 0, PM_FRICTION_COULOMB, 0.4);
    const int slip = scene_on(s, PM_TRIGGER_SLIP, c), opens = scene_on(s, PM_TRIGGER_OPEN, c);
    scene_until(s, opens, 1);
    scene_ask_event(s, scene_read(s, part(s, g, PM_PART_Y)), slip, 1, 0);
    scene_ask_event(s, scene_read(s, scene_time(s)), slip, 1, 0);
    scene_ask_event(s, scene_read(s, omega_of(s, b)), slip, 1, 0);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, omega_of(s, b));
    return s;
}

typedef scene *maker(void);
typedef struct sample {
    const char *name;
    maker *make;
    int leaves; /* some phase has more than one degree of freedom, or friction that slides */
} sample;
static const sample samples[] = {
    {"swings", swings, 0},   {"trammel", trammel, 0}, {"slider-crank", slider_crank, 0}, {"hoop", hoop, 0},
    {"springs", springs, 0}, {"driven", driven, 0},   {"multiples", multiples, 0},       {"bars", bars, 0},
    {"lifts", lifts, 1},     {"slips", slips, 1},
};
enum { SAMPLES = sizeof samples / sizeof *samples };

static int run(maker *make, int route, double accuracy, double out[ANSWERS])
{
    scene *s = make();
    scene_route(s, route, accuracy);
    EQUAL(scene_run(s, NULL), PM_OK);
    const int n = s->nout < ANSWERS ? s->nout : ANSWERS;
    for (int i = 0; i < n; i++) {
        out[i] = s->out[i];
        CHECK(!isnan(out[i]));
    }
    if (route == PM_ROUTE_PATH || route == PM_ROUTE_AUTO) {
        CHECK(used(s, PM_ROUTE_PATH));
        CHECK(s->audit[PM_AUDIT_ENERGY] <= (route == PM_ROUTE_PATH ? 2e-13 : 1e-9));
    }
    scene_free(s);
    return n;
}

static void routes_agree(void)
{
    for (int i = 0; i < SAMPLES; i++) {
        double path[ANSWERS], rk[ANSWERS], ida[ANSWERS];
        const int before = check_count;
        const int n = run(samples[i].make, samples[i].leaves ? PM_ROUTE_AUTO : PM_ROUTE_PATH, 1e-12, path);
        run(samples[i].make, PM_ROUTE_RK, 1e-13, rk);
        run(samples[i].make, PM_ROUTE_IDA, 1e-9, ida);
        for (int k = 0; k < n; k++) {
            const double size = 1 + fabs(rk[k]);
            NEAR(path[k], rk[k], 2e-10 * size);
            NEAR(ida[k], rk[k], 2e-4 * size);
            if (check_count > before) fprintf(stderr, "in %s, answer %d\n", samples[i].name, k);
            if (check_count > before) break;
        }
    }
}

/* Accelerations and reactions by the one freedom, and by the saddle point; pins around a loop too. */
static void accelerations(void)
{
    for (int i = 0; i < SAMPLES; i++) {
        scene *s = samples[i].make();
        pm_workspace *w;
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
        if (!CHECK(scene_begin(s) == PM_OK)) continue;
        w = s->w;
        for (int k = 0; k < w->model->nq; k++)
            w->state.v[k] = w->numbers.inverse_mass[k] > 0 ? check_random(-2, 2) : 0;
        pm_frame_look_state(&w->frame, &w->state);
        pm_saddle_evaluate(&w->active, &w->frame);
        EQUAL(pm_projection_velocity(w, &w->state), PM_OK);
        pm_frame_look_state(&w->frame, &w->state);
        if (samples[i].leaves || !CHECK(pm_route_prepare(w, &pm_route_path))) {
            scene_free(s);
            continue;
        }
        pm_frame_look_state(&w->frame, &w->state);
        EQUAL(pm_saddle_accelerate(w), PM_OK);
        const size_t a_bytes = (size_t)w->model->nq * sizeof(double),
                     l_bytes = (size_t)w->active.n * sizeof(double);
        double a[3 * 8], lambda[3 * 8], size = 1;
        CHECK(a_bytes <= sizeof a && l_bytes <= sizeof lambda);
        memcpy(a, w->frame.a, a_bytes);
        memcpy(lambda, w->frame.lambda, l_bytes);
        for (int k = 0; k < w->active.n; k++) size = fmax(size, fabs(lambda[k]));
        memset(w->frame.a, 0, a_bytes);
        pm_frame_look_state(&w->frame, &w->state);
        EQUAL(pm_path_accelerate(w, w->state.v), PM_OK);
        EQUAL(w->frame.level, PM_LEVEL_DYNAMIC);
        for (int k = 0; k < w->model->nq; k++) NEAR(w->frame.a[k], a[k], 1e-12 * size / 0.05);
        for (int k = 0; k < w->active.n; k++) NEAR(w->frame.lambda[k], lambda[k], 1e-12 * size);
        scene_free(s);
    }
}

/* The evidence of one step: `shift` moves the mark of a row, `more` is added to the weight, after the phase has begun. */
static double evidence(maker *make, double shift, double more)
{
    scene *s = make();
    double out = NAN;
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    if (CHECK(scene_begin(s) == PM_OK)) {
        pm_workspace *w = s->w;
        w->state.v[2] = 2;
        pm_frame_look_state(&w->frame, &w->state);
        pm_saddle_evaluate(&w->active, &w->frame);
        EQUAL(pm_projection_velocity(w, &w->state), PM_OK);
        pm_frame_look_state(&w->frame, &w->state);
        CHECK(pm_route_prepare(w, &pm_route_path));
        EQUAL(pm_route_path.begin(w), PM_OK);
        w->active.constraint[1].a[0] += shift;
        w->numbers.gravity[1] *= 1 + more;
        w->ledger.evidence = 0;
        EQUAL(pm_route_path.step(w, INFINITY), PM_OK);
        out = w->ledger.evidence;
    }
    scene_free(s);
    return out;
}

/* It tells rows that the direction of the motion breaks, and forces that the path does not know. */
static void tells_on_itself(void)
{
    CHECK(evidence(swings, 0, 0) < 1e-13);
    CHECK(evidence(swings, 1e-4, 0) > 1e-6);
    CHECK(evidence(swings, 0, 1e-4) > 1e-6);
    CHECK(evidence(slider_crank, 0, 0) < 1e-12);
}

/* A force that vanishes on the way: the least of its norm is zero, at a corner. */
static void corner(void)
{
    for (int route = 0; route < 2; route++) {
        scene *s = trammel();
        *scene_setting(s, PM_SETTING_ROUTE) = route ? PM_ROUTE_RK : PM_ROUTE_PATH;
        const int least = scene_ask_extreme(
            s, PM_ASK_MIN, scene_read(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_NORM)), PM_NONE);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[least], 0, route ? 1e-5 : 1e-11);
        scene_free(s);
    }
}

int main(void)
{
    accelerations();
    tells_on_itself();
    routes_agree();
    corner();
    return check_failures();
}
