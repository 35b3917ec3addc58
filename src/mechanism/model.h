/* SPDX-License-Identifier: BSD-3-Clause */
/* The types of a mechanism: elements (bodies, joints, forces), their types, the point where they
 * are evaluated, and the frozen structure. Functions of the whole mechanism are in mechanism.h.
 *
 * An element type is one const struct of functions; adding a joint is one file with such a struct
 * and its four public functions (definition.h). Functions work on groups: all elements of
 * one type in one call. Structure and numbers are apart: after freeze the structure is constant,
 * and every mass, length and stiffness lives in one parameter array.
 *
 * Body 0 is ground. A body id's index1 is the index here; BAUM_GROUND's is -1.
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
  void *def;     /* own copy; its name points to `name` or is NULL */
  char *name;    /* given, or "body<k>", "joint<k>", "force<k>" */
  int index;     /* in its family; bodies from 1 */
  int parameter; /* start of its numbers in the parameter array; set at freeze */
} baum_i_element;

/* The bodies that an element acts on, with their velocities and positions. The local columns are
 * those of the bodies one after the other, without ground. Freeze sets all but bodies and
 * body_count. */
typedef struct baum_i_span {
  int body_count;
  int *bodies;    /* (body_count) indices, 0 = ground */
  int nl;         /* number of local velocities */
  int *columns;   /* (nl) their columns in v */
  int ql;         /* number of local positions */
  int *positions; /* (ql) their columns in q; memory of `columns` */
  bool flat;      /* none of the bodies has a manifold */
} baum_i_span;

/* Which coordinates give a body's frame. */
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
  baum_i_span span;                /* itself; columns set at freeze */
  int q;                           /* first position */
  int nq;                          /* number of positions */
  int v;                           /* first velocity */
  int nv;                          /* number of velocities */
  int mass;                        /* start of its nv x nv values in the mass blocks */
  bool fixed;                      /* welded to ground */
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
  bool fixes;   /* the weld that fixes one of them */
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

/* Pose and velocities of a body. Every planar element reads this instead of q. One cache line. */
typedef struct baum_i_frame {
  double x, y;   /* origin */
  double vx, vy; /* velocities; zero at position level */
  double c, s;   /* cos, sin of the angle */
  double w;      /* angular velocity; zero at position level */
  double angle;  /* continuous */
} baum_i_frame;

/* Likewise in space, for spatial elements. */
typedef struct baum_i_spatial_frame {
  double r[3];    /* origin */
  double v[3];    /* velocities in ground axes; zero at position level */
  double w[3];    /* angular velocity in ground axes */
  double axes[9]; /* A by rows: turns body axes into ground axes */
} baum_i_spatial_frame;

/* Where a body's frame finds its coordinates. */
typedef struct baum_i_body_place {
  int32_t q;    /* first position */
  int32_t v;    /* first velocity */
  int32_t kind; /* baum_i_frame_kind */
} baum_i_body_place;

typedef struct baum_i_frames_kernel baum_i_frames_kernel;

baum_i_frame_kind baum_i_frame_of(const baum_i_body *body);

/* Frame of a body at its q, and its v or NULL for rest. Bodies without a position are at the
 * origin. */
baum_i_frame baum_i_frame_at(baum_i_frame_kind kind, const double *q, const double *v);

/* A point at which functions are evaluated. Only one thread at a time may use it. */
typedef struct baum_i_point {
  const baum_mechanism *mechanism;
  const double *parameters; /* of the mechanism, or a caller's own copy */
  double t;
  const double *q;      /* normalized, in own memory, where the mechanism is not flat */
  const double *v;      /* NULL at position level */
  double *normalized;   /* (nq); NULL where the mechanism is flat */
  baum_i_frame *frames; /* (body_count + 1), ground first */
  const baum_i_frames_kernel *kernel;
  baum_i_spatial_frame *spatial; /* likewise; NULL where nothing is spatial */
  /* (joint_count, 2) angle and rate of spatial joints at angles[2 joint_count], a time: angles are
   * the nearest to those that go on at these rates. */
  double *angles;
  const double *inputs; /* (input_count) present values; NULL while there are none */
  double *scratch;      /* (mechanism->scratch_size) for gathering and differences */
  bool retry;           /* set when the last failure may vanish with a smaller step */
  bool asking;          /* a user function is running, which must not use this point */
} baum_i_point;

/* Frame of a body in the design configuration at rest, from its definition; valid before freeze. */
baum_i_frame baum_i_design_frame(const baum_mechanism *mechanism, int body);

/* Create a point with the mechanism's numbers and initial inputs. BAUM_OK or BAUM_ERR_MEMORY;
 * release it in both cases. */
baum_status baum_i_point_create(const baum_mechanism *mechanism, baum_i_point *point);
void baum_i_point_release(baum_i_point *point); /* a zeroed one is fine */

/* ---- spatial/spatial_frames.c ---- */

/* Frame of a body at its q, and its v or NULL for rest. Kinds without a place have that of
 * ground. */
baum_i_spatial_frame baum_i_spatial_frame_at(baum_i_frame_kind kind, const double *q,
                                             const double *v);

/* Frame of a body in the design configuration, at rest. Valid before freeze. */
baum_i_spatial_frame baum_i_spatial_design_frame(const baum_mechanism *mechanism, int body);

/* Set the spatial frames of a point. */
void baum_i_point_set_spatial(baum_i_point *point);

/* The two cases of baum_i_point_set(): the mechanism is flat, or not. */
void baum_i_point_set_vector(baum_i_point *point, double t, const double *q, const double *v);
void baum_i_point_set_normalized(baum_i_point *point, double t, const double *q, const double *v);

/* Set t, q, v (or NULL) and the frames. The point refers to v, and to q where the mechanism is
 * flat, without a copy. */
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

/* What to evaluate of all constraint rows; NULL members are not wanted. Scleronomic joints leave
 * their rows of nu alone, which hold zeros. */
typedef struct baum_i_rows {
  double *phi;      /* (nc) */
  double *jacobian; /* (jacobian_size) */
  double *nu;       /* (nc) */
  double *gamma;    /* (nc); needs velocities */
} baum_i_rows;

/* Blocks of second derivatives of a joint, row-major over its local columns; each starts at the
 * joint's `jacobian` (rows x nl) or `square` (nl x nl) in the array given. NULL where not wanted.
 * Set, not added. */
typedef struct baum_i_joint_blocks {
  double *jw_q;    /* (J w)_q, rows x nl */
  double *jtl_q;   /* (J^T lambda)_q, nl x nl */
  double *gamma_q; /* rows x nl */
  double *gamma_v; /* rows x nl */
  double *nu_q;    /* rows x nl */
} baum_i_joint_blocks;

/* Blocks of a body, nv x nv at its `mass`. Set, not added. */
typedef struct baum_i_body_blocks {
  double *ma_q; /* (M a)_q */
  double *force_q;
  double *force_v;
} baum_i_body_blocks;

/* Blocks of a force, nl x nl at its `square`. Set, not added. */
typedef struct baum_i_force_blocks {
  double *force_q;
  double *force_v;
} baum_i_force_blocks;

/* Powers [W] by class, for the energy account of a run. */
typedef enum baum_i_power {
  BAUM_I_POWER_LOADS,
  BAUM_I_POWER_SPRINGS,
  BAUM_I_POWER_DAMPERS,
  BAUM_I_POWER_USER_FORCES,
  BAUM_I_POWER_BODIES,
  BAUM_I_POWERS
} baum_i_power;

/* Manifold of a body whose positions are not a vector: q' = N(q) v, with q (nq) and v (nv). dx has
 * velocity size. See manifold.h. */
struct baum_i_manifold {
  /* dq = N(q) v. q may be as far off the manifold as an integrator's stage. */
  void (*rate)(const baum_i_body *body, const double *q, const double *v, double *dq);
  /* Move q to where it is after the time h at constant v, to second order in h. */
  void (*move)(const baum_i_body *body, double h, const double *v, double *q);
  /* dx such that `move` with h = 1 leads from one to the other. */
  void (*difference)(const baum_i_body *body, const double *from, const double *to, double *dx);
  /* Move q to the nearest point of the manifold. */
  void (*normalize)(const baum_i_body *body, double *q);
};

struct baum_i_body_type {
  baum_i_definition definition;
  baum_i_frame_kind frame;
  bool scleronomic;                  /* mass and force of the type never depend on t */
  bool constant_force;               /* force of the type depends on parameters only */
  int nq, nv;                        /* of all of the type; 0: see size() and positions() */
  int (*size)(const void *def);      /* nv of one; or NULL */
  int (*positions)(const void *def); /* nq of one; or NULL */
  /* Of one; NULL, or returning NULL: q is a vector and v = q'. */
  const baum_i_manifold *(*manifold)(const void *def);
  bool (*constant_mass)(const void *def);       /* NULL: always */
  bool (*depends_on_velocity)(const void *def); /* force() does; NULL: never */
  /* Numbers of this body; NULL: none. */
  void (*lower)(const baum_i_body *body, double *parameters);
  /* Design pose, and given velocities or NaN. */
  void (*design)(const void *def, double *q, double *v, bool *held);
  /* (nv) relevant change of each coordinate. */
  void (*scale)(const void *def, double length, double *scale);
  /* (nq) relevant change of each position; NULL where there is no manifold. */
  void (*position_scale)(const void *def, double length, double *scale);
  /* Sets its blocks. */
  baum_status (*mass)(const baum_i_body_group *group, baum_i_point *point, double *mass);
  /* Adds to (nv). */
  baum_status (*force)(const baum_i_body_group *group, baum_i_point *point, double *force);
  /* One body: adds; NULL: 0. */
  baum_status (*potential)(const baum_i_body *body, baum_i_point *point, double *sum);
  /* One body. a (nv). The blocks are zeroed before. NULL: they stay zero. */
  baum_status (*linearize)(const baum_i_body *body, baum_i_point *point, const double *a,
                           const baum_i_body_blocks *blocks);
  /* One body: adds g^T v + v^T M' v / 2, including the power of the potential. NULL: the potential
   * gives all forces, and M' = 0. */
  baum_status (*power)(const baum_i_body *body, baum_i_point *point, double power[BAUM_I_POWERS]);
};

/* Columns of a body in the kernels of elements of the plane and of space. */
enum { BAUM_I_PLANE = 3, BAUM_I_SPACE = 6, BAUM_I_PAIR_COLUMNS = 2 * BAUM_I_SPACE };

/* A joint's coordinate for drivers and channels, over the columns of both bodies, as many as its
 * type is wide: in the plane x_a y_a angle_a x_b y_b angle_b. */
typedef struct baum_i_coordinate {
  double value;
  double rate;
  double gradient[BAUM_I_PAIR_COLUMNS];
  double gamma; /* so that gradient a = (coordinate)'' + gamma */
} baum_i_coordinate;

/* Second derivatives of a coordinate: for w and a multiplier l, as in baum_i_joint_blocks. */
typedef struct baum_i_coordinate_blocks {
  double jw_q[BAUM_I_PAIR_COLUMNS];
  double jtl_q[BAUM_I_PAIR_COLUMNS * BAUM_I_PAIR_COLUMNS];
  double gamma_q[BAUM_I_PAIR_COLUMNS];
  double gamma_v[BAUM_I_PAIR_COLUMNS];
} baum_i_coordinate_blocks;

struct baum_i_joint_type {
  baum_i_definition definition;
  int width;        /* BAUM_I_PLANE or BAUM_I_SPACE: its reaction is force and moment; 0: neither */
  bool scleronomic; /* Phi never depends on t */
  bool is_pin;      /* its rows are exactly those of pin_rows.h */
  /* One row: the coordinate of that joint minus a function of time; NULL: no driver. Its width is
   * that of the joint. */
  const baum_i_joint *(*driven)(const baum_mechanism *mechanism, const void *def);
  /* Value, rate and acceleration by the law of a driver, at the point's time; fails as phi does. */
  baum_status (*motion)(const baum_i_joint *driver, baum_i_point *point, double s[3]);
  /* Replace the law of a driver, in its numbers, by s + s' (t - t0) + s'' (t - t0)^2 / 2. NULL for
   * joints that are not drivers. */
  void (*replace_law)(double *parameters, double t0, const double s[3]);
  int row_count;                /* of all of the type; 0: see rows() */
  int (*rows)(const void *def); /* of one; or NULL */
  /* Numbers from the definition and the design configuration; BAUM_OK or BAUM_ERR_ARGUMENT with the
   * message. */
  baum_status (*lower)(const baum_mechanism *mechanism, const baum_i_joint *joint,
                       double *parameters);
  /* Sets its rows and blocks of what is wanted; baum_i_evaluate_each() calls evaluate_one(). */
  baum_status (*evaluate)(const baum_i_joint_group *group, baum_i_point *point,
                          const baum_i_rows *rows);
  baum_status (*evaluate_one)(const baum_i_joint *joint, baum_i_point *point,
                              const baum_i_rows *rows);
  /* One joint. w (nv), lambda (nc). The blocks are zeroed before. NULL: they stay zero. */
  baum_status (*linearize)(const baum_i_joint *joint, baum_i_point *point, const double *w,
                           const double *lambda, const baum_i_joint_blocks *blocks);
  /* Find the pose of one body from that of the other (body_a's if from_a; NULL: ground). NULL: the
   * type is no weld. */
  void (*weld)(const double *parameters, bool from_a, const double *known, double *q);
  /* The joint's point on body_b in ground axes, for reactions and drawing; NULL without width. */
  void (*place)(const baum_i_joint *joint, const baum_i_point *point, double at[3]);
  /* Spatial joints: add the generalized force -J^T lambda of the rows over six columns of body_b,
   * also those that a planar body or a particle does not have. */
  void (*force_on_b)(const baum_i_joint *joint, const baum_i_point *point, const double *lambda,
                     double six[BAUM_I_SPACE]);
  /* Its rows are fulfilled, but it is mounted the wrong way round; NULL: it cannot be. */
  bool (*is_reversed)(const baum_i_joint *joint, const baum_i_point *point);
  /* Include its points in the design configuration; NULL: it has none. */
  void (*extent)(const baum_mechanism *mechanism, const baum_i_joint *joint, baum_i_box *box);
  /* Only joints with a coordinate, else NULL. */
  bool is_angle; /* [rad], else [m] */
  /* Check that a joint with a checked definition has it; NULL: all have. */
  baum_status (*check_coordinate)(const baum_mechanism *mechanism, const void *def,
                                  const char *label);
  void (*coordinate)(const baum_i_joint *joint, const baum_i_point *point, baum_i_coordinate *out);
  void (*coordinate_linearize)(const baum_i_joint *joint, const baum_i_point *point,
                               const double *w, double lambda, baum_i_coordinate_blocks *out);
  /* Relative error of derivatives by differences; NULL: none are taken. */
  double (*noise)(const void *def);
};

/* The `evaluate` of types that evaluate joint by joint. */
baum_status baum_i_evaluate_each(const baum_i_joint_group *group, baum_i_point *point,
                                 const baum_i_rows *rows);

struct baum_i_force_type {
  baum_i_definition definition;
  bool spatial; /* reads spatial frames */
  baum_status (*lower)(const baum_mechanism *mechanism, const baum_i_force *force,
                       double *parameters);
  /* Adds to (nv). */
  baum_status (*force)(const baum_i_force_group *group, baum_i_point *point, double *force);
  bool (*depends_on_velocity)(const void *def); /* NULL: never */
  /* One force: adds; NULL: 0. */
  baum_status (*potential)(const baum_i_force *force, baum_i_point *point, double *sum);
  /* One force. The blocks are zeroed before. */
  baum_status (*linearize)(const baum_i_force *force, baum_i_point *point,
                           const baum_i_force_blocks *blocks);
  /* One force: adds g^T v by class, without the power of the potential; with it where
   * power_is_whole. */
  baum_status (*power)(const baum_i_force *force, baum_i_point *point, double power[BAUM_I_POWERS]);
  bool power_is_whole;
};

/* ---- the mechanism ---- */

struct baum_mechanism {
  atomic_int references;
  uint32_t tag; /* shared by copies */
  bool frozen;
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
  double *breaks; /* (break_count) [s] rising */

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
  double *design_v;               /* (nv) NaN where free */
  bool *held;                     /* (nv) */
  double *scale;                  /* (nv) relevant change of each coordinate */
  double *position_scale;         /* (nq) likewise of each position */
  int fixed_count;                /* fixed bodies without ground */
  int fixed_nv;                   /* number of their velocities */
  double *fixed_q;                /* (nq) their positions */
  baum_i_body_group *body_groups; /* each list ends with a group without a type */
  baum_i_joint_group *joint_groups;
  baum_i_force_group *force_groups;
};

#endif
