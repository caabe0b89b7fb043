//! Causes of speed-driven robots that have no law in a plant: the loads of steady driving do not show them, the body does.

use crate::CauseSpec;

/// The robot is commanded to drive and does not.
pub const STANDING: CauseSpec = CauseSpec {
    id: "standing",
    name: "the robot stands although it is commanded to drive: dug in, its wheels spin or are held, or its motors are off",
    robots: "speed-driven",
    meaning: "The wheels are driven at speeds that would move the robot, and the body does not move with them: it is dug in, its \
        wheels spin, or it pushes against something. Or the wheels themselves do not turn as commanded: something holds them, or the motors \
        give no torque (an emergency stop, a fuse, the driver).",
    size: "yaw rate over what the wheels' speeds and the effective track of the references give; of wheels that are held, their \
        speed over the commanded one",
    unit: "-",
    recognised: "For three seconds or more the gyro shows less than about a third of the yaw rate that the wheels ask for; or \
        straight driving takes more than 0.4 of the robot's weight, which no ground does by resisting to roll; or measured wheel speeds are below a fifth of the commanded ones \
        while the torque is above that of driving, or below a tenth of it.",
    revealed_by: "turns both ways, a gyro recorded",
    resembles: "a gyro that is off or of another scale; a track that is much longer than thought",
};

/// The ground gives way.
pub const SOFT_GROUND: CauseSpec = CauseSpec {
    id: "soft_ground",
    name: "soft ground",
    robots: "speed-driven",
    meaning: "Wheels sink and push material before them, and in turns the ground shears instead of the tyres.",
    size: "rolling resistance beyond that of the references",
    unit: "-",
    recognised: "Straight driving takes more torque, turning takes no more beyond that, and the body turns less than the same \
        wheel speeds turned it on the references: the effective track is longer.",
    revealed_by: "straight drives both ways, then spins both ways on the same spot",
    resembles: "rolling resistance of hard ground where nothing turns; a slope where all drives go one way; less grip in spins",
};

/// All of them.
pub const ALL: [&CauseSpec; 2] = [&STANDING, &SOFT_GROUND];
