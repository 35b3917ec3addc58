# SPDX-License-Identifier: BSD-3-Clause
"""Tests the catalogue of known mechanisms. These tests cover what the binding adds to the C
interface. C tests cover the C interface itself."""

import math
import unittest

import numpy as np

import baum
from baum import catalog


class Catalog(unittest.TestCase):
    def test_entries_tell_what_there_is(self):
        names = [entry.name for entry in catalog.entries()]
        self.assertEqual(len(names), len(set(names)))
        entry = catalog.entry("n_four_bar")
        self.assertIn(entry.name, names)
        self.assertTrue(entry.exact)
        self.assertEqual(entry.parameter_count, len(entry.parameters))
        windows = entry.parameters["windows"]
        self.assertEqual((windows.unit, windows.value, windows.whole), ("-", 2.0, True))

    def test_a_mechanism_of_the_catalogue_is_a_mechanism_like_others(self):
        m = catalog.build("slider_crank_driven", eccentricity=0.02)
        self.assertIsInstance(m, baum.Mechanism)
        self.assertTrue(m.frozen)
        self.assertEqual(m["rod"].definition["mass"], 0.038)
        self.assertEqual(m["motor"].definition["joint"], m["A"])
        run = m.simulate([0, 0.01], "kinematics", record=["motor.effort"])
        self.assertEqual(run["slider.pose"][-1][1], 0.02)
        self.assertEqual(run["motor.effort"].shape, (2, 1))
        heavier = m.copy(slider=dict(mass=1.0))
        self.assertEqual(heavier["slider"].definition["mass"], 1.0)

    def test_every_kind_of_element_is_found(self):
        m = catalog.build("andrews_bodies")
        self.assertEqual(m["K3"].kind.name, "planar_body")
        self.assertEqual(m["K3"].columns, (slice(6, 9), slice(6, 9)))
        self.assertEqual(m["spring"].kind.name, "planar_spring")
        self.assertEqual(m["motor"].kind.name, "planar_load")
        self.assertEqual(catalog.build("andrews_angles")["angles"].nq, 7)
        self.assertEqual(catalog.build("pendulum")["rod"].kind.name, "planar_distance")

    def test_names_that_the_library_gave_can_be_used(self):
        m = catalog.build("chain", links=4)
        self.assertEqual(m.sizes, (12, 12, 8))
        self.assertIn("body4", m)

    def test_runs_are_compared_with_the_reference(self):
        m = catalog.build("four_bar")
        known = catalog.reference("four_bar")
        self.assertEqual(known.q.shape, (len(known.t), 9))
        error = catalog.compare(m.simulate(known.t, "rk8", rtol=1e-8), "four_bar")
        # Errors of about 1e-8 per step add up over about a hundred steps.
        self.assertLess(error.q, 1e-5)
        self.assertGreater(error.q, error.q_floor)
        self.assertEqual(catalog.compare(known, "four_bar").q, 0.0)
        self.assertTrue(math.isnan(catalog.compare((known.t, known.q, None), "four_bar").v))

    def test_orientations_are_compared_by_the_rotation_between_them(self):
        known = catalog.reference("heavy_top")
        self.assertEqual((known.q.shape, known.v.shape), ((21, 7), (21, 6)))
        other = known.q.copy()
        other[:, 3:] *= -1  # -p is the same orientation as p
        self.assertLess(catalog.compare((known.t, other, known.v), "heavy_top").q, 1e-15)
        # a rotation by 1e-3 rad about the z axis of the body
        turn = np.array([math.cos(5e-4), math.sin(5e-4)])
        w, x, y, z = known.q[:, 3:].T
        other[:, 3:] = np.array(
            [
                w * turn[0] - z * turn[1],
                x * turn[0] + y * turn[1],
                y * turn[0] - x * turn[1],
                z * turn[0] + w * turn[1],
            ]
        ).T
        error = catalog.compare((known.t, other, None), "heavy_top")
        self.assertAlmostEqual(error.q, 1e-3, delta=1e-9)

    def test_a_formula_holds_for_all_parameters_and_times(self):
        known = catalog.reference("pendulum", [0.3, 0.1], length=2.0, angle=0.01)
        rate = math.sqrt(9.81 / 2)
        # The period of a pendulum is longer than that of small oscillations by the fraction
        # angle^2 / 16 = 6e-6. At 0.3 s, the phase is 0.66 rad. The error of the cosine formula is
        # therefore at most 0.01 x 0.66 x 6e-6 = 4e-8 rad.
        np.testing.assert_allclose(
            np.arcsin(known.q[:, 0] / 2), 0.01 * np.cos(rate * known.t), rtol=0, atol=5e-8
        )

    def test_mechanisms_with_formulas_follow_them(self):
        for name in (
            "rolling_disc",
            "chaplygin_sleigh",
            "stewart",
            "differential",
            "gimbals",
            "double_wishbone",
        ):
            with self.subTest(name):
                run = catalog.build(name).simulate(catalog.times(name), "rk8", rtol=1e-9)
                # The largest errors measured are 4e-8 (gimbals) and 3e-8 (rolling disc).
                self.assertLess(catalog.compare(run, name).q, 3e-7)

    def test_the_motions_obey_their_laws(self):
        t = np.linspace(0, 2, 11)

        def run(name, method="rk8", **options):
            options = options if method == "kinematics" else dict(rtol=1e-11, **options)
            return catalog.build(name).simulate(t, method, **options)

        x, y, angle = run("chaplygin_sleigh")["sleigh.pose"].T
        vx, vy, rate = run("chaplygin_sleigh")["sleigh.velocity"].T
        across = vy * np.cos(angle) - vx * np.sin(angle) - 0.3 * rate  # velocity across the blade
        self.assertLess(abs(across).max(), 1e-14)

        centre = run("rolling_disc")["disc.pose"]
        self.assertLess(abs(centre[:, 2] - 0.5 * np.cos(0.3)).max(), 1e-9)

        inner = run("gimbals")["inner ring.pose"]
        self.assertLess(abs(inner[:, 2] - 0.05 * np.sin(0.4)).max(), 1e-9)
        azimuth = np.unwrap(np.arctan2(inner[:, 1], inner[:, 0]))
        np.testing.assert_allclose(azimuth - azimuth[0], 2.0 * t, rtol=0, atol=1e-8)

        one = run("double_wishbone", "kinematics")
        wheel = one["upright.pose"][:, 2]
        self.assertLess(abs(wheel - 0.32 - 0.05 * np.sin(5 * t)).max(), 1e-14)
        rack = one["rack.pose"][:, 1]
        self.assertLess(abs(rack - 0.02 * np.sin(3 * t)).max(), 1e-14)

    def test_assembly_solves_the_forward_kinematics_of_the_stewart_platform(self):
        m = catalog.build("stewart")
        workspace = baum.Workspace(m)
        q, v = workspace.design()
        random = np.random.default_rng(0)
        for t in random.uniform(0, 2, 10):
            guess = workspace.move(random.uniform(-0.1, 0.1, len(v)), q)
            found, _ = workspace.assemble(t, guess, np.full(len(v), np.nan))
            np.testing.assert_allclose(
                found[:3], catalog.reference("stewart", t).q[0, :3], rtol=0, atol=1e-11
            )

    def test_nothing_is_compared_with_a_reference_that_does_not_hold(self):
        with self.assertRaisesRegex(baum.Error, "crank = 1 m, not for 1.5"):
            catalog.reference("four_bar", crank=1.5)
        with self.assertRaisesRegex(baum.Error, "no sample at t = 0.125 s"):
            catalog.reference("four_bar", 0.125)
        with self.assertRaisesRegex(baum.Error, '"chain" has no reference'):
            catalog.times("chain")

    def test_refusals_name_what_there_is(self):
        with self.assertRaisesRegex(baum.Error, "there are pendulum, "):
            catalog.build("windmill")
        with self.assertRaisesRegex(baum.Error, "there are: links, mass"):
            catalog.build("chain", length_of_all=1)
        with self.assertRaisesRegex(baum.Error, "links is 2.5, must be a whole number"):
            catalog.build("chain", links=2.5)
        with self.assertRaisesRegex(TypeError, "catalogue: links: a number is wanted"):
            catalog.build("chain", links="many")


if __name__ == "__main__":
    unittest.main()
