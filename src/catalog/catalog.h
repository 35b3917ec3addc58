/* SPDX-License-Identifier: BSD-3-Clause */
/* Every mechanism of the catalogue is a const struct at the end of a source file. To add a
 * mechanism, write such a file and add the name of its struct, without baum_i_, to
 * BAUM_I_CATALOG_LIST below. */
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
  BAUM_I_NONZERO,
  BAUM_I_ACUTE, /* an angle between -pi/2 and pi/2 */
  BAUM_I_POSITIVE,
  BAUM_I_WHOLE /* a whole number > 0 */
} baum_i_catalog_range;

typedef struct baum_i_catalog_parameter {
  const char *name;
  const char *unit;
  const char *meaning;
  baum_i_catalog_range range;
} baum_i_catalog_parameter;

/* In the members of this struct, `p` are the values of the parameters, in the order of
 * `parameters`. */
typedef struct baum_i_catalog_mechanism {
  const char *name;
  const char *title;
  const char *source;
  const char *provenance; /* "" if there is no reference */
  const char *note;       /* or NULL */
  int parameter_count;
  const baum_i_catalog_parameter *parameters;
  const double *defaults;
  double end;      /* [s] end of the motion and of its reference */
  double digits_q; /* number of correct digits in the positions of the reference */
  double digits_v; /* the same for velocities */
  bool branches;   /* whether the motion passes bifurcations */
  void (*build)(baum_i_parts *parts, const double *p); /* adds all elements of the mechanism */

  /* One letter for each coordinate of a body: m for a length, r for an angle, u for a user
   * coordinate. Components of a quaternion have the letter q, and follow three lengths. */
  const char *units;
  int bodies; /* number of bodies, or 0 if count() returns it */
  int (*count)(const double *p);

  /* The reference has `samples` rows with `columns` numbers each. If t is not NULL, the rows are
   * stored. If t is NULL, solution() computes them at equal intervals of time. */
  int samples;
  const double *t; /* (samples) */
  int columns;
  const double *q; /* (samples x columns) */
  const double *v; /* (samples x columns) */
  double (*solution)(const double *p, double t, double *q,
                     double *v); /* returns a bound of the errors of q and v */
  /* Computes the state of one body from the columns of a sample. If state() is NULL, the columns
   * are the coordinates of all bodies. */
  baum_i_body_state (*state)(const double *p, const double *q, const double *v, int body);
} baum_i_catalog_mechanism;

/* Sets the members that describe a mechanism. BODIES is the number of bodies, or 0 if count()
 * returns it. */
#define BAUM_I_CATALOG_MODEL(PARAMETERS, BUILD, STATE, UNITS, BODIES)                  \
  .parameter_count = sizeof PARAMETERS / sizeof *PARAMETERS, .parameters = PARAMETERS, \
  .build = BUILD, .state = STATE, .units = UNITS, .bodies = BODIES

/* Sets the members that describe a reference computed by a function. */
#define BAUM_I_CATALOG_COMPUTED(SOLUTION, SAMPLES, COLUMNS, DIGITS)                 \
  .solution = SOLUTION, .samples = SAMPLES, .columns = COLUMNS, .digits_q = DIGITS, \
  .digits_v = DIGITS

/* Sets the members that describe a reference stored in data/. */
#define BAUM_I_CATALOG_STORED(NAME, DIGITS)                                            \
  .samples = NAME##_SAMPLES, .t = NAME##_T, .columns = NAME##_WIDTH, .q = NAME##_Q[0], \
  .v = NAME##_V[0], .digits_q = DIGITS, .digits_v = DIGITS

/* Sets the members that describe a stored reference with only one column. */
#define BAUM_I_CATALOG_SERIES(NAME, DIGITS_Q, DIGITS_V)                                 \
  .samples = NAME##_SAMPLES, .t = NAME##_T, .columns = 1, .q = NAME##_Q, .v = NAME##_V, \
  .digits_q = DIGITS_Q, .digits_v = DIGITS_V

/* The names of all mechanisms, in the order of baum_catalog_entry_at(). */
/* clang-format off */
#define BAUM_I_CATALOG_LIST(X) \
  X(pendulum_a01) X(pendulum_sundials) X(pendulum_mebdf) \
  X(slider_crank) X(slider_crank_eccentric) X(slider_crank_driven) X(slider_crank_simeon) \
  X(slider_crank_sundials) X(four_bar) X(n_four_bar) \
  X(andrews_angles) X(andrews_bodies) X(andrews_a03) \
  X(car_axis) X(chain_of_3) X(chain_of_n) \
  X(spatial_slider_crank) X(rssr) X(bricard) X(flyball) X(flyball_stiff) X(heavy_top) X(robot_arm) \
  X(rolling_disc) X(chaplygin_sleigh) X(stewart) X(differential) X(gimbals) X(double_wishbone) \
  X(quadruped)
/* clang-format on */

#define BAUM_I_CATALOG_DECLARE(name) extern const baum_i_catalog_mechanism baum_i_##name;
BAUM_I_CATALOG_LIST(BAUM_I_CATALOG_DECLARE)

/* If a call fails, returns its status from the function that uses this macro. */
#define BAUM_I_CATALOG_TRY(call) \
  do {                           \
    baum_status tried_ = (call); \
    if (tried_ != BAUM_OK) {     \
      return tried_;             \
    }                            \
  } while (0)

/* Sets the message of this thread and returns the status. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
baum_status
baum_i_catalog_fail(baum_status status, const char *format, ...);

/* Copies a struct to the caller, but at most caller_size bytes of it, and sets struct_size in the
 * copy. Returns BAUM_OK or BAUM_ERR_ARGUMENT. */
baum_status baum_i_catalog_give(void *out, size_t caller_size, const void *whole, size_t size);

/* Finds a mechanism by its name. If there is no such mechanism, returns NULL and sets the
 * message. */
const baum_i_catalog_mechanism *baum_i_catalog_find(const char *name);

/* Finds the mechanism that a caller has chosen, and the values of all its parameters. Returns
 * BAUM_OK or BAUM_ERR_ARGUMENT. */
baum_status baum_i_catalog_resolve(const baum_catalog_choice *choice,
                                   const baum_i_catalog_mechanism **out,
                                   double p[BAUM_I_CATALOG_PARAMETERS]);

/* Returns how many bodies a mechanism has with the parameters p. */
int baum_i_catalog_bodies(const baum_i_catalog_mechanism *mechanism, const double *p);

#endif
