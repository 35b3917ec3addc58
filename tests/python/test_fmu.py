# SPDX-License-Identifier: BSD-3-Clause
"""Tests FMUs. The functions of the binary are called directly and, if FMPy is installed, by FMPy."""

import ctypes
import importlib.util
import json
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

import numpy as np

import baum
from baum.fmu import _binary

HAS_FMPY = importlib.util.find_spec("fmpy") is not None
OUTPUTS = ["pin.coordinate", "energy", "arm.acceleration"]
NAMES = ["time", "torque", "arm.mass", "arm.position[0]", "arm.position[1]", "arm.angle",
         "pin.coordinate[0]", "pin.coordinate[1]", "energy[0]", "energy[1]",
         "arm.acceleration[0]", "arm.acceleration[1]", "arm.acceleration[2]"]  # fmt: skip
TORQUE, MASS, X, Y = 1, 2, 3, 4
FIRST = 6  # the first output
PERIOD = 0.01  # [s] between two calls of the controller
PARAMETERS = ["arm.mass", "arm.position", "arm.angle"]
SIZE, BOOL, REAL = ctypes.c_size_t, ctypes.c_bool, ctypes.c_double
LOG = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p)


def arm():
    m = baum.Mechanism()
    torque = m.input("torque", 0.5)
    m.planar_body("arm", mass=1.2, inertia=0.1, position=(0.3, 0))
    m.revolute("pin", "ground", "arm", point=(0, 0))
    m.load("motor", "arm", torque=1.0, input=torque)
    return m


def control(angle, velocity):
    """A PD controller."""
    return 8.0 * (0.6 - angle) - 1.5 * velocity


class Unpacked:
    """An unpacked FMU. Methods call its functions directly, and raise OSError if a call fails."""

    def __init__(self, file, folder):
        zipfile.ZipFile(file).extractall(folder)
        root = ElementTree.parse(folder / "modelDescription.xml").getroot()
        self.token = root.get("instantiationToken").encode()
        self.resources = folder / "resources"
        self.library = ctypes.CDLL(str(folder / _binary()[0]))
        self.messages = []
        self.log = LOG(lambda *given: self.messages.append((given[2].decode(), given[3].decode())))

    def create(self, token=None):
        create = self.library.fmi3InstantiateCoSimulation
        create.restype = ctypes.c_void_p
        create.argtypes = [ctypes.c_char_p] * 3 + [BOOL] * 4 + [ctypes.c_void_p, SIZE]
        create.argtypes += [ctypes.c_void_p, LOG, ctypes.c_void_p]
        folder = str(self.resources).encode()
        address = create(b"one", token or self.token, folder, False, False, False, False, None, 0,
                         None, self.log, None)  # fmt: skip
        if not address:
            raise OSError(self.messages[-1][1])
        return Instance(self, ctypes.c_void_p(address))


class Instance:
    def __init__(self, unpacked, address):
        self.unpacked, self.address = unpacked, address

    def call(self, name, *arguments):
        status = getattr(self.unpacked.library, name)(self.address, *arguments)
        if status > 1:
            raise OSError(self.unpacked.messages[-1][1])

    def initialize(self, start=0.0, tolerance=None):
        given = BOOL(tolerance is not None), REAL(tolerance or 0)
        self.call("fmi3EnterInitializationMode", *given, REAL(start), BOOL(False), REAL(0))
        self.call("fmi3ExitInitializationMode")
        return self

    def get(self, *references):
        found = (REAL * len(references))()
        places = (ctypes.c_uint32 * len(references))(*references)
        count = SIZE(len(references))
        self.call("fmi3GetFloat64", places, count, found, count)
        return list(found)

    def set(self, reference, value):
        place, given = (ctypes.c_uint32 * 1)(reference), (REAL * 1)(value)
        self.call("fmi3SetFloat64", place, SIZE(1), given, SIZE(1))

    def step(self, t, step):
        flags, reached = [BOOL() for _ in range(3)], REAL()
        places = [ctypes.byref(one) for one in (*flags, reached)]
        self.call("fmi3DoStep", REAL(t), REAL(step), BOOL(False), *places)
        return reached.value

    def outputs(self):
        return self.get(*range(FIRST, len(NAMES)))

    def loop(self, first, end):
        """Run a closed loop with the controller, and return the outputs after each step."""
        rows = []
        for k in range(first, end):
            self.set(TORQUE, control(*self.get(FIRST, FIRST + 1)))
            self.step(k * PERIOD, PERIOD)
            rows.append(self.outputs())
        return np.array(rows)

    def free(self):
        self.unpacked.library.fmi3FreeInstance(self.address)


def loop_in_python(m, end, *method, **options):
    rows = []
    with m.freeze().simulation(*method, **options) as s:
        for k in range(end):
            s.set_input("torque", control(*s.get("pin.coordinate")))
            s.advance_to(k * PERIOD + PERIOD)
            rows.append(np.concatenate([np.ravel(one) for one in s.get(*OUTPUTS)]))
    return np.array(rows)


class FmuTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def export(self, m=None, *method, **options):
        file = self.folder / "arm.fmu"
        given = dict(outputs=OUTPUTS, parameters=PARAMETERS)
        given.update(options or {"step": 1e-3})
        (m or arm()).export_fmu(file, *(method or ["rk8"]), **given)
        return file

    def create(self, *method, **options):
        """Export an FMU, unpack it into a new folder, and load it."""
        file = self.export(None, *method, **options)
        self.unpacked = Unpacked(file, Path(tempfile.mkdtemp(dir=self.folder)))
        return self.another()

    def another(self):
        made = self.unpacked.create()
        self.addCleanup(made.free)
        return made


class BinaryTest(FmuTest):
    def test_a_closed_loop_equals_the_loop_in_python(self):
        for method, options in (("rk8", {"step": 1e-3}), ("rk8", {"rtol": 1e-8})):
            fmu = self.create(method, **options).initialize()
            wanted = loop_in_python(arm(), 50, method, **options)
            np.testing.assert_array_equal(fmu.loop(0, 50), wanted)

    def test_single_names_need_no_list(self):
        single = dict(outputs="pin.coordinate", inputs="torque", parameters="arm.mass")
        listed = {name: [value] for name, value in single.items()}
        files = [self.export(None, "rk8", step=1e-3, **given).read_bytes() for given in (single, listed)]
        self.assertEqual(*files)

    def test_options_reach_the_run(self):
        options = dict(step=1e-3, formulation="baumgarte", gains=baum.fixed(20, 30), solver="klu")
        fmu = self.create("rk4", **options).initialize()
        wanted = loop_in_python(arm(), 20, "rk4", **options)
        np.testing.assert_array_equal(fmu.loop(0, 20), wanted)
        other = loop_in_python(arm(), 20, "rk4", step=1e-3)
        self.assertGreater(np.abs(other - wanted).max(), 0)

    def test_parameters_and_inputs_change_the_motion(self):
        fmu = self.create("rk8", step=1e-3)
        self.assertEqual(fmu.get(*range(FIRST)), [0.0, 0.5, 1.2, 0.3, 0.0, 0.0])
        for reference, value in ((MASS, 2.0), (TORQUE, -1.0), (X, 0.0), (Y, 0.3), (5, np.pi / 2)):
            fmu.set(reference, value)
        fmu.initialize()
        m = arm().copy(arm=dict(mass=2.0, position=(0.0, 0.3), angle=np.pi / 2)).freeze()
        with m.simulation("rk8", step=1e-3) as s:
            s.set_input("torque", -1.0)
            s.advance_to(0.25)
            fmu.step(0.0, 0.25)
            self.assertEqual(fmu.get(FIRST, FIRST + 1), list(s.get("pin.coordinate")))
        self.assertEqual(fmu.get(0, MASS), [0.25, 2.0])

    def test_a_reset_fmu_repeats_its_motion(self):
        fmu = self.create().initialize()
        first = fmu.loop(0, 10)
        fmu.call("fmi3Terminate")
        fmu.call("fmi3Reset")
        fmu.set(MASS, 3.0)
        fmu.call("fmi3Reset")
        self.assertEqual(fmu.get(0, TORQUE, MASS), [0.0, 0.5, 1.2])
        np.testing.assert_array_equal(fmu.initialize().loop(0, 10), first)

    def test_the_start_time_and_the_tolerance_are_those_of_the_simulator(self):
        fmu = self.create("rk8", rtol=1e-5).initialize(start=3.0, tolerance=1e-9)
        fmu.step(3.0, 1.0)
        times = [3.0, 4.0]
        run = arm().freeze().simulate(
            times, "rk8", rtol=1e-9, start_time=3.0, record="pin.coordinate"
        )
        self.assertEqual(fmu.get(FIRST, FIRST + 1), list(run["pin.coordinate"][-1]))

    def test_a_state_is_restored_also_in_another_instance(self):
        fmu = self.create()
        fmu.set(MASS, 2.0)
        fmu.initialize()
        fmu.loop(0, 10)
        state, size, copy = ctypes.c_void_p(), SIZE(), ctypes.c_void_p()
        fmu.call("fmi3GetFMUState", ctypes.byref(state))
        wanted = fmu.loop(10, 20)
        fmu.call("fmi3SetFMUState", state)
        np.testing.assert_array_equal(fmu.loop(10, 20), wanted)

        fmu.call("fmi3SerializedFMUStateSize", state, ctypes.byref(size))
        bytes = (ctypes.c_uint8 * size.value)()
        fmu.call("fmi3SerializeFMUState", state, bytes, size)
        with self.assertRaisesRegex(OSError, "too small"):
            fmu.call("fmi3SerializeFMUState", state, bytes, SIZE(size.value - 1))
        other = self.another()
        other.call("fmi3DeserializeFMUState", bytes, size, ctypes.byref(copy))
        other.call("fmi3SetFMUState", copy)
        self.assertEqual(other.get(0, MASS), [0.1, 2.0])
        np.testing.assert_array_equal(other.loop(10, 20), wanted)
        for wrong in (size.value - 1, 3):
            with self.assertRaisesRegex(OSError, "not a state of this FMU"):
                other.call("fmi3DeserializeFMUState", bytes, SIZE(wrong), ctypes.byref(copy))
        for k in (90, 150):  # the tolerance and a parameter
            damaged = (ctypes.c_uint8 * size.value).from_buffer_copy(bytes)
            damaged[k] ^= 1
            with self.assertRaisesRegex(OSError, "damaged"):
                other.call("fmi3DeserializeFMUState", damaged, size, ctypes.byref(copy))
        damaged = (ctypes.c_uint8 * size.value).from_buffer_copy(bytes)
        damaged[1000] ^= 1  # the saved run begins before byte 200 and has more than 2000 bytes
        other.call("fmi3DeserializeFMUState", damaged, size, ctypes.byref(copy))
        with self.assertRaisesRegex(OSError, "damaged"):
            other.call("fmi3SetFMUState", copy)
        with self.assertRaisesRegex(OSError, "not initialized"):
            other.step(0.1, PERIOD)
        other.call("fmi3Reset")
        expected = self.another().initialize().loop(0, 5)
        np.testing.assert_array_equal(other.initialize().loop(0, 5), expected)
        stranger = self.create(step=5e-4)  # an FMU with the same variables
        with self.assertRaisesRegex(OSError, "not a state of this FMU"):
            stranger.call("fmi3DeserializeFMUState", bytes, size, ctypes.byref(copy))
        with self.assertRaisesRegex(OSError, "that of another FMU"):
            stranger.call("fmi3SetFMUState", state)
        for one in (state, copy):
            fmu.call("fmi3FreeFMUState", ctypes.byref(one))
            self.assertIsNone(one.value)

    def test_a_state_before_initialization_has_only_numbers(self):
        fmu, state = self.create(), ctypes.c_void_p()
        fmu.call("fmi3GetFMUState", ctypes.byref(state))
        fmu.set(MASS, 2.0)
        fmu.initialize().loop(0, 3)
        fmu.call("fmi3SetFMUState", state)
        self.assertEqual(fmu.get(0, TORQUE, MASS), [0.0, 0.5, 1.2])
        fmu.call("fmi3FreeFMUState", ctypes.byref(state))
        wanted = loop_in_python(arm(), 5, "rk8", step=1e-3)
        np.testing.assert_array_equal(fmu.initialize().loop(0, 5), wanted)

    def test_wrong_calls_fail_with_a_message(self):
        fmu = self.create()

        def refuses(text, call, *arguments):
            with self.assertRaisesRegex(OSError, text):
                call(*arguments)

        refuses("another FMU", self.unpacked.create, b"wrong")
        refuses("not initialized", fmu.step, 0.0, 0.1)
        refuses("no such variable", fmu.get, len(NAMES))
        refuses("no such input or parameter", fmu.set, 0, 1.0)
        refuses("no such input or parameter", fmu.set, FIRST, 1.0)
        fmu.set(MASS, -1.0)
        refuses("mass is -1 kg", fmu.initialize)
        fmu.set(MASS, 1.0)
        fmu.initialize()
        refuses("already initialized", fmu.initialize)
        refuses("cannot change after initialization", fmu.set, MASS, 2.0)
        refuses("is at 0 s, not 0.5 s", fmu.step, 0.5, 0.1)
        refuses("the step is -0.1 s, must be > 0", fmu.step, 0.0, -0.1)
        refuses("is nan, must be finite", fmu.set, TORQUE, float("nan"))
        refuses("fmi3SetTime is not supported", fmu.call, "fmi3SetTime", REAL(0))
        self.assertIn(("error", "fmi3SetTime is not supported"), self.unpacked.messages)

    def test_damaged_resources_are_refused(self):
        self.create()
        file = self.unpacked.resources / "fmu.json"
        whole = json.loads(file.read_text())
        for key, value, text in (
            ("integrator", "rk9", 'no integrator "rk9"'),
            ("outputs", None, '"outputs" is missing'),
            ("inputs", [3], "input 3 does not exist"),
            ("parameters", [{"element": "arm", "field": "name"}], 'no parameter "arm.name"'),
            ("outputs", [{"quantity": 8, "body": 7}], "body 7 does not exist"),
        ):
            file.write_text(json.dumps({**whole, key: value}))
            with self.assertRaisesRegex(OSError, text):
                self.unpacked.create()

    def test_unreadable_scenes_are_refused(self):
        self.create()
        (self.unpacked.resources / "scene.json").unlink()
        with self.assertRaisesRegex(OSError, "scene.json"):
            self.unpacked.create()


class ExportTest(FmuTest):
    def test_the_description_lists_all_variables(self):
        file = self.export()
        root = ElementTree.fromstring(zipfile.ZipFile(file).read("modelDescription.xml"))
        found = {one.get("valueReference"): one for one in root.find("ModelVariables")}
        self.assertEqual([found[str(k)].get("name") for k in range(len(NAMES))], NAMES)
        self.assertEqual(root.get("modelName"), "arm")
        self.assertEqual(found["2"].get("causality"), "parameter")
        self.assertEqual(float(found["2"].get("start")), 1.2)

    def test_equal_mechanisms_give_equal_files(self):
        first = self.export().read_bytes()
        self.assertEqual(self.export().read_bytes(), first)

    def test_what_an_fmu_cannot_do_is_refused(self):
        m = arm()
        m.force("wind", ["arm"], force=lambda t, q, v: -v)
        with self.assertRaisesRegex(ValueError, "cannot contain functions: wind.force"):
            self.export(m)
        other = baum.Mechanism()
        other.input("force")
        other.input("torque")
        for kind, text, given in (
            (TypeError, "cannot have the option max_steps", dict(step=1e-3, max_steps=3)),
            (TypeError, "no option", dict(step=1e-3, stride=1)),
            (baum.Error, "step", dict(rtol=1e-8, step=1e-3)),
            (KeyError, "no channel", dict(step=1e-3, outputs=["arm.poses"])),
            (KeyError, "no input", dict(step=1e-3, inputs=["force"])),
            (KeyError, "no input", dict(step=1e-3, inputs=[other["force"]])),
            (ValueError, '"torque" belongs to another mechanism', dict(step=1e-3, inputs=[other["torque"]])),
            (ValueError, 'the name "arm.mass"', dict(step=1e-3, parameters=["arm.mass"] * 2)),
            (ValueError, 'the name "torque"', dict(step=1e-3, inputs=["torque"] * 2)),
            (ValueError, "max_step is inf", dict(rtol=1e-6, max_step=float("inf"))),
            (ValueError, "field of numbers; there are: mass, .*'mass'", dict(step=1e-3, parameters=["arm.masss"])),
            (ValueError, "field of numbers", dict(step=1e-3, parameters=["torque.initial"])),
            (ValueError, "field of numbers", dict(step=1e-3, parameters=["pin.body_a"])),
        ):
            with self.assertRaisesRegex(kind, text):
                self.export(None, "rk8", **given)
        m = arm()
        m.input("a\ufffe")
        with self.assertRaisesRegex(ValueError, "has a character that XML does not allow"):
            self.export(m, "rk8", step=1e-3)
        self.assertFalse((self.folder / "arm.fmu").exists())

    def test_orientations_that_an_element_needs_are_no_parameters(self):
        m = baum.Mechanism()
        m.spatial_body("b", mass=1, inertia=(1, 1, 1))
        self.export(m.copy(), step=1e-3, outputs=["energy"], parameters=["b.orientation"])
        m.spatial_torsion_spring("s", "ground", "b", point=(0, 0, 0), stiffness=1)
        with self.assertRaisesRegex(ValueError, 'force "s" keeps the relative orientation'):
            self.export(m, step=1e-3, outputs=["energy"], parameters=["b.orientation"])


@unittest.skipUnless(HAS_FMPY, "FMPy is missing: pip install fmpy")
class FmpyTest(FmuTest):
    def test_the_validator_finds_no_problems(self):
        from fmpy.validation import validate_fmu

        for method, options in (("rk8", {"step": 1e-3}), ("ida", {"rtol": 1e-8})):
            self.assertEqual(validate_fmu(str(self.export(None, method, **options))), [])

    def test_a_simulation_equals_the_run(self):
        import fmpy

        start = {"arm.mass": 2.0, "torque": 0.25}
        found = fmpy.simulate_fmu(
            str(self.export()), stop_time=1.0, output_interval=0.01, start_values=start
        )
        m = arm().copy(arm=dict(mass=2.0), torque=dict(initial=0.25)).freeze()
        run = m.simulate(found["time"], "rk8", step=1e-3, record=OUTPUTS)
        for name, values in run.to_dict().items():
            if name in NAMES:
                np.testing.assert_array_equal(found[name], values)

    def test_a_closed_loop_equals_the_loop_in_python(self):
        import fmpy
        from fmpy.fmi3 import FMU3Slave

        file = str(self.export())
        model = fmpy.read_model_description(file)
        folder = fmpy.extract(file, self.folder / "arm")
        fmu = FMU3Slave(
            guid=model.guid, unzipDirectory=str(folder), modelIdentifier="baum_fmu"
        )
        fmu.instantiate()
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        rows = []
        for k in range(100):
            fmu.setFloat64([TORQUE], [control(*fmu.getFloat64([FIRST, FIRST + 1]))])
            fmu.doStep(k * PERIOD, PERIOD)
            rows.append(fmu.getFloat64(list(range(FIRST, len(NAMES)))))
        fmu.terminate()
        fmu.freeInstance()
        wanted = loop_in_python(arm(), 100, "rk8", step=1e-3)
        # FMPy only calls the functions of the FMU, so all digits are the same.
        np.testing.assert_array_equal(rows, wanted)


if __name__ == "__main__":
    unittest.main()
