# SPDX-License-Identifier: BSD-3-Clause
"""Results of the library as named tuples. Made by tools/generate_abi.py from the headers; do not
edit. Units are in brackets, and [-] means a pure number."""
from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from .elements import Body, Joint
    from .errors import Status
    from .gains import Gains


class Mobility(NamedTuple):
    """What a mechanism can do at its assembled initial configuration. nv is the number of
    velocities, and J is the velocity Jacobian of the constraints.

    degrees_of_freedom: [-] nv minus the rank of J at configurations near the initial one; -1 if
        the mechanism cannot be assembled.
    redundant_rows: [-] rows that depend on other rows at every configuration near the initial
        one.
    conflicting_rows: [-] rows that contradict the other rows.
    free_bodies: [-] bodies without a joint.
    near_singular: True if the initial configuration is singular, which means that J has a lower
        rank there than at nearby configurations. Also true if a row of J is nearly dependent on
        the other rows in the initial configuration, but not in nearby configurations. Nearly
        dependent means that the distance of the row from the span of the other rows is less
        than 1e-5 of its length.
    worst_phi: [m or rad] largest |Phi| after assembly.
    worst_joint: The joint whose row has the violation worst_phi.
    text: The results in words, with the names of elements.
    velocity_rows: [-] rows of velocity level (non-holonomic constraints).
    position_degrees_of_freedom: [-] degrees of freedom of position: nv minus the rank of J
        without its rows of velocity level. degrees_of_freedom counts the degrees of freedom of
        velocity instead, which are fewer if there are rows of velocity level.
    """

    degrees_of_freedom: int
    redundant_rows: int
    conflicting_rows: int
    free_bodies: int
    near_singular: bool
    worst_phi: float
    worst_joint: Joint | None
    text: str
    velocity_rows: int
    position_degrees_of_freedom: int


class Report(NamedTuple):
    """What an evaluation of the accelerations costs, and which work it skips. nv and nc are the
    numbers of velocities and of constraint rows, and J is the velocity Jacobian of the constraints.

    bodies: [-] number of bodies, not counting ground.
    joints: [-] number of joints, drivers, couplings and user constraints.
    forces: [-] number of forces, not counting gravity.
    velocities: [-] number of velocities, nv.
    rows: [-] number of constraint rows, nc.
    degrees_of_freedom: [-] nv minus the rank of J; -1 if the mechanism cannot be assembled.
    redundant_rows: [-] redundant rows, which the solver always omits.
    constant_rows: [-] rows that do not depend explicitly on time.
    islands: [-] groups of bodies connected with each other by joints. Fixed bodies belong to no
        group and connect no bodies.
    fixed_bodies: [-] bodies welded to ground. The equations of these bodies are solved only if
        multipliers are requested.
    constant_mass: True if the mass matrix is constant; it is then inverted only once.
    constant_force: True if all forces are constant.
    blocks: True if the block solver solves the equations, false if KLU (a sparse LU
        factorization of the whole system) does.
    nodes: [-] nodes of the block solver; 0 if KLU solves the equations. A node is a whole joint
        if the mechanism has spatial bodies but no user coordinates; otherwise it is a pair of
        rows.
    couplings: [-] pairs of nodes that are coupled during elimination; 0 if KLU solves the
        equations.
    fill: [-] number of these couplings that arise only during elimination (fill-in); 0 if KLU
        solves the equations.
    most_couplings: [-] largest number of couplings that a node has when it is eliminated; 0 if
        KLU solves the equations.
    most_joints: [-] number of joints of the body most_joined.
    most_joined: The body with the most joints, among bodies that are not fixed; none if there
        are no joints.
    text: The results in words, with the names of elements and with reasons.
    velocity_rows: [-] rows of velocity level (non-holonomic constraints).
    position_degrees_of_freedom: [-] degrees of freedom of position: nv minus the rank of J
        without its rows of velocity level; -1 if the mechanism cannot be assembled.
    """

    bodies: int
    joints: int
    forces: int
    velocities: int
    rows: int
    degrees_of_freedom: int
    redundant_rows: int
    constant_rows: int
    islands: int
    fixed_bodies: int
    constant_mass: bool
    constant_force: bool
    blocks: bool
    nodes: int
    couplings: int
    fill: int
    most_couplings: int
    most_joints: int
    most_joined: Body | None
    text: str
    velocity_rows: int
    position_degrees_of_freedom: int


class Counters(NamedTuple):
    """What a run has cost since it was created, and how well it has kept the constraints.
    max_phi_joint and max_phi_rate_joint are handles of joints or None; after unpickling, they are
    the names of the joints. Phi are the values of the constraints, and Phi' is their time
    derivative.

    steps: [-] accepted steps.
    rejected: [-] steps that were repeated, because an error test or an iteration failed.
    short_steps: [-] shorter steps that a fixed-step method took to reach a requested time or a
        break time that is not on its grid of steps.
    evaluations: [-] evaluations of the equations of motion. Most methods solve equation (7) of
        the page "docs/notation.md" in each evaluation. IDA and generalized-alpha compute the
        residual of their equations instead.
    factorizations: [-] factorizations of the matrix in equation (7) and of the matrices of IDA
        and CVODE.
    full_factorizations: [-] factorizations that chose new pivots, which may allocate memory.
    nonlinear_iterations: [-] iterations of "kinematics" and of the implicit methods: CVODE,
        IDA, RATTLE and generalized-alpha.
    restarts: [-] restarts of multistep and variable-step methods.
    near_singular: [-] evaluations in which the matrix of the equations of motion was almost
        singular.
    warnings: [-] number of kinds of warnings that occurred.
    wall: [s] wall time inside the functions that advance the run: advance_to(), step() and
        sample().
    max_phi: [m or rad] largest violation |Phi| over all steps.
    max_phi_rate: [m/s or rad/s] largest rate |Phi'| over all steps.
    max_phi_joint: The joint with the violation max_phi.
    max_phi_rate_joint: The joint with the violation max_phi_rate.
    predicted_phi: [m or rad] prediction of the steady |Phi| that the gains leave,
        (alpha/beta^2) h max |gamma_i|, where h is the step, and gamma is the right-hand side of
        J a = gamma. It is known only for the Euler methods with stable gains of at least 0.1/h,
        otherwise it is NaN.
    predicted_phi_rate: [m/s or rad/s] prediction of the steady |Phi'| that the gains leave,
        (h/2) max |gamma_i|, with h and gamma as for predicted_phi. It is NaN in the same cases
        as predicted_phi.
    energy_change: [J] change of kinetic plus potential energy since the start. It contains the
        error of the method, but also the work of drivers, inputs and dampers.
    start_change: [-] largest displacement of a body in the last assembly, in characteristic
        lengths or rad. It includes the motion of drivers to their initial values if assembly
        makes this motion in a single step, but not if assembly makes it in several small steps.
    alpha: [1/s] Baumgarte's gain alpha in use.
    beta: [1/s] Baumgarte's gain beta in use.
    spectral_radius: [-] spectral radius of the gains: the factor by which each step multiplies
        a violation in the long run. NaN if the formulation is not "baumgarte", or if the steps
        are variable.
    damping: [1/s] decay rate of violations, -ln(spectral_radius) / h. For small gains with
        alpha = beta it is approximately alpha. It is infinite for dead-beat gains, and negative
        if violations grow. NaN if spectral_radius is NaN.
    near_singular_intervals: [-] number of intervals in which the run was near a singular
        configuration.
    branch_warnings: [-] number of near-singular intervals after which the motion is, or may be,
        on another branch than before.
    forced_steps: [-] steps of rk8 and dp5 across a singular configuration. They are accepted
        although their error estimate is above the tolerance.
    energy_residual: [J] energy that errors of the method have added so far, according to the
        energy account. NaN without the option energy_account.
    doubts: [-] number of kinds of warnings that put the motion in doubt.
    error_estimate: [-] estimate of the largest global error of the positions since the start.
        Errors of lengths are relative to the characteristic length, and errors of angles are in
        radians. NaN means that the error is unknown, for example because the estimate failed or
        would cost too much. Without the option error_check, the estimate shows only whether the
        error is large: values up to 0.01 may be errors of the estimate itself. Without the
        option error_check, the estimate of a run with a fixed step is 0 as long as the local
        errors of the run are negligible, and NaN if inputs change every few steps. Without the
        option, the estimate of a run with variable steps is NaN, except after a singularity
        crossing at a loose tolerance.
    """

    steps: int
    rejected: int
    short_steps: int
    evaluations: int
    factorizations: int
    full_factorizations: int
    nonlinear_iterations: int
    restarts: int
    near_singular: int
    warnings: int
    wall: float
    max_phi: float
    max_phi_rate: float
    max_phi_joint: Joint | None
    max_phi_rate_joint: Joint | None
    predicted_phi: float
    predicted_phi_rate: float
    energy_change: float
    start_change: float
    alpha: float
    beta: float
    spectral_radius: float
    damping: float
    near_singular_intervals: int
    branch_warnings: int
    forced_steps: int
    energy_residual: float
    doubts: int
    error_estimate: float


class EnergyAccount(NamedTuple):
    """Where the energy of a run has come from. The page docs/notation.md explains the symbols.

    kinetic: [J] present kinetic energy v^T M v / 2.
    potential: [J] present potential energy of gravity, linear springs, user potentials, and
        loads that are only a constant force in ground axes.
    start: [J] kinetic plus potential energy at the start.
    loads: [J] work of the loads that have an input, a torque or a moment, or that follow their
        body.
    springs: [J] work of springs with a user law.
    dampers: [J] work of the dampers in bushings, and in springs and cables without a user law.
    user_forces: [J] the part of the work of user forces that no potential explains: their whole
        work plus the change of their potential energy.
    bodies: [J] work of the forces of user coordinates, plus the change of their potential
        energy, plus the integral of v^T M' v / 2. In this sum the velocity terms of Lagrange's
        equations cancel.
    drivers: [J] work of drivers and of other rows that depend on time: the integral of -nu^T
        lambda, where nu is the right-hand side of J v = nu.
    violation: [J] work of violated constraints: the integral of -Phi'^T lambda.
    projection: [J] change of kinetic and potential energy by projections.
    gains: [J] work of Baumgarte's gains. It is already contained in the fields `drivers` and
        `violation`, so do not add it to these fields.
    residual: [J] kinetic + potential - start, minus the sum of all work terms except gains.
    evaluations: [-] evaluations of the equations (5) and (7) (page "docs/notation.md") for the
        account. The counters of the run do not include them.
    """

    kinetic: float
    potential: float
    start: float
    loads: float
    springs: float
    dampers: float
    user_forces: float
    bodies: float
    drivers: float
    violation: float
    projection: float
    gains: float
    residual: float
    evaluations: int


class NearSingular(NamedTuple):
    """An interval in which a run was near a singular configuration. branch is "continued", "left"
    or "unknown". The joint is a handle or None; after unpickling it is the name of the joint.

    begin: [s] time of the last state of the run before the interval, or of the first state if
        the run starts or restarts in the interval.
    end: [s] time of the first state of the run after the interval. However, if the motion stays
        close to singular configurations, the run may list the interval before the motion has
        left it. The interval then continues after this time.
    t: [s] time at which p is smallest (see pivot); it may be inside a step.
    pivot: [-] the smallest p in the interval. At each state, p is the smallest pivot of the
        equations of motion, divided by the largest value that the smallest pivot has had at any
        state of the run so far. The page "docs/theory/singular.md" defines the smallest pivot.
    jump: [-] difference between the velocity after the interval and the velocity of a smooth
        continuation of the motion before the interval, relative to the size of the velocity.
        NaN: unknown.
    jump_error: [-] estimated error of the field `jump`; NaN: unknown.
    branch: How the motion continues after the interval.
    joint: Joint whose rows have the smallest pivot; none if unknown.
    """

    begin: float
    end: float
    t: float
    pivot: float
    jump: float
    jump_error: float
    branch: str
    joint: Joint | None


class StudyEntry(NamedTuple):
    """What a setting costs and how accurate it is. Unknown values are NaN. The scale of a length is
    the characteristic length, and the scale of an angle is 1 rad. For error_lambda, the multiplier
    of row i is multiplied by the norm of row i of the Jacobian. For this norm, each column of the
    Jacobian is first multiplied by the scale of its coordinate.

    name: The name, such as "rk8 projection, rtol 1e-06".
    message: The reason why the entry was refused or failed. For other entries: the first
        warning of the run, or "" if the run has no warning.
    integrator: The integrator.
    formulation: The formulation; never "default".
    gains: The gain rule, as given in the options.
    step: [s] fixed step; NaN if the entry has rtol.
    rtol: [-] tolerance; NaN if the entry has a step.
    method: [-] number of the method of this entry among all methods of the study, counted from
        0.
    state: done, refused, failed, timed_out or waiting
    status: status of the run of the entry
    at_floor: measured error is not above the uncertainty of the reference
    untrusted: the reference is not trusted, so neither are the errors
    off: run followed another motion: error_q above 0.1, or a branch warning
    unstable: the gains do not damp violations at this step
    alpha: [1/s] alpha in use; 0: no gains
    beta: [1/s] beta in use; 0: no gains
    error: [-] largest error over all samples, by the definition of the study
    error_final: [-] error at the last sample
    error_half: [-] largest error over the first half of the samples
    error_q: [-] error of scaled positions
    error_q_final: [-] error_q at the last sample
    error_v: [-] error of scaled velocities, relative to the largest one
    error_v_final: [-] error_v at the last sample
    error_lambda: [-] error of weighted multipliers, relative to the largest one
    error_lambda_final: [-] error_lambda at the last sample
    energy_error: [J] difference of energy from the reference
    energy_error_final: [J] energy_error at the last sample
    error_estimate: [-] error_estimate of counters
    error_validated: [-] largest error of the validation, see option validate
    max_phi: [m or rad] largest constraint violation |Phi| over all steps
    max_phi_rate: [m/s or rad/s] largest |Phi'| over all steps
    violation_work: [J] work of violated constraints, see energy_account
    projection_work: [J] change of energy by projections
    gains_work: [J] work of Baumgarte's gains, see energy_account
    work: [evaluations] evaluations + factorizations + implicit iterations
    cpu: [s] least CPU time to create a run and advance it, without samples
    cpu_spread: [s] second smallest CPU time minus the smallest
    repeats: [-] number of runs that measured the CPU time
    evaluations: [-] evaluations in the run, without those for samples
    factorizations: [-] factorizations of matrices, without those for samples
    nonlinear_iterations: [-] iterations of implicit methods
    steps: [-] accepted steps
    rejected: [-] steps that were repeated
    forced_steps: [-] steps across singularities, see counters
    near_singular_intervals: [-] number of near-singular intervals of the run
    warnings: [-] number of kinds of warnings of the run
    branch_warnings: [-] near-singular intervals with a doubtful branch
    doubts: [-] number of kinds of warnings that put the motion in doubt
    """

    name: str
    message: str
    integrator: str
    formulation: str
    gains: Gains | None
    step: float
    rtol: float
    method: int
    state: str
    status: Status | int
    at_floor: bool
    untrusted: bool
    off: bool
    unstable: bool
    alpha: float
    beta: float
    error: float
    error_final: float
    error_half: float
    error_q: float
    error_q_final: float
    error_v: float
    error_v_final: float
    error_lambda: float
    error_lambda_final: float
    energy_error: float
    energy_error_final: float
    error_estimate: float
    error_validated: float
    max_phi: float
    max_phi_rate: float
    violation_work: float
    projection_work: float
    gains_work: float
    work: float
    cpu: float
    cpu_spread: float
    repeats: int
    evaluations: int
    factorizations: int
    nonlinear_iterations: int
    steps: int
    rejected: int
    forced_steps: int
    near_singular_intervals: int
    warnings: int
    branch_warnings: int
    doubts: int


class StudyMethod(NamedTuple):
    """Entries of a study with the same integrator, formulation and gains.

    name: The name, such as "rk8 projection". If an integrator can use fixed and variable steps,
        two methods have the same name; the field fixed_step distinguishes them.
    integrator: Integrator of the method.
    formulation: Formulation of the method.
    gains: Gain rule of the method.
    fixed_step: True if the entries differ in step, false if in rtol.
    entries: [-] number of entries.
    usable: [-] number of entries that are done, whose CPU time is measured, whose error is
        finite and not 0, and whose field `off` is false. If `off` is true, the run has followed
        another motion than the reference: error_q is above 0.1, or the run has a branch
        warning.
    least_error: [-] smallest error of the usable entries; NaN if there are none.
    slope: [-] slope of the error curve: d log error / d log step, or d log error / d log rtol
        if entries differ in rtol. NaN: unknown.
    work_per_digit: [-] factor by which the work grows for one more correct digit; NaN: unknown.
    cpu_per_digit: [-] factor by which the CPU time grows for one more correct digit; NaN:
        unknown.
    growth: [-] geometric mean of error_validated / error over the usable entries whose
        error_validated is finite; NaN if there are none.
    """

    name: str
    integrator: str
    formulation: str
    gains: Gains | None
    fixed_step: bool
    entries: int
    usable: int
    least_error: float
    slope: float
    work_per_digit: float
    cpu_per_digit: float
    growth: float


class StudyReference(NamedTuple):
    """How far the reference of a study can be trusted. The uncertainties below are those of the
    fields error, error_q, error_v, error_lambda and energy_error of StudyEntry.

    origin: Where the reference comes from.
    trusted: False if the study has computed the reference itself, and the runs for the
        reference agree to fewer than three digits or pass near a singular configuration.
    digits: [-] number of digits that can be trusted, -log10(uncertainty). NaN before the
        reference is computed.
    uncertainty: [-] uncertainty of the reference, measured like `error` of an entry.
    uncertainty_q: [-] uncertainty of the reference, measured like error_q of an entry.
    uncertainty_v: [-] uncertainty of the reference, measured like error_v of an entry.
    uncertainty_lambda: [-] uncertainty of the reference, measured like error_lambda of an
        entry.
    uncertainty_energy: [J] uncertainty of the reference, measured like energy_error of an
        entry.
    samples: [-] number of samples.
    text: A text that states the number of digits to which the runs for the reference agree, or
        the reason why the reference is not trusted.
    """

    origin: str
    trusted: bool
    digits: float
    uncertainty: float
    uncertainty_q: float
    uncertainty_v: float
    uncertainty_lambda: float
    uncertainty_energy: float
    samples: int
    text: str


class CatalogParameter(NamedTuple):
    """A number that a mechanism of the catalogue depends on.

    name: Name of the parameter, such as "eccentricity".
    unit: Unit of `value`, such as "kg m^2"; "-" for a pure number.
    meaning: What the parameter describes.
    value: [unit] default value of the parameter.
    positive: True if the value must be > 0.
    whole: True if the value must be an integer.
    """

    name: str
    unit: str
    meaning: str
    value: float
    positive: bool
    whole: bool


class CatalogEntry(NamedTuple):
    """A mechanism of the catalogue.

    name: Name of the mechanism, such as "slider_crank".
    title: Description in a few words.
    source: Where the data of the mechanism come from.
    provenance: How the reference was computed and checked; "" if the mechanism has no
        reference.
    note: A remark, such as "one redundant constraint row"; may be "".
    parameter_count: [-] number of parameters, see baum.catalog.parameter_at().
    sample_count: [-] number of sample times; 0 if there is no reference.
    start_time: [s] start of the motion and of its reference.
    end_time: [s] end of the motion and of its reference.
    digits_q: [-] number of correct digits of the reference positions: the error of a position q
        is at most 10^(-digits_q) max(1, |q|). NaN if there is no reference.
    digits_v: [-] number of correct digits of the reference velocities: the error of a velocity
        v is at most 10^(-digits_v) max(1, |v|). NaN if there is no reference.
    exact: True if the reference consists of formulas.
    smooth: True if the motion with default parameters passes through no singular configuration.
    parameters: Its parameters by name.
    """

    name: str
    title: str
    source: str
    provenance: str
    note: str
    parameter_count: int
    sample_count: int
    start_time: float
    end_time: float
    digits_q: float
    digits_v: float
    exact: bool
    smooth: bool
    parameters: dict[str, CatalogParameter]


class CatalogError(NamedTuple):
    """How far a run is from the reference of the catalogue.

    q: [-] largest error of positions over all times; NaN if a state is not finite.
    v: [-] largest error of velocities over all times; NaN if a state is not finite, or if the
        argument v was None.
    q_final: [-] error of positions at the last time.
    v_final: [-] error of velocities at the last time.
    q_time: [s] time of the largest error of positions.
    v_time: [s] time of the largest error of velocities.
    q_floor: [-] uncertainty of the positions of the reference.
    v_floor: [-] uncertainty of the velocities of the reference.
    """

    q: float
    v: float
    q_final: float
    v_final: float
    q_time: float
    v_time: float
    q_floor: float
    v_floor: float
