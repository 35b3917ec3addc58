# SPDX-License-Identifier: BSD-3-Clause
"""Tests scenes: mechanisms are written, read, compared and pickled, also by commands."""

import contextlib
import io
import json
import pickle
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import baum
from baum.__main__ import main


def circle(t, q):
    return q @ q - 1.0


def drag(t, q, v, throttle):
    return -throttle * v


def pendulum():
    m = baum.Mechanism(gravity=(0.1, -9.81))
    throttle = m.input("throttle", 0.3)
    bob = m.planar_particle("bob", mass=1.0 / 3.0, position=(1, 0), outline=baum.Circle(0.1))
    m.constraint("circle", [bob], rows=1, phi=circle)
    m.force("wind", [bob], force=drag, inputs=[throttle])
    m.add_break_times([0.5])
    return m


def crank():
    m = baum.Mechanism()
    m.planar_body("crank", mass=1, inertia=0.1)
    m.revolute("A", "ground", "crank", point=(0, 0))
    return m


def call(*arguments):
    """Run a command, and return its exit code, its standard output and its standard error."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main([str(argument) for argument in arguments])
    return code, out.getvalue(), err.getvalue()


class FileTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "scene.json"


class SceneTest(FileTest):
    def test_a_file_gives_the_same_motion_bit_for_bit(self):
        m = pendulum()
        m.save(self.path)
        back = baum.load(self.path, globals())
        self.assertEqual(back, m)
        self.assertFalse(back != m)
        times = np.linspace(0, 1, 11)
        runs = [x.freeze().simulate(times, "rk8", rtol=1e-9) for x in (m, back)]
        np.testing.assert_array_equal(runs[0].q, runs[1].q)

    def test_elements_with_equal_names_are_all_there(self):
        """C programs can give several elements the same name."""
        text = """{"baum_scene": 1, "gravity": [0, 0, 0],
            "bodies": [{"kind": "planar_body", "name": "a"}, {"kind": "planar_body", "name": "b"}],
            "forces": [{"kind": "user_force", "name": "b", "bodies": ["a"], "force": "first"},
                       {"kind": "user_force", "name": "b", "bodies": ["b"], "force": "second"}]}"""
        given = {"first": lambda t, q, v: (1, 0, 0), "second": lambda t, q, v: (2, 0, 0)}
        m = baum.parse(text, given)
        self.assertEqual([one.name for one in m], ["a", "b", "b (2)", "b (3)"])
        self.assertEqual(m.function_names(), ["b (2).force", "b (3).force"])
        run = m.freeze().simulate([0, 1], "rk8", step=0.1)
        np.testing.assert_allclose(run.v[-1], [1, 0, 0, 2, 0, 0], atol=1e-14)  # rounding errors
        other = baum.parse(text.replace('"second"', '"third"'), given | {"third": circle})
        self.assertEqual(m.difference(other), "b (3): force b (3).force -> circle")

    def test_parameters_of_an_fmu_need_a_unique_name(self):
        text = crank().scene().replace('"name": "A"', '"name": "crank"')
        m = baum.parse(text)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "a.fmu"
            with self.assertRaisesRegex(ValueError, "several elements .* 'crank .2.'"):
                m.export_fmu(
                    file, "rk4", step=0.1, outputs=["energy"], parameters=["crank (2).point"]
                )

    def test_texts_that_python_cannot_read_are_refused_by_the_library(self):
        for text in ("[" * 100000, '{"a": ' * 100000):
            with self.assertRaisesRegex(baum.Error, "line 1: brackets are nested too deeply"):
                baum.parse(text)
        unnamed = pendulum().scene({"wind": drag}).replace('"wind(0)"', '""')
        with self.assertRaisesRegex(baum.Error, '"force" is the function ""'):
            baum.parse(unnamed, globals())
        self.path.write_text("\ufeff" + pendulum().scene(), encoding="utf-8")
        self.assertEqual(baum.load(self.path, globals()), pendulum())
        self.path.write_text(crank().scene(), encoding="utf-16")
        with self.assertRaisesRegex(ValueError, "scene.json: 'utf-8' codec"):
            baum.load(self.path)

    def test_messages_about_a_file_begin_with_its_path(self):
        self.path.write_text('{"baum_scene": 1,\n "bodis": []}')
        with self.assertRaises(baum.Error) as caught:
            baum.load(self.path)
        self.assertTrue(str(caught.exception).startswith(f"{self.path}: line 2: "), caught.exception)

    def test_functions_get_the_names_that_are_given(self):
        text = pendulum().scene({"friction": drag})
        self.assertIn('"force": "friction(0)"', text)
        self.assertIn('"phi": "circle"', text)
        back = baum.parse(text, {"friction": drag, "circle": circle})
        self.assertEqual(back, pendulum())

    def test_functions_without_a_name_are_named_by_their_element(self):
        m = baum.Mechanism()
        for name in ("a", "b"):
            m.planar_particle(name, position=(1, 0))
            m.constraint(f"on {name}", [name], rows=1, phi=lambda t, q: q @ q - 1)
        text = m.scene()
        self.assertIn('"phi": "on a.phi"', text)
        self.assertIn('"phi": "on b.phi"', text)

    def test_two_functions_of_the_same_name_are_kept_apart(self):
        def make(radius):
            def phi(t, q):
                return q @ q - radius

            return phi

        m = baum.Mechanism()
        functions = [make(1.0), make(4.0)]
        for k, function in enumerate(functions):
            m.planar_particle(f"p{k}", position=(k + 1, 0))
            m.constraint(f"c{k}", [f"p{k}"], rows=1, phi=function)
        back = baum.parse(m.scene(), {"phi": functions[0], "c1.phi": functions[1]})
        self.assertEqual(back, m)
        self.assertNotEqual(baum.parse(m.scene(), {"phi": functions[1], "c1.phi": functions[0]}), m)

    def test_a_missing_function_is_named(self):
        with self.assertRaisesRegex(KeyError, "circle: phi is 'circle'.*give functions="):
            baum.parse(pendulum().scene())

    def test_a_wrong_text_is_refused_with_its_line(self):
        with self.assertRaisesRegex(baum.Error, 'line 2: a planar_body has no field "masss"; did you mean "mass"'):
            baum.parse(
                '{"baum_scene": 1, "bodies": [\n{"kind": "planar_body", "masss": 1}]}'
            )
        for text in ("", "[]", "3", "{", '{"bodies": 3}', '{"bodies": [[]]}'):
            with self.assertRaises(baum.Error):
                baum.parse(text)

    def test_a_note_on_units_is_ignored(self):
        text = crank().scene(units="mm, t, s")
        self.assertIn('"units": "mm, t, s"', text)
        self.assertEqual(baum.parse(text).scene(), crank().scene())
        with self.assertRaisesRegex(TypeError, "units: a text is wanted, not 5"):
            crank().scene(units=5)
        with self.assertRaisesRegex(ValueError, "units: .* contains characters"):
            crank().scene(units="m\0")
        with self.assertRaisesRegex(baum.Error, 'line 3: "units" is a number, must be a text'):
            baum.parse(text.replace('"mm, t, s"', "3"))

    def test_differences_are_named(self):
        a, b = crank(), crank()
        self.assertEqual(a.difference(b), "")
        b["crank"].set(mass=2)
        b.planar_particle("more")
        b.gravity = (0, 0)
        self.assertNotEqual(a, b)
        self.assertEqual(
            a.difference(b).split("\n"),
            [
                "mechanism: gravity [0, -9.81, 0] -> [0, 0, 0]",
                "crank: mass default -> 2",
                "more: only in the second",
            ],
        )

    def test_a_mechanism_is_not_equal_to_something_else(self):
        self.assertNotEqual(crank(), 3)
        self.assertEqual(len({crank(), crank()}), 2)

    def test_mechanisms_and_their_functions_are_pickled(self):
        for m in (pendulum(), crank().freeze()):
            back = pickle.loads(pickle.dumps(m))
            self.assertEqual(back, m)
            self.assertEqual(back.frozen, m.frozen)

    def test_handles_are_pickled_with_their_mechanism(self):
        m, bob = pickle.loads(pickle.dumps((m := pendulum(), m["bob"])))
        self.assertIs(bob.mechanism, m)
        self.assertEqual(bob, m["bob"])

    def test_a_run_with_functions_carries_its_scene(self):
        m = pendulum().freeze()
        back = pickle.loads(pickle.dumps(m.simulate([0, 0.1], "rk8", rtol=1e-8)))
        self.assertIsNone(back.mechanism)
        self.assertEqual(baum.parse(back.scene, globals()), m)
        with self.assertRaisesRegex(ValueError, "a mechanism that has functions"):
            back.figure(0.05)

    def test_addresses_are_not_pickled(self):
        m = baum.Mechanism()
        m.planar_particle("a", position=(1, 0))
        m.constraint("c", ["a"], rows=1, phi=12345678)
        with self.assertRaisesRegex(TypeError, "c.phi: a function given by its address"):
            pickle.dumps(m)

    @unittest.skipUnless(hasattr(baum, "catalog"), "the catalogue is missing")
    def test_a_mechanism_of_the_library_is_written(self):
        m = baum.catalog.build("slider_crank")
        self.assertEqual(baum.parse(m.scene()), m)


def problems(value, schema, whole):
    """List where a value violates a schema. Supports only those parts of JSON Schema that the
    schema of scenes uses."""
    if "$ref" in schema:
        schema = {**whole["$defs"][schema["$ref"].split("/")[-1]], "$ref": None}
    if "oneOf" in schema:
        fits = [not problems(value, one, whole) for one in schema["oneOf"]]
        return [] if sum(fits) == 1 else [f"{value} fits {sum(fits)} kinds"]
    types = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None),
             "integer": int, "number": (int, float)}  # fmt: skip
    wanted = schema.get("type", list(types))
    wanted = [wanted] if isinstance(wanted, str) else wanted
    found = []
    if not any(isinstance(value, types[one]) for one in wanted):
        found.append(f"{value} is not {wanted}")
    if "const" in schema and value != schema["const"]:
        found.append(f"{value} is not {schema['const']}")
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{value} is not one of {schema['enum']}")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{value} has a wrong length")
        for one in value:
            found += problems(one, schema.get("items", {}), whole)
    if isinstance(value, dict):
        found += [f"{key} is missing" for key in schema.get("required", ()) if key not in value]
        known = schema.get("properties", dict.fromkeys(value, {}))
        found += [f"{key} is unknown" for key in value if key not in known]
        for key in set(value) & set(known):
            found += problems(value[key], known[key], whole)
    return found


class SchemaTest(unittest.TestCase):
    ROOT = Path(__file__).parents[2]

    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads((cls.ROOT / "docs" / "scene.schema.json").read_text())

    def problems(self, text):
        """List the violations in a scene. If jsonschema is installed, it must agree."""
        found = problems(json.loads(text), self.schema, self.schema)
        try:
            import jsonschema
        except ImportError:
            return found
        validator = jsonschema.Draft202012Validator(self.schema)
        self.assertEqual(validator.is_valid(json.loads(text)), not found, found)
        return found

    def test_generating_it_again_changes_nothing(self):
        tool = self.ROOT / "bindings" / "python" / "tools" / "generate_schema.py"
        subprocess.run([sys.executable, str(tool), "--check"], check=True)

    @unittest.skipUnless(hasattr(baum, "catalog"), "the catalogue is missing")
    def test_all_mechanisms_of_the_library_are_valid(self):
        for entry in baum.catalog.entries():
            text = baum.catalog.build(entry.name).scene()
            self.assertEqual(self.problems(text), [], entry.name)

    def test_functions_outlines_and_units_are_valid(self):
        self.assertEqual(self.problems(pendulum().scene(units="m, kg, s")), [])
        m = crank()
        m["crank"].outline = [baum.Circle(0.1), [(0, 0), (1, 0), (0, 1)]]
        self.assertEqual(self.problems(m.scene()), [])

    def test_wrong_scenes_are_not_valid(self):
        for old, new in (
            ('"baum_scene": 1', '"baum_scene": 2'),
            ('"inertia": 0.1', '"inertia": "0.1"'),
            ('"inertia": 0.1', '"inertias": 0.1'),
            ("planar_revolute", "planar_revolut"),
            ('"point": [0, 0]', '"point": [0]'),
            ('"body_b": "crank"', '"body_b": -1.5'),
        ):
            text = crank().scene()
            self.assertIn(old, text)
            self.assertTrue(self.problems(text.replace(old, new)), new)


class CommandTest(FileTest):
    def setUp(self):
        super().setUp()
        crank().save(self.path)
        self.out = self.path.with_name

    def test_run_writes_samples_and_a_page(self):
        csv, page = self.out("run.csv"), self.out("run.html")
        code, out, err = call(
            "run", self.path, "--method", "rk8", "--rtol", 1e-9, "--until", 0.5, "--samples", 6,
            "--record", "energy", "--out", csv, "--page", page,
        )  # fmt: skip
        self.assertEqual((code, err), (0, ""))
        self.assertIn("rk8", out)
        lines = csv.read_text().split("\n")
        self.assertTrue(lines[0].startswith("t,q[0],q[1],q[2],v[0]"))
        self.assertEqual(len(lines), 8)
        self.assertIn("<html", page.read_text()[:500].lower())

    def test_results_are_kept_if_the_run_or_the_writing_fails(self):
        m = baum.Mechanism(gravity=(0, 0))  # the rod of 0.5 m is shorter than the crank of 1 m
        for name, x in (("crank", 0.5), ("rod", 1.25), ("slider", 1.5)):
            m.planar_body(name, mass=1, inertia=0.1, position=(x, 0))
        m.revolute("A", "ground", "crank", point=(0, 0))
        m.revolute("B", "crank", "rod", point=(1, 0))
        m.revolute("C", "rod", "slider", point=(1.5, 0))
        m.translational("D", "ground", "slider", point=(1.5, 0), axis=(1, 0))
        m.driver("motor", "A", rate=1)
        m.save(self.path)
        csv, page = self.out("run.csv"), self.out("run.html")
        given = ["run", self.path, "--method", "rk4", "--step", 1e-3, "--samples", 11]
        code, out, err = call(*given, "--out", csv, "--page", page)
        self.assertEqual(code, 1)
        self.assertIn("does not converge", err)
        self.assertEqual(csv.read_text().split("\n")[-2].split(",")[0], "0.5")  # it locks at 0.52 s
        self.assertTrue(page.exists())
        code, out, err = call("study", self.path, "--until", 0.1, "--page", self.out("no") / "a.csv")
        self.assertEqual(code, 1)
        self.assertIn("cheapest", out)

    def test_functions_come_from_a_file(self):
        pendulum().save(self.path)
        code, out, err = call("check", self.path)
        self.assertEqual(code, 1)
        self.assertIn("circle: phi is 'circle'", err)
        code, out, err = call("check", self.path, "--functions", __file__)
        self.assertEqual((code, err), (0, ""))

    def test_mobility_and_drawing_are_printed(self):
        self.assertIn("1 degree of freedom", call("mobility", self.path)[1])
        self.assertIn("<svg", call("draw", self.path)[1])
        self.assertEqual(call("draw", self.path, "--assembled", "--out", self.out("a.svg"))[0], 0)

    def test_a_study_is_printed(self):
        code, out, err = call("study", self.path, "--until", 0.1, "--page", self.out("a.html"))
        self.assertEqual((code, err), (0, ""))
        self.assertIn("rk8", out)

    def test_errors_are_messages(self):
        code, out, err = call("mobility", self.out("missing.json"))
        self.assertEqual(code, 1)
        self.assertIn("missing.json", err)
        self.assertNotIn("Traceback", err)
        code, out, err = call("run", self.path, "--method", "rk8", "--rtol", 1e-9, "--samples", 1)
        self.assertEqual(code, 1)
        self.assertIn("--samples is 1, must be at least 2", err)

    def test_a_run_without_a_method_is_refused(self):
        err = io.StringIO()
        with contextlib.redirect_stderr(err), self.assertRaises(SystemExit):
            main(["run", str(self.path)])
        self.assertIn("required: --method", err.getvalue())


if __name__ == "__main__":
    unittest.main()
