/* SPDX-License-Identifier: BSD-3-Clause */
/* Random mechanisms. They have bodies of all kinds, joints of all kinds in a random graph between
 * bodies and ground, loads and springs. The design configuration satisfies all constraints. Rows
 * may be redundant. The same seed gives the same mechanism on every machine. */
#ifndef BAUM_TEST_RANDOM_MECHANISM_H
#define BAUM_TEST_RANDOM_MECHANISM_H

#include <stdint.h>

#include <baum/baum.h>

enum { RANDOM_BODIES = 80, RANDOM_JOINTS = 160, RANDOM_SIZE = 5, RANDOM_ROWS = 5, RANDOM_SPAN = 3 };

/* A random number generator (xorshift64*, S. Vigna, 2016). */
typedef struct chance {
  uint64_t state;
} chance;

chance chance_of(uint64_t seed);
double chance_number(chance *c, double low, double high);
/* Returns a number whose logarithm is uniform. */
double chance_decade(chance *c, double low, double high);
int chance_below(chance *c, int count);

typedef struct random_kind {
  int bodies;      /* at most RANDOM_BODIES */
  int joints;      /* number of attempts to add a joint, at most RANDOM_JOINTS */
  int particles;   /* [%] of the bodies are particles */
  int coordinates; /* [%] of the bodies have user coordinates */
  int pins;        /* [%] of the joints are pins */
  bool constant;   /* user coordinates have constant masses */
  bool hub;        /* whether all joints involve body 1 */
  double span;     /* masses are from 1/span to span */
  int loads;
  int springs;        /* number of attempts to add a spring; springs have dampers */
  int velocity_rows;  /* number of attempts to add rows of velocity level, at most RANDOM_ROWS */
  bool drivers_begin; /* whether drivers prescribe the design configuration at time `start` */
  double start;       /* [s] */
} random_kind;

/* A body of any kind. It also contains the data for the functions of user coordinates. */
typedef struct random_body {
  baum_body_id id;
  char kind; /* 'g'round, 'b'ody, 'p'article, 'c'oordinates */
  int size;  /* number of coordinates in q */
  double q[RANDOM_SIZE];
  /* M = factor factor^T, with M_00 multiplied by 1 + q_0^2 / 4. */
  double factor[RANDOM_SIZE * RANDOM_SIZE];
  double force[RANDOM_SIZE];
  bool constant;
} random_body;

/* Random constraints. Row r is Phi_r = linear_r . d + square_r . d^2 / 2, with d = x - at. Here x
 * contains the coordinates of the constrained bodies, and d^2 the squares of the elements of d.
 * random_velocity_rows.c uses the numbers in another way. */
typedef struct random_rows {
  int rows;
  int columns;
  double linear[RANDOM_ROWS][RANDOM_SPAN * RANDOM_SIZE];
  double square[RANDOM_ROWS][RANDOM_SPAN * RANDOM_SIZE];
  double at[RANDOM_SPAN * RANDOM_SIZE];
  int fail_at; /* the call with this number fails; 0 if none fails */
  int answer;  /* return value of this call; if 0, its results are NaN instead */
} random_rows;

typedef struct random_mechanism {
  baum_mechanism *mechanism;
  chance chance;
  int body_count; /* includes ground, which is body 0 */
  random_body bodies[RANDOM_BODIES + 1];
  int joint_count;
  baum_joint_id joints[2 * RANDOM_JOINTS];
  char joint_kind[2 * RANDOM_JOINTS];
  int rows_count;
  random_rows rows[RANDOM_JOINTS + RANDOM_ROWS];
} random_mechanism;

/* Makes a frozen mechanism. Its functions keep pointers into *out, so *out must not be moved. */
void random_mechanism_make(random_mechanism *out, uint64_t seed, const random_kind *kind);
void random_mechanism_destroy(random_mechanism *out);

#endif
