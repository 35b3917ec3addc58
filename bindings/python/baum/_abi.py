# SPDX-License-Identifier: BSD-3-Clause
"""The C interface of baum 0.1.0. Made by tools/generate_abi.py from the headers; do not edit.

Addresses of numbers (double *) and handles are c_void_p; strings are c_char_p.
"""
import enum
from ctypes import (
    CFUNCTYPE, POINTER, Structure, c_bool, c_char, c_char_p, c_double, c_int, c_int32, c_int64,
    c_size_t, c_uint32, c_void_p,
)

VERSION = "0.1.0"


class baum_status(enum.IntEnum):
    BAUM_OK = 0
    BAUM_STOP_CANCELLED = 1
    BAUM_STOP_EVENT = 2
    BAUM_STOP_TIME = 3
    BAUM_WARNED = 10
    BAUM_ERR_ARGUMENT = -1
    BAUM_ERR_STATE = -2
    BAUM_ERR_MEMORY = -3
    BAUM_ERR_STRUCT = -4
    BAUM_ERR_UNSUPPORTED = -5
    BAUM_ERR_BUFFER = -6
    BAUM_ERR_FILE = -7
    BAUM_ERR_INCONSISTENT = -10
    BAUM_ERR_SINGULAR = -11
    BAUM_ERR_UNSTABLE = -12
    BAUM_ERR_STEP = -20
    BAUM_ERR_CONVERGENCE = -21
    BAUM_ERR_INTEGRATOR = -22
    BAUM_ERR_NOT_FINITE = -23
    BAUM_ERR_CALLBACK = -30


class baum_body_id(Structure):
    _fields_ = [
        ("index1", c_int32),
        ("tag", c_uint32),
    ]


class baum_joint_id(Structure):
    _fields_ = [
        ("index1", c_int32),
        ("tag", c_uint32),
    ]


class baum_force_id(Structure):
    _fields_ = [
        ("index1", c_int32),
        ("tag", c_uint32),
    ]


class baum_input_id(Structure):
    _fields_ = [
        ("index1", c_int32),
        ("tag", c_uint32),
    ]


BAUM_GROUND = baum_body_id(-1, 0)
baum_q_fn = CFUNCTYPE(c_int, c_double, c_void_p, c_void_p, c_void_p)
baum_qv_fn = CFUNCTYPE(c_int, c_double, c_void_p, c_void_p, c_void_p, c_void_p)
baum_force_fn = CFUNCTYPE(c_int, c_double, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p)
baum_law_fn = CFUNCTYPE(c_int, c_double, c_void_p, c_void_p)
baum_rate_fn = CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p)
baum_move_fn = CFUNCTYPE(None, c_double, c_void_p, c_void_p, c_void_p)
baum_difference_fn = CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p)
baum_normalize_fn = CFUNCTYPE(None, c_void_p, c_void_p)


class baum_coordinates_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("size", c_int32),
        ("q", c_void_p),
        ("v", c_void_p),
        ("scale", c_void_p),
        ("mass", baum_q_fn),
        ("force", baum_force_fn),
        ("force_q", baum_force_fn),
        ("force_v", baum_force_fn),
        ("potential", baum_q_fn),
        ("constant_mass", c_bool),
        ("held", c_bool),
        ("user", c_void_p),
        ("depends_on_velocity", c_bool),
        ("position_scale", c_void_p),
        ("rate", baum_rate_fn),
        ("move", baum_move_fn),
        ("difference", baum_difference_fn),
        ("normalize", baum_normalize_fn),
        ("position_count", c_int32),
    ]


class baum_user_constraint_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("bodies", POINTER(baum_body_id)),
        ("body_count", c_int32),
        ("row_count", c_int32),
        ("phi", baum_q_fn),
        ("jacobian", baum_q_fn),
        ("nu", baum_q_fn),
        ("gamma", baum_qv_fn),
        ("user", c_void_p),
        ("velocity_level", c_bool),
    ]


class baum_joint_coordinate(enum.IntEnum):
    BAUM_COORDINATE_FIRST = 0
    BAUM_COORDINATE_DISPLACEMENT = 1
    BAUM_COORDINATE_ANGLE = 2
    BAUM_COORDINATE_ANGLE_B = 3
    BAUM_COORDINATE_X = 4
    BAUM_COORDINATE_Y = 5


class baum_driver_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("joint", baum_joint_id),
        ("value", c_double),
        ("rate", c_double),
        ("acceleration", c_double),
        ("law", baum_law_fn),
        ("user", c_void_p),
        ("coordinate", c_int),
    ]


baum_coupling_fn = CFUNCTYPE(c_int, c_double, c_void_p, c_void_p)


class baum_coupling_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("joint_a", baum_joint_id),
        ("joint_b", baum_joint_id),
        ("ratio", c_double),
        ("offset", c_double),
        ("law", baum_coupling_fn),
        ("user", c_void_p),
        ("coordinate_a", c_int),
        ("coordinate_b", c_int),
    ]


class baum_user_force_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("bodies", POINTER(baum_body_id)),
        ("body_count", c_int32),
        ("force", baum_force_fn),
        ("force_q", baum_force_fn),
        ("force_v", baum_force_fn),
        ("potential", baum_q_fn),
        ("user", c_void_p),
        ("depends_on_velocity", c_bool),
    ]


baum_spring_fn = CFUNCTYPE(c_int, c_double, c_double, c_void_p, c_void_p)


class baum_joint_spring_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("joint", baum_joint_id),
        ("coordinate", c_int),
        ("stiffness", c_double),
        ("damping", c_double),
        ("free_value", c_double),
        ("law", baum_spring_fn),
        ("user", c_void_p),
        ("depends_on_velocity", c_bool),
    ]


class baum_joint_load_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("joint", baum_joint_id),
        ("coordinate", c_int),
        ("effort", c_double),
        ("input", baum_input_id),
    ]


class baum_mobility(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("degrees_of_freedom", c_int32),
        ("redundant_rows", c_int32),
        ("conflicting_rows", c_int32),
        ("free_bodies", c_int32),
        ("near_singular", c_bool),
        ("worst_phi", c_double),
        ("worst_joint", baum_joint_id),
        ("text", c_char * 1024),
        ("velocity_rows", c_int32),
        ("position_degrees_of_freedom", c_int32),
    ]


class baum_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("bodies", c_int32),
        ("joints", c_int32),
        ("forces", c_int32),
        ("velocities", c_int32),
        ("rows", c_int32),
        ("degrees_of_freedom", c_int32),
        ("redundant_rows", c_int32),
        ("constant_rows", c_int32),
        ("islands", c_int32),
        ("fixed_bodies", c_int32),
        ("constant_mass", c_bool),
        ("constant_force", c_bool),
        ("blocks", c_bool),
        ("nodes", c_int32),
        ("couplings", c_int32),
        ("fill", c_int32),
        ("most_couplings", c_int32),
        ("most_joints", c_int32),
        ("most_joined", baum_body_id),
        ("text", c_char * 2048),
        ("velocity_rows", c_int32),
        ("position_degrees_of_freedom", c_int32),
    ]


class baum_gain_rule(enum.IntEnum):
    BAUM_GAINS_DEFAULT = 0
    BAUM_GAINS_FIXED = 1
    BAUM_GAINS_SCALED = 2
    BAUM_GAINS_TAYLOR = 3
    BAUM_GAINS_FREQUENCY = 4
    BAUM_GAINS_DEADBEAT = 5
    BAUM_GAINS_AUTO = 6
    BAUM_GAINS_BEST_DAMPING = 7


class baum_gains(Structure):
    _fields_ = [
        ("rule", c_int32),
        ("value", c_double * 2),
    ]


class baum_stability(enum.IntEnum):
    BAUM_STABLE = 0
    BAUM_MARGINAL = 1
    BAUM_UNSTABLE = 2
    BAUM_VARIABLE_STEP = 3
    BAUM_WITHOUT_GAINS = 4


class baum_amplification(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("stability", c_int),
        ("spectral_radius", c_double),
        ("z", (c_double * 2) * 2),
        ("damping", c_double),
    ]


class baum_formulation(enum.IntEnum):
    BAUM_FORMULATION_DEFAULT = 0
    BAUM_FORMULATION_UNSTABILIZED = 1
    BAUM_FORMULATION_BAUMGARTE = 2
    BAUM_FORMULATION_PROJECTION = 3
    BAUM_FORMULATION_INDEX2 = 4
    BAUM_FORMULATION_GGL = 5
    BAUM_FORMULATION_INDEX3 = 6


class baum_start(enum.IntEnum):
    BAUM_START_ASSEMBLE = 0
    BAUM_START_EXACT = 1
    BAUM_START_AS_GIVEN = 2


class baum_solver(enum.IntEnum):
    BAUM_SOLVER_AUTO = 0
    BAUM_SOLVER_KLU = 1
    BAUM_SOLVER_QR = 2
    BAUM_SOLVER_BLOCK = 3


baum_progress_fn = CFUNCTYPE(c_int, c_void_p, c_double, c_void_p)


class baum_simulation_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("integrator", c_void_p),
        ("formulation", c_int),
        ("gains", baum_gains),
        ("allow_unstable", c_bool),
        ("step", c_double),
        ("rtol", c_double),
        ("atol", c_double),
        ("max_step", c_double),
        ("start_time", c_double),
        ("start", c_int),
        ("solver", c_int),
        ("check_derivatives", c_bool),
        ("max_steps", c_int64),
        ("progress", baum_progress_fn),
        ("progress_interval", c_double),
        ("user", c_void_p),
        ("tolerance_q", c_double),
        ("tolerance_v", c_double),
        ("tolerance_lambda", c_double),
        ("energy_account", c_bool),
        ("row_gains", c_void_p),
        ("row_gain_count", c_int32),
        ("error_check", c_bool),
    ]


class baum_quantity(enum.IntEnum):
    BAUM_Q = 1
    BAUM_V = 2
    BAUM_A = 3
    BAUM_LAMBDA = 4
    BAUM_PHI = 5
    BAUM_PHI_RATE = 6
    BAUM_ENERGY = 7
    BAUM_BODY_POSE = 8
    BAUM_BODY_VELOCITY = 9
    BAUM_JOINT_REACTION = 10
    BAUM_JOINT_COORDINATE = 11
    BAUM_BODY_ACCELERATION = 12
    BAUM_DRIVE_EFFORT = 13
    BAUM_ENERGY_ACCOUNT = 14


class baum_channel(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("quantity", c_int),
        ("body", baum_body_id),
        ("joint", baum_joint_id),
        ("point", c_double * 3),
        ("coordinate", c_int),
    ]


class baum_counters(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("steps", c_int64),
        ("rejected", c_int64),
        ("short_steps", c_int64),
        ("evaluations", c_int64),
        ("factorizations", c_int64),
        ("full_factorizations", c_int64),
        ("nonlinear_iterations", c_int64),
        ("restarts", c_int64),
        ("near_singular", c_int64),
        ("warnings", c_int64),
        ("wall", c_double),
        ("max_phi", c_double),
        ("max_phi_rate", c_double),
        ("max_phi_joint", baum_joint_id),
        ("max_phi_rate_joint", baum_joint_id),
        ("predicted_phi", c_double),
        ("predicted_phi_rate", c_double),
        ("energy_change", c_double),
        ("start_change", c_double),
        ("alpha", c_double),
        ("beta", c_double),
        ("spectral_radius", c_double),
        ("damping", c_double),
        ("near_singular_intervals", c_int64),
        ("branch_warnings", c_int64),
        ("forced_steps", c_int64),
        ("energy_residual", c_double),
        ("doubts", c_int64),
        ("error_estimate", c_double),
    ]


class baum_energy_account(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("kinetic", c_double),
        ("potential", c_double),
        ("start", c_double),
        ("loads", c_double),
        ("springs", c_double),
        ("dampers", c_double),
        ("user_forces", c_double),
        ("bodies", c_double),
        ("drivers", c_double),
        ("violation", c_double),
        ("projection", c_double),
        ("gains", c_double),
        ("residual", c_double),
        ("evaluations", c_int64),
    ]


class baum_branch(enum.IntEnum):
    BAUM_BRANCH_CONTINUED = 1
    BAUM_BRANCH_LEFT = 2
    BAUM_BRANCH_UNKNOWN = 3


class baum_near_singular(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("begin", c_double),
        ("end", c_double),
        ("t", c_double),
        ("pivot", c_double),
        ("jump", c_double),
        ("jump_error", c_double),
        ("branch", c_int),
        ("joint", baum_joint_id),
    ]


class baum_warning_code(enum.IntEnum):
    BAUM_WARNING_REDUNDANT_ROWS = 1
    BAUM_WARNING_GAINS = 2
    BAUM_WARNING_NOISY_DERIVATIVES = 3
    BAUM_WARNING_INDEX3 = 4
    BAUM_WARNING_LOOSE_VELOCITIES = 5
    BAUM_WARNING_ENERGY_ACCOUNT = 6
    BAUM_WARNING_ILL_CONDITIONED = 7
    BAUM_WARNING_SINGULARITY_CROSSED = 8
    BAUM_WARNING_ERROR_UNKNOWN = 9
    BAUM_WARNING_BRANCH = 100
    BAUM_WARNING_VIOLATION = 101
    BAUM_WARNING_CONTRADICTION = 102
    BAUM_WARNING_ACCURACY = 103
    BAUM_WARNING_SINGULAR_START = 104
    BAUM_WARNING_BUSHING = 105
    BAUM_WARNING_WRONG_DERIVATIVE = 106


class baum_warning(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("code", c_int),
        ("doubts_motion", c_bool),
        ("joint", baum_joint_id),
        ("first", c_double),
        ("last", c_double),
        ("count", c_int64),
        ("text", c_char * 400),
    ]


class baum_outline_form(enum.IntEnum):
    BAUM_OUTLINE_POLYGON = 0
    BAUM_OUTLINE_CIRCLE = 1
    BAUM_OUTLINE_BOX = 2
    BAUM_OUTLINE_CYLINDER = 3
    BAUM_OUTLINE_SPHERE = 4
    BAUM_OUTLINE_MESH = 5


class baum_outline(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("form", c_int),
        ("points", c_void_p),
        ("point_count", c_int32),
        ("triangles", POINTER(c_int32)),
        ("triangle_count", c_int32),
        ("center", c_double * 3),
        ("size", c_double * 3),
        ("start", c_double * 3),
        ("end", c_double * 3),
        ("radius", c_double),
        ("color", c_char_p),
    ]


class baum_mark_kind(enum.IntEnum):
    BAUM_MARK_WARNING = 0
    BAUM_MARK_SINGULAR = 1
    BAUM_MARK_EVENT = 2


class baum_page(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("title", c_char_p),
        ("times", c_void_p),
        ("count", c_int64),
        ("channels", POINTER(baum_channel)),
        ("channel_count", c_int32),
        ("rows", c_void_p),
        ("plots", c_void_p),
        ("plot_count", c_int32),
        ("plot_stride", c_int32),
        ("plot_labels", POINTER(c_char_p)),
        ("traces", POINTER(baum_channel)),
        ("trace_count", c_int32),
        ("mark_times", c_void_p),
        ("mark_texts", POINTER(c_char_p)),
        ("mark_kinds", POINTER(c_int32)),
        ("mark_count", c_int32),
    ]


class baum_residual(enum.IntEnum):
    BAUM_RESIDUAL_INDEX1 = 1
    BAUM_RESIDUAL_INDEX2 = 2
    BAUM_RESIDUAL_INDEX3 = 3
    BAUM_RESIDUAL_GGL = 4


class baum_dae(Structure):
    _fields_ = [
        ("index", c_int),
        ("alpha", c_double),
        ("beta", c_double),
    ]


class baum_sparse(Structure):
    _fields_ = [
        ("columns", POINTER(c_int32)),
        ("rows", POINTER(c_int32)),
        ("values", c_void_p),
        ("nonzeros", c_int32),
    ]


class baum_event_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("function", baum_force_fn),
        ("joint", baum_joint_id),
        ("value", c_double),
        ("direction", c_int32),
        ("terminal", c_bool),
        ("tolerance", c_double),
        ("user", c_void_p),
        ("coordinate", c_int),
    ]


class baum_event_record(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("t", c_double),
        ("event", c_int32),
        ("direction", c_int32),
    ]


class baum_planar_body_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("mass", c_double),
        ("inertia", c_double),
        ("position", c_double * 2),
        ("angle", c_double),
        ("velocity", c_double * 2),
        ("angular_velocity", c_double),
        ("held", c_bool),
    ]


class baum_planar_particle_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("mass", c_double),
        ("position", c_double * 2),
        ("velocity", c_double * 2),
        ("held", c_bool),
    ]


class baum_planar_revolute_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 2),
        ("point_a", c_double * 2),
        ("point_b", c_double * 2),
    ]


class baum_planar_translational_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 2),
        ("point_a", c_double * 2),
        ("point_b", c_double * 2),
        ("axis", c_double * 2),
        ("angle", c_double),
    ]


class baum_planar_distance_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 2),
        ("point_a", c_double * 2),
        ("point_b", c_double * 2),
        ("length", c_double),
    ]


class baum_planar_fixed_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 2),
        ("point_a", c_double * 2),
        ("point_b", c_double * 2),
        ("angle", c_double),
    ]


class baum_planar_spring_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 2),
        ("point_a", c_double * 2),
        ("point_b", c_double * 2),
        ("stiffness", c_double),
        ("damping", c_double),
        ("free_length", c_double),
        ("law", baum_spring_fn),
        ("user", c_void_p),
        ("depends_on_velocity", c_bool),
    ]


class baum_planar_torsion_spring_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("stiffness", c_double),
        ("damping", c_double),
        ("free_angle", c_double),
        ("law", baum_spring_fn),
        ("user", c_void_p),
        ("depends_on_velocity", c_bool),
    ]


class baum_planar_load_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body", baum_body_id),
        ("point", c_double * 2),
        ("force", c_double * 2),
        ("torque", c_double),
        ("follows_body", c_bool),
        ("input", baum_input_id),
    ]


class baum_planar_pin_in_slot_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 2),
        ("point_a", c_double * 2),
        ("point_b", c_double * 2),
        ("axis", c_double * 2),
    ]


class baum_planar_rack_and_pinion_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 2),
        ("point_a", c_double * 2),
        ("point_b", c_double * 2),
        ("axis", c_double * 2),
        ("radius", c_double),
        ("offset", c_double),
    ]


class baum_planar_gear_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("carrier", baum_body_id),
        ("radius_a", c_double),
        ("radius_b", c_double),
        ("offset", c_double),
    ]


baum_curve_fn = CFUNCTYPE(c_int, c_void_p, c_void_p, c_void_p)


class baum_planar_curve_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 2),
        ("point_a", c_double * 2),
        ("point_b", c_double * 2),
        ("curve", baum_curve_fn),
        ("user", c_void_p),
    ]


class baum_planar_knife_edge_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 2),
        ("point_a", c_double * 2),
        ("axis", c_double * 2),
    ]


baum_study_progress_fn = CFUNCTYPE(c_int, c_void_p, c_int32, c_int32, c_void_p)


class baum_study_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("samples", c_int32),
        ("threads", c_int32),
        ("repeats", c_int32),
        ("entry_limit", c_double),
        ("time_budget", c_double),
        ("energy_account", c_bool),
        ("file", c_char_p),
        ("progress", baum_study_progress_fn),
        ("user", c_void_p),
        ("validate", c_bool),
    ]


class baum_study_grid(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("integrator", c_void_p),
        ("formulation", c_int),
        ("settings", c_int32),
        ("constants", c_int32),
        ("coarsest", c_double),
        ("finest", c_double),
        ("quick", c_bool),
    ]


baum_study_solution_fn = CFUNCTYPE(c_int, c_double, c_void_p, c_void_p, c_void_p, c_void_p)


class baum_study_state(enum.IntEnum):
    BAUM_STUDY_WAITING = 0
    BAUM_STUDY_DONE = 1
    BAUM_STUDY_REFUSED = 2
    BAUM_STUDY_FAILED = 3
    BAUM_STUDY_TIMED_OUT = 4


class baum_study_entry(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("message", c_char_p),
        ("integrator", c_void_p),
        ("formulation", c_int),
        ("gains", baum_gains),
        ("step", c_double),
        ("rtol", c_double),
        ("method", c_int32),
        ("state", c_int),
        ("status", c_int),
        ("at_floor", c_bool),
        ("untrusted", c_bool),
        ("off", c_bool),
        ("unstable", c_bool),
        ("alpha", c_double),
        ("beta", c_double),
        ("error", c_double),
        ("error_final", c_double),
        ("error_half", c_double),
        ("error_q", c_double),
        ("error_q_final", c_double),
        ("error_v", c_double),
        ("error_v_final", c_double),
        ("error_lambda", c_double),
        ("error_lambda_final", c_double),
        ("energy_error", c_double),
        ("energy_error_final", c_double),
        ("error_estimate", c_double),
        ("error_validated", c_double),
        ("max_phi", c_double),
        ("max_phi_rate", c_double),
        ("violation_work", c_double),
        ("projection_work", c_double),
        ("gains_work", c_double),
        ("work", c_double),
        ("cpu", c_double),
        ("cpu_spread", c_double),
        ("repeats", c_int32),
        ("evaluations", c_int64),
        ("factorizations", c_int64),
        ("nonlinear_iterations", c_int64),
        ("steps", c_int64),
        ("rejected", c_int64),
        ("forced_steps", c_int64),
        ("near_singular_intervals", c_int64),
        ("warnings", c_int64),
        ("branch_warnings", c_int64),
        ("doubts", c_int64),
    ]


class baum_study_origin(enum.IntEnum):
    BAUM_STUDY_OWN = 0
    BAUM_STUDY_GIVEN = 1
    BAUM_STUDY_SOLUTION = 2


class baum_study_reference(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("origin", c_int),
        ("trusted", c_bool),
        ("digits", c_double),
        ("uncertainty", c_double),
        ("uncertainty_q", c_double),
        ("uncertainty_v", c_double),
        ("uncertainty_lambda", c_double),
        ("uncertainty_energy", c_double),
        ("samples", c_int32),
        ("text", c_char_p),
    ]


class baum_study_cost(enum.IntEnum):
    BAUM_STUDY_WORK = 0
    BAUM_STUDY_CPU = 1


class baum_study_method(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("integrator", c_void_p),
        ("formulation", c_int),
        ("gains", baum_gains),
        ("fixed_step", c_bool),
        ("entries", c_int32),
        ("usable", c_int32),
        ("least_error", c_double),
        ("slope", c_double),
        ("work_per_digit", c_double),
        ("cpu_per_digit", c_double),
        ("growth", c_double),
    ]


class baum_report_form(enum.IntEnum):
    BAUM_REPORT_TEXT = 0
    BAUM_REPORT_CSV = 1
    BAUM_REPORT_JSON = 2
    BAUM_REPORT_PAGE = 3


baum_hook_fn = CFUNCTYPE(None)


class baum_hook(Structure):
    _fields_ = [
        ("name", c_char_p),
        ("function", baum_hook_fn),
        ("user", c_void_p),
    ]


class baum_spatial_body_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("mass", c_double),
        ("inertia", c_double * 6),
        ("position", c_double * 3),
        ("orientation", c_double * 4),
        ("velocity", c_double * 3),
        ("angular_velocity", c_double * 3),
        ("held", c_bool),
    ]


class baum_spatial_particle_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("mass", c_double),
        ("position", c_double * 3),
        ("velocity", c_double * 3),
        ("held", c_bool),
    ]


class baum_spatial_spring_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("stiffness", c_double),
        ("damping", c_double),
        ("free_length", c_double),
        ("law", baum_spring_fn),
        ("user", c_void_p),
        ("depends_on_velocity", c_bool),
    ]


class baum_spatial_cable_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("bodies", POINTER(baum_body_id)),
        ("points", c_void_p),
        ("point_count", c_int32),
        ("stiffness", c_double),
        ("damping", c_double),
        ("free_length", c_double),
        ("law", baum_spring_fn),
        ("user", c_void_p),
        ("depends_on_velocity", c_bool),
        ("transition", c_double),
    ]


class baum_spatial_torsion_spring_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
        ("axis_b", c_double * 3),
        ("stiffness", c_double),
        ("damping", c_double),
        ("free_angle", c_double),
        ("law", baum_spring_fn),
        ("user", c_void_p),
        ("depends_on_velocity", c_bool),
    ]


class baum_spatial_bushing_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
        ("axis_b", c_double * 3),
        ("x_axis", c_double * 3),
        ("stiffness", c_double * 36),
        ("damping", c_double * 36),
    ]


class baum_spatial_load_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body", baum_body_id),
        ("point", c_double * 3),
        ("force", c_double * 3),
        ("moment", c_double * 3),
        ("input", baum_input_id),
        ("follows_body", c_bool),
    ]


class baum_spatial_distance_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("length", c_double),
    ]


class baum_spatial_point_on_line_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
    ]


class baum_spatial_point_on_plane_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
    ]


baum_spatial_curve_fn = CFUNCTYPE(c_int, c_void_p, c_void_p, c_void_p)


class baum_spatial_curve_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("curve", baum_spatial_curve_fn),
        ("user", c_void_p),
    ]


class baum_spatial_rolling_disc_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point_a", c_double * 3),
        ("normal", c_double * 3),
        ("centre", c_double * 3),
        ("axis_b", c_double * 3),
        ("radius", c_double),
        ("rim_radius", c_double),
    ]


class baum_spatial_knife_edge_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("axis", c_double * 3),
    ]


class baum_spatial_spherical_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
    ]


class baum_spatial_revolute_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
        ("axis_b", c_double * 3),
    ]


class baum_spatial_universal_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
        ("axis_b", c_double * 3),
    ]


class baum_spatial_cylindrical_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
        ("axis_b", c_double * 3),
    ]


class baum_spatial_prismatic_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
        ("axis_b", c_double * 3),
    ]


class baum_spatial_planar_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
        ("axis_b", c_double * 3),
        ("x_axis", c_double * 3),
    ]


class baum_spatial_fixed_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
    ]


class baum_spatial_screw_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
        ("axis_b", c_double * 3),
        ("pitch", c_double),
        ("offset", c_double),
    ]


class baum_spatial_constant_velocity_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("body_a", baum_body_id),
        ("body_b", baum_body_id),
        ("point", c_double * 3),
        ("point_a", c_double * 3),
        ("point_b", c_double * 3),
        ("axis", c_double * 3),
        ("axis_b", c_double * 3),
    ]


class baum_spline_driver_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("joint", baum_joint_id),
        ("times", c_void_p),
        ("values", c_void_p),
        ("count", c_int32),
        ("periodic", c_bool),
        ("coordinate", c_int),
    ]


baum_sweep_change_fn = CFUNCTYPE(c_int, c_void_p, c_int64, c_void_p)


class baum_sweep_def(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("count", c_int64),
        ("change", baum_sweep_change_fn),
        ("user", c_void_p),
        ("times", c_void_p),
        ("time_count", c_int64),
        ("channels", POINTER(baum_channel)),
        ("channel_count", c_int32),
        ("threads", c_int32),
    ]


class baum_catalog_entry(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("title", c_char_p),
        ("source", c_char_p),
        ("provenance", c_char_p),
        ("note", c_char_p),
        ("parameter_count", c_int32),
        ("sample_count", c_int32),
        ("start_time", c_double),
        ("end_time", c_double),
        ("digits_q", c_double),
        ("digits_v", c_double),
        ("exact", c_bool),
        ("smooth", c_bool),
    ]


class baum_catalog_parameter(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("unit", c_char_p),
        ("meaning", c_char_p),
        ("value", c_double),
        ("positive", c_bool),
        ("whole", c_bool),
    ]


class baum_catalog_setting(Structure):
    _fields_ = [
        ("name", c_char_p),
        ("value", c_double),
    ]


class baum_catalog_choice(Structure):
    _fields_ = [
        ("name", c_char_p),
        ("settings", POINTER(baum_catalog_setting)),
        ("setting_count", c_int32),
    ]


class baum_catalog_error(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("q", c_double),
        ("v", c_double),
        ("q_final", c_double),
        ("v_final", c_double),
        ("q_time", c_double),
        ("v_time", c_double),
        ("q_floor", c_double),
        ("v_floor", c_double),
    ]


# Result and argument types of every function.
PROTOTYPES = {
    "baum_status_name": (c_char_p, [c_int]),
    "baum_status_text": (c_char_p, [c_int]),
    "baum_message": (c_char_p, []),
    "baum_fail": (c_int, [c_int, c_char_p]),
    "baum_coordinates_def_init": (None, [POINTER(baum_coordinates_def), c_size_t]),
    "baum_mechanism_add_coordinates": (c_int, [
        c_void_p, POINTER(baum_coordinates_def), POINTER(baum_body_id),
    ]),
    "baum_mechanism_get_coordinates": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_coordinates_def), c_size_t,
    ]),
    "baum_mechanism_set_coordinates": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_coordinates_def),
    ]),
    "baum_user_constraint_def_init": (None, [POINTER(baum_user_constraint_def), c_size_t]),
    "baum_mechanism_add_user_constraint": (c_int, [
        c_void_p, POINTER(baum_user_constraint_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_user_constraint": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_user_constraint_def), c_size_t,
    ]),
    "baum_mechanism_set_user_constraint": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_user_constraint_def),
    ]),
    "baum_driver_def_init": (None, [POINTER(baum_driver_def), c_size_t]),
    "baum_mechanism_add_driver": (c_int, [
        c_void_p, POINTER(baum_driver_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_driver": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_driver_def), c_size_t,
    ]),
    "baum_mechanism_set_driver": (c_int, [c_void_p, baum_joint_id, POINTER(baum_driver_def)]),
    "baum_coupling_def_init": (None, [POINTER(baum_coupling_def), c_size_t]),
    "baum_mechanism_add_coupling": (c_int, [
        c_void_p, POINTER(baum_coupling_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_coupling": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_coupling_def), c_size_t,
    ]),
    "baum_mechanism_set_coupling": (c_int, [c_void_p, baum_joint_id, POINTER(baum_coupling_def)]),
    "baum_user_force_def_init": (None, [POINTER(baum_user_force_def), c_size_t]),
    "baum_mechanism_add_user_force": (c_int, [
        c_void_p, POINTER(baum_user_force_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_user_force": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_user_force_def), c_size_t,
    ]),
    "baum_mechanism_set_user_force": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_user_force_def),
    ]),
    "baum_joint_spring_def_init": (None, [POINTER(baum_joint_spring_def), c_size_t]),
    "baum_mechanism_add_joint_spring": (c_int, [
        c_void_p, POINTER(baum_joint_spring_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_joint_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_joint_spring_def), c_size_t,
    ]),
    "baum_mechanism_set_joint_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_joint_spring_def),
    ]),
    "baum_joint_load_def_init": (None, [POINTER(baum_joint_load_def), c_size_t]),
    "baum_mechanism_add_joint_load": (c_int, [
        c_void_p, POINTER(baum_joint_load_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_joint_load": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_joint_load_def), c_size_t,
    ]),
    "baum_mechanism_set_joint_load": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_joint_load_def),
    ]),
    "baum_mechanism_add_input": (c_int, [c_void_p, c_char_p, c_double, POINTER(baum_input_id)]),
    "baum_mechanism_get_input": (c_int, [c_void_p, baum_input_id, c_void_p]),
    "baum_mechanism_set_input": (c_int, [c_void_p, baum_input_id, c_double]),
    "baum_mechanism_input_count": (c_int32, [c_void_p]),
    "baum_mechanism_create": (c_int, [POINTER(c_void_p)]),
    "baum_mechanism_copy": (c_int, [c_void_p, POINTER(c_void_p)]),
    "baum_mechanism_destroy": (None, [c_void_p]),
    "baum_mechanism_set_gravity": (c_int, [c_void_p, c_double, c_double, c_double]),
    "baum_mechanism_get_gravity": (c_int, [c_void_p, c_void_p]),
    "baum_mechanism_set_characteristic_length": (c_int, [c_void_p, c_double]),
    "baum_mechanism_get_characteristic_length": (c_int, [c_void_p, c_void_p]),
    "baum_mechanism_freeze": (c_int, [c_void_p]),
    "baum_mechanism_is_frozen": (c_bool, [c_void_p]),
    "baum_mechanism_sizes": (c_int, [
        c_void_p, POINTER(c_int32), POINTER(c_int32), POINTER(c_int32),
    ]),
    "baum_mechanism_rows": (c_int, [c_void_p, baum_joint_id, POINTER(c_int32), POINTER(c_int32)]),
    "baum_mechanism_columns": (c_int, [c_void_p, baum_body_id, POINTER(c_int32), POINTER(c_int32)]),
    "baum_mechanism_body_name": (c_char_p, [c_void_p, baum_body_id]),
    "baum_mechanism_joint_name": (c_char_p, [c_void_p, baum_joint_id]),
    "baum_mechanism_input_name": (c_char_p, [c_void_p, baum_input_id]),
    "baum_mechanism_mobility": (c_int, [c_void_p, POINTER(baum_mobility), c_size_t]),
    "baum_mechanism_report": (c_int, [c_void_p, POINTER(baum_report), c_size_t]),
    "baum_mechanism_check_derivatives": (c_int, [c_void_p]),
    "baum_gains_fixed": (baum_gains, [c_double, c_double]),
    "baum_gains_scaled": (baum_gains, [c_double, c_double]),
    "baum_gains_taylor": (baum_gains, []),
    "baum_gains_frequency": (baum_gains, [c_double, c_double]),
    "baum_gains_deadbeat": (baum_gains, []),
    "baum_gains_auto": (baum_gains, []),
    "baum_gains_best_damping": (baum_gains, []),
    "baum_stability_at": (c_int, [
        c_void_p, c_double, c_double, POINTER(baum_amplification), c_size_t,
    ]),
    "baum_stability_velocity_at": (c_int, [
        c_void_p, c_double, POINTER(baum_amplification), c_size_t,
    ]),
    "baum_stability_velocity_limit": (c_int, [c_void_p, c_void_p]),
    "baum_stability_statement": (c_char_p, [c_void_p]),
    "baum_stability_limit": (c_int, [c_void_p, c_double, c_void_p]),
    "baum_stability_intervals": (c_int, [
        c_void_p, c_double, c_int32, c_void_p, c_void_p, POINTER(c_int32),
    ]),
    "baum_stability_best_on_ray": (c_int, [c_void_p, c_double, c_void_p]),
    "baum_stability_best": (c_int, [c_void_p, c_void_p, c_void_p]),
    "baum_stability_deadbeat": (c_int, [c_void_p, c_void_p, c_void_p]),
    "baum_stability_nearest": (c_int, [c_void_p, c_double, c_double, c_void_p, c_void_p]),
    "baum_stability_grid": (c_int, [c_void_p, c_void_p, c_void_p, c_int32, c_int32, c_void_p]),
    "baum_stability_outline": (c_int, [
        c_void_p, c_double, c_int32, c_void_p, c_void_p, POINTER(c_int32),
    ]),
    "baum_euler": (c_void_p, []),
    "baum_semi_implicit_euler": (c_void_p, []),
    "baum_rk2": (c_void_p, []),
    "baum_rk3": (c_void_p, []),
    "baum_rk4": (c_void_p, []),
    "baum_dp5": (c_void_p, []),
    "baum_rk8": (c_void_p, []),
    "baum_ab2": (c_void_p, []),
    "baum_ab3": (c_void_p, []),
    "baum_ab4": (c_void_p, []),
    "baum_rattle": (c_void_p, []),
    "baum_generalized_alpha": (c_void_p, []),
    "baum_cvode_adams": (c_void_p, []),
    "baum_cvode_bdf": (c_void_p, []),
    "baum_ida": (c_void_p, []),
    "baum_kinematics": (c_void_p, []),
    "baum_integrator_at": (c_void_p, [c_int32]),
    "baum_integrator_name": (c_char_p, [c_void_p]),
    "baum_integrator_order": (c_int32, [c_void_p]),
    "baum_integrator_has_fixed_step": (c_bool, [c_void_p]),
    "baum_integrator_has_variable_step": (c_bool, [c_void_p]),
    "baum_formulation_name": (c_char_p, [c_int]),
    "baum_integrator_offers": (c_bool, [c_void_p, c_int]),
    "baum_simulation_options_init": (None, [POINTER(baum_simulation_options), c_size_t]),
    "baum_simulation_create": (c_int, [
        c_void_p, POINTER(baum_simulation_options), POINTER(c_void_p),
    ]),
    "baum_simulation_destroy": (None, [c_void_p]),
    "baum_simulation_advance_to": (c_int, [c_void_p, c_double]),
    "baum_simulation_step": (c_int, [c_void_p, c_int64]),
    "baum_simulation_cancel": (None, [c_void_p]),
    "baum_simulation_set_progress_interval": (c_int, [c_void_p, c_double]),
    "baum_simulation_set_time_limit": (c_int, [c_void_p, c_double]),
    "baum_simulation_set_state": (c_int, [c_void_p, c_double, c_void_p, c_void_p]),
    "baum_simulation_set_angle": (c_int, [c_void_p, baum_joint_id, c_int, c_double]),
    "baum_simulation_continue": (c_int, [c_void_p, c_void_p]),
    "baum_simulation_set_input": (c_int, [c_void_p, baum_input_id, c_double]),
    "baum_simulation_input": (c_double, [c_void_p, baum_input_id]),
    "baum_simulation_set_driver": (c_int, [c_void_p, baum_joint_id, c_double, c_double, c_double]),
    "baum_simulation_save": (c_int, [c_void_p, c_void_p, c_size_t, POINTER(c_size_t)]),
    "baum_simulation_restore": (c_int, [c_void_p, c_void_p, c_size_t]),
    "baum_simulation_time": (c_double, [c_void_p]),
    "baum_simulation_q": (c_void_p, [c_void_p]),
    "baum_simulation_v": (c_void_p, [c_void_p]),
    "baum_channel_init": (None, [POINTER(baum_channel), c_size_t]),
    "baum_channels_width": (c_int32, [c_void_p, POINTER(baum_channel), c_int32]),
    "baum_simulation_unique_multipliers": (c_int, [c_void_p, POINTER(c_bool)]),
    "baum_simulation_get": (c_int, [c_void_p, POINTER(baum_channel), c_int32, c_void_p]),
    "baum_simulation_sample": (c_int, [
        c_void_p, c_void_p, c_int64, POINTER(baum_channel), c_int32, c_void_p, POINTER(c_int64),
    ]),
    "baum_simulation_counters": (c_int, [c_void_p, POINTER(baum_counters), c_size_t]),
    "baum_simulation_energy_account": (c_int, [c_void_p, POINTER(baum_energy_account), c_size_t]),
    "baum_simulation_near_singular": (c_int, [
        c_void_p, c_int64, POINTER(baum_near_singular), c_size_t,
    ]),
    "baum_warning_name": (c_char_p, [c_int]),
    "baum_simulation_warning": (c_int, [c_void_p, c_int64, POINTER(baum_warning), c_size_t]),
    "baum_simulation_explain": (c_char_p, [c_void_p]),
    "baum_simulation_message": (c_char_p, [c_void_p]),
    "baum_mechanism_add_break_times": (c_int, [c_void_p, c_void_p, c_int32]),
    "baum_mechanism_break_times": (c_void_p, [c_void_p, POINTER(c_int32)]),
    "baum_simulation_schedule_input": (c_int, [
        c_void_p, baum_input_id, c_void_p, c_void_p, c_int32,
    ]),
    "baum_outline_init": (None, [POINTER(baum_outline), c_size_t]),
    "baum_mechanism_set_outlines": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_outline), c_int32,
    ]),
    "baum_mechanism_outline_count": (c_int32, [c_void_p, baum_body_id]),
    "baum_mechanism_get_outline": (c_int, [
        c_void_p, baum_body_id, c_int32, POINTER(baum_outline), c_size_t,
    ]),
    "baum_mechanism_svg": (c_int, [c_void_p, c_void_p, c_char_p, c_size_t, POINTER(c_size_t)]),
    "baum_mechanism_write_svg": (c_int, [c_void_p, c_void_p, c_char_p]),
    "baum_mechanism_svg_assembled": (c_int, [c_void_p, c_char_p, c_size_t, POINTER(c_size_t)]),
    "baum_page_init": (None, [POINTER(baum_page), c_size_t]),
    "baum_page_write": (c_int, [c_void_p, POINTER(baum_page), c_char_p]),
    "baum_page_print": (c_int, [
        c_void_p, POINTER(baum_page), c_char_p, c_size_t, POINTER(c_size_t),
    ]),
    "baum_page_svg": (c_int, [
        c_void_p, POINTER(baum_page), c_int64, c_char_p, c_size_t, POINTER(c_size_t),
    ]),
    "baum_workspace_create": (c_int, [c_void_p, POINTER(c_void_p)]),
    "baum_workspace_destroy": (None, [c_void_p]),
    "baum_workspace_design": (c_int, [c_void_p, c_void_p, c_void_p]),
    "baum_workspace_set_input": (c_int, [c_void_p, baum_input_id, c_double]),
    "baum_workspace_input": (c_double, [c_void_p, baum_input_id]),
    "baum_workspace_set_angle": (c_int, [c_void_p, baum_joint_id, c_int, c_double]),
    "baum_workspace_rate": (c_int, [c_void_p, c_void_p, c_void_p, c_void_p]),
    "baum_workspace_move": (c_int, [c_void_p, c_void_p, c_void_p]),
    "baum_workspace_difference": (c_int, [c_void_p, c_void_p, c_void_p, c_void_p]),
    "baum_workspace_phi": (c_int, [c_void_p, c_double, c_void_p, c_void_p]),
    "baum_workspace_jacobian": (c_int, [c_void_p, c_double, c_void_p, c_void_p]),
    "baum_workspace_nu": (c_int, [c_void_p, c_double, c_void_p, c_void_p]),
    "baum_workspace_gamma": (c_int, [c_void_p, c_double, c_void_p, c_void_p, c_void_p]),
    "baum_workspace_mass": (c_int, [c_void_p, c_double, c_void_p, c_void_p]),
    "baum_workspace_force": (c_int, [c_void_p, c_double, c_void_p, c_void_p, c_void_p]),
    "baum_workspace_energy": (c_int, [c_void_p, c_double, c_void_p, c_void_p, c_void_p, c_void_p]),
    "baum_workspace_acceleration": (c_int, [
        c_void_p, c_double, c_void_p, c_void_p, c_double, c_double, c_void_p, c_void_p,
    ]),
    "baum_workspace_reaction": (c_int, [
        c_void_p, c_double, c_void_p, c_void_p, baum_joint_id, c_void_p,
    ]),
    "baum_workspace_residual": (c_int, [
        c_void_p, POINTER(baum_dae), c_double, c_void_p, c_void_p, c_void_p,
    ]),
    "baum_workspace_residual_jacobian": (c_int, [
        c_void_p, POINTER(baum_dae), c_double, c_double, c_void_p, c_void_p, POINTER(baum_sparse),
    ]),
    "baum_workspace_assemble": (c_int, [
        c_void_p, c_double, c_void_p, c_void_p, POINTER(baum_body_id), c_int32,
    ]),
    "baum_workspace_project": (c_int, [c_void_p, c_double, c_void_p, c_void_p]),
    "baum_mechanism_body_count": (c_int32, [c_void_p]),
    "baum_mechanism_joint_count": (c_int32, [c_void_p]),
    "baum_mechanism_force_count": (c_int32, [c_void_p]),
    "baum_mechanism_body_at": (baum_body_id, [c_void_p, c_int32]),
    "baum_mechanism_joint_at": (baum_joint_id, [c_void_p, c_int32]),
    "baum_mechanism_force_at": (baum_force_id, [c_void_p, c_int32]),
    "baum_mechanism_input_at": (baum_input_id, [c_void_p, c_int32]),
    "baum_mechanism_find_body": (baum_body_id, [c_void_p, c_char_p]),
    "baum_mechanism_find_joint": (baum_joint_id, [c_void_p, c_char_p]),
    "baum_mechanism_find_force": (baum_force_id, [c_void_p, c_char_p]),
    "baum_mechanism_find_input": (baum_input_id, [c_void_p, c_char_p]),
    "baum_mechanism_force_name": (c_char_p, [c_void_p, baum_force_id]),
    "baum_event_def_init": (None, [POINTER(baum_event_def), c_size_t]),
    "baum_simulation_add_event": (c_int, [c_void_p, POINTER(baum_event_def), POINTER(c_int32)]),
    "baum_simulation_event_count": (c_int64, [c_void_p]),
    "baum_simulation_event": (c_int, [c_void_p, c_int64, POINTER(baum_event_record), c_size_t]),
    "baum_planar_body_def_init": (None, [POINTER(baum_planar_body_def), c_size_t]),
    "baum_mechanism_add_planar_body": (c_int, [
        c_void_p, POINTER(baum_planar_body_def), POINTER(baum_body_id),
    ]),
    "baum_mechanism_get_planar_body": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_planar_body_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_body": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_planar_body_def),
    ]),
    "baum_planar_particle_def_init": (None, [POINTER(baum_planar_particle_def), c_size_t]),
    "baum_mechanism_add_planar_particle": (c_int, [
        c_void_p, POINTER(baum_planar_particle_def), POINTER(baum_body_id),
    ]),
    "baum_mechanism_get_planar_particle": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_planar_particle_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_particle": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_planar_particle_def),
    ]),
    "baum_planar_revolute_def_init": (None, [POINTER(baum_planar_revolute_def), c_size_t]),
    "baum_mechanism_add_planar_revolute": (c_int, [
        c_void_p, POINTER(baum_planar_revolute_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_planar_revolute": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_revolute_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_revolute": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_revolute_def),
    ]),
    "baum_planar_translational_def_init": (None, [
        POINTER(baum_planar_translational_def), c_size_t,
    ]),
    "baum_mechanism_add_planar_translational": (c_int, [
        c_void_p, POINTER(baum_planar_translational_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_planar_translational": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_translational_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_translational": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_translational_def),
    ]),
    "baum_planar_distance_def_init": (None, [POINTER(baum_planar_distance_def), c_size_t]),
    "baum_mechanism_add_planar_distance": (c_int, [
        c_void_p, POINTER(baum_planar_distance_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_planar_distance": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_distance_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_distance": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_distance_def),
    ]),
    "baum_planar_fixed_def_init": (None, [POINTER(baum_planar_fixed_def), c_size_t]),
    "baum_mechanism_add_planar_fixed": (c_int, [
        c_void_p, POINTER(baum_planar_fixed_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_planar_fixed": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_fixed_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_fixed": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_fixed_def),
    ]),
    "baum_planar_spring_def_init": (None, [POINTER(baum_planar_spring_def), c_size_t]),
    "baum_mechanism_add_planar_spring": (c_int, [
        c_void_p, POINTER(baum_planar_spring_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_planar_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_planar_spring_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_planar_spring_def),
    ]),
    "baum_planar_torsion_spring_def_init": (None, [
        POINTER(baum_planar_torsion_spring_def), c_size_t,
    ]),
    "baum_mechanism_add_planar_torsion_spring": (c_int, [
        c_void_p, POINTER(baum_planar_torsion_spring_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_planar_torsion_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_planar_torsion_spring_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_torsion_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_planar_torsion_spring_def),
    ]),
    "baum_planar_load_def_init": (None, [POINTER(baum_planar_load_def), c_size_t]),
    "baum_mechanism_add_planar_load": (c_int, [
        c_void_p, POINTER(baum_planar_load_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_planar_load": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_planar_load_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_load": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_planar_load_def),
    ]),
    "baum_planar_pin_in_slot_def_init": (None, [POINTER(baum_planar_pin_in_slot_def), c_size_t]),
    "baum_mechanism_add_planar_pin_in_slot": (c_int, [
        c_void_p, POINTER(baum_planar_pin_in_slot_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_planar_pin_in_slot": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_pin_in_slot_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_pin_in_slot": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_pin_in_slot_def),
    ]),
    "baum_planar_rack_and_pinion_def_init": (None, [
        POINTER(baum_planar_rack_and_pinion_def), c_size_t,
    ]),
    "baum_mechanism_add_planar_rack_and_pinion": (c_int, [
        c_void_p, POINTER(baum_planar_rack_and_pinion_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_planar_rack_and_pinion": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_rack_and_pinion_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_rack_and_pinion": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_rack_and_pinion_def),
    ]),
    "baum_planar_gear_def_init": (None, [POINTER(baum_planar_gear_def), c_size_t]),
    "baum_mechanism_add_planar_gear": (c_int, [
        c_void_p, POINTER(baum_planar_gear_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_planar_gear": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_gear_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_gear": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_gear_def),
    ]),
    "baum_planar_curve_def_init": (None, [POINTER(baum_planar_curve_def), c_size_t]),
    "baum_mechanism_add_planar_curve": (c_int, [
        c_void_p, POINTER(baum_planar_curve_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_planar_curve": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_curve_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_curve": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_curve_def),
    ]),
    "baum_planar_knife_edge_def_init": (None, [POINTER(baum_planar_knife_edge_def), c_size_t]),
    "baum_mechanism_add_planar_knife_edge": (c_int, [
        c_void_p, POINTER(baum_planar_knife_edge_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_planar_knife_edge": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_knife_edge_def), c_size_t,
    ]),
    "baum_mechanism_set_planar_knife_edge": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_planar_knife_edge_def),
    ]),
    "baum_study_create": (c_int, [c_void_p, c_double, c_double, POINTER(c_void_p)]),
    "baum_study_destroy": (None, [c_void_p]),
    "baum_study_options_init": (None, [POINTER(baum_study_options), c_size_t]),
    "baum_study_set_options": (c_int, [c_void_p, POINTER(baum_study_options)]),
    "baum_study_add": (c_int, [c_void_p, POINTER(baum_simulation_options)]),
    "baum_study_grid_init": (None, [POINTER(baum_study_grid), c_size_t]),
    "baum_study_add_standard": (c_int, [c_void_p, POINTER(baum_study_grid)]),
    "baum_study_add_stress": (c_int, [c_void_p, c_void_p]),
    "baum_study_set_error": (c_int, [c_void_p, POINTER(baum_channel), c_int32, c_double]),
    "baum_study_set_reference": (c_int, [
        c_void_p, c_void_p, c_int32, c_void_p, c_void_p, c_void_p, c_double,
    ]),
    "baum_study_set_solution": (c_int, [c_void_p, baum_study_solution_fn, c_void_p, c_double]),
    "baum_study_run": (c_int, [c_void_p]),
    "baum_study_cancel": (None, [c_void_p]),
    "baum_study_state_name": (c_char_p, [c_int]),
    "baum_study_entry_count": (c_int32, [c_void_p]),
    "baum_study_entry_at": (c_int, [c_void_p, c_int32, POINTER(baum_study_entry), c_size_t]),
    "baum_study_entry_options": (c_int, [
        c_void_p, c_int32, POINTER(baum_simulation_options), c_size_t,
    ]),
    "baum_study_reference_read": (c_int, [c_void_p, POINTER(baum_study_reference), c_size_t]),
    "baum_study_reference_sample": (c_int, [
        c_void_p, c_int32, c_void_p, c_void_p, c_void_p, c_void_p,
    ]),
    "baum_study_settings": (c_int, [
        c_void_p, c_void_p, c_void_p, POINTER(baum_study_options), c_size_t,
    ]),
    "baum_study_error_text": (c_char_p, [c_void_p]),
    "baum_study_method_count": (c_int32, [c_void_p]),
    "baum_study_method_at": (c_int, [c_void_p, c_int32, POINTER(baum_study_method), c_size_t]),
    "baum_study_front": (c_int, [c_void_p, c_int, c_int32, POINTER(c_int32), POINTER(c_int32)]),
    "baum_study_cost_at": (c_int, [c_void_p, c_int32, c_double, c_int, c_void_p]),
    "baum_study_compare": (c_int, [c_void_p, c_int32, c_int32, c_double, c_int, c_void_p]),
    "baum_study_recommend": (c_int, [
        c_void_p, c_double, c_int, POINTER(baum_simulation_options), c_size_t, c_char_p, c_size_t,
    ]),
    "baum_study_recommend_budget": (c_int, [
        c_void_p, c_double, POINTER(baum_simulation_options), c_size_t, c_char_p, c_size_t,
    ]),
    "baum_study_write": (c_int, [c_void_p, c_int, c_char_p, c_char_p]),
    "baum_study_print": (c_int, [c_void_p, c_int, c_char_p, c_char_p, c_size_t, POINTER(c_size_t)]),
    "baum_mechanism_print": (c_int, [
        c_void_p, POINTER(baum_hook), c_int32, c_char_p, c_size_t, POINTER(c_size_t),
    ]),
    "baum_mechanism_write": (c_int, [c_void_p, POINTER(baum_hook), c_int32, c_char_p]),
    "baum_mechanism_parse": (c_int, [
        c_char_p, c_size_t, POINTER(baum_hook), c_int32, POINTER(c_void_p),
    ]),
    "baum_mechanism_read": (c_int, [c_char_p, POINTER(baum_hook), c_int32, POINTER(c_void_p)]),
    "baum_mechanism_compare": (c_int, [c_void_p, c_void_p, POINTER(c_bool)]),
    "baum_spatial_body_def_init": (None, [POINTER(baum_spatial_body_def), c_size_t]),
    "baum_mechanism_add_spatial_body": (c_int, [
        c_void_p, POINTER(baum_spatial_body_def), POINTER(baum_body_id),
    ]),
    "baum_mechanism_get_spatial_body": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_spatial_body_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_body": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_spatial_body_def),
    ]),
    "baum_spatial_particle_def_init": (None, [POINTER(baum_spatial_particle_def), c_size_t]),
    "baum_mechanism_add_spatial_particle": (c_int, [
        c_void_p, POINTER(baum_spatial_particle_def), POINTER(baum_body_id),
    ]),
    "baum_mechanism_get_spatial_particle": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_spatial_particle_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_particle": (c_int, [
        c_void_p, baum_body_id, POINTER(baum_spatial_particle_def),
    ]),
    "baum_spatial_spring_def_init": (None, [POINTER(baum_spatial_spring_def), c_size_t]),
    "baum_mechanism_add_spatial_spring": (c_int, [
        c_void_p, POINTER(baum_spatial_spring_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_spatial_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_spring_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_spring_def),
    ]),
    "baum_spatial_cable_def_init": (None, [POINTER(baum_spatial_cable_def), c_size_t]),
    "baum_mechanism_add_spatial_cable": (c_int, [
        c_void_p, POINTER(baum_spatial_cable_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_spatial_cable": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_cable_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_cable": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_cable_def),
    ]),
    "baum_spatial_torsion_spring_def_init": (None, [
        POINTER(baum_spatial_torsion_spring_def), c_size_t,
    ]),
    "baum_mechanism_add_spatial_torsion_spring": (c_int, [
        c_void_p, POINTER(baum_spatial_torsion_spring_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_spatial_torsion_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_torsion_spring_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_torsion_spring": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_torsion_spring_def),
    ]),
    "baum_spatial_bushing_def_init": (None, [POINTER(baum_spatial_bushing_def), c_size_t]),
    "baum_mechanism_add_spatial_bushing": (c_int, [
        c_void_p, POINTER(baum_spatial_bushing_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_spatial_bushing": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_bushing_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_bushing": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_bushing_def),
    ]),
    "baum_spatial_load_def_init": (None, [POINTER(baum_spatial_load_def), c_size_t]),
    "baum_mechanism_add_spatial_load": (c_int, [
        c_void_p, POINTER(baum_spatial_load_def), POINTER(baum_force_id),
    ]),
    "baum_mechanism_get_spatial_load": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_load_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_load": (c_int, [
        c_void_p, baum_force_id, POINTER(baum_spatial_load_def),
    ]),
    "baum_spatial_distance_def_init": (None, [POINTER(baum_spatial_distance_def), c_size_t]),
    "baum_mechanism_add_spatial_distance": (c_int, [
        c_void_p, POINTER(baum_spatial_distance_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_distance": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_distance_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_distance": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_distance_def),
    ]),
    "baum_spatial_point_on_line_def_init": (None, [
        POINTER(baum_spatial_point_on_line_def), c_size_t,
    ]),
    "baum_mechanism_add_spatial_point_on_line": (c_int, [
        c_void_p, POINTER(baum_spatial_point_on_line_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_point_on_line": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_point_on_line_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_point_on_line": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_point_on_line_def),
    ]),
    "baum_spatial_point_on_plane_def_init": (None, [
        POINTER(baum_spatial_point_on_plane_def), c_size_t,
    ]),
    "baum_mechanism_add_spatial_point_on_plane": (c_int, [
        c_void_p, POINTER(baum_spatial_point_on_plane_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_point_on_plane": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_point_on_plane_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_point_on_plane": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_point_on_plane_def),
    ]),
    "baum_spatial_curve_def_init": (None, [POINTER(baum_spatial_curve_def), c_size_t]),
    "baum_mechanism_add_spatial_curve": (c_int, [
        c_void_p, POINTER(baum_spatial_curve_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_curve": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_curve_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_curve": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_curve_def),
    ]),
    "baum_spatial_rolling_disc_def_init": (None, [
        POINTER(baum_spatial_rolling_disc_def), c_size_t,
    ]),
    "baum_mechanism_add_spatial_rolling_disc": (c_int, [
        c_void_p, POINTER(baum_spatial_rolling_disc_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_rolling_disc": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_rolling_disc_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_rolling_disc": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_rolling_disc_def),
    ]),
    "baum_spatial_knife_edge_def_init": (None, [POINTER(baum_spatial_knife_edge_def), c_size_t]),
    "baum_mechanism_add_spatial_knife_edge": (c_int, [
        c_void_p, POINTER(baum_spatial_knife_edge_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_knife_edge": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_knife_edge_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_knife_edge": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_knife_edge_def),
    ]),
    "baum_spatial_spherical_def_init": (None, [POINTER(baum_spatial_spherical_def), c_size_t]),
    "baum_mechanism_add_spatial_spherical": (c_int, [
        c_void_p, POINTER(baum_spatial_spherical_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_spherical": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_spherical_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_spherical": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_spherical_def),
    ]),
    "baum_spatial_revolute_def_init": (None, [POINTER(baum_spatial_revolute_def), c_size_t]),
    "baum_mechanism_add_spatial_revolute": (c_int, [
        c_void_p, POINTER(baum_spatial_revolute_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_revolute": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_revolute_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_revolute": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_revolute_def),
    ]),
    "baum_spatial_universal_def_init": (None, [POINTER(baum_spatial_universal_def), c_size_t]),
    "baum_mechanism_add_spatial_universal": (c_int, [
        c_void_p, POINTER(baum_spatial_universal_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_universal": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_universal_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_universal": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_universal_def),
    ]),
    "baum_spatial_cylindrical_def_init": (None, [POINTER(baum_spatial_cylindrical_def), c_size_t]),
    "baum_mechanism_add_spatial_cylindrical": (c_int, [
        c_void_p, POINTER(baum_spatial_cylindrical_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_cylindrical": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_cylindrical_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_cylindrical": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_cylindrical_def),
    ]),
    "baum_spatial_prismatic_def_init": (None, [POINTER(baum_spatial_prismatic_def), c_size_t]),
    "baum_mechanism_add_spatial_prismatic": (c_int, [
        c_void_p, POINTER(baum_spatial_prismatic_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_prismatic": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_prismatic_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_prismatic": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_prismatic_def),
    ]),
    "baum_spatial_planar_def_init": (None, [POINTER(baum_spatial_planar_def), c_size_t]),
    "baum_mechanism_add_spatial_planar": (c_int, [
        c_void_p, POINTER(baum_spatial_planar_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_planar": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_planar_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_planar": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_planar_def),
    ]),
    "baum_spatial_fixed_def_init": (None, [POINTER(baum_spatial_fixed_def), c_size_t]),
    "baum_mechanism_add_spatial_fixed": (c_int, [
        c_void_p, POINTER(baum_spatial_fixed_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_fixed": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_fixed_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_fixed": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_fixed_def),
    ]),
    "baum_spatial_screw_def_init": (None, [POINTER(baum_spatial_screw_def), c_size_t]),
    "baum_mechanism_add_spatial_screw": (c_int, [
        c_void_p, POINTER(baum_spatial_screw_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_screw": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_screw_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_screw": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_screw_def),
    ]),
    "baum_spatial_constant_velocity_def_init": (None, [
        POINTER(baum_spatial_constant_velocity_def), c_size_t,
    ]),
    "baum_mechanism_add_spatial_constant_velocity": (c_int, [
        c_void_p, POINTER(baum_spatial_constant_velocity_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spatial_constant_velocity": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_constant_velocity_def), c_size_t,
    ]),
    "baum_mechanism_set_spatial_constant_velocity": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spatial_constant_velocity_def),
    ]),
    "baum_spline_driver_def_init": (None, [POINTER(baum_spline_driver_def), c_size_t]),
    "baum_mechanism_add_spline_driver": (c_int, [
        c_void_p, POINTER(baum_spline_driver_def), POINTER(baum_joint_id),
    ]),
    "baum_mechanism_get_spline_driver": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spline_driver_def), c_size_t,
    ]),
    "baum_mechanism_set_spline_driver": (c_int, [
        c_void_p, baum_joint_id, POINTER(baum_spline_driver_def),
    ]),
    "baum_sweep_def_init": (None, [POINTER(baum_sweep_def), c_size_t]),
    "baum_sweep": (c_int, [
        c_void_p, POINTER(baum_simulation_options), POINTER(baum_sweep_def), c_void_p,
        POINTER(c_int32),
    ]),
    "baum_version": (c_char_p, []),
    "baum_has": (c_bool, [c_char_p]),
}

# The same for the library of the catalogue.
CATALOG_PROTOTYPES = {
    "baum_catalog_count": (c_int32, []),
    "baum_catalog_entry_at": (c_int, [c_int32, POINTER(baum_catalog_entry), c_size_t]),
    "baum_catalog_find": (c_int, [c_char_p, POINTER(baum_catalog_entry), c_size_t]),
    "baum_catalog_parameter_at": (c_int, [
        c_char_p, c_int32, POINTER(baum_catalog_parameter), c_size_t,
    ]),
    "baum_catalog_build": (c_int, [POINTER(baum_catalog_choice), POINTER(c_void_p)]),
    "baum_catalog_times": (c_int, [c_char_p, c_void_p]),
    "baum_catalog_reference": (c_int, [POINTER(baum_catalog_choice), c_double, c_void_p, c_void_p]),
    "baum_catalog_solution": (c_int, [c_double, c_void_p, c_void_p, c_void_p, c_void_p]),
    "baum_catalog_compare": (c_int, [
        POINTER(baum_catalog_choice), c_void_p, c_void_p, c_int64, c_void_p, c_void_p,
        POINTER(baum_catalog_error), c_size_t,
    ]),
}

# Structs that the caller fills, and the functions that set their defaults.
DEFAULTS = {
    baum_coordinates_def: "baum_coordinates_def_init",
    baum_user_constraint_def: "baum_user_constraint_def_init",
    baum_driver_def: "baum_driver_def_init",
    baum_coupling_def: "baum_coupling_def_init",
    baum_user_force_def: "baum_user_force_def_init",
    baum_joint_spring_def: "baum_joint_spring_def_init",
    baum_joint_load_def: "baum_joint_load_def_init",
    baum_simulation_options: "baum_simulation_options_init",
    baum_channel: "baum_channel_init",
    baum_outline: "baum_outline_init",
    baum_page: "baum_page_init",
    baum_event_def: "baum_event_def_init",
    baum_planar_body_def: "baum_planar_body_def_init",
    baum_planar_particle_def: "baum_planar_particle_def_init",
    baum_planar_revolute_def: "baum_planar_revolute_def_init",
    baum_planar_translational_def: "baum_planar_translational_def_init",
    baum_planar_distance_def: "baum_planar_distance_def_init",
    baum_planar_fixed_def: "baum_planar_fixed_def_init",
    baum_planar_spring_def: "baum_planar_spring_def_init",
    baum_planar_torsion_spring_def: "baum_planar_torsion_spring_def_init",
    baum_planar_load_def: "baum_planar_load_def_init",
    baum_planar_pin_in_slot_def: "baum_planar_pin_in_slot_def_init",
    baum_planar_rack_and_pinion_def: "baum_planar_rack_and_pinion_def_init",
    baum_planar_gear_def: "baum_planar_gear_def_init",
    baum_planar_curve_def: "baum_planar_curve_def_init",
    baum_planar_knife_edge_def: "baum_planar_knife_edge_def_init",
    baum_study_options: "baum_study_options_init",
    baum_study_grid: "baum_study_grid_init",
    baum_spatial_body_def: "baum_spatial_body_def_init",
    baum_spatial_particle_def: "baum_spatial_particle_def_init",
    baum_spatial_spring_def: "baum_spatial_spring_def_init",
    baum_spatial_cable_def: "baum_spatial_cable_def_init",
    baum_spatial_torsion_spring_def: "baum_spatial_torsion_spring_def_init",
    baum_spatial_bushing_def: "baum_spatial_bushing_def_init",
    baum_spatial_load_def: "baum_spatial_load_def_init",
    baum_spatial_distance_def: "baum_spatial_distance_def_init",
    baum_spatial_point_on_line_def: "baum_spatial_point_on_line_def_init",
    baum_spatial_point_on_plane_def: "baum_spatial_point_on_plane_def_init",
    baum_spatial_curve_def: "baum_spatial_curve_def_init",
    baum_spatial_rolling_disc_def: "baum_spatial_rolling_disc_def_init",
    baum_spatial_knife_edge_def: "baum_spatial_knife_edge_def_init",
    baum_spatial_spherical_def: "baum_spatial_spherical_def_init",
    baum_spatial_revolute_def: "baum_spatial_revolute_def_init",
    baum_spatial_universal_def: "baum_spatial_universal_def_init",
    baum_spatial_cylindrical_def: "baum_spatial_cylindrical_def_init",
    baum_spatial_prismatic_def: "baum_spatial_prismatic_def_init",
    baum_spatial_planar_def: "baum_spatial_planar_def_init",
    baum_spatial_fixed_def: "baum_spatial_fixed_def_init",
    baum_spatial_screw_def: "baum_spatial_screw_def_init",
    baum_spatial_constant_velocity_def: "baum_spatial_constant_velocity_def_init",
    baum_spline_driver_def: "baum_spline_driver_def_init",
    baum_sweep_def: "baum_sweep_def_init",
}

STRUCTS = [
    baum_body_id,
    baum_joint_id,
    baum_force_id,
    baum_input_id,
    baum_coordinates_def,
    baum_user_constraint_def,
    baum_driver_def,
    baum_coupling_def,
    baum_user_force_def,
    baum_joint_spring_def,
    baum_joint_load_def,
    baum_mobility,
    baum_report,
    baum_gains,
    baum_amplification,
    baum_simulation_options,
    baum_channel,
    baum_counters,
    baum_energy_account,
    baum_near_singular,
    baum_warning,
    baum_outline,
    baum_page,
    baum_dae,
    baum_sparse,
    baum_event_def,
    baum_event_record,
    baum_planar_body_def,
    baum_planar_particle_def,
    baum_planar_revolute_def,
    baum_planar_translational_def,
    baum_planar_distance_def,
    baum_planar_fixed_def,
    baum_planar_spring_def,
    baum_planar_torsion_spring_def,
    baum_planar_load_def,
    baum_planar_pin_in_slot_def,
    baum_planar_rack_and_pinion_def,
    baum_planar_gear_def,
    baum_planar_curve_def,
    baum_planar_knife_edge_def,
    baum_study_options,
    baum_study_grid,
    baum_study_entry,
    baum_study_reference,
    baum_study_method,
    baum_hook,
    baum_spatial_body_def,
    baum_spatial_particle_def,
    baum_spatial_spring_def,
    baum_spatial_cable_def,
    baum_spatial_torsion_spring_def,
    baum_spatial_bushing_def,
    baum_spatial_load_def,
    baum_spatial_distance_def,
    baum_spatial_point_on_line_def,
    baum_spatial_point_on_plane_def,
    baum_spatial_curve_def,
    baum_spatial_rolling_disc_def,
    baum_spatial_knife_edge_def,
    baum_spatial_spherical_def,
    baum_spatial_revolute_def,
    baum_spatial_universal_def,
    baum_spatial_cylindrical_def,
    baum_spatial_prismatic_def,
    baum_spatial_planar_def,
    baum_spatial_fixed_def,
    baum_spatial_screw_def,
    baum_spatial_constant_velocity_def,
    baum_spline_driver_def,
    baum_sweep_def,
    baum_catalog_entry,
    baum_catalog_parameter,
    baum_catalog_setting,
    baum_catalog_choice,
    baum_catalog_error,
]
