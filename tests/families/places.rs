//! A place that is visited once, or twice: family 10.

use examiner::{EffectId, Manoeuvre, Place, Settings};
use torque_driven::Case;
use verdict::Diagnosis;

use crate::common::{case_of, draw, told};
use crate::damage::between;
use crate::rules::{answer, is_named, no_physics_is_claimed_but, nothing_is_claimed_but, strong};

const EFFECT: EffectId = EffectId::RollingResistance;
const SEED: u64 = 110;
/// Wheels may be in a place that the middle of the robot has left less than this ago, s.
const CLEAR: f64 = 1.5;

/// The case with the longest stretch of one recording that holds one visit, or that and the next.
fn visited(twice: bool) -> Case {
    // Circles come back to the place.
    let drives = vec![Manoeuvre::Loop];
    let settings = Settings { place: Some(Place::Patch), drives, duration_s: 24.0, ..strong(&[EFFECT]) };
    let drawn = draw(&settings, SEED);
    let case = case_of(&drawn);
    let stretches = drawn.truth.recordings.values().enumerate().flat_map(|(run, r)| {
        let visits = &r.intervals_s[&EFFECT.id()];
        visits.windows(3).map(move |v| (run, [v[0][1] + CLEAR, v[2][0] - CLEAR], v[2][1])).collect::<Vec<_>>()
    });
    let longest = stretches.max_by(|a, b| (a.1[1] - a.1[0]).total_cmp(&(b.1[1] - b.1[0])));
    let (run, [from, until], next) = longest.expect("visits with others before and after");
    let recordings = vec![between(&case.recordings[run], [from, if twice { next } else { until }])];
    Case { recordings, ..case }
}

/// Visits and penalty of the trial that names the effect at a place.
fn place(d: &Diagnosis) -> (usize, f64) {
    let name = format!("{} (place)", EFFECT.id());
    let trial = d.trials.iter().find(|t| t.hypothesis == [name.as_str()]).unwrap_or_else(|| panic!("{}", told(d)));
    (trial.visits.expect("a place has visits"), trial.gain - trial.score)
}

#[test]
fn a_place_visited_once_costs_more_than_one_visited_twice_and_its_short_circle_accuses_no_gyro() {
    let [once, twice] = [false, true].map(|t| answer(&format!("seed {SEED}, twice: {t}"), &visited(t)));
    nothing_is_claimed_but(&once, &[EFFECT]);
    no_physics_is_claimed_but(&twice, &[EFFECT]);
    is_named(&twice, EFFECT);
    let (first, both) = (place(&once), place(&twice));
    assert_eq!((first.0, both.0), (1, 2), "{} {}", told(&once), told(&twice));
    assert!(first.1 > both.1 + 5.0, "{first:?} {both:?}");
}
