/* SPDX-License-Identifier: BSD-3-Clause */
/* One function per axis; each takes an ordinary cell and turns one of its numbers. */
#include "axes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- ways ---- */

#define FIXED(name, integrator, formulation, order)                     \
  {                                                                     \
    name, integrator, BAUM_FORMULATION_##formulation, true, order, true \
  }
#define VARIABLE(name, integrator, formulation)                        \
  {                                                                    \
    name, integrator, BAUM_FORMULATION_##formulation, false, 0.0, true \
  }
#define SUNDIALS(name, integrator, formulation)                                      \
  {                                                                                  \
    name, integrator, BAUM_FORMULATION_##formulation, false, 0.0, BAUM_HAVE_SUNDIALS \
  }

static const way RK8 = VARIABLE("rk8", baum_rk8, PROJECTION);
static const way RK8_GAINS = VARIABLE("rk8 baumgarte", baum_rk8, BAUMGARTE);
static const way DP5 = VARIABLE("dp5", baum_dp5, PROJECTION);
static const way RK4 = FIXED("rk4", baum_rk4, PROJECTION, 4.0);
static const way RK4_GAINS = FIXED("rk4 baumgarte", baum_rk4, BAUMGARTE, 4.0);
static const way RK8_FIXED = FIXED("rk8 fixed", baum_rk8, PROJECTION, 8.0);
static const way AB4 = FIXED("ab4", baum_ab4, BAUMGARTE, 4.0);
static const way EULER = FIXED("euler", baum_euler, BAUMGARTE, 1.0);
static const way SYMPLECTIC = FIXED("semi-implicit", baum_semi_implicit_euler, BAUMGARTE, 1.0);
static const way RATTLE = FIXED("rattle", baum_rattle, INDEX3, 2.0);
static const way ALPHA = FIXED("generalized-alpha", baum_generalized_alpha, INDEX3, 2.0);
static const way KINEMATICS = VARIABLE("kinematics", baum_kinematics, DEFAULT);
static const way ADAMS = SUNDIALS("adams", baum_cvode_adams, BAUMGARTE);
static const way BDF = SUNDIALS("bdf", baum_cvode_bdf, PROJECTION);
static const way BDF_GAINS = SUNDIALS("bdf baumgarte", baum_cvode_bdf, BAUMGARTE);
static const way GGL = SUNDIALS("ida ggl", baum_ida, GGL);
static const way IDA_GAINS = SUNDIALS("ida baumgarte", baum_ida, BAUMGARTE);

/* Lists end with NULL. */
static const way *const FIXED_WAYS[] = {&RK4,        &RK8_FIXED, &AB4,   &EULER,
                                        &SYMPLECTIC, &RATTLE,    &ALPHA, NULL};
static const way *const VARIABLE_WAYS[] = {&RK8,       &RK8_GAINS, &DP5,       &ADAMS, &BDF,
                                           &BDF_GAINS, &GGL,       &IDA_GAINS, NULL};
static const way *const WAYS[] = {&RK8, &RK4, &SYMPLECTIC, &ADAMS, &BDF, &GGL, NULL};
static const way *const DRIVEN_WAYS[] = {&KINEMATICS, &RK8, &RK4, &SYMPLECTIC,
                                         &ADAMS,      &BDF, &GGL, NULL};
static const way *const GAIN_WAYS[] = {&RK4_GAINS, &AB4,       &SYMPLECTIC, &RK8_GAINS,
                                       &ADAMS,     &BDF_GAINS, &IDA_GAINS,  NULL};
static const way *const STIFF_WAYS[] = {&RK8, &RK4, &SYMPLECTIC, &ALPHA, &ADAMS, &BDF, &GGL, NULL};

/* ---- lists of cells ---- */

static void add(cell_list *list, cell c)
{
  if (list->count == list->room) {
    list->room = 2 * list->room + 64;
    cell *moved = realloc(list->cells, (size_t)list->room * sizeof *moved);
    if (!moved) {
      abort();
    }
    list->cells = moved;
  }
  list->cells[list->count++] = c;
}

static cell ordinary(const char *axis, scene_kind kind)
{
  return (cell){.axis = axis,
                .scene = scene_of(kind),
                .periods = 1.0,
                .step = 1.0 / 200,
                .rtol = 1e-7,
                .gain = (double)NAN,
                .begin = BAUM_START_ASSEMBLE,
                .most = 20000};
}

static void with_ways(cell_list *list, cell c, double value, const way *const *ways)
{
  c.value = value;
  for (; *ways; ways++) {
    if ((*ways)->built) {
      c.way = *ways;
      add(list, c);
    }
  }
}

/* ---- axes ---- */

static void sweep_step(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_BOB, SCENE_CRANK, SCENE_FOUR_BAR, SCENE_WINDOWS};
  for (int k = 0; k < 4; k++) {
    cell c = ordinary("step", KINDS[k]);
    c.most = 2000;
    for (int decade = 1; decade <= 9; decade++) {
      c.step = pow(10.0, -decade);
      with_ways(list, c, c.step, FIXED_WAYS);
    }
  }
}

static void sweep_gains(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_PENDULUM, SCENE_CRANK};
  for (int k = 0; k < 2; k++) {
    cell c = ordinary("gain", KINDS[k]);
    c.gain = 0.0;
    with_ways(list, c, c.gain, GAIN_WAYS);
    for (int decade = -6; decade <= 12; decade++) {
      c.gain = pow(10.0, decade);
      with_ways(list, c, c.gain, GAIN_WAYS);
    }
  }
}

static void sweep_tolerance(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_BOB, SCENE_CRANK, SCENE_FOUR_BAR};
  for (int k = 0; k < 3; k++) {
    cell c = ordinary("tolerance", KINDS[k]);
    for (int decade = 2; decade <= 14; decade++) {
      c.rtol = pow(10.0, -decade);
      with_ways(list, c, c.rtol, VARIABLE_WAYS);
    }
  }
}

static void sweep_mass(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_PENDULUM, SCENE_CRANK, SCENE_WINDOWS, SCENE_FOUR_BAR};
  for (int k = 0; k < 4; k++) {
    cell c = ordinary("mass ratio", KINDS[k]);
    for (int decade = -12; decade <= 12; decade += 3) {
      c.scene.ratio = pow(10.0, decade);
      with_ways(list, c, c.scene.ratio, WAYS);
    }
  }
}

static void sweep_stiffness(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_PENDULUM, SCENE_CRANK};
  for (int k = 0; k < 2; k++) {
    for (int decade = 0; decade <= 12; decade += 2) {
      cell c = ordinary("stiffness", KINDS[k]);
      c.scene.stiffness = pow(10.0, decade);
      with_ways(list, c, c.scene.stiffness, STIFF_WAYS);
      c = ordinary("damping", KINDS[k]);
      c.scene.damping = pow(10.0, decade);
      with_ways(list, c, c.scene.damping, STIFF_WAYS);
    }
  }
}

static void sweep_units(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_BOB, SCENE_CRANK};
  for (int k = 0; k < 2; k++) {
    for (int decade = -9; decade <= 9; decade += 3) {
      double unit = pow(10.0, decade);
      cell c = ordinary("length", KINDS[k]);
      c.scene.units.length = unit;
      with_ways(list, c, unit, WAYS);
      c = ordinary("mass", KINDS[k]);
      c.scene.units.mass = unit;
      with_ways(list, c, unit, WAYS);
      c = ordinary("time", KINDS[k]);
      c.scene.units.time = unit;
      with_ways(list, c, unit, WAYS);
    }
  }
}

static void sweep_speed(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_BOB, SCENE_CRANK, SCENE_FOUR_BAR};
  for (int k = 0; k < 3; k++) {
    cell c = ordinary("speed", KINDS[k]);
    c.scene.rate = 0.0;
    with_ways(list, c, 0.0, WAYS);
    for (int decade = 0; decade <= 6; decade++) {
      c.scene.rate = pow(10.0, decade);
      with_ways(list, c, c.scene.rate, WAYS);
    }
  }
}

static void sweep_start_time(cell_list *list)
{
  static const double STARTS[] = {0.0, 1e3, 1e6, 1e9, 1e12};
  for (int i = 0; i < 5; i++) {
    cell c = ordinary("start time", SCENE_BOB);
    c.scene.start = STARTS[i];
    with_ways(list, c, STARTS[i], WAYS);
    c = ordinary("start time", SCENE_CRANK);
    c.scene.start = STARTS[i];
    with_ways(list, c, STARTS[i], WAYS);
    c.axis = "start time, driven";
    c.scene.driven = true;
    with_ways(list, c, STARTS[i], DRIVEN_WAYS);
  }
}

static void sweep_violation(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_BOB, SCENE_CRANK, SCENE_FOUR_BAR};
  static const double SIZES[] = {1e-14, 1e-10, 1e-6, 1e-3, 1e-2, 0.1, 0.3};
  for (int k = 0; k < 3; k++) {
    for (int i = 0; i < 7; i++) {
      cell c = ordinary("violation", KINDS[k]);
      c.scene.violation = SIZES[i];
      with_ways(list, c, SIZES[i], WAYS);
      c.axis = "violation, exact";
      c.begin = BAUM_START_EXACT;
      with_ways(list, c, SIZES[i], WAYS);
    }
  }
}

/* Towards the flat configuration and through it, or away from it. */
static void sweep_singular(cell_list *list)
{
  for (int decade = 0; decade <= 16; decade++) {
    cell c = ordinary("singular configuration", SCENE_WINDOWS);
    c.scene.gap = decade == 16 ? 0.0 : pow(10.0, -decade);
    c.scene.angle = c.scene.gap;
    c.scene.rate = -2.0;
    c.scene.count = 1;
    with_ways(list, c, c.scene.gap, WAYS);
    c.scene.count = 4;
    with_ways(list, c, c.scene.gap, WAYS);
    c.axis = "singular rod";
    c.scene = scene_of(SCENE_CRANK);
    c.scene.gap = decade == 16 ? 0.0 : pow(10.0, -decade);
    c.scene.rod = 1.0 + c.scene.gap;
    c.scene.rate = 6.0;
    with_ways(list, c, c.scene.gap, WAYS);
  }
}

static void sweep_bodies(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_WINDOWS, SCENE_CHAIN};
  for (int k = 0; k < 2; k++) {
    for (int decade = 0; decade <= 5; decade++) {
      cell c = ordinary("bodies", KINDS[k]);
      int bodies = (int)pow(10.0, decade);
      c.scene.count = KINDS[k] == SCENE_CHAIN ? bodies : bodies / 2 + (bodies == 1);
      /* A chain of n links has rates n times that of its turning. */
      c.periods = KINDS[k] == SCENE_CHAIN ? 0.2 / bodies : decade < 4 ? 0.2 : 20.0 / bodies;
      c.step = fmin(c.step, c.periods / 4);
      with_ways(list, c, bodies, WAYS);
    }
  }
}

static void sweep_redundancy(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_BOB, SCENE_PENDULUM, SCENE_CRANK};
  static const int SPARES[] = {0, 1, 5, 20};
  static const double OFF[] = {0.0, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6};
  for (int k = 0; k < 3; k++) {
    for (int n = 0; n < 4; n++) {
      for (int i = 0; i < (n == 0 ? 1 : 6); i++) {
        cell c = ordinary("redundancy", KINDS[k]);
        c.scene.spare = SPARES[n];
        c.scene.off = OFF[i];
        c.share = 10.0 * SPARES[n] * OFF[i]; /* the mechanism itself is not known better */
        with_ways(list, c, OFF[i], WAYS);
      }
    }
  }
}

typedef struct axis {
  const char *name;
  void (*sweep)(cell_list *list);
} axis;

static const axis AXES[] = {{"step", sweep_step},           {"gain", sweep_gains},
                            {"tolerance", sweep_tolerance}, {"mass_ratio", sweep_mass},
                            {"stiffness", sweep_stiffness}, {"units", sweep_units},
                            {"speed", sweep_speed},         {"start_time", sweep_start_time},
                            {"violation", sweep_violation}, {"singular", sweep_singular},
                            {"bodies", sweep_bodies},       {"redundancy", sweep_redundancy}};

cell_list axes_cells(const char *axis_)
{
  cell_list list = {0};
  for (size_t k = 0; k < sizeof AXES / sizeof AXES[0]; k++) {
    if (!axis_ || strcmp(axis_, AXES[k].name) == 0) {
      AXES[k].sweep(&list);
    }
  }
  return list;
}

void axes_free(cell_list *list)
{
  free(list->cells);
  *list = (cell_list){0};
}
