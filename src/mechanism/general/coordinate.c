/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks and design values of joints' coordinates. */
#include "mechanism/general/coordinate.h"

#include "base/message.h"

baum_status baum_i_check_coordinate(const baum_mechanism *mechanism, baum_joint_id id,
                                    const char *label, const char *field, const char *purpose)
{
  BAUM_I_TRY(baum_i_check_joint(mechanism, id, label, field));
  const baum_i_joint *joint = mechanism->joints[baum_i_joint_index(mechanism, id)];
  if (!joint->type->coordinate) {
    char text[BAUM_I_LABEL_SIZE];
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %s, a %s, which has no coordinate %s", label,
                       field, baum_i_label(&joint->element, text), joint->type->definition.kind,
                       purpose);
  }
  return joint->type->check_coordinate
           ? joint->type->check_coordinate(mechanism, joint->element.def, label)
           : BAUM_OK;
}

double baum_i_design_coordinate(const baum_mechanism *mechanism, const baum_i_joint *joint)
{
  /* A coordinate depends on its two bodies only, so they are renumbered 0 and 1. */
  int pair[2] = {0, 1};
  baum_i_frame frames[2] = {baum_i_design_frame(mechanism, joint->span.bodies[0]),
                            baum_i_design_frame(mechanism, joint->span.bodies[1])};
  baum_i_spatial_frame spatial[2] = {baum_i_spatial_design_frame(mechanism, joint->span.bodies[0]),
                                     baum_i_spatial_design_frame(mechanism, joint->span.bodies[1])};
  baum_i_joint alone = *joint;
  alone.span.bodies = pair;
  baum_i_point point = {.mechanism = mechanism,
                        .parameters = mechanism->parameters,
                        .frames = frames,
                        .spatial = spatial};
  baum_i_coordinate c;
  joint->type->coordinate(&alone, &point, &c);
  return c.value;
}
