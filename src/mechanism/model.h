/* SPDX-License-Identifier: BSD-3-Clause */
/* Data structures of a mechanism: elements (bodies, joints, forces), element types, the point in
 * state space at which elements are evaluated, and the frozen structure. Functions of the whole
 * mechanism are in mechanism.h.
 *
 * An element type is a const struct of functions. The file of a type contains this struct and the
 * four public functions of the type (definition.h). Functions process groups: all elements of one
 * type in one call. Structure and numbers are separate: after freeze the structure is constant, and
 * every mass, length and stiffness is in one parameter array.
 *
 * Body 0 is ground. index1 of a body id is the index in `bodies`; that of BAUM_GROUND is -1.
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

/* The first member of every element. */
typedef struct baum_i_element {
  const char *family; /* "body", "joint" or "force" */
  const baum_i_definition *definition;
  void *def;     /* own copy; its `name` points to `name` below or is NULL */
  char *name;    /* the given name, or "body<k>", "joint<k>", "force<k>" */
  int index;     /* in its family, from 1 */
  int parameter; /* start of its numbers in the parameter array; set at freeze */
} baum_i_element;

/* The bodies on which an element acts, with their velocities and positions. The local columns are
 * those of the bodies one after the other, without ground. Freeze sets all members except bodies
 * and body_count. */
typedef struct baum_i_span {
  int body_count;
  int *bodies;    /* (body_count) indices, 0 = ground */
  int nl;         /* number of local velocities */
  int *columns;   /* (nl) their indices in v */
  int ql;         /* number of local positions */
  int *positions; /* (ql) their indices in q; in the memory of `columns` */
  bool flat;      /* none of the bodies has a manifold */
} baum_i_span;

/* Kinds of bodies, by the coordinates that determine their frame. */
typedef enum baum_i_frame_kind {
  BAUM_I_FRAME_NONE,     /* user coordinates: no position */
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
  const baum_i_manifold *manifold; /* NULL: q is a vector and v = q' */
  baum_i_span span;                /* the body itself; columns are set at freeze */
  int q;                           /* first position */
  int nq;                          /* number of positions */
  int v;                           /* first velocity */
  int nv;                          /* number of velocities */
  int mass;                        /* start of its nv x nv values in the mass blocks */
  bool fixed;                      /* welded to ground */
  int outline_count;
  struct baum_outline *outlines; /* (outline_count) given by the user, or NULL */
} baum_i_body;

typedef struct baum_i_joint {
  baum_i_element element;
  const baum_i_joint_type *type;
  baum_i_span span;
  int row;
  int rows;
  int jacobian; /* start of its rows x nl values */
  int square;   /* start of its nl x nl values, for second derivatives */
  bool fixed;   /* between fixed bodies */
  bool fixes;   /* a weld that determines the pose of a fixed body */
} baum_i_joint;

typedef struct baum_i_force {
  baum_i_element element;
  const baum_i_force_type *type;
  baum_i_span span;
  int square; /* start of its nl x nl values */
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

/* Pose and velocities of a body, in one cache line. Planar elements read this instead of q. */
typedef struct baum_i_frame {
  double x, y;   /* origin */
  double vx, vy; /* velocities; zero at position level */
  double c, s;   /* cos, sin of the angle */
  double w;      /* angular velocity; zero at position level */
  double angle;  /* continuous over revolutions */
} baum_i_frame;

/* Pose and velocities of a body in space. Spatial elements read this instead of q. */
typedef struct baum_i_spatial_frame {
  double r[3];    /* origin */
  double v[3];    /* velocities in ground axes; zero at position level */
  double w[3];    /* angular velocity in ground axes */
  double axes[9]; /* A, row-major: from body axes to ground axes */
} baum_i_spatial_frame;

/* The coordinates from which the frame of a body is computed. */
typedef struct baum_i_body_place {
  int32_t q;    /* first position */
  int32_t v;    /* first velocity */
  int32_t kind; /* baum_i_frame_kind */
} baum_i_body_place;

typedef struct baum_i_frames_kernel baum_i_frames_kernel;

baum_i_frame_kind baum_i_frame_of(const baum_i_body *body);

/* Return the frame of a body at its q, at rest. Bodies without a position are at the
 * origin. */
baum_i_frame baum_i_frame_at(baum_i_frame_kind kind, const double *q);

/* A point in state space, at which functions are evaluated. Only one thread at a time may use
 * it. */
typedef struct baum_i_point {
  const baum_mechanism *mechanism;
  const double *parameters; /* those of the mechanism, or a caller's copy */
  double t;
  const double *q;      /* if the mechanism is not flat, = normalized */
  const double *v;      /* NULL at position level */
  double *normalized;   /* (nq) normalized q; NULL if the mechanism is flat */
  baum_i_frame *frames; /* (body_count + 1), ground first */
  const baum_i_frames_kernel *kernel;
  baum_i_spatial_frame *spatial; /* (body_count + 1); NULL if nothing is spatial */
  /* Expected angles of spatial joints (general/coordinate.h): own_angles, or an array of a run. */
  double *angles;
  double *own_angles;
  const double *inputs;  /* (input_count) present values; NULL: none */
  const double *moments; /* (nv) in place of the gyroscopic moments of rigid bodies, or NULL */
  double *scratch;       /* (mechanism->scratch_size) for user functions and differences */
  bool retry;            /* a smaller step may avoid the last failure */
  bool asking;           /* a user function is running and must not use this point */
} baum_i_point;

/* Return the frame of a body in the design configuration at rest. May be called before freeze. */
baum_i_frame baum_i_design_frame(const baum_mechanism *mechanism, int body);

/* Create a point with the parameters and initial inputs of the mechanism. BAUM_OK or
 * BAUM_ERR_MEMORY. The point must be released even after a failure. */
baum_status baum_i_point_create(const baum_mechanism *mechanism, baum_i_point *point);
void baum_i_point_release(baum_i_point *point); /* a zeroed point is allowed */

/* ---- spatial/spatial_frames.c ---- */

/* Return the frame of a body at its q and v. v = NULL means rest. Kinds without a position have the
 * frame of ground. */
baum_i_spatial_frame baum_i_spatial_frame_at(baum_i_frame_kind kind, const double *q,
                                             const double *v);

/* Return the frame of a body in the design configuration at rest. May be called before freeze. */
baum_i_spatial_frame baum_i_spatial_design_frame(const baum_mechanism *mechanism, int body);

/* Set the spatial frames of a point. */
void baum_i_point_set_spatial(baum_i_point *point);

/* The two cases of baum_i_point_set(): the mechanism is flat, or not. */
void baum_i_point_set_vector(baum_i_point *point, double t, const double *q, const double *v);
void baum_i_point_set_normalized(baum_i_point *point, double t, const double *q, const double *v);

/* Set t, q, v (or NULL) and the frames. The point refers to v, and if the mechanism is flat to q,
 * without a copy. */
static inline void baum_i_point_set(baum_i_point *point, double t, const double *q, const double *v)
{
  if (point->normalized) {
    baum_i_point_set_normalized(point, t, q, v);
  } else {
    baum_i_point_set_vector(point, t, q, v);
  }
}

/* ---- types ---- */

/* The smallest box around points in ground axes. */
typedef struct baum_i_box {
  double low[3];
  double high[3];
} baum_i_box;

void baum_i_box_include(baum_i_box *box, double x, double y, double z);

/* Results of the evaluation of all constraint rows. Members that are NULL are not evaluated.
 * Scleronomic joints (Phi without t) do not set their rows of nu, which must be zeroed before. */
typedef struct baum_i_rows {
  double *phi;      /* (nc) */
  double *jacobian; /* (jacobian_size) */
  double *nu;       /* (nc) */
  double *gamma;    /* (nc); requires velocities */
} baum_i_rows;

/* Arrays for the second derivatives of joints. The block of a joint is row-major over its local
 * columns and starts at its `jacobian` (rows x nl) or `square` (nl x nl). NULL: not evaluated.
 * Blocks are set, not added to. */
typedef struct baum_i_joint_blocks {
  double *jw_q;    /* (J w)_q, rows x nl */
  double *jtl_q;   /* (J^T lambda)_q, nl x nl */
  double *gamma_q; /* rows x nl */
  double *gamma_v; /* rows x nl */
  double *nu_q;    /* rows x nl */
} baum_i_joint_blocks;

/* Arrays for the derivatives of bodies. The block nv x nv of a body starts at its `mass`. Blocks
 * are set, not added to. */
typedef struct baum_i_body_blocks {
  double *ma_q; /* (M a)_q */
  double *force_q;
  double *force_v;
} baum_i_body_blocks;

/* Arrays for the derivatives of forces. The block nl x nl of a force starts at its `square`. Blocks
 * are set, not added to. */
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

/* Manifold of a body whose positions are not a vector: q' = N(q) v with q (nq) and v (nv). dx has
 * length nv. See manifold.h. */
struct baum_i_manifold {
  /* Set dq = N(q) v. q may be slightly off the manifold, as in the stages of an integrator. */
  void (*rate)(const baum_i_body *body, const double *q, const double *v, double *dq);
  /* Move q by h v: to the configuration after the time h at constant v, to second order in h. */
  void (*move)(const baum_i_body *body, double h, const double *v, double *q);
  /* Find dx such that `move` by dx with h = 1 leads from `from` to `to`. */
  void (*difference)(const baum_i_body *body, const double *from, const double *to, double *dx);
  /* Move q to the nearest point of the manifold. */
  void (*normalize)(const baum_i_body *body, double *q);
};

struct baum_i_body_type {
  baum_i_definition definition;
  baum_i_frame_kind frame;
  bool scleronomic;                  /* mass and force never depend on t */
  bool constant_force;               /* force depends only on parameters */
  int nq, nv;                        /* of every body; 0: size() and positions() return them */
  int (*size)(const void *def);      /* nv of a body, or NULL */
  int (*positions)(const void *def); /* nq of a body, or NULL */
  /* Manifold of a body. If this or its result is NULL, q is a vector and v = q'. */
  const baum_i_manifold *(*manifold)(const void *def);
  bool (*constant_mass)(const void *def);       /* NULL: always */
  bool (*depends_on_velocity)(const void *def); /* whether force() does; NULL: never */
  /* Rigid bodies in space: return the inertia tensor (9) in body axes. Velocities 3 to 5 of such a
   * body are its angular velocity in body axes, and its force() depends on velocities only by the
   * gyroscopic moment. NULL for other bodies. */
  const double *(*inertia)(const baum_i_body *body, const double *parameters);
  /* Set the parameters of a body. NULL: there are none. */
  void (*lower)(const baum_i_body *body, double *parameters);
  /* Set the design pose, the given velocities (NaN: free), and whether assembly must not move
   * it. */
  void (*design)(const void *def, double *q, double *v, bool *held);
  /* Set the scale (nv) of each coordinate, which is the size of a relevant change. */
  void (*scale)(const void *def, double length, double *scale);
  /* Set the scale (nq) of each position. NULL if there is no manifold. */
  void (*position_scale)(const void *def, double length, double *scale);
  /* Sets the mass blocks of the group. */
  baum_status (*mass)(const baum_i_body_group *group, baum_i_point *point, double *mass);
  /* Adds to force (nv). */
  baum_status (*force)(const baum_i_body_group *group, baum_i_point *point, double *force);
  /* Adds the potential of one body to *sum. NULL: it is 0. */
  baum_status (*potential)(const baum_i_body *body, baum_i_point *point, double *sum);
  /* Sets the blocks of one body, which are zeroed before. a (nv). NULL: they are zero. */
  baum_status (*linearize)(const baum_i_body *body, baum_i_point *point, const double *a,
                           const baum_i_body_blocks *blocks);
  /* Adds g^T v + v^T M' v / 2 of one body, including the power of the potential. NULL: all forces
   * derive from the potential, and M' = 0. */
  baum_status (*power)(const baum_i_body *body, baum_i_point *point, double power[BAUM_I_POWERS]);
};

/* Numbers of columns of a body in planar and in spatial elements (general/columns.h). */
enum { BAUM_I_PLANE = 3, BAUM_I_SPACE = 6, BAUM_I_PAIR_COLUMNS = 2 * BAUM_I_SPACE };

/* Largest number of coordinates of a joint. */
enum { BAUM_I_COORDINATES = 3 };

/* A joint coordinate. Its gradient has `width` columns (of the joint type) for each of the two
 * bodies: in the plane x_a y_a angle_a x_b y_b angle_b. */
typedef struct baum_i_coordinate {
  double value;
  double rate;
  double gradient[BAUM_I_PAIR_COLUMNS];
  double gamma; /* value'' = gradient a - gamma */
} baum_i_coordinate;

/* Second derivatives of a coordinate for w and a multiplier lambda, as in baum_i_joint_blocks. */
typedef struct baum_i_coordinate_blocks {
  double jw_q[BAUM_I_PAIR_COLUMNS];
  double jtl_q[BAUM_I_PAIR_COLUMNS * BAUM_I_PAIR_COLUMNS];
  double gamma_q[BAUM_I_PAIR_COLUMNS];
  double gamma_v[BAUM_I_PAIR_COLUMNS];
  double rate_q[BAUM_I_PAIR_COLUMNS]; /* (J v)_q */
} baum_i_coordinate_blocks;

/* One coordinate of a joint. */
typedef struct baum_i_joint_coordinate {
  const baum_i_joint *joint;
  int number; /* index in `coordinates` of the joint's type */
} baum_i_joint_coordinate;

struct baum_i_joint_type {
  baum_i_definition definition;
  int width;        /* columns of a body: BAUM_I_PLANE or BAUM_I_SPACE; 0: its reaction is not a
                     * force and a moment */
  bool scleronomic; /* Phi never depends on t */
  bool is_pin;      /* its rows are exactly those of a pin (planar/lower_pairs.c) */
  /* Return the coordinate that a driver prescribes. A driver has one row: this coordinate minus a
   * function of time. NULL: the type is not a driver. */
  baum_i_joint_coordinate (*driven)(const baum_mechanism *mechanism, const void *def);
  /* Set s to the prescribed value, rate and acceleration at the time of the point. NULL for joints
   * that are not drivers. */
  baum_status (*motion)(const baum_i_joint *driver, baum_i_point *point, double s[3]);
  /* Set the parameters of a driver such that its law becomes s + s' (t - t0) + s'' (t - t0)^2 / 2.
   * NULL for joints that are not drivers. */
  void (*replace_law)(double *parameters, double t0, const double s[3]);
  int row_count;                /* of every joint; 0: rows() returns it */
  int (*rows)(const void *def); /* rows of a joint, or NULL */
  /* Set the parameters from the definition and the design configuration. Returns BAUM_OK, or
   * BAUM_ERR_ARGUMENT and sets the message. */
  baum_status (*lower)(const baum_mechanism *mechanism, const baum_i_joint *joint,
                       double *parameters);
  /* Sets the rows and blocks of the group in members that are not NULL. baum_i_evaluate_each()
   * calls evaluate_one() for every joint. */
  baum_status (*evaluate)(const baum_i_joint_group *group, baum_i_point *point,
                          const baum_i_rows *rows);
  baum_status (*evaluate_one)(const baum_i_joint *joint, baum_i_point *point,
                              const baum_i_rows *rows);
  /* Sets the blocks of one joint, which are zeroed before. w (nv), lambda (nc). NULL: they are
   * zero. */
  baum_status (*linearize)(const baum_i_joint *joint, baum_i_point *point, const double *w,
                           const double *lambda, const baum_i_joint_blocks *blocks);
  /* Welds: find the pose q of one body from the known pose of the other, which is body_a if from_a.
   * known = NULL means ground. NULL: the type is not a weld. */
  void (*weld)(const double *parameters, bool from_a, const double *known, double *q);
  /* Find the joint's point on body_b in ground axes, for reactions and drawing. NULL if width is
   * 0. */
  void (*place)(const baum_i_joint *joint, const baum_i_point *point, double at[3]);
  /* Spatial joints: add the generalized force -J^T lambda over all six columns of body_b, including
   * those that a planar body or a particle does not have. */
  void (*force_on_b)(const baum_i_joint *joint, const baum_i_point *point, const double *lambda,
                     double six[BAUM_I_SPACE]);
  /* Tell whether the constraints hold, but with axes that point in opposite instead of equal
   * directions. NULL: never. */
  bool (*is_reversed)(const baum_i_joint *joint, const baum_i_point *point);
  /* Extend a box to include the points of the joint in the design configuration. NULL: it has
   * none. */
  void (*extent)(const baum_mechanism *mechanism, const baum_i_joint *joint, baum_i_box *box);
  /* Its coordinates; the list ends with BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinates[BAUM_I_COORDINATES + 1];
  /* Check that a joint, whose definition has been checked, has these coordinates. NULL: all joints
   * of the type have them. */
  baum_status (*check_coordinate)(const baum_mechanism *mechanism, const void *def,
                                  const char *label);
  void (*coordinate)(const baum_i_joint *joint, int number, const baum_i_point *point,
                     baum_i_coordinate *out);
  void (*coordinate_linearize)(const baum_i_joint *joint, int number, const baum_i_point *point,
                               const double *w, double lambda, baum_i_coordinate_blocks *out);
  /* Return the relative error of derivatives that are computed by differences. NULL: none are. */
  double (*noise)(const void *def);
};

/* The `evaluate` of types that evaluate one joint at a time. */
baum_status baum_i_evaluate_each(const baum_i_joint_group *group, baum_i_point *point,
                                 const baum_i_rows *rows);

/* The present length of a spring. For a torsion spring it is an angle, for a joint spring a
 * coordinate of a joint. */
typedef struct baum_i_stretch {
  double length;
  double rate;
  double scale;      /* size of a relevant change of the length */
  bool no_direction; /* the spring is a line of length zero, so there is no force */
} baum_i_stretch;

struct baum_i_force_type {
  baum_i_definition definition;
  bool spatial; /* requires spatial frames */
  baum_status (*lower)(const baum_mechanism *mechanism, const baum_i_force *force,
                       double *parameters);
  /* Adds to force (nv). */
  baum_status (*force)(const baum_i_force_group *group, baum_i_point *point, double *force);
  bool (*depends_on_velocity)(const baum_i_force *force); /* NULL: never */
  /* Springs (general/spring_law.h): the offset of the first field of baum_i_spring_def in the
   * definition, and a function that returns the present length of a spring. */
  size_t spring_fields;
  baum_i_stretch (*stretch)(const baum_i_force *force, const baum_i_point *point);
  /* Adds the potential of one force to *sum. NULL: it is 0. */
  baum_status (*potential)(const baum_i_force *force, baum_i_point *point, double *sum);
  /* Sets the blocks of one force, which are zeroed before. */
  baum_status (*linearize)(const baum_i_force *force, baum_i_point *point,
                           const baum_i_force_blocks *blocks);
  /* Adds the power g^T v of one force by class. If the force has a potential, the power of this
   * part is included only if power_is_whole. */
  baum_status (*power)(const baum_i_force *force, baum_i_point *point, double power[BAUM_I_POWERS]);
  bool power_is_whole;
};

/* ---- the mechanism ---- */

struct baum_mechanism {
  atomic_int references;
  uint32_t tag; /* shared by copies */
  bool frozen;
  bool wide; /* evaluated with wide vectors (base/hot.h) */
  double gravity[3];
  double given_length; /* NaN: not set */

  int body_count;       /* without ground */
  baum_i_body **bodies; /* (body_count + 1), [0] is ground */
  int joint_count;
  baum_i_joint **joints;
  int force_count;
  baum_i_force **forces;
  int input_count;
  char **input_names;
  double *inputs; /* (input_count) initial values */
  int break_count;
  double *breaks; /* (break_count) [s] ascending */

  /* Set at freeze. */
  int nq, nv, nc;
  int mass_size;     /* values in all mass blocks */
  int jacobian_size; /* values in all row blocks */
  int joint_square_size;
  int force_square_size;
  int scratch_size;
  int parameter_count;
  bool constant_mass;
  bool flat;                 /* no body has a manifold: nq = nv and q' = v */
  double length;             /* characteristic length */
  baum_i_body_place *places; /* (body_count + 1) */
  bool all_planar;           /* every body has the three coordinates of a planar body */
  bool spatial;              /* has a spatial body, joint or force */
  double *parameters;
  double *design_q;               /* (nq) */
  double *design_v;               /* (nv) NaN: free */
  bool *held;                     /* (nv) */
  double *scale;                  /* (nv) size of a relevant change of each coordinate */
  double *position_scale;         /* (nq) size of a relevant change of each position */
  int fixed_count;                /* fixed bodies without ground */
  int fixed_nv;                   /* number of their velocities */
  double *fixed_q;                /* (nq) their positions */
  baum_i_body_group *body_groups; /* each list of groups ends with one without a type */
  baum_i_joint_group *joint_groups;
  baum_i_force_group *force_groups;
};

#endif
