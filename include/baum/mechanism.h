/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Mechanisms, the objects that are simulated. A mechanism consists of bodies, joints, forces and
 *  inputs.
 *
 *  Use: add elements, freeze the mechanism, then run simulations. A frozen mechanism does not
 *  change any more, so several threads may share it.
 *  - A *body* is anything that has coordinates: a rigid body or a particle (planar.h, spatial.h),
 *    or a group of user coordinates.
 *  - A *joint* is anything that adds constraint equations, which are called rows: a joint between
 *    two bodies (planar.h, planar_joints.h, spatial_joints.h), a driver, a coupling or a user
 *    constraint.
 *  - A *force* is anything else that acts on bodies: a spring, a load or a user force.
 *
 *  If you want to simulate equations of your own, without predefined elements, use one body of user
 *  coordinates and one user constraint.
 *
 *  Equations (the numbers in parentheses are those of Flores et al. 2008): the constraints are
 *  Phi(q, t) = 0 (1). Their first time derivative is Phi' = J v - nu = 0 (3), and their second time
 *  derivative is Phi'' = J a - gamma = 0 (4). The equations of motion are M a + J^T lambda = g (2).
 *  The page "docs/notation.md" lists all symbols.
 *
 *  Units: you may use any consistent set of units. Only the default gravity assumes SI units.
 *  Angles are in radians. The comments in the headers give SI units in brackets; [-] means a pure
 *  number. The shapes of arrays are in parentheses.
 *
 *  Scales: the tolerance of a coordinate is relative to the *scale* of this coordinate. The scale
 *  of a length is the characteristic length of the mechanism, and the scale of an angle is 1. For
 *  user coordinates, the field `scale` gives the scale.
 *
 *  Order: q and v contain the coordinates in the order in which the bodies were added. Constraint
 *  rows and lambda are in the order in which the joints were added.
 *
 *  Configurations: the *design configuration* consists of the positions in the definitions of the
 *  bodies. *Assembly* starts from it and computes an initial configuration that satisfies the
 *  constraints.
 *
 *  NULL: pointers must not be NULL unless their comment allows it.
 *
 *  Names: messages contain the names of elements, inputs and events. If a name is NULL, the library
 *  chooses a default name, such as "joint<k>" with the number k of the joint, counted from 1. Empty
 *  names and names with control characters are refused.
 *
 *  Definitions: each kind K of element has a struct baum_K_def and five functions:
 *  baum_K_def_default(), baum_K_def_init(), baum_mechanism_add_K(), baum_mechanism_get_K() and
 *  baum_mechanism_set_K(). Each of the five functions does the same for every kind. The comments of
 *  baum_coordinates_def_init() and of the other four functions for user coordinates describe them.
 *  The words "Default: NULL, zeros" in the comment of a field mean that the field is NULL by
 *  default, and that NULL stands for zeros.
 *
 *  Versions: new versions of the library add fields only at the end of a struct. `struct_size`
 *  tells the library which fields a program knows. A program that was compiled with an older
 *  version passes a smaller struct; the fields that it does not know then have their defaults. Any
 *  other size is refused (BAUM_ERR_STRUCT), such as 0 in an all-zero struct, or the larger size of
 *  a newer version. A function that fills a struct writes at most as many bytes as its argument
 *  `caller_size` says, and at most the size that the struct has in the library. It sets struct_size
 *  to the number of bytes written.
 *
 *  Elements cannot be removed from a mechanism. Destroy every object only once, because the library
 *  cannot detect that an object has already been destroyed.
 *
 *  Callbacks are functions of yours that the library calls. Their arguments q and v hold the
 *  positions and velocities of the bodies that the definition names, one body after the other.
 *  Matrices are dense and row-major. The library sets outputs to zero before the call. A callback
 *  returns 0 on success, a positive number to ask for a smaller step, and a negative number to stop
 *  the run. If threads share the mechanism, callbacks must be reentrant.
 *
 *  A callback may call the library, but it must not use the workspace or the run that is calling
 *  it. If it does, functions that return a status fail with BAUM_ERR_STATE, and the function that
 *  destroys the workspace or the run does nothing. There are two exceptions: the callback may read
 *  the time, q, v, inputs and texts of the run, and it may cancel the run. */
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

/** A mechanism: its bodies, joints, forces and inputs. */
typedef struct baum_mechanism baum_mechanism;

/** Identifies a body of a mechanism. The id is also valid in copies of this mechanism. An all-zero
 *  id means no body, and functions refuse it. */
typedef struct baum_body_id {
  int32_t index1; /**< Private: number of the element, counted from 1. */
  uint32_t tag;   /**< Private: identifies the mechanism. */
} baum_body_id;

/** Identifies a joint, which is any element that adds constraint rows. An all-zero id means no
 *  joint, and functions refuse it.
 */
typedef struct baum_joint_id {
  int32_t index1; /**< Private: number of the element, counted from 1. */
  uint32_t tag;   /**< Private: identifies the mechanism. */
} baum_joint_id;

/** Identifies a force. An all-zero id means no force, and functions refuse it. */
typedef struct baum_force_id {
  int32_t index1; /**< Private: number of the element, counted from 1. */
  uint32_t tag;   /**< Private: identifies the mechanism. */
} baum_force_id;

/** Identifies an input. An all-zero id means no input. */
typedef struct baum_input_id {
  int32_t index1; /**< Private: number of the element, counted from 1. */
  uint32_t tag;   /**< Private: identifies the mechanism. */
} baum_input_id;

/** Ground, the body that never moves. Every mechanism has it. */
static const baum_body_id BAUM_GROUND = {-1, 0};

/** A function of time and positions.
 *  @param      t     [s] time
 *  @param[in]  q     positions of the bodies that the definition names
 *  @param[out] out   the result; the comment of the field that holds the function gives the shape
 *                    of the result
 *  @param      user  the definition's `user`
 *  @return  0 success, > 0 retry with a smaller step, < 0 stop */
typedef int baum_q_fn(double t, const double *q, double *out, void *user);

/** A function of time, positions and velocities. v holds the velocities of the bodies that the
 *  definition names. The other arguments and the return value are those of baum_q_fn. */
typedef int baum_qv_fn(double t, const double *q, const double *v, double *out, void *user);

/** A function that computes a generalized force. `inputs` holds the present values of all inputs of
 *  the mechanism in the order in which they were added; it is NULL if there are none. The other
 *  arguments and the return value are those of baum_qv_fn. */
typedef int baum_force_fn(double t, const double *q, const double *v, const double *inputs,
                          double *out, void *user);

/** The law of a driver. At time t the function writes the value of the law to s[0], its first time
 *  derivative to s[1] and its second to s[2]. s[1] and s[2] must be the exact derivatives of s[0];
 *  baum_mechanism_check_derivatives() compares them with finite differences. The library also calls
 *  the law at times outside the run, in order to check the derivatives and to find redundant rows
 *  in configurations near the start. The return value has the same meaning as that of baum_q_fn. */
typedef int baum_law_fn(double t, double s[3], void *user);

/* ---- a body given by functions --------------------------------------------------------------- */

/** Computes the time derivative of the positions, dq = N(q) v, which must be linear in v. The
 *  configuration manifold is the set of all valid q. The function must also accept a q that the
 *  local error of a step has moved off this manifold. If the result for q is dq, then for every
 *  number c the result for c q, with the same v, must be c dq. */
typedef void baum_rate_fn(const double *q, const double *v, double *dq, void *user);

/** Moves q for the time h with the constant velocity v, and overwrites q with the result. The
 *  result must be accurate to second order in h or better. With h = 1, the function moves q by the
 *  displacement v. A displacement has as many numbers as v; this number is the field `size` of
 *  baum_coordinates_def. */
typedef void baum_move_fn(double h, const double *v, double *q, void *user);

/** Computes the displacement dx (size) from one configuration to another. If the function `move` of
 *  the same body starts at `from`, with h = 1 and v = dx, its result must be `to`. */
typedef void baum_difference_fn(const double *from, const double *to, double *dx, void *user);

/** Replaces q by the nearest point of the configuration manifold, for example a quaternion by the
 *  unit quaternion of the same direction. This function must not change the sign of a quaternion.
 *  Integrators that combine the positions of several steps would lose their order of accuracy at
 *  the change of sign. */
typedef void baum_normalize_fn(double *q, void *user);

/** A body with user coordinates. Functions of yours give its mass matrix and its force.
 *
 *  Usually v is the time derivative of q. If the positions q do not form a vector space, for
 *  example if they are a unit quaternion, also set the last fields of this struct, from
 *  position_scale to position_count; the time derivative of q is then N(q) v. In this case every
 *  function except `rate` and `normalize` receives a normalized q. Derivatives with respect to q,
 *  such as force_q, are then derivatives along the `size` components of a displacement. This also
 *  applies to constraints on these coordinates: their Jacobian is the product of dPhi/dq and N.
 *  The functions rate, move, difference and normalize report a failure by writing NaN. */
typedef struct baum_coordinates_def {
  size_t struct_size; /**< Set by baum_coordinates_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  int32_t size;       /**< [-] > 0, number of velocities. Default: 0, must be set. */
  /** (position_count) positions in the design configuration; they must lie on the configuration
   *  manifold. Copied. Default: NULL, which means zeros; must be set if `rate` is set. */
  const double *q;
  /** (size) initial velocities. Where an entry is NaN, the velocity is free, which means that
   *  assembly determines it. Copied. Default: NULL, all free. */
  const double *v;
  /** (size) scale of each coordinate, > 0: the amount of a typical change. Tolerances are relative
   *  to the scale. Copied. Default: NULL, ones. */
  const double *scale;
  /** Computes the mass matrix, out (size x size), which is symmetric and positive semidefinite.
   *  Default: NULL, must be set. */
  baum_q_fn *mass;
  /** Computes the generalized force g, out (size). It includes the velocity terms of Lagrange's
   *  equations. Default: NULL, must be set. */
  baum_force_fn *force;
  /** Computes dg/dq, out (size x size). Default: NULL, computed by differences. */
  baum_force_fn *force_q;
  /** Computes dg/dv, out (size x size). Default: NULL, computed by differences. */
  baum_force_fn *force_v;
  baum_q_fn *potential;     /**< Computes the potential energy, out (1) [J]. Default: NULL, none. */
  bool constant_mass;       /**< True if mass() always returns the same matrix. Default: false. */
  bool held;                /**< True if assembly must not change q. Default: false. */
  void *user;               /**< Passed to the functions. Not owned. Default: NULL. */
  bool depends_on_velocity; /**< True if force() reads v. RATTLE requires false. Default: true. */
  /** (position_count) amount of a typical change of each position, > 0. Copied. Used only if
   *  `rate` is set. Default: NULL, ones. */
  const double *position_scale;
  baum_rate_fn *rate; /**< Computes q' = N(q) v. Default: NULL, q' = v. */
  /** Moves q by a displacement. Default: NULL; must be set if `rate` is set. */
  baum_move_fn *move;
  /** Computes the displacement between two positions. Default: NULL; must be set if `rate` is set.
   */
  baum_difference_fn *difference;
  /** Moves q onto the configuration manifold. Not needed if every q is on this manifold.
   *  Default: NULL. */
  baum_normalize_fn *normalize;
  int32_t position_count; /**< [-] number of positions. Default: 0, which means `size`. */
} baum_coordinates_def;

/** Set every field to its default. This function is for bindings to other languages. C programs
 *  call the function whose name ends in `_def_default` instead.
 *  @param[out] def          the struct to fill; if it is NULL, the function does nothing
 *  @param      caller_size  sizeof *def; the function writes no byte beyond this size */
BAUM_API void baum_coordinates_def_init(baum_coordinates_def *def, size_t caller_size);

/** Get a struct with every field at its default. In this struct, change the fields that need other
 *  values.
 *  @return  the struct */
static inline baum_coordinates_def baum_coordinates_def_default(void)
{
  baum_coordinates_def def;
  baum_coordinates_def_init(&def, sizeof def);
  return def;
}

/** Add an element. The library copies the definition, including its name and its arrays. It also
 *  stores the function pointers and the pointer `user`, but it does not copy the data to which
 *  `user` points.
 *  @param      mechanism  not frozen; unchanged on failure
 *  @param[in]  def        the definition
 *  @param[out] id         receives the id of the element; not written on failure. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE (frozen), BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_mechanism_add_coordinates(baum_mechanism *mechanism,
                                                    const baum_coordinates_def *def,
                                                    baum_body_id *id);

/** Read the definition of an element as it was given. The name and the arrays in the definition
 *  belong to the mechanism. They are valid until the definition is replaced or the mechanism is
 *  destroyed.
 *  @param      mechanism    frozen or not
 *  @param      id           an element of the kind in the name of this function
 *  @param[out] out          receives the definition
 *  @param      caller_size  sizeof *out; the function writes no byte beyond this size
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_mechanism_get_coordinates(const baum_mechanism *mechanism,
                                                    baum_body_id id, baum_coordinates_def *out,
                                                    size_t caller_size);

/** Replace the definition of an element. Some properties must stay the same: the bodies or joints
 *  that the element acts on, the number of its rows or coordinates, and, for user coordinates,
 *  whether the function `rate` is given.
 *  @param     mechanism  not frozen; unchanged on failure
 *  @param     id         an element of the kind in the name of this function
 *  @param[in] def        the new definition, copied as by the add function
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE (frozen), BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_mechanism_set_coordinates(baum_mechanism *mechanism, baum_body_id id,
                                                    const baum_coordinates_def *def);

/* ---- constraints given by functions ---------------------------------------------------------- */

/** A user constraint: constraints Phi(q, t) = 0 on the coordinates of the listed bodies, given by
 *  functions of yours. For such constraints, the only required function is `phi`. In the comments
 *  of the fields, nv is the total number of velocities of the listed bodies.
 *
 *  If velocity_level is true, the functions give constraints J(q, t) v = nu(q, t) on the
 *  velocities. Such constraints are not the time derivative of a Phi; they are non-holonomic, like
 *  those of a wheel that does not slip. For such constraints, `jacobian` is required and `phi` must
 *  be NULL. With Baumgarte's gain alpha (stabilization.h), the accelerations a satisfy
 *  J a = gamma - alpha (J v - nu).
 *
 *  The functions must be valid everywhere, not only where Phi = 0. Derivatives that you do not give
 *  are replaced by central differences of `phi`. The differences for nu evaluate `phi` up to 0.006
 *  time units before and after t, and the differences for gamma up to 0.05 time units. If `phi` is
 *  not defined before t = 0, give `nu` and `gamma`. */
typedef struct baum_user_constraint_def {
  size_t struct_size; /**< Set by baum_user_constraint_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  /** (body_count) bodies on which the element acts. Copied. Default: NULL, must be set. */
  const baum_body_id *bodies;
  int32_t body_count; /**< [-] number of bodies, > 0. Default: 0, must be set. */
  int32_t row_count;  /**< [-] number of rows, > 0. Default: 0, must be set. */
  /** Computes Phi(q, t), out (row_count). Default: NULL, must be set unless velocity_level is true.
   */
  baum_q_fn *phi;
  /** Computes J, out (row_count x nv). Default: NULL, computed by differences of `phi`. */
  baum_q_fn *jacobian;
  /** Computes nu = -dPhi/dt, the partial derivative at constant q, out (row_count). Default: NULL,
   *  computed by differences of `phi` in t. */
  baum_q_fn *nu;
  /** Computes gamma in J a = gamma, out (row_count). Default: NULL, computed by differences of
   *  `phi`. */
  baum_qv_fn *gamma;
  void *user; /**< Passed to the functions. Not owned. Default: NULL. */
  /** True for constraints J v = nu on velocities. In this case, `jacobian` must be set and `phi`
   *  must be NULL. If the function `nu` is NULL, these constraints have nu = 0. Default: false. */
  bool velocity_level;
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

/** A coordinate of a joint. Drivers, joint springs, joint loads, channels and events each refer to
 *  one coordinate of a joint; a coupling refers to one coordinate of each of its two joints. The
 *  joints have the following coordinates:
 *
 *  - planar revolute joint, spatial revolute joint: ANGLE
 *  - planar translational joint, pin in a slot: DISPLACEMENT
 *  - prismatic joint, point on a line: DISPLACEMENT
 *  - cylindrical joint, screw: DISPLACEMENT, ANGLE
 *  - universal joint: ANGLE, ANGLE_B
 *  - spatial planar joint: X, Y, ANGLE
 *
 *  The angle of a planar revolute joint includes whole revolutions, because the angles of planar
 *  bodies do. A single configuration determines an angle of a spatial joint only up to whole
 *  revolutions. A run therefore counts the revolutions. A workspace does not know the past of the
 *  motion, so its functions use angles between -pi and pi, unless baum_workspace_set_angle() has
 *  chosen other revolutions. */
typedef enum baum_joint_coordinate {
  /** The first coordinate that the list above gives for the joint. Most joints have only one
   *  coordinate. */
  BAUM_COORDINATE_FIRST = 0,
  /** [m] displacement from body_a's point to body_b's point, along the axis. */
  BAUM_COORDINATE_DISPLACEMENT = 1,
  BAUM_COORDINATE_ANGLE = 2,   /**< [rad] angle of body_b relative to body_a, about the axis. */
  BAUM_COORDINATE_ANGLE_B = 3, /**< [rad] the second angle of a universal joint, about axis_b. */
  /** [m] displacement from body_a's point to body_b's point, along the x axis of a spatial planar
   *  joint. */
  BAUM_COORDINATE_X = 4,
  /** [m] displacement from body_a's point to body_b's point, along the y axis of a spatial planar
   *  joint. This axis lies in the plane of the joint and is perpendicular to the x axis of the
   *  joint. */
  BAUM_COORDINATE_Y = 5
} baum_joint_coordinate;

/* ---- drivers --------------------------------------------------------------------------------- */

/** A driver prescribes a coordinate of a joint as a function of time. It adds one row,
 *  coordinate(q) - s(t) = 0. The function s(t) is value + rate * t + acceleration * t^2 / 2, where
 *  value, rate and acceleration are fields of the definition, or it is a law of your own. Whole
 *  revolutions of an angle of a spatial joint do not change the value of this row. */
typedef struct baum_driver_def {
  size_t struct_size;  /**< Set by baum_driver_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_joint_id joint; /**< A joint with a coordinate. Default: none, must be set. */
  double value;        /**< [rad or m] value of s at t = 0. Default: 0. */
  double rate;         /**< [rad/s or m/s] value of s' at t = 0. Default: 0. */
  double acceleration; /**< [rad/s^2 or m/s^2] value of s'', which is constant. Default: 0. */
  /** A law that replaces value, rate and acceleration, which must then be 0. Default: NULL. */
  baum_law_fn *law;
  void *user; /**< Passed to law. Not owned. Default: NULL. */
  /** [-] which coordinate of the joint the driver prescribes. Default: BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinate;
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

/** The law of a coupling. x is the coordinate of joint_a [rad or m]. The function writes the value
 *  of the law at x to f[0], its first derivative to f[1] and its second derivative to f[2]. The
 *  library sets f to zero before the call. If x is an angle, it grows continuously over several
 *  revolutions. There is one exception: if a workspace calls the function, an angle of a spatial
 *  joint is between -pi and pi, unless baum_workspace_set_angle() has chosen other revolutions.
 *  Methods that need the third derivative compute it by finite differences of f[2]. When the
 *  library checks the derivatives, it also calls the law at values of x that the motion does not
 *  reach. The return value has the same meaning as that of baum_q_fn. */
typedef int baum_coupling_fn(double x, double f[3], void *user);

/** A coupling connects the coordinates of two joints. It adds one row, coordinate_b -
 *  f(coordinate_a) = 0, where f(x) is ratio * x + offset, or a law of your own. A coupling with a
 *  law can model a cam whose follower moves along coordinate_b. The two joints may share a body:
 *  for example, both may be joints to ground. A coupling of the angle and the displacement of one
 *  cylindrical joint is a screw.
 *
 *  Angles of spatial joints are known only up to whole revolutions. Without a law, the value of the
 *  row therefore does not depend on the number of revolutions of such an angle. If both coordinates
 *  are angles of spatial joints, this is true only if ratio is a fraction with a denominator of at
 *  most 1000. With any other ratio, the value of the row depends on the number of revolutions.
 *
 *  The reaction of a coupling is the generalized force -J^T lambda of its row, with one number for
 *  each velocity of the bodies: first those of joint_a, then those of joint_b. A body that belongs
 *  to both joints appears once, and ground does not appear. */
typedef struct baum_coupling_def {
  size_t struct_size;    /**< Set by baum_coupling_def_default(). Do not change it. */
  const char *name;      /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_joint_id joint_a; /**< A joint with a coordinate. Default: none, must be set. */
  /** A joint with a coordinate. It may be the same joint as joint_a, to couple two coordinates of
   *  this joint. Default: none, must be set. */
  baum_joint_id joint_b;
  /** [unit of coordinate_b / unit of coordinate_a] factor of coordinate_a in the row. Default: 1.
   */
  double ratio;
  /** [rad or m] value of coordinate_b if coordinate_a is 0. Default: NaN, the value that
   *  satisfies the row in the design configuration. */
  double offset;
  /** A law that replaces ratio and offset, which must then have their defaults. Default: NULL. */
  baum_coupling_fn *law;
  void *user; /**< Passed to law. Not owned. Default: NULL. */
  /** [-] coordinate of joint_a that is coupled. Default: BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinate_a;
  /** [-] coordinate of joint_b that is coupled. Default: BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinate_b;
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

/** A user force: a generalized force on the listed bodies, given by functions of yours. In the
 *  comments of the fields, nv is the total number of velocities of the listed bodies. For a planar
 *  body, the generalized force consists of a force x, y [N] and a moment [N m]. For a spatial body,
 *  it consists of a force x, y, z in ground axes and a moment x, y, z in body axes. The force acts
 *  at the centre of mass, and the moment is about the centre of mass. */
typedef struct baum_user_force_def {
  size_t struct_size; /**< Set by baum_user_force_def_default(). Do not change it. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "force<k>". */
  /** (body_count) bodies on which the element acts. Copied. Default: NULL, must be set. */
  const baum_body_id *bodies;
  int32_t body_count; /**< [-] number of bodies, > 0. Default: 0, must be set. */
  /** Computes the generalized force, out (nv). Default: NULL, must be set. */
  baum_force_fn *force;
  /** Computes the derivatives of the force with respect to displacements of the bodies,
   *  out (nv x nv). Default: NULL, computed by differences. */
  baum_force_fn *force_q;
  /** Computes the derivatives of the force with respect to v, out (nv x nv). Default: NULL,
   *  computed by differences. */
  baum_force_fn *force_v;
  baum_q_fn *potential;     /**< Computes the potential energy, out (1) [J]. Default: NULL, none. */
  void *user;               /**< Passed to the functions. Not owned. Default: NULL. */
  bool depends_on_velocity; /**< True if force() reads v. RATTLE requires false. Default: true. */
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

/** The law of a spring: computes the tension or the torque of the spring, and the derivatives of
 *  this value. When the library checks the derivatives, it also calls the law in configurations
 *  that the motion does not reach.
 *  @param      length  distance between the two points of the spring [m]; for a cable its length
 *                      [m]; for a torsion spring the angle of body_b relative to body_a [rad]; for
 *                      a joint spring the coordinate of the joint
 *  @param      rate    [m/s or rad/s] time derivative of length
 *  @param[out] out     (3) set to zero before the call. out[0] is the tension [N], which pulls the
 *                      points together if it is positive; for a torsion or joint spring it is the
 *                      restoring force [N] or torque [N m]. out[1] is the derivative of out[0] with
 *                      respect to length [N/m or N m/rad], and out[2] is the derivative of out[0]
 *                      with respect to rate [N s/m or N m s/rad]
 *  @param      user    the definition's `user`
 *  @return  0 success, > 0 retry with a smaller step, < 0 stop */
typedef int baum_spring_fn(double length, double rate, double out[3], void *user);

/** A linear spring and damper in parallel, or a law of your own, that acts on a coordinate of a
 *  joint. The spring pulls the coordinate towards free_value, with a force along the axis of the
 *  joint or a torque about this axis.
 *
 *  A run counts the revolutions of an angle of a spatial joint, so the spring winds up further with
 *  each revolution. The functions of a workspace use angles between -pi and pi, unless
 *  baum_workspace_set_angle() has chosen other revolutions. */
typedef struct baum_joint_spring_def {
  size_t struct_size;  /**< Set by baum_joint_spring_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_joint_id joint; /**< A joint with a coordinate. Default: none, must be set. */
  /** [-] the coordinate on which the spring acts. Default: BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinate;
  double stiffness; /**< [N m/rad or N/m] >= 0. Default: 0. */
  double damping;   /**< [N m s/rad or N s/m] >= 0. Default: 0. */
  /** [rad or m] coordinate at which the spring exerts no force. Default: NaN, the value in the
   *  design configuration. */
  double free_value;
  /** A law that replaces stiffness, damping and free_value, which must then have their defaults;
   *  the spring then has no potential energy. Default: NULL. */
  baum_spring_fn *law;
  void *user; /**< Passed to law. Not owned. Default: NULL. */
  /** True if law reads its argument `rate`, the time derivative of the coordinate. RATTLE requires
   *  false. Default: true. */
  bool depends_on_velocity;
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

/* ---- loads of joints ------------------------------------------------------------------------- */

/** A force or a torque that acts on a coordinate of a joint, such as the torque of a motor. It acts
 *  on body_b of the joint in the positive direction of the coordinate, and with the opposite sign
 *  on body_a. The effort is constant, or it is multiplied by the value of an input. A joint load
 *  has no potential energy; the energy account counts its work as work of loads. */
typedef struct baum_joint_load_def {
  size_t struct_size;  /**< Set by baum_joint_load_def_default(). Do not change it. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_joint_id joint; /**< A joint with a coordinate. Default: none, must be set. */
  /** [-] the coordinate on which the load acts. Default: BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinate;
  /** [N m or N] torque on an angle, or force on a displacement. It drives the coordinate in its
   *  positive direction if it is positive. Default: 0. */
  double effort;
  baum_input_id input; /**< An input whose value multiplies the effort. Default: none. */
} baum_joint_load_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_joint_load_def_init(baum_joint_load_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_joint_load_def baum_joint_load_def_default(void)
{
  baum_joint_load_def def;
  baum_joint_load_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_joint_load(baum_mechanism *mechanism,
                                                   const baum_joint_load_def *def,
                                                   baum_force_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_joint_load(const baum_mechanism *mechanism,
                                                   baum_force_id id, baum_joint_load_def *out,
                                                   size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_joint_load(baum_mechanism *mechanism, baum_force_id id,
                                                   const baum_joint_load_def *def);

/* ---- inputs ---------------------------------------------------------------------------------- */

/** Add an input. An input is a number that your program sets during a run, such as the torque of a
 *  motor. If the definition of a load names an input, the load is multiplied by the value of this
 *  input. All force functions receive the values of all inputs. Runs and workspaces
 *  begin with the initial value and keep it until baum_simulation_set_input() or
 *  baum_workspace_set_input() changes it.
 *  @param      mechanism  not frozen; unchanged on failure
 *  @param[in]  name       label in messages. Copied. NULL stands for "input<k>" with the number k
 *                         of the input, counted from 1.
 *  @param      initial    the initial value; finite, in a unit of your choice
 *  @param[out] id         receives the id of the input; not written on failure. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (frozen), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_add_input(baum_mechanism *mechanism, const char *name,
                                              double initial, baum_input_id *id);

/** Read the initial value of an input.
 *  @param      mechanism  frozen or not
 *  @param      id         an input of the mechanism
 *  @param[out] initial    receives the initial value
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_mechanism_get_input(const baum_mechanism *mechanism, baum_input_id id,
                                              double *initial);

/** Replace the initial value of an input.
 *  @param mechanism  not frozen
 *  @param id         an input of the mechanism
 *  @param initial    the new initial value, finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (frozen) */
BAUM_API baum_status baum_mechanism_set_input(baum_mechanism *mechanism, baum_input_id id,
                                              double initial);

/** Count the inputs. @param mechanism  frozen or not @return the number of inputs; 0 for NULL */
BAUM_API int32_t baum_mechanism_input_count(const baum_mechanism *mechanism);

/* ---- the mechanism --------------------------------------------------------------------------- */

/** Create an empty mechanism with gravity (0, -9.81, 0) m/s^2.
 *  @param[out] out  receives the mechanism, NULL on failure; release it with
 *                   baum_mechanism_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_create(baum_mechanism **out);

/** Copy a mechanism. The copy is not frozen. Ids of the original are valid in the copy, and ids of
 *  the copy in the original, until elements are added to one of the two.
 *
 *  Definitions are copied as they were given. Some values of a definition may follow from the
 *  design configuration: the place of a joint that is given by `point`, and lengths, angles and
 *  offsets that are not given. In the copy, these values follow from the design configuration of
 *  the copy. So they change if you change the position or the angle of a body in the copy. To keep
 *  them, first give point_a, point_b, lengths, angles and offsets as numbers. The copy shares
 *  function pointers and `user` with the original.
 *  @param      mechanism  frozen or not
 *  @param[out] out        receives the copy, NULL on failure; release it with
 *                         baum_mechanism_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_copy(const baum_mechanism *mechanism, baum_mechanism **out);

/** Release a mechanism. If simulations, workspaces or studies of the mechanism still exist, its
 *  memory is freed when the last of them is released.
 *  @param mechanism  may be NULL */
BAUM_API void baum_mechanism_destroy(baum_mechanism *mechanism);

/** Set gravity, which acts on particles and rigid bodies but not on user coordinates.
 *  @param mechanism  not frozen
 *  @param x          [m/s^2] finite. Default of a mechanism: 0.
 *  @param y          [m/s^2] finite. Default of a mechanism: -9.81.
 *  @param z          [m/s^2] finite; does not act on planar bodies. Default of a mechanism: 0.
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
 *  @param length     [m] > 0. If no length is set, freezing sets it to the size of the design
 *                    configuration.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (frozen) */
BAUM_API baum_status baum_mechanism_set_characteristic_length(baum_mechanism *mechanism,
                                                              double length);

/** Read the characteristic length.
 *  @param      mechanism  frozen or not
 *  @param[out] length     [m]; NaN if no length was set and the mechanism is not frozen
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_mechanism_get_characteristic_length(const baum_mechanism *mechanism,
                                                              double *length);

/** Freeze a mechanism: check all its definitions, and make it constant, so that it can be
 *  simulated. If the mechanism is frozen already, the call does nothing.
 *  @param mechanism  a mechanism with at least one body; it is not frozen if the call fails
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (no bodies), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_freeze(baum_mechanism *mechanism);

/** Tell whether a mechanism is frozen.
 *  @param mechanism  may be NULL
 *  @return  true if it is frozen; false for NULL */
BAUM_API bool baum_mechanism_is_frozen(const baum_mechanism *mechanism);

/** Read the sizes of a mechanism.
 *  @param      mechanism  frozen
 *  @param[out] nq         [-] number of positions. May be NULL.
 *  @param[out] nv         [-] number of velocities. May be NULL.
 *  @param[out] nc         [-] number of constraint rows. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen) */
BAUM_API baum_status baum_mechanism_sizes(const baum_mechanism *mechanism, int32_t *nq, int32_t *nv,
                                          int32_t *nc);

/** Find the rows of a joint in Phi and lambda.
 *  @param      mechanism  frozen
 *  @param      joint      a joint of the mechanism
 *  @param[out] first      [-] index of the first row of the joint, counted from 0. May be NULL.
 *  @param[out] count      [-] number of rows of the joint. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen) */
BAUM_API baum_status baum_mechanism_rows(const baum_mechanism *mechanism, baum_joint_id joint,
                                         int32_t *first, int32_t *count);

/** Find the coordinates of a body in q and v.
 *  @param      mechanism  frozen
 *  @param      body       a body of the mechanism, not ground
 *  @param[out] first_q    [-] index of the first position of the body in q. May be NULL.
 *  @param[out] first_v    [-] index of the first velocity of the body in v. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen) */
BAUM_API baum_status baum_mechanism_columns(const baum_mechanism *mechanism, baum_body_id body,
                                            int32_t *first_q, int32_t *first_v);

/** Read the name of a body.
 *  @param mechanism  frozen or not
 *  @param body       a body of the mechanism
 *  @return  the name, owned by the mechanism; NULL for ids of other mechanisms */
BAUM_API const char *baum_mechanism_body_name(const baum_mechanism *mechanism, baum_body_id body);

/** Read the name of a joint.
 *  @param mechanism  frozen or not
 *  @param joint      a joint of the mechanism
 *  @return  the name, owned by the mechanism; NULL for ids of other mechanisms */
BAUM_API const char *baum_mechanism_joint_name(const baum_mechanism *mechanism,
                                               baum_joint_id joint);

/** Read the name of an input.
 *  @param mechanism  frozen or not
 *  @param input      an input of the mechanism
 *  @return  the name, owned by the mechanism; NULL for ids of other mechanisms */
BAUM_API const char *baum_mechanism_input_name(const baum_mechanism *mechanism,
                                               baum_input_id input);

/** The result of baum_mechanism_mobility(): how a mechanism can move from its assembled initial
 *  configuration. */
typedef struct baum_mobility {
  size_t struct_size; /**< Set by baum_mechanism_mobility(). */
  /** [-] nv minus the rank of J at configurations near the initial one; -1 if the mechanism cannot
   *  be assembled. */
  int32_t degrees_of_freedom;
  /** [-] rows that depend on other rows at every configuration near the initial one. */
  int32_t redundant_rows;
  int32_t conflicting_rows; /**< [-] rows that contradict the other rows. */
  int32_t free_bodies;      /**< [-] bodies without a joint. */
  /** True if the initial configuration is singular, which means that J has a lower rank there than
   *  at nearby configurations. Also true if a row of J is nearly dependent on the other rows in the
   *  initial configuration, but not in nearby configurations. Nearly dependent means that the
   *  distance of the row from the span of the other rows is less than 1e-5 of its length. */
  bool near_singular;
  double worst_phi;          /**< [m or rad] largest |Phi| after assembly. */
  baum_joint_id worst_joint; /**< The joint whose row has the violation worst_phi. */
  char text[1024];           /**< The results in words, with the names of elements. */
  int32_t velocity_rows;     /**< [-] rows of velocity level (non-holonomic constraints). */
  /** [-] degrees of freedom of position: nv minus the rank of J without its rows of velocity level.
   *  degrees_of_freedom counts the degrees of freedom of velocity instead, which are fewer if there
   *  are rows of velocity level. */
  int32_t position_degrees_of_freedom;
} baum_mobility;

/** Count degrees of freedom, redundant and conflicting rows, and free bodies, in the assembled
 *  initial configuration at t = 0.
 *  @param      mechanism    if it is not frozen, a frozen copy is examined
 *  @param[out] out          filled also when rows conflict
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK,
 *           BAUM_ERR_NOT_FINITE, BAUM_ERR_SINGULAR */
BAUM_API baum_status baum_mechanism_mobility(const baum_mechanism *mechanism, baum_mobility *out,
                                             size_t caller_size);

/** The result of baum_mechanism_report(): what an evaluation of the accelerations costs in a run,
 *  and which work the evaluation skips because the mechanism does not need it. The counts in this
 *  struct follow from the structure of the mechanism. They do not include the cost of user
 *  functions. */
typedef struct baum_report {
  size_t struct_size; /**< Set by baum_mechanism_report(). */
  int32_t bodies;     /**< [-] number of bodies, not counting ground. */
  int32_t joints;     /**< [-] number of joints, drivers, couplings and user constraints. */
  int32_t forces;     /**< [-] number of forces, not counting gravity. */
  int32_t velocities; /**< [-] number of velocities, nv. */
  int32_t rows;       /**< [-] number of constraint rows, nc. */
  /** [-] nv minus the rank of J; -1 if the mechanism cannot be assembled. */
  int32_t degrees_of_freedom;
  int32_t redundant_rows; /**< [-] redundant rows, which the solver always omits. */
  int32_t constant_rows;  /**< [-] rows that do not depend explicitly on time. */
  /** [-] groups of bodies connected with each other by joints. Fixed bodies belong to no group and
   *  connect no bodies. */
  int32_t islands;
  /** [-] bodies welded to ground. The equations of these bodies are solved only if multipliers are
   *  requested. */
  int32_t fixed_bodies;
  bool constant_mass;  /**< True if the mass matrix is constant; it is then inverted only once. */
  bool constant_force; /**< True if all forces are constant. */
  /** True if the block solver solves the equations, false if KLU (a sparse LU factorization of the
   *  whole system) does. */
  bool blocks;
  /** [-] nodes of the block solver; 0 if KLU solves the equations. A node is a whole joint if the
   *  mechanism has spatial bodies but no user coordinates; otherwise it is a pair of rows. */
  int32_t nodes;
  /** [-] pairs of nodes that are coupled during elimination; 0 if KLU solves the equations. */
  int32_t couplings;
  /** [-] number of these couplings that arise only during elimination (fill-in); 0 if KLU solves
   *  the equations. */
  int32_t fill;
  /** [-] largest number of couplings that a node has when it is eliminated; 0 if KLU solves the
   *  equations. */
  int32_t most_couplings;
  int32_t most_joints; /**< [-] number of joints of the body most_joined. */
  /** The body with the most joints, among bodies that are not fixed; none if there are no joints.
   */
  baum_body_id most_joined;
  /** The results in words, with the names of elements and with reasons. */
  char text[2048];
  int32_t velocity_rows; /**< [-] rows of velocity level (non-holonomic constraints). */
  /** [-] degrees of freedom of position: nv minus the rank of J without its rows of velocity level;
   *  -1 if the mechanism cannot be assembled. */
  int32_t position_degrees_of_freedom;
} baum_report;

/** Report what an evaluation of the accelerations costs. The report is valid for the assembled
 *  initial configuration at t = 0 and for the solver that a run chooses by default.
 *  @param      mechanism    if it is not frozen, a frozen copy is examined
 *  @param[out] out          filled also when the mechanism cannot be assembled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_report(const baum_mechanism *mechanism, baum_report *out,
                                           size_t caller_size);

/** Compare finite differences with the derivatives that user functions return. These derivatives
 *  are `jacobian`, `nu`, `gamma`, `force_q`, `force_v`, and the derivatives of laws and curves. By
 *  default, baum_simulation_create() makes this check, too.
 *
 *  The check evaluates the functions in the design configuration at t = 0, and in three
 *  configurations near it at the times 0, 0.37 and 1.3. A derivative is a matrix. The check rejects
 *  an entry of the matrix if the error of the entry exceeds the sum of 1e-6 times the entry and
 *  1e-9 times the largest entry of the same row. Before the entries of a row are compared, each is
 *  multiplied by the scale of its coordinate. The call also checks the function mass() of user
 *  coordinates: the matrix must be symmetric, its diagonal must not contain negative numbers in the
 *  design configuration, and it must be constant if constant_mass is true. Kinks of a function are
 *  allowed. The check skips configurations and times at which a function fails. If a function fails
 *  in all configurations, the check returns this failure. Laws of drivers are an exception: they
 *  may fail in all configurations.
 *  @param mechanism  frozen
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (the message names element, function, entry and both
 *           values), BAUM_ERR_STATE (not frozen), BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK,
 *           BAUM_ERR_NOT_FINITE */
BAUM_API baum_status baum_mechanism_check_derivatives(const baum_mechanism *mechanism);

#ifdef __cplusplus
}
#endif

#endif
