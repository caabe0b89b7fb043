//! Calibration on the references: what the model explains when nothing is missing, and how well.

use std::sync::Arc;

use faer::Mat;
use robot_model::Robot;
use robot_model::tunable::COUNT as NUISANCES;

use crate::between_visits::{Moves, constants_of_visits, likeliest_factor, visits_of_references};
use crate::case::Case;
use crate::channel::{Channel, Channels};
use crate::drives::Drives;
use crate::fit::{Columns, Fitted, Hypothesis, Point, Problem};
use crate::null_scores::NullScores;
use crate::regimes::Regimes;
use crate::run::Run;
use crate::run_numbers::{UNKNOWN, constant};
use crate::settings::fit::{Calibrating, SETTINGS};
use crate::settings::preparation::{self, Logs};
use crate::simulate::Response;
use crate::windows::Cut;
use inference::algebra::{inverse_spd, solve_spd};
use inference::{DiagnosisError, Options};

/// What the references teach.
#[derive(Clone)]
pub(crate) struct Calibration {
    pub(crate) theta: [f64; NUISANCES],
    /// Prior information about θ for the recordings.
    pub(crate) information: Mat<f64>,
    pub(crate) variance: Channels<f64>,
    pub(crate) spread: f64,
    pub(crate) regimes: Regimes,
    /// Null scores of the references themselves.
    pub(crate) null_scores: NullScores,
    /// What is known of moves between visits.
    pub(crate) moves: Moves,
}

const CALIBRATING: Calibrating = SETTINGS.calibration;
const LOGS: Logs = preparation::SETTINGS.logs;

/// Constants that fault-free robots push farther than their files say, with the factor of their sigmas.
const WIDER: [(usize, f64); 4] = [
    (constant("yaw_inertia"), CALIBRATING.wider),
    (constant("com_height"), CALIBRATING.wider),
    (constant("slip_at_peak"), CALIBRATING.wider),
    (constant("motor_inertia"), CALIBRATING.wider_motor_inertia),
];

/// What a robot file says of its constants, in their sigmas.
pub(crate) fn of_file() -> Mat<f64> {
    Mat::identity(NUISANCES, NUISANCES)
}

/// Calibrates the model on the references, from the robot file on.
pub(crate) fn calibrate(
    robot: &Robot<f64>,
    sigma: &[f64; NUISANCES],
    cuts: &[Cut],
    largest_torque: f64,
    options: &Options,
) -> Result<Calibration, DiagnosisError> {
    calibrate_on(Driver::Robot, robot, sigma, cuts, largest_torque, options)
}

/// What was driven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Driver {
    /// A robot, whose ground and drivetrain differ a little from drive to drive.
    Robot,
    /// A simulator: its robot is the same in every run, and may be far from the file.
    Simulator,
}

/// The same on drives of a robot or on logs of a simulator.
pub(crate) fn calibrate_on(
    driver: Driver,
    robot: &Robot<f64>,
    sigma: &[f64; NUISANCES],
    cuts: &[Cut],
    largest_torque: f64,
    options: &Options,
) -> Result<Calibration, DiagnosisError> {
    let mut problem = beginning(
        driver,
        Problem {
            robot,
            sigma: *sigma,
            cuts,
            has_references: true,
            constants_are_loose: false,
            variance: Channels::all(0.0),
            regime: Vec::new(),
            information: of_file(),
            centre: [0.0; NUISANCES],
            spread: 0.0,
            visits: if driver == Driver::Robot { visits_of_references(cuts) } else { Vec::new() },
            moves: 0.0,
            likelihood_power: options.likelihood_power,
            outlier_scale: options.outlier_scale,
            step: options.step,
            largest_torque,
            same_robot: options.same_robot,
            known: options.known,
            without: options.without,
            drives: Drives::default(),
        },
    );
    let none = Hypothesis::default();
    let at = alternate(&mut problem, if driver == Driver::Robot { CALIBRATING.steps } else { LOGS.steps });

    if driver == Driver::Robot {
        problem.spread = likeliest_spread(&mut problem, &at.point, &at.columns)?;
    }
    let mut at = problem.begin(&none, at.point, None);
    let mut moves = Moves { taught: !problem.visits.is_empty(), ..Moves::default() };
    if moves.taught {
        (moves.factor, at.point) = likeliest_factor(&mut problem, &at)?;
        at.cost = problem.cost(&at.point, &at.response);
    }
    at = problem.refine(&none, at, CALIBRATING.last_steps, None);
    problem.variance = channel_variance(&problem, &at.response);
    let regimes = if driver == Driver::Robot && cuts.len() < CALIBRATING.enough_references {
        // What a fit leaves of the drives that it was fitted to is too little, and few drives do not show by how much.
        let usual = Channels::from(CALIBRATING.usual_residual);
        problem.variance = Channels::from_fn(|c| problem.variance[c].max(usual[c].powi(2)));
        Regimes::default()
    } else {
        Regimes::of_references(&problem, &at.response)
    };
    problem.regime = regimes.of(cuts);

    // What the references know of the constants is the prior of the recordings.
    at.columns = Arc::new(problem.nuisance_columns(&at.point, &none, &at.response));
    let normal = problem
        .normal(&at.point, &at.response, &at.columns, &Columns(Vec::new()))
        .ok_or(DiagnosisError::Singular { stage: "calibration" })?;
    let information = &normal.matrix + &problem.information;
    moves.known = constants_of_visits(&problem, &at, &information)?;
    let null_scores = NullScores::new(&problem, &at.point, &information, &moves.known);
    Ok(Calibration {
        theta: at.point.theta,
        information,
        variance: problem.variance,
        spread: problem.spread,
        regimes,
        null_scores,
        moves,
    })
}

/// A problem before anything is known of its noise.
pub(crate) fn beginning(driver: Driver, problem: Problem<'_>) -> Problem<'_> {
    Problem {
        variance: Channels::from(CALIBRATING.first_sigma).map(|s| s * s),
        regime: problem.cuts.iter().map(|c| vec![1.0; c.segments.len()]).collect(),
        spread: if driver == Driver::Robot { CALIBRATING.usual_spread } else { 0.0 },
        ..problem
    }
}

/// Constants and variances in turn, each by the other, until the constants are settled or in so many steps.
pub(crate) fn alternate(problem: &mut Problem<'_>, steps: usize) -> Fitted {
    let none = Hypothesis::default();
    let mut at = problem.begin(&none, problem.origin(), None);
    for step in 0..steps {
        let before = at.point.theta;
        at.cost = problem.cost(&at.point, &at.response);
        at = problem.refine(&none, at, 1, (step > 0).then_some(0));
        problem.variance = channel_variance(problem, &at.response);
        problem.regime = Regimes::of_references(problem, &at.response).of(problem.cuts);
        let moved = at.point.theta.iter().zip(before).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if step + 1 >= CALIBRATING.steps && moved < CALIBRATING.settled {
            break;
        }
    }
    at
}

impl Calibration {
    /// Without references: the robot file's constants as sure as it states, and what simulations of such robots leave.
    pub(crate) fn by_file() -> Self {
        let mut covariance = Mat::<f64>::identity(NUISANCES, NUISANCES);
        for (k, factor) in WIDER {
            covariance[(k, k)] = factor.powi(2);
        }
        let [left, right] = const { [constant("coulomb_left"), constant("coulomb_right")] };
        covariance[(left, right)] = CALIBRATING.coulomb_correlation;
        covariance[(right, left)] = CALIBRATING.coulomb_correlation;
        Self {
            theta: [0.0; NUISANCES],
            information: inverse_spd(&covariance).unwrap_or_else(|| Mat::identity(NUISANCES, NUISANCES)),
            variance: Channels::from(CALIBRATING.usual_residual).map(|s| s * s),
            spread: CALIBRATING.usual_spread,
            regimes: Regimes::default(),
            null_scores: NullScores::default(),
            moves: Moves::default(),
        }
    }

    /// The same where a constant may have moved since the references, by so many of its sigmas usually.
    pub(crate) fn with_free(mut self, place: usize, usual: f64) -> Self {
        if let Some(mut covariance) = inverse_spd(&self.information) {
            covariance[(place, place)] += usual * usual;
            self.information = inverse_spd(&covariance).unwrap_or(self.information);
        }
        self
    }

    /// Raises the variances of the accelerations to what the best fit without any effect leaves of them, never below the usual,
    /// before any hypothesis is weighed.
    ///
    /// A body that rocks on soft tyres shakes its accelerometer, and a level that is assumed too low makes every segment an outlier,
    /// wheels and gyro with it.
    pub(crate) fn learn_shaking(&mut self, problem: &Problem<'_>, nothing: &Fitted) {
        let left = channel_variance(problem, &nothing.response);
        for c in [Channel::ForwardAcceleration, Channel::LateralAcceleration] {
            self.variance[c] = left[c].max(self.variance[c]);
        }
    }

    /// Raises the variance of each channel to what the best hypothesis leaves of it, never below the usual; whether any
    /// changed so much that the hypotheses must be weighed again.
    pub(crate) fn learn_noise(&mut self, problem: &Problem<'_>, best: &Fitted) -> bool {
        let left = channel_variance(problem, &best.response);
        let usual = Channels::from(CALIBRATING.usual_residual);
        let mut changed = false;
        for c in Channel::ALL {
            let learnt = left[c].max(usual[c].powi(2));
            changed |= (learnt / self.variance[c]).sqrt().ln().abs() > CALIBRATING.repeat_change;
            self.variance[c] = learnt;
        }
        changed
    }
}

fn channel_variance(problem: &Problem<'_>, response: &Response) -> Channels<f64> {
    let (mut sum, mut n) = (Channels::all(0.0), Channels::all(0.0));
    for (r, cut) in problem.cuts.iter().enumerate() {
        for (s, segment) in cut.segments.iter().enumerate() {
            for ((o, p), valid) in segment.observed.iter().zip(&response[r][s]).zip(&segment.valid) {
                for c in Channel::ALL.into_iter().filter(|&c| valid[c]) {
                    sum[c] += (o[c] - p[c]).powi(2);
                    n[c] += 1.0;
                }
            }
        }
    }
    let first = Channels::from(CALIBRATING.first_sigma);
    Channels::from_fn(|c| {
        let first = first[c];
        let least = (CALIBRATING.least_share * first).powi(2);
        if n[c] > 0.0 { (sum[c] / n[c]).max(least) } else { first.powi(2) }
    })
}

/// The common factor of the run-to-run deviations by marginal likelihood of the linearised model.
fn likeliest_spread(problem: &mut Problem<'_>, point: &Point, columns: &Columns) -> Result<f64, DiagnosisError> {
    let mut flat = point.clone();
    flat.run = vec![UNKNOWN; problem.cuts.len()];
    let response = problem.response(&flat, &Hypothesis::default());
    let usual = CALIBRATING.usual_spread;
    let mut best = (f64::MIN, usual);
    for f in CALIBRATING.spreads {
        problem.spread = f;
        let Some(mut normal) = problem.normal(&flat, &response, columns, &Columns(Vec::new())) else { continue };
        problem.with_prior(&flat, &mut normal);
        let Some((x, logdet)) = solve_spd(&normal.matrix, &normal.gradient) else { continue };
        let gain: f64 = (0..NUISANCES).map(|i| 0.5 * x[(i, 0)] * normal.gradient[(i, 0)]).sum();
        let prior = -0.5 * ((f / usual).ln() / CALIBRATING.spread_width).powi(2);
        let value = normal.gain + gain - 0.5 * (normal.log_determinant + logdet) + prior;
        if value > best.0 {
            best = (value, f);
        }
    }
    if best.0 == f64::MIN { Err(DiagnosisError::Singular { stage: "calibration" }) } else { Ok(best.1) }
}

/// What the recordings are compared with after calibration.
pub(crate) fn problem<'a>(
    robot: &'a Robot<f64>,
    case: &Case,
    cuts: &'a [Cut],
    calibration: &Calibration,
    largest_torque: f64,
    options: &Options,
) -> Problem<'a> {
    let has_references = !case.references.iter().all(Run::is_noise_free);
    Problem {
        robot,
        sigma: case.sigma,
        cuts,
        has_references,
        constants_are_loose: !has_references || calibration.moves.are_loose,
        variance: calibration.variance,
        regime: calibration.regimes.of(cuts),
        information: calibration.information.clone(),
        centre: calibration.theta,
        spread: calibration.spread,
        visits: calibration.moves.visits.clone(),
        moves: calibration.moves.of_recordings,
        likelihood_power: options.likelihood_power,
        outlier_scale: options.outlier_scale,
        step: options.step,
        largest_torque,
        same_robot: options.same_robot,
        known: options.known,
        without: options.without,
        drives: Drives::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use testing::robot;

    #[test]
    fn a_shaken_accelerometer_is_noise_before_anything_is_weighed_and_wheels_are_not() {
        let robot = robot();
        let mut run = driven(&robot, &[], 12.0);
        // The body rocks: what no rigid robot shows.
        for (row, reading) in run.accel[1].iter_mut().enumerate() {
            *reading = reading.map(|a| a + 2.0 * (0.9 * row as f64).sin());
        }
        run.angle[0].iter_mut().enumerate().for_each(|(row, angle)| *angle = angle.map(|a| a + 0.01 * row as f64));
        let cuts = [cut(&run, &cutting())];
        let p = problem(&robot, &cuts);
        let mut calibration = Calibration::by_file();
        let before = calibration.variance;
        calibration.learn_shaking(&p, &p.begin(&Hypothesis::default(), p.origin(), None));

        assert!(calibration.variance[Channel::LateralAcceleration] > 4.0 * before[Channel::LateralAcceleration]);
        let others = Channel::ALL.into_iter().filter(|c| *c != Channel::LateralAcceleration);
        for channel in others {
            assert_eq!(calibration.variance[channel], before[channel], "{channel:?}");
        }
    }
}
