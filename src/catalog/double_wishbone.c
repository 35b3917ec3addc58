/* SPDX-License-Identifier: BSD-3-Clause */
/* A right front wheel on two wishbones, with steering and a road. The x axis points backwards, the
 * y axis to the right and the z axis up. The wishbones rotate about skew axes on the car, which is
 * the ground. The upright connects the ball joints of the two wishbones. A tie rod of constant
 * length connects the upright to a rack. The rack moves along y, and its motion is prescribed. A
 * plate, whose motion along z is prescribed, carries the centre of the wheel.
 *
 * Closed formulas give the poses of all bodies from the angle of the lower wishbone and the
 * position of the rack. In each step of these formulas a part rotates about a known axis until one
 * of its points has a given distance from a known point. The upper wishbone rotates until the
 * distance between the ball joints of both wishbones is that of the ball joints on the upright. The
 * upright rotates about the line through both ball joints until the distance of its steering arm
 * from the rack is the length of the tie rod. Newton's method finds the angle of the lower wishbone
 * at which the wheel has the height of the plate.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "catalog/catalog.h"
#include "catalog/spatial_parts.h"

enum {
  LOWER_MASS,
  UPPER_MASS,
  UPRIGHT_MASS,
  RACK_MASS,
  PLATE_MASS,
  STIFFNESS,
  DAMPING,
  GRAVITY,
  COUNT
};
enum { LOWER, UPPER, UPRIGHT, RACK, PLATE, BODIES };
enum { ANGLE, STEER, ROAD, COLUMNS };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [LOWER_MASS] = {"lower", "kg", "mass of the lower wishbone", BAUM_I_POSITIVE},
  [UPPER_MASS] = {"upper", "kg", "mass of the upper wishbone", BAUM_I_POSITIVE},
  [UPRIGHT_MASS] = {"upright", "kg", "mass of the upright with the wheel", BAUM_I_POSITIVE},
  [RACK_MASS] = {"rack", "kg", "mass of the rack", BAUM_I_POSITIVE},
  [PLATE_MASS] = {"plate", "kg", "mass of the plate", BAUM_I_POSITIVE},
  [STIFFNESS] = {"stiffness", "N/m", "of the strut", BAUM_I_POSITIVE},
  [DAMPING] = {"damping", "N s/m", "of the strut", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
};

/* Points [m] in the design configuration. */
typedef const double point[3];
static point FRONT[2] = {{-0.15, 0.40, 0.20}, {-0.12, 0.45, 0.46}}; /* pivots of both wishbones */
static point REAR[2] = {{0.20, 0.38, 0.21}, {0.18, 0.47, 0.48}};
static point BALL[2] = {{-0.01, 0.72, 0.18}, {0.015, 0.68, 0.50}};
/* Ends of the tie rod on the rack and on the upright. */
static point TIE_ROD[2] = {{0.15, 0.36, 0.25}, {0.14, 0.70, 0.26}};
static point WHEEL = {0.0, 0.76, 0.32};
/* Ends of the strut on the ground and on the lower wishbone. */
static point STRUT[2] = {{0.02, 0.50, 0.70}, {0.0, 0.62, 0.19}};

/* Amplitude [m] and frequency [rad/s] of the rack and of the plate. */
static const double WAVE[2][2] = {{0.02, 3.0}, {0.05, 5.0}};

static int drive(int k, double t, double s[3])
{
  s[0] = WAVE[k][0] * sin(WAVE[k][1] * t);
  s[1] = WAVE[k][0] * WAVE[k][1] * cos(WAVE[k][1] * t);
  s[2] = -WAVE[k][1] * WAVE[k][1] * s[0];
  return 0;
}

static int steer(double t, double s[3], void *user)
{
  (void)user;
  return drive(0, t, s);
}

static int lift(double t, double s[3], void *user)
{
  (void)user;
  return drive(1, t, s);
}

/* ---- kinematics ---- */

/* Converts a point r from ground axes to the given axes. */
static void find_local(const baum_i_axes *axes, const double r[3], double out[3])
{
  for (int k = 0; k < 3; k++) {
    double e[3];
    baum_i_axes_direction(axes, k, e);
    out[k] = e[0] * (r[0] - axes->r[0]) + e[1] * (r[1] - axes->r[1]) + e[2] * (r[2] - axes->r[2]);
  }
}

static double distance(const double a[3], const double b[3])
{
  return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* Rotates axes about their x axis until the point `local`, which is fixed in them, has the distance
 * `length` from `target`. If a is the angle, (x, y, z) are the components of `local`, and d are the
 * coordinates of the target in the axes, then
 *
 *   (y d_y + z d_z) cos a + (y d_z - z d_y) sin a = (|local|^2 + |d|^2 - length^2) / 2 - x d_x
 *
 * Of the two solutions for a, the function uses the one that is nearer to 0. */
static void swing(baum_i_axes *axes, const double local[3], const baum_i_axes *target,
                  double length)
{
  double d[3];
  find_local(axes, target->r, d);
  double a = local[1] * d[1] + local[2] * d[2];
  double b = local[1] * d[2] - local[2] * d[1];
  double c = -0.5 * length * length - local[0] * d[0];
  for (int i = 0; i < 3; i++) {
    c += 0.5 * (local[i] * local[i] + d[i] * d[i]);
  }
  double half = acos(c / hypot(a, b));
  double angle = atan2(b, a) + (b > 0.0 ? -half : half);
  baum_i_axes_turn(axes, 0, angle, 0.0);
  baum_i_axes end = *axes;
  baum_i_axes faster = *axes;
  baum_i_axes_go(&end, local[0], local[1], local[2]);
  baum_i_axes_turn(&faster, 0, 0.0, 1.0);
  baum_i_axes_go(&faster, local[0], local[1], local[2]);
  double apart = 0.0;
  double gained = 0.0;
  for (int i = 0; i < 3; i++) {
    double between = end.r[i] - target->r[i];
    apart += between * (end.v[i] - target->v[i]);
    gained += between * (faster.v[i] - end.v[i]);
  }
  baum_i_axes_turn(axes, 0, 0.0, -apart / gained);
}

/* Returns axes at the front pivot of a wishbone. Their x axis points to the rear pivot. */
static baum_i_axes pivot_axes(int arm)
{
  const baum_i_axes front = baum_i_axes_at(FRONT[arm], baum_i_zeros);
  const baum_i_axes rear = baum_i_axes_at(REAR[arm], baum_i_zeros);
  return baum_i_axes_between(&front, &rear);
}

/* Returns axes of the upright in the design configuration. Their x axis points from the lower to
 * the upper ball joint. */
static baum_i_axes kingpin_axes(void)
{
  const baum_i_axes lower = baum_i_axes_at(BALL[0], baum_i_zeros);
  const baum_i_axes upper = baum_i_axes_at(BALL[1], baum_i_zeros);
  return baum_i_axes_between(&lower, &upper);
}

static baum_i_axes moved(baum_i_axes axes, const double local[3])
{
  baum_i_axes_go(&axes, local[0], local[1], local[2]);
  return axes;
}

/* Finds one set of axes for each body. The origins of these axes are the front pivots, the lower
 * ball joint, and the centres of rack and plate. */
static void find_axes(const double *q, const double *v, baum_i_axes axes[BODIES])
{
  double local[3];
  double arm[3];
  const baum_i_axes kingpin = kingpin_axes();
  const double rack[3] = {TIE_ROD[0][0], q[STEER], TIE_ROD[0][2]};
  const double rack_rate[3] = {0.0, v[STEER], 0.0};
  const double plate[3] = {WHEEL[0], WHEEL[1], WHEEL[2] + q[ROAD]};
  const double plate_rate[3] = {0.0, 0.0, v[ROAD]};
  axes[RACK] = baum_i_axes_at(rack, rack_rate);
  axes[PLATE] = baum_i_axes_at(plate, plate_rate);

  axes[LOWER] = pivot_axes(LOWER);
  find_local(&axes[LOWER], BALL[LOWER], local);
  baum_i_axes_turn(&axes[LOWER], 0, q[ANGLE], v[ANGLE]);
  const baum_i_axes lower = moved(axes[LOWER], local);

  axes[UPPER] = pivot_axes(UPPER);
  find_local(&axes[UPPER], BALL[UPPER], local);
  swing(&axes[UPPER], local, &lower, distance(BALL[0], BALL[1]));
  const baum_i_axes upper = moved(axes[UPPER], local);

  const double end[3] = {0.0, TIE_ROD[0][1], 0.0};
  const baum_i_axes rod = moved(axes[RACK], end);
  find_local(&kingpin, TIE_ROD[1], arm);
  axes[UPRIGHT] = baum_i_axes_between(&lower, &upper);
  swing(&axes[UPRIGHT], arm, &rod, distance(TIE_ROD[0], TIE_ROD[1]));
}

/* Computes the centre of mass of a body in the axes that find_axes() gives to this body. */
static void find_centre(int body, double out[3])
{
  memset(out, 0, 3 * sizeof *out);
  if (body == UPRIGHT) {
    const baum_i_axes kingpin = kingpin_axes();
    find_local(&kingpin, WHEEL, out);
  } else if (body <= UPPER) {
    const baum_i_axes pivot = pivot_axes(body);
    double r[3];
    for (int i = 0; i < 3; i++) {
      r[i] = (FRONT[body][i] + REAR[body][i] + BALL[body][i]) / 3;
    }
    find_local(&pivot, r, out);
  }
}

static baum_i_axes centre_axes(const double *q, const double *v, int body)
{
  baum_i_axes axes[BODIES];
  double centre[3];
  find_axes(q, v, axes);
  find_centre(body, centre);
  return moved(axes[body], centre);
}

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  (void)p;
  const baum_i_axes at = centre_axes(q, v, body);
  return baum_i_axes_state(&at);
}

static double solution(const double *p, double t, double *q, double *v)
{
  enum { MOST = 30 };
  static const double unit[COLUMNS] = {1.0, 0.0, 0.0};
  double s[3];
  (void)p;
  q[ANGLE] = v[ANGLE] = 0.0;
  for (int k = 0; k < 2; k++) {
    (void)drive(k, t, s);
    q[STEER + k] = s[0];
    v[STEER + k] = s[1];
  }
  double gain = 1.0;
  double change = 1.0;
  for (int k = 0; k < MOST && fabs(change) > 4 * DBL_EPSILON; k++) {
    const baum_i_axes wheel = centre_axes(q, unit, UPRIGHT);
    gain = wheel.v[2];
    change = (WHEEL[2] + q[ROAD] - wheel.r[2]) / gain;
    q[ANGLE] += change;
  }
  v[ANGLE] = 0.0;
  v[ANGLE] = (v[ROAD] - centre_axes(q, v, UPRIGHT).v[2]) / gain;
  return fabs(change) <= 1e-14 ? DBL_EPSILON * (10.0 + 5.0 * fabs(t)) : (double)INFINITY;
}

/* ---- elements ---- */

static void add_strut(baum_i_parts *parts, const double *p, baum_body_id arm)
{
  baum_spatial_spring_def strut = baum_spatial_spring_def_default();
  const baum_i_axes at = centre_axes(baum_i_zeros, baum_i_zeros, LOWER);
  strut.name = "strut";
  strut.body_a = BAUM_GROUND;
  strut.body_b = arm;
  memcpy(strut.point_a, STRUT[0], sizeof strut.point_a);
  find_local(&at, STRUT[1], strut.point_b);
  strut.stiffness = p[STIFFNESS];
  strut.damping = p[DAMPING];
  strut.free_length = distance(STRUT[0], STRUT[1]) + 0.1;
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_spatial_spring(parts->mechanism, &strut, NULL));
}

/* Adds the tie rod, and the contact of the wheel with the plate. */
static void add_contacts(baum_i_parts *parts, const baum_body_id *id)
{
  baum_spatial_distance_def rod = baum_spatial_distance_def_default();
  const baum_i_axes upright = centre_axes(baum_i_zeros, baum_i_zeros, UPRIGHT);
  rod.name = "tie rod";
  rod.body_a = id[RACK];
  rod.body_b = id[UPRIGHT];
  rod.point_a[0] = rod.point_a[2] = 0.0;
  rod.point_a[1] = TIE_ROD[0][1];
  find_local(&upright, TIE_ROD[1], rod.point_b);
  rod.length = distance(TIE_ROD[0], TIE_ROD[1]);
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_spatial_distance(parts->mechanism, &rod, NULL));
  baum_spatial_point_on_plane_def road = baum_spatial_point_on_plane_def_default();
  road.name = "road";
  road.body_a = id[PLATE];
  road.body_b = id[UPRIGHT];
  memcpy(road.point, WHEEL, sizeof road.point);
  BAUM_I_UNLESS_FAILED(parts,
                       baum_mechanism_add_spatial_point_on_plane(parts->mechanism, &road, NULL));
}

static void build(baum_i_parts *parts, const double *p)
{
  static const char *const names[BODIES] = {"lower", "upper", "upright", "rack", "plate"};
  static const double inertia[BODIES][3] = {
    {0.04, 0.06, 0.1}, {0.02, 0.03, 0.05}, {0.6, 0.5, 0.9}, {0.05, 0.01, 0.05}, {0.3, 0.3, 0.6}};
  static const double y[3] = {0.0, 1.0, 0.0};
  static const double z[3] = {0.0, 0.0, 1.0};
  double q[COLUMNS];
  double v[COLUMNS];
  baum_body_id id[BODIES];
  (void)solution(p, 0.0, q, v);
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  for (int k = 0; k < BODIES; k++) {
    id[k] =
      baum_i_parts_spatial_body(parts, names[k], p[LOWER_MASS + k], inertia[k], state(p, q, v, k));
  }
  for (int k = 0; k < 2; k++) {
    const baum_i_axes pivot = pivot_axes(k);
    double axis[3];
    baum_i_axes_direction(&pivot, 0, axis);
    baum_i_parts_spatial_revolute(parts, k == LOWER ? "lower pivots" : "upper pivots",
                                  (baum_i_place){BAUM_GROUND, id[k], FRONT[k], axis});
    baum_i_parts_spherical(parts, k == LOWER ? "lower ball" : "upper ball",
                           (baum_i_place){id[k], id[UPRIGHT], BALL[k], NULL});
  }
  baum_joint_id guide = baum_i_parts_prismatic(
    parts, "rack guide", (baum_i_place){BAUM_GROUND, id[RACK], TIE_ROD[0], y});
  baum_joint_id piston =
    baum_i_parts_prismatic(parts, "piston", (baum_i_place){BAUM_GROUND, id[PLATE], WHEEL, z});
  add_contacts(parts, id);
  add_strut(parts, p, id[LOWER]);
  baum_i_parts_law(parts, "steering", guide, steer);
  baum_i_parts_law(parts, "bumps", piston, lift);
}

const baum_i_catalog_mechanism baum_i_double_wishbone = {
  .name = "double_wishbone",
  .title = "wheel on two wishbones, with steering and a road",
  .source = "chosen for this catalogue",
  .provenance = "closed form, with Newton's method for the height of the wheel",
  .note = "no degrees of freedom; baum_kinematics() can simulate this mechanism, too",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", BODIES),
  .defaults = (const double[COUNT]){4.0, 3.0, 30.0, 3.0, 20.0, 4e4, 2e3, 9.81},
  .end = 2.0,
  BAUM_I_CATALOG_COMPUTED(solution, 21, COLUMNS, 13),
};
