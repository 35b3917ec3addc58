/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions that find elements by their ids, find the owners of rows and columns, and make labels
 * for messages. Other functions check ids, and whether a mechanism is frozen. */
#ifndef BAUM_I_MECHANISM_IDENTIFY_H
#define BAUM_I_MECHANISM_IDENTIFY_H

#include "base/text.h"
#include "mechanism/family.h"

/* An id of a body, joint or force, as used in code that is common to all families. */
typedef struct baum_i_id {
  int32_t index1;
  uint32_t tag;
} baum_i_id;

/* Return the index of an element in its family, counted from 0. Returns -1 for ground, the empty
 * id, ids of other mechanisms and ids out of range. */
int baum_i_index(const baum_mechanism *mechanism, const baum_i_family *family, baum_i_id id);

/* Return the number of the first element with that name, counted from 0. Returns -1 if there is
 * none. */
int baum_i_index_of_name(const baum_mechanism *mechanism, const baum_i_family *family,
                         const char *name);

/* Return the index of a body, joint or input. Bodies have indices from 1, and ground has the index
 * 0. Returns -1 for the empty id, ids of other mechanisms and ids out of range. */
int baum_i_body_index(const baum_mechanism *mechanism, baum_body_id id);
/* indices count from 0 */
int baum_i_joint_index(const baum_mechanism *mechanism, baum_joint_id id);
/* indices count from 0 */
int baum_i_input_index(const baum_mechanism *mechanism, baum_input_id id);

/* Check an id in a definition. If the check fails, the message tells whether the id is empty or
 * belongs to another mechanism. */
baum_status baum_i_check_id(const baum_mechanism *mechanism, const baum_i_family *family,
                            baum_i_id id, const char *label, const char *field);
baum_status baum_i_check_body(const baum_mechanism *mechanism, baum_body_id id, const char *label,
                              const char *field);
baum_status baum_i_check_joint(const baum_mechanism *mechanism, baum_joint_id id, const char *label,
                               const char *field);
baum_status baum_i_check_input(const baum_mechanism *mechanism, baum_input_id id, const char *label,
                               const char *field);
/* Check the id of an input and its new value. */
baum_status baum_i_check_input_value(const baum_mechanism *mechanism, baum_input_id id,
                                     const char *call, double value);

/* Return the initial inputs (input_count), or NULL if there are none. */
const double *baum_i_initial_inputs(const baum_mechanism *mechanism);

static inline bool baum_i_has_input(baum_input_id id)
{
  return id.index1 != 0 || id.tag != 0;
}

/* Return the present value of the input that multiplies a load, or 1 if the load has no input. */
static inline double baum_i_input_factor(const baum_i_point *point, baum_input_id id)
{
  return baum_i_has_input(id) ? point->inputs[id.index1 - 1] : 1.0;
}

/* Check that a mechanism is not frozen. Returns BAUM_OK, BAUM_ERR_ARGUMENT if the mechanism is
 * NULL, or BAUM_ERR_STATE if it is frozen. */
baum_status baum_i_check_open(const baum_mechanism *mechanism, const char *call);

/* Check that a mechanism is frozen. Returns BAUM_OK, BAUM_ERR_ARGUMENT if the mechanism is NULL, or
 * BAUM_ERR_STATE if it is not frozen. */
baum_status baum_i_check_frozen(const baum_mechanism *mechanism, const char *call);

/* Return a note for messages about configurations if an angle of a definition is larger than a
 * revolution, because the user may have given it in degrees. Otherwise return "". */
baum_i_text baum_i_degrees(const baum_mechanism *mechanism);

/* Find the joint that owns a row, or the body that owns a velocity. The mechanism must be
 * frozen. */
int baum_i_row_joint(const baum_mechanism *mechanism, int row);
const baum_i_body *baum_i_velocity_body(const baum_mechanism *mechanism, int column);
baum_joint_id baum_i_joint_id(const baum_mechanism *mechanism, int joint);

/* Return a label for messages: `ground`, or for example `joint 2 "B"`. The numbers start at 1. */
baum_i_text baum_i_label(const baum_i_element *element);
/* Return the label of a joint, given the index of the joint or of one of its rows. Returns "no
 * joint" if the index is negative. */
baum_i_text baum_i_joint_label(const baum_mechanism *mechanism, int joint);
baum_i_text baum_i_row_label(const baum_mechanism *mechanism, int row);

#endif
