# SPDX-License-Identifier: BSD-3-Clause
"""What a run came to."""

import copy
from collections import namedtuple

import numpy as np

from . import _abi
from .channels import Channel
from .elements import Element
from .errors import Status


class ByName:
    """What a named tuple does that has handles: it is pickled with their names in place of them."""

    __slots__ = ()

    def __reduce__(self):
        return self._make, ([value.name if isinstance(value, Element) else value for value in self],)

    def __deepcopy__(self, memo):
        return self


class Counters(ByName, namedtuple("Counters", [name for name, _ in _abi.baum_counters._fields_[1:]])):
    """What a run has cost and how well constraints were kept since it was created; see baum_counters
    in simulation.h. Joints are handles or None (names, where it was unpickled), times in seconds."""

    __slots__ = ()


class NearSingular(
    ByName, namedtuple("NearSingular", [name for name, _ in _abi.baum_near_singular._fields_[1:]])
):
    """An interval in which a run was near a singular configuration; see baum_near_singular in
    simulation.h. The branch is a word such as "continued" or "left"; the joint is as in Counters."""

    __slots__ = ()


EnergyAccount = namedtuple(
    "EnergyAccount", [name for name, _ in _abi.baum_energy_account._fields_[1:]]
)
EnergyAccount.__doc__ = """Where the energy of a run has come from [J]; see baum_energy_account in
simulation.h."""

Event = namedtuple("Event", "t event direction")
Event.__doc__ = """An event that has happened: when [s], its number as Simulation.event() has given
it, and 1 for rising in time or -1 for falling."""


class Run:
    """Samples of a run. t is (n), q (n x nq), v (n x nv); run["B.phi"] or run[m["B"].phi] (n x
    columns) is a recorded channel. Poses and velocities of bodies need no recording, they are parts
    of q and v.

    status: OK, WARNED, or STOP_CANCELLED and STOP_EVENT (then the samples end early); counters;
    explain: in words how it was done; warnings: a baum.Warning for each kind; near_singular, events: of the whole
    simulation so far; energy_account: at the end, None without the option. A run can be pickled;
    `mechanism` is None then.
    """

    def __init__(self, mechanism, layout, times, rows, status, account):
        self.mechanism = mechanism
        self.t = times
        self.status = status
        self.counters, self.explain, self.warnings = account
        self.near_singular = []
        self.events = []
        self.energy_account = None
        self._slices = layout.slices
        self._rows = rows
        self._bodies = None
        self.q = self["q"]
        self.v = self["v"]

    def __getstate__(self):
        bodies = self._bodies
        if bodies is None:
            bodies = {one.name: one.columns for one in self.mechanism if one.family == "body"}
        return dict(vars(self), mechanism=None, _bodies=bodies, q=None, v=None)

    def __setstate__(self, state):
        vars(self).update(state)
        self.q = self["q"]
        self.v = self["v"]

    def __deepcopy__(self, memo):
        copied = type(self).__new__(type(self))
        own = {name: copy.deepcopy(value, memo) for name, value in self.__getstate__().items()}
        copied.__setstate__(dict(own, mechanism=self.mechanism, _bodies=self._bodies))
        return copied

    def __array__(self, *how, **also):
        raise TypeError(
            "a run is several arrays: take one of them, such as run.q, or run.to_dict(), also for a "
            "table: pandas.DataFrame(run.to_dict())"
        )

    def to_dict(self):
        """All columns by name: "t", and of each recorded channel its key, with the number of the
        column where it has several, such as "energy[1]". For tables: pandas.DataFrame(run.to_dict())."""
        named = {"t": self.t}
        for key in self:
            columns = self[key].T
            names = [key] if len(columns) == 1 else [f"{key}[{k}]" for k in range(len(columns))]
            named.update(zip(names, columns))
        return named

    def __repr__(self):
        name = self.status.name if isinstance(self.status, Status) else self.status
        return f"<run of {len(self.t)} samples, {self.counters.steps} steps, {name}>"

    def keys(self):
        """Names of the recorded channels."""
        return list(self._slices)

    def __iter__(self):
        return iter(self.keys())

    def __contains__(self, key):
        name = key.key if isinstance(key, Channel) else key
        return name in self._slices or self._of_body(name) is not None

    def __getitem__(self, key):
        """The columns of a channel, given by itself or by name."""
        name = key.key if isinstance(key, Channel) else key
        place = self._slices.get(name)
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
        if what not in ("pose", "velocity"):
            return None
        columns = self._columns_of(body)
        if columns is None:
            return None
        q, v = columns
        return np.ascontiguousarray(self.q[:, q] if what == "pose" else self.v[:, v])

    def _columns_of(self, body):
        """Places of a body in q and v, or None."""
        if self._bodies is not None:
            return self._bodies.get(body)
        element = self.mechanism[body] if body in self.mechanism else None
        if element is None or element.family != "body" or element.kind is None:
            return None
        return element.columns
