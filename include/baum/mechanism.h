/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  What is simulated: bodies, joints and forces.
 *
 *  A mechanism is made by `add` calls, then frozen, then constant; a frozen one may be shared
 *  between threads. *Bodies* are anything with coordinates (planar.h, or user coordinates below),
 *  *joints* anything with constraint rows (planar.h, planar_joints.h, drivers, couplings, or user
 *  constraints), *forces* the rest. A mechanism that is given wholly by functions of the user is
 *  one body of user coordinates and one user constraint.
 *
 *  Equations (Flores et al. 2008, numbers in brackets): constraints Phi(q, t) = 0 (1), their rate
 *  Phi' = J v - nu (3), their second derivative J a - gamma (4), and M a + J^T lambda = g (2).
 *
 *  Units: SI is assumed nowhere but in the default gravity; any consistent set will do. Angles in
 *  radians.
 *  Order: q, v, constraint rows and lambda are in the order in which bodies and joints were added.
 *  Callbacks: q and v hold the coordinates of the named bodies one after the other; matrices are
 *  dense and row-major, zeroed before the call; return 0 when fine, > 0 to ask for a smaller
 *  step, < 0 to stop the run. They must be reentrant when the mechanism is shared between threads.
 *  They may call the library, but not with the workspace or the run that is calling them: what
 *  returns a status fails there (BAUM_ERR_STATE), and it cannot be destroyed; time, q, v, inputs
 *  and texts can be read, and the run be cancelled.
 *  Names of elements, inputs and events are labels in messages: NULL stands for the default; empty
 *  ones and ones with control characters, such as line breaks, are refused.
 *  Definitions: start from baum_<what>_def_default(); an all-zero struct is refused. Fields are
 *  only ever appended: a struct of a program that was compiled with an older version is smaller,
 *  and what it lacks has its default. A larger one, of a newer version, is refused
 *  (BAUM_ERR_STRUCT).
 */
#ifndef BAUM_MECHANISM_H
#define BAUM_MECHANISM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/export.h>
#include <baum/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Bodies, joints and forces under construction, or frozen. */
typedef struct baum_mechanism baum_mechanism;

/** Names one body of one mechanism and its copies, by value. All-zero: "none", refused. */
typedef struct baum_body_id {
  int32_t index1; /**< Private: 1 + position in the mechanism. */
  uint32_t tag;   /**< Private: which mechanism. */
} baum_body_id;

/** Names one joint, anything with constraint rows, by value. All-zero: "none", refused. */
typedef struct baum_joint_id {
  int32_t index1; /**< Private: 1 + position in the mechanism. */
  uint32_t tag;   /**< Private: which mechanism. */
} baum_joint_id;

/** Names one force, by value. All-zero: "none", refused. */
typedef struct baum_force_id {
  int32_t index1; /**< Private: 1 + position in the mechanism. */
  uint32_t tag;   /**< Private: which mechanism. */
} baum_force_id;

/** Names one input, by value. All-zero: "none". */
typedef struct baum_input_id {
  int32_t index1; /**< Private: 1 + position in the mechanism. */
  uint32_t tag;   /**< Private: which mechanism. */
} baum_input_id;

/** The body that does not move, in every mechanism. */
static const baum_body_id BAUM_GROUND = {-1, 0};

/** Function of time and positions.
 *  @param      t     [s]
 *  @param[in]  q     positions of the named bodies
 *  @param[out] out   what the definition says, zeroed before the call
 *  @param      user  the definition's `user`
 *  @return           0 fine, > 0 retry with a smaller step, < 0 stop
 */
typedef int baum_q_fn(double t, const double *q, double *out, void *user);

/** Function of time, positions and velocities; as baum_q_fn. */
typedef int baum_qv_fn(double t, const double *q, const double *v, double *out, void *user);

/** Generalized force, as baum_qv_fn.
 *  @param[in] inputs  present values of the mechanism's inputs in the order of adding; NULL while
 *                     it has none
 */
typedef int baum_force_fn(double t, const double *q, const double *v, const double *inputs,
                          double *out, void *user);

/** Law of a driver: s[0] value, s[1] rate, s[2] acceleration at time t; return as baum_q_fn. Rate
 *  and acceleration must be the derivatives of the value (baum_mechanism_check_derivatives()). It
 *  is also called at times outside of the run: by the check of derivatives, and where the
 *  constraints around the start are explored. */
typedef int baum_law_fn(double t, double s[3], void *user);

/* ---- a body given by functions --------------------------------------------------------------- */

/** Rates of positions, linear in v: dq = N(q) v. It is also called with a q that is off the
 *  manifold by as much as a step may leave it; scaling q scales dq. */
typedef void baum_rate_fn(const double *q, const double *v, double *dq, void *user);

/** Moves q, in place, to where it is after the time h at constant v, at least to second order in h.
 *  With h = 1, v is a displacement of velocity size. */
typedef void baum_move_fn(double h, const double *v, double *q, void *user);

/** The displacement dx, of velocity size, by which baum_move_fn leads with h = 1 from one position
 *  to another. */
typedef void baum_difference_fn(const double *from, const double *to, double *dx, void *user);

/** Replaces q by the nearest one on the manifold. */
typedef void baum_normalize_fn(double *q, void *user);

/** Generalized coordinates with mass and force given by functions. v = q', or, where positions are
 *  not a vector (a unit quaternion, say), q' = N(q) v with the last fields. Every other function
 *  then sees a normalized q; derivatives by q, as those of constraints on these coordinates, are
 *  those along displacements of velocity size: (Phi_q N) in place of Phi_q. Functions that cannot
 *  answer give NaN. */
typedef struct baum_coordinates_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  int32_t size;       /**< [-] > 0, number of velocities. Default: 0, must be set. */
  const double *q;    /**< (position_count) design positions, on the manifold. Copied.
                           Default: NULL, zeros; with `rate` it must be set. */
  const double *v; /**< (size) velocities at start, NaN = free. Copied. Default: NULL, all free. */
  const double *scale;    /**< (size) > 0, relevant changes. Copied. Default: NULL, ones. */
  baum_q_fn *mass;        /**< out (size x size), symmetric, no energy below 0. Default: NULL, must
                               be set. */
  baum_force_fn *force;   /**< out (size), g with velocity terms. Default: NULL, must be set. */
  baum_force_fn *force_q; /**< out (size x size), dg/dq. Default: NULL, by differences. */
  baum_force_fn *force_v; /**< out (size x size), dg/dv. Default: NULL, by differences. */
  baum_q_fn *potential;   /**< out (1) [J]. Default: NULL, none. */
  bool constant_mass;     /**< mass() depends on nothing. Default: false. */
  bool held;              /**< Assembly keeps the design positions. Default: false. */
  void *user;             /**< Passed to the functions, not owned. Default: NULL. */
  bool depends_on_velocity;       /**< force() reads v; RATTLE takes false alone. Default: true. */
  const double *position_scale;   /**< (position_count) > 0, relevant changes of positions. Copied.
                                       Used with `rate`. Default: NULL, ones. */
  baum_rate_fn *rate;             /**< N(q) v. Default: NULL, q' = v. */
  baum_move_fn *move;             /**< Default: NULL; with `rate` it must be set. */
  baum_difference_fn *difference; /**< Default: NULL; with `rate` it must be set. */
  baum_normalize_fn *normalize;   /**< Default: NULL, every q is on the manifold. */
  int32_t position_count;         /**< [-] Number of positions. Default: 0, `size`. */
} baum_coordinates_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_coordinates_def_init(baum_coordinates_def *def, size_t caller_size);

/** The default definition of user coordinates. */
static inline baum_coordinates_def baum_coordinates_def_default(void)
{
  baum_coordinates_def def;
  baum_coordinates_def_init(&def, sizeof def);
  return def;
}

/** Add a body of user coordinates.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the body; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_coordinates(baum_mechanism *mechanism,
                                                    const baum_coordinates_def *def,
                                                    baum_body_id *id);

/** Read a definition back; its pointers stay owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_coordinates(const baum_mechanism *mechanism,
                                                    baum_body_id id, baum_coordinates_def *out,
                                                    size_t caller_size);

/** Replace a definition; `size` must stay, and so must `position_count`.
 *  @return as baum_mechanism_add_coordinates()
 */
BAUM_API baum_status baum_mechanism_set_coordinates(baum_mechanism *mechanism, baum_body_id id,
                                                    const baum_coordinates_def *def);

/* ---- constraints given by functions ---------------------------------------------------------- */

/** Constraints Phi(q, t) = 0 over the coordinates of the named bodies. Only phi is required. nv
 *  below is the number of velocities of the named bodies together. Functions must hold everywhere,
 *  not only where Phi = 0. Differences evaluate phi to both sides of q and t: missing nu within
 *  0.006 and missing gamma within 0.05 units of time of t, so that a law that begins at t = 0 must
 *  be defined a little before, or nu and gamma be given. */
typedef struct baum_user_constraint_def {
  size_t struct_size;         /**< Set by the default. Do not write. */
  const char *name;           /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  const baum_body_id *bodies; /**< (body_count) acted on. Copied. Default: NULL, must be set. */
  int32_t body_count;         /**< [-] > 0. Default: 0, must be set. */
  int32_t row_count;          /**< [-] > 0. Default: 0, must be set. */
  baum_q_fn *phi;             /**< out (row_count). Default: NULL, must be set. */
  baum_q_fn *jacobian;        /**< out (row_count x nv), J. Default: NULL, differences of phi. */
  baum_q_fn *nu;     /**< out (row_count), -dPhi/dt. Default: NULL, differences of phi in t. */
  baum_qv_fn *gamma; /**< out (row_count), right side of (4). Default: NULL, differences. */
  void *user;        /**< Passed to the functions, not owned. Default: NULL. */
} baum_user_constraint_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_user_constraint_def_init(baum_user_constraint_def *def, size_t caller_size);

/** The default definition of a user constraint. */
static inline baum_user_constraint_def baum_user_constraint_def_default(void)
{
  baum_user_constraint_def def;
  baum_user_constraint_def_init(&def, sizeof def);
  return def;
}

/** Add constraints given by functions.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_user_constraint(baum_mechanism *mechanism,
                                                        const baum_user_constraint_def *def,
                                                        baum_joint_id *id);

/** Read a definition back; its pointers stay owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_user_constraint(const baum_mechanism *mechanism,
                                                        baum_joint_id id,
                                                        baum_user_constraint_def *out,
                                                        size_t caller_size);

/** Replace a definition; bodies and row_count must stay.
 *  @return as baum_mechanism_add_user_constraint()
 */
BAUM_API baum_status baum_mechanism_set_user_constraint(baum_mechanism *mechanism, baum_joint_id id,
                                                        const baum_user_constraint_def *def);

/* ---- drivers --------------------------------------------------------------------------------- */

/** One row that prescribes a joint's coordinate: coordinate(q) - s(t) = 0. The coordinate of a
 *  revolute joint is angle_b - angle_a, continuous over turns; that of a translational joint and of
 *  a pin in a slot the displacement of body_b's point from body_a's along the axis.
 *  s(t) = value + rate t + acceleration t^2 / 2, or a user law. */
typedef struct baum_driver_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_joint_id joint; /**< With a coordinate. Default: none, must be set. */
  double value;        /**< [rad or m] s at t = 0. Default: 0. */
  double rate;         /**< [rad/s or m/s] s' at t = 0. Default: 0. */
  double acceleration; /**< [rad/s^2 or m/s^2] s'', constant. Default: 0. */
  baum_law_fn *law;    /**< Replaces the polynomial. Default: NULL. */
  void *user;          /**< Passed to law, not owned. Default: NULL. */
} baum_driver_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_driver_def_init(baum_driver_def *def, size_t caller_size);

/** The default definition of a driver. */
static inline baum_driver_def baum_driver_def_default(void)
{
  baum_driver_def def;
  baum_driver_def_init(&def, sizeof def);
  return def;
}

/** Add a driver on the coordinate of a joint.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the driver, a joint of one row; left as it is on failure.
 *                         May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_driver(baum_mechanism *mechanism,
                                               const baum_driver_def *def, baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_driver(const baum_mechanism *mechanism, baum_joint_id id,
                                               baum_driver_def *out, size_t caller_size);

/** Replace a definition; the joint must stay.
 *  @return as baum_mechanism_add_driver()
 */
BAUM_API baum_status baum_mechanism_set_driver(baum_mechanism *mechanism, baum_joint_id id,
                                               const baum_driver_def *def);

/* ---- couplings ------------------------------------------------------------------------------- */

/** Law of a coupling: f[0] value, f[1] slope df/dx, f[2] curvature d2f/dx2 at coordinate x of
 *  joint_a [rad or m]; angles go on over turns. f is zeroed before the call; return as baum_q_fn.
 *  Third derivatives, where a method needs them, are differences of f[2]. It is also called beside
 *  the motion, by the check of derivatives. */
typedef int baum_coupling_fn(double x, double f[3], void *user);

/** One row that ties the coordinates of two joints: coordinate_b - f(coordinate_a) = 0, with
 *  f(x) = ratio x + offset, or a user law: that is a cam whose follower is a joint. Coordinates are
 *  those that drivers prescribe. The joints may share bodies, as a crank and a slider on the ground
 *  do. Reaction: the generalized force -J^T lambda over the velocities of the bodies of joint_a,
 *  then of those of joint_b, each body once, those of ground left out. */
typedef struct baum_coupling_def {
  size_t struct_size;    /**< Set by the default. Do not write. */
  const char *name;      /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_joint_id joint_a; /**< With a coordinate. Default: none, must be set. */
  baum_joint_id joint_b; /**< With a coordinate; not joint_a. Default: none, must be set. */
  double ratio;          /**< [unit b / unit a] Default: 1. */
  double offset; /**< [rad or m] of coordinate_b. Default: NaN, that of the design configuration. */
  baum_coupling_fn *law; /**< Replaces ratio and offset. Default: NULL. */
  void *user;            /**< Passed to law, not owned. Default: NULL. */
} baum_coupling_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_coupling_def_init(baum_coupling_def *def, size_t caller_size);

/** The default definition of a coupling of two joints. */
static inline baum_coupling_def baum_coupling_def_default(void)
{
  baum_coupling_def def;
  baum_coupling_def_init(&def, sizeof def);
  return def;
}

/** Add a coupling of two joints.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the joint; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_coupling(baum_mechanism *mechanism,
                                                 const baum_coupling_def *def, baum_joint_id *id);

/** Read a definition back; its name stays owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_coupling(const baum_mechanism *mechanism, baum_joint_id id,
                                                 baum_coupling_def *out, size_t caller_size);

/** Replace a definition; the joints must stay.
 *  @return as baum_mechanism_add_coupling()
 */
BAUM_API baum_status baum_mechanism_set_coupling(baum_mechanism *mechanism, baum_joint_id id,
                                                 const baum_coupling_def *def);

/* ---- forces given by functions --------------------------------------------------------------- */

/** Generalized force on the named bodies. nv below is the number of their velocities together. */
typedef struct baum_user_force_def {
  size_t struct_size;         /**< Set by the default. Do not write. */
  const char *name;           /**< Label in messages. Copied. Default: NULL, "force<k>". */
  const baum_body_id *bodies; /**< (body_count) acted on. Copied. Default: NULL, must be set. */
  int32_t body_count;         /**< [-] > 0. Default: 0, must be set. */
  baum_force_fn *force;       /**< out (nv). Default: NULL, must be set. */
  baum_force_fn *force_q;     /**< out (nv x nv). Default: NULL, by differences. */
  baum_force_fn *force_v;     /**< out (nv x nv). Default: NULL, by differences. */
  baum_q_fn *potential;       /**< out (1) [J]. Default: NULL, none. */
  void *user;                 /**< Passed to the functions, not owned. Default: NULL. */
  bool depends_on_velocity;   /**< force() reads v; RATTLE takes false alone. Default: true. */
} baum_user_force_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_user_force_def_init(baum_user_force_def *def, size_t caller_size);

/** The default definition of a user force. */
static inline baum_user_force_def baum_user_force_def_default(void)
{
  baum_user_force_def def;
  baum_user_force_def_init(&def, sizeof def);
  return def;
}

/** Add a force given by functions.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the force; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the
 *              mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_user_force(baum_mechanism *mechanism,
                                                   const baum_user_force_def *def,
                                                   baum_force_id *id);

/** Read a definition back; its pointers stay owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_user_force(const baum_mechanism *mechanism,
                                                   baum_force_id id, baum_user_force_def *out,
                                                   size_t caller_size);

/** Replace a definition; the bodies must stay.
 *  @return as baum_mechanism_add_user_force()
 */
BAUM_API baum_status baum_mechanism_set_user_force(baum_mechanism *mechanism, baum_force_id id,
                                                   const baum_user_force_def *def);

/* ---- inputs ---------------------------------------------------------------------------------- */

/** Add an input: a number that acts on the motion from outside, such as the torque of a motor. It
 *  scales the loads that name it (planar.h), and all force functions receive it. Every run and
 *  workspace begins with the initial value and holds it until it is changed there
 *  (baum_simulation_set_input(), baum_workspace_set_input()).
 *  @param      mechanism  not yet frozen
 *  @param[in]  name       label in messages. Copied. NULL: "input<k>"
 *  @param      initial    finite
 *  @param[out] id         receives the input; left as it is on failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the mechanism is
 *              unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_input(baum_mechanism *mechanism, const char *name,
                                              double initial, baum_input_id *id);

/** Read an initial value.
 *  @param[out] initial  not NULL
 *  @return              BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_input(const baum_mechanism *mechanism, baum_input_id id,
                                              double *initial);

/** Replace an initial value.
 *  @param mechanism  not yet frozen
 *  @param initial    finite
 *  @return           BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE
 */
BAUM_API baum_status baum_mechanism_set_input(baum_mechanism *mechanism, baum_input_id id,
                                              double initial);

/** Number of inputs, frozen or not; 0 for NULL. */
BAUM_API int32_t baum_mechanism_input_count(const baum_mechanism *mechanism);

/* ---- the mechanism --------------------------------------------------------------------------- */

/** Make an empty mechanism with gravity (0, -9.81, 0) m/s^2.
 *  @param[out] out  receives it, NULL on failure; release with baum_mechanism_destroy()
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_mechanism_create(baum_mechanism **out);

/** Copy a mechanism; the copy is not frozen, and the ids of one are valid in the other as long as
 *  nothing is added. Functions and their `user` pointers are shared. Definitions are copied as they
 *  were given: a joint with `point`, and lengths, angles and offsets that were left out, are taken
 *  from the copy's own design configuration, so give point_a, point_b and these numbers before you
 *  set another position or angle of a body.
 *  @param[in]  mechanism  frozen or not
 *  @param[out] out        receives the copy, NULL on failure
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_mechanism_copy(const baum_mechanism *mechanism, baum_mechanism **out);

/** Give up a mechanism. Simulations and workspaces made from it keep it alive as long as they live.
 *  @param mechanism  may be NULL
 */
BAUM_API void baum_mechanism_destroy(baum_mechanism *mechanism);

/** Set gravity, which acts on particles and rigid bodies, not on user coordinates.
 *  @param mechanism  not yet frozen
 *  @param x,y,z      [m/s^2] finite; planar bodies use x and y. Default of a mechanism:
 *                    (0, -9.81, 0).
 *  @return           BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE
 */
BAUM_API baum_status baum_mechanism_set_gravity(baum_mechanism *mechanism, double x, double y,
                                                double z);

/** Read gravity.
 *  @param[out] gravity  (3) [m/s^2]
 *  @return              BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_gravity(const baum_mechanism *mechanism, double gravity[3]);

/** Set the characteristic length L that tolerances and errors of positions are relative to.
 *  @param mechanism  not yet frozen
 *  @param length     [m] > 0. Default of a mechanism: the size of the design configuration, found
 *                    at freeze.
 *  @return           BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE
 */
BAUM_API baum_status baum_mechanism_set_characteristic_length(baum_mechanism *mechanism,
                                                              double length);

/** Read the characteristic length.
 *  @param[out] length  [m]; NaN when it was not set and the mechanism is not frozen
 *  @return             BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_characteristic_length(const baum_mechanism *mechanism,
                                                              double *length);

/** Check everything and make the mechanism constant. A second call does nothing.
 *  @param mechanism  with at least one body
 *  @return           BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (nothing to move), BAUM_ERR_MEMORY;
 *                    on failure still not frozen
 */
BAUM_API baum_status baum_mechanism_freeze(baum_mechanism *mechanism);

/** Whether a mechanism is frozen. NULL gives false. */
BAUM_API bool baum_mechanism_is_frozen(const baum_mechanism *mechanism);

/** Sizes of a frozen mechanism.
 *  @param[out] nq,nv,nc  numbers of positions, velocities and constraint rows. Each may be NULL.
 *  @return               BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE
 */
BAUM_API baum_status baum_mechanism_sizes(const baum_mechanism *mechanism, int32_t *nq, int32_t *nv,
                                          int32_t *nc);

/** Rows of a joint in Phi and lambda of a frozen mechanism.
 *  @param[out] first,count  may be NULL
 *  @return                  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE
 */
BAUM_API baum_status baum_mechanism_rows(const baum_mechanism *mechanism, baum_joint_id joint,
                                         int32_t *first, int32_t *count);

/** Places of a body in q and v of a frozen mechanism.
 *  @param[out] first_q,first_v  may be NULL
 *  @return                      BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE
 */
BAUM_API baum_status baum_mechanism_columns(const baum_mechanism *mechanism, baum_body_id body,
                                            int32_t *first_q, int32_t *first_v);

/** Name of a body, owned by the mechanism; NULL when the id is not one of its bodies. */
BAUM_API const char *baum_mechanism_body_name(const baum_mechanism *mechanism, baum_body_id body);

/** Name of a joint, owned by the mechanism; NULL when the id is not one of its joints. */
BAUM_API const char *baum_mechanism_joint_name(const baum_mechanism *mechanism,
                                               baum_joint_id joint);

/** Name of an input, owned by the mechanism; NULL when the id is not one of its inputs. */
BAUM_API const char *baum_mechanism_input_name(const baum_mechanism *mechanism,
                                               baum_input_id input);

/** What a mechanism can do at its assembled start pose. */
typedef struct baum_mobility {
  size_t struct_size;         /**< Set by baum_mechanism_mobility(). */
  int32_t degrees_of_freedom; /**< [-] nv - rank of J at nearby configurations; -1: cannot be
                                   assembled. */
  int32_t redundant_rows;     /**< [-] rows that depend on others at every nearby pose. */
  int32_t conflicting_rows;   /**< [-] rows that cannot be met together with the others. */
  int32_t free_bodies;        /**< [-] bodies without a joint. */
  bool
    near_singular;  /**< The start configuration has fewer independent rows than its neighbours, or
                                  comes within 1e-5 of that, relative to the scales. */
  double worst_phi; /**< [m or rad] largest |Phi| after assembly. */
  baum_joint_id worst_joint; /**< Joint of worst_phi. */
  char text[1024];           /**< The same in messages, by name. */
} baum_mobility;

/** Count degrees of freedom, redundant and conflicting rows and free bodies at the assembled start
 *  pose, at t = 0.
 *  @param[in]  mechanism    frozen; otherwise a copy is frozen and examined
 *  @param[out] out          filled also when rows conflict
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK,
 *              BAUM_ERR_NOT_FINITE, BAUM_ERR_SINGULAR
 */
BAUM_API baum_status baum_mechanism_mobility(const baum_mechanism *mechanism, baum_mobility *out,
                                             size_t caller_size);

/** What an evaluation of the accelerations costs in a run, and which work it skips. Counts follow
 *  from the structure; forces and functions of the user are not counted. */
typedef struct baum_report {
  size_t struct_size; /**< Set by baum_mechanism_report(). */
  int32_t bodies;     /**< [-] without ground. */
  int32_t joints;     /**< [-] with drivers and user constraints. */
  int32_t forces;     /**< [-] gravity not among them. */
  int32_t velocities; /**< [-] nv. */
  int32_t rows;       /**< [-] nc. */
  int32_t
    degrees_of_freedom;   /**< [-] nv - rank of J; -1: not known, see baum_mechanism_mobility(). */
  int32_t redundant_rows; /**< [-] left out of every solution. */
  int32_t constant_rows;  /**< [-] without time derivatives, for they are not of time. */
  int32_t islands;        /**< [-] of bodies that joints hold together, fixed ones left out. */
  int32_t fixed_bodies;   /**< [-] welded to ground: solved for where multipliers are wanted. */
  bool constant_mass;     /**< Masses are constant: inverted once. */
  bool constant_force;    /**< So are all forces. */
  bool blocks;            /**< Solved by blocks (BAUM_SOLVER_BLOCK); else by KLU. */
  int32_t nodes;          /**< [-] pairs of rows; 0 for KLU. */
  int32_t couplings;      /**< [-] of nodes when these are eliminated; 0 for KLU. */
  int32_t fill;           /**< [-] couplings that no body makes, but elimination; 0 for KLU. */
  int32_t most_couplings; /**< [-] of one node; 0 for KLU. */
  int32_t most_joints;    /**< [-] of one body that is not fixed. */
  baum_body_id most_joined; /**< That body; none when there are no joints. */
  char text[2048];          /**< The same in lines, by name, with the reasons. */
} baum_report;

/** Find out what a mechanism costs, at the assembled start configuration, at t = 0, with the solver
 *  that a run takes by itself.
 *  @param[in]  mechanism    frozen; otherwise a copy is frozen and examined
 *  @param[out] out          filled also when the mechanism cannot be assembled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_mechanism_report(const baum_mechanism *mechanism, baum_report *out,
                                           size_t caller_size);

/** Compare the derivatives that user functions give (jacobian, nu, gamma, force_q, force_v, and
 *  those in laws and curves) with differences, in the design configuration at t = 0 and at three
 *  configurations beside it, at t = 0, 0.37 and 1.3. An entry is wrong when it is off by more than
 *  1e-6 of itself and 1e-9 of its row. mass() must be symmetric, without negative numbers on its
 *  diagonal in the design configuration, and constant where constant_mass says so. Kinks, and poses
 *  and times that functions refuse, raise no alarm; an element that refuses all configurations
 *  gives that failure, but for the laws of drivers.
 *  Runs by itself when a simulation is created.
 *  @param[in] mechanism  frozen
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT (the message names element, function, entry and both
 *             values), BAUM_ERR_STATE, BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE
 */
BAUM_API baum_status baum_mechanism_check_derivatives(const baum_mechanism *mechanism);

#ifdef __cplusplus
}
#endif

#endif
