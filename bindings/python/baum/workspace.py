# SPDX-License-Identifier: BSD-3-Clause
"""Workspaces evaluate a frozen mechanism at a state, without a run."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

from . import _abi, _calls
from ._lib import lib
from ._values import address, number, vector, word
from .channels import Channel, width
from .definitions import COORDINATES
from .typing import Array, ArrayLike, BodyLike, Coordinate, InputLike, JointLike, Scalar

if TYPE_CHECKING:
    from .mechanism import Mechanism

_Q = _abi.baum_quantity


class Workspace(_calls.Closing):
    """Evaluates a frozen mechanism at a state (t, q, v): constraints, Jacobian, mass matrix,
    forces, accelerations and more.

    t: time [s].
    q: positions (nq).
    v: velocities (nv).

    nc is the number of constraint rows. The columns of J and M and the numbers in q and v are in
    the order in which the bodies were added. Constraint rows are in the order in which the joints
    were added. Only one thread at a time may use a workspace.

    Errors: TypeError and ValueError for values of a wrong type or size; baum.Error if the library
        cannot evaluate the state; exceptions of your own functions.
    """

    mechanism: Mechanism

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        out = ctypes.c_void_p()
        _calls.interruptible(
            _calls.make, lib.baum_workspace_create, mechanism.handle, ctypes.byref(out)
        )
        self._owner = _calls.Handle(_calls.made(out), lib.baum_workspace_destroy, "workspace")
        self._sizes = mechanism.sizes

    def _call(self, function: Any, *arguments: Any) -> None:
        """Make a call. If it may run Python callbacks, make it in a second thread."""
        if self.mechanism.has_python:
            _calls.interruptible(self._owner.call, function, *arguments)
        else:
            self._owner.call(function, *arguments)

    def _evaluate(
        self, function: Any, shape: Any, t: Scalar, q: ArrayLike, v: ArrayLike | None = None
    ) -> Array:
        """Return the array that a library function of (t, q) or (t, q, v) computes."""
        out: Array = np.empty(shape)
        state = [self._q(q)] if v is None else [self._q(q), self._v(v)]
        self._call(function, number(t, "t"), *map(address, state), address(out))
        return out

    def _q(self, q: ArrayLike) -> Array:
        return vector(q, self._sizes.nq, "q")

    def _v(self, v: ArrayLike) -> Array:
        return vector(v, self._sizes.nv, "v")

    def set_input(self, input: InputLike, value: Scalar) -> None:
        """Set an input. Before the first such call, the input has its initial value."""
        found = self.mechanism.find("input", input)
        self._owner.call(lib.baum_workspace_set_input, found.id, number(value, found.name))

    def set_angle(self, joint: JointLike, angle: Scalar, coordinate: Coordinate = "first") -> None:
        """Set the number of whole revolutions in an angle of a spatial joint. Positions determine
        such an angle only up to whole revolutions. From this call on, the workspace uses the value
        that is nearest to the given angle [rad]. Before the first such call, it uses the value that
        is nearest to 0.

        coordinate: which angle of the joint, as in Mechanism.driver().
        """
        found = self.mechanism.find("joint", joint)
        which = word(COORDINATES, coordinate, "coordinate")
        self._owner.call(lib.baum_workspace_set_angle, found.id, which, number(angle, "angle"))

    @property
    def inputs(self) -> dict[str, float]:
        """A dict from the name of each input to its present value."""
        return {
            input.name: lib.baum_workspace_input(self._owner.address, input.id)
            for input in self.mechanism.inputs
        }

    def design(self) -> tuple[Array, Array]:
        """Return the design configuration: the positions q (nq) and velocities v (nv) that the
        definitions of the bodies give. Velocities that they do not give are NaN."""
        q, v = np.empty(self._sizes.nq), np.empty(self._sizes.nv)
        self._call(lib.baum_workspace_design, address(q), address(v))
        return q, v

    def rate(self, q: ArrayLike, v: ArrayLike) -> Array:
        """Return the time derivative of the positions (nq), q' = N(q) v. For planar bodies,
        q' is equal to v."""
        out: Array = np.empty(self._sizes.nq)
        q, v = self._q(q), self._v(v)
        self._call(lib.baum_workspace_rate, address(q), address(v), address(out))
        return out

    def move(self, dx: ArrayLike, q: ArrayLike) -> Array:
        """Return the positions q (nq) moved by a displacement dx (nv). For planar bodies,
        the result is q + dx."""
        dx, moved = self._v(dx), np.array(self._q(q))
        self._call(lib.baum_workspace_move, address(dx), address(moved))
        return moved

    def difference(self, start: ArrayLike, end: ArrayLike) -> Array:
        """Return the displacement (nv) between two configurations: move() with this displacement
        moves `start` to `end`."""
        out = np.empty(self._sizes.nv)
        start, end = self._q(start), self._q(end)
        self._call(lib.baum_workspace_difference, address(start), address(end), address(out))
        return out

    def phi(self, t: Scalar, q: ArrayLike) -> Array:
        """Return the values of the constraints, Phi (nc)."""
        return self._evaluate(lib.baum_workspace_phi, self._sizes.nc, t, q)

    def jacobian(self, t: Scalar, q: ArrayLike) -> Array:
        """Return the velocity Jacobian J (nc x nv)."""
        return self._evaluate(lib.baum_workspace_jacobian, (self._sizes.nc, self._sizes.nv), t, q)

    def nu(self, t: Scalar, q: ArrayLike) -> Array:
        """Return the right-hand side nu (nc) of J v = nu."""
        return self._evaluate(lib.baum_workspace_nu, self._sizes.nc, t, q)

    def gamma(self, t: Scalar, q: ArrayLike, v: ArrayLike) -> Array:
        """Return the right-hand side gamma (nc) of J a = gamma, where a are the accelerations."""
        return self._evaluate(lib.baum_workspace_gamma, self._sizes.nc, t, q, v)

    def mass(self, t: Scalar, q: ArrayLike) -> Array:
        """Return the mass matrix M (nv x nv)."""
        return self._evaluate(lib.baum_workspace_mass, (self._sizes.nv, self._sizes.nv), t, q)

    def force(self, t: Scalar, q: ArrayLike, v: ArrayLike) -> Array:
        """Return the force vector g (nv), which contains applied forces, gravity and velocity
        terms."""
        return self._evaluate(lib.baum_workspace_force, self._sizes.nv, t, q, v)

    def energy(self, t: Scalar, q: ArrayLike, v: ArrayLike) -> tuple[float, float]:
        """Return the kinetic and the potential energy [J]."""
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

    def acceleration(
        self, t: Scalar, q: ArrayLike, v: ArrayLike, alpha: Scalar = 0.0, beta: Scalar = 0.0
    ) -> tuple[Array, Array]:
        """Return the accelerations a (nv) and the multipliers lambda (nc). alpha, beta: Baumgarte's
        gains [1/s]."""
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

    def reaction(self, t: Scalar, q: ArrayLike, lambda_: ArrayLike, joint: JointLike) -> Array:
        """Return the reaction of a joint, which is also what the channel `reaction` of the joint
        contains. For most joints, the reaction is the force [N] and the moment [N m] on body_b (3
        numbers in the plane, 6 in space). lambda_: multipliers (nc), as acceleration() returns
        them."""
        found = self.mechanism.find("joint", joint)
        channel = Channel("reaction", _Q.BAUM_JOINT_REACTION, joint=found.id)
        out = np.empty(width(self.mechanism, channel))
        q, lambda_ = self._q(q), vector(lambda_, self._sizes.nc, "lambda")
        self._call(
            lib.baum_workspace_reaction,
            number(t, "t"),
            address(q),
            address(lambda_),
            found.id,
            address(out),
        )
        return out

    def assemble(
        self,
        t: Scalar = 0.0,
        q: ArrayLike | None = None,
        v: ArrayLike | None = None,
        held: Sequence[BodyLike] = (),
    ) -> tuple[Array, Array]:
        """Assemble the mechanism. Return the configuration q (nq) with Phi = 0 that is nearest to
        the given one, and velocities v (nv) with J v = nu.

        q, v: the given configuration and velocities, by default those that design() returns. Finite
            entries of v are kept, and entries that are NaN are computed from the constraints.
        held: bodies whose positions must not change.

        Raises baum.Error if the joints cannot be closed.
        """
        design_q, design_v = self.design()
        q = design_q if q is None else self._q(q)
        v = design_v if v is None else self._v(v)
        bodies = [self.mechanism.find("body", body).id for body in held]
        ids = (_abi.baum_body_id * len(bodies))(*bodies)
        assemble = lib.baum_workspace_assemble
        self._call(assemble, number(t, "t"), address(q), address(v), ids, len(bodies))
        return q, v

    def project(self, t: Scalar, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Return q (nq) and v (nv) projected onto the constraints. The changes of q and v are the
        smallest possible ones in the norm of the mass matrix M."""
        q, v = self._q(q), self._v(v)
        self._call(lib.baum_workspace_project, number(t, "t"), address(q), address(v))
        return q, v
