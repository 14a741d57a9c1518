/* Actions of events, what is asked beside them, and the ledgers that close. */
#ifndef ACTIONS_H
#define ACTIONS_H

#include "check.h"
#include "scene.h"

static inline int action(scene *s, int kind, int event, int table, int a, int x, int y)
{
    return SCENE_ROW(s, PM_TABLE_ACTION, kind, event, table, a, x, y);
}

static inline void add(scene *s, int event, int table, int row)
{
    action(s, PM_ACTION_ADD, event, table, row, PM_NONE, PM_NONE);
}

static inline void take(scene *s, int event, int table, int row)
{
    action(s, PM_ACTION_REMOVE, event, table, row, PM_NONE, PM_NONE);
}

static inline int number(scene *s, double x) { return SCENE_PROGRAM(s, scene_k(s, x)); }

static inline void strike(scene *s, int event, int point, double x, double y)
{
    action(s, PM_ACTION_IMPULSE, event, PM_NONE, point, number(s, x), number(s, y));
}

static inline void turn(scene *s, int event, int body, double x)
{
    action(s, PM_ACTION_ANGULAR, event, PM_NONE, body, number(s, x), PM_NONE);
}

static inline void work(scene *s, int event, int body, double x)
{
    action(s, PM_ACTION_WORK, event, PM_NONE, body, number(s, x), PM_NONE);
}

static inline int start_event(scene *s) { return scene_on(s, PM_TRIGGER_START, PM_NONE); }

static inline int at_time(scene *s, double t)
{
    return scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), t));
}

static inline int ask_part(scene *s, int kind, int a, int part)
{
    return scene_ask_measure(s, scene_part(s, kind, a, part));
}

static inline int ask(scene *s, int kind, int a) { return ask_part(s, kind, a, PM_PART_NONE); }

static inline int ask_on(scene *s, int joint, int body)
{
    return scene_ask_measure(
        s, scene_measure_with(s, PM_MEASURE_JOINT_IMPULSE, joint, PM_PART_X, PM_MEASURE_ON, body));
}

static inline void closes(const scene *s)
{
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9);
    CHECK(s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-9);
}

#endif
