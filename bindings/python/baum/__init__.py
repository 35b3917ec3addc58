# SPDX-License-Identifier: BSD-3-Clause
"""Dynamics of constrained multibody systems.

    import baum, numpy as np

    m = baum.Mechanism()
    bob = m.planar_particle("bob", mass=1, position=(1, 0))
    m.constraint("circle", [bob], rows=1, phi=lambda t, q: q @ q - 1)
    times = np.linspace(0, 10, 101)
    run = m.freeze().simulate(times, "rk4", step=1e-3, record=["circle.phi", "energy"])
    run.t, run["bob.pose"], run["circle.phi"], run.counters, run.explain

The library that does the work is found beside this package, in the build tree, or by the system's
loader; the environment variable BAUM_LIBRARY names another.
"""
import importlib

from . import _abi, _lib
from .channels import Channel, a, energy, energy_account, lambda_, phi, phi_rate, q, v
from .elements import Body, Force, Input, Joint
from .errors import WARNINGS, DoubtWarning, Error, Retry, Status, Warning
from .gains import Gains, auto, best_damping, deadbeat, fixed, frequency, scaled, taylor
from .integrators import (
    Amplification, Integrator, integrators, stability, stability_best, stability_best_on_ray,
    stability_deadbeat, stability_grid, stability_intervals, stability_limit, stability_nearest,
    stability_outline, stability_statement,
)
from .mechanism import Mechanism, Mobility, Report, Sizes
from .run import Counters, EnergyAccount, Event, NearSingular, Run
from .simulation import Simulation
from .studies import Recommendation, Study, StudyEntry, StudyMethod, StudyReference, study
from .workspace import Workspace

globals().update(WARNINGS)

__version__ = _abi.VERSION
library = _lib.path
library_version = _lib.version


def __getattr__(name):
    # A library of its own, which may be missing.
    if name == "catalog":
        return importlib.import_module(".catalog", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def has(feature):
    """Whether the library was built with "sundials"."""
    return _lib.lib.baum_has(feature.encode())


__all__ = [
    *WARNINGS, "Amplification", "Body", "Channel", "Counters", "DoubtWarning", "EnergyAccount", "Error",
    "Event", "Force", "Gains",
    "Input", "Integrator", "Joint", "Mechanism", "Mobility", "NearSingular", "Recommendation",
    "Report", "Retry", "Run", "Simulation", "Sizes", "Status", "Study", "StudyEntry", "StudyMethod",
    "StudyReference", "Warning", "Workspace", "a", "auto", "best_damping", "deadbeat",
    "energy", "energy_account",
    "fixed", "frequency", "has", "integrators", "lambda_", "library", "library_version",
    "phi", "phi_rate",
    "q", "scaled", "stability", "stability_best", "stability_best_on_ray",
    "stability_deadbeat", "stability_grid", "stability_intervals", "stability_limit",
    "stability_nearest", "stability_outline", "stability_statement",
    "study", "taylor", "v",
]
