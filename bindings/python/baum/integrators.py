# SPDX-License-Identifier: BSD-3-Clause
"""Integrators by name, and what they make of Baumgarte's gains."""

import ctypes
from collections import namedtuple

import numpy as np

from . import _abi, _calls
from ._lib import lib
from ._values import number, vector


def names(enum, prefix):
    """The values of an enum of the library by their names in lower case."""
    return {value.name[len(prefix) :].lower(): value for value in enum}


FORMULATIONS = names(_abi.baum_formulation, "BAUM_FORMULATION_")
STABILITIES = {value: name for name, value in names(_abi.baum_stability, "BAUM_").items()}


class Integrator:
    """A method: name, order (0 when it varies), whether it takes `step`, whether `rtol` (a run is
    given one of them), and its formulations. "kinematics" takes none of these: see Simulation."""

    def __init__(self, address):
        self.address = address
        self.name = lib.baum_integrator_name(address).decode()
        self.order = lib.baum_integrator_order(address)
        self.fixed_step = lib.baum_integrator_has_fixed_step(address)
        self.variable_step = lib.baum_integrator_has_variable_step(address)
        self.formulations = tuple(
            name
            for name, value in FORMULATIONS.items()
            if name != "default" and lib.baum_integrator_offers(address, value)
        )

    def __repr__(self):
        return f"<integrator {self.name}>"


def _find_all():
    found = []
    while True:
        address = lib.baum_integrator_at(len(found))
        if not address:
            return {one.name: one for one in found}
        found.append(Integrator(address))


_ALL = _find_all()


def integrators():
    """All integrators by name: euler, semi_implicit_euler, rk2, rk3, rk4, dp5, rk8, ab2, ab3, ab4,
    rattle, generalized_alpha, kinematics, and with SUNDIALS cvode_adams, cvode_bdf, ida."""
    return dict(_ALL)


def lookup(value):
    """The Integrator for one or its name."""
    if isinstance(value, Integrator):
        return value
    try:
        return _ALL[value]
    except (KeyError, TypeError):
        raise ValueError(f"no integrator {value!r}; there are: {', '.join(_ALL)}") from None


class Amplification(namedtuple("Amplification", "stability spectral_radius roots damping")):
    """What becomes of a violation: "stable", "marginal", "unstable", "variable_step" or
    "without_gains"; the largest |z|; the largest root z of each of the two modes; what a step takes
    off a violation, 1 - |z| with all its digits. Numbers are NaN without a region."""

    __slots__ = ()


def stability(integrator, alpha_h, beta2_h2):
    """Amplification at a point (alpha h, (beta h)^2) of the plane of Fig. 1."""
    out = _abi.baum_amplification()
    _calls.make(
        lib.baum_stability_at,
        lookup(integrator).address,
        number(alpha_h, "alpha_h"),
        number(beta2_h2, "beta2_h2"),
        ctypes.byref(out),
        ctypes.sizeof(out),
    )
    roots = tuple(complex(*root) for root in out.z)
    return Amplification(STABILITIES[out.stability], out.spectral_radius, roots, out.damping)


def stability_limit(integrator, damping_ratio=1.0):
    """Largest alpha h for which alpha = damping_ratio x beta is stable; 0 when nothing is."""
    return _numbers(
        lib.baum_stability_limit, 1, integrator, number(damping_ratio, "damping_ratio")
    )[0]


def stability_intervals(integrator, damping_ratio=1.0):
    """All intervals of alpha h for which alpha = damping_ratio x beta is stable: array (n, 2)."""
    ratio = number(damping_ratio, "damping_ratio")
    return _arrays(lib.baum_stability_intervals, integrator, ratio)


def stability_best(integrator):
    """The point (alpha h, (beta h)^2) of least spectral radius."""
    return _numbers(lib.baum_stability_best, 2, integrator)


def stability_best_on_ray(integrator, damping_ratio=1.0):
    """The alpha h of least spectral radius for alpha = damping_ratio x beta; 0 when none is stable."""
    return _numbers(
        lib.baum_stability_best_on_ray, 1, integrator, number(damping_ratio, "damping_ratio")
    )[0]


def stability_deadbeat(integrator):
    """The point (alpha h, (beta h)^2) where all roots are zero; one-step methods."""
    return _numbers(lib.baum_stability_deadbeat, 2, integrator)


def stability_nearest(integrator, alpha_h, beta2_h2):
    """The nearest point that damps well, itself when it does."""
    return _numbers(
        lib.baum_stability_nearest,
        2,
        integrator,
        number(alpha_h, "alpha_h"),
        number(beta2_h2, "beta2_h2"),
    )


def stability_grid(integrator, alpha_h, beta2_h2, shape=(100, 100)):
    """Spectral radii over a rectangle: alpha_h and beta2_h2 are (first, last), both included.

    Array of `shape` (rows of beta2_h2, columns of alpha_h).
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


def stability_outline(integrator, radius=1.0):
    """Where the spectral radius is `radius`: array (n, 2) of (alpha h, (beta h)^2), closed curves
    with a row of NaN between them, which is how Matplotlib draws them apart."""
    return _arrays(lib.baum_stability_outline, integrator, number(radius, "radius"))


def stability_statement(integrator):
    """What gains do with a method in words, also with one that chooses its steps."""
    return lib.baum_stability_statement(lookup(integrator).address).decode()


def _arrays(function, integrator, value):
    """Call a function that fills two arrays, first to ask how long they are."""
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


def _numbers(function, count, integrator, *arguments):
    """Call a function that gives `count` numbers."""
    outs = [ctypes.c_double() for _ in range(count)]
    _calls.make(function, lookup(integrator).address, *arguments, *map(ctypes.byref, outs))
    return tuple(out.value for out in outs)
