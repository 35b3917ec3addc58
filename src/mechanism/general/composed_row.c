/* SPDX-License-Identifier: BSD-3-Clause */
/* This file applies the chain rule to a constraint Phi = G(c_0, c_1) of two coordinates. G_i is the
 * derivative of G with respect to c_i, and repeated indices i, j, k are summed. With g_i = (c_i)_q,
 * r_i = c_i' = g_i v, and gamma_i defined by g_i a = c_i'' + gamma_i:
 *
 *   J       = G_i g_i
 *   gamma   = G_i gamma_i - G_ij r_i r_j
 *   (J w)_q = G_i (g_i w)_q + G_ij (g_j w) g_i
 *   (J^T lambda)_q = lambda (G_i (g_i^T)_q + G_ij g_i^T g_j)
 *   (J v)_q = G_i (r_i)_q + G_ij r_j g_i
 *   gamma_v = G_i (gamma_i)_v - 2 G_ij r_j g_i
 *   gamma_q = G_i (gamma_i)_q + (G_ij gamma_j - G_ijk r_j r_k) g_i - 2 G_ij r_j (r_i)_q
 *
 * The matrices (g_i^T)_q need not be symmetric. For coordinates in space they are not
 * symmetric.
 */
#include "mechanism/general/composed_row.h"

#include <string.h>

#include "mechanism/general/columns.h"

void baum_i_composed_place(baum_i_inner *inner, int width, int row_width, const int place[2])
{
  inner->columns = 2 * width;
  for (int k = 0; k < 2; k++) {
    for (int i = 0; i < width; i++) {
      /* If a body has six columns in the row, the angle of a planar body is its rotation about z,
       * column 5. */
      int column = row_width > width && i == 2 ? 5 : i;
      inner->at[width * k + i] = row_width * place[k] + column;
    }
  }
}

void baum_i_composed_narrow(const baum_i_inner *inner, const double *wide, double *own)
{
  for (int i = 0; i < inner->columns; i++) {
    own[i] = wide[inner->at[i]];
  }
}

/* Add factor * own, which has the columns of a coordinate, to `wide`, which has the columns of the
 * row. */
static void add(const baum_i_inner *inner, double factor, const double *own, double *wide)
{
  for (int i = 0; factor != 0.0 && i < inner->columns; i++) {
    wide[inner->at[i]] += factor * own[i];
  }
}

void baum_i_composed_add_gradient(const baum_i_inner x[2], const baum_i_outer *g, double *gradient)
{
  for (int i = 0; i < 2; i++) {
    add(&x[i], g->first[i], x[i].c.gradient, gradient);
  }
}

double baum_i_composed_gamma(const baum_i_inner x[2], const baum_i_outer *g)
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

/* Return the product g w of the gradient of a coordinate with w. */
static double along(const baum_i_inner *inner, const double *w)
{
  double sum = 0.0;
  for (int i = 0; i < inner->columns; i++) {
    sum += inner->c.gradient[i] * w[inner->at[i]];
  }
  return sum;
}

static void add_square(const baum_i_inner x[2], const baum_i_outer *g, double lambda,
                       const baum_i_composed_blocks *out)
{
  for (int i = 0; i < 2; i++) {
    for (int row = 0; row < x[i].columns; row++) {
      double *wide = out->jtl_q + (ptrdiff_t)out->columns * x[i].at[row];
      add(&x[i], lambda * g->first[i], x[i].blocks.jtl_q + (ptrdiff_t)x[i].columns * row, wide);
      for (int j = 0; j < 2; j++) {
        add(&x[j], lambda * g->second[i + j] * x[i].c.gradient[row], x[j].c.gradient, wide);
      }
    }
  }
}

void baum_i_composed_linearize(const baum_i_inner x[2], const baum_i_outer *g, const double *w,
                               double lambda, const baum_i_composed_blocks *out)
{
  const double w_along[2] = {along(&x[0], w), along(&x[1], w)};
  for (int i = 0; i < 2; i++) {
    const baum_i_coordinate_blocks *own = &x[i].blocks;
    const double *gradient = x[i].c.gradient;
    double first = g->first[i];
    double bend_w = 0.0;    /* G_ij (g_j w) */
    double bend = 0.0;      /* G_ij r_j */
    double bend_rate = 0.0; /* G_ij gamma_j - G_ijk r_j r_k */
    for (int j = 0; j < 2; j++) {
      bend_w += g->second[i + j] * w_along[j];
      bend += g->second[i + j] * x[j].c.rate;
      bend_rate += g->second[i + j] * x[j].c.gamma;
      for (int k = 0; k < 2; k++) {
        bend_rate -= g->third[i + j + k] * x[j].c.rate * x[k].c.rate;
      }
    }
    add(&x[i], first, own->jw_q, out->jw_q);
    add(&x[i], bend_w, gradient, out->jw_q);
    add(&x[i], first, own->rate_q, out->rate_q);
    add(&x[i], bend, gradient, out->rate_q);
    add(&x[i], first, own->gamma_v, out->gamma_v);
    add(&x[i], -2.0 * bend, gradient, out->gamma_v);
    add(&x[i], first, own->gamma_q, out->gamma_q);
    add(&x[i], bend_rate, gradient, out->gamma_q);
    add(&x[i], -2.0 * bend, own->rate_q, out->gamma_q);
  }
  add_square(x, g, lambda, out);
}

void baum_i_composed_put_row(const baum_i_joint *joint, const baum_i_point *point, int width,
                             const baum_i_inner x[2], const baum_i_outer *g, const baum_i_rows *out)
{
  if (out->phi) {
    out->phi[joint->row] = g->value;
  }
  if (out->jacobian) {
    double wide[BAUM_I_COMPOSED_COLUMNS] = {0.0};
    baum_i_composed_add_gradient(x, g, wide);
    baum_i_columns_pack_any(point->mechanism, &joint->span, width, 1, wide,
                            out->jacobian + joint->jacobian);
  }
  if (out->gamma) {
    out->gamma[joint->row] = baum_i_composed_gamma(x, g);
  }
}

void baum_i_composed_put_blocks(const baum_i_joint *joint, const baum_i_point *point, int width,
                                const baum_i_inner x[2], const baum_i_outer *g, const double *w,
                                const double *lambda, const baum_i_joint_blocks *blocks)
{
  double rows[4][BAUM_I_COMPOSED_COLUMNS] = {{0.0}};
  double square[BAUM_I_COMPOSED_COLUMNS * BAUM_I_COMPOSED_COLUMNS] = {0.0};
  const baum_i_composed_blocks wide = {
    width * joint->span.body_count, rows[0], square, rows[1], rows[2], rows[3]};
  const baum_i_joint_blocks all = {rows[0], square, rows[1], rows[2], NULL};
  baum_i_composed_linearize(x, g, w, lambda ? lambda[joint->row] : 0.0, &wide);
  baum_i_columns_pack_blocks(point->mechanism, joint, width, &all, blocks);
}
