/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  More planar joints: pin in a slot, rack and pinion, gear, point on a curve. planar.h explains
 *  coordinates, points and reactions.
 */
#ifndef BAUM_PLANAR_JOINTS_H
#define BAUM_PLANAR_JOINTS_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- pin in a slot (point on a line) --------------------------------------------------------- */

/** A pin of body_b in a straight slot of body_a; body_b may rotate about the pin. One row [m]:
 *  distance of body_b's point from the axis through body_a's point. The joint's coordinate is the
 *  displacement [m] of body_b's point from body_a's point along the axis. body_a must have an
 *  angle; body_b may be a particle. */
typedef struct baum_planar_pin_in_slot_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  double point[2]; /**< [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point_a[2]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[2]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (1, 0). */
  double axis[2];
} baum_planar_pin_in_slot_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_pin_in_slot_def_init(baum_planar_pin_in_slot_def *def,
                                               size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_pin_in_slot_def baum_planar_pin_in_slot_def_default(void)
{
  baum_planar_pin_in_slot_def def;
  baum_planar_pin_in_slot_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_pin_in_slot(baum_mechanism *mechanism,
                                                           const baum_planar_pin_in_slot_def *def,
                                                           baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_pin_in_slot(const baum_mechanism *mechanism,
                                                           baum_joint_id id,
                                                           baum_planar_pin_in_slot_def *out,
                                                           size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_pin_in_slot(baum_mechanism *mechanism,
                                                           baum_joint_id id,
                                                           const baum_planar_pin_in_slot_def *def);

/* ---- rack and pinion ------------------------------------------------------------------------- */

/** A pinion of body_b rolls on a rack of body_a without slipping. One row [m]: displacement -
 *  radius (angle_b - angle_a) - offset. The axis is the direction of the rack. The displacement is
 *  that of body_b's point, the centre of the pinion, from body_a's point along the axis.
 *
 *  The row enforces rolling only. Another joint, such as a pin in a slot, must keep the centre at
 *  its distance from the rack. A pinion with positive radius moves forward along the axis when it
 *  rotates counter-clockwise: its rack is on its left, looking along the axis. With a negative
 *  radius the rack is on its right, which is below for the axis (1, 0). Both bodies must have an
 *  angle. */
typedef struct baum_planar_rack_and_pinion_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  double point[2]; /**< [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point_a[2]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[2]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (1, 0). */
  double axis[2];
  /** [m] radius of the pitch circle, not 0; its sign as described above. Default: 0, must be set.
   */
  double radius;
  double offset; /**< [m] in the row above. Default: NaN, the value in the design configuration. */
} baum_planar_rack_and_pinion_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_rack_and_pinion_def_init(baum_planar_rack_and_pinion_def *def,
                                                   size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_rack_and_pinion_def baum_planar_rack_and_pinion_def_default(void)
{
  baum_planar_rack_and_pinion_def def;
  baum_planar_rack_and_pinion_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_rack_and_pinion(
  baum_mechanism *mechanism, const baum_planar_rack_and_pinion_def *def, baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_rack_and_pinion(const baum_mechanism *mechanism,
                                                               baum_joint_id id,
                                                               baum_planar_rack_and_pinion_def *out,
                                                               size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_rack_and_pinion(
  baum_mechanism *mechanism, baum_joint_id id, const baum_planar_rack_and_pinion_def *def);

/* ---- gear ------------------------------------------------------------------------------------ */

/** Two wheels, body_a and body_b, roll on each other without slipping; a carrier bears both. One
 *  row [m]: radius_a (angle_a - angle_c) + radius_b (angle_b - angle_c) - offset, where angle_c is
 *  the angle of the carrier.
 *
 *  Two positive radii mean external teeth: the wheels rotate in opposite directions. One negative
 *  radius means that this wheel is a ring with internal teeth: both wheels rotate in the same
 *  direction. Only the ratio matters for the motion, so numbers of teeth may replace radii. Other
 *  joints, such as pins, must keep the wheels on the carrier. A planetary gear has one row between
 *  sun and planet and one between planet and ring, with the arm as carrier; a fixed ring is
 *  BAUM_GROUND. All bodies must have an angle.
 *
 *  Reaction: the generalized force -J^T lambda on the velocities of body_a, body_b and the carrier,
 *  without ground. Its force components are zero, because the row contains angles only. */
typedef struct baum_planar_gear_def {
  size_t struct_size;   /**< Set by the default. Do not write. */
  const char *name;     /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a;  /**< Default: none, must be set. */
  baum_body_id body_b;  /**< Default: none, must be set; must differ from body_a. */
  baum_body_id carrier; /**< Neither body_a nor body_b. Default: BAUM_GROUND. */
  /** [m] radius of the pitch circle, not 0; negative: internal teeth. Default: 0, must be set. */
  double radius_a;
  /** [m] radius of the pitch circle, not 0; negative: internal teeth. Default: 0, must be set. */
  double radius_b;
  double offset; /**< [m] in the row above. Default: NaN, the value in the design configuration. */
} baum_planar_gear_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_gear_def_init(baum_planar_gear_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_gear_def baum_planar_gear_def_default(void)
{
  baum_planar_gear_def def;
  baum_planar_gear_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_gear(baum_mechanism *mechanism,
                                                    const baum_planar_gear_def *def,
                                                    baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_gear(const baum_mechanism *mechanism,
                                                    baum_joint_id id, baum_planar_gear_def *out,
                                                    size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_gear(baum_mechanism *mechanism, baum_joint_id id,
                                                    const baum_planar_gear_def *def);

/* ---- point on a curve (cam) ------------------------------------------------------------------ */

/** A curve F(x, y) = 0 and the derivatives of F. The derivatives must be exact near the curve, not
 *  only on it. F should change by about 1 per metre across the curve: with |grad F| near 1 the row
 *  is to first order the distance from the curve, and tolerances bound this distance.
 *  @param[in]  xy    (2) [m] x and y from body_a's point, in body_a's axes
 *  @param[out] out   (6) F [m], its first derivatives F_x, F_y [-] and second derivatives F_xx,
 *                    F_xy, F_yy [1/m]; zeroed before the call
 *  @param      user  the definition's `user`
 *  @return  0 success, > 0 retry with a smaller step, < 0 stop */
typedef int baum_curve_fn(const double xy[2], double out[6], void *user);

/** A point of body_b stays on a curve fixed in body_a: a cam with a pointed follower, or a bead on
 *  a wire. One row [m]: F at body_b's point. For a roller, give the path of its centre. For a cam
 *  whose follower moves along the coordinate of a joint, use a coupling with a law (mechanism.h).
 *
 *  If `point` is given, the origin of the curve is at this point in the design configuration.
 *  body_a must have an angle; body_b may be a particle. baum_mechanism_check_derivatives() compares
 *  the derivatives with differences. Methods that need third derivatives take differences of the
 *  second. */
typedef struct baum_planar_curve_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  double point[2]; /**< [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point_a[2];    /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[2];    /**< [m] on body_b, in its axes. Default: NaN, not given. */
  baum_curve_fn *curve; /**< F. Default: NULL, must be set. */
  void *user;           /**< Passed to curve. Not owned. Default: NULL. */
} baum_planar_curve_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_curve_def_init(baum_planar_curve_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_curve_def baum_planar_curve_def_default(void)
{
  baum_planar_curve_def def;
  baum_planar_curve_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_curve(baum_mechanism *mechanism,
                                                     const baum_planar_curve_def *def,
                                                     baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_curve(const baum_mechanism *mechanism,
                                                     baum_joint_id id, baum_planar_curve_def *out,
                                                     size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_curve(baum_mechanism *mechanism, baum_joint_id id,
                                                     const baum_planar_curve_def *def);

/* ---- knife edge ------------------------------------------------------------------------------ */

/** A point of body_a moves only along a blade that is fixed in body_a, relative to body_b: a skate,
 *  or a wheel seen from above. One row of velocity level [m/s]: the velocity of the point across
 *  the blade, positive to the left of `axis`. Such a row does not restrict positions: with it a
 *  mechanism has more degrees of freedom of position than of velocity (see baum_mobility).
 *
 *  body_b is the surface on which the blade slides. Both bodies must have an angle. Reaction: force
 *  and moment on body_b at the blade's point. */
typedef struct baum_planar_knife_edge_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Bears the blade. Default: none, must be set. */
  baum_body_id body_b; /**< The surface; must differ from body_a. Default: BAUM_GROUND. */
  double point[2]; /**< [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point_a[2]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  /** [-] direction of the blade, not zero; in ground axes if `point` is given, otherwise in the
   * axes of body_a. Default: (1, 0). */
  double axis[2];
} baum_planar_knife_edge_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_knife_edge_def_init(baum_planar_knife_edge_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_knife_edge_def baum_planar_knife_edge_def_default(void)
{
  baum_planar_knife_edge_def def;
  baum_planar_knife_edge_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_knife_edge(baum_mechanism *mechanism,
                                                          const baum_planar_knife_edge_def *def,
                                                          baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_knife_edge(const baum_mechanism *mechanism,
                                                          baum_joint_id id,
                                                          baum_planar_knife_edge_def *out,
                                                          size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_knife_edge(baum_mechanism *mechanism,
                                                          baum_joint_id id,
                                                          const baum_planar_knife_edge_def *def);

#ifdef __cplusplus
}
#endif

#endif
