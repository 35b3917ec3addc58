# SPDX-License-Identifier: BSD-3-Clause
"""Studies measure accuracy against cost: a study makes many runs of one mechanism, measures the
error and the cost of each, and recommends a setting."""

from __future__ import annotations

import ctypes
import math
import os
from typing import TYPE_CHECKING, Any, Callable, Literal, Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import _abi, _calls, _html
from ._lib import default, lib, text
from ._records import StudyEntry, StudyMethod, StudyReference
from ._values import address, integer, number, numbers, there_are, truth, vector, word
from ._words import in_python
from .channels import Channel
from .errors import Status, Warning, as_status, warn
from .gains import Gains
from .integrators import FORMULATIONS, Integrator, lookup, names
from .progress import StudyLine, stream
from .simulation import SOLVERS, STARTS, make_options, row_factors
from .typing import Array, ArrayLike, ChannelLike, Cost, Formulation, Scalar

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .mechanism import Mechanism
    from .typing import SettingOptions

StudyProgress = Union[Callable[[int, int], object], Literal[False], None]
Solution = Callable[[float], Sequence[ArrayLike]]

COSTS = names(_abi.baum_study_cost, "BAUM_STUDY_")
FORMS = names(_abi.baum_report_form, "BAUM_REPORT_")
SUFFIXES = {".txt": "text", ".csv": "csv", ".json": "json", ".html": "page"}
WHY_SIZE = 2048  # [byte] size of the buffer for the reason of a recommendation


def _swap(words: Mapping[str, int]) -> dict[int, str]:
    return {value: name for name, value in words.items()}


class ReferenceSamples(NamedTuple):
    """Samples of the reference of a study. Values that are not known are NaN.

    t: times (n) [s].
    q: positions (n x nq).
    v: velocities (n x nv).
    lambda_: multipliers (n x nc).
    """

    t: Array
    q: Array
    v: Array
    lambda_: Array


class Recommendation(dict[str, Any]):
    """A dict of options for Mechanism.simulate() and Mechanism.simulation(). With a recommendation
    `best`, write m.simulate(t, **best).

    why: the reason for the recommendation, with the measured figures.
    """

    def __init__(self, options: Mapping[str, Any], why: str) -> None:
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


def _gains(struct: Any) -> Gains | None:
    """Return the Gains of a struct; None if they are the default rule of the integrator."""
    rule = RULES[struct.rule]
    if rule == "default":
        return None
    return Gains(rule, **dict(zip(GAINS[rule], struct.value)))


def _value(name: str, value: Any) -> Any:
    """Convert a field of a struct to the types of this package."""
    if isinstance(value, bytes):
        return text(value)
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


# ---- studies -------------------------------------------------------------------------------------


class Study(_calls.Closing):
    """A study: many runs of one frozen mechanism from t0 to t1 [s] with different settings.

        best = baum.study(m, 0, 2).run().recommend(1e-6)
        print(best.why)
        run = m.simulate(t, **best)

    error: channels or their names. The error of a run is the largest difference of these channels
        from the reference, divided by `unit`. By default the error of a run is the largest error of
        all positions, with lengths divided by the characteristic length, and angles in radians.
    reference: a known motion, which replaces the reference that the study computes itself. It is a
        tuple (times, q), (times, q, v) or (times, q, v, lambda_). Each of the arrays q, v and
        lambda_ has one row for each time.
    solution: a known motion as a function: solution(t) returns (q, v) or (q, v, lambda_).
    digits: the number of digits of the known motion that can be trusted.
    samples: number of times at which errors are measured, 2 to 1e6.
    repeats: how often, at most, each entry is run again to measure its CPU time.
    entry_limit: largest CPU time of a run [s].
    time_budget: largest wall time of one call of run() [s].
    threads: number of threads, by default the number of processors, but 1 for a mechanism with
        Python functions.
    energy_account: if True, measure the work that stabilization and projection do on the mechanism.
    validate: if True, further runs, over twice the time span and from perturbed initial states,
        test the entries that may be recommended.
    file: path of a file in which the study keeps its results. A later study can continue from it.
    grid: the settings that run() adds to a study without settings. "quick" takes seconds, or about
        a minute with Python functions. "full" takes about 25 times as long.
    progress: by default a bar in a terminal or a notebook, with an estimate of the time left; False
        shows nothing. If you give a function, progress(done, total) is called twice for each entry:
        when its error is known, and when its CPU time is known. `done` is the number of entries
        whose error is known plus the number of entries whose CPU time is known, and `total` is
        twice the number of entries. The function cancels the study if it returns a true value. It
        may call cancel() and len() of the study, but no other method.

    In a `with` block, the end of the block frees the memory of the study and closes its file.

    Errors: TypeError for arguments of a wrong type; ValueError for unknown words, such as the name
        of a grid that does not exist; baum.Error for values that the library refuses.
    """

    mechanism: Mechanism
    _advice = "options are arguments of baum.study()"

    def __init__(
        self,
        mechanism: Mechanism,
        t0: Scalar,
        t1: Scalar,
        *,
        error: ChannelLike | Sequence[ChannelLike] | None = None,
        unit: Scalar = 1.0,
        reference: Sequence[ArrayLike | None] | None = None,
        solution: Solution | None = None,
        digits: Scalar | None = None,
        samples: int = 100,
        threads: int | None = None,
        repeats: int = 5,
        entry_limit: Scalar = 10.0,
        time_budget: Scalar = math.inf,
        energy_account: bool = True,
        validate: bool = True,
        file: str | os.PathLike[str] | None = None,
        grid: Literal["quick", "full"] = "quick",
        progress: StudyProgress = None,
    ) -> None:
        self.mechanism = mechanism
        if grid not in ("quick", "full"):
            raise ValueError(f"no grid {grid!r}; there are: quick, full")
        if not (progress is None or progress is False or callable(progress)):
            raise TypeError(f"progress: a function or False is wanted, not {progress!r}")
        self._quick = grid == "quick"
        self._progress: Callable[[int, int], object] | None = progress or None
        self._silent = progress is False
        out = ctypes.c_void_p()
        start, end = number(t0, "t0"), number(t1, "t1")
        _calls.make(lib.baum_study_create, mechanism.handle, start, end, ctypes.byref(out))
        self._owner = _calls.Handle(_calls.made(out), lib.baum_study_destroy, "study")
        self._error: BaseException | None = None
        self._keep: list[Any] = []
        if threads is None:
            threads = 1 if mechanism.has_python else os.cpu_count() or 1
        options = default(_abi.baum_study_options)
        options.samples = integer(samples, "samples")
        options.threads = integer(threads, "threads")
        options.repeats = integer(repeats, "repeats")
        options.entry_limit = number(entry_limit, "entry_limit")
        options.time_budget = number(time_budget, "time_budget")
        options.energy_account = truth(energy_account, "energy_account")
        options.validate = truth(validate, "validate")
        options.file = None if file is None else os.fsencode(file)
        options.progress = self._hold(_abi.baum_study_progress_fn, self._call_progress)
        self._owner.call(lib.baum_study_set_options, ctypes.byref(options))
        if error is not None:
            self._set_error(error, unit)
        if (reference is None and solution is None) != (digits is None):
            raise TypeError(
                "give reference or solution together with digits, the number of its digits that "
                "can be trusted"
            )
        if reference is not None:
            self._set_reference(reference, number(digits, "digits"))
        if solution is not None:
            self._set_solution(solution, number(digits, "digits"))

    def __repr__(self) -> str:
        return "<study, closed>" if self._owner.closed else f"<study of {len(self)} entries>"

    def _repr_html_(self) -> str:
        """Show a table of the Pareto front in notebooks."""
        rows = [
            (entry.name, entry.error, entry.work, entry.cpu, entry.max_phi)
            for entry in (self.entries[k] for k in self.front())
        ]
        caption = f"study of {len(self)} entries: the front"
        header = ("setting", "error", "work [evaluations]", "CPU time [s]", "max |Phi| [m or rad]")
        return _html.table(caption, header, rows)

    def __len__(self) -> int:
        return int(lib.baum_study_entry_count(self._owner.address))

    # ---- what is studied -------------------------------------------------------------------------

    def _hold(self, kind: Any, function: Any) -> Any:
        """Make a function pointer for the library, and keep it alive as long as the study."""
        self._keep.append(kind(function))
        return self._keep[-1]

    def _call_progress(self, study: Any, done: int, total: int, user: Any) -> int:
        try:
            return int(self._progress is not None and bool(self._progress(done, total)))
        except BaseException as error:
            self._error = error
            return 1

    def _set_error(self, error: ChannelLike | Sequence[ChannelLike], unit: Scalar) -> None:
        given = [error] if isinstance(error, (str, Channel)) else error
        structs = [self.mechanism.channel(channel).struct for channel in given]
        if not structs:
            raise ValueError("error: one channel or several are wanted, not none")
        channels = (_abi.baum_channel * len(structs))(*structs)
        self._owner.call(lib.baum_study_set_error, channels, len(structs), number(unit, "unit"))

    def _set_reference(self, reference: Sequence[ArrayLike | None], digits: float) -> None:
        times = vector(np.atleast_1d(np.asarray(reference[0])), None, "reference: times")
        arrays: list[Array | None] = []
        for part, size, label in zip(reference[1:], self.mechanism.sizes, ("q", "v", "lambda_")):
            if part is not None:
                part = np.asarray(part, dtype=float).reshape(-1)
                part = vector(part, len(times) * size, f"reference: {label}")
            arrays.append(part)
        arrays += [None] * (3 - len(arrays))
        places = map(address, arrays)
        set_reference = lib.baum_study_set_reference
        self._owner.call(set_reference, address(times), len(times), *places, digits)

    def _set_solution(self, solution: Solution, digits: float) -> None:
        sizes = self.mechanism.sizes

        def call(t: float, q: Any, v: Any, lambda_: Any, user: Any) -> int:
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

    def add(
        self,
        integrator: str | Integrator,
        *,
        row_gains: Mapping[Any, ArrayLike] | None = None,
        **options: Unpack[SettingOptions],
    ) -> Study:
        """Add one setting: an integrator with options of baum.Simulation. Returns the study."""
        struct = make_options(integrator, options)
        if row_gains is not None:
            factors = row_factors(self.mechanism, row_gains)
            struct.row_gains = factors.ctypes.data
            struct.row_gain_count = len(factors)
        self._owner.call(lib.baum_study_add, ctypes.byref(struct))
        return self

    def add_standard(
        self,
        integrator: str | Integrator | None = None,
        formulation: Formulation = "default",
        *,
        settings: int = 8,
        constants: int = 2,
        coarsest: Scalar | None = None,
        finest: Scalar | None = None,
        quick: bool = False,
    ) -> Study:
        """Add the standard grid of settings, or only its settings with one integrator or one
        formulation. Returns the study.

        settings: number of step sizes or tolerances of each method, 1 to 64.
        constants: number of pairs of constant gains that are tried in addition to the gain rules, 0
            to 4.
        coarsest: longest step of integrators of the orders 3 to 5 [s]. The longest steps of
            integrators of the orders 1, 2 and 8 are 0.2, 0.6 and 1.6 times this step. By default
            all these steps follow from the speed of the motion.
        finest: smallest rtol [-], by default 1e-13, or 1e-11 if a user constraint has neither
            `jacobian` nor `gamma`.
        quick: True adds the quick grid, with at most 5 step sizes and at most 5 tolerances of each
            integrator.
        """
        struct = default(_abi.baum_study_grid)
        if integrator is not None:
            struct.integrator = lookup(integrator).address
        struct.formulation = word(FORMULATIONS, formulation, "formulation")
        struct.settings = integer(settings, "settings")
        struct.constants = integer(constants, "constants")
        if coarsest is not None:
            struct.coarsest = number(coarsest, "coarsest")
        if finest is not None:
            struct.finest = number(finest, "finest")
        struct.quick = truth(quick, "quick")
        self._long(lib.baum_study_add_standard, ctypes.byref(struct))
        return self

    def add_stress(self, integrator: str | Integrator | None = None) -> Study:
        """Add stress settings, which have extreme steps, tolerances and gains. They use the given
        integrator, or by default all integrators. Returns the study."""
        place = None if integrator is None else lookup(integrator).address
        self._long(lib.baum_study_add_stress, place)
        return self

    # ---- running ---------------------------------------------------------------------------------

    def run(self) -> Study:
        """Compute the reference, and run the entries that are not done. Returns the study.

        If the study has no entries, this call first adds the settings that the option `grid`
        selects. A Python warning is issued if the reference cannot be trusted, or if the time
        budget is spent. If a function of the mechanism raises an exception in a run of an entry,
        this entry fails, and its message contains the exception.
        """
        if len(self) == 0:
            self.add_standard(quick=self._quick)
        out = None if self._silent or self._progress is not None else stream()
        if out is None:
            status, message = self._long(lib.baum_study_run)
        else:
            self._progress = line = StudyLine(out, [entry.method for entry in self.entries])
            try:
                status, message = self._long(lib.baum_study_run)
            finally:
                line.close()
                self._progress = None
        if status != Status.OK:
            warn(Warning(message))
        return self

    def cancel(self) -> None:
        """Ask run() to stop. Any thread may call this."""
        lib.baum_study_cancel(self._owner.address)

    def _long(self, function: Any, *arguments: Any) -> tuple[Status, str]:
        """Make a call that may take long, and return its message. If a function of the user raises
        an exception in any thread, raise it here."""

        def call() -> tuple[Status, str]:
            return self._owner.call(function, *arguments), _calls.message()

        self._error = None
        try:
            result: tuple[Status, str] = _calls.interruptible(call, cancel=self.cancel)
        except Exception as failure:
            if self._error is not None:
                raise self._error from failure
            raise
        if self._error is not None:
            raise self._error
        return result

    # ---- reading ---------------------------------------------------------------------------------

    def _read(self, function: Any, struct: Any, made: Any, *arguments: Any) -> Any:
        self._owner.call(function, *arguments, ctypes.byref(struct), ctypes.sizeof(struct))
        return made(*(_value(name, getattr(struct, name)) for name in made._fields))

    @property
    def entries(self) -> list[StudyEntry]:
        """All entries, in the order in which they were added."""
        return [
            self._read(lib.baum_study_entry_at, _abi.baum_study_entry(), StudyEntry, k)
            for k in range(len(self))
        ]

    @property
    def methods(self) -> list[StudyMethod]:
        """All methods. A method is a group of entries with the same integrator, formulation and
        gains. Among other figures, a StudyMethod states the factor by which one more digit of
        accuracy increases the cost."""
        count = lib.baum_study_method_count(self._owner.address)
        return [
            self._read(lib.baum_study_method_at, _abi.baum_study_method(), StudyMethod, k)
            for k in range(count)
        ]

    @property
    def reference(self) -> StudyReference:
        """The quality of the reference: how far the reference can be trusted. It is known after
        run()."""
        struct = _abi.baum_study_reference()
        found: StudyReference = self._read(lib.baum_study_reference_read, struct, StudyReference)
        return found

    def reference_samples(self) -> ReferenceSamples:
        """The samples of the reference: t, q, v, lambda_."""
        count = self.reference.samples
        times = np.empty(count)
        arrays = [np.empty((count, size)) for size in self.mechanism.sizes]
        for k in range(count):
            places = [address(part[k:]) for part in (times, *arrays)]
            self._owner.call(lib.baum_study_reference_sample, k, *places)
        return ReferenceSamples(times, *arrays)

    @property
    def error_text(self) -> str:
        """The definition of the error in words."""
        return text(lib.baum_study_error_text(self._owner.address))

    # ---- answers ---------------------------------------------------------------------------------

    def front(self, cost: Cost = "work") -> list[int]:
        """Return the indices of the entries on the Pareto front, from the cheapest to the most
        accurate. No other entry is both cheaper and more accurate than an entry on the front.

        cost: "work" counts evaluations, factorizations and, for implicit methods, iterations, and
            is the same on every machine. "cpu" is the CPU time.
        """
        entries = (ctypes.c_int32 * max(len(self), 1))()
        count = ctypes.c_int32()
        how = word(COSTS, cost, "cost")
        self._owner.call(lib.baum_study_front, how, len(self), entries, ctypes.byref(count))
        return list(entries[: count.value])

    def cost_at(self, method: int, error: Scalar, cost: Cost = "work") -> float:
        """Return what a method costs for a given error [-].

        method: index of the method in `methods`.
        cost: "work" gives the number of evaluations plus factorizations and, for implicit methods,
            iterations; "cpu" gives the CPU time [s].
        """
        out = ctypes.c_double()
        given = integer(method, "method"), number(error, "error"), word(COSTS, cost, "cost")
        self._owner.call(lib.baum_study_cost_at, *given, ctypes.byref(out))
        return out.value

    def compare(self, a: int, b: int, error: Scalar, cost: Cost = "work") -> float:
        """Return the cost of method a divided by the cost of method b, for the same error [-]. a
        and b are indices of methods in `methods`."""
        out = ctypes.c_double()
        given = integer(a, "a"), integer(b, "b"), number(error, "error"), word(COSTS, cost, "cost")
        self._owner.call(lib.baum_study_compare, *given, ctypes.byref(out))
        return out.value

    def recommend(self, error: Scalar, cost: Cost = "work") -> Recommendation:
        """Return the cheapest setting whose error is at most `error` [-]. If possible, the error of
        this setting stays below this limit also in runs from perturbed initial states and over
        twice the time span. If no setting achieves this, the attribute `why` of the result says so.
        Raises baum.Error if no setting is accurate enough, or if the uncertainty of the reference
        is larger than `error`."""
        given = number(error, "error"), word(COSTS, cost, "cost")
        return self._answer(lib.baum_study_recommend, *given)

    def recommend_budget(self, seconds: Scalar) -> Recommendation:
        """Return the most accurate setting whose run takes at most `seconds` of CPU time on
        this machine. Raises baum.Error if no setting is fast enough."""
        return self._answer(lib.baum_study_recommend_budget, number(seconds, "seconds"))

    def _answer(self, function: Any, *arguments: Any) -> Recommendation:
        best = default(_abi.baum_simulation_options)
        why = ctypes.create_string_buffer(WHY_SIZE)
        size = ctypes.sizeof(best)
        status = self._owner.call(function, *arguments, ctypes.byref(best), size, why, WHY_SIZE)
        if status != Status.OK:
            warn(Warning(_calls.message()))
        return Recommendation(self._keywords(best), text(why.value))

    def _keywords(self, best: Any) -> dict[str, Any]:
        """Return the options that differ from the defaults, as keyword arguments of Simulation."""
        plain = default(_abi.baum_simulation_options)
        found = {"integrator": _value("integrator", best.integrator)}
        words = {"formulation": FORMULATIONS, "start": STARTS, "solver": SOLVERS}
        skipped = {
            "struct_size",
            "integrator",
            "gains",
            "progress",
            "user",
            "row_gains",
            "row_gain_count",
        }
        for name in (field[0] for field in best._fields_):
            value = getattr(best, name)
            if name in skipped or value == getattr(plain, name) or value != value:
                continue
            found[name] = _swap(words[name])[value] if name in words else value
        gains = _gains(best.gains)
        if gains is not None:
            found["gains"] = gains
        if best.row_gains:
            factors = numbers(best.row_gains, best.row_gain_count)
            found["row_gains"] = self._row_gains(factors)
        return found

    def _row_gains(self, factors: Any) -> dict[str, Array]:
        joints = [element for element in self.mechanism if element.family == "joint"]
        rows = {joint.name: self.mechanism.rows(joint) for joint in joints}
        return {name: factors[place] for name, place in rows.items() if place.stop > place.start}

    # ---- reports ---------------------------------------------------------------------------------

    def report(self, form: str = "text", title: str | None = None) -> str:
        """Return a report as a string. form: "text", "csv", "json", or "page" for HTML."""
        how = (_form(form), _title(title))
        size = ctypes.c_size_t()
        self._owner.call(lib.baum_study_print, *how, None, 0, ctypes.byref(size))
        # The report is made twice, and its date may be longer the second time.
        room = ctypes.create_string_buffer(size.value + 1024)
        self._owner.call(lib.baum_study_print, *how, room, len(room), None)
        report = room.value.decode(errors="replace")
        return in_python(report) if form == "text" else report

    def write(self, path: str | os.PathLike[str], title: str | None = None) -> None:
        """Write a report to a file. The suffix of the path determines the form of the report: .txt,
        .csv, .json or .html. An existing file is replaced only when the new file is complete."""
        suffix = os.path.splitext(os.fspath(path))[1]
        if suffix not in SUFFIXES:
            raise ValueError(f"{path}: the name of a report ends with {', '.join(SUFFIXES)}")
        how = (_form(SUFFIXES[suffix]), _title(title))
        self._owner.call(lib.baum_study_write, *how, os.fsencode(path))


def _title(title: str | None) -> bytes | None:
    return None if title is None else title.encode()


def _form(name: str) -> int:
    if name not in FORMS:
        raise ValueError(f"no form {name!r} of a report; {there_are(FORMS, name)}")
    return FORMS[name]


study = Study
