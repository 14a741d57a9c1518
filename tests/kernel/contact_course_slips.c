/* Slips that end in the course of a blow: in turn, for good, wedged. */
#include <string.h>

#include "check.h"
#include "course_problem.h"
#include "impact/contact_course.h"
#include "state/arena.h"

#define CLOSE 1e-9

/* One body whose blow asks for much: at places on it, with lines at these angles. */
static problem one_body(int law, double mass, double inertia, const double velocity[3], int n,
                        const double (*at)[5])
{
    problem x = {.inverse = {1 / mass, 1 / mass, 1 / inertia, 1, 1, 1}};
    memcpy(x.velocity, velocity, 3 * sizeof *velocity);
    for (int i = 0; i < n; i++) {
        add_contact(&x, at[i][0], at[i][1], at[i][2], law);
        x.mu[i] = at[i][3], x.e[i] = at[i][4];
    }
    return x;
}

/* Two slips end in turn, each time after 0.76 of the time before, and then both hold: as tests/stress/contacts/course.py has it. */
static void slips_end_in_turn(void)
{
    const double at[2][5] = {{0.007202130280657255, -0.24407644630544972, 9.316825951963871,
                              0.9762848837580984, 0.8393028401010101},
                             {0.12470246162114376, -0.2785006485900891, 9.81371724921367, 0.9113911731555072,
                              0.43643356239724407}};
    const double before[3] = {-1.3129789806376428, 0.841340797970912, -1.9443501820124132},
                 expected[3] = {-0.35141468849291096, -0.716674623833637, 1.9572451697082835};
    const problem x = one_body(PM_LAW_POISSON, 2.192017060693545, 0.08508079061194995, before, 2, at);
    double after[6];
    EQUAL(follow(&x, after), 1);
    for (int q = 0; q < 3; q++) NEAR(after[q], expected[q], 1e-8);
}

/* Compression stops the body for good: all slips end with it, though rounding puts them a little before or after. */
static void stopped_for_good(void)
{
    const double at[3][5] = {
        {-0.4387404282328529, 0.16908535721363596, 3.574130982724302, 0.4255028153273718,
         0.24769512941912497},
        {-0.44060948954248375, -0.17112670761725465, 4.70331632220247, 0.6705514547994152, 0},
        {-0.09994420582047472, -0.24793335753822004, 9.538457368014207, 1.0508730090322786,
         0.2089265117077318}};
    const double before[3] = {-1.19819577065374, -0.13103676657655755, -3.2629530373868763},
                 expected[3] = {0.07513476011421791, -0.06805039688764243, 1.2837861032427798};
    for (int k = 0; k < 300; k++) {
        problem x = one_body(PM_LAW_POISSON, 4.107565568743859, 0.054879924191479086, before, 3, at);
        double after[6];
        for (int q = 0; q < 3; q++) {
            x.velocity[q] *= 1 + check_random(-4e-16, 4e-16);
            for (int i = 0; i < 6; i++) x.jacobian[i][q] *= 1 + check_random(-4e-16, 4e-16);
        }
        EQUAL(follow(&x, after), 1);
        for (int q = 0; q < 3; q++) NEAR(after[q], expected[q], CLOSE);
    }
}

/* Two slips end in turn until the body is wedged: none of those slips that are less than counts as slip ends once more, when
 * restitution has parted the contacts by as much as nothing.  There no motion obeys the law, and not several. */
static void wedged_by_slips_in_turn(void)
{
    const double at[4][5] = {
        {-0.1642068070022505, 0.06696809389876886, 4.857365163562014, 1.1628578849254945,
         0.05757255339938483},
        {-0.44591539086775706, -0.017014436821950096, 5.2057904596061615, 0.8956750767667209,
         0.26260288174176794},
        {-0.0029685157206231425, -0.1313227240387858, 6.537202404032805, 0.7662528507589383,
         0.04438177273126487},
        {0.13819705955182207, -0.39891357064506766, 5.880117009583794, 0, 0.08573778175166358}};
    const double before[3] = {-0.6856497435183405, -0.34459953355575523, 1.2350441470395102};
    const problem x = one_body(PM_LAW_STRONGE, 1.6672725109704871, 0.16892482028737277, before, 4, at);
    pose(&x);
    course.no_slip = 3e-11;
    EQUAL(pm_contact_course_follow(&course), 0);
}

/* Several slips all but end at once: of one 8e-10 m/s is left, with which no motion goes on; without it the blow goes on to its end,
 * as tests/stress/contacts/course.py has it. */
static void hardly_any_slip_is_left(void)
{
    const double at[4][5] = {
        {0.3966406300560481, -0.20153260059247227, 7.97463955747153, 0.6902515467979136, 0.5805722410593079},
        {0.35893092158095147, -0.019859905898761073, 10.865792792446102, 0.52564693124706,
         0.012499868403444303},
        {-0.06289051815261856, 0.10746239640121538, 12.728578852978817, 0.6147144591710793,
         0.010357981221339907},
        {-0.11856730857768626, -0.19682406281446468, 14.436822900854299, 0.0, 0.7914441412074555}};
    const double before[3] = {0.20098419725371655, 0.07044121477796488, 7.593260753603979},
                 expected[3] = {0.008371289758761273, 0.15129551899688123, -0.4215170962562064};
    for (int k = 0; k < 300; k++) {
        problem x = one_body(PM_LAW_POISSON, 1.2341434575706915, 0.17055851181091677, before, 4, at);
        double after[6];
        for (int q = 0; q < 3 && k > 0; q++) {
            x.velocity[q] *= 1 + check_random(-4e-16, 4e-16);
            for (int i = 0; i < 8; i++) x.jacobian[i][q] *= 1 + check_random(-4e-16, 4e-16);
        }
        EQUAL(follow(&x, after), 1);
        for (int q = 0; q < 3; q++) NEAR(after[q], expected[q], 1e-7);
    }
}

/* All slips but 0.1 % have ended: then the body may stop dead, or slide on at two of its contacts, which is hardly another motion
 * and known no better than the velocities of the whole blow.  There are two in whatever order, and however it is rounded. */
static void stopped_or_not(void)
{
    const double at[4][5] = {
        {-0.42557090918587465, -0.1628595766621585, 8.27564340260227, 0.6949215748933685, 0},
        {0.0901621213682595, -0.2547810341910145, 6.987636981898612, 0.5313046126884096, 0.6842995515414615},
        {0.28610916882594956, 0.3937316216614984, 8.275750965190893, 0, 0.25822147313226984},
        {-0.10442603029055557, 0.2634609321274887, 13.730222345988413, 0.8740962098489833, 0}};
    const double before[3] = {1.0371435720118074, 0.24149134695640867, -2.7114116599176405};
    for (int k = 0; k < 300; k++) {
        double after[6];
        problem x = one_body(PM_LAW_POISSON, 1.4913913214574754, 0.13310993014218925, before, 0, at);
        for (int i = 0; i < 4; i++) {
            const double *of = at[(i + k) % 4];
            add_contact(&x, of[0], of[1], of[2], PM_LAW_POISSON);
            x.mu[i] = of[3], x.e[i] = of[4];
        }
        for (int q = 0; q < 3; q++) {
            x.velocity[q] *= 1 + check_random(-4e-16, 4e-16);
            for (int i = 0; i < 8; i++) x.jacobian[i][q] *= 1 + check_random(-4e-16, 4e-16);
        }
        EQUAL(follow(&x, after), 2);
    }
}

/* The slips that follow a blow where slower than no_slip is none; 0: no motion, or several. */
static int slips_after(const problem *x, double no_slip, double slip[2])
{
    pose(x);
    course.no_slip = no_slip;
    const int found = pm_contact_course_follow(&course) == 1;
    for (int i = 0; i < 2; i++) slip[i] = found ? course.velocity[2 * i + 1] : 0;
    return found;
}

/* Slips of corners and edges at right angles end together.  What rounding leaves of them is no slip, however slow such a slip
 * may be in the scene of a blow that is much faster. */
static void rounding_is_no_slip(void)
{
    for (int k = 0; k < 2000; k++) {
        const double e = check_random(0, 0.9), mu = check_random(0, 1.2);
        problem x = {.inverse = {1, 1, check_random(2, 200), 1, 1, 1}};
        for (int q = 0; q < 3; q++) x.velocity[q] = floor(check_random(-3, 3));
        for (int i = 0; i < 2; i++) {
            add_contact(&x, 0.5 * floor(check_random(-2, 3)), 0.5 * floor(check_random(-2, 3)),
                        M_PI / 4 * floor(check_random(0, 8)), k % 2 ? PM_LAW_POISSON : PM_LAW_STRONGE);
            x.mu[i] = mu, x.e[i] = i ? e : 0;
        }
        double slip[2], expected[2];
        EQUAL(slips_after(&x, 0, slip), slips_after(&x, 1e-9, expected));
        for (int i = 0; i < 2; i++) NEAR(slip[i], expected[i], CLOSE);
    }
}

int main(void)
{
    EQUAL(pm_contact_course_create(&course, &memory, MOST, 0), 0);
    slips_end_in_turn();
    stopped_for_good();
    hardly_any_slip_is_left();
    wedged_by_slips_in_turn();
    stopped_or_not();
    rounding_is_no_slip();
    pm_arena_free(&memory);
    return check_failures();
}
