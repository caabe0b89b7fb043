//! How the inertial unit leans in the body, from its turns.
//!
//! A wheeled robot turns about the vertical axis of its body, on level ground and on slopes. A unit that leans shows a part of
//! that turning about its other axes, `ω_x = c_x + a_x ω_z` and `ω_y = c_y + a_y ω_z`, where `a_x` and `a_y` are the upward
//! components of its forward and its left axis; at rest on level ground its accelerometer shows `a_x g` forward. Not taken out,
//! the one is a slope that comes and goes with the turns, and the other one a slope under every drive.

use inference::robust::{MAD_TO_SIGMA, mean, median, median_absolute_deviation};

use crate::body_rates::BodyRates;
use crate::run::SpeedRun;
use crate::settings::{MEASURING, measuring::Mounting};

const MOUNTING: Mounting = MEASURING.mounting;

/// How units lean, forward axis and left axis upward, rad; zero where turns do not show it clearly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Leans {
    pub(crate) references: [f64; 2],
    pub(crate) recordings: [f64; 2],
    /// Whether the recordings do not show it themselves, so that the lean of the references was taken.
    pub(crate) are_of_references: bool,
}

/// Takes out how the unit leans in references and in recordings: of recordings that turn too little to tell, or that tell the same,
/// as it leans in the references.
pub(crate) fn set_upright(references: &mut [SpeedRun], recordings: &mut [SpeedRun]) -> Leans {
    let shown = [0, 1].map(|axis| (lean(references, axis), lean(recordings, axis)));
    let of_references = shown.map(|(of_references, _)| of_references);
    let of_recordings = shown.map(|(of_references, own)| match (of_references, own) {
        (Some(a), Some(b)) if !a.differs(b) && !b.is_clear() => Some(a),
        (of_references, own) => own.or(of_references),
    });
    Leans {
        references: take_out(references, of_references),
        recordings: take_out(recordings, of_recordings),
        are_of_references: shown.iter().all(|(_, own)| own.is_none()),
    }
}

/// Turns rates and accelerometer upright by leans that are clear; the level is then known as well as that of the forward axis.
fn take_out(runs: &mut [SpeedRun], leans: [Option<Lean>; 2]) -> [f64; 2] {
    let clear = leans.map(|lean| lean.map_or(0.0, Lean::clear));
    for rates in runs.iter_mut().filter_map(|run| run.body_rates.as_mut()) {
        let [x, y, z] = &mut rates.rate;
        for (rate, lean) in [x, y].into_iter().zip(clear) {
            rate.iter_mut().zip(z.iter()).for_each(|(rate, turn)| *rate -= lean * turn);
        }
        rates.level.iter_mut().flatten().for_each(|level| *level -= clear[0]);
        rates.level_sigma =
            leans[0].map_or(MOUNTING.unknown, |lean| lean.error.clamp(MOUNTING.known, MOUNTING.unknown));
    }
    clear
}

/// Upward component of one axis, and its error.
#[derive(Debug, Clone, Copy)]
struct Lean {
    value: f64,
    error: f64,
}

impl Lean {
    fn is_clear(self) -> bool {
        self.value.abs() > MOUNTING.clear * self.error
    }

    /// Its value where it is clear.
    fn clear(self) -> f64 {
        if self.is_clear() { self.value } else { 0.0 }
    }

    fn differs(self, other: Self) -> bool {
        (self.value - other.value).abs() > MOUNTING.clear * self.error.hypot(other.error)
    }
}

/// Upward component of one axis: the median over stretches of the share of the turning that it shows; `None` of too few.
fn lean(runs: &[SpeedRun], axis: usize) -> Option<Lean> {
    let all = runs.iter().filter_map(|run| run.body_rates.as_ref());
    let shares: Vec<f64> = all.flat_map(|rates| shares(rates, axis)).collect();
    if shares.len() < MOUNTING.least {
        return None;
    }
    let error = MAD_TO_SIGMA * median_absolute_deviation(&shares)? / (shares.len() as f64).sqrt();
    median(shares).map(|value| Lean { value, error })
}

/// Of every stretch in which the robot turns: slope of an axis' rate over the turning rate, by least squares.
fn shares(rates: &BodyRates, axis: usize) -> Vec<f64> {
    let steps = ((MOUNTING.stretch / rates.step) as usize).max(1);
    let of = |(rate, turning): (&[f64], &[f64])| {
        let [own, turn] = [rate, turning].map(|values| mean(values.iter().copied()));
        let (own, turn) = (own?, turn?);
        let sums = rate.iter().zip(turning).map(|(w, z)| [(w - own) * (z - turn), (z - turn).powi(2)]);
        let [product, square] = sums.fold([0.0; 2], |[p, s], [dp, ds]| [p + dp, s + ds]);
        let spread = (square / turning.len() as f64).sqrt();
        (spread > MOUNTING.turning).then(|| product / square)
    };
    rates.rate[axis].chunks(steps).zip(rates.rate[2].chunks(steps)).filter_map(of).collect()
}

impl Leans {
    /// Leans that are worth telling, for people.
    pub(crate) fn told(&self) -> Vec<String> {
        let told = |[x, y]: [f64; 2], of: &str| {
            let [along, across] = [x, y].map(|lean| lean.clamp(-1.0, 1.0).asin().to_degrees());
            (along.hypot(across) > MOUNTING.told).then(|| {
                format!(
                    "the turns of the {of} show that the inertial unit leans in the body: its forward axis points {:.1}° {}, its \
                     left axis {:.1}° {}; turning rates and accelerometer were turned upright",
                    along.abs(),
                    up_or_down(along),
                    across.abs(),
                    up_or_down(across)
                )
            })
        };
        let of_references = told(self.references, "references").map(|text| {
            let note = ", and those of the recordings, which turn too little to show it, with them";
            if self.are_of_references { text + note } else { text }
        });
        let own = if self.are_of_references { None } else { told(self.recordings, "recordings") };
        of_references.into_iter().chain(own).collect()
    }
}

fn up_or_down(angle: f64) -> &'static str {
    if angle < 0.0 { "down" } else { "up" }
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;
    use verdict::Verdict;

    use super::*;
    use crate::testing::{Leg, case, levelled, rounds};
    use inference::Options;

    /// Rounds whose inertial unit leans, degrees, with offsets of its gyro.
    fn leaning([x, y]: [f64; 2], legs: &[Leg]) -> SpeedRun {
        let mut run = levelled(legs, x);
        let rates = run.body_rates.as_mut().expect("rates");
        let turning = rates.rate[2].clone();
        for (axis, lean, offset) in [(0, x, 0.01), (1, y, -0.02)] {
            let shown = turning.iter().map(|z| offset + lean.to_radians().sin() * z);
            rates.rate[axis].iter_mut().zip(shown).for_each(|(rate, more)| *rate += more);
        }
        run
    }

    #[test]
    fn a_unit_that_leans_is_set_upright_by_its_turns() {
        let mut runs = [leaning([5.0, -3.0], &rounds(4))];
        let leans = set_upright(&mut [], &mut runs);
        let [x, y] = leans.recordings;
        assert_abs_diff_eq!(x, 5.0_f64.to_radians().sin(), epsilon = 1e-3);
        assert_abs_diff_eq!(y, (-3.0_f64).to_radians().sin(), epsilon = 1e-3);
        let told = leans.told();
        assert!(
            told.len() == 1 && told[0].contains("forward axis points 5.0° up, its left axis 3.0° down"),
            "{told:?}"
        );
        // A unit that stands upright is left alone, and without turns nothing is known.
        for legs in [rounds(4), vec![Leg::straight(100.0)]] {
            let mut runs = [levelled(&legs, 0.0)];
            let rate = |runs: &[SpeedRun]| runs[0].body_rates.as_ref().expect("rates").rate.clone();
            let before = rate(&runs);
            assert_eq!(set_upright(&mut [], &mut runs).recordings, [0.0; 2]);
            assert_eq!(rate(&runs), before);
        }
    }

    #[test]
    fn a_unit_that_leans_is_no_slope_with_and_without_references() {
        for references in [vec![leaning([5.0, 3.0], &rounds(3))], Vec::new()] {
            let by_file = references.is_empty();
            let d = crate::diagnose_steady(
                &case(references, vec![leaning([5.0, 3.0], &rounds(5))]),
                &Options::default(),
                &|_| {},
            )
            .expect("a diagnosis");
            let loads = d.steady.as_ref().expect("loads");
            assert!(loads.changes.found.is_empty(), "{:?}", d.sentences);
            assert!(by_file || d.verdict == Verdict::NoMismatch, "{:?}", d.sentences);
            assert!(d.limits.iter().any(|l| l.contains("leans in the body")), "{:?}", d.limits);
        }
    }

    #[test]
    fn recordings_that_hardly_turn_take_the_lean_of_their_references() {
        let straight = vec![Leg::straight(100.0)];
        let mut references = [leaning([5.0, 3.0], &rounds(4))];
        let mut runs = [leaning([5.0, 3.0], &straight)];
        let leans = set_upright(&mut references, &mut runs);
        assert_abs_diff_eq!(leans.recordings[0], 5.0_f64.to_radians().sin(), epsilon = 1e-3);
        assert!(leans.told().len() == 1 && leans.told()[0].contains("which turn too little"), "{:?}", leans.told());

        // A unit that was set upright since is not.
        let mut runs = [leaning([0.0, 0.0], &rounds(4))];
        assert_eq!(set_upright(&mut [leaning([5.0, 3.0], &rounds(4))], &mut runs).recordings, [0.0; 2]);
    }

    #[test]
    fn a_unit_that_leans_is_no_slope_of_a_drive_that_hardly_turns() {
        for references in [vec![leaning([5.0, 3.0], &rounds(3))], Vec::new()] {
            let recordings = vec![leaning([5.0, 3.0], &[Leg::straight(100.0)])];
            let d = crate::diagnose_steady(&case(references, recordings), &Options::default(), &|_| {})
                .expect("a diagnosis");
            let loads = d.steady.as_ref().expect("loads");
            assert!(loads.changes.found.is_empty(), "{:?}", d.sentences);
        }
    }
}
