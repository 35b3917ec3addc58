/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism of the catalogue from the inside: one const struct, stated at the end of its file.
 * Adding one is a file and a line in catalog.c. */
#ifndef BAUM_I_CATALOG_CATALOG_H
#define BAUM_I_CATALOG_CATALOG_H

#include <baum/catalog.h>

#include "catalog/parts.h"

enum {
  BAUM_I_CATALOG_PARAMETERS = 12, /* at most, of one mechanism */
  BAUM_I_CATALOG_COLUMNS = 9,     /* at most, of a sample */
  BAUM_I_CATALOG_WIDTH = 7        /* at most, coordinates of one body */
};

typedef enum baum_i_catalog_range {
  BAUM_I_ANY,
  BAUM_I_POSITIVE,
  BAUM_I_WHOLE /* > 0, too */
} baum_i_catalog_range;

typedef struct baum_i_catalog_parameter {
  const char *name;
  const char *unit;
  const char *meaning;
  baum_i_catalog_range range;
} baum_i_catalog_parameter;

/* Parameters, in the order of the mechanism's list, are `p` below. */
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
  bool branches; /* passes configurations where its motion does */
  void (*build)(baum_i_parts *parts, const double *p); /* adds all of it */

  const char *units; /* coordinates of a body: m length, r angle, u the user's */
  int bodies;        /* 0: count() tells */
  int (*count)(const double *p);

  /* The reference: `samples` of some columns, stored or, when t is NULL, by solution() at equal
   * intervals. */
  int samples;
  const double *t; /* (samples) */
  int columns;
  const double *q; /* (samples x columns) */
  const double *v; /* (samples x columns) */
  double (*solution)(const double *p, double t, double *q,
                     double *v); /* by how much they may be off */
  /* Positions and velocities of one body from the columns; NULL: the columns are those of all
   * bodies. */
  void (*state)(const double *p, const double *q, const double *v, int body, double *body_q,
                double *body_v);
} baum_i_catalog_mechanism;

/* The reference stored in data/. */
#define BAUM_I_CATALOG_STORED(NAME, DIGITS)                                            \
  .samples = NAME##_SAMPLES, .t = NAME##_T, .columns = NAME##_WIDTH, .q = NAME##_Q[0], \
  .v = NAME##_V[0], .digits_q = DIGITS, .digits_v = DIGITS

/* The same of one column. */
#define BAUM_I_CATALOG_SERIES(NAME, DIGITS_Q, DIGITS_V)                                 \
  .samples = NAME##_SAMPLES, .t = NAME##_T, .columns = 1, .q = NAME##_Q, .v = NAME##_V, \
  .digits_q = DIGITS_Q, .digits_v = DIGITS_V

extern const baum_i_catalog_mechanism baum_i_pendulum_a01;
extern const baum_i_catalog_mechanism baum_i_pendulum_sundials;
extern const baum_i_catalog_mechanism baum_i_pendulum_mebdf;
extern const baum_i_catalog_mechanism baum_i_slider_crank;
extern const baum_i_catalog_mechanism baum_i_slider_crank_eccentric;
extern const baum_i_catalog_mechanism baum_i_slider_crank_driven;
extern const baum_i_catalog_mechanism baum_i_slider_crank_simeon;
extern const baum_i_catalog_mechanism baum_i_slider_crank_sundials;
extern const baum_i_catalog_mechanism baum_i_four_bar;
extern const baum_i_catalog_mechanism baum_i_n_four_bar;
extern const baum_i_catalog_mechanism baum_i_andrews_angles;
extern const baum_i_catalog_mechanism baum_i_andrews_bodies;
extern const baum_i_catalog_mechanism baum_i_andrews_a03;
extern const baum_i_catalog_mechanism baum_i_car_axis;
extern const baum_i_catalog_mechanism baum_i_chain_of_3;
extern const baum_i_catalog_mechanism baum_i_chain_of_n;

/* Return the status of a call that is not BAUM_OK. */
#define BAUM_I_CATALOG_TRY(call) \
  do {                           \
    baum_status tried_ = (call); \
    if (tried_ != BAUM_OK) {     \
      return tried_;             \
    }                            \
  } while (0)

/* Set this thread's message and return the status. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
baum_status
baum_i_catalog_fail(baum_status status, const char *format, ...);

/* As much of a whole struct as the caller knows; its struct_size is set. BAUM_OK or
 * BAUM_ERR_ARGUMENT. */
baum_status baum_i_catalog_give(void *out, size_t caller_size, const void *whole, size_t size);

/* A mechanism by its name; NULL when there is none, and the message is set. */
const baum_i_catalog_mechanism *baum_i_catalog_find(const char *name);

/* The mechanism and all its parameters. BAUM_OK or BAUM_ERR_ARGUMENT. */
baum_status baum_i_catalog_resolve(const baum_catalog_choice *choice,
                                   const baum_i_catalog_mechanism **out,
                                   double p[BAUM_I_CATALOG_PARAMETERS]);

/* Number of its bodies. */
int baum_i_catalog_bodies(const baum_i_catalog_mechanism *mechanism, const double *p);

#endif
