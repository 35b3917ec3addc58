/* SPDX-License-Identifier: BSD-3-Clause */
/* The list of all mechanisms. This file finds entries of the list, reads parameters, and builds
 * mechanisms. */
#include "catalog/catalog.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define ADDRESS(name) &baum_i_##name,
static const baum_i_catalog_mechanism *const MECHANISMS[] = {BAUM_I_CATALOG_LIST(ADDRESS)};
enum { COUNT = sizeof MECHANISMS / sizeof MECHANISMS[0], MESSAGE = 1024 };
static const double QUARTER = 1.5707963267948966; /* [rad] a quarter of a revolution */

baum_status baum_i_catalog_fail(baum_status status, const char *format, ...)
{
  char text[MESSAGE];
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return baum_fail(status, text);
}

/* Appends ", " and a name. If the text becomes too long, the name is cut. */
static void append_name(char text[MESSAGE], const char *name)
{
  size_t used = strlen(text);
  (void)snprintf(text + used, MESSAGE - used, "%s%s", used > 0 ? ", " : "", name);
}

/* ---- entries ---- */

baum_status baum_i_catalog_give(void *out, size_t caller_size, const void *whole, size_t size)
{
  if (!out || caller_size < sizeof(size_t)) {
    return baum_fail(BAUM_ERR_ARGUMENT, "catalogue: out is NULL or caller_size is too small");
  }
  size_t bytes = caller_size < size ? caller_size : size;
  memcpy(out, whole, bytes);
  memcpy(out, &bytes, sizeof bytes);
  return BAUM_OK;
}

int32_t baum_catalog_count(void)
{
  return COUNT;
}

static baum_status give_entry(const baum_i_catalog_mechanism *of, baum_catalog_entry *out,
                              size_t caller_size)
{
  const baum_catalog_entry entry = {.name = of->name,
                                    .title = of->title,
                                    .source = of->source,
                                    .provenance = of->provenance,
                                    .note = of->note ? of->note : "",
                                    .parameter_count = of->parameter_count,
                                    .sample_count = of->samples,
                                    .end_time = of->end,
                                    .digits_q = of->samples > 0 ? of->digits_q : (double)NAN,
                                    .digits_v = of->samples > 0 ? of->digits_v : (double)NAN,
                                    .exact = of->solution != NULL,
                                    .smooth = !of->branches};
  return baum_i_catalog_give(out, caller_size, &entry, sizeof entry);
}

baum_status baum_catalog_entry_at(int32_t k, baum_catalog_entry *out, size_t caller_size)
{
  if (k < 0 || k >= COUNT) {
    return baum_i_catalog_fail(BAUM_ERR_ARGUMENT, "catalogue: k is %d, must be 0 to %d", (int)k,
                               COUNT - 1);
  }
  return give_entry(MECHANISMS[k], out, caller_size);
}

const baum_i_catalog_mechanism *baum_i_catalog_find(const char *name)
{
  char names[MESSAGE] = "";
  for (int k = 0; k < COUNT; k++) {
    if (name && strcmp(name, MECHANISMS[k]->name) == 0) {
      return MECHANISMS[k];
    }
    append_name(names, MECHANISMS[k]->name);
  }
  (void)baum_i_catalog_fail(BAUM_ERR_ARGUMENT, "catalogue: there is no \"%.80s\"; there are %.800s",
                            name ? name : "NULL", names);
  return NULL;
}

baum_status baum_catalog_find(const char *name, baum_catalog_entry *out, size_t caller_size)
{
  const baum_i_catalog_mechanism *found = baum_i_catalog_find(name);
  return found ? give_entry(found, out, caller_size) : BAUM_ERR_ARGUMENT;
}

/* ---- parameters ---- */

baum_status baum_catalog_parameter_at(const char *name, int32_t k, baum_catalog_parameter *out,
                                      size_t caller_size)
{
  const baum_i_catalog_mechanism *of = baum_i_catalog_find(name);
  if (!of) {
    return BAUM_ERR_ARGUMENT;
  }
  if (k < 0 || k >= of->parameter_count) {
    return baum_i_catalog_fail(BAUM_ERR_ARGUMENT,
                               "catalogue: k is %d, but \"%s\" has %d parameters", (int)k, of->name,
                               of->parameter_count);
  }
  const baum_i_catalog_parameter *parameter = &of->parameters[k];
  const baum_catalog_parameter whole = {.name = parameter->name,
                                        .unit = parameter->unit,
                                        .meaning = parameter->meaning,
                                        .value = of->defaults[k],
                                        .positive = parameter->range >= BAUM_I_POSITIVE,
                                        .whole = parameter->range == BAUM_I_WHOLE};
  return baum_i_catalog_give(out, caller_size, &whole, sizeof whole);
}

static int find_parameter(const baum_i_catalog_mechanism *of, const char *name)
{
  char names[MESSAGE] = "";
  for (int k = 0; k < of->parameter_count; k++) {
    if (name && strcmp(name, of->parameters[k].name) == 0) {
      return k;
    }
    append_name(names, of->parameters[k].name);
  }
  (void)baum_i_catalog_fail(BAUM_ERR_ARGUMENT,
                            "catalogue: \"%s\" has no parameter \"%.80s\"; there are: %.800s",
                            of->name, name ? name : "NULL", names);
  return -1;
}

/* For each range: the words by which a message says what a value must be. */
static const char *const RULES[] = {[BAUM_I_ANY] = "finite",
                                    [BAUM_I_NONZERO] = "other than 0",
                                    [BAUM_I_ACUTE] = "between -pi/2 and pi/2",
                                    [BAUM_I_POSITIVE] = "positive",
                                    [BAUM_I_WHOLE] = "a whole number from 1 to 1e6"};

static bool is_in_range(baum_i_catalog_range range, double value)
{
  switch (range) {
  case BAUM_I_ANY: break;
  case BAUM_I_NONZERO: return value != 0.0;
  case BAUM_I_ACUTE: return fabs(value) < QUARTER;
  case BAUM_I_POSITIVE: return value > 0.0;
  case BAUM_I_WHOLE: return value == floor(value) && value > 0.0 && value <= 1e6;
  }
  return true;
}

static baum_status set_parameter(const baum_i_catalog_mechanism *of,
                                 const baum_catalog_setting *setting, double *p)
{
  int k = find_parameter(of, setting->name);
  if (k < 0) {
    return BAUM_ERR_ARGUMENT;
  }
  const baum_i_catalog_parameter *parameter = &of->parameters[k];
  double value = setting->value;
  if (!isfinite(value) || !is_in_range(parameter->range, value)) {
    const char *rule = RULES[isfinite(value) ? parameter->range : BAUM_I_ANY];
    bool pure = strcmp(parameter->unit, "-") == 0;
    return baum_i_catalog_fail(BAUM_ERR_ARGUMENT, "catalogue: \"%s\": %s is %g%s%s, must be %s",
                               of->name, parameter->name, value, pure ? "" : " ",
                               pure ? "" : parameter->unit, rule);
  }
  p[k] = value;
  return BAUM_OK;
}

baum_status baum_i_catalog_resolve(const baum_catalog_choice *choice,
                                   const baum_i_catalog_mechanism **out,
                                   double p[BAUM_I_CATALOG_PARAMETERS])
{
  if (!choice) {
    (void)baum_fail(BAUM_ERR_ARGUMENT, "catalogue: the choice is NULL");
    return BAUM_ERR_ARGUMENT; /* tells a static analyzer that this is a failure */
  }
  *out = baum_i_catalog_find(choice->name);
  if (!*out) {
    return BAUM_ERR_ARGUMENT;
  }
  if (choice->setting_count < 0 || (choice->setting_count > 0 && !choice->settings)) {
    return baum_i_catalog_fail(
      BAUM_ERR_ARGUMENT, "catalogue: \"%s\": settings %s, but setting_count is %d", (*out)->name,
      choice->settings ? "are given" : "are NULL", (int)choice->setting_count);
  }
  for (int k = 0; k < (*out)->parameter_count; k++) {
    p[k] = (*out)->defaults[k];
  }
  for (int k = 0; k < choice->setting_count; k++) {
    BAUM_I_CATALOG_TRY(set_parameter(*out, &choice->settings[k], p));
  }
  return BAUM_OK;
}

/* ---- mechanisms ---- */

int baum_i_catalog_bodies(const baum_i_catalog_mechanism *mechanism, const double *p)
{
  return mechanism->count ? mechanism->count(p) : mechanism->bodies;
}

baum_status baum_catalog_build(const baum_catalog_choice *choice, baum_mechanism **out)
{
  if (!out) {
    return baum_fail(BAUM_ERR_ARGUMENT, "baum_catalog_build: out is NULL");
  }
  *out = NULL;
  const baum_i_catalog_mechanism *which = NULL;
  double p[BAUM_I_CATALOG_PARAMETERS];
  BAUM_I_CATALOG_TRY(baum_i_catalog_resolve(choice, &which, p));
  baum_i_parts parts = baum_i_parts_begin();
  which->build(&parts, p);
  return baum_i_parts_finish(&parts, out);
}
