# SPDX-License-Identifier: BSD-3-Clause
"""Baumgarte's gains: how alpha and beta [1/s] in Phi'' + 2 alpha Phi' + beta^2 Phi = 0 are
chosen."""

from ._lib import lib
from ._values import number


class Gains:
    """A rule with its numbers, made by the functions of this module."""

    __slots__ = ("name", "values", "struct")

    def __init__(self, name, **values):
        self.name = name
        self.values = {key: number(value, f"gains {name}: {key}") for key, value in values.items()}
        self.struct = getattr(lib, f"baum_gains_{name}")(*self.values.values())

    def __repr__(self):
        return f"{self.name}({', '.join(f'{key}={value:g}' for key, value in self.values.items())})"

    def __eq__(self, other):
        return isinstance(other, Gains) and (self.name, self.values) == (other.name, other.values)

    def __hash__(self):
        return hash((self.name, *self.values.values()))


def fixed(alpha, beta):
    """Gains as numbers [1/s] >= 0."""
    return Gains("fixed", alpha=alpha, beta=beta)


def scaled(alpha_h, beta2_h2):
    """Gains relative to the step h: alpha h and (beta h)^2, both >= 0. Fixed step only."""
    return Gains("scaled", alpha_h=alpha_h, beta2_h2=beta2_h2)


def taylor():
    """Gains of the Taylor expansion: alpha = 1/h, beta = sqrt(2)/h. Marginal with explicit
    Euler."""
    return Gains("taylor")


def frequency(hertz, damping_ratio):
    """Gains of an oscillator: beta = 2 pi hertz, alpha = damping_ratio x beta; both > 0."""
    return Gains("frequency", hertz=hertz, damping_ratio=damping_ratio)


def deadbeat():
    """Fastest decay per step. Fixed step only; it costs Runge-Kutta methods of order above 1 their
    order, and methods of several steps have no such point."""
    return Gains("deadbeat")


def best_damping():
    """Least spectral radius: the dead-beat point where there is one. The rule for AB2 to AB4, which
    keep their order with it. Fixed step only."""
    return Gains("best_damping")


def auto():
    """alpha = beta = 0.05 to 0.35 x, by integrator, the mean angular rate over the first radians of
    the motion; keeps the order of the method. More where drivers take all freedom."""
    return Gains("auto")
