/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions for planar joints, except the kernels. */
#include "mechanism/planar/planar_rows.h"

void baum_i_planar_place(const baum_i_joint *joint, const baum_i_point *point, double at[3])
{
  baum_i_planar_pair pair = baum_i_planar_pair_at(joint, point);
  at[0] = pair.b.r[0];
  at[1] = pair.b.r[1];
  at[2] = 0.0;
}

baum_status baum_i_planar_lower_points(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                       double *parameters)
{
  return baum_i_planar_points(mechanism, &joint->element, parameters);
}
