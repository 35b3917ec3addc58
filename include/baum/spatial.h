/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Bodies and forces in space.
 *
 *  Coordinates: axes are right-handed. A spatial body has seven positions. The first three are its
 *  centre of mass r in ground axes. The other four are a unit quaternion p (Hamilton's convention,
 *  w first), which rotates vectors from body axes into ground axes. A spatial body has six
 *  velocities: the velocity r' of its centre of mass in ground axes, and its angular velocity in
 *  body axes. A particle has three positions and three velocities.
 *
 *  Points: as in planar.h, the place of a joint or a spring is given either by `point` in ground
 *  axes, or by `point_a` and `point_b` in the axes of the bodies. Spatial joints and springs may
 *  also connect planar bodies and planar particles, which stay in the plane z = 0.
 *
 *  Reaction of a joint: the force [N] and the moment [N m] that the joint exerts on body_b, in
 *  ground axes. The moment is about the joint's point on body_b. If a driver acts on the joint, the
 *  reaction does not include the force or torque of the driver. If a body is planar, the reaction
 *  includes a force perpendicular to the plane z = 0 and moments about x and y. These parts do not
 *  move the body, which stays in this plane.
 */
#ifndef BAUM_SPATIAL_H
#define BAUM_SPATIAL_H

#include <baum/mechanism.h>
#include <baum/planar.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- rigid body in space --------------------------------------------------------------------- */

/** A rigid body in space. The origin of its body axes is the centre of mass. */
typedef struct baum_spatial_body_def {
  size_t struct_size; /**< Set by baum_spatial_body_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;        /**< [kg] > 0. Default: 1. */
  /** [kg m^2] inertia tensor about the centre of mass in body axes, in the order xx, yy, zz, xy,
   *  xz, yz. The last three have the sign of the tensor: xy = - integral of x y dm. The principal
   *  moments must be >= 0, and none may exceed the sum of the two others. One of them may be 0, as
   *  for a slender rod. If a principal moment is less than 1e-10 times the largest one, the library
   *  uses 1e-10 times the largest one instead. Default: (1, 1, 1, 0, 0, 0). */
  double inertia[6];
  /** [m] position of the centre of mass in the design configuration. Default: (0, 0, 0). */
  double position[3];
  /** [-] unit quaternion w, x, y, z in the design configuration; its norm may differ from 1 by at
   *  most 1e-6. Default: (1, 0, 0, 0). */
  double orientation[4];
  /** [m/s] velocity of the centre of mass at the start, in ground axes. Default: NaN, assembly
   *  determines it. */
  double velocity[3];
  /** [rad/s] angular velocity at the start, in body axes. Default: NaN, assembly determines it. */
  double angular_velocity[3];
  bool held; /**< True if assembly must not move the body. Default: false. */
} baum_spatial_body_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_body_def_init(baum_spatial_body_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_body_def baum_spatial_body_def_default(void)
{
  baum_spatial_body_def def;
  baum_spatial_body_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_body(baum_mechanism *mechanism,
                                                     const baum_spatial_body_def *def,
                                                     baum_body_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_body(const baum_mechanism *mechanism,
                                                     baum_body_id id, baum_spatial_body_def *out,
                                                     size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_body(baum_mechanism *mechanism, baum_body_id id,
                                                     const baum_spatial_body_def *def);

/* ---- particle in space ----------------------------------------------------------------------- */

/** A point mass in space. */
typedef struct baum_spatial_particle_def {
  size_t struct_size; /**< Set by baum_spatial_particle_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;        /**< [kg] > 0. Default: 1. */
  double position[3]; /**< [m] position in the design configuration. Default: (0, 0, 0). */
  double velocity[3]; /**< [m/s] velocity at the start. Default: NaN, assembly determines it. */
  bool held;          /**< True if assembly must not move the body. Default: false. */
} baum_spatial_particle_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_particle_def_init(baum_spatial_particle_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_particle_def baum_spatial_particle_def_default(void)
{
  baum_spatial_particle_def def;
  baum_spatial_particle_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_particle(baum_mechanism *mechanism,
                                                         const baum_spatial_particle_def *def,
                                                         baum_body_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_particle(const baum_mechanism *mechanism,
                                                         baum_body_id id,
                                                         baum_spatial_particle_def *out,
                                                         size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_particle(baum_mechanism *mechanism, baum_body_id id,
                                                         const baum_spatial_particle_def *def);

/* ---- spring and damper ----------------------------------------------------------------------- */

/** A linear spring and damper in parallel between two points, or a law of your own. The tension is
 *  stiffness (length - free_length) + damping (d/dt length); a positive tension pulls the points
 *  together. The force is zero when the points coincide. */
typedef struct baum_spatial_spring_def {
  size_t struct_size;  /**< Set by baum_spatial_spring_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] must not be given, because then both points would coincide. Default: NaN, not given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  double stiffness;  /**< [N/m] >= 0. Default: 0. */
  double damping;    /**< [N s/m] >= 0. Default: 0. */
  /** [m] >= 0, length at which the spring exerts no force. Default: NaN, the value in the design
   *  configuration. */
  double free_length;
  /** A law that replaces stiffness, damping and free_length, which must then have their defaults;
   *  the spring then has no potential energy. Default: NULL. */
  baum_spring_fn *law;
  void *user; /**< Passed to law. Not owned. Default: NULL. */
  /** True if law reads its argument `rate`, the time derivative of the length. RATTLE requires
   *  false. Default: true. */
  bool depends_on_velocity;
} baum_spatial_spring_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_spring_def_init(baum_spatial_spring_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_spring_def baum_spatial_spring_def_default(void)
{
  baum_spatial_spring_def def;
  baum_spatial_spring_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_spring(baum_mechanism *mechanism,
                                                       const baum_spatial_spring_def *def,
                                                       baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_spring(const baum_mechanism *mechanism,
                                                       baum_force_id id,
                                                       baum_spatial_spring_def *out,
                                                       size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_spring(baum_mechanism *mechanism, baum_force_id id,
                                                       const baum_spatial_spring_def *def);

/* ---- cable ----------------------------------------------------------------------------------- */

/** A cable, rope or tendon without mass or friction. It runs along straight lines through points
 *  that are fixed in bodies, and slides freely through all of them except the first and the last.
 *  Its length is the sum of the distances between consecutive points. The cable only pulls. With
 *  the stretch s = length - free_length, the tension of the cable is
 *
 *    stiffness s + damping w(s / transition) (d/dt length)   if s > 0 and this sum is positive,
 *
 *  and 0 otherwise. The factor w(x) = x^2 (3 - 2 x) grows from 0 at x = 0 to 1 at x = 1, and w(x) =
 *  1 for x > 1. The tension is therefore continuous when the cable becomes taut or slack. The
 *  potential energy is stiffness s^2 / 2 for s > 0. The damper dissipates that part of the power of
 *  the tension which does not change the potential energy.
 *
 *  Consecutive points may belong to the same body, and points of ground are allowed. Between two
 *  points that coincide the cable has no direction: it exerts no force there, and pulls only along
 *  its other parts. If two consecutive points pass through each other, the force jumps. The bodies
 *  of the points may also be planar bodies and planar particles, which stay in the plane z = 0. */
typedef struct baum_spatial_cable_def {
  size_t struct_size; /**< Set by baum_spatial_cable_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "force<k>". */
  /** (point_count) the body of each point, in the order of the path. Copied. Default: NULL, must be
   *  set. */
  const baum_body_id *bodies;
  /** (point_count x 3) [m] points, each in the axes of its body. Copied. Default: NULL, must be
   *  set. */
  const double *points;
  int32_t point_count; /**< Number of points, at least 2. Default: 0, must be set. */
  double stiffness;    /**< [N/m] >= 0. Default: 0. */
  double damping;      /**< [N s/m] >= 0. Default: 0. */
  /** [m] >= 0, length up to which the cable is slack. Default: NaN, the value in the design
   *  configuration. */
  double free_length;
  /** A law that computes the tension [N]. It replaces stiffness, damping, free_length and
   *  transition, which must then have their defaults. A cable with a law has no potential energy.
   *  The law must return 0 where the cable is slack. Default: NULL. */
  baum_spring_fn *law;
  void *user; /**< Passed to law. Not owned. Default: NULL. */
  /** True if law reads its argument `rate`, the time derivative of the length. RATTLE requires
   *  false. Default: true. */
  bool depends_on_velocity;
  /** [m] >= 0, stretch s at which the damper reaches its full strength (w = 1). Default: NaN, 1e-4
   *  times free_length. */
  double transition;
} baum_spatial_cable_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_cable_def_init(baum_spatial_cable_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_cable_def baum_spatial_cable_def_default(void)
{
  baum_spatial_cable_def def;
  baum_spatial_cable_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_cable(baum_mechanism *mechanism,
                                                      const baum_spatial_cable_def *def,
                                                      baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_cable(const baum_mechanism *mechanism,
                                                      baum_force_id id, baum_spatial_cable_def *out,
                                                      size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_cable(baum_mechanism *mechanism, baum_force_id id,
                                                      const baum_spatial_cable_def *def);

/* ---- torsion spring -------------------------------------------------------------------------- */

/** A torsion spring and damper in parallel, which act between two bodies about an axis. A law of
 *  your own may replace both. The restoring torque is stiffness (angle - free_angle) + damping
 *  (d/dt angle). A positive torque acts on body_b in the direction in which the angle decreases.
 *
 *  The angle is the twist of body_b relative to body_a about the axis, as in the swing-twist
 *  decomposition. It is defined as follows: apply to body_b the smallest rotation that makes axis_b
 *  parallel to axis. Then only a rotation about the axis remains between the bodies, and the angle
 *  of the spring is the angle of this rotation. The angle is 0 in the design configuration. During
 *  a run, the angle is continuous over several revolutions. The bodies need not be connected by a
 *  joint. If the spring should act on a coordinate of a joint, use a joint spring instead. If axis
 *  and axis_b point in opposite directions, the angle is undefined and the torque is zero. Close to
 *  this configuration, a small rotation may change the angle by up to 2 pi. If the steps of a run
 *  are too long to follow this change of the angle, the run warns with BAUM_WARNING_BUSHING. */
typedef struct baum_spatial_torsion_spring_def {
  size_t struct_size;  /**< Set by baum_spatial_torsion_spring_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set; must not be a particle. */
  /** Default: none, must be set; must differ from body_a and must not be a particle. */
  baum_body_id body_b;
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] axis, with any length except 0; in ground axes if point is given, otherwise in the axes
   *  of body_a. Default: (0, 0, 1). */
  double axis[3];
  /** [-] the axis on body_b; in ground axes if point is given, otherwise in the axes of body_b.
   *  Default: NaN, equal to axis in the design configuration. */
  double axis_b[3];
  double stiffness; /**< [N m/rad] >= 0. Default: 0. */
  double damping;   /**< [N m s/rad] >= 0. Default: 0. */
  /** [rad] angle at which the spring exerts no torque. Default: NaN, which means 0. */
  double free_angle;
  /** A law that computes the torque [N m]. It replaces stiffness, damping and free_angle, which
   *  must then have their defaults. Default: NULL. */
  baum_spring_fn *law;
  void *user; /**< Passed to law. Not owned. Default: NULL. */
  /** True if law reads its argument `rate`, the time derivative of the angle. RATTLE requires
   *  false. Default: true. */
  bool depends_on_velocity;
} baum_spatial_torsion_spring_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_torsion_spring_def_init(baum_spatial_torsion_spring_def *def,
                                                   size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_torsion_spring_def baum_spatial_torsion_spring_def_default(void)
{
  baum_spatial_torsion_spring_def def;
  baum_spatial_torsion_spring_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_torsion_spring(
  baum_mechanism *mechanism, const baum_spatial_torsion_spring_def *def, baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_torsion_spring(const baum_mechanism *mechanism,
                                                               baum_force_id id,
                                                               baum_spatial_torsion_spring_def *out,
                                                               size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_torsion_spring(
  baum_mechanism *mechanism, baum_force_id id, const baum_spatial_torsion_spring_def *def);

/* ---- bushing --------------------------------------------------------------------------------- */

/** An elastic connection of two bodies with stiffness and damping in all six directions. The force
 *  and the moment depend on the six numbers x = (d, theta) and on x'. Both x and x' are given in
 *  the axes of the bushing on body_a:
 *
 *  - d is the vector from body_a's point to body_b's point [m];
 *  - theta is the rotation vector of body_b relative to body_a [rad]. Its direction is the axis of
 *    the rotation, and its length is the angle. theta is 0 in the design configuration, unless the
 *    fields axis and axis_b have different directions there. The angle must stay below pi, because
 *    theta and the moment jump at pi. If the angle passes pi in a run, the run warns with
 *    BAUM_WARNING_BUSHING.
 *
 *  The potential energy is x^T stiffness x / 2, and the dissipated power is x'^T damping x'. */
typedef struct baum_spatial_bushing_def {
  size_t struct_size;  /**< Set by baum_spatial_bushing_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set; must not be a particle. */
  /** Default: none, must be set; must differ from body_a and must not be a particle. */
  baum_body_id body_b;
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[3];
  double point_a[3]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[3]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [-] the z axis of the bushing, with any length except 0; in ground axes if point is given,
   *  otherwise in the axes of body_a. Default: (0, 0, 1). */
  double axis[3];
  /** [-] the z axis on body_b; in ground axes if point is given, otherwise in the axes of body_b.
   *  Default: NaN, equal to axis in the design configuration. */
  double axis_b[3];
  /** [-] the x axis of the bushing, which is made perpendicular to axis; in ground axes if point is
   *  given, otherwise in the axes of body_a. Default: NaN, the ground x axis, or the ground y axis
   *  if axis is along the ground x axis. */
  double x_axis[3];
  /** [N/m, N or N m/rad] 6 x 6 matrix, row-major, symmetric and positive semidefinite.
   *  Default: all 0. */
  double stiffness[36];
  /** [N s/m, N s or N m s/rad] 6 x 6 matrix, with the same properties as stiffness. Default: all 0.
   */
  double damping[36];
} baum_spatial_bushing_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_bushing_def_init(baum_spatial_bushing_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_bushing_def baum_spatial_bushing_def_default(void)
{
  baum_spatial_bushing_def def;
  baum_spatial_bushing_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_bushing(baum_mechanism *mechanism,
                                                        const baum_spatial_bushing_def *def,
                                                        baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_bushing(const baum_mechanism *mechanism,
                                                        baum_force_id id,
                                                        baum_spatial_bushing_def *out,
                                                        size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_bushing(baum_mechanism *mechanism, baum_force_id id,
                                                        const baum_spatial_bushing_def *def);

/* ---- load ------------------------------------------------------------------------------------ */

/** A force at a point of a body, and a moment on the body. If `input` names an input, the value of
 *  this input multiplies the force and the moment. */
typedef struct baum_spatial_load_def {
  size_t struct_size; /**< Set by baum_spatial_load_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body;  /**< Default: none, must be set; must not be ground. */
  double point[3];    /**< [m] where the force acts, in body axes. Default: (0, 0, 0). */
  /** [N] the force in ground axes, or in body axes if `follows_body` is true. Default: (0, 0, 0).
   */
  double force[3];
  /** [N m] the moment in ground axes, or in body axes if `follows_body` is true; must be zero on a
   *  particle. Default: (0, 0, 0). */
  double moment[3];
  /** An input whose value multiplies force and moment. Default: none. */
  baum_input_id input;
  /** True if force and moment are in body axes and rotate with the body, false if they are in
   *  ground axes. Default: false. */
  bool follows_body;
} baum_spatial_load_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spatial_load_def_init(baum_spatial_load_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spatial_load_def baum_spatial_load_def_default(void)
{
  baum_spatial_load_def def;
  baum_spatial_load_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spatial_load(baum_mechanism *mechanism,
                                                     const baum_spatial_load_def *def,
                                                     baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spatial_load(const baum_mechanism *mechanism,
                                                     baum_force_id id, baum_spatial_load_def *out,
                                                     size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spatial_load(baum_mechanism *mechanism, baum_force_id id,
                                                     const baum_spatial_load_def *def);

#ifdef __cplusplus
}
#endif

#endif
