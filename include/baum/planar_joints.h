/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  More planar joints: pin in a slot, rack and pinion, gear, point on a curve, knife edge. planar.h
 *  explains coordinates, points and reactions.
 */
#ifndef BAUM_PLANAR_JOINTS_H
#define BAUM_PLANAR_JOINTS_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- pin in a slot (point on a line) --------------------------------------------------------- */

/** A pin of body_b in a straight slot of body_a; body_b may rotate about the pin. The axis of the
 *  slot passes through body_a's point. The joint has one row, the distance of body_b's point from
 *  this axis [m]. The coordinate of the joint is the displacement from body_a's point to body_b's
 *  point along the axis [m]. body_a must have an angle; body_b may be a particle. */
typedef struct baum_planar_pin_in_slot_def {
  size_t struct_size;  /**< Set by baum_planar_pin_in_slot_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[2];
  double point_a[2]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[2]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_a. Default: (1, 0). */
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

/** Rack and pinion: a pinion that is part of body_b rolls without slipping on a rack that is part
 *  of body_a. The axis is the direction of the rack, and body_b's point is the centre of the
 *  pinion. The joint has one row [m]: displacement - radius (angle_b - angle_a) - offset. The
 *  displacement is measured from body_a's point to body_b's point along the axis.
 *
 *  The row only enforces that the pinion rolls. Another joint, such as a pin in a slot, must keep
 *  the centre of the pinion at a constant distance from the rack. A pinion with a positive radius
 *  moves forward along the axis when it rotates counter-clockwise. Its rack is then to the left of
 *  the pinion, seen in the direction of the axis. With a negative radius, the rack is to the right
 *  of the pinion; for the axis (1, 0), the rack is below the pinion. Both bodies must have an
 *  angle. */
typedef struct baum_planar_rack_and_pinion_def {
  size_t struct_size;  /**< Set by baum_planar_rack_and_pinion_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[2];
  double point_a[2]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[2]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_a. Default: (1, 0). */
  double axis[2];
  /** [m] radius of the pitch circle, not 0. Positive if the rack is to the left of the pinion, seen
   *  in the direction of the axis, and negative if it is to the right. Default: 0, must be set. */
  double radius;
  /** [m] the offset in the row of the joint. Default: NaN, the value that satisfies the row in the
   *  design configuration. */
  double offset;
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

/** A pair of gears: two wheels, body_a and body_b, roll on each other without slipping. A third
 *  body, the carrier, carries both wheels. The joint has one row [m],
 *  radius_a (angle_a - angle_c) + radius_b (angle_b - angle_c) - offset, where angle_c is the angle
 *  of the carrier.
 *
 *  If both radii are positive, both wheels have external teeth and rotate in opposite directions
 *  relative to the carrier. If the radius of one wheel is negative, this wheel is a ring with
 *  internal teeth, and both wheels rotate in the same direction. The motion depends only on the
 *  ratio of the radii, so you may give numbers of teeth instead of radii. Other joints, such as
 *  pins, must keep the wheels on the carrier. A planetary gear consists of two of these joints, one
 *  between sun and planet and one between planet and ring. In both joints, the carrier is the arm
 *  that carries the planets. If the ring does not move, give BAUM_GROUND as the ring. All bodies
 *  must have an angle.
 *
 *  The reaction of a gear pair is the generalized force -J^T lambda of its row, with one number for
 *  each velocity of body_a, body_b and the carrier; ground is omitted. It contains only torques:
 *  its force components are zero, because the row contains only angles. */
typedef struct baum_planar_gear_def {
  size_t struct_size;  /**< Set by baum_planar_gear_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** The body that carries both wheels; neither body_a nor body_b. Default: BAUM_GROUND. */
  baum_body_id carrier;
  /** [m] radius of the pitch circle, not 0; negative for internal teeth. Default: 0, must be
   *  set. */
  double radius_a;
  /** [m] radius of the pitch circle, not 0; negative for internal teeth. Default: 0, must be
   *  set. */
  double radius_b;
  /** [m] the offset in the row of the joint. Default: NaN, the value that satisfies the row in the
   *  design configuration. */
  double offset;
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

/** A function that describes a curve F(x, y) = 0: it computes F and the derivatives of F. The
 *  derivatives must be exact on the curve and near it. Scale F so that |grad F| is about 1 on the
 *  curve. Near the curve, F is then approximately the distance from the curve, so that the
 *  tolerances of a run bound this distance.
 *  @param[in]  xy    (2) [m] x and y of a point, in the axes of body_a, with body_a's point as
 *                    origin
 *  @param[out] out   (6) F [m], its first derivatives F_x, F_y [-] and its second derivatives F_xx,
 *                    F_xy, F_yy [1/m]; set to zero before the call
 *  @param      user  the definition's `user`
 *  @return  0 success, > 0 retry with a smaller step, < 0 stop */
typedef int baum_curve_fn(const double xy[2], double out[6], void *user);

/** A point of body_b stays on a curve that is fixed in body_a. Examples are a cam with a pointed
 *  follower, and a bead on a wire. The equation of the curve is F(x, y) = 0, and the field `curve`
 *  is the function that computes F. The joint has one row, the value of F at body_b's point [m]. If
 *  the follower is a roller, give the curve on which the centre of the roller moves. If you know
 *  the lift of a cam as a function of its angle, use a coupling with a law instead (mechanism.h).
 *
 *  The coordinates x and y in F are relative to body_a's point and in the axes of body_a. body_a
 *  must have an angle; body_b may be a particle. baum_mechanism_check_derivatives() compares the
 *  derivatives of F with finite differences. Integrators that need third derivatives compute them
 *  by finite differences of the second derivatives. */
typedef struct baum_planar_curve_def {
  size_t struct_size;  /**< Set by baum_planar_curve_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[2];
  double point_a[2];    /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[2];    /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  baum_curve_fn *curve; /**< The function that computes F. Default: NULL, must be set. */
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

/** A blade that is fixed in body_a slides on body_b, but not sideways. Examples are a skate, and a
 *  wheel seen from above. The blade touches body_b at one point, which moves relative to body_b
 *  only in the direction of the blade. The joint has one row of velocity level [m/s]: the component
 *  across the blade of the velocity of this point relative to body_b, positive to the left of
 *  `axis`. This row does not restrict positions. A mechanism with such a row therefore has more
 *  degrees of freedom of position than of velocity (see baum_mobility).
 *
 *  Both bodies must have an angle. The reaction of the joint is the force and the moment on body_b
 *  at the point where the blade touches it. */
typedef struct baum_planar_knife_edge_def {
  size_t struct_size;  /**< Set by baum_planar_knife_edge_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< The body with the blade. Default: none, must be set. */
  /** The body on which the blade slides; must differ from body_a. Default: BAUM_GROUND. */
  baum_body_id body_b;
  /** [m] point of the blade in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[2];
  double point_a[2]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  /** [-] direction of the blade, not zero; in ground axes if `point` is given, otherwise in the
   *  axes of body_a. Default: (1, 0). */
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
