/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms by chance: bodies of all kinds, a random graph of joints of all kinds between them and
 * to ground, loads. The design configuration fulfils all constraints; rows may be redundant. The
 * same seed gives the same mechanism on every machine.
 */
#ifndef BAUM_TEST_RANDOM_MECHANISM_H
#define BAUM_TEST_RANDOM_MECHANISM_H

#include <stdint.h>

#include <baum/baum.h>

enum { RANDOM_BODIES = 80, RANDOM_JOINTS = 160, RANDOM_SIZE = 5, RANDOM_ROWS = 5, RANDOM_SPAN = 3 };

/* A generator of numbers (xorshift64*, S. Vigna, 2016). */
typedef struct chance {
  uint64_t state;
} chance;

chance chance_of(uint64_t seed);
double chance_number(chance *c, double low, double high);
/* Over decades, such that the logarithm is uniform. */
double chance_decade(chance *c, double low, double high);
int chance_below(chance *c, int count);

typedef struct random_kind {
  int bodies;      /* not more than RANDOM_BODIES */
  int joints;      /* tried; not more than RANDOM_JOINTS */
  int particles;   /* in a hundred bodies */
  int coordinates; /* likewise */
  int pins;        /* in a hundred joints */
  bool constant;   /* user coordinates have constant masses */
  bool hub;        /* all joints have body 1 as a member */
  double span;     /* masses are from 1/span to span */
  int loads;
  int springs;        /* tried, with dampers */
  bool drivers_begin; /* at their design coordinates at time `start`; else anywhere */
  double start;       /* [s] */
} random_kind;

/* What functions of user coordinates know. */
typedef struct random_body {
  baum_body_id id;
  char kind; /* 'g'round, 'b'ody, 'p'article, 'c'oordinates */
  int size;  /* numbers of q */
  double q[RANDOM_SIZE];
  double
    factor[RANDOM_SIZE * RANDOM_SIZE]; /* M = factor factor^T, that of row 0 times 1 + q_0^2 / 4 */
  double force[RANDOM_SIZE];
  bool constant;
} random_body;

/* Phi_r = linear_r (x - x0) + square_r (x - x0)^2 / 2, element by element. */
typedef struct random_rows {
  int rows;
  int columns;
  double linear[RANDOM_ROWS][RANDOM_SPAN * RANDOM_SIZE];
  double square[RANDOM_ROWS][RANDOM_SPAN * RANDOM_SIZE];
  double at[RANDOM_SPAN * RANDOM_SIZE];
  int fail_at; /* call that fails, counted down; 0: none */
  int answer;  /* its answer, or 0: NaN */
} random_rows;

typedef struct random_mechanism {
  baum_mechanism *mechanism;
  chance chance;
  int body_count; /* with ground, which is 0 */
  random_body bodies[RANDOM_BODIES + 1];
  int joint_count;
  baum_joint_id joints[2 * RANDOM_JOINTS];
  char joint_kind[2 * RANDOM_JOINTS];
  int rows_count;
  random_rows rows[RANDOM_JOINTS];
} random_mechanism;

/* Frozen. The struct must stay where it is. */
void random_mechanism_make(random_mechanism *out, uint64_t seed, const random_kind *kind);
void random_mechanism_destroy(random_mechanism *out);

#endif
