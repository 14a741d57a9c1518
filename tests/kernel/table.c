/* Tables: every index, kind and count that contradicts planemotion.h is refused with its table and row; numbers out of
 * bounds are refused case by case. */
#include "check.h"
#include "scene.h"
#include "scene/build.h"

/* One of everything. */
static scene *everything(void)
{
    scene *s = scene_create();
    const int a = scene_body(s, 2, 0.1, 0, 1, 0), b = scene_body(s, 1, 0.1, 1, 1, 0);
    const int pa = scene_point(s, a, 0.5, 0), pb = scene_point(s, b, -0.5, 0),
              o = scene_point(s, PM_GROUND, 0, 0);
    const int line = scene_line(s, o, 0.1), ca = scene_circle(s, pa, 0.1), cb = scene_circle(s, pb, 0.2);
    const int row =
        SCENE_ROW(s, PM_TABLE_PATTERN, o, scene_value(s, 1), scene_value(s, 0), scene_value(s, 3));
    scene_joint(s, PM_JOINT_PIN, pa, pb, 0);
    scene_joint(s, PM_JOINT_SLIDER, pa, line, 0);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, pa, line, 0);
    scene_joint(s, PM_JOINT_LINK, pa, o, 1);
    scene_joint(s, PM_JOINT_WELD, pa, pb, 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, ca, line, 0);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, ca, cb, 1);
    scene_teeth(s, ca, cb, 1, 0.3);
    scene_belt(s, PM_JOINT_BELT_GRIPS, ca, cb, 1, 20);
    scene_contact(s, PM_CONTACT_LINE, ca, line, 0, 0, PM_FRICTION_COULOMB, 0.2);
    scene_contact(s, PM_CONTACT_CIRCLE, ca, cb, 1, 0, PM_FRICTION_SMOOTH, 0);
    scene_contact(s, PM_CONTACT_PATTERN, ca, row, 0, 0, PM_FRICTION_ROUGH, 0);
    const int time = scene_time(s), program = scene_read(s, time);
    scene_force(s, PM_FORCE_SPRING, pa, pb, 10, 1);
    scene_force(s, PM_FORCE_TORSION, a, b, 10, 0);
    scene_force(s, PM_FORCE_DAMPER, pa, pb, 10, 0);
    scene_force(s, PM_FORCE_ROTARY_DAMPER, a, b, 10, 0);
    scene_applied(s, pa, b, program, program);
    scene_couple(s, a, b, program);
    const int along =
        scene_measure_with(s, PM_MEASURE_VELOCITY, pa, PM_PART_ALONG, PM_MEASURE_VALUE, scene_value(s, 0.3));
    scene_measure_with(s, PM_MEASURE_OMEGA, a, 0, PM_MEASURE_IN, b);
    scene_measure_with(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_X, PM_MEASURE_ON, b);
    scene_measure_with(s, PM_MEASURE_INERTIA, a, 0, PM_MEASURE_ABOUT, o);
    scene_measure(s, PM_MEASURE_JOINT_NORMAL, 5);
    scene_measure(s, PM_MEASURE_EVENT_COUNT, 0);
    scene_measure(s, PM_MEASURE_FORCE_WORK, 1);
    scene_measure(s, PM_MEASURE_CONTACT_GAP, 2);
    scene_start(s, PM_START_POSITION, scene_measure(s, PM_MEASURE_ANGLE, a), 0.1);
    scene_start(s, PM_START_VELOCITY, along, 1);
    const int e = scene_when(s, PM_TRIGGER_CROSS, program);
    scene_on(s, PM_TRIGGER_STRIKE, 1);
    scene_on(s, PM_TRIGGER_REST, 1);
    scene_until(s, e, 1);
    scene_ask_end(s, program);
    scene_ask_event(s, program, e, 1, 0);
    scene_ask_extreme(s, PM_ASK_MAX, program, PM_NONE);
    scene_ask_extreme(s, PM_ASK_AT_MIN, program, program);
    scene_ask(s, PM_ASK_GRID, program, PM_NONE, 1, 0, program, 3, 4);
    scene_ask(s, PM_ASK_EACH, program, e, 1, 0, PM_NONE, PM_NONE, 5);
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_REMOVE, PM_NONE, PM_TABLE_FORCE, 0, PM_NONE, PM_NONE);
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_ADD, e, PM_TABLE_FORCE, 0, PM_NONE, PM_NONE);
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_REMOVE, e, PM_TABLE_CONTACT, 0, PM_NONE, PM_NONE);
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_IMPULSE, e, PM_NONE, pa, program, program);
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_ANGULAR, e, PM_NONE, a, program, PM_NONE);
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_WORK, e, PM_NONE, b, program, PM_NONE);
    return s;
}

/* Columns of which every number has a meaning. */
static int is_free(int table, int column)
{
    return (table == PM_TABLE_BODY && column == PM_BODY_ROTATES) || table == PM_TABLE_EVENT ||
           (table == PM_TABLE_UNTIL && (column == PM_UNTIL_GROUP || column == PM_UNTIL_NTH)) ||
           (table == PM_TABLE_ASK &&
            (column == PM_ASK_COUNT || column == PM_ASK_NTH || column == PM_ASK_BEFORE)) ||
           (table == PM_TABLE_MEASURE && (column == PM_MEASURE_MEMBER || column == PM_MEASURE_PART)) ||
           (table == PM_TABLE_SETTING && (column == PM_SETTING_MAX_EVENTS || column == PM_SETTING_MAX_STEPS));
}

/* Columns that stay unread in rows of this kind. */
static int is_unread(const int32_t *row, int table, int column)
{
    switch (table) {
    case PM_TABLE_JOINT:
        return column == PM_JOINT_VALUE &&
               (row[0] == PM_JOINT_PIN || row[0] == PM_JOINT_SLIDER || row[0] == PM_JOINT_ROLLING_LINE);
    case PM_TABLE_CONTACT:
        if (column == PM_CONTACT_SENSE_RIM) return row[PM_CONTACT_RIM] == PM_NONE;
        return (column == PM_CONTACT_SENSE_A || column == PM_CONTACT_SENSE_B) && row[0] != PM_CONTACT_CORD;
    case PM_TABLE_FORCE:
        if (column == PM_FORCE_VALUE_1) return row[0] >= PM_FORCE_APPLIED;
        if (column == PM_FORCE_VALUE_2) return row[0] >= PM_FORCE_DAMPER;
        if (column == PM_FORCE_PROGRAM_X) return row[0] < PM_FORCE_APPLIED;
        if (column == PM_FORCE_PROGRAM_Y) return row[0] != PM_FORCE_APPLIED;
        return column == PM_FORCE_OPTION && row[0] != PM_FORCE_SPRING;
    case PM_TABLE_TRIGGER: return column == PM_TRIGGER_A && row[0] < PM_TRIGGER_STRIKE;
    case PM_TABLE_MEASURE: return column == PM_MEASURE_A && row[0] == PM_MEASURE_TIME;
    default: return 0;
    }
}

static void corrupt_every_column(void)
{
    static const int32_t wrong[] = {1000000, -77, INT32_MAX, INT32_MIN};
    for (int table = PM_TABLE_VALUE; table < PM_TABLES; table++) {
        scene *s = everything();
        for (int row = 0; row < s->rows[table]; row++)
            for (int column = 0; column < s->columns[table]; column++) {
                int32_t *first = s->cell[table] + row * s->columns[table], kept = first[column];
                if (is_free(table, column) || is_unread(first, table, column)) continue;
                for (int i = 0; i < 4; i++) {
                    first[column] = wrong[i];
                    const int status = scene_run(s, NULL);
                    if (status != PM_BAD_TABLE || s->where[PM_WHERE_TABLE] != table ||
                        s->where[PM_WHERE_ROW] != row) {
                        fprintf(stderr, "table %d row %d column %d = %d: status %d at table %d row %d\n",
                                table, row, column, wrong[i], status, s->where[PM_WHERE_TABLE],
                                s->where[PM_WHERE_ROW]);
                        CHECK(0);
                    }
                    first[column] = kept;
                }
            }
        CHECK(scene_run(s, NULL) != PM_BAD_TABLE);
        scene_free(s);
    }
}

/* Kinds and counts that are wrong only in their place. */
static void refused(int table, int row, int column, int32_t number)
{
    scene *s = everything();
    s->cell[table][row * s->columns[table] + column] = number;
    EQUAL(scene_run(s, NULL), PM_BAD_TABLE);
    EQUAL(s->where[PM_WHERE_TABLE], table);
    EQUAL(s->where[PM_WHERE_ROW], row);
    scene_free(s);
}

/* What forces read of an event is told by a program that rises and falls (a switch), or by two (a piece). */
static void effects_have_their_triggers(void)
{
    static const struct {
        int effect, first, second, program, good;
    } cases[] = {
        {PM_EFFECT_SWITCH, PM_TRIGGER_RISE, PM_TRIGGER_FALL, 0, 1},
        {PM_EFFECT_SWITCH, PM_TRIGGER_RISE, PM_TRIGGER_FALL, 1, 0},
        {PM_EFFECT_SWITCH, PM_TRIGGER_RISE, PM_TRIGGER_RISE, 0, 0},
        {PM_EFFECT_SWITCH, PM_TRIGGER_FALL, PM_TRIGGER_START, 0, 0},
        {PM_EFFECT_SWITCH, PM_TRIGGER_FALL, PM_TRIGGER_STRIKE, 0, 0},
        {PM_EFFECT_PIECE, PM_TRIGGER_FALL, PM_TRIGGER_RISE, 1, 1},
        {PM_EFFECT_PIECE, PM_TRIGGER_FALL, PM_TRIGGER_CROSS, 1, 0},
        {PM_EFFECT_COUNT, PM_TRIGGER_RISE, PM_TRIGGER_RISE, 1, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene *s = everything();
        const int program[] = {scene_read(s, scene_time(s)), scene_minus(s, scene_time(s), 1)};
        const int event = SCENE_ROW(s, PM_TABLE_EVENT, 0, cases[i].effect);
        scene_trigger(s, cases[i].first, event, program[0], 0);
        scene_trigger(s, cases[i].second, event, program[cases[i].program], 0);
        EQUAL(scene_run(s, NULL) != PM_BAD_TABLE, cases[i].good);
        scene_free(s);
    }
}

static void wrong_in_its_place(void)
{
    refused(PM_TABLE_MEASURE, 1, PM_MEASURE_PART, PM_PART_NONE); /* a vector without its part */
    refused(PM_TABLE_MEASURE, 1, PM_MEASURE_PART, PM_PARTS);
    refused(PM_TABLE_MEASURE, 1, PM_MEASURE_VALUE, PM_NONE); /* along what? */
    refused(PM_TABLE_MEASURE, 5, PM_MEASURE_A, 0);           /* the normal force of a pin */
    refused(PM_TABLE_START, 0, PM_START_LEVEL, PM_START_VELOCITY);
    refused(PM_TABLE_START, 1, PM_START_LEVEL, PM_START_POSITION);
    refused(PM_TABLE_TRIGGER, 0, PM_TRIGGER_PROGRAM, PM_NONE);
    refused(PM_TABLE_CONTACT, 0, PM_CONTACT_STATIC, PM_NONE);
    refused(PM_TABLE_CONTACT, 0, PM_CONTACT_KINETIC, PM_NONE);
    refused(PM_TABLE_CONTACT, 1, PM_CONTACT_SIDE, PM_NONE);
    refused(PM_TABLE_ASK, 1, PM_ASK_EVENT_INDEX, PM_NONE);
    refused(PM_TABLE_ASK, 3, PM_ASK_PROGRAM_2, PM_NONE);
    refused(PM_TABLE_ASK, 4, PM_ASK_COUNT, 0);
    refused(PM_TABLE_ASK, 4, PM_ASK_COUNT, 1000000);
    refused(PM_TABLE_ASK, 4, PM_ASK_COUNT, INT32_MAX);
    refused(PM_TABLE_ASK, 5, PM_ASK_COUNT, INT32_MAX);
    refused(PM_TABLE_ASK, 0, PM_ASK_COUNT, 2);
    refused(PM_TABLE_ASK, 1, PM_ASK_NTH, 0);
    refused(PM_TABLE_UNTIL, 0, PM_UNTIL_NTH, 0);
    refused(PM_TABLE_SETTING, 0, PM_SETTING_MAX_EVENTS, 0);
    refused(PM_TABLE_SETTING, 0, PM_SETTING_MAX_STEPS, 0);
}

static void wrong_directory(void)
{
    scene *s = everything();
    pm_where where;
    scene_pack(s);
    for (int i = 0; i < PM_TABLES; i++)
        for (int k = 0; k < 2; k++) {
            const int32_t kept = s->table[2 * i + k], wrong[] = {-1, (int32_t)s->ntable + 1, INT32_MAX};
            for (int n = 0; n < 3; n++) {
                s->table[2 * i + k] = wrong[n];
                EQUAL(pm_model_create(s->ntable, s->table, s->nconstant, s->constant, 0, &s->model, &where),
                      PM_BAD_TABLE);
                EQUAL(where.table, i);
            }
            s->table[2 * i + k] = kept;
        }
    EQUAL(pm_model_create(5, s->table, s->nconstant, s->constant, 0, &s->model, &where), PM_BAD_TABLE);
    scene_free(s);
}

/* A force may not depend on what depends on forces: that would have no end, or an old value. */
static void forces_on_forces(void)
{
    static const int kinds[] = {PM_MEASURE_FORCE_FORCE, PM_MEASURE_FORCE_POWER, PM_MEASURE_FORCE_ENERGY,
                                PM_MEASURE_ACCELERATION};
    for (int i = 0; i < 4; i++) {
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0, 0, 0, 0), p = scene_point(s, b, 0, 0);
        const int vector = kinds[i] == PM_MEASURE_FORCE_FORCE || kinds[i] == PM_MEASURE_ACCELERATION;
        const int program = scene_read(s, scene_part(s, kinds[i], 0, vector ? PM_PART_X : PM_PART_NONE));
        scene_applied(s, p, PM_GROUND, program, program);
        scene_until(s, scene_on(s, PM_TRIGGER_START, PM_NONE), 1);
        pm_where where = {0, 0, 0, 0, 0};
        scene_pack(s);
        const int status =
            pm_model_create(s->ntable, s->table, s->nconstant, s->constant, 0, &s->model, &where);
        if (CHECK(status == PM_BAD_TABLE)) EQUAL(where.table, PM_TABLE_FORCE);
        scene_free(s);
    }
}

/* ---- numbers ---- */
static void out_of_bound(int table, int row, int column, double number)
{
    scene *s = everything();
    s->cell[table][row * s->columns[table] + column] = scene_value(s, number);
    EQUAL(scene_run(s, NULL), PM_BAD_VALUE);
    EQUAL(s->where[PM_WHERE_TABLE], table);
    EQUAL(s->where[PM_WHERE_ROW], row);
    CHECK(s->detail[PM_DETAIL_VALUE] == number || isnan(number) || table == PM_TABLE_PATTERN);
    for (int i = 0; i < s->nout; i++) CHECK(isnan(s->out[i]));
    EQUAL(s->reason[0], PM_REASON_FAILED);
    scene_free(s);
}

static void numbers(void)
{
    static const double not_numbers[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        const double x = not_numbers[i];
        for (int k = PM_BODY_MASS; k <= PM_BODY_ANGLE; k++) out_of_bound(PM_TABLE_BODY, 1, k, x);
        out_of_bound(PM_TABLE_POINT, 1, PM_POINT_X, x);
        out_of_bound(PM_TABLE_LINE, 0, PM_LINE_ANGLE, x);
        out_of_bound(PM_TABLE_CIRCLE, 1, PM_CIRCLE_RADIUS, x);
        out_of_bound(PM_TABLE_PATTERN, 0, PM_PATTERN_STEP_X, x);
        out_of_bound(PM_TABLE_PATTERN, 0, PM_PATTERN_COUNT, x);
        out_of_bound(PM_TABLE_JOINT, 3, PM_JOINT_VALUE, x);
        for (int k = 7; k < 9; k++) out_of_bound(PM_TABLE_JOINT, k, PM_JOINT_VALUE_2, x);
        out_of_bound(PM_TABLE_CONTACT, 1, PM_CONTACT_RESTITUTION, x);
        out_of_bound(PM_TABLE_CONTACT, 0, PM_CONTACT_STATIC, x);
        out_of_bound(PM_TABLE_CONTACT, 0, PM_CONTACT_KINETIC, x);
        out_of_bound(PM_TABLE_FORCE, 0, PM_FORCE_VALUE_1, x);
        out_of_bound(PM_TABLE_START, 1, PM_START_VALUE, x);
        out_of_bound(PM_TABLE_SETTING, 0, PM_SETTING_GRAVITY_X, x);
        out_of_bound(PM_TABLE_SETTING, 0, PM_SETTING_ACCURACY, x);
    }
    out_of_bound(PM_TABLE_BODY, 0, PM_BODY_MASS, -3);
    out_of_bound(PM_TABLE_BODY, 0, PM_BODY_INERTIA, -1e-9);
    out_of_bound(PM_TABLE_CIRCLE, 0, PM_CIRCLE_RADIUS, -0.1);
    out_of_bound(PM_TABLE_JOINT, 3, PM_JOINT_VALUE, 0);
    out_of_bound(PM_TABLE_JOINT, 6, PM_JOINT_VALUE, 0.5); /* no side */
    out_of_bound(PM_TABLE_JOINT, 7, PM_JOINT_VALUE_2, 1.05);
    out_of_bound(PM_TABLE_JOINT, 8, PM_JOINT_VALUE_2, -1);
    out_of_bound(PM_TABLE_CONTACT, 1, PM_CONTACT_SIDE, 2);
    out_of_bound(PM_TABLE_CONTACT, 0, PM_CONTACT_RESTITUTION, -0.1);
    out_of_bound(PM_TABLE_CONTACT, 0, PM_CONTACT_RESTITUTION, 1.1);
    out_of_bound(PM_TABLE_CONTACT, 0, PM_CONTACT_KINETIC, -0.1);
    out_of_bound(PM_TABLE_FORCE, 0, PM_FORCE_VALUE_1, -1);
    out_of_bound(PM_TABLE_SETTING, 0, PM_SETTING_ACCURACY, 0.5);
    out_of_bound(PM_TABLE_SETTING, 0, PM_SETTING_MAX_TIME, 0);
}

/* Two points cannot touch, nor can a point touch a row of points. */
static void points_that_touch(void)
{
    for (int kind = PM_CONTACT_CIRCLE; kind <= PM_CONTACT_PATTERN; kind++) {
        scene *s = scene_create();
        const int o = scene_point(s, PM_GROUND, 0, 0),
                  c = scene_circle(s, scene_point(s, scene_body(s, 1, 0, 0, 1, 0), 0, 0), 0);
        const int row =
            SCENE_ROW(s, PM_TABLE_PATTERN, o, scene_value(s, 1), scene_value(s, 0), scene_value(s, -1));
        scene_contact(s, kind, c, kind == PM_CONTACT_PATTERN ? row : scene_circle(s, o, 0), 1, 0,
                      PM_FRICTION_SMOOTH, 0);
        scene_until_time(s, 1);
        EQUAL(scene_run(s, NULL), PM_BAD_VALUE);
        EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_CONTACT);
        scene_free(s);
    }
}

int main(void)
{
    corrupt_every_column();
    effects_have_their_triggers();
    wrong_in_its_place();
    wrong_directory();
    forces_on_forces();
    numbers();
    points_that_touch();
    return check_failures();
}
