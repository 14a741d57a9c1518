/* A wall at a right angle, as near as doubles are, throws what comes straight at it straight back: not by a rounding aside, of which
 * further blows among balls make twenty times as much each. */
#include "check.h"
#include "estimating.h"
#include "scene.h"
#include "scene_elements.h"

/* Thrown along an axis at a wall across it, 1 m away; the wall's direction has that angle, and its left is where the ball is. */
static void straight_back(double angle, int route)
{
    const double right[2] = {sin(angle), -cos(angle)}; /* from the ball to the wall, but for rounding */
    const double to[2] = {round(right[0]), round(right[1])};
    scene *s = estimating(1e-10);
    const int b = scene_body(s, 1, 0, 0, 0, 0), g = scene_point(s, b, 0, 0);
    scene_start_velocity(s, g, 3 * to[0], 3 * to[1]);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0),
                  scene_line(s, scene_point(s, PM_GROUND, to[0], to[1]), angle), 0, 0.7, PM_FRICTION_SMOOTH,
                  0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_until_time(s, 0.5);
    int v[2];
    for (int k = 0; k < 2; k++)
        v[k] = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, k ? PM_PART_Y : PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_OK);
    const int along = to[0] == 0;
    NEAR(s->out[v[along]], -0.7 * 3 * to[along], 1e-12);
    CHECK(s->out[v[!along]] == 0);
    scene_free(s);
}

int main(void)
{
    static const int route[] = {PM_ROUTE_UNIFORM, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int k = 0; k < 3; k++)
        for (int quarter = -4; quarter <= 4; quarter++) straight_back(quarter * M_PI_2, route[k]);
    return check_failures();
}
