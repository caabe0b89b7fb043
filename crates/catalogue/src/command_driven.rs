//! Causes of command-driven robots: neither torques nor currents are known, only commanded and measured wheel speeds and
//! how the body moves. What is named is an element of the way from command to wheel, or from wheel to ground.

use robot_model::effects::{motor_lag, transport_delay, wheel_radius_mismatch};

use crate::CauseSpec;

const ROBOTS: &str = "command-driven";
const WHEEL: &str = "Forecasts of left-out wheel speeds from the commands get worse without it";
const BODY: &str = "Forecasts of left-out body motion from the measured wheel speeds get worse without it";

/// Gains, limits and ramps between command and wheel.
pub const DRIVE_COMMAND: CauseSpec = CauseSpec {
    id: "drive_command",
    name: "the drive's controller does not hold the command: gains, limits, ramps",
    robots: ROBOTS,
    meaning: "The wheels turn otherwise than commanded, steadily: gains of forward speed and turning, their limits, a \
        limit of the wheels that both sides share, limits of acceleration, or sides of different gain.",
    size: "error of the wheel speeds when they are taken to be those commanded, rms",
    unit: "rad/s",
    recognised: WHEEL,
    revealed_by: "steps of forward speed and of turning, small and up to the limits",
    resembles: "motor_lag and transport_delay while commands change all the time",
};

/// Dead time between command and wheel.
pub const DEAD_TIME: CauseSpec = CauseSpec {
    id: transport_delay::SPEC.id,
    name: "dead time from command to wheel",
    robots: ROBOTS,
    meaning: "The wheels answer to a command after a dead time.",
    size: "dead time",
    unit: "s",
    recognised: WHEEL,
    revealed_by: "steps of the command after steady driving",
    resembles: "motor_lag when commands change slowly",
};

/// Lag of the wheels' speed control.
pub const LAG: CauseSpec = CauseSpec {
    id: motor_lag::SPEC.id,
    name: "lag of the wheels' speed control",
    robots: ROBOTS,
    meaning: "The wheels follow the command by a lag of first or second order.",
    size: "time constant; of a second-order lag twice the damping ratio over the natural frequency",
    unit: "s",
    recognised: WHEEL,
    revealed_by: "steps of the command after steady driving",
    resembles: "transport_delay when commands change slowly; a limit of acceleration (drive_command) for steps of one size",
};

/// Effective track.
pub const EFFECTIVE_TRACK: CauseSpec = CauseSpec {
    id: "effective_track",
    name: "effective track: the body turns otherwise than the track says",
    robots: "command-driven, speed-driven",
    meaning: "The yaw rate is the difference of the sides' rim speeds over another length than the track: wheels that \
        are steered by skidding slip sideways.",
    size: "effective track",
    unit: "m",
    recognised: BODY,
    revealed_by: "spins and arcs both ways",
    resembles: "an error of the gyro's scale where no pose was recorded",
};

/// Rolling radius, or steady slip.
pub const ROLLING_RADIUS: CauseSpec = CauseSpec {
    id: "rolling_radius",
    name: "rolling radius, or a longitudinal slip that is always there",
    robots: ROBOTS,
    meaning: "The body moves by another length per turn of the wheels than the radius says.",
    size: "factor on the radius",
    unit: "-",
    recognised: BODY,
    revealed_by: "a long straight drive",
    resembles: "a wrong scale of the encoders or of the pose",
};

/// Forward speed lost in turns.
pub const TURN_SLIP: CauseSpec = CauseSpec {
    id: "turning_slip",
    name: "forward speed lost in turns",
    robots: ROBOTS,
    meaning: "The faster the robot turns, the less of its wheels' mean speed becomes forward speed: v exp(−c ψ̇²) or v exp(−c |ψ̇|).",
    size: "share of the forward speed that is lost at 1 rad/s, 1 − exp(−c)",
    unit: "-",
    recognised: BODY,
    revealed_by: "tight arcs at several speeds",
    resembles: "rolling_radius when all drives turn alike",
};

/// Centre of rotation away from the pose sensor.
pub const TURN_CENTRE_OFFSET: CauseSpec = CauseSpec {
    id: "turn_centre_offset",
    name: "centre of rotation away from the pose sensor",
    robots: ROBOTS,
    meaning: "In turns the pose sensor moves sideways: it sits ahead of the centre of rotation, or behind it.",
    size: "distance of the pose sensor ahead of the centre of rotation",
    unit: "m",
    recognised: BODY,
    revealed_by: "spins both ways",
    resembles: "com_offset, which moves the centre of rotation",
};

/// Body late behind the wheels.
pub const BODY_LAG: CauseSpec = CauseSpec {
    id: "body_lag",
    name: "body (or pose sensor) late behind the wheels",
    robots: ROBOTS,
    meaning: "The body follows its wheels by a first-order lag.",
    size: "time constant",
    unit: "s",
    recognised: BODY,
    revealed_by: "quick changes of speed and of turning",
    resembles: "clock_offset of the pose sensor",
};

/// Sides of different radius.
pub const SIDE_RADIUS: CauseSpec = CauseSpec {
    id: wheel_radius_mismatch::SPEC.id,
    name: "wheels of one side of another radius",
    robots: ROBOTS,
    meaning: "Equal wheel speeds of both sides make the body turn.",
    size: "the left radius is larger, and the right one smaller, by this share",
    unit: "-",
    recognised: BODY,
    revealed_by: "long straight drives both ways",
    resembles: "an offset of the gyro where no pose was recorded",
};

/// All of them, from the command to the ground.
pub const ALL: [&CauseSpec; 9] = [
    &DRIVE_COMMAND,
    &DEAD_TIME,
    &LAG,
    &EFFECTIVE_TRACK,
    &ROLLING_RADIUS,
    &TURN_SLIP,
    &TURN_CENTRE_OFFSET,
    &BODY_LAG,
    &SIDE_RADIUS,
];
