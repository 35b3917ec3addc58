/* SPDX-License-Identifier: BSD-3-Clause */
/* Ids, labels for messages, and checks of ids. */
#include "mechanism/identify.h"

#include <string.h>

#include "base/message.h"
#include "mechanism/general/coordinate.h"

/* ---- ids ---- */

static int index_of(const baum_mechanism *mechanism, baum_i_id id, int count)
{
  bool ours = id.tag == mechanism->tag && id.index1 >= 1 && id.index1 <= count;
  return ours ? id.index1 - 1 : -1;
}

int baum_i_index(const baum_mechanism *mechanism, const baum_i_family *family, baum_i_id id)
{
  return mechanism ? index_of(mechanism, id, baum_i_family_count(family, mechanism)) : -1;
}

static bool is_ground(const baum_i_family *family, baum_i_id id)
{
  return family == &baum_i_body_family && id.index1 == BAUM_GROUND.index1 &&
         id.tag == BAUM_GROUND.tag;
}

int baum_i_body_index(const baum_mechanism *mechanism, baum_body_id id)
{
  baum_i_id any = {id.index1, id.tag};
  int k = baum_i_index(mechanism, &baum_i_body_family, any);
  return k >= 0 || (mechanism && is_ground(&baum_i_body_family, any)) ? k + 1 : -1;
}

int baum_i_joint_index(const baum_mechanism *mechanism, baum_joint_id id)
{
  return baum_i_index(mechanism, &baum_i_joint_family, (baum_i_id){id.index1, id.tag});
}

int baum_i_input_index(const baum_mechanism *mechanism, baum_input_id id)
{
  return mechanism ? index_of(mechanism, (baum_i_id){id.index1, id.tag}, mechanism->input_count)
                   : -1;
}

int baum_i_index_of_name(const baum_mechanism *mechanism, const baum_i_family *family,
                         const char *name)
{
  const int count = mechanism && name ? baum_i_family_count(family, mechanism) : 0;
  for (int k = 0; k < count; k++) {
    if (strcmp(family->at(mechanism, k)->name, name) == 0) {
      return k;
    }
  }
  return -1;
}

static baum_status check_known(const baum_mechanism *mechanism, int32_t index1, bool known,
                               const char *label, const char *field)
{
  if (!mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the mechanism is NULL", label);
  }
  if (known) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %s", label, field,
                     index1 == 0 ? "none, must be given" : "not of this mechanism");
}

baum_status baum_i_check_id(const baum_mechanism *mechanism, const baum_i_family *family,
                            baum_i_id id, const char *label, const char *field)
{
  bool known = baum_i_index(mechanism, family, id) >= 0 || is_ground(family, id);
  return check_known(mechanism, id.index1, known, label, field);
}

baum_status baum_i_check_body(const baum_mechanism *mechanism, baum_body_id id, const char *label,
                              const char *field)
{
  return baum_i_check_id(mechanism, &baum_i_body_family, (baum_i_id){id.index1, id.tag}, label,
                         field);
}

baum_status baum_i_check_joint(const baum_mechanism *mechanism, baum_joint_id id, const char *label,
                               const char *field)
{
  return baum_i_check_id(mechanism, &baum_i_joint_family, (baum_i_id){id.index1, id.tag}, label,
                         field);
}

baum_status baum_i_check_input(const baum_mechanism *mechanism, baum_input_id id, const char *label,
                               const char *field)
{
  bool known = baum_i_input_index(mechanism, id) >= 0;
  baum_status status = check_known(mechanism, id.index1, known, label, field);
  if (status == BAUM_OK || !mechanism || mechanism->input_count > 0) {
    return status;
  }
  return baum_i_fail(status,
                     "%.900s; the mechanism has no inputs, baum_mechanism_add_input() adds one "
                     "before freezing",
                     baum_message());
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

baum_i_text baum_i_label(const baum_i_element *element)
{
  return element->definition
           ? baum_i_text_of("%s %d \"%.80s\"", element->family, element->index, element->name)
           : (baum_i_text){"ground"};
}

baum_i_text baum_i_joint_label(const baum_mechanism *mechanism, int joint)
{
  return joint < 0 ? (baum_i_text){"no joint"} : baum_i_label(&mechanism->joints[joint]->element);
}

baum_i_text baum_i_row_label(const baum_mechanism *mechanism, int row)
{
  return baum_i_joint_label(mechanism, row < 0 ? -1 : baum_i_row_joint(mechanism, row));
}

/* ---- frozen or not ---- */

static baum_status check_stage(const baum_mechanism *mechanism, bool frozen, const char *call)
{
  if (!mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the mechanism is NULL", call);
  }
  if (mechanism->frozen != frozen) {
    return baum_i_fail(BAUM_ERR_STATE, "%s: the mechanism is %s", call,
                       frozen ? "not frozen; call baum_mechanism_freeze() first"
                              : "frozen; change a copy of it");
  }
  return BAUM_OK;
}

baum_status baum_i_check_open(const baum_mechanism *mechanism, const char *call)
{
  return check_stage(mechanism, false, call);
}

baum_status baum_i_check_frozen(const baum_mechanism *mechanism, const char *call)
{
  return check_stage(mechanism, true, call);
}

/* ---- angles that may be in degrees ---- */

/* Tell whether a field is an angle. The value of a driver may be a length or an angle. */
static bool is_angle(const baum_mechanism *m, const baum_i_family *family, int k,
                     const baum_i_def_field *field)
{
  const baum_i_joint *joint = family == &baum_i_joint_family ? m->joints[k] : NULL;
  if (!joint || !joint->type->driven || strcmp(field->unit, "rad or m") != 0) {
    return strcmp(field->unit, "rad") == 0;
  }
  const baum_i_joint_coordinate driven = joint->type->driven(m, joint->element.def);
  return baum_i_is_angle(&driven);
}

/* Return the value of an angle of element k that is larger than a revolution. Returns 0 if there is
 * none. */
static double find_large_angle(const baum_mechanism *m, const baum_i_family *family, int k,
                               const char **name)
{
  static const double REVOLUTION = 6.3;
  const baum_i_element *element = family->at(m, k);
  for (const baum_i_def_field *field = element->definition->fields; field->name; field++) {
    if (field->kind == BAUM_I_FIELD_NUMBERS && is_angle(m, family, k, field)) {
      double value = *(const double *)baum_i_field_at(field, element->def);
      if (fabs(value) > REVOLUTION) {
        *name = field->name;
        return value;
      }
    }
  }
  return 0.0;
}

baum_i_text baum_i_degrees(const baum_mechanism *mechanism)
{
  for (int f = 0; f < BAUM_I_FAMILIES; f++) {
    const baum_i_family *family = baum_i_families[f];
    for (int k = 0; k < baum_i_family_count(family, mechanism); k++) {
      const char *name = NULL;
      double value = find_large_angle(mechanism, family, k, &name);
      if (name) {
        return baum_i_text_of(" (angles are in radians, and %s of %.100s is %g rad)", name,
                              baum_i_label(family->at(mechanism, k)).text, value);
      }
    }
  }
  return baum_i_text_of("%s", "");
}
