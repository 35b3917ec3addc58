/* SPDX-License-Identifier: BSD-3-Clause */
/* Ids, labels and the checks of both. */
#include "mechanism/identify.h"

#include <stdio.h>

#include "base/message.h"

/* ---- ids ---- */

static int index_of(const baum_mechanism *mechanism, int32_t index1, uint32_t tag, int count)
{
  bool ours = mechanism && tag == mechanism->tag && index1 >= 1 && index1 <= count;
  return ours ? index1 : -1;
}

int baum_i_body_index(const baum_mechanism *mechanism, baum_body_id id)
{
  if (mechanism && id.index1 == BAUM_GROUND.index1 && id.tag == BAUM_GROUND.tag) {
    return 0;
  }
  return index_of(mechanism, id.index1, id.tag, mechanism ? mechanism->body_count : 0);
}

int baum_i_joint_index(const baum_mechanism *mechanism, baum_joint_id id)
{
  int index1 = index_of(mechanism, id.index1, id.tag, mechanism ? mechanism->joint_count : 0);
  return index1 < 0 ? -1 : index1 - 1;
}

int baum_i_force_index(const baum_mechanism *mechanism, baum_force_id id)
{
  int index1 = index_of(mechanism, id.index1, id.tag, mechanism ? mechanism->force_count : 0);
  return index1 < 0 ? -1 : index1 - 1;
}

static baum_status check_id(const baum_mechanism *mechanism, int32_t index1, int found,
                            const char *label, const char *field)
{
  if (!mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the mechanism is NULL", label);
  }
  if (found >= 0) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %s", label, field,
                     index1 == 0 ? "none, must be given" : "not of this mechanism");
}

baum_status baum_i_check_body(const baum_mechanism *mechanism, baum_body_id id, const char *label,
                              const char *field)
{
  return check_id(mechanism, id.index1, baum_i_body_index(mechanism, id), label, field);
}

baum_status baum_i_check_joint(const baum_mechanism *mechanism, baum_joint_id id, const char *label,
                               const char *field)
{
  return check_id(mechanism, id.index1, baum_i_joint_index(mechanism, id), label, field);
}

baum_status baum_i_check_force(const baum_mechanism *mechanism, baum_force_id id, const char *label,
                               const char *field)
{
  return check_id(mechanism, id.index1, baum_i_force_index(mechanism, id), label, field);
}

baum_joint_id baum_i_joint_id(const baum_mechanism *mechanism, int joint)
{
  return joint < 0 ? (baum_joint_id){0} : (baum_joint_id){joint + 1, mechanism->tag};
}

int baum_i_row_joint(const baum_mechanism *mechanism, int row)
{
  int low = 0;
  int high = mechanism->joint_count - 1;
  while (low < high) {
    int middle = (low + high + 1) / 2;
    if (mechanism->joints[middle]->row <= row) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

const baum_i_body *baum_i_velocity_body(const baum_mechanism *mechanism, int column)
{
  int low = 1;
  int high = mechanism->body_count;
  while (low < high) {
    int middle = (low + high + 1) / 2;
    if (mechanism->bodies[middle]->v <= column) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return mechanism->bodies[low];
}

/* ---- labels ---- */

const char *baum_i_label(const baum_i_element *element, const char *family,
                         char text[BAUM_I_LABEL_SIZE])
{
  (void)snprintf(text, BAUM_I_LABEL_SIZE, "%s %d \"%.80s\"", family, element->index, element->name);
  return text;
}

const char *baum_i_joint_label(const baum_mechanism *mechanism, int joint,
                               char text[BAUM_I_LABEL_SIZE])
{
  return baum_i_label(&mechanism->joints[joint]->element, "joint", text);
}

/* ---- stages ---- */

baum_status baum_i_check_open(const baum_mechanism *mechanism, const char *call)
{
  if (!mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the mechanism is NULL", call);
  }
  if (mechanism->frozen) {
    return baum_i_fail(BAUM_ERR_STATE, "%s: the mechanism is frozen; change a copy of it", call);
  }
  return BAUM_OK;
}

baum_status baum_i_check_frozen(const baum_mechanism *mechanism, const char *call)
{
  if (!mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the mechanism is NULL", call);
  }
  if (!mechanism->frozen) {
    return baum_i_fail(BAUM_ERR_STATE, "%s: the mechanism is not frozen", call);
  }
  return BAUM_OK;
}
