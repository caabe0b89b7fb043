//! Causes of cars whose motion is compared with what throttle and steering imply: from the command to the report.

use crate::CauseSpec;

const ROBOTS: &str = "car";

/// Steering angle at full command.
pub const STEERING_COMMAND_GAIN: CauseSpec = CauseSpec {
    id: "steering_command_gain",
    name: "steering angle at full command",
    robots: ROBOTS,
    meaning: "The wheels steer by more or less at full command than stated: linkage, horn of the servo, \
        or the map of the driver.",
    size: "factor on the steering angle",
    unit: "-",
    recognised: "Curvatures of slow circles err by one factor both ways",
    revealed_by: "slow circles to both sides at several commands",
    resembles: "car_wheelbase: curvature knows only their ratio while tyres do not slip",
};

/// Steering angle at no command.
pub const STEERING_CENTRE: CauseSpec = CauseSpec {
    id: "steering_centre",
    name: "steering angle at no command",
    robots: ROBOTS,
    meaning: "The wheels do not point ahead at no command: trim of the servo, or a bent linkage.",
    size: "steering angle at no command beyond what is stated",
    unit: "rad",
    recognised: "Straight commands give a curve, and left and right circles differ",
    revealed_by: "straight drives, and circles to both sides",
    resembles: "car_gyro_bias where only a gyro shows the turning",
};

/// Steering angle out of proportion to the command.
pub const STEERING_MAP: CauseSpec = CauseSpec {
    id: "steering_map",
    name: "steering angle out of proportion to the command",
    robots: ROBOTS,
    meaning: "The linkage turns the wheels by less per command far out than near the centre, or unlike \
        to the left and the right.",
    size: "bend of the map at full command",
    unit: "rad",
    recognised: "Curvatures of slow circles are no straight line over the command",
    revealed_by: "slow circles at five commands to both sides",
    resembles: "grip_limit in fast circles only",
};

/// Steering begins late.
pub const STEERING_DELAY: CauseSpec = CauseSpec {
    id: "steering_delay",
    name: "steering begins late",
    robots: ROBOTS,
    meaning: "Commands reach the steering late: a bus, a driver, or a servo that reads its pulse at 50 \
        Hz.",
    size: "dead time beyond what is stated",
    unit: "s",
    recognised: "Turning begins later than commanded by a time that does not depend on the step",
    revealed_by: "steps and sweeps of the steering at constant throttle",
    resembles: "steering_lag in slow sweeps; car_clock_delay where no sensor of the car is recorded",
};

/// Steering settles slowly.
pub const STEERING_LAG: CauseSpec = CauseSpec {
    id: "steering_lag",
    name: "steering settles slowly",
    robots: ROBOTS,
    meaning: "The servo approaches its command like a first-order lag.",
    size: "time constant beyond what is stated",
    unit: "s",
    recognised: "Turning after a step approaches its end by an exponential",
    revealed_by: "steps of the steering at constant throttle",
    resembles: "steering_delay in slow sweeps; steering_rate in large steps",
};

/// Steering moves at a limited rate.
pub const STEERING_RATE: CauseSpec = CauseSpec {
    id: "steering_rate",
    name: "steering moves at a limited rate",
    robots: ROBOTS,
    meaning: "The servo turns at a largest rate: large steps take longer than small ones.",
    size: "time for a steering angle of one radian",
    unit: "s/rad",
    recognised: "The time to turn grows with the step",
    revealed_by: "steps of the steering of unlike size",
    resembles: "steering_lag where all steps are alike",
};

/// Play of the steering.
pub const STEERING_PLAY: CauseSpec = CauseSpec {
    id: "steering_play",
    name: "play of the steering",
    robots: ROBOTS,
    meaning: "The linkage has play: the wheels stay where they are until the servo has crossed it.",
    size: "half of the play",
    unit: "rad",
    recognised: "The same command gives two curvatures, by where it came from",
    revealed_by: "slow sweeps of the steering to and fro",
    resembles: "steering_lag in sweeps of one rate",
};

/// Distance of the axles.
pub const WHEELBASE: CauseSpec = CauseSpec {
    id: "car_wheelbase",
    name: "distance of the axles",
    robots: ROBOTS,
    meaning: "Front and rear contacts lie farther apart, or nearer, than stated.",
    size: "factor on the wheelbase",
    unit: "-",
    recognised: "Curvatures are wrong by one factor",
    revealed_by: "slow circles",
    resembles: "steering_command_gain, if that is not known better",
};

/// Place of the centre of mass along the car.
pub const CENTRE_OF_MASS: CauseSpec = CauseSpec {
    id: "centre_of_mass",
    name: "place of the centre of mass along the car",
    robots: ROBOTS,
    meaning: "The load sits further forward, or back, than stated, which moves sideways forces between \
        the axles.",
    size: "factor on its distance from the rear axle",
    unit: "-",
    recognised: "Turning on and off the throttle and transients of fast curves",
    revealed_by: "fast curves with steps of the steering",
    resembles: "tyre_slip of one axle",
};

/// Yaw inertia.
pub const YAW_INERTIA: CauseSpec = CauseSpec {
    id: "yaw_inertia",
    name: "yaw inertia",
    robots: ROBOTS,
    meaning: "The car turns in slower, or faster, than its stated inertia says.",
    size: "factor on the yaw inertia",
    unit: "-",
    recognised: "Yaw rate after steps of the steering at speed",
    revealed_by: "fast steps of the steering",
    resembles: "steering_lag where all steps are at one speed",
};

/// Tyres slip sideways: understeer or oversteer.
pub const TYRE_SLIP: CauseSpec = CauseSpec {
    id: "tyre_slip",
    name: "tyres slip sideways: understeer or oversteer",
    robots: ROBOTS,
    meaning: "Tyres give way in proportion to the side force, front and rear unlike: curves become \
        wider, or narrower, with speed.",
    size: "slip angle per sideways acceleration",
    unit: "rad s²/m",
    recognised: "Curvature at one command changes with the square of the speed",
    revealed_by: "circles at one command and rising speed",
    resembles: "grip_limit where all circles are fast",
};

/// Sideways acceleration is limited by grip.
pub const GRIP_LIMIT: CauseSpec = CauseSpec {
    id: "grip_limit",
    name: "sideways acceleration is limited by grip",
    robots: ROBOTS,
    meaning: "Tyres cannot hold more than a largest sideways acceleration; beyond it curves open.",
    size: "inverse of the largest sideways acceleration",
    unit: "s²/m",
    recognised: "Sideways acceleration stops growing with speed",
    revealed_by: "circles up to the speed at which the car slides",
    resembles: "tyre_slip below half of the limit",
};

/// Acceleration at full throttle.
pub const DRIVE_GAIN: CauseSpec = CauseSpec {
    id: "drive_gain",
    name: "acceleration at full throttle",
    robots: ROBOTS,
    meaning: "The motor pushes more or less than stated: gear, battery, or the driver's current limit.",
    size: "factor on the acceleration at full throttle",
    unit: "-",
    recognised: "Starts are faster or slower in proportion to the throttle",
    revealed_by: "steps of the throttle from rest",
    resembles: "drive_friction where the throttle is always the same",
};

/// Dead zone of the throttle.
pub const THROTTLE_DEAD_ZONE: CauseSpec = CauseSpec {
    id: "throttle_dead_zone",
    name: "dead zone of the throttle",
    robots: ROBOTS,
    meaning: "The motor does not turn below a throttle that is higher than stated.",
    size: "throttle that has no effect, beyond what is stated",
    unit: "-",
    recognised: "Small throttles have no effect",
    revealed_by: "slow ramps of the throttle from zero",
    resembles: "drive_friction: dry friction shifts the throttle at which the car starts likewise",
};

/// Top speed: back-EMF.
pub const TOP_SPEED: CauseSpec = CauseSpec {
    id: "top_speed",
    name: "top speed: back-EMF",
    robots: ROBOTS,
    meaning: "Push falls with speed by more or less than stated: the motor's voltage constant or its \
        gear.",
    size: "loss of acceleration per speed at full throttle",
    unit: "1/s",
    recognised: "Speeds at high throttle settle lower or higher",
    revealed_by: "throttle held until the speed settles, at several throttles",
    resembles: "drive_friction",
};

/// Friction of the drive.
pub const DRIVE_FRICTION: CauseSpec = CauseSpec {
    id: "drive_friction",
    name: "friction of the drive",
    robots: ROBOTS,
    meaning: "Gears, bearings and tyres slow the car by more or less than stated, dry or with speed.",
    size: "deceleration that does not depend on speed",
    unit: "m/s²",
    recognised: "The car rolls out shorter, or longer, than it should",
    revealed_by: "rolling out without throttle",
    resembles: "throttle_dead_zone; top_speed",
};

/// Motor follows the throttle late.
pub const DRIVE_LAG: CauseSpec = CauseSpec {
    id: "drive_lag",
    name: "motor follows the throttle late",
    robots: ROBOTS,
    meaning: "Push follows the throttle with a lag beyond the one stated.",
    size: "time constant of the drive",
    unit: "s",
    recognised: "Speed after a step of the throttle begins flat",
    revealed_by: "steps of the throttle",
    resembles: "car_clock_delay",
};

/// Place of the tracked point.
pub const TRACKED_POINT: CauseSpec = CauseSpec {
    id: "tracked_point",
    name: "place of the tracked point",
    robots: ROBOTS,
    meaning: "Motion capture follows another point of the car than stated.",
    size: "place of the point, forward, beyond what is stated",
    unit: "m",
    recognised: "The car seems to slide sideways in proportion to its turning",
    revealed_by: "slow circles to both sides",
    resembles: "tyre_slip in fast circles",
};

/// Direction of the tracked axes.
pub const TRACKED_AXES: CauseSpec = CauseSpec {
    id: "tracked_axes",
    name: "direction of the tracked axes",
    robots: ROBOTS,
    meaning: "The tracked heading is not that of the car.",
    size: "angle of the tracked x axis beyond what is stated",
    unit: "rad",
    recognised: "The car seems to slide sideways in proportion to its speed, straight on as well",
    revealed_by: "straight drives",
    resembles: "none in straight drives",
};

/// The car's channels come late.
pub const CAR_CLOCK_DELAY: CauseSpec = CauseSpec {
    id: "car_clock_delay",
    name: "the car's channels come late",
    robots: ROBOTS,
    meaning: "Commands and sensors of the car are recorded later than the pose.",
    size: "by how much they are late",
    unit: "s",
    recognised: "Gyro and pose agree when one of them is shifted, and commands with them",
    revealed_by: "sweeps of the steering, steps of the throttle",
    resembles: "steering_delay with drive_lag; gyro_delay",
};

/// The clocks of car and pose run at unlike rates.
pub const CAR_CLOCK_RATE: CauseSpec = CauseSpec {
    id: "car_clock_rate",
    name: "clocks of car and pose run at unlike rates",
    robots: ROBOTS,
    meaning: "The clock of the car's channels is slow or fast against that of the pose, and may have started apart from it; or both \
              logs were joined by hand.",
    size: "share by which the car's clock is slow; below zero it is fast",
    unit: "-",
    recognised: "Gyro and encoder agree with the pose once the car's time is shifted and stretched",
    revealed_by: "long drives with turns and stops",
    resembles: "nothing else: a delay does not grow",
};

/// Scale of the gyro.
pub const GYRO_SCALE: CauseSpec = CauseSpec {
    id: "car_gyro_scale",
    name: "scale of the gyro",
    robots: ROBOTS,
    meaning: "The gyro shows turning by a factor: its range, unit or mounting.",
    size: "factor on the yaw rate",
    unit: "-",
    recognised: "Gyro and turning of the pose differ by one factor",
    revealed_by: "circles both ways",
    resembles: "a wrong unit: 57.3 stands for degrees",
};

/// Bias of the gyro.
pub const GYRO_BIAS: CauseSpec = CauseSpec {
    id: "car_gyro_bias",
    name: "bias of the gyro",
    robots: ROBOTS,
    meaning: "The gyro shows turning of a car at rest.",
    size: "yaw rate that it shows at rest",
    unit: "rad/s",
    recognised: "Gyro minus turning of the pose does not change",
    revealed_by: "any drive",
    resembles: "steering_centre where there is no pose",
};

/// The gyro is late.
pub const GYRO_DELAY: CauseSpec = CauseSpec {
    id: "gyro_delay",
    name: "the gyro is late",
    robots: ROBOTS,
    meaning: "The gyro's filter or its bus shows turning late, the other channels of the car are in \
        time.",
    size: "by how much it is late",
    unit: "s",
    recognised: "Gyro and pose agree when the gyro alone is shifted",
    revealed_by: "sweeps of the steering",
    resembles: "car_clock_delay",
};

/// Speed by the encoder: wheel radius, gear or counts.
pub const ENCODER_SCALE: CauseSpec = CauseSpec {
    id: "car_encoder_scale",
    name: "speed by the encoder: wheel radius, gear or counts",
    robots: ROBOTS,
    meaning: "The encoder's speed is that of the ground by a factor: radius of the wheels, gear, or \
        counts per turn; 2 or 4 are edges that are counted.",
    size: "factor on the speed",
    unit: "-",
    recognised: "Encoder and pose differ by one factor at all speeds",
    revealed_by: "straight drives at several speeds",
    resembles: "a wrong scale of the pose",
};

/// Driven wheels slip in bends.
pub const WHEEL_SLIP_IN_BENDS: CauseSpec = CauseSpec {
    id: "wheel_slip_in_bends",
    name: "driven wheels slip in bends",
    robots: ROBOTS,
    meaning: "Driven wheels turn faster than the car moves where it corners hard: their push against \
        the drag of tyres that hold it sideways takes slip, and the encoder counts it.",
    size: "share by which the encoder is ahead, over the square of the sideways acceleration",
    unit: "s⁴/m²",
    recognised: "Encoder over pose is right straight ahead and grows with the sideways acceleration",
    revealed_by: "circles from slow to fast",
    resembles: "car_encoder_scale where all bends are alike",
};

/// Speed by the encoder is late.
pub const ENCODER_DELAY: CauseSpec = CauseSpec {
    id: "encoder_delay",
    name: "speed by the encoder is late",
    robots: ROBOTS,
    meaning: "The encoder's speed is that of a time ago, beyond its own averaging.",
    size: "by how much it is late",
    unit: "s",
    recognised: "Encoder and pose agree when the encoder alone is shifted",
    revealed_by: "steps of the throttle",
    resembles: "car_clock_delay",
};

/// A slope under the car.
pub const GROUND_SLOPE: CauseSpec = CauseSpec {
    id: "car_ground_slope",
    name: "the car drives on a slope",
    robots: ROBOTS,
    meaning: "Gravity pulls the car along the ground, the same way in the world wherever it heads.",
    size: "slope along x and y of the pose's frame, positive where the ground rises",
    unit: "rad",
    recognised: "The car is slower than its throttle implies one way, and faster the other way",
    revealed_by: "the same straight line both ways, in two directions",
    resembles: "drive_gain and drive_friction while the car heads one way",
};

/// All of them, from the command to the report.
pub const ALL: [&CauseSpec; 28] = [
    &STEERING_COMMAND_GAIN,
    &STEERING_CENTRE,
    &STEERING_MAP,
    &STEERING_DELAY,
    &STEERING_LAG,
    &STEERING_RATE,
    &STEERING_PLAY,
    &WHEELBASE,
    &CENTRE_OF_MASS,
    &YAW_INERTIA,
    &TYRE_SLIP,
    &GRIP_LIMIT,
    &DRIVE_GAIN,
    &THROTTLE_DEAD_ZONE,
    &TOP_SPEED,
    &DRIVE_FRICTION,
    &DRIVE_LAG,
    &GROUND_SLOPE,
    &TRACKED_POINT,
    &TRACKED_AXES,
    &CAR_CLOCK_DELAY,
    &CAR_CLOCK_RATE,
    &GYRO_SCALE,
    &GYRO_BIAS,
    &GYRO_DELAY,
    &ENCODER_SCALE,
    &WHEEL_SLIP_IN_BENDS,
    &ENCODER_DELAY,
];
