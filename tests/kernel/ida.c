/* The ida route: its Newton matrix against differences of its residual; motions against the rk route and
 * closed forms; stiff forces; roots that change no sign between steps; failures that come back as numbers;
 * the same bits always. */
#include "routes/ida/ida.h"
#include "check.h"
#include "scene.h"
#include "state/route.h"
#include "state/workspace.h"

#define G 9.81
#define MOST 256 /* unknowns */
#define MANY_BARS 40
#define LINKS 9 /* a chain that makes their system a sparse one */

static scene *with_ida(double accuracy)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_IDA;
    scene_set(s, PM_SETTING_ACCURACY, accuracy);
    return s;
}

static int rod(scene *s, double mass, double length, double x, double y, double angle)
{
    return scene_body(s, mass, mass * length * length / 12, x, y, angle);
}

/* Two rods of 1 m and 1 kg in series, released from the horizontal. */
static void double_pendulum(scene *s, int out[3])
{
    const int a = rod(s, 1, 1, 0.5, 0, 0), b = rod(s, 1, 1, 1.5, 0, 0), tip = scene_point(s, b, 0.5, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, a, 0.5, 0), 0);
    out[0] = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, tip, PM_PART_X));
    out[1] = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, tip, PM_PART_Y));
    out[2] = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, a));
    scene_until_time(s, 5);
}

/* Links of 0.3 m on a pin above all else, with springs and dampers in their joints. */
static int chain(scene *s, int links)
{
    int last = PM_GROUND, hook = scene_point(s, PM_GROUND, 0.2, 3);
    for (int i = 0; i < links; i++) {
        const int link = rod(s, 0.4 + 0.1 * i, 0.3, 0.2 + 0.3 * i + 0.15, 3, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, link, -0.15, 0), hook, 0);
        scene_force(s, PM_FORCE_TORSION, link, last, 5, 0.1);
        scene_force(s, PM_FORCE_ROTARY_DAMPER, link, last, 0.05 * i, 0);
        hook = scene_point(s, link, 0.15, 0);
        last = link;
    }
    return last;
}

typedef struct crank_parts {
    int crank, rod, slider, crank_pin, slider_pin;
} crank_parts;

/* Crank 0.1 m, rod 0.3 m; 0.2, 0.2, 0.4 kg; from 45 degrees with 10 rad/s; the slider is a particle. */
static crank_parts slider_crank_of(scene *s)
{
    const double r = 0.1, l = 0.3, t = 0.78539816339744831, c = cos(t), d = sin(t), phi = -asin(r / l * d);
    const double x = r * c + l * cos(phi);
    crank_parts p;
    p.crank = rod(s, 0.2, r, r / 2 * c, r / 2 * d, t);
    p.rod = rod(s, 0.2, l, r * c + l / 2 * cos(phi), r / 2 * d, phi);
    p.slider = scene_body(s, 0.4, 0, x, 0, 0);
    p.crank_pin = scene_point(s, p.crank, r / 2, 0);
    p.slider_pin = scene_point(s, p.slider, 0, 0);
    scene_set(s, PM_SETTING_ASSEMBLY, 1e-9);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, p.crank, -r / 2, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, p.rod, -l / 2, 0), p.crank_pin, 0);
    scene_joint(s, PM_JOINT_PIN, p.slider_pin, scene_point(s, p.rod, l / 2, 0), 0);
    scene_joint(s, PM_JOINT_SLIDER, p.slider_pin, scene_floor(s, 0), 0);
    scene_start_omega(s, p.crank, 10);
    return p;
}

static void slider_crank(scene *s, int out[3])
{
    const crank_parts p = slider_crank_of(s);
    out[0] = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, p.crank));
    out[1] = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, p.rod));
    out[2] = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, p.slider_pin, PM_PART_X));
    scene_until_time(s, 3);
}

/* The end of the chain. */
static void long_chain(scene *s, int out[3])
{
    const int last = chain(s, LINKS), tip = scene_point(s, last, 0.15, 0);
    out[0] = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, tip, PM_PART_X));
    out[1] = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, tip, PM_PART_Y));
    out[2] = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, last));
    scene_until_time(s, 0.6);
}

/* ---- the Newton matrix ---- */
/* J x by central differences of F along (x, cj x) and solved again gives x. */
static void check_newton_matrix(scene *s, double cj, int sparse)
{
    double y[MOST] = {0}, yp[MOST] = {0}, x[MOST], moved[2][MOST], b[MOST];
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    pm_ida *r = w->ida;
    pm_ida_system_layout(w);
    CHECK(r->n <= MOST);
    EQUAL(r->jacobian.sparse, sparse);
    EQUAL(pm_ida_system_start(w, y, yp), PM_OK);
    pm_ida_jacobian_evaluate(w, w->state.t, cj, y, yp);
    EQUAL(pm_ida_linear_factor(w), PM_OK);
    const double step = 1e-5;
    for (int i = 0; i < r->n; i++) x[i] = check_random(-1, 1);
    for (int i = 2; i < 3 * s->rows[PM_TABLE_BODY]; i += 3)
        if (w->numbers.inverse_mass[i] == 0) x[i] = x[w->model->nq + i] = 0; /* held */
    for (int sign = 0; sign < 2; sign++) {
        double z[MOST], zp[MOST];
        for (int i = 0; i < r->n; i++) {
            z[i] = y[i] + (sign ? step : -step) * x[i];
            zp[i] = yp[i] + (sign ? step : -step) * cj * x[i];
        }
        pm_ida_system_residual(w, w->state.t, z, zp, moved[sign]);
    }
    for (int i = 0; i < r->n; i++) b[i] = (moved[1][i] - moved[0][i]) / (2 * step);
    pm_ida_linear_solve(w->model, w->ida, b, b);
    for (int i = 0; i < r->n; i++) NEAR(b[i], x[i], 2e-5);
}

static void newton_matrix(int links)
{
    scene *s = with_ida(1e-8);
    const crank_parts p = slider_crank_of(s);
    const int post = scene_point(s, PM_GROUND, 0.1, 0.5), time = scene_time(s);
    const int push = SCENE_PROGRAM(s, scene_m(scene_part(s, PM_MEASURE_VELOCITY, p.slider_pin, PM_PART_X)),
                                   scene_m(time), scene_op(PM_OP_ADD));
    scene_force(s, PM_FORCE_SPRING, p.slider_pin, post, 400, 0.3);
    scene_force(s, PM_FORCE_DAMPER, p.crank_pin, post, 30, 0);
    scene_force(s, PM_FORCE_TORSION, p.rod, p.crank, 7, 0.2);
    scene_force(s, PM_FORCE_ROTARY_DAMPER, p.crank, PM_GROUND, 0.4, 0);
    scene_applied(s, p.slider_pin, p.rod, push, push);
    chain(s, links);
    check_newton_matrix(s, 23.85, links > 0);
    check_newton_matrix(s, 2385, links > 0);
    scene_free(s);
}

/* A block on a floor, sliding on two corners with friction: the friction rides on the normal forces. */
static scene *sliding_block(double accuracy, double v)
{
    scene *s = with_ida(accuracy);
    const int b = scene_body(s, 1.5, 0.02, 0, 0.1, 0), floor = scene_floor(s, 0);
    for (int side = -1; side <= 1; side += 2) {
        const int corner = scene_circle(s, scene_point(s, b, 0.2 * side, -0.1), 0);
        scene_contact(s, PM_CONTACT_LINE, corner, floor, 0, 0, PM_FRICTION_COULOMB, 0.3);
    }
    scene_start_velocity(s, scene_point(s, b, 0, 0), v, 0);
    return s;
}

static void newton_matrix_with_friction(int links)
{
    scene *s = sliding_block(1e-8, 2);
    const int spring = scene_point(s, 0, 0.1, 0.05); /* positions must not be without forces */
    scene_force(s, PM_FORCE_DAMPER, spring, scene_point(s, PM_GROUND, 1, 1), 3, 0);
    chain(s, links);
    check_newton_matrix(s, 238.5, links > 0);
    CHECK(s->w->active.asymmetric);
    scene_free(s);
}

/* ---- motions ---- */
static void routes_agree(void (*make)(scene *, int *), const double bound[3])
{
    int out[3];
    scene *reference = scene_create();
    make(reference, out);
    scene_set(reference, PM_SETTING_ACCURACY, 1e-13);
    EQUAL(scene_run(reference, NULL), PM_OK);
    for (int i = 0; i < 3; i++) {
        const double accuracy[] = {1e-6, 1e-8, 1e-10};
        scene *s = with_ida(accuracy[i]);
        make(s, out);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->count[PM_COUNT_ROUTE], PM_ROUTE_IDA);
        for (int k = 0; k < 3; k++) NEAR(s->out[out[k]], reference->out[out[k]], bound[i]);
        CHECK(s->audit[PM_AUDIT_ENERGY] < 100 * accuracy[i]);
        CHECK(s->audit[PM_AUDIT_MOMENTUM] < 10 * accuracy[i]);
        scene_free(s);
    }
    scene_free(reference);
}

static void motions(void)
{
    routes_agree(double_pendulum, (double[]){4e-6, 4e-8, 1e-9});
    routes_agree(slider_crank, (double[]){5e-4, 5e-6, 1e-7});
    routes_agree(long_chain, (double[]){2e-8, 2e-10, 2e-11});
}

/* The block stops after v^2 / (2 mu g) and v / (mu g), and stays. */
static void friction_stops(void)
{
    scene *s = sliding_block(1e-8, 2);
    const int x =
        scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, scene_point(s, 0, 0, 0), PM_PART_X));
    const int t = scene_ask_measure(s, scene_time(s));
    scene_until(s, scene_on(s, PM_TRIGGER_REST, PM_NONE), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[x], 4 / (0.6 * G), 1e-9);
    NEAR(s->out[t], 2 / (0.3 * G), 1e-9);
    scene_free(s);
}

/* A disk rolls down 30 degrees: a = 2/3 g sin; 200 turns, and still on its anchor. */
static void rolls_far(double r, double accuracy)
{
    const double angle = -0.52359877559829887, way = 200 * 6.283185307179586 * r;
    scene *s = with_ida(accuracy);
    const int b = scene_body(s, 3, 3 * r * r / 2, -r * sin(angle), r * cos(angle), 0);
    const int centre = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, centre, r), scene_floor(s, angle), 0);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, b);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_MOVED, centre, PM_PART_X)),
              t = scene_ask_measure(s, scene_time(s));
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_minus(s, turned, -way / r)), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[x], way * cos(angle), 1e-8);
    NEAR(s->out[t], sqrt(3 * way / (G * sin(-angle))), 1e-8);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-11);
    scene_free(s);
}

/* A rod sinks against a very strong rotary damper c: theta' = -k cos theta, k = m g l / (2 c), so that
 * theta is -2 atan tanh (k t / 2), and the integrator does not see the time constant I / c of 3e-7 s. */
static void stiff_damper(int route)
{
    const double c = 1e6, k = G * 0.5 / c, t = 4e5;
    scene *s = with_ida(1e-6);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int b = rod(s, 1, 1, 0.5, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_force(s, PM_FORCE_ROTARY_DAMPER, b, PM_GROUND, c, 0);
    const int theta = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, b));
    scene_set(s, PM_SETTING_MAX_TIME, 2 * t);
    scene_until_time(s, t);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[theta], -2 * atan(tanh(k * t / 2)), 1e-6);
    EQUAL(s->count[PM_COUNT_ROUTE], PM_ROUTE_IDA);
    EQUAL(s->count[PM_COUNT_STIFF_PHASES], route == PM_ROUTE_AUTO);
    CHECK(s->count[PM_COUNT_STEPS] < (route == PM_ROUTE_IDA ? 500 : 3000));
    scene_free(s);
}

/* ---- roots ---- */
typedef struct flight {
    scene *s;
    int body, point, x, y;
} flight;

static flight thrown(double vx, double vy, double accuracy)
{
    flight f = {.s = with_ida(accuracy)};
    f.body = scene_body(f.s, 0.7, 0, 0, 0, 0);
    f.point = scene_point(f.s, f.body, 0, 0);
    f.x = scene_part(f.s, PM_MEASURE_POSITION, f.point, PM_PART_X);
    f.y = scene_part(f.s, PM_MEASURE_POSITION, f.point, PM_PART_Y);
    scene_start_velocity(f.s, f.point, vx, vy);
    return f;
}

static int count_of(scene *s, int event)
{
    return scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, event));
}

/* Heights just below the top are passed twice within one step, wherever the step begins. */
static void grazes(void)
{
    for (int i = 0; i < 20; i++) {
        flight f = thrown(1, 8 + 0.0137 * i, 1e-7);
        scene *s = f.s;
        const double v = 8 + 0.0137 * i, below = 1e-8 * (1 + i), top = v * v / (2 * G),
                     dt = sqrt(2 * below / G);
        const int event = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, f.y, top - below)),
                  count = count_of(s, event);
        const int first = scene_ask_event(s, scene_read(s, scene_time(s)), event, 1, 0);
        scene_until_time(s, 1.2);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[count], 2);
        NEAR(s->out[first], v / G - dt, 0.1 * dt);
        scene_free(s);
    }
}

/* A function that holds zero at the start, or misses it by rounding, counts when it comes back, from either
 * side; multiples count each once. */
static void held_zeros(void)
{
    for (int side = -1; side <= 1; side += 2) {
        flight f = thrown(3 * side, 8, 1e-8);
        scene *s = f.s;
        const int y = SCENE_PROGRAM(s, scene_m(f.y), scene_k(s, 1e-15), scene_op(PM_OP_SUB), scene_k(s, side),
                                    scene_op(PM_OP_MUL));
        const int zero = scene_when(s, PM_TRIGGER_CROSS, y), zeros = count_of(s, zero);
        const int back = scene_when(s, side > 0 ? PM_TRIGGER_FALL : PM_TRIGGER_RISE, y),
                  backs = count_of(s, back);
        const int every = scene_when(s, PM_TRIGGER_EVERY, scene_read(s, f.x)), multiples = count_of(s, every);
        const int t = scene_ask_event(s, scene_read(s, scene_time(s)), zero, 1, 0);
        scene_until_time(s, 1.7);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[zeros], 1);
        EQUAL(s->out[backs], 1);
        NEAR(s->out[t], 16 / G, 1e-9);
        EQUAL(s->out[multiples], 5);
        scene_free(s);
    }
}

/* Bounces die out after t1 (1 + e) / (1 - e): each flight is found, down to the last; away from the origin,
 * too, where the last flights are lost in rounding. */
static void bounces_to_rest(void)
{
    const double e = 0.6, h = 1.25, t1 = sqrt(2 * h / G);
    for (double away = 0; away < 6000; away += 5000) {
        scene *s = with_ida(1e-10);
        const int b = scene_body(s, 0.7, 0, away, away, 0), point = scene_point(s, b, 0, 0);
        const int line = scene_line(s, scene_point(s, PM_GROUND, away, away - h), 0);
        const int c =
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, point, 0), line, 0, e, PM_FRICTION_SMOOTH, 0);
        const int strike = scene_on(s, PM_TRIGGER_STRIKE, c), time = scene_read(s, scene_time(s));
        const int t = scene_ask_end(s, time),
                  each = scene_ask(s, PM_ASK_EACH, time, strike, 1, 0, PM_NONE, PM_NONE, 10);
        scene_until(s, scene_on(s, PM_TRIGGER_REST, b), 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[t], t1 * (1 + e) / (1 - e), away > 0 ? 1e-4 : 1e-6);
        double strikes = t1;
        for (int i = 0; i < 10; i++) {
            NEAR(s->out[each + i], strikes, away > 0 ? 1e-7 : 1e-9);
            strikes += 2 * t1 * pow(e, i + 1);
        }
        CHECK(s->count[PM_COUNT_EVENTS] < 60);
        scene_free(s);
    }
}

/* Rebounds far below the tolerance of positions, beside a fast body a long way off that gives the scene its size and speed: the
 * first bounce ends in its time all the same, and in the middle of the second the mark is on top. */
static void low_bounces(double accuracy)
{
    const double v = 1e-4, e = 0.5, flight_time = 2 * v / G;
    scene *s = with_ida(accuracy);
    const int b = scene_body(s, 0.7, 0, 0, 0, 0), far_one = scene_body(s, 1, 0, 0, 50, 0),
              mark = scene_point(s, b, 0, 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, mark, 0), scene_floor(s, 0), 0, e,
                                PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, mark, 0, v);
    scene_start_velocity(s, scene_point(s, far_one, 0, 0), 1, 0);
    const int strikes = count_of(s, scene_on(s, PM_TRIGGER_STRIKE, c)),
              speed = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, mark, PM_PART_Y));
    scene_until_time(s, (1 + 0.5 * e) * flight_time);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[strikes], 1);
    NEAR(s->out[speed], 0, 0.1 * v);
    scene_free(s);
}

/* ---- failures, sameness ---- */
/* A force whose program has no value from the start on, or from an instant that no step can pass. */
static void fails_with_a_number(void)
{
    const double end[] = {0, 0.5};
    for (int i = 0; i < 2; i++) {
        flight f = thrown(0, 0, 1e-8);
        scene *s = f.s;
        const int push = SCENE_PROGRAM(s, scene_k(s, end[i]), scene_m(scene_time(s)), scene_op(PM_OP_SUB),
                                       scene_op(PM_OP_SQRT));
        scene_applied(s, f.point, PM_GROUND, push, push);
        scene_ask_measure(s, f.x);
        scene_until_time(s, 1);
        EQUAL(scene_run(s, NULL), i == 0 ? PM_SOLVER : PM_STEP_TOO_SMALL);
        if (i == 0) CHECK(s->detail[PM_DETAIL_VALUE] < 0); /* IDA's code */
        NEAR(s->detail[PM_DETAIL_TIME], end[i], 1e-9);
        CHECK(isnan(s->out[0]));
        scene_free(s);
    }
}

/* Where a force has no value, neither has the residual: IDA is told, and tries a smaller step. */
static void residual_without_a_value(void)
{
    flight f = thrown(1, 0, 1e-8);
    scene *s = f.s;
    const int push =
        SCENE_PROGRAM(s, scene_k(s, 0.5), scene_m(f.x), scene_op(PM_OP_SUB), scene_op(PM_OP_SQRT));
    scene_applied(s, f.point, PM_GROUND, push, push);
    scene_until_time(s, 0.1);
    EQUAL(scene_open(s), PM_OK);
    pm_workspace *w = s->w;
    EQUAL(pm_run(w, NULL), PM_OK);
    double y[20] = {0}, yp[20] = {0}, r[20];
    CHECK(w->ida->n <= 20);
    EQUAL(pm_ida_system_residual(w, 0, y, yp, r), 1);
    y[0] = 0.6; /* x, beyond where the force ends */
    EQUAL(pm_ida_system_residual(w, 0, y, yp, r), 0);
    scene_free(s);
}

/* Cases in any order and over any threads give the same bits: nothing is left over from the case before. */
static void same_bits(void)
{
    enum { CASES = 12 };
    flight f = thrown(2, 5, 1e-6);
    scene *s = f.s;
    const int line = scene_line(s, scene_point(s, PM_GROUND, 0, -1), 0), g = scene_parameter(s);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, f.point, 0), line, 0, 0.5, PM_FRICTION_COULOMB, 0.2);
    *scene_setting(s, PM_SETTING_GRAVITY_Y) = g;
    scene_ask_measure(s, f.x);
    scene_until_time(s, 3);
    scene_pack(s);
    double param[2][CASES], out[2][CASES], detail[CASES * PM_DETAIL_COLUMNS], audit[CASES * PM_AUDITS];
    double found[CASES * PM_FOUND_COLUMNS];
    double error[CASES], margin[CASES], trust[CASES * PM_TRUSTS];
    int32_t reason[CASES], status[CASES], where[CASES * PM_WHERE_COLUMNS], stop = 0;
    int64_t progress = 0, count[CASES * PM_COUNT_COLUMNS];
    for (int i = 0; i < CASES; i++) param[0][i] = param[1][CASES - 1 - i] = -9 - 0.3 * i;
    for (int run = 0; run < 2; run++) {
        EQUAL(pm_batch(s->ntable, s->table, s->nconstant, s->constant, CASES, 1, param[run], run + 1, &stop,
                       &progress, 1, out[run], 1, reason, status, where, detail, audit, count, found, error,
                       margin, trust),
              PM_OK);
        for (int i = 0; i < CASES; i++) EQUAL(status[i], PM_OK);
    }
    for (int i = 0; i < CASES; i++) EQUAL(out[0][i], out[1][CASES - 1 - i]);
    scene_free(s);
}

/* Cranks in a row and couplers between them, rods of 1 m and 1 kg, turn from upright through both flat positions, where the
 * rows lose their rank and the cranks could as well part: energy is kept, and the couplers stay level.  Each flat position is
 * left to rk, and not stepped over: it is the first, third and fifth phase that ida computes. */
static void passes_flat_parallelograms(int n, double accuracy, double start, double close)
{
    const double quarter = 1.57079632679489661923, end = -4, legs = n + 1;
    scene *s = with_ida(accuracy);
    int leg[MANY_BARS + 1], bar = PM_NONE;
    for (int i = 0; i <= n; i++) {
        leg[i] = rod(s, 1, 1, i, 0.5, quarter);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, leg[i], -0.5, 0), scene_point(s, PM_GROUND, i, 0), 0);
    }
    for (int i = 0; i < n; i++) {
        bar = rod(s, 1, 1, i + 0.5, 1, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, bar, -0.5, 0), scene_point(s, leg[i], 0.5, 0), 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, bar, 0.5, 0), scene_point(s, leg[i + 1], 0.5, 0), 0);
    }
    scene_start_omega(s, leg[0], -start);
    const int angle = scene_measure(s, PM_MEASURE_ANGLE, leg[0]);
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_minus(s, angle, end)), 1);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, leg[0])),
              level = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, bar));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double ratio = (legs / 2 + n) / (legs / 3 + n); /* of the weights' levers and the inertia */
    NEAR(s->out[omega], -sqrt(start * start + 2 * ratio * G * (1 - sin(end))), close);
    NEAR(s->out[level], 0, 1e-8);
    CHECK(s->count[PM_COUNT_ROUTES] & (int64_t)1 << PM_ROUTE_RK); /* no further than there */
    EQUAL(s->count[PM_COUNT_ROUTE], PM_ROUTE_IDA);
    EQUAL(s->count[PM_COUNT_PHASES], 5);
    scene_free(s);
}

int main(void)
{
    passes_flat_parallelograms(1, 1e-9, 1, 1e-8);
    passes_flat_parallelograms(MANY_BARS, 1e-9, 1, 1e-8);
    passes_flat_parallelograms(MANY_BARS, 1e-10, 1, 1e-8);
    for (int n = 7; n < 20;
         n += 4) /* so fast and loose that one step leads from far before a flat position to far behind */
        passes_flat_parallelograms(n, 1.5e-4, 34, 1e-2);
    for (int links = 0; links <= LINKS; links += LINKS) {
        newton_matrix(links);
        newton_matrix_with_friction(links);
    }
    motions();
    friction_stops();
    rolls_far(0.25, 1e-8);
    rolls_far(0.25, 1e-10);
    rolls_far(0.003, 1e-10);
    stiff_damper(PM_ROUTE_IDA);
    stiff_damper(PM_ROUTE_AUTO); /* which finds out */
    grazes();
    held_zeros();
    bounces_to_rest();
    for (double accuracy = 1e-4; accuracy > 5e-7; accuracy *= 0.1) low_bounces(accuracy);
    fails_with_a_number();
    residual_without_a_value();
    same_bits();
    return check_failures();
}
