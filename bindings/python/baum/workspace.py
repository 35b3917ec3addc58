# SPDX-License-Identifier: BSD-3-Clause
"""Evaluation of a frozen mechanism at a point, without a run."""

import ctypes

import numpy as np

from . import _abi, _calls
from .channels import Channel, width
from ._lib import lib
from ._values import address, number, vector

_Q = _abi.baum_quantity


class Workspace:
    """Phi, J, nu, gamma, M, g, accelerations and more at (t, q, v), t in seconds, q (nq), v (nv).

    Rows and columns are in the order of adding. One thread at a time may use it.
    """

    def __init__(self, mechanism):
        self.mechanism = mechanism
        out = ctypes.c_void_p()
        _calls.interruptible(
            _calls.make, lib.baum_workspace_create, mechanism.handle, ctypes.byref(out)
        )
        self._owner = _calls.Handle(out.value, lib.baum_workspace_destroy, "workspace")
        self._sizes = mechanism.sizes

    def _call(self, function, *arguments):
        """A call; in a thread of its own when it may come back through Python."""
        if self.mechanism.has_python:
            _calls.interruptible(self._owner.call, function, *arguments)
        else:
            self._owner.call(function, *arguments)

    def _evaluate(self, function, shape, t, q, v=None):
        """An array from a function of (t, q) or (t, q, v)."""
        out = np.empty(shape)
        q = self._q(q)
        state = (q,) if v is None else (q, self._v(v))
        self._call(function, number(t, "t"), *map(address, state), address(out))
        return out

    def _q(self, q):
        return vector(q, self._sizes.nq, "q")

    def _v(self, v):
        return vector(v, self._sizes.nv, "v")

    def set_input(self, input, value):
        """Set an input, given as a handle or by name; before, it has its initial value."""
        input = self.mechanism.find("input", input)
        self._owner.call(lib.baum_workspace_set_input, input.id, number(value, input.name))

    @property
    def inputs(self):
        """Present values of all inputs by name, a copy."""
        return {
            input.name: lib.baum_workspace_input(self._owner._address, input.id)
            for input in self.mechanism.inputs
        }

    def design(self):
        """Design configuration (nq) and given velocities (nv), NaN where free."""
        q, v = np.empty(self._sizes.nq), np.empty(self._sizes.nv)
        self._call(lib.baum_workspace_design, address(q), address(v))
        return q, v

    def rate(self, q, v):
        """Rates of positions q' = N(q) v (nq): v itself unless positions are not a vector."""
        out = np.empty(self._sizes.nq)
        q, v = self._q(q), self._v(v)
        self._call(lib.baum_workspace_rate, address(q), address(v), address(out))
        return out

    def move(self, dx, q):
        """q (nq) moved by a displacement dx (nv): q + dx unless positions are not a vector."""
        dx, moved = self._v(dx), np.array(self._q(q))
        self._call(lib.baum_workspace_move, address(dx), address(moved))
        return moved

    def difference(self, start, end):
        """The displacement (nv) by which move() leads from one configuration to another."""
        out = np.empty(self._sizes.nv)
        start, end = self._q(start), self._q(end)
        self._call(lib.baum_workspace_difference, address(start), address(end), address(out))
        return out

    def phi(self, t, q):
        """Constraint residual Phi (nc)."""
        return self._evaluate(lib.baum_workspace_phi, self._sizes.nc, t, q)

    def jacobian(self, t, q):
        """Velocity Jacobian J (nc x nv)."""
        return self._evaluate(lib.baum_workspace_jacobian, (self._sizes.nc, self._sizes.nv), t, q)

    def nu(self, t, q):
        """nu (nc), so that J v = nu."""
        return self._evaluate(lib.baum_workspace_nu, self._sizes.nc, t, q)

    def gamma(self, t, q, v):
        """gamma (nc), so that J a = gamma."""
        return self._evaluate(lib.baum_workspace_gamma, self._sizes.nc, t, q, v)

    def mass(self, t, q):
        """Mass matrix M (nv x nv)."""
        return self._evaluate(lib.baum_workspace_mass, (self._sizes.nv, self._sizes.nv), t, q)

    def force(self, t, q, v):
        """Force vector g (nv): applied, gravity and velocity terms."""
        return self._evaluate(lib.baum_workspace_force, self._sizes.nv, t, q, v)

    def energy(self, t, q, v):
        """Kinetic and potential energy [J]."""
        kinetic, potential = ctypes.c_double(), ctypes.c_double()
        q, v = self._q(q), self._v(v)
        self._call(
            lib.baum_workspace_energy,
            number(t, "t"),
            address(q),
            address(v),
            ctypes.byref(kinetic),
            ctypes.byref(potential),
        )
        return kinetic.value, potential.value

    def acceleration(self, t, q, v, alpha=0.0, beta=0.0):
        """Accelerations a (nv) and multipliers lambda (nc), with Baumgarte's gains [1/s] if
        given."""
        a, lambda_ = np.empty(self._sizes.nv), np.empty(self._sizes.nc)
        q, v = self._q(q), self._v(v)
        self._call(
            lib.baum_workspace_acceleration,
            number(t, "t"),
            address(q),
            address(v),
            number(alpha, "alpha"),
            number(beta, "beta"),
            address(a),
            address(lambda_),
        )
        return a, lambda_

    def reaction(self, t, q, lambda_, joint):
        """Force [N] and moment [N m] of a joint on its body_b; of a user constraint -J^T lambda."""
        joint = self.mechanism.find("joint", joint)
        channel = Channel("reaction", _Q.BAUM_JOINT_REACTION, joint=joint.id)
        out = np.empty(width(self.mechanism, channel))
        q, lambda_ = self._q(q), vector(lambda_, self._sizes.nc, "lambda")
        self._call(
            lib.baum_workspace_reaction,
            number(t, "t"),
            address(q),
            address(lambda_),
            joint.id,
            address(out),
        )
        return out

    def assemble(self, t=0.0, q=None, v=None, held=()):
        """The nearest q with Phi = 0, and v: finite entries are held, NaN ones follow. Left out,
        both are those of the design configuration. held: bodies whose positions stay."""
        design_q, design_v = self.design()
        q = design_q if q is None else self._q(q)
        v = design_v if v is None else self._v(v)
        bodies = [self.mechanism.find("body", body).id for body in held]
        ids = (_abi.baum_body_id * len(bodies))(*bodies)
        self._call(
            lib.baum_workspace_assemble, number(t, "t"), address(q), address(v), ids, len(bodies)
        )
        return q, v

    def project(self, t, q, v):
        """q and v moved the least onto the constraints, in the metric of M."""
        q, v = self._q(q), self._v(v)
        self._call(lib.baum_workspace_project, number(t, "t"), address(q), address(v))
        return q, v
