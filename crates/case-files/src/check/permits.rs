//! Which diagnoses the signals of a recording permit.

use recordings::Signal;

use Signal::{
    AccelX, AccelY, CommandSpeedLeft, CommandSpeedRight, CurrentLeft, CurrentRight, GyroZ, PoseX, PoseY, PoseYaw,
    TorqueLeft, TorqueRight, WheelAngleLeft, WheelAngleRight, WheelSpeedLeft, WheelSpeedRight,
};

/// A diagnosis and what it takes.
struct Kind {
    name: &'static str,
    /// One of each list must be there.
    needed: &'static [&'static [Signal]],
    /// What makes it sharper.
    helpful: &'static [Signal],
}

const KINDS: [Kind; 3] = [
    Kind {
        name: "torque-driven robot",
        needed: &[
            &[TorqueLeft],
            &[TorqueRight],
            &[WheelAngleLeft, WheelSpeedLeft],
            &[WheelAngleRight, WheelSpeedRight],
        ],
        helpful: &[GyroZ, AccelX, AccelY, PoseX, PoseY, PoseYaw],
    },
    Kind {
        name: "speed-driven robot, by steady loads",
        needed: &[
            &[WheelSpeedLeft, CommandSpeedLeft],
            &[WheelSpeedRight, CommandSpeedRight],
            &[CurrentLeft, TorqueLeft],
            &[CurrentRight, TorqueRight],
        ],
        helpful: &[GyroZ],
    },
    Kind {
        name: "command-driven robot, by its response",
        needed: &[&[CommandSpeedLeft], &[CommandSpeedRight], &[WheelSpeedLeft], &[WheelSpeedRight], &[PoseYaw, GyroZ]],
        helpful: &[PoseX, PoseY, PoseYaw],
    },
];

/// A sentence for each diagnosis, with samples of these signals.
pub(super) fn permits(signals: &[Signal]) -> Vec<String> {
    let there = |signal: &Signal| signals.contains(signal);
    let names = |signals: &[Signal]| signals.iter().map(|s| s.name()).collect::<Vec<_>>();
    KINDS
        .iter()
        .map(|kind| {
            let missing: Vec<String> = kind
                .needed
                .iter()
                .filter(|choice| !choice.iter().any(there))
                .map(|choice| names(choice).join(" or "))
                .collect();
            if !missing.is_empty() {
                return format!("{}: not permitted, there is no {}", kind.name, missing.join(", no "));
            }
            let absent: Vec<Signal> = kind.helpful.iter().filter(|s| !there(s)).copied().collect();
            if absent.is_empty() {
                format!("{}: permitted", kind.name)
            } else {
                format!("{}: permitted; sharper with {}", kind.name, names(&absent).join(", "))
            }
        })
        .collect()
}
