/* SPDX-License-Identifier: BSD-3-Clause */
/* One mechanism that has an element of every kind, and a table of all kinds. Tests of the interface
 * use them.
 *
 * These elements are planar:
 *
 *   a driven crank with a rod and a slider on a guide, and a tool welded to the slider
 *   a bob on a circle about the slider (user constraint)
 *   two masses in a row (user coordinates)
 *   a spring, a load, a drag (user force) and a torsion spring
 *   a disc on an axle, geared with the crank
 *   a bar on a rail, whose rack is in mesh with the disc
 *   a bead in a slot of the disc, positioned by the crank's angle (coupling)
 *   a pea on a curve of the bar
 *   a wheel on a hinge that is driven along a spline (cam)
 *
 * These elements are spatial:
 *
 *   a shaft in a bearing
 *   a yoke on a universal joint of the shaft, with a shoe (point on a plane)
 *   a ram on a slide
 *   a top in a socket of the shaft and on a table of the ram
 *   a tube in a sleeve, with a cap clamped to it
 *   a ball on a wire of the yoke and on a strut of the cap
 *   a coil (spring), a push (load), a winding and a thrust (joint spring and joint load of the
 *   sleeve)
 *   a twirl (torsion spring of the top) and a rubber (bushing of the cap)
 *
 * The last elements are a sled in the plane on a blade (knife edge), a coin that rolls (rolling
 * disc), a nut on a thread (screw), a spindle behind a constant-velocity joint of the nut, a drop
 * on a spiral (curve in space), and a skate on a runner (knife edge in space) with a rope (cable)
 * to the drop.
 *
 * The mechanism has 105 positions, 95 velocities, 72 rows and 23 degrees of freedom of velocity.
 * The planar part without the sled comes first. It has 26 positions, 26 velocities, 22 rows and 4
 * degrees of freedom. The design configuration satisfies all rows except the row of `cam`.
 */
#ifndef BAUM_TEST_EVERY_ELEMENT_H
#define BAUM_TEST_EVERY_ELEMENT_H

#include <baum/baum.h>

#include "mechanism/kinds.h"

/* The id of an element of any kind. */
typedef struct any_id {
  int32_t index1;
  uint32_t tag;
} any_id;

/* Decides which calls of the elements' functions fail on purpose, and counts the calls. If all
 * fields are zero, the functions do not fail. */
typedef struct every_fault {
  int answer;    /* return value of a failing call; if 0, the call sets NaN instead */
  bool fails;    /* whether calls fail */
  double after;  /* a call fails if t is above this */
  int64_t from;  /* if > 0, the call with this number and all later calls fail, at any t */
  int64_t calls; /* number of calls of all functions */
} every_fault;

typedef struct every_element {
  baum_mechanism *mechanism;
  baum_body_id crank;
  baum_body_id slider;
  baum_body_id tool;
  baum_body_id bob;
  baum_body_id masses;
  baum_body_id disc;
  baum_body_id bar;
  baum_body_id bead;
  baum_body_id pea;
  baum_body_id wheel;
  baum_body_id shaft;
  baum_body_id ball;
  baum_body_id yoke;
  baum_body_id ram;
  baum_body_id top;
  baum_body_id tube;
  baum_body_id cap;
  baum_body_id sled;
  baum_body_id coin;
  baum_body_id nut;
  baum_body_id spindle;
  baum_body_id drop;
  baum_body_id skate;
  baum_joint_id pin;
  baum_joint_id rod;
  baum_joint_id guide;
  baum_joint_id weld;
  baum_joint_id motor;
  baum_joint_id circle;
  baum_joint_id axle;
  baum_joint_id rail;
  baum_joint_id slot;
  baum_joint_id rack;
  baum_joint_id teeth;
  baum_joint_id lead;
  baum_joint_id track;
  baum_joint_id hinge;
  baum_joint_id cam;
  baum_joint_id bearing;
  baum_joint_id cross;
  baum_joint_id shoe;
  baum_joint_id slide;
  baum_joint_id socket;
  baum_joint_id table;
  baum_joint_id sleeve;
  baum_joint_id clamp;
  baum_joint_id wire;
  baum_joint_id strut;
  baum_joint_id blade;
  baum_joint_id rolling;
  baum_joint_id thread;
  baum_joint_id ball_cage;
  baum_joint_id spiral;
  baum_joint_id runner;
  baum_force_id spring;
  baum_force_id load;
  baum_force_id drag;
  baum_force_id twist;
  baum_force_id coil;
  baum_force_id push;
  baum_force_id winding;
  baum_force_id twirl;
  baum_force_id rubber;
  baum_force_id rope;
  baum_force_id thrust;
  /* The input of the loads `load`, `push` and `thrust`; its initial value is 1. */
  baum_input_id throttle;
  every_fault *fault;            /* the `user` of all functions; may be NULL */
  baum_body_id circle_bodies[2]; /* arrays for the definitions */
  baum_body_id drag_bodies[1];
  baum_body_id rope_bodies[3];
} every_element;

enum { EVERY_NQ = 105, EVERY_NV = 95, EVERY_NC = 72, EVERY_DEF_SIZE = 1024 };

/* The definition of an element of any kind. */
typedef union any_def {
  struct {
    size_t struct_size;
    const char *name;
  } head;
  double numbers[EVERY_DEF_SIZE / sizeof(double)];
  unsigned char bytes[EVERY_DEF_SIZE];
} any_def;

typedef enum field_type {
  FIELD_SIZE,     /* struct_size */
  FIELD_NAME,     /* text that is copied */
  FIELD_NUMBERS,  /* up to FIELD_NUMBERS_MAX doubles */
  FIELD_INTEGER,  /* int32_t, int64_t or an enum */
  FIELD_FLAG,     /* bool */
  FIELD_ID,       /* id of a body, a joint or an input */
  FIELD_FUNCTION, /* a function, or another pointer that the library does not dereference */
  FIELD_ARRAY,    /* array of doubles or ids that is copied, or NULL */
  FIELD_GAINS
} field_type;

typedef struct element_field {
  const char *name;
  size_t offset;
  size_t size;
  field_type type;
} element_field;

typedef struct element_kind {
  const char *name;  /* baum_<name>_def */
  const char *title; /* name of the kind in messages */
  const char *family;
  size_t size;
  void (*init)(any_def *def, size_t caller_size);
  baum_status (*add)(baum_mechanism *mechanism, const any_def *def, any_id *id);
  baum_status (*get)(const baum_mechanism *mechanism, any_id id, any_def *out, size_t caller_size);
  baum_status (*set)(baum_mechanism *mechanism, any_id id, const any_def *def);
  /* Sets the definition with which every_element_build() adds an element of this kind. The other
   * elements that this definition names must exist. */
  void (*good)(const every_element *parts, any_def *def);
  size_t id; /* offset of the id in every_element */
  const baum_i_definition *const *definition;
} element_kind;

/* All fields of a definition, in their order. */
enum { ELEMENT_FIELDS_MAX = 32, FIELD_NUMBERS_MAX = BAUM_I_FIELD_SIZE_MAX };
typedef struct element_fields {
  element_field list[ELEMENT_FIELDS_MAX];
  int count;
} element_fields;

element_fields element_fields_of(const element_kind *kind);

enum { ELEMENT_KINDS = 44 };
extern const element_kind element_kinds[ELEMENT_KINDS];

enum { OPTION_FIELDS = 24 };
extern const element_field option_fields[OPTION_FIELDS]; /* of baum_simulation_options */

any_id every_element_id(const every_element *parts, const element_kind *kind);

/* Builds the mechanism without freezing it. If this fails, no mechanism remains. The function reads
 * parts->fault and sets all other fields. */
baum_status every_element_build(every_element *parts);

/* Builds and freezes the mechanism. If anything fails, the test fails. */
every_element every_element_make(every_fault *fault);

/* Builds and freezes a mechanism that has only the planar part, so that nq = nv. If anything fails,
 * the test fails. */
every_element every_element_make_planar(void);

/* Tells whether an integrator supports the mechanism, which has dampers and a variable mass. */
static inline bool every_element_suits(const baum_integrator *integrator)
{
  return integrator != baum_rattle();
}

#endif
