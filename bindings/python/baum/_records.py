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
    """What a mechanism can do at its assembled initial configuration.

    degrees_of_freedom: [-] nv - rank of J at nearby configurations; -1: cannot be assembled.
    redundant_rows: [-] rows that depend on others at every nearby pose.
    conflicting_rows: [-] rows that cannot be met together with the others.
    free_bodies: [-] bodies without a joint.
    near_singular: The start configuration has fewer independent rows than its neighbours, or
        comes within 1e-5 of that, relative to the scales.
    worst_phi: [m or rad] largest |Phi| after assembly.
    worst_joint: Joint of worst_phi.
    text: The same in messages, by name.
    """

    degrees_of_freedom: int
    redundant_rows: int
    conflicting_rows: int
    free_bodies: int
    near_singular: bool
    worst_phi: float
    worst_joint: Joint | None
    text: str


class Report(NamedTuple):
    """What an evaluation of the accelerations costs, and which work it skips.

    bodies: [-] without ground.
    joints: [-] with drivers and user constraints.
    forces: [-] gravity not among them.
    velocities: [-] nv.
    rows: [-] nc.
    degrees_of_freedom: [-] nv - rank of J; -1: not known, see mobility().
    redundant_rows: [-] left out of every solution.
    constant_rows: [-] without time derivatives, for they are not of time.
    islands: [-] of bodies that joints hold together, fixed ones left out.
    fixed_bodies: [-] welded to ground: solved for where multipliers are wanted.
    constant_mass: Masses are constant: inverted once.
    constant_force: So are all forces.
    blocks: Solved by blocks ("block"); else by KLU.
    nodes: [-] pairs of rows; 0 for KLU.
    couplings: [-] of nodes when these are eliminated; 0 for KLU.
    fill: [-] couplings that no body makes, but elimination; 0 for KLU.
    most_couplings: [-] of one node; 0 for KLU.
    most_joints: [-] of one body that is not fixed.
    most_joined: That body; none when there are no joints.
    text: The same in lines, by name, with the reasons.
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


class Counters(NamedTuple):
    """What a run has cost since it was created, and how well it has kept the constraints. Joints
    are handles or None, and names after unpickling.

    steps: [-] accepted.
    rejected: [-] steps that failed an error test or an iteration.
    short_steps: [-] shorter steps of a fixed-step method to a target off its grid.
    evaluations: [-] of (7) or of the residual.
    factorizations: [-] refactorizations of the matrix in (7) and of IDA's or CVODE's.
    full_factorizations: [-] of these those that chose new pivots and may allocate.
    nonlinear_iterations: [-] of CVODE, IDA, kinematics.
    restarts: [-] of a multistep method.
    near_singular: [-] evaluations in which the matrix was close to singular.
    warnings: [-] kinds of warnings, see warnings.
    wall: [s] inside advance_to, step and sample.
    max_phi: [m or rad] largest |Phi| over all steps.
    max_phi_rate: [m/s or rad/s] largest |Phi'| over all steps.
    max_phi_joint: Joint of max_phi.
    max_phi_rate_joint: Joint of max_phi_rate.
    predicted_phi: [m or rad] (alpha/beta^2) h largest |gamma_i|; NaN: not predicted.
    predicted_phi_rate: [m/s or rad/s] (h/2) largest |gamma_i|; NaN likewise.
    energy_change: [J] kinetic, potential since start; of drivers, inputs, dampers too.
    start_change: [-] largest displacement of the last assembly, of the scale.
    alpha: [1/s] in use.
    beta: [1/s] in use.
    spectral_radius: [-] what a step of the gains in use leaves of a violation in the long run;
        NaN without "baumgarte" or where steps vary.
    damping: [1/s] effective, -ln(spectral_radius) / h: alpha where gains are small and alpha =
        beta; infinite for a dead-beat pair, negative where violations grow; NaN likewise.
    near_singular_intervals: [-] crossings near singular configurations, see near_singular.
    branch_warnings: [-] of these those behind which the motion is on another branch, or may be.
    forced_steps: [-] of rk8 and dp5, taken over a singular configuration whatever their error
        estimate.
    energy_residual: [J] of the energy account at present: gained or lost by the method itself;
        NaN without the option energy_account.
    doubts: [-] kinds of warnings that doubt the motion.
    error_estimate: [-] largest estimated error of the positions since the start, relative to
        the characteristic length and to radians; 0 while the local errors of fixed steps are
        negligible. NaN: not known, as with variable steps without the option error_check, or
        where the estimate would cost more than the run.
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
    """Where the energy of a run has come from.

    kinetic: [J] v^T M v / 2 at present.
    potential: [J] of gravity, linear springs, constant loads and as users say.
    start: [J] kinetic and potential at the start.
    loads: [J] of loads with an input or a torque, or that follow their body.
    springs: [J] of springs with a law of the user.
    dampers: [J] of the damping of linear springs.
    user_forces: [J] of user forces, without the change of their potential.
    bodies: [J] of the forces of user coordinates, without the change of their potential, and
        v^T M' v / 2 of theirs: 0 where these are Lagrange's.
    drivers: [J] -nu^T lambda: of drivers and other rows that depend on time.
    violation: [J] -Phi'^T lambda: of rows whose Phi' is not 0.
    projection: [J] changes of kinetic and potential energy by projections.
    gains: [J] what the gains have done, a part of drivers and violation: not to be added.
    residual: [J] kinetic + potential - start - all works but gains.
    evaluations: [-] of (5) and (7) for the account, which counters leave out.
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
    or "unknown". The joint is a handle or None, and a name after unpickling.

    begin: [s] last step before it.
    end: [s] first step behind it.
    t: [s] of the smallest pivot, between steps too.
    pivot: [-] smallest of the motion, of the usual one; also between steps.
    jump: [-] change of the velocity against the smooth continuation of the motion before, of
        its size; NaN: not known.
    jump_error: [-] estimated error of jump; NaN likewise.
    branch: What has become of the motion.
    joint: With the smallest pivot; none where it is not known.
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
    """What a setting costs and how accurate it is; NaN: not known.

    name: Such as "rk8 projection, rtol 1e-06".
    message: Why it is refused or failed, else its first warning, else "".
    integrator: Of the options.
    formulation: The one it stands for, not "default".
    gains: Of the options.
    step: [s] NaN: it goes by rtol.
    rtol: [-] NaN: it goes by step.
    method: See methods.
    state: done, refused, failed, timed_out or waiting
    status: of its run
    at_floor: error is the uncertainty of the reference, as good as it gets
    untrusted: the reference is not to be trusted, so errors are not either
    off: another motion: error_q above 0.1, or a branch warning
    unstable: its gains do not damp with this step
    alpha: [1/s] of the gains that the run used, whatever their rule; 0: none
    beta: [1/s] likewise
    error: [-] what the study calls error, see error
    error_final: [-] error at the last sample
    error_half: [-] error over the first half of the samples: how errors grow
    error_q: [-] of positions, by the scales
    error_q_final: [-] of positions at the last sample
    error_v: [-] of velocities, by the scales and the largest scaled velocity
    error_v_final: [-] of velocities at the last sample
    error_lambda: [-] of multipliers, times the displacement of their rows
    error_lambda_final: [-] of multipliers at the last sample
    energy_error: [J] drift of energy against the reference
    energy_error_final: [J] drift of energy at the last sample
    error_estimate: [-] as in counters
    error_validated: [-] over twice the span and from starts nearby; see below
    max_phi: [m or rad] largest constraint violation |Phi| over all steps
    max_phi_rate: [m/s or rad/s] largest |Phi'| over all steps
    violation_work: [J] work of constraint forces, see energy_account
    projection_work: [J] energy that projections have changed, likewise
    gains_work: [J] work of the stabilization, likewise
    work: [evaluations] the same on every machine: "work"
    cpu: [s] least CPU time of a run from its making to its end, without samples
    cpu_spread: [s] second least CPU time less the least
    repeats: [-] runs for the CPU time
    evaluations: [-] right-hand sides or residuals, without those of samples
    factorizations: [-] of matrices, likewise
    nonlinear_iterations: [-] of implicit methods
    steps: [-] accepted
    rejected: [-] steps that were repeated
    forced_steps: [-] over singular configurations
    near_singular_intervals: [-] of its run
    warnings: [-] of its run
    branch_warnings: [-] of its run
    doubts: [-] kinds of warnings that doubt the motion
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

    name: Such as "rk8 projection".
    integrator: Of its entries.
    formulation: Of its entries.
    gains: Of its entries.
    fixed_step: Of steps rather than tolerances.
    entries: [-] it has.
    usable: [-] of these those that are done and not `off`.
    least_error: [-] that it reaches; NaN when none is usable.
    slope: [-] d log error / d log step or rtol where errors fall; NaN: not known.
    work_per_digit: [-] factor on work for one more digit; NaN likewise.
    cpu_per_digit: [-] factor on CPU time for one more digit; NaN likewise.
    growth: [-] error_validated over error of its entries, on geometric average; NaN: none was
        validated to the end.
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
    """How far the reference of a study can be trusted.

    origin: Whose.
    trusted: Own: its runs agree to three digits or more and met no singular configuration.
    digits: [-] trusted digits, -log10(uncertainty); NaN before it is made.
    uncertainty: [-] of error.
    uncertainty_q: [-] of error_q.
    uncertainty_v: [-] of error_v.
    uncertainty_lambda: [-] of error_lambda.
    uncertainty_energy: [J] of energy_error.
    samples: [-] number of samples.
    text: Who agrees with whom to how many digits, or why it is not to be trusted.
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

    name: Such as "eccentricity".
    unit: Such as "kg m^2"; "-" for a pure number.
    meaning: In words.
    value: [unit] default.
    positive: Must be > 0.
    whole: Must be a whole number.
    """

    name: str
    unit: str
    meaning: str
    value: float
    positive: bool
    whole: bool


class CatalogEntry(NamedTuple):
    """A mechanism of the catalogue.

    name: Such as "slider_crank".
    title: In words.
    source: Where its data come from.
    provenance: How its reference was made and checked; "" without one.
    note: What to know before running it; may be "".
    parameter_count: [-] see baum.catalog.parameter_at().
    sample_count: [-] of the reference, that of the start among them; 0: none.
    start_time: [s]
    end_time: [s] of the reference, and of the problem as it is posed.
    digits_q: [-] of positions of the reference that can be trusted, relative to max(1, |q|);
        NaN without one.
    digits_v: [-] likewise of velocities.
    exact: The reference is formulas.
    smooth: Stays away from singular configurations with the default parameters.
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

    q: [-] largest of positions over all times; NaN where a state is not finite.
    v: [-] largest of velocities, likewise; NaN also when they were not given.
    q_final: [-] of positions at the last time.
    v_final: [-] of velocities at the last time.
    q_time: [s] of the largest error of positions.
    v_time: [s] of the largest error of velocities.
    q_floor: [-] what the trusted digits mean for positions.
    v_floor: [-] likewise for velocities.
    """

    q: float
    v: float
    q_final: float
    v_final: float
    q_time: float
    v_time: float
    q_floor: float
    v_floor: float
