# SPDX-License-Identifier: BSD-3-Clause
"""Sensitivities: derivatives of the results of runs with respect to parameters, by differences."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, Mapping, Sequence

import numpy as np

from . import errors
from .sweeps import Reduce, Sweep, sweep
from .typing import Array, ArrayLike, ChannelLike

if TYPE_CHECKING:
    from .mechanism import Mechanism

CHANGES = np.array([1.0, -1.0, 0.5, -0.5])  # of a parameter in four runs, in steps
UNCERTAIN = 1e-4  # share of the largest derivative
NEGLIGIBLE = 1e-6  # share of result / parameter, below which a derivative may be uncertain


class Sensitivities:
    """The derivatives of results with respect to p parameters.

    parameters: their names. A vector field has one name for each number, such as "rod.position[0]".

    sensitivities["rod.pose"] contains the derivatives (samples x columns x p) of a channel. If
    `reduce` was given, sensitivities["value"] contains those of its results (... x p).
    error(name) is an array of the same shape, an estimate of the errors of these derivatives.
    """

    def __init__(
        self, parameters: Sequence[str], steps: Array, results: Mapping[str, Array]
    ) -> None:
        self.parameters = tuple(parameters)
        self._values: dict[str, Array] = {}
        self._errors: dict[str, Array] = {}
        for name, values in results.items():
            # axis 0: parameters, axis 1: the four runs of each parameter
            runs = np.moveaxis(values.reshape(len(steps), 4, *values.shape[1:]), (0, 1), (-1, 0))
            coarse, fine = (runs[0] - runs[1]) / (2 * steps), (runs[2] - runs[3]) / steps
            self._values[name] = (4 * fine - coarse) / 3  # Richardson's extrapolation
            self._errors[name] = np.abs(fine - coarse)

    def __repr__(self) -> str:
        return f"<sensitivities of {', '.join(self._values)} to {', '.join(self.parameters)}>"

    def keys(self) -> list[str]:
        """The names of the results."""
        return list(self._values)

    def __getitem__(self, name: str) -> Array:
        found = self._values.get(name)
        if found is None:
            raise KeyError(f"no {name!r} here; there are: {', '.join(self._values)}")
        return found

    def error(self, name: str) -> Array:
        """An estimate of the errors of the derivatives. It is the difference between the difference
        quotients of two steps. It contains the errors of the runs, too."""
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
    steps: Mapping[str, float] | None = None,
    executor: Any = None,
    **options: Any,
) -> Sensitivities:
    """Compute derivatives of results with respect to parameters by central differences. Four runs
    for each number of a parameter give differences for two steps. Richardson's extrapolation from
    both gives the derivative, and their difference estimates its error.

    parameters: the values at which the derivatives are computed, by "element.field", such as
        {"rod.mass": 0.2}.
    relative_step: change of a parameter, relative to its value; for a vector, relative to its
        largest number.
    steps: changes of single parameters, in place of relative_step. A parameter that is 0 needs one.
    times, method, record, reduce, executor, options: as in baum.sweep().

    Take a method with a fixed step, such as "rk8" with `step`. Results of methods with variable
    steps do not depend smoothly on parameters. Warns with UncertainSensitivityWarning if the error
    of a derivative may exceed 1e-4 of the largest derivative of the same result with respect to
    this parameter. Raises baum.Error if a run fails, and ValueError for a step that is not > 0.
    """
    names, changes, rows = [], [], []
    point = {name: np.asarray(value, dtype=float) for name, value in parameters.items()}
    for name, value in point.items():
        relative = relative_step * float(np.max(np.abs(value), initial=0.0))
        step = float(steps[name]) if steps and name in steps else relative
        if not 0 < step < np.inf:
            raise ValueError(f"{name}: its step is {step:g}, must be > 0: pass it in `steps`")
        for place in np.ndindex(value.shape):
            names.append(name + "".join(f"[{k}]" for k in place))
            changes.append(step)
            for change in step * CHANGES:
                rows.append({**point, name: value.copy()})
                rows[-1][name][place] += change
    columns = {name: np.array([row[name] for row in rows]) for name in point}
    runs = sweep(mechanism, columns, times, method, record=record, reduce=reduce, executor=executor,
                 **options)  # fmt: skip
    for k, message in runs.messages.items():
        raise errors.Error(runs.status[k], message)
    made = Sensitivities(names, np.array(changes), {name: runs[name] for name in runs.keys()})
    _warn(made, runs, np.array(changes) / relative_step)
    return made


def _warn(made: Sensitivities, runs: Sweep, scales: Array) -> None:
    """Repeat the warnings of the runs, and warn of derivatives that are uncertain. `scales` are the
    magnitudes of the parameters."""
    for kind in sorted({kind for found in runs.warnings for kind in found}):
        count = sum(kind in found for found in runs.warnings)
        warnings.warn(f"{count} of {len(runs)} runs have this warning", getattr(errors, kind),
                      stacklevel=3)  # fmt: skip
    for name in made.keys():
        values, doubts = (np.abs(x).reshape(-1, len(scales)).max(axis=0, initial=0.0)
                          for x in (made[name], made.error(name)))  # fmt: skip
        negligible = NEGLIGIBLE * np.max(np.abs(runs[name]), initial=0.0) / scales
        shares = doubts / np.maximum(values, np.finfo(float).tiny)
        doubtful = (shares > UNCERTAIN) & (doubts > negligible)
        if np.any(doubtful):
            worst = int(np.argmax(np.where(doubtful, shares, 0.0)))
            warnings.warn(
                f"the derivative of {name} with respect to {made.parameters[worst]} is uncertain "
                f"by {shares[worst]:.1g} of its largest value: two steps give different values. "
                'Take a method with a fixed step, such as "rk8" with step, or another step.',
                errors.UncertainSensitivityWarning,
                stacklevel=3,
            )
