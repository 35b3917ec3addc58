/* SPDX-License-Identifier: BSD-3-Clause */
/* Evaluates spatial mechanisms in quadruple precision. The formulas differ from those of the
 * library. A joint is defined only by Phi, which is a function of the positions and axes of its
 * bodies. J v and gamma follow from the first and second time derivatives of Phi along motions.
 * These derivatives are computed with truncated Taylor series. Coordinates of joints are computed
 * in the same way. Rows of velocity level are defined by the velocities of points along the motion.
 * Rows may be dependent. For example, z_a - z_b = 0 for parallel axes has three rows, but their
 * rank is 2. Every body has six velocities, which are r' in ground axes and the angular velocity in
 * body axes. Planar bodies and particles use only some of them. */
#ifndef BAUM_TEST_SPATIAL_ORACLE_H
#define BAUM_TEST_SPATIAL_ORACLE_H

#include <stdbool.h>
#include <stdint.h>

#include <baum/baum.h>

#include "quad_rows.h"

enum {
  ORACLE_BODIES = 13, /* includes ground, which is body 0 */
  ORACLE_JOINTS = 44,
  ORACLE_FORCES = 14,
  ORACLE_ROWS = 12,     /* of one joint */
  ORACLE_MEMBERS = 4,   /* bodies of one joint */
  ORACLE_REACTION = 24, /* numbers that describe the reaction of one joint */
  ORACLE_USER_ROWS = 2, /* of one user constraint */
  ORACLE_USER_COLUMNS = 12,
  ORACLE_PATH = 5, /* points of one cable */
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
  ORACLE_BASIC_KINDS,
  ORACLE_SCREW = ORACLE_BASIC_KINDS,
  ORACLE_CONSTANT_VELOCITY,
  ORACLE_ROLLING_DISC,
  ORACLE_KNIFE_EDGE, /* its bodies are planar or ground */
  ORACLE_SPATIAL_EDGE,
  ORACLE_CURVE,      /* a point of body_b on a curve of body_a */
  ORACLE_PAIR_KINDS, /* the joints above have two bodies */
  ORACLE_DRIVER = ORACLE_PAIR_KINDS,
  ORACLE_COUPLING,
  ORACLE_USER, /* a user constraint of velocity level */
  ORACLE_KINDS
} oracle_kind;

typedef struct oracle_body {
  baum_body_id id;
  char kind; /* 'g'round, 's'patial body, spatial 'p'article, planar 'b'ody, planar particle 'o' */
  double mass;
  double inertia[6]; /* xx, yy, zz, xy, xz, yz */
  double q[7];       /* in the design configuration, as in the library */
  int nq;
  int nv;
  int first_q;
  int first_v;
} oracle_body;

/* A user constraint of velocity level: sum_j (linear_ij + slope_ij x) v_j = nu_i cos t. Here v are
 * the velocities of all members, and x is the first coordinate of the first member. */
typedef struct oracle_user {
  int members[2];
  int member_count;
  int rows;
  int columns;
  double linear[ORACLE_USER_ROWS][ORACLE_USER_COLUMNS];
  double slope[ORACLE_USER_ROWS][ORACLE_USER_COLUMNS];
  double nu[ORACLE_USER_ROWS];
} oracle_user;

/* A curve F = G = 0. With y = turn x + shift, where x is the position relative to body_a's point in
 * the axes of body_a, the three kinds of curves are:
 *   helix     F = y_1 - r cos(y_3 / c),            G = y_2 - r sin(y_3 / c)
 *   circle    F = (y_1^2 + y_2^2 - r^2) / (2 r),   G = y_3
 *   parabola  F = y_2 - r y_1^2 / 2,               G = y_3 - c y_1 */
typedef struct oracle_curve {
  enum { ORACLE_HELIX, ORACLE_CIRCLE, ORACLE_PARABOLA, ORACLE_CURVES } kind;
  double turn[9]; /* row by row */
  double shift[3];
  double r, c;
} oracle_curve;

/* In a rolling disc, s contains a point of the plane and the centre of the disc. The z axes are the
 * normal of the plane and the axis of the disc. In a knife edge, s[0] is the point of the blade.
 * The x axis on body_a is along the blade, and the y axis on body_a is across it. In a spatial
 * knife edge, s[0] and this y axis have the same meaning. */
typedef struct oracle_joint {
  baum_joint_id id;
  oracle_kind kind;
  int a, b;        /* bodies */
  wide s[2][3];    /* points in body axes */
  wide axes[2][9]; /* x, y and z axis of the joint, in body axes */
  wide length;
  double pitch;       /* of a screw */
  double radius, rim; /* of a rolling disc */
  int of;             /* the joint that a driver moves, or the first joint of a coupling */
  int coordinate;     /* number of the coordinate of this joint, in the order of the library */
  int to;             /* the second joint of a coupling */
  int to_coordinate;  /* number of its coordinate */
  double ratio;       /* of a coupling: c_to = ratio c_of + offset */
  wide offset;        /* of a coupling or a screw */
  double period;      /* [rad or m] whole revolutions change Phi by multiples of it; 0 if none */
  double start[2];    /* of a driver: a time [s], and the value that it prescribes at this time */
  oracle_user user;
  oracle_curve curve;
} oracle_joint;

typedef enum oracle_force_kind {
  ORACLE_LOAD,
  ORACLE_SPRING,
  ORACLE_JOINT_SPRING,
  ORACLE_TORSION_SPRING,
  ORACLE_BUSHING,
  ORACLE_CABLE,
  ORACLE_FORCE_KINDS
} oracle_force_kind;

typedef struct oracle_force {
  oracle_force_kind kind;
  int a, b;           /* a load acts on b */
  int of, coordinate; /* the joint and the coordinate of a joint spring */
  double s[2][3];
  double stiffness;
  double damping;
  wide free_length; /* free length, free angle, or free value of a joint's coordinate */
  double force[3];
  double moment[3];
  bool follows_body;
  oracle_joint frame;        /* bodies, points and axes of a torsion spring or a bushing */
  double stiffness_of_6[36]; /* of a bushing */
  double damping_of_6[36];
  int path[ORACLE_PATH]; /* bodies of the points of a cable */
  double points[ORACLE_PATH][3];
  int point_count;
  wide transition; /* of a cable */
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
  uint64_t rounding; /* 0, or a random seed for rounding errors of the elements of J */
} spatial_oracle;

/* The results of one evaluation. */
typedef struct oracle_answer {
  double phi;  /* largest |Phi| of all rows */
  double rate; /* largest |Phi'| of all rows, relative to the largest velocity */
  wide a[ORACLE_COLUMNS];
  /* Force and moment on body_b at its point, in ground axes. For couplings and user constraints,
   * the generalized force on all bodies. */
  wide reaction[ORACLE_JOINTS][ORACLE_REACTION];
  bool unique[ORACLE_JOINTS];
  quad_rows rows;
  int velocity_rows;       /* number of rows of velocity level */
  quad_rows position_rows; /* results without rows of velocity level: only rank and distances */
} oracle_answer;

/* Computes the points and axes of a joint in body axes. A point on each body and an axis are given
 * in ground axes, in the design configuration. */
void oracle_place(const spatial_oracle *o, oracle_joint *joint, const wide point_a[3],
                  const wide point_b[3], const wide z[3]);

/* Inclines the axes on body_b, so that their z axis becomes parallel to z, which is given in ground
 * axes. They are rotated by the smallest possible angle. */
void oracle_incline(const spatial_oracle *o, oracle_joint *joint, const wide z[3]);

/* The first two functions convert a point of the design configuration to body axes, s = A^T (point
 * - r), and back. The last two functions convert an axis to body axes, and back. */
void oracle_to_body(const oracle_body *body, const wide point[3], wide s[3]);
void oracle_to_ground(const oracle_body *body, const wide s[3], wide point[3]);
void oracle_axis_to_body(const oracle_body *body, const wide axis[3], wide s[3]);
void oracle_axis_to_ground(const oracle_body *body, const wide s[3], wide axis[3]);

/* Returns the length of a cable in the design configuration. */
wide oracle_design_length(const spatial_oracle *o, const oracle_force *cable);

/* The law of the drivers, which the library calls. `user` points to the member `start` of an
 * oracle_joint. */
int oracle_law(double t, double s[3], void *user);

/* The first function returns the number of coordinates of a joint. The second one returns one of
 * these coordinates in the design configuration. */
int oracle_coordinate_count(oracle_kind kind);
wide oracle_design_coordinate(const spatial_oracle *o, const oracle_joint *joint, int number);

/* Evaluates the mechanism at q (nq) and v (nv). Their entries are in the order of the bodies.
 * Returns false if there is not enough memory. */
bool oracle_answer_at(const spatial_oracle *o, double t, const wide *q, const double *v,
                      oracle_answer *out);

/* Returns the largest element of M a - g - reactions, for the given accelerations and reactions. It
 * is relative to the largest term. */
double oracle_imbalance(const spatial_oracle *o, const wide *q, const double *v, const double *a,
                        double (*reactions)[ORACLE_REACTION]);

#endif
