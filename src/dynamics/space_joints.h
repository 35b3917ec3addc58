/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the frames of bodies in space and the geometry of joints between them in two passes, and
 * writes them directly to the solver for space. The joints are those of
 * mechanism/spatial/lower_pairs.c, whose rows make points coincide, compare directions or keep a
 * point on a line or plane.
 */
#ifndef BAUM_I_DYNAMICS_SPACE_JOINTS_H
#define BAUM_I_DYNAMICS_SPACE_JOINTS_H

#include "linear/space_block.h"
#include "mechanism/mechanism.h"

/* The frame of a body. Each vector of three numbers is followed by a 0. */
typedef struct baum_i_space_frame {
  double axes[12];   /* columns of A */
  double turned[12]; /* columns of B = A L^-T, with L of space_block.h */
  double r[4];
  double v[4];
  double w[4]; /* angular velocity in ground axes */
} baum_i_space_frame;

/* The shape of a planar revolute joint is PIN. In the names of the other shapes, the letters stand
 * for the rows of the joint, in their order. P: three rows that make points coincide. D: the dot
 * product of two axes, one on each body. E: a row D with the same axis on body_b as the row before
 * it. S: the dot product of an axis on body_a and the vector between the points. U: a spin row. */
typedef enum baum_i_space_shape {
  BAUM_I_SHAPE_PIN,
  BAUM_I_SHAPE_P,
  BAUM_I_SHAPE_PD,
  BAUM_I_SHAPE_PDE,
  BAUM_I_SHAPE_PDED,
  BAUM_I_SHAPE_DESS,
  BAUM_I_SHAPE_DESSD,
  BAUM_I_SHAPE_DES,
  BAUM_I_SHAPE_SS,
  BAUM_I_SHAPE_S,
  BAUM_I_SHAPE_PU,
  BAUM_I_SHAPE_PDU,
  BAUM_I_SHAPE_PDEU,
  BAUM_I_SHAPE_DESSDU,
  BAUM_I_SHAPES
} baum_i_space_shape;

/* The indices at which the constants of a joint begin in the array of its numbers. Vectors are in
 * body axes. */
enum {
  BAUM_I_JOINT_POINTS = 0, /* s_a, s_b */
  BAUM_I_JOINT_ARMS = 8,   /* columns of [s_a]x L_a^-T and of -[s_b]x L_b^-T */
  BAUM_I_JOINT_KEEP = 32,  /* for each row 1, or 0 if it is omitted; eight numbers */
  /* constant part of the diagonal of D: the terms E E^T / m of rows p, and the pivots 1 of omitted
   * rows; eight numbers */
  BAUM_I_JOINT_DIAGONAL = 40,
  BAUM_I_JOINT_AXES =
    48 /* 8 numbers for each row; rows d and e: the axes on a and on b; rows s: the axis on a; rows
          u: rows of R of both sides */
};

typedef struct baum_i_space_joint {
  int32_t shape; /* baum_i_space_shape */
  int32_t node;
  int32_t row; /* the first of its rows */
  /* The bodies in the order for which Phi is x_1 - x_0, where x_k is the joint's point on body[k].
   * Phi of a pin is x_a - x_b, so its first body is body_b. */
  int32_t body[2];
  /* starts of E and R of the node's sides for these bodies in baum_i_space.sides; -1: the body is
   * ground */
  int32_t move[2];
  int32_t turn[2];
  int32_t numbers; /* index of its first constant in baum_i_space_joints.numbers */
} baum_i_space_joint;

/* The joints of a block path, and a frame for each body. */
typedef struct baum_i_space_joints {
  int count;
  baum_i_space_joint *list; /* sorted by shapes */
  double *numbers;
  baum_i_space_frame *frames; /* (body_count), ground first */
} baum_i_space_joints;

/* Return the shape of a joint. Returns BAUM_I_SHAPES if the joint must be evaluated by its J,
 * because it has other kinds of rows. */
baum_i_space_shape baum_i_shape_of(const baum_i_joint *joint);

/* Return the shape with an additional spin row, or BAUM_I_SHAPES if there is no such shape. */
baum_i_space_shape baum_i_shape_with_spin(int shape);

/* Input and output of the kernel. */
typedef struct baum_i_space_pass {
  baum_i_space_joints joints;
  const baum_i_body_place *places; /* (body_count) */
  const double *q;
  const double *v;               /* NULL: at rest */
  double *normalized;            /* (nq) receives q with unit quaternions, or NULL */
  const baum_i_frame *frames;    /* (body_count) planar frames */
  baum_i_spatial_frame *spatial; /* (body_count) receives frames in space, for other elements */
  const double *gravity;         /* NULL: no forces are wanted */
  const double *moments;         /* (nv) replace the gyroscopic moments unless NULL */
  double *force;                 /* (nv) receives weights and gyroscopic moments */
  double bending;                /* r = bending gamma - damping Phi' - stiffness Phi */
  double damping;
  double stiffness;
  double *phi; /* (nc) only rows of the joints are set */
  double *phi_rate;
  double *gamma;
} baum_i_space_pass;

typedef struct baum_i_space_joints_kernel {
  /* Sets the frames of all bodies, and the forces and a0 of bodies in space. */
  void (*set_bodies)(baum_i_space *space, const baum_i_space_pass *pass);
  /* Sets sides, r, D and J a0 - r of the joints' nodes, and their rows of Phi, Phi' and gamma. */
  void (*set_joints)(baum_i_space *space, const baum_i_space_pass *pass);
} baum_i_space_joints_kernel;

extern const baum_i_space_joints_kernel baum_i_space_joints_kernel_plain;
extern const baum_i_space_joints_kernel baum_i_space_joints_kernel_wide;

#endif
