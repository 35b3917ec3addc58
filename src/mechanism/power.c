/* SPDX-License-Identifier: BSD-3-Clause */
/* Powers of bodies and forces by class, without those of potentials.
 *
 * Functions of the user give a potential, but not its gradient: the power of these elements is
 * taken whole, and what the potential has taken up over a time is the difference of its values,
 * without any error.
 */
#include "base/message.h"
#include "mechanism/mechanism.h"

baum_status baum_i_mechanism_power(baum_i_point *point, double power[BAUM_I_POWERS])
{
  const baum_mechanism *mechanism = point->mechanism;
  for (int k = 0; k < BAUM_I_POWERS; k++) {
    power[k] = 0.0;
  }
  for (int k = 0; k < mechanism->body_group_count; k++) {
    const baum_i_body_group *group = &mechanism->body_groups[k];
    if (group->type->power) {
      BAUM_I_TRY(group->type->power(group, point, power));
    }
  }
  for (int k = 0; k < mechanism->force_group_count; k++) {
    const baum_i_force_group *group = &mechanism->force_groups[k];
    BAUM_I_TRY(group->type->power(group, point, power));
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_potential_of_whole(baum_i_point *point,
                                                double potential[BAUM_I_POWERS])
{
  const baum_mechanism *mechanism = point->mechanism;
  for (int k = 0; k < BAUM_I_POWERS; k++) {
    potential[k] = 0.0;
  }
  for (int k = 0; k < mechanism->body_group_count; k++) {
    const baum_i_body_group *group = &mechanism->body_groups[k];
    if (group->type->power && group->type->potential) {
      BAUM_I_TRY(group->type->potential(group, point, &potential[BAUM_I_POWER_BODIES]));
    }
  }
  for (int k = 0; k < mechanism->force_group_count; k++) {
    const baum_i_force_group *group = &mechanism->force_groups[k];
    if (group->type->power_is_whole && group->type->potential) {
      BAUM_I_TRY(group->type->potential(group, point, &potential[BAUM_I_POWER_USER_FORCES]));
    }
  }
  return BAUM_OK;
}
