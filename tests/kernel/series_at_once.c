/* Contacts that are struck at once, again and again: their series has a ratio where two of them agree, not where there is but one. */
#include "check.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "scene.h"

enum { BLOWS = 6, MOST = 6 };

/* A plate on n feet. */
static scene *feet(int n)
{
    scene *s = scene_create();
    const int plate = scene_body(s, 1, 0.1, 0, 1, 0);
    for (int i = 0; i < n; i++)
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, plate, i, -0.5), 0),
                      scene_floor(s, 0), 0, 0.5, PM_FRICTION_COULOMB, 0.2);
    scene_until_time(s, 1);
    return s;
}

/* All feet are struck together, after flights that shrink by these ratios. */
static void together(int n, const double ratio[BLOWS])
{
    double flight = 1e-3;
    scene *s = feet(n);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    pm_bounce_series_begin(w);
    for (int k = 0; k < BLOWS; k++) {
        const int settled = k > 2 && fabs(ratio[k] - ratio[k - 1]) < 1e-6;
        w->state.t += flight;
        for (int i = 0; i < n; i++) pm_bounce_series_strike(w, i, 1);
        for (int i = 0; i < n; i++) {
            EQUAL(pm_bounce_series_is_settled(w, i), settled);
            EQUAL(pm_bounce_series_is_of_several(w, i), settled && n > 1);
        }
        if (settled) NEAR(w->event->series[0].left, flight * ratio[k] / (1 - ratio[k]), 1e-6 * flight);
        if (k + 1 < BLOWS) flight *= ratio[k + 1];
    }
    scene_free(s);
}

int main(void)
{
    for (int n = 1; n <= MOST; n++) {
        together(n, (double[BLOWS]){1, 0.5, 0.5, 0.5, 0.5, 0.5});
        together(n, (double[BLOWS]){1, 0.7, 0.3, 0.6, 0.9, 0.4});
        together(n, (double[BLOWS]){1, 0.7, 0.3, 0.6, 0.6, 0.6});
    }
    return check_failures();
}
