/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Joints in space that connect points, axes or orientations of two bodies. Joints that guide only
 *  a point of a body are in spatial_points.h, which this header includes. spatial.h explains points
 *  and reactions.
 *
 *  Axes: `axis` is an axis of the joint that is fixed in body_a, and `axis_b` is an axis of the
 *  joint that is fixed in body_b. If `point` is given, both vectors are in ground axes and describe
 *  the design configuration. Otherwise `axis` is in the axes of body_a, and `axis_b` in the axes of
 *  body_b. A universal joint keeps the two axes perpendicular, and always needs `axis_b`. For every
 *  other joint, `axis_b` coincides by default with `axis` in the design configuration. The
 *  constraints of joints with parallel axes would also be satisfied if the two axes pointed in
 *  opposite directions, but assembly refuses this.
 *
 *  Angles: a run counts the revolutions of the angles of joints. A workspace does not know the past
 *  of the motion and uses angles between -pi and pi, unless baum_workspace_set_angle() has chosen
 *  other revolutions.
 */
#ifndef BAUM_SPATIAL_JOINTS_H
#define BAUM_SPATIAL_JOINTS_H

#include <baum/mechanism.h>
#include <baum/spatial_points.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- spherical joint ------------------------------------------------------------------------- */

/** A ball joint (spherical joint): the points of both bodies coincide. The joint has three rows
 *  [m]. */
typedef struct baum_spatial_spherical_def {
  size_t struct_size;  /**< Set by baum_spatial_spherical_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
} baum_spatial_spherical_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_spherical_def_init(baum_spatial_spherical_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_spherical_def baum_spatial_spherical_def_default(void)
{
  baum_spatial_spherical_def def;
  baum_spatial_spherical_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_spherical(baum_mechanism *mechanism,
                                                          const baum_spatial_spherical_def *def,
                                                          baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_spherical(const baum_mechanism *mechanism,
                                                          baum_joint_id id,
                                                          baum_spatial_spherical_def *out,
                                                          size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_spherical(baum_mechanism *mechanism,
                                                          baum_joint_id id,
                                                          const baum_spatial_spherical_def *def);

/* ---- revolute joint -------------------------------------------------------------------------- */

/** A hinge (revolute joint): body_b rotates about an axis of body_a. The joint has five rows: three
 *  make the points of both bodies coincide [m], and two make the axes of both bodies parallel [-].
 *  The coordinate of the joint is the angle of body_b relative to body_a about the axis [rad]. It
 *  is 0 in the design configuration. */
typedef struct baum_spatial_revolute_def {
  size_t struct_size;  /**< Set by baum_spatial_revolute_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_a. Default: (0, 0, 1). */
  double axis[3];
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_b. Default: NaN, the direction of `axis` in the design configuration. */
  double axis_b[3];
} baum_spatial_revolute_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_revolute_def_init(baum_spatial_revolute_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_revolute_def baum_spatial_revolute_def_default(void)
{
  baum_spatial_revolute_def def;
  baum_spatial_revolute_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_revolute(baum_mechanism *mechanism,
                                                         const baum_spatial_revolute_def *def,
                                                         baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_revolute(const baum_mechanism *mechanism,
                                                         baum_joint_id id,
                                                         baum_spatial_revolute_def *out,
                                                         size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_revolute(baum_mechanism *mechanism,
                                                         baum_joint_id id,
                                                         const baum_spatial_revolute_def *def);

/* ---- universal joint ------------------------------------------------------------------------- */

/** A universal joint (Hooke's joint): a cross connects the bodies. The cross rotates relative to
 *  body_a about `axis`, and body_b rotates relative to the cross about `axis_b`. The joint has four
 *  rows: three make the points of both bodies coincide [m], and one keeps the two axes
 *  perpendicular [-]. If the axes are not perpendicular in the design configuration, assembly
 *  rotates the bodies; parallel axes are refused. The coordinates of the joint are two angles
 *  [rad], which are both 0 in the design configuration: BAUM_COORDINATE_ANGLE is the angle of the
 *  cross relative to body_a about `axis`, and BAUM_COORDINATE_ANGLE_B is the angle of body_b
 *  relative to the cross about `axis_b`. */
typedef struct baum_spatial_universal_def {
  size_t struct_size;  /**< Set by baum_spatial_universal_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_a. Default: (0, 0, 1). */
  double axis[3];
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_b. Default: NaN, must be set. */
  double axis_b[3];
} baum_spatial_universal_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_universal_def_init(baum_spatial_universal_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_universal_def baum_spatial_universal_def_default(void)
{
  baum_spatial_universal_def def;
  baum_spatial_universal_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_universal(baum_mechanism *mechanism,
                                                          const baum_spatial_universal_def *def,
                                                          baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_universal(const baum_mechanism *mechanism,
                                                          baum_joint_id id,
                                                          baum_spatial_universal_def *out,
                                                          size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_universal(baum_mechanism *mechanism,
                                                          baum_joint_id id,
                                                          const baum_spatial_universal_def *def);

/* ---- cylindrical joint ----------------------------------------------------------------------- */

/** A cylindrical joint: body_b slides along an axis of body_a and rotates about this axis. The
 *  joint has four rows: two make the axes of both bodies parallel [-], and two keep body_b's point
 *  on the line through body_a's point along the axis [m]. The coordinates of the joint are the
 *  displacement from body_a's point to body_b's point along the axis [m], and the angle about the
 *  axis [rad]. The angle is 0 in the design configuration. */
typedef struct baum_spatial_cylindrical_def {
  size_t struct_size;  /**< Set by baum_spatial_cylindrical_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_a. Default: (0, 0, 1). */
  double axis[3];
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_b. Default: NaN, the direction of `axis` in the design configuration. */
  double axis_b[3];
} baum_spatial_cylindrical_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_cylindrical_def_init(baum_spatial_cylindrical_def *def,
                                                size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_cylindrical_def baum_spatial_cylindrical_def_default(void)
{
  baum_spatial_cylindrical_def def;
  baum_spatial_cylindrical_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_cylindrical(baum_mechanism *mechanism,
                                                            const baum_spatial_cylindrical_def *def,
                                                            baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_cylindrical(const baum_mechanism *mechanism,
                                                            baum_joint_id id,
                                                            baum_spatial_cylindrical_def *out,
                                                            size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_cylindrical(
  baum_mechanism *mechanism, baum_joint_id id, const baum_spatial_cylindrical_def *def);

/* ---- prismatic joint ------------------------------------------------------------------------- */

/** A prismatic joint: body_b slides along an axis of body_a and does not rotate relative to body_a.
 *  The joint has five rows: two make the axes of both bodies parallel [-], two keep body_b's point
 *  on the line through body_a's point along the axis [m], and one prevents a rotation about the
 *  axis [-]. The coordinate of the joint is the displacement from body_a's point to body_b's point
 *  along the axis [m]. */
typedef struct baum_spatial_prismatic_def {
  size_t struct_size;  /**< Set by baum_spatial_prismatic_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_a. Default: (0, 0, 1). */
  double axis[3];
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_b. Default: NaN, the direction of `axis` in the design configuration. */
  double axis_b[3];
} baum_spatial_prismatic_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_prismatic_def_init(baum_spatial_prismatic_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_prismatic_def baum_spatial_prismatic_def_default(void)
{
  baum_spatial_prismatic_def def;
  baum_spatial_prismatic_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_prismatic(baum_mechanism *mechanism,
                                                          const baum_spatial_prismatic_def *def,
                                                          baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_prismatic(const baum_mechanism *mechanism,
                                                          baum_joint_id id,
                                                          baum_spatial_prismatic_def *out,
                                                          size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_prismatic(baum_mechanism *mechanism,
                                                          baum_joint_id id,
                                                          const baum_spatial_prismatic_def *def);

/* ---- planar joint ---------------------------------------------------------------------------- */

/** A planar joint: body_b moves in a plane of body_a. The axis is the normal of the plane. The
 *  joint has three rows: two make the normals of both bodies parallel [-], and one keeps body_b's
 *  point in the plane [m]. The coordinates of the joint are the displacements x and y from body_a's
 *  point to body_b's point in the plane [m], and the angle about the normal [rad]. The angle is 0
 *  in the design configuration. The direction of y is the cross product of the normal and the
 *  direction of x. */
typedef struct baum_spatial_planar_def {
  size_t struct_size;  /**< Set by baum_spatial_planar_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_a. Default: (0, 0, 1). */
  double axis[3];
  /** [-] direction, not zero; in ground axes if `point` is given, otherwise in the axes of
   *  body_b. Default: NaN, the direction of `axis` in the design configuration. */
  double axis_b[3];
  /** [-] direction of the coordinate x, projected onto the plane; in ground axes if `point` is
   *  given, otherwise in the axes of body_a. Default: NaN, the direction of the ground x axis in
   *  the design configuration, or that of the ground y axis if the normal is along the ground x
   *  axis. */
  double x_axis[3];
} baum_spatial_planar_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_planar_def_init(baum_spatial_planar_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_planar_def baum_spatial_planar_def_default(void)
{
  baum_spatial_planar_def def;
  baum_spatial_planar_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_planar(baum_mechanism *mechanism,
                                                       const baum_spatial_planar_def *def,
                                                       baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_planar(const baum_mechanism *mechanism,
                                                       baum_joint_id id,
                                                       baum_spatial_planar_def *out,
                                                       size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_planar(baum_mechanism *mechanism, baum_joint_id id,
                                                       const baum_spatial_planar_def *def);

/* ---- fixed joint (weld) ---------------------------------------------------------------------- */

/** A weld (fixed joint): the points of both bodies coincide, and the bodies keep the relative
 *  orientation of the design configuration. The joint has six rows: three for the points [m] and
 *  three for the orientation [-]. */
typedef struct baum_spatial_fixed_def {
  size_t struct_size;  /**< Set by baum_spatial_fixed_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
} baum_spatial_fixed_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_fixed_def_init(baum_spatial_fixed_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_fixed_def baum_spatial_fixed_def_default(void)
{
  baum_spatial_fixed_def def;
  baum_spatial_fixed_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_fixed(baum_mechanism *mechanism,
                                                      const baum_spatial_fixed_def *def,
                                                      baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_fixed(const baum_mechanism *mechanism,
                                                      baum_joint_id id, baum_spatial_fixed_def *out,
                                                      size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_fixed(baum_mechanism *mechanism, baum_joint_id id,
                                                      const baum_spatial_fixed_def *def);

/* ---- screw ----------------------------------------------------------------------------------- */

/** A screw joint: a cylindrical joint whose displacement is offset + pitch * angle / (2 pi). The
 *  joint has five rows: two make the axes of both bodies parallel [-], two keep body_b's point on
 *  the line through body_a's point along the axis [m], and the last describes the thread [m]. This
 *  last row is evaluated modulo the pitch, so it does not depend on the number of revolutions. The
 *  coordinates of the joint are displacement and angle, as for the cylindrical joint. */
typedef struct baum_spatial_screw_def {
  size_t struct_size;  /**< Set by baum_spatial_screw_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set; must not be a particle. */
  /** Default: none, must be set; must differ from body_a and must not be a particle. */
  baum_body_id body_b;
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] axis, with any length except 0; in ground axes if `point` is given, otherwise in the axes
   *  of body_a. Default: (0, 0, 1). */
  double axis[3];
  /** [-] the axis on body_b; in ground axes if `point` is given, otherwise in the axes of body_b.
   *  Default: NaN, equal to axis in the design configuration. */
  double axis_b[3];
  /** [m] not 0. Displacement of body_b per revolution; positive for a right-handed thread.
   *  Default: 0, must be set. */
  double pitch;
  /** [m] displacement at which the angle is 0. Default: NaN, the value in the design
   *  configuration. */
  double offset;
} baum_spatial_screw_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_screw_def_init(baum_spatial_screw_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_screw_def baum_spatial_screw_def_default(void)
{
  baum_spatial_screw_def def;
  baum_spatial_screw_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_screw(baum_mechanism *mechanism,
                                                      const baum_spatial_screw_def *def,
                                                      baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_screw(const baum_mechanism *mechanism,
                                                      baum_joint_id id, baum_spatial_screw_def *out,
                                                      size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_screw(baum_mechanism *mechanism, baum_joint_id id,
                                                      const baum_spatial_screw_def *def);

/* ---- constant-velocity joint ----------------------------------------------------------------- */

/** A constant-velocity joint, such as a Rzeppa joint: two shafts meet at a point and rotate with
 *  equal angular velocities about their axes, at any angle between the axes. The joint has four
 *  rows: three make the points of both bodies coincide [m], and one [-] keeps the twist of body_b
 *  relative to body_a (their relative rotation about the shaft axes) at 0. The multiplier of the
 *  fourth row is the moment about the bisector of the axes. A motion may pass 180 degrees, where
 *  the axes point in opposite directions; the direction of the bisector is continuous there. */
typedef struct baum_spatial_constant_velocity_def {
  size_t struct_size; /**< Set by baum_spatial_constant_velocity_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set; must not be a particle. */
  /** Default: none, must be set; must differ from body_a and must not be a particle. */
  baum_body_id body_b;
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] axis of the first shaft, which is fixed in body_a. The vector may have any length except
   *  0. It is in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (0, 0, 1). */
  double axis[3];
  /** [-] axis of the second shaft, which is fixed in body_b; in ground axes if `point` is given,
   *  otherwise in the axes of body_b. Default: NaN, equal to axis in the design configuration. */
  double axis_b[3];
} baum_spatial_constant_velocity_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_constant_velocity_def_init(baum_spatial_constant_velocity_def *def,
                                                      size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_constant_velocity_def baum_spatial_constant_velocity_def_default(void)
{
  baum_spatial_constant_velocity_def def;
  baum_spatial_constant_velocity_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_constant_velocity(
  baum_mechanism *mechanism, const baum_spatial_constant_velocity_def *def, baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_constant_velocity(
  const baum_mechanism *mechanism, baum_joint_id id, baum_spatial_constant_velocity_def *out,
  size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_constant_velocity(
  baum_mechanism *mechanism, baum_joint_id id, const baum_spatial_constant_velocity_def *def);

#ifdef __cplusplus
}
#endif

#endif
