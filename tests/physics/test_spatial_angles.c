/* SPDX-License-Identifier: BSD-3-Clause */
/* The angle of a spatial joint must count revolutions, even in a restored run. A driver must be
 * able to prescribe it over many revolutions. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "base/rotation.h"
#include "check.h"
#include "construct.h"
#include "runs.h"

static const double RATE = 40.0;

/* Makes a rotor with an oblique axis. If `driven` is true, a driver moves it. */
static baum_mechanism *make(bool driven, baum_joint_id *bearing)
{
  baum_body_id rotor;
  baum_spatial_body_def body = baum_spatial_body_def_default();
  baum_spatial_revolute_def joint = baum_spatial_revolute_def_default();
  const double axis[3] = {1.0, 2.0, 2.0};
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  if (!driven) {
    for (int i = 0; i < 3; i++) {
      body.angular_velocity[i] = RATE * axis[i] / 3.0;
    }
  }
  check(baum_mechanism_add_spatial_body(m, &body, &rotor));
  joint.body_a = BAUM_GROUND;
  joint.body_b = rotor;
  memset(joint.point, 0, sizeof joint.point);
  memcpy(joint.axis, axis, sizeof axis);
  check(baum_mechanism_add_spatial_revolute(m, &joint, bearing));
  if (driven) {
    baum_driver_def motor = baum_driver_def_default();
    motor.joint = *bearing;
    motor.rate = RATE;
    check(baum_mechanism_add_driver(m, &motor, NULL));
  }
  check(baum_mechanism_freeze(m));
  return m;
}

static baum_simulation *start(const baum_mechanism *m, const baum_integrator *integrator)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  if (integrator == baum_rk4() || integrator == baum_generalized_alpha()) {
    o.step = integrator == baum_rk4() ? 0.01 : 0.002;
  } else if (integrator != baum_kinematics()) {
    o.rtol = 1e-7;
  }
  return create_run(m, &o);
}

/* [N m/rad] Stiffness of a torsion spring. The rotor winds it up by up to 20 rad. */
static const double STIFFNESS = 4.0;

/* The spring of the rotor is either a joint spring, or a torsion spring between the rotor and
 * ground. */
typedef enum winding { OF_JOINT, OF_BODIES, WINDINGS } winding;

static void add_torsion_spring(baum_mechanism *m, double damping)
{
  const double axis[3] = {1.0, 2.0, 2.0};
  baum_spatial_torsion_spring_def spring = baum_spatial_torsion_spring_def_default();
  spring.body_a = BAUM_GROUND;
  spring.body_b = baum_mechanism_body_at(m, 0);
  memset(spring.point, 0, sizeof spring.point);
  memcpy(spring.axis, axis, sizeof axis);
  spring.stiffness = STIFFNESS;
  spring.damping = damping;
  check(baum_mechanism_add_spatial_torsion_spring(m, &spring, NULL));
}

static baum_mechanism *make_wound(winding which, double damping, baum_joint_id *bearing)
{
  baum_mechanism *free_rotor = make(false, bearing);
  baum_mechanism *m = NULL;
  baum_joint_spring_def spring = baum_joint_spring_def_default();
  check(baum_mechanism_copy(free_rotor, &m));
  baum_mechanism_destroy(free_rotor);
  spring.joint = *bearing;
  spring.coordinate = BAUM_COORDINATE_ANGLE;
  spring.stiffness = STIFFNESS;
  spring.damping = damping;
  if (which == OF_JOINT) {
    check(baum_mechanism_add_joint_spring(m, &spring, NULL));
  } else {
    add_torsion_spring(m, damping);
  }
  check(baum_mechanism_freeze(m));
  return m;
}

static double angle_of(baum_simulation *run, baum_joint_id joint)
{
  double out[2];
  const baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, joint);
  check(baum_simulation_get(run, &channel, 1, out));
  return out[0];
}

static void angles_count_revolutions(void **state)
{
  (void)state;
  const baum_integrator *methods[] = {
    baum_rk4(),
    baum_rk8(),
#if BAUM_HAVE_SUNDIALS
    baum_cvode_bdf(),
    baum_ida(),
#endif
  };
  for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
    baum_joint_id bearing;
    baum_mechanism *m = make(false, &bearing);
    baum_simulation *run = start(m, methods[k]);
    for (int i = 1; i <= 10; i++) {
      check(baum_simulation_advance_to(run, 0.5 * i));
      assert_true(fabs(angle_of(run, bearing) - 0.5 * i * RATE) < 1e-2);
    }
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

static void a_restored_run_continues_to_count_revolutions(void **state)
{
  (void)state;
  baum_joint_id bearing;
  baum_mechanism *m = make(false, &bearing);
  baum_simulation *run = start(m, baum_rk4());
  baum_simulation *other = start(m, baum_rk4());
  static unsigned char buffer[1 << 16];
  size_t size = 0;
  check(baum_simulation_advance_to(run, 2.0));
  check(baum_simulation_save(run, buffer, sizeof buffer, &size));
  check(baum_simulation_restore(other, buffer, size));
  check(baum_simulation_advance_to(run, 3.0));
  check(baum_simulation_advance_to(other, 3.0));
  assert_true(angle_of(run, bearing) == angle_of(other, bearing));
  assert_true(fabs(angle_of(other, bearing) - 3.0 * RATE) < 1e-2);
  baum_simulation_destroy(run);
  baum_simulation_destroy(other);
  baum_mechanism_destroy(m);
}

static void a_continued_run_continues_to_count_revolutions(void **state)
{
  (void)state;
  baum_joint_id bearing;
  baum_mechanism *m = make(false, &bearing);
  baum_simulation *run = start(m, baum_rk4());
  baum_simulation *other = start(m, baum_rk8());
  check(baum_simulation_advance_to(run, 2.0));
  check(baum_simulation_continue(other, run));
  assert_true(fabs(angle_of(other, bearing) - angle_of(run, bearing)) < 1e-9);
  check(baum_simulation_advance_to(other, 3.0));
  assert_true(fabs(angle_of(other, bearing) - 3.0 * RATE) < 1e-2);
  baum_simulation_destroy(run);
  baum_simulation_destroy(other);
  baum_mechanism_destroy(m);
}

/* During steps, the run updates its count of revolutions only every tenth of a radian. If a state
 * 3.1 rad ahead is set, its revolutions must nevertheless be counted from the present angle of the
 * run. */
static void revolutions_of_a_set_state_are_counted_from_the_present_angle(void **state)
{
  (void)state;
  static const double AHEAD = 3.1; /* [rad] */
  baum_joint_id bearing;
  baum_mechanism *m = make(false, &bearing);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3 / RATE;
  for (int k = 0; k < 6; k++) {
    double from = (0.5 + 0.017 * k) / RATE;
    baum_simulation *run = create_run(m, &o);
    baum_simulation *ahead = create_run(m, &o);
    check(baum_simulation_advance_to(run, from));
    check(baum_simulation_advance_to(ahead, from + AHEAD / RATE));
    check(baum_simulation_set_state(run, from, baum_simulation_q(ahead), baum_simulation_v(ahead)));
    assert_true(fabs(angle_of(run, bearing) - from * RATE - AHEAD) < 1e-6);
    baum_simulation_destroy(run);
    baum_simulation_destroy(ahead);
  }
  baum_mechanism_destroy(m);
}

static void a_driver_prescribes_many_revolutions(void **state)
{
  (void)state;
  baum_joint_id bearing;
  baum_mechanism *m = make(true, &bearing);
  baum_simulation *run = start(m, baum_kinematics());
  check(baum_simulation_advance_to(run, 5.0));
  assert_true(fabs(angle_of(run, bearing) - 5.0 * RATE) < 1e-9);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* Returns the exact angle at time t. The moment of inertia of the rotor is 1 kg m^2. */
static double wound_angle(double t, double damping)
{
  double decay = 0.5 * damping;
  double frequency = sqrt(STIFFNESS - decay * decay);
  return RATE / frequency * exp(-decay * t) * sin(frequency * t);
}

static void springs_wind_up_over_revolutions(void **state)
{
  (void)state;
  const baum_integrator *methods[] = {
    baum_rk4(),
    baum_rk8(),
    baum_generalized_alpha(),
#if BAUM_HAVE_SUNDIALS
    baum_cvode_bdf(),
    baum_ida(),
#endif
  };
  for (size_t k = 0; k < 4 * sizeof methods / sizeof *methods; k++) {
    baum_joint_id bearing;
    double damping = k % 2 == 0 ? 0.0 : 0.5;
    baum_mechanism *m = make_wound(k / 2 % 2 == 0 ? OF_JOINT : OF_BODIES, damping, &bearing);
    baum_simulation *run = start(m, methods[k / 4]);
    double largest = 0.0;
    for (int i = 1; i <= 20; i++) {
      double want = wound_angle(0.25 * i, damping);
      check(baum_simulation_advance_to(run, 0.25 * i));
      assert_true(fabs(angle_of(run, bearing) - want) < 1e-2);
      largest = fmax(largest, fabs(want));
    }
    assert_true(largest > 10.0);
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

/* The potential energy of the spring and the work of the damper must use the angle that includes
 * revolutions. This must also hold in the energy account, and in the companion, which is the second
 * integration that estimates the error. */
static void check_energies(winding which)
{
  baum_joint_id bearing;
  baum_mechanism *m = make_wound(which, 0.5, &bearing);
  baum_simulation_options o = baum_simulation_options_default();
  baum_energy_account account;
  double energy[2];
  o.integrator = baum_rk4();
  o.step = 0.01;
  o.energy_account = true;
  o.error_check = true;
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, 0.8));
  double angle = angle_of(run, bearing);
  assert_true(angle > 10.0);
  const baum_channel channel = baum_channel_of(BAUM_ENERGY);
  check(baum_simulation_get(run, &channel, 1, energy));
  assert_true(fabs(energy[1] - 0.5 * STIFFNESS * angle * angle) < 1e-9 * energy[1]);
  check(baum_simulation_advance_to(run, 5.0));
  check(baum_simulation_energy_account(run, &account, sizeof account));
  assert_true(account.dampers < -0.9 * 0.5 * RATE * RATE);
  assert_true(fabs(account.residual) < 1e-5 * 0.5 * RATE * RATE); /* the error of rk4 */
  baum_counters counters = counters_of(run);
  assert_true(counters.error_estimate < 1e-3);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void energies_include_the_revolutions_of_the_spring(void **state)
{
  (void)state;
  for (int k = 0; k < WINDINGS; k++) {
    check_energies((winding)k);
  }
}

/* A saved run must contain the revolutions of a wound spring, so that a restored run continues with
 * them. */
static void a_restored_spring_stays_wound(void **state)
{
  (void)state;
  static unsigned char buffer[1 << 16];
  for (int k = 0; k < WINDINGS; k++) {
    baum_joint_id bearing;
    baum_mechanism *m = make_wound((winding)k, 0.0, &bearing);
    baum_simulation *runs[2] = {start(m, baum_rk4()), start(m, baum_rk4())};
    size_t size = 0;
    check(baum_simulation_advance_to(runs[0], 0.5));
    assert_true(angle_of(runs[0], bearing) > 10.0);
    check(baum_simulation_save(runs[0], buffer, sizeof buffer, &size));
    check(baum_simulation_restore(runs[1], buffer, size));
    for (int i = 0; i < 2; i++) {
      check(baum_simulation_advance_to(runs[i], 1.0));
      assert_true(fabs(angle_of(runs[i], bearing) - wound_angle(1.0, 0.0)) < 1e-2);
    }
    assert_true(angle_of(runs[0], bearing) == angle_of(runs[1], bearing));
    baum_simulation_destroy(runs[0]);
    baum_simulation_destroy(runs[1]);
    baum_mechanism_destroy(m);
  }
}

/* A state determines angles only up to whole revolutions. When a state is set, an angle gets the
 * number of revolutions that brings it closest to its last value. A state that is refused must
 * change nothing. */
static void check_set_state(winding which)
{
  baum_joint_id bearing;
  baum_mechanism *m = make_wound(which, 0.0, &bearing);
  baum_simulation *runs[2] = {start(m, baum_rk4()), start(m, baum_rk4())};
  double q[7];
  double v[6];
  for (int k = 0; k < 2; k++) {
    check(baum_simulation_advance_to(runs[k], 0.5));
  }
  memcpy(q, baum_simulation_q(runs[0]), sizeof q);
  memcpy(v, baum_simulation_v(runs[0]), sizeof v);
  check(baum_simulation_set_state(runs[0], 7.5, q, v));
  v[0] = (double)INFINITY;
  assert_int_equal(baum_simulation_set_state(runs[1], 7.5, q, v), BAUM_ERR_ARGUMENT);
  check(baum_simulation_advance_to(runs[0], 8.0));
  check(baum_simulation_advance_to(runs[1], 1.0));
  assert_true(fabs(angle_of(runs[0], bearing) - wound_angle(1.0, 0.0)) < 1e-2);
  assert_true(fabs(angle_of(runs[1], bearing) - wound_angle(1.0, 0.0)) < 1e-2);
  baum_simulation_destroy(runs[0]);
  baum_simulation_destroy(runs[1]);
  baum_mechanism_destroy(m);
}

static void a_state_that_is_set_stays_wound(void **state)
{
  (void)state;
  for (int k = 0; k < WINDINGS; k++) {
    check_set_state((winding)k);
  }
}

/* A new run does not know that the spring of another run is wound, until it is given the angle. */
static void a_run_uses_the_revolutions_that_it_is_given(void **state)
{
  (void)state;
  baum_joint_id bearing;
  baum_mechanism *m = make_wound(OF_JOINT, 0.0, &bearing);
  baum_simulation *from = start(m, baum_rk8());
  baum_simulation *run = start(m, baum_rk8());
  check(baum_simulation_advance_to(from, 0.5));
  const double angle = angle_of(from, bearing);
  assert_true(angle > 10.0);
  check(baum_simulation_set_state(run, 0.5, baum_simulation_q(from), baum_simulation_v(from)));
  assert_true(fabs(angle_of(run, bearing)) <= 3.2);
  check(baum_simulation_set_angle(run, bearing, BAUM_COORDINATE_ANGLE, angle + 1.0));
  assert_true(fabs(angle_of(run, bearing) - angle) < 1e-12);
  assert_int_equal(baum_simulation_set_angle(run, bearing, BAUM_COORDINATE_DISPLACEMENT, 0.0),
                   BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_set_angle(run, bearing, BAUM_COORDINATE_ANGLE, (double)NAN),
                   BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_simulation_message(run), "angle is nan rad, must be finite"));
  assert_true(fabs(counters_of(run).energy_change) < 1e-9 * RATE * RATE);
  check(baum_simulation_advance_to(run, 1.0));
  assert_true(fabs(angle_of(run, bearing) - wound_angle(1.0, 0.0)) < 1e-4);
  assert_true(fabs(counters_of(run).energy_change) < 1e-6 * RATE * RATE);
  baum_simulation_destroy(from);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* A driven angle has the revolutions of its driver at the start of a run, and at another time to
 * which the run is set. A refused state changes nothing, and a state at the present time keeps
 * revolutions that the user has chosen. */
static void check_driven(double value, double start_time)
{
  baum_joint_id bearing;
  baum_mechanism *wound = make_wound(OF_JOINT, 0.0, &bearing);
  baum_mechanism *m = NULL;
  baum_driver_def motor = baum_driver_def_default();
  baum_simulation_options o = baum_simulation_options_default();
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  const double later = start_time + 10.0 * BAUM_I_REVOLUTION / RATE;
  double out[2];
  check(baum_mechanism_copy(wound, &m));
  motor.joint = bearing;
  motor.value = value;
  motor.rate = RATE;
  check(baum_mechanism_add_driver(m, &motor, NULL));
  check(baum_mechanism_freeze(m));
  o.integrator = baum_kinematics();
  o.start_time = start_time;
  baum_simulation *run = create_run(m, &o);
  double want = value + RATE * start_time;
  assert_true(fabs(angle_of(run, bearing) - want) < 1e-9);
  check(baum_simulation_get(run, &energy, 1, out));
  assert_true(fabs(out[1] - 0.5 * STIFFNESS * want * want) < 1e-9 * fmax(out[1], 1.0));
  const double *q = baum_simulation_q(run);
  const double *v = baum_simulation_v(run);
  double still[6] = {0.0}; /* the driver demands another velocity */
  assert_int_equal(baum_simulation_set_state(run, later, q, still), BAUM_ERR_INCONSISTENT);
  assert_true(fabs(angle_of(run, bearing) - want) < 1e-9);
  check(baum_simulation_set_state(run, later, q, v));
  want = value + RATE * later;
  assert_true(fabs(angle_of(run, bearing) - want) < 1e-9);
  check(baum_simulation_set_angle(run, bearing, BAUM_COORDINATE_FIRST, want + BAUM_I_REVOLUTION));
  check(baum_simulation_set_state(run, later, q, v));
  assert_true(fabs(angle_of(run, bearing) - want - BAUM_I_REVOLUTION) < 1e-9);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  baum_mechanism_destroy(wound);
}

static void a_driven_angle_has_the_revolutions_of_its_driver(void **state)
{
  (void)state;
  check_driven(0.5, 0.0);
  check_driven(4.0, 0.0);
  check_driven(-9.5, 0.0);
  check_driven(0.0, 5.0);
}

enum { SAMPLES = 40 };

/* Returns the error of the angle in a study. The reference is given to the study, with `samples`
 * samples over 5 s. */
static double error_of_angle(int samples)
{
  baum_joint_id bearing;
  baum_mechanism *m = make_wound(OF_JOINT, 0.0, &bearing);
  baum_simulation *run = start(m, baum_rk8());
  baum_study *study = NULL;
  baum_study_entry entry;
  baum_simulation_options o = baum_simulation_options_default();
  double times[SAMPLES];
  double q[7 * SAMPLES];
  double v[6 * SAMPLES];
  for (int k = 0; k < samples; k++) {
    times[k] = 5.0 * (k + 1) / samples;
    check(baum_simulation_advance_to(run, times[k]));
    memcpy(q + (ptrdiff_t)7 * k, baum_simulation_q(run), 7 * sizeof *q);
    memcpy(v + (ptrdiff_t)6 * k, baum_simulation_v(run), 6 * sizeof *v);
  }
  const baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, bearing);
  o.integrator = baum_rk4();
  o.step = 0.01;
  check(baum_study_create(m, 0.0, 5.0, &study));
  check(baum_study_set_error(study, &channel, 1, 1.0));
  check(baum_study_set_reference(study, times, samples, q, v, NULL, 6.0));
  check(baum_study_add(study, &o));
  check(baum_study_run(study));
  check(baum_study_entry_at(study, 0, &entry, sizeof entry));
  baum_study_destroy(study);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  return entry.error;
}

/* The study counts the revolutions of a given reference from sample to sample. With only 3 samples
 * the number of revolutions is uncertain, so the error must be NaN. */
static void revolutions_of_a_given_reference_are_counted(void **state)
{
  (void)state;
  double error = error_of_angle(SAMPLES);
  assert_true(error > 0.0 && error < 0.02);
  assert_true(isnan(error_of_angle(3)));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(angles_count_revolutions),
    cmocka_unit_test(a_restored_run_continues_to_count_revolutions),
    cmocka_unit_test(a_continued_run_continues_to_count_revolutions),
    cmocka_unit_test(revolutions_of_a_set_state_are_counted_from_the_present_angle),
    cmocka_unit_test(a_driver_prescribes_many_revolutions),
    cmocka_unit_test(springs_wind_up_over_revolutions),
    cmocka_unit_test(energies_include_the_revolutions_of_the_spring),
    cmocka_unit_test(a_restored_spring_stays_wound),
    cmocka_unit_test(a_state_that_is_set_stays_wound),
    cmocka_unit_test(a_run_uses_the_revolutions_that_it_is_given),
    cmocka_unit_test(a_driven_angle_has_the_revolutions_of_its_driver),
    cmocka_unit_test(revolutions_of_a_given_reference_are_counted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
