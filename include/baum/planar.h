/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Planar bodies, joints and forces. More joints are in planar_joints.h.
 *
 *  Coordinates: a planar body has three (x, y, angle), a particle two (x, y); velocities likewise.
 *  Positions are of the centre of mass in ground axes. Angles are counter-clockwise and continuous
 *  over revolutions.
 *
 *  Points: give joints and springs either `point` or both `point_a` and `point_b`; NaN means not
 *  given. `point` is one point in ground axes that both bodies share in the design configuration.
 *  `point_a` and `point_b` are in the axes of their bodies, for ground in ground axes. On a
 *  particle the point is the particle itself. Springs and distance joints require point_a and
 *  point_b, because their length would be 0 with `point`.
 *
 *  Design configuration: the positions and angles of the definitions. Assembly takes them as its
 *  initial guess.
 *
 *  Reaction of a joint: force [N] and moment [N m] on body_b, in ground axes, about the joint's
 *  point on body_b. The reaction does not include the effort of a driver of the joint. */
#ifndef BAUM_PLANAR_H
#define BAUM_PLANAR_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- rigid body in the plane ----------------------------------------------------------------- */

/** A rigid body. Its body axes have their origin at the centre of mass. */
typedef struct baum_planar_body_def {
  size_t struct_size;      /**< Set by the default. Do not write. */
  const char *name;        /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;             /**< [kg] > 0. Default: 1. */
  double inertia;          /**< [kg m^2] > 0, about the centre of mass. Default: 1. */
  double position[2];      /**< [m] centre of mass, design configuration. Default: (0, 0). */
  double angle;            /**< [rad] body axes, design configuration. Default: 0. */
  double velocity[2];      /**< [m/s] initial, of the centre of mass. Default: NaN, free. */
  double angular_velocity; /**< [rad/s] initial. Default: NaN, free. */
  bool held;               /**< Assembly keeps the design position and angle. Default: false. */
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

/** A point mass. It has no angle; joints that need one refuse it. */
typedef struct baum_planar_particle_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;        /**< [kg] > 0. Default: 1. */
  double position[2]; /**< [m] design configuration. Default: (0, 0). */
  double velocity[2]; /**< [m/s] initial. Default: NaN, free. */
  bool held;          /**< Assembly keeps the design position. Default: false. */
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

/** A pin (revolute joint): the points of both bodies coincide. Two rows [m]: x and y of body_a's
 *  point minus body_b's point. */
typedef struct baum_planar_revolute_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  double point[2]; /**< [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point_a[2]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[2]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
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

/** A slider (translational joint): body_b slides along an axis fixed in body_a without rotating
 *  relative to it. Two rows: distance of body_b's point from the axis through body_a's point [m],
 *  and angle_b - angle_a - angle [rad]. */
typedef struct baum_planar_translational_def {
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
  /** [rad] constant angle_b - angle_a. Default: NaN, the value in the design configuration. */
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

/** A massless rod between two points. One row [m]: (d.d - length^2) / (2 length), where d leads
 *  from body_a's point to body_b's point. To first order the row is the change of length; unlike
 *  the length it is smooth everywhere. */
typedef struct baum_planar_distance_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  double point[2]; /**< [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point_a[2]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[2]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
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

/** A weld (fixed joint): the points coincide and the relative angle is constant. Three rows [m],
 *  [m], [rad]. */
typedef struct baum_planar_fixed_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  double point[2]; /**< [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point_a[2]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[2]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  /** [rad] constant angle_b - angle_a. Default: NaN, the value in the design configuration. */
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
 *  along the line through the points; it is zero when they coincide. */
typedef struct baum_planar_spring_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  double point[2]; /**< [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point_a[2]; /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[2]; /**< [m] on body_b, in its axes. Default: NaN, not given. */
  double stiffness;  /**< [N/m] >= 0. Default: 0. */
  double damping;    /**< [N s/m] >= 0. Default: 0. */
  /** [m] >= 0, length without force. Default: NaN, the value in the design configuration. */
  double free_length;
  /** Replaces the three fields above; the spring then has no potential energy. Default: NULL. */
  baum_spring_fn *law;
  void *user;               /**< Passed to law. Not owned. Default: NULL. */
  bool depends_on_velocity; /**< law reads rate. RATTLE requires false. Default: true. */
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

/** A linear torsion spring and damper in parallel on angle_b - angle_a, or a law of your own. The
 *  angle is continuous over revolutions. Both bodies must have an angle; ground has one. */
typedef struct baum_planar_torsion_spring_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  double stiffness;    /**< [N m/rad] >= 0. Default: 0. */
  double damping;      /**< [N m s/rad] >= 0. Default: 0. */
  /** [rad] angle without torque. Default: NaN, the value in the design configuration. */
  double free_angle;
  /** Replaces the three fields above; the spring then has no potential energy. Default: NULL. */
  baum_spring_fn *law;
  void *user;               /**< Passed to law. Not owned. Default: NULL. */
  bool depends_on_velocity; /**< law reads rate. RATTLE requires false. Default: true. */
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

/** A force at a point of a body and a torque on the body, both constant or multiplied by an input.
 *  The point is fixed in the body. The direction of the force is fixed in ground axes or in the
 *  body. A load in ground axes with neither torque nor input has a potential; other loads have
 *  none. */
typedef struct baum_planar_load_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body;  /**< Default: none, must be set; must not be ground. */
  double point[2];    /**< [m] where the force acts, in body axes. Default: (0, 0). */
  double force[2];    /**< [N] Default: (0, 0). */
  double torque;      /**< [N m] counter-clockwise. Default: 0. */
  /** The force rotates with the body. Default: false, it is in ground axes. */
  bool follows_body;
  baum_input_id input; /**< Its value multiplies force and torque. Default: none. */
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
