/* SPDX-License-Identifier: BSD-3-Clause */
/* Fields of all definitions and of the options, and the table of kinds. */
#include <stddef.h>
#include <string.h>

#include "every_element_good.h"

/* ---- fields ---- */

#define FIELD(STRUCT, NAME, TYPE)                                            \
  {                                                                          \
#NAME, offsetof(STRUCT, NAME), sizeof(((STRUCT *)0)->NAME), FIELD_##TYPE \
  }

static const element_field planar_body_fields[] = {
  FIELD(baum_planar_body_def, struct_size, SIZE),
  FIELD(baum_planar_body_def, name, NAME),
  FIELD(baum_planar_body_def, mass, NUMBERS),
  FIELD(baum_planar_body_def, inertia, NUMBERS),
  FIELD(baum_planar_body_def, position, NUMBERS),
  FIELD(baum_planar_body_def, angle, NUMBERS),
  FIELD(baum_planar_body_def, velocity, NUMBERS),
  FIELD(baum_planar_body_def, angular_velocity, NUMBERS),
  FIELD(baum_planar_body_def, held, FLAG),
};

static const element_field planar_particle_fields[] = {
  FIELD(baum_planar_particle_def, struct_size, SIZE),
  FIELD(baum_planar_particle_def, name, NAME),
  FIELD(baum_planar_particle_def, mass, NUMBERS),
  FIELD(baum_planar_particle_def, position, NUMBERS),
  FIELD(baum_planar_particle_def, velocity, NUMBERS),
  FIELD(baum_planar_particle_def, held, FLAG),
};

static const element_field coordinates_fields[] = {
  FIELD(baum_coordinates_def, struct_size, SIZE),
  FIELD(baum_coordinates_def, name, NAME),
  FIELD(baum_coordinates_def, size, INTEGER),
  FIELD(baum_coordinates_def, q, ARRAY),
  FIELD(baum_coordinates_def, v, ARRAY),
  FIELD(baum_coordinates_def, scale, ARRAY),
  FIELD(baum_coordinates_def, mass, FUNCTION),
  FIELD(baum_coordinates_def, force, FUNCTION),
  FIELD(baum_coordinates_def, force_q, FUNCTION),
  FIELD(baum_coordinates_def, force_v, FUNCTION),
  FIELD(baum_coordinates_def, potential, FUNCTION),
  FIELD(baum_coordinates_def, constant_mass, FLAG),
  FIELD(baum_coordinates_def, held, FLAG),
  FIELD(baum_coordinates_def, user, FUNCTION),
  FIELD(baum_coordinates_def, depends_on_velocity, FLAG),
  FIELD(baum_coordinates_def, position_scale, ARRAY),
  FIELD(baum_coordinates_def, rate, FUNCTION),
  FIELD(baum_coordinates_def, move, FUNCTION),
  FIELD(baum_coordinates_def, difference, FUNCTION),
  FIELD(baum_coordinates_def, normalize, FUNCTION),
  FIELD(baum_coordinates_def, position_count, INTEGER),
};

static const element_field planar_revolute_fields[] = {
  FIELD(baum_planar_revolute_def, struct_size, SIZE),
  FIELD(baum_planar_revolute_def, name, NAME),
  FIELD(baum_planar_revolute_def, body_a, ID),
  FIELD(baum_planar_revolute_def, body_b, ID),
  FIELD(baum_planar_revolute_def, point, NUMBERS),
  FIELD(baum_planar_revolute_def, point_a, NUMBERS),
  FIELD(baum_planar_revolute_def, point_b, NUMBERS),
};

static const element_field planar_distance_fields[] = {
  FIELD(baum_planar_distance_def, struct_size, SIZE),
  FIELD(baum_planar_distance_def, name, NAME),
  FIELD(baum_planar_distance_def, body_a, ID),
  FIELD(baum_planar_distance_def, body_b, ID),
  FIELD(baum_planar_distance_def, point, NUMBERS),
  FIELD(baum_planar_distance_def, point_a, NUMBERS),
  FIELD(baum_planar_distance_def, point_b, NUMBERS),
  FIELD(baum_planar_distance_def, length, NUMBERS),
};

static const element_field planar_translational_fields[] = {
  FIELD(baum_planar_translational_def, struct_size, SIZE),
  FIELD(baum_planar_translational_def, name, NAME),
  FIELD(baum_planar_translational_def, body_a, ID),
  FIELD(baum_planar_translational_def, body_b, ID),
  FIELD(baum_planar_translational_def, point, NUMBERS),
  FIELD(baum_planar_translational_def, point_a, NUMBERS),
  FIELD(baum_planar_translational_def, point_b, NUMBERS),
  FIELD(baum_planar_translational_def, axis, NUMBERS),
  FIELD(baum_planar_translational_def, angle, NUMBERS),
};

static const element_field planar_fixed_fields[] = {
  FIELD(baum_planar_fixed_def, struct_size, SIZE), FIELD(baum_planar_fixed_def, name, NAME),
  FIELD(baum_planar_fixed_def, body_a, ID),        FIELD(baum_planar_fixed_def, body_b, ID),
  FIELD(baum_planar_fixed_def, point, NUMBERS),    FIELD(baum_planar_fixed_def, point_a, NUMBERS),
  FIELD(baum_planar_fixed_def, point_b, NUMBERS),  FIELD(baum_planar_fixed_def, angle, NUMBERS),
};

static const element_field driver_fields[] = {
  FIELD(baum_driver_def, struct_size, SIZE), FIELD(baum_driver_def, name, NAME),
  FIELD(baum_driver_def, joint, ID),         FIELD(baum_driver_def, value, NUMBERS),
  FIELD(baum_driver_def, rate, NUMBERS),     FIELD(baum_driver_def, acceleration, NUMBERS),
  FIELD(baum_driver_def, law, FUNCTION),     FIELD(baum_driver_def, user, FUNCTION),
};

static const element_field user_constraint_fields[] = {
  FIELD(baum_user_constraint_def, struct_size, SIZE),
  FIELD(baum_user_constraint_def, name, NAME),
  FIELD(baum_user_constraint_def, bodies, ARRAY),
  FIELD(baum_user_constraint_def, body_count, INTEGER),
  FIELD(baum_user_constraint_def, row_count, INTEGER),
  FIELD(baum_user_constraint_def, phi, FUNCTION),
  FIELD(baum_user_constraint_def, jacobian, FUNCTION),
  FIELD(baum_user_constraint_def, nu, FUNCTION),
  FIELD(baum_user_constraint_def, gamma, FUNCTION),
  FIELD(baum_user_constraint_def, user, FUNCTION),
};

static const element_field planar_spring_fields[] = {
  FIELD(baum_planar_spring_def, struct_size, SIZE),
  FIELD(baum_planar_spring_def, name, NAME),
  FIELD(baum_planar_spring_def, body_a, ID),
  FIELD(baum_planar_spring_def, body_b, ID),
  FIELD(baum_planar_spring_def, point, NUMBERS),
  FIELD(baum_planar_spring_def, point_a, NUMBERS),
  FIELD(baum_planar_spring_def, point_b, NUMBERS),
  FIELD(baum_planar_spring_def, stiffness, NUMBERS),
  FIELD(baum_planar_spring_def, damping, NUMBERS),
  FIELD(baum_planar_spring_def, free_length, NUMBERS),
  FIELD(baum_planar_spring_def, law, FUNCTION),
  FIELD(baum_planar_spring_def, user, FUNCTION),
  FIELD(baum_planar_spring_def, depends_on_velocity, FLAG),
};

static const element_field planar_load_fields[] = {
  FIELD(baum_planar_load_def, struct_size, SIZE),  FIELD(baum_planar_load_def, name, NAME),
  FIELD(baum_planar_load_def, body, ID),           FIELD(baum_planar_load_def, point, NUMBERS),
  FIELD(baum_planar_load_def, force, NUMBERS),     FIELD(baum_planar_load_def, torque, NUMBERS),
  FIELD(baum_planar_load_def, follows_body, FLAG), FIELD(baum_planar_load_def, input, ID),
};

static const element_field user_force_fields[] = {
  FIELD(baum_user_force_def, struct_size, SIZE),
  FIELD(baum_user_force_def, name, NAME),
  FIELD(baum_user_force_def, bodies, ARRAY),
  FIELD(baum_user_force_def, body_count, INTEGER),
  FIELD(baum_user_force_def, force, FUNCTION),
  FIELD(baum_user_force_def, force_q, FUNCTION),
  FIELD(baum_user_force_def, force_v, FUNCTION),
  FIELD(baum_user_force_def, potential, FUNCTION),
  FIELD(baum_user_force_def, user, FUNCTION),
  FIELD(baum_user_force_def, depends_on_velocity, FLAG),
};

static const element_field planar_torsion_spring_fields[] = {
  FIELD(baum_planar_torsion_spring_def, struct_size, SIZE),
  FIELD(baum_planar_torsion_spring_def, name, NAME),
  FIELD(baum_planar_torsion_spring_def, body_a, ID),
  FIELD(baum_planar_torsion_spring_def, body_b, ID),
  FIELD(baum_planar_torsion_spring_def, stiffness, NUMBERS),
  FIELD(baum_planar_torsion_spring_def, damping, NUMBERS),
  FIELD(baum_planar_torsion_spring_def, free_angle, NUMBERS),
  FIELD(baum_planar_torsion_spring_def, law, FUNCTION),
  FIELD(baum_planar_torsion_spring_def, user, FUNCTION),
  FIELD(baum_planar_torsion_spring_def, depends_on_velocity, FLAG),
};

static const element_field planar_pin_in_slot_fields[] = {
  FIELD(baum_planar_pin_in_slot_def, struct_size, SIZE),
  FIELD(baum_planar_pin_in_slot_def, name, NAME),
  FIELD(baum_planar_pin_in_slot_def, body_a, ID),
  FIELD(baum_planar_pin_in_slot_def, body_b, ID),
  FIELD(baum_planar_pin_in_slot_def, point, NUMBERS),
  FIELD(baum_planar_pin_in_slot_def, point_a, NUMBERS),
  FIELD(baum_planar_pin_in_slot_def, point_b, NUMBERS),
  FIELD(baum_planar_pin_in_slot_def, axis, NUMBERS),
};

static const element_field planar_rack_and_pinion_fields[] = {
  FIELD(baum_planar_rack_and_pinion_def, struct_size, SIZE),
  FIELD(baum_planar_rack_and_pinion_def, name, NAME),
  FIELD(baum_planar_rack_and_pinion_def, body_a, ID),
  FIELD(baum_planar_rack_and_pinion_def, body_b, ID),
  FIELD(baum_planar_rack_and_pinion_def, point, NUMBERS),
  FIELD(baum_planar_rack_and_pinion_def, point_a, NUMBERS),
  FIELD(baum_planar_rack_and_pinion_def, point_b, NUMBERS),
  FIELD(baum_planar_rack_and_pinion_def, axis, NUMBERS),
  FIELD(baum_planar_rack_and_pinion_def, radius, NUMBERS),
  FIELD(baum_planar_rack_and_pinion_def, offset, NUMBERS),
};

static const element_field planar_gear_fields[] = {
  FIELD(baum_planar_gear_def, struct_size, SIZE), FIELD(baum_planar_gear_def, name, NAME),
  FIELD(baum_planar_gear_def, body_a, ID),        FIELD(baum_planar_gear_def, body_b, ID),
  FIELD(baum_planar_gear_def, carrier, ID),       FIELD(baum_planar_gear_def, radius_a, NUMBERS),
  FIELD(baum_planar_gear_def, radius_b, NUMBERS), FIELD(baum_planar_gear_def, offset, NUMBERS),
};

static const element_field coupling_fields[] = {
  FIELD(baum_coupling_def, struct_size, SIZE), FIELD(baum_coupling_def, name, NAME),
  FIELD(baum_coupling_def, joint_a, ID),       FIELD(baum_coupling_def, joint_b, ID),
  FIELD(baum_coupling_def, ratio, NUMBERS),    FIELD(baum_coupling_def, offset, NUMBERS),
  FIELD(baum_coupling_def, law, FUNCTION),     FIELD(baum_coupling_def, user, FUNCTION),
};

static const element_field planar_curve_fields[] = {
  FIELD(baum_planar_curve_def, struct_size, SIZE), FIELD(baum_planar_curve_def, name, NAME),
  FIELD(baum_planar_curve_def, body_a, ID),        FIELD(baum_planar_curve_def, body_b, ID),
  FIELD(baum_planar_curve_def, point, NUMBERS),    FIELD(baum_planar_curve_def, point_a, NUMBERS),
  FIELD(baum_planar_curve_def, point_b, NUMBERS),  FIELD(baum_planar_curve_def, curve, FUNCTION),
  FIELD(baum_planar_curve_def, user, FUNCTION),
};

static const element_field spline_driver_fields[] = {
  FIELD(baum_spline_driver_def, struct_size, SIZE), FIELD(baum_spline_driver_def, name, NAME),
  FIELD(baum_spline_driver_def, joint, ID),         FIELD(baum_spline_driver_def, times, ARRAY),
  FIELD(baum_spline_driver_def, values, ARRAY),     FIELD(baum_spline_driver_def, count, INTEGER),
  FIELD(baum_spline_driver_def, periodic, FLAG),
};

const element_field option_fields[OPTION_FIELDS] = {
  FIELD(baum_simulation_options, struct_size, SIZE),
  FIELD(baum_simulation_options, integrator, FUNCTION),
  FIELD(baum_simulation_options, formulation, INTEGER),
  FIELD(baum_simulation_options, gains, GAINS),
  FIELD(baum_simulation_options, allow_unstable, FLAG),
  FIELD(baum_simulation_options, step, NUMBERS),
  FIELD(baum_simulation_options, rtol, NUMBERS),
  FIELD(baum_simulation_options, atol, NUMBERS),
  FIELD(baum_simulation_options, max_step, NUMBERS),
  FIELD(baum_simulation_options, start_time, NUMBERS),
  FIELD(baum_simulation_options, start, INTEGER),
  FIELD(baum_simulation_options, solver, INTEGER),
  FIELD(baum_simulation_options, check_derivatives, FLAG),
  FIELD(baum_simulation_options, max_steps, INTEGER),
  FIELD(baum_simulation_options, progress, FUNCTION),
  FIELD(baum_simulation_options, progress_interval, NUMBERS),
  FIELD(baum_simulation_options, user, FUNCTION),
  FIELD(baum_simulation_options, tolerance_q, NUMBERS),
  FIELD(baum_simulation_options, tolerance_v, NUMBERS),
  FIELD(baum_simulation_options, tolerance_lambda, NUMBERS),
  FIELD(baum_simulation_options, energy_account, FLAG),
  FIELD(baum_simulation_options, row_gains, FUNCTION),
  FIELD(baum_simulation_options, row_gain_count, INTEGER),
  FIELD(baum_simulation_options, error_check, FLAG),
};

/* ---- the table ---- */

#define KIND_FUNCTIONS(FAMILY, NAME)                                                       \
  static void init_##NAME(any_def *def, size_t caller_size)                                \
  {                                                                                        \
    baum_##NAME##_def_init((void *)def, caller_size);                                      \
  }                                                                                        \
  static baum_status add_##NAME(baum_mechanism *mechanism, const any_def *def, any_id *id) \
  {                                                                                        \
    baum_##FAMILY##_id found = {id ? id->index1 : 0, id ? id->tag : 0};                    \
    baum_status status =                                                                   \
      baum_mechanism_add_##NAME(mechanism, (const void *)def, id ? &found : NULL);         \
    if (id) {                                                                              \
      *id = (any_id){found.index1, found.tag};                                             \
    }                                                                                      \
    return status;                                                                         \
  }                                                                                        \
  static baum_status get_##NAME(const baum_mechanism *mechanism, any_id id, any_def *out,  \
                                size_t caller_size)                                        \
  {                                                                                        \
    baum_##FAMILY##_id typed = {id.index1, id.tag};                                        \
    return baum_mechanism_get_##NAME(mechanism, typed, (void *)out, caller_size);          \
  }                                                                                        \
  static baum_status set_##NAME(baum_mechanism *mechanism, any_id id, const any_def *def)  \
  {                                                                                        \
    baum_##FAMILY##_id typed = {id.index1, id.tag};                                        \
    return baum_mechanism_set_##NAME(mechanism, typed, (const void *)def);                 \
  }

#define KIND(FAMILY, NAME, TITLE, PART)                                                    \
  {                                                                                        \
#NAME, TITLE, #FAMILY, sizeof(baum_##NAME##_def), init_##NAME, add_##NAME, get_##NAME, \
      set_##NAME, good_##NAME, offsetof(every_element, PART), NAME##_fields,               \
      sizeof NAME##_fields / sizeof *NAME##_fields                                         \
  }

KIND_FUNCTIONS(body, planar_body)
KIND_FUNCTIONS(body, planar_particle)
KIND_FUNCTIONS(body, coordinates)
KIND_FUNCTIONS(joint, planar_revolute)
KIND_FUNCTIONS(joint, planar_distance)
KIND_FUNCTIONS(joint, planar_translational)
KIND_FUNCTIONS(joint, planar_fixed)
KIND_FUNCTIONS(joint, driver)
KIND_FUNCTIONS(joint, user_constraint)
KIND_FUNCTIONS(force, planar_spring)
KIND_FUNCTIONS(force, planar_load)
KIND_FUNCTIONS(force, user_force)
KIND_FUNCTIONS(force, planar_torsion_spring)
KIND_FUNCTIONS(joint, planar_pin_in_slot)
KIND_FUNCTIONS(joint, planar_rack_and_pinion)
KIND_FUNCTIONS(joint, planar_gear)
KIND_FUNCTIONS(joint, coupling)
KIND_FUNCTIONS(joint, planar_curve)
KIND_FUNCTIONS(joint, spline_driver)

const element_kind element_kinds[ELEMENT_KINDS] = {
  KIND(body, planar_body, "planar body", crank),
  KIND(body, planar_particle, "planar particle", bob),
  KIND(body, coordinates, "user coordinates", masses),
  KIND(joint, planar_revolute, "planar revolute joint", pin),
  KIND(joint, planar_distance, "planar distance joint", rod),
  KIND(joint, planar_translational, "planar translational joint", guide),
  KIND(joint, planar_fixed, "planar fixed joint", weld),
  KIND(joint, driver, "driver", motor),
  KIND(joint, user_constraint, "user constraint", circle),
  KIND(force, planar_spring, "planar spring", spring),
  KIND(force, planar_load, "planar load", load),
  KIND(force, user_force, "user force", drag),
  KIND(force, planar_torsion_spring, "planar torsion spring", twist),
  KIND(joint, planar_pin_in_slot, "planar pin in a slot", slot),
  KIND(joint, planar_rack_and_pinion, "planar rack and pinion", rack),
  KIND(joint, planar_gear, "planar gear", teeth),
  KIND(joint, coupling, "coupling", lead),
  KIND(joint, planar_curve, "planar point on a curve", track),
  KIND(joint, spline_driver, "spline driver", cam),
};

any_id every_element_id(const every_element *parts, const element_kind *kind)
{
  any_id id;
  memcpy(&id, (const char *)parts + kind->id, sizeof id);
  return id;
}
