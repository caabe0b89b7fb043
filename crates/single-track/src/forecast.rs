//! Motion from throttle and steering alone on drives that no fit has seen.
//!
//! At the start of a forecast nothing but its past is known: velocities come from a parabola through the poses before it, the
//! servo from the commands before it, and constants from the fit on other drives, moved by what the past of this drive says of
//! its own deviation (battery, floor, trims). What it said fades.

use hierarchical_fit::{Ahead, Noise, Session, equations};
use nalgebra::DVector;

use crate::constants::Constant;
use crate::model::{Inputs, Laws, STEP, State};
use crate::rows::Shown;
use crate::settings::{Forecast, SETTINGS};
use inference::robust::median;
use odometry::rates::end;

const RULES: Forecast = SETTINGS.forecast;

/// Lengths of forecasts, s.
pub const LENGTHS: [f64; 3] = RULES.lengths;

/// Errors of forecasts of one length: position, m, and heading, rad, one of each beginning.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Errors {
    /// Distance between forecast and measured position, m.
    pub position: Vec<f64>,
    /// Difference of headings, rad, without its sign.
    pub heading: Vec<f64>,
}

impl Errors {
    /// Medians of position, m, and heading, rad; `None` where no drive is long enough.
    pub fn medians(&self) -> Option<[f64; 2]> {
        Some([median(self.position.iter().copied())?, median(self.heading.iter().copied())?])
    }

    /// Adds those of other drives.
    pub fn extend(&mut self, other: Self) {
        self.position.extend(other.position);
        self.heading.extend(other.heading);
    }
}

/// Errors over each of [`LENGTHS`].
pub type ByLength = [Errors; 3];

/// How much the past of a drive is listened to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Habit {
    /// Time after which what the drive said of itself has faded, s.
    pub(crate) fading: f64,
    /// Factor on the scatter of drives.
    pub(crate) freedom: f64,
}

/// Which forecasts are made.
const AHEAD: Ahead = Ahead {
    step: STEP,
    lengths: LENGTHS,
    every: RULES.every,
    past: RULES.past[RULES.past.len() - 1],
    way: RULES.way,
    // A car does not turn on the spot.
    turn: f64::INFINITY,
};

/// Steps at which forecasts begin.
pub(crate) fn beginnings(shown: &Shown<'_>) -> Vec<usize> {
    AHEAD.beginnings(&shown.drive.pose)
}

/// Errors by length from those of each beginning.
pub(crate) fn collected(each: impl IntoIterator<Item = [[f64; 2]; 3]>) -> ByLength {
    let mut out = ByLength::default();
    for errors in each {
        for (sum, [position, heading]) in out.iter_mut().zip(errors) {
            sum.position.push(position);
            sum.heading.push(heading);
        }
    }
    out
}

/// Forecasts of a law from each beginning, from velocities of so much past.
pub(crate) fn of_laws(shown: &Shown<'_>, laws: &Laws, past: f64) -> Vec<[[f64; 2]; 3]> {
    let inputs = laws.inputs(shown.drive);
    beginnings(shown).into_iter().filter_map(|from| one(shown, laws, &inputs, from, past)).collect()
}

fn one(shown: &Shown<'_>, laws: &Laws, inputs: &Inputs, from: usize, past: f64) -> Option<[[f64; 2]; 3]> {
    let pose = &shown.drive.pose;
    let (at, rates) = end(pose, from, past, STEP)?;
    let steps = AHEAD.longest();
    let states: Vec<State> = laws.run(laws.state(at, rates), inputs, from, steps);
    Some(AHEAD.judge(pose, from, |k| laws.tracked(&states[k - 1])))
}

/// A twist that does not change.
pub(crate) fn of_twist(shown: &Shown<'_>, past: f64) -> Vec<[[f64; 2]; 3]> {
    let pose = &shown.drive.pose;
    let of = |from: usize| Some(AHEAD.judge_twist(pose, from, end(pose, from, past, STEP)?));
    beginnings(shown).into_iter().filter_map(of).collect()
}

/// Constants that follow what a drive says of itself, as they are at each beginning of a forecast: an extended Kalman filter in
/// information form, about deviations `δ ~ N(0, S²)` of the drive from the fit. Every row is linearised once, where the drive was
/// thought to be when the row became known, and fades by `exp(−Δt/τ)` (Ljung, System Identification, 11.2: forgetting).
pub(crate) fn following(
    constants: &[Constant],
    scatter: &DVector<f64>,
    shown: &Shown<'_>,
    (theta, noise): (&[f64], Noise),
    habit: Habit,
) -> Vec<(usize, Vec<f64>)> {
    let scatter = scatter * habit.freedom;
    let about = DVector::from_column_slice(theta);
    let n = theta.len();
    let mut so_far = Session::of_nothing(n);
    let mut own = theta.to_vec();
    let mut last = f64::NEG_INFINITY;
    let of = |from: usize| {
        let now = STEP * from as f64;
        let part = shown.part(last, now, RULES.warm);
        let (errors, columns) = (part.errors_of(&Laws::at(constants, &own)), part.columns_of(constants, &own));
        let new = equations(&part, (&errors, &columns), noise);

        // Said about where the drive was thought to be; kept about the fit.
        let moved = DVector::from_column_slice(&own) - &about;
        let kept = ((last - now) / habit.fading).exp();
        so_far.slope = &so_far.slope * kept + new.slope - &new.curvature * moved;
        so_far.curvature = &so_far.curvature * kept + new.curvature;
        last = now;

        let deviation = so_far.deviation(&scatter)?;
        for ((value, c), (t, d)) in own.iter_mut().zip(constants).zip(theta.iter().zip(deviation.iter())) {
            let [least, most] = c.bounds();
            *value = (t + d).clamp(least, most);
        }
        Some((from, own.clone()))
    };
    beginnings(shown).into_iter().filter_map(of).collect()
}

/// Forecasts of constants that follow the drive's own past, from velocities of so much past.
pub(crate) fn of_followed(
    constants: &[Constant],
    shown: &Shown<'_>,
    followed: &[(usize, Vec<f64>)],
    past: f64,
) -> Vec<[[f64; 2]; 3]> {
    let warm = (RULES.warm / STEP) as usize;
    let ahead = AHEAD.longest();
    let of = |(from, theta): &(usize, Vec<f64>)| {
        let laws = Laws::at(constants, theta);
        let inputs = laws.inputs_between(shown.drive, from.saturating_sub(warm), from + ahead + 1);
        one(shown, &laws, &inputs, *from, past)
    };
    followed.iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOISE: Noise = Noise { sigma: [0.01; 3], power: [1.0; 3] };
    use crate::car::Car;
    use crate::constant_table::constants;
    use crate::constants::Quantity;
    use crate::drive::{Columns, Drive};

    /// A drive of laws in circles and eights at changing speeds, 40 s.
    fn drive(laws: &Laws) -> Drive {
        let steps = (40.0 / STEP) as usize;
        let time: Vec<f64> = (0..=steps).map(|k| STEP * k as f64).collect();
        let steering: Vec<f64> = time.iter().map(|t| 0.5 * (0.9 * t).sin() + 0.3 * (0.23 * t).sin()).collect();
        let throttle: Vec<f64> = time.iter().map(|t| 0.4 + 0.1 * (0.4 * t).sin()).collect();
        let table = Columns {
            pose: vec![[0.0; 3]; time.len()],
            gyro: vec![0.0; time.len()],
            time,
            throttle,
            steering,
            ..Columns::default()
        };
        let inputs = laws.inputs(&Drive::new("drawn", &table).expect("commands"));
        let start = State { place: [0.0; 2], yaw: 0.0, speed: 1.0, side: 0.0, rate: 0.0 };
        let states = laws.run(start, &inputs, 0, steps);
        let pose = std::iter::once(&start).chain(&states).map(|s| laws.tracked(s)).collect();
        Drive::new("drawn", &Columns { pose, gyro: Vec::new(), ..table }).expect("a drive")
    }

    #[test]
    fn a_drive_far_from_the_fit_is_followed_although_its_motion_is_no_line_in_its_constants() {
        let all = constants(&Car::new("drawn", 0.25));
        let mut truth = vec![0.0; all.len()];
        let place = |q: Quantity| all.iter().position(|c| c.quantity == q).expect("a constant");
        truth[place(Quantity::FullSteering)] = -0.5;
        truth[place(Quantity::FrontCompliance)] = 0.03;
        truth[place(Quantity::RearCompliance)] = 0.015;
        let drive = drive(&Laws::at(&all, &truth));
        let shown = Shown::new(&drive, 0.0);

        let scatter = DVector::from_iterator(all.len(), all.iter().map(|c| c.scatter));
        let theta = vec![0.0; all.len()];
        let habit = Habit { fading: 5.0, freedom: 10.0 };
        let followed = following(&all, &scatter, &shown, (&theta, NOISE), habit);
        let last = |errors: Vec<[[f64; 2]; 3]>| median(errors.iter().rev().take(20).map(|e| e[2][0])).expect("errors");
        let own = last(of_followed(&all, &shown, &followed, 0.2));
        let fitted = last(of_laws(&shown, &Laws::at(&all, &theta), 0.2));
        assert!(fitted > 1.0 && own < 0.03 * fitted, "{own} m beside {fitted} m");
    }

    #[test]
    fn what_follows_a_drive_knows_its_past_alone() {
        let all = constants(&Car::new("drawn", 0.25));
        let laws = |full: f64| {
            let mut theta = vec![0.0; all.len()];
            theta[all.iter().position(|c| c.quantity == Quantity::FullSteering).expect("a constant")] = full;
            Laws::at(&all, &theta)
        };
        let whole = drive(&laws(-0.2));
        let mut cut = whole.clone();
        let half = whole.pose.len() / 2;
        for pose in &mut cut.pose[half..] {
            pose[1] *= 1.5;
        }
        let scatter = DVector::from_iterator(all.len(), all.iter().map(|c| c.scatter));
        let of = |drive: &Drive| {
            let shown = Shown::new(drive, 0.0);
            following(&all, &scatter, &shown, (&vec![0.0; all.len()], NOISE), Habit { fading: 5.0, freedom: 3.0 })
        };
        let (one, other) = (of(&whole), of(&cut));
        let before = |f: &[(usize, Vec<f64>)]| -> Vec<_> { f.iter().filter(|(k, _)| *k < half).cloned().collect() };
        assert!(!before(&one).is_empty() && before(&one) == before(&other));
        assert!(one.last() != other.last());
    }
}
