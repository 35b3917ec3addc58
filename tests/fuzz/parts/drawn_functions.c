/* SPDX-License-Identifier: BSD-3-Clause */
#include "drawn_functions.h"

#include <math.h>
#include <string.h>

#include <baum/baum.h>

#include "drawn.h"

static int answer(void *user, double *out)
{
  design_user *u = user;
  if (!u || u->calls == 0 || --u->calls > 0) {
    return 0;
  }
  out[0] = u->answer == 0 ? (double)NAN : out[0];
  return u->answer;
}

/* ---- user coordinates: masses of 2, 1, 1, ... kg on springs ---- */

static int mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  const design_user *u = user;
  int size = u ? u->size : 1;
  for (int i = 0; i < size; i++) {
    out[i * size + i] = i == 0 ? 2.0 : 1.0;
  }
  return answer(user, out);
}

static int force(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  (void)t;
  (void)inputs;
  out[0] = -3.0 * q[0] - 0.1 * v[0];
  return answer(user, out);
}

static int force_q(double t, const double *q, const double *v, const double *inputs, double *out,
                   void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  out[0] = -3.0;
  return answer(user, out);
}

static int force_v(double t, const double *q, const double *v, const double *inputs, double *out,
                   void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  out[0] = -0.1;
  return answer(user, out);
}

static int potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = 1.5 * q[0] * q[0];
  return answer(user, out);
}

/* ---- user constraints: q_0 + 0.1 q_0^2 = 0.05 sin t ---- */

static int phi(double t, const double *q, double *out, void *user)
{
  out[0] = q[0] + 0.1 * q[0] * q[0] - 0.05 * sin(t);
  return answer(user, out);
}

static int jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = 1.0 + 0.2 * q[0];
  return answer(user, out);
}

static int nu(double t, const double *q, double *out, void *user)
{
  (void)q;
  out[0] = 0.05 * cos(t);
  return answer(user, out);
}

static int gamma_of(double t, const double *q, const double *v, double *out, void *user)
{
  (void)q;
  out[0] = -0.05 * sin(t) - 0.2 * v[0] * v[0];
  return answer(user, out);
}

/* ---- laws ---- */

static int driver_law(double t, double s[3], void *user)
{
  s[0] = 0.3 * sin(t);
  s[1] = 0.3 * cos(t);
  s[2] = -0.3 * sin(t);
  return answer(user, s);
}

static int coupling_law(double x, double f[3], void *user)
{
  f[0] = 0.5 * x + 0.1 * sin(x);
  f[1] = 0.5 + 0.1 * cos(x);
  f[2] = -0.1 * sin(x);
  return answer(user, f);
}

static int spring_law(double length, double rate, double out[3], void *user)
{
  out[0] = 2.0 * length + 0.1 * rate;
  out[1] = 2.0;
  out[2] = 0.1;
  return answer(user, out);
}

static int curve(const double xy[2], double out[6], void *user)
{
  out[0] = xy[1] - xy[0] * xy[0];
  out[1] = -2.0 * xy[0];
  out[2] = 1.0;
  out[3] = -2.0;
  return answer(user, out);
}

/* ---- the table ---- */

typedef void any_fn(void);

typedef struct row {
  const char *kind; /* NULL for every kind */
  const char *field;
  any_fn *function;
} row;

static const row rows[] = {
  {NULL, "mass", (any_fn *)mass},
  {NULL, "force", (any_fn *)force},
  {NULL, "force_q", (any_fn *)force_q},
  {NULL, "force_v", (any_fn *)force_v},
  {NULL, "potential", (any_fn *)potential},
  {NULL, "phi", (any_fn *)phi},
  {NULL, "jacobian", (any_fn *)jacobian},
  {NULL, "nu", (any_fn *)nu},
  {NULL, "gamma", (any_fn *)gamma_of},
  {"driver", "law", (any_fn *)driver_law},
  {"coupling", "law", (any_fn *)coupling_law},
  {NULL, "law", (any_fn *)spring_law},
  {NULL, "curve", (any_fn *)curve},
};

int design_function(const char *kind, const char *field, void *out)
{
  for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
    if (strcmp(rows[k].field, field) == 0 && (!rows[k].kind || strcmp(rows[k].kind, kind) == 0)) {
      memcpy(out, &rows[k].function, sizeof rows[k].function);
      return 1;
    }
  }
  return 0;
}
