# SPDX-License-Identifier: BSD-3-Clause
"""Rules that choose Baumgarte's gains alpha and beta [1/s] in Phi'' + 2 alpha Phi' + beta^2 Phi =
0.

Each function returns a rule, which you pass to a run as the option `gains`. The functions raise
TypeError for values that are not numbers. The run raises baum.Error for values that are out of
range.
"""

from __future__ import annotations

from ._lib import lib
from ._values import number
from .typing import Scalar


class Gains:
    """A gain rule and its numbers. Functions such as baum.fixed() and baum.auto() make such rules.

    name: the name of the function that made the rule.
    values: the arguments of this function, as a dict from their names to their values.
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
    """Gains that you choose: alpha and beta [1/s], both >= 0."""
    return Gains("fixed", alpha=alpha, beta=beta)


def scaled(alpha_h: Scalar, beta2_h2: Scalar) -> Gains:
    """Gains given relative to the step h: alpha h and (beta h)^2 [-], both >= 0. They need a fixed
    step."""
    return Gains("scaled", alpha_h=alpha_h, beta2_h2=beta2_h2)


def taylor() -> Gains:
    """Gains for which the Taylor expansion of the violation to second order is zero after one step:
    alpha = 1/h and beta = sqrt(2)/h, where h is the step. They need a fixed step. With explicit
    Euler they are marginally stable, so violations do not decay."""
    return Gains("taylor")


def frequency(hertz: Scalar, damping_ratio: Scalar) -> Gains:
    """Gains like those of an oscillator: beta = 2 pi hertz and alpha = damping_ratio x beta.

    hertz: natural frequency [Hz], positive.
    damping_ratio: [-] positive; 1 is critical damping.
    """
    return Gains("frequency", hertz=hertz, damping_ratio=damping_ratio)


def deadbeat() -> Gains:
    """Gains with the fastest decay: a violation vanishes after at most two steps. They need a fixed
    step. Runge-Kutta methods of order above 1 lose order with these gains. Multistep methods have
    no such gains, so a run with such a method refuses this rule."""
    return Gains("deadbeat")


def best_damping() -> Gains:
    """Gains of least spectral radius, which let violations decay fastest. If a method has dead-beat
    gains, the rule chooses them. The rule needs a fixed step. It is the default of "ab2", "ab3" and
    "ab4", which keep their order with these gains."""
    return Gains("best_damping")


def auto() -> Gains:
    """Gains that suit the speed of the motion.

    The gains are alpha = beta = c omega, where omega is the mean angular velocity over roughly the
    first 4 rad of the motion. This angular velocity is max(|v|/L, sqrt(|a|/L)), where v are
    velocities, a are accelerations, and L is the characteristic length. The factor c depends on the
    integrator. It is 0.05 to 0.35, or 0.6 to 40 if drivers prescribe all degrees of freedom. With
    these gains the integrator keeps its order.
    """
    return Gains("auto")
