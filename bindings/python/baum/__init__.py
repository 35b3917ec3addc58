# SPDX-License-Identifier: BSD-3-Clause
"""Dynamics of constrained multibody systems.

    import baum, numpy as np

    m = baum.Mechanism()
    bob = m.planar_particle("bob", mass=1, position=(1, 0))
    m.constraint("circle", [bob], rows=1, phi=lambda t, q: q @ q - 1)
    times = np.linspace(0, 10, 101)
    run = m.freeze().simulate(times, "rk4", step=1e-3, record=["circle.phi", "energy"])
    run.t, run["bob.pose"], run["circle.phi"], run.counters, run.explain

The package searches for the C library in its own folder, in the build tree, in the folder `lib` of
the virtual environment, and on the path of the system's loader. If the environment variable
BAUM_LIBRARY is set, it names the file to load.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from . import _abi, _lib, inertia
from ._records import StudyEntry, StudyMethod, StudyReference
from .channels import Channel, a, energy, energy_account, lambda_, phi, phi_rate, q, v
from .elements import Body, Force, Input, Joint
from .errors import (
    AccuracyWarning,
    BranchWarning,
    BushingWarning,
    ContradictionWarning,
    DoubtWarning,
    EnergyAccountWarning,
    Error,
    ErrorUnknownWarning,
    GainsWarning,
    IllConditionedWarning,
    Index3Warning,
    LooseVelocitiesWarning,
    NoisyDerivativesWarning,
    RedundantRowsWarning,
    Retry,
    SingularityCrossedWarning,
    SingularStartWarning,
    Status,
    UncertainSensitivityWarning,
    ViolationWarning,
    Warning,
    WrongDerivativeWarning,
)
from .gains import Gains, auto, best_damping, deadbeat, fixed, frequency, scaled, taylor
from .integrators import (
    Amplification,
    Integrator,
    integrators,
    stability,
    stability_best,
    stability_best_on_ray,
    stability_deadbeat,
    stability_grid,
    stability_intervals,
    stability_limit,
    stability_nearest,
    stability_outline,
    stability_statement,
)
from .live import View
from .mechanism import Mechanism, Mobility, Report, Sizes
from .outlines import Box, Circle, Cylinder, Mesh, Outline, Polygon, Sphere
from .run import Counters, EnergyAccount, Event, NearSingular, Run
from .scenes import load, parse
from .sensitivity import Sensitivities, sensitivities
from .simulation import Simulation
from .studies import Recommendation, ReferenceSamples, Study, study
from .sweeps import Sweep, sweep
from .workspace import Workspace

if TYPE_CHECKING:
    from . import catalog as catalog

__version__ = _abi.VERSION
library = _lib.path
library_version = _lib.version


def __getattr__(name: str) -> Any:
    # The catalogue is a separate library, which may be missing. It is therefore imported only when
    # it is used.
    if name == "catalog":
        return importlib.import_module(".catalog", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__", "catalog", "typing"])


def has(feature: str) -> bool:
    """Tell whether the library was built with a feature, such as "sundials"."""
    return bool(_lib.lib.baum_has(feature.encode()))


__all__ = [
    "AccuracyWarning",
    "Amplification",
    "Body",
    "Box",
    "BranchWarning",
    "BushingWarning",
    "Channel",
    "Circle",
    "ContradictionWarning",
    "Counters",
    "Cylinder",
    "DoubtWarning",
    "EnergyAccount",
    "EnergyAccountWarning",
    "Error",
    "ErrorUnknownWarning",
    "Event",
    "Force",
    "Gains",
    "GainsWarning",
    "IllConditionedWarning",
    "Index3Warning",
    "Input",
    "Integrator",
    "Joint",
    "LooseVelocitiesWarning",
    "Mechanism",
    "Mesh",
    "Mobility",
    "NearSingular",
    "NoisyDerivativesWarning",
    "Outline",
    "Polygon",
    "Recommendation",
    "RedundantRowsWarning",
    "ReferenceSamples",
    "Report",
    "Retry",
    "Run",
    "Sensitivities",
    "Simulation",
    "SingularStartWarning",
    "SingularityCrossedWarning",
    "Sizes",
    "Sphere",
    "Status",
    "Study",
    "StudyEntry",
    "StudyMethod",
    "StudyReference",
    "Sweep",
    "UncertainSensitivityWarning",
    "View",
    "ViolationWarning",
    "Warning",
    "Workspace",
    "WrongDerivativeWarning",
    "a",
    "auto",
    "best_damping",
    "deadbeat",
    "energy",
    "energy_account",
    "fixed",
    "frequency",
    "has",
    "inertia",
    "integrators",
    "lambda_",
    "library",
    "load",
    "library_version",
    "parse",
    "phi",
    "phi_rate",
    "q",
    "scaled",
    "sensitivities",
    "stability",
    "stability_best",
    "stability_best_on_ray",
    "stability_deadbeat",
    "stability_grid",
    "stability_intervals",
    "stability_limit",
    "stability_nearest",
    "stability_outline",
    "stability_statement",
    "study",
    "sweep",
    "taylor",
    "v",
]
