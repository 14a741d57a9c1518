/* How the tests of constant accelerations run a case. */
#ifndef TEST_UNIFORM_H
#define TEST_UNIFORM_H

#include "check.h"
#include "scene.h"
#include "state/route.h"

#define G 9.81
#define CLOSE 1e-12

/* The case runs, by constant accelerations throughout. */
static inline int runs_uniformly(scene *s)
{
    scene_route(s, PM_ROUTE_UNIFORM, 1e-11);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(s->audit[PM_AUDIT_ENERGY] < CLOSE && s->audit[PM_AUDIT_MOMENTUM] < CLOSE);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < CLOSE);
    return s->status == PM_OK && CHECK(s->count[PM_COUNT_ROUTE] == PM_ROUTE_UNIFORM);
}

#endif
