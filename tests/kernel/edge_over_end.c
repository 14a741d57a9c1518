/* A pinned rod goes to and fro between two stops, which its faces strike.  Beyond 90 deg from its lowest place a stop that is
 * behind a face comes round the pinned end over it: that is no contact and no decision, however the phase goes on.  Beside the
 * speeds by energy. */
#include "check.h"
#include "estimating.h"
#include "scene.h"
#include "scene_elements.h"

#define BLOWS 5
#define HALF_TURN 3.14159265358979323846

/* The angles of the stops from the lowest place of the rod, on either side; its first speed there, rad/s. */
typedef struct stops {
    double angle[2], restitution, omega, arm;
} stops;

static stops random_stops(double low, double high)
{
    stops x = {.angle = {check_random(low, high), -check_random(low, high)},
               .restitution = check_random(0.3, 0.9),
               .arm = check_random(0.2, 0.9)};
    const double highest = fmax(x.angle[0], -x.angle[1]);
    x.omega = sqrt(3 * G * (1 - cos(highest)) * check_random(1.05, 1.4));
    return x;
}

/* Just after so many blows: omega^2 goes by 3 g cos(angle) from stop to stop, or back to the same one. */
static double omega_after(const stops *x, int blows)
{
    double square = x->omega * x->omega, from = 0;
    int side = 0;
    for (int i = 0; i < blows; i++) {
        double there = square + 3 * G * (cos(x->angle[side]) - cos(from));
        if (there <= 0) {
            side = 1 - side;
            there = square;
        }
        from = x->angle[side];
        square = x->restitution * x->restitution * there;
        side = 1 - side;
    }
    return (side == 0 ? 1 : -1) * sqrt(square);
}

static int stop(scene *s, const stops *x, int rod, int side)
{
    const double way = x->angle[side] - 0.5 * HALF_TURN;
    const int at = scene_circle(s, scene_point(s, PM_GROUND, x->arm * cos(way), x->arm * sin(way)), 0);
    const int face = scene_line(s, scene_point(s, rod, -0.5, 0), side == 0 ? 0 : HALF_TURN);
    const int contact = scene_segment(s, at, face, side == 0 ? 0 : -1, side == 0 ? 1 : 0, x->restitution,
                                      PM_FRICTION_SMOOTH, 0);
    return contact;
}

static void between_stops(const stops *x, int route)
{
    scene *s = estimating(1e-10);
    const int rod = scene_body(s, 2, 2. / 12, 0, -0.5, -0.5 * HALF_TURN);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, rod, x->omega);
    const int hit = scene_event(s);
    for (int side = 0; side < 2; side++)
        scene_trigger(s, PM_TRIGGER_STRIKE, hit, PM_NONE, stop(s, x, rod, side));
    scene_until(s, hit, BLOWS);
    const int omega = scene_measure(s, PM_MEASURE_OMEGA, rod);
    const int first = scene_ask_event(s, scene_read(s, omega), hit, 1, 0), last = scene_ask_measure(s, omega);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[first], omega_after(x, 1), 1e-8);
    NEAR(s->out[last], omega_after(x, BLOWS), 1e-8);
    CHECK(s->trust[PM_TRUST_MARGIN] > 50);
    scene_free(s);
}

int main(void)
{
    static const int route[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 20; i++) {
            const stops high = random_stops(0.55 * HALF_TURN, 0.9 * HALF_TURN),
                        low = random_stops(0.1 * HALF_TURN, 0.45 * HALF_TURN);
            between_stops(&high, route[k]);
            between_stops(&low, route[k]);
        }
    return check_failures();
}
