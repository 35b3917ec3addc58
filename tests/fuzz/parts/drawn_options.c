/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "drawn.h"

static const baum_integrator *draw_integrator(fuzz_bytes *b)
{
  int count = 0;
  while (baum_integrator_at(count)) {
    count++;
  }
  return baum_integrator_at(fuzz_below(b, count));
}

/* Sets the step or the rtol, whichever the integrator needs. */
static void draw_steps(fuzz_bytes *b, baum_simulation_options *o)
{
  bool fixed = baum_integrator_has_fixed_step(o->integrator);
  bool variable = baum_integrator_has_variable_step(o->integrator);
  double x = fuzz_small(b);
  if (fixed && (!variable || fuzz_below(b, 2) == 0)) {
    o->step = x;
  } else if (variable) {
    o->rtol = x;
  }
}

static void draw_integer(fuzz_bytes *b, const element_field *f, unsigned char *at)
{
  int64_t value = fuzz_below(b, 10) - 1;
  if (f->size == sizeof(int32_t)) {
    memcpy(at, &(int32_t){(int32_t)value}, sizeof(int32_t));
  } else {
    memcpy(at, &value, sizeof value);
  }
}

/* Chooses the size of the options. Every size that the library may accept includes max_steps. With
 * the smaller struct of an older version, which lacks this field, a run could make a billion
 * steps. */
static size_t draw_size(fuzz_bytes *b)
{
  const size_t least = offsetof(baum_simulation_options, max_steps) + sizeof(int64_t);
  const size_t nonsense = sizeof(size_t);
  size_t size = fuzz_below(b, 4) == 0 ? (size_t)fuzz_byte(b) : sizeof(baum_simulation_options);
  return size > nonsense && size < least ? least : size;
}

static void draw_field(fuzz_bytes *b, baum_simulation_options *o)
{
  const element_field *f = &option_fields[fuzz_below(b, OPTION_FIELDS)];
  unsigned char *at = (unsigned char *)o + f->offset;
  double x = fuzz_number(b);
  switch (f->type) {
  case FIELD_NUMBERS: memcpy(at, &x, sizeof x); break;
  case FIELD_INTEGER: draw_integer(b, f, at); break;
  case FIELD_FLAG: *at = (unsigned char)fuzz_below(b, 2); break;
  case FIELD_GAINS: o->gains = (baum_gains){fuzz_below(b, 10) - 1, {x, fuzz_number(b)}}; break;
  case FIELD_SIZE: o->struct_size = draw_size(b); break;
  case FIELD_FUNCTION: /* other code sets these: integrator, progress, user, row_gains */
  case FIELD_NAME:
  case FIELD_ID:
  case FIELD_ARRAY:
  default: break;
  }
}

void design_options(fuzz_bytes *b, int steps, double factors[DRAWN_ROOM],
                    baum_simulation_options *out)
{
  *out = baum_simulation_options_default();
  out->integrator = draw_integrator(b);
  draw_steps(b, out);
  for (int k = fuzz_below(b, 8); k > 0; k--) {
    draw_field(b, out);
  }
  if (fuzz_below(b, 8) == 7) {
    for (int k = 0; k < DRAWN_ROOM; k++) {
      factors[k] = fuzz_number(b);
    }
    out->row_gains = factors;
  }
  if (out->max_steps > steps) {
    out->max_steps = steps;
  }
}
