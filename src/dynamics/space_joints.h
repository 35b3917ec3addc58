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

/* What joints need of a body besides its baum_i_spatial_frame. */
typedef struct baum_i_space_frame {
  double columns[12]; /* columns of A, each followed by 0 */
  double spin[4];     /* angular velocity in body axes, followed by its square */
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

/* The indices at which the constants of a joint begin in the array of its numbers. */
enum {
  BAUM_I_JOINT_DIAGONAL =
    0, /* E E^T / m of rows p, the diagonal of their part of D; eight numbers */
  /* the vectors s_a and s_b of space_joints_hot.c: two matrices of three columns (space_block.h);
   * then, if there are rows s, eight numbers Phi - s_a . z_a; then, if there is a spin row, R of
   * this row for both bodies, four numbers each */
  BAUM_I_JOINT_OWN = 8
};

/* The pointers spare the kernel the computation of addresses. */
typedef struct baum_i_space_joint {
  int32_t shape; /* baum_i_space_shape */
  int32_t node;
  int32_t row;   /* the first of its rows */
  int32_t omits; /* non-zero: at least one of its rows is omitted */
  int32_t stage;
  /* The bodies in the order for which Phi is x_1 - x_0, where x_k is the joint's point on body[k].
   * Phi of a pin is x_a - x_b, so its first body is body_b. */
  int32_t body[2];
  const double *white[2];  /* L^-T of the bodies */
  const double *weight[2]; /* W of their origins */
  double *move[2];         /* E and R of the node's sides for these bodies; NULL: W = 0 */
  double *turn[2];
  double *equations; /* J a0 - r, r and D of the node */
  baum_i_space_measure *measure;
  const double *numbers; /* its constants */
  const double *spin;    /* R of its spin row for both bodies, if it has one */
} baum_i_space_joint;

/* The joints of a block path, and a frame for each body. The bodies and joints of stage s
 * (space_block.h) are bodies[i] and list[k] with body_start[s] <= i < body_start[s + 1] and
 * joint_start[s] <= k < joint_start[s + 1]. A body is set before the first of its joints. */
typedef struct baum_i_space_joints {
  int count;
  baum_i_space_joint *list; /* sorted by stages, then by shapes */
  int32_t *bodies;          /* all bodies but ground */
  int32_t *body_start;      /* (stage_count + 1) */
  int32_t *joint_start;     /* (stage_count + 1) */
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
  baum_i_spatial_frame *spatial; /* (body_count) receives frames in space, except ground */
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

/* Replaces the omitted rows of a joint, which the kernel computes like all others, by rows of zeros
 * with the pivot 1. */
void baum_i_space_joint_omit(const baum_i_space *space, const baum_i_space_joint *joint);

/* Functions for the stages from `first` to `end` - 1. */
typedef struct baum_i_space_bodies_kernel {
  /* Sets the frames of bodies, and the forces and a0 of bodies in space. */
  void (*set)(baum_i_space *space, const baum_i_space_pass *pass, int first, int end);
} baum_i_space_bodies_kernel;

extern const baum_i_space_bodies_kernel baum_i_space_bodies_kernel_plain;
extern const baum_i_space_bodies_kernel baum_i_space_bodies_kernel_wide;

typedef struct baum_i_space_joints_kernel {
  /* Sets sides, r, D and J a0 - r of the joints' nodes, and their rows of Phi, Phi' and gamma. */
  void (*set)(baum_i_space *space, const baum_i_space_pass *pass, int first, int end);
} baum_i_space_joints_kernel;

extern const baum_i_space_joints_kernel baum_i_space_joints_kernel_plain;
extern const baum_i_space_joints_kernel baum_i_space_joints_kernel_wide;

#endif
