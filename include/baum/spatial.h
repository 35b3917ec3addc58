/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Bodies and forces in space.
 *
 *  Axes are right-handed. A spatial body has seven positions: its centre of mass r in ground axes,
 *  and a unit quaternion p (Hamilton's convention, w first) that turns body axes into ground axes.
 *  It has six velocities: r' in ground axes and the angular velocity in body axes. A particle has
 *  three of each.
 *
 *  Points: joints and springs are placed as in planar.h, by `point` in ground axes, or by `point_a`
 *  and `point_b` in the axes of the bodies. Planar bodies and particles may take part in spatial
 *  joints and springs. They stay in the plane z = 0.
 *
 *  Reaction of a joint: force [N] and moment [N m] on body_b, in ground axes, about the joint's
 *  point on body_b.
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
  /** [kg m^2] about the centre of mass, body axes: xx, yy, zz, xy, xz, yz, the entries of the
   *  tensor with their sign (xy = - integral of x y dm). No principal moment is negative or above
   *  the sum of the two others. One may be 0, that of a slender rod: one below 1e-10 of the largest
   *  is raised to that. Default: (1, 1, 1, 0, 0, 0). */
  double inertia[6];
  double position[3]; /**< [m] of the centre of mass, design configuration. Default: (0, 0, 0). */
  double orientation[4]; /**< [-] unit quaternion w, x, y, z, design configuration; its length may
                          *   be off by 1e-6. Default: (1, 0, 0, 0). */
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
 *  together): stiffness (length - free_length) + damping (rate of length), or the law of the user.
 *  No force where the length is 0. */
typedef struct baum_spatial_spring_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body_a; /**< Default: none, must be set. */
  baum_body_id body_b; /**< Default: none, must be set; not body_a. */
  double point[3];     /**< [m] ground axes, design configuration. Default: NaN, not given. */
  double point_a[3];   /**< [m] on body_a, its axes. Default: NaN, not given. */
  double point_b[3];   /**< [m] on body_b, its axes. Default: NaN, not given. */
  double stiffness;    /**< [N/m] >= 0. Default: 0. */
  double damping;      /**< [N s/m] >= 0. Default: 0. */
  double free_length;  /**< [m] >= 0. Default: NaN, that of the design configuration. */
  baum_spring_fn *law; /**< Tension [N] instead of the three numbers above. Default: NULL. */
  void *user;          /**< For law. Default: NULL. */
  /** false: law does not read the rate, which rattle requires. Default: true. */
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

/** A force at a point of a body and a moment on it. With an input both are multiplied by its
 *  value. */
typedef struct baum_spatial_load_def {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "force<k>". */
  baum_body_id body;   /**< Default: none, must be set; not ground. */
  double point[3];     /**< [m] on the body, its axes. Default: (0, 0, 0). */
  double force[3];     /**< [N]. Default: (0, 0, 0). */
  double moment[3];    /**< [N m] about the point; zero on a particle. Default: (0, 0, 0). */
  baum_input_id input; /**< Default: none. */
  bool follows_body; /**< Force and moment are in body axes, else in ground axes. Default: false. */
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
