/* SPDX-License-Identifier: BSD-3-Clause */
/* Inputs of a mechanism. The mechanism stores their names and initial values. Their present values
 * are stored in runs and workspaces. */
#include <math.h>

#include "base/alloc.h"
#include "base/message.h"
#include "base/text.h"
#include "mechanism/mechanism.h"

static baum_status check_value(const char *call, int number, const char *name, double value)
{
  return isfinite(value)
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: input %d \"%.80s\" is %g, must be finite", call,
                         number, name, value);
}

baum_status baum_i_check_input_value(const baum_mechanism *mechanism, baum_input_id id,
                                     const char *call, double value)
{
  BAUM_I_TRY(baum_i_check_input(mechanism, id, call, "input"));
  return check_value(call, id.index1, mechanism->input_names[id.index1 - 1], value);
}

/* ---- the list ---- */

const double *baum_i_initial_inputs(const baum_mechanism *mechanism)
{
  return mechanism->input_count > 0 ? mechanism->inputs : NULL;
}

void baum_i_free_inputs(baum_mechanism *mechanism)
{
  for (int i = 0; i < mechanism->input_count; i++) {
    baum_i_free(mechanism->input_names[i]);
  }
  baum_i_free(mechanism->input_names);
  baum_i_free(mechanism->inputs);
}

static baum_status append(baum_mechanism *mechanism, const char *name, double initial)
{
  size_t count = (size_t)mechanism->input_count + 1;
  char **names = baum_i_grow(mechanism->input_names, count, sizeof *names);
  BAUM_I_TRY(baum_i_check_memory(names));
  mechanism->input_names = names;
  double *values = baum_i_grow(mechanism->inputs, count, sizeof *values);
  BAUM_I_TRY(baum_i_check_memory(values));
  mechanism->inputs = values;
  names[count - 1] = baum_i_copy_text(name);
  if (!names[count - 1]) {
    return baum_i_fail_memory();
  }
  values[count - 1] = initial;
  mechanism->input_count++;
  return BAUM_OK;
}

baum_status baum_i_copy_inputs(baum_mechanism *to, const baum_mechanism *from)
{
  for (int i = 0; i < from->input_count; i++) {
    BAUM_I_TRY(append(to, from->input_names[i], from->inputs[i]));
  }
  return BAUM_OK;
}

/* ---- public ---- */

baum_status baum_mechanism_add_input(baum_mechanism *mechanism, const char *name, double initial,
                                     baum_input_id *id)
{
  const char *call = "baum_mechanism_add_input";
  BAUM_I_TRY(baum_i_check_open(mechanism, call));
  int number = mechanism->input_count + 1;
  const baum_i_text default_name = baum_i_text_of("input%d", number);
  const char *given = name ? name : default_name.text;
  BAUM_I_TRY(baum_i_check_name("input", number, name));
  BAUM_I_TRY(check_value(call, number, given, initial));
  BAUM_I_TRY(append(mechanism, given, initial));
  if (id) {
    *id = (baum_input_id){number, mechanism->tag};
  }
  return BAUM_OK;
}

baum_status baum_mechanism_get_input(const baum_mechanism *mechanism, baum_input_id id,
                                     double *initial)
{
  const char *call = "baum_mechanism_get_input";
  BAUM_I_TRY(baum_i_check_input(mechanism, id, call, "input"));
  if (!initial) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: initial is NULL", call);
  }
  *initial = mechanism->inputs[id.index1 - 1];
  return BAUM_OK;
}

baum_status baum_mechanism_set_input(baum_mechanism *mechanism, baum_input_id id, double initial)
{
  const char *call = "baum_mechanism_set_input";
  BAUM_I_TRY(baum_i_check_open(mechanism, call));
  BAUM_I_TRY(baum_i_check_input_value(mechanism, id, call, initial));
  mechanism->inputs[id.index1 - 1] = initial;
  return BAUM_OK;
}

int32_t baum_mechanism_input_count(const baum_mechanism *mechanism)
{
  return mechanism ? mechanism->input_count : 0;
}

const char *baum_mechanism_input_name(const baum_mechanism *mechanism, baum_input_id id)
{
  int index = baum_i_input_index(mechanism, id);
  return index < 0 ? NULL : mechanism->input_names[index];
}
