/* SPDX-License-Identifier: BSD-3-Clause */
/* The tables of fields of entries, methods and the reference. The names of fields must never
 * change, because files contain them. */
#include "study/fields.h"

#include <math.h>

/* clang-format off */
#define KIND_double BAUM_I_NUMBER
#define KIND_int64_t BAUM_I_COUNT
#define KIND_int32_t BAUM_I_INDEX
#define KIND_bool BAUM_I_FLAG
#define KIND_baum_study_state BAUM_I_STATE
#define KIND_baum_status BAUM_I_STATUS
#define WHEN_ALWAYS false
#define WHEN_DONE true

#define FOUND(type, name, known, unit, meaning) \
  {#name, unit, meaning, KIND_##type, WHEN_##known, true, offsetof(baum_study_entry, name)},
#define GIVEN(key, unit, meaning, kind, member) \
  {key, unit, meaning, BAUM_I_##kind, false, false, offsetof(baum_i_report_entry, member)}
#define METHOD(name, unit, kind) \
  {#name, unit, "", BAUM_I_##kind, false, false, offsetof(baum_study_method, name)}
#define REFERENCE(name, unit, kind, filed) \
  {#name, unit, "", BAUM_I_##kind, false, filed, offsetof(baum_study_reference, name)}
#define END {.key = NULL}

const baum_i_field baum_i_entry_fields[] = {
  GIVEN("name", "", "method and step or tolerance", TEXT, entry.name),
  GIVEN("integrator", "", "", INTEGRATOR, entry.integrator),
  GIVEN("formulation", "", "", FORMULATION, entry.formulation),
  GIVEN("gains", "", "rule of the gains", TEXT, gains),
  GIVEN("gain_1", "of the rule", "first number of the rule", NUMBER, gain[0]),
  GIVEN("gain_2", "of the rule", "second number of the rule", NUMBER, gain[1]),
  GIVEN("method", "", "index in methods", INDEX, entry.method),
  GIVEN("step", "s", "", NUMBER, entry.step),
  GIVEN("rtol", "1", "", NUMBER, entry.rtol),
  BAUM_STUDY_ENTRY_LIST(FOUND)
  GIVEN("on_front_work", "", "no entry is both cheaper by work and more exact", FLAG, front[0]),
  GIVEN("on_front_cpu", "", "no entry is both cheaper by CPU and more exact", FLAG, front[1]),
  GIVEN("message", "", "why it was refused or failed, else its first warning", TEXT, entry.message),
  END
};

const baum_i_field baum_i_method_fields[] = {
  METHOD(name, "", TEXT),
  METHOD(integrator, "", INTEGRATOR),
  METHOD(formulation, "", FORMULATION),
  METHOD(fixed_step, "", FLAG),
  METHOD(entries, "1", INDEX),
  METHOD(usable, "1", INDEX),
  METHOD(least_error, "1", NUMBER),
  METHOD(slope, "1", NUMBER),
  METHOD(work_per_digit, "1", NUMBER),
  METHOD(cpu_per_digit, "1", NUMBER),
  METHOD(growth, "1", NUMBER),
  END
};

const baum_i_field baum_i_reference_fields[] = {
  REFERENCE(trusted, "", FLAG, true),
  REFERENCE(digits, "1", NUMBER, true),
  REFERENCE(uncertainty, "1", NUMBER, true),
  REFERENCE(uncertainty_q, "1", NUMBER, true),
  REFERENCE(uncertainty_v, "1", NUMBER, true),
  REFERENCE(uncertainty_lambda, "1", NUMBER, true),
  REFERENCE(uncertainty_energy, "J", NUMBER, true),
  REFERENCE(samples, "1", INDEX, false),
  REFERENCE(text, "", TEXT, false),
  END
};
/* clang-format on */

static const void *at(const baum_i_field *field, const void *object)
{
  return (const char *)object + field->place;
}

int64_t baum_i_field_whole(const baum_i_field *field, const void *object)
{
  const void *place = at(field, object);
  switch (field->kind) {
  case BAUM_I_COUNT: return *(const int64_t *)place;
  case BAUM_I_INDEX: return *(const int32_t *)place;
  case BAUM_I_FLAG: return *(const bool *)place;
  case BAUM_I_STATE: return *(const baum_study_state *)place;
  case BAUM_I_STATUS: return *(const baum_status *)place;
  case BAUM_I_FORMULATION: return *(const baum_formulation *)place;
  case BAUM_I_TEXT:
  case BAUM_I_INTEGRATOR:
  case BAUM_I_NUMBER: break;
  }
  return 0;
}

static bool is_in_state(const void *entry, baum_study_state state)
{
  return ((const baum_study_entry *)entry)->state == state;
}

const char *baum_i_field_text(const baum_i_field *field, const void *object)
{
  int value = (int)baum_i_field_whole(field, object);
  const char *text = NULL;
  if (field->kind == BAUM_I_TEXT) {
    text = *(const char *const *)at(field, object);
  } else if (field->kind == BAUM_I_INTEGRATOR) {
    text = baum_integrator_name(*(const baum_integrator *const *)at(field, object));
  } else if (field->kind == BAUM_I_FORMULATION) {
    text = baum_formulation_name((baum_formulation)value);
  } else if (field->kind == BAUM_I_STATE) {
    text = baum_study_state_name((baum_study_state)value);
  } else if (field->kind == BAUM_I_STATUS && !is_in_state(object, BAUM_STUDY_WAITING)) {
    text = baum_status_name((baum_status)value);
  }
  return text && text[0] ? text : NULL;
}

double baum_i_field_number(const baum_i_field *field, const void *object)
{
  if (field->when_done && !is_in_state(object, BAUM_STUDY_DONE)) {
    return (double)NAN;
  }
  return field->kind == BAUM_I_NUMBER ? *(const double *)at(field, object)
                                      : (double)baum_i_field_whole(field, object);
}
