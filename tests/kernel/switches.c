/* Forces that switch by the motion: against closed forms, where a place is passed, regions however thin, a speed changes sign, a blow
 * reverses it, from rest on a switch, and where a switch holds the motion; and forces along a line by programs. */
#include "check.h"
#include "scene.h"
#include "state/workspace.h"

#define CASES 40
#define G 9.81

/* A measure that is 1 where a program became positive. */
static int scene_side(scene *s, int program)
{
    const int event = SCENE_ROW(s, PM_TABLE_EVENT, 0, PM_EFFECT_SWITCH);
    scene_trigger(s, PM_TRIGGER_RISE, event, program, PM_NONE);
    scene_trigger(s, PM_TRIGGER_FALL, event, program, PM_NONE);
    return scene_measure(s, PM_MEASURE_EVENT_SIDE, event);
}

/* A particle, and what is asked of it. */
typedef struct particle {
    scene *s;
    int point, place, speed, out_place, out_speed;
} particle;

static particle particle_at(double y, double vy, int route)
{
    particle p = {.s = scene_create()};
    *scene_setting(p.s, PM_SETTING_ROUTE) = route;
    scene_set(p.s, PM_SETTING_GRAVITY_Y, 0);
    p.point = scene_point(p.s, scene_body(p.s, 1, 0, 0, y, 0), 0, 0);
    p.place = scene_part(p.s, PM_MEASURE_POSITION, p.point, PM_PART_Y);
    p.speed = scene_part(p.s, PM_MEASURE_VELOCITY, p.point, PM_PART_Y);
    p.out_place = scene_ask_measure(p.s, p.place);
    p.out_speed = scene_ask_measure(p.s, p.speed);
    scene_start_velocity(p.s, p.point, 0, vy);
    return p;
}

static void push(particle *p, int program)
{
    scene_applied(p->s, p->point, PM_GROUND, SCENE_PROGRAM(p->s, scene_k(p->s, 0)), program);
}

static void ends_at(particle *p, double t, double place, double speed, double close)
{
    scene_until_time(p->s, t);
    EQUAL(scene_run(p->s, NULL), PM_OK);
    NEAR(p->s->out[p->out_place], place, close);
    NEAR(p->s->out[p->out_speed], speed, close);
    scene_free(p->s);
}

/* -F beyond a place: there and back, and on with the speed it came with. */
static void a_place(int route)
{
    for (int i = 0; i < CASES; i++) {
        const double knot = check_random(0.2, 2), force = check_random(1, 5), v = check_random(0.5, 2);
        const double back = knot / v + 2 * v / force, t = back + check_random(0.1, 1);
        particle p = particle_at(0, v, route);
        const int side = scene_side(p.s, scene_minus(p.s, p.place, knot));
        push(&p, SCENE_PROGRAM(p.s, scene_m(side), scene_k(p.s, -force), scene_op(PM_OP_MUL)));
        ends_at(&p, t, knot - v * (t - back), -v, 1e-9);
    }
}

/* Weight and drag c v |v|, |v| by the side of v: from rest, which is on the switch, and thrown upwards. */
static void drag(double up, int route)
{
    const double c = 0.05, last = sqrt(G / c), rate = sqrt(G * c), t = 2;
    particle p = particle_at(0, up, route);
    const scene_code v = scene_m(p.speed), side = scene_m(scene_side(p.s, scene_read(p.s, p.speed)));
    push(&p, SCENE_PROGRAM(p.s, scene_k(p.s, -G), scene_k(p.s, c), v, scene_op(PM_OP_MUL), v,
                           scene_op(PM_OP_MUL), side, scene_k(p.s, 2), scene_op(PM_OP_MUL), scene_k(p.s, 1),
                           scene_op(PM_OP_SUB), scene_op(PM_OP_MUL), scene_op(PM_OP_SUB)));
    const double top = atan(up / last) / rate, height = log(1 + up * up / (last * last)) / (2 * c);
    ends_at(&p, t, height - log(cosh(rate * (t - top))) / c, -last * tanh(rate * (t - top)), 1e-9);
}

/* The same thrown so fast, through air so thin, that at the top a rounding of the time is one of the speed. */
static void thin_air(int route)
{
    for (int i = 0; i < CASES; i++) {
        const double c = pow(10, check_random(-3, -1)), last = sqrt(G / c), up = last * check_random(4, 40);
        particle p = particle_at(0, up, route);
        const scene_code v = scene_m(p.speed), side = scene_m(scene_side(p.s, scene_read(p.s, p.speed)));
        push(&p,
             SCENE_PROGRAM(p.s, scene_k(p.s, -G), scene_k(p.s, c), v, scene_op(PM_OP_MUL), v,
                           scene_op(PM_OP_MUL), side, scene_k(p.s, 2), scene_op(PM_OP_MUL), scene_k(p.s, 1),
                           scene_op(PM_OP_SUB), scene_op(PM_OP_MUL), scene_op(PM_OP_SUB)));
        const double rate = sqrt(G * c), top = atan(up / last) / rate, t = top + 0.5 / rate;
        const double height = log(1 + up * up / (last * last)) / (2 * c);
        scene_until_time(p.s, t);
        EQUAL(scene_run(p.s, NULL), PM_OK);
        NEAR(p.s->out[p.out_place], height - log(cosh(0.5)) / c, 1e-8 * height);
        NEAR(p.s->out[p.out_speed], -last * tanh(0.5), 1e-8 * last);
        scene_free(p.s);
    }
}

/* A force over a width of 1 m that is next to nothing: it does its work, or throws the particle back from within. */
static void thin_region(double thinnest, int route)
{
    for (int i = 0; i < CASES; i++) {
        const double width = pow(10, check_random(thinnest, -1)), end = 1 + width, v = check_random(0.5, 20);
        const double gain = check_random(0, 1) < 0.5 ? -check_random(1.2, 4) : check_random(-0.8, 3);
        particle p = particle_at(0, v, route);
        const int from = scene_side(p.s, scene_minus(p.s, p.place, 1)),
                  to = scene_side(p.s, scene_minus(p.s, p.place, end));
        push(&p, SCENE_PROGRAM(p.s, scene_k(p.s, gain * v * v / 2 / (end - 1)), scene_m(from), scene_m(to),
                               scene_op(PM_OP_SUB), scene_op(PM_OP_MUL)));
        scene_until_time(p.s, 1.5 / v);
        EQUAL(scene_run(p.s, NULL), PM_OK);
        NEAR(p.s->out[p.out_speed], gain < -1 ? -v : v * sqrt(1 + gain), (1e-7 + 1e-15 / width) * v);
        scene_free(p.s);
    }
}

/* At rest for a long time, then F, and -F beyond a place: there, and back to where it came from; places are passed within fewer digits
 * than they have, since the time has few. */
static void late(double quarters, int route)
{
    const double begin = 900, force = 1e7, quarter = sqrt(1 / force), v = force * quarter;
    particle p = particle_at(0, 0, route);
    const int side = scene_side(p.s, scene_minus(p.s, p.place, 0.5));
    const scene_code time = scene_m(scene_time(p.s));
    scene_when(p.s, PM_TRIGGER_RISE, scene_minus(p.s, scene_time(p.s), begin));
    push(&p, SCENE_PROGRAM(p.s, time, scene_k(p.s, begin), scene_op(PM_OP_GE), scene_k(p.s, force),
                           scene_op(PM_OP_MUL), scene_m(side), scene_k(p.s, -2 * force), scene_op(PM_OP_MUL),
                           scene_op(PM_OP_ADD)));
    const double from_top = quarters - 2, u = quarters < 3 ? from_top : 4 - quarters; /* of a quarter */
    ends_at(&p, begin + quarters * quarter, quarters < 3 ? 1 - 0.5 * u * u : 0.5 * u * u, -v * u, 1e-6 * v);
}

/* Thrown over a switch by no more than rounding, and back: by the force of the other side, not by 4 N. */
static void turned_back(int route)
{
    for (int i = 0; i < CASES; i++) {
        particle p = particle_at(0, pow(10, check_random(-14, -9)), route);
        const int side = scene_side(p.s, scene_read(p.s, p.place));
        push(&p, SCENE_PROGRAM(p.s, scene_k(p.s, -1), scene_m(side), scene_k(p.s, 3), scene_op(PM_OP_MUL),
                               scene_op(PM_OP_SUB)));
        ends_at(&p, 1, -0.5, -1, 1e-8);
    }
}

/* Falls by 2 m/s^2, is thrown back by an elastic blow, and rises against 6 m/s^2. */
static void a_blow(int route)
{
    particle p = particle_at(1, 0, route);
    const int side = scene_side(p.s, scene_read(p.s, p.speed));
    push(&p, SCENE_PROGRAM(p.s, scene_k(p.s, -2), scene_m(side), scene_k(p.s, 4), scene_op(PM_OP_MUL),
                           scene_op(PM_OP_SUB)));
    const int circle = scene_circle(p.s, p.point, 0), floor = scene_floor(p.s, 0);
    scene_contact(p.s, PM_CONTACT_LINE, circle, floor, 0, 1, PM_FRICTION_SMOOTH, 0);
    const double struck = 1, speed = 2, rises = speed / 6, t = struck + rises + 0.2;
    ends_at(&p, t, speed * rises / 2 - 0.5 * 2 * 0.2 * 0.2, -2 * 0.2, 1e-9);
}

/* 1 - 2 side(v - 0.5) holds v there. */
static void held(int route)
{
    particle p = particle_at(0, 0, route);
    const int side = scene_side(p.s, scene_minus(p.s, p.speed, 0.5));
    push(&p, SCENE_PROGRAM(p.s, scene_k(p.s, 1), scene_m(side), scene_k(p.s, 2), scene_op(PM_OP_MUL),
                           scene_op(PM_OP_SUB)));
    scene_until_time(p.s, 2);
    EQUAL(scene_run(p.s, NULL), PM_ALTERNATES);
    EQUAL(p.s->where[PM_WHERE_TABLE], PM_TABLE_EVENT);
    scene_free(p.s);
}

/* The force of a spring as a program of its stretch; the rate of the stretch. */
static void line(int program, int route)
{
    particle p = particle_at(2, 0.3, route);
    const int origin = scene_point(p.s, PM_GROUND, 0, 0);
    int force;
    if (program) {
        force =
            SCENE_ROW(p.s, PM_TABLE_FORCE, PM_FORCE_LINE, p.point, origin, PM_NONE, PM_NONE, 0, PM_NONE, 0);
        const int stretch = scene_measure(p.s, PM_MEASURE_FORCE_STRETCH, force);
        const int pull = SCENE_PROGRAM(p.s, scene_m(stretch), scene_k(p.s, 1.5), scene_op(PM_OP_SUB),
                                       scene_k(p.s, 4), scene_op(PM_OP_MUL));
        scene_cell(p.s, PM_TABLE_FORCE, force, PM_FORCE_PROGRAM_X, pull);
    } else {
        force = scene_force(p.s, PM_FORCE_SPRING, p.point, origin, 4, 1.5);
    }
    const int rate = scene_ask_measure(p.s, scene_measure(p.s, PM_MEASURE_FORCE_RATE, force));
    const double t = 3, y = 0.5 * cos(2 * t) + 0.15 * sin(2 * t), v = -sin(2 * t) + 0.3 * cos(2 * t);
    scene_until_time(p.s, t);
    EQUAL(scene_run(p.s, NULL), PM_OK);
    NEAR(p.s->out[p.out_place], 1.5 + y, 1e-9);
    NEAR(p.s->out[p.out_speed], v, 1e-9);
    NEAR(p.s->out[rate], v, 1e-9);
    scene_free(p.s);
}

/* -k sqrt(y) beyond 0, a root that begins and ends there: out with the speed it came with. */
static void a_root(int route)
{
    for (int i = 0; i < CASES / 4; i++) {
        const double k = pow(10, check_random(0, 3)), v = check_random(0.5, 5), whole = 1.5 * 0.5 * v * v / k;
        const double turn = pow(whole, 2.0 / 3), part = tgamma(5.0 / 3) * tgamma(0.5) / tgamma(7.0 / 6);
        particle p = particle_at(-0.5, v, route);
        push(&p, SCENE_PROGRAM(p.s, scene_k(p.s, -k), scene_m(p.place), scene_k(p.s, 0), scene_op(PM_OP_MAX),
                               scene_op(PM_OP_SQRT), scene_op(PM_OP_MUL)));
        scene_until_time(p.s, 1 / v + 2 * turn / v * part);
        EQUAL(scene_run(p.s, NULL), PM_OK);
        NEAR(p.s->out[p.out_speed], -v, 1e-6 * v);
        NEAR(p.s->out[p.out_place], -0.5, 1e-6);
        scene_free(p.s);
    }
}

/* A force F / cosh^2(y - knot / width), narrow beside the way of a step: its work tells the speed. */
static void a_peak(int route)
{
    for (int i = 0; i < CASES; i++) {
        const double knot = check_random(1, 9), width = pow(10, check_random(-5, -1)),
                     v = check_random(0.5, 3);
        const double force = check_random(-0.1, 0.3) * v * v / width;
        particle p = particle_at(0, v, route);
        const scene_code y = scene_m(p.place), k = scene_k(p.s, knot), d = scene_k(p.s, width);
        const scene_code sub = scene_op(PM_OP_SUB), div = scene_op(PM_OP_DIV), e = scene_op(PM_OP_EXP);
        push(&p, SCENE_PROGRAM(p.s, scene_k(p.s, 4 * force), y, k, sub, d, div, e, k, y, sub, d, div, e,
                               scene_op(PM_OP_ADD), scene_k(p.s, 2), scene_op(PM_OP_POW), div));
        const int there = scene_when(p.s, PM_TRIGGER_RISE, scene_minus(p.s, p.place, 10));
        scene_until(p.s, there, 1);
        EQUAL(scene_run(p.s, NULL), PM_OK);
        const double work = force * width * (tanh((10 - knot) / width) + tanh(knot / width));
        NEAR(p.s->out[p.out_speed], sqrt(v * v + 2 * work), 1e-8);
        scene_free(p.s);
    }
}

/* A disk lies on a belt that begins to run with v: it gets v / 3, by friction in v / 3 mu g, or if it is rough by an impulse.  Then
 * the belt runs back: what slips the one way slips the other. */
static void a_belt(int rough, double back, int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double r = 0.2, m = 3, v = 1.5, mu = 0.4, knots[] = {0.3, back};
    const int b = scene_body(s, m, 0.5 * m * r * r, 0, r, 0), g = scene_point(s, b, 0, 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, r), scene_floor(s, 0), 0, 0,
                                rough ? PM_FRICTION_ROUGH : PM_FRICTION_COULOMB, rough ? 0 : mu);
    const scene_code time = scene_m(scene_time(s));
    for (int i = 0; i < 2; i++) scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), knots[i]));
    scene_cell(s, PM_TABLE_CONTACT, c, PM_CONTACT_SPEED,
               SCENE_PROGRAM(s, time, scene_k(s, knots[0]), scene_op(PM_OP_GE), scene_k(s, v),
                             scene_op(PM_OP_MUL), time, scene_k(s, knots[1]), scene_op(PM_OP_GE),
                             scene_k(s, -2 * v), scene_op(PM_OP_MUL), scene_op(PM_OP_ADD)));
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    const int speed = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X));
    const int lost = scene_ask_measure(s, scene_measure(s, PM_MEASURE_LOST, PM_NONE));
    scene_until_time(s, 2);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double a = mu * G, caught = rough ? 0 : v / (3 * a), first = fmin(caught, back - knots[0]);
    const double u = rough ? v / 3 : a * first, turns = rough ? 0 : (u + v / 3) / a;
    const double way = 0.5 * u * first + u * (back - knots[0] - first);
    NEAR(s->out[x], way + 0.5 * (u - v / 3) * turns - v / 3 * (2 - back - turns), 1e-7);
    NEAR(s->out[speed], -v / 3, 1e-7);
    CHECK(rough || s->out[lost] == 0);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-7);
    scene_free(s);
}

int main(void)
{
    static const int route[] = {PM_ROUTE_RK, PM_ROUTE_IDA};
    late(2.5, PM_ROUTE_RK); /* IDA takes no steps that are so short beside the time */
    late(3.5, PM_ROUTE_RK);
    for (int i = 0; i < 2; i++) {
        a_place(route[i]);
        drag(0, route[i]);
        drag(7, route[i]);
        thin_air(route[i]);
        turned_back(route[i]);
        thin_region(i == 0 ? -10 : -7, route[i]);
        a_blow(route[i]);
        held(route[i]);
        line(0, route[i]);
        line(1, route[i]);
        a_peak(route[i]);
        a_root(route[i]);
        for (int rough = 0; rough < 2; rough++) {
            a_belt(rough, 1, route[i]);
            a_belt(rough, 0.35, route[i]);
        }
    }
    return check_failures();
}
