/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial mechanisms in quadruple precision by formulas of their own. A joint is Phi alone, from
 * the places and axes of its bodies; J v, gamma and coordinates are first and second derivatives
 * of Phi along motions, by truncated Taylor series. Rows may depend on each other: parallel axes
 * are z_a - z_b = 0, which is three rows of rank 2. Every body has six velocities here, r' in
 * ground axes and the angular velocity in body axes, of which a planar body or a particle uses
 * some.
 */
#ifndef BAUM_TEST_SPATIAL_ORACLE_H
#define BAUM_TEST_SPATIAL_ORACLE_H

#include <stdbool.h>

#include <baum/baum.h>

#include "quad_rows.h"

enum {
  ORACLE_BODIES = 9, /* with ground, which is 0 */
  ORACLE_JOINTS = 32,
  ORACLE_FORCES = 8,
  ORACLE_ROWS = 12, /* most of a joint */
  ORACLE_COLUMNS = 6 * ORACLE_BODIES
};

typedef enum oracle_kind {
  ORACLE_SPHERICAL,
  ORACLE_REVOLUTE,
  ORACLE_UNIVERSAL,
  ORACLE_CYLINDRICAL,
  ORACLE_PRISMATIC,
  ORACLE_PLANAR,
  ORACLE_FIXED,
  ORACLE_DISTANCE,
  ORACLE_ON_LINE,
  ORACLE_ON_PLANE,
  ORACLE_JOINT_KINDS,
  ORACLE_DRIVER
} oracle_kind;

typedef struct oracle_body {
  baum_body_id id;
  char kind; /* 'g'round, 's'patial body, spatial 'p'article, planar 'b'ody, planar particle 'o' */
  double mass;
  double inertia[6]; /* xx, yy, zz, xy, xz, yz */
  double q[7];       /* of the design configuration, as the library has it */
  int nq;
  int nv;
  int first_q;
  int first_v;
} oracle_body;

typedef struct oracle_joint {
  baum_joint_id id;
  oracle_kind kind;
  int a, b;        /* bodies */
  wide s[2][3];    /* points in body axes */
  wide axes[2][9]; /* x, y, z of the joint one after the other, in body axes */
  wide length;
  int of;          /* joint of a driver */
  double start[2]; /* [s] of the law of a driver, and its coordinate then */
} oracle_joint;

typedef struct oracle_force {
  bool is_spring;
  int a, b; /* a load acts on b */
  double s[2][3];
  double stiffness;
  double damping;
  wide free_length;
  double force[3];
  double moment[3];
  bool follows_body;
} oracle_force;

typedef struct spatial_oracle {
  double gravity[3];
  int body_count;
  int nq;
  int nv;
  oracle_body bodies[ORACLE_BODIES];
  int joint_count;
  oracle_joint joints[ORACLE_JOINTS];
  int force_count;
  oracle_force forces[ORACLE_FORCES];
} spatial_oracle;

/* One evaluation. */
typedef struct oracle_answer {
  double phi;  /* largest |Phi| and |Phi'| of all rows */
  double rate; /* of the largest velocity */
  wide a[ORACLE_COLUMNS];
  wide reaction[ORACLE_JOINTS][6]; /* force and moment on body_b about its point, ground axes */
  bool unique[ORACLE_JOINTS];
  quad_rows rows;
} oracle_answer;

/* Find the points and axes of a joint on its bodies, from a point on each and an axis, all in
 * ground axes of the design configuration. */
void oracle_place(const spatial_oracle *o, oracle_joint *joint, const wide point_a[3],
                  const wide point_b[3], const wide z[3]);

/* A point or an axis of the design configuration: s = A^T (point - r), and back. */
void oracle_to_body(const oracle_body *body, const wide point[3], wide s[3]);
void oracle_to_ground(const oracle_body *body, const wide s[3], wide point[3]);
void oracle_axis_to_body(const oracle_body *body, const wide axis[3], wide s[3]);
void oracle_axis_to_ground(const oracle_body *body, const wide s[3], wide axis[3]);

/* The sway of drivers, for the library: `user` points to an oracle_joint's start. */
int oracle_law(double t, double s[3], void *user);

/* The coordinate of a joint in the design configuration. */
wide oracle_design_coordinate(const spatial_oracle *o, const oracle_joint *joint);

/* At q (nq) and v (nv) in the order of the bodies. false: no memory. */
bool oracle_answer_at(const spatial_oracle *o, double t, const wide *q, const double *v,
                      oracle_answer *out);

/* How far forces are from balance, with these accelerations and reactions: the largest entry of
 * M a - g - reactions, of the largest part of it. */
double oracle_imbalance(const spatial_oracle *o, const wide *q, const double *v, const double *a,
                        double (*reactions)[6]);

#endif
