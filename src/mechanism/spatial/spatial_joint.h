/* SPDX-License-Identifier: BSD-3-Clause */
/* Many spatial joints are defined by a table of products (spatial_rows.h). Some of the products are
 * the rows of the joint, and its coordinates are computed from the other products. All these joints
 * have the same functions in their type struct.
 */
#ifndef BAUM_I_MECHANISM_SPATIAL_SPATIAL_JOINT_H
#define BAUM_I_MECHANISM_SPATIAL_SPATIAL_JOINT_H

#include "mechanism/definition.h"
#include "mechanism/general/composed_row.h"
#include "mechanism/spatial/spatial_rows.h"

/* The type of a spatial joint that is defined by a table. It begins with the struct that all joint
 * types share. */
typedef struct baum_i_spatial_joint_type {
  baum_i_joint_type type;
  baum_i_spatial_row rows[BAUM_I_SPATIAL_ROWS];
  /* Each coordinate has either one product, which is the displacement, or two products, which are
   * the sine and the cosine of the angle. */
  baum_i_spatial_row coordinate_rows[BAUM_I_COORDINATES][2];
  /* These products of axes are 1 if the joint is assembled as intended. The rows are also satisfied
   * in wrong assemblies. If the axes are reversed, one of these products is -1. If a weld is
   * rotated by 120 degrees about the diagonal of its axes, the products are 0. */
  int directed_count;
  baum_i_spatial_row directed[2];
} baum_i_spatial_joint_type;

/* The first fields of the definitions of joints that have axes. */
typedef struct baum_i_spatial_axis_head {
  baum_i_spatial_head head;
  double axis[3];
  double axis_b[3];
} baum_i_spatial_axis_head;

#define BAUM_I_SPATIAL_AXIS_FIELDS(DEF)                                                 \
  BAUM_I_SPATIAL_FIELDS(DEF), BAUM_I_NUMBERS(DEF, axis, DIRECTION, "-", 0.0, 0.0, 1.0), \
    BAUM_I_OPTIONAL(DEF, axis_b, POINT, "-")

/* Check the head and the axes of a definition, and set BAUM_I_SPATIAL_NUMBERS parameters from them.
 * Joints with axes use these functions, and so do forces with the same fields. The second pair of
 * functions is for definitions in which the field x_axis follows the axes. */
baum_status baum_i_spatial_check_axes(const baum_mechanism *mechanism, const void *def,
                                      const char *label);
baum_status baum_i_spatial_lower_axes(const baum_mechanism *mechanism,
                                      const baum_i_element *element, const baum_i_span *span,
                                      double *parameters);
baum_status baum_i_spatial_check_frame(const baum_mechanism *mechanism, const void *def,
                                       const char *label);
baum_status baum_i_spatial_lower_frame(const baum_mechanism *mechanism,
                                       const baum_i_element *element, const baum_i_span *span,
                                       double *parameters);

/* Return the table of rows of a joint whose type is a baum_i_spatial_joint_type. Returns NULL for
 * other joints. */
const baum_i_spatial_row *baum_i_spatial_rows_of(const baum_i_joint *joint);

/* Return the angle atan2(s, c) and its derivatives, as a function of the coordinates c and s. */
baum_i_outer baum_i_spatial_angle_of(double c, double s);

/* ---- members of the type struct ---- */

baum_status baum_i_spatial_evaluate(const baum_i_joint *joint, baum_i_point *point,
                                    const baum_i_rows *out);
baum_status baum_i_spatial_linearize(const baum_i_joint *joint, baum_i_point *point,
                                     const double *w, const double *lambda,
                                     const baum_i_joint_blocks *blocks);
void baum_i_spatial_place(const baum_i_joint *joint, const baum_i_point *point, double at[3]);
void baum_i_spatial_force_on_b(const baum_i_joint *joint, const baum_i_point *point,
                               const double *lambda, double six[BAUM_I_SPACE]);
bool baum_i_spatial_is_reversed(const baum_i_joint *joint, const baum_i_point *point);
void baum_i_spatial_coordinate(const baum_i_joint *joint, int number, const baum_i_point *point,
                               baum_i_coordinate *out);
void baum_i_spatial_coordinate_linearize(const baum_i_joint *joint, int number,
                                         const baum_i_point *point, const double *w, double lambda,
                                         baum_i_coordinate_blocks *out);

/* Members that the types of all joints with a table have in common. The last arguments are the
 * fields of the definition. */
#define BAUM_I_SPATIAL_JOINT(NAME, TITLE, CHECK, LOWER, ROWS, ...)                   \
  .definition = {.kind = (TITLE),                                                    \
                 .size = sizeof(baum_##NAME##_def),                                  \
                 .fields = (const baum_i_def_field[]){__VA_ARGS__, {0}},             \
                 .check = (CHECK),                                                   \
                 .parameter_count = BAUM_I_SPATIAL_NUMBERS},                         \
  .width = BAUM_I_SPACE, .scleronomic = true, .row_count = (ROWS), .lower = (LOWER), \
  .extent = baum_i_spatial_extent, .evaluate = baum_i_evaluate_each,                 \
  .evaluate_one = baum_i_spatial_evaluate, .linearize = baum_i_spatial_linearize,    \
  .place = baum_i_spatial_place, .force_on_b = baum_i_spatial_force_on_b,            \
  .is_reversed = baum_i_spatial_is_reversed

#endif
