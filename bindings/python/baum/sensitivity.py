# SPDX-License-Identifier: BSD-3-Clause
"""Sensitivities: derivatives of the results of runs with respect to parameters, computed by
differences."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, Mapping, Sequence

import numpy as np

from . import errors
from .sweeps import Named, Reduce, Sweep, mapping, sweep
from .typing import Array, ArrayLike, ChannelLike

if TYPE_CHECKING:
    from .mechanism import Mechanism

# Each number is changed in four runs, by these multiples of its difference step.
CHANGES = np.array([1.0, -1.0, 0.5, -0.5])
UNCERTAIN = 1e-4  # largest allowed error of a derivative, relative to the largest derivative
LEAST_STEP = 1e-8  # smallest step of a number, relative to the number
ROUNDING = 1e4 * float(np.finfo(float).eps)  # assumed rounding error of a result, relative to it


class Sensitivities(Named):
    """The derivatives of results with respect to all numbers in the parameters. A parameter is a
    number or a vector of numbers. In the shapes below, p is the count of all these numbers.

    parameters: the names of these numbers. A vector has one name for each of its numbers,
        such as "rod.position[0]".

    sensitivities["rod.pose"] contains the derivatives (samples x columns x p) of a channel. If
    baum.sensitivities() was called with a function `reduce`, sensitivities["value"] contains the
    derivatives of the results of this function (... x p). error(name) is an array of the same shape
    as sensitivities[name]. For each derivative, it contains the difference between the two
    difference quotients from which the derivative is computed. These differences are large if the
    results jump when a parameter changes, as they may with variable steps. They do not show
    integration errors that all runs have in common.
    """

    def __init__(self, parameters: Sequence[str], values: Array, runs: Sweep) -> None:
        """values: the value of each number in its four runs (p x 4)."""
        self.parameters = tuple(parameters)
        self._values = {}
        self._errors: dict[str, Array] = {}
        for name in runs.keys():
            found = runs[name].reshape(*values.shape, *runs[name].shape[1:])
            x, y = values.T, np.moveaxis(found, (0, 1), (-1, 0))
            coarse, fine = (y[0] - y[1]) / (x[0] - x[1]), (y[2] - y[3]) / (x[2] - x[3])
            self._values[name] = (4 * fine - coarse) / 3  # Richardson's extrapolation
            self._errors[name] = np.abs(fine - coarse)

    def __repr__(self) -> str:
        return f"<sensitivities of {', '.join(self._values)} to {', '.join(self.parameters)}>"

    def error(self, name: str) -> Array:
        """The differences between the two difference quotients of each derivative."""
        self[name]  # raises KeyError
        return self._errors[name]


def sensitivities(
    mechanism: Mechanism,
    parameters: Mapping[str, ArrayLike],
    times: ArrayLike,
    method: Any = None,
    *,
    record: ChannelLike | Sequence[ChannelLike] = (),
    reduce: Reduce | None = None,
    relative_step: float = 1e-3,
    steps: Mapping[str, ArrayLike] | None = None,
    executor: Any = None,
    **options: Any,
) -> Sensitivities:
    """Compute derivatives of results with respect to parameters by central differences. A parameter
    is a number or a vector of numbers. For each number, four runs give two difference quotients:
    one with a change of the number, and one with half this change. Richardson's extrapolation from
    both quotients gives the derivative. The difference of the two quotients shows how certain the
    derivative is.

    parameters: a dict from "element.field" to the value at which the derivatives are computed, such
        as {"rod.mass": 0.2}. An orientation cannot be a parameter.
    relative_step: change of a number, relative to its value. If a number in a vector is 0, its
        change is relative to the largest number of the vector.
    steps: a dict from "element.field" to the absolute change of this parameter, which replaces
        relative_step. A parameter that is 0 needs such a change.
    times, method, record, reduce, executor, options: as in baum.sweep().

    Take a method with a fixed step, such as "rk8" with `step`, and check the integration error by a
    second call with half the step. Results of methods with variable steps do not depend smoothly on
    parameters. Warns with UncertainSensitivityWarning if the two difference quotients of a
    derivative differ by more than 1e-4 of the largest derivative, unless rounding explains this.
    For a channel, the largest derivative is taken over all samples of a column. For each kind of
    warning that occurs in the runs, one Python warning is issued. Raises baum.Error if a run fails.
    Raises ValueError if the change of a number is not positive, or is below 1e-8 times the number.
    """
    for name in {"samples", "count", "progress", "file"} & set(options):
        raise TypeError(f"sensitivities() got an unexpected keyword argument {name!r}")
    mapping(parameters)
    for name in set(steps or {}) - set(parameters):
        raise KeyError(f"steps: {name!r} is not one of the parameters: {', '.join(parameters)}")
    names: list[str] = []
    values: list[list[float]] = []
    rows: list[dict[str, Array]] = []
    point = {name: np.asarray(value, dtype=float) for name, value in parameters.items()}
    for name, value in point.items():
        scale = np.where(value == 0, np.max(np.abs(value), initial=0.0), np.abs(value))
        given = steps[name] if steps and name in steps else relative_step * scale
        step = np.broadcast_to(np.asarray(given, dtype=float), value.shape)
        for place in np.ndindex(value.shape):
            names.append(name + "".join(f"[{k}]" for k in place))
            _check_step(names[-1], float(step[place]), float(value[place]))
            runs_of = [{**point, name: value.copy()} for _ in CHANGES]
            for row, change in zip(runs_of, step[place] * CHANGES):
                row[name][place] += change
            values.append([float(row[name][place]) for row in runs_of])
            rows += runs_of
    if not rows:
        raise ValueError("sensitivities(): there are no parameters")
    columns = {name: np.array([row[name] for row in rows]) for name in point}
    runs = sweep(mechanism, columns, times, method, record=record, reduce=reduce, executor=executor,
                 **options)  # fmt: skip
    for k, message in runs.messages.items():
        where = f"{names[k // 4]} = {values[k // 4][k % 4]:.9g}"
        raise errors.Error(runs.status[k], f"the run with {where}: {message}")
    made = Sensitivities(names, np.array(values), runs)
    _warn(made, np.array(values), runs, is_channel=reduce is None)
    return made


def _check_step(name: str, step: float, value: float) -> None:
    if not 0 < step < np.inf:
        raise ValueError(f"{name}: its step is {step:g}, must be > 0: pass it in `steps`")
    if step < LEAST_STEP * abs(value):
        raise ValueError(
            f"{name}: its step is {step:g}, which is below {LEAST_STEP:g} of {value:g}"
        )


def _warn(made: Sensitivities, values: Array, runs: Sweep, is_channel: bool) -> None:
    """Repeat the warnings of the runs, and warn of derivatives that are uncertain."""
    for kind in sorted({kind for found in runs.warnings for kind in found}):
        count = sum(kind in found for found in runs.warnings)
        warnings.warn(f"{kind} in {count} of {len(runs)} runs; Mechanism.simulate() gives its text",
                      getattr(errors, kind), stacklevel=3)  # fmt: skip
    for name in made.keys():
        error = made.error(name)
        over = 0 if is_channel else tuple(range(error.ndim - 1))
        largest = np.fmax.reduce(np.abs(made[name]), axis=over, keepdims=True)
        rounding = (
            ROUNDING * np.nanmax(np.abs(runs[name]), initial=0.0) / (values[:, 0] - values[:, 1])
        )
        # A comparison with NaN is false, so a derivative that is NaN counts as uncertain.
        doubtful = ~((error <= UNCERTAIN * largest) | (error <= rounding))
        for k in np.flatnonzero(doubtful.reshape(-1, len(values)).any(axis=0))[:1]:
            warnings.warn(
                f"the derivative of {name} with respect to {made.parameters[k]} is uncertain: two "
                "difference steps of this parameter give different values. Take a method with a "
                'fixed step, such as "rk8" with step, or another difference step (argument steps).',
                errors.UncertainSensitivityWarning,
                stacklevel=3,
            )
