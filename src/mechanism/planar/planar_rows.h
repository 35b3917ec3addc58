/* SPDX-License-Identifier: BSD-3-Clause */
/* The part that planar joints have in common. Every joint has kernels. A kernel is a function that
 * computes the rows of one joint from its two markers. The rows have six columns, three for each
 * body.
 *
 * This file contains the loops over the joints of a group, and the conversion to packed columns.
 * These loops are inline functions, and the kernels are constants in the file of a joint. The
 * compiled loop therefore calls no functions through pointers.
 */
#ifndef BAUM_I_MECHANISM_PLANAR_PLANAR_ROWS_H
#define BAUM_I_MECHANISM_PLANAR_PLANAR_ROWS_H

#include <string.h>

#include "base/hot.h"
#include "mechanism/planar/planar.h"

enum {
  BAUM_I_PLANAR_COLUMNS = 6,
  BAUM_I_PLANAR_ROWS = 3,    /* largest number of rows of a planar joint */
  BAUM_I_PLANAR_NUMBERS = 4, /* number of parameters for the points s_a and s_b, which come first */
};

/* A joint, together with the state (point) in which it is evaluated. */
typedef struct baum_i_planar_pair {
  const double *s_a;
  const double *s_b;
  const double *numbers; /* the parameters of the joint that follow s_a and s_b */
  const baum_i_frame *frame_a;
  const baum_i_frame *frame_b;
  baum_i_marker a;
  baum_i_marker b;
} baum_i_planar_pair;

/* Second derivatives of up to three rows over the six columns of both bodies. jtl_q is summed over
 * the rows. */
typedef struct baum_i_planar_blocks {
  double jw_q[BAUM_I_PLANAR_ROWS * BAUM_I_PLANAR_COLUMNS];
  double jtl_q[BAUM_I_PLANAR_COLUMNS * BAUM_I_PLANAR_COLUMNS];
  double gamma_q[BAUM_I_PLANAR_ROWS * BAUM_I_PLANAR_COLUMNS];
  double gamma_v[BAUM_I_PLANAR_ROWS * BAUM_I_PLANAR_COLUMNS];
} baum_i_planar_blocks;

/* Sets either one value for each row, or six values (one for each column) for each row. */
typedef void baum_i_planar_kernel(const baum_i_planar_pair *pair, double *out);

/* Sets second derivatives for w (6 entries) and lambda (one entry for each row). The caller has
 * zeroed `out`. */
typedef void baum_i_planar_second_kernel(const baum_i_planar_pair *pair, const double *w,
                                         const double *lambda, baum_i_planar_blocks *out);

/* Compute the markers from the joint's parameters and the frames of its bodies. */
static inline baum_i_planar_pair baum_i_planar_pair_of(const double *numbers, const baum_i_frame *a,
                                                       const baum_i_frame *b)
{
  return (baum_i_planar_pair){
    .s_a = numbers,
    .s_b = numbers + 2,
    .numbers = numbers + BAUM_I_PLANAR_NUMBERS,
    .frame_a = a,
    .frame_b = b,
    .a = baum_i_marker_on(a, numbers),
    .b = baum_i_marker_on(b, numbers + 2),
  };
}

static inline baum_i_planar_pair baum_i_planar_pair_at(const baum_i_joint *joint,
                                                       const baum_i_point *point)
{
  return baum_i_planar_pair_of(point->parameters + joint->element.parameter,
                               &point->frames[joint->span.bodies[0]],
                               &point->frames[joint->span.bodies[1]]);
}

/* Return the angle of body_b relative to body_a. It is continuous, so it may exceed a full
 * revolution. */
static inline double baum_i_planar_angle(const baum_i_planar_pair *pair)
{
  return pair->frame_b->angle - pair->frame_a->angle;
}

/* The kernels of a joint. */
typedef struct baum_i_planar_kernels {
  int rows;
  baum_i_planar_kernel *phi;
  baum_i_planar_kernel *jacobian; /* sets six columns for each row */
  baum_i_planar_kernel *gamma;
} baum_i_planar_kernels;

/* Set one row of J. */
static inline void baum_i_planar_set_row(double six[6], double x_a, double y_a, double angle_a,
                                         double x_b, double y_b, double angle_b)
{
  six[0] = x_a;
  six[1] = y_a;
  six[2] = angle_a;
  six[3] = x_b;
  six[4] = y_b;
  six[5] = angle_b;
}

BAUM_I_INLINE void baum_i_planar_put_jacobian(const baum_i_joint *joint, const baum_i_point *point,
                                              const baum_i_planar_pair *pair,
                                              const baum_i_planar_kernels *kernels,
                                              double *jacobian)
{
  double six[BAUM_I_PLANAR_ROWS * BAUM_I_PLANAR_COLUMNS];
  kernels->jacobian(pair, six);
  baum_i_columns_pack(point->mechanism, &joint->span, kernels->rows, six,
                      jacobian + joint->jacobian);
}

/* Evaluate Phi, gamma and J. Phi and gamma are stored only after all three have been evaluated. The
 * compiler can then compute common terms only once. */
BAUM_I_INLINE void baum_i_planar_put_all(const baum_i_joint *joint, const baum_i_point *point,
                                         const baum_i_planar_pair *pair,
                                         const baum_i_planar_kernels *kernels,
                                         const baum_i_rows *rows)
{
  double phi[BAUM_I_PLANAR_ROWS];
  double gamma[BAUM_I_PLANAR_ROWS];
  kernels->phi(pair, phi);
  kernels->gamma(pair, gamma);
  baum_i_planar_put_jacobian(joint, point, pair, kernels, rows->jacobian);
  memcpy(rows->phi + joint->row, phi, (size_t)kernels->rows * sizeof *phi);
  memcpy(rows->gamma + joint->row, gamma, (size_t)kernels->rows * sizeof *gamma);
}

BAUM_I_INLINE baum_status baum_i_planar_evaluate(const baum_i_joint_group *group,
                                                 const baum_i_point *point,
                                                 const baum_i_planar_kernels *kernels,
                                                 const baum_i_rows *rows)
{
  bool all = rows->phi && rows->jacobian && rows->gamma;
  for (int i = 0; i < group->count; i++) {
    const baum_i_joint *joint = group->joints[i];
    baum_i_planar_pair pair = baum_i_planar_pair_at(joint, point);
    if (all) {
      baum_i_planar_put_all(joint, point, &pair, kernels, rows);
      continue;
    }
    if (rows->phi) {
      kernels->phi(&pair, rows->phi + joint->row);
    }
    if (rows->jacobian) {
      baum_i_planar_put_jacobian(joint, point, &pair, kernels, rows->jacobian);
    }
    if (rows->gamma) {
      kernels->gamma(&pair, rows->gamma + joint->row);
    }
  }
  return BAUM_OK;
}

static inline baum_status baum_i_planar_linearize(const baum_i_joint *joint,
                                                  const baum_i_point *point, const double *w,
                                                  const double *lambda,
                                                  baum_i_planar_second_kernel *kernel,
                                                  const baum_i_joint_blocks *blocks)
{
  static const double none[BAUM_I_PLANAR_ROWS] = {0.0};
  baum_i_planar_pair pair = baum_i_planar_pair_at(joint, point);
  double w_six[BAUM_I_PLANAR_COLUMNS];
  baum_i_columns_gather(point, &joint->span, BAUM_I_PLANE, w, w_six);
  baum_i_planar_blocks six = {.jw_q = {0.0}};
  kernel(&pair, w_six, lambda ? lambda + joint->row : none, &six);
  const baum_i_joint_blocks wide = {six.jw_q, six.jtl_q, six.gamma_q, six.gamma_v, NULL};
  baum_i_columns_pack_blocks(point->mechanism, joint, BAUM_I_PLANE, &wide, blocks);
  return BAUM_OK;
}

/* Define the functions NAME_evaluate() and NAME_linearize() of a type from its kernels. */
#define BAUM_I_PLANAR_EVALUATE(NAME, ROWS, PHI, JACOBIAN, GAMMA)                           \
  static baum_status NAME##_evaluate(const baum_i_joint_group *group, baum_i_point *point, \
                                     const baum_i_rows *out)                               \
  {                                                                                        \
    static const baum_i_planar_kernels kernels = {ROWS, PHI, JACOBIAN, GAMMA};             \
    return baum_i_planar_evaluate(group, point, &kernels, out);                            \
  }

#define BAUM_I_PLANAR_LINEARIZE(NAME, KERNEL)                                         \
  static baum_status NAME##_linearize(const baum_i_joint *joint, baum_i_point *point, \
                                      const double *w, const double *lambda,          \
                                      const baum_i_joint_blocks *blocks)              \
  {                                                                                   \
    return baum_i_planar_linearize(joint, point, w, lambda, KERNEL, blocks);          \
  }

/* Common members of definitions and types of joints with two bodies. The parameters are the two
 * points and then OWN further numbers. The last arguments are the fields of the definition. */
#define BAUM_I_PLANAR_DEFINITION(NAME, TITLE, CHECK, OWN, ...)              \
  .kind = (TITLE), .size = sizeof(baum_##NAME##_def),                       \
  .fields = (const baum_i_def_field[]){__VA_ARGS__, {0}}, .check = (CHECK), \
  .parameter_count = BAUM_I_PLANAR_NUMBERS + (OWN)
#define BAUM_I_PLANAR_MEMBERS(ROWS)                                                                \
  .width = BAUM_I_PLANE, .scleronomic = true, .row_count = (ROWS), .extent = baum_i_planar_extent, \
  .place = baum_i_planar_place
#define BAUM_I_PLANAR_JOINT(NAME, TITLE, CHECK, OWN, ROWS, ...)                   \
  .definition = {BAUM_I_PLANAR_DEFINITION(NAME, TITLE, CHECK, OWN, __VA_ARGS__)}, \
  .evaluate = NAME##_evaluate, BAUM_I_PLANAR_MEMBERS(ROWS)

void baum_i_planar_place(const baum_i_joint *joint, const baum_i_point *point, double at[3]);

/* Set the parameters that are the two points. The caller sets the other parameters of the joint.
 * Returns the status of baum_i_planar_points(). */
baum_status baum_i_planar_lower_points(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                       double *parameters);

#endif
