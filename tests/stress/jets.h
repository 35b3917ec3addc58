/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes with functions of one angle, together with their first and second derivatives, in long
 * double. */
#ifndef BAUM_TEST_JETS_H
#define BAUM_TEST_JETS_H

#include <math.h>

typedef struct jets {
  long double d[3];
} jets;

static inline jets jets_constant(long double x)
{
  return (jets){{x, 0, 0}};
}

static inline jets jets_add(jets a, jets b)
{
  return (jets){{a.d[0] + b.d[0], a.d[1] + b.d[1], a.d[2] + b.d[2]}};
}

static inline jets jets_scale(long double factor, jets a)
{
  return (jets){{factor * a.d[0], factor * a.d[1], factor * a.d[2]}};
}

static inline jets jets_less(jets a, jets b)
{
  return jets_add(a, jets_scale(-1, b));
}

static inline jets jets_times(jets a, jets b)
{
  return (jets){{a.d[0] * b.d[0], a.d[1] * b.d[0] + a.d[0] * b.d[1],
                 a.d[2] * b.d[0] + 2 * a.d[1] * b.d[1] + a.d[0] * b.d[2]}};
}

/* Returns f(a) by the chain rule. The arguments f, f1 and f2 are f, f' and f'' at the value of
 * a. */
static inline jets jets_chain(long double f, long double f1, long double f2, jets a)
{
  return (jets){{f, f1 * a.d[1], f2 * a.d[1] * a.d[1] + f1 * a.d[2]}};
}

static inline jets jets_sin(jets a)
{
  return jets_chain(sinl(a.d[0]), cosl(a.d[0]), -sinl(a.d[0]), a);
}

static inline jets jets_cos(jets a)
{
  return jets_chain(cosl(a.d[0]), -sinl(a.d[0]), -cosl(a.d[0]), a);
}

static inline jets jets_root(jets a)
{
  long double r = sqrtl(a.d[0]);
  return jets_chain(r, 1 / (2 * r), -1 / (4 * r * a.d[0]), a);
}

/* Returns 1 / a. */
static inline jets jets_inverse(jets a)
{
  long double x = 1 / a.d[0];
  return jets_chain(x, -x * x, 2 * x * x * x, a);
}

/* Returns atan2(y, x). */
static inline jets jets_angle(jets x, jets y)
{
  long double square = x.d[0] * x.d[0] + y.d[0] * y.d[0];
  long double rate = (x.d[0] * y.d[1] - y.d[0] * x.d[1]) / square;
  long double growth = 2 * (x.d[0] * x.d[1] + y.d[0] * y.d[1]);
  return (jets){
    {atan2l(y.d[0], x.d[0]), rate, (x.d[0] * y.d[2] - y.d[0] * x.d[2] - rate * growth) / square}};
}

#endif
