/* path.h - the configuration path of a phase with one degree of freedom, as route_path.c and its parts share it. */
#ifndef PM_PATH_H
#define PM_PATH_H

#include "numerics/chebyshev_nodes.h"
#include "numerics/lanes.h"
#include "state/evidence.h"
#include "state/workspace.h"
#include "tree/tree.h"

/* A place on the path: the configuration, and the velocities that go with a unit rate of the driver. */
typedef struct pm_place {
    double *y;               /* [n] tree coordinates */
    double *slope;           /* [n] dy/du */
    double *q;               /* [nq] */
    double *tangent;         /* [nq] dq/du */
    double *rate;            /* [nz_controlled] of the running integrals, by u */
    double *pose;            /* [nbody][5] of the frame */
    double *bend;            /* [nq] dtangent/du, where no constraint closes a loop */
    double *arm;             /* [nbody][PM_TREE_ARM] the levers of the tree that reactions go by, likewise */
    int determined;          /* by the constraints: not a place on a bridge */
    double mass;             /* generalised: T = mass (du/dt)^2 / 2 */
    double change;           /* tangent . M bend: half of dmass/du */
    double potential, force; /* V, and the generalised force of all applied forces */
    double kinetic;          /* T, once the work is known */
} pm_place;

enum pm_path_clock {
    PM_CLOCK_NONE = 0,   /* nobody asks for the time */
    PM_CLOCK_PLAIN = 1,  /* dt/du is smooth over the step */
    PM_CLOCK_LEAVES = 2, /* the step begins at rest: dt/du = g / sqrt(u - u0) */
    PM_CLOCK_RESTS = 3   /* the step ends at rest: dt/du = g / sqrt(u1 - u) */
};

enum { PM_BRIDGE_PLACES = 12 };

/* path_bridge.c: the branch next to a singular position, as polynomials of the driver. */
typedef struct pm_bridge {
    double centre, reach;          /* of the driver; reach 0: there is none */
    int has_known;                 /* a place that the constraints determine: the last one */
    double known;                  /* its driver value */
    double *known_y, *known_slope; /* [n] */
    double *c;                     /* [PM_BRIDGE_PLACES][n] coefficients */
    double *y, *slope, *bend;      /* [n] scratch: where the polynomial is read */
} pm_bridge;

/* path_clock.c: what only the nodes decide. */
enum {
    PM_CLOCK_FINE = PM_NODES_CLOCK - 1, /* the last fine node */
    PM_CLOCK_PAIRS = PM_CLOCK_FINE / 4  /* of odd multiples of an angle, or of nodes on one side, at most */
};
typedef struct pm_clock_table {
    /* what the coarse nodes on one side, with those on the other added or taken off, give at the fine nodes between */
    pm_lanes same_9[5][PM_CLOCK_PAIRS], other_9[4][PM_CLOCK_PAIRS];
    pm_lanes same_17[9][PM_CLOCK_PAIRS], other_17[8][PM_CLOCK_PAIRS];
    pm_lanes cosine[PM_CLOCK_FINE / 2][PM_CLOCK_PAIRS]; /* of a node's odd multiples */
} pm_clock_table;

/* path_rigid.c: an open tree in which one rigid group moves. */
typedef struct pm_rigid_body {
    int body;
    int rotates;          /* with the group */
    int holds;            /* its reactions go by levers */
    double angle;         /* against the first body */
    double mass, inertia; /* inertia 0: it does not rotate */
    pm_lanes weight;
    pm_lanes d, lever,
        rotation; /* in the axes of the first body: from its mark to the mass centre, from there to the mark on
                                 what carries it; cosine and sine of the angle */
} pm_rigid_body;

typedef struct pm_rigid {
    int n; /* bodies; 0: the tree is none such */
    pm_rigid_body *body;
    const struct pm_tree_node *first;
    int rotates;
    int weights_alone; /* act on it */
    double fixed;      /* angle of what it moves on */
    pm_lanes from;     /* the mark there */
    pm_lanes line;     /* direction of its line, in the scene, or in the axes of the first body */
    double angle;      /* of the first body, where it does not rotate */
    pm_lanes rotation; /* its cosine and sine */
    double potential;  /* of the weight of the fixed bodies */
} pm_rigid;

/* The time along the step (path_clock.c). */
typedef struct pm_clock {
    int kind;                      /* enum pm_path_clock */
    double t0;                     /* s, at the begin of the step */
    double late;                   /* s, what rounding has left out of t0: it is made up for */
    double rate;                   /* 1; of a coarse run, what errors that are all alike would make of it */
    double unresolved;             /* s, since the run began: what the nodes of the steps leave out */
    double greatest;               /* s, of that, in one step; in steps that repeat, together */
    double tail;                   /* of the clock of the step that was tried before */
    double length;                 /* of that step */
    double longer;                 /* tail of the longer step that was tried before it */
    double series[PM_NODES_CLOCK]; /* Chebyshev coefficients of the smooth part of dt/du */
    int terms;                     /* of them: how many matter */
    pm_clock_table table;
    double error; /* s */
} pm_clock;

/* path_error_time.c: a state of the step beside the one that the frame looks at. */
typedef struct pm_path_aside {
    pm_frame kept, own; /* the frame while it looks there; its arrays then */
    pm_state state;
    double *y; /* [nq] coordinates of the one it looked at */
} pm_path_aside;

typedef struct pm_path {
    int n;         /* tree coordinates of the phase */
    int driver;    /* the one that is the path parameter u */
    double sense;  /* +1 or -1: which way it goes */
    double u0, h;  /* the last step: u = u0 + sense x, x from 0 to h */
    double energy; /* T + V - (work of forces without potential): constant */
    int at_rest;   /* the step begins at rest */
    int balanced;  /* it begins in equilibrium, too: it takes for ever to leave it */
    int fresh;     /* no step of the phase has been taken yet */
    pm_clock clock;
    int by_work; /* T by the work of all forces, not by their potential: the better of both in this step */
    double force[PM_NODES_MOST];     /* generalised, at the nodes, the way it goes */
    const pm_chebyshev_nodes *nodes; /* of the step: its node k is node[k * every] */
    int every;
    int looked_at; /* the node that was looked at last */
    double safe;   /* length up to which steps are taken even if their nodes do not resolve what is sampled */
    double most;   /* length that the nodes of the last steps resolved; INFINITY: any did */
    pm_place begin; /* of a phase that has been planned */
    pm_place node[PM_NODES_MOST], spare;
    int node_driver; /* driver and sense of the step in the nodes */
    double node_sense;
    int repeats; /* the phase that has been planned begins like the one step in the nodes, but for a shift */
    int halved;  /* the step in the nodes is not taken: a part of it is tried */
    int filled;  /* the nodes hold the places of a step of length h already */
    double *inertia; /* [nbody] of the phase on an open tree */
    pm_bridge bridge;
    pm_rigid rigid;
    pm_loops loop;  /* constraints that the tree does not solve */
    double *weight; /* [nz_controlled] z at the begin of the step */
    double *work;   /* [nz_controlled] z somewhere in the step */
    int *column;    /* [n] pivots */
    pm_path_aside aside;
    double error; /* of T, J */
    double ended; /* T at the end of the last phase, before its blows; 0: none has ended since the step */
    double least, lowest;      /* T of the step, of the phase */
    double way;                /* of the driver since the phase began, or since the last lap */
    double impulse[PM_LEDGER]; /* what the ledger of the outer impulses exceeds the momenta by */
} pm_path;

/* path_clock.c: the step begins at time t, where the last one ended at s. */
void pm_path_clock_begin(pm_path *p, double t, double s);

/* path_place.c: the place at driver value u; place->y holds a guess on entry. */
int pm_path_place(pm_workspace *w, double u, pm_place *place);
/* The place at the tree coordinates place->y, given by some rate; PM_SINGULAR where the path has no direction. */
int pm_path_look(pm_workspace *w, pm_place *place);
/* path_motion.c: makes the frame, which looks at a place that the constraints determine, DYNAMIC.  along[nq]: velocities
 * at any rate of the driver. */
int pm_path_accelerate(pm_workspace *w, const double *along);
/* The same at any state of the last step; by the saddle point where constraints close loops. */
int pm_path_react(pm_workspace *w);
/* path_open.c: pm_path_accelerate for a place of an open tree, at the rate that goes with its T; the frame looks at it. */
void pm_path_open_accelerate(pm_workspace *w, const pm_place *place);
/* Such a place at place->y, the one coordinate; the frame has its forces.  pm_path_open_begin comes before, once a phase, where
 * the frame looks at the state. */
void pm_path_open_begin(pm_workspace *w);
void pm_path_open_place(pm_workspace *w, pm_place *place);
/* The force along the place and its potential, the rates of the running integrals; the frame looks at unit rate. */
void pm_path_measure_forces(pm_workspace *w, pm_place *place);
/* Chooses the coordinate that moves most as driver, unless the present one still does, and gives the place by it. */
int pm_path_drive(pm_workspace *w, pm_place *place);

/* Closes the loops at a first place, its driver kept, as exactly as at all places that follow: the energies do not know what
 * forces would do on what is left.  A place that the constraints do not determine well stays as it is. */
int pm_path_meet(pm_workspace *w, pm_place *place);

/* path_step.c: a step from node 0, at most `full` long, into w->path. */
int pm_path_take_step(pm_workspace *w, double full);
/* path_cycle.c: whether p->begin is like node 0, and all nodes are determined. */
int pm_path_cycle(const pm_workspace *w);
/* The last step once more from p->begin, where T is `kinetic`: places and T at all nodes. */
void pm_path_cycle_of(const pm_model *model, pm_path *p, double kinetic);
/* The place at the fraction s of the filled step, with its T, in w->path->spare. */
int pm_path_inside(pm_workspace *w, double s);
/* The running integrals at the fraction s of the step. */
void pm_path_integrals(const pm_model *model, const pm_path *p, double s, double *z);
/* What forces without potential have done. */
double pm_path_work(const pm_model *model, const double *z);
/* What the perturbation that waits (w->request) makes of velocities[nq] where the frame looks, which then has these: > 0 on
 * its side. */
double pm_path_requested(pm_workspace *w, const double *velocity);
static inline pm_place *pm_path_node(pm_path *p, int k) { return &p->node[k * p->every]; }

/* ---- path_bridge.c: places next to a singular position, and at it ---- */
/* A phase begins, or another driver describes the path. */
void pm_path_bridge_forget(pm_path *p);
/* A place at u that the constraints determine well. */
void pm_path_bridge_determined(pm_path *p, double u, const pm_place *place);
/* The coordinates, their slopes and the pose of the frame at u, which the constraints determine badly or not at all.
 * PM_SINGULAR or PM_ASSEMBLY where the branch cannot be followed. */
int pm_path_bridge_place(pm_workspace *w, double u, pm_place *place);
/* Accelerations at the frame (its forces are known) from the branch, reactions left open; 0 if there is no bridge. */
int pm_path_bridge_accelerate(pm_workspace *w);

/* ---- path_clock.c: the time along a step ---- */
/* The table of a path that has been created; all zero before. */
void pm_path_clock_fill_table(pm_clock_table *table);
/* Makes the clock of a step whose nodes are filled; 0 if they do not resolve it: its highest coefficients exceed `most`. */
int pm_path_clock_set(pm_path *p, int clock, double most);
/* Time at the fraction s of the step; from one to another, as it was before both were rounded. */
double pm_path_clock_at(const pm_path *p, double s);
double pm_path_clock_between(const pm_path *p, double from, double to);
/* What rounding has left out of the time t at the fraction s of the step. */
double pm_path_clock_left(const pm_path *p, double t, double s);

/* ---- path_rigid.c: an open tree of one coordinate in which all that moves is one rigid group ---- */
/* Whether the tree is such a one; p->rigid is made for the phase then, where the frame looks. */
int pm_path_rigid_build(pm_workspace *w);
/* All of the place at coordinate u but the coordinate.  The frame looks at it where other forces than weights act. */
void pm_path_rigid_place(const pm_workspace *w, double u, pm_place *place);

/* ---- path_begin.c ---- */
/* The operations of the route (state/route.h). */
int pm_path_applies(const pm_workspace *w);
int pm_path_prepare(pm_workspace *w);
int pm_path_begin(pm_workspace *w);
/* What the generalised force at x would be if the forces of the frame were along the motion. */
double pm_path_force_size(const pm_frame *frame, const pm_place *x);

/* ---- path_check.c: a step has ended at w->state, where the frame looks: notes the evidence of it in the ledger ---- */
void pm_path_check(pm_workspace *w);

/* ---- path_error.c: what rounding makes of the answers of a run along paths: no coarse run is needed ---- */
/* The error of T at the begin of a path phase, from that at the end of the phase before it. */
void pm_path_error_begin(pm_workspace *w);
/* The phase has ended where the frame looks, before the blows of the instant. */
void pm_path_error_end(pm_workspace *w);
/* The error of T, J, where the step ends with `kinetic`, J. */
double pm_path_error_after(const struct pm_path *path, double kinetic);
/* What the steps leave out of the time, s: many are off to either side, and leave a part of the sum; one may leave most of it. */
double pm_path_error_unresolved(const pm_clock *clock);
/* After a step that ends with `kinetic`. */
void pm_path_error_step(pm_workspace *w, double kinetic);
/* T passed a barrier at `distance` above it, or reversed as much below. */
void pm_path_error_barrier(pm_evidence *evidence, const struct pm_path *path, double distance);
/* Tells the error of out[column], the value of the program at the frame, if it is known. */
void pm_path_error_answer(pm_workspace *w, int ask, int column, int program, double value);

/* A step has been sampled: how near to zero the functions come that do not fire by place. */
void pm_path_error_sampled(pm_workspace *w);
/* The margin of these in a pass; trigger_scale[ntrigger] natural sizes. */
pm_closest pm_path_error_margin(const pm_model *model, const pm_pass *pass, const double *trigger_scale);

/* Once per model: do places alone, or the time alone, decide when what matters to the answers happens, but for events that are
 * counted and no more? */
int pm_path_error_by_places(const pm_model *m);

/* ---- path_error_time.c: where the time sets an instant, or is asked ---- */
/* Memory of a path that has been created. */
int pm_path_aside_create(pm_workspace *w);
/* Whether the time may have set the place at which it is asked. */
int pm_path_aside_is_timed(const pm_workspace *w, int ask);
/* The error of out[column] = value at the frame, which it has at that time; by_kinetic: what the error of T makes of it there. */
double pm_path_aside_error(pm_workspace *w, int ask, int column, double value, double by_kinetic);
/* What the error of T makes of the program where the motion turns back, if the frame looks there: the place is off; else 0. */
double pm_path_aside_turn(pm_workspace *w, int program, double value);
/* s, of the time at the place at which the frame looks. */
double pm_path_aside_clock(pm_workspace *w);
/* See state/route.h. */
double pm_path_aside_look(pm_workspace *w, int level, int on_time);
void pm_path_aside_back(pm_workspace *w);

#endif
