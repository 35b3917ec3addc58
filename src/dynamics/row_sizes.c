/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes sizes of constraint rows and of states, with which quantities of different units can be
 * compared. */
#include <math.h>
#include <string.h>

#include "base/hot.h"
#include "base/measure.h"
#include "dynamics/dynamics.h"

/* Set rows[i] to the sum of weight_j J_ij^2 over all columns j. */
static void add_squares(const baum_workspace *w, const double *weight, double *rows)
{
  memset(rows, 0, (size_t)w->mechanism->nc * sizeof *rows);
  for (int k = 0; k < w->structure.row_block_count; k++) {
    const baum_i_row_block *block = &w->structure.row_blocks[k];
    for (int i = 0; i < block->rows; i++) {
      for (int j = 0; j < block->cols; j++) {
        double value = w->jacobian[block->value + i * block->cols + j];
        rows[block->row + i] += weight[block->col[j]] * value * value;
      }
    }
  }
}

void baum_i_row_displacements(const baum_workspace *workspace, double *size)
{
  double *weight = workspace->work_v;
  for (int j = 0; j < workspace->mechanism->nv; j++) {
    weight[j] = workspace->mechanism->scale[j] * workspace->mechanism->scale[j];
  }
  add_squares(workspace, weight, size);
  for (int i = 0; i < workspace->mechanism->nc; i++) {
    size[i] = size[i] > 0.0 ? sqrt(size[i]) : 1.0;
  }
}

/* A moment of inertia below NEGLIGIBLE times the trace of the tensor counts as RAISED times the
 * trace. Otherwise rows that restrict the rotation of a slender rod about its axis would be so
 * large, compared with others, that assembly would need hundreds of steps, and other rows would
 * look dependent. */
static double moment_of(const double *tensor, int i)
{
  static const double NEGLIGIBLE = 1e-8;
  static const double RAISED = 1e-4;
  double trace = tensor[0] + tensor[7] + tensor[14];
  double moment = tensor[7 * i];
  return moment < NEGLIGIBLE * trace ? RAISED * trace : moment;
}

void baum_i_inverse_masses(const baum_workspace *workspace, double *inverse)
{
  for (int k = 0; k < workspace->structure.mass_block_count; k++) {
    const baum_i_mass_block *block = &workspace->structure.mass_blocks[k];
    const double *m = workspace->mass + block->value;
    bool rigid =
      block->size == 6 && baum_i_is_spatial(workspace->mechanism->bodies[k + 1]->type->frame);
    for (int i = 0; i < block->size; i++) {
      double mass = rigid && i > 2 ? moment_of(m + 21, i - 3) : m[i * block->size + i];
      inverse[block->first + i] = mass > 0.0 ? 1.0 / mass : 0.0;
    }
  }
}

void baum_i_row_mobilities(const baum_workspace *workspace, double *mobility)
{
  baum_i_inverse_masses(workspace, workspace->work_v);
  add_squares(workspace, workspace->work_v, mobility);
}

void baum_i_column_scales(const baum_workspace *workspace, double *scale)
{
  const baum_mechanism *m = workspace->mechanism;
  baum_i_inverse_masses(workspace, scale);
  for (int i = 0; i < m->nv; i++) {
    scale[i] = scale[i] > 0.0 ? sqrt(scale[i]) : m->scale[i];
  }
  baum_i_rest_fixed_bodies(m, scale);
}

int baum_i_largest(const double *values, int count, double *largest)
{
  int where = -1;
  double most = 0.0;
  for (int i = 0; i < count && !isnan(most); i++) {
    double size = fabs(values[i]);
    if (where < 0 || !(size <= most)) { /* NaN counts as the largest */
      where = i;
      most = size;
    }
  }
  if (largest) {
    *largest = most;
  }
  return where;
}

double baum_i_scaled_size(const baum_mechanism *mechanism, const double *x)
{
  const baum_i_measure_kernel *kernel = BAUM_I_HOT_TABLE(mechanism->wide, baum_i_measure_kernel);
  return kernel->largest_scaled(mechanism->nv, x, mechanism->scale);
}

double baum_i_position_size(const baum_mechanism *mechanism, const double *q)
{
  const baum_i_measure_kernel *kernel = BAUM_I_HOT_TABLE(mechanism->wide, baum_i_measure_kernel);
  return kernel->largest_scaled(mechanism->nq, q, mechanism->position_scale);
}

double baum_i_state_rate(const baum_mechanism *mechanism, const double *v, const double *a)
{
  return fmax(baum_i_scaled_size(mechanism, v), sqrt(baum_i_scaled_size(mechanism, a)));
}

double baum_i_swing_rate(const baum_mechanism *mechanism)
{
  const double *g = mechanism->gravity;
  return sqrt(hypot(hypot(g[0], g[1]), g[2]) / mechanism->length);
}
