/* What scenes of the path route are made of, and what they are asked. */
#ifndef PM_TEST_PATH_SCENES_H
#define PM_TEST_PATH_SCENES_H

#include "scene.h"
#include "state/route.h"

#define G 9.81
#define PI 3.14159265358979323846

static inline int used(const scene *s, int route) { return (s->count[PM_COUNT_ROUTES] >> route & 1) != 0; }

static inline int omega_of(scene *s, int body) { return scene_measure(s, PM_MEASURE_OMEGA, body); }
static inline int part(scene *s, int point, int which)
{
    return scene_part(s, PM_MEASURE_POSITION, point, which);
}
static inline int ground(scene *s, double x, double y) { return scene_point(s, PM_GROUND, x, y); }

/* A rod of length 1 and mass 2, pinned at its end in the origin, at `angle` from the x axis. */
static inline int pendulum_rod(scene *s, double angle)
{
    const int b = scene_body(s, 2, 2 / 12., 0.5 * cos(angle), 0.5 * sin(angle), angle);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), ground(s, 0, 0), 0);
    return b;
}

#endif
