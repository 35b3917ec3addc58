/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests definitions, ids and mechanisms that must be refused. Each test compares the message, and
 * checks that nothing has changed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "every_element.h"
#include "message.h"
#include "user_models.h"

static const any_id SENTINEL = {77, 88};

enum { PARTS_SIZE = 160 };

/* Checks the numbers of velocities and rows. It uses a frozen copy, because these numbers are only
 * known after freeze. */
static void check_size(const baum_mechanism *mechanism, int nv, int nc)
{
  baum_mechanism *copy = NULL;
  int32_t found[2] = {0, 0};
  assert_int_equal(baum_mechanism_copy(mechanism, &copy), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(copy), BAUM_OK);
  assert_int_equal(baum_mechanism_sizes(copy, NULL, &found[0], &found[1]), BAUM_OK);
  assert_int_equal(found[0], nv);
  assert_int_equal(found[1], nc);
  baum_mechanism_destroy(copy);
}

/* Checks that adding the definition is refused and leaves the id unchanged. Checks also that
 * setting it is refused and keeps the old definition. */
static void check_refused(every_element *parts, const element_kind *kind, const any_def *def,
                          baum_status want, const char *message)
{
  any_id id = SENTINEL;
  ASSERT_SAYS(kind->add(parts->mechanism, def, &id), want, message);
  assert_memory_equal(&id, &SENTINEL, sizeof id);
  any_id present = every_element_id(parts, kind);
  any_def before;
  any_def after;
  assert_int_equal(kind->get(parts->mechanism, present, &before, kind->size), BAUM_OK);
  ASSERT_SAYS(kind->set(parts->mechanism, present, def), want, message);
  assert_int_equal(kind->get(parts->mechanism, present, &after, kind->size), BAUM_OK);
  assert_memory_equal(&before, &after, kind->size);
}

typedef void kind_check(every_element *parts, const element_kind *kind);

/* Runs a check for each kind of element on one open mechanism. Afterwards the size of this
 * mechanism must be the same. */
static void for_every_kind(kind_check *check)
{
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    check(&parts, &element_kinds[k]);
  }
  check_size(parts.mechanism, EVERY_NV, EVERY_NC);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- struct_size ---- */

static void check_struct_sizes(every_element *parts, const element_kind *kind)
{
  const size_t sizes[] = {0,
                          1,
                          sizeof(size_t),
                          kind->size - 1,
                          kind->size + 1,
                          kind->size + sizeof(size_t),
                          4 * kind->size,
                          SIZE_MAX};
  any_def def;
  kind->good(parts, &def);
  for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
    char message[PARTS_SIZE];
    (void)snprintf(message, sizeof message, "%s: struct_size is %zu|must be %zu|default",
                   kind->title, sizes[k], kind->size);
    def.head.struct_size = sizes[k];
    check_refused(parts, kind, &def, BAUM_ERR_STRUCT, message);
  }
}

static void a_wrong_struct_size_is_refused(void **state)
{
  (void)state;
  for_every_kind(check_struct_sizes);
}

/* ---- names ---- */

static void check_names(every_element *parts, const element_kind *kind)
{
  const char *const names[] = {"", "two\nlines", "a\ttab", "\r", "last\x7f", "\x01"};
  any_def def;
  kind->good(parts, &def);
  for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
    def.head.name = names[k];
    check_refused(parts, kind, &def, BAUM_ERR_ARGUMENT,
                  names[k][0] ? ": name has the control character 0x|must not contain"
                              : ": name is empty; NULL stands for the default name");
    assert_null(strpbrk(baum_message(), "\n\t\r\x7f\x01"));
  }
}

static void names_that_break_messages_are_refused(void **state)
{
  (void)state;
  for_every_kind(check_names);
}

/* ---- NULL ---- */

static void check_nulls(every_element *parts, const element_kind *kind)
{
  char mechanism_sentence[PARTS_SIZE];
  char def_sentence[PARTS_SIZE];
  (void)snprintf(mechanism_sentence, PARTS_SIZE, "%s: the mechanism is NULL", kind->title);
  (void)snprintf(def_sentence, PARTS_SIZE, "%s: the definition is NULL", kind->title);
  any_def def;
  any_id id = SENTINEL;
  any_id present = every_element_id(parts, kind);
  kind->good(parts, &def);
  ASSERT_SAYS(kind->add(NULL, &def, &id), BAUM_ERR_ARGUMENT, mechanism_sentence);
  ASSERT_SAYS(kind->add(parts->mechanism, NULL, &id), BAUM_ERR_ARGUMENT, def_sentence);
  assert_memory_equal(&id, &SENTINEL, sizeof id);
  ASSERT_SAYS(kind->set(NULL, present, &def), BAUM_ERR_ARGUMENT, mechanism_sentence);
  ASSERT_SAYS(kind->set(parts->mechanism, present, NULL), BAUM_ERR_ARGUMENT, def_sentence);
  ASSERT_SAYS(kind->get(NULL, present, &def, kind->size), BAUM_ERR_ARGUMENT, mechanism_sentence);
  ASSERT_SAYS(kind->get(parts->mechanism, present, NULL, kind->size), BAUM_ERR_ARGUMENT,
              "out is NULL");
  for (size_t size = 0; size < sizeof(size_t); size++) {
    ASSERT_SAYS(kind->get(parts->mechanism, present, &def, size), BAUM_ERR_ARGUMENT,
                "caller_size is too small");
  }
}

static void null_is_refused_by_add_get_and_set(void **state)
{
  (void)state;
  for_every_kind(check_nulls);
}

/* ---- numbers ---- */

/* The message names the element in the form: body 1 "crank". */
static void check_number(every_element *parts, const element_kind *kind, const element_field *field,
                         size_t i, double bad)
{
  any_def def;
  kind->good(parts, &def);
  double values[FIELD_NUMBERS_MAX] = {0.0};
  values[i] = bad;
  memcpy(def.bytes + field->offset, values, field->size);
  char message[PARTS_SIZE];
  (void)snprintf(message, sizeof message, "%s|\"%s\"|%s|%g|must be", kind->family, def.head.name,
                 field->name, bad);
  check_refused(parts, kind, &def, BAUM_ERR_ARGUMENT, message);
}

static bool begins(const char *text, const char *with)
{
  return strncmp(text, with, strlen(with)) == 0;
}

/* Tells whether NaN in this field means "not given". */
static bool may_be_nan(const char *name)
{
  return begins(name, "velocity") || begins(name, "angular_velocity") || begins(name, "length") ||
         begins(name, "free_length") || begins(name, "free_angle") || begins(name, "free_value") ||
         begins(name, "offset") || begins(name, "transition") || strcmp(name, "angle") == 0;
}

static void check_not_finite(every_element *parts, const element_kind *kind)
{
  const element_fields fields = element_fields_of(kind);
  for (int k = 0; k < fields.count; k++) {
    const element_field *field = &fields.list[k];
    bool nan_is_fine = may_be_nan(field->name) && kind != &element_kinds[0];
    nan_is_fine = nan_is_fine || begins(field->name, "velocity") ||
                  begins(field->name, "angular_velocity") || begins(field->name, "point") ||
                  begins(field->name, "axis_b") || begins(field->name, "x_axis");
    for (size_t i = 0; field->type == FIELD_NUMBERS && i < field->size / sizeof(double); i++) {
      check_number(parts, kind, field, i, (double)INFINITY);
      check_number(parts, kind, field, i, -(double)INFINITY);
      if (!nan_is_fine) {
        check_number(parts, kind, field, i, (double)NAN);
      }
    }
  }
}

static void numbers_that_are_not_finite_are_refused(void **state)
{
  (void)state;
  for_every_kind(check_not_finite);
}

static void masses_inertias_and_lengths_out_of_range_are_refused(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  static const struct {
    int kind;
    const char *field;
    double value;
    const char *message;
  } bad[] = {
    {0, "mass", -2.0, "\"crank\": mass is -2 kg, must be finite and > 0"},
    {0, "mass", 0.0, "\"crank\": mass is 0 kg, must be finite and > 0"},
    {0, "inertia", 0.0, "\"crank\": inertia is 0 kg m^2, must be finite and > 0"},
    {0, "inertia", -1e-9, "\"crank\": inertia is -1e-09 kg m^2, must be finite and > 0"},
    {1, "mass", -0.5, "\"bob\": mass is -0.5 kg, must be finite and > 0"},
    {4, "length", 0.0, "\"rod\": length is 0 m, must be finite and > 0"},
    {4, "length", -1.0, "\"rod\": length is -1 m, must be finite and > 0"},
    {9, "stiffness", -3.0, "\"spring\": stiffness is -3 N/m, must be finite and >= 0"},
    {9, "damping", -1.0, "\"spring\": damping is -1 N s/m, must be finite and >= 0"},
    {9, "free_length", -1.0, "\"spring\": free_length is -1 m, must be finite and >= 0"},
    {12, "stiffness", -3.0, "\"twist\": stiffness is -3 N m/rad, must be finite and >= 0"},
    {12, "damping", -1.0, "\"twist\": damping is -1 N m s/rad, must be finite and >= 0"},
  };
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    const element_kind *kind = &element_kinds[bad[k].kind];
    const element_fields fields = element_fields_of(kind);
    any_def def;
    kind->good(&parts, &def);
    for (int f = 0; f < fields.count; f++) {
      if (strcmp(fields.list[f].name, bad[k].field) == 0) {
        memcpy(def.bytes + fields.list[f].offset, &bad[k].value, sizeof(double));
      }
    }
    check_refused(&parts, kind, &def, BAUM_ERR_ARGUMENT, bad[k].message);
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- ids ---- */

static void check_ids(every_element *parts, const element_kind *kind)
{
  const element_fields fields = element_fields_of(kind);
  for (int k = 0; k < fields.count; k++) {
    const element_field *field = &fields.list[k];
    if (field->type != FIELD_ID) {
      continue;
    }
    any_def def;
    char message[PARTS_SIZE];
    kind->good(parts, &def);
    any_id good;
    memcpy(&good, def.bytes + field->offset, sizeof good);
    uint32_t tag = parts->crank.tag;
    const any_id bad[] = {{0, 0}, {0, tag}, {1, tag + 1}, {1, 0}, {99, tag}, {-1, tag}, {-7, 0}};
    /* {0, 0} means that there is no input. */
    size_t first = strcmp(field->name, "input") == 0 ? 1 : 0;
    for (size_t i = first; i < sizeof bad / sizeof *bad; i++) {
      memcpy(def.bytes + field->offset, &bad[i], sizeof bad[i]);
      (void)snprintf(message, sizeof message, "%s|\"%s\"|%s is %s", kind->family, def.head.name,
                     field->name,
                     bad[i].index1 == 0 ? "none, must be given" : "not of this mechanism");
      check_refused(parts, kind, &def, BAUM_ERR_ARGUMENT, message);
    }
  }
}

static void none_and_foreign_ids_in_definitions_are_refused(void **state)
{
  (void)state;
  for_every_kind(check_ids);
}

static void check_own_id(every_element *parts, const element_kind *kind)
{
  any_def def;
  any_def got;
  kind->good(parts, &def);
  any_id good = every_element_id(parts, kind);
  const any_id bad[] = {{0, 0}, {good.index1, good.tag + 1}, {99, good.tag}, {-1, 0}};
  int count = strcmp(kind->family, "body") == 0 ? 4 : 3;
  memset(&got, 0x5A, sizeof got);
  for (int i = 0; i < count; i++) {
    ASSERT_SAYS(kind->get(parts->mechanism, bad[i], &got, kind->size), BAUM_ERR_ARGUMENT,
                kind->title);
    ASSERT_SAYS(kind->set(parts->mechanism, bad[i], &def), BAUM_ERR_ARGUMENT, kind->title);
    assert_int_equal(got.bytes[0], 0x5A);
  }
}

static void none_foreign_and_ground_ids_have_no_definition(void **state)
{
  (void)state;
  for_every_kind(check_own_id);
}

/* The functions of one kind must refuse to read or replace an element of another kind in the same
 * family. */
static void check_other_kind(every_element *parts, const element_kind *kind)
{
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    const element_kind *other = &element_kinds[k];
    if (other == kind || strcmp(other->family, kind->family) != 0) {
      continue;
    }
    any_def def;
    char message[PARTS_SIZE];
    (void)snprintf(message, sizeof message, "is a %s, not a %s", other->title, kind->title);
    any_id id = every_element_id(parts, other);
    ASSERT_SAYS(kind->get(parts->mechanism, id, &def, kind->size), BAUM_ERR_ARGUMENT, message);
    kind->good(parts, &def);
    ASSERT_SAYS(kind->set(parts->mechanism, id, &def), BAUM_ERR_ARGUMENT, message);
  }
}

static void ids_of_another_kind_of_element_are_refused(void **state)
{
  (void)state;
  for_every_kind(check_other_kind);
}

static void a_joint_of_a_body_to_itself_is_refused(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  for (int k = 3; k < ELEMENT_KINDS; k++) {
    const element_kind *kind = &element_kinds[k];
    const element_fields fields = element_fields_of(kind);
    const element_field *b = &fields.list[3];
    if (strcmp(b->name, "body_b") != 0) {
      continue;
    }
    any_def def;
    kind->good(&parts, &def);
    memcpy(def.bytes + fields.list[2].offset, &parts.crank, sizeof parts.crank);
    memcpy(def.bytes + b->offset, &parts.crank, sizeof parts.crank);
    check_refused(&parts, kind, &def, BAUM_ERR_ARGUMENT,
                  "body_a and body_b are both body 1 \"crank\"");
    memcpy(def.bytes + fields.list[2].offset, &BAUM_GROUND, sizeof BAUM_GROUND);
    memcpy(def.bytes + b->offset, &BAUM_GROUND, sizeof BAUM_GROUND);
    check_refused(&parts, kind, &def, BAUM_ERR_ARGUMENT, "body_a and body_b are both ground");
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void ids_stay_valid_in_copies_and_only_there(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  every_element others = every_element_make(NULL);
  baum_mechanism *copy = NULL;
  assert_int_equal(baum_mechanism_copy(parts.mechanism, &copy), BAUM_OK);
  assert_string_equal(baum_mechanism_body_name(copy, parts.crank), "crank");
  assert_string_equal(baum_mechanism_joint_name(copy, parts.rod), "rod");
  assert_null(baum_mechanism_body_name(copy, others.crank));
  assert_null(baum_mechanism_joint_name(others.mechanism, parts.rod));
  ASSERT_SAYS(baum_mechanism_rows(parts.mechanism, others.rod, NULL, NULL), BAUM_ERR_ARGUMENT,
              "baum_mechanism_rows: joint is not of this mechanism");
  ASSERT_SAYS(baum_mechanism_columns(parts.mechanism, others.crank, NULL, NULL), BAUM_ERR_ARGUMENT,
              "baum_mechanism_columns: body is not of this mechanism");
  ASSERT_SAYS(baum_mechanism_columns(parts.mechanism, BAUM_GROUND, NULL, NULL), BAUM_ERR_ARGUMENT,
              "ground has no coordinates");
  baum_mechanism_destroy(parts.mechanism);
  assert_string_equal(baum_mechanism_body_name(copy, parts.bob), "bob");
  baum_mechanism_destroy(copy);
  baum_mechanism_destroy(others.mechanism);
}

/* ---- bodies and sizes that must stay the same ---- */

static void set_refuses_other_bodies_and_sizes(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  baum_planar_revolute_def pin;
  any_id id = every_element_id(&parts, &element_kinds[3]);
  baum_joint_id joint = {id.index1, id.tag};
  assert_int_equal(baum_mechanism_get_planar_revolute(parts.mechanism, joint, &pin, sizeof pin),
                   BAUM_OK);
  pin.body_b = parts.tool;
  ASSERT_SAYS(baum_mechanism_set_planar_revolute(parts.mechanism, joint, &pin), BAUM_ERR_ARGUMENT,
              "\"pin\": its bodies cannot change");
  baum_coordinates_def masses;
  assert_int_equal(
    baum_mechanism_get_coordinates(parts.mechanism, parts.masses, &masses, sizeof masses), BAUM_OK);
  masses.size = 1;
  ASSERT_SAYS(baum_mechanism_set_coordinates(parts.mechanism, parts.masses, &masses),
              BAUM_ERR_ARGUMENT, "\"masses\": its size is 2 and cannot change");
  check_size(parts.mechanism, EVERY_NV, EVERY_NC);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- frozen ---- */

static void nothing_is_added_or_set_after_freeze(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    char message[PARTS_SIZE];
    any_def def;
    const element_kind *kind = &element_kinds[k];
    kind->good(&parts, &def);
    (void)snprintf(message, sizeof message, "%s: the mechanism is frozen; change a copy of it",
                   kind->title);
    check_refused(&parts, kind, &def, BAUM_ERR_STATE, message);
  }
  ASSERT_SAYS(baum_mechanism_set_gravity(parts.mechanism, 0.0, 0.0, 0.0), BAUM_ERR_STATE,
              "baum_mechanism_set_gravity: the mechanism is frozen");
  ASSERT_SAYS(baum_mechanism_set_characteristic_length(parts.mechanism, 1.0), BAUM_ERR_STATE,
              "baum_mechanism_set_characteristic_length: the mechanism is frozen");
  assert_int_equal(baum_mechanism_freeze(parts.mechanism), BAUM_OK);
  check_size(parts.mechanism, EVERY_NV, EVERY_NC);
  baum_mechanism_destroy(parts.mechanism);
}

static void gravity_and_scale_out_of_range_are_refused(void **state)
{
  (void)state;
  double gravity[3];
  baum_mechanism *mechanism = create_mechanism();
  ASSERT_SAYS(baum_mechanism_set_gravity(mechanism, 0.0, (double)NAN, 0.0), BAUM_ERR_ARGUMENT,
              "gravity is (0, nan, 0) m/s^2, must be finite");
  assert_int_equal(baum_mechanism_get_gravity(mechanism, gravity), BAUM_OK);
  assert_true(gravity[1] == -9.81);
  const double bad[] = {0.0, -1.0, (double)NAN, (double)INFINITY};
  for (int k = 0; k < 4; k++) {
    ASSERT_SAYS(baum_mechanism_set_characteristic_length(mechanism, bad[k]), BAUM_ERR_ARGUMENT,
                "characteristic length is | m, must be finite and > 0");
  }
  ASSERT_SAYS(baum_mechanism_freeze(mechanism), BAUM_ERR_STATE, "the mechanism has no body");
  assert_false(baum_mechanism_is_frozen(mechanism));
  baum_mechanism_destroy(mechanism);
}

/* Only freeze can find these errors, because they involve the definition of another element. */
static void freezing_refuses_points_that_do_not_fit(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_particle_def bead = baum_planar_particle_def_default();
  baum_body_id id;
  bead.name = "bead";
  assert_int_equal(baum_mechanism_add_planar_particle(mechanism, &bead, &id), BAUM_OK);
  (void)add_planar_pin(mechanism, "pin", BAUM_GROUND, id, 1.0, 0.0);
  ASSERT_SAYS(baum_mechanism_freeze(mechanism), BAUM_ERR_ARGUMENT,
              "joint 1 \"pin\"|point is (1, 0) m|\"bead\"|(0, 0) m");
  assert_false(baum_mechanism_is_frozen(mechanism));
  bead.position[0] = 1.0;
  assert_int_equal(baum_mechanism_set_planar_particle(mechanism, id, &bead), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  baum_mechanism_destroy(mechanism);
}

/* When the slot was added, the particle was at `point`. Freeze compares `point` with the present
 * position of the particle. */
static void freezing_refuses_a_slot_whose_particle_was_moved_off_it(void **state)
{
  (void)state;
  baum_joint_id id;
  int32_t nc = -1;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_particle_def bead = baum_planar_particle_def_default();
  baum_planar_pin_in_slot_def slot = baum_planar_pin_in_slot_def_default();
  bead.name = "bead";
  assert_int_equal(baum_mechanism_add_planar_particle(mechanism, &bead, &slot.body_b), BAUM_OK);
  slot.name = "slot";
  slot.body_a = BAUM_GROUND;
  slot.point[0] = 0.0;
  slot.point[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_pin_in_slot(mechanism, &slot, &id), BAUM_OK);
  bead.position[0] = 0.5; /* along the slot, so that the constraint would still be satisfied */
  assert_int_equal(baum_mechanism_set_planar_particle(mechanism, slot.body_b, &bead), BAUM_OK);
  for (int again = 0; again < 2; again++) {
    ASSERT_SAYS(baum_mechanism_freeze(mechanism), BAUM_ERR_ARGUMENT,
                "joint 1 \"slot\": point is (0, 0) m, must be at the particle body 1 \"bead\", "
                "which is at (0.5, 0) m");
    assert_false(baum_mechanism_is_frozen(mechanism));
    assert_int_equal(baum_mechanism_sizes(mechanism, NULL, NULL, &nc), BAUM_ERR_STATE);
    assert_int_equal(nc, -1);
  }
  slot.point[0] = 0.5;
  assert_int_equal(baum_mechanism_set_planar_pin_in_slot(mechanism, id, &slot), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  assert_int_equal(baum_mechanism_sizes(mechanism, NULL, NULL, &nc), BAUM_OK);
  assert_int_equal(nc, 1);
  baum_mechanism_destroy(mechanism);
}

/* ---- more numbers than an int can count ---- */

enum { HUGE_BODIES = 22, HUGE_SIZE = 10000 };

static baum_mechanism *make_huge(int count, baum_body_id *ids)
{
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = HUGE_SIZE;
  def.mass = user_never_asked;
  def.force = user_never_pushed;
  baum_mechanism *mechanism = create_mechanism();
  for (int k = 0; k < count; k++) {
    assert_int_equal(baum_mechanism_add_coordinates(mechanism, &def, &ids[k]), BAUM_OK);
  }
  return mechanism;
}

static void check_too_large(baum_mechanism *mechanism, const char *element)
{
  char message[120];
  (void)snprintf(message, sizeof message,
                 "%s|with this element the mechanism has more than 2147483647 matrix entries",
                 element);
  ASSERT_SAYS(baum_mechanism_freeze(mechanism), BAUM_ERR_ARGUMENT, message);
  assert_false(baum_mechanism_is_frozen(mechanism));
  baum_mechanism_destroy(mechanism);
}

/* Each body has a mass matrix with 10000^2 = 1e8 entries. An int32_t can only count the entries of
 * 21 such matrices. */
static void freezing_refuses_matrices_too_large_to_count(void **state)
{
  (void)state;
  baum_body_id ids[HUGE_BODIES];
  baum_mechanism *mechanism = make_huge(HUGE_BODIES, ids);
  check_too_large(mechanism, "body 22 ");

  mechanism = make_huge(1, ids);
  baum_user_constraint_def rows = baum_user_constraint_def_default();
  rows.bodies = ids;
  rows.body_count = 1;
  rows.row_count = HUGE_SIZE;
  rows.phi = user_never_asked;
  for (int k = 0; k < HUGE_BODIES; k++) {
    assert_int_equal(baum_mechanism_add_user_constraint(mechanism, &rows, NULL), BAUM_OK);
  }
  check_too_large(mechanism, "joint 22 ");

  /* The force couples all three bodies. Its derivatives have 3e4 x 3e4 = 9e8 entries, and three
   * times as many indices. */
  mechanism = make_huge(3, ids);
  baum_user_force_def force = baum_user_force_def_default();
  force.bodies = ids;
  force.body_count = 3;
  force.force = user_never_pushed;
  assert_int_equal(baum_mechanism_add_user_force(mechanism, &force, NULL), BAUM_OK);
  check_too_large(mechanism, "force 1 ");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_wrong_struct_size_is_refused),
    cmocka_unit_test(names_that_break_messages_are_refused),
    cmocka_unit_test(null_is_refused_by_add_get_and_set),
    cmocka_unit_test(numbers_that_are_not_finite_are_refused),
    cmocka_unit_test(masses_inertias_and_lengths_out_of_range_are_refused),
    cmocka_unit_test(none_and_foreign_ids_in_definitions_are_refused),
    cmocka_unit_test(none_foreign_and_ground_ids_have_no_definition),
    cmocka_unit_test(ids_of_another_kind_of_element_are_refused),
    cmocka_unit_test(a_joint_of_a_body_to_itself_is_refused),
    cmocka_unit_test(ids_stay_valid_in_copies_and_only_there),
    cmocka_unit_test(set_refuses_other_bodies_and_sizes),
    cmocka_unit_test(nothing_is_added_or_set_after_freeze),
    cmocka_unit_test(gravity_and_scale_out_of_range_are_refused),
    cmocka_unit_test(freezing_refuses_points_that_do_not_fit),
    cmocka_unit_test(freezing_refuses_a_slot_whose_particle_was_moved_off_it),
    cmocka_unit_test(freezing_refuses_matrices_too_large_to_count),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
