/* Phases without losses keep their energy on rk, at any accuracy; what was returned remains as evidence; work that is not
 * a potential's is left as it is. */
#include "equations/energy_level.h"

#include "check.h"
#include "scene.h"

enum { PLAIN, SPRING, DAMPED, FORCED };

typedef struct result {
    double energy, angle, evidence;
} result;

/* Two rods in series, thrown so that they turn over; the tip may be held by a spring, a damper, or be pushed. */
static result thrown(int what, int rods, int route, double accuracy)
{
    scene *s = scene_create();
    int body = PM_GROUND;
    for (int i = 0; i < rods; i++) {
        const int last = body;
        body = scene_body(s, 1, 1 / 12., i + 0.5, 0, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, body, -0.5, 0), scene_point(s, last, i > 0 ? 0.5 : 0, 0),
                    0);
        scene_start_omega(s, body, 9);
    }
    const int tip = scene_point(s, body, 0.5, 0), nail = scene_point(s, PM_GROUND, 3, 1);
    if (what == SPRING) scene_force(s, PM_FORCE_SPRING, tip, nail, 3, 1);
    if (what == DAMPED) scene_force(s, PM_FORCE_DAMPER, tip, nail, 0.05, 0);
    if (what == FORCED)
        scene_applied(s, tip, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, 1)), SCENE_PROGRAM(s, scene_k(s, 0)));
    scene_until_time(s, 4);
    const int energy = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TOTAL, PM_NONE));
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, body));
    scene_route(s, route, accuracy);
    EQUAL(scene_run(s, NULL), PM_OK);
    const result x = {s->out[energy], s->out[angle], s->audit[PM_AUDIT_ENERGY]};
    scene_free(s);
    return x;
}

/* At the start weights have the zero of their energy, and all turns as one. */
static double start_energy(int what, int rods)
{
    double sum = 0;
    for (int i = 0; i < rods; i++) sum += 0.5 * 81 * (1 / 12. + (i + 0.5) * (i + 0.5));
    return what == SPRING ? sum + 1.5 * pow(hypot(3 - rods, 1) - 1, 2) : sum;
}

static void keeps_energy(void)
{
    for (int rods = 1; rods <= 2; rods++)
        for (int what = PLAIN; what <= SPRING; what++) {
            const result x = thrown(what, rods, PM_ROUTE_RK, 1e-4);
            NEAR(x.energy, start_energy(what, rods), 1e-12 * x.energy);
            CHECK(x.evidence > 1e-8); /* the drift is told */
        }
}

/* The errors of a whole motion: of one freedom they are delays. */
static void keeps_pace(void)
{
    const result exact = thrown(PLAIN, 1, PM_ROUTE_PATH, 1e-10), rk = thrown(PLAIN, 1, PM_ROUTE_RK, 1e-7);
    NEAR(rk.angle, exact.angle, 1e-6);
}

/* The work of a damper or a force enters the energy as it was integrated, to the accuracy and no better. */
static void leaves_work(void)
{
    for (int what = DAMPED; what <= FORCED; what++) {
        const result fine = thrown(what, 2, PM_ROUTE_RK, 1e-12), coarse = thrown(what, 2, PM_ROUTE_RK, 1e-5);
        CHECK(fabs(fine.energy - start_energy(PLAIN, 2)) > 0.1);
        NEAR(coarse.energy, fine.energy, 1e-2);
        CHECK(fabs(coarse.energy - fine.energy) > 1e-9);
    }
}

int main(void)
{
    keeps_energy();
    keeps_pace();
    leaves_work();
    return check_failures();
}
