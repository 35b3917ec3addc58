/* SPDX-License-Identifier: BSD-3-Clause */
#include "planar_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "construct.h"

static baum_body_id add_body(baum_mechanism *mechanism, const char *name, double x, double y,
                             double angle)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = name;
  def.mass = 2.0;
  def.inertia = 0.3;
  def.position[0] = x;
  def.position[1] = y;
  def.angle = angle;
  baum_body_id id;
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &def, &id), BAUM_OK);
  return id;
}

static baum_body_id add_particle(baum_mechanism *mechanism, const char *name, double x, double y)
{
  baum_planar_particle_def def = baum_planar_particle_def_default();
  def.name = name;
  def.mass = 0.7;
  def.position[0] = x;
  def.position[1] = y;
  baum_body_id id;
  assert_int_equal(baum_mechanism_add_planar_particle(mechanism, &def, &id), BAUM_OK);
  return id;
}

planar_scene planar_scene_make(void)
{
  planar_scene scene;
  scene.mechanism = create_mechanism();
  scene.link = add_body(scene.mechanism, "link", 1.0, 0.5, 0.4);
  scene.ball = add_particle(scene.mechanism, "ball", -0.6, 0.8);
  scene.crank = add_body(scene.mechanism, "crank", -0.3, 1.2, -1.1);
  scene.bead = add_particle(scene.mechanism, "bead", 0.2, -0.9);
  return scene;
}

static bool same(baum_body_id a, baum_body_id b)
{
  return a.index1 == b.index1;
}

void planar_scene_arm(const planar_scene *scene, baum_body_id body, double arm[2])
{
  arm[0] = 0.0;
  arm[1] = 0.0;
  if (same(body, scene->link)) {
    arm[0] = 0.3;
    arm[1] = -0.2;
  } else if (same(body, scene->crank)) {
    arm[0] = -0.45;
    arm[1] = 0.15;
  } else if (same(body, BAUM_GROUND)) {
    arm[0] = 0.5;
    arm[1] = 0.7;
  }
}

static void check_pair(planar_add_fn *add, int which, planar_check_fn *check)
{
  planar_scene scene = planar_scene_make();
  const baum_body_id pairs[][2] = {
    {scene.link, scene.crank}, {scene.crank, scene.link}, {BAUM_GROUND, scene.crank},
    {scene.link, BAUM_GROUND}, {scene.ball, scene.crank}, {scene.link, scene.bead},
    {BAUM_GROUND, scene.ball}, {scene.bead, BAUM_GROUND}, {scene.ball, scene.bead},
  };
  add(&scene, pairs[which][0], pairs[which][1]);
  /* The element is added a second time, so that not all indices and offsets in arrays are zero. */
  add(&scene, scene.crank, BAUM_GROUND);
  test_point p;
  test_point_open(&p, scene.mechanism);
  uint64_t seed = 5;
  for (int k = 0; k < 20; k++) {
    test_point_random(&p, &seed);
    check(&p);
  }
  test_point_close(&p);
}

void for_each_planar_pair(planar_add_fn *add, bool particles, planar_check_fn *check)
{
  int count = particles ? 9 : 4;
  for (int which = 0; which < count; which++) {
    check_pair(add, which, check);
  }
}
