/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Mechanisms: what is simulated. A mechanism consists of bodies, joints, forces and inputs.
 *
 *  Use: add elements, freeze the mechanism, then run simulations. A frozen mechanism is constant
 *  and may be shared between threads.
 *  - A *body* is anything with coordinates: rigid bodies and particles (planar.h, spatial.h), or
 *    user coordinates.
 *  - A *joint* is anything with constraint rows: joints (planar.h, planar_joints.h,
 *    spatial_joints.h), drivers, couplings or user constraints.
 *  - A *force* is anything else that acts on bodies.
 *
 *  Equations of your own, without predefined elements, are one body of user coordinates and one
 *  user constraint.
 *
 *  Equations (numbers in parentheses are those of Flores et al. 2008): constraints Phi(q, t) = 0
 *  (1), their first derivative Phi' = J v - nu = 0 (3), their second derivative Phi'' = J a - gamma
 *  = 0 (4), and the equations of motion M a + J^T lambda = g (2). docs/notation.md lists all
 *  symbols.
 *
 *  Units: any consistent set. Only the default gravity assumes SI. Angles are in radians. Comments
 *  give units in SI, [-] for a pure number, and shapes of arrays in parentheses. The *scale* of a
 *  coordinate is the characteristic length for a length, 1 for an angle, and `scale` for user
 *  coordinates.
 *
 *  Order: q, v, constraint rows and lambda follow the order in which bodies and joints were added.
 *
 *  NULL: pointers must not be NULL unless their comment says so.
 *
 *  Names of elements, inputs and events appear in messages. NULL selects the default name. Empty
 *  names and names with control characters are refused.
 *
 *  Definitions: each kind K of element has a struct baum_K_def and five functions:
 *  baum_K_def_default(), baum_K_def_init(), baum_mechanism_add_K(), baum_mechanism_get_K() and
 *  baum_mechanism_set_K(). They behave alike for every kind. The comments after
 *  baum_coordinates_def hold for all kinds.
 *
 *  Versions: fields are only ever appended to a struct. `struct_size` tells the library which
 *  fields a program knows. A program that was compiled with an older version passes a smaller
 *  struct, and the missing fields have their defaults. Any other size, such as 0 in an all-zero
 *  struct or the size of a newer version, is refused (BAUM_ERR_STRUCT). In a struct that the
 *  library fills, it writes the first caller_size bytes only.
 *
 *  Callbacks: q and v hold the coordinates of the named bodies one after the other. Matrices are
 *  dense and row-major. Outputs are zeroed before the call. Return 0 on success, > 0 to ask for a
 *  smaller step, < 0 to stop the run. If threads share the mechanism, callbacks must be reentrant.
 *  A callback may call the library, but must not use the workspace or run that is calling it:
 *  functions of this object that return a status fail with BAUM_ERR_STATE, and destroying it does
 *  nothing. The callback may only read its time, q, v, inputs and texts, and cancel the run. */
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

/** Bodies, joints, forces and inputs; under construction or frozen. */
typedef struct baum_mechanism baum_mechanism;

/** Identifies a body of one mechanism and its copies. All-zero means none and is refused. */
typedef struct baum_body_id {
  int32_t index1; /**< Private: 1 + position in the mechanism. */
  uint32_t tag;   /**< Private: which mechanism. */
} baum_body_id;

/** Identifies a joint, which is anything with constraint rows. All-zero means none and is refused.
 */
typedef struct baum_joint_id {
  int32_t index1; /**< Private: 1 + position in the mechanism. */
  uint32_t tag;   /**< Private: which mechanism. */
} baum_joint_id;

/** Identifies a force. All-zero means none and is refused. */
typedef struct baum_force_id {
  int32_t index1; /**< Private: 1 + position in the mechanism. */
  uint32_t tag;   /**< Private: which mechanism. */
} baum_force_id;

/** Identifies an input. All-zero means none. */
typedef struct baum_input_id {
  int32_t index1; /**< Private: 1 + position in the mechanism. */
  uint32_t tag;   /**< Private: which mechanism. */
} baum_input_id;

/** The fixed body of every mechanism. */
static const baum_body_id BAUM_GROUND = {-1, 0};

/** A function of time and positions.
 *  @param      t     [s] time
 *  @param[in]  q     positions of the named bodies
 *  @param[out] out   the result, whose shape the definition states
 *  @param      user  the definition's `user`
 *  @return  0 success, > 0 retry with a smaller step, < 0 stop */
typedef int baum_q_fn(double t, const double *q, double *out, void *user);

/** A function of time, positions and velocities. Otherwise like baum_q_fn. */
typedef int baum_qv_fn(double t, const double *q, const double *v, double *out, void *user);

/** A generalized force. Otherwise like baum_qv_fn. `inputs` holds the present values of all inputs
 *  in the order of adding; it is NULL if there are none. */
typedef int baum_force_fn(double t, const double *q, const double *v, const double *inputs,
                          double *out, void *user);

/** The law of a driver: s[0] is the value, s[1] the first and s[2] the second derivative at time t.
 *  s[1] and s[2] must be the exact derivatives; baum_mechanism_check_derivatives() compares them.
 *  The library also calls the law at times outside the run: to check derivatives, and to find
 *  redundant rows in configurations near the start. Returns the same as baum_q_fn. */
typedef int baum_law_fn(double t, double s[3], void *user);

/* ---- a body given by functions --------------------------------------------------------------- */

/** Computes dq = N(q) v, which is linear in v. q may be off the manifold by the error of a step.
 *  Scaling q must scale dq by the same factor. */
typedef void baum_rate_fn(const double *q, const double *v, double *dq, void *user);

/** Moves q in place along constant v for the time h, accurate to second order in h or better. With
 *  h = 1, v is a displacement (size). */
typedef void baum_move_fn(double h, const double *v, double *q, void *user);

/** Computes the displacement dx (size) for which baum_move_fn with h = 1 takes `from` to `to`. */
typedef void baum_difference_fn(const double *from, const double *to, double *dx, void *user);

/** Replaces q by the nearest point on the manifold. Do not change the sign of a quaternion here:
 *  methods that combine several positions would lose their order where the sign changes. */
typedef void baum_normalize_fn(double *q, void *user);

/** A body with user coordinates, whose mass and force are given by functions.
 *
 *  Usually v = q'. If q is not a vector, for example a unit quaternion, set position_scale and the
 *  fields below it; then q' = N(q) v. All functions but `rate` receive a normalized q. Derivatives
 *  with respect to q, including those of constraints on these coordinates, are then derivatives
 *  along displacements (size): (Phi_q N) in place of Phi_q. rate, move, difference and normalize
 *  report failure by writing NaN. */
typedef struct baum_coordinates_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  int32_t size;       /**< [-] > 0, number of velocities. Default: 0, must be set. */
  /** (position_count) design positions, on the manifold. Copied. Default: NULL, zeros; must be set
   *  if `rate` is. */
  const double *q;
  /** (size) initial velocities; NaN: free, determined by assembly. Copied. Default: NULL, all free.
   */
  const double *v;
  /** (size) > 0, a typical change of each coordinate; tolerances are relative to it. Copied.
   *  Default: NULL, ones. */
  const double *scale;
  /** out (size x size), symmetric and positive semidefinite. Default: NULL, must be set. */
  baum_q_fn *mass;
  baum_force_fn *force;     /**< out (size), g with velocity terms. Default: NULL, must be set. */
  baum_force_fn *force_q;   /**< out (size x size), dg/dq. Default: NULL, by differences. */
  baum_force_fn *force_v;   /**< out (size x size), dg/dv. Default: NULL, by differences. */
  baum_q_fn *potential;     /**< out (1) [J]. Default: NULL, none. */
  bool constant_mass;       /**< mass() always returns the same matrix. Default: false. */
  bool held;                /**< Assembly keeps the design positions. Default: false. */
  void *user;               /**< Passed to the functions. Not owned. Default: NULL. */
  bool depends_on_velocity; /**< force() reads v. RATTLE requires false. Default: true. */
  /** (position_count) > 0, a typical change of each position. Copied. Used if `rate` is set.
   *  Default: NULL, ones. */
  const double *position_scale;
  baum_rate_fn *rate;             /**< N(q) v. Default: NULL, q' = v. */
  baum_move_fn *move;             /**< Default: NULL; must be set if `rate` is. */
  baum_difference_fn *difference; /**< Default: NULL; must be set if `rate` is. */
  baum_normalize_fn *normalize;   /**< Default: NULL, if every q is on the manifold. */
  int32_t position_count;         /**< [-] number of positions. Default: 0, the same as `size`. */
} baum_coordinates_def;

/** Set every field to its default. Bindings call this; C programs call the function below.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def; no byte beyond it is written */
BAUM_API void baum_coordinates_def_init(baum_coordinates_def *def, size_t caller_size);

/** Get a definition with every field at its default. Start from it and set the other fields.
 *  @return  the default definition */
static inline baum_coordinates_def baum_coordinates_def_default(void)
{
  baum_coordinates_def def;
  baum_coordinates_def_init(&def, sizeof def);
  return def;
}

/** Add an element. The library copies the definition, its name and its arrays; it stores function
 *  pointers and `user`, but not what `user` points to.
 *  @param      mechanism  not frozen; unchanged on failure
 *  @param[in]  def        the definition
 *  @param[out] id         receives the id of the element; not written on failure. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE (frozen), BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_mechanism_add_coordinates(baum_mechanism *mechanism,
                                                    const baum_coordinates_def *def,
                                                    baum_body_id *id);

/** Read a definition back as it was given. Its pointers stay owned by the mechanism and are valid
 *  until the definition is set again.
 *  @param      mechanism    frozen or not
 *  @param      id           an element of this kind
 *  @param[out] out          receives the definition
 *  @param      caller_size  sizeof *out; no byte beyond it is written
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_mechanism_get_coordinates(const baum_mechanism *mechanism,
                                                    baum_body_id id, baum_coordinates_def *out,
                                                    size_t caller_size);

/** Replace a definition. The structure must stay the same: the bodies or joints that the element
 *  acts on, numbers of rows and coordinates, and whether `rate` is given.
 *  @param     mechanism  not frozen; unchanged on failure
 *  @param     id         an element of this kind
 *  @param[in] def        the new definition, copied as by the add function
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE (frozen), BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_mechanism_set_coordinates(baum_mechanism *mechanism, baum_body_id id,
                                                    const baum_coordinates_def *def);

/* ---- constraints given by functions ---------------------------------------------------------- */

/** Constraints Phi(q, t) = 0 on the coordinates of the named bodies, given by functions. Only phi
 *  is required. nv below is the total number of velocities of the named bodies.
 *
 *  With velocity_level = true they are constraints J(q, t) v = nu(q, t) on velocities that are not
 *  derivatives of a Phi (non-holonomic constraints, such as a wheel that does not slip). Then
 *  jacobian is required, phi must be NULL, and the right side of (4) becomes gamma - alpha (J v -
 *  nu).
 *
 *  The functions must be valid everywhere, not only where Phi = 0. Missing derivatives are replaced
 *  by central differences of phi. These evaluate phi up to 0.006 time units before and after t for
 *  nu, and up to 0.05 for gamma. If phi is not defined before t = 0, give nu and gamma. */
typedef struct baum_user_constraint_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  /** (body_count) bodies acted on. Copied. Default: NULL, must be set. */
  const baum_body_id *bodies;
  int32_t body_count; /**< [-] > 0. Default: 0, must be set. */
  int32_t row_count;  /**< [-] > 0. Default: 0, must be set. */
  /** out (row_count). Default: NULL, must be set unless velocity_level. */
  baum_q_fn *phi;
  baum_q_fn *jacobian; /**< out (row_count x nv), J. Default: NULL, differences of phi. */
  baum_q_fn *nu;       /**< out (row_count), -dPhi/dt. Default: NULL, differences of phi in t. */
  baum_qv_fn *gamma;   /**< out (row_count), right side of (4). Default: NULL, differences. */
  void *user;          /**< Passed to the functions. Not owned. Default: NULL. */
  bool velocity_level; /**< J v = nu without Phi; nu NULL: 0. Default: false. */
} baum_user_constraint_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_user_constraint_def_init(baum_user_constraint_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_user_constraint_def baum_user_constraint_def_default(void)
{
  baum_user_constraint_def def;
  baum_user_constraint_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_user_constraint(baum_mechanism *mechanism,
                                                        const baum_user_constraint_def *def,
                                                        baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_user_constraint(const baum_mechanism *mechanism,
                                                        baum_joint_id id,
                                                        baum_user_constraint_def *out,
                                                        size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_user_constraint(baum_mechanism *mechanism, baum_joint_id id,
                                                        const baum_user_constraint_def *def);

/* ---- coordinates of joints ------------------------------------------------------------------- */

/** A coordinate of a joint, for drivers, couplings, joint springs, channels and events:
 *
 *  - planar revolute joint, spatial revolute joint: ANGLE
 *  - planar translational joint, pin in a slot: DISPLACEMENT
 *  - prismatic joint, point on a line: DISPLACEMENT
 *  - cylindrical joint: DISPLACEMENT, ANGLE
 *  - universal joint: ANGLE, ANGLE_B
 *  - spatial planar joint: X, Y, ANGLE
 *
 *  Angles of planar joints are continuous over revolutions. For angles of spatial joints, a run
 *  counts the revolutions; functions of a workspace know one state only and use angles between -pi
 *  and pi. */
typedef enum baum_joint_coordinate {
  BAUM_COORDINATE_FIRST = 0,        /**< The first in the list above; most joints have only one. */
  BAUM_COORDINATE_DISPLACEMENT = 1, /**< [m] of body_b's point from body_a's along the axis. */
  BAUM_COORDINATE_ANGLE = 2,        /**< [rad] of body_b relative to body_a about the axis. */
  BAUM_COORDINATE_ANGLE_B = 3,      /**< [rad] about axis_b. */
  BAUM_COORDINATE_X = 4,            /**< [m] of body_b's point from body_a's in the plane. */
  BAUM_COORDINATE_Y = 5             /**< [m] perpendicular to x in the plane. */
} baum_joint_coordinate;

/* ---- drivers --------------------------------------------------------------------------------- */

/** A driver: one row that prescribes the coordinate of a joint, coordinate(q) - s(t) = 0, with s(t)
 *  = value + rate t + acceleration t^2 / 2 or a law of your own. An angle of a spatial joint is
 *  prescribed up to whole revolutions. */
typedef struct baum_driver_def {
  size_t struct_size;               /**< Set by the default. Do not write. */
  const char *name;                 /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_joint_id joint;              /**< A joint with a coordinate. Default: none, must be set. */
  double value;                     /**< [rad or m] s at t = 0. Default: 0. */
  double rate;                      /**< [rad/s or m/s] s' at t = 0. Default: 0. */
  double acceleration;              /**< [rad/s^2 or m/s^2] s'', constant. Default: 0. */
  baum_law_fn *law;                 /**< Replaces the polynomial. Default: NULL. */
  void *user;                       /**< Passed to law. Not owned. Default: NULL. */
  baum_joint_coordinate coordinate; /**< [-] Default: BAUM_COORDINATE_FIRST. */
} baum_driver_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_driver_def_init(baum_driver_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_driver_def baum_driver_def_default(void)
{
  baum_driver_def def;
  baum_driver_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_driver(baum_mechanism *mechanism,
                                               const baum_driver_def *def, baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_driver(const baum_mechanism *mechanism, baum_joint_id id,
                                               baum_driver_def *out, size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_driver(baum_mechanism *mechanism, baum_joint_id id,
                                               const baum_driver_def *def);

/* ---- couplings ------------------------------------------------------------------------------- */

/** The law of a coupling: f[0] is the value, f[1] the first and f[2] the second derivative at
 *  coordinate x of joint_a [rad or m]. Angles count revolutions, except for angles of spatial
 *  joints in functions of a workspace, which are between -pi and pi. f is zeroed before the call.
 *  Methods that need third derivatives take differences of f[2]. The check of derivatives also
 *  calls the law at coordinates near those of the motion. Returns the same as baum_q_fn. */
typedef int baum_coupling_fn(double x, double f[3], void *user);

/** A coupling: one row that ties the coordinates of two joints, coordinate_b - f(coordinate_a) = 0,
 *  with f(x) = ratio x + offset or a law of your own. A law describes a cam whose follower moves
 *  along coordinate_b. The joints may share bodies, such as a crank and a slider on the ground.
 *  With angle and displacement of one cylindrical joint it is a screw.
 *
 *  Without a law, an angle of a spatial joint may change by whole revolutions without violating the
 *  row. If both coordinates are such angles, this holds only if ratio is a fraction with a
 *  denominator of at most 1000. With other ratios, revolutions count.
 *
 *  Reaction: the generalized force -J^T lambda on the velocities of the bodies of joint_a, then of
 *  joint_b; each body once, without ground. */
typedef struct baum_coupling_def {
  size_t struct_size;    /**< Set by the default. Do not write. */
  const char *name;      /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_joint_id joint_a; /**< A joint with a coordinate. Default: none, must be set. */
  /** A joint with a coordinate; joint_a for two coordinates of it. Default: none, must be set. */
  baum_joint_id joint_b;
  double ratio; /**< [unit of b / unit of a] Default: 1. */
  /** [rad or m] of coordinate_b. Default: NaN, the value in the design configuration. */
  double offset;
  baum_coupling_fn *law;              /**< Replaces ratio and offset. Default: NULL. */
  void *user;                         /**< Passed to law. Not owned. Default: NULL. */
  baum_joint_coordinate coordinate_a; /**< [-] Default: BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinate_b; /**< [-] Default: BAUM_COORDINATE_FIRST. */
} baum_coupling_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_coupling_def_init(baum_coupling_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_coupling_def baum_coupling_def_default(void)
{
  baum_coupling_def def;
  baum_coupling_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_coupling(baum_mechanism *mechanism,
                                                 const baum_coupling_def *def, baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_coupling(const baum_mechanism *mechanism, baum_joint_id id,
                                                 baum_coupling_def *out, size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_coupling(baum_mechanism *mechanism, baum_joint_id id,
                                                 const baum_coupling_def *def);

/* ---- forces given by functions --------------------------------------------------------------- */

/** A generalized force on the named bodies, given by functions. nv below is the total number of
 *  velocities of these bodies. A planar body receives a force x, y [N] and a moment [N m]; a
 *  spatial body a force x, y, z in ground axes and a moment x, y, z in body axes; both about the
 *  centre of mass. */
typedef struct baum_user_force_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "force<k>". */
  /** (body_count) bodies acted on. Copied. Default: NULL, must be set. */
  const baum_body_id *bodies;
  int32_t body_count;       /**< [-] > 0. Default: 0, must be set. */
  baum_force_fn *force;     /**< out (nv). Default: NULL, must be set. */
  baum_force_fn *force_q;   /**< out (nv x nv). Default: NULL, by differences. */
  baum_force_fn *force_v;   /**< out (nv x nv). Default: NULL, by differences. */
  baum_q_fn *potential;     /**< out (1) [J]. Default: NULL, none. */
  void *user;               /**< Passed to the functions. Not owned. Default: NULL. */
  bool depends_on_velocity; /**< force() reads v. RATTLE requires false. Default: true. */
} baum_user_force_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_user_force_def_init(baum_user_force_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_user_force_def baum_user_force_def_default(void)
{
  baum_user_force_def def;
  baum_user_force_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_user_force(baum_mechanism *mechanism,
                                                   const baum_user_force_def *def,
                                                   baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_user_force(const baum_mechanism *mechanism,
                                                   baum_force_id id, baum_user_force_def *out,
                                                   size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_user_force(baum_mechanism *mechanism, baum_force_id id,
                                                   const baum_user_force_def *def);

/* ---- springs of joints ----------------------------------------------------------------------- */

/** The law of a spring: tension or torque, and its derivatives.
 *  @param      length  [m] distance of the points; of a torsion spring [rad] angle_b - angle_a;
 *                      of a joint spring the coordinate
 *  @param      rate    [m/s or rad/s] time derivative of length
 *  @param[out] out     (3) zeroed before the call. out[0]: tension [N] (positive pulls the points
 *                      together), restoring force [N] or torque [N m]; out[1]: its derivative with
 *                      respect to length [N/m or N m/rad]; out[2]: its derivative with respect to
 *                      rate [N s/m or N m s/rad]
 *  @param      user    the definition's `user`
 *  @return  as baum_q_fn. The check of derivatives also calls it at configurations near those of
 *           the mechanism. */
typedef int baum_spring_fn(double length, double rate, double out[3], void *user);

/** A linear spring and damper in parallel on a coordinate of a joint, or a law of your own. It
 *  drives the coordinate towards free_value, by a force along the axis or a torque about it.
 *
 *  In a run, angles of spatial joints count revolutions, so a spring winds up further with each
 *  revolution. Functions of a workspace use angles between -pi and pi. */
typedef struct baum_joint_spring_def {
  size_t struct_size;               /**< Set by the default. Do not write. */
  const char *name;                 /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_joint_id joint;              /**< A joint with a coordinate. Default: none, must be set. */
  baum_joint_coordinate coordinate; /**< [-] Default: BAUM_COORDINATE_FIRST. */
  double stiffness;                 /**< [N m/rad or N/m] >= 0. Default: 0. */
  double damping;                   /**< [N m s/rad or N s/m] >= 0. Default: 0. */
  /** [rad or m] coordinate without force. Default: NaN, the value in the design configuration. */
  double free_value;
  /** Replaces the three fields above; the spring then has no potential energy. Default: NULL. */
  baum_spring_fn *law;
  void *user;               /**< Passed to law. Not owned. Default: NULL. */
  bool depends_on_velocity; /**< law reads rate. RATTLE requires false. Default: true. */
} baum_joint_spring_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_joint_spring_def_init(baum_joint_spring_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_joint_spring_def baum_joint_spring_def_default(void)
{
  baum_joint_spring_def def;
  baum_joint_spring_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_joint_spring(baum_mechanism *mechanism,
                                                     const baum_joint_spring_def *def,
                                                     baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_joint_spring(const baum_mechanism *mechanism,
                                                     baum_force_id id, baum_joint_spring_def *out,
                                                     size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_joint_spring(baum_mechanism *mechanism, baum_force_id id,
                                                     const baum_joint_spring_def *def);

/* ---- inputs ---------------------------------------------------------------------------------- */

/** Add an input: a number that acts on the motion from outside, such as the torque of a motor. An
 *  input multiplies the loads that name it (planar.h), and all force functions receive it. Runs and
 *  workspaces begin with the initial value and keep it until baum_simulation_set_input() or
 *  baum_workspace_set_input() changes it.
 *  @param      mechanism  not frozen; unchanged on failure
 *  @param[in]  name       label in messages. Copied. NULL: "input<k>".
 *  @param      initial    finite, in the unit of your choice
 *  @param[out] id         receives the id of the input; not written on failure. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (frozen), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_add_input(baum_mechanism *mechanism, const char *name,
                                              double initial, baum_input_id *id);

/** Read an initial value.
 *  @param      mechanism  frozen or not
 *  @param      id         one of its inputs
 *  @param[out] initial    receives it
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_mechanism_get_input(const baum_mechanism *mechanism, baum_input_id id,
                                              double *initial);

/** Replace an initial value.
 *  @param mechanism  not frozen
 *  @param id         one of its inputs
 *  @param initial    finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (frozen) */
BAUM_API baum_status baum_mechanism_set_input(baum_mechanism *mechanism, baum_input_id id,
                                              double initial);

/** Count the inputs. @param mechanism  frozen or not @return 0 for NULL */
BAUM_API int32_t baum_mechanism_input_count(const baum_mechanism *mechanism);

/* ---- the mechanism --------------------------------------------------------------------------- */

/** Create an empty mechanism with gravity (0, -9.81, 0) m/s^2.
 *  @param[out] out  receives it, NULL on failure; release it with baum_mechanism_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_create(baum_mechanism **out);

/** Copy a mechanism. The copy is not frozen. Ids of the original are valid in the copy, and the
 *  other way round, until elements are added to either.
 *
 *  Definitions are copied as they were given. Values that definitions leave to the design
 *  configuration therefore follow from the design configuration of the copy. These are the places
 *  of joints with `point`, and lengths, angles and offsets that were not given. To keep these
 *  values while you change the position or angle of a body, first give point_a, point_b, lengths,
 *  angles and offsets as numbers. Function pointers and `user` are shared.
 *  @param      mechanism  frozen or not
 *  @param[out] out        receives the copy, NULL on failure; release it with
 *                         baum_mechanism_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_copy(const baum_mechanism *mechanism, baum_mechanism **out);

/** Release a mechanism. Simulations and workspaces made from it keep it alive.
 *  @param mechanism  may be NULL */
BAUM_API void baum_mechanism_destroy(baum_mechanism *mechanism);

/** Set gravity, which acts on particles and rigid bodies but not on user coordinates.
 *  @param mechanism  not frozen
 *  @param x,y,z      [m/s^2] finite; planar bodies use x and y. Default of a mechanism: (0, -9.81,
 *                    0).
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (frozen) */
BAUM_API baum_status baum_mechanism_set_gravity(baum_mechanism *mechanism, double x, double y,
                                                double z);

/** Read gravity.
 *  @param      mechanism  frozen or not
 *  @param[out] gravity    (3) [m/s^2]
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_mechanism_get_gravity(const baum_mechanism *mechanism, double gravity[3]);

/** Set the characteristic length. Tolerances and errors of positions are relative to it.
 *  @param mechanism  not frozen
 *  @param length     [m] > 0. Default of a mechanism: the size of the design configuration, found
 *                    when it is frozen.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (frozen) */
BAUM_API baum_status baum_mechanism_set_characteristic_length(baum_mechanism *mechanism,
                                                              double length);

/** Read the characteristic length.
 *  @param      mechanism  frozen or not
 *  @param[out] length     [m]; NaN if it was not set and the mechanism is not frozen
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_mechanism_get_characteristic_length(const baum_mechanism *mechanism,
                                                              double *length);

/** Check everything and make the mechanism constant. A second call does nothing.
 *  @param mechanism  with at least one body; not frozen on failure
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (no bodies), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_freeze(baum_mechanism *mechanism);

/** Whether a mechanism is frozen. @param mechanism  may be NULL @return false for NULL */
BAUM_API bool baum_mechanism_is_frozen(const baum_mechanism *mechanism);

/** Read the sizes of a mechanism.
 *  @param      mechanism  frozen
 *  @param[out] nq,nv,nc   [-] numbers of positions, velocities and constraint rows. Each may be
 *                         NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen) */
BAUM_API baum_status baum_mechanism_sizes(const baum_mechanism *mechanism, int32_t *nq, int32_t *nv,
                                          int32_t *nc);

/** Find the rows of a joint in Phi and lambda.
 *  @param      mechanism    frozen
 *  @param      joint        one of its joints
 *  @param[out] first,count  [-] first row and number of rows. Each may be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen) */
BAUM_API baum_status baum_mechanism_rows(const baum_mechanism *mechanism, baum_joint_id joint,
                                         int32_t *first, int32_t *count);

/** Find a body in q and v.
 *  @param      mechanism        frozen
 *  @param      body             one of its bodies
 *  @param[out] first_q,first_v  [-] first index in q and in v. Each may be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen) */
BAUM_API baum_status baum_mechanism_columns(const baum_mechanism *mechanism, baum_body_id body,
                                            int32_t *first_q, int32_t *first_v);

/** Name of a body.
 *  @param mechanism  frozen or not
 *  @param body       one of its bodies
 *  @return  text owned by the mechanism; NULL for other ids */
BAUM_API const char *baum_mechanism_body_name(const baum_mechanism *mechanism, baum_body_id body);

/** Name of a joint.
 *  @param mechanism  frozen or not
 *  @param joint      one of its joints
 *  @return  text owned by the mechanism; NULL for other ids */
BAUM_API const char *baum_mechanism_joint_name(const baum_mechanism *mechanism,
                                               baum_joint_id joint);

/** Name of an input.
 *  @param mechanism  frozen or not
 *  @param input      one of its inputs
 *  @return  text owned by the mechanism; NULL for other ids */
BAUM_API const char *baum_mechanism_input_name(const baum_mechanism *mechanism,
                                               baum_input_id input);

/** How a mechanism can move from its assembled initial configuration. */
typedef struct baum_mobility {
  size_t struct_size; /**< Set by baum_mechanism_mobility(). */
  /** [-] nv - rank of J at nearby configurations; -1: cannot be assembled. */
  int32_t degrees_of_freedom;
  /** [-] rows that depend on others at every nearby configuration. */
  int32_t redundant_rows;
  int32_t conflicting_rows; /**< [-] rows that contradict the others. */
  int32_t free_bodies;      /**< [-] bodies without a joint. */
  /** The initial configuration is singular: J has a lower rank there than nearby. Also true within
   *  1e-5 of such a configuration, relative to the scales. */
  bool near_singular;
  double worst_phi;          /**< [m or rad] largest |Phi| after assembly. */
  baum_joint_id worst_joint; /**< Joint of worst_phi. */
  char text[1024];           /**< These results in words, with the names of elements. */
  int32_t velocity_rows;     /**< [-] rows of velocity level (non-holonomic constraints). */
  /** [-] degrees of freedom of position: nv - rank of J without rows of velocity level.
   *  degrees_of_freedom counts those of velocity, which are fewer if there are such rows. */
  int32_t position_degrees_of_freedom;
} baum_mobility;

/** Count degrees of freedom, redundant and conflicting rows and free bodies, in the assembled
 *  initial configuration at t = 0.
 *  @param      mechanism    if it is not frozen, a frozen copy is examined
 *  @param[out] out          filled also when rows conflict
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK,
 *           BAUM_ERR_NOT_FINITE, BAUM_ERR_SINGULAR */
BAUM_API baum_status baum_mechanism_mobility(const baum_mechanism *mechanism, baum_mobility *out,
                                             size_t caller_size);

/** What an evaluation of the accelerations costs in a run, and which work it skips. The counts
 *  follow from the structure; user functions are not counted. */
typedef struct baum_report {
  size_t struct_size; /**< Set by baum_mechanism_report(). */
  int32_t bodies;     /**< [-] bodies without ground. */
  int32_t joints;     /**< [-] joints, drivers and user constraints. */
  int32_t forces;     /**< [-] forces without gravity. */
  int32_t velocities; /**< [-] nv. */
  int32_t rows;       /**< [-] nc. */
  /** [-] nv - rank of J; -1: not known, see baum_mechanism_mobility(). */
  int32_t degrees_of_freedom;
  int32_t redundant_rows; /**< [-] rows omitted from every solution. */
  int32_t constant_rows;  /**< [-] rows that do not depend on time. */
  int32_t islands;        /**< [-] groups of bodies connected by joints, without fixed bodies. */
  /** [-] bodies welded to ground; solved for only if multipliers are requested. */
  int32_t fixed_bodies;
  bool constant_mass;     /**< All masses are constant, so they are inverted only once. */
  bool constant_force;    /**< All forces are constant. */
  bool blocks;            /**< Solved by blocks (BAUM_SOLVER_BLOCK), otherwise by KLU. */
  int32_t nodes;          /**< [-] nodes of the block solver, which are pairs of rows; 0 for KLU. */
  int32_t couplings;      /**< [-] couplings of nodes during elimination; 0 for KLU. */
  int32_t fill;           /**< [-] couplings that elimination adds; 0 for KLU. */
  int32_t most_couplings; /**< [-] largest number of couplings of a node; 0 for KLU. */
  int32_t most_joints;    /**< [-] largest number of joints of a body that is not fixed. */
  baum_body_id most_joined; /**< The body with most joints; none if there are no joints. */
  /** These results in words, with the names of elements and the reasons. */
  char text[2048];
  int32_t velocity_rows; /**< [-] rows of velocity level (non-holonomic constraints). */
  /** [-] nv - rank of J without rows of velocity level; -1: not known. */
  int32_t position_degrees_of_freedom;
} baum_report;

/** Report what an evaluation costs, in the assembled initial configuration at t = 0 and with the
 *  solver that a run chooses by default.
 *  @param      mechanism    if it is not frozen, a frozen copy is examined
 *  @param[out] out          filled also when the mechanism cannot be assembled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_report(const baum_mechanism *mechanism, baum_report *out,
                                           size_t caller_size);

/** Compare the derivatives that user functions return (jacobian, nu, gamma, force_q, force_v, and
 *  those of laws and curves) with finite differences. Creating a simulation does this by default.
 *
 *  The check runs in the design configuration at t = 0 and in three configurations near it at t =
 *  0, 0.37 and 1.3. An entry is wrong if its error exceeds 1e-6 of its own size plus 1e-9 of the
 *  size of its row. mass() must be symmetric, without negative numbers on its diagonal in the
 *  design configuration, and constant if constant_mass says so. The check accepts kinks, and skips
 *  configurations and times at which a function fails. If a function fails in all configurations,
 *  the check returns that failure, except for laws of drivers.
 *  @param mechanism  frozen
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (the message names element, function, entry and both
 *           values), BAUM_ERR_STATE (not frozen), BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK,
 *           BAUM_ERR_NOT_FINITE */
BAUM_API baum_status baum_mechanism_check_derivatives(const baum_mechanism *mechanism);

#ifdef __cplusplus
}
#endif

#endif
