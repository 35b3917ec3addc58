# SPDX-License-Identifier: BSD-3-Clause
"""Values that should be a number, a truth value, a name or an integer, but are not, must be refused
with a message. Nothing may be guessed. If an exception is raised, the samples that a run has
recorded must not be lost."""

import copy
import pickle
import unittest

import numpy as np

import baum
from mechanisms import pendulum, rod_pendulum


class Values(unittest.TestCase):
    def says(self, kind, message, call, *arguments, **fields):
        with self.assertRaisesRegex(kind, message):
            call(*arguments, **fields)

    def test_text_is_no_number(self):
        m = baum.Mechanism()
        self.says(TypeError, 'body "x": mass: a number is wanted', m.planar_body, "x", mass="1")
        self.says(TypeError, "position: numbers are wanted", m.planar_body, "x", position="12")
        s = rod_pendulum().simulation("rk4", step=0.1)
        self.says(TypeError, "t: a number is wanted, not '1'", s.advance_to, "1")
        self.says(TypeError, "times: numbers are wanted", s.sample, np.array(["1", "2"]))
        self.says(TypeError, "times: numbers are wanted", s.sample, np.array([0, 1j]))
        self.says(TypeError, "times: numbers are wanted", s.sample, np.array(["2020-01-01"], "M8[s]"))
        self.assertEqual(s.time, 0)

    def test_truth_is_no_number(self):
        m = baum.Mechanism()
        self.says(TypeError, "mass: a number is wanted, not True", m.planar_body, "x", mass=True)
        self.says(TypeError, "position: numbers are wanted", m.planar_body, "x", position=(True, False))
        self.assertEqual(m.planar_body("x", mass=None).definition["mass"], 1)

    def test_numbers_that_do_not_fit_are_not_cut(self):
        m = baum.Mechanism()
        self.says(ValueError, 'body "x": mass: the number is too large', m.planar_body, "x", mass=10**400)
        self.says(ValueError, "size: 4294967297 does not fit into 32 bits", m.coordinates, "x", 2**32 + 1)
        s = rod_pendulum().simulation("rk4", step=0.1)
        self.says(ValueError, "count: 18446744073709551617 does not fit", s.step, 2**64 + 1)
        self.says(ValueError, "max_steps: .* does not fit", s.mechanism.simulation, "rk4", step=1,
                  max_steps=2**64 + 1)

    def test_text_is_not_true(self):
        m = baum.Mechanism()
        self.says(TypeError, "held: True or False is wanted, not 'no'", m.planar_body, "x", held="no")
        self.says(TypeError, "energy_account: True or False", rod_pendulum().simulation, "rk4", step=1,
                  energy_account="no")
        self.assertTrue(m.planar_body("y", held=np.bool_(True)).definition["held"])

    def test_names_reach_the_library_whole(self):
        m = baum.Mechanism()
        self.says(ValueError, "the name of a body is ''", m.planar_body, "")
        for name in "", "a\0b", "a\nb", "a\tb", "a\x7f":
            self.says(ValueError, "must have letters, but no control characters", m.planar_body, name)
        self.says(ValueError, "the name of an input is ''", m.input, "")

    def test_sizes_below_one_are_refused_by_the_library(self):
        m = baum.Mechanism()
        m.planar_particle("bob")
        self.says(baum.Error, '"c": rows is -1, must be > 0', m.constraint, "c", "bob", -1,
                  lambda t, q: 0)
        self.says(baum.Error, '"c": size is -3, must be > 0', m.coordinates, "c", -3,
                  mass=lambda t, q: 1, force=lambda t, q, v: 0)

    def test_others_are_named(self):
        self.says(ValueError, "gravity: several numbers are wanted, not one", baum.Mechanism, gravity=9.81)
        m = rod_pendulum()
        self.says(TypeError, 'body "bob": a dict is wanted, not 3', m.copy, bob=3)
        self.says(TypeError, "progress: a function or True is wanted", m.simulation, "rk4", step=1, progress=1)
        s = m.simulation("rk4", step=0.1)
        self.says(TypeError, "a simulation is wanted, not None", s.continue_from, None)
        self.says(TypeError, "cannot be pickled; build it in each process", pickle.dumps, s)
        self.assertTrue(copy.copy(m).frozen)

    def test_names_are_suggested_whatever_their_case(self):
        s = rod_pendulum()
        self.says(ValueError, "did you mean 'rk8'", s.simulation, "RK8", rtol=1e-6)

    def test_a_state_that_violates_the_constraints_is_called_given(self):
        s = rod_pendulum().simulation("rk4", step=0.1)
        self.says(baum.Error, "the given state violates .*; give a configuration closer to the "
                  "assembled one", s.set_state, 0, (9, 9))

    def test_a_long_list_of_names_is_cut(self):
        m = baum.Mechanism()
        for _ in range(40):
            m.planar_particle()
        self.says(KeyError, "body29 and 11 more", m.__getitem__, "nobody")


class Attributes(unittest.TestCase):
    """An assignment to an attribute that does not exist would vanish."""

    def refuses(self, owner, name, message):
        with self.assertRaisesRegex(AttributeError, message):
            setattr(owner, name, 5)

    def test_elements_name_what_changes_their_definitions(self):
        m = rod_pendulum()
        self.refuses(m["bob"], "mass", r"set\(mass=\.\.\.\) changes the definition before freezing, "
                     r"and m.copy\(bob=dict\(mass=\.\.\.\)\) changes it in a copy of the mechanism$")
        self.refuses(m["bob"], "masss", "there are: mass, .*; did you mean 'mass'")
        self.refuses(m["bob"], "Outline", "did you mean 'outline'")
        self.refuses(m["bob"], "name", 'body "bob" has no attribute \'name\' that can be set')
        self.refuses(m["rod"], "stiffness", 'joint "rod" has no .*; there are: .*length')
        self.refuses(m.ground, "mass", "body \"ground\" has no attribute 'mass' that can be set; "
                     "there are: outline$")
        free = baum.Mechanism()
        self.refuses(free.input("u", 1), "initial", r"m.copy\(u=dict\(initial=")
        free["u"].set(initial=2)
        free.ground.outline = [[0, 0], [1, 0], [0, 1]]

    def test_elements_name_where_their_definitions_can_be_read(self):
        bob = rod_pendulum()["bob"]
        message = r"no attribute 'mass'; definition\['mass'\] of body 'bob' has this value$"
        with self.assertRaisesRegex(AttributeError, message):
            bob.mass
        with self.assertRaisesRegex(AttributeError, "'Body' object has no attribute 'masss'$"):
            bob.masss
        self.assertEqual(bob.definition["mass"], 1)
        self.assertEqual(copy.copy(bob), bob)

    def test_other_objects_name_what_can_be_set(self):
        m = rod_pendulum()
        self.refuses(m, "gravty", "there are: characteristic_length, gravity; did you mean 'gravity'")
        self.refuses(m, "copy", "a Mechanism has no attribute 'copy' that can be set")
        s = m.simulation("rk4", step=0.1)
        for name in "step", "rtol", "tme", "time":
            self.refuses(s, name, "options are arguments of Mechanism.simulation")
        self.refuses(baum.Workspace(m), "q", "a Workspace has no attribute 'q' that can be set$")
        self.refuses(baum.study(m, 0, 1), "samples", "options are arguments of baum.study")
        self.refuses(s.sample([0.1]), "record", "a Run has no attribute 'record'")

    def test_private_names_and_derived_classes_are_free(self):
        class Own(baum.Mechanism):
            def __init__(self):
                super().__init__()
                self.crank = self.planar_body("crank")

        m = Own()
        m.note = m.copy()._note = "any"
        self.assertEqual((m.crank.name, m.note), ("crank", "any"))

    def test_copies_cannot_be_written_into(self):
        s = rod_pendulum().simulation("rk4", step=0.1)
        for copied in s.q, s.v, s.unique_multipliers, s.mechanism.break_times:
            self.assertFalse(copied.flags.writeable)


class Instead(unittest.TestCase):
    """Messages must name only remedies that exist in Python."""

    def says(self, kind, message, call, *arguments, **fields):
        with self.assertRaisesRegex(kind, message) as caught:
            call(*arguments, **fields)
        self.assertNotRegex(str(caught.exception), r"baum_|BAUM_")

    def test_without_an_integrator_the_names_of_python_are_listed(self):
        m = rod_pendulum()
        wanted = "no integrator is given; choose one of euler, .*rk4, .*kinematics"
        self.says(baum.Error, wanted, m.simulate, [0, 1])
        self.says(baum.Error, wanted, m.simulation, step=1e-3)

    def test_a_wrong_name_lists_those_that_would_do(self):
        m = baum.Mechanism()
        m.revolute("pin", m.ground, m.planar_body("arm", mass=1, inertia=1), point=(0, 0))
        m.input("torque")
        s = m.freeze().simulation("rk4", step=0.1)
        self.says(KeyError, "no input 'x' in this mechanism; there are: torque\\W*$", s.set_input, "x", 1)
        self.says(KeyError, "no joint 'x' .* there are: pin\\W*$", s.set_driver, "x", 1)
        self.says(KeyError, "no body 'x' .* there are: ground, arm\\W*$", m.columns, "x")
        self.says(KeyError, "no 'torqe' .*; did you mean 'torque'", m.__getitem__, "torqe")
        self.says(TypeError, "has no mas; there are: .*; did you mean 'mass'", m.copy, arm=dict(mas=1))
        self.says(TypeError, "no option 'stepp'; .*; did you mean 'step'", m.simulation, "rk4", stepp=1)
        self.says(ValueError, "no integrator 'rk44'; .*; did you mean 'rk4'", m.simulation, "rk44")
        self.says(ValueError, "no form.* 'projektion'; .*; did you mean 'projection'", m.simulation, "rk4",
                  step=1, formulation="projektion")
        self.says(TypeError, "a body or its name is wanted, not 'pin', a joint", m.columns, "pin")

    def test_long_lists_of_names_end_early(self):
        m = baum.Mechanism()
        for k in range(40):
            m.planar_particle(f"body {k}")
        self.says(KeyError, "there are: ground, body 0, .*body 28 and 11 more; did you mean 'body 39'",
                  m.__getitem__, "bdy 39")

    def test_a_mechanism_without_inputs(self):
        m = rod_pendulum()
        wanted = "no input 'x': the mechanism has no inputs; add one by Mechanism.input"
        self.says(KeyError, wanted, m.simulation("rk4", step=0.1).set_input, "x", 1)
        self.says(KeyError, wanted, m.initial, "x")
        m, other = m.thawed(), baum.Mechanism()
        self.says(baum.Error, "the mechanism has no inputs, Mechanism.input.. adds one before freezing$", m.load,
                  "push", "bob", input=other.input("x"))

    def test_remedies_are_named(self):
        m = rod_pendulum()
        self.says(TypeError, 'joint "c": bodies: a body or a list of bodies is wanted', m.thawed().constraint,
                  "c", lambda t, q: q, 1, lambda t, q: q)
        self.says(ValueError, "position: 2 numbers are wanted, not one", m.copy, bob=dict(position=1))
        self.says(baum.Error, "rk4 needs it; rtol is only for integrators", m.simulation, "rk4", rtol=1e-6)
        self.says(baum.Error, "call again to continue, or raise max_steps", m.simulation("rk4", step=1e-3,
                  max_steps=2).advance_to, 1)
        self.says(baum.Error, r"no entry is finished; call run\(\); if it has spent", baum.study(
            m, 0, 1, progress=False).recommend, 1e-3)

    def test_a_mechanism_that_is_not_frozen(self):
        m = baum.Mechanism()
        m.planar_body("arm", mass=1, inertia=1)
        self.says(baum.Error, r"^the mechanism is not frozen; call freeze\(\) first$", m.simulation, "rk4", step=0.1)

    def test_a_run_is_not_read_in_its_own_functions(self):
        m = rod_pendulum()
        s = m.simulation("rk4", step=1e-2)
        w = baum.Workspace(m)
        read = lambda t, q, v: s.get("rod.multipliers")[0]
        self.says(baum.Error, "acceleration.t, q, v. of a baum.Workspace for multipliers", s.event, function=read)
        s.event(function=lambda t, q, v: abs(w.acceleration(t, q, v)[1][0]) - 9.81)
        self.assertEqual(s.advance_to(1), baum.Status.STOP_EVENT)
        self.assertAlmostEqual(abs(s.get("rod.multipliers")[0]), 9.81, 6)

    def test_a_function_is_looked_at_before_what_it_is_given(self):
        m = baum.Mechanism()
        pin = m.revolute("pin", m.ground, m.planar_body("arm", mass=1, inertia=1), point=(0, 0))
        for user in None, 5, [1, 2]:
            self.says(TypeError, "law: a function or the address", m.driver, "d", pin, law=[1, 2, 3], user=user)
        self.says(TypeError, "user: an address or an object of ctypes is wanted, not .1, 2.", m.driver, "d",
                  pin, law=lambda t: (0, 0, 0), user=[1, 2])


class One(unittest.TestCase):
    """A single body or channel need not be in a list."""

    def test_one_body(self):
        for given in ("bob", ["bob"]):
            m = baum.Mechanism()
            m.planar_particle("bob", position=(1, 0))
            m.constraint("rod", given, 1, lambda t, q: q @ q - 1)
            m.force("push", m["bob"], lambda t, q, v: (1, 0))
            self.assertEqual(m.freeze().sizes.nc, 1)

    def test_one_channel(self):
        m = rod_pendulum()
        for given in ("rod.phi", m["rod"].phi, ["rod.phi"]):
            run = m.simulate([0, 0.1], "rk4", step=0.1, record=given)
            self.assertEqual(list(run), ["q", "v", "rod.phi"])
            self.assertTrue("rod.phi" in run and m["bob"].pose in run and "rod.reaction" not in run)


class Kept(unittest.TestCase):
    """Tests the samples that were recorded before a function raised an exception."""

    def test_recorded_samples_come_with_the_exception(self):
        for kind, status in (ValueError, "ERR_CALLBACK"), (KeyboardInterrupt, "STOP_CANCELLED"):

            armed = []

            def phi(t, q):
                if armed and t > 0.5:
                    raise kind
                return q @ q - 1

            s = pendulum(phi).simulation("rk4", step=0.01)
            armed.append(True)
            with self.assertRaises(kind) as caught:
                s.sample(np.linspace(0, 1, 11))
            run = caught.exception.run
            self.assertEqual(run.status.name, status)
            np.testing.assert_allclose(run.t, 0.1 * np.arange(5), atol=1e-15)  # rounding errors
            self.assertTrue(np.isfinite(run["bob.pose"]).all())


if __name__ == "__main__":
    unittest.main()
