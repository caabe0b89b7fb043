//! The fewest constants of a robot with which the plant behaves as logs of a simulator show.
//!
//! Many constants trade in a drive: a heavier body shows as larger inertias and weaker motors do. A fit of all of them
//! finds one of many robots that behave alike, and which one is the prior's choice. Who built a simulation has seldom
//! got more than a constant or two wrong, so the fewest that behave as well as all together are the answer; and where
//! another constant alone does as well, both are told.

use faer::Mat;
use robot_model::tunable::COUNT as NUISANCES;

use crate::calibrate::{Driver, alternate, beginning};
use crate::fit::{Hypothesis, Point, Problem};
use crate::rms::rms;
use crate::settings::preparation::{Logs, SETTINGS};

const LOGS: Logs = SETTINGS.logs;

/// Constants in their sigmas, with those of them that were free.
#[derive(Debug, Clone)]
pub(crate) struct FewConstants {
    pub(crate) theta: [f64; NUISANCES],
    /// Places of those that were free: none where the robot file behaves as the logs do.
    pub(crate) free: Vec<usize>,
    /// Where a single one was free: the same by others, each alone, that the logs cannot tell from it.
    pub(crate) or: Vec<([f64; NUISANCES], usize)>,
}

/// The fewest constants that behave as well as `all`, a fit of all of them to the same logs; `None` where even a few do
/// not. `problem` is the fit of all.
pub(crate) fn few_constants(problem: &Problem<'_>, all: &[f64; NUISANCES]) -> Option<FewConstants> {
    let floor = errors(problem, all);
    let misfit = |theta: &[f64; NUISANCES]| relative(errors(problem, theta), floor);
    let file = [0.0; NUISANCES];
    if misfit(&file) <= LOGS.as_well {
        return Some(FewConstants { theta: file, free: Vec::new(), or: Vec::new() });
    }

    let mut free: Vec<usize> = Vec::new();
    while free.len() < LOGS.most_constants {
        let tried = (0..NUISANCES).filter(|k| !free.contains(k)).map(|k| {
            let theta = fit_of(problem, &[free.as_slice(), &[k]].concat());
            (misfit(&theta), theta, k)
        });
        let mut tried: Vec<(f64, [f64; NUISANCES], usize)> = tried.filter(|t| t.0.is_finite()).collect();
        tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        let &(best, theta, k) = tried.first()?;
        free.push(k);
        if best <= LOGS.as_well {
            let alike = tried.iter().skip(1).take_while(|t| free.len() == 1 && t.0 <= LOGS.not_told_apart * best);
            let or = alike.map(|&(_, theta, k)| (theta, k)).collect();
            return Some(FewConstants { theta, free, or });
        }
    }
    None
}

/// A fit of some constants, the others held at the robot file's.
fn fit_of(all: &Problem<'_>, free: &[usize]) -> [f64; NUISANCES] {
    let mut problem = beginning(Driver::Simulator, all.clone());
    problem.information = Mat::from_fn(NUISANCES, NUISANCES, |i, j| match (i == j, free.contains(&i)) {
        (true, true) => 1.0,
        (true, false) => LOGS.held,
        (false, _) => 0.0,
    });
    alternate(&mut problem, LOGS.steps).point.theta
}

/// Rms errors of free runs at these constants: wheel speed and yaw rate, rad/s.
pub(crate) fn errors(problem: &Problem<'_>, theta: &[f64; NUISANCES]) -> [f64; 2] {
    let at = Point { theta: *theta, ..problem.origin() };
    let none = Hypothesis::default();
    let responses: Vec<_> = (0..problem.cuts.len()).map(|run| (run, problem.run_response(run, &at, &none))).collect();
    rms(problem, &responses)
}

/// Mean square of errors over others.
fn relative(errors: [f64; 2], floor: [f64; 2]) -> f64 {
    let of = |q: usize| (errors[q] / floor[q].max(LOGS.invisible[q])).powi(2);
    0.5 * (of(0) + of(1))
}

#[cfg(test)]
mod tests {
    use crate::case::Case;
    use crate::diagnose::Calibrated;
    use crate::testing::logged;
    use inference::Options;
    use robot_model::Robot;
    use testing::robot;
    use verdict::SimulatorConstants;

    /// What logs of a simulator of this robot say against the usual robot's file.
    fn told(truth: &Robot<f64>) -> SimulatorConstants {
        let case = Case { simulations: vec![logged(truth, 40.0)], ..Case::new(robot()) };
        let calibrated = Calibrated::new(&case, &Options::default()).expect("logs");
        calibrated.simulator.expect("there are logs").told
    }

    #[test]
    fn a_constant_alone_is_told_with_its_value_and_the_files_own_robot_is_right() {
        assert_eq!(told(&robot()), SimulatorConstants::default());

        let mut heavier = robot();
        heavier.mass *= 1.09;
        let told = told(&heavier);
        let [mass] = &told.constants[..] else { panic!("{told:?}") };
        assert!(!told.only_together && mass.constant == "mass", "{told:?}");
        approx::assert_relative_eq!(mass.to, heavier.mass, max_relative = 0.01);
        assert!((mass.to - heavier.mass).abs() < mass.half_width, "{mass:?}");
    }

    #[test]
    fn several_constants_are_told_together_only() {
        let mut other = robot();
        other.mass *= 1.1;
        other.adhesion *= 0.8;
        other.yaw_inertia *= 1.5;
        let told = told(&other);
        assert!(told.only_together && told.constants.len() > 1 && told.or.is_empty(), "{told:?}");
    }
}
