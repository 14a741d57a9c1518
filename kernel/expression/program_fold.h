/* program_fold.h - programs as they are run within a case: what does not change in it is worked out once. */
#ifndef PM_PROGRAM_FOLD_H
#define PM_PROGRAM_FOLD_H

#include "state/model.h"

enum pm_step_kind {
    STEP_NUMBER = 0,      /* push number[arg] of the case */
    STEP_MEASURE = 1,     /* push measure arg, with its sign if it is the size of something */
    STEP_ANSWER = 2,      /* push out[arg] */
    STEP_UNARY = 3,       /* op */
    STEP_BINARY = 4,      /* op */
    STEP_WITH_NUMBER = 5, /* op with number[arg] as its second operand */
    STEP_SELECT = 6,
    STEP_TABLE = 7 /* op that reads the piecewise polynomial arg */
};

typedef struct pm_program_step {
    int32_t kind, op, arg;
} pm_program_step;

/* Instructions first .. first + length - 1 of the code: a part of a program, of constants, parameters and values alone. */
typedef struct pm_program_part {
    int32_t first, length;
} pm_program_part;

typedef struct pm_program_fold {
    pm_program_step *step;
    int *first;            /* [nprogram + 1] first step of each program */
    pm_program_part *part; /* [nnumber] */
    int nnumber;
} pm_program_fold;

/* Folds all programs of the scene; they are valid. */
int pm_program_fold_create(pm_model *m);
void pm_program_fold_free(pm_model *m);

#endif
