/* SPDX-License-Identifier: BSD-3-Clause */
/* Contains two tables: the fields of the simulation options, and all kinds of elements with the
 * fields of their definitions. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "every_element_good.h"

/* ---- fields ---- */

#define FIELD(STRUCT, NAME, TYPE)                                            \
  {                                                                          \
#NAME, offsetof(STRUCT, NAME), sizeof(((STRUCT *)0)->NAME), FIELD_##TYPE \
  }

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
      set_##NAME, good_##NAME, offsetof(every_element, PART), &baum_i_##NAME##_definition  \
  }

BAUM_I_KINDS(KIND_FUNCTIONS)

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
  KIND(body, spatial_body, "spatial body", shaft),
  KIND(body, spatial_particle, "spatial particle", ball),
  KIND(joint, spatial_revolute, "spatial revolute joint", bearing),
  KIND(joint, spatial_universal, "spatial universal joint", cross),
  KIND(joint, spatial_point_on_plane, "spatial point on a plane", shoe),
  KIND(joint, spatial_prismatic, "spatial prismatic joint", slide),
  KIND(joint, spatial_spherical, "spatial spherical joint", socket),
  KIND(joint, spatial_planar, "spatial planar joint", table),
  KIND(joint, spatial_cylindrical, "spatial cylindrical joint", sleeve),
  KIND(joint, spatial_fixed, "spatial fixed joint", clamp),
  KIND(joint, spatial_point_on_line, "spatial point on a line", wire),
  KIND(joint, spatial_distance, "spatial distance joint", strut),
  KIND(force, spatial_spring, "spatial spring", coil),
  KIND(force, spatial_load, "spatial load", push),
  KIND(force, joint_spring, "joint spring", winding),
  KIND(joint, planar_knife_edge, "planar knife edge", blade),
  KIND(joint, spatial_rolling_disc, "spatial rolling disc", rolling),
  KIND(force, spatial_torsion_spring, "spatial torsion spring", twirl),
  KIND(force, spatial_bushing, "spatial bushing", rubber),
  KIND(joint, spatial_screw, "spatial screw", thread),
  KIND(joint, spatial_constant_velocity, "spatial constant-velocity joint", ball_cage),
  KIND(joint, spatial_curve, "spatial point on a curve", spiral),
  KIND(joint, spatial_knife_edge, "spatial knife edge", runner),
  KIND(force, spatial_cable, "spatial cable", rope),
  KIND(force, joint_load, "joint load", thrust),
};

/* ---- fields of a definition, read from the library's table ---- */

static field_type type_of(const baum_i_def_field *field)
{
  static const field_type types[] = {
    [BAUM_I_FIELD_NUMBERS] = FIELD_NUMBERS,
    [BAUM_I_FIELD_ARRAY] = FIELD_ARRAY,
    [BAUM_I_FIELD_OWN_ARRAY] = FIELD_ARRAY,
    [BAUM_I_FIELD_POINTS] = FIELD_ARRAY,
    [BAUM_I_FIELD_COUNT] = FIELD_INTEGER,
    [BAUM_I_FIELD_OPTIONAL_COUNT] = FIELD_INTEGER,
    [BAUM_I_FIELD_OWN_COUNT] = FIELD_INTEGER,
    [BAUM_I_FIELD_FLAG] = FIELD_FLAG,
    [BAUM_I_FIELD_START_FLAG] = FIELD_FLAG,
    [BAUM_I_FIELD_CLAIM] = FIELD_FLAG,
    [BAUM_I_FIELD_BODY] = FIELD_ID,
    [BAUM_I_FIELD_CARRIER] = FIELD_ID,
    [BAUM_I_FIELD_BODIES] = FIELD_ARRAY,
    [BAUM_I_FIELD_PATH] = FIELD_ARRAY,
    [BAUM_I_FIELD_JOINT] = FIELD_ID,
    [BAUM_I_FIELD_COORDINATE] = FIELD_INTEGER,
    [BAUM_I_FIELD_INPUT] = FIELD_ID,
    [BAUM_I_FIELD_FUNCTION] = FIELD_FUNCTION,
    [BAUM_I_FIELD_OPTIONAL_FUNCTION] = FIELD_FUNCTION,
    [BAUM_I_FIELD_LAW] = FIELD_FUNCTION,
    [BAUM_I_FIELD_KEPT_FUNCTION] = FIELD_FUNCTION,
    [BAUM_I_FIELD_USER] = FIELD_FUNCTION,
  };
  return types[field->kind];
}

element_fields element_fields_of(const element_kind *kind)
{
  element_fields fields = {
    .list = {FIELD(baum_i_def_head, struct_size, SIZE), FIELD(baum_i_def_head, name, NAME)},
    .count = 2};
  for (const baum_i_def_field *f = (*kind->definition)->fields; f->name; f++) {
    assert_in_range(fields.count, 2, ELEMENT_FIELDS_MAX - 1);
    fields.list[fields.count++] = (element_field){f->name, f->offset, f->size, type_of(f)};
  }
  return fields;
}

any_id every_element_id(const every_element *parts, const element_kind *kind)
{
  any_id id;
  memcpy(&id, (const char *)parts + kind->id, sizeof id);
  return id;
}
