/* SPDX-License-Identifier: BSD-3-Clause */
#include "mechanism/general/columns.h"

/* Return which of the `width` columns belongs to velocity i of a body. In space, the angle of a
 * planar body is the rotation about z, column 5. */
BAUM_I_INLINE int column(const baum_i_body *body, int width, int i)
{
  return width == BAUM_I_SPACE && i == 2 && body->type->frame == BAUM_I_FRAME_BODY ? 5 : i;
}

void baum_i_columns_gather(const baum_i_point *point, const baum_i_span *span, int width,
                           const double *x, double *wide)
{
  memset(wide, 0, (size_t)(span->body_count * width) * sizeof *wide);
  for (int k = 0; x && k < span->body_count; k++, wide += width) {
    const baum_i_body *body = point->mechanism->bodies[span->bodies[k]];
    for (int i = 0; i < body->nv; i++) {
      wide[column(body, width, i)] = x[body->v + i];
    }
  }
}

void baum_i_columns_scatter_any(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                                const double *wide, double *x)
{
  for (int k = 0; k < span->body_count; k++, wide += width) {
    const baum_i_body *body = mechanism->bodies[span->bodies[k]];
    double *own = x + body->v;
    for (int i = 0; body->nv == BAUM_I_SPACE && i < BAUM_I_SPACE; i++) {
      own[i] += wide[i];
    }
    for (int i = 0; body->nv < BAUM_I_SPACE && i < body->nv; i++) {
      own[i] += wide[column(body, width, i)];
    }
  }
}

void baum_i_columns_find(const baum_mechanism *mechanism, const baum_i_span *span, int k, int width,
                         int *at)
{
  int first = 0;
  for (int i = 0; i < k; i++) {
    first += mechanism->bodies[span->bodies[i]]->nv;
  }
  for (int i = 0; i < width; i++) {
    at[i] = -1;
  }
  const baum_i_body *body = mechanism->bodies[span->bodies[k]];
  for (int i = 0; i < body->nv; i++) {
    at[column(body, width, i)] = first + i;
  }
}

BAUM_I_INLINE void pack_wide(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                             int rows, const double *wide, double *packed)
{
  for (int row = 0; row < rows; row++) {
    for (int k = 0; k < span->body_count; k++, wide += width) {
      const baum_i_body *body = mechanism->bodies[span->bodies[k]];
      for (int i = 0; i < body->nv; i++) {
        *packed++ = wide[column(body, width, i)];
      }
    }
  }
}

void baum_i_columns_pack_any(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                             int rows, const double *wide, double *packed)
{
  if (width == BAUM_I_PLANE) { /* with a constant width, the compiler removes column() */
    pack_wide(mechanism, span, BAUM_I_PLANE, rows, wide, packed);
  } else {
    pack_wide(mechanism, span, BAUM_I_SPACE, rows, wide, packed);
  }
}

BAUM_I_INLINE void pack(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                        int rows, const double *wide, double *packed)
{
  if (width == BAUM_I_PLANE) {
    baum_i_columns_pack(mechanism, span, rows, wide, packed);
  } else {
    baum_i_columns_pack_any(mechanism, span, width, rows, wide, packed);
  }
}

void baum_i_columns_pack_square(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                                const double *wide, double *packed)
{
  const ptrdiff_t size = (ptrdiff_t)span->body_count * width;
  for (int k = 0; k < span->body_count; k++, wide += width * size) {
    const baum_i_body *body = mechanism->bodies[span->bodies[k]];
    if (width == BAUM_I_PLANE) { /* column(body, width, i) is i */
      pack(mechanism, span, width, body->nv, wide, packed);
      packed += (ptrdiff_t)body->nv * span->nl;
      continue;
    }
    for (int i = 0; i < body->nv; i++, packed += span->nl) {
      pack(mechanism, span, width, 1, wide + size * column(body, width, i), packed);
    }
  }
}

BAUM_I_INLINE void pack_rows(const baum_mechanism *mechanism, const baum_i_joint *joint, int width,
                             const double *wide, double *rows)
{
  if (rows) {
    pack(mechanism, &joint->span, width, joint->rows, wide, rows + joint->jacobian);
  }
}

void baum_i_columns_pack_blocks(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                int width, const baum_i_joint_blocks *wide,
                                const baum_i_joint_blocks *blocks)
{
  pack_rows(mechanism, joint, width, wide->jw_q, blocks->jw_q);
  pack_rows(mechanism, joint, width, wide->gamma_q, blocks->gamma_q);
  pack_rows(mechanism, joint, width, wide->gamma_v, blocks->gamma_v);
  if (blocks->jtl_q) {
    baum_i_columns_pack_square(mechanism, &joint->span, width, wide->jtl_q,
                               blocks->jtl_q + joint->square);
  }
}

void baum_i_columns_pack_force(const baum_mechanism *mechanism, const baum_i_force *force,
                               int width, const double *wide, double *squares)
{
  if (squares) {
    baum_i_columns_pack_square(mechanism, &force->span, width, wide, squares + force->square);
  }
}
