/* SPDX-License-Identifier: BSD-3-Clause */
#include "user_models.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"

/* ---- circle ---- */

static int circle_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  const user_model *m = user;
  out[0] = q[0] * q[0] + q[1] * q[1] - m->length * m->length;
  return 0;
}

static int circle_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 2.0 * q[0];
  out[1] = 2.0 * q[1];
  return 0;
}

static int circle_nu(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)out;
  (void)user;
  return 0;
}

static int circle_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[0] = -2.0 * (v[0] * v[0] + v[1] * v[1]);
  return 0;
}

static void circle_blocks(const user_model *model, double t, const double *q, const double *v,
                          const double *w, const double *lambda, user_blocks *out)
{
  (void)model;
  (void)t;
  (void)q;
  memset(out->jtl_q, 0, 4 * sizeof(double));
  for (int i = 0; i < 2; i++) {
    out->jw_q[i] = 2.0 * w[i];
    out->jtl_q[3 * i] = 2.0 * lambda[0];
    out->gamma_q[i] = 0.0;
    out->gamma_v[i] = -4.0 * v[i];
    out->nu_q[i] = 0.0;
  }
}

const user_kind user_circle = {.name = "circle",
                               .size = 2,
                               .rows = 1,
                               .phi = circle_phi,
                               .jacobian = circle_jacobian,
                               .nu = circle_nu,
                               .gamma = circle_gamma,
                               .blocks = circle_blocks};

/* ---- loop ---- */

static const double LOOP_R = 0.007;
static const double LOOP_D = 0.028;
static const double LOOP_S = 0.035;
static const double LOOP_X = -0.03635;
static const double LOOP_Y = 0.03273;

static int loop_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  double l = ((const user_model *)user)->length;
  double sum = q[0] + q[1];
  out[0] = l * (LOOP_R * cos(q[0]) - LOOP_D * cos(sum) - LOOP_S * sin(q[2]) - LOOP_X);
  out[1] = l * (LOOP_R * sin(q[0]) - LOOP_D * sin(sum) + LOOP_S * cos(q[2]) - LOOP_Y);
  return 0;
}

static int loop_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  double l = ((const user_model *)user)->length;
  double sum = q[0] + q[1];
  out[0] = l * (-LOOP_R * sin(q[0]) + LOOP_D * sin(sum));
  out[1] = l * LOOP_D * sin(sum);
  out[2] = -l * LOOP_S * cos(q[2]);
  out[3] = l * (LOOP_R * cos(q[0]) - LOOP_D * cos(sum));
  out[4] = -l * LOOP_D * cos(sum);
  out[5] = -l * LOOP_S * sin(q[2]);
  return 0;
}

static int loop_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  double l = ((const user_model *)user)->length;
  double sum = q[0] + q[1];
  double b2 = LOOP_R * v[0] * v[0];
  double s2 = LOOP_D * (v[0] + v[1]) * (v[0] + v[1]);
  double g2 = LOOP_S * v[2] * v[2];
  out[0] = l * (b2 * cos(q[0]) - s2 * cos(sum) - g2 * sin(q[2]));
  out[1] = l * (b2 * sin(q[0]) - s2 * sin(sum) + g2 * cos(q[2]));
  return 0;
}

/* Computes both rows of (J w)_q. */
static void loop_jw_q(double l, const double *q, const double *w, double *jw_q)
{
  double sum = q[0] + q[1];
  double ws = LOOP_D * (w[0] + w[1]);
  jw_q[0] = l * (-LOOP_R * cos(q[0]) * w[0] + ws * cos(sum));
  jw_q[1] = l * ws * cos(sum);
  jw_q[2] = l * LOOP_S * sin(q[2]) * w[2];
  jw_q[3] = l * (-LOOP_R * sin(q[0]) * w[0] + ws * sin(sum));
  jw_q[4] = l * ws * sin(sum);
  jw_q[5] = -l * LOOP_S * cos(q[2]) * w[2];
}

static void loop_gamma_q(double l, const double *q, const double *v, double *gamma_q)
{
  double sum = q[0] + q[1];
  double b2 = LOOP_R * v[0] * v[0];
  double s2 = LOOP_D * (v[0] + v[1]) * (v[0] + v[1]);
  double g2 = LOOP_S * v[2] * v[2];
  gamma_q[0] = l * (-b2 * sin(q[0]) + s2 * sin(sum));
  gamma_q[1] = l * s2 * sin(sum);
  gamma_q[2] = -l * g2 * cos(q[2]);
  gamma_q[3] = l * (b2 * cos(q[0]) - s2 * cos(sum));
  gamma_q[4] = -l * s2 * cos(sum);
  gamma_q[5] = -l * g2 * sin(q[2]);
}

static void loop_blocks(const user_model *model, double t, const double *q, const double *v,
                        const double *w, const double *lambda, user_blocks *out)
{
  (void)t;
  loop_jw_q(model->length, q, w, out->jw_q);
  loop_jw_q(model->length, q, v, out->gamma_v);
  loop_gamma_q(model->length, q, v, out->gamma_q);
  memset(out->nu_q, 0, 6 * sizeof(double));
  for (int i = 0; i < 6; i++) {
    out->gamma_v[i] *= -2.0;
  }
  for (int j = 0; j < 3; j++) {
    const double unit[3] = {j == 0, j == 1, j == 2};
    double column[6];
    loop_jw_q(model->length, q, unit, column);
    for (int i = 0; i < 3; i++) {
      out->jtl_q[3 * i + j] = lambda[0] * column[i] + lambda[1] * column[3 + i];
    }
  }
}

const user_kind user_loop = {.name = "loop",
                             .size = 3,
                             .rows = 2,
                             .angles = true,
                             .phi = loop_phi,
                             .jacobian = loop_jacobian,
                             .nu = circle_nu,
                             .gamma = loop_gamma,
                             .blocks = loop_blocks};

/* ---- swing ---- */

static int swing_phi(double t, const double *q, double *out, void *user)
{
  const user_model *m = user;
  double s = sin(m->rate * t);
  double c = cos(m->rate * t);
  out[0] = q[0] * s + q[1] * q[1] * c / m->length - m->length * s * c;
  return 0;
}

static int swing_jacobian(double t, const double *q, double *out, void *user)
{
  const user_model *m = user;
  out[0] = sin(m->rate * t);
  out[1] = 2.0 * q[1] * cos(m->rate * t) / m->length;
  return 0;
}

static int swing_nu(double t, const double *q, double *out, void *user)
{
  const user_model *m = user;
  double s = sin(m->rate * t);
  double c = cos(m->rate * t);
  double l = m->length;
  out[0] = -m->rate * (q[0] * c - q[1] * q[1] * s / l - l * (c * c - s * s));
  return 0;
}

static int swing_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  const user_model *m = user;
  double s = sin(m->rate * t);
  double c = cos(m->rate * t);
  double l = m->length;
  double w = m->rate;
  out[0] = -2.0 * c * v[1] * v[1] / l - 2.0 * w * (c * v[0] - 2.0 * q[1] * s * v[1] / l) -
           w * w * (-q[0] * s - q[1] * q[1] * c / l + 4.0 * l * s * c);
  return 0;
}

static void swing_blocks(const user_model *model, double t, const double *q, const double *v,
                         const double *w, const double *lambda, user_blocks *out)
{
  double l = model->length;
  double rate = model->rate;
  double s = sin(rate * t);
  double c = cos(rate * t);
  memset(out->jtl_q, 0, 4 * sizeof(double));
  out->jw_q[0] = 0.0;
  out->jw_q[1] = 2.0 * c * w[1] / l;
  out->jtl_q[3] = 2.0 * c * lambda[0] / l;
  out->gamma_q[0] = rate * rate * s;
  out->gamma_q[1] = 4.0 * rate * s * v[1] / l + 2.0 * rate * rate * q[1] * c / l;
  out->gamma_v[0] = -2.0 * rate * c;
  out->gamma_v[1] = -4.0 * c * v[1] / l + 4.0 * rate * q[1] * s / l;
  out->nu_q[0] = -rate * c;
  out->nu_q[1] = 2.0 * rate * q[1] * s / l;
}

const user_kind user_swing = {.name = "swing",
                              .size = 2,
                              .rows = 1,
                              .phi = swing_phi,
                              .jacobian = swing_jacobian,
                              .nu = swing_nu,
                              .gamma = swing_gamma,
                              .blocks = swing_blocks};

/* ---- mechanisms ---- */

static int unit_mass(int size, double *out)
{
  for (int i = 0; i < size; i++) {
    out[i * size + i] = 1.0;
  }
  return 0;
}

static int unit_mass_2(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  return unit_mass(2, out);
}

static int unit_mass_3(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  return unit_mass(3, out);
}

int user_mass_of_first(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[0] = 1.0;
  return 0;
}

int user_no_force(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  (void)out;
  (void)user;
  return 0;
}

int user_never_asked(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)out;
  (void)user;
  fail();
  return 0;
}

int user_never_pushed(double t, const double *q, const double *v, const double *inputs, double *out,
                      void *user)
{
  (void)v;
  (void)inputs;
  return user_never_asked(t, q, out, user);
}

baum_body_id user_add_coordinates(baum_mechanism *mechanism, int size, const double *q,
                                  double scale)
{
  const double scales[3] = {scale, scale, scale};
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = size;
  def.q = q;
  def.scale = scales;
  def.mass = size == 2 ? unit_mass_2 : unit_mass_3;
  def.force = user_no_force;
  baum_body_id id = {0};
  assert_int_equal(baum_mechanism_add_coordinates(mechanism, &def, &id), BAUM_OK);
  return id;
}

baum_mechanism *user_make(const user_kind *kind, user_model *model, int given)
{
  double size = kind->angles ? 1.0 : model->length;
  const double q[3] = {0.6 * size, -0.8 * size, 0.3 * size};
  baum_mechanism *mechanism = create_mechanism();
  baum_body_id body = user_add_coordinates(mechanism, kind->size, q, size);
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = kind->name;
  def.bodies = &body;
  def.body_count = 1;
  def.row_count = kind->rows;
  def.phi = kind->phi;
  def.jacobian = given & GIVE_JACOBIAN ? kind->jacobian : NULL;
  def.nu = given & GIVE_NU ? kind->nu : NULL;
  def.gamma = given & GIVE_GAMMA ? kind->gamma : NULL;
  def.user = model;
  assert_int_equal(baum_mechanism_add_user_constraint(mechanism, &def, NULL), BAUM_OK);
  return mechanism;
}
