/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Bodies and forces in space.
 *
 *  Axes are right-handed. A spatial body has seven positions: its centre of mass r in ground axes,
 *  and a unit quaternion p (Hamilton's convention, w first) that rotates vectors from body axes
 *  into ground axes. It has six velocities: r' in ground axes and the angular velocity in body
 *  axes. A particle has three positions and three velocities.
 *
 *  Points: joints and springs are placed as in planar.h, by `point` in ground axes, or by `point_a`
 *  and `point_b` in the axes of the bodies. Spatial joints and springs also connect planar bodies
 *  and particles, which stay in the plane z = 0.
 *
 *  Reaction of a joint: force [N] and moment [N m] on body_b, in ground axes, about the joint's
 *  point on body_b. The reaction does not include the effort of a driver of the joint.
 */
#ifndef BAUM_SPATIAL_H
#define BAUM_SPATIAL_H

#include <baum/mechanism.h>
#include <baum/planar.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- rigid body in space --------------------------------------------------------------------- */

/** A rigid body. The origin of its axes is the centre of mass. */
typedef struct baum_spatial_body_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;        /**< [kg] > 0. Default: 1. */
  /** [kg m^2] about the centre of mass, body axes: xx, yy, zz, xy, xz, yz, with the sign of the
   *  tensor (xy = - integral of x y dm). Principal moments must be >= 0, and none may
   *  exceed the sum of the two others. One may be 0, as for a slender rod; the library raises
   *  moments below 1e-10 of the largest one to this value. Default: (1, 1, 1, 0, 0, 0). */
  double inertia[6];
  double position[3]; /**< [m] of the centre of mass, design configuration. Default: (0, 0, 0). */
  /** [-] unit quaternion w, x, y, z, design configuration; its norm may differ from 1 by 1e-6.
   *  Default: (1, 0, 0, 0). */
  double orientation[4];
  double velocity[3]; /**< [m/s] of the centre of mass at start, ground axes. Default: NaN, free. */
  double angular_velocity[3]; /**< [rad/s] at start, body axes. Default: NaN, free. */
  bool held; /**< Assembly keeps the design position and orientation. Default: false. */
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

/** A point mass. */
typedef struct baum_spatial_particle_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "body<k>". */
  double mass;        /**< [kg] > 0. Default: 1. */
  double position[3]; /**< [m] design configuration. Default: (0, 0, 0). */
  double velocity[3]; /**< [m/s] at start. Default: NaN, free. */
  bool held;          /**< Assembly keeps the design position. Default: false. */
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

/** A spring and a damper in parallel between two points. Tension (positive pulls the points
 *  together): stiffness (length - free_length) + damping (d/dt length), or a law of your own.
 *  The force is zero where the length is 0. */
typedef struct baum_spatial_spring_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; must differ from body_a. */
  /** [m] in ground axes, in the design configuration. Default: NaN, not given. */
  double point[3];
  double point_a[3];   /**< [m] on body_a, in its axes. Default: NaN, not given. */
  double point_b[3];   /**< [m] on body_b, in its axes. Default: NaN, not given. */
  double stiffness;    /**< [N/m] >= 0. Default: 0. */
  double damping;      /**< [N s/m] >= 0. Default: 0. */
  double free_length;  /**< [m] >= 0. Default: NaN, the value in the design configuration. */
  baum_spring_fn *law; /**< Tension [N]; replaces the three numbers above. Default: NULL. */
  void *user;          /**< For law. Default: NULL. */
  /** false: the law ignores the rate of the length; rattle requires this. Default: true. */
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

/* ---- load ------------------------------------------------------------------------------------ */

/** A force at a point of a body and a moment on it. The value of `input`, if set, multiplies
 *  both. */
typedef struct baum_spatial_load_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body;   /**< Default: none, must be set; must not be ground. */
  double point[3];     /**< [m] in the axes of the body. Default: (0, 0, 0). */
  double force[3];     /**< [N]. Default: (0, 0, 0). */
  double moment[3];    /**< [N m] about the point; zero on a particle. Default: (0, 0, 0). */
  baum_input_id input; /**< Default: none. */
  /** True: force and moment are in body axes. False: in ground axes. Default: false. */
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
