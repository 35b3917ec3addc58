# SPDX-License-Identifier: BSD-3-Clause
"""Tests that signatures show the defaults of the library, that type hints list all strings that the
library accepts, and that everything public has a docstring with working examples."""

import ast
import ctypes
import doctest
import enum
import importlib
import inspect
import math
import typing
import unittest
from pathlib import Path

import numpy as np

import baum
import baum.typing
from baum import _abi, _lib
from baum.adding import Adding
from baum.adding_space import AddingInSpace
from baum.definitions import ARGUMENTS, COORDINATES, HIDDEN, KINDS
from baum.integrators import FORMULATIONS
from baum.simulation import CONVERT, SOLVERS, STARTS
from baum.studies import COSTS

PACKAGE = Path(baum.__file__).parent


def shown(function):
    """Return the defaults that a signature shows, by name."""
    return {
        parameter.name: parameter.default
        for parameter in inspect.signature(function).parameters.values()
        if parameter.default is not None and parameter.default is not parameter.empty
    }


def methods():
    """Yield the methods that add an element, for each kind."""
    for name, method in [*vars(Adding).items(), *vars(AddingInSpace).items()]:
        if not name.startswith("_") and name != "input":
            names = name, f"planar_{name}", f"spatial_{name}", f"user_{name}"
            kinds = [kind for kind in names if kind in KINDS]
            yield {"constraint": "user_constraint"}.get(name, kinds[0]), method


class Defaults(unittest.TestCase):
    def compare(self, function, struct, words=()):
        """Test that every default in a signature is the library's default. If the library has a
        default for a number or a truth value, the signature must show it, unless the argument is
        required."""
        of_library = _lib.default(struct)
        defaults = shown(function)
        for name, kind in struct._fields_:
            value, argument = getattr(of_library, name), ARGUMENTS.get(name, name)
            if argument.startswith("coordinate"):
                value = list(COORDINATES)[value]
            elif argument in words:
                value = {v: k for k, v in words[argument].items()}[value]
            elif isinstance(value, ctypes.Array):
                value = tuple(value)
            with self.subTest(function=function.__name__, argument=argument):
                if argument in defaults:
                    self.assertEqual(defaults.pop(argument), value)
                elif kind in (ctypes.c_double, ctypes.c_bool):
                    self.assertTrue(self.is_needed(function, argument) or math.isnan(value))
        return defaults

    def is_needed(self, function, name):
        parameter = inspect.signature(function).parameters.get(name)
        return parameter is not None and parameter.default is parameter.empty

    def test_of_elements(self):
        found = dict(methods())
        self.assertEqual(set(found), set(KINDS))
        for name, method in found.items():
            self.assertEqual(self.compare(method, KINDS[name].struct), {})

    def test_of_mechanisms_and_inputs(self):
        address = ctypes.c_void_p()
        self.assertEqual(_lib.lib.baum_mechanism_create(ctypes.byref(address)), 0)
        gravity = np.empty(3)
        _lib.lib.baum_mechanism_get_gravity(address, gravity.ctypes.data)
        _lib.lib.baum_mechanism_destroy(address)
        self.assertEqual((*shown(baum.Mechanism)["gravity"], 0.0), tuple(gravity))
        self.assertEqual(shown(baum.Mechanism.input), {"initial": 0.0})

    def test_of_runs(self):
        words = {"formulation": FORMULATIONS, "start": STARTS, "solver": SOLVERS}
        left = self.compare(baum.Simulation, _abi.baum_simulation_options, words)
        self.assertEqual(left, {})
        self.compare(baum.Simulation.event, _abi.baum_event_def)

    def test_of_studies(self):
        left = self.compare(baum.Study, _abi.baum_study_options)
        self.assertEqual(left, {"unit": 1.0, "grid": "quick"})
        words = {"formulation": FORMULATIONS}
        left = self.compare(baum.Study.add_standard, _abi.baum_study_grid, words)
        self.assertEqual(left, {})

    def test_simulate_shows_the_options_of_a_run(self):
        options = set(inspect.signature(baum.Simulation).parameters) - {"mechanism"}
        for method in baum.Mechanism.simulate, baum.Mechanism.simulation:
            parameters = inspect.signature(method).parameters
            self.assertEqual(set(parameters) - {"self", "times", "record"}, options)
            self.assertEqual(parameters["max_steps"].default, 10**9)


class Types(unittest.TestCase):
    def test_options_have_types(self):
        options = set(inspect.signature(baum.Simulation).parameters) - {"mechanism", "integrator"}
        self.assertEqual(set(baum.typing.SimulationOptions.__annotations__), options)
        setting = set(baum.typing.SettingOptions.__annotations__)
        self.assertEqual(options - setting, {"progress", "progress_interval", "row_gains"})
        self.assertEqual(set(CONVERT), options - {"progress", "row_gains"})
        fields = {name for name, _ in _abi.baum_simulation_options._fields_}
        self.assertEqual(fields - options, {"struct_size", "integrator", "user", "row_gain_count"})

    def test_words_are_those_of_the_library(self):
        for words, known in (
            (baum.typing.Formulation, FORMULATIONS),
            (baum.typing.Start, STARTS),
            (baum.typing.Solver, SOLVERS),
            (baum.typing.Cost, COSTS),
        ):
            self.assertEqual(set(typing.get_args(words)), set(known))

    def test_statuses_and_warnings_are_those_of_the_library(self):
        known = {one.name[len("BAUM_"):]: one.value for one in _abi.baum_status}
        self.assertEqual({one.name: one.value for one in baum.Status}, known)
        for code in _abi.baum_warning_code:
            words = code.name[len("BAUM_WARNING_"):].split("_")
            kind = getattr(baum, "".join(map(str.capitalize, words)) + "Warning")
            self.assertEqual(kind.code, code)
            doubts = code >= _abi.baum_warning_code.BAUM_WARNING_BRANCH
            self.assertEqual(issubclass(kind, baum.DoubtWarning), doubts)
            self.assertIn(kind.__name__, baum.__all__)

    def test_the_package_says_that_it_is_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_the_oldest_python_can_read_it(self):
        for path in PACKAGE.glob("*.py"):
            ast.parse(path.read_text(encoding="utf-8"), feature_version=(3, 9))


class Described(unittest.TestCase):
    """Tests that everything which a user can call has a docstring and complete types."""

    def public(self):
        from baum import catalog

        for module in baum, catalog:
            names = getattr(module, "__all__", [n for n in vars(module) if not n.startswith("_")])
            for name in names:
                one = getattr(module, name)
                if not getattr(one, "__module__", "").startswith("baum"):
                    continue
                yield name, one
                for inner, method in vars(one).items() if isinstance(one, type) else ():
                    if inner.startswith("_") or isinstance(method, enum.IntEnum):
                        continue
                    if callable(method) or isinstance(method, property):
                        yield f"{name}.{inner}", method

    def test_everything_public_has_a_docstring(self):
        for name, one in self.public():
            with self.subTest(name):
                text = one.__doc__ if isinstance(one, type) else inspect.getdoc(one)
                self.assertTrue(text or isinstance(one, baum.Channel))

    def test_docstrings_name_nothing_of_c(self):
        for name, one in self.public():
            with self.subTest(name):
                self.assertNotRegex(inspect.getdoc(one) or "", r"baum_\w|BAUM_|\.h\b|NULL|struct")

    def test_examples_in_docstrings_print_what_they_show(self):
        tried = 0
        for path in sorted(PACKAGE.glob("*.py")):
            if ">>>" in path.read_text(encoding="utf-8"):
                results = doctest.testmod(importlib.import_module(f"baum.{path.stem}"))
                self.assertEqual(results.failed, 0)
                tried += results.attempted
        self.assertGreater(tried, 0)

    def test_all_arguments_and_results_have_types(self):
        for path in sorted(PACKAGE.glob("*.py")):
            for one in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(one, ast.FunctionDef):
                    with self.subTest(f"{path.name}: {one.name}"):
                        self.assertIsNotNone(one.returns)


if __name__ == "__main__":
    unittest.main()
