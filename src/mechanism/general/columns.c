/* SPDX-License-Identifier: BSD-3-Clause */
#include "mechanism/general/columns.h"

void baum_i_columns_gather(const baum_i_point *point, const baum_i_span *span, const double *x,
                           double *six)
{
  for (int k = 0; k < span->body_count; k++) {
    const baum_i_body *body = point->mechanism->bodies[span->bodies[k]];
    for (int i = 0; i < 3; i++) {
      six[3 * k + i] = x && i < body->nv ? x[body->v + i] : 0.0;
    }
  }
}

void baum_i_columns_scatter_any(const baum_mechanism *mechanism, const baum_i_span *span,
                                const double *six, double *x)
{
  for (int k = 0; k < span->body_count; k++) {
    const baum_i_body *body = mechanism->bodies[span->bodies[k]];
    for (int i = 0; i < body->nv; i++) {
      x[body->v + i] += six[3 * k + i];
    }
  }
}

void baum_i_columns_pack_any(const baum_mechanism *mechanism, const baum_i_span *span, int rows,
                             const double *six, double *packed)
{
  for (int row = 0; row < rows; row++) {
    for (int k = 0; k < span->body_count; k++) {
      int nv = mechanism->bodies[span->bodies[k]]->nv;
      for (int i = 0; i < nv; i++) {
        *packed++ = six[i];
      }
      six += 3;
    }
  }
}

void baum_i_columns_pack_square(const baum_mechanism *mechanism, const baum_i_span *span,
                                const double *six, double *packed)
{
  /* Three rows of each body, of which it has the first nv. */
  ptrdiff_t rows_size = (ptrdiff_t)9 * span->body_count;
  for (int k = 0; k < span->body_count; k++) {
    int nv = mechanism->bodies[span->bodies[k]]->nv;
    baum_i_columns_pack(mechanism, span, nv, six + rows_size * k, packed);
    packed += (ptrdiff_t)nv * span->nl;
  }
}

BAUM_I_INLINE void pack_rows(const baum_mechanism *mechanism, const baum_i_joint *joint,
                             const double *six, double *rows)
{
  if (rows) {
    baum_i_columns_pack(mechanism, &joint->span, joint->rows, six, rows + joint->jacobian);
  }
}

void baum_i_columns_pack_blocks(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                const baum_i_joint_blocks *six, const baum_i_joint_blocks *blocks)
{
  pack_rows(mechanism, joint, six->jw_q, blocks->jw_q);
  pack_rows(mechanism, joint, six->gamma_q, blocks->gamma_q);
  pack_rows(mechanism, joint, six->gamma_v, blocks->gamma_v);
  if (blocks->jtl_q) {
    baum_i_columns_pack_square(mechanism, &joint->span, six->jtl_q, blocks->jtl_q + joint->square);
  }
}
