/* SPDX-License-Identifier: BSD-3-Clause */
/* The list of all element types, each as KIND(family, name). */
#ifndef BAUM_I_MECHANISM_KINDS_H
#define BAUM_I_MECHANISM_KINDS_H

#include "mechanism/fields.h"

/* The argument is a macro KIND(family, name), which is expanded for every type. */
#define BAUM_I_KINDS(KIND)               \
  KIND(body, planar_body)                \
  KIND(body, planar_particle)            \
  KIND(body, spatial_body)               \
  KIND(body, spatial_particle)           \
  KIND(body, coordinates)                \
  KIND(joint, planar_revolute)           \
  KIND(joint, planar_distance)           \
  KIND(joint, planar_translational)      \
  KIND(joint, planar_fixed)              \
  KIND(joint, planar_pin_in_slot)        \
  KIND(joint, planar_rack_and_pinion)    \
  KIND(joint, planar_gear)               \
  KIND(joint, planar_curve)              \
  KIND(joint, planar_knife_edge)         \
  KIND(joint, spatial_spherical)         \
  KIND(joint, spatial_revolute)          \
  KIND(joint, spatial_universal)         \
  KIND(joint, spatial_cylindrical)       \
  KIND(joint, spatial_prismatic)         \
  KIND(joint, spatial_planar)            \
  KIND(joint, spatial_fixed)             \
  KIND(joint, spatial_distance)          \
  KIND(joint, spatial_point_on_line)     \
  KIND(joint, spatial_point_on_plane)    \
  KIND(joint, spatial_curve)             \
  KIND(joint, spatial_rolling_disc)      \
  KIND(joint, spatial_knife_edge)        \
  KIND(joint, spatial_screw)             \
  KIND(joint, spatial_constant_velocity) \
  KIND(joint, coupling)                  \
  KIND(joint, driver)                    \
  KIND(joint, spline_driver)             \
  KIND(joint, user_constraint)           \
  KIND(force, planar_spring)             \
  KIND(force, planar_torsion_spring)     \
  KIND(force, planar_load)               \
  KIND(force, spatial_spring)            \
  KIND(force, spatial_cable)             \
  KIND(force, spatial_load)              \
  KIND(force, spatial_torsion_spring)    \
  KIND(force, spatial_bushing)           \
  KIND(force, joint_spring)              \
  KIND(force, joint_load)                \
  KIND(force, user_force)

#define BAUM_I_DECLARE_DEFINITION(FAMILY, NAME) \
  extern const baum_i_definition *const baum_i_##NAME##_definition;

BAUM_I_KINDS(BAUM_I_DECLARE_DEFINITION)

#endif
