/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests scenes, which are mechanisms written as text. Mechanisms of every kind must be the same,
 * bit for bit, after they were written and read. Wrong texts must be refused with a message that
 * names the line. If allocations fail, no memory may be lost. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>
#include <baum/catalog.h>

#include "check.h"
#include "construct.h"
#include "every_element.h"
#include "failing_heap.h"
#include "mechanism/family.h"
#include "message.h"
#include "random_mechanism.h"
#include "random_spatial.h"

enum { HOOKS = 4096 };

/* How many random mechanisms of each kind are tested; the first argument of the program. */
static long random_count = 200;

/* ---- hooks for everything that a mechanism uses ---- */

typedef struct all_hooks {
  int count;
  baum_hook hooks[HOOKS];
  char names[HOOKS][16];
} all_hooks;

static void add_hook(all_hooks *all, baum_hook hook)
{
  for (int k = 0; k < all->count; k++) {
    if (all->hooks[k].function == hook.function && all->hooks[k].user == hook.user) {
      return;
    }
  }
  assert_true(all->count < HOOKS);
  (void)snprintf(all->names[all->count], sizeof *all->names, "hook %d", all->count);
  hook.name = all->names[all->count];
  all->hooks[all->count++] = hook;
}

static void add_hook_of_field(all_hooks *all, const baum_i_def_field *f, const void *def)
{
  baum_hook hook = {0};
  if (f->kind == BAUM_I_FIELD_USER) {
    memcpy(&hook.user, baum_i_field_at(f, def), sizeof hook.user);
  } else if (f->kind >= BAUM_I_FIELD_FUNCTION) {
    memcpy(&hook.function, baum_i_field_at(f, def), sizeof hook.function);
  }
  if (hook.user || hook.function) {
    add_hook(all, hook);
  }
}

static all_hooks *hooks_of(const baum_mechanism *m)
{
  all_hooks *all = calloc(1, sizeof *all);
  assert_non_null(all);
  for (int i = 0; i < BAUM_I_FAMILIES; i++) {
    for (int k = 0; k < baum_i_family_count(baum_i_families[i], m); k++) {
      const baum_i_element *element = baum_i_families[i]->at(m, k);
      for (const baum_i_def_field *f = element->definition->fields; f->name; f++) {
        add_hook_of_field(all, f, element->def);
      }
    }
  }
  return all;
}

/* ---- round trips ---- */

static char *print(const baum_mechanism *m, const all_hooks *all)
{
  size_t size = 0;
  check(baum_mechanism_print(m, all->hooks, all->count, NULL, 0, &size));
  char *text = malloc(size + 1);
  assert_non_null(text);
  check(baum_mechanism_print(m, all->hooks, all->count, text, size + 1, NULL));
  assert_int_equal(strlen(text), size);
  return text;
}

static void must_be_equal(const baum_mechanism *a, const baum_mechanism *b)
{
  bool equal = false;
  check(baum_mechanism_compare(a, b, &equal));
  assert_true(equal);
}

/* Writes a mechanism, reads the text, and compares the result with the mechanism. The result is
 * frozen. */
static baum_mechanism *round_trip(const baum_mechanism *m)
{
  all_hooks *all = hooks_of(m);
  char *text = print(m, all);
  baum_mechanism *back = NULL;
  check(baum_mechanism_parse(text, strlen(text), all->hooks, all->count, &back));
  char *again = print(back, all);
  assert_string_equal(text, again);
  must_be_equal(m, back);
  check(baum_mechanism_freeze(back));
  free(text);
  free(again);
  free(all);
  return back;
}

/* Runs both mechanisms and compares every bit of their motions. */
static void must_move_alike(const baum_mechanism *a, const baum_mechanism *b, double t0, double dt)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = dt / 4.0;
  o.start_time = t0;
  baum_simulation *runs[2] = {NULL, NULL};
  baum_status created = baum_simulation_create(a, &o, &runs[0]);
  assert_int_equal(baum_simulation_create(b, &o, &runs[1]), created);
  if (created >= BAUM_OK) {
    baum_status moved = baum_simulation_advance_to(runs[0], t0 + dt);
    assert_int_equal(baum_simulation_advance_to(runs[1], t0 + dt), moved);
    int32_t nq = 0;
    check(baum_mechanism_sizes(a, &nq, NULL, NULL));
    assert_memory_equal(baum_simulation_q(runs[0]), baum_simulation_q(runs[1]),
                        (size_t)nq * sizeof(double));
  }
  baum_simulation_destroy(runs[0]);
  baum_simulation_destroy(runs[1]);
}

static void every_kind_of_element_is_the_same_after_writing_and_reading(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_mechanism *back = round_trip(parts.mechanism);
  must_move_alike(parts.mechanism, back, 0.0, 0.01);
  baum_mechanism_destroy(back);
  baum_mechanism_destroy(parts.mechanism);
}

static void every_catalogue_mechanism_is_the_same_after_writing_and_reading(void **state)
{
  (void)state;
  for (int k = 0; k < baum_catalog_count(); k++) {
    baum_catalog_entry entry;
    check(baum_catalog_entry_at(k, &entry, sizeof entry));
    baum_catalog_choice choice = {.name = entry.name};
    baum_mechanism *m = NULL;
    check(baum_catalog_build(&choice, &m));
    baum_mechanism *back = round_trip(m);
    must_move_alike(m, back, entry.start_time, 1e-3 * (entry.end_time - entry.start_time));
    baum_mechanism_destroy(back);
    baum_mechanism_destroy(m);
  }
}

static void random_mechanisms_are_the_same_after_writing_and_reading(void **state)
{
  (void)state;
  const random_kind kind = {.bodies = 12,
                            .joints = 14,
                            .particles = 20,
                            .coordinates = 20,
                            .pins = 50,
                            .span = 10.0,
                            .loads = 3,
                            .springs = 3,
                            .velocity_rows = 3};
  for (uint64_t seed = 0; seed < (uint64_t)random_count; seed++) {
    random_mechanism planar;
    random_mechanism_make(&planar, seed, &kind);
    baum_mechanism *back = round_trip(planar.mechanism);
    must_move_alike(planar.mechanism, back, 0.0, 1e-3);
    baum_mechanism_destroy(back);
    random_mechanism_destroy(&planar);
    random_spatial spatial;
    random_spatial_make(&spatial, seed, seed % 2 == 1);
    back = round_trip(spatial.mechanism);
    must_move_alike(spatial.mechanism, back, spatial.start, 1e-3);
    baum_mechanism_destroy(back);
    random_spatial_destroy(&spatial);
  }
}

/* ---- special cases ---- */

static baum_body_id add_body(baum_mechanism *m, const char *name)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id = {0};
  def.name = name;
  def.mass = 0.1 + 1e-17;
  def.inertia = 1e-300;
  check(baum_mechanism_add_planar_body(m, &def, &id));
  return id;
}

static void add_pin(baum_mechanism *m, baum_body_id a, baum_body_id b)
{
  (void)add_planar_pin(m, NULL, a, b, -0.0, -0.0);
}

/* Makes bodies with the same name, joints with the same name, and one body that is called
 * ground. */
static baum_mechanism *make_unclear(void)
{
  baum_mechanism *m = create_mechanism();
  baum_body_id a = add_body(m, "a \"<\\");
  baum_body_id b = add_body(m, "twin");
  baum_body_id c = add_body(m, "twin");
  baum_body_id d = add_body(m, "ground");
  baum_body_id e = add_body(m, "\xc3\xa9");
  add_pin(m, BAUM_GROUND, a);
  add_pin(m, a, b);
  add_pin(m, a, c);
  add_pin(m, d, BAUM_GROUND);
  add_pin(m, d, e);
  for (int k = 0; k < 2; k++) {
    baum_planar_revolute_def pin = baum_planar_revolute_def_default();
    baum_driver_def driver = baum_driver_def_default();
    pin.name = "twin";
    pin.body_a = a;
    pin.body_b = k == 0 ? b : c;
    pin.point[0] = pin.point[1] = 0.0;
    check(baum_mechanism_add_planar_revolute(m, &pin, &driver.joint));
    check(baum_mechanism_add_driver(m, &driver, NULL));
  }
  check(baum_mechanism_add_input(m, "twin", 2.0, NULL));
  check(baum_mechanism_set_gravity(m, 0.1, -0.0, 1e-310));
  check(baum_mechanism_set_characteristic_length(m, 3.0));
  check(baum_mechanism_add_break_times(m, (double[]){0.1, 1.0 / 3.0}, 2));
  return m;
}

static void unclear_names_are_not_confused(void **state)
{
  (void)state;
  baum_mechanism *m = make_unclear();
  const all_hooks none = {0};
  char *text = print(m, &none);
  baum_mechanism *back = NULL;
  check(baum_mechanism_parse(text, strlen(text), NULL, 0, &back));
  must_be_equal(m, back);
  baum_planar_revolute_def was, is;
  for (int k = 0; k < 5; k++) {
    check(baum_mechanism_get_planar_revolute(m, baum_mechanism_joint_at(m, k), &was, sizeof was));
    check(
      baum_mechanism_get_planar_revolute(back, baum_mechanism_joint_at(back, k), &is, sizeof is));
    assert_int_equal(was.body_a.index1, is.body_a.index1);
    assert_int_equal(was.body_b.index1, is.body_b.index1);
    assert_memory_equal(was.point, is.point, sizeof is.point);
  }
  free(text);
  baum_mechanism_destroy(m);
  baum_mechanism_destroy(back);
}

static void outlines_are_the_same_after_writing_and_reading(void **state)
{
  (void)state;
  static const double points[3][3] = {{0, 0, 0.1}, {1, 0, 0.1}, {0, 1, 0.1}};
  static const int32_t triangles[2][3] = {{0, 1, 2}, {2, 1, 0}};
  baum_mechanism *m = make_unclear();
  baum_outline all[BAUM_OUTLINE_MESH + 1];
  for (int form = BAUM_OUTLINE_POLYGON; form <= BAUM_OUTLINE_MESH; form++) {
    all[form] = baum_outline_default();
    all[form].form = (baum_outline_form)form;
    all[form].points = points[0];
    all[form].point_count = 3;
    all[form].triangles = triangles[0];
    all[form].triangle_count = 2;
    all[form].radius = 0.1;
    all[form].size[0] = all[form].size[1] = all[form].end[1] = 1.0 / 3.0;
    all[form].color = form == BAUM_OUTLINE_BOX ? "#102030" : NULL;
  }
  check(baum_mechanism_set_outlines(m, BAUM_GROUND, all, BAUM_OUTLINE_MESH + 1));
  check(baum_mechanism_set_outlines(m, baum_mechanism_body_at(m, 1), all + 3, 3));
  const all_hooks none = {0};
  char *text = print(m, &none);
  baum_mechanism *back = NULL;
  check(baum_mechanism_parse(text, strlen(text), NULL, 0, &back));
  must_be_equal(m, back);
  assert_int_equal(baum_mechanism_outline_count(back, BAUM_GROUND), BAUM_OUTLINE_MESH + 1);
  assert_int_equal(baum_mechanism_outline_count(back, baum_mechanism_body_at(back, 1)), 3);
  baum_mechanism_destroy(back);
  free(text);
  baum_mechanism_destroy(m);
}

static void a_change_of_any_part_is_detected(void **state)
{
  (void)state;
  baum_mechanism *m = make_unclear();
  bool equal = true;
  for (int change = 0; change < 4; change++) {
    baum_mechanism *other = NULL;
    check(baum_mechanism_copy(m, &other));
    must_be_equal(m, other);
    baum_planar_body_def def;
    baum_body_id last = baum_mechanism_body_at(other, 4);
    check(baum_mechanism_get_planar_body(other, last, &def, sizeof def));
    def.mass = nextafter(def.mass, 1.0);
    switch (change) {
    case 0: check(baum_mechanism_set_planar_body(other, last, &def)); break;
    case 1: check(baum_mechanism_set_gravity(other, 0.1, 0.0, 1e-310)); break;
    case 2: check(baum_mechanism_add_input(other, "more", 0.0, NULL)); break;
    default: check(baum_mechanism_add_break_times(other, (double[]){0.2}, 1)); break;
    }
    check(baum_mechanism_compare(m, other, &equal));
    assert_false(equal);
    baum_mechanism_destroy(other);
  }
  baum_mechanism_destroy(m);
}

static void functions_without_hooks_are_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  ASSERT_SAYS(baum_mechanism_print(parts.mechanism, NULL, 0, NULL, 0, NULL), BAUM_ERR_ARGUMENT,
              "mass is a function|give a hook");
  all_hooks *all = hooks_of(parts.mechanism);
  char *text = print(parts.mechanism, all);
  baum_mechanism *back = NULL;
  ASSERT_SAYS(baum_mechanism_parse(text, strlen(text), all->hooks, 0, &back), BAUM_ERR_ARGUMENT,
              "scene: line |is the function \"hook 0\", for which there is no hook");
  assert_null(back);
  free(text);
  free(all);
  baum_mechanism_destroy(parts.mechanism);
}

static void names_that_are_not_utf8_are_refused(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  ASSERT_SAYS(baum_mechanism_add_input(m, "\xe9", 0.0, NULL), BAUM_ERR_ARGUMENT,
              "input 1: name is not UTF-8");
  baum_mechanism_destroy(m);
}

static void files_hold_scenes(void **state)
{
  (void)state;
  baum_mechanism *m = make_unclear();
  baum_mechanism *back = NULL;
  check(baum_mechanism_write(m, NULL, 0, "test_scene.json"));
  check(baum_mechanism_read("test_scene.json", NULL, 0, &back));
  must_be_equal(m, back);
  baum_mechanism_destroy(back);
  (void)remove("test_scene.json");
  ASSERT_SAYS(baum_mechanism_read("test_scene.json", NULL, 0, &back), BAUM_ERR_FILE,
              "test_scene.json: cannot be read: No such file");
  ASSERT_SAYS(baum_mechanism_read(".", NULL, 0, &back), BAUM_ERR_FILE, "cannot be read");
  assert_null(back);
  baum_mechanism_destroy(m);
}

/* ---- wrong texts ---- */

#define HEAD "{\"baum_scene\": 1, "
#define BODY "{\"kind\": \"planar_body\", \"name\": \"b\", \"mass\": 1, \"inertia\": 1}"
#define PIN_A                                                                                    \
  "{\"kind\": \"planar_revolute\", \"name\": \"A\", \"body_a\": \"ground\", \"body_b\": \"b\", " \
  "\"point\": [0, 0]}"
#define DRIVER_A "{\"kind\": \"driver\", \"joint\": \"A\"}"

static const char *const WRONG[][2] = {
  {"", "line 1: this is not JSON"},
  {"{\"baum_scene\": 1}}", "there is more text after the end"},
  {"[1]", "not a scene"},
  {"{}", "\"baum_scene\" is missing"},
  {"{\"baum_scene\": 2}", "version 2, but this library reads 1"},
  {"{\"baum_scene\": 1.5}", "\"baum_scene\" is a number, must be a whole number"},
  {"{\"baum_scene\": 1,\n\n \"baum_scene\": 1}", "line 3: the key \"baum_scene\" appears twice"},
  {HEAD "\"gravitation\": 1}", "no field \"gravitation\""},
  {HEAD "\"gravity\": [0, 1]}", "\"gravity\" has 2 entries, must have 3"},
  {HEAD "\"gravity\": [0, 1, \"2\"]}", "must be a list of numbers"},
  {HEAD "\"gravity\": [0, 1, null]}", "gravity is (0, 1, nan) m/s^2"},
  {HEAD "\"gravity\": [0, 1, 1e999]}", "a number is too large"},
  {HEAD "\"gravity\": [0, 1, 01]}", "not JSON"},
  {HEAD "\"gravity\": [0, 1, .5]}", "not JSON"},
  {HEAD "\"gravity\": [0, 1, 1e]}", "not JSON"},
  {HEAD "\"gravity\": [0, 1, -]}", "not JSON"},
  {HEAD "\"gravity\": [0, 1, 1.00000000000000000000000000000000000000000000000000000]}",
   "more than 40 characters"},
  {HEAD "\"gravity\": [0, 1, 2,]}", "not JSON"},
  {HEAD "\"units\": 3}", "\"units\" is a number, must be a text"},
  {HEAD "\"characteristic_length\": -1}", "-1 m"},
  {HEAD "\"break_times\": 3}", "\"break_times\" is a number, must be a list"},
  {HEAD "\"inputs\": [{\"name\": \"a\"}]}", "an input must be an object"},
  {HEAD "\"inputs\": [{\"name\": 1, \"initial\": 0}]}", "\"name\" is a number, must be a text"},
  {HEAD "\"bodies\": {}}", "\"bodies\" is an object, must be a list"},
  {HEAD "\"bodies\": [1]}", "a body must be an object with the field \"kind\""},
  {HEAD "\"bodies\": [{\"kind\": \"driver\"}]}", "no body of the kind \"driver\""},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"masss\": 1}]}",
   "no field \"masss\"; did you mean \"mass\"?"},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"colour\": 1}]}", "no field \"colour\""},
  {HEAD "\"bodies\": [\n{\"kind\": \"planar_body\", \"name\": \"b\", \"mass\": 0}]}",
   "line 2: body 1 \"b\": mass is 0 kg"},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"mass\": null}]}",
   "line 1: body 1: \"mass\" is null, must be a number"},
  {"\xef\xbb\xbf{}", "this is not a scene: the key"},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"name\": \"\\u0007\"}]}", "name"},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"name\": \"\\ud800\"}]}", "backslash"},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"name\": \"\\x\"}]}", "backslash"},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"name\": \"", "does not end"},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"held\": 1}]}", "must be true or false"},
  {HEAD "\"bodies\": [{\"kind\": \"coordinates\", \"size\": 2, \"q\": [1]}]}",
   "\"q\" has 1 entries, must have 2"},
  {HEAD "\"bodies\": [" BODY "], \"joints\": [{\"kind\": \"planar_revolute\", \"body_b\": \"c\"}]}",
   "there is no body \"c\""},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"name\": \"crank\"}], \"joints\": [{\"kind\": "
        "\"planar_revolute\", \"body_b\": \"cranck\"}]}",
   "no body \"cranck\"; did you mean \"crank\"?"},
  {HEAD "\"bodies\": [" BODY "], \"joints\": [{\"kind\": \"revolute\"}]}",
   "no joint of the kind \"revolute\"; did you mean \"planar_revolute\"?"},
  {HEAD "\"joint\": []}", "a scene has no field \"joint\"; did you mean \"joints\"?"},
  {HEAD "\"bodys\": []}", "a scene has no field \"bodys\"; did you mean \"bodies\"?"},
  {HEAD "\"bodies\": [" BODY ", " BODY
        "], \"joints\": [{\"kind\": \"planar_revolute\", \"body_b\": \"b\"}]}",
   "several bodies \"b\""},
  {HEAD "\"bodies\": [" BODY "], \"joints\": [{\"kind\": \"planar_revolute\", \"body_b\": 1}]}",
   "body 1 does not exist"},
  {HEAD "\"bodies\": [" BODY "], \"joints\": [{\"kind\": \"planar_revolute\", \"body_b\": []}]}",
   "must be the name of a body"},
  {HEAD "\"joints\": [{\"kind\": \"driver\", \"joint\": \"A\"}]}",
   "no joint \"A\" before this element"},
  {HEAD "\"bodies\": [" BODY "], \"joints\": [" PIN_A ", " PIN_A ", " DRIVER_A "]}",
   "several joints \"A\"; give the number of the joint"},
  {HEAD "\"bodies\": [" BODY "], \"joints\": [" PIN_A ", " DRIVER_A ", " PIN_A "]}",
   "several joints \"A\""},
  {HEAD "\"joints\": [{\"kind\": \"driver\", \"joint\": 0}]}", "joint 0 does not exist"},
  {HEAD "\"joints\": [{\"kind\": \"driver\", \"coordinate\": \"angel\"}]}", "\"angel\""},
  {HEAD "\"bodies\": [{\"kind\": \"planar_body\", \"name\": \"b\", \"mass\": 1, \"inertia\": 1, "
        "\"outlines\": [{\"form\": \"cube\"}]}]}",
   "line 1: body 1 \"b\": there is no form \"cube\""},
  {HEAD "\"ground_outlines\": [{\"form\": \"circle\", \"radius\": 0}]}", "line 1: |radius is 0 m"},
  {HEAD "\"ground_outlines\": [{\"form\": \"circle\", \"radios\": 0}]}", "no field \"radios\""},
  {HEAD "\"ground_outlines\": [{\"points\": [[1, 2]]}]}", "2 entries, must have 3"},
  {HEAD "\"ground_outlines\": [{\"triangles\": [[1, 2, 0.5]]}]}", "a whole number"},
  {HEAD "\"ground_outlines\": [3]}", "an outline must be an object"},
  {HEAD "\"ground_outlines\": 3}", "must be a list"},
};

static void wrong_texts_are_refused(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof WRONG / sizeof *WRONG; k++) {
    baum_mechanism *m = NULL;
    const char *text = WRONG[k][0];
    ASSERT_SAYS(baum_mechanism_parse(text, strlen(text), NULL, 0, &m), BAUM_ERR_ARGUMENT,
                WRONG[k][1]);
    assert_null(m);
  }
  char keys[1000] = "{";
  for (int k = 0; k < 65; k++) {
    (void)snprintf(keys + strlen(keys), sizeof keys - strlen(keys), "\"k%d\": 0, ", k);
  }
  char deep[100];
  memset(deep, '[', sizeof deep);
  baum_mechanism *m = NULL;
  ASSERT_SAYS(baum_mechanism_parse(deep, sizeof deep, NULL, 0, &m), BAUM_ERR_ARGUMENT,
              "nested too deeply");
  ASSERT_SAYS(baum_mechanism_parse(keys, strlen(keys), NULL, 0, &m), BAUM_ERR_ARGUMENT,
              "too many keys");
}

static void every_part_of_a_scene_is_refused(void **state)
{
  (void)state;
  baum_mechanism *m = make_unclear();
  const all_hooks none = {0};
  char *text = print(m, &none);
  size_t size = strlen(text) - 1; /* without the last newline */
  for (size_t k = 0; k < size; k++) {
    baum_mechanism *back = NULL;
    assert_int_equal(baum_mechanism_parse(text, k, NULL, 0, &back), BAUM_ERR_ARGUMENT);
    assert_null(back);
  }
  free(text);
  baum_mechanism_destroy(m);
}

/* ---- calls ---- */

static void wrong_calls_are_refused(void **state)
{
  (void)state;
  baum_mechanism *m = make_unclear();
  baum_mechanism *back = NULL;
  bool equal = false;
  const baum_hook bad = {.name = "x"};
  ASSERT_SAYS(baum_mechanism_print(NULL, NULL, 0, NULL, 0, NULL), BAUM_ERR_ARGUMENT, "is NULL");
  ASSERT_SAYS(baum_mechanism_print(m, NULL, 1, NULL, 0, NULL), BAUM_ERR_ARGUMENT, "hooks are NULL");
  ASSERT_SAYS(baum_mechanism_print(m, NULL, -1, NULL, 0, NULL), BAUM_ERR_ARGUMENT, "negative");
  ASSERT_SAYS(baum_mechanism_print(m, &bad, 1, NULL, 0, NULL), BAUM_ERR_ARGUMENT, "hooks[0] must");
  ASSERT_SAYS(baum_mechanism_print(m, NULL, 0, NULL, 5, NULL), BAUM_ERR_ARGUMENT, "text is NULL");
  ASSERT_SAYS(baum_mechanism_write(m, NULL, 0, NULL), BAUM_ERR_ARGUMENT, "path is NULL");
  ASSERT_SAYS(baum_mechanism_write(NULL, NULL, 0, "x"), BAUM_ERR_ARGUMENT, "mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_parse(NULL, 0, NULL, 0, &back), BAUM_ERR_ARGUMENT, "text is NULL");
  ASSERT_SAYS(baum_mechanism_parse("", 0, NULL, 0, NULL), BAUM_ERR_ARGUMENT, "out is NULL");
  ASSERT_SAYS(baum_mechanism_parse("", 0, &bad, 1, &back), BAUM_ERR_ARGUMENT, "hooks[0] must");
  const baum_hook twins[2] = {{.name = "f", .function = (baum_hook_fn *)make_unclear},
                              {.name = "f", .function = (baum_hook_fn *)create_mechanism}};
  const char *law = HEAD "\"joints\": [{\"kind\": \"driver\", \"law\": \"f\"}]}";
  ASSERT_SAYS(baum_mechanism_parse(law, strlen(law), twins, 2, &back), BAUM_ERR_ARGUMENT,
              "the function \"f\", for which there are several hooks");
  ASSERT_SAYS(baum_mechanism_read("", NULL, 0, &back), BAUM_ERR_ARGUMENT, "path is NULL or empty");
  ASSERT_SAYS(baum_mechanism_read("x", NULL, 0, NULL), BAUM_ERR_ARGUMENT, "out is NULL");
  ASSERT_SAYS(baum_mechanism_read("x", &bad, 1, &back), BAUM_ERR_ARGUMENT, "hooks[0] must");
  ASSERT_SAYS(baum_mechanism_compare(m, NULL, &equal), BAUM_ERR_ARGUMENT, "mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_compare(m, m, NULL), BAUM_ERR_ARGUMENT, "equal is NULL");
  baum_mechanism_destroy(m);
}

/* ---- memory ---- */

static baum_status write_and_read(void *context)
{
  const all_hooks *all = context;
  const baum_mechanism *m = all->hooks[HOOKS - 1].user;
  static char text[1 << 16];
  baum_mechanism *back = NULL;
  bool equal = false;
  baum_status status = baum_mechanism_print(m, all->hooks, all->count, text, sizeof text, NULL);
  if (status == BAUM_OK) {
    status = baum_mechanism_parse(text, strlen(text), all->hooks, all->count, &back);
  }
  if (status == BAUM_OK) {
    status = baum_mechanism_compare(m, back, &equal);
    assert_true(status != BAUM_OK || equal);
  }
  baum_mechanism_destroy(back);
  return status;
}

static void failing_allocations_lose_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  every_element parts = every_element_make(NULL);
  all_hooks *all = hooks_of(parts.mechanism);
  all->hooks[HOOKS - 1].user = parts.mechanism;
  fail_every_allocation(write_and_read, all);
  free(all);
  baum_mechanism_destroy(parts.mechanism);
}

int main(int count, char **arguments)
{
  random_count = count > 1 ? strtol(arguments[1], NULL, 10) : random_count;
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_kind_of_element_is_the_same_after_writing_and_reading),
    cmocka_unit_test(every_catalogue_mechanism_is_the_same_after_writing_and_reading),
    cmocka_unit_test(random_mechanisms_are_the_same_after_writing_and_reading),
    cmocka_unit_test(unclear_names_are_not_confused),
    cmocka_unit_test(outlines_are_the_same_after_writing_and_reading),
    cmocka_unit_test(a_change_of_any_part_is_detected),
    cmocka_unit_test(functions_without_hooks_are_refused),
    cmocka_unit_test(names_that_are_not_utf8_are_refused),
    cmocka_unit_test(files_hold_scenes),
    cmocka_unit_test(wrong_texts_are_refused),
    cmocka_unit_test(every_part_of_a_scene_is_refused),
    cmocka_unit_test(wrong_calls_are_refused),
    cmocka_unit_test(failing_allocations_lose_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
