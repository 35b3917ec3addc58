/* SPDX-License-Identifier: BSD-3-Clause */
/* Random planar mechanisms for bench_doubts, described only by numbers. The mechanism of the
 * library and the equations of the reference are both built from these numbers. Other random
 * mechanisms in the tests share no code with these. planar.h explains the conventions for
 * coordinates, axes and rows. */
#ifndef BAUM_JUDGE_SCENE_H
#define BAUM_JUDGE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

enum { JUDGE_BODIES = 10, JUDGE_JOINTS = 20, JUDGE_SPRINGS = 8, JUDGE_N = 30, JUDGE_ROWS = 30 };
enum { JUDGE_GROUND = -1 };

typedef struct judge_body {
  bool particle;
  double mass;
  double inertia;
  double length; /* [m] length of the rod, which is along its x axis; 0 for a particle */
  double pose[3];
  int first; /* index of its first coordinate */
} judge_body;

typedef enum judge_kind {
  JUDGE_REVOLUTE,
  JUDGE_SLOT,
  JUDGE_TRANSLATIONAL,
  JUDGE_DISTANCE,
  /* Prescribes the angle of the revolute joint `of`, and has the bodies and points of this
   * joint. */
  JUDGE_DRIVE_ANGLE,
  JUDGE_DRIVE_SLIDE /* prescribes the displacement of a pin in its slot in the same way */
} judge_kind;

typedef struct judge_joint {
  judge_kind kind;
  int a;
  int b;
  double point_a[2];
  double point_b[2];
  double axis[2]; /* unit vector in the axes of body a */
  double kept;    /* [m or rad] the length or angle that the joint prescribes */
  int of;
  double law[5]; /* s = law[0] + law[1] t + law[2] sin(law[3] t + law[4]) */
} judge_joint;

typedef struct judge_spring {
  bool torsion;
  int a;
  int b;
  double point_a[2];
  double point_b[2];
  double stiffness;
  double damping;
  double free; /* [m or rad] free length or angle */
} judge_spring;

typedef struct judge_scene {
  uint64_t seed;
  const char *family;
  judge_body bodies[JUDGE_BODIES];
  judge_joint joints[JUDGE_JOINTS];
  judge_spring springs[JUDGE_SPRINGS];
  int body_count;
  int joint_count;
  int spring_count;
  int load_body; /* JUDGE_GROUND if there is no load */
  double load[3];
  double gravity;
  int n;    /* number of coordinates */
  int rows; /* number of constraint rows */
  bool conservative;
  bool driven;
  double mass_ratio;
  double q[JUDGE_N]; /* design configuration */
  double v[JUDGE_N]; /* velocities that are consistent with the constraints */
  double end;        /* [s] */
} judge_scene;

/** Generates the scene of a seed. Returns false if no attempt has a consistent start. */
bool judge_scene_draw(judge_scene *s, uint64_t seed);

/** Evaluates the law of a driver. s receives its value, rate and acceleration. */
void judge_law(const judge_joint *joint, double t, double s[3]);

/* A random number generator, xorshift64*. */
typedef struct judge_dice {
  uint64_t state;
} judge_dice;

double judge_between(judge_dice *d, double from, double to);
int judge_below(judge_dice *d, int count);
bool judge_chance(judge_dice *d, double share);

#endif
