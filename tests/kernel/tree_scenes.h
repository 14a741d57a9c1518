/* Bodies as a tree of joints: chains, plates, planks, wheels, sliders and loops. */
#ifndef TREE_SCENES_H
#define TREE_SCENES_H

#include "scene.h"

static inline int rod(scene *s, double x, double y, double angle, double length, double mass)
{
    const double c = cos(angle), d = sin(angle);
    return scene_body(s, mass, mass * length * length / 12, x + 0.5 * length * c, y + 0.5 * length * d,
                      angle);
}

static inline void pin(scene *s, int a, double ax, double ay, int b, double bx, double by)
{
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, ax, ay), scene_point(s, b, bx, by), 0);
}

/* Three rods; the second pin has its child as second partner. */
static inline scene *pinned(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0, 0, 0.3, 1, 1), b = rod(s, cos(0.3), sin(0.3), -0.8, 0.7, 2);
    const int c = rod(s, cos(0.3) + 0.7 * cos(0.8), sin(0.3) - 0.7 * sin(0.8), 2, 0.5, 0.5);
    pin(s, a, -0.5, 0, PM_GROUND, 0, 0);
    pin(s, a, 0.5, 0, b, -0.35, 0);
    pin(s, c, -0.25, 0, b, 0.35, 0);
    const int bob = scene_body(s, 0.3, 0, 0.4, 0.6, 0); /* a particle on the second rod */
    pin(s, bob, 0, 0, b, 0.1, 0.2);
    return s;
}

/* A wheel on a tilted line of a swinging plate, and what is welded to it. */
static inline scene *on_plate(int line_first)
{
    scene *s = scene_create();
    const double tilt = 0.4;
    const int plate = scene_body(s, 3, 0.4, 0, 0, 0.1);
    const int wheel = scene_body(s, 1, 0.05, 0.2, 0.5, 0.7), fin = scene_body(s, 0.2, 0.01, 0.25, 0.6, 1);
    pin(s, plate, -0.6, 0.1, PM_GROUND, -0.6, 0.1);
    const int line = scene_line(s, scene_point(s, plate, 0.1, 0.05), tilt);
    const int circle = scene_circle(s, scene_point(s, wheel, 0.02, 0.01), 0.25);
    scene_joint(s, PM_JOINT_ROLLING_LINE, circle, line, 0);
    if (line_first)
        scene_joint(s, PM_JOINT_WELD, scene_point(s, fin, 0.1, 0), scene_point(s, wheel, 0, 0.2), 0.3);
    else
        scene_joint(s, PM_JOINT_WELD, scene_point(s, wheel, 0, 0.2), scene_point(s, fin, 0.1, 0), -0.3);
    return s;
}

/* A plank that rolls on a wheel, itself rolling on the ground: the line belongs to the child. */
static inline scene *plank(void)
{
    scene *s = scene_create();
    const int wheel = scene_body(s, 2, 0.08, 0, 0.3, 0), board = scene_body(s, 1, 0.5, 0.1, 0.65, 0.1);
    const int circle = scene_circle(s, scene_point(s, wheel, 0, 0), 0.3);
    scene_joint(s, PM_JOINT_ROLLING_LINE, circle, scene_floor(s, 0.05), 0);
    const double down = acos(-1.);
    scene_joint(s, PM_JOINT_ROLLING_LINE, circle, scene_line(s, scene_point(s, board, 0, -0.05), down), 0);
    return s;
}

/* Circle on circle: side 1 outside, -1 inside; a third one on the second, with the child as b. */
static inline scene *circles(double side)
{
    scene *s = scene_create();
    const double big = 1, small = 0.3, third = 0.2, first = big + side * small;
    const int a = scene_body(s, 1, 0.03, first * cos(0.7), first * sin(0.7), 0.2);
    const int b =
        scene_body(s, 0.5, 0.01, first * cos(0.7) + 0.5 * cos(2.), first * sin(0.7) + 0.5 * sin(2.), 0);
    const int fixed = scene_circle(s, scene_point(s, PM_GROUND, 0, 0), big);
    const int moving = scene_circle(s, scene_point(s, a, 0, 0), small);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, moving, fixed, side);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, moving, scene_circle(s, scene_point(s, b, 0.02, 0), third), 1);
    return s;
}

/* A block that keeps its direction on a line of a moving rod, or carries the line of which a rod holds the point. */
static inline scene *sliders(int block_first)
{
    scene *s = scene_create();
    const int arm = rod(s, 0, 0, 0.5, 2, 1);
    const int block = scene_body(s, 2, 0.1, 1.1 * cos(0.5), 1.1 * sin(0.5), 0.8);
    pin(s, arm, -1, 0, PM_GROUND, 0, 0);
    if (block_first)
        scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, block, 0.05, 0.02),
                    scene_line(s, scene_point(s, arm, 0, 0.1), 0.2), 0.3);
    else
        scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, arm, 0.1, 0.05),
                    scene_line(s, scene_point(s, block, 0, 0.1), 0.2), -0.3);
    return s;
}

static inline scene *slider_crank(void)
{
    scene *s = scene_create();
    const double at = 0.7, swing = -asin(0.1 / 0.3 * sin(at));
    const int crank = rod(s, 0, 0, at, 0.1, 0.2),
              link = rod(s, 0.1 * cos(at), 0.1 * sin(at), swing, 0.3, 0.2);
    const int piston = scene_body(s, 0.4, 0, 0.1 * cos(at) + 0.3 * cos(swing), 0, 0);
    pin(s, crank, -0.05, 0, PM_GROUND, 0, 0);
    pin(s, crank, 0.05, 0, link, -0.15, 0);
    pin(s, link, 0.15, 0, piston, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER, scene_point(s, piston, 0, 0), scene_floor(s, 0), 0);
    scene_start_omega(s, crank, 10);
    return s;
}

static inline scene *four_bar(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0, 0, 1.2, 0.4, 1), c = rod(s, 1, 0, 1.9, 0.8, 1);
    const int b = rod(s, 0.4 * cos(1.2), 0.4 * sin(1.2), 0.4, 0.9, 2);
    pin(s, a, -0.2, 0, PM_GROUND, 0, 0);
    pin(s, c, -0.4, 0, PM_GROUND, 1, 0);
    pin(s, a, 0.2, 0, b, -0.45, 0);
    pin(s, b, 0.45, 0, c, 0.4, 0);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, scene_body(s, 0.5, 0.02, 0.7, 1.6, 0), 0.1, 0),
                scene_point(s, b, 0, 0.3), 0.8);
    return s;
}

/* On links: a particle, a rod on it, and on the rod another particle and a rod that is pinned to a block.  `turned`: each link
 * names its partners the other way round. */
static inline scene *linked(int turned)
{
    scene *s = scene_create();
    const int p = scene_body(s, 0.7, 0, 0.6, -0.8, 0), bar = rod(s, 0.9, -1.5, 0.3, 0.8, 1.1),
              bob = scene_body(s, 0.4, 0, 2.1, -1.9, 0), block = scene_body(s, 0.5, 0.02, 1.2, -2.2, 0.5);
    const int joined[4][2] = {{scene_point(s, p, 0, 0), scene_point(s, PM_GROUND, 0, 0)},
                              {scene_point(s, bar, -0.3, 0.1), scene_point(s, p, 0, 0)},
                              {scene_point(s, bob, 0, 0), scene_point(s, bar, 0.4, 0)},
                              {scene_point(s, block, 0.1, 0.05), scene_point(s, bar, 0, -0.1)}};
    static const double length[4] = {1, 0.7, 0.75, 0.65};
    for (int i = 0; i < 4; i++) {
        const int first = i % 2 == turned;
        scene_joint(s, PM_JOINT_LINK, joined[i][!first], joined[i][first], length[i]);
    }
    pin(s, rod(s, 1.2 + 0.3, -2.2, -1.1, 0.6, 0.3), -0.3, 0, block, 0.3 * cos(0.5), -0.3 * sin(0.5));
    return s;
}

/* Particles, each on a link from the one before. */
static inline scene *row_on_links(int n)
{
    scene *s = scene_create();
    int before = scene_point(s, PM_GROUND, 0, 0);
    for (int i = 1; i <= n; i++) {
        const int next = scene_point(s, scene_body(s, 0.5, 0, i, 0.3 * (i % 2), 0), 0, 0);
        scene_joint(s, PM_JOINT_LINK, before, next, 1.05);
        before = next;
    }
    return s;
}

/* Two particles and a rod, each on a link. */
static inline scene *bobs(void)
{
    scene *s = scene_create();
    const int a = scene_body(s, 0.7, 0, 0.6, -0.8, 0), b = scene_body(s, 0.4, 0, 1.1, -1.2, 0),
              bar = rod(s, 1.4, -1.8, 0.3, 0.8, 1.1);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, a, 0, 0), scene_point(s, PM_GROUND, 0, 0), 1);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, a, 0, 0), scene_point(s, b, 0, 0), 0.6);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, bar, -0.3, 0.1), scene_point(s, b, 0, 0), 0.7);
    return s;
}

/* Three bodies in a loop of pins, or of a wheel, a rod and a block on the ground. */
static inline scene *loop_of_three(int wheel)
{
    scene *s = scene_create();
    const int first = scene_body(s, 1, 0.02, 0, wheel ? 0.2 : 0, 0.3);
    const int bar = rod(s, 0.2 * cos(0.3), (wheel ? 0.2 : 0) + 0.2 * sin(0.3), 0.1, 0.9, 2);
    const double x = 0.2 * cos(0.3) + 0.9 * cos(0.1), y = (wheel ? 0.2 : 0) + 0.2 * sin(0.3) + 0.9 * sin(0.1);
    const int last = scene_body(s, 0.5, 0.01, x, y, 0.4);
    if (wheel) {
        const int circle = scene_circle(s, scene_point(s, first, 0, 0), 0.2);
        scene_joint(s, PM_JOINT_ROLLING_LINE, circle, scene_floor(s, 0), 0);
        scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, last, 0.05, 0),
                    scene_line(s, scene_point(s, PM_GROUND, x + 0.05 * cos(0.4), y + 0.05 * sin(0.4)), 0.5),
                    -0.1);
    } else {
        pin(s, first, -0.1, 0.05, PM_GROUND, -0.1 * cos(0.3) - 0.05 * sin(0.3),
            -0.1 * sin(0.3) + 0.05 * cos(0.3));
        pin(s, last, 0.3, -0.4, PM_GROUND, x + 0.3 * cos(0.4) + 0.4 * sin(0.4),
            y + 0.3 * sin(0.4) - 0.4 * cos(0.4));
    }
    pin(s, first, 0.2, 0, bar, -0.45, 0);
    pin(s, last, 0, 0, bar, 0.45, 0);
    return s;
}

/* A frame of four rods, closed last by a weld, that swings as one body. */
static inline scene *frame(void)
{
    scene *s = scene_create();
    const double x[] = {0, 1, 1.2, 0, 0}, y[] = {0, 0.2, 0.9, 0, 0.8};
    const int end[] = {1, 2, 4, 4};
    int body[4];
    double angle[4], length[4];
    for (int i = 0; i < 4; i++) {
        angle[i] = atan2(y[end[i]] - y[i], x[end[i]] - x[i]);
        length[i] = hypot(y[end[i]] - y[i], x[end[i]] - x[i]);
        body[i] = rod(s, x[i], y[i], angle[i], length[i], 1 + 0.3 * i);
    }
    pin(s, body[0], -length[0] / 2, 0, PM_GROUND, 0, 0);
    for (int i = 0; i < 2; i++) pin(s, body[i], length[i] / 2, 0, body[i + 1], -length[i + 1] / 2, 0);
    pin(s, body[3], -length[3] / 2, 0, body[0], -length[0] / 2, 0);
    scene_joint(s, PM_JOINT_WELD, scene_point(s, body[2], length[2] / 2, 0),
                scene_point(s, body[3], length[3] / 2, 0), angle[2] - angle[3]);
    return s;
}

static inline scene *free_bodies(void)
{
    scene *s = scene_create();
    scene_body(s, 1, 0.1, 0, 0, 0.3);
    scene_body(s, 2, 0, 1, 0, 0);
    scene_body(s, 1, 0.2, 3, 1, 0);
    return s;
}

#endif
