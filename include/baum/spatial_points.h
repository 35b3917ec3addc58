/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Joints in space that guide a point of a body: rods, lines, planes, curves, blades and wheels.
 *  spatial.h explains points and reactions.
 */
#ifndef BAUM_SPATIAL_POINTS_H
#define BAUM_SPATIAL_POINTS_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- distance joint (massless rod) ----------------------------------------------------------- */

/** A massless rod between two points. The joint has one row [m], (d.d - length^2) / (2 length),
 *  where d is the vector from body_a's point to body_b's point. */
typedef struct baum_spatial_distance_def {
  size_t struct_size;  /**< Set by baum_spatial_distance_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] must not be given, because then both points would coincide. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
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
  size_t struct_size;  /**< Set by baum_spatial_point_on_line_def_default(). Do not change it. */
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
  size_t struct_size;  /**< Set by baum_spatial_point_on_plane_def_default(). Do not change it. */
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

/* ---- point on a curve ------------------------------------------------------------------------ */

/** A user function that describes a curve in space, the intersection of the surfaces F(x, y, z) = 0
 *  and G(x, y, z) = 0. The function computes F, G and their derivatives. The derivatives must be
 *  exact on the curve and near it. Scale F and G so that their gradients have lengths of about 1 on
 *  the curve. On the curve, the gradients must not be parallel.
 *  @param[in]  xyz   (3) [m] x, y and z of a point, in the axes of body_a, with body_a's point as
 *                    origin
 *  @param[out] out   (20) F [m]; F_x, F_y, F_z [-]; F_xx, F_xy, F_xz, F_yy, F_yz, F_zz [1/m]; and
 *                    then the same ten numbers of G; set to zero before the call
 *  @param      user  the definition's `user`
 *  @return  0 success, > 0 retry with a smaller step, < 0 stop */
typedef int baum_spatial_curve_fn(const double xyz[3], double out[20], void *user);

/** A point of body_b stays on a curve that is fixed in body_a, as a bead on a wire does. The curve
 *  is the intersection of the surfaces F(x, y, z) = 0 and G(x, y, z) = 0, and the field `curve` is
 *  the function that computes F and G. The joint has two rows, the values of F and G at body_b's
 *  point [m]. If a curve is given by a parameter u, such as the helix (r cos u, r sin u, c u),
 *  eliminate the parameter: F = x - r cos(z / c), G = y - r sin(z / c).
 *
 *  The coordinates x, y and z in F and G are relative to body_a's point and in the axes of body_a.
 *  body_a must have an orientation; body_b may be a particle. baum_mechanism_check_derivatives()
 *  compares the derivatives of F and G with finite differences. Integrators that need third
 *  derivatives compute them by finite differences of the second derivatives. */
typedef struct baum_spatial_curve_def {
  size_t struct_size;  /**< Set by baum_spatial_curve_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  baum_spatial_curve_fn
    *curve;   /**< The function that computes F and G. Default: NULL, must be set. */
  void *user; /**< Passed to curve. Not owned. Default: NULL. */
} baum_spatial_curve_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_curve_def_init(baum_spatial_curve_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_curve_def baum_spatial_curve_def_default(void)
{
  baum_spatial_curve_def def;
  baum_spatial_curve_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_curve(baum_mechanism *mechanism,
                                                      const baum_spatial_curve_def *def,
                                                      baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_curve(const baum_mechanism *mechanism,
                                                      baum_joint_id id, baum_spatial_curve_def *out,
                                                      size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_curve(baum_mechanism *mechanism, baum_joint_id id,
                                                      const baum_spatial_curve_def *def);

/* ---- rolling disc ---------------------------------------------------------------------------- */

/** A disc, wheel or sphere of body_b rolls without slipping on a plane of body_a. The joint has
 *  three rows. The first is a constraint on positions: the height of the lowest point of the disc
 *  over the plane [m]. The other two are rows of velocity level [m/s]: the velocities of the
 *  contact point in two directions of the plane. Rows of velocity level do not restrict positions.
 *  A mechanism with such rows therefore has more degrees of freedom of position than of velocity
 *  (see baum_mobility).
 *
 *  The rim has a circular cross-section with the radius rim_radius. If rim_radius is 0, the disc is
 *  thin; if it is equal to radius, the disc is a sphere. Contact is permanent: the normal force may
 *  also pull. A disc that is not a sphere must not lie flat on the plane. Both bodies must have an
 *  orientation. The reaction of the joint is the force and the moment on body_b at the contact
 *  point. The multipliers are the forces [N] on body_b along the normal and along the two
 *  directions, with the opposite sign. */
typedef struct baum_spatial_rolling_disc_def {
  size_t struct_size; /**< Set by baum_spatial_rolling_disc_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id
    body_a; /**< The body with the plane; must differ from body_b. Default: BAUM_GROUND. */
  baum_body_id body_b; /**< The body with the disc. Default: none, must be set. */
  double point_a[3];   /**< [m] a point in the plane, in axes of body_a. Default: (0, 0, 0). */
  /** [-] normal of the plane towards the disc, in axes of body_a. Default: (0, 1, 0). */
  double normal[3];
  double centre[3]; /**< [m] centre of the disc, in axes of body_b. Default: (0, 0, 0). */
  double axis_b[3]; /**< [-] axis of the disc, in axes of body_b. Default: (0, 0, 1). */
  double radius;    /**< [m] > 0, largest radius of the disc. Default: 0, must be set. */
  /** [m] radius of the circular cross-section of the rim: 0 for a thin disc, equal to `radius` for
   *  a sphere, or a value between them. Default: 0. */
  double rim_radius;
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

/* ---- knife edge ------------------------------------------------------------------------------ */

/** A point of body_a moves relative to body_b, but not along an axis that is fixed in body_a. An
 *  example is a skate: the point is where the blade touches the ice, and the axis is perpendicular
 *  to the sides of the blade. The joint has one row of velocity level [m/s], the velocity of this
 *  point relative to body_b along the axis. This row does not restrict positions. A mechanism with
 *  such a row therefore has more degrees of freedom of position than of velocity (see
 *  baum_mobility). The joint does not keep the point on a surface; add a point_on_plane or a
 *  spatial_planar joint for this purpose.
 *
 *  Note that the axis of the planar knife edge has the direction of the blade, whereas the axis of
 *  this joint is perpendicular to the blade. Both bodies must have an orientation. The reaction of
 *  the joint is the force and the moment on body_b at the point of body_a. */
typedef struct baum_spatial_knife_edge_def {
  size_t struct_size;  /**< Set by baum_spatial_knife_edge_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< The body with the blade. Default: none, must be set. */
  /** The body on which the blade slides; must differ from body_a. Default: BAUM_GROUND. */
  baum_body_id body_b;
  /** [m] point of the blade in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  /** [-] direction in which the point does not move, not zero; in ground axes if `point` is given,
   *  otherwise in the axes of body_a. Default: (0, 0, 1). */
  double axis[3];
} baum_spatial_knife_edge_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_knife_edge_def_init(baum_spatial_knife_edge_def *def,
                                               size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_knife_edge_def baum_spatial_knife_edge_def_default(void)
{
  baum_spatial_knife_edge_def def;
  baum_spatial_knife_edge_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_knife_edge(baum_mechanism *mechanism,
                                                           const baum_spatial_knife_edge_def *def,
                                                           baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_knife_edge(const baum_mechanism *mechanism,
                                                           baum_joint_id id,
                                                           baum_spatial_knife_edge_def *out,
                                                           size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_knife_edge(baum_mechanism *mechanism,
                                                           baum_joint_id id,
                                                           const baum_spatial_knife_edge_def *def);

#ifdef __cplusplus
}
#endif

#endif
