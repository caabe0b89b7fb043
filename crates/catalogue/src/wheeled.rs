//! Causes of robots of any wheels, driven by torques: what moves a constant of their plant.

use crate::CauseSpec;

/// For which robots they are named.
const ROBOTS: &str = "robots of any wheels whose motors' torques are recorded";

/// A cause: id and name, what it means, its size and unit, how it is recognised, what reveals it, what resembles it.
const fn cause(
    [id, name]: [&'static str; 2],
    meaning: &'static str,
    [size, unit]: [&'static str; 2],
    [recognised, revealed_by, resembles]: [&'static str; 3],
) -> CauseSpec {
    CauseSpec { id, name, robots: ROBOTS, meaning, size, unit, recognised, revealed_by, resembles }
}

/// Another mass.
pub const BODY_MASS: CauseSpec = cause(
    ["body_mass", "another mass"],
    "The robot is heavier or lighter than stated: a payload, a battery, an arm.",
    ["mass", "kg"],
    [
        "Accelerations per torque, and rolling resistance with them, are off by one factor",
        "starting and stopping on straight lines, at several torques",
        "motor_torque_scale: without friction only their ratio shows",
    ],
);

/// Another centre of mass.
pub const BODY_COM: CauseSpec = cause(
    ["body_centre_of_mass", "another place of the centre of mass"],
    "A load stands elsewhere than the middle of the mass was taken to be.",
    ["distance ahead of the stated place", "m"],
    [
        "Starting and stopping turns the robot, and turning pushes it aside",
        "turns on the spot, and straight starts with wheels that push to one side",
        "motor_torque_scale of one motor on straight lines",
    ],
);

/// Another yaw inertia.
pub const BODY_YAW_INERTIA: CauseSpec = cause(
    ["body_yaw_inertia", "another yaw inertia"],
    "Masses lie farther out, or nearer, than stated.",
    ["yaw inertia", "kg m²"],
    [
        "Only the beginnings and ends of turns are off",
        "turns that begin and end quickly, to both sides",
        "body_mass at one place of the robot",
    ],
);

/// Dry friction of motors.
pub const MOTOR_DRY_FRICTION: CauseSpec = cause(
    ["motor_dry_friction", "dry friction of motors"],
    "Gears, bearings or brakes of one motor or of all hold with a torque that does not depend on speed.",
    ["dry friction beyond what is stated", "N m"],
    [
        "The same torque is missing at all speeds and turns round with them",
        "slow driving both ways",
        "rolling_drag on all wheels; ground_slope in one direction",
    ],
);

/// Viscous friction of motors.
pub const MOTOR_VISCOUS_FRICTION: CauseSpec = cause(
    ["motor_viscous_friction", "viscous friction of motors"],
    "Grease or back-EMF of one motor or of all takes a torque in proportion to speed.",
    ["viscous friction beyond what is stated", "N m s/rad"],
    [
        "What is missing of the torque grows with the speed",
        "steady driving at three speeds",
        "motor_dry_friction at one speed",
    ],
);

/// Drag that grows with the square of the speed.
pub const BODY_DRAG: CauseSpec = cause(
    ["body_drag", "drag that grows with the square of the speed"],
    "Air, water, tall grass or snow that is pushed aside holds the body: four times as much at twice the speed.",
    ["drag over the square of the speed, beyond what is stated", "N s²/m²"],
    [
        "What is missing of the torque grows faster than the speed, on all motors alike",
        "steady driving at three speeds, the fastest among them",
        "motor_viscous_friction of all motors over a narrow range of speeds",
    ],
);

/// Torque over what is recorded.
pub const MOTOR_TORQUE_SCALE: CauseSpec = cause(
    ["motor_torque_scale", "motors give another torque than recorded"],
    "Motors give more or less torque than their current or command says: torque constant, gear, or units.",
    ["factor on the torque", "-"],
    [
        "Accelerations and friction are off by one factor of the torque",
        "starting and stopping at several torques, and standing against a known force",
        "body_mass where nothing else resists",
    ],
);

/// Lag of motors.
pub const MOTOR_TORQUE_LAG: CauseSpec = cause(
    ["motor_torque_lag", "torque comes later than recorded"],
    "Torque follows what is recorded with a time constant or a dead time: current loops, buses.",
    ["time constant beyond what is stated", "s"],
    [
        "Motion is right but for what follows each step of the torque",
        "steps of the torque",
        "counts_clock_offset, which shifts the whole motion",
    ],
);

/// Rolling resistance.
pub const ROLLING_DRAG: CauseSpec = cause(
    ["rolling_drag", "rolling resistance of the ground"],
    "Tyres or ground take more force than stated, in proportion to the load.",
    ["rolling resistance over the load", "-"],
    ["Wheels without a motor are held, too", "slow driving with the motors off", "motor_dry_friction of all motors"],
);

/// Slip stiffness.
pub const TYRE_STIFFNESS: CauseSpec = cause(
    ["tyre_stiffness", "wheels slip more or less than stated"],
    "Tyres or ground give way more, or less, per force: soft tyres, carpet, dust.",
    ["slip at the largest force over what is stated", "-"],
    [
        "Wheels are ahead of the body while they push, and behind while they brake",
        "hard starts and stops, fast bends",
        "radius_of_all_wheels in steady driving",
    ],
);

/// Grip of the ground.
pub const GROUND_GRIP: CauseSpec = cause(
    ["ground_grip", "another grip of the ground"],
    "The ground holds wheels that skid in turns by more, or less, than stated: carpet for concrete, wet for dry.",
    ["friction coefficient", "-"],
    [
        "Turns of a robot whose wheels skid take more torque, or less, and straight lines do not",
        "turns on the spot and in motion, to both sides",
        "wheel_distance and body_yaw_inertia in turns of one sort",
    ],
);

/// A slope.
pub const GROUND_SLOPE: CauseSpec = cause(
    ["ground_slope", "the ground is a slope"],
    "Gravity pulls the robot along the ground, the same way in the world wherever it heads.",
    ["slope along x of the pose's frame, positive where the ground rises", "rad"],
    [
        "Driving one way takes more torque than the other way",
        "the same straight line both ways, in two directions",
        "motor_dry_friction while the robot heads one way",
    ],
);

/// Rolling resistance of casters.
pub const CASTER_ROLLING_DRAG: CauseSpec = cause(
    ["caster_rolling_drag", "casters roll hard"],
    "Casters are blocked by hair, threads or worn bearings.",
    ["rolling resistance over the load of casters", "-"],
    [
        "A force holds the robot where its casters are, along their way",
        "turns on the spot, where casters run far from the axle",
        "rolling_drag",
    ],
);

/// Friction of casters' pivots.
pub const CASTER_PIVOT_FRICTION: CauseSpec = cause(
    ["caster_pivot_friction", "casters swing hard"],
    "Pivots of casters turn hard, so that their wheels push sideways while they swing.",
    ["dry friction of a pivot", "N m"],
    [
        "After each change of direction the robot is pushed aside until its casters have swung",
        "driving forward and back in turn",
        "caster_rolling_drag",
    ],
);

/// Drag of rollers.
pub const ROLLER_DRAG: CauseSpec = cause(
    ["roller_drag", "rollers run hard"],
    "Rollers of omni or mecanum wheels are dragged instead of rolling freely.",
    ["drag over the load", "-"],
    [
        "Directions in which rollers run take more torque than those in which wheels roll",
        "straight lines along and across, and turns on the spot",
        "motor_dry_friction, which shows in all directions",
    ],
);

/// A wheel that is out of true.
pub const WHEEL_DIRECTION: CauseSpec = cause(
    ["wheel_direction", "a wheel is out of alignment"],
    "A wheel is mounted, or bent, at an angle to the direction in which it should roll.",
    ["angle to the stated direction, positive to the left", "rad"],
    [
        "The robot drifts to one side in steady driving, and resists it at the same time",
        "straight lines both ways",
        "steering_zero of a steered wheel",
    ],
);

/// All of them, from the motor to the ground.
pub const ALL: [&CauseSpec; 16] = [
    &MOTOR_TORQUE_SCALE,
    &MOTOR_TORQUE_LAG,
    &MOTOR_DRY_FRICTION,
    &MOTOR_VISCOUS_FRICTION,
    &BODY_MASS,
    &BODY_COM,
    &BODY_YAW_INERTIA,
    &WHEEL_DIRECTION,
    &TYRE_STIFFNESS,
    &GROUND_GRIP,
    &ROLLING_DRAG,
    &BODY_DRAG,
    &ROLLER_DRAG,
    &CASTER_ROLLING_DRAG,
    &CASTER_PIVOT_FRICTION,
    &GROUND_SLOPE,
];
