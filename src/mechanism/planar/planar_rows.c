/* SPDX-License-Identifier: BSD-3-Clause */
/* What planar joints do alike outside their kernels. */
#include "mechanism/planar/planar_rows.h"

void baum_i_planar_put(const baum_i_joint *joint, const baum_mechanism *mechanism,
                       const baum_i_planar_blocks *six, const baum_i_joint_blocks *blocks)
{
  const baum_i_span *span = &joint->span;
  if (blocks->jw_q) {
    baum_i_columns_pack(mechanism, span, joint->rows, six->jw_q, blocks->jw_q + joint->jacobian);
  }
  if (blocks->jtl_q) {
    baum_i_columns_pack_square(mechanism, span, six->jtl_q, blocks->jtl_q + joint->square);
  }
  if (blocks->gamma_q) {
    baum_i_columns_pack(mechanism, span, joint->rows, six->gamma_q,
                        blocks->gamma_q + joint->jacobian);
  }
  if (blocks->gamma_v) {
    baum_i_columns_pack(mechanism, span, joint->rows, six->gamma_v,
                        blocks->gamma_v + joint->jacobian);
  }
}

void baum_i_planar_place(const baum_i_joint *joint, const baum_i_point *point, double at[2])
{
  baum_i_planar_pair pair = baum_i_planar_pair_at(joint, point);
  at[0] = pair.b.r[0];
  at[1] = pair.b.r[1];
}

baum_status baum_i_planar_lower_points(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                       double *parameters)
{
  return baum_i_planar_points(mechanism, &joint->element, parameters);
}
