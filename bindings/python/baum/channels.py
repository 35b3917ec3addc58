# SPDX-License-Identifier: BSD-3-Clause
"""What can be read from a run: channels, each a group of columns with a name.

Those of the whole mechanism are here: q, v, a, lambda_, phi, phi_rate, energy. Those of a body or a
joint are its attributes, for example m["slider"].pose and m["B"].reaction.
"""

import ctypes

import numpy as np

from . import _abi, _calls
from ._lib import default, lib
from .errors import Error, Status

_Q = _abi.baum_quantity


class Channel:
    """One group of columns. `key` is its name in a run, such as "slider.pose"."""

    __slots__ = ("key", "struct")

    def __init__(self, key, quantity, **fields):
        self.key = key
        self.struct = default(_abi.baum_channel)
        for field, value in {"quantity": quantity, **fields}.items():
            setattr(self.struct, field, value)

    def __repr__(self):
        return f"<channel {self.key}>"


q = Channel("q", _Q.BAUM_Q)
v = Channel("v", _Q.BAUM_V)
a = Channel("a", _Q.BAUM_A)
lambda_ = Channel("lambda", _Q.BAUM_LAMBDA)
phi = Channel("phi", _Q.BAUM_PHI)
phi_rate = Channel("phi_rate", _Q.BAUM_PHI_RATE)
energy = Channel("energy", _Q.BAUM_ENERGY)
energy_account = Channel("energy_account", _Q.BAUM_ENERGY_ACCOUNT)

WHOLE = {channel.key: channel for channel in (
    q, v, a, lambda_, phi, phi_rate, energy, energy_account
)}


class Layout:
    """Channels in a row of numbers: where each one is."""

    def __init__(self, mechanism, channels):
        by_key = {channel.key: channel for channel in channels}
        self.count = len(by_key)
        self.structs = (_abi.baum_channel * self.count)(*(c.struct for c in by_key.values()))
        self.slices = {}
        self.width = 0
        for key, channel in by_key.items():
            end = self.width + width(mechanism, channel)
            self.slices[key] = slice(self.width, end)
            self.width = end

    def rows(self, count):
        """Room for that many rows."""
        return np.empty((count, self.width))


def width(mechanism, channel):
    """Number of columns of a channel."""
    count = lib.baum_channels_width(mechanism.handle, ctypes.byref(channel.struct), 1)
    if count < 0:
        raise Error(Status.ERR_ARGUMENT, _calls.message())
    return count
