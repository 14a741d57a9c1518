/* Blows of contacts whose constraints depend on each other at their place, though not next to it: none ends singular, and no
 * order in the file decides. */
#include <math.h>

#include "check.h"
#include "elements/constraint.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "struck.h"

#define RIGHT_ANGLE 1.5707963267948966

/* A body meets walls with points around its centre of mass, at these angles from straight below.  All normals go through the
 * centre: two of them span the others, until it has turned. */
static void add_walls(scene *s, int n, const double *angle, double e)
{
    const double reach = 0.7;
    const int body = scene_body(s, 2, 0.3, 0, 0, 0);
    for (int i = 0; i < n; i++) {
        const double x = reach * sin(angle[i]), y = -reach * cos(angle[i]);
        const int wall = scene_line(s, scene_point(s, PM_GROUND, x, y), angle[i]);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, body, x, y), 0), wall, 0, e,
                      PM_FRICTION_SMOOTH, 0);
    }
}

static void begin(scene *s)
{
    scene_until_time(s, 1);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    CHECK(scene_begin(s) == PM_OK);
}

/* It comes straight down and turns: it goes up as it came, and turns on. */
static void goes_up(int n, const double *angle, double e)
{
    scene *s = scene_create();
    add_walls(s, n, angle, e);
    begin(s);
    const double v[] = {0, -1.3, 0.4};
    const blow x = strike(s, v, 0);
    EQUAL(x.jumped, 1);
    laws(s, &x, 0);
    NEAR(x.after[0], 0, CLOSE);
    NEAR(x.after[1], 1.3 * e, CLOSE);
    NEAR(x.after[2], 0.4, CLOSE);
    scene_free(s);
}

/* Another body strikes at the same instant, far from it, and slides on: its friction is its own. */
static void beside_one_that_slides(void)
{
    static const double side = 2 * RIGHT_ANGLE / 3, mu = 0.2;
    const double angle[] = {0, side, -side};
    scene *s = scene_create();
    add_walls(s, 3, angle, 0);
    const int other = scene_body(s, 0.8, 0.1, 5, -1, 0);
    const int floor = scene_line(s, scene_point(s, PM_GROUND, 5, -1), 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, other, 0, 0), 0), floor, 0, 0,
                  PM_FRICTION_COULOMB, mu);
    begin(s);
    const double v[] = {0, -1.3, 0.4, 1.5, -2, 0};
    const blow x = strike(s, v, 0);
    EQUAL(x.jumped, 1);
    laws(s, &x, 0);
    for (int i = 0; i < 2; i++) NEAR(x.after[i], 0, CLOSE);
    NEAR(x.after[3], 1.5 - 2 * mu, CLOSE);
    NEAR(x.after[4], 0, CLOSE);
    scene_free(s);
}

static void three_through_a_point(void)
{
    static const double side = 2 * RIGHT_ANGLE / 3;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            double angle[3] = {0, 0, 0};
            angle[i] += side;
            angle[k] -= side;
            if (i != k) goes_up(3, angle, 0);
            if (i != k) goes_up(3, angle, 0.5);
        }
}

/* Two of the walls are all but one: that they differ holds nothing where others hold clearly. */
static void two_all_but_one(void)
{
    static const double side = 1.1;
    static const double angles[][4] = {{-2e-7, 2e-7, side, -side},
                                       {side, 2e-7, -2e-7, -side},
                                       {2e-7, side, -side, -2e-7},
                                       {side, -side, -2e-7, 2e-7}};
    for (int i = 0; i < 4; i++) {
        goes_up(4, angles[i], 0);
        goes_up(4, angles[i], 0.4);
    }
}

int main(void)
{
    three_through_a_point();
    two_all_but_one();
    beside_one_that_slides();
    return check_failures();
}
