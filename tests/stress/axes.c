/* SPDX-License-Identifier: BSD-3-Clause */
/* The axes of the stress grid. A cell of the grid is one run of one scene (cell.h). Most axes vary
 * one number of an ordinary cell by powers of ten. These axes are rows of the table DECADES. All
 * other axes are functions. If the name of an axis begins with "space", its cells are in space. If
 * it begins with "elements", its scenes have elements that the other scenes do not have. */
#include "axes.h"

#include <math.h>
#include <stddef.h>
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

/* Lists of ways (integrators with formulations). Each list ends with NULL. */
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

static bool begins_with(const char *axis, const char *word)
{
  return strncmp(axis, word, strlen(word)) == 0;
}

static bool is_in_space(const char *axis)
{
  return begins_with(axis, "space");
}

/* Returns a cell with ordinary numbers. If the axis is in space, the scene of the cell is a planar
 * scene in a tilted plane, or a spatial mechanism of the catalogue. */
static cell ordinary(const char *axis, scene_kind kind)
{
  const bool space = is_in_space(axis);
  cell c = {.axis = axis,
            .scene = scene_of(kind),
            .periods = 1.0,
            .step = 1.0 / 200,
            .rtol = 1e-7,
            .gain = (double)NAN,
            .begin = BAUM_START_ASSEMBLE,
            .most = space || begins_with(axis, "elements") ? 5000 : 20000};
  c.scene.tilted = space && kind <= SCENE_CHAIN;
  return c;
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

/* ---- axes that vary one number ---- */

#define KIND(NAME)    (1U << SCENE_##NAME)
#define NUMBER(FIELD) offsetof(cell, FIELD)
#define ELEMENTS                                                                          \
  (KIND(SLEIGH) | KIND(WHEEL) | KIND(DISC) | KIND(SCREW) | KIND(SHAFTS) | KIND(BUSHING) | \
   KIND(BEAD))

typedef struct decades {
  const char *name; /* name on the command line */
  const char *axis; /* name that is printed */
  size_t number;    /* offset in `cell` of the double that is varied */
  unsigned kinds;   /* set of kinds of scenes for which the axis exists */
  int from, to, by; /* the exponents of ten */
  const way *const *ways;
  bool zero;    /* whether the first value is 0 */
  int64_t most; /* largest number of steps; 0 means the limit of an ordinary cell */
} decades;

static const decades DECADES[] = {
  {"step", "step", NUMBER(step), KIND(BOB) | KIND(CRANK) | KIND(FOUR_BAR) | KIND(WINDOWS), -1, -9,
   -1, FIXED_WAYS, false, 2000},
  {"gain", "gain", NUMBER(gain), KIND(PENDULUM) | KIND(CRANK), -6, 12, 1, GAIN_WAYS, true, 0},
  {"tolerance", "tolerance", NUMBER(rtol), KIND(BOB) | KIND(CRANK) | KIND(FOUR_BAR), -2, -14, -1,
   VARIABLE_WAYS, false, 0},
  {"mass_ratio", "mass ratio", NUMBER(scene.ratio),
   KIND(PENDULUM) | KIND(CRANK) | KIND(FOUR_BAR) | KIND(WINDOWS), -12, 12, 3, WAYS, false, 0},
  {"stiffness", "stiffness", NUMBER(scene.stiffness), KIND(PENDULUM) | KIND(CRANK), 0, 12, 2,
   STIFF_WAYS, false, 0},
  {"stiffness", "damping", NUMBER(scene.damping), KIND(PENDULUM) | KIND(CRANK), 0, 12, 2,
   STIFF_WAYS, false, 0},
  {"units", "length", NUMBER(scene.units.length), KIND(BOB) | KIND(CRANK), -9, 9, 3, WAYS, false,
   0},
  {"units", "mass", NUMBER(scene.units.mass), KIND(BOB) | KIND(CRANK), -9, 9, 3, WAYS, false, 0},
  {"units", "time", NUMBER(scene.units.time), KIND(BOB) | KIND(CRANK), -9, 9, 3, WAYS, false, 0},
  {"speed", "speed", NUMBER(scene.rate), KIND(BOB) | KIND(CRANK) | KIND(FOUR_BAR), 0, 6, 1, WAYS,
   true, 0},
  {"space_step", "space: step", NUMBER(step),
   KIND(CRANK) | KIND(FOUR_BAR) | KIND(SPATIAL_CRANK) | KIND(BRICARD) | KIND(TOP), -1, -7, -1,
   FIXED_WAYS, false, 1000},
  {"space_tolerance", "space: tolerance", NUMBER(rtol),
   KIND(FOUR_BAR) | KIND(SPATIAL_CRANK) | KIND(BRICARD) | KIND(TOP), -2, -14, -2, VARIABLE_WAYS,
   false, 0},
  {"space_gain", "space: gain", NUMBER(gain), KIND(CRANK) | KIND(SPATIAL_CRANK), -6, 12, 3,
   GAIN_WAYS, true, 0},
  {"space_mass_ratio", "space: mass ratio", NUMBER(scene.ratio),
   KIND(CRANK) | KIND(WINDOWS) | KIND(SPATIAL_CRANK) | KIND(RSSR), -12, 12, 3, WAYS, false, 0},
  /* For Bricard's mechanism, `ratio` is the ratio of a rod's moments of inertia, which is at most
   * 2. */
  {"space_mass_ratio", "space: mass ratio", NUMBER(scene.ratio), KIND(BRICARD), -12, 0, 3, WAYS,
   false, 0},
  {"space_stiffness", "space: stiffness", NUMBER(scene.stiffness), KIND(SPATIAL_CRANK), 0, 12, 2,
   STIFF_WAYS, false, 0},
  {"space_stiffness", "space: damping", NUMBER(scene.damping), KIND(SPATIAL_CRANK), 0, 12, 2,
   STIFF_WAYS, false, 0},
  {"space_units", "space: length", NUMBER(scene.units.length),
   KIND(CRANK) | KIND(SPATIAL_CRANK) | KIND(TOP), -6, 6, 3, WAYS, false, 0},
  {"space_units", "space: mass", NUMBER(scene.units.mass),
   KIND(CRANK) | KIND(SPATIAL_CRANK) | KIND(TOP), -6, 6, 3, WAYS, false, 0},
  {"space_units", "space: time", NUMBER(scene.units.time),
   KIND(CRANK) | KIND(SPATIAL_CRANK) | KIND(TOP), -6, 6, 3, WAYS, false, 0},
  {"space_speed", "space: speed", NUMBER(scene.rate), KIND(FOUR_BAR) | KIND(SPATIAL_CRANK), 0, 6, 1,
   WAYS, false, 0},
  {"space_speed", "space: speed", NUMBER(scene.rate), KIND(RSSR), 0, 6, 1, DRIVEN_WAYS, false, 0},
  /* If the top were slower, it would not precess steadily. */
  {"space_speed", "space: speed", NUMBER(scene.rate), KIND(TOP), 2, 6, 1, WAYS, false, 0},
  {"elements_step", "elements: step", NUMBER(step), ELEMENTS, -1, -7, -1, FIXED_WAYS, false, 1000},
  {"elements_tolerance", "elements: tolerance", NUMBER(rtol), ELEMENTS, -2, -14, -2, VARIABLE_WAYS,
   false, 0},
  {"elements_gain", "elements: gain", NUMBER(gain), KIND(SLEIGH) | KIND(WHEEL) | KIND(DISC), -6, 12,
   3, GAIN_WAYS, true, 0},
  {"elements_mass_ratio", "elements: mass ratio", NUMBER(scene.ratio),
   KIND(SLEIGH) | KIND(WHEEL) | KIND(SCREW) | KIND(SHAFTS) | KIND(BUSHING), -12, 12, 3, WAYS, false,
   0},
  {"elements_stiffness", "elements: stiffness", NUMBER(scene.stiffness), KIND(BUSHING), 0, 12, 2,
   STIFF_WAYS, false, 0},
  {"elements_stiffness", "elements: damping", NUMBER(scene.damping), KIND(BUSHING), 0, 12, 2,
   STIFF_WAYS, false, 0},
  {"elements_units", "elements: length", NUMBER(scene.units.length),
   KIND(WHEEL) | KIND(DISC) | KIND(SCREW) | KIND(SHAFTS), -6, 6, 3, WAYS, false, 0},
  {"elements_units", "elements: time", NUMBER(scene.units.time),
   KIND(WHEEL) | KIND(DISC) | KIND(SCREW) | KIND(SHAFTS), -6, 6, 3, WAYS, false, 0},
  {"elements_speed", "elements: speed", NUMBER(scene.rate),
   KIND(WHEEL) | KIND(SCREW) | KIND(SHAFTS), 0, 6, 1, WAYS, false, 0},
  /* A slower disc would not roll steadily. A faster one would roll on a circle larger than 1e7
   * m. */
  {"elements_speed", "elements: speed", NUMBER(scene.rate), KIND(DISC), 1, 4, 1, WAYS, false, 0},
};

static void vary(cell_list *list, const decades *d, cell c, double value)
{
  memcpy((char *)&c + d->number, &value, sizeof value);
  c.most = d->most ? d->most : c.most;
  with_ways(list, c, value, d->ways);
}

static void sweep_decades(cell_list *list, const decades *d)
{
  for (unsigned kind = 0; kind < SCENE_KINDS; kind++) {
    if (d->kinds >> kind & 1U) {
      const cell c = ordinary(d->axis, (scene_kind)kind);
      if (d->zero) {
        vary(list, d, c, 0.0);
      }
      for (int decade = d->from; d->by * (d->to - decade) >= 0; decade += d->by) {
        vary(list, d, c, pow(10.0, decade));
      }
    }
  }
}

/* ---- other axes ---- */

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

static void sweep_violation(cell_list *list, const char *axis, const char *exact, scene_kind kind)
{
  static const double SIZES[] = {1e-14, 1e-10, 1e-6, 1e-3, 1e-2, 0.1, 0.3};
  for (int i = 0; i < 7; i++) {
    cell c = ordinary(axis, kind);
    c.scene.violation = SIZES[i];
    with_ways(list, c, SIZES[i], WAYS);
    c.axis = exact;
    c.begin = BAUM_START_EXACT;
    with_ways(list, c, SIZES[i], WAYS);
  }
}

static void sweep_planar_violation(cell_list *list)
{
  sweep_violation(list, "violation", "violation, exact", SCENE_BOB);
  sweep_violation(list, "violation", "violation, exact", SCENE_CRANK);
  sweep_violation(list, "violation", "violation, exact", SCENE_FOUR_BAR);
}

static void sweep_space_violation(cell_list *list)
{
  sweep_violation(list, "space: violation", "space: violation, exact", SCENE_CRANK);
  sweep_violation(list, "space: violation", "space: violation, exact", SCENE_FOUR_BAR);
}

/* An N-four-bar starts at a distance of `gap` [rad] from a singular configuration, and moves
 * through it. For the slider-crank, `gap` [m] is the length of the rod minus the length of the
 * crank. */
static void sweep_singular(cell_list *list, const char *axis, const char *rod, int by)
{
  for (int decade = 0; decade <= 16; decade += by) {
    cell c = ordinary(axis, SCENE_WINDOWS);
    c.scene.gap = decade == 16 ? 0.0 : pow(10.0, -decade);
    c.scene.angle = c.scene.gap;
    c.scene.rate = -2.0;
    c.scene.count = 1;
    with_ways(list, c, c.scene.gap, WAYS);
    c.scene.count = 4;
    with_ways(list, c, c.scene.gap, WAYS);
    c = ordinary(rod, SCENE_CRANK);
    c.scene.gap = decade == 16 ? 0.0 : pow(10.0, -decade);
    c.scene.rod = 1.0 + c.scene.gap;
    c.scene.rate = 6.0;
    with_ways(list, c, c.scene.gap, WAYS);
  }
}

static void sweep_planar_singular(cell_list *list)
{
  sweep_singular(list, "singular configuration", "singular rod", 1);
}

static void sweep_space_singular(cell_list *list)
{
  sweep_singular(list, "space: singular configuration", "space: singular rod", 2);
}

static void sweep_bodies(cell_list *list)
{
  static const scene_kind KINDS[] = {SCENE_WINDOWS, SCENE_CHAIN};
  for (int k = 0; k < 2; k++) {
    for (int decade = 0; decade <= 5; decade++) {
      cell c = ordinary("bodies", KINDS[k]);
      int bodies = (int)pow(10.0, decade);
      c.scene.count = KINDS[k] == SCENE_CHAIN ? bodies : bodies / 2 + (bodies == 1);
      /* In a chain of n links, the fastest rate is n times the angular velocity. */
      c.periods = KINDS[k] == SCENE_CHAIN ? 0.2 / bodies : decade < 4 ? 0.2 : 20.0 / bodies;
      c.step = fmin(c.step, c.periods / 4);
      with_ways(list, c, bodies, WAYS);
    }
  }
}

/* Adds cells with redundant joints. To save time, the axes "space" and "elements" skip every second
 * value of OFF and the largest value of SPARES. */
static void sweep_redundancy(cell_list *list, const char *axis, scene_kind kind)
{
  static const int SPARES[] = {0, 1, 5, 20};
  static const double OFF[] = {0.0, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6};
  const bool space = is_in_space(axis) || begins_with(axis, "elements");
  for (int n = 0; n < (space ? 3 : 4); n++) {
    for (int i = 0; i < (n == 0 ? 1 : 6); i += space && i > 0 ? 2 : 1) {
      cell c = ordinary(axis, kind);
      c.scene.spare = SPARES[n];
      c.scene.off = OFF[i];
      /* This error is permitted, because redundant joints are displaced by OFF[i] from the
       * others. */
      c.share = 10.0 * SPARES[n] * OFF[i];
      with_ways(list, c, OFF[i], WAYS);
    }
  }
}

static void sweep_planar_redundancy(cell_list *list)
{
  sweep_redundancy(list, "redundancy", SCENE_BOB);
  sweep_redundancy(list, "redundancy", SCENE_PENDULUM);
  sweep_redundancy(list, "redundancy", SCENE_CRANK);
}

static void sweep_space_redundancy(cell_list *list)
{
  sweep_redundancy(list, "space: redundancy", SCENE_PENDULUM);
  sweep_redundancy(list, "space: redundancy", SCENE_CRANK);
}

static void sweep_elements_redundancy(cell_list *list)
{
  sweep_redundancy(list, "elements: redundancy", SCENE_SLEIGH);
  sweep_redundancy(list, "elements: redundancy", SCENE_WHEEL);
  sweep_redundancy(list, "elements: redundancy", SCENE_SCREW);
  sweep_redundancy(list, "elements: redundancy", SCENE_SHAFTS);
}

static const struct {
  const char *name;
  void (*sweep)(cell_list *list);
} OTHERS[] = {
  {"start_time", sweep_start_time},
  {"violation", sweep_planar_violation},
  {"singular", sweep_planar_singular},
  {"bodies", sweep_bodies},
  {"redundancy", sweep_planar_redundancy},
  {"space_violation", sweep_space_violation},
  {"space_singular", sweep_space_singular},
  {"space_redundancy", sweep_space_redundancy},
  {"elements_redundancy", sweep_elements_redundancy},
};

/* ---- all ---- */

static bool begins(const char *name, const char *with)
{
  return !with || strncmp(with, name, strlen(with)) == 0;
}

cell_list axes_cells(const char *axis)
{
  cell_list list = {0};
  for (size_t k = 0; k < sizeof DECADES / sizeof DECADES[0]; k++) {
    if (begins(DECADES[k].name, axis)) {
      sweep_decades(&list, &DECADES[k]);
    }
  }
  for (size_t k = 0; k < sizeof OTHERS / sizeof OTHERS[0]; k++) {
    if (begins(OTHERS[k].name, axis)) {
      OTHERS[k].sweep(&list);
    }
  }
  return list;
}

void axes_free(cell_list *list)
{
  free(list->cells);
  *list = (cell_list){0};
}
