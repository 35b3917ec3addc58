/* SPDX-License-Identifier: BSD-3-Clause */
/* Data structures of a mechanism: elements (bodies, joints, forces), element types, the point in
 * state space at which elements are evaluated, and the frozen structure. Functions of the whole
 * mechanism are in mechanism.h.
 *
 * An element type is a const struct of functions. The file of a type contains this struct and the
 * four public functions of the type (definition.h). Functions of a type process a group, which
 * consists of all elements of one type, in one call. Structure and numbers are stored separately.
 * After freeze the structure is constant, and every mass, length and stiffness is in one parameter
 * array.
 *
 * Body 0 is ground. The index1 of a body id is the index of the body in `bodies`. For BAUM_GROUND
 * it is -1.
 */
#ifndef BAUM_I_MECHANISM_MODEL_H
#define BAUM_I_MECHANISM_MODEL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/mechanism.h>

#include "mechanism/fields.h"

/* ---- elements ---- */

/* Every element struct begins with this struct. */
typedef struct baum_i_element {
  const char *family; /* "body", "joint" or "force" */
  const baum_i_definition *definition;
  /* the element's copy of the definition; the `name` in this copy points to `name` below or is
   * NULL */
  void *def;
  char *name;    /* the given name, or "body<k>", "joint<k>" or "force<k>" with k = index */
  int index;     /* index in its family, from 1 */
  int parameter; /* where the element's numbers begin in the parameter array; set at freeze */
} baum_i_element;

/* The bodies on which an element acts, and where their velocities and positions are in v and q. The
 * local columns of an element are the columns of these bodies, one body after the other. Ground has
 * no columns. Freeze sets all members except bodies and body_count. */
typedef struct baum_i_span {
  int body_count;
  int *bodies;    /* (body_count) indices, 0 = ground */
  int nl;         /* number of local velocities */
  int *columns;   /* (nl) indices of the local velocities in v */
  int ql;         /* number of local positions */
  int *positions; /* (ql) indices of the local positions in q; allocated together with `columns` */
  bool flat;      /* true if the positions of each body form a vector (baum_i_manifold is NULL) */
} baum_i_span;

/* Kinds of bodies, by the coordinates that determine their frame. */
typedef enum baum_i_frame_kind {
  BAUM_I_FRAME_NONE,     /* user coordinates, which have no position in the plane or in space */
  BAUM_I_FRAME_PARTICLE, /* x, y */
  BAUM_I_FRAME_BODY,     /* x, y, angle */
  BAUM_I_FRAME_GROUND,
  BAUM_I_FRAME_SPATIAL_PARTICLE, /* x, y, z */
  BAUM_I_FRAME_SPATIAL_BODY      /* x, y, z, quaternion */
} baum_i_frame_kind;

static inline bool baum_i_is_spatial(baum_i_frame_kind kind)
{
  return kind >= BAUM_I_FRAME_SPATIAL_PARTICLE;
}

typedef struct baum_i_body_type baum_i_body_type;
typedef struct baum_i_manifold baum_i_manifold;
typedef struct baum_i_joint_type baum_i_joint_type;
typedef struct baum_i_force_type baum_i_force_type;

typedef struct baum_i_body {
  baum_i_element element;
  const baum_i_body_type *type;
  const baum_i_manifold *manifold; /* NULL if q is a vector and v = q' */
  baum_i_span span;                /* contains only the body itself; columns are set at freeze */
  int q;                           /* first position */
  int nq;                          /* number of positions */
  int v;                           /* first velocity */
  int nv;                          /* number of velocities */
  /* where the nv x nv values of the body begin in the mass blocks */
  int mass;
  bool fixed; /* true if welds connect the body to ground */
  int outline_count;
  struct baum_outline *outlines; /* (outline_count) given by the user, or NULL */
} baum_i_body;

typedef struct baum_i_joint {
  baum_i_element element;
  const baum_i_joint_type *type;
  baum_i_span span;
  int row;
  int rows;
  /* number of velocity-level rows (J v = nu without Phi); they are the last rows of the joint */
  int velocity_rows;
  int jacobian; /* where its rows x nl values begin in the Jacobian */
  int square;   /* where its nl x nl values begin in arrays of second derivatives */
  bool fixed;   /* true if all its bodies are fixed */
  bool fixes;   /* true for a weld that determines the pose of a fixed body */
} baum_i_joint;

typedef struct baum_i_force {
  baum_i_element element;
  const baum_i_force_type *type;
  baum_i_span span;
  int square; /* where its nl x nl values begin in arrays of derivatives */
} baum_i_force;

typedef struct baum_i_body_group {
  const baum_i_body_type *type;
  int count;
  const baum_i_body **bodies; /* (count) */
} baum_i_body_group;

typedef struct baum_i_joint_group {
  const baum_i_joint_type *type;
  int count;
  const baum_i_joint **joints; /* (count) */
} baum_i_joint_group;

typedef struct baum_i_force_group {
  const baum_i_force_type *type;
  int count;
  const baum_i_force **forces; /* (count) */
} baum_i_force_group;

/* ---- a point in state space ---- */

/* Pose and velocities of a body, in one cache line. Planar elements read this struct instead of
 * q. */
typedef struct baum_i_frame {
  double x, y;   /* origin */
  double vx, vy; /* velocities; zero if only positions are known */
  double c, s;   /* cos, sin of the angle */
  double w;      /* angular velocity; zero if only positions are known */
  double angle;  /* continuous, so it may exceed a full revolution */
} baum_i_frame;

/* Pose and velocities of a body in space. Spatial elements read this struct instead of q. */
typedef struct baum_i_spatial_frame {
  double r[4]; /* origin, followed by 0 like the next two vectors, which can thus be loaded whole */
  double v[4]; /* velocity of the origin in ground axes; zero if only positions are known */
  double w[4]; /* angular velocity in ground axes; zero if only positions are known */
  double axes[12]; /* rotation matrix A, row-major, from body axes to ground axes; then zeros */
} baum_i_spatial_frame;

/* Return the frame of a planar body as a frame in space. */
static inline baum_i_spatial_frame baum_i_lifted(const baum_i_frame *f)
{
  return (baum_i_spatial_frame){.r = {f->x, f->y},
                                .v = {f->vx, f->vy},
                                .w = {0.0, 0.0, f->w},
                                .axes = {f->c, -f->s, 0.0, f->s, f->c, 0.0, 0.0, 0.0, 1.0}};
}

/* The coordinates from which the frame of a body is computed: their indices in q and v. */
typedef struct baum_i_body_place {
  int32_t q;    /* first position */
  int32_t v;    /* first velocity */
  int32_t kind; /* baum_i_frame_kind */
  /* whether the spatial frame is needed, because the body or an element that acts on it is
   * spatial */
  int32_t in_space;
} baum_i_body_place;

typedef struct baum_i_frames_kernel baum_i_frames_kernel;

baum_i_frame_kind baum_i_frame_of(const baum_i_body *body);

/* Return the frame of a body with the coordinates q and zero velocities. Bodies without a position
 * are at the origin. */
baum_i_frame baum_i_frame_at(baum_i_frame_kind kind, const double *q);

/* A point in state space at which the functions of elements are evaluated. Only one thread at a
 * time may use it. */
typedef struct baum_i_point {
  const baum_mechanism *mechanism;
  const double *parameters; /* the mechanism's parameter array, or a caller's copy of it */
  double t;
  const double *q;      /* the same as `normalized` if the mechanism is not flat */
  const double *v;      /* NULL if the point has only positions */
  double *normalized;   /* (nq) normalized q; NULL if the mechanism is flat */
  baum_i_frame *frames; /* (body_count + 1) frames of all bodies, ground first */
  const baum_i_frames_kernel *kernel;
  /* (body_count + 1) spatial frames, set only for bodies with `in_space` in baum_i_body_place; NULL
   * if the mechanism has no spatial elements */
  baum_i_spatial_frame *spatial;
  /* Expected angles of spatial joints, see general/coordinate.h. `angles` points to own_angles or
   * to an array of a run. */
  double *angles;
  double *own_angles;
  const double *inputs; /* (input_count) present values, or NULL if there are no inputs */
  /* (nv) moments that replace the gyroscopic moments of rigid bodies; NULL if they are not
   * replaced */
  const double *moments;
  double *scratch; /* (mechanism->scratch_size) for user functions and differences */
  bool retry;      /* set by a failure that a smaller step may avoid */
  bool asking;     /* set while a user function runs; the user function must not use this point */
  bool checks_run; /* set while derivatives are checked at a state of a run */
} baum_i_point;

/* Return the frame of a body in the design configuration at rest. May be called before freeze. */
baum_i_frame baum_i_design_frame(const baum_mechanism *mechanism, int body);

/* Create an evaluation point, with the parameters and the initial inputs of the mechanism. Returns
 * BAUM_OK or BAUM_ERR_MEMORY. The point must be released even after a failure. */
baum_status baum_i_point_create(const baum_mechanism *mechanism, baum_i_point *point);
void baum_i_point_release(baum_i_point *point); /* a zeroed point is allowed */

/* ---- spatial/spatial_frames.c ---- */

/* Return the frame of a body at the coordinates q and velocities v. If v is NULL, the velocities
 * are zero. Kinds without a position have the frame of ground. */
baum_i_spatial_frame baum_i_spatial_frame_at(baum_i_frame_kind kind, const double *q,
                                             const double *v);

/* Return the frame of a body in the design configuration at rest. May be called before freeze. */
baum_i_spatial_frame baum_i_spatial_design_frame(const baum_mechanism *mechanism, int body);

/* Set the spatial frames of a point. */
void baum_i_point_set_spatial(baum_i_point *point);

/* These functions implement baum_i_point_set(): the first one if the mechanism is flat, that is, if
 * q is a vector, and the second one otherwise. */
void baum_i_point_set_vector(baum_i_point *point, double t, const double *q, const double *v);
void baum_i_point_set_normalized(baum_i_point *point, double t, const double *q, const double *v);

/* Set the time, q, v and the frames of a point. v may be NULL. The point stores the pointer v
 * without copying the numbers. If the mechanism is flat, it also stores the pointer q. */
static inline void baum_i_point_set(baum_i_point *point, double t, const double *q, const double *v)
{
  if (point->normalized) {
    baum_i_point_set_normalized(point, t, q, v);
  } else {
    baum_i_point_set_vector(point, t, q, v);
  }
}

/* ---- types ---- */

/* The smallest box that contains a set of points. Its edges are parallel to the ground axes. */
typedef struct baum_i_box {
  double low[3];
  double high[3];
} baum_i_box;

void baum_i_box_include(baum_i_box *box, double x, double y, double z);

/* Results of the evaluation of all constraint rows. Members that are NULL are not evaluated.
 * Scleronomic joints, whose Phi does not depend on t, do not set their rows of nu. The caller must
 * set these rows to zero before the evaluation. */
typedef struct baum_i_rows {
  double *phi;      /* (nc) */
  double *jacobian; /* (jacobian_size) */
  double *nu;       /* (nc) */
  double *gamma;    /* (nc); the point must have velocities */
} baum_i_rows;

/* Arrays for the second derivatives of joints. The block of a joint is row-major over its local
 * columns. A block of rows x nl entries begins at the index `jacobian` of the joint, and a block of
 * nl x nl entries at the index `square` of the joint. Members that are NULL are not evaluated.
 * Functions set the blocks and do not add to them. */
typedef struct baum_i_joint_blocks {
  double *jw_q;    /* (J w)_q, rows x nl */
  double *jtl_q;   /* (J^T lambda)_q, nl x nl */
  double *gamma_q; /* rows x nl */
  double *gamma_v; /* rows x nl */
  double *nu_q;    /* rows x nl */
} baum_i_joint_blocks;

/* Arrays for the derivatives of bodies. The nv x nv block of a body begins at the index `mass` of
 * the body. Functions set the blocks and do not add to them. */
typedef struct baum_i_body_blocks {
  double *ma_q; /* (M a)_q */
  double *force_q;
  double *force_v;
} baum_i_body_blocks;

/* Arrays for the derivatives of forces. The nl x nl block of a force begins at the index `square`
 * of the force. Functions set the blocks and do not add to them. */
typedef struct baum_i_force_blocks {
  double *force_q;
  double *force_v;
} baum_i_force_blocks;

/* Classes of powers [W] in the energy account of a run. */
typedef enum baum_i_power {
  BAUM_I_POWER_LOADS,
  BAUM_I_POWER_SPRINGS,
  BAUM_I_POWER_DAMPERS,
  BAUM_I_POWER_USER_FORCES,
  BAUM_I_POWER_BODIES,
  BAUM_I_POWERS
} baum_i_power;

/* Functions for the manifold of a body whose positions are not a vector. Its positions are q (nq),
 * its velocities are v (nv), and q' = N(q) v. Displacements dx have length nv. The file manifold.h
 * has the same functions for whole mechanisms. */
struct baum_i_manifold {
  /* Set dq = N(q) v. q may be slightly off the manifold, as it is in the stages of an
   * integrator. */
  void (*rate)(const baum_i_body *body, const double *q, const double *v, double *dq);
  /* Move q by h v. To second order in h, the result is the configuration after the time h at
   * constant v. */
  void (*move)(const baum_i_body *body, double h, const double *v, double *q);
  /* Find the displacement dx that leads from `from` to `to`: `move` with h = 1 and v = dx moves
   * `from` to `to`. */
  void (*difference)(const baum_i_body *body, const double *from, const double *to, double *dx);
  /* Move q to the nearest point of the manifold. */
  void (*normalize)(const baum_i_body *body, double *q);
  /* second_rate() sets ddq = N a + N' v. tangent() sets dx so that N dx is the tangential part of
   * dq. If a function is NULL, finite differences replace it. */
  void (*second_rate)(const baum_i_body *body, const double *q, const double *v, const double *a,
                      double *ddq);
  void (*tangent)(const baum_i_body *body, const double *q, const double *dq, double *dx);
};

struct baum_i_body_type {
  baum_i_definition definition;
  baum_i_frame_kind frame;
  bool scleronomic;    /* whether mass and force never depend on t */
  bool constant_force; /* whether the force depends only on parameters */
  /* numbers of positions and velocities, if they are the same for all bodies of the type; 0 if
   * size() and positions() return them */
  int nq, nv;
  int (*size)(const void *def);      /* nv of a body, or NULL */
  int (*positions)(const void *def); /* nq of a body, or NULL */
  /* Return the manifold of a body. If this function or its result is NULL, q is a vector and
   * v = q'. */
  const baum_i_manifold *(*manifold)(const void *def);
  bool (*constant_mass)(const void *def); /* NULL if the mass is always constant */
  /* whether force() depends on velocities; NULL if it never does */
  bool (*depends_on_velocity)(const void *def);
  /* Rigid bodies in space have this function. It returns the inertia tensor (9) in body axes.
   * Velocities 3 to 5 of such a body are its angular velocity in body axes, and force() depends on
   * velocities only through the gyroscopic moment. NULL for other bodies. */
  const double *(*inertia)(const baum_i_body *body, const double *parameters);
  /* Set the parameters of a body. NULL if the body has no parameters. */
  void (*lower)(const baum_i_body *body, double *parameters);
  /* Set the design pose and the given velocities of a body, and whether assembly must not move the
   * body. Velocities that are not given are NaN. */
  void (*design)(const void *def, double *q, double *v, bool *held);
  /* Set the scale (nv) of each velocity coordinate, which is the size of a significant change. */
  void (*scale)(const void *def, double length, double *scale);
  /* Set the scale (nq) of each position coordinate. NULL if the body has no manifold. */
  void (*position_scale)(const void *def, double length, double *scale);
  /* Sets the mass blocks of the group. */
  baum_status (*mass)(const baum_i_body_group *group, baum_i_point *point, double *mass);
  /* Adds the forces of the group to force (nv). */
  baum_status (*force)(const baum_i_body_group *group, baum_i_point *point, double *force);
  /* Adds the potential of one body to *sum. NULL if the potential is 0. */
  baum_status (*potential)(const baum_i_body *body, baum_i_point *point, double *sum);
  /* Sets the blocks of one body, which the caller has zeroed. `a` has nv entries. NULL if the
   * blocks are zero. */
  baum_status (*linearize)(const baum_i_body *body, baum_i_point *point, const double *a,
                           const baum_i_body_blocks *blocks);
  /* Adds g^T v + v^T M' v / 2 of one body to the power of its class. This includes the power of
   * forces that have a potential. NULL if all forces derive from the potential, and M' = 0. */
  baum_status (*power)(const baum_i_body *body, baum_i_point *point, double power[BAUM_I_POWERS]);
};

/* Numbers of columns of a body in planar and in spatial elements (general/columns.h). */
enum { BAUM_I_PLANE = 3, BAUM_I_SPACE = 6, BAUM_I_PAIR_COLUMNS = 2 * BAUM_I_SPACE };

/* Largest number of coordinates of a joint. */
enum { BAUM_I_COORDINATES = 3 };

/* A joint coordinate. Its gradient has `width` columns for each of the two bodies, where `width` is
 * a member of the joint type. In the plane, the columns are x_a y_a angle_a x_b y_b angle_b. */
typedef struct baum_i_coordinate {
  double value;
  double rate;
  double gradient[BAUM_I_PAIR_COLUMNS];
  double gamma; /* defined by value'' = gradient a - gamma */
} baum_i_coordinate;

/* Second derivatives of a coordinate for a vector w and a multiplier lambda, as in
 * baum_i_joint_blocks. */
typedef struct baum_i_coordinate_blocks {
  double jw_q[BAUM_I_PAIR_COLUMNS];
  double jtl_q[BAUM_I_PAIR_COLUMNS * BAUM_I_PAIR_COLUMNS];
  double gamma_q[BAUM_I_PAIR_COLUMNS];
  double gamma_v[BAUM_I_PAIR_COLUMNS];
  double rate_q[BAUM_I_PAIR_COLUMNS]; /* (J v)_q */
} baum_i_coordinate_blocks;

/* Identifies one coordinate of a joint. */
typedef struct baum_i_joint_coordinate {
  const baum_i_joint *joint;
  int number; /* index of the coordinate in `coordinates` of the joint's type */
} baum_i_joint_coordinate;

struct baum_i_joint_type {
  baum_i_definition definition;
  /* number of columns of a body: BAUM_I_PLANE or BAUM_I_SPACE, or 0 if the reaction of the joint is
   * not a force and a moment */
  int width;
  bool scleronomic; /* whether Phi never depends on t */
  bool is_pin;      /* whether its rows are exactly those of a pin (planar/lower_pairs.c) */
  /* Return the coordinate that a driver prescribes. A driver has one row: this coordinate minus a
   * function of time. NULL for types that are not drivers. */
  baum_i_joint_coordinate (*driven)(const baum_mechanism *mechanism, const void *def);
  /* Set s to the prescribed value, rate and acceleration at the time of the point. NULL for joints
   * that are not drivers. */
  baum_status (*motion)(const baum_i_joint *driver, baum_i_point *point, double s[3]);
  /* Replace the law of a driver by s + s' (t - t0) + s'' (t - t0)^2 / 2. The function stores the
   * new law in the driver's parameters. NULL for joints that are not drivers. */
  void (*replace_law)(double *parameters, double t0, const double s[3]);
  /* number of rows, the same for all joints of the type; 0 if rows() returns it */
  int row_count;
  /* returns the number of rows of a joint; NULL if row_count is not 0 */
  int (*rows)(const void *def);
  /* Number of velocity-level rows. Like the number of all rows, it is either the same for all
   * joints of the type, or a function returns it. Velocity-level rows are the last rows of the
   * joint, and their Phi is 0. */
  int velocity_row_count;
  int (*velocity_rows)(const void *def);
  /* Set the parameters from the definition and the design configuration. Returns BAUM_OK, or
   * BAUM_ERR_ARGUMENT after setting the message. */
  baum_status (*lower)(const baum_mechanism *mechanism, const baum_i_joint *joint,
                       double *parameters);
  /* Sets the rows and Jacobian blocks of all joints of the group, in those members of `rows` that
   * are not NULL. If a type has evaluate_one(), its evaluate() is baum_i_evaluate_each(), which
   * calls evaluate_one() for every joint. */
  baum_status (*evaluate)(const baum_i_joint_group *group, baum_i_point *point,
                          const baum_i_rows *rows);
  baum_status (*evaluate_one)(const baum_i_joint *joint, baum_i_point *point,
                              const baum_i_rows *rows);
  /* Sets the blocks of one joint, which the caller has zeroed. w has nv entries, and lambda has nc
   * entries. NULL if the blocks are zero. */
  baum_status (*linearize)(const baum_i_joint *joint, baum_i_point *point, const double *w,
                           const double *lambda, const baum_i_joint_blocks *blocks);
  /* Welds have this function. From the known pose of one body it finds the pose q of the other. The
   * known body is body_a if `from_a` is set. known = NULL means that the known body is ground. NULL
   * for types that are not welds. */
  void (*weld)(const double *parameters, bool from_a, const double *known, double *q);
  /* Find the joint's point on body_b in ground axes, for reactions and drawing. NULL if width is
   * 0. */
  void (*place)(const baum_i_joint *joint, const baum_i_point *point, double at[3]);
  /* Spatial joints have this function. It adds the generalized force -J^T lambda to all six columns
   * of body_b, including those that a planar body or a particle does not have. */
  void (*force_on_b)(const baum_i_joint *joint, const baum_i_point *point, const double *lambda,
                     double six[BAUM_I_SPACE]);
  /* Tell whether the rows are satisfied in a wrong way, with axes that point in opposite instead of
   * equal directions. NULL if this cannot happen. */
  bool (*is_reversed)(const baum_i_joint *joint, const baum_i_point *point);
  /* Extend a box so that it includes the points of the joint in the design configuration. NULL if
   * the joint has no points. */
  void (*extent)(const baum_mechanism *mechanism, const baum_i_joint *joint, baum_i_box *box);
  /* The coordinates of the joint type. The list ends with BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinates[BAUM_I_COORDINATES + 1];
  /* Check that a joint has the coordinates that its type lists. Its definition has already been
   * checked. NULL if all joints of the type have them. */
  baum_status (*check_coordinate)(const baum_mechanism *mechanism, const void *def,
                                  const char *label);
  void (*coordinate)(const baum_i_joint *joint, int number, const baum_i_point *point,
                     baum_i_coordinate *out);
  void (*coordinate_linearize)(const baum_i_joint *joint, int number, const baum_i_point *point,
                               const double *w, double lambda, baum_i_coordinate_blocks *out);
  /* Return the relative error of those derivatives that the joint computes by differences. NULL if
   * the joint computes no derivatives by differences. */
  double (*noise)(const void *def);
};

/* Calls evaluate_one() for one joint after the other. All types that have a function evaluate_one()
 * use baum_i_evaluate_each() as their `evaluate`. */
baum_status baum_i_evaluate_each(const baum_i_joint_group *group, baum_i_point *point,
                                 const baum_i_rows *rows);

/* The present length of a spring. For a torsion spring this length is an angle, and for a joint
 * spring it is a coordinate of a joint. */
typedef struct baum_i_stretch {
  double length;
  double rate;
  double scale;      /* the size of a significant change of the length */
  bool no_direction; /* set for a spring between points that coincide; it exerts no force */
} baum_i_stretch;

struct baum_i_force_type {
  baum_i_definition definition;
  bool spatial; /* whether elements of the type need spatial frames */
  /* True if stretch() returns an angle that positions determine only up to whole revolutions. */
  bool counts_revolutions;
  baum_status (*lower)(const baum_mechanism *mechanism, const baum_i_force *force,
                       double *parameters);
  /* Adds the forces of the group to force (nv). */
  baum_status (*force)(const baum_i_force_group *group, baum_i_point *point, double *force);
  /* Tell whether the force depends on velocities. NULL if it never does. */
  bool (*depends_on_velocity)(const baum_i_force *force);
  /* Springs have these two members (general/spring_law.h). The first is the offset of the first
   * field of baum_i_spring_def in the definition, and the second returns the present length of a
   * spring. */
  size_t spring_fields;
  baum_i_stretch (*stretch)(const baum_i_force *force, const baum_i_point *point);
  /* Adds the potential of one force to *sum. NULL if the potential is 0. */
  baum_status (*potential)(const baum_i_force *force, baum_i_point *point, double *sum);
  /* Sets the blocks of one force, which the caller has zeroed. */
  baum_status (*linearize)(const baum_i_force *force, baum_i_point *point,
                           const baum_i_force_blocks *blocks);
  /* Adds the power g^T v of one force to the power of its class. If the force has a potential, the
   * power of the part that derives from it is included only if power_is_whole() returns true. */
  baum_status (*power)(const baum_i_force *force, baum_i_point *point, double power[BAUM_I_POWERS]);
  /* Tell whether power() returns the power of the whole force. NULL if it never does. */
  bool (*power_is_whole)(const baum_i_force *force);
  /* if power_is_whole() returns true: the class to which power() adds the power */
  baum_i_power whole_class;
  /* Tell whether the force jumps, or its count of revolutions may become wrong, during a step from
   * the configuration `from` to the configuration `to` (nq each). NULL if this never happens. */
  bool (*jumps)(const baum_i_force *force, const baum_i_point *point, const double *from,
                const double *to);
};

/* ---- the mechanism ---- */

struct baum_mechanism {
  atomic_int references;
  uint32_t tag; /* identifies the mechanism in ids; copies of a mechanism have the same tag */
  bool frozen;
  bool wide; /* whether it is evaluated with wide vector instructions (base/hot.h) */
  double gravity[3];
  double given_length; /* [m] characteristic length given by the user; NaN if not set */

  int body_count;       /* without ground */
  baum_i_body **bodies; /* (body_count + 1); the first one is ground */
  int joint_count;
  baum_i_joint **joints;
  int force_count;
  baum_i_force **forces;
  int input_count;
  char **input_names;
  double *inputs; /* (input_count) initial values */
  int break_count;
  double *breaks; /* (break_count) [s] ascending */

  /* Freeze sets the members from here on. */
  int nq, nv, nc;
  int mass_size;     /* number of values in all mass blocks */
  int jacobian_size; /* number of values in all blocks of the Jacobian */
  int joint_square_size;
  int force_square_size;
  int scratch_size;
  int parameter_count;
  bool constant_mass;
  bool flat;                 /* true if no body has a manifold; then nq = nv and q' = v */
  double length;             /* characteristic length */
  baum_i_body_place *places; /* (body_count + 1) */
  bool all_planar;           /* true if every body has the three coordinates of a planar body */
  bool spatial;              /* true if the mechanism has a spatial body, joint or force */
  double *parameters;
  double *design_q; /* (nq) */
  double *design_v; /* (nv) NaN where the velocity is not given */
  bool *held;       /* (nv) whether assembly must not move the coordinate */
  /* (nv) for each velocity coordinate, the size of a significant change */
  double *scale;
  double *position_scale;       /* (nq) for each position, the size of a significant change */
  int velocity_row_count;       /* number of rows of velocity level */
  unsigned char *velocity_rows; /* (nc) 1: row of velocity level; NULL: there are none */
  double *row_gains;            /* (nc) 1/2 for rows of velocity level, else 1; NULL: all 1 */
  int fixed_count;              /* number of fixed bodies, without ground */
  int fixed_nv;                 /* number of velocities of fixed bodies */
  /* (nq) positions of fixed bodies; the entries of other bodies are not used */
  double *fixed_q;
  baum_i_body_group *body_groups; /* each list of groups ends with a group that has no type */
  baum_i_joint_group *joint_groups;
  baum_i_force_group *force_groups;
};

#endif
