/* SPDX-License-Identifier: BSD-3-Clause */
#include "fmu/resources.h"

#include <string.h>

#include <baum/scene.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/text.h"
#include "mechanism/definition.h"
#include "scene/reader.h"

static const baum_i_def_field channel_fields[] = {
  BAUM_I_FIELD(baum_channel, quantity, COUNT),
  BAUM_I_FIELD(baum_channel, body, BODY),
  BAUM_I_FIELD(baum_channel, joint, JOINT),
  BAUM_I_NUMBERS(baum_channel, point, FINITE, "m", 0.0),
  BAUM_I_FIELD(baum_channel, coordinate, COUNT),
  {.name = NULL}};

#define OPTION(FIELD)       BAUM_I_NUMBERS(baum_simulation_options, FIELD, FINITE, "", 0.0)
#define CHOICE(FIELD, KIND) BAUM_I_FIELD(baum_simulation_options, FIELD, KIND)

static const baum_i_def_field option_fields[] = {CHOICE(formulation, COUNT),
                                                 CHOICE(gains.rule, COUNT),
                                                 OPTION(gains.value),
                                                 CHOICE(allow_unstable, FLAG),
                                                 OPTION(step),
                                                 OPTION(rtol),
                                                 OPTION(atol),
                                                 OPTION(max_step),
                                                 CHOICE(start, COUNT),
                                                 CHOICE(solver, COUNT),
                                                 CHOICE(check_derivatives, FLAG),
                                                 OPTION(tolerance_q),
                                                 OPTION(tolerance_v),
                                                 OPTION(tolerance_lambda),
                                                 CHOICE(energy_account, FLAG),
                                                 CHOICE(error_check, FLAG),
                                                 {.name = NULL}};

/* ---- reading ---- */

static baum_status read_object(const baum_i_scene_reader *r, const baum_i_def_field *fields,
                               const baum_i_json_node *object, void *out)
{
  for (const baum_i_def_field *f = fields; f->name; f++) {
    const baum_i_json_node *node = baum_i_json_find(r->json, object, f->name);
    if (node) {
      BAUM_I_TRY(baum_i_scene_read_field(r, f, node, (char *)out + f->offset));
    }
  }
  return BAUM_OK;
}

/* Find a value in an object of fmu.json, and check its kind. */
static baum_status find(const baum_i_scene_reader *r, const baum_i_json_node *object,
                        const char *key, baum_i_json_kind kind, const baum_i_json_node **out)
{
  *out = baum_i_json_find(r->json, object, key);
  return *out && (*out)->kind == kind
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: \"%s\" is missing or has a wrong type",
                         r->label, object->line, key);
}

static baum_status read_integrator(const baum_i_scene_reader *r, const char *name,
                                   baum_simulation_options *options)
{
  const baum_integrator *integrator = NULL;
  int32_t k = 0;
  do {
    integrator = baum_integrator_at(k++);
  } while (integrator && strcmp(baum_integrator_name(integrator), name) != 0);
  options->integrator = integrator;
  return integrator
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: there is no integrator \"%.60s\"", r->label, name);
}

static const baum_i_def_field *find_field(const baum_i_definition *definition, const char *name)
{
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    if (f->kind == BAUM_I_FIELD_NUMBERS && strcmp(f->name, name) == 0) {
      return f;
    }
  }
  return NULL;
}

/* Find a parameter by the names of its element and its field, and append its numbers to `start`,
 * which has room for a field of the largest size. */
static baum_status read_parameter(const baum_i_scene_reader *r, const baum_i_json_node *object,
                                  baum_i_fmu_resources *out)
{
  const baum_i_json_node *element = NULL;
  const baum_i_json_node *field = NULL;
  BAUM_I_TRY(find(r, object, "element", BAUM_I_JSON_TEXT, &element));
  BAUM_I_TRY(find(r, object, "field", BAUM_I_JSON_TEXT, &field));
  for (int f = 0; f < BAUM_I_FAMILIES; f++) {
    const baum_i_family *family = baum_i_families[f];
    const int k = baum_i_index_of_name(r->mechanism, family, element->text);
    const baum_i_element *found = k < 0 ? NULL : family->at(r->mechanism, k);
    const baum_i_def_field *its = found ? find_field(found->definition, field->text) : NULL;
    if (its) {
      const baum_i_fmu_parameter parameter = {
        family, found->definition, its, {k + 1, r->mechanism->tag}};
      out->parameters[out->parameter_count++] = parameter;
      memcpy(out->start + out->number_count, baum_i_field_at(its, found->def), its->size);
      out->number_count += baum_i_fmu_size(&parameter);
      return BAUM_OK;
    }
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: there is no parameter \"%.80s.%.60s\"",
                     r->label, object->line, element->text, field->text);
}

static baum_status read_input(const baum_i_scene_reader *r, const baum_i_json_node *node,
                              baum_i_fmu_resources *out)
{
  static const baum_i_def_field number = {.kind = BAUM_I_FIELD_INPUT};
  baum_input_id *id = &out->inputs[out->input_count++];
  BAUM_I_TRY(baum_i_scene_read_field(r, &number, node, id));
  return baum_mechanism_get_input(r->mechanism, *id, &out->start[out->number_count++]);
}

static baum_status read_channel(const baum_i_scene_reader *r, const baum_i_json_node *object,
                                baum_i_fmu_resources *out)
{
  baum_channel *channel = &out->channels[out->channel_count++];
  baum_channel_init(channel, sizeof *channel);
  return read_object(r, channel_fields, object, channel);
}

typedef baum_status read_fn(const baum_i_scene_reader *r, const baum_i_json_node *node,
                            baum_i_fmu_resources *out);

static baum_status read_all(const baum_i_scene_reader *r, const baum_i_json_node *list,
                            read_fn *read, baum_i_fmu_resources *out)
{
  for (const baum_i_json_node *node = baum_i_json_first(r->json, list); node;
       node = baum_i_json_next(r->json, node)) {
    BAUM_I_TRY(read(r, node, out));
  }
  return BAUM_OK;
}

static baum_status read_variables(const baum_i_scene_reader *r, baum_i_fmu_resources *out)
{
  const baum_i_json_node *whole = r->json->nodes;
  const baum_i_json_node *inputs = NULL;
  const baum_i_json_node *parameters = NULL;
  const baum_i_json_node *outputs = NULL;
  BAUM_I_TRY(find(r, whole, "inputs", BAUM_I_JSON_LIST, &inputs));
  BAUM_I_TRY(find(r, whole, "parameters", BAUM_I_JSON_LIST, &parameters));
  BAUM_I_TRY(find(r, whole, "outputs", BAUM_I_JSON_LIST, &outputs));
  const size_t numbers = (size_t)inputs->count + BAUM_I_FIELD_SIZE_MAX * (size_t)parameters->count;
  out->start = baum_i_alloc(numbers, sizeof(double));
  out->inputs = baum_i_alloc((size_t)inputs->count, sizeof *out->inputs);
  out->parameters = baum_i_alloc((size_t)parameters->count, sizeof *out->parameters);
  out->channels = baum_i_alloc((size_t)outputs->count, sizeof *out->channels);
  if (!out->start || !out->inputs || !out->parameters || !out->channels) {
    return baum_i_fail_memory();
  }
  BAUM_I_TRY(read_all(r, inputs, read_input, out));
  BAUM_I_TRY(read_all(r, parameters, read_parameter, out));
  return read_all(r, outputs, read_channel, out);
}

static baum_status read_whole(const baum_i_scene_reader *r, baum_i_fmu_resources *out)
{
  const baum_i_json_node *node = NULL;
  const baum_i_json_node *whole = r->json->nodes;
  BAUM_I_TRY(find(r, whole, "token", BAUM_I_JSON_TEXT, &node));
  out->token = baum_i_copy_text(node->text);
  BAUM_I_TRY(baum_i_check_memory(out->token));
  BAUM_I_TRY(find(r, whole, "integrator", BAUM_I_JSON_TEXT, &node));
  BAUM_I_TRY(read_integrator(r, node->text, &out->options));
  BAUM_I_TRY(find(r, whole, "options", BAUM_I_JSON_OBJECT, &node));
  BAUM_I_TRY(read_object(r, option_fields, node, &out->options));
  return read_variables(r, out);
}

/* Write the path of a file in a folder. The name of the folder may end with a separator. */
static baum_status join(const char *folder, const char *name, baum_i_buffer *path)
{
  const size_t length = strlen(folder);
  const bool ends = length > 0 && strchr("/\\", folder[length - 1]);
  baum_i_putf(path, "%s%s%s", folder, ends ? "" : "/", name);
  return path->failed ? baum_i_fail_memory() : BAUM_OK;
}

static baum_status read_scene(const char *folder, baum_i_fmu_resources *out)
{
  baum_i_buffer path = {0};
  baum_status status = join(folder, "scene.json", &path);
  if (status == BAUM_OK) {
    status = baum_mechanism_read(path.text, NULL, 0, &out->mechanism);
  }
  baum_i_buffer_clear(&path);
  return status;
}

static baum_status read_interface(const char *folder, baum_i_fmu_resources *out)
{
  baum_i_buffer path = {0};
  baum_i_buffer text = {0};
  baum_i_json json = {0};
  const baum_i_scene_reader r = {.json = &json, .label = "fmu.json", .mechanism = out->mechanism};
  baum_status status = join(folder, "fmu.json", &path);
  if (status == BAUM_OK) {
    status = baum_i_read_file(path.text, "fmi3InstantiateCoSimulation", &text);
  }
  if (status == BAUM_OK) {
    status = baum_i_json_parse(text.text, text.used, r.label, &json);
  }
  if (status == BAUM_OK) {
    status = read_whole(&r, out);
    baum_i_json_release(&json);
  }
  baum_i_buffer_clear(&text);
  baum_i_buffer_clear(&path);
  return status;
}

baum_status baum_i_fmu_read(const char *folder, baum_i_fmu_resources *out)
{
  *out = (baum_i_fmu_resources){.options = baum_simulation_options_default()};
  BAUM_I_TRY(read_scene(folder, out));
  return read_interface(folder, out);
}

void baum_i_fmu_release(baum_i_fmu_resources *resources)
{
  baum_mechanism_destroy(resources->mechanism);
  baum_i_free(resources->token);
  baum_i_free(resources->inputs);
  baum_i_free(resources->parameters);
  baum_i_free(resources->channels);
  baum_i_free(resources->start);
}

/* ---- using ---- */

int baum_i_fmu_size(const baum_i_fmu_parameter *parameter)
{
  return (int)(parameter->field->size / sizeof(double));
}

static baum_status set_parameter(baum_mechanism *mechanism, const baum_i_fmu_parameter *parameter,
                                 const double *numbers)
{
  const baum_i_definition *definition = parameter->definition;
  void *def = baum_i_alloc(1, definition->size);
  BAUM_I_TRY(baum_i_check_memory(def));
  baum_status status = baum_i_get_element(mechanism, parameter->family, definition, parameter->id,
                                          def, definition->size);
  if (status == BAUM_OK) {
    memcpy((char *)def + parameter->field->offset, numbers, parameter->field->size);
    status = baum_i_set_element(mechanism, parameter->family, definition, parameter->id, def);
  }
  baum_i_free(def);
  return status;
}

static baum_status set_parameters(const baum_i_fmu_resources *resources, const double *numbers,
                                  baum_mechanism *mechanism)
{
  const double *next = numbers + resources->input_count;
  for (int k = 0; k < resources->parameter_count; k++) {
    BAUM_I_TRY(set_parameter(mechanism, &resources->parameters[k], next));
    next += baum_i_fmu_size(&resources->parameters[k]);
  }
  return baum_mechanism_freeze(mechanism);
}

baum_status baum_i_fmu_build(const baum_i_fmu_resources *resources, const double *numbers,
                             baum_mechanism **out)
{
  BAUM_I_TRY(baum_mechanism_copy(resources->mechanism, out));
  baum_status status = set_parameters(resources, numbers, *out);
  if (status != BAUM_OK) {
    baum_mechanism_destroy(*out);
    *out = NULL;
  }
  return status;
}
