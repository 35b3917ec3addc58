/* SPDX-License-Identifier: BSD-3-Clause */
/* A spatial joint is a table of products (spatial_rows.h): those that are its rows, and those from
 * which its coordinates are computed. All spatial joints have the same functions in the type
 * struct.
 */
#ifndef BAUM_I_MECHANISM_SPATIAL_SPATIAL_JOINT_H
#define BAUM_I_MECHANISM_SPATIAL_SPATIAL_JOINT_H

#include "mechanism/definition.h"
#include "mechanism/spatial/spatial_rows.h"

/* The type of a spatial joint; begins with the struct that all joint types share. */
typedef struct baum_i_spatial_joint_type {
  baum_i_joint_type type;
  baum_i_spatial_row rows[BAUM_I_SPATIAL_ROWS];
  /* For each coordinate: the product that is the displacement, or the two products that are sine
   * and cosine of the angle. */
  baum_i_spatial_row coordinate_rows[BAUM_I_COORDINATES][2];
  /* Products of axes that are 1 in the intended assembly. The rows also hold in wrong assemblies:
   * if axes are reversed, one of these products is -1; if a weld is rotated by 120 degrees about
   * the diagonal of its axes, they are 0. */
  int directed_count;
  baum_i_spatial_row directed[2];
} baum_i_spatial_joint_type;

/* The first fields of definitions of joints with axes. */
typedef struct baum_i_spatial_axis_head {
  baum_i_spatial_head head;
  double axis[3];
  double axis_b[3];
} baum_i_spatial_axis_head;

#define BAUM_I_SPATIAL_AXIS_FIELDS(DEF)                                                 \
  BAUM_I_SPATIAL_FIELDS(DEF), BAUM_I_NUMBERS(DEF, axis, DIRECTION, "-", 0.0, 0.0, 1.0), \
    BAUM_I_OPTIONAL(DEF, axis_b, POINT, "-")

/* The rows of a joint of such a type; NULL for other joints. */
const baum_i_spatial_row *baum_i_spatial_rows_of(const baum_i_joint *joint);

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

/* The last arguments are the fields of the definition. */
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
