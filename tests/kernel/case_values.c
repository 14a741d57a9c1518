/* Values of case after case in one workspace: those that a parameter reaches, through others too, follow it; numbers out of
 * bounds are told in every case, whether a parameter reaches them or not. */
#include "equations/case_values.h"

#include "check.h"
#include "equations/case.h"
#include "scene.h"
#include "state/workspace.h"

static const double first[] = {2, 0.5}, second[] = {3, 0.25}, negative[] = {-1, 0.25};

/* A body whose mass is 2 p0, by a value that reads a value, and whose inertia is p1. */
static scene *make_scene(double x, int *mass)
{
    scene *s = scene_create();
    const int p0 = scene_parameter(s), p1 = scene_parameter(s);
    *mass = scene_value_of(s, SCENE_PROGRAM(s, scene_v(p0), scene_k(s, 2), scene_op(PM_OP_MUL)));
    const int place = scene_value(s, x);
    SCENE_ROW(s, PM_TABLE_BODY, 1, *mass, p1, place, place, place);
    return s;
}

static void values_follow(void)
{
    int mass;
    scene *s = make_scene(0.7, &mass);
    if (CHECK(scene_open(s) == PM_OK)) {
        const double *cases[] = {first, second, first};
        for (int i = 0; i < 3; i++) {
            EQUAL(pm_case_begin(s->w, cases[i]), PM_OK);
            NEAR(s->w->numbers.value[mass], 2 * cases[i][0], 0);
            NEAR(s->w->numbers.inverse_mass[2], 1 / cases[i][1], 0);
            NEAR(s->w->numbers.value[PM_BODY_ROW(s->model, 0)[PM_BODY_X]], 0.7, 0);
        }
        EQUAL(pm_case_begin(s->w, negative), PM_BAD_VALUE);
        EQUAL(s->w->result.where.member, PM_BODY_MASS);
        NEAR(s->w->result.where.value, -2, 0);
        EQUAL(pm_case_begin(s->w, second), PM_OK);
    }
    scene_free(s);
}

static void constants_are_told_each_time(void)
{
    int mass;
    scene *s = make_scene(INFINITY, &mass);
    if (CHECK(scene_open(s) == PM_OK))
        for (int i = 0; i < 2; i++) {
            EQUAL(pm_case_begin(s->w, first), PM_BAD_VALUE);
            EQUAL(s->w->result.where.member, PM_BODY_X);
        }
    scene_free(s);
}

int main(void)
{
    values_follow();
    constants_are_told_each_time();
    return check_failures();
}
