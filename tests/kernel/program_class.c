/* Classes of programs: what they are functions of, how they grow with the kinetic energy, and what a shift does to
 * them; a round body may turn as it likes, others only whole turns. */
#include "expression/program_class.h"

#include "check.h"
#include "scene.h"
#include "scene/program_grade.h"
#include "scene/symmetry.h"

#define TURN (4 * acos(0.))

typedef struct rig {
    scene *s;
    int body, rim, time, x, norm, angle, omega, velocity, alpha, force, force_norm, normal, count, needed;
} rig;

/* A wheel that rolls on the level; its rim is not its mass centre where off != 0. */
static rig make_rig(double off)
{
    rig r = {.s = scene_create()};
    scene *s = r.s;
    r.body = scene_body(s, 2, 0.1, off, 0.3, 0);
    r.rim = scene_point(s, r.body, -off, 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, r.rim, 0.3), scene_floor(s, 0), 0);
    r.time = scene_time(s);
    r.x = scene_part(s, PM_MEASURE_POSITION, r.rim, PM_PART_X);
    r.norm = scene_part(s, PM_MEASURE_POSITION, r.rim, PM_PART_NORM);
    r.angle = scene_measure(s, PM_MEASURE_ANGLE, r.body);
    r.omega = scene_measure(s, PM_MEASURE_OMEGA, r.body);
    r.velocity = scene_part(s, PM_MEASURE_VELOCITY, r.rim, PM_PART_NORM);
    r.alpha = scene_measure(s, PM_MEASURE_ALPHA, r.body);
    r.force = scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_X);
    r.force_norm = scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_NORM);
    r.normal = scene_measure(s, PM_MEASURE_JOINT_NORMAL, 0);
    r.needed = scene_measure(s, PM_MEASURE_JOINT_FRICTION_NEEDED, 0);
    const int event = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, r.x, 1));
    r.count = scene_measure(s, PM_MEASURE_EVENT_COUNT, event);
    scene_until(s, event, 1);
    return r;
}

static scene_code k(rig *r, double x) { return scene_k(r->s, x); }
static scene_code op(int code) { return scene_op(code); }

/* A program a op b, or op a, of two measures. */
static int two(rig *r, int a, int b, int code)
{
    return SCENE_PROGRAM(r->s, scene_m(a), scene_m(b), op(code));
}
static int one(rig *r, int a, int code) { return SCENE_PROGRAM(r->s, scene_m(a), op(code)); }
static int with(rig *r, int a, double number, int code)
{
    return SCENE_PROGRAM(r->s, scene_m(a), k(r, number), op(code));
}

static void classes(void)
{
    rig r = make_rig(0);
    scene *s = r.s;
    const struct {
        int program, class, reads_time, discrete;
    } expected[] = {
        {SCENE_PROGRAM(s, k(&r, 1), k(&r, 2), op(PM_OP_ADD)), PM_CLASS_CONSTANT, 0, 0},
        {with(&r, r.time, 2, PM_OP_SUB), PM_CLASS_TIME, 1, 0},
        {with(&r, r.time, 2, PM_OP_MUL), PM_CLASS_TIME, 1, 0},
        {with(&r, r.time, 2, PM_OP_DIV), PM_CLASS_TIME, 1, 0},
        {SCENE_PROGRAM(s, k(&r, 2), scene_m(r.time), op(PM_OP_DIV)), PM_CLASS_MOTION, 1, 0},
        {two(&r, r.time, r.time, PM_OP_MUL), PM_CLASS_MOTION, 1, 0},
        {two(&r, r.time, r.x, PM_OP_ADD), PM_CLASS_MOTION, 1, 0},
        {one(&r, r.time, PM_OP_SIN), PM_CLASS_MOTION, 1, 0},
        {one(&r, r.time, PM_OP_NEG), PM_CLASS_TIME, 1, 0},
        {two(&r, r.x, r.angle, PM_OP_MUL), PM_CLASS_PLACE, 0, 0},
        {one(&r, r.angle, PM_OP_COS), PM_CLASS_PLACE, 0, 0},
        {two(&r, r.x, r.omega, PM_OP_ADD), PM_CLASS_MOTION, 0, 0},
        {with(&r, r.x, 1, PM_OP_GT), PM_CLASS_PLACE, 0, 1},
        {scene_read(s, r.count), PM_CLASS_MOTION, 0, 1},
        {two(&r, r.count, r.x, PM_OP_MUL), PM_CLASS_MOTION, 0, 0},
    };
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, expected[9].program), 1);
    if (CHECK(scene_open(s) == PM_OK))
        for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
            EQUAL(pm_program_grade_class(s->model, expected[i].program), expected[i].class);
            EQUAL(pm_program_class_reads_time(s->model, expected[i].program), expected[i].reads_time);
            EQUAL(pm_program_class_is_discrete(s->model, expected[i].program), expected[i].discrete);
        }
    scene_free(s);
}

static void growths(void)
{
    rig r = make_rig(0);
    scene *s = r.s;
    const struct {
        int program, growth;
    } expected[] = {
        {scene_read(s, r.x), PM_ENERGY_CLASS_NONE},
        {scene_read(s, r.omega), PM_ENERGY_CLASS_ROOT},
        {scene_read(s, r.velocity), PM_ENERGY_CLASS_ROOT},
        {scene_read(s, r.alpha), PM_ENERGY_CLASS_LINEAR},
        {scene_read(s, r.force), PM_ENERGY_CLASS_LINEAR},
        {scene_read(s, r.force_norm), PM_ENERGY_CLASS_CONVEX},
        {scene_read(s, r.needed), PM_ENERGY_CLASS_CONVEX},
        {scene_read(s, r.time), PM_ENERGY_CLASS_UNKNOWN},
        {scene_read(s, r.count), PM_ENERGY_CLASS_UNKNOWN},
        {with(&r, r.omega, 2, PM_OP_SUB), PM_ENERGY_CLASS_STEADY},
        {with(&r, r.alpha, 2, PM_OP_SUB), PM_ENERGY_CLASS_LINEAR},
        {with(&r, r.omega, 2, PM_OP_MUL), PM_ENERGY_CLASS_ROOT},
        {with(&r, r.force_norm, 2, PM_OP_SUB), PM_ENERGY_CLASS_CONVEX},
        {with(&r, r.force_norm, -2, PM_OP_MUL), PM_ENERGY_CLASS_UNKNOWN},
        {SCENE_PROGRAM(s, k(&r, 2), scene_m(r.force_norm), op(PM_OP_SUB)), PM_ENERGY_CLASS_UNKNOWN},
        {one(&r, r.force_norm, PM_OP_NEG), PM_ENERGY_CLASS_CONCAVE},
        {two(&r, r.omega, r.velocity, PM_OP_MUL), PM_ENERGY_CLASS_LINEAR},
        {two(&r, r.omega, r.velocity, PM_OP_DIV), PM_ENERGY_CLASS_NONE},
        {two(&r, r.omega, r.velocity, PM_OP_ADD), PM_ENERGY_CLASS_ROOT},
        {two(&r, r.omega, r.alpha, PM_OP_ADD), PM_ENERGY_CLASS_UNKNOWN},
        {two(&r, r.force, r.normal, PM_OP_DIV), PM_ENERGY_CLASS_UNKNOWN},
        {two(&r, r.force, r.normal, PM_OP_MAX), PM_ENERGY_CLASS_CONVEX},
        {two(&r, r.force, r.normal, PM_OP_MIN), PM_ENERGY_CLASS_CONCAVE},
        {two(&r, r.force_norm, r.normal, PM_OP_MIN), PM_ENERGY_CLASS_UNKNOWN},
        {one(&r, r.omega, PM_OP_ABS), PM_ENERGY_CLASS_ROOT},
        {one(&r, r.force, PM_OP_ABS), PM_ENERGY_CLASS_CONVEX},
        {one(&r, r.alpha, PM_OP_SIN), PM_ENERGY_CLASS_UNKNOWN},
        {one(&r, r.x, PM_OP_SIN), PM_ENERGY_CLASS_NONE},
        {SCENE_PROGRAM(s, scene_m(r.omega), k(&r, 1), k(&r, 2), op(PM_OP_SELECT)), PM_ENERGY_CLASS_UNKNOWN},
        {with(&r, r.omega, 1, PM_OP_GT), PM_ENERGY_CLASS_UNKNOWN},
    };
    if (CHECK(scene_open(s) == PM_OK))
        for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
            if (!CHECK(pm_program_grade_energy(s->model, expected[i].program) == expected[i].growth))
                fprintf(stderr, "program %d\n", (int)i);
    scene_free(s);
}

/* Along the level and a turn of any size: only a round body stays; across, nothing does. */
static void shifts(void)
{
    for (int round = 0; round < 2; round++) {
        rig r = make_rig(round ? 0 : 0.05);
        scene *s = r.s;
        const int p[] = {
            scene_read(s, r.x),
            with(&r, r.x, 3, PM_OP_MUL),
            with(&r, r.x, 4, PM_OP_DIV),
            SCENE_PROGRAM(s, k(&r, 2), scene_m(r.x), op(PM_OP_DIV)),
            scene_read(s, r.norm),
            scene_read(s, r.angle),
            SCENE_PROGRAM(s, scene_m(r.x), scene_m(r.angle), k(&r, 0.3), op(PM_OP_MUL), op(PM_OP_ADD)),
            one(&r, r.angle, PM_OP_SIN),
            scene_read(s, r.omega),
            scene_read(s, r.time),
            one(&r, r.x, PM_OP_NEG),
        };
        const double way = 0.6, turn[] = {-2}, turns[] = {-3 * TURN};
        const int known[] = {1, 1, 1, 0, 0, 1, 1, 0, 1, 0, 1};
        const double expected[] = {way, 3 * way, way / 4, 0, 0, turn[0], way + 0.3 * turn[0], 0, 0, 0, -way};
        double change;
        if (!CHECK(scene_begin(s) == PM_OK)) continue;
        const pm_symmetry_shift along = {{way, 0}, turn}, whole = {{way, 0}, turns},
                                across = {{0, way}, turns};
        EQUAL(pm_symmetry_holds(&s->w->frame, &along), round);
        EQUAL(pm_symmetry_holds(&s->w->frame, &whole), 1);
        EQUAL(pm_symmetry_holds(&s->w->frame, &across), 0);
        for (size_t i = 0; i < sizeof p / sizeof *p && round; i++) {
            if (!CHECK(pm_symmetry_program(&s->w->frame, &along, p[i], &change) == known[i]))
                fprintf(stderr, "program %d\n", (int)i);
            if (known[i]) NEAR(change, expected[i], 1e-15);
        }
        scene_free(s);
    }
}

/* What stands in the way of a shift: each element alone. */
static void obstacles(void)
{
    for (int i = 0; i < 8; i++) {
        rig r = make_rig(0);
        scene *s = r.s;
        const int g = r.rim, wall = scene_point(s, PM_GROUND, 3, 0), spot = scene_point(s, r.body, 0.1, 0);
        const int one_n = SCENE_PROGRAM(s, k(&r, 1));
        switch (i) {
        case 0: scene_force(s, PM_FORCE_SPRING, g, wall, 5, 1); break;
        case 1: scene_force(s, PM_FORCE_TORSION, r.body, PM_GROUND, 5, 0); break;
        case 2: scene_applied(s, spot, PM_GROUND, one_n, one_n); break;
        case 3: scene_applied(s, g, r.body, one_n, one_n); break;
        case 4: scene_applied(s, g, PM_GROUND, scene_read(s, r.x), one_n); break;
        case 5:
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0.3), scene_line(s, wall, 2), 0, 0,
                          PM_FRICTION_SMOOTH, 0);
            break;
        case 6: scene_applied(s, g, PM_GROUND, one_n, one_n); break;        /* does not mind */
        case 7: scene_couple(s, r.body, PM_GROUND, scene_read(s, r.omega)); /* nor does this */
        }
        const double turn[] = {-2};
        const pm_symmetry_shift along = {{0.6, 0}, turn};
        if (CHECK(scene_begin(s) == PM_OK) && !CHECK(pm_symmetry_holds(&s->w->frame, &along) == (i >= 6)))
            fprintf(stderr, "obstacle %d\n", i);
        scene_free(s);
    }
}

int main(void)
{
    classes();
    growths();
    shifts();
    obstacles();
    return check_failures();
}
