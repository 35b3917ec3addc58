/* SPDX-License-Identifier: BSD-3-Clause */
#include "drawn.h"

#include <string.h>

#include "drawn_functions.h"

/* ---- fields ---- */

/* A definition whose fields are chosen one after the other. */
typedef struct drawing {
  design_mechanism *m;
  fuzz_bytes *b;
  const element_kind *kind;
  element_fields fields;
  any_def *def;
  int arrays; /* number of arrays of numbers in use */
} drawing;

static void put(const drawing *d, const element_field *f, const void *value, size_t size)
{
  memcpy(d->def->bytes + f->offset, value, size);
}

static void draw_size(const drawing *d, const element_field *f)
{
  if (fuzz_byte(d->b) == 255) {
    size_t size = (size_t)fuzz_byte(d->b);
    put(d, f, &size, sizeof size);
  }
}

static void draw_name(const drawing *d, const element_field *f)
{
  const char *name = NULL;
  int length = fuzz_byte(d->b);
  if (length > 16) {
    memset(d->m->name, '%', sizeof d->m->name);
    d->m->name[length < 250 ? length % 8 : DRAWN_NAME - 1] = '\0';
    name = d->m->name;
  }
  put(d, f, &name, sizeof name);
}

static void draw_numbers(const drawing *d, const element_field *f)
{
  for (size_t at = 0; at < f->size; at += sizeof(double)) {
    double x = fuzz_number(d->b);
    memcpy(d->def->bytes + f->offset + at, &x, sizeof x);
  }
}

static void draw_integer(const drawing *d, const element_field *f)
{
  static const int32_t odd[] = {-1, INT32_MIN, 40, INT32_MAX};
  int roll = fuzz_below(d->b, 4 * DRAWN_ROOM);
  int32_t value = roll < 4 ? odd[roll] : roll % (DRAWN_ROOM + 1);
  put(d, f, &value, sizeof value);
}

static void draw_flag(const drawing *d, const element_field *f)
{
  bool value = fuzz_below(d->b, 2) == 1;
  put(d, f, &value, sizeof value);
}

/* Returns a handle, which usually belongs to an existing element. */
static any_id draw_id_of(design_mechanism *m, fuzz_bytes *b, int family)
{
  int roll = fuzz_byte(b);
  if (m->counts[family] > 0 && roll >= 64) {
    return m->ids[family][roll % m->counts[family]];
  }
  any_id id = {BAUM_GROUND.index1, BAUM_GROUND.tag};
  if (roll % 8 == 7) {
    fuzz_copy(b, &id, sizeof id);
  }
  return id;
}

static void draw_id(const drawing *d, const element_field *f)
{
  any_id id = {d->m->input.index1, d->m->input.tag};
  if (strcmp(f->name, "input") != 0) {
    id = draw_id_of(d->m, d->b, strncmp(f->name, "joint", 5) == 0 ? 1 : 0);
  }
  put(d, f, &id, sizeof id);
}

static void draw_function(const drawing *d, const element_field *f)
{
  unsigned char bytes[sizeof(void (*)(void))];
  if (strcmp(f->name, "user") == 0) {
    design_user *user = NULL;
    if (d->m->user_count < 3 * DRAWN_MOST) {
      user = &d->m->users[d->m->user_count++];
      *user = (design_user){.size = 1};
    }
    if (user && fuzz_below(d->b, 8) == 0) {
      user->calls = fuzz_byte(d->b);
      user->answer = fuzz_below(d->b, 3) - 1;
    }
    put(d, f, &user, sizeof user);
  } else if (design_function(d->kind->name, f->name, bytes)) {
    put(d, f, bytes, sizeof bytes);
  }
}

static void draw_array(drawing *d, const element_field *f)
{
  const void *values = d->m->bodies;
  if (strcmp(f->name, "bodies") == 0) {
    for (int k = 0; k < DRAWN_ROOM; k++) {
      any_id id = draw_id_of(d->m, d->b, 0);
      d->m->bodies[k] = (baum_body_id){id.index1, id.tag};
    }
  } else {
    double *numbers = d->m->numbers[d->arrays++];
    values = numbers;
    for (int k = 0; k < DRAWN_ROOM; k++) {
      numbers[k] = fuzz_number(d->b);
    }
  }
  put(d, f, &values, sizeof values);
}

static void draw_field(drawing *d, const element_field *f)
{
  switch (f->type) {
  case FIELD_SIZE: draw_size(d, f); break;
  case FIELD_NAME: draw_name(d, f); break;
  case FIELD_NUMBERS: draw_numbers(d, f); break;
  case FIELD_INTEGER: draw_integer(d, f); break;
  case FIELD_FLAG: draw_flag(d, f); break;
  case FIELD_ID: draw_id(d, f); break;
  case FIELD_FUNCTION: draw_function(d, f); break;
  case FIELD_ARRAY: draw_array(d, f); break;
  case FIELD_GAINS:
  default: break;
  }
}

/* ---- definitions ---- */

/* Sets all arrays to NULL if the definition states more entries than the arrays have. */
static void drop_short_arrays(const drawing *d, int32_t count)
{
  const void *none = NULL;
  for (int k = 0; k < d->fields.count && count > DRAWN_ROOM; k++) {
    if (d->fields.list[k].type == FIELD_ARRAY) {
      put(d, &d->fields.list[k], &none, sizeof none);
    }
  }
}

static int32_t integer_of(const drawing *d, const char *name)
{
  int32_t value = 0;
  for (int k = 0; k < d->fields.count; k++) {
    const element_field *f = &d->fields.list[k];
    if (f->type == FIELD_INTEGER && strcmp(f->name, name) == 0) {
      memcpy(&value, d->def->bytes + f->offset, sizeof value);
    }
  }
  return value;
}

void design_definition(design_mechanism *m, fuzz_bytes *b, const element_kind *kind, any_def *def)
{
  drawing d = {.m = m, .b = b, .kind = kind, .fields = element_fields_of(kind), .def = def};
  int users = m->user_count;
  memset(def, 0, sizeof *def);
  kind->init(def, kind->size);
  for (int k = 0; k < d.fields.count; k++) {
    if (d.fields.list[k].type == FIELD_ID || fuzz_below(b, 4) != 0) {
      draw_field(&d, &d.fields.list[k]);
    }
  }
  int32_t size = integer_of(&d, "size");
  drop_short_arrays(&d, size);
  drop_short_arrays(&d, integer_of(&d, "body_count"));
  drop_short_arrays(&d, integer_of(&d, "count"));
  if (m->user_count > users && size > 0 && size <= DRAWN_ROOM) {
    m->users[users].size = size;
  }
}

int design_family(const element_kind *kind)
{
  static const char *const families[] = {"body", "joint", "force"};
  int family = 0;
  while (strcmp(kind->family, families[family]) != 0) {
    family++;
  }
  return family;
}

/* ---- mechanisms ---- */

static void add_one(design_mechanism *m, fuzz_bytes *b)
{
  int k = fuzz_below(b, ELEMENT_KINDS);
  const element_kind *kind = &element_kinds[k];
  int family = design_family(kind);
  any_def def;
  any_id id = {-7, 7};
  if (m->counts[family] == DRAWN_MOST) {
    return;
  }
  design_definition(m, b, kind, &def);
  if (fuzz_status(kind->add(m->mechanism, &def, &id)) != BAUM_OK) {
    FUZZ_CHECK(id.index1 == -7 && id.tag == 7);
    return;
  }
  m->kinds[family][m->counts[family]] = k;
  m->ids[family][m->counts[family]++] = id;
}

/* Reads a definition back and sets it again. Then sets a second definition. If the library refuses
 * the second one, the first one must be unchanged. */
static void replace_one(design_mechanism *m, fuzz_bytes *b)
{
  int family = fuzz_below(b, 3);
  if (m->counts[family] == 0) {
    return;
  }
  int n = fuzz_below(b, m->counts[family]);
  const element_kind *kind = &element_kinds[m->kinds[family][n]];
  any_id id = m->ids[family][n];
  any_def before;
  any_def now;
  any_def def;
  memset(&before, 0, sizeof before);
  memset(&now, 0, sizeof now);
  FUZZ_CHECK(kind->get(m->mechanism, id, &before, kind->size) == BAUM_OK);
  FUZZ_CHECK(kind->set(m->mechanism, id, &before) == BAUM_OK);
  FUZZ_CHECK(kind->get(m->mechanism, id, &before, kind->size) == BAUM_OK);
  design_definition(m, b, kind, &def);
  if (fuzz_status(kind->set(m->mechanism, id, &def)) != BAUM_OK) {
    FUZZ_CHECK(kind->get(m->mechanism, id, &now, kind->size) == BAUM_OK);
    FUZZ_CHECK(memcmp(&before, &now, sizeof now) == 0);
  }
}

static void ask_for_wrong_element(design_mechanism *m, fuzz_bytes *b)
{
  const element_kind *kind = &element_kinds[fuzz_below(b, ELEMENT_KINDS)];
  any_def def;
  memset(&def, 0, sizeof def);
  any_id id = draw_id_of(m, b, design_family(kind));
  (void)fuzz_status(kind->get(m->mechanism, id, &def, (size_t)fuzz_byte(b)));
}

/* Replaces the mechanism by its copy. The handles of the elements remain valid. */
static void continue_with_copy(design_mechanism *m)
{
  baum_mechanism *copy = NULL;
  FUZZ_CHECK(baum_mechanism_copy(m->mechanism, &copy) == BAUM_OK);
  baum_mechanism_destroy(m->mechanism);
  m->mechanism = copy;
}

static void call_another(design_mechanism *m, fuzz_bytes *b)
{
  double x[3] = {fuzz_number(b), fuzz_number(b), fuzz_number(b)};
  switch (fuzz_below(b, 8)) {
  case 0: (void)fuzz_status(baum_mechanism_set_gravity(m->mechanism, x[0], x[1], x[2])); break;
  case 1: (void)fuzz_status(baum_mechanism_set_characteristic_length(m->mechanism, x[0])); break;
  case 2: (void)fuzz_status(baum_mechanism_add_input(m->mechanism, "%", x[0], &m->input)); break;
  case 3: (void)fuzz_status(baum_mechanism_set_input(m->mechanism, m->input, x[0])); break;
  case 4: (void)fuzz_status(baum_mechanism_add_break_times(m->mechanism, x, 3)); break;
  case 5: continue_with_copy(m); break;
  case 6: replace_one(m, b); break;
  default: ask_for_wrong_element(m, b); break;
  }
}

void design_mechanism_make(design_mechanism *m, fuzz_bytes *b)
{
  enum { CALLS = 60 };
  memset(m, 0, sizeof *m);
  FUZZ_CHECK(baum_mechanism_create(&m->mechanism) == BAUM_OK);
  for (int k = 0; k < CALLS && b->left > 0 && fuzz_byte(b) != 0; k++) {
    if (fuzz_below(b, 4) != 0) {
      add_one(m, b);
    } else {
      call_another(m, b);
    }
  }
}

void design_mechanism_destroy(design_mechanism *m)
{
  baum_mechanism_destroy(m->mechanism);
  m->mechanism = NULL;
}
