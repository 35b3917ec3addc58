/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Planar joints beside the pin, slider, rod and weld of planar.h: pin in a slot, rack and pinion,
 *  gear, point on a curve. What is said there of coordinates, placing and reactions holds here.
 */
#ifndef BAUM_PLANAR_JOINTS_H
#define BAUM_PLANAR_JOINTS_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- pin in a slot (point on a line) --------------------------------------------------------- */

/** A pin of body_b in a straight slot of body_a, about which it may turn. One row [m]: distance of
 *  body_b's point from the axis through body_a's point. Its coordinate, for drivers, couplings and
 *  channels, is the displacement [m] of body_b's point from body_a's along the axis. body_a must
 *  have an angle; body_b may be a particle. */
typedef struct baum_planar_pin_in_slot_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; not body_a. */
  double point[2];     /**< [m] ground axes, design configuration. Default: NaN, not given. */
  double point_a[2];   /**< [m] on body_a, its axes. Default: NaN, not given. */
  double point_b[2];   /**< [m] on body_b, its axes. Default: NaN, not given. */
  double axis[2]; /**< [-] not zero; in ground axes with `point`, else body_a's. Default: (1, 0). */
} baum_planar_pin_in_slot_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_pin_in_slot_def_init(baum_planar_pin_in_slot_def *def,
                                               size_t caller_size);

/** The default definition of a pin in a slot. */
static inline baum_planar_pin_in_slot_def baum_planar_pin_in_slot_def_default(void)
{
  baum_planar_pin_in_slot_def def;
  baum_planar_pin_in_slot_def_init(&def, sizeof def);
  return def;
}

/** Add a pin in a slot.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_pin_in_slot(baum_mechanism *mechanism,
                                                           const baum_planar_pin_in_slot_def *def,
                                                           baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_pin_in_slot(const baum_mechanism *mechanism,
                                                           baum_joint_id id,
                                                           baum_planar_pin_in_slot_def *out,
                                                           size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_pin_in_slot()
 */
BAUM_API baum_status baum_mechanism_set_planar_pin_in_slot(baum_mechanism *mechanism,
                                                           baum_joint_id id,
                                                           const baum_planar_pin_in_slot_def *def);

/* ---- rack and pinion ------------------------------------------------------------------------- */

/** A pinion of body_b rolls on a rack of body_a without slipping. One row [m]:
 *  displacement - radius (angle_b - angle_a) - offset, where displacement is that of body_b's
 *  point, the pinion's centre, from body_a's along the axis, the direction of the rack. The row
 *  holds the rolling only: that the centre stays at its distance from the rack is left to another
 *  joint, such as a pin in a slot. Turning counter-clockwise, a pinion of positive radius goes
 *  forward along the axis: its rack lies on the left of it, seen along the axis; with a negative
 *  radius on the right, which is below for the axis (1, 0). Both bodies must have an angle. */
typedef struct baum_planar_rack_and_pinion_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; not body_a. */
  double point[2];     /**< [m] ground axes, design configuration. Default: NaN, not given. */
  double point_a[2];   /**< [m] on body_a, its axes. Default: NaN, not given. */
  double point_b[2];   /**< [m] on body_b, its axes. Default: NaN, not given. */
  double axis[2]; /**< [-] not zero; in ground axes with `point`, else body_a's. Default: (1, 0). */
  double radius;  /**< [m] of its pitch circle, not 0; sign as above. Default: 0, must be set. */
  double offset;  /**< [m] that is kept. Default: NaN, that of the design configuration. */
} baum_planar_rack_and_pinion_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_rack_and_pinion_def_init(baum_planar_rack_and_pinion_def *def,
                                                   size_t caller_size);

/** The default definition of a rack and pinion. */
static inline baum_planar_rack_and_pinion_def baum_planar_rack_and_pinion_def_default(void)
{
  baum_planar_rack_and_pinion_def def;
  baum_planar_rack_and_pinion_def_init(&def, sizeof def);
  return def;
}

/** Add a rack and pinion.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_rack_and_pinion(
  baum_mechanism *mechanism, const baum_planar_rack_and_pinion_def *def, baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_rack_and_pinion(const baum_mechanism *mechanism,
                                                               baum_joint_id id,
                                                               baum_planar_rack_and_pinion_def *out,
                                                               size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_rack_and_pinion()
 */
BAUM_API baum_status baum_mechanism_set_planar_rack_and_pinion(
  baum_mechanism *mechanism, baum_joint_id id, const baum_planar_rack_and_pinion_def *def);

/* ---- gear ------------------------------------------------------------------------------------ */

/** Two wheels of body_a and body_b on a carrier roll on each other without slipping. One row [m]:
 *  radius_a (angle_a - angle_c) + radius_b (angle_b - angle_c) - offset, with angle_c of the
 *  carrier. Both radii positive: external teeth, the wheels turn in opposite directions; one of
 *  them negative: that wheel is a ring with internal teeth, they turn alike. Only their ratio
 *  matters to the motion; numbers of teeth do as well. That the wheels stay on the carrier is left
 *  to other joints, such as pins. A planetary gear is one row between sun and planet and one
 *  between planet and ring, with the arm as their carrier; a fixed ring is BAUM_GROUND.
 *  All bodies must have an angle. Reaction: the generalized force -J^T lambda over the velocities
 *  of body_a, body_b and the carrier, those of ground left out; only its moments are not zero. */
typedef struct baum_planar_gear_def {
  size_t struct_size;   /**< Set by the default. Do not write. */
  const char *name;     /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a;  /**< Default: none, must be set. */
  baum_body_id body_b;  /**< Default: none, must be set; not body_a. */
  baum_body_id carrier; /**< Neither body_a nor body_b. Default: BAUM_GROUND. */
  double radius_a;      /**< [m] of its pitch circle, not 0; negative: internal teeth.
                             Default: 0, must be set. */
  double radius_b;      /**< [m] of its pitch circle, not 0; negative: internal teeth.
                             Default: 0, must be set. */
  double offset;        /**< [m] that is kept. Default: NaN, that of the design configuration. */
} baum_planar_gear_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_gear_def_init(baum_planar_gear_def *def, size_t caller_size);

/** The default definition of a gear. */
static inline baum_planar_gear_def baum_planar_gear_def_default(void)
{
  baum_planar_gear_def def;
  baum_planar_gear_def_init(&def, sizeof def);
  return def;
}

/** Add a gear.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_gear(baum_mechanism *mechanism,
                                                    const baum_planar_gear_def *def,
                                                    baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_gear(const baum_mechanism *mechanism,
                                                    baum_joint_id id, baum_planar_gear_def *out,
                                                    size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_gear()
 */
BAUM_API baum_status baum_mechanism_set_planar_gear(baum_mechanism *mechanism, baum_joint_id id,
                                                    const baum_planar_gear_def *def);

/* ---- point on a curve (cam) ------------------------------------------------------------------ */

/** A curve F(x, y) = 0 and derivatives of F. They must be those of F everywhere near the curve, not
 *  only on it, and F should change at about 1 per metre across it: |grad F| near 1 makes the row
 *  the distance from the curve to first order, and tolerances mean what they say.
 *  @param[in]  xy    (2) [m] in body_a's axes, from its point
 *  @param[out] out   (6) F [m], F_x, F_y [-], F_xx, F_xy, F_yy [1/m]; zeroed before the call
 *  @param      user  the definition's `user`
 *  @return           0 fine, > 0 retry with a smaller step, < 0 stop
 */
typedef int baum_curve_fn(const double xy[2], double out[6], void *user);

/** A point of body_b is on a curve that is fixed in body_a: a cam with a pointed follower, a bead
 *  on a wire. One row [m]: F at body_b's point. (A roller's centre is on the curve beside the cam,
 *  at its radius; a cam whose follower is a joint is a coupling with a law, in mechanism.h.)
 *  With `point` the curve's origin is drawn where body_b's point is. body_a must have an angle;
 *  body_b may be a particle. baum_mechanism_check_derivatives() compares the derivatives with
 *  differences; third derivatives, where a method needs them, are differences of the second. */
typedef struct baum_planar_curve_def {
  size_t struct_size;   /**< Set by the default. Do not write. */
  const char *name;     /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a;  /**< Default: none, must be set. */
  baum_body_id body_b;  /**< Default: none, must be set; not body_a. */
  double point[2];      /**< [m] ground axes, design configuration. Default: NaN, not given. */
  double point_a[2];    /**< [m] on body_a, its axes. Default: NaN, not given. */
  double point_b[2];    /**< [m] on body_b, its axes. Default: NaN, not given. */
  baum_curve_fn *curve; /**< F. Default: NULL, must be set. */
  void *user;           /**< Passed to curve, not owned. Default: NULL. */
} baum_planar_curve_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_curve_def_init(baum_planar_curve_def *def, size_t caller_size);

/** The default definition of a point on a curve. */
static inline baum_planar_curve_def baum_planar_curve_def_default(void)
{
  baum_planar_curve_def def;
  baum_planar_curve_def_init(&def, sizeof def);
  return def;
}

/** Add a point on a curve.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_curve(baum_mechanism *mechanism,
                                                     const baum_planar_curve_def *def,
                                                     baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_curve(const baum_mechanism *mechanism,
                                                     baum_joint_id id, baum_planar_curve_def *out,
                                                     size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_curve()
 */
BAUM_API baum_status baum_mechanism_set_planar_curve(baum_mechanism *mechanism, baum_joint_id id,
                                                     const baum_planar_curve_def *def);

#ifdef __cplusplus
}
#endif

#endif
