/* A contact is struck again and again, and no ratio of its flights has settled.  How the speeds of its blows shrink, and how its flights
 * do, tells whether an end of them is known.
 *
 * Pressed on evenly, flights shrink as the speeds do, by e; where nothing presses it, as by a spring at its rest, flights are alike while
 * speeds shrink by e.  What is pressed on more as it comes down, as bodies beside it slip, gains speed in flight: speeds and flights
 * shrink together by less. */
#include "events/bounce_series.h"
#include "check.h"
#include "events/event.h"
#include "scene.h"

/* Struck three times, each time at `speeds` of the speed before, after `flights` of the flight before. */
static int is_endless(double e, double speeds, double flights)
{
    scene *s = scene_create();
    const int ball = scene_body(s, 1, 0.1, 0, 1, 0),
              c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, ball, 0, 0), 0),
                                scene_floor(s, 0), 0, e, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    EQUAL(scene_begin(s), PM_OK);
    double flight = 1e-4, speed = 1e-3;
    for (int i = 0; i < 3; i++, flight *= flights, speed *= speeds) {
        pm_bounce_series_strike(s->w, c, speed);
        CHECK(!pm_bounce_series_is_settled(s->w, c));
        if (i < 2) CHECK(!pm_bounce_series_is_endless(s->w, c));
        if (i < 2) s->w->state.t += flight;
    }
    const int endless = pm_bounce_series_is_endless(s->w, c);
    scene_free(s);
    return endless;
}

int main(void)
{
    for (int i = 0; i < 500; i++) {
        const double e = check_random(0.1, 0.9), press = check_random(0.2, 1);
        EQUAL(is_endless(e, e, 1 - press * (1 - e)), 0);
        EQUAL(is_endless(e, e, 1 - check_random(-0.5, 0.09) * (1 - e)), 1);
        const double gain = check_random(e, 0.999);
        EQUAL(is_endless(e, gain, 1 - press * (1 - gain)), 0);
        EQUAL(is_endless(e, gain, 1 - check_random(-0.5, 0.09) * (1 - gain)), 1);
        EQUAL(is_endless(e, check_random(1.001, 1.1), check_random(1.001, 1.1)), 1);
    }
    return check_failures();
}
