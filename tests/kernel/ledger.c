/* The audit: both ledgers close for every kind of force and contact, and open when something is changed by nobody. */
#include "equations/ledger.h"

#include "check.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

/* Springs, dampers, forces that follow, friction, blows and joints at once. */
static scene *busy(void)
{
    scene *s = scene_create();
    const int a = scene_body(s, 1.2, 0.1, 0.5, 1, 0), b = scene_body(s, 0.7, 0.04, 1.4, 1, 0),
              ball = scene_body(s, 0.4, 0.002, 0.3, 0.5, 0);
    const int tip = scene_point(s, b, 0.4, 0), g = scene_point(s, ball, 0, 0),
              o = scene_point(s, PM_GROUND, 0, 1);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), o, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.4, 0), scene_point(s, a, 0.5, 0), 0);
    scene_force(s, PM_FORCE_SPRING, tip, g, 5, 0.3);
    scene_force(s, PM_FORCE_DAMPER, tip, o, 0.4, 0);
    scene_force(s, PM_FORCE_TORSION, a, b, 2, 0.1);
    scene_force(s, PM_FORCE_ROTARY_DAMPER, ball, a, 0.01, 0);
    const int time = scene_time(s);
    scene_applied(s, tip, b, SCENE_PROGRAM(s, scene_m(time), scene_op(PM_OP_SIN)),
                  SCENE_PROGRAM(s, scene_k(s, 0.8)));
    scene_couple(s, a, PM_GROUND,
                 SCENE_PROGRAM(s, scene_m(scene_measure(s, PM_MEASURE_OMEGA, a)), scene_k(s, -0.2),
                               scene_op(PM_OP_MUL)));
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0.1), scene_floor(s, 0.1), 0, 0.5,
                  PM_FRICTION_COULOMB, 0.2);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, tip, 0.05), scene_floor(s, 0), 0, 0.3,
                  PM_FRICTION_ROUGH, 0);
    scene_start_omega(s, a, -1);
    scene_start_omega(s, b, -3);
    scene_start_omega(s, ball, 4);
    scene_start_velocity(s, g, 1, 0.5);
    scene_until_time(s, 1.5);
    return s;
}

static void closes(void)
{
    scene *s = busy();
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(s->count[PM_COUNT_JUMPS] >= 2);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9);
    CHECK(s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-12);
    scene_free(s);
}

/* A plate that swings carries a slide with a weld on it, a wheel on its edge and one round its hub: every kind of row
 * with two moving partners does its part in the ledgers. */
static void closes_on_moving_partners(void)
{
    scene *s = scene_create();
    const int plate = scene_body(s, 3, 0.4, 0, 0, 0), hub = scene_point(s, plate, 0, 0);
    const int slide = scene_body(s, 0.5, 0.02, 0.5, 0.1, 0), arm = scene_body(s, 0.3, 0.01, 0.5, 0.4, 0);
    const int planet = scene_body(s, 0.6, 0.012, 0, -0.5, 0), wheel = scene_body(s, 0.4, 0.002, -0.5, 0.2, 0);
    const int edge = scene_line(s, scene_point(s, plate, 0, 0.1), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, plate, -0.2, 0), scene_point(s, PM_GROUND, -0.2, 0), 0);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, slide, 0, 0), edge, 0);
    scene_joint(s, PM_JOINT_WELD, scene_point(s, arm, 0, 0), scene_point(s, slide, 0, 0.3), 0);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, scene_circle(s, scene_point(s, planet, 0, 0), 0.2),
                scene_circle(s, hub, 0.3), 1);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, scene_point(s, wheel, 0, 0), 0.1), edge, 0);
    scene_until_time(s, 0.5);
    const int turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, plate));
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(fabs(s->out[turned]) > 0.3);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9);
    CHECK(s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-12);
    scene_free(s);
}

/* Runs, then tampers with what was kept, and closes the ledger again. */
static int tampered(int what, int *which)
{
    scene *s = busy();
    int status = scene_open(s);
    if (!status) status = pm_run(s->w, s->constant);
    EQUAL(status, PM_OK);
    pm_workspace *w = s->w;
    switch (what) {
    case 0: break;
    case 1: w->state.v[6] *= 1 + 1e-5; break;           /* a speed */
    case 2: w->state.q[7] += 1e-5; break;               /* a height: energy alone */
    case 3: w->ledger.energy_lost += 1e-5; break;       /* a loss that was not */
    case 4: w->ledger.momentum_start[2] += 1e-5; break; /* a moment from nowhere */
    case 5: w->ledger.constraint_worst = 1e-6; break;   /* a joint that opened */
    default: w->state.z[0] = NAN;                       /* not a number anywhere */
    }
    status = pm_ledger_close(w);
    *which = w->result.where.row;
    scene_free(s);
    return status;
}

static void opens(void)
{
    int which;
    EQUAL(tampered(0, &which), PM_OK);
    for (int what = 1; what <= 6; what++) EQUAL(tampered(what, &which), PM_AUDIT);
    tampered(2, &which);
    EQUAL(which, PM_AUDIT_ENERGY);
    tampered(4, &which);
    EQUAL(which, PM_AUDIT_MOMENTUM);
    tampered(5, &which);
    EQUAL(which, PM_AUDIT_CONSTRAINT);
}

/* Energy that nobody gave: a part of the greatest kinetic energy, at an accuracy. */
static int with_more_energy(double accuracy, double part)
{
    scene *s = busy();
    scene_set(s, PM_SETTING_ACCURACY, accuracy);
    int status = scene_open(s);
    if (!status) status = pm_run(s->w, s->constant);
    EQUAL(status, PM_OK);
    s->w->ledger.energy_lost += part * s->w->ledger.energy_scale;
    status = pm_ledger_close(s->w);
    scene_free(s);
    return status;
}

/* A tenth of the energy too much fails at every accuracy, and less at tight ones. */
static void opens_at_every_accuracy(void)
{
    for (double accuracy = 1e-2; accuracy > 1e-13; accuracy /= 10) {
        EQUAL(with_more_energy(accuracy, 0), PM_OK);
        EQUAL(with_more_energy(accuracy, 0.1), PM_AUDIT);
        EQUAL(with_more_energy(accuracy, fmax(3e3 * accuracy, 1e-6)), PM_AUDIT);
    }
}

/* A rod swings in a plane that turns with a great wheel; then a part of the energy of the rod is given by nobody, and of the
 * momentum after a long time. */
static int beside_a_wheel(double inertia, double energy, double momentum)
{
    scene *s = scene_create();
    SCENE_ROW(s, PM_TABLE_SECOND, scene_value(s, 0), scene_value(s, 0.0625), scene_value(s, 0));
    const int rod = scene_body(s, 3, 0.0625, 0, -0.25, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, 0, 0.25), scene_point(s, PM_GROUND, 0, 0), 0);
    SCENE_ROW(s, PM_TABLE_SPIN, scene_value(s, 0), scene_value(s, 0), scene_value(s, acos(0)),
              scene_value(s, inertia), scene_value(s, 1), PM_NONE);
    scene_start_omega(s, rod, 1);
    scene_until_time(s, 0.3);
    int status = scene_open(s);
    if (!CHECK(status == PM_OK)) return status;
    status = pm_run(s->w, s->constant);
    s->w->ledger.energy_lost += energy * s->w->ledger.energy_scale;
    if (momentum > 0) s->w->state.t = 1e20; /* so long that its rounding would excuse anything */
    s->w->state.z[pm_ledger_ledger(s->w->model)] += momentum * s->w->ledger.momentum_scale;
    if (!status) status = pm_ledger_close(s->w);
    scene_free(s);
    return status;
}

/* However much rounding there may be: what is wrong by a hundredth is not confirmed. */
static void opens_at_any_size(void)
{
    EQUAL(beside_a_wheel(1e4, 0, 0), PM_OK);
    for (double inertia = 1; inertia < 1e17; inertia *= 100)
        EQUAL(beside_a_wheel(inertia, 0.01, 0), PM_AUDIT);
    EQUAL(beside_a_wheel(1e4, 0, 0.01), PM_AUDIT);
}

/* A scene at rest has nothing but rounding: that is no reason for distrust. */
static void at_rest(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 3, 0.2, -0.1, 0.5, 0.2);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, -0.3, -0.5), 0), scene_floor(s, 0.2),
                  0, 0, PM_FRICTION_COULOMB, 0.5);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, 0.3, -0.5), 0), scene_floor(s, 0.2),
                  0, 0, PM_FRICTION_COULOMB, 0.5);
    s->cell[PM_TABLE_BODY][PM_BODY_X] = scene_value(s, -0.5 * sin(0.2));
    s->cell[PM_TABLE_BODY][PM_BODY_Y] = scene_value(s, 0.5 * cos(0.2));
    scene_until_time(s, 2);
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < PM_AUDITS; i++) CHECK(s->audit[i] < 1e-9);
    scene_free(s);
}

/* A couple that has no value from t = 1 on ends the run there.  What was answered before stands: its ledgers closed; what is
 * asked at the end, and at an instant that did not come, has no value. */
static void late_failure(int route)
{
    scene *s = scene_create();
    const double inertia = 0.4, couple = 1.5;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int wheel = scene_body(s, 2, inertia, 0, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, wheel, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_couple(s, wheel, PM_GROUND,
                 SCENE_PROGRAM(s, scene_k(s, 1), scene_m(scene_time(s)), scene_op(PM_OP_SUB),
                               scene_op(PM_OP_SQRT), scene_k(s, couple), scene_op(PM_OP_MUL)));
    const int omega = scene_measure(s, PM_MEASURE_OMEGA, wheel), time = scene_time(s);
    const int half = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, time, 0.5));
    const int late = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, time, 1.5));
    const int before = scene_ask_event(s, scene_read(s, omega), half, 1, 0);
    const int after = scene_ask_event(s, scene_read(s, omega), late, 1, 0);
    const int end = scene_ask_measure(s, omega);
    scene_until_time(s, 2);
    CHECK(scene_run(s, NULL) < 0);
    NEAR(s->out[before], couple / inertia * (1 - pow(0.5, 1.5)) * 2 / 3, 1e-8);
    CHECK(isnan(s->out[after]) && isnan(s->out[end]));
    EQUAL(s->reason[0], PM_REASON_NONE);
    EQUAL(s->reason[1], PM_REASON_FAILED);
    EQUAL(s->reason[2], PM_REASON_FAILED);
    scene_free(s);
}

int main(void)
{
    late_failure(PM_ROUTE_RK);
    late_failure(PM_ROUTE_IDA);
    closes();
    closes_on_moving_partners();
    opens();
    opens_at_every_accuracy();
    opens_at_any_size();
    at_rest();
    return check_failures();
}
