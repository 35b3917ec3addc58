# SPDX-License-Identifier: BSD-3-Clause
"""One run of a frozen mechanism."""

import ctypes
import time

import numpy as np

from . import _abi, _calls
from .callbacks import event_function
from .channels import Channel, Layout, q as ALL_Q, v as ALL_V
from .errors import Error, Status, as_warning, warn
from .gains import Gains
from .integrators import FORMULATIONS, Integrator, integrators, lookup, names
from ._lib import default, lib
from .run import Counters, EnergyAccount, Event, NearSingular, Run
from ._values import address, integer, number, truth, vector

STARTS = names(_abi.baum_start, "BAUM_START_")
SOLVERS = names(_abi.baum_solver, "BAUM_SOLVER_")
BRANCHES = {value: name for name, value in names(_abi.baum_branch, "BAUM_BRANCH_").items()}
AT_ONCE = 0.01  # [s] steps that take less are not worth a second thread


def _word(words, label):
    """A converter from one of some words."""

    def convert(value):
        if value not in words:
            raise ValueError(f"no {label} {value!r}; there are: {', '.join(words)}")
        return words[value]

    return convert


def _number(name):
    return lambda value: number(value, name)


def _truth(name):
    return lambda value: truth(value, name)


def _gains(value):
    if not isinstance(value, Gains):
        raise TypeError(f"gains: something like baum.fixed(5, 5) is wanted, not {value!r}")
    return value.struct


CONVERT = {
    "formulation": _word(FORMULATIONS, "formulation"),
    "gains": _gains,
    "allow_unstable": _truth("allow_unstable"),
    "step": _number("step"),
    "rtol": _number("rtol"),
    "atol": _number("atol"),
    "max_step": _number("max_step"),
    "start_time": _number("start_time"),
    "start": _word(STARTS, "start"),
    "solver": _word(SOLVERS, "solver"),
    "check_derivatives": _truth("check_derivatives"),
    "max_steps": lambda value: integer(value, "max_steps", 64),
    "progress_interval": _number("progress_interval"),
    "tolerance_q": _number("tolerance_q"),
    "tolerance_v": _number("tolerance_v"),
    "tolerance_lambda": _number("tolerance_lambda"),
    "energy_account": _truth("energy_account"),
    "error_check": _truth("error_check"),
}


def _status_of(error):
    """Why a run has ended that a Python exception has ended."""
    interrupted = isinstance(error, KeyboardInterrupt)
    return Status.STOP_CANCELLED if interrupted else Status.ERR_CALLBACK


def make_options(method, values):
    """The library's options from keyword arguments; None keeps a default."""
    options = default(_abi.baum_simulation_options)
    if isinstance(method, (str, Integrator)):
        options.integrator = lookup(method).address
    elif method is None:
        message = f"no integrator is given; choose one of {', '.join(integrators())}"
        raise Error(Status.ERR_ARGUMENT, message)
    else:
        raise TypeError(f"integrator: a name is wanted, not {method!r}")
    for name, value in values.items():
        if name not in CONVERT:
            raise TypeError(
                f"no option {name!r}; there are: integrator, progress, "
                + ", ".join([*CONVERT, "row_gains"])
            )
        if value is not None:
            setattr(options, name, CONVERT[name](value))
    return options


def _progress(holder):
    """A progress function of the library that calls holder[0](t), which may change from call to
    call."""

    def call(simulation, t, user):
        try:
            return int(holder[0] is not None and bool(holder[0](t)))
        except BaseException as error:
            _calls.raise_later(error)
            return 1

    return _abi.baum_progress_fn(call)


def _row_gains(mechanism, factors):
    """Factors of all rows from those of some joints."""
    if not hasattr(factors, "items"):
        raise TypeError(f"row_gains: {{joint: factor}} is wanted, not {factors!r}")
    values = np.ones(mechanism.sizes.nc)
    for joint, factor in factors.items():
        joint = mechanism.find("joint", joint)
        rows = mechanism.rows(joint)
        label = f'row_gains of "{joint.name}"'
        if np.ndim(factor) == 0:
            values[rows] = number(factor, label)
        else:
            values[rows] = vector(factor, rows.stop - rows.start, label)
    return values


class Simulation:
    """One run.

    integrator, and what it takes (baum.integrators() has them with order and formulations):
        "euler", "semi_implicit_euler", "rk2", "rk3", "rk4", "ab2", "ab3", "ab4", "rattle",
        "generalized_alpha"                  step [s]
        "dp5", "rk8"                         step or rtol
        "cvode_adams", "cvode_bdf", "ida"    rtol
        "kinematics"                         neither: drivers leave no freedom, nothing is integrated
    formulation: "default", the first that the integrator offers; "unstabilized", "baumgarte",
        "projection"; of IDA also "index2", "ggl", "index3"; "rattle" and "generalized_alpha" have
        "index3" alone.
    gains: baum.fixed(alpha, beta), scaled, frequency, taylor, deadbeat, best_damping, auto; for
        "baumgarte". row_gains: {joint or its name: factor on alpha and beta}, a number or one per row
        of the joint. allow_unstable: run with gains that are known to be unstable.
    atol, added to rtol; tolerance_q, tolerance_v, tolerance_lambda: factors on both for positions,
        velocities and multipliers (these of IDA with "baumgarte" or "unstabilized" only); max_step
        [s], for variable steps where a force begins late.
    energy_account: keep the works of Simulation.energy_account and of the channel "energy_account".
    error_check: estimate the error of the motion by a second integration (counters.error_estimate),
        and warn where it is large; with fixed steps this is done in any case where it may matter.
    start_time [s], default 0. start: "assemble", "exact", "as_given". solver: "auto", "klu", "qr",
        "block". check_derivatives: compare given derivatives with differences first. max_steps of
        one call. progress(t) is called every progress_interval seconds of wall time, and cancels
        when it returns something true.

    Warnings of the run become Python warnings: subclasses of baum.Warning, and of baum.DoubtWarning
    where the motion may be wrong. One thread at a time
    may use it, but for cancel().
    """

    def __init__(self, mechanism, integrator=None, *, progress=None, row_gains=None, **options):
        self.mechanism = mechanism
        if progress is not None and not callable(progress):
            raise TypeError(f"progress: a function is wanted, not {progress!r}")
        self._own_progress = progress
        self._progress = [progress]
        self._keep = _progress(self._progress)
        self._has_account = bool(options.get("energy_account"))
        self._layouts = {}
        self._event_functions = []
        self._warned = {}
        self._seconds_per_step = None
        struct = make_options(integrator, options)
        struct.progress = self._keep
        if row_gains is not None:
            factors = _row_gains(mechanism, row_gains)
            struct.row_gains = factors.ctypes.data
            struct.row_gain_count = len(factors)
        out = ctypes.c_void_p()
        _calls.interruptible(
            _calls.make,
            lib.baum_simulation_create,
            mechanism.handle,
            ctypes.byref(struct),
            ctypes.byref(out),
        )
        self._owner = _calls.Handle(out.value, lib.baum_simulation_destroy, "simulation")
        self._sizes = mechanism.sizes
        self._warn()

    def __repr__(self):
        return f"<simulation at t = {self.time:g} s>"

    # ---- moving ----------------------------------------------------------------------------------

    def advance_to(self, t, progress=None):
        """Advance to time t [s], forward or backward. Returns the Status: OK, WARNED, STOP_EVENT or
        STOP_CANCELLED."""
        return self._run(progress, lib.baum_simulation_advance_to, number(t, "t"))

    def step(self, count=1, progress=None):
        """Take whole steps forward. Returns the Status, as advance_to()."""
        count = integer(count, "count", 64)
        begun = time.perf_counter()
        try:
            return self._run(
                progress, lib.baum_simulation_step, count, at_once=self._is_short(count)
            )
        finally:
            self._seconds_per_step = (time.perf_counter() - begun) / max(count, 1)

    def _is_short(self, count):
        seconds = self._seconds_per_step
        return seconds is not None and seconds * count < AT_ONCE and not self._has_python

    @property
    def _has_python(self):
        """Whether calls may come back through Python."""
        return self.mechanism.has_python or bool(self._event_functions)

    def sample(self, times, record=()):
        """Advance through times [s] and return a Run: q, v and the channels in `record` (one or
        several) at each of them. What is raised, KeyboardInterrupt and exceptions of your functions
        too, has what was recorded so far as `run`."""
        times = vector(np.atleast_1d(times), None, "times")
        if isinstance(record, (str, Channel)):
            record = [record]
        layout = self._layout(
            [ALL_Q, ALL_V, *(self.mechanism.channel(channel) for channel in record)]
        )
        rows = layout.rows(len(times))
        done = ctypes.c_int64()
        arguments = (
            address(times),
            len(times),
            layout.structs,
            layout.count,
            address(rows),
            ctypes.byref(done),
        )
        try:
            status = self._run(None, lib.baum_simulation_sample, *arguments)
        except BaseException as error:
            if not self._owner.busy:
                status = getattr(error, "status", _status_of(error))
                error.run = self._make_run(layout, times, rows, done.value, status)
            raise
        return self._make_run(layout, times, rows, done.value, status)

    def _make_run(self, layout, times, rows, done, status):
        account = (self.counters, self.explain, self.warnings)
        run = Run(self.mechanism, layout, times[:done], rows[:done], status, account)
        run.near_singular = self.near_singular
        run.events = self.events
        run.energy_account = self.energy_account if self._has_account else None
        return run

    def set_state(self, t, q, v=None):
        """Replace time [s] and state, which is handled as the option `start` says. v, or parts of
        it, may be left free: None or NaN."""
        nq, nv, _ = self._sizes
        q = vector(q, nq, "q")
        v = np.full(nv, np.nan) if v is None else vector(v, nv, "v")
        self._call(lib.baum_simulation_set_state, number(t, "t"), address(q), address(v))
        self._warn()

    def set_input(self, input, value):
        """Set an input from now on, given as a handle or by name; it is held until it is set again.
        Variable-step methods restart, which costs multistep ones small steps: a loop that sets
        inputs often goes best with a fixed step, or with "rk8"."""
        input = self.mechanism.find("input", input)
        self._call(lib.baum_simulation_set_input, input.id, number(value, input.name))

    def schedule_input(self, input, times, values):
        """Give an input values[k] from times[k] [s] on, rising; before the first it has its present
        one. No step passes a time, and methods with a past restart there. set_input() ends it."""
        input = self.mechanism.find("input", input)
        times = vector(np.atleast_1d(times), None, f"{input.name}: times")
        values = vector(np.atleast_1d(values), len(times), f"{input.name}: values")
        self._call(
            lib.baum_simulation_schedule_input, input.id, address(times), address(values), len(times)
        )

    @property
    def inputs(self):
        """Present values of all inputs by name, a copy."""
        return {
            input.name: lib.baum_simulation_input(self._owner._address, input.id)
            for input in self.mechanism.inputs
        }

    def set_driver(self, driver, value, rate=0.0, acceleration=0.0):
        """Give a driver another law, for this run only: with the present time t0 its coordinate is
        value + rate (t - t0) + acceleration (t - t0)^2 / 2, until it is set again. Lead on from
        where the coordinate is: a jump in value or rate is a violation, which the formulation
        treats as any other."""
        driver = self.mechanism.find("joint", driver)
        law = {"value": value, "rate": rate, "acceleration": acceleration}
        law = [number(part, f"{driver.name}: {name}") for name, part in law.items()]
        self._call(lib.baum_simulation_set_driver, driver.id, *law)

    def event(self, joint=None, value=0.0, *, function=None, direction=0, terminal=True, name=None,
              tolerance=None):
        """Add an event, from the present state on, and return its number: the coordinate of a joint
        passes value, or function(t, q, v) of the whole run passes zero; direction 1 rising, -1
        falling in time, 0 both. A terminal one ends the call with Status.STOP_EVENT, and the run
        stands at it; the next call goes on. See `events`."""
        struct = default(_abi.baum_event_def)
        struct.name = None if name is None else name.encode()
        if joint is not None:
            struct.joint = self.mechanism.find("joint", joint).id
        struct.value = number(value, "value")
        struct.direction = integer(direction, "direction")
        struct.terminal = truth(terminal, "terminal")
        if tolerance is not None:
            struct.tolerance = number(tolerance, "tolerance")
        if function is not None:
            struct.function = event_function(function, self._sizes.nq, self._sizes.nv)
            self._event_functions.append(struct.function)
        index = ctypes.c_int32()
        self._call(lib.baum_simulation_add_event, ctypes.byref(struct), ctypes.byref(index))
        return index.value

    @property
    def events(self):
        """What has happened so far, of which the last 1024 are kept: Event(t, event, direction)."""
        count = lib.baum_simulation_event_count(self._owner._address)
        record = _abi.baum_event_record()
        happened = []
        for k in range(max(0, count - 1024), count):
            size = ctypes.sizeof(record)
            self._call(lib.baum_simulation_event, k, ctypes.byref(record), size)
            happened.append(Event(record.t, record.event, record.direction))
        return happened

    def save(self):
        """The run as bytes, to be restored in this or another process. Methods of several steps and
        those that choose their step restart from here, so that this run and a restored one go on
        alike, bit for bit."""
        size = ctypes.c_size_t()
        self._call(lib.baum_simulation_save, None, 0, ctypes.byref(size))
        buffer = ctypes.create_string_buffer(size.value)
        self._call(lib.baum_simulation_save, buffer, size.value, ctypes.byref(size))
        return buffer.raw[: size.value]

    def restore(self, saved):
        """Put this run back to where `saved` was: a run of the same mechanism and options. Anything
        else is refused with Status.ERR_BUFFER. Warnings of the saved run are not given again."""
        saved = bytes(memoryview(saved))
        self._call(lib.baum_simulation_restore, saved, len(saved))
        self._warned = {warning.code: warning.count for warning in self.warnings}

    def continue_from(self, other):
        """Go on where another run of the same mechanism stands, also one that has failed: with its
        state, inputs and laws of drivers, and the options of this one."""
        if not isinstance(other, Simulation):
            raise TypeError(f"a simulation is wanted, not {other!r}")
        self._call(lib.baum_simulation_continue, other._owner._address)
        self._warn()

    def cancel(self):
        """Ask a run to stop after its present step. From any thread or signal handler."""
        lib.baum_simulation_cancel(self._owner._address)

    def _run(self, progress, function, *arguments, at_once=False):
        """A call that moves the run."""
        self._progress[0] = progress or self._own_progress
        try:
            if at_once:
                status = self._owner.call(function, *arguments)
            else:
                status = _calls.interruptible(
                    self._owner.call, function, *arguments, cancel=self.cancel
                )
        except Error:
            self._warn()
            raise
        finally:
            self._progress[0] = self._own_progress
        if status != Status.OK:
            self._warn()
        return status

    def _call(self, function, *arguments):
        """A short call; in a thread of its own only when it may come back through Python."""
        if self._has_python:
            return _calls.interruptible(self._owner.call, function, *arguments)
        return self._owner.call(function, *arguments)

    # ---- reading ---------------------------------------------------------------------------------

    @property
    def time(self):
        """Present time [s]."""
        return lib.baum_simulation_time(self._owner._address)

    @property
    def q(self):
        """Present positions (nq), a copy."""
        return self._copy(lib.baum_simulation_q, self._sizes.nq)

    @property
    def v(self):
        """Present velocities (nv), a copy."""
        return self._copy(lib.baum_simulation_v, self._sizes.nv)

    def _copy(self, function, size):
        place = function(self._owner._address)
        return np.array((ctypes.c_double * size).from_address(place))

    def get(self, *channels):
        """A channel at the present state: an array of its columns; a tuple of arrays for
        several."""
        channels = [self.mechanism.channel(channel) for channel in channels]
        layout = self._layout(channels)
        row = layout.rows(1)
        self._call(lib.baum_simulation_get, layout.structs, layout.count, address(row))
        parts = tuple(row[0, layout.slices[channel.key]] for channel in channels)
        return parts[0] if len(parts) == 1 else parts

    def _layout(self, channels):
        key = tuple(channel.key for channel in channels)
        if key not in self._layouts:
            self._layouts[key] = Layout(self.mechanism, channels)
        return self._layouts[key]

    @property
    def unique_multipliers(self):
        """Which multipliers have no choice at the present state, one bool per constraint row."""
        unique = (ctypes.c_bool * self.mechanism.sizes.nc)()
        self._call(lib.baum_simulation_unique_multipliers, unique)
        return np.array(unique, dtype=bool)

    @property
    def energy_account(self):
        """Where the energy has come from; with the option energy_account=True."""
        struct = _abi.baum_energy_account()
        self._call(
            lib.baum_simulation_energy_account, ctypes.byref(struct), ctypes.sizeof(struct)
        )
        return EnergyAccount(*(getattr(struct, name) for name in EnergyAccount._fields))

    @property
    def near_singular(self):
        """Intervals in which the run was near a singular configuration, the first 64."""
        found = []
        for k in range(min(self.counters.near_singular_intervals, 64)):
            out = _abi.baum_near_singular()
            self._call(
                lib.baum_simulation_near_singular, k, ctypes.byref(out), ctypes.sizeof(out)
            )
            values = {name: getattr(out, name) for name in NearSingular._fields}
            values["branch"] = BRANCHES[values["branch"]]
            values["joint"] = self.mechanism.find("joint", values["joint"])
            found.append(NearSingular(**values))
        return found

    @property
    def counters(self):
        """What the run has cost and how well constraints were kept."""
        struct = _abi.baum_counters()
        self._call(lib.baum_simulation_counters, ctypes.byref(struct), ctypes.sizeof(struct))
        values = [getattr(struct, name) for name in Counters._fields]
        return Counters(
            *(
                (
                    self.mechanism.find("joint", value)
                    if isinstance(value, ctypes.Structure)
                    else value
                )
                for value in values
            )
        )

    @property
    def warnings(self):
        """A baum.Warning for each kind of warnings so far, with the time and count of it."""
        found = []
        for k in range(self.counters.warnings):
            out = _abi.baum_warning()
            self._owner.call(
                lib.baum_simulation_warning, k, ctypes.byref(out), ctypes.sizeof(out)
            )
            found.append(as_warning(out, self.mechanism.find("joint", out.joint)))
        return found

    def _warn(self):
        """Hand warnings that are new, or came again, to Python."""
        before, self._warned = self._warned, {}
        for warning in self.warnings:
            self._warned[warning.code] = warning.count
            if warning.count > before.get(warning.code, 0):
                warn(warning)

    @property
    def explain(self):
        """In words: formulation, integrator, gains and why, stability, solver, redundancy,
        tolerances."""
        return lib.baum_simulation_explain(self._owner._address).decode(errors="replace")

    @property
    def message(self):
        """The message of the last failure or stop, "" at first."""
        return lib.baum_simulation_message(self._owner._address).decode(errors="replace")
