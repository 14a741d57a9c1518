/* Constraints of belts and cords, checked like those of joints and contacts. */
#include "check.h"
#include "constraint_check.h"
#include "elements/constraint.h"
#include "elements/joint.h"
#include "scene.h"
#include "state/workspace.h"

#define TWO_PI 6.283185307179586

/* The slack of a cord and its slip on a rim; its rates are those of its strands along their lines. */
static void check_cord(scene *s)
{
    pm_constraint row[2], strand[2];
    if (!open_case(s)) return;
    pm_workspace *w = s->w;
    look(w, NULL, 0);
    pm_contact_constraint_both(&w->frame, 0, s->model->contact_slot[0], 0, &row[0], &row[1]);
    pm_memory *memory = &w->state.memory[row[0].memory];
    for (int k = 0; k < 2; k++) {
        pm_constraint_kind(row[k].kind)->remember(&w->frame, &row[k], memory, 1);
        check_row(w, row[k], 1);
    }
    const double wrap = pm_constraint_cord_wrap(&w->frame, &row[0]);
    CHECK(wrap > 2 * TWO_PI && wrap < 3 * TWO_PI);
    pm_constraint_cord_strands(&row[0], strand);
    for (int k = 0; k < 2; k++) {
        pm_line_of_action one;
        pm_constraint_kind(strand[k].kind)->act(&w->frame, &strand[k], &one);
        memory->direction = atan2(one.direction[1], one.direction[0]);
        if (k == 0) memory->behind = memory->direction;
    }
    const double turned = (memory->direction - memory->behind) * (row[0].radius_rim < 0 ? -1 : 1);
    NEAR(remainder(wrap - turned, TWO_PI), 0, 1e-13);
}

/* What a belt drives with is half the difference of what its strands do: the same force, and the same couple on each body. */
static void check_belt(pm_workspace *w, const pm_constraint *belt, const pm_constraint strand[2])
{
    pm_line_of_action whole, of[2];
    pm_constraint_kind(belt->kind)->act(&w->frame, belt, &whole);
    for (int k = 0; k < 2; k++) pm_constraint_kind(strand[k].kind)->act(&w->frame, &strand[k], &of[k]);
    for (int body = 0; body < 2; body++) {
        double force[2] = {0}, moment = 0; /* about where the whole acts */
        for (int k = 0; k < 2; k++) {
            const double half = k == 0 ? 0.5 : -0.5;
            const double arm[2] = {of[k].at[0] - whole.at[0], of[k].at[1] - whole.at[1]};
            for (int i = 0; i < 2; i++) force[i] += half * of[k].direction[i];
            moment += half * pm_cross(arm, of[k].direction);
        }
        for (int i = 0; i < 2; i++) NEAR(force[i], whole.direction[i], 1e-14);
        NEAR(body == 0 ? moment : -moment, whole.couple[body], 1e-14);
    }
}

/* Two circles of a belt, which may be alike. */
static void belt_rows(int ground_side, double sense, double radius_a, double radius_b)
{
    pair x = make_pair(ground_side);
    const int a = scene_circle(x.s, x.point[0], radius_a), b = scene_circle(x.s, x.point[1], radius_b);
    scene_belt(x.s, PM_JOINT_BELT_GRIPS, a, b, sense, 30);
    scene_joint(x.s, PM_JOINT_BELT, a, b, sense);
    check_scene(x.s, 1);
    if (x.s->w) {
        pm_constraint belt[PM_JOINT_CONSTRAINTS], strand[PM_JOINT_CONSTRAINTS];
        look(x.s->w, NULL, 0);
        EQUAL(pm_joint_constraints(&x.s->w->frame, &x.s->w->state, 0, belt), 1);
        EQUAL(pm_joint_constraints(&x.s->w->frame, &x.s->w->state, 1, strand), 2);
        check_belt(x.s->w, belt, strand);
    }
    scene_free(x.s);
}

/* A cord over a rim that is on the ground, or on one of the bodies while an end is on the ground. */
static void cord_rows(int rim_on)
{
    pair x = make_pair(-1);
    const int sense[3] = {1, -1, rim_on == 0 ? 1 : -1};
    const int away = scene_point(x.s, PM_GROUND, 1.9, -2.3);
    const int ends[3][2] = {{x.point[0], x.point[1]}, {away, x.point[1]}, {x.point[0], away}};
    const int rim = scene_point(x.s, rim_on - 1 < 0 ? PM_GROUND : x.body[rim_on - 1], 0.4, 2.6);
    scene_cord_over(x.s, scene_circle(x.s, ends[rim_on][0], 0.11), scene_circle(x.s, ends[rim_on][1], 0.07),
                    scene_circle(x.s, rim, 0.13), sense, 2, 0.3, 0.2);
    check_cord(x.s);
    scene_free(x.s);
}

int main(void)
{
    for (int ground_side = -1; ground_side < 2; ground_side++) {
        belt_rows(ground_side, 1, 0.31, 0.17);
        belt_rows(ground_side, 1, 0.2, 0.2);
        belt_rows(ground_side, -1, 0.31, 0.17);
    }
    for (int rim_on = 0; rim_on < 3; rim_on++) cord_rows(rim_on);
    return check_failures();
}
