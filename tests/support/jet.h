/* SPDX-License-Identifier: BSD-3-Clause */
/* A jet consists of the value of a function of time and of its first two derivatives. This file
 * computes with jets and with vectors of jets. */
#ifndef BAUM_TEST_JET_H
#define BAUM_TEST_JET_H

#include <math.h>

#include "quad.h"

typedef struct jet {
  wide d[3];
} jet;

static inline jet jet_add(jet a, jet b)
{
  return (jet){{a.d[0] + b.d[0], a.d[1] + b.d[1], a.d[2] + b.d[2]}};
}

static inline jet jet_scale(wide factor, jet a)
{
  return (jet){{factor * a.d[0], factor * a.d[1], factor * a.d[2]}};
}

static inline jet jet_less(jet a, jet b)
{
  return jet_add(a, jet_scale(-1, b));
}

static inline jet jet_times(jet a, jet b)
{
  return (jet){{a.d[0] * b.d[0], a.d[1] * b.d[0] + a.d[0] * b.d[1],
                a.d[2] * b.d[0] + 2 * a.d[1] * b.d[1] + a.d[0] * b.d[2]}};
}

static inline jet jet_root(jet a)
{
  wide root = wide_root(a.d[0]);
  wide rate = a.d[1] / (2 * root);
  return (jet){{root, rate, (a.d[2] / 2 - rate * rate) / root}};
}

static inline jet jet_quotient(jet a, jet b)
{
  wide value = a.d[0] / b.d[0];
  wide rate = (a.d[1] - value * b.d[1]) / b.d[0];
  return (jet){{value, rate, (a.d[2] - 2 * rate * b.d[1] - value * b.d[2]) / b.d[0]}};
}

/* Returns the derivative of a. The second derivative of the result is not known, and set to 0. */
static inline jet jet_rate(jet a)
{
  return (jet){{a.d[1], a.d[2], 0}};
}

/* Returns the angle whose cosine and sine are proportional to c and s. The value of this jet has
 * only double precision. */
static inline jet jet_angle(jet c, jet s)
{
  wide square = c.d[0] * c.d[0] + s.d[0] * s.d[0];
  wide rate = (c.d[0] * s.d[1] - s.d[0] * c.d[1]) / square;
  wide square_rate = 2 * (c.d[0] * c.d[1] + s.d[0] * s.d[1]);
  return (jet){{atan2((double)s.d[0], (double)c.d[0]), rate,
                (c.d[0] * s.d[2] - s.d[0] * c.d[2] - rate * square_rate) / square}};
}

static inline jet jet_dot(const jet a[3], const jet b[3])
{
  return jet_add(jet_times(a[0], b[0]), jet_add(jet_times(a[1], b[1]), jet_times(a[2], b[2])));
}

static inline void jet_cross(const jet a[3], const jet b[3], jet out[3])
{
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3;
    int k = (i + 2) % 3;
    out[i] = jet_less(jet_times(a[j], b[k]), jet_times(a[k], b[j]));
  }
}

#endif
