/* constraint_cord.c - a cord from circle a over a rim to circle b, which may slip on the rim (capstan).
 *
 * Its strands, from a to the rim and from there to b, are those of constraint_strand.c, as if the cord did not slip: C_1 and C_2
 * is what they are slack.  With T_1 and T_2 their tensions
 *   cord    C = C_1 + C_2          what the cord is slack;             reaction R = (T_1 + T_2) / 2
 *   slip    S = (C_1 - C_2) / 2    what has passed from 1 to 2;        reaction F = T_1 - T_2, the friction
 * so that T_1 = R + F/2 and T_2 = R - F/2.  A cord without mass that slips along a wrap of angle beta has T_2 = T_1 e^(mu beta)
 * where it passes from 1 to 2 (Euler, Eytelwein), and less of a difference where it holds:
 *   |F| <= 2 tanh(mu beta / 2) R
 * This is Coulomb's law, with a coefficient that goes with the wrap; so such a cord is a contact with friction. */
#include <float.h>
#include <math.h>

#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

void pm_constraint_cord_strands(const pm_constraint *c, pm_constraint strand[2])
{
    for (int k = 0; k < 2; k++) {
        strand[k] = *c;
        strand[k].kind = PM_CONSTRAINT_STRAND;
        strand[k].over = 0;
    }
    strand[0].body[1] = strand[1].body[0] = c->body[2];
    strand[0].radius_b = strand[1].radius_a = c->radius_rim;
    for (int k = 0; k < 2; k++) strand[0].b[k] = strand[1].a[k] = c->rim[k];
}

void pm_constraint_cord_tensions(const pm_constraint *c, double tension[2])
{
    const int slip = c->kind == PM_CONSTRAINT_CORD_SLIP;
    tension[0] = slip ? 0.5 : 1;
    tension[1] = slip ? -0.5 : 1;
}

/* Both strands, evaluated but for the anchor, and their directions. */
static void look(const pm_frame *frame, const pm_constraint *c, pm_constraint strand[2], double direction[2])
{
    const pm_memory *memory = &frame->memory[c->memory];
    pm_constraint_cord_strands(c, strand);
    pm_constraint_strand_look(frame, &strand[0], memory->direction, &direction[0]);
    pm_constraint_strand_look(frame, &strand[1], memory->behind, &direction[1]);
}

static double wrap_between(const pm_constraint *c, const double direction[2])
{
    return c->radius_rim < 0 ? direction[0] - direction[1] : direction[1] - direction[0];
}

double pm_constraint_cord_wrap(const pm_frame *frame, const pm_constraint *c)
{
    pm_constraint strand[2];
    double direction[2];
    look(frame, c, strand, direction);
    return wrap_between(c, direction);
}

double pm_constraint_cord_grip(double coefficient, double wrap)
{
    return 2 * tanh(0.5 * coefficient * fmax(wrap, 0));
}

/* g, gamma and the Jacobian: of each strand times its tension. */
static void add(const pm_constraint strand[2], pm_constraint *c)
{
    static const int place[2][2] = {{0, 2}, {2, 1}};
    double tension[2];
    pm_constraint_cord_tensions(c, tension);
    c->g = tension[0] * strand[0].g + tension[1] * strand[1].g;
    c->gamma = tension[0] * strand[0].gamma + tension[1] * strand[1].gamma;
    for (int k = 0; k < PM_CONSTRAINT_COORDINATES; k++) c->j[k] = 0;
    for (int n = 0; n < 2; n++)
        for (int k = 0; k < 6; k++) c->j[3 * place[n][k / 3] + k % 3] += tension[n] * strand[n].j[k];
}

/* While it slips the friction that rides on it goes with the wrap. */
static void evaluate(const pm_frame *frame, pm_constraint *c)
{
    pm_constraint strand[2];
    double direction[2];
    look(frame, c, strand, direction);
    add(strand, c);
    c->g += frame->memory[c->memory].anchor;
    if (c->slide == 0) return;
    c->slide =
        copysign(fmax(pm_constraint_cord_grip(c->value, wrap_between(c, direction)), DBL_MIN), c->slide);
}

static void evaluate_slip(const pm_frame *frame, pm_constraint *c)
{
    pm_constraint strand[2];
    double direction[2];
    look(frame, c, strand, direction);
    add(strand, c);
    c->g += frame->memory[c->memory].slip;
}

/* As drawn it is wrapped by less than a full turn, and by the turns that are given beyond it. */
static double wrap_as_drawn(const pm_constraint *c, const double direction[2])
{
    const double turn = 2 * M_PI;
    double wrap = fmod(wrap_between(c, direction), turn);
    if (wrap < 0) wrap += turn;
    if (wrap > turn * (1 - PM_WRAP_NOTHING)) wrap -= turn;
    return wrap + turn * c->turns;
}

static void remember(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    pm_constraint strand[2], own = *c;
    double direction[2];
    look(frame, c, strand, direction);
    if (anchor_too) {
        direction[0] -= 2 * M_PI * round(direction[0] / (2 * M_PI));
        const double wrap = wrap_as_drawn(c, direction);
        pm_constraint_strand_look(frame, &strand[0], direction[0], &direction[0]);
        direction[1] = direction[0] + (c->radius_rim < 0 ? -wrap : wrap);
        pm_constraint_strand_look(frame, &strand[1], direction[1], &direction[1]);
        add(strand, &own);
        memory->anchor = -own.g;
    }
    memory->direction = direction[0];
    memory->behind = direction[1];
}

/* From here on it holds. */
static void remember_slip(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    pm_constraint strand[2], own = *c;
    double direction[2];
    look(frame, c, strand, direction);
    add(strand, &own);
    if (anchor_too) memory->slip = -own.g;
    memory->direction = direction[0];
    memory->behind = direction[1];
}

/* Its first strand: what asks for all of its lines asks its strands. */
static void act(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    pm_constraint strand[2];
    pm_constraint_cord_strands(c, strand);
    pm_constraint_strand.act(frame, &strand[0], x);
}

static int steady(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    pm_constraint strand[2];
    pm_constraint_cord_strands(c, strand);
    return pm_constraint_strand.steady(frame, &strand[0], x) &&
           pm_constraint_strand.steady(frame, &strand[1], x);
}

static void bound(const pm_frame *frame, const pm_constraint *c, const double *a, double h,
                  pm_constraint_bounds *x)
{
    pm_constraint strand[2];
    pm_constraint_bounds of[2];
    pm_constraint_cord_strands(c, strand);
    for (int k = 0; k < 2; k++) pm_constraint_strand.bound(frame, &strand[k], a, h, &of[k]);
    *x = (pm_constraint_bounds){of[0].bend + of[1].bend, of[0].rate + of[1].rate, 0};
}

const pm_constraint_ops pm_constraint_cord = {
    .evaluate = evaluate, .act = act, .remember = remember, .steady = steady, .bound = bound};
const pm_constraint_ops pm_constraint_cord_slip = {
    .evaluate = evaluate_slip, .act = act, .remember = remember_slip, .steady = steady};
