/* SPDX-License-Identifier: BSD-3-Clause */
/* Constraints and coordinates by user functions, with all their derivatives in closed form.
 *
 *   circle  (x, y)        Phi = x^2 + y^2 - l^2
 *   loop    (b, th, ga)   the first loop of Andrews' squeezer, lengths times l:
 *                         Phi = (r cos b - d cos(b + th) - s sin ga - x_b, r sin b - d sin(b + th)
 *                         + s cos ga - y_b)
 *   swing   (x, y)        Phi = x sin(w t) + y^2 cos(w t) / l - l sin(w t) cos(w t)
 */
#ifndef BAUM_TEST_USER_MODELS_H
#define BAUM_TEST_USER_MODELS_H

#include <baum/mechanism.h>

/* The `user` of all functions of these constraints. */
typedef struct user_model {
  double length; /* l */
  double rate;   /* w */
} user_model;

/* The derivatives of a constraint that are given, to be combined with |. */
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
  bool angles; /* coordinates are angles, not lengths */
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

/* The mass is 1 for the first coordinate and 0 for the others. */
int user_mass_of_first(double t, const double *q, double *out, void *user);

/* A zero force. */
int user_no_force(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user);

/* Both functions fail the test if they are called. */
int user_never_asked(double t, const double *q, double *out, void *user);
int user_never_pushed(double t, const double *q, const double *v, const double *inputs, double *out,
                      void *user);

/* Adds `size` coordinates (2 or 3) with unit mass, the design values q and one common scale. */
baum_body_id user_add_coordinates(baum_mechanism *mechanism, int size, const double *q,
                                  double scale);

/* Makes a mechanism, not frozen, of one body and the constraint on it. The design coordinates are
 * of size l, or of size 1 for angles. */
baum_mechanism *user_make(const user_kind *kind, user_model *model, int given);

#endif
