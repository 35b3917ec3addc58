# SPDX-License-Identifier: BSD-3-Clause
"""Speed against accuracy: many runs of one mechanism, what each costs, and which one to take."""

import ctypes
import os
from collections import namedtuple

import numpy as np

from . import _abi, _calls
from ._lib import default, lib
from ._values import address, integer, number, numbers, truth, vector
from .channels import Channel
from .errors import Status, Warning, as_status, warn
from .gains import Gains
from .integrators import FORMULATIONS, lookup, names
from .progress import Line, stream
from .simulation import SOLVERS, STARTS, _row_gains, make_options

COSTS = names(_abi.baum_study_cost, "BAUM_STUDY_")
FORMS = names(_abi.baum_report_form, "BAUM_REPORT_")
SUFFIXES = {".txt": "text", ".csv": "csv", ".json": "json", ".html": "page"}
WHY_SIZE = 2048


def _swap(words):
    return {value: word for word, value in words.items()}


def _record(name, struct, doc):
    made = namedtuple(name, [field for field, _ in struct._fields_[1:]])
    made.__doc__ = doc
    return made


StudyEntry = _record(
    "StudyEntry",
    _abi.baum_study_entry,
    """What a setting costs and how exact it is; see baum_study_entry in study.h. Integrator,
formulation, gains and state are words or objects of this package, NaN is not known.""",
)
StudyMethod = _record(
    "StudyMethod",
    _abi.baum_study_method,
    """Entries with the same integrator, formulation and gains; see baum_study_method in study.h.""",
)
StudyReference = _record(
    "StudyReference",
    _abi.baum_study_reference,
    """How far the reference of a study can be trusted; see baum_study_reference in study.h.""",
)


class Recommendation(dict):
    """Keyword options for Mechanism.simulate() and simulation(): m.simulate(t, **best). `why` is a
    message with what was measured."""

    def __init__(self, options, why):
        super().__init__(options)
        self.why = why


# ---- from the library ----------------------------------------------------------------------------

GAINS = {
    "fixed": ("alpha", "beta"),
    "scaled": ("alpha_h", "beta2_h2"),
    "taylor": (),
    "frequency": ("hertz", "damping_ratio"),
    "deadbeat": (),
    "auto": (),
    "best_damping": (),
}
RULES = _swap(names(_abi.baum_gain_rule, "BAUM_GAINS_"))


def _gains(struct):
    """The Gains of a struct; None for the rule of the integrator."""
    rule = RULES[struct.rule]
    if rule == "default":
        return None
    return Gains(rule, **dict(zip(GAINS[rule], struct.value)))


def _value(name, value):
    """A field of a struct as this package has it."""
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    if name == "integrator":
        return lib.baum_integrator_name(value).decode()
    if name == "formulation":
        return _swap(FORMULATIONS)[value]
    if name == "gains":
        return _gains(value)
    if name == "state":
        return lib.baum_study_state_name(value).decode()
    if name == "origin":
        return _swap(names(_abi.baum_study_origin, "BAUM_STUDY_"))[value]
    return as_status(value) if name == "status" else value


def _cost(word):
    if word not in COSTS:
        raise ValueError(f"no cost {word!r}; there are: {', '.join(COSTS)}")
    return COSTS[word]


# ---- studies -------------------------------------------------------------------------------------


class Study:
    """Many runs of one frozen mechanism from t0 to t1 [s].

        best = baum.study(m, 0, 2).run().recommend(1e-6)
        print(best.why)
        run = m.simulate(t, **best)

    error: channels or their names whose largest difference from the reference, over `unit`, is what
        error means; left out all positions, lengths by the scale and angles in radians.
    reference: (times, q), (times, q, v) or (times, q, v, lambda_) with a sample a line, or
        solution(t), which returns (q, v) or (q, v, lambda_), in place of the study's own; `digits`
        says how far it can be trusted.
    samples, repeats, entry_limit [s of CPU time], time_budget [s of wall time], energy_account,
        validate, file: see baum_study_options in study.h. threads: left out as many as there are
        processors, but one for a mechanism with functions of Python.
    grid: what run() adds to a study without settings: "quick", which takes about a minute where
        functions of Python are called and seconds otherwise, or "full", about 25 times as long.
    progress: left out, a line with an estimate of the time left where somebody watches, in a terminal
        or a notebook; False: nothing. progress(done, total) is called after entries, of which timed ones
        count twice, and cancels when it returns something true; of the study it can use cancel() and
        len() alone.
    """

    def __init__(self, mechanism, t0, t1, *, error=None, unit=1.0, reference=None, solution=None,
                 digits=None, progress=None, threads=None, file=None, grid="quick", **options):
        self.mechanism = mechanism
        if grid not in ("quick", "full"):
            raise ValueError(f'no grid {grid!r}; there are: quick, full')
        if not (progress is None or progress is False or callable(progress)):
            raise TypeError(f"progress: a function or False is wanted, not {progress!r}")
        self._quick = grid == "quick"
        self._progress = progress
        out = ctypes.c_void_p()
        _calls.make(lib.baum_study_create, mechanism.handle, number(t0, "t0"), number(t1, "t1"),
                    ctypes.byref(out))
        self._owner = _calls.Handle(out.value, lib.baum_study_destroy, "study")
        self._error = None
        self._keep = []
        if threads is None:
            threads = 1 if mechanism.has_python else os.cpu_count() or 1
        self._set_options(file, dict(options, threads=threads))
        if error is not None:
            self._set_error(error, unit)
        if (reference is None and solution is None) != (digits is None):
            raise TypeError("reference or solution and digits, which says how many of its digits "
                            "can be trusted, go together")
        if reference is not None:
            self._set_reference(reference, number(digits, "digits"))
        if solution is not None:
            self._set_solution(solution, number(digits, "digits"))

    def __repr__(self):
        return f"<study of {len(self)} entries>"

    def __len__(self):
        return lib.baum_study_entry_count(self._owner._address)

    # ---- what is studied -------------------------------------------------------------------------

    def _set_options(self, file, values):
        struct = default(_abi.baum_study_options)
        whole = {"samples", "threads", "repeats"}
        for name, value in values.items():
            if name not in whole | {"entry_limit", "time_budget", "energy_account", "validate"}:
                raise TypeError(f"a study has no option {name!r}")
            if name in whole:
                value = integer(value, name)
            setattr(struct, name, value)
        struct.file = None if file is None else os.fsencode(file)
        struct.progress = self._hold(_abi.baum_study_progress_fn, self._call_progress)
        self._owner.call(lib.baum_study_set_options, ctypes.byref(struct))

    def _hold(self, kind, function):
        """A function of the library that lives as long as the study."""
        self._keep.append(kind(function))
        return self._keep[-1]

    def _call_progress(self, study, done, total, user):
        try:
            return int(bool(self._progress and self._progress(done, total)))
        except BaseException as error:
            self._error = error
            return 1

    def _set_error(self, error, unit):
        error = [error] if isinstance(error, (str, Channel)) else error
        structs = [self.mechanism.channel(channel).struct for channel in error]
        channels = (_abi.baum_channel * len(structs))(*structs)
        self._owner.call(lib.baum_study_set_error, channels, len(structs), number(unit, "unit"))

    def _set_reference(self, reference, digits):
        times, *parts = reference
        times = vector(np.atleast_1d(times), None, "reference: times")
        sizes = self.mechanism.sizes
        arrays = []
        for part, size, label in zip(parts, sizes, ("q", "v", "lambda_")):
            if part is not None:
                part = np.asarray(part, dtype=float).reshape(-1)
                part = vector(part, len(times) * size, f"reference: {label}")
            arrays.append(part)
        arrays += [None] * (3 - len(arrays))
        self._owner.call(lib.baum_study_set_reference, address(times), len(times),
                         *map(address, arrays), digits)

    def _set_solution(self, solution, digits):
        sizes = self.mechanism.sizes

        def call(t, q, v, lambda_, user):
            try:
                for place, size, part in zip((q, v, lambda_), sizes, solution(t)):
                    if part is not None:
                        room = (ctypes.c_double * size).from_address(place)
                        room[:] = vector(part, size, "solution").tolist()
                return 0
            except BaseException as error:
                self._error = error
                return -1

        function = self._hold(_abi.baum_study_solution_fn, call)
        self._owner.call(lib.baum_study_set_solution, function, None, digits)

    # ---- settings --------------------------------------------------------------------------------

    def add(self, integrator, *, row_gains=None, **options):
        """Add one setting, with the options of Simulation. Returns the study."""
        struct = make_options(integrator, options)
        if row_gains is not None:
            factors = _row_gains(self.mechanism, row_gains)
            struct.row_gains = factors.ctypes.data
            struct.row_gain_count = len(factors)
        self._owner.call(lib.baum_study_add, ctypes.byref(struct))
        return self

    def add_standard(self, integrator=None, formulation="default", **grid):
        """Add the full standard grid, or with quick=True the quick one, or what of it is of one
        integrator or formulation; settings, constants, coarsest [s], finest: see baum_study_grid in
        study.h. Returns the study."""
        struct = default(_abi.baum_study_grid)
        if integrator is not None:
            struct.integrator = lookup(integrator).address
        if formulation not in FORMULATIONS:
            raise ValueError(f"no formulation {formulation!r}; there are: {', '.join(FORMULATIONS)}")
        struct.formulation = FORMULATIONS[formulation]
        for name, value in grid.items():
            if name not in ("settings", "constants", "coarsest", "finest", "quick"):
                raise TypeError(f"the standard grid has no option {name!r}")
            setattr(struct, name, truth(value, name) if name == "quick" else value)
        self._long(lib.baum_study_add_standard, ctypes.byref(struct))
        return self

    def add_stress(self, integrator=None):
        """Add stress settings of all integrators or of one: extreme steps, tolerances and gains; see
        baum_study_add_stress() in study.h. Returns the study."""
        address = None if integrator is None else lookup(integrator).address
        self._long(lib.baum_study_add_stress, address)
        return self

    # ---- running ---------------------------------------------------------------------------------

    def run(self):
        """Make the reference and run the entries that are not done; without any the grid of the study
        is added first. A reference that is not to be trusted, and a budget that is spent, are Python
        warnings. Where a function of the mechanism raises, the entry fails, and its message tells
        what was raised. Returns the study."""
        if len(self) == 0:
            self.add_standard(quick=self._quick)
        out = stream() if self._progress is None else None
        if out is None:
            status, message = self._long(lib.baum_study_run)
        else:
            self._progress = Line(out, [entry.method for entry in self.entries])
            try:
                status, message = self._long(lib.baum_study_run)
            finally:
                self._progress.close()
                self._progress = None
        if status != Status.OK:
            warn(Warning(message))
        return self

    def cancel(self):
        """Ask run() to stop; from any thread."""
        lib.baum_study_cancel(self._owner._address)

    def _long(self, function, *arguments):
        """A call that may take long, and its message. What a function of the user raised is raised
        here, whichever thread it was called from."""

        def call():
            return self._owner.call(function, *arguments), _calls.message()

        self._error = None
        try:
            result = _calls.interruptible(call, cancel=self.cancel)
        except Exception as failure:
            if self._error is not None:
                raise self._error from failure
            raise
        if self._error is not None:
            raise self._error
        return result

    # ---- reading ---------------------------------------------------------------------------------

    def _read(self, function, struct, made, *arguments):
        self._owner.call(function, *arguments, ctypes.byref(struct), ctypes.sizeof(struct))
        return made(*(_value(name, getattr(struct, name)) for name in made._fields))

    @property
    def entries(self):
        """All entries, in the order of adding."""
        return [
            self._read(lib.baum_study_entry_at, _abi.baum_study_entry(), StudyEntry, k)
            for k in range(len(self))
        ]

    @property
    def methods(self):
        """Methods and the price of a digit with each."""
        count = lib.baum_study_method_count(self._owner._address)
        return [
            self._read(lib.baum_study_method_at, _abi.baum_study_method(), StudyMethod, k)
            for k in range(count)
        ]

    @property
    def reference(self):
        """How far the reference can be trusted; known after run()."""
        struct = _abi.baum_study_reference()
        return self._read(lib.baum_study_reference_read, struct, StudyReference)

    def reference_samples(self):
        """The reference: times (n), q (n x nq), v (n x nv), lambda (n x nc), NaN where not known."""
        count = self.reference.samples
        times = np.empty(count)
        arrays = [np.empty((count, size)) for size in self.mechanism.sizes]
        for k in range(count):
            places = [address(part[k:]) for part in (times, *arrays)]
            self._owner.call(lib.baum_study_reference_sample, k, *places)
        return (times, *arrays)

    @property
    def error_text(self):
        """In words what error means."""
        return lib.baum_study_error_text(self._owner._address).decode(errors="replace")

    # ---- answers ---------------------------------------------------------------------------------

    def front(self, cost="work"):
        """Numbers of the entries than which none is both cheaper and more exact, from cheap to exact;
        cost is "work", the same on every machine, or "cpu"."""
        entries = (ctypes.c_int32 * max(len(self), 1))()
        count = ctypes.c_int32()
        self._owner.call(lib.baum_study_front, _cost(cost), len(self), entries, ctypes.byref(count))
        return list(entries[: count.value])

    def cost_at(self, method, error, cost="work"):
        """What the method of that number costs at an error."""
        out = ctypes.c_double()
        self._owner.call(lib.baum_study_cost_at, integer(method, "method"), number(error, "error"),
                         _cost(cost), ctypes.byref(out))
        return out.value

    def compare(self, a, b, error, cost="work"):
        """Cost of method a over that of method b at the same error."""
        out = ctypes.c_double()
        self._owner.call(lib.baum_study_compare, integer(a, "a"), integer(b, "b"),
                         number(error, "error"), _cost(cost), ctypes.byref(out))
        return out.value

    def recommend(self, error, cost="work"):
        """The cheapest setting for an error, which holds for starts nearby and twice the span too:
        a Recommendation."""
        return self._answer(lib.baum_study_recommend, number(error, "error"), _cost(cost))

    def recommend_budget(self, seconds):
        """The most exact setting for a CPU time [s] on this machine: a Recommendation."""
        return self._answer(lib.baum_study_recommend_budget, number(seconds, "seconds"))

    def _answer(self, function, *arguments):
        best = default(_abi.baum_simulation_options)
        why = ctypes.create_string_buffer(WHY_SIZE)
        status = self._owner.call(function, *arguments, ctypes.byref(best), ctypes.sizeof(best),
                                  why, WHY_SIZE)
        if status != Status.OK:
            warn(Warning(_calls.message()))
        return Recommendation(self._keywords(best), why.value.decode(errors="replace"))

    def _keywords(self, best):
        """What differs from the defaults, as keywords of Simulation."""
        plain = default(_abi.baum_simulation_options)
        found = {"integrator": _value("integrator", best.integrator)}
        words = {"formulation": FORMULATIONS, "start": STARTS, "solver": SOLVERS}
        left_out = {"struct_size", "integrator", "gains", "progress", "user", "row_gains",
                    "row_gain_count"}
        for name, _ in best._fields_:
            value = getattr(best, name)
            if name in left_out or value == getattr(plain, name) or value != value:
                continue
            found[name] = _swap(words[name])[value] if name in words else value
        gains = _gains(best.gains)
        if gains is not None:
            found["gains"] = gains
        if best.row_gains:
            found["row_gains"] = self._row_gains(numbers(best.row_gains, best.row_gain_count))
        return found

    def _row_gains(self, factors):
        joints = [element for element in self.mechanism if element.family == "joint"]
        rows = {joint.name: self.mechanism.rows(joint) for joint in joints}
        return {name: factors[place] for name, place in rows.items() if place.stop > place.start}

    # ---- reports ---------------------------------------------------------------------------------

    def report(self, form="text", title=None):
        """A report as a string: "text", "csv", "json", or "page" in HTML."""
        how = (_form(form), _title(title))
        size = ctypes.c_size_t()
        self._owner.call(lib.baum_study_print, *how, None, 0, ctypes.byref(size))
        text = ctypes.create_string_buffer(size.value + 1024)  # its date is another one
        self._owner.call(lib.baum_study_print, *how, text, len(text), None)
        return text.value.decode(errors="replace")

    def write(self, path, title=None):
        """Write a report into a file, in the form that its name ends with: .txt, .csv, .json, .html.
        A file that is there already is replaced when the new one is complete."""
        suffix = os.path.splitext(os.fspath(path))[1]
        if suffix not in SUFFIXES:
            raise ValueError(f"{path}: the name of a report ends with {', '.join(SUFFIXES)}")
        self._owner.call(lib.baum_study_write, _form(SUFFIXES[suffix]), _title(title),
                         os.fsencode(path))


def _title(text):
    return None if text is None else text.encode()


def _form(word):
    if word not in FORMS:
        raise ValueError(f"no form {word!r} of a report; there are: {', '.join(FORMS)}")
    return FORMS[word]


def study(mechanism, t0, t1, **options):
    """A Study of a frozen mechanism from t0 to t1 [s]; see Study for the options."""
    return Study(mechanism, t0, t1, **options)
