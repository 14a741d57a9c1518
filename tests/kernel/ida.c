/* The ida route: its Newton matrix against differences of its residual; motions against the rk route and
 * closed forms; stiff forces. */
#include "routes/ida/ida.h"
#include "check.h"
#include "scene.h"
#include "state/route.h"
#include "state/workspace.h"

#define G 9.81
#define MOST 256 /* unknowns */
#define MANY_BARS 40
#define LINKS 9 /* a chain that makes their system a sparse one */

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
    scene *s = scene_by(PM_ROUTE_IDA, 1e-8);
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
    scene *s = scene_by(PM_ROUTE_IDA, accuracy);
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
        scene *s = scene_by(PM_ROUTE_IDA, accuracy[i]);
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
    scene *s = scene_by(PM_ROUTE_IDA, accuracy);
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
    scene *s = scene_by(PM_ROUTE_IDA, 1e-6);
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

/* Cranks in a row and couplers between them, rods of 1 m and 1 kg, turn from upright through both flat positions, where the
 * rows lose their rank and the cranks could as well part: energy is kept, and the couplers stay level.  Each flat position is
 * left to rk, and not stepped over: it is the first, third and fifth phase that ida computes. */
static void passes_flat_parallelograms(int n, double accuracy, double start, double close)
{
    const double quarter = 1.57079632679489661923, end = -4, legs = n + 1;
    scene *s = scene_by(PM_ROUTE_IDA, accuracy);
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
    return check_failures();
}
