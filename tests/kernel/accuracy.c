/* Estimated errors and margins: against true errors, on decisions that are close, and what is asked of accuracy. */
#include "study/accuracy.h"
#include "check.h"
#include "estimating.h"
#include "expression/program_class.h"
#include "scene.h"
#include "state/workspace.h"

/* A rod, pinned at one end, let go at an angle above the horizontal, to the vertical: omega^2 = 3 g (1 + sin angle) / L;
 * the pin then carries m g + m omega^2 L / 2, and nothing sideways. */
static scene *pendulum(double accuracy, double length, double angle)
{
    scene *s = estimating(accuracy);
    const int rod = scene_body(s, 3, 3 * length * length / 12, 0.5 * length * cos(angle),
                               0.5 * length * sin(angle), angle);
    const int end = scene_point(s, rod, -length / 2, 0);
    const int pin = scene_joint(s, PM_JOINT_PIN, end, scene_point(s, PM_GROUND, 0, 0), 0);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, rod);
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_minus(s, turned, -1.5707963267948966 - angle)), 1);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, rod));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, pin, PM_PART_Y));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, pin, PM_PART_X)); /* 0 */
    return s;
}

/* Of all asks at many accuracies, on both routes, nearly all errors lie below their estimates, and not far below. */
static void calibrated(void)
{
    static const int routes[] = {PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int r = 0; r < 2; r++) {
        int asks = 0, covered = 0, close = 0;
        for (int i = 0; i < 40; i++) {
            const double length = check_random(0.3, 3), angle = check_random(-0.5, 1),
                         accuracy = pow(10, check_random(-11, -4));
            scene *s = pendulum(accuracy, length, angle);
            *scene_setting(s, PM_SETTING_ROUTE) = routes[r];
            EQUAL(scene_run(s, NULL), PM_OK);
            const double up = 1 + sin(angle),
                         truth[] = {-sqrt(3 * G * up / length), 3 * G * (1 + 1.5 * up), 0};
            for (int k = 0; k < 3; k++) {
                const double scale = k == 0 ? -truth[0] : truth[1];
                const double error = fmax(fabs(s->out[k] - truth[k]), 1e-14 * fabs(truth[k]));
                asks++;
                covered += error <= s->error[k];
                close += s->error[k] <= 100 * error;
                CHECK(s->error[k] <= accuracy * s->trust[PM_TRUST_EXCESS] * 1000 * scale);
            }
            CHECK(s->trust[PM_TRUST_MARGIN] > 1);
            CHECK(isnan(s->margin[0]));
            CHECK(s->trust[PM_TRUST_EXCESS] <= 1 || accuracy < 2e-9); /* below it ida gets no better */
            CHECK(s->count[PM_COUNT_PASSES] >= 2);
            scene_free(s);
        }
        CHECK(covered >= 0.95 * asks);
        CHECK(close >= 0.5 * asks);
    }
}

/* Without the setting one pass is made, and the numbers are those of the kernel without estimates. */
static void switched_off(void)
{
    scene *s = pendulum(1e-8, 1, 0), *t = pendulum(1e-8, 1, 0);
    *scene_setting(t, PM_SETTING_ESTIMATE) = 0;
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(scene_run(t, NULL), PM_OK);
    for (int k = 0; k < 3; k++) {
        if (s->count[PM_COUNT_PASSES] == 2) EQUAL(s->out[k], t->out[k]);
        CHECK(isnan(t->error[k]));
    }
    EQUAL(t->count[PM_COUNT_PASSES], 1);
    CHECK(isnan(t->trust[PM_TRUST_MARGIN]) && isnan(t->trust[PM_TRUST_EXCESS]));
    scene_free(s);
    scene_free(t);
}

/* A double pendulum multiplies errors: the accuracy asked takes a tighter tolerance, and is kept. */
static void promise(void)
{
    double out[2];
    for (int pass = 0; pass < 2; pass++) {
        scene *s = estimating(pass ? 1e-8 : 1e-12);
        const int tip = scene_point(s, hang_two_rods(s, 0, 0), 0.5, 0);
        scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, tip, PM_PART_X));
        scene_until_time(s, 5);
        EQUAL(scene_run(s, NULL), PM_OK);
        out[pass] = s->out[0];
        if (pass) {
            CHECK(s->count[PM_COUNT_PASSES] > 2);
            CHECK(s->trust[PM_TRUST_EXCESS] <= 1);
            CHECK(fabs(out[1] - out[0]) <= s->error[0]);
        }
        scene_free(s);
    }
}

/* For a time in which rk takes few steps, or (time 0) until the upper rod has fallen by an angle, which is within a step. */
static scene *two_rods(double accuracy, const double *angle, double time, double fallen)
{
    scene *s = estimating(accuracy);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
    const int lower = hang_two_rods(s, angle[0], angle[1]), upper = lower - 1;
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, upper));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, scene_point(s, lower, 0.5, 0), PM_PART_Y));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, lower));
    const int turned = scene_measure(s, PM_MEASURE_TURNED, upper);
    if (time > 0)
        scene_until_time(s, time);
    else
        scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_minus(s, turned, -fallen)), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    return s;
}

/* The coarse run of one that takes few steps does not err like it, wherever in a step it ends: none of 3000 errors is three times its
 * estimate, and hardly one more than it, though the difference of two runs may be small by chance. */
static void few_steps(int within)
{
    int beyond = 0, more = 0, single = 0;
    for (int i = 0; i < 1000; i++) {
        const double most = within ? -1 : -3, fallen = check_random(0.02, 0.5),
                     angle[] = {check_random(most, 1), check_random(most, 1)},
                     time = within ? 0 : check_random(0.05, 0.6);
        scene *s = two_rods(pow(10, check_random(-6, -4)), angle, time, fallen),
              *exact = two_rods(1e-12, angle, time, fallen);
        single += s->count[PM_COUNT_STEPS] == 1;
        for (int k = 0; k < 3; k++) {
            const double off = fabs(s->out[k] - exact->out[k]);
            beyond += off > fmax(3 * s->error[k], 1e-13);
            more += off > fmax(s->error[k], 1e-13);
        }
        scene_free(s);
        scene_free(exact);
    }
    CHECK(single > (within ? 4 : 10));
    EQUAL(beyond, 0);
    CHECK(more < 8); /* 0.25 % */
}

/* Two runs may tell one answer alike by chance, but hardly all of them: none is told far better than the others, each over its size. */
static void by_chance(void)
{
    const double size[] = {1, 1, 10}; /* of an angle, a place, the speed of a turn */
    int alone = 0;
    for (int i = 0; i < 1000; i++) {
        const double angle[] = {check_random(-3, 1), check_random(-3, 1)};
        scene *s = two_rods(pow(10, check_random(-6, -3)), angle, check_random(1, 3), 0);
        double greatest = 0;
        for (int k = 0; k < 3; k++) greatest = fmax(s->error[k] / size[k], greatest);
        for (int k = 0; k < 3; k++) alone += s->error[k] / size[k] < 1e-2 * greatest;
        scene_free(s);
    }
    EQUAL(alone, 0);
}

/* Errors of few steps at loose accuracies have a sign by chance: two runs that err alike in all are told by a third. */
static void loose(void)
{
    int beyond = 0, more = 0;
    for (int i = 0; i < 1000; i++) {
        const double angle[] = {check_random(-3, 1), check_random(-3, 1)}, time = check_random(1, 3);
        scene *s = two_rods(pow(10, check_random(-8, -3)), angle, time, 0),
              *exact = two_rods(1e-12, angle, time, 0);
        for (int k = 0; k < 3; k++) {
            const double off = fabs(s->out[k] - exact->out[k]);
            beyond += off > 10 * s->error[k];
            more += off > s->error[k];
        }
        scene_free(s);
        scene_free(exact);
    }
    EQUAL(beyond, 0);
    CHECK(more < 15); /* 0.5 % */
}

/* A double pendulum whose lower rod is driven by a couple that is switched 200 times a second, in a frame turned by an angle. */
static scene *switched(double turned)
{
    scene *s = estimating(1e-9);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
    const double x = cos(turned), y = sin(turned), often = 100;
    scene_set(s, PM_SETTING_GRAVITY_X, G * y);
    scene_set(s, PM_SETTING_GRAVITY_Y, -G * x);
    const int lower = hang_two_rods(s, turned, turned), t = scene_time(s);
    const int couple =
        SCENE_PROGRAM(s, scene_m(t), scene_k(s, often), scene_op(PM_OP_MUL), scene_m(t), scene_k(s, often),
                      scene_op(PM_OP_MUL), scene_op(PM_OP_FLOOR), scene_op(PM_OP_SUB), scene_k(s, 0.5),
                      scene_op(PM_OP_LT), scene_k(s, 0.5), scene_op(PM_OP_MUL));
    scene_couple(s, lower, PM_GROUND, couple);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, lower));
    scene_until_time(s, 20);
    return s;
}

/* Its steps end where the couple is switched, whatever the tolerance: two main passes are rounded alike, and only a disturbed
 * run shows what the motion makes of rounding.  In another frame the same motion is rounded otherwise: the answers differ by
 * no more than both errors. */
static void rounded_alike(void)
{
    double out[2], error[2];
    for (int i = 0; i < 2; i++) {
        scene *s = switched(0.9 + 0.3 * i);
        EQUAL(scene_run(s, NULL), PM_OK);
        out[i] = s->out[0];
        error[i] = s->error[0];
        scene_free(s);
    }
    CHECK(fabs(out[1] - out[0]) <= error[0] + error[1]);
}

static void margins(void)
{
    double last = INFINITY;
    for (int i = 2; i < 12; i++) {
        for (int side = -1; side <= 1; side += 2) {
            scene *s = thrown(side * pow(10, -i), 1e-10);
            const int status = scene_run(s, NULL);
            EQUAL(status, PM_OK);
            EQUAL(s->out[0], side > 0);
            EQUAL(s->error[0], 0);
            EQUAL(s->margin[0], s->trust[PM_TRUST_MARGIN]);
            CHECK(s->margin[0] > 1);
            CHECK(i < 5 || s->margin[0] < pow(10, 15 - i)); /* rounding over how close it is */
            if (side > 0) {
                CHECK(i < 4 || s->margin[0] < 3 * last); /* before, rounding by chance */
                last = s->margin[0];
            }
            scene_free(s);
        }
    }
    int undecided = 0;
    for (int i = -3; i <= 3; i++) {
        scene *s = thrown(i * 3e-16, 1e-10);
        undecided += scene_run(s, NULL) == PM_UNDECIDED && s->margin[0] < 1;
        scene_free(s);
    }
    EQUAL(undecided, 7);
}

/* What a coarse run shows without truncation, and at once: a parabola is exact, only the disturbance is seen. */
static void rounding(void)
{
    scene *s = thrown(0.5, 1e-10);
    const int y = scene_ask_end(s, scene_read(s, scene_part(s, PM_MEASURE_POSITION, 0, PM_PART_Y)));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double v = sqrt(2 * G * 1.5 * 1.5), truth = 2 * v - 2 * G;
    CHECK(fabs(s->out[y] - truth) <= s->error[y]);
    CHECK(s->error[y] < 1e-12);
    scene_free(s);
}

/* Routes may bring their own errors; what they say counts. */
static void own_errors(void)
{
    scene *s = pendulum(1e-8, 1, 0);
    scene_open(s);
    pm_workspace *w = s->w;
    double out[3], error[3], margin[3], trust[PM_TRUSTS], audit[PM_AUDITS];
    int32_t reason[3];
    w->result.out = out;
    w->result.reason = reason;
    w->result.audit = audit;
    EQUAL(pm_accuracy_run(w, NULL, NULL, error, margin, trust), PM_OK);
    w->evidence.present->margin = INFINITY;
    pm_evidence_decide(&w->evidence, -3e-9, 1e-9);
    NEAR(w->evidence.present->margin, 3, 1e-12);
    pm_evidence_answer(&w->evidence, 1, 0.25);
    EQUAL(w->evidence.present->error[1], 0.25);
    scene_close(s);
    scene_free(s);
}

/* Only counts, constants and comparisons: no error, but a margin. */
static void discrete(void)
{
    scene *s = scene_create();
    const int ball = scene_body(s, 1, 0, 0, 0, 0),
              x = scene_part(s, PM_MEASURE_POSITION, scene_point(s, ball, 0, 0), 1);
    const int count = scene_measure(s, PM_MEASURE_EVENT_COUNT, scene_event(s));
    const int program[] = {
        scene_read(s, count),
        SCENE_PROGRAM(s, scene_m(x), scene_k(s, 1), scene_op(PM_OP_LT), scene_m(count), scene_op(PM_OP_ADD)),
        SCENE_PROGRAM(s, scene_m(x), scene_op(PM_OP_FLOOR)),
        SCENE_PROGRAM(s, scene_m(x), scene_k(s, 1), scene_op(PM_OP_LT), scene_m(x), scene_op(PM_OP_ADD)),
        SCENE_PROGRAM(s, scene_m(count), scene_m(x), scene_k(s, 2), scene_op(PM_OP_SELECT)),
        scene_read(s, x),
        SCENE_PROGRAM(s, scene_k(s, 0.3)),
    };
    scene_until_time(s, 1);
    scene_open(s);
    for (int i = 0; i < 7; i++) EQUAL(pm_program_class_is_discrete(s->model, program[i]), i < 3);
    scene_free(s);
}

/* The path knows the error of its clock: times of a rod of length 1 on its pin by elliptic integrals (Gauss's mean), from
 * rest to the lowest place and from there, fast enough, to the highest.  No coarse run is made; a watched event that the
 * speeds decide changes nothing, one that ends the run is not for it. */
static void clock_errors(void)
{
    const double w2 = 1.5 * G, quarter = 0.5 * 3.14159265358979323846;
    int covered = 0, close = 0, all = 0;
    for (int i = 0; i < 40; i++) {
        const int turns = i % 2, watches = i % 4 > 1;
        const double rise = check_random(0.1, 3), omega = sqrt(4 * w2) * check_random(1.05, 3);
        const double accuracy = pow(10, check_random(-12, -6));
        const double angle = turns ? -quarter : -quarter + rise, end = turns ? quarter : -quarter;
        scene *s = estimating(accuracy);
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
        const int rod = scene_body(s, 3, 0.25, 0.5 * cos(angle), 0.5 * sin(angle), angle);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
        const int there = scene_measure(s, PM_MEASURE_ANGLE, rod),
                  rate = scene_measure(s, PM_MEASURE_ALPHA, rod);
        if (turns) scene_start_omega(s, rod, omega);
        scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, there, end)), 1);
        if (watches) scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, rate, turns ? -1 : 1));
        scene_ask_measure(s, scene_time(s));
        EQUAL(scene_run(s, NULL), PM_OK);
        const double exact = turns ? 2 * quarter / mean(omega, sqrt(omega * omega - 4 * w2))
                                   : quarter / (mean(1, cos(0.5 * rise)) * sqrt(w2));
        const double error = fmax(fabs(s->out[0] - exact), 1e-14 * exact);
        EQUAL(s->count[PM_COUNT_PASSES], 1);
        all++;
        covered += error <= s->error[0];
        close += s->error[0] <= 100 * error;
        CHECK(s->error[0] <= accuracy * exact || accuracy < 1e-11);
        scene_free(s);
    }
    CHECK(covered >= 0.95 * all);
    CHECK(close >= 0.5 * all);
    scene *s = pendulum(1e-9, 1, 0); /* ends where its acceleration says so */
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, scene_measure(s, PM_MEASURE_ALPHA, 0), -3)),
                1);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(s->count[PM_COUNT_PASSES] >= 2);
    scene_free(s);
}

int main(void)
{
    calibrated();
    switched_off();
    promise();
    few_steps(0);
    few_steps(1);
    by_chance();
    rounded_alike();
    margins();
    rounding();
    own_errors();
    discrete();
    clock_errors();
    loose();
    return check_failures();
}
