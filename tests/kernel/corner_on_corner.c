/* Corner on corner, while the edges from there lie on each other: either corner touches the other's edge, and both contacts are one
 * for an instant.  Which of them stays the slip decides. */
#include "check.h"
#include "scene.h"

#define TIME 2e-3

/* A box beside the face of the ground that goes up from its corner; the box is pushed against it, and turns so that they open
 * upwards.  It slides down, and the corner of the ground goes on along the box, or up, and that of the box along the face. */
typedef struct box {
    double mass, width, height, omega, push, mu, along;
} box;

enum { OF_BOX = 1, OF_GROUND = 2 };

static void touch(scene *s, const box *x, int side, int body, int which)
{
    const double quarter = acos(0.), up = 3;
    const int corner = scene_point(s, PM_GROUND, 0, 0),
              mark = scene_point(s, body, -side * x->width / 2, -x->height / 2);
    const int friction = x->mu > 0 ? PM_FRICTION_COULOMB : PM_FRICTION_SMOOTH;
    if (which == OF_BOX)
        scene_segment(s, scene_circle(s, mark, 0), scene_line(s, corner, -side * quarter), side > 0 ? -up : 0,
                      side > 0 ? 0 : up, 0, friction, x->mu);
    else
        scene_segment(s, scene_circle(s, corner, 0), scene_line(s, mark, side * quarter),
                      side > 0 ? 0 : -x->height, side > 0 ? x->height : 0, 0, friction, x->mu);
}

/* With these two contacts, or one; where its centre is after a while, and its angle. */
static void run(const box *x, int side, int first, int second, double *out)
{
    scene *s = scene_create();
    const double w = x->width, h = x->height;
    const int b = scene_body(s, x->mass, x->mass * (w * w + h * h) / 12, side * w / 2, h / 2, 0),
              g = scene_point(s, b, 0, 0);
    touch(s, x, side, b, first);
    if (second) touch(s, x, side, b, second);
    scene_applied(s, g, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, -side * x->push)),
                  SCENE_PROGRAM(s, scene_k(s, x->along)));
    scene_start_velocity(s, g, x->omega * side * h / 2, -x->omega * w / 2);
    scene_start_omega(s, b, -side * x->omega);
    scene_until_time(s, TIME);
    const int ask[] = {scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X)),
                       scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y)),
                       scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b))};
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < 3; i++) out[i] = s->out[ask[i]];
    scene_free(s);
}

/* As if there were only the contact that stays, whichever is written first. */
static void one_stays(void)
{
    const int side = check_random(-1, 1) > 0 ? 1 : -1, up = check_random(-1, 1) > 0;
    const double mass = check_random(0.5, 5);
    const box x = {mass,
                   check_random(0.05, 0.5),
                   check_random(0.05, 0.5),
                   check_random(0.5, 2),
                   mass * check_random(1, 5),
                   check_random(-0.1, 0.3),
                   up ? mass * check_random(20, 30) : 0};
    double one[3], both[3];
    run(&x, side, up ? OF_BOX : OF_GROUND, 0, one);
    for (int k = 0; k < 2; k++) {
        run(&x, side, k ? OF_BOX : OF_GROUND, k ? OF_GROUND : OF_BOX, both);
        for (int i = 0; i < 3; i++) NEAR(both[i], one[i], 1e-10);
    }
}

int main(void)
{
    for (int i = 0; i < 100; i++) one_stays();
    return check_failures();
}
