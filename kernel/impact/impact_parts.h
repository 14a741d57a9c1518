/* impact_parts.h - one blow, as the files share it that resolve it: who takes part, what is tried, what comes of it.
 *
 * impact.c owns it for all blows of a workspace; nothing is kept in it from one blow to the next. */
#ifndef PM_IMPACT_PARTS_H
#define PM_IMPACT_PARTS_H

#include "elements/constraint.h"
#include "impact/contact_course.h"
#include "impact/contact_system.h"
#include "impact/impact_course.h"
#include "state/workspace.h"

/* Which part a slot takes. */
enum pm_share { PM_OUT = 0, PM_STRUCK = 1, PM_JOINED = 2, PM_DROPPED = 3 };

/* What is known of an open contact while blows follow each other at one instant: it does not touch, or the last blow made it part. */
enum pm_apart { PM_NOT_APART = 0, PM_APART = 1, PM_PARTED = 2 };

/* How the blow of one contact ends, where that is known before its equations are solved. */
typedef struct pm_impact_given {
    int is;
    double normal; /* m/s, after the blow */
    double ratio;  /* tangential impulse over the normal one */
    int sticks;    /* without slip; what it seems to slip after the blow is rounding */
} pm_impact_given;

typedef struct pm_blow {
    unsigned char *share; /* [nslot] enum pm_share */
    unsigned char *held;  /* [nslot] closed after the blow whatever it would do: the mode tried first, or 0 */
    unsigned char *apart; /* [ncontact] enum pm_apart */
    int32_t *resting;     /* [nslot] enum pm_contact_mode before the blow; PM_OPEN if struck */
    int32_t *trial;       /* [nslot] enum pm_contact_mode in the blow of what takes part */
    double *before;       /* [nq] velocities before the blow, m/s and rad/s */
    double *place;    /* [nq] places, where those of a coarse run are disturbed for the time of the blow */
    double *after;    /* [nq] and after it */
    double *response; /* [nq] scratch of impact_course.c */
    double approach;  /* m/s, greatest of what is struck */
    int ends_bounce;  /* a contact whose bounce is over is closed: what it was left with is rounding */
    int series_ends;  /* some rebound of this instant is the last of its series */
    int shock;        /* slot whose blow is an impact without collision, or PM_NONE */
    int several;      /* the blow is that of impact_together.c, and no rounding */
    int followed;     /* it is that of impact_followed.c */
    int plastic;      /* without restitution */
    int equations;    /* one contact alone is solved as several are, not followed */
    pm_contact_system system; /* several contacts at once */
    pm_contact_course course; /* the same where their blow is followed */
    struct {
        int *friction;        /* [nfriction] those of the course */
        pm_constraint *along; /* [nfriction] their slips, evaluated */
        int captures;         /* the blow has captures */
    } loaded;                 /* joints that rub by their load */
    struct {
        double *after, *slot; /* [nq], [2 nslot] */
    } elastic;                /* the blow with restitution, while the one without is found */
    struct {
        double *before, *after, *now; /* [2 nslot] velocities at the listed contacts */
    } order;                          /* scratch of impact_order.c */
    int alone;              /* slot whose blow is followed by itself (impact_course.c), or PM_NONE */
    pm_impact_given *given; /* [nslot] */
} pm_blow;

static inline int pm_blow_has(const pm_blow *b, int slot)
{
    return b->share[slot] == PM_STRUCK || b->share[slot] == PM_JOINED;
}

/* ---- impact_find.c ---- */
/* The velocities after the blow of what is listed, in b->after; in a coarse run what is struck alone is struck at places
 * that are off by some roundings. */
int pm_impact_find(pm_workspace *w, pm_blow *b);

/* ---- impact_trial.c: the constraints of a trial, and its impulses ---- */
/* The settings want blows one by one. */
int pm_impact_one_by_one(const pm_model *m);
/* Mode in which the contact of a slot enters a blow. */
int32_t pm_impact_trial_mode(const pm_frame *frame, int slot);
/* The active constraints, their impulses (w->saddle.rhs) and b->after, of the shares and modes that are tried. */
int pm_impact_trial_solve(pm_workspace *w, pm_blow *b);
/* The same of contacts whose ends are b->given; *independent = 0, and nothing is solved, where their normals depend on each
 * other. */
int pm_impact_trial_solve_given(pm_workspace *w, pm_blow *b, int *independent);
/* Rate of active constraint i before the blow, relative to what drives prescribe. */
double pm_impact_trial_rate(const pm_workspace *w, int i);

/* 1 if the trial of one contact, or none, is a blow: it does not pull, and nothing else would approach. */
int pm_impact_trial_is_whole(pm_workspace *w, const pm_blow *b);
/* How many contacts take part; captured pairs are joints. */
int pm_impact_trial_contacts(const pm_model *m, const pm_blow *b);

/* ---- impact_together.c: several contacts at once ---- */
/* The blow of all that is struck or rests, recorded.  PM_BLOW_UNDECIDED, PM_NOT_UNIQUE: where = contact; detail = its
 * coefficient of friction, how many contacts. */
int pm_impact_together(pm_workspace *w, pm_blow *b);
/* Lists what is struck or rests, opens it, and finds the response of its contacts and the velocities that they would have
 * after a blow in which none of them takes part (b->system). */
int pm_impact_list(pm_workspace *w, pm_blow *b);
/* Velocities x->free after a blow in which no listed contact takes part; the reactions are in w->saddle.rhs. */
void pm_impact_respond_free(pm_workspace *w, pm_contact_system *x);
/* What the blow asks of each listed contact: its bias (b->system). */
void pm_impact_pose(pm_workspace *w, pm_blow *b);
/* What the problem says where it has `n` motions, not one; `at`: the listed contact that it is said of. */
int pm_impact_fail(pm_workspace *w, const pm_contact_system *x, int n, int at);
/* The blow that was found and recorded would gain energy: it is mixed with the one without restitution until it does not,
 * and counted (PM_COUNT_LIMITED_BLOWS). */
int pm_impact_limit(pm_workspace *w, pm_blow *b);

/* ---- impact_held.c: several contacts in a blow too slow to be seen ---- */
/* 1 if it is one of the last of a series. */
int pm_impact_is_slow(const pm_workspace *w, const pm_blow *b);
/* A blow so slow that nothing could be seen of how its contacts part: all of them are held; *holds: whether it is one. */
int pm_impact_hold_rocking(pm_workspace *w, pm_blow *b, int *holds);

/* ---- impact_followed.c: several contacts whose blow is followed ---- */
/* 1 if a listed contact has a law that is followed. */
int pm_impact_is_followed(const pm_model *m, const pm_contact_system *x);
/* The blow of what is listed, recorded.  As pm_impact_together; PM_UNSUPPORTED with massless bodies; PM_BLOW_SEVERAL where a
 * contact has a restitution along it; PM_BLOWS_ENDLESS where stiffnesses share it without end. */
int pm_impact_follow_several(pm_workspace *w, pm_blow *b);
/* The impact without collision of the contact in b->shock, recorded.  PM_PAINLEVE: friction does not draw it together, or
 * others would have to take part; where = contact, detail = its coefficient of friction, contacts that are closed. */
int pm_impact_follow_shock(pm_workspace *w, pm_blow *b);
/* The course (b->course) of what is listed, without joints that rub. */
void pm_impact_pose_course(pm_workspace *w, pm_blow *b);
/* What a blow that is followed cannot have: as pm_impact_follow_several. */
int pm_impact_check_followed(pm_workspace *w, const pm_contact_system *x);
/* Velocities after it, and the impulses of all that holds, with the impulses of the course. */
int pm_impact_apply(pm_workspace *w, pm_blow *b);
/* Whether no listed contact but the one in `slot` would be struck then. */
int pm_impact_others_part(const pm_workspace *w, const pm_blow *b, int slot);
/* Its impulses, and who took part. */
void pm_impact_record_followed(pm_workspace *w, pm_blow *b);
/* Enters the blow, where it is one, into the counts, and its contacts, which are not among the active constraints, into the
 * ledger of a jump from b->before. */
void pm_impact_followed_close(pm_workspace *w, const pm_blow *b);

/* ---- impact_loaded.c: joints that rub by their load ---- */
/* The blow of all that is struck or rests, recorded, where it loads such joints: *loaded = 1.  As pm_impact_together;
 * PM_UNSUPPORTED, PM_NOT_UNIQUE with where = force: what such a friction cannot take part in, or whose load is shared. */
int pm_impact_loaded(pm_workspace *w, pm_blow *b, int *loaded);

/* ---- impact_order.c: the same one by one ---- */
/* Counts the blow of what is listed, from b->before to b->after, if its contacts struck one by one leave another motion
 * (PM_COUNT_ORDERED_BLOWS; the first of them is w->result.ordered).  The course of the blow is lost. */
void pm_impact_order_look(pm_workspace *w, pm_blow *b);

/* ---- impact_end.c: what the blow that was found leaves ---- */
/* The energy, J, that contacts give beyond rounding; 0 if they give none. */
double pm_impact_end_gains(pm_workspace *w, const pm_blow *b);
/* Its impulses, for measures (w->impulses). */
void pm_impact_end_record(pm_workspace *w);
/* Those of one contact, along its constraints. */
void pm_impact_end_record_contact(pm_workspace *w, int slot, const pm_constraint *normal,
                                  const pm_constraint *tangent, const double impulse[2]);
/* Modes after it: the frame looks at the velocities after the blow. */
void pm_impact_end_modes(pm_workspace *w, pm_blow *b);

#endif
