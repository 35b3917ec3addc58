/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Planar bodies, joints and forces. More joints are in planar_joints.h.
 *
 *  Coordinates: a planar body has three coordinates (x, y, angle), and a particle has two (x, y).
 *  The velocities are the time derivatives of these coordinates. The coordinates x and y are the
 *  position of the centre of mass in ground axes. Angles are positive counter-clockwise; they grow
 *  continuously over several revolutions.
 *
 *  Points: give a joint or a spring either `point`, or both `point_a` and `point_b`. NaN means that
 *  a point is not given. `point` is a single point in ground axes, which both bodies share in the
 *  design configuration. `point_a` is a point of body_a in the axes of body_a, and `point_b` a
 *  point of body_b in the axes of body_b. Points of ground are in ground axes. The point of a
 *  particle is the particle itself. Distance joints and springs between two points require point_a
 *  and point_b, because with `point` their length would be 0.
 *
 *  Design configuration: the positions and angles that the definitions of the bodies give. Assembly
 *  starts from it.
 *
 *  Reaction of a joint: the force [N] and the moment [N m] that the joint exerts on body_b, in
 *  ground axes. The moment is about the joint's point on body_b. If a driver acts on the joint, the
 *  reaction does not include the force or torque of the driver. */
#ifndef BAUM_PLANAR_H
#define BAUM_PLANAR_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- rigid body in the plane ----------------------------------------------------------------- */

/** A rigid body in the plane. The origin of its body axes is the centre of mass. */
typedef struct baum_planar_body_def {
  size_t struct_size; /**< Set by baum_planar_body_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;        /**< [kg] > 0. Default: 1. */
  double inertia;     /**< [kg m^2] > 0, about the centre of mass. Default: 1. */
  /** [m] position of the centre of mass in the design configuration. Default: (0, 0). */
  double position[2];
  double angle; /**< [rad] angle of the body axes in the design configuration. Default: 0. */
  /** [m/s] velocity of the centre of mass at the start. Default: NaN, assembly determines it. */
  double velocity[2];
  /** [rad/s] angular velocity at the start. Default: NaN, assembly determines it. */
  double angular_velocity;
  bool held; /**< True if assembly must not move the body. Default: false. */
} baum_planar_body_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_body_def_init(baum_planar_body_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_body_def baum_planar_body_def_default(void)
{
  baum_planar_body_def def;
  baum_planar_body_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_body(baum_mechanism *mechanism,
                                                    const baum_planar_body_def *def,
                                                    baum_body_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_body(const baum_mechanism *mechanism,
                                                    baum_body_id id, baum_planar_body_def *out,
                                                    size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_body(baum_mechanism *mechanism, baum_body_id id,
                                                    const baum_planar_body_def *def);

/* ---- particle in the plane ------------------------------------------------------------------- */

/** A point mass in the plane. It has no angle, so joints that need an angle refuse it. */
typedef struct baum_planar_particle_def {
  size_t struct_size; /**< Set by baum_planar_particle_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;        /**< [kg] > 0. Default: 1. */
  double position[2]; /**< [m] position in the design configuration. Default: (0, 0). */
  double velocity[2]; /**< [m/s] velocity at the start. Default: NaN, assembly determines it. */
  bool held;          /**< True if assembly must not move the body. Default: false. */
} baum_planar_particle_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_particle_def_init(baum_planar_particle_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_particle_def baum_planar_particle_def_default(void)
{
  baum_planar_particle_def def;
  baum_planar_particle_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_particle(baum_mechanism *mechanism,
                                                        const baum_planar_particle_def *def,
                                                        baum_body_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_particle(const baum_mechanism *mechanism,
                                                        baum_body_id id,
                                                        baum_planar_particle_def *out,
                                                        size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_particle(baum_mechanism *mechanism, baum_body_id id,
                                                        const baum_planar_particle_def *def);

/* ---- revolute joint (pin) -------------------------------------------------------------------- */

/** A pin (revolute joint): the points of both bodies coincide. The joint has two rows [m]: x and y
 *  of the vector from body_b's point to body_a's point. */
typedef struct baum_planar_revolute_def {
  size_t struct_size;  /**< Set by baum_planar_revolute_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[2];
  double point_a[2]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[2]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
} baum_planar_revolute_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_revolute_def_init(baum_planar_revolute_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_revolute_def baum_planar_revolute_def_default(void)
{
  baum_planar_revolute_def def;
  baum_planar_revolute_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_revolute(baum_mechanism *mechanism,
                                                        const baum_planar_revolute_def *def,
                                                        baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_revolute(const baum_mechanism *mechanism,
                                                        baum_joint_id id,
                                                        baum_planar_revolute_def *out,
                                                        size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_revolute(baum_mechanism *mechanism, baum_joint_id id,
                                                        const baum_planar_revolute_def *def);

/* ---- translational joint (slider) ------------------------------------------------------------ */

/** A slider (translational joint): body_b slides along an axis that is fixed in body_a, and does
 *  not rotate relative to body_a. The axis passes through body_a's point. The joint has two rows.
 *  The first is the distance of body_b's point from the axis [m], and the second is angle_b -
 *  angle_a minus the field `angle` [rad]. */
typedef struct baum_planar_translational_def {
  size_t struct_size;  /**< Set by baum_planar_translational_def_default(). Do not change it. */
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
  /** [rad] constant value of angle_b - angle_a. Default: NaN, the value in the design
   *  configuration. */
  double angle;
} baum_planar_translational_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_translational_def_init(baum_planar_translational_def *def,
                                                 size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_translational_def baum_planar_translational_def_default(void)
{
  baum_planar_translational_def def;
  baum_planar_translational_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_translational(
  baum_mechanism *mechanism, const baum_planar_translational_def *def, baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_translational(const baum_mechanism *mechanism,
                                                             baum_joint_id id,
                                                             baum_planar_translational_def *out,
                                                             size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_translational(
  baum_mechanism *mechanism, baum_joint_id id, const baum_planar_translational_def *def);

/* ---- distance joint (massless rod) ----------------------------------------------------------- */

/** A massless rod between two points. The joint has one row [m], (d.d - length^2) / (2 length),
 *  where d is the vector from body_a's point to body_b's point. For a small violation, the value of
 *  the row is approximately the change of the length of the rod. The row is a smooth function of
 *  the coordinates everywhere, whereas the length itself is not smooth where it is 0. */
typedef struct baum_planar_distance_def {
  size_t struct_size;  /**< Set by baum_planar_distance_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] must not be given, because then both points would coincide. Default: NaN, not given. */
  double point[2];
  double point_a[2]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[2]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  double length;     /**< [m] > 0. Default: NaN, the value in the design configuration. */
} baum_planar_distance_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_distance_def_init(baum_planar_distance_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_distance_def baum_planar_distance_def_default(void)
{
  baum_planar_distance_def def;
  baum_planar_distance_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_distance(baum_mechanism *mechanism,
                                                        const baum_planar_distance_def *def,
                                                        baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_distance(const baum_mechanism *mechanism,
                                                        baum_joint_id id,
                                                        baum_planar_distance_def *out,
                                                        size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_distance(baum_mechanism *mechanism, baum_joint_id id,
                                                        const baum_planar_distance_def *def);

/* ---- fixed joint (weld) ---------------------------------------------------------------------- */

/** A weld (fixed joint): the points of both bodies coincide, and the relative angle of the bodies
 *  is constant. The joint has three rows: x and y of the vector from body_b's point to body_a's
 *  point [m], and angle_b - angle_a minus the field `angle` [rad]. */
typedef struct baum_planar_fixed_def {
  size_t struct_size;  /**< Set by baum_planar_fixed_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] common point of both bodies in the design configuration, in ground axes. Default: NaN, not
   *  given. */
  double point[2];
  double point_a[2]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[2]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
  /** [rad] constant value of angle_b - angle_a. Default: NaN, the value in the design
   *  configuration. */
  double angle;
} baum_planar_fixed_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_fixed_def_init(baum_planar_fixed_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_fixed_def baum_planar_fixed_def_default(void)
{
  baum_planar_fixed_def def;
  baum_planar_fixed_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_fixed(baum_mechanism *mechanism,
                                                     const baum_planar_fixed_def *def,
                                                     baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_fixed(const baum_mechanism *mechanism,
                                                     baum_joint_id id, baum_planar_fixed_def *out,
                                                     size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_fixed(baum_mechanism *mechanism, baum_joint_id id,
                                                     const baum_planar_fixed_def *def);

/* ---- spring-damper between two points -------------------------------------------------------- */

/** A linear spring and damper in parallel between two points, or a law of your own. The force acts
 *  along the line through the points. The force is zero when the points coincide. */
typedef struct baum_planar_spring_def {
  size_t struct_size;  /**< Set by baum_planar_spring_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] must not be given, because then both points would coincide. Default: NaN, not given. */
  double point[2];
  double point_a[2]; /**< [m] point of body_a, in the axes of body_a. Default: NaN, not given. */
  double point_b[2]; /**< [m] point of body_b, in the axes of body_b. Default: NaN, not given. */
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
} baum_planar_spring_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_spring_def_init(baum_planar_spring_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_spring_def baum_planar_spring_def_default(void)
{
  baum_planar_spring_def def;
  baum_planar_spring_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_spring(baum_mechanism *mechanism,
                                                      const baum_planar_spring_def *def,
                                                      baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_spring(const baum_mechanism *mechanism,
                                                      baum_force_id id, baum_planar_spring_def *out,
                                                      size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_spring(baum_mechanism *mechanism, baum_force_id id,
                                                      const baum_planar_spring_def *def);

/* ---- torsion spring-damper between two bodies ------------------------------------------------ */

/** A linear torsion spring and damper in parallel, or a law of your own, that acts on the relative
 *  angle angle_b - angle_a. The relative angle is continuous over several revolutions. Both bodies
 *  must have an angle, which particles do not have. One of the bodies may be ground. */
typedef struct baum_planar_torsion_spring_def {
  size_t struct_size;  /**< Set by baum_planar_torsion_spring_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  double stiffness;    /**< [N m/rad] >= 0. Default: 0. */
  double damping;      /**< [N m s/rad] >= 0. Default: 0. */
  /** [rad] relative angle at which the spring exerts no torque. Default: NaN, the value in the
   *  design configuration. */
  double free_angle;
  /** A law that replaces stiffness, damping and free_angle, which must then have their defaults;
   *  the spring then has no potential energy. Default: NULL. */
  baum_spring_fn *law;
  void *user; /**< Passed to law. Not owned. Default: NULL. */
  /** True if law reads its argument `rate`, the time derivative of the angle. RATTLE requires
   *  false. Default: true. */
  bool depends_on_velocity;
} baum_planar_torsion_spring_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_torsion_spring_def_init(baum_planar_torsion_spring_def *def,
                                                  size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_torsion_spring_def baum_planar_torsion_spring_def_default(void)
{
  baum_planar_torsion_spring_def def;
  baum_planar_torsion_spring_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_torsion_spring(
  baum_mechanism *mechanism, const baum_planar_torsion_spring_def *def, baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_torsion_spring(const baum_mechanism *mechanism,
                                                              baum_force_id id,
                                                              baum_planar_torsion_spring_def *out,
                                                              size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_torsion_spring(
  baum_mechanism *mechanism, baum_force_id id, const baum_planar_torsion_spring_def *def);

/* ---- load ------------------------------------------------------------------------------------ */

/** A force at a point of a body, and a torque on the body. Force and torque are constant, or both
 *  are multiplied by the value of an input. The point is fixed in the body. The force keeps its
 *  direction in ground axes, or it rotates with the body. A load in ground axes that has neither a
 *  torque nor an input has a potential energy; other loads have none. */
typedef struct baum_planar_load_def {
  size_t struct_size; /**< Set by baum_planar_load_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body;  /**< Default: none, must be set; must not be ground. */
  double point[2];    /**< [m] where the force acts, in body axes. Default: (0, 0). */
  /** [N] the force in ground axes, or in body axes if `follows_body` is true. Default: (0, 0). */
  double force[2];
  double torque; /**< [N m] counter-clockwise. Default: 0. */
  /** True if the force rotates with the body. Default: false, the force is in ground axes. */
  bool follows_body;
  baum_input_id input; /**< An input whose value multiplies force and torque. Default: none. */
} baum_planar_load_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_planar_load_def_init(baum_planar_load_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_planar_load_def baum_planar_load_def_default(void)
{
  baum_planar_load_def def;
  baum_planar_load_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_planar_load(baum_mechanism *mechanism,
                                                    const baum_planar_load_def *def,
                                                    baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_planar_load(const baum_mechanism *mechanism,
                                                    baum_force_id id, baum_planar_load_def *out,
                                                    size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_planar_load(baum_mechanism *mechanism, baum_force_id id,
                                                    const baum_planar_load_def *def);

#ifdef __cplusplus
}
#endif

#endif
