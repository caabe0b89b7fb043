//! Whether the wheels of a side are coupled or have a motor each, where the robot file does not say it.
//!
//! In a turn the wheels of a side are pushed alike only where they are coupled. A robot without couplings leaves in a model that has
//! them what a wheel without load, a slipping belt or another centre of mass would leave: the chassis is settled before any effect is
//! weighed.

use robot_model::tunable::COUNT as NUISANCES;
use robot_model::{Chassis, Robot};

use crate::calibrate::{Calibration, of_file, problem};
use crate::case::Case;
use crate::decision::Decision;
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::nothing::retune;
use crate::prices::penalty;
use crate::settings::search::{FourMotors, SETTINGS};
use crate::windows::Cut;
use inference::Options;

const RULES: FourMotors = SETTINGS.four_motors;

/// That each wheel has a motor of its own, as drives show and the robot file does not say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Found {
    /// The drives that show it, for people.
    pub(crate) by: &'static str,
    /// Log-likelihood that such a robot gains over one with coupled wheels, nats.
    pub(crate) gain: f64,
}

impl Found {
    /// What drives show that gain so much, if that is enough to believe it.
    pub(crate) fn by(by: &'static str, gain: f64) -> Option<Self> {
        (gain > RULES.least_gain).then_some(Self { by, gain })
    }

    /// What was found, for people, and what to do about it.
    pub(crate) fn sentence(self) -> String {
        let Self { by, gain } = self;
        format!(
            "the robot file does not say whether the wheels of a side are coupled or have a motor each: {by} are followed better with a \
             motor at each wheel (by {gain:.0} nats of log-likelihood), and this is assumed; write chassis = \"four-motors\" into the robot \
             file, or chassis = \"skid-steer\" if a belt, chain or gear couples them"
        )
    }
}

/// The same robot with a motor at each of its four wheels.
pub(crate) fn with_four_motors(robot: &Robot<f64>) -> Robot<f64> {
    Robot { chassis: Chassis::FourMotors, ..*robot }
}

/// Whether it is to be asked at all: of a robot on four wheels whose file says no more.
pub(crate) fn is_open(case: &Case, robot: &Robot<f64>) -> bool {
    case.may_have_four_motors && robot.chassis == Chassis::SkidSteer
}

/// Whether drives that gain so much say too little of it.
pub(crate) fn is_unsure(gain: f64) -> bool {
    gain.abs() <= RULES.least_gain
}

/// What fault-free drives gain by a motor at each wheel, nats. `at`: where their fit with coupled wheels is.
pub(crate) fn gain_of_drives(problem: &Problem<'_>, at: &Point) -> f64 {
    let robot = with_four_motors(problem.robot);
    let four = Problem { robot: &robot, ..problem.clone() };
    refit(problem, &Hypothesis::default(), at).cost - refit(&four, &Hypothesis::default(), at).cost
}

/// What references gain that calibrated the robot with coupled wheels, nats.
pub(crate) fn gain_of_references(
    case: &Case,
    robot: &Robot<f64>,
    (references, calibration): (&[Cut], &Calibration),
    largest_torque: f64,
    options: &Options,
) -> f64 {
    let by_file = Calibration { information: of_file(), theta: [0.0; NUISANCES], ..calibration.clone() };
    let problem = problem(robot, case, references, &by_file, largest_torque, options);
    let at = Point { theta: calibration.theta, ..problem.origin() };
    gain_of_drives(&problem, &at)
}

/// The same of recordings, in which something may be missing: of both robots the best of the best hypothesis, each of its effects and
/// none of them, each less what it has to gain to be named.
pub(crate) fn gain_of_recordings(
    coupled: &Problem<'_>,
    four: &Problem<'_>,
    retuned: &Fitted,
    decision: &Decision,
) -> f64 {
    let worth = |p: &Problem<'_>, h: &Hypothesis, fitted: &Fitted| {
        retuned.cost - fitted.cost - penalty(h, &fitted.point.effects, &p.sizes())
    };

    let best = decision.scored.first().map(|s| &s.trial);
    // References know the constants of either robot; without them the fit begins where that of the other one ended.
    let start = |point: &Point| if four.has_references { four.origin() } else { point.clone() };
    let mut tried = vec![(Hypothesis::default(), start(&retuned.point))];
    if let Some(best) = best {
        let of_best = |effects| Point { effects, ..start(&best.fitted.point) };
        let alone = best.hypothesis.each_alone(&best.fitted.point.effects);
        tried.extend(alone.into_iter().map(|(h, effects)| (h, of_best(effects))));
        tried.push((best.hypothesis.clone(), of_best(best.fitted.point.effects.clone())));
    }
    tried.retain(|(h, _)| h.variants().all(|variant| variant.spec().is_of(Chassis::FourMotors)));

    let of_coupled = best.map_or(0.0, |best| worth(coupled, &best.hypothesis, &best.fitted)).max(0.0);
    let of_four = tried.iter().map(|(h, at)| worth(four, h, &refit(four, h, at))).fold(f64::MIN, f64::max);
    of_four - of_coupled
}

fn refit(problem: &Problem<'_>, h: &Hypothesis, at: &Point) -> Fitted {
    retune(problem, h, problem.begin(h, at.clone(), None))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibrate::calibrate;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use testing::robot;

    fn drives(of: &Robot<f64>) -> [Cut; 3] {
        [8.0, 10.0, 12.0].map(|seconds| cut(&driven(of, &[], seconds), &cutting()))
    }

    fn case(may_have_four_motors: bool) -> Case {
        Case { may_have_four_motors, pose_sigma: 1e-4, ..Case::new(robot()) }
    }

    #[test]
    fn references_tell_motors_at_each_wheel_from_coupled_wheels() {
        let found = |of: &Robot<f64>| {
            let (references, case, options) = (drives(of), case(true), Options::default());
            let calibration = calibrate(&robot(), &case.sigma, &references, 5.0, &options).expect("determined");
            Found::by("the references", gain_of_references(&case, &robot(), (&references, &calibration), 5.0, &options))
        };
        let told = found(&with_four_motors(&robot())).expect("shown").sentence();
        assert!(
            told.contains("the references are followed better") && told.contains("chassis = \"four-motors\""),
            "{told}"
        );
        assert_eq!(found(&robot()), None, "its wheels are coupled");
    }

    #[test]
    fn recordings_alone_tell_them_apart_too() {
        let robot = robot();
        let gain = |of: &Robot<f64>| {
            let cuts = drives(of);
            // Sensors as good as those of the plant's own drives.
            let plain = problem(&robot, &cuts);
            let variance = plain.variance.map(|v| 1e-4 * v);
            let p = Problem { has_references: false, constants_are_loose: true, variance, ..plain };
            let none = Hypothesis::default();
            let retuned = retune(&p, &none, p.begin(&none, p.origin(), None));
            let motors = with_four_motors(&robot);
            let four = Problem { robot: &motors, ..p.clone() };
            gain_of_recordings(&p, &four, &retuned, &Decision { none: 1.0, ..Decision::default() })
        };
        let [four, coupled] = [with_four_motors(&robot), robot].map(|of| gain(&of));
        assert!(four > RULES.least_gain && coupled < 0.0, "{four} {coupled}");
    }

    #[test]
    fn a_robot_on_casters_is_not_asked() {
        let on_casters = Robot { chassis: Chassis::Differential, ..robot() };
        assert!(
            is_open(&case(true), &robot()) && !is_open(&case(true), &on_casters) && !is_open(&case(false), &robot())
        );
    }
}
