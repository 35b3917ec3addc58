# SPDX-License-Identifier: BSD-3-Clause
"""Integrators by name, and the stability of Baumgarte's gains with them.

The functions stability...() take an integrator or its name. All of them raise ValueError for a name
that does not exist, and TypeError for values that are not numbers. Some integrators, such as
"cvode_bdf" and "rattle", have no region of stability. For these integrators, most of the functions
raise baum.Error.
"""

from __future__ import annotations

import ctypes
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np

from . import _abi, _calls
from ._lib import lib, text
from ._values import number, there_are, vector
from .typing import Array, ArrayLike, Scalar


def names(enum: type[IntEnum], prefix: str) -> dict[str, int]:
    """Return a dict from the names of an enum of the library, in lower case, to their values."""
    return {value.name[len(prefix) :].lower(): value for value in enum}


FORMULATIONS = names(_abi.baum_formulation, "BAUM_FORMULATION_")
STABILITIES = {value: name for name, value in names(_abi.baum_stability, "BAUM_").items()}


class Integrator:
    """An integration method.

    name: the name of the method, which you can pass as the argument `integrator`.
    order: order of accuracy; 0 if it varies.
    fixed_step: whether the method takes the option `step`.
    variable_step: whether the method takes the option `rtol`. If it takes both options, give a run
        either `step` or `rtol`. "kinematics" takes neither of them.
    formulations: names of the formulations that the method offers. The first one is the default.
    """

    def __init__(self, address: int) -> None:
        self.address = address
        self.name: str = lib.baum_integrator_name(address).decode()
        self.order: int = lib.baum_integrator_order(address)
        self.fixed_step: bool = lib.baum_integrator_has_fixed_step(address)
        self.variable_step: bool = lib.baum_integrator_has_variable_step(address)
        self.formulations: tuple[str, ...] = tuple(
            name
            for name, value in FORMULATIONS.items()
            if name != "default" and lib.baum_integrator_offers(address, value)
        )

    def __repr__(self) -> str:
        return f"<integrator {self.name}>"


def _find_all() -> dict[str, Integrator]:
    found: list[Integrator] = []
    while True:
        address = lib.baum_integrator_at(len(found))
        if not address:
            return {one.name: one for one in found}
        found.append(Integrator(address))


_ALL = _find_all()


def integrators() -> dict[str, Integrator]:
    """Return all integrators by name: euler, semi_implicit_euler, rk2, rk3, rk4, dp5, rk8, ab2,
    ab3, ab4, rattle, generalized_alpha, kinematics, cvode_adams, cvode_bdf and ida. The last three
    can run only if baum.has("sundials") is true."""
    return dict(_ALL)


def lookup(value: Any) -> Integrator:
    """Return the Integrator for an Integrator or its name."""
    if isinstance(value, Integrator):
        return value
    try:
        return _ALL[value]
    except (KeyError, TypeError):
        raise ValueError(f"no integrator {value!r}; {there_are(_ALL, value)}") from None


class Amplification(NamedTuple):
    """How one step changes a constraint violation: the violation is a sum of modes, and the step
    multiplies each mode by a root z of the characteristic equation of the integrator.

    stability: "stable", "marginal" or "unstable"; for methods without a region of stability,
        "variable_step" or "without_gains".
    spectral_radius: the largest |z| [-]. Violations decay if it is below 1.
    roots: for each of the two modes, the root z with the largest |z|.
    damping: 1 - spectral_radius, computed without cancellation. This is the fraction of a violation
        that one step removes, for the mode that decays most slowly.

    The numbers are NaN for methods without a region of stability.
    """

    stability: str
    spectral_radius: float
    roots: tuple[complex, complex]
    damping: float


def stability(
    integrator: str | Integrator, alpha_h: Scalar, beta2_h2: Scalar | None = None
) -> Amplification:
    """Compute the amplification of a constraint violation in one step h with the gains alpha h [-]
    and (beta h)^2 [-].

    Without beta2_h2 the result applies to rows at velocity level, which have no beta. A violation
    of such a row has only one mode, so the second root is NaN.
    """
    out = _abi.baum_amplification()
    gains = [number(alpha_h, "alpha_h")]
    call = lib.baum_stability_velocity_at
    if beta2_h2 is not None:
        gains.append(number(beta2_h2, "beta2_h2"))
        call = lib.baum_stability_at
    _calls.make(call, lookup(integrator).address, *gains, ctypes.byref(out), ctypes.sizeof(out))
    first, second = (complex(*root) for root in out.z)
    stability = STABILITIES[out.stability]
    return Amplification(stability, out.spectral_radius, (first, second), out.damping)


def stability_limit(
    integrator: str | Integrator, damping_ratio: Scalar = 1.0, *, velocity_level: bool = False
) -> float:
    """Return the stability limit for gains with alpha = damping_ratio x beta: they are stable from
    alpha h = 0 up to this limit [-]. The limit is 0 if even small gains are unstable.
    velocity_level: True returns the limit for rows at velocity level, which have no beta."""
    if velocity_level:
        return _numbers(lib.baum_stability_velocity_limit, 1, integrator)[0]
    ratio = number(damping_ratio, "damping_ratio")
    return _numbers(lib.baum_stability_limit, 1, integrator, ratio)[0]


def stability_intervals(integrator: str | Integrator, damping_ratio: Scalar = 1.0) -> Array:
    """Return all intervals of alpha h [-] in which gains with alpha = damping_ratio x beta are
    stable (n x 2)."""
    ratio = number(damping_ratio, "damping_ratio")
    return _arrays(lib.baum_stability_intervals, integrator, ratio)


def stability_best(integrator: str | Integrator) -> tuple[float, float]:
    """Return the point (alpha h, (beta h)^2) [-] of least spectral radius."""
    return _point(lib.baum_stability_best, integrator)


def stability_best_on_ray(integrator: str | Integrator, damping_ratio: Scalar = 1.0) -> float:
    """Return the alpha h [-] of least spectral radius among gains with alpha = damping_ratio x
    beta; 0 if none of them is stable."""
    ratio = number(damping_ratio, "damping_ratio")
    return _numbers(lib.baum_stability_best_on_ray, 1, integrator, ratio)[0]


def stability_deadbeat(integrator: str | Integrator) -> tuple[float, float]:
    """Return the point (alpha h, (beta h)^2) [-] where all roots z are zero, so that a violation
    vanishes after at most two steps. Only one-step methods have such a point."""
    return _point(lib.baum_stability_deadbeat, integrator)


def stability_nearest(
    integrator: str | Integrator, alpha_h: Scalar, beta2_h2: Scalar
) -> tuple[float, float]:
    """Return the point (alpha h, (beta h)^2) [-] with a spectral radius of at most 0.9 that is
    nearest to the given point."""
    return _point(
        lib.baum_stability_nearest,
        integrator,
        number(alpha_h, "alpha_h"),
        number(beta2_h2, "beta2_h2"),
    )


def stability_grid(
    integrator: str | Integrator,
    alpha_h: ArrayLike,
    beta2_h2: ArrayLike,
    shape: tuple[int, int] = (100, 100),
) -> Array:
    """Compute spectral radii on a rectangular grid of alpha h and (beta h)^2.

    alpha_h: first and last value of alpha h [-].
    beta2_h2: first and last value of (beta h)^2 [-].
    shape: number of rows and number of columns. Each row belongs to a value of `beta2_h2`, and each
        column to a value of `alpha_h`.
    """
    rows, columns = shape
    columns_range = vector(alpha_h, 2, "alpha_h")
    rows_range = vector(beta2_h2, 2, "beta2_h2")
    radius = np.empty((rows, columns))
    _calls.make(
        lib.baum_stability_grid,
        lookup(integrator).address,
        columns_range.ctypes.data,
        rows_range.ctypes.data,
        columns,
        rows,
        radius.ctypes.data,
    )
    return radius


def stability_outline(integrator: str | Integrator, radius: Scalar = 1.0) -> Array:
    """Return points (alpha h, (beta h)^2) [-] as an array (n x 2). At these points the spectral
    radius is `radius`. The points form closed curves. A row of NaN separates two curves, so that
    Matplotlib draws them separately."""
    return _arrays(lib.baum_stability_outline, integrator, number(radius, "radius"))


def stability_statement(integrator: str | Integrator) -> str:
    """Describe in words which gains make violations decay. Integrators without a region of
    stability have such a text, too."""
    return text(lib.baum_stability_statement(lookup(integrator).address))


def _arrays(function: Any, integrator: Any, value: float) -> Array:
    """Call a function that fills two arrays. The first call asks for their length, and the second
    call fills them."""
    address = lookup(integrator).address
    count = ctypes.c_int32()
    _calls.make(function, address, value, 0, None, None, ctypes.byref(count))
    out = np.empty((2, count.value))
    _calls.make(
        function,
        address,
        value,
        count,
        out[0].ctypes.data,
        out[1].ctypes.data,
        ctypes.byref(count),
    )
    return out.T.copy()


def _numbers(function: Any, count: int, integrator: Any, *arguments: float) -> list[float]:
    """Call a function that writes `count` numbers, and return these."""
    outs = [ctypes.c_double() for _ in range(count)]
    _calls.make(function, lookup(integrator).address, *arguments, *map(ctypes.byref, outs))
    return [out.value for out in outs]


def _point(function: Any, integrator: Any, *arguments: float) -> tuple[float, float]:
    alpha_h, beta2_h2 = _numbers(function, 2, integrator, *arguments)
    return alpha_h, beta2_h2
