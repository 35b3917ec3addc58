/* SPDX-License-Identifier: BSD-3-Clause */
/* Every mechanism of the catalogue is a const struct at the end of a file. To add a mechanism,
 * write such a file and add the name of the struct without baum_i_ to BAUM_I_CATALOG_LIST below. */
#ifndef BAUM_I_CATALOG_CATALOG_H
#define BAUM_I_CATALOG_CATALOG_H

#include <baum/catalog.h>

#include "catalog/parts.h"

enum {
  BAUM_I_CATALOG_PARAMETERS = 14, /* largest number of parameters of a mechanism */
  BAUM_I_CATALOG_COLUMNS = 9      /* largest number of columns of a sample */
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

/* `p` below are the values of the parameters, in the order of `parameters`. */
typedef struct baum_i_catalog_mechanism {
  const char *name;
  const char *title;
  const char *source;
  const char *provenance; /* "" if there is no reference */
  const char *note;       /* or NULL */
  int parameter_count;
  const baum_i_catalog_parameter *parameters;
  const double *defaults;
  double end;
  double digits_q;
  double digits_v;
  bool branches;                                       /* the motion passes bifurcations */
  void (*build)(baum_i_parts *parts, const double *p); /* adds all elements */

  /* One letter for each coordinate of a body: m length, r angle, u user coordinate, q component of
   * a quaternion, after three lengths. */
  const char *units;
  int bodies; /* 0: count() returns the number */
  int (*count)(const double *p);

  /* The reference: `samples` rows of `columns` numbers. They are stored or, if t is NULL, computed
   * by solution() at equal intervals. */
  int samples;
  const double *t; /* (samples) */
  int columns;
  const double *q; /* (samples x columns) */
  const double *v; /* (samples x columns) */
  double (*solution)(const double *p, double t, double *q,
                     double *v); /* returns an error bound of q and v */
  /* Computes the state of one body from the columns; NULL: the columns are the coordinates of all
   * bodies. */
  baum_i_body_state (*state)(const double *p, const double *q, const double *v, int body);
} baum_i_catalog_mechanism;

/* Sets the fields of a mechanism with a constant number of bodies. */
#define BAUM_I_CATALOG_MODEL(PARAMETERS, BUILD, STATE, UNITS, BODIES)                  \
  .parameter_count = sizeof PARAMETERS / sizeof *PARAMETERS, .parameters = PARAMETERS, \
  .build = BUILD, .state = STATE, .units = UNITS, .bodies = BODIES

/* Sets the fields of a reference that is computed. */
#define BAUM_I_CATALOG_COMPUTED(SOLUTION, SAMPLES, COLUMNS, DIGITS)                 \
  .solution = SOLUTION, .samples = SAMPLES, .columns = COLUMNS, .digits_q = DIGITS, \
  .digits_v = DIGITS

/* Sets the fields of a reference that is stored in data/. */
#define BAUM_I_CATALOG_STORED(NAME, DIGITS)                                            \
  .samples = NAME##_SAMPLES, .t = NAME##_T, .columns = NAME##_WIDTH, .q = NAME##_Q[0], \
  .v = NAME##_V[0], .digits_q = DIGITS, .digits_v = DIGITS

/* Sets the fields of a stored reference with one column. */
#define BAUM_I_CATALOG_SERIES(NAME, DIGITS_Q, DIGITS_V)                                 \
  .samples = NAME##_SAMPLES, .t = NAME##_T, .columns = 1, .q = NAME##_Q, .v = NAME##_V, \
  .digits_q = DIGITS_Q, .digits_v = DIGITS_V

/* All mechanisms, in the order of baum_catalog_entry_at(). */
/* clang-format off */
#define BAUM_I_CATALOG_LIST(X) \
  X(pendulum_a01) X(pendulum_sundials) X(pendulum_mebdf) \
  X(slider_crank) X(slider_crank_eccentric) X(slider_crank_driven) X(slider_crank_simeon) \
  X(slider_crank_sundials) X(four_bar) X(n_four_bar) \
  X(andrews_angles) X(andrews_bodies) X(andrews_a03) \
  X(car_axis) X(chain_of_3) X(chain_of_n) \
  X(spatial_slider_crank) X(rssr) X(bricard) X(flyball) X(flyball_stiff) X(heavy_top) X(robot_arm)
/* clang-format on */

#define BAUM_I_CATALOG_DECLARE(name) extern const baum_i_catalog_mechanism baum_i_##name;
BAUM_I_CATALOG_LIST(BAUM_I_CATALOG_DECLARE)

/* Returns from the calling function with the status of a call that fails. */
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

/* Copies at most caller_size bytes of a struct and sets its struct_size. Returns BAUM_OK or
 * BAUM_ERR_ARGUMENT. */
baum_status baum_i_catalog_give(void *out, size_t caller_size, const void *whole, size_t size);

/* Finds a mechanism by its name. Returns NULL and sets the message if there is none. */
const baum_i_catalog_mechanism *baum_i_catalog_find(const char *name);

/* Finds the mechanism of a choice and the values of all its parameters. Returns BAUM_OK or
 * BAUM_ERR_ARGUMENT. */
baum_status baum_i_catalog_resolve(const baum_catalog_choice *choice,
                                   const baum_i_catalog_mechanism **out,
                                   double p[BAUM_I_CATALOG_PARAMETERS]);

/* Returns the number of bodies of a mechanism with parameters p. */
int baum_i_catalog_bodies(const baum_i_catalog_mechanism *mechanism, const double *p);

#endif
