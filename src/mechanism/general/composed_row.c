/* SPDX-License-Identifier: BSD-3-Clause */
/* The chain rule for a row Phi = G(c_0, c_1). With g_i = (c_i)_q, H_i = (c_i)_qq, r_i = c_i' = g_i
 * v, gamma_i such that g_i a = c_i'' + gamma_i, that is gamma_i = -v^T H_i v, and sums over i, j,
 * k:
 *
 *   J       = G_i g_i
 *   gamma   = G_i gamma_i - G_ij r_i r_j
 *   (J w)_q = G_i H_i w + G_ij (g_j w) g_i
 *   (J^T lambda)_q = lambda (G_i H_i + G_ij g_i g_j^T)
 *   gamma_v = G_i (gamma_i)_v - 2 G_ij r_j g_i
 *   gamma_q = G_i (gamma_i)_q + (G_ik gamma_i - G_ijk r_i r_j) g_k + G_ij r_j (gamma_i)_v
 *
 * the last because (r_i)_q = H_i v = -(gamma_i)_v / 2.
 */
#include "mechanism/general/composed_row.h"

#include <string.h>

#include "mechanism/general/columns.h"

void baum_i_composed_narrow(const baum_i_inner *inner, const double *wide, double six[6])
{
  for (int i = 0; i < 6; i++) {
    six[i] = wide[inner->at[i / 3] + i % 3];
  }
}

/* wide += factor six */
static void add(const baum_i_inner *inner, double factor, const double six[6], double *wide)
{
  for (int i = 0; i < 6; i++) {
    wide[inner->at[i / 3] + i % 3] += factor * six[i];
  }
}

static void find_gradient(const baum_i_inner x[2], const baum_i_outer *g,
                          double wide[BAUM_I_COMPOSED_COLUMNS])
{
  memset(wide, 0, BAUM_I_COMPOSED_COLUMNS * sizeof *wide);
  for (int i = 0; i < 2; i++) {
    add(&x[i], g->first[i], x[i].c.gradient, wide);
  }
}

static double find_gamma(const baum_i_inner x[2], const baum_i_outer *g)
{
  double sum = 0.0;
  for (int i = 0; i < 2; i++) {
    sum += g->first[i] * x[i].c.gamma;
    for (int j = 0; j < 2; j++) {
      sum -= g->second[i + j] * x[i].c.rate * x[j].c.rate;
    }
  }
  return sum;
}

/* g w */
static double along(const baum_i_inner *inner, const double *w)
{
  double six[6];
  baum_i_composed_narrow(inner, w, six);
  double sum = 0.0;
  for (int i = 0; i < 6; i++) {
    sum += inner->c.gradient[i] * six[i];
  }
  return sum;
}

static void add_square(const baum_i_inner x[2], const baum_i_outer *g, int columns, double lambda,
                       double *square)
{
  for (int i = 0; i < 2; i++) {
    for (int row = 0; row < 6; row++) {
      double *wide = square + (ptrdiff_t)columns * (x[i].at[row / 3] + row % 3);
      add(&x[i], lambda * g->first[i], x[i].blocks.jtl_q + (ptrdiff_t)6 * row, wide);
      for (int j = 0; j < 2; j++) {
        add(&x[j], lambda * g->second[i + j] * x[i].c.gradient[row], x[j].c.gradient, wide);
      }
    }
  }
}

/* Over the first `columns`; jtl_q is columns x columns. */
typedef struct wide_blocks {
  double jw_q[BAUM_I_COMPOSED_COLUMNS];
  double jtl_q[BAUM_I_COMPOSED_COLUMNS * BAUM_I_COMPOSED_COLUMNS];
  double gamma_q[BAUM_I_COMPOSED_COLUMNS];
  double gamma_v[BAUM_I_COMPOSED_COLUMNS];
} wide_blocks;

/* out arrives zeroed. */
static void linearize(const baum_i_inner x[2], const baum_i_outer *g, int columns, const double *w,
                      double lambda, wide_blocks *out)
{
  const double w_along[2] = {along(&x[0], w), along(&x[1], w)};
  for (int i = 0; i < 2; i++) {
    const double *first = g->first;
    double bend_w = 0.0;    /* G_ij (g_j w) */
    double bend = 0.0;      /* G_ij r_j */
    double bend_rate = 0.0; /* G_ji gamma_j - G_jki r_j r_k */
    for (int j = 0; j < 2; j++) {
      bend_w += g->second[i + j] * w_along[j];
      bend += g->second[i + j] * x[j].c.rate;
      bend_rate += g->second[i + j] * x[j].c.gamma;
      for (int k = 0; k < 2; k++) {
        bend_rate -= g->third[i + j + k] * x[j].c.rate * x[k].c.rate;
      }
    }
    add(&x[i], first[i], x[i].blocks.jw_q, out->jw_q);
    add(&x[i], bend_w, x[i].c.gradient, out->jw_q);
    add(&x[i], first[i], x[i].blocks.gamma_v, out->gamma_v);
    add(&x[i], -2.0 * bend, x[i].c.gradient, out->gamma_v);
    add(&x[i], first[i], x[i].blocks.gamma_q, out->gamma_q);
    add(&x[i], bend_rate, x[i].c.gradient, out->gamma_q);
    add(&x[i], bend, x[i].blocks.gamma_v, out->gamma_q);
  }
  add_square(x, g, columns, lambda, out->jtl_q);
}

void baum_i_composed_put_row(const baum_i_joint *joint, const baum_i_point *point,
                             const baum_i_inner x[2], const baum_i_outer *g, const baum_i_rows *out)
{
  if (out->phi) {
    out->phi[joint->row] = g->value;
  }
  if (out->jacobian) {
    double wide[BAUM_I_COMPOSED_COLUMNS];
    find_gradient(x, g, wide);
    baum_i_columns_pack(point->mechanism, &joint->span, 1, wide, out->jacobian + joint->jacobian);
  }
  if (out->gamma) {
    out->gamma[joint->row] = find_gamma(x, g);
  }
}

void baum_i_composed_put_blocks(const baum_i_joint *joint, const baum_i_point *point,
                                const baum_i_inner x[2], const baum_i_outer *g, const double *w,
                                const double *lambda, const baum_i_joint_blocks *blocks)
{
  wide_blocks wide = {.jw_q = {0.0}};
  linearize(x, g, 3 * joint->span.body_count, w, lambda ? lambda[joint->row] : 0.0, &wide);
  const baum_i_joint_blocks all = {wide.jw_q, wide.jtl_q, wide.gamma_q, wide.gamma_v, NULL};
  baum_i_columns_pack_blocks(point->mechanism, joint, &all, blocks);
}
