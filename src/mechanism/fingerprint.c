/* SPDX-License-Identifier: BSD-3-Clause */
#include "mechanism/fingerprint.h"

static void add_numbers(baum_i_digest *sum, const double *numbers, int count)
{
  baum_i_digest_add(sum, numbers, (size_t)count * sizeof *numbers);
}

static void add_elements(const baum_mechanism *m, const baum_i_family *family,
                         baum_i_digest *structure, baum_i_digest *numbers)
{
  for (int k = 0; k < baum_i_family_count(family, m); k++) {
    baum_i_element *element = family->at(m, k);
    const baum_i_span *span = baum_i_family_span(family, element);
    baum_i_digest_add_text(structure, element->definition->kind);
    baum_i_digest_add_integer(structure, family->rows(element));
    for (int i = 0; i < span->body_count; i++) {
      baum_i_digest_add_integer(structure, span->bodies[i]);
    }
    baum_i_fields_digest(element->definition, element->def, numbers);
  }
}

static void add_inputs(const baum_mechanism *m, baum_i_digest *structure)
{
  baum_i_digest_add_integer(structure, m->input_count);
  for (int i = 0; i < m->input_count; i++) {
    baum_i_digest_add_text(structure, m->input_names[i]);
  }
}

baum_i_fingerprint baum_i_mechanism_fingerprint(const baum_mechanism *m)
{
  baum_i_digest structure = {0};
  baum_i_digest numbers = {0};
  const int sizes[] = {m->nq, m->nv, m->nc, m->body_count, m->joint_count, m->force_count};
  for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
    baum_i_digest_add_integer(&structure, sizes[k]);
  }
  for (int i = 0; i < BAUM_I_FAMILIES; i++) {
    add_elements(m, baum_i_families[i], &structure, &numbers);
  }
  add_inputs(m, &structure);
  add_numbers(&numbers, m->breaks, m->break_count);
  add_numbers(&numbers, m->gravity, 3);
  add_numbers(&numbers, &m->length, 1);
  add_numbers(&numbers, m->scale, m->nv);
  add_numbers(&numbers, m->position_scale, m->flat ? 0 : m->nq);
  add_numbers(&numbers, m->parameters, m->parameter_count);
  return (baum_i_fingerprint){.structure = structure.value, .numbers = numbers.value};
}
