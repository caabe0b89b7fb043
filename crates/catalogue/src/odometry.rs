//! Causes of robots whose wheel motion is compared with a measured pose: what lies between a count and the pose.

use crate::CauseSpec;

const ROBOTS: &str = "odometry";

/// An encoder loses counts.
pub const LOST_COUNTS: CauseSpec = CauseSpec {
    id: "lost_counts",
    name: "an encoder loses counts",
    robots: ROBOTS,
    meaning: "In some windows a wheel counts less than it turns: a loose plug, a buffer that runs \
        over, a count rate that is too high.",
    size: "share of the counts that is lost while it happens",
    unit: "-",
    recognised: "Windows far off, in which missing counts of one wheel account for the error",
    revealed_by: "any long drive, its fastest part most",
    resembles: "a wheel that slides, where the pose shows the loss at hard starts and stops only",
};

/// Clocks of counts and pose run at unlike rates.
pub const CLOCK_RATE: CauseSpec = CauseSpec {
    id: "clock_rate",
    name: "clocks of counts and pose run at unlike rates",
    robots: ROBOTS,
    meaning: "The device that counts samples at another rate than it says: the counts get ahead of \
        the pose, or behind it, all through a drive.",
    size: "share by which the clock of the counts is slow",
    unit: "-",
    recognised: "The error grows along a drive and stands for no way that is lost",
    revealed_by: "drives of a minute and more with many turns",
    resembles: "counts_clock_offset in short drives",
};

/// Counts and pose are recorded apart in time.
pub const COUNTS_CLOCK_OFFSET: CauseSpec = CauseSpec {
    id: "counts_clock_offset",
    name: "counts and pose are recorded apart in time",
    robots: ROBOTS,
    meaning: "The counts of a row belong to another instant than its pose.",
    size: "by how much the pose comes later than the counts of its row; of robots under torque, by how much their channels come later than the pose",
    unit: "s",
    recognised: "Errors at starts, stops and at the beginning of turns that cancel afterwards",
    revealed_by: "starts, stops and reversals of turning",
    resembles: "cornering_slip in steady curves",
};

/// A wheel with rollers is out of alignment.
pub const DIRECTION_OF_ONE_WHEEL: CauseSpec = CauseSpec {
    id: "direction_of_one_wheel",
    name: "direction of one wheel",
    robots: ROBOTS,
    meaning: "An omni or mecanum wheel is mounted, or bent, at an angle to the direction in which it \
        should roll, so that its turns move the body another way.",
    size: "angle to the stated direction, positive to the left",
    unit: "rad",
    recognised: "The body goes aside, or turns, in the directions in which this wheel turns most",
    revealed_by: "straight lines along and across and turns on the spot, both ways",
    resembles: "radius_of_one_wheel in drives that go one way; pose_mounting where all wheels are turned alike",
};

/// Radius of all wheels, gear or counts per turn.
pub const RADIUS_OF_ALL_WHEELS: CauseSpec = CauseSpec {
    id: "radius_of_all_wheels",
    name: "radius of all wheels, gear or counts per turn",
    robots: ROBOTS,
    meaning: "All wheels move the body by another length per count than stated: the radius, the \
        gear, or the counts per turn. A factor of 2 or 4 is one of the edges that are \
        counted.",
    size: "factor on the radius",
    unit: "-",
    recognised: "Ways and turnings are wrong by one factor",
    revealed_by: "a straight drive along a measured length",
    resembles: "a wrong scale of the pose: no drive tells the two apart",
};

/// Radius of one wheel.
pub const RADIUS_OF_ONE_WHEEL: CauseSpec = CauseSpec {
    id: "radius_of_one_wheel",
    name: "radius of one wheel",
    robots: ROBOTS,
    meaning: "One wheel moves the body by another length per count than stated, so that straight \
        drives bend.",
    size: "factor on the radius",
    unit: "-",
    recognised: "The heading drifts with the way, the other way round in reverse",
    revealed_by: "straight drives forwards and backwards",
    resembles: "another wheel with the opposite error beside radius_of_all_wheels",
};

/// Distance between wheels: track, wheelbase or centre to wheel.
pub const WHEEL_DISTANCE: CauseSpec = CauseSpec {
    id: "wheel_distance",
    name: "distance between wheels: track, wheelbase or centre to wheel",
    robots: ROBOTS,
    meaning: "The contacts of the wheels lie farther apart, or nearer, than stated: turns are too \
        small or too large by one factor.",
    size: "factor on the distance",
    unit: "-",
    recognised: "Turnings are wrong by one factor, ways are right",
    revealed_by: "turns on the spot both ways",
    resembles: "slip_in_turns where all turns are alike; of a mecanum robot track and wheelbase act \
        as one",
};

/// Zero of the steering.
pub const STEERING_ZERO: CauseSpec = CauseSpec {
    id: "steering_zero",
    name: "zero of the steering",
    robots: ROBOTS,
    meaning: "The steering angle has an offset: straight ahead is a curve.",
    size: "angle of the steered wheels where the recorded one is none",
    unit: "rad",
    recognised: "The heading drifts with the way in one direction",
    revealed_by: "straight drives",
    resembles: "pose_mounting shows sideways motion without a drift of heading",
};

/// Gain of the steering.
pub const STEERING_GAIN: CauseSpec = CauseSpec {
    id: "steering_gain",
    name: "gain of the steering",
    robots: ROBOTS,
    meaning: "The wheel is steered by more or less than is recorded.",
    size: "factor on the steering angle",
    unit: "-",
    recognised: "Turnings err by one share at small angles and by more at large ones",
    revealed_by: "circles of several radii",
    resembles: "wheel_distance at small steering angles",
};

/// Slip in turns.
pub const SLIP_IN_TURNS: CauseSpec = CauseSpec {
    id: "slip_in_turns",
    name: "slip in turns",
    robots: ROBOTS,
    meaning: "The body falls behind its wheels while it turns, by a share that does not grow much \
        with the rate: rollers or tyres are dragged sideways with dry friction.",
    size: "share of the way that is lost in turns",
    unit: "-",
    recognised: "Ways in turns are shorter than straight ones for the same counts",
    revealed_by: "straight drives and circles in one recording",
    resembles: "radius_of_all_wheels where all drives are straight, or all turn",
};

/// Slip that grows with the turning rate.
pub const SLIP_WITH_TURNING: CauseSpec = CauseSpec {
    id: "slip_with_turning",
    name: "slip that grows with the turning rate",
    robots: ROBOTS,
    meaning: "Turning falls behind the wheels by a share in proportion to the turning rate.",
    size: "share per turning rate",
    unit: "s/rad",
    recognised: "Fast turns are smaller than slow ones for the same counts",
    revealed_by: "turns on the spot at several rates",
    resembles: "wheel_distance where all turns are equally fast",
};

/// Slip that grows with speed.
pub const SLIP_WITH_SPEED: CauseSpec = CauseSpec {
    id: "slip_with_speed",
    name: "slip that grows with speed",
    robots: ROBOTS,
    meaning: "The body falls behind its wheels by a share in proportion to the speed, in its way and perhaps in its turning; that of \
        each wheel may grow with its own speed.",
    size: "share of the way that is lost in straight driving, per speed",
    unit: "s/m",
    recognised: "Fast drives are shorter than slow ones for the same counts",
    revealed_by: "straight drives at several speeds",
    resembles: "radius_of_all_wheels where all drives are equally fast",
};

/// Slip in proportion to sideways acceleration.
pub const CORNERING_SLIP: CauseSpec = CauseSpec {
    id: "cornering_slip",
    name: "slip in proportion to sideways acceleration",
    robots: ROBOTS,
    meaning: "In curves the body slides outwards, or turns less than its wheels, in proportion to \
        the sideways acceleration.",
    size: "sideways slip velocity per acceleration",
    unit: "s",
    recognised: "Errors in proportion to speed times turning rate",
    revealed_by: "circles at several speeds both ways",
    resembles: "counts_clock_offset in steady curves",
};

/// Rollers lose sideways motion.
pub const ROLLER_SLIP: CauseSpec = CauseSpec {
    id: "roller_slip",
    name: "rollers lose sideways motion",
    robots: ROBOTS,
    meaning: "Sideways motion of an omni or mecanum robot is shorter than its wheels say: rollers \
        roll with friction and at other heights.",
    size: "share of sideways motion that is lost",
    unit: "-",
    recognised: "Sideways ways are wrong by one factor, forward ones are right",
    revealed_by: "straight drives sideways",
    resembles: "radius_of_one_wheel where sideways drives go one way only",
};

/// Direction of the pose's frame in the robot.
pub const POSE_MOUNTING: CauseSpec = CauseSpec {
    id: "pose_mounting",
    name: "direction of the pose's frame in the robot",
    robots: ROBOTS,
    meaning: "The pose's forward direction is not that of the robot: markers or a lidar are \
        mounted at an angle.",
    size: "angle of the pose's x axis",
    unit: "rad",
    recognised: "The body seems to move sideways in proportion to its forward way",
    revealed_by: "straight drives",
    resembles: "wheels that all point to one side",
};

/// Place of the pose's origin in the robot.
pub const POSE_ORIGIN: CauseSpec = CauseSpec {
    id: "pose_origin",
    name: "place of the pose's origin in the robot",
    robots: ROBOTS,
    meaning: "The pose is that of another point than the origin of the robot file.",
    size: "place of the origin, forward",
    unit: "m",
    recognised: "The body seems to move sideways, or forward, in proportion to its turning",
    revealed_by: "turns on the spot",
    resembles: "a centre of rotation that skidding wheels move",
};

/// Scale of a gyro that stands for the pose.
pub const GYRO_SCALE: CauseSpec = CauseSpec {
    id: "heading_gyro_scale",
    name: "scale of the gyro",
    robots: ROBOTS,
    meaning: "The gyro, which shows the turning where no pose was measured, shows it by a factor: its range, unit or mounting.",
    size: "factor on the yaw rate",
    unit: "-",
    recognised: "Turning by the wheels and by the gyro differ by one factor, whichever way and however fast the robot turns",
    revealed_by: "turns on the spot both ways, counted by marks on the ground",
    resembles: "wheel_distance (track) and radius_of_all_wheels: without a pose nothing tells the three apart but how well each \
                is known",
};

/// Bias of a gyro that stands for the pose.
pub const GYRO_BIAS: CauseSpec = CauseSpec {
    id: "heading_gyro_bias",
    name: "bias of the gyro",
    robots: ROBOTS,
    meaning: "The gyro, which shows the turning where no pose was measured, turns while the robot stands.",
    size: "yaw rate that it shows at rest",
    unit: "rad/s",
    recognised: "Turning by the gyro grows with time, also at rest and however fast the robot drives",
    revealed_by: "a second at rest: the bias is then measured and taken off",
    resembles: "radius_of_one_wheel where the speed never changes",
};

/// All of them, from the count to the pose.
pub const ALL: [&CauseSpec; 18] = [
    &LOST_COUNTS,
    &CLOCK_RATE,
    &COUNTS_CLOCK_OFFSET,
    &RADIUS_OF_ALL_WHEELS,
    &RADIUS_OF_ONE_WHEEL,
    &DIRECTION_OF_ONE_WHEEL,
    &WHEEL_DISTANCE,
    &STEERING_ZERO,
    &STEERING_GAIN,
    &SLIP_IN_TURNS,
    &SLIP_WITH_TURNING,
    &SLIP_WITH_SPEED,
    &CORNERING_SLIP,
    &ROLLER_SLIP,
    &POSE_MOUNTING,
    &POSE_ORIGIN,
    &GYRO_SCALE,
    &GYRO_BIAS,
];
