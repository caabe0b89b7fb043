//! Drives that would tell the remaining answers apart, each as the robot of the answer would drive it.

use hierarchical_fit::menu::{Reach, menu};
use hierarchical_fit::next_drive::{self, Answers, Candidate, Readings};
use hierarchical_fit::{Cause, Evidence, Prior, Weighed};
use nalgebra::DMatrix;
use verdict::{Advice, Manoeuvre};

use crate::case::Case;
use crate::drive::{Drive, WheelData};
use crate::fit::{Fit, columns, equations, scatter};
use crate::kinematics::Kinematics;
use crate::motion::{Laws, implied};
use crate::settings::{NextDrive, SETTINGS};
use crate::wheel::WheeledRobot;
use crate::windows::{Data, laws};

const RULES: NextDrive = SETTINGS.next_drive;

/// What was found in the drives that were made.
pub(crate) struct Found<'a> {
    pub(crate) data: &'a Data<'a>,
    pub(crate) causes: &'a [Cause],
    pub(crate) prior: &'a Prior,
    pub(crate) fit: &'a Fit,
    pub(crate) chosen: &'a [Weighed],
}

/// Advises on the next drive of so many seconds.
pub(crate) fn advise(case: &Case, found: &Found<'_>, length: f64) -> Advice {
    let Found { data, causes, prior, fit, chosen } = *found;
    let (robot, constants) = (&case.robot, data.constants);
    let best = laws(robot, constants, &fit.theta);
    let did: Vec<[f64; 2]> = case.recordings.iter().flat_map(|drive| twists(robot, drive, &best)).collect();
    let goes_sideways = robot.wheels.iter().all(|wheel| wheel.roller != 0.0);
    let Some(reach) = Reach::of(&did, goes_sideways) else {
        return Advice::withheld(
            "the robot hardly moved in these drives, so that nobody knows how fast it can be driven",
        );
    };
    let scatter = scatter(data, fit.factors);
    let Some(evidence) = Evidence::new(&fit.theta, &fit.sessions, &scatter, &prior.mean) else {
        return Advice::withheld("the equations of these drives have no solution");
    };

    let heading_only = case.recordings.iter().all(|drive| drive.heading_only);
    let candidate = |manoeuvre: Manoeuvre| {
        let drive = driven(robot, &best, &manoeuvre, heading_only)?;
        let own = Data::of(robot, constants, vec![&drive]);
        let information = equations(&own, &fit.theta, fit.scale).first()?.marginal(&scatter)?.curvature;
        let by_constant = columns(&own, &fit.theta, 0);
        let windows = own.windows[0].len();
        // Headings stand in metres, `yaw / lever`; one that is measured alone is told in radians.
        let per = if heading_only { SETTINGS.windows.lever } else { 1.0 };
        let of_window = |i: usize, k: usize| per * by_constant[k][i / 3][i % 3];
        let columns = DMatrix::from_fn(3 * windows, by_constant.len(), of_window);
        let what = if heading_only {
            format!("the turning over {} s", SETTINGS.windows.length)
        } else {
            format!(
                "the place (or the heading, at a lever of {:.2} m) after {} s",
                1.0 / SETTINGS.windows.lever,
                SETTINGS.windows.length
            )
        };
        let unit = if heading_only { "rad" } else { "m" };
        let readings = vec![Readings { what, unit, columns, sigma: per * fit.scale }];
        Some(Candidate { manoeuvre, information, readings })
    };
    let candidates = menu(reach, length).into_iter().filter_map(candidate).collect();
    next_drive::advise(Answers { evidence: &evidence, known: &prior.covariance, causes, chosen }, candidates)
}

/// Speed and yaw rate at instants of a drive, as its wheels show them.
fn twists(robot: &WheeledRobot, drive: &Drive, laws: &Laws) -> Vec<[f64; 2]> {
    let kinematics = Kinematics::new(robot, &laws.geometry);
    let angle = |row: usize| drive.steering.as_ref().map_or(0.0, |angles| angles[row]);
    let of = |row: usize| if row == 0 { [0.0; 3] } else { kinematics.motion(&drive.turns[row], angle(row)) };
    let rates = drive.rates(of);
    rates.into_iter().map(|[ahead, left, turning]| [ahead.hypot(left).copysign(ahead), turning]).collect()
}

/// What would be recorded of a drive; `None` where the robot cannot drive so.
fn driven(robot: &WheeledRobot, laws: &Laws, m: &Manoeuvre, heading_only: bool) -> Option<Drive> {
    let rows = (m.length() / RULES.period).round() as usize;
    let time: Vec<f64> = (0..rows).map(|row| RULES.period * row as f64).collect();
    let kinematics = Kinematics::new(robot, &laws.geometry);
    let mut angles = vec![vec![0.0; rows]; robot.measured().len()];
    let mut steering = vec![0.0; rows];
    for row in 1..rows {
        let twist = m.wanted_twist(time[row] - 0.5 * RULES.period);
        steering[row] = if robot.is_steered() { kinematics.steering(twist, steering[row - 1]) } else { 0.0 };
        let turns = kinematics.turns(twist.map(|rate| RULES.period * rate), steering[row]);
        for (angle, turn) in angles.iter_mut().zip(turns) {
            angle[row] = angle[row - 1] + turn;
        }
    }

    let nowhere = vec![[0.0; 3]; rows];
    let steering = robot.is_steered().then_some(steering);
    let mut drive = Drive::of_columns(&m.name, robot, time, (WheelData::Angle, &angles), steering, nowhere).ok()?;
    drive.heading_only = heading_only;
    drive.session.clone_from(&m.name);
    drive.pose = implied(robot, &drive, laws);
    if heading_only {
        drive.pose.iter_mut().for_each(|pose| (pose[0], pose[1]) = (f64::NAN, f64::NAN));
    }
    Some(drive)
}
