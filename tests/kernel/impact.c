/* Blows: the laws of impulsive motion recomputed from the velocities before and after, for one contact struck or several, with resting contacts, with joints, for every friction; and the awkward cases that have one right answer. */
#include "check.h"
#include "elements/constraint.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "struck.h"

static void rod_corner(void)
{
    static const double restitution[] = {0, 0.3, 1}, mu[] = {0, 0.05, 5, 0};
    static const int friction[] = {PM_FRICTION_SMOOTH, PM_FRICTION_COULOMB, PM_FRICTION_COULOMB,
                                   PM_FRICTION_ROUGH};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 3; i++)
            for (int n = 0; n < 20; n++) {
                scene *s = rod(check_random(0.1, 1.4), restitution[i], friction[k], mu[k], 1);
                const double v[] = {check_random(-2, 2), check_random(-6, -3), check_random(-2, 2)};
                const blow x = strike(s, v, 0);
                laws(s, &x, 0);
                EQUAL(x.jumped, 1);
                CHECK(s->w->impulses.slot[0] > 0);
                scene_free(s);
            }
}

/* A corner that parts already is not struck. */
static void parts_already(void)
{
    scene *s = rod(0.5, 0.5, PM_FRICTION_ROUGH, 0, 1);
    const double v[] = {1, 0.5, 0};
    const blow x = strike(s, v, 0);
    EQUAL(x.jumped, 0);
    for (int i = 0; i < 3; i++) EQUAL(x.after[i], v[i]);
    scene_free(s);
}

/* A flat rod: both ends at once, or one after the other. */
static void two_ends(void)
{
    static const double restitution[] = {0, 0.6, 1};
    for (int i = 0; i < 3; i++) {
        scene *s = rod(0, restitution[i], PM_FRICTION_SMOOTH, 0, 2);
        const double v[] = {0.4, -2, 0};
        blow x = strike(s, v, 0);
        EQUAL(x.jumped, 1);
        laws(s, &x, 0);
        NEAR(x.after[1], 2 * restitution[i], CLOSE);
        NEAR(x.after[2], 0, CLOSE);
        scene_free(s);
        for (int n = 0; n < 40; n++) {
            static const int friction[] = {PM_FRICTION_SMOOTH, PM_FRICTION_COULOMB, PM_FRICTION_ROUGH};
            s = rod(0, restitution[i], friction[n % 3], 0.3, 2);
            const double u[] = {check_random(-1, 1), check_random(-3, -1), check_random(-4, 4)};
            x = strike(s, u, 0);
            CHECK(x.jumped >= 1);
            laws(s, &x, 0);
            scene_free(s);
        }
    }
}

/* A rod that rests on two supports at -a and a is struck at its right end from above by a ball. */
static blow rod_on_supports(double a, double e, int friction, double impulse[3])
{
    const double half = 0.6;
    scene *s = scene_create();
    const int b = scene_body(s, 2, 2 * half * half / 3, 0, 0, 0), ball = scene_body(s, 0.5, 0, half, 0.1, 0);
    const int top = scene_line(s, scene_point(s, b, 0, 0), 0);
    for (int i = -1; i <= 1; i += 2) {
        const int support = scene_line(s, scene_point(s, PM_GROUND, 0, 0), 0);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, i * a, 0), 0), support, 0, 0,
                      friction, 0);
    }
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, ball, 0, 0), 0.1), top, 0, e,
                  PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    CHECK(scene_begin(s) == PM_OK);
    const double v[] = {0, 0, 0, 0, -3, 0};
    const blow x = strike(s, v, 3); /* both supports rest */
    EQUAL(x.jumped, 1);
    laws(s, &x, 3);
    for (int i = 0; i < 3; i++) impulse[i] = s->w->impulses.slot[2 * i];
    scene_free(s);
    return x;
}

static void resting_contact_joins(void)
{
    static const int friction[] = {PM_FRICTION_SMOOTH, PM_FRICTION_ROUGH};
    double p[3];
    for (int k = 0; k < 2; k++) {
        const double a = 0.4, e = 0.5, half = 0.6, i_support = 2 * half * half / 3 + 2 * a * a,
                     arm = half - a;
        blow x = rod_on_supports(a, e, friction[k], p);
        CHECK(p[0] == 0 && p[1] > 0 &&
              p[2] > 0); /* the near one is pressed, the far one rises and carries nothing */
        const double struck = (1 + e) * 3 / (1 / 0.5 + arm * arm / i_support);
        NEAR(p[2], struck, CLOSE);
        NEAR(x.after[2], -struck * arm / i_support, CLOSE);
        x = rod_on_supports(0.15, 0, friction[k],
                            p); /* within the middle third both could be pressed: one is enough */
        CHECK(p[1] > 0);
        x = rod_on_supports(0.7, 1, friction[k],
                            p); /* struck between the supports: nothing moves but the ball */
        CHECK(p[0] >= 0 && p[1] > 0);
        NEAR(x.after[4], 3, CLOSE);
        NEAR(x.after[1], 0, CLOSE);
        NEAR(x.after[2], 0, CLOSE);
    }
}

/* What touches without approaching rests, though it is not closed yet, as at the start of a run. */
static void touching_joins(void)
{
    scene *s = rod(0, 0.5, PM_FRICTION_SMOOTH, 0, 2);
    const double v[] = {0, -0.6,
                        -1}; /* about the left end, which the blow at the right end would press down */
    const blow x = strike(s, v, 0);
    EQUAL(x.jumped, 1);
    laws(s, &x, 1);
    NEAR(x.after[1], 0.3, CLOSE);
    NEAR(x.after[2], 0.5, CLOSE);
    scene_free(s);
}

/* A spinning ball that rolls from the blow on: that is where it comes to stick. */
static void sticks_by_a_blow(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.4, 0, 1, 0), center = scene_point(s, b, 0, 0);
    const int contact = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, center, 1), scene_floor(s, 0), 0, 0,
                                      PM_FRICTION_COULOMB, 5);
    scene_start_velocity(s, center, 0, -3);
    scene_start_omega(s, b, -1);
    scene_until(s, scene_on(s, PM_TRIGGER_STICK, contact), 1);
    const int t = scene_ask_measure(s, scene_time(s));
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, center, PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_NO_TIME_ROUTE);
    EQUAL(s->out[t], 0);
    NEAR(s->out[v], 2.0 / 7, CLOSE);
    scene_free(s);
}

/* ---- joints hold ---- */
static void pendulum_struck(void)
{
    for (int n = 0; n < 20; n++) {
        const double e = check_random(0, 1), place = check_random(-0.4, 0.6);
        scene *s = scene_create();
        const int b = scene_body(s, 2, 0.24, 0, -0.6, -acos(0.)),
                  ball = scene_body(s, 0.7, 0.01, -0.2, -0.6 - place, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.6, 0), scene_point(s, PM_GROUND, 0, 0), 0);
        const int face = scene_line(s, scene_point(s, b, 0, 0),
                                    2 * acos(0.)); /* its free side is on the left of the rod */
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, ball, 0, 0), 0.2), face, 0, e,
                      PM_FRICTION_ROUGH, 0);
        scene_until_time(s, 1);
        CHECK(scene_begin(s) == PM_OK);
        const double arm = 0.6 + place, v[] = {0.6 * 0.5, 0, 0.5, 4, 0, 1.5};
        const blow x = strike(s, v, 0);
        EQUAL(x.jumped, 1);
        laws(s, &x, 0);
        /* moment of momentum about the pin: kept, whatever the pin's impulse is */
        double h[2];
        for (int k = 0; k < 2; k++) {
            const double *u = k ? x.after : x.before;
            h[k] = 0.24 * u[2] + 2 * 0.6 * u[0] + 0.01 * u[5] + 0.7 * (arm * u[3] - 0.2 * u[4]);
        }
        NEAR(h[1], h[0], CLOSE);
        scene_free(s);
    }
}

/* ---- the sphere between two rough bars ---- */
static void never_wedged(void)
{
    for (double d = 0.1; d < 1.4; d += 0.25) { /* bars, in radii apart; beyond it would leave the bar */
        const double beta = asin(0.5 * d), k = (2 + 5 * cos(2 * beta)) / 7;
        scene *s = scene_create();
        const int b = scene_body(s, 3, 0.4 * 3, 0, 1, 0), g = scene_point(s, b, 0, 0);
        const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0, 0), scene_value(s, d),
                                  scene_value(s, 0), scene_value(s, -1));
        scene_contact(s, PM_CONTACT_PATTERN, scene_circle(s, g, 1), row, 0, 0, PM_FRICTION_ROUGH, 0);
        scene_start_omega(s, b, -1.5);
        const int hit = scene_on(s, PM_TRIGGER_STRIKE, 0), omega = scene_measure(s, PM_MEASURE_OMEGA, b);
        const int before = scene_ask_event(s, scene_read(s, omega), hit, 1, 1);
        const int after = scene_ask_event(s, scene_read(s, omega), hit, 1, 0);
        const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, 0));
        scene_until(s, hit, 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[after], k * s->out[before], 1e-10);
        NEAR(s->out[before], -sqrt(2.25 + 2 * 9.81 * (1 - cos(beta)) / 1.4), 1e-9);
        EQUAL(s->out[closed], 1); /* the bar behind is left at once and carries nothing in the blow */
        scene_free(s);
    }
}

/* Two rolling spheres: the floor's no-slip rows carry nothing in the blow between them. */
static void rolling_spheres(void)
{
    scene *s = scene_create();
    const double r = 0.2, v1 = 3, e = 0.8;
    int circle[2], line = scene_floor(s, 0);
    for (int i = 0; i < 2; i++) {
        const int b = scene_body(s, 1, 0.4 * r * r, 2 * r * i, r, 0);
        circle[i] = scene_circle(s, scene_point(s, b, 0, 0), r);
        scene_contact(s, PM_CONTACT_LINE, circle[i], line, 0, 0, PM_FRICTION_COULOMB, 0.3);
    }
    scene_contact(s, PM_CONTACT_CIRCLE, circle[0], circle[1], 1, e, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    const double v[] = {v1, 0, -v1 / r, 0, 0, 0};
    const blow x = strike(s, v, 3);
    laws(s, &x, 3);
    NEAR(x.after[0], 0.5 * (1 - e) * v1, CLOSE);
    NEAR(x.after[3], 0.5 * (1 + e) * v1, CLOSE);
    NEAR(x.after[2], -v1 / r, CLOSE); /* they slide now */
    NEAR(x.after[5], 0, CLOSE);
    EQUAL(s->w->state.slot[0].mode, PM_SLIDE_BACKWARD);
    EQUAL(s->w->state.slot[1].mode, PM_SLIDE_FORWARD);
    scene_free(s);
}

/* A row of balls at rest, struck at its end: together without restitution, never with more energy. */
static void row_of_balls(void)
{
    for (int n = 0; n < 3; n++) {
        scene *s = scene_create();
        int circle[4];
        for (int i = 0; i < 4; i++)
            circle[i] = scene_circle(s, scene_point(s, scene_body(s, 1 + i, 0.1, 0.4 * i, 0, 0), 0, 0), 0.2);
        for (int i = 0; i < 3; i++)
            scene_contact(s, PM_CONTACT_CIRCLE, circle[i], circle[i + 1], 1, 0.5 * n, PM_FRICTION_SMOOTH, 0);
        scene_until_time(s, 1);
        scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        CHECK(scene_begin(s) == PM_OK);
        const double v[12] = {2};
        const blow x = strike(s, v, 6);
        laws(s, &x, 6);
        if (n == 0)
            for (int i = 0; i < 4; i++) NEAR(x.after[3 * i], 0.2, CLOSE);
        scene_free(s);
    }
}

/* One contact carries all of the blow of two, and slides the other way after it; its own course would leave the other one
 * approaching.  The blow is that of the laws, at once; in a mirror, too. */
static void carried_by_one(void)
{
    static const double place[2][2] = {{0.107, -0.144}, {0.419, -0.129}}, angle[] = {-1.634, -0.938},
                        mu[] = {1.19, 0.69}, e[] = {0, 0.057};
    blow x[2];
    for (int k = 0; k < 2; k++) {
        const int flip = k ? -1 : 1;
        scene *s = scene_create();
        const int b = scene_body(s, 1.2, 0.0194, 0, 0, 0);
        for (int i = 0; i < 2; i++) {
            const double at = flip * place[i][0];
            const int line = scene_line(s, scene_point(s, PM_GROUND, at, place[i][1]), flip * angle[i]);
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, at, place[i][1]), 0), line, 1,
                          e[i], PM_FRICTION_COULOMB, mu[i]);
        }
        scene_until_time(s, 1);
        CHECK(scene_begin(s) == PM_OK);
        x[k] = strike(s, (double[]){-0.3675 * flip, 0.0821, -3.135 * flip}, 0);
        laws(s, &x[k], 0);
        scene_free(s);
    }
    for (int i = 0; i < 3; i++) NEAR(x[1].after[i], (i == 1 ? 1 : -1) * x[0].after[i], CLOSE);
}

/* A particle in the corner of two walls: each blow throws it at the other wall, a little slower, and it takes hundreds of
 * them. */
static void dies_out_at_once(void)
{
    const double opening = 0.02;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int b = scene_body(s, 1, 0, 0, 0, 0), c = scene_circle(s, scene_point(s, b, 0, 0), 0);
    scene_contact(s, PM_CONTACT_LINE, c, scene_floor(s, 0), 1, 0.9, PM_FRICTION_SMOOTH, 0);
    scene_contact(s, PM_CONTACT_LINE, c, scene_line(s, scene_point(s, PM_GROUND, 0, 0), opening - acos(-1.)),
                  1, 0.9, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    const blow x = strike(s, (double[]){-1, -0.03, 0}, 0);
    CHECK(x.jumped > 100);
    CHECK(kinetic(s->w, x.after) < kinetic(s->w, x.before));
    for (int i = 0; i < 2; i++) CHECK(normal_rate(s->w, i, x.after) > -CLOSE);
    scene_free(s);
}

int main(void)
{
    carried_by_one();
    dies_out_at_once();
    rod_corner();
    parts_already();
    two_ends();
    resting_contact_joins();
    touching_joins();
    sticks_by_a_blow();
    pendulum_struck();
    never_wedged();
    rolling_spheres();
    row_of_balls();
    return check_failures();
}
