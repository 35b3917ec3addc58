/* SPDX-License-Identifier: BSD-3-Clause */
/* Compute F_qq = G^T G + diag(0 0 d . p_a 0 0 -d . p_b), see separation.h. */
#include "mechanism/planar/separation.h"

#include <math.h>

void baum_i_separation_hessian(const baum_i_separation *s, double hessian[36])
{
  const double *g = s->g_angle;
  const double columns[6][2] = {{-1.0, 0.0}, {0.0, -1.0}, {g[0], g[1]},
                                {1.0, 0.0},  {0.0, 1.0},  {g[2], g[3]}};
  for (int j = 0; j < 6; j++) {
    /* Column j of G^T G is written as row j, because the matrix is symmetric. */
    baum_i_separation_spread(s, columns[j], hessian + (size_t)6 * j);
  }
  /* The arms follow from g: p_a = (-g[1], g[0]) and p_b = (g[3], -g[2]). */
  hessian[2 * 6 + 2] += -s->d[0] * g[1] + s->d[1] * g[0];
  hessian[5 * 6 + 5] -= s->d[0] * g[3] - s->d[1] * g[2];
}

double baum_i_separation_in_design(const baum_mechanism *mechanism, const baum_i_span *span,
                                   const double points[4])
{
  double at[2][2];
  for (int k = 0; k < 2; k++) {
    baum_i_frame frame = baum_i_design_frame(mechanism, span->bodies[k]);
    baum_i_marker marker = baum_i_marker_on(&frame, points + (size_t)2 * k);
    at[k][0] = marker.r[0];
    at[k][1] = marker.r[1];
  }
  return hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]);
}
