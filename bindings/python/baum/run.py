# SPDX-License-Identifier: BSD-3-Clause
"""What a run came to."""

from collections import namedtuple

import numpy as np

from . import _abi
from .channels import Channel
from .errors import Status

Counters = namedtuple("Counters", [name for name, _ in _abi.baum_counters._fields_[1:]])
Counters.__doc__ = """What a run has cost and how well constraints were kept since it was created;
see baum_counters in simulation.h. Joints are handles or None, times in seconds."""

EnergyAccount = namedtuple(
    "EnergyAccount", [name for name, _ in _abi.baum_energy_account._fields_[1:]]
)
EnergyAccount.__doc__ = """Where the energy of a run has come from [J]; see baum_energy_account in
simulation.h."""

NearSingular = namedtuple("NearSingular", [name for name, _ in _abi.baum_near_singular._fields_[1:]])
NearSingular.__doc__ = """An interval in which a run was near a singular pose; see
baum_near_singular in simulation.h. The branch is a word such as "continued" or "left"."""


Event = namedtuple("Event", "t event direction")
Event.__doc__ = """An event that has happened: when [s], its number as Simulation.event() has given
it, and 1 for rising in time or -1 for falling."""


class Run:
    """Samples of a run. t is (n), q (n x nq), v (n x nv); run["B.phi"] or run[m["B"].phi] (n x
    columns) is a recorded channel. Poses and velocities of bodies need no recording, they are parts
    of q and v.

    status: OK, WARNED, or STOP_CANCELLED and STOP_EVENT (then the samples end early); counters;
    explain: in words how it was done; warnings: a baum.Warning for each kind; near_singular, events: of the whole
    simulation so far; energy_account: at the end, None without the option.
    """

    def __init__(self, mechanism, layout, times, rows, status, account):
        self.mechanism = mechanism
        self.t = times
        self.status = status
        self.counters, self.explain, self.warnings = account
        self.near_singular = []
        self.events = []
        self.energy_account = None
        self._layout = layout
        self._rows = rows
        self.q = self["q"]
        self.v = self["v"]

    def __repr__(self):
        name = self.status.name if isinstance(self.status, Status) else self.status
        return f"<run of {len(self.t)} samples, {self.counters.steps} steps, {name}>"

    def keys(self):
        """Names of the recorded channels."""
        return list(self._layout.slices)

    def __iter__(self):
        return iter(self.keys())

    def __contains__(self, key):
        name = key.key if isinstance(key, Channel) else key
        return name in self._layout.slices or self._of_body(name) is not None

    def __getitem__(self, key):
        """The columns of a channel, given by itself or by name."""
        name = key.key if isinstance(key, Channel) else key
        place = self._layout.slices.get(name)
        if place is not None:
            return self._rows[:, place]
        columns = self._of_body(name)
        if columns is None:
            raise KeyError(
                f"{name!r} was not recorded; there are {', '.join(self.keys())} and poses and "
                "velocities of bodies; name others in record=[...]"
            )
        return columns

    def _of_body(self, name):
        """Pose or velocity of a body out of q and v, or None."""
        body, _, what = str(name).rpartition(".")
        if what not in ("pose", "velocity") or body not in self.mechanism:
            return None
        element = self.mechanism[body]
        if element.family != "body" or element.kind is None:
            return None
        q, v = element.columns
        return np.ascontiguousarray(self.q[:, q] if what == "pose" else self.v[:, v])
