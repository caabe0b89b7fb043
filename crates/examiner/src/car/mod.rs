//! Cars: throttle and steering commands, a pose, a gyro and an encoder, and something between them that the robot file does
//! not have.
//!
//! The plant is a two-axle car with brush tyres, a servo of second order and a motor with back-EMF, in small steps.

mod draw;
mod plant;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

/// Something hidden in a car.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CarHidden {
    /// The wheels steer by more or less at full command.
    SteeringGain,
    /// The wheels do not point ahead at no command.
    SteeringCentre,
    /// The wheels turn by less per command far out.
    SteeringBend,
    /// Steering begins late.
    SteeringDelay,
    /// Steering settles slowly.
    SteeringLag,
    /// Steering moves at a limited rate.
    SteeringRate,
    /// The linkage has play.
    SteeringPlay,
    /// The axles are farther apart, or nearer.
    Wheelbase,
    /// Tyres give way.
    TyreSlip,
    /// Tyres hold little, and the car is driven fast.
    GripLimit,
    /// The motor pushes more or less.
    DriveGain,
    /// The motor does not turn below a higher throttle.
    DeadZone,
    /// Another point is tracked.
    TrackedPoint,
    /// The tracked axes are turned.
    TrackedAxes,
    /// All channels of the car are late.
    ClockDelay,
    /// The car's clock is slow or fast, and started apart from that of the pose.
    ClockRate,
    /// The gyro shows another scale.
    GyroScale,
    /// The gyro shows turning at rest.
    GyroBias,
    /// The gyro alone is late.
    GyroDelay,
    /// The encoder shows another scale.
    EncoderScale,
    /// The encoder alone is late.
    EncoderDelay,
    /// The driven wheels slip in bends.
    WheelSlip,
    /// The ground is a slope.
    Slope,
}

impl CarHidden {
    /// All.
    pub const ALL: [Self; 23] = [
        Self::SteeringGain,
        Self::SteeringCentre,
        Self::SteeringBend,
        Self::SteeringDelay,
        Self::SteeringLag,
        Self::SteeringRate,
        Self::SteeringPlay,
        Self::Wheelbase,
        Self::TyreSlip,
        Self::GripLimit,
        Self::DriveGain,
        Self::DeadZone,
        Self::TrackedPoint,
        Self::TrackedAxes,
        Self::ClockDelay,
        Self::ClockRate,
        Self::GyroScale,
        Self::GyroBias,
        Self::GyroDelay,
        Self::EncoderScale,
        Self::EncoderDelay,
        Self::WheelSlip,
        Self::Slope,
    ];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::SteeringGain => "gain of the steering",
            Self::SteeringCentre => "centre of the steering",
            Self::SteeringBend => "bend of the steering map",
            Self::SteeringDelay => "delay of the steering",
            Self::SteeringLag => "lag of the steering",
            Self::SteeringRate => "largest rate of the steering",
            Self::SteeringPlay => "play of the steering",
            Self::Wheelbase => "wheelbase",
            Self::TyreSlip => "slip of the tyres",
            Self::GripLimit => "limit of the grip",
            Self::DriveGain => "gain of the drive",
            Self::DeadZone => "dead zone of the throttle",
            Self::TrackedPoint => "tracked point",
            Self::TrackedAxes => "tracked axes",
            Self::ClockDelay => "delay of the car's clock",
            Self::ClockRate => "rate of the car's clock",
            Self::GyroScale => "scale of the gyro",
            Self::GyroBias => "bias of the gyro",
            Self::GyroDelay => "delay of the gyro",
            Self::EncoderScale => "scale of the encoder",
            Self::EncoderDelay => "delay of the encoder",
            Self::WheelSlip => "slip of the driven wheels in bends",
            Self::Slope => "slope of the ground",
        }
    }
}

/// What was hidden in a case, for the scorer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CarTruth {
    /// Name of the case.
    pub case: String,
    /// What is hidden.
    pub hidden: Vec<CarHidden>,
    /// Whether the tyres give way, so that slip and limit are both there.
    pub has_tyres: bool,
    /// Numbers of what is hidden, SI, by what they are: `gain`, `centre`, `delay`, `lag`, `rate` (s/rad), `play`, `wheelbase`,
    /// `front_compliance`, `rear_compliance`, `drive`, `dead_zone`, `point_x`, `point_y`, `axes`, `clock`, `clock_rate`, `gyro_scale`,
    /// `gyro_bias`, `gyro_delay`, `encoder_scale`, `encoder_delay`, `slope_x`, `slope_y`.
    pub numbers: BTreeMap<String, f64>,
}

/// A drawn case: what the diagnoser gets, and what was hidden.
#[derive(Debug, Clone)]
pub struct CarCase {
    /// Files of the case by their path in it.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// What was hidden.
    pub truth: CarTruth,
}

/// Which case is to be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CarPlan {
    /// Name of the case.
    pub name: String,
    /// Seed of the set.
    pub seed: u64,
    /// Number of the case in it.
    pub index: u64,
    /// What is hidden.
    pub hidden: Vec<CarHidden>,
    /// Drives before anything is hidden.
    pub references: usize,
    /// What the robot file lacks in all drives, references included.
    pub in_all: Option<CarHidden>,
}

impl CarPlan {
    /// A set of so many cases: in a quarter nothing is hidden, in the others one thing, each as often; beside every third of
    /// them the tyres slip as well. Where there are references, every other car has something else in all drives instead.
    pub fn set(seed: u64, count: usize, references: usize) -> Vec<Self> {
        let mut turn = 0;
        let mut plan = |i: usize| {
            let mut hidden = Vec::new();
            if !i.is_multiple_of(4) {
                let one = CarHidden::ALL[turn % CarHidden::ALL.len()];
                turn += 1;
                hidden.push(one);
                let is_tyre = matches!(one, CarHidden::TyreSlip | CarHidden::GripLimit);
                if turn.is_multiple_of(3) && !is_tyre && references == 0 {
                    hidden.push(CarHidden::TyreSlip);
                }
            }
            let is_flawed = references > 0 && (i / 4 + i).is_multiple_of(2);
            let in_all = Self::FLAWS[i / 2 % Self::FLAWS.len()];
            let in_all = (is_flawed && !hidden.contains(&in_all)).then_some(in_all);
            Self { name: format!("a{:03}", i + 1), seed, index: i as u64, hidden, references, in_all }
        };
        (0..count).map(&mut plan).collect()
    }

    /// What robot files of cars lack most often.
    const FLAWS: [CarHidden; 4] =
        [CarHidden::TyreSlip, CarHidden::SteeringBend, CarHidden::SteeringLag, CarHidden::DriveGain];

    /// Draws the case.
    pub fn draw(&self) -> CarCase {
        draw::case(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_hides_nothing_in_a_quarter_and_everything_in_turn() {
        let all = CarPlan::set(1, 184, 0);
        assert_eq!(all.iter().filter(|p| p.hidden.is_empty()).count(), 46);
        for hidden in CarHidden::ALL {
            assert!(all.iter().filter(|p| p.hidden.contains(&hidden)).count() >= 6, "{hidden:?}");
        }
        let pairs = all.iter().filter(|p| p.hidden.len() == 2).count();
        assert!((30..45).contains(&pairs), "{pairs}");
    }

    #[test]
    fn references_have_what_all_drives_lack_and_nothing_that_is_hidden() {
        let file = |plan: &CarPlan, path: &str| {
            let files = plan.draw().files;
            files.into_iter().find(|(p, _)| p == std::path::Path::new(path)).map(|(_, bytes)| bytes)
        };
        let plan = CarPlan::set(3, 12, 1).into_iter().find(|p| p.in_all.is_some() && !p.hidden.is_empty());
        let plan = plan.expect("a flawed car with something hidden");
        let sound = CarPlan { hidden: Vec::new(), ..plan.clone() };
        let ideal = CarPlan { in_all: None, ..sound.clone() };
        let reference = file(&plan, "references/ref_1.csv").expect("a reference");
        assert_eq!(Some(&reference), file(&sound, "references/ref_1.csv").as_ref());
        assert_ne!(Some(&reference), file(&ideal, "references/ref_1.csv").as_ref());
        assert_ne!(file(&plan, "recordings/run_1.csv"), file(&sound, "recordings/run_1.csv"));
        assert!(file(&plan, "references/ref_2.csv").is_none() && plan.draw().truth.hidden == plan.hidden);
    }

    #[test]
    fn a_case_is_the_same_twice_and_its_cars_drive() {
        for plan in CarPlan::set(3, 28, 0) {
            let case = plan.draw();
            assert_eq!(case.files, plan.draw().files);
            assert_eq!(case.truth.hidden, plan.hidden);
            let (path, bytes) = &case.files[1];
            let text = String::from_utf8_lossy(bytes);
            let cell = |line: &str, k: usize| line.split(',').nth(k).and_then(|c| c.parse::<f64>().ok());
            let places: Vec<[f64; 2]> = text.lines().skip(1).filter_map(|l| Some([cell(l, 3)?, cell(l, 4)?])).collect();
            let way: f64 = places.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
            assert!(way > 15.0 && way < 400.0, "{}: {way} m in {} rows", path.display(), places.len());
        }
    }
}
