/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Joints in space. spatial.h explains points and reactions.
 *
 *  Axes: `axis` is an axis of the joint that is fixed in body_a, and `axis_b` is the corresponding
 *  axis that is fixed in body_b. If `point` is given, both vectors are in ground axes and describe
 *  the design configuration. Otherwise `axis` is in the axes of body_a, and `axis_b` in the axes of
 *  body_b. By default, `axis_b` coincides with `axis` in the design configuration. The constraints
 *  would also be satisfied if the two axes pointed in opposite directions, but assembly refuses
 *  this.
 *
 *  Angles: a run counts the revolutions of the angles of joints. A workspace does not know the past
 *  of the motion and uses angles between -pi and pi.
 */
#ifndef BAUM_SPATIAL_JOINTS_H
#define BAUM_SPATIAL_JOINTS_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- spherical joint ------------------------------------------------------------------------- */

/** A ball joint (spherical joint): the points of both bodies coincide. The joint has three rows
 *  [m]. */
typedef struct baum_spatial_spherical_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
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
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (0, 0, 1). */
  double axis[3];
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_b.
   *  Default: NaN, the direction of `axis` in the design configuration. */
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
 *  perpendicular [-]. The axes must not be parallel in the design configuration. The coordinates of
 *  the joint are two angles [rad], which are both 0 in the design configuration: ANGLE is the angle
 *  of the cross relative to body_a about `axis`, and ANGLE_B is the angle of body_b relative to the
 *  cross about `axis_b`. */
typedef struct baum_spatial_universal_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (0, 0, 1). */
  double axis[3];
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_b.
   *  Default: NaN, must be set. */
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
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (0, 0, 1). */
  double axis[3];
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_b.
   *  Default: NaN, the direction of `axis` in the design configuration. */
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
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (0, 0, 1). */
  double axis[3];
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_b.
   *  Default: NaN, the direction of `axis` in the design configuration. */
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
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (0, 0, 1). */
  double axis[3];
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_b.
   *  Default: NaN, the direction of `axis` in the design configuration. */
  double axis_b[3];
  /** [-] direction of x, projected onto the plane; in ground axes if `point` is given, otherwise in
   *  the axes of body_a. Default: NaN, the direction of the ground x axis in the design
   *  configuration, or of the ground y axis if the normal is along x. */
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
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
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

/* ---- distance joint (massless rod) ----------------------------------------------------------- */

/** A massless rod between two points. The joint has one row [m], (d.d - length^2) / (2 length),
 *  where d is the vector from body_a's point to body_b's point. */
typedef struct baum_spatial_distance_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  double length;     /**< [m] > 0. Default: NaN, the distance in the design configuration. */
} baum_spatial_distance_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_distance_def_init(baum_spatial_distance_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_distance_def baum_spatial_distance_def_default(void)
{
  baum_spatial_distance_def def;
  baum_spatial_distance_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_distance(baum_mechanism *mechanism,
                                                         const baum_spatial_distance_def *def,
                                                         baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_distance(const baum_mechanism *mechanism,
                                                         baum_joint_id id,
                                                         baum_spatial_distance_def *out,
                                                         size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_distance(baum_mechanism *mechanism,
                                                         baum_joint_id id,
                                                         const baum_spatial_distance_def *def);

/* ---- point on a line ------------------------------------------------------------------------- */

/** A point of body_b stays on a line of body_a, which passes through body_a's point along the axis.
 *  The joint has two rows [m]. The coordinate of the joint is the displacement from body_a's point
 *  to body_b's point along the line [m]. body_b may be a particle. */
typedef struct baum_spatial_point_on_line_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (0, 0, 1). */
  double axis[3];
} baum_spatial_point_on_line_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_point_on_line_def_init(baum_spatial_point_on_line_def *def,
                                                  size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_point_on_line_def baum_spatial_point_on_line_def_default(void)
{
  baum_spatial_point_on_line_def def;
  baum_spatial_point_on_line_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_point_on_line(
  baum_mechanism *mechanism, const baum_spatial_point_on_line_def *def, baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_point_on_line(const baum_mechanism *mechanism,
                                                              baum_joint_id id,
                                                              baum_spatial_point_on_line_def *out,
                                                              size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_point_on_line(
  baum_mechanism *mechanism, baum_joint_id id, const baum_spatial_point_on_line_def *def);

/* ---- point on a plane ------------------------------------------------------------------------ */

/** A point of body_b stays in a plane of body_a. The plane contains body_a's point, and the axis is
 *  its normal. The joint has one row [m]. body_b may be a particle. */
typedef struct baum_spatial_point_on_plane_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] not zero; in ground axes if `point` is given, otherwise in the axes of body_a.
   *  Default: (0, 0, 1). */
  double axis[3];
} baum_spatial_point_on_plane_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_point_on_plane_def_init(baum_spatial_point_on_plane_def *def,
                                                   size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_point_on_plane_def baum_spatial_point_on_plane_def_default(void)
{
  baum_spatial_point_on_plane_def def;
  baum_spatial_point_on_plane_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_point_on_plane(
  baum_mechanism *mechanism, const baum_spatial_point_on_plane_def *def, baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_point_on_plane(const baum_mechanism *mechanism,
                                                               baum_joint_id id,
                                                               baum_spatial_point_on_plane_def *out,
                                                               size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_point_on_plane(
  baum_mechanism *mechanism, baum_joint_id id, const baum_spatial_point_on_plane_def *def);

/* ---- rolling disc ---------------------------------------------------------------------------- */

/** A disc, wheel or sphere of body_b rolls without slipping on a plane of body_a. The joint has
 *  three rows. The first is a constraint on positions: the height of the disc over the plane [m].
 *  The other two are rows of velocity level [m/s]: the velocities of the contact point in two
 *  directions of the plane. Rows of velocity level do not restrict positions. A mechanism with such
 *  rows therefore has more degrees of freedom of position than of velocity (see baum_mobility).
 *
 *  The rim has a circular cross-section with the radius rim_radius. If rim_radius is 0, the disc is
 *  thin; if it is equal to radius, the disc is a sphere. Contact is permanent: the normal force may
 *  also pull. A disc that is not a sphere must not lie flat on the plane. Both bodies must have an
 *  orientation. The reaction of the joint is the force and the moment on body_b at the contact
 *  point. The multipliers are the forces [N] on body_b along the normal and along the two
 *  directions, with the opposite sign. */
typedef struct baum_spatial_rolling_disc_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< The body with the plane; not body_b. Default: BAUM_GROUND. */
  baum_body_id body_b; /**< The body with the disc. Default: none, must be set. */
  double point_a[3];   /**< [m] point of the plane, in axes of body_a. Default: (0, 0, 0). */
  /** [-] normal of the plane towards the disc, in axes of body_a. Default: (0, 1, 0). */
  double normal[3];
  double centre[3];  /**< [m] of the disc, in axes of body_b. Default: (0, 0, 0). */
  double axis_b[3];  /**< [-] axis of the disc, in axes of body_b. Default: (0, 0, 1). */
  double radius;     /**< [m] > 0, largest radius. Default: 0, must be set. */
  double rim_radius; /**< [m] of the cross-section of the rim, from 0 to radius. Default: 0. */
} baum_spatial_rolling_disc_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_rolling_disc_def_init(baum_spatial_rolling_disc_def *def,
                                                 size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_rolling_disc_def baum_spatial_rolling_disc_def_default(void)
{
  baum_spatial_rolling_disc_def def;
  baum_spatial_rolling_disc_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_rolling_disc(
  baum_mechanism *mechanism, const baum_spatial_rolling_disc_def *def, baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_rolling_disc(const baum_mechanism *mechanism,
                                                             baum_joint_id id,
                                                             baum_spatial_rolling_disc_def *out,
                                                             size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_rolling_disc(
  baum_mechanism *mechanism, baum_joint_id id, const baum_spatial_rolling_disc_def *def);

/* ---- screw ----------------------------------------------------------------------------------- */

/** A screw joint: a cylindrical joint whose displacement is offset + pitch angle / (2 pi). Five
 *  rows: two for the directions of the axes [-], and three lengths [m]. The last row, which is that
 *  of the thread, is evaluated modulo the pitch, so it does not depend on the number of
 *  revolutions. Coordinates: displacement and angle, as for the cylindrical joint. */
typedef struct baum_spatial_screw_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set; must not be a particle. */
  /** Default: none, must be set; must differ from body_a and must not be a particle. */
  baum_body_id body_b;
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
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
 *  equal angular velocities about their axes, at any angle between the axes. Four rows: three for
 *  the points [m], and one for the rotation [-], which keeps the twist of body_b relative to body_a
 *  at 0. The angle between the axes must stay below 180 degrees. The derivatives of the fourth row
 *  are proportional to the cosine of half this angle, so the joint is ill-conditioned close to 180
 *  degrees. */
typedef struct baum_spatial_constant_velocity_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set; must not be a particle. */
  /** Default: none, must be set; must differ from body_a and must not be a particle. */
  baum_body_id body_b;
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [-] axis of the shaft body_a, with any length except 0; in ground axes if `point` is given,
   *  otherwise in the axes of body_a. Default: (0, 0, 1). */
  double axis[3];
  /** [-] axis of the shaft body_b; in ground axes if `point` is given, otherwise in the axes of
   *  body_b. Default: NaN, equal to axis in the design configuration. */
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
