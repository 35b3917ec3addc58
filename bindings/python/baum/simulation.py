# SPDX-License-Identifier: BSD-3-Clause
"""One run of a frozen mechanism."""

from __future__ import annotations

import ctypes
import functools
import inspect
import math
import time
from typing import (
    TYPE_CHECKING,
    Any,
    Callable,
    Iterable,
    Mapping,
    Sequence,
    TypeVar,
    overload,
)

import numpy as np
from numpy.typing import NDArray

from . import _abi, _calls
from ._lib import default, lib, text
from ._motion import TraceLike
from ._values import address, integer, number, there_are, truth, vector, word
from .callbacks import event_function
from .channels import Channel, Layout, several
from .channels import q as ALL_Q
from .channels import v as ALL_V
from .definitions import COORDINATES
from .errors import Error, Status, Warning, as_warning, warn
from .gains import Gains
from .integrators import FORMULATIONS, Integrator, integrators, lookup, names
from .live import Live, View, Watcher, open_view
from .progress import RunLine, stream
from .run import Account, Counters, EnergyAccount, Event, NearSingular, Run
from .typing import (
    Array,
    ArrayLike,
    ChannelLike,
    Coordinate,
    Formulation,
    InputLike,
    JointLike,
    Progress,
    Scalar,
    Solver,
    Start,
)

if TYPE_CHECKING:
    from .mechanism import Mechanism

Method = TypeVar("Method", bound=Callable[..., Any])

STARTS = names(_abi.baum_start, "BAUM_START_")
SOLVERS = names(_abi.baum_solver, "BAUM_SOLVER_")
BRANCHES = {value: name for name, value in names(_abi.baum_branch, "BAUM_BRANCH_").items()}
AT_ONCE = 0.01  # [s] a call that takes less time than this needs no second thread


def _word(words: Mapping[str, int], label: str) -> Callable[[Any], int]:
    """Return a function that converts one of these words to its value."""

    return lambda value: word(words, value, label)


def _number(name: str) -> Callable[[Any], float]:
    return lambda value: number(value, name)


def _truth(name: str) -> Callable[[Any], bool]:
    return lambda value: truth(value, name)


def _gains(value: Any) -> Any:
    if not isinstance(value, Gains):
        raise TypeError(f"gains: something like baum.fixed(5, 5) is wanted, not {value!r}")
    return value.struct


CONVERT: dict[str, Callable[[Any], Any]] = {
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


def _status_of(error: BaseException) -> Status:
    """Return the Status of a run that has ended with this exception."""
    if isinstance(error, Error):
        return error.status
    interrupted = isinstance(error, KeyboardInterrupt)
    return Status.STOP_CANCELLED if interrupted else Status.ERR_CALLBACK


def _check_names(options: Iterable[str], known: Sequence[str]) -> None:
    for name in options:
        if name not in known:
            raise TypeError(f"no option {name!r}; {there_are(['integrator', *known], name)}")


def make_options(method: Any, values: Mapping[str, Any]) -> Any:
    """Make the options of the library from keyword arguments. An argument that is None keeps the
    default."""
    _check_names(values, [*CONVERT, "row_gains"])
    options = default(_abi.baum_simulation_options)
    if isinstance(method, (str, Integrator)):
        options.integrator = lookup(method).address
    elif method is None:
        message = f"no integrator is given; choose one of {', '.join(integrators())}"
        raise Error(Status.ERR_ARGUMENT, message)
    else:
        raise TypeError(f"integrator: a name is wanted, not {method!r}")
    for name, value in values.items():
        if value is not None:
            setattr(options, name, CONVERT[name](value))
    return options


def _progress(live: Live) -> Any:
    """Make a progress function for the library."""

    def call(simulation: Any, t: float, user: Any) -> int:
        try:
            return int(live.call(simulation, t))
        except BaseException as error:
            _calls.raise_later(error)
            return 1

    return _abi.baum_progress_fn(call)


def row_factors(mechanism: Mechanism, factors: Any) -> Array:
    """Return the gain factors of all rows (nc) from the factors of some joints."""
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


def _checked(progress: Any) -> Any:
    """Check the option progress: a function, True for a bar, or None."""
    if progress is None or progress is False:
        return None
    if progress is not True and not callable(progress):
        raise TypeError(f"progress: a function or True is wanted, not {progress!r}")
    return progress


def takes_options(method: Method) -> Method:
    """Decorate a method that passes **options to Simulation, so that its signature shows these
    options."""
    own = inspect.signature(method)
    options = [
        parameter
        for parameter in inspect.signature(Simulation.__init__).parameters.values()
        if parameter.kind is parameter.KEYWORD_ONLY
    ]
    shown = [parameter for parameter in own.parameters.values() if parameter.name != "options"]
    known = [parameter.name for parameter in options]
    named = {parameter.name for parameter in shown}

    @functools.wraps(method)
    def call(*arguments: Any, **given: Any) -> Any:
        _check_names([name for name in given if name not in named], known)
        return method(*arguments, **given)

    call.__signature__ = own.replace(parameters=[*shown, *options])  # type: ignore[attr-defined]
    return call  # type: ignore[return-value]


class Simulation(_calls.Closing):
    """One run of a frozen mechanism.

    integrator: the name of an integration method. The methods "euler", "semi_implicit_euler",
        "rk2", "rk3", "rk4", "ab2", "ab3", "ab4", "rattle" and "generalized_alpha" need the option
        `step`. The methods "dp5" and "rk8" need either `step` or `rtol`. The methods "cvode_adams",
        "cvode_bdf" and "ida" need `rtol`. The method "kinematics" needs neither `step` nor `rtol`,
        because drivers prescribe the whole motion. baum.integrators() states the orders and the
        formulations of all methods.
    step: length of a fixed step [s], positive.
    rtol: tolerance of the local error [-], between 0 and 1, relative to typical sizes of q and v
        (their scales).
    atol: absolute tolerance [unit of the coordinate], which is added to rtol times the scale of
        the coordinate. None adds nothing.
    max_step: longest variable step [s], by default unlimited. Set max_step if a force is zero at
        first and begins to act later: a long step could miss this beginning. Also set it if an
        event function may pass zero twice within a quarter of a step.
    formulation: "default" is the first formulation that the integrator offers. Most integrators
        offer "unstabilized" and "baumgarte"; the Runge-Kutta methods, the Euler methods and
        "cvode_bdf" also offer "projection", and "ida" also offers "index2", "ggl" and "index3".
        "rattle" and "generalized_alpha" offer only "index3".
    gains: gain rule for "baumgarte": baum.fixed(alpha, beta), scaled(), frequency(), taylor(),
        deadbeat(), best_damping() or auto(). None means the default rule of the integrator.
    row_gains: factors on alpha and beta, as a dict from joints or their names to a number, or to
        one number for each row of the joint.
    allow_unstable: True accepts gains that are known to be unstable.
    tolerance_q, tolerance_v, tolerance_lambda: factors on the tolerances of positions, velocities
        and multipliers [-], positive. By default tolerance_lambda is infinite, so the error of
        multipliers is not tested. Only "ida" with the formulation "baumgarte" or "unstabilized"
        accepts a finite tolerance_lambda.
    start_time: time at which the run starts [s].
    start: "assemble" first moves the bodies so that the joints are closed. "exact" refuses a
        design configuration that violates constraints. "as_given" accepts such a configuration and
        does not assemble it.
    solver: the solver of the linear system for the accelerations and the multipliers: "klu" (sparse
        LU factorization), "qr" (sparse QR factorization), "block" (Schur complement in blocks), or
        "auto", which chooses one of them.
    check_derivatives: True compares the derivatives of your functions with finite differences, at
        the start and at some later states of the run. A derivative that is wrong at the start
        raises baum.Error. For a derivative that is wrong only later, the run issues a
        WrongDerivativeWarning.
    max_steps: largest number of steps in one call that advances the run. A call that needs more
        steps fails.
    energy_account: True computes the work of all forces during the run. The property and the
        channel `energy_account` report this work.
    error_check: if True, estimate the error of the motion by a second integration. The estimate is
        counters.error_estimate. The run warns if the error is large, or if the second integration
        fails or becomes too expensive, so that the error is unknown. With this option, rtol must be
        at least 2e-14. Without this option, a run with a fixed step makes a second integration only
        if the step is long, or if the sum of its local errors becomes large enough to matter.
    progress: True shows a bar in a terminal or a notebook, but not for step(), because the end time
        of its steps is not known in advance. If you give a function, the run calls progress(t) with
        the present time t [s] every progress_interval seconds of wall time. The function cancels
        the run if it returns a true value.

    The run issues its warnings as Python warnings. The class of each warning is a subclass of
    baum.Warning. If the motion may be wrong, the class is also a subclass of baum.DoubtWarning.

    In a `with` block, the memory of the run is freed at the end of the block. Only one thread at a
    time may use a run, except that any thread may call cancel().

    Errors: TypeError for options of a wrong type; ValueError for unknown words, such as the name of
        a formulation that does not exist; baum.Error for options that the library refuses, and for
        a mechanism that is not frozen or cannot be assembled.
    """

    mechanism: Mechanism
    _advice = (
        "options are arguments of Mechanism.simulation(), and set_state(), set_input() and "
        "set_driver() change a run"
    )

    def __init__(
        self,
        mechanism: Mechanism,
        integrator: str | Integrator | None = None,
        *,
        progress: Progress = None,
        formulation: Formulation = "default",
        gains: Gains | None = None,
        row_gains: Mapping[Any, ArrayLike] | None = None,
        allow_unstable: bool = False,
        step: Scalar | None = None,
        rtol: Scalar | None = None,
        atol: Scalar | None = None,
        max_step: Scalar | None = None,
        start_time: Scalar = 0.0,
        start: Start = "assemble",
        solver: Solver = "auto",
        check_derivatives: bool = True,
        max_steps: int = 1_000_000_000,
        progress_interval: Scalar = 0.05,
        tolerance_q: Scalar = 1.0,
        tolerance_v: Scalar = 1.0,
        tolerance_lambda: Scalar = math.inf,
        energy_account: bool = False,
        error_check: bool = False,
    ) -> None:
        given = locals()
        kept = Simulation.__init__.__kwdefaults__ or {}
        changed = {name: given[name] for name in CONVERT if given[name] is not kept[name]}
        struct = make_options(integrator, changed)
        self.mechanism = mechanism
        self._own_progress = _checked(progress)
        self._own_watcher: Watcher = None if progress is True else self._own_progress
        self._live = Live(struct.progress_interval)
        self._live.function = self._own_watcher
        self._keep = struct.progress = _progress(self._live)
        self._has_account = bool(energy_account)
        self._layouts: dict[tuple[str, ...], Layout] = {}
        self._event_functions: list[Any] = []
        self._event_names: list[str] = []
        self._warned: dict[int, int] = {}
        self._seconds_per_step: float | None = None
        self._time_limit = math.inf
        if row_gains is not None:
            factors = row_factors(mechanism, row_gains)
            struct.row_gains = factors.ctypes.data
            struct.row_gain_count = len(factors)
        out = ctypes.c_void_p()
        arguments = mechanism.handle, ctypes.byref(struct), ctypes.byref(out)
        if mechanism.is_quick:
            _calls.make(lib.baum_simulation_create, *arguments)
        else:
            _calls.interruptible(_calls.make, lib.baum_simulation_create, *arguments)
        self._owner = _calls.Handle(_calls.made(out), lib.baum_simulation_destroy, "simulation")
        self._sizes = mechanism.sizes
        self._warn()

    def __reduce__(self) -> Any:
        return self._owner.__reduce__()  # refuses

    def __repr__(self) -> str:
        return (
            "<simulation, closed>" if self._owner.closed else f"<simulation at t = {self.time:g} s>"
        )

    # ---- moving ----------------------------------------------------------------------------------

    def advance_to(self, t: Scalar, progress: Progress = None) -> Status:
        """Advance to the time t [s], forward or backward.

        progress: like the option `progress`, but for this call only.

        Returns the Status: OK, WARNED, STOP_EVENT or STOP_CANCELLED. Raises baum.Error if the run
        fails. The run then stays at the end of its last successful step.
        """
        end = number(t, "t")
        return self._run(progress, lib.baum_simulation_advance_to, lambda: (end,), end=end)

    def step(self, count: int = 1, progress: Progress = None) -> Status:
        """Take `count` whole steps forward in time. Returns and raises the same as
        advance_to()."""
        count = integer(count, "count", 64)
        begun = time.perf_counter()
        try:
            at_once = self._is_short(count)
            return self._run(progress, lib.baum_simulation_step, lambda: (count,), at_once=at_once)
        finally:
            self._seconds_per_step = (time.perf_counter() - begun) / max(count, 1)

    def _is_short(self, count: int) -> bool:
        seconds = self._seconds_per_step
        return seconds is not None and seconds * count < AT_ONCE and not self._has_python

    @property
    def _has_python(self) -> bool:
        """Whether calls may run Python callbacks."""
        return self.mechanism.has_python or bool(self._event_functions)

    def sample(self, times: ArrayLike, record: ChannelLike | Sequence[ChannelLike] = ()) -> Run:
        """Advance through times (n) [s]. Return a Run with q, v and the channels in `record` at
        each time.

        record: one channel or several channels.

        Raises the same as advance_to(). All exceptions, including KeyboardInterrupt and those of
        your own functions, have the attribute `run` with the samples recorded so far.
        """
        given = vector(np.atleast_1d(times), None, "times")
        counts: list[ctypes.c_int64] = []
        layout = self._layout(
            [ALL_Q, ALL_V, *(self.mechanism.channel(channel) for channel in several(record))]
        )
        rows = layout.rows(len(given))

        def done() -> int:
            return sum(count.value for count in counts)

        def remaining() -> tuple[Any, ...]:
            first = done()
            counts.append(ctypes.c_int64())
            left, to = given[first:], rows[first:]
            into = ctypes.byref(counts[-1])
            return address(left), len(left), layout.structs, layout.count, address(to), into

        try:
            end = float(given[-1]) if len(given) else None
            status = self._run(None, lib.baum_simulation_sample, remaining, end=end)
        except BaseException as error:
            if not self._owner.busy:
                recorded = self._make_run(layout, given, rows, done(), _status_of(error))
                recorded.failure = str(error)
                error.run = recorded  # type: ignore[attr-defined]
            raise
        return self._make_run(layout, given, rows, done(), status)

    def _make_run(
        self, layout: Layout, times: Array, rows: Array, done: int, status: Status
    ) -> Run:
        works = self.energy_account if self._has_account else None
        account = Account(
            self.counters, self.explain, self.warnings, self.near_singular, self.events, works
        )
        return Run(self.mechanism, layout, times[:done], rows[:done], status, account)

    def set_state(self, t: Scalar, q: ArrayLike, v: ArrayLike | None = None) -> None:
        """Replace the time t [s] and the state q (nq), v (nv).

        If the new state violates the constraints, the option `start` decides what happens. With
        start="assemble", v may be None, and entries of v may be NaN; assembly then determines them.
        Raises baum.Error if the state cannot be assembled. The run is then unchanged. The positions
        q do not determine the number of whole revolutions in an angle of a spatial joint. To choose
        this number, call set_angle() afterwards.
        """
        nq, nv, _ = self._sizes
        q = vector(q, nq, "q")
        v = np.full(nv, np.nan) if v is None else vector(v, nv, "v")
        self._call(lib.baum_simulation_set_state, number(t, "t"), address(q), address(v))
        self._warn()

    def set_angle(self, joint: JointLike, angle: Scalar, coordinate: Coordinate = "first") -> None:
        """Set the number of whole revolutions in an angle of a spatial joint, for example after
        set_state() has given a new run the state of another run. The run restarts at its present
        state. The new angle differs from the present angle by whole revolutions, and is as near as
        possible to the argument `angle` [rad].

        coordinate: which angle of the joint, as in Mechanism.driver().
        """
        found = self.mechanism.find("joint", joint)
        which = word(COORDINATES, coordinate, "coordinate")
        self._call(lib.baum_simulation_set_angle, found.id, which, number(angle, "angle"))
        self._warn()

    def set_input(self, input: InputLike, value: Scalar) -> None:
        """Set an input from the present time on. The input keeps the value until it is set again.

        Variable-step methods restart, and CVODE and IDA then begin with small steps. A loop that
        sets inputs therefore often runs fastest with a fixed step, or with "rk8".
        """
        found = self.mechanism.find("input", input)
        self._call(lib.baum_simulation_set_input, found.id, number(value, found.name))

    def schedule_input(self, input: InputLike, times: ArrayLike, values: ArrayLike) -> None:
        """Schedule an input: from the time times[k] [s] on, the input has the value values[k].
        Before times[0], the input keeps its present value.

        times: (n) times in rising order.
        values: (n) values of the input from these times on.

        Steps end at these times, and multistep methods restart there. set_input() ends the
        schedule.
        """
        found = self.mechanism.find("input", input)
        at = vector(np.atleast_1d(times), None, f"{found.name}: times")
        what = vector(np.atleast_1d(values), len(at), f"{found.name}: values")
        schedule = lib.baum_simulation_schedule_input
        self._call(schedule, found.id, address(at), address(what), len(at))

    @property
    def inputs(self) -> dict[str, float]:
        """A dict from the name of each input to its present value."""
        return {
            input.name: lib.baum_simulation_input(self._owner.address, input.id)
            for input in self.mechanism.inputs
        }

    def set_driver(
        self,
        driver: JointLike,
        value: Scalar,
        rate: Scalar = 0.0,
        acceleration: Scalar = 0.0,
    ) -> None:
        """Give a driver another law in this run, until the next call for this driver. From the
        present time t0 on, the driver prescribes value + rate (t - t0) + acceleration
        (t - t0)^2 / 2.

        value: [rad] or [m].
        rate: [rad/s] or [m/s].
        acceleration: [rad/s^2] or [m/s^2].

        To avoid a jump, let value be the present coordinate, and rate its present velocity. A jump
        is a constraint violation, and the formulation determines what happens to it.
        """
        found = self.mechanism.find("joint", driver)
        law = {"value": value, "rate": rate, "acceleration": acceleration}
        parts = [number(part, f"{found.name}: {name}") for name, part in law.items()]
        self._call(lib.baum_simulation_set_driver, found.id, *parts)

    def event(
        self,
        joint: JointLike | None = None,
        value: Scalar = 0.0,
        *,
        function: Callable[[float, Array, Array], ArrayLike] | None = None,
        direction: int = 0,
        terminal: bool = True,
        name: str | None = None,
        tolerance: Scalar | None = None,
        coordinate: Coordinate = "first",
    ) -> int:
        """Add an event, and return its number. The run looks for the event from the present state
        on.

        The event happens when the coordinate of `joint` passes `value` [rad] or [m], or when
        function(t, q, v) passes zero. The function receives q and v of the whole mechanism. If
        the function passes zero twice within a quarter of a step, the run may miss both events. To
        avoid this, set the option max_step, or take a smaller step.

        direction: 1 if the event happens only when the coordinate or the function rises, -1 if it
            happens only when the coordinate or the function falls, 0 for both.
        terminal: True stops the run at the event. The call that advances the run then returns
            Status.STOP_EVENT, and the next call continues the run. False only records the event in
            `events`.
        name: name of the event in messages and in `events`, by default "event 0", "event 1", ...
        tolerance: accuracy of the time of the event [s], by default 4 rounding errors of the time.
        coordinate: which coordinate of `joint`, as in Mechanism.driver().
        """
        if not (name is None or isinstance(name, str)):
            raise TypeError(f"name: a string is wanted, not {name!r}")
        struct = default(_abi.baum_event_def)
        struct.name = None if name is None else name.encode()
        if joint is not None:
            struct.joint = self.mechanism.find("joint", joint).id
        struct.coordinate = word(COORDINATES, coordinate, "coordinate")
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
        self._event_names.append(f"event {index.value}" if name is None else name)
        return index.value

    @property
    def events(self) -> list[Event]:
        """A list of the events that have happened so far. It contains at most the last 1024
        events."""
        count = lib.baum_simulation_event_count(self._owner.address)
        record = _abi.baum_event_record()
        happened = []
        for k in range(max(0, count - 1024), count):
            size = ctypes.sizeof(record)
            self._call(lib.baum_simulation_event, k, ctypes.byref(record), size)
            name = self._event_names[record.event]
            happened.append(Event(record.t, record.event, record.direction, name))
        return happened

    def save(self) -> bytes:
        """Return the state of the run as bytes, for restore() in this process or another one.

        The past steps that an integrator remembers are not saved. Both save() and restore() discard
        them, so that the saved run and the restored run continue identically, bit for bit.
        """
        size = ctypes.c_size_t()
        self._call(lib.baum_simulation_save, None, 0, ctypes.byref(size))
        buffer = ctypes.create_string_buffer(size.value)
        self._call(lib.baum_simulation_save, buffer, size.value, ctypes.byref(size))
        return buffer.raw[: size.value]

    def restore(self, saved: bytes | bytearray | memoryview) -> None:
        """Restore a state from save() of this run, or of another run with the same mechanism and
        the same options.

        Raises baum.Error with Status.ERR_BUFFER for bytes that do not come from save() of such a
        run. Python warnings of the saved run are not issued again.
        """
        given = bytes(memoryview(saved))
        self._call(lib.baum_simulation_restore, given, len(given))
        self._warned = {warning.code: warning.count for warning in self.warnings}

    def continue_from(self, other: Simulation) -> None:
        """Continue with the motion of another run of the same mechanism, even if that run has
        failed. This run takes over the state, the inputs and the laws of drivers of the other run,
        and keeps its own options."""
        if not isinstance(other, Simulation):
            raise TypeError(f"a simulation is wanted, not {other!r}")
        if other is self:
            self._call(lib.baum_simulation_continue, self._owner.address)
        else:  # other._owner.call() refuses a run that another call is advancing
            other._owner.call(lambda from_: self._call(lib.baum_simulation_continue, from_))
        self._warn()

    def cancel(self) -> None:
        """Ask the run to stop after its present step. Any thread and any signal handler may call
        this method."""
        self._live.cancelled = True
        lib.baum_simulation_cancel(self._owner.address)

    def close(self) -> None:
        super().close()
        self._live.end()

    def _run(
        self,
        progress: Progress,
        function: Any,
        arguments: Callable[[], tuple[Any, ...]],
        at_once: bool = False,
        end: float | None = None,
    ) -> Status:
        """Call a function that advances the run. `end` is the time at which the call will end, if
        this time is known. arguments() returns the arguments for the work that has not been done
        yet. at_once is True if the call is known to be short."""
        wanted = _checked(progress) if progress is not None else self._own_progress
        out = stream() if wanted is True and end is not None else None
        line = None if out is None or end is None else RunLine(out, self.time, end)
        live = self._live
        live.function = line or (wanted if callable(wanted) else None)
        live.cancelled = False
        if live.servers and (live.paused or live.function is not None):
            live.begin(self._owner.address)
        status: Status
        try:
            status = self._advance(function, arguments, at_once, end is not None)
        except Error:
            self._warn()
            raise
        finally:
            live.function = self._own_watcher
            if line is not None:
                line.close()
        if status != Status.OK:
            self._warn()
        if live.servers:
            live.returned(self._owner)
        return status

    def _advance(
        self, function: Any, arguments: Callable[[], tuple[Any, ...]], short: bool, divisible: bool
    ) -> Status:
        """Make a call that advances the run: in this thread if it is short, otherwise in a second
        thread.

        A divisible call can be stopped and continued. If it runs no Python callbacks, it begins in
        this thread with a time limit of AT_ONCE. If it does not end within this limit, the second
        thread continues it.
        """
        if short:
            return self._owner.call(function, *arguments())
        if divisible and self._live.is_silent(AT_ONCE) and not self._has_python:
            self._limit_time(AT_ONCE)
            status = self._owner.call(function, *arguments())
            if status != Status.STOP_TIME:
                return status
        self._limit_time(math.inf)
        call = self._owner.call
        last: Status = _calls.interruptible(call, function, *arguments(), cancel=self.cancel)
        return last

    def _limit_time(self, seconds: float) -> None:
        if seconds != self._time_limit:
            self._owner.call(lib.baum_simulation_set_time_limit, seconds)
            self._time_limit = seconds

    def _call(self, function: Any, *arguments: Any) -> Any:
        """Make a short call. If it may run Python callbacks, make it in a second thread."""
        if self._has_python:
            return _calls.interruptible(self._owner.call, function, *arguments)
        return self._owner.call(function, *arguments)

    # ---- reading ---------------------------------------------------------------------------------

    def view(
        self,
        *,
        title: str | None = None,
        traces: Sequence[TraceLike] = (),
        paused: bool = False,
        browser: bool = True,
    ) -> View:
        """Open a page in the browser. The page shows this run while it advances, with up to 60
        frames per second. A notebook shows the returned baum.View.

        traces: paths to draw, as in Run.page().
        paused: True makes the run wait until you start it in the page.
        browser: False opens no browser. You can then visit View.url yourself.

        The page has buttons that pause the run, take one step of the integrator, and resume the
        run. While the run is paused, the call that advances it waits. Ctrl-C and cancel() end the
        waiting. If all pages of a paused run are closed, the run continues. A view ends with
        close(), at the end of a `with` block, or when the simulation ends. The server of the view
        answers only programs on this computer that know the secret in View.url.
        """
        return open_view(
            self, self._live, self._owner, title, traces, truth(paused, "paused"), browser
        )

    @property
    def time(self) -> float:
        """Present time [s]."""
        return float(lib.baum_simulation_time(self._owner.address))

    @property
    def q(self) -> Array:
        """A copy of the present positions (nq). It is read-only; set_state() changes the state."""
        return self._copy(lib.baum_simulation_q, self._sizes.nq)

    @property
    def v(self) -> Array:
        """A copy of the present velocities (nv). It is read-only; set_state() changes the state."""
        return self._copy(lib.baum_simulation_v, self._sizes.nv)

    def _copy(self, function: Any, size: int) -> Array:
        place = function(self._owner.address)
        return np.frombuffer(ctypes.string_at(place, 8 * size))  # bytes make it read-only

    @overload
    def get(self, channel: ChannelLike, /) -> Array: ...
    @overload
    def get(
        self, one: ChannelLike, two: ChannelLike, /, *more: ChannelLike
    ) -> tuple[Array, ...]: ...
    def get(self, *channels: ChannelLike) -> Array | tuple[Array, ...]:
        """Read channels at the present state. Return an array (columns) for one channel, and a
        tuple of arrays for several. Raises KeyError for a channel that does not exist."""
        found = [self.mechanism.channel(channel) for channel in channels]
        layout = self._layout(found)
        row = layout.rows(1)
        self._call(lib.baum_simulation_get, layout.structs, layout.count, address(row))
        parts = tuple(row[0, layout.slices[channel.key]] for channel in found)
        return parts[0] if len(parts) == 1 else parts

    def _layout(self, channels: Sequence[Channel]) -> Layout:
        key = tuple(channel.key for channel in channels)
        if key not in self._layouts:
            self._layouts[key] = Layout(self.mechanism, channels)
        return self._layouts[key]

    @property
    def unique_multipliers(self) -> NDArray[np.bool_]:
        """Determine which multipliers are unique at the present state. Return one bool for each row
        (nc). The array is read-only."""
        unique = (ctypes.c_bool * self.mechanism.sizes.nc)()
        self._call(lib.baum_simulation_unique_multipliers, unique)
        return np.frombuffer(bytes(unique), dtype=bool)

    @property
    def energy_account(self) -> EnergyAccount:
        """The energy account at the present state: the energies and the work of all forces. Raises
        baum.Error unless the option energy_account is True."""
        struct = _abi.baum_energy_account()
        self._call(lib.baum_simulation_energy_account, ctypes.byref(struct), ctypes.sizeof(struct))
        return EnergyAccount(*(getattr(struct, name) for name in EnergyAccount._fields))

    @property
    def near_singular(self) -> list[NearSingular]:
        """A list of the intervals in which the run was near a singular configuration. It contains
        at most the first 64 intervals."""
        found = []
        for k in range(min(self.counters.near_singular_intervals, 64)):
            out = _abi.baum_near_singular()
            self._call(lib.baum_simulation_near_singular, k, ctypes.byref(out), ctypes.sizeof(out))
            values = {name: getattr(out, name) for name in NearSingular._fields}
            values["branch"] = BRANCHES[values["branch"]]
            values["joint"] = self.mechanism.find("joint", values["joint"])
            found.append(NearSingular(**values))
        return found

    @property
    def counters(self) -> Counters:
        """Numbers of steps and evaluations, the wall time, and the largest constraint violations of
        the run so far."""
        struct = self._read_counters()
        values = [getattr(struct, name) for name in Counters._fields]
        return Counters._make(
            self.mechanism.find("joint", value) if isinstance(value, ctypes.Structure) else value
            for value in values
        )

    def _read_counters(self) -> _abi.baum_counters:
        struct = _abi.baum_counters()
        self._owner.call(lib.baum_simulation_counters, ctypes.byref(struct), ctypes.sizeof(struct))
        return struct

    @property
    def warnings(self) -> list[Warning]:
        """A list with one baum.Warning for each kind of warning so far."""
        found = []
        for k in range(self._read_counters().warnings):
            out = _abi.baum_warning()
            self._owner.call(lib.baum_simulation_warning, k, ctypes.byref(out), ctypes.sizeof(out))
            found.append(as_warning(out, self.mechanism.find("joint", out.joint)))
        return found

    def _warn(self) -> None:
        """Issue a Python warning for each warning of the run that is new or has occurred again."""
        before, self._warned = self._warned, {}
        for warning in self.warnings:
            self._warned[warning.code] = warning.count
            if warning.count > before.get(warning.code, 0):
                warn(warning)

    @property
    def explain(self) -> str:
        """An explanation of the run in words: its formulation, its integrator, its gains and the
        reason for them, their stability, the solver, redundant rows and tolerances."""
        return text(lib.baum_simulation_explain(self._owner.address))

    @property
    def message(self) -> str:
        """The message of the last failure or stop, or "" if there was none."""
        return text(lib.baum_simulation_message(self._owner.address))
