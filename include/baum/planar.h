/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Planar bodies, joints and forces.
 *
 *  A planar body has three coordinates (x, y, angle), a particle two (x, y); velocities likewise.
 *  Positions are of the centre of mass, in ground axes; angles are counter-clockwise and continuous
 *  over turns.
 *
 *  Placing: joints and springs are placed either by `point` (ground axes, in the design
 *  configuration, the same for both bodies) or by `point_a` and `point_b` (each in the axes of its
 *  body, for ground the ground axes); NaN means not given; both ways or neither is refused. The
 *  design configuration is a guess that is assembled at start. A point of a particle is the
 *  particle itself. A spring and a distance joint with `point` would have no length: they take
 *  point_a and point_b.
 *
 *  Reaction of a joint: force [N] and moment [N m] on body_b, ground axes, about the joint's point
 *  on body_b.
 *
 *  More joints are in planar_joints.h.
 */
#ifndef BAUM_PLANAR_H
#define BAUM_PLANAR_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- rigid body in the plane ----------------------------------------------------------------- */

/** A rigid body. The body axes have their origin at the centre of mass. */
typedef struct baum_planar_body_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;        /**< [kg] > 0. Default: 1. */
  double inertia;     /**< [kg m^2] > 0, about the centre of mass. Default: 1. */
  double
    position[2]; /**< [m] of the centre of mass in the design configuration. Default: (0, 0). */
  double angle;  /**< [rad] of the body axes in the design configuration. Default: 0. */
  double velocity[2];      /**< [m/s] of the centre of mass at start. Default: NaN, free. */
  double angular_velocity; /**< [rad/s] at start. Default: NaN, free. */
  bool held;               /**< Assembly keeps the design position and angle. Default: false. */
} baum_planar_body_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_body_def_init(baum_planar_body_def *def, size_t caller_size);

/** The default definition of a rigid body in the plane. */
static inline baum_planar_body_def baum_planar_body_def_default(void)
{
  baum_planar_body_def def;
  baum_planar_body_def_init(&def, sizeof def);
  return def;
}

/** Add a rigid body in the plane.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the body; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_body(baum_mechanism *mechanism,
                                                    const baum_planar_body_def *def,
                                                    baum_body_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_body(const baum_mechanism *mechanism,
                                                    baum_body_id id, baum_planar_body_def *out,
                                                    size_t caller_size);

/** Replace a definition.
 *  @return as baum_mechanism_add_planar_body()
 */
BAUM_API baum_status baum_mechanism_set_planar_body(baum_mechanism *mechanism, baum_body_id id,
                                                    const baum_planar_body_def *def);

/* ---- particle in the plane ------------------------------------------------------------------- */

/** A point mass; it has no angle, and joints that need one refuse it. */
typedef struct baum_planar_particle_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;        /**< [kg] > 0. Default: 1. */
  double position[2]; /**< [m] in the design configuration. Default: (0, 0). */
  double velocity[2]; /**< [m/s] at start. Default: NaN, free. */
  bool held;          /**< Assembly keeps the design position. Default: false. */
} baum_planar_particle_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_particle_def_init(baum_planar_particle_def *def, size_t caller_size);

/** The default definition of a particle in the plane. */
static inline baum_planar_particle_def baum_planar_particle_def_default(void)
{
  baum_planar_particle_def def;
  baum_planar_particle_def_init(&def, sizeof def);
  return def;
}

/** Add a particle in the plane.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the body; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_particle(baum_mechanism *mechanism,
                                                        const baum_planar_particle_def *def,
                                                        baum_body_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_particle(const baum_mechanism *mechanism,
                                                        baum_body_id id,
                                                        baum_planar_particle_def *out,
                                                        size_t caller_size);

/** Replace a definition.
 *  @return as baum_mechanism_add_planar_particle()
 */
BAUM_API baum_status baum_mechanism_set_planar_particle(baum_mechanism *mechanism, baum_body_id id,
                                                        const baum_planar_particle_def *def);

/* ---- revolute joint (pin) -------------------------------------------------------------------- */

/** A pin: the points of both bodies coincide. Two rows [m]: x, y of body_a's point minus
 *  body_b's. */
typedef struct baum_planar_revolute_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; not body_a. */
  double point[2];     /**< [m] ground axes, design configuration. Default: NaN, not given. */
  double point_a[2];   /**< [m] on body_a, its axes. Default: NaN, not given. */
  double point_b[2];   /**< [m] on body_b, its axes. Default: NaN, not given. */
} baum_planar_revolute_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_revolute_def_init(baum_planar_revolute_def *def, size_t caller_size);

/** The default definition of a revolute joint (pin). */
static inline baum_planar_revolute_def baum_planar_revolute_def_default(void)
{
  baum_planar_revolute_def def;
  baum_planar_revolute_def_init(&def, sizeof def);
  return def;
}

/** Add a revolute joint (pin).
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_revolute(baum_mechanism *mechanism,
                                                        const baum_planar_revolute_def *def,
                                                        baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_revolute(const baum_mechanism *mechanism,
                                                        baum_joint_id id,
                                                        baum_planar_revolute_def *out,
                                                        size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_revolute()
 */
BAUM_API baum_status baum_mechanism_set_planar_revolute(baum_mechanism *mechanism, baum_joint_id id,
                                                        const baum_planar_revolute_def *def);

/* ---- translational joint (slider) ------------------------------------------------------------ */

/** body_b slides along an axis fixed in body_a without turning. Two rows: distance of body_b's
 *  point from the axis through body_a's point [m], and angle_b - angle_a - angle [rad]. */
typedef struct baum_planar_translational_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; not body_a. */
  double point[2];     /**< [m] ground axes, design configuration. Default: NaN, not given. */
  double point_a[2];   /**< [m] on body_a, its axes. Default: NaN, not given. */
  double point_b[2];   /**< [m] on body_b, its axes. Default: NaN, not given. */
  double axis[2]; /**< [-] not zero; in ground axes with `point`, else body_a's. Default: (1, 0). */
  double angle;   /**< [rad] angle_b - angle_a that is kept. Default: NaN, that of the design
                     configuration. */
} baum_planar_translational_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_translational_def_init(baum_planar_translational_def *def,
                                                 size_t caller_size);

/** The default definition of a translational joint (slider). */
static inline baum_planar_translational_def baum_planar_translational_def_default(void)
{
  baum_planar_translational_def def;
  baum_planar_translational_def_init(&def, sizeof def);
  return def;
}

/** Add a translational joint (slider).
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_translational(
  baum_mechanism *mechanism, const baum_planar_translational_def *def, baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_translational(const baum_mechanism *mechanism,
                                                             baum_joint_id id,
                                                             baum_planar_translational_def *out,
                                                             size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_translational()
 */
BAUM_API baum_status baum_mechanism_set_planar_translational(
  baum_mechanism *mechanism, baum_joint_id id, const baum_planar_translational_def *def);

/* ---- distance joint (massless rod) ----------------------------------------------------------- */

/** A rod without mass between two points. One row [m]: (d.d - length^2) / (2 length) with d from
 *  body_a's point to body_b's, which is the change of length to first order and smooth
 *  everywhere. */
typedef struct baum_planar_distance_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; not body_a. */
  double point[2];     /**< [m] ground axes, design configuration. Default: NaN, not given. */
  double point_a[2];   /**< [m] on body_a, its axes. Default: NaN, not given. */
  double point_b[2];   /**< [m] on body_b, its axes. Default: NaN, not given. */
  double length;       /**< [m] > 0. Default: NaN, that of the design configuration. */
} baum_planar_distance_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_distance_def_init(baum_planar_distance_def *def, size_t caller_size);

/** The default definition of a distance joint (massless rod). */
static inline baum_planar_distance_def baum_planar_distance_def_default(void)
{
  baum_planar_distance_def def;
  baum_planar_distance_def_init(&def, sizeof def);
  return def;
}

/** Add a distance joint (massless rod).
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_distance(baum_mechanism *mechanism,
                                                        const baum_planar_distance_def *def,
                                                        baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_distance(const baum_mechanism *mechanism,
                                                        baum_joint_id id,
                                                        baum_planar_distance_def *out,
                                                        size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_distance()
 */
BAUM_API baum_status baum_mechanism_set_planar_distance(baum_mechanism *mechanism, baum_joint_id id,
                                                        const baum_planar_distance_def *def);

/* ---- fixed joint (weld) ---------------------------------------------------------------------- */

/** A weld: points coincide and the relative angle is kept. Three rows [m], [m], [rad]. */
typedef struct baum_planar_fixed_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; not body_a. */
  double point[2];     /**< [m] ground axes, design configuration. Default: NaN, not given. */
  double point_a[2];   /**< [m] on body_a, its axes. Default: NaN, not given. */
  double point_b[2];   /**< [m] on body_b, its axes. Default: NaN, not given. */
  double angle;        /**< [rad] angle_b - angle_a that is kept. Default: NaN, that of the design
                     configuration. */
} baum_planar_fixed_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_fixed_def_init(baum_planar_fixed_def *def, size_t caller_size);

/** The default definition of a fixed joint (weld). */
static inline baum_planar_fixed_def baum_planar_fixed_def_default(void)
{
  baum_planar_fixed_def def;
  baum_planar_fixed_def_init(&def, sizeof def);
  return def;
}

/** Add a fixed joint (weld).
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_fixed(baum_mechanism *mechanism,
                                                     const baum_planar_fixed_def *def,
                                                     baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_fixed(const baum_mechanism *mechanism,
                                                     baum_joint_id id, baum_planar_fixed_def *out,
                                                     size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_fixed()
 */
BAUM_API baum_status baum_mechanism_set_planar_fixed(baum_mechanism *mechanism, baum_joint_id id,
                                                     const baum_planar_fixed_def *def);

/* ---- spring-damper between two points -------------------------------------------------------- */

/** Law of a spring: tension, or torque of a torsion spring, and its derivatives.
 *  @param      length  [m] distance of the points; [rad] angle_b - angle_a of a torsion spring
 *  @param      rate    [m/s or rad/s] its rate
 *  @param[out] out     zeroed before the call: out[0] what shortens the length [N], or turns the
 *                      angle back [N m], when > 0; out[1] its derivative by length [N/m or
 *                      N m/rad]; out[2] by rate [N s/m or N m s/rad]
 *  @param      user    the definition's `user`
 *  @return             as baum_q_fn. The check of derivatives calls it beside configurations of the
 *                      mechanism
 */
typedef int baum_spring_fn(double length, double rate, double out[3], void *user);

/** A linear spring and damper in parallel along the line between two points, or a law of the user.
 *  Its force is zero when the points coincide. */
typedef struct baum_planar_spring_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; not body_a. */
  double point[2];     /**< [m] ground axes, design configuration. Default: NaN, not given. */
  double point_a[2];   /**< [m] on body_a, its axes. Default: NaN, not given. */
  double point_b[2];   /**< [m] on body_b, its axes. Default: NaN, not given. */
  double stiffness;    /**< [N/m] >= 0. Default: 0. */
  double damping;      /**< [N s/m] >= 0. Default: 0. */
  double free_length;  /**< [m] >= 0. Default: NaN, that of the design configuration. */
  baum_spring_fn *law; /**< Replaces the three above, without potential energy. Default: NULL. */
  void *user;          /**< Passed to law, not owned. Default: NULL. */
  bool depends_on_velocity; /**< law reads rate; RATTLE takes false alone. Default: true. */
} baum_planar_spring_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_spring_def_init(baum_planar_spring_def *def, size_t caller_size);

/** The default definition of a spring-damper between two points. */
static inline baum_planar_spring_def baum_planar_spring_def_default(void)
{
  baum_planar_spring_def def;
  baum_planar_spring_def_init(&def, sizeof def);
  return def;
}

/** Add a spring-damper between two points.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the force; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_spring(baum_mechanism *mechanism,
                                                      const baum_planar_spring_def *def,
                                                      baum_force_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_spring(const baum_mechanism *mechanism,
                                                      baum_force_id id, baum_planar_spring_def *out,
                                                      size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_spring()
 */
BAUM_API baum_status baum_mechanism_set_planar_spring(baum_mechanism *mechanism, baum_force_id id,
                                                      const baum_planar_spring_def *def);

/* ---- torsion spring-damper between two bodies ------------------------------------------------ */

/** A linear torsion spring and damper in parallel on angle_b - angle_a, which is continuous over
 *  turns, or a law of the user. Both bodies must have an angle; ground has. */
typedef struct baum_planar_torsion_spring_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; not body_a. */
  double stiffness;    /**< [N m/rad] >= 0. Default: 0. */
  double damping;      /**< [N m s/rad] >= 0. Default: 0. */
  double free_angle;   /**< [rad] angle_b - angle_a without torque. Default: NaN, as designed. */
  baum_spring_fn *law; /**< Replaces the three above, without potential energy. Default: NULL. */
  void *user;          /**< Passed to law, not owned. Default: NULL. */
  bool depends_on_velocity; /**< law reads rate; RATTLE takes false alone. Default: true. */
} baum_planar_torsion_spring_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_torsion_spring_def_init(baum_planar_torsion_spring_def *def,
                                                  size_t caller_size);

/** The default definition of a torsion spring-damper between two bodies. */
static inline baum_planar_torsion_spring_def baum_planar_torsion_spring_def_default(void)
{
  baum_planar_torsion_spring_def def;
  baum_planar_torsion_spring_def_init(&def, sizeof def);
  return def;
}

/** Add a torsion spring-damper between two bodies.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the force; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_torsion_spring(
  baum_mechanism *mechanism, const baum_planar_torsion_spring_def *def, baum_force_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_torsion_spring(const baum_mechanism *mechanism,
                                                              baum_force_id id,
                                                              baum_planar_torsion_spring_def *out,
                                                              size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_planar_torsion_spring()
 */
BAUM_API baum_status baum_mechanism_set_planar_torsion_spring(
  baum_mechanism *mechanism, baum_force_id id, const baum_planar_torsion_spring_def *def);

/* ---- load ------------------------------------------------------------------------------------ */

/** A force at a point of a body and a torque, constant or times an input. The force keeps its
 *  direction in ground axes or turns with the body; the point is always the body's. A load in
 *  ground axes without torque and input has a potential, and its energy is counted as such. */
typedef struct baum_planar_load_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body;   /**< Default: none, must be set; not ground. */
  double point[2];     /**< [m] on the body, its axes, where the force acts. Default: (0, 0). */
  double force[2];     /**< [N] Default: (0, 0). */
  double torque;       /**< [N m] about the normal of the plane. Default: 0. */
  bool follows_body;   /**< The force turns with the body. Default: false, ground axes. */
  baum_input_id input; /**< Its value multiplies force and torque. Default: none, 1. */
} baum_planar_load_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_planar_load_def_init(baum_planar_load_def *def, size_t caller_size);

/** The default definition of a load. */
static inline baum_planar_load_def baum_planar_load_def_default(void)
{
  baum_planar_load_def def;
  baum_planar_load_def_init(&def, sizeof def);
  return def;
}

/** Add a load.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the force; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_planar_load(baum_mechanism *mechanism,
                                                    const baum_planar_load_def *def,
                                                    baum_force_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_planar_load(const baum_mechanism *mechanism,
                                                    baum_force_id id, baum_planar_load_def *out,
                                                    size_t caller_size);

/** Replace a definition; the body must stay.
 *  @return as baum_mechanism_add_planar_load()
 */
BAUM_API baum_status baum_mechanism_set_planar_load(baum_mechanism *mechanism, baum_force_id id,
                                                    const baum_planar_load_def *def);

#ifdef __cplusplus
}
#endif

#endif
