/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism of the catalogue: one const struct at the end of its file. To add one: write a file
 * and add a line in catalog.c. */
#ifndef BAUM_I_CATALOG_CATALOG_H
#define BAUM_I_CATALOG_CATALOG_H

#include <baum/catalog.h>

#include "catalog/parts.h"

enum {
  BAUM_I_CATALOG_PARAMETERS = 12, /* most parameters of a mechanism */
  BAUM_I_CATALOG_COLUMNS = 9,     /* most columns of a sample */
  BAUM_I_CATALOG_WIDTH = 7        /* most coordinates of a body */
};

typedef enum baum_i_catalog_range {
  BAUM_I_ANY,
  BAUM_I_POSITIVE,
  BAUM_I_WHOLE /* > 0 */
} baum_i_catalog_range;

typedef struct baum_i_catalog_parameter {
  const char *name;
  const char *unit;
  const char *meaning;
  baum_i_catalog_range range;
} baum_i_catalog_parameter;

/* `p` below are the parameters, in the order of the mechanism's list. */
typedef struct baum_i_catalog_mechanism {
  const char *name;
  const char *title;
  const char *source;
  const char *provenance; /* "" without a reference */
  const char *note;       /* or NULL */
  int parameter_count;
  const baum_i_catalog_parameter *parameters;
  const double *defaults;
  double end;
  double digits_q;
  double digits_v;
  bool branches;                                       /* its motion passes bifurcations */
  void (*build)(baum_i_parts *parts, const double *p); /* adds all elements */

  const char *units; /* coordinates of a body: m length, r angle, u the user's */
  int bodies;        /* 0: the number is that of count() */
  int (*count)(const double *p);

  /* The reference: `samples` rows of some columns. They are stored or, where t is NULL, computed by
   * solution() at equal intervals. */
  int samples;
  const double *t; /* (samples) */
  int columns;
  const double *q; /* (samples x columns) */
  const double *v; /* (samples x columns) */
  double (*solution)(const double *p, double t, double *q,
                     double *v); /* returns a bound of their error */
  /* Computes positions and velocities of one body from the columns; NULL: the columns are those of
   * all bodies. */
  void (*state)(const double *p, const double *q, const double *v, int body, double *body_q,
                double *body_v);
} baum_i_catalog_mechanism;

/* A reference stored in data/. */
#define BAUM_I_CATALOG_STORED(NAME, DIGITS)                                            \
  .samples = NAME##_SAMPLES, .t = NAME##_T, .columns = NAME##_WIDTH, .q = NAME##_Q[0], \
  .v = NAME##_V[0], .digits_q = DIGITS, .digits_v = DIGITS

/* A stored reference of one column. */
#define BAUM_I_CATALOG_SERIES(NAME, DIGITS_Q, DIGITS_V)                                 \
  .samples = NAME##_SAMPLES, .t = NAME##_T, .columns = 1, .q = NAME##_Q, .v = NAME##_V, \
  .digits_q = DIGITS_Q, .digits_v = DIGITS_V

/* All mechanisms, in the order of their entries. */
/* clang-format off */
#define BAUM_I_CATALOG_LIST(X) \
  X(pendulum_a01) X(pendulum_sundials) X(pendulum_mebdf) \
  X(slider_crank) X(slider_crank_eccentric) X(slider_crank_driven) X(slider_crank_simeon) \
  X(slider_crank_sundials) X(four_bar) X(n_four_bar) \
  X(andrews_angles) X(andrews_bodies) X(andrews_a03) \
  X(car_axis) X(chain_of_3) X(chain_of_n)
/* clang-format on */

#define BAUM_I_CATALOG_DECLARE(name) extern const baum_i_catalog_mechanism baum_i_##name;
BAUM_I_CATALOG_LIST(BAUM_I_CATALOG_DECLARE)

/* Returns from the function if a call fails. */
#define BAUM_I_CATALOG_TRY(call) \
  do {                           \
    baum_status tried_ = (call); \
    if (tried_ != BAUM_OK) {     \
      return tried_;             \
    }                            \
  } while (0)

/* Sets this thread's message and returns the status. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
baum_status
baum_i_catalog_fail(baum_status status, const char *format, ...);

/* Copies as much of a whole struct as the caller knows, and sets its struct_size. BAUM_OK or
 * BAUM_ERR_ARGUMENT. */
baum_status baum_i_catalog_give(void *out, size_t caller_size, const void *whole, size_t size);

/* Finds a mechanism by its name; NULL, with a message, where there is none. */
const baum_i_catalog_mechanism *baum_i_catalog_find(const char *name);

/* Finds the mechanism and all its parameters. BAUM_OK or BAUM_ERR_ARGUMENT. */
baum_status baum_i_catalog_resolve(const baum_catalog_choice *choice,
                                   const baum_i_catalog_mechanism **out,
                                   double p[BAUM_I_CATALOG_PARAMETERS]);

/* Returns the number of bodies. */
int baum_i_catalog_bodies(const baum_i_catalog_mechanism *mechanism, const double *p);

#endif
