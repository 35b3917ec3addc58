# SPDX-License-Identifier: BSD-3-Clause
"""Baumgarte's gains: rules for alpha and beta [1/s] in Phi'' + 2 alpha Phi' + beta^2 Phi = 0.

Each function returns a rule for the option `gains` of a run. It raises TypeError for values that
are not numbers; the run raises baum.Error for values that are out of range.
"""

from __future__ import annotations

from ._lib import lib
from ._values import number
from .typing import Scalar


class Gains:
    """A rule with its numbers, made by one of the functions of this module.

    name: the name of that function. values: its arguments by name.
    """

    __slots__ = ("name", "values", "struct")

    def __init__(self, name: str, **values: Scalar) -> None:
        self.name = name
        self.values = {key: number(value, f"gains {name}: {key}") for key, value in values.items()}
        self.struct = getattr(lib, f"baum_gains_{name}")(*self.values.values())

    def __repr__(self) -> str:
        return f"{self.name}({', '.join(f'{key}={value:g}' for key, value in self.values.items())})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Gains) and (self.name, self.values) == (other.name, other.values)

    def __hash__(self) -> int:
        return hash((self.name, *self.values.values()))


def fixed(alpha: Scalar, beta: Scalar) -> Gains:
    """Given gains [1/s], both >= 0."""
    return Gains("fixed", alpha=alpha, beta=beta)


def scaled(alpha_h: Scalar, beta2_h2: Scalar) -> Gains:
    """Gains relative to the step h: alpha h and (beta h)^2 [-], both >= 0. Needs a fixed step."""
    return Gains("scaled", alpha_h=alpha_h, beta2_h2=beta2_h2)


def taylor() -> Gains:
    """Gains of the Taylor expansion: alpha = 1/h and beta = sqrt(2)/h with the step h. They are
    marginally stable with explicit Euler."""
    return Gains("taylor")


def frequency(hertz: Scalar, damping_ratio: Scalar) -> Gains:
    """Gains given as an oscillator: beta = 2 pi hertz and alpha = damping_ratio x beta. hertz:
    natural frequency [Hz] > 0. damping_ratio: [-] > 0, 1 is critical."""
    return Gains("frequency", hertz=hertz, damping_ratio=damping_ratio)


def deadbeat() -> Gains:
    """Gains with the fastest decay per step. Needs a fixed step. Runge-Kutta methods of order above
    1 lose their order with these gains. Multistep methods have no such gains and refuse the rule.
    """
    return Gains("deadbeat")


def best_damping() -> Gains:
    """Gains of least spectral radius, which is the dead-beat point if there is one. This is the
    default rule of "ab2", "ab3" and "ab4", which keep their order with these gains. Needs a fixed
    step."""
    return Gains("best_damping")


def auto() -> Gains:
    """alpha = beta = 0.05 to 0.35 times the mean angular velocity over the first radians of the
    motion; the factor depends on the integrator, which keeps its order. Gains are larger if drivers
    prescribe all degrees of freedom."""
    return Gains("auto")
