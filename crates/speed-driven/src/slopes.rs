//! Slopes under the robot, by its turning rates and loads.

use crate::attitude::Attitude;
use crate::pieces::{GRADE, pieces};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, changes::Slopes as Settings};
use inference::robust::{NINETY, mean, median};
use verdict::LoadChange;

const SLOPES: Settings = CHANGES.slopes;

/// Slopes, and those that only a turn shows.
#[derive(Debug, Default)]
pub(super) struct Slopes {
    pub(super) found: Vec<LoadChange>,
    pub(super) tentative: Vec<LoadChange>,
}

impl Slopes {
    /// All stretches on which the ground does not count as level, s, ramps included.
    pub(super) fn stretches(&self) -> Vec<[f64; 2]> {
        let far = SLOPES.ramp[1];
        self.found.iter().map(|c| [c.interval[0] - far, c.interval[1] + far]).collect()
    }

    /// The same slopes with the angles that this attitude gives them.
    pub(super) fn measured_again(mut self, run: &SpeedRun, attitude: &Attitude) -> Self {
        for c in &mut self.found {
            let [from, until] = c.interval;
            let rows: Vec<usize> =
                (0..run.time.len()).filter(|&i| from <= run.time[i] && run.time[i] <= until).collect();
            if let Some([slope, sigma]) = angle(run, attitude, &rows) {
                (c.slope, c.slope_half) = (slope.to_degrees(), (NINETY * sigma).to_degrees());
            }
        }
        self
    }
}

/// What the turning rates say of a slope.
enum Ramp {
    /// The nose rose or fell where it begins or ends.
    Seen,
    /// The robot turned there: a slope that it turned into, or a roll that drifted and that the turn made a pitch.
    Turned,
    /// The robot went straight, and its nose neither rose nor fell.
    NotSeen,
}

/// Whether the nose rose where a slope begins, or fell where it ends, by a fair share of it.
fn ramp(run: &SpeedRun, attitude: &Attitude, [from, until]: [f64; 2], pitch: f64) -> Ramp {
    let around = |z: &[f64], a: f64, b: f64| {
        mean((0..run.time.len()).filter(|&i| a <= run.time[i] && run.time[i] <= b).map(|i| z[i]))
    };
    let [near, far] = SLOPES.ramp;
    // Of the stretch over the level ground beside it.
    let steps = |z: &[f64]| {
        let before = around(z, from + near, from + far).zip(around(z, from - far, from - near));
        let after = around(z, until - far, until - near).zip(around(z, until + near, until + far));
        [before, after].map(|ends| ends.map(|(on, beside)| on - beside))
    };
    let is_share = |step: Option<f64>| step.is_some_and(|s| s * pitch.signum() > SLOPES.ramp_share * pitch.abs());
    if steps(&attitude.nose).into_iter().any(is_share) {
        return Ramp::Seen;
    }
    let turned = steps(&attitude.turned).map(|step| step.is_some_and(|s| s.abs() > SLOPES.turned));
    let tilted = steps(&attitude.by_rates).map(is_share);
    if (0..2).any(|end| turned[end] && tilted[end]) { Ramp::Turned } else { Ramp::NotSeen }
}

/// The slope along the way over these rows and one sigma of it, rad: the middle value, so that ramps do not count.
fn angle(run: &SpeedRun, attitude: &Attitude, rows: &[usize]) -> Option<[f64; 2]> {
    let (first, last) = (*rows.first()?, *rows.last()?);
    let inside = |i: &&usize| {
        let t = run.time[**i];
        run.time[first] + SLOPES.flank <= t && t <= run.time[last] - SLOPES.flank
    };
    let plateau: Vec<usize> = rows.iter().filter(inside).copied().collect();
    let rows = if 2 * plateau.len() >= rows.len() { &plateau } else { rows };
    let slope = median(rows.iter().map(|&i| attitude.pitch[i] * run.forward(i).signum()))?;
    Some([slope, mean(rows.iter().map(|&i| attitude.sigma[i]))?])
}

/// Rows on a slope: what is certain somewhere goes on to where it is none.
fn steep_rows(run: &SpeedRun, attitude: &Attitude) -> Vec<bool> {
    let drives = |i: usize| run.forward(i).abs() > CHANGES.pieces.driving;
    let certain = |i: usize| {
        drives(i)
            && attitude.pitch[i].abs() > SLOPES.least.to_radians()
            && attitude.pitch[i].abs() > NINETY * attitude.sigma[i]
    };
    let mut steep: Vec<bool> = (0..run.time.len()).map(certain).collect();
    let goes_on = |i: usize, k: usize| {
        let (here, there) = (attitude.pitch[i], attitude.pitch[k]);
        drives(i) && here * there > 0.0 && here.abs() > SLOPES.least.to_radians()
    };
    for i in 1..steep.len() {
        steep[i] = steep[i] || (steep[i - 1] && goes_on(i, i - 1));
    }
    for i in (1..steep.len()).rev() {
        steep[i - 1] = steep[i - 1] || (steep[i] && goes_on(i - 1, i));
    }
    steep
}

/// Slopes that the gyro and the load show together.
pub(super) fn slopes(run: &SpeedRun, attitude: &Attitude) -> Slopes {
    let levelled = run.body_rates.as_ref().is_some_and(|rates| rates.level.is_some());
    let by = if levelled {
        "gyro and accelerometer measure the tilt"
    } else if attitude.relative {
        "the gyro measures the tilt; ground that gives way tilts the body too, which an accelerometer would tell"
    } else {
        "the gyro measures the tilt"
    };
    let along = |i: usize| attitude.pitch[i] * run.forward(i).signum();
    let steep = steep_rows(run, attitude);

    let mut out = Slopes::default();
    for piece in pieces(&run.time, (0..run.time.len()).filter(|&i| steep[i]), SLOPES.gap) {
        for piece in piece.chunk_by(|&a, &b| along(a) * along(b) > 0.0) {
            let [from, until] = [run.time[piece[0]], run.time[piece[piece.len() - 1]]];
            let Some([slope, sigma]) = angle(run, attitude, piece) else { continue };
            if until - from < SLOPES.least_seconds || slope.abs() < NINETY * sigma {
                continue;
            }
            let pitch = piece.iter().map(|&i| attitude.pitch[i]).sum::<f64>() / piece.len() as f64;
            let seen = if levelled { Ramp::Seen } else { ramp(run, attitude, [from, until], pitch) };
            let change = |reason: &'static str| LoadChange {
                recording: run.name.clone(),
                interval: [from, until],
                onset: [from - SLOPES.clock, from + SLOPES.clock],
                end: [until - SLOPES.clock, until + SLOPES.clock],
                seconds: piece.len() as f64 * run.period(),
                ratio: None,
                slope: slope.to_degrees(),
                slope_half: (NINETY * sigma).to_degrees(),
                bound: false,
                relative: attitude.relative,
                causes: vec![GRADE],
                reason: reason.into(),
            };
            match seen {
                Ramp::Seen => out.found.push(change(by)),
                Ramp::Turned => out.tentative.push(change(
                    "the robot turned there: a gyro that drifts shows the same; drive straight onto it, or record an \
                     accelerometer",
                )),
                Ramp::NotSeen => {}
            }
        }
    }
    out
}
