/* SPDX-License-Identifier: BSD-3-Clause */
#include "carried.h"

#include <string.h>

static void multiply(const jets a[4], const jets b[4], jets out[4])
{
  out[0] = jets_times(a[0], b[0]);
  for (int i = 1; i < 4; i++) {
    int j = i % 3 + 1;
    int k = j % 3 + 1;
    out[0] = jets_less(out[0], jets_times(a[i], b[i]));
    out[i] = jets_add(jets_add(jets_times(a[0], b[i]), jets_times(a[i], b[0])),
                      jets_less(jets_times(a[j], b[k]), jets_times(a[k], b[j])));
  }
}

carried carried_at(long double x, long double y, long double z)
{
  return (carried){{jets_constant(x), jets_constant(y), jets_constant(z)}, {jets_constant(1)}};
}

void carried_turn(carried *c, int axis, jets angle)
{
  jets before[4];
  jets by[4] = {jets_cos(jets_scale(0.5L, angle))};
  by[axis + 1] = jets_sin(jets_scale(0.5L, angle));
  memcpy(before, c->p, sizeof before);
  multiply(before, by, c->p);
}

void carried_go(carried *c, long double x, long double y, long double z)
{
  const jets s[4] = {jets_constant(0), jets_constant(x), jets_constant(y), jets_constant(z)};
  const jets back[4] = {c->p[0], jets_scale(-1, c->p[1]), jets_scale(-1, c->p[2]),
                        jets_scale(-1, c->p[3])};
  jets half[4];
  jets whole[4];
  multiply(c->p, s, half);
  multiply(half, back, whole);
  for (int i = 0; i < 3; i++) {
    c->r[i] = jets_add(c->r[i], whole[i + 1]);
  }
}

void carried_spin(const carried *c, int n, long double w[3])
{
  for (int i = 1; i < 4; i++) {
    int j = i % 3 + 1;
    int k = j % 3 + 1;
    w[i - 1] = 2 * (c->p[0].d[0] * c->p[i].d[n] - c->p[i].d[0] * c->p[0].d[n] -
                    c->p[j].d[0] * c->p[k].d[n] + c->p[k].d[0] * c->p[j].d[n]);
  }
}
