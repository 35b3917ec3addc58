/* SPDX-License-Identifier: BSD-3-Clause */
/* User constraints on user coordinates. All their derivatives are known in closed form.
 *
 *   circle  (x, y)        Phi = x^2 + y^2 - l^2
 *   loop    (b, th, ga)   the first loop of Andrews' squeezer; r, d, s, x_b and y_b are l times the
 *                         constants LOOP_* of user_models.c:
 *                         Phi = (r cos b - d cos(b + th) - s sin ga - x_b, r sin b - d sin(b + th)
 *                         + s cos ga - y_b)
 *   swing   (x, y)        Phi = x sin(w t) + y^2 cos(w t) / l - l sin(w t) cos(w t)
 */
#ifndef BAUM_TEST_USER_MODELS_H
#define BAUM_TEST_USER_MODELS_H

#include <baum/mechanism.h>

/* All functions of these constraints receive a pointer to this struct as their `user`. */
typedef struct user_model {
  double length; /* l */
  double rate;   /* w */
} user_model;

/* Tells which derivatives of a constraint are given. The values are combined with |. */
enum { GIVE_NOTHING = 0, GIVE_JACOBIAN = 1, GIVE_NU = 2, GIVE_GAMMA = 4, GIVE_ALL = 7 };

/* Second derivatives, as in baum_i_joint_blocks. */
typedef struct user_blocks {
  double jw_q[9];
  double jtl_q[9];
  double gamma_q[9];
  double gamma_v[9];
  double nu_q[9];
} user_blocks;

typedef struct user_kind {
  const char *name;
  int size; /* number of coordinates */
  int rows;
  bool angles; /* whether the coordinates are angles; otherwise they are lengths */
  baum_q_fn *phi;
  baum_q_fn *jacobian;
  baum_q_fn *nu;
  baum_qv_fn *gamma;
  void (*blocks)(const user_model *model, double t, const double *q, const double *v,
                 const double *w, const double *lambda, user_blocks *out);
} user_kind;

extern const user_kind user_circle;
extern const user_kind user_loop;
extern const user_kind user_swing;

/* The mass of the first coordinate is 1, and the masses of the others are 0. */
int user_mass_of_first(double t, const double *q, double *out, void *user);

/* A force that is zero. */
int user_no_force(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user);

/* If either of these functions is called, the test fails. */
int user_never_asked(double t, const double *q, double *out, void *user);
int user_never_pushed(double t, const double *q, const double *v, const double *inputs, double *out,
                      void *user);

/* Adds 2 or 3 coordinates (`size`) with unit masses. Their design values are q, and they have one
 * common scale. */
baum_body_id user_add_coordinates(baum_mechanism *mechanism, int size, const double *q,
                                  double scale);

/* Makes a mechanism with one body and the constraint on it. The mechanism is not frozen. The design
 * coordinates are about l, or about 1 if they are angles. */
baum_mechanism *user_make(const user_kind *kind, user_model *model, int given);

#endif
