//! The next drive of a command-driven robot: which commands would tell the remaining responses apart.
//!
//! Rivals are the response that was found and those that differ from it in one element that is in doubt, or in how the
//! sides are held at a wheel's limit. Each in turn is taken for true and follows every drive of a menu; the others
//! forecast its windows of 2 s, their constants moved within what is known of them. A drive is worth the expected fall
//! of the entropy of the rivals, as for the other kinds of robots.

mod forecast;
mod menu;
mod rivals;

use inference::advice::{LEAST_BITS, among, nothing_to_split, sorted};
use inference::expected_information::{expected_bits, widest_pair};
use rayon::prelude::*;
use verdict::{Advice, Course, Manoeuvre};

use crate::identified::Identified;
use crate::identify::Base;
use crate::windows::Windows;
use forecast::{Differences, Forecaster};
use rivals::{Rival, rivals};

/// Scores are log odds as they are.
const TEMPERATURE: f64 = 1.0;

/// Advises on the next drive, of `length` s; `unknown` is the probability that the response has another cause.
pub(crate) fn advise(
    windows: &Windows,
    base: &Base,
    found: &Identified,
    nominal: [f64; 2],
    unknown: f64,
    length: f64,
) -> Advice {
    let rivals = rivals(windows, base, found, nominal);
    let forecaster = Forecaster::new(windows, &rivals, nominal);
    let mut out = among(rivals.iter().map(|r| r.contender.clone()));
    let drives = menu::drives(windows, nominal, length);
    out.manoeuvres = drives
        .into_par_iter()
        .map(|(name, course)| manoeuvre(&name, &course, &forecaster.differences(&course), &rivals))
        .collect();
    out.withheld = nothing_to_split(&out);
    out.limits = limits(&out, unknown);
    sorted(out)
}

fn manoeuvre(name: &str, course: &Course, shown: &Differences, rivals: &[Rival]) -> Manoeuvre {
    let p: Vec<f64> = rivals.iter().map(|r| r.contender.probability).collect();
    let mut out = Manoeuvre::new(name, course.clone(), [0.0; 3]);
    out.expected_bits = expected_bits(&p, &shown.forecasts, TEMPERATURE);
    out.narrows = shown.narrows;
    let pair = widest_pair(&p, &shown.forecasts, TEMPERATURE);
    out.splits = pair.map(|(k, l)| [k, l].map(|i| rivals[i].contender.name.clone()));
    out.why = match (pair, shown.narrows) {
        (Some((k, l)), _) => {
            format!(
                "Between \"{}\" and \"{}\" forecasts over 2 s would differ by {}.",
                rivals[k].contender.name,
                rivals[l].contender.name,
                difference(shown.rms[k][l])
            )
        }
        (None, Some(share)) => format!(
            "The uncertainty of the constants of the response would fall to {:.0} % of what it is now.",
            100.0 * share
        ),
        (None, None) => "It would add to what the recordings say about the response.".to_owned(),
    };
    out
}

/// The quantity in which two forecasts differ: one part of the response is another, never both.
fn difference([wheel, pose]: [f64; 2]) -> String {
    if wheel > pose {
        format!("{wheel:.2} rad/s in wheel speed (rms)")
    } else {
        format!("{pose:.3} in the pose (rms, m and rad)")
    }
}

fn limits(advice: &Advice, unknown: f64) -> Vec<String> {
    let mut out = vec![
        "the profile is what is commanded, on the robot file's wheel radius and track, from rest: begin where there is \
         room, for a robot that slips or turns otherwise leaves the path"
            .to_owned(),
    ];
    if unknown > crate::settings::SETTINGS.left.likely {
        out.push(format!(
            "with probability {unknown:.2} the cause is not in the catalogue: which drive would reveal it best cannot be \
             computed"
        ));
    }
    if advice.manoeuvres.iter().any(|m| m.expected_bits >= LEAST_BITS) {
        out.push("record it on the same ground as the others, and add it to the recordings".to_owned());
    }
    out
}

#[cfg(test)]
mod tests {
    use inference::Options;
    use recordings::Recording;

    use super::*;
    use crate::testing::{NOMINAL, Truth, alone};
    use crate::{ResponseRun, diagnose_response};

    const LENGTH: f64 = 20.0;
    const NOISE: f64 = 0.3;

    /// Advice from these drives.
    fn advised(recordings: &[Recording]) -> Advice {
        let recordings = recordings.iter().map(|r| ResponseRun::new(r).expect("a run")).collect();
        let case = alone(recordings);
        let options = Options { next: Some(LENGTH), ..Options::default() };
        diagnose_response(&case, &options, &|_| {}).expect("a diagnosis").next.expect("advice")
    }

    #[test]
    fn what_is_in_doubt_is_a_rival_and_the_advised_drive_settles_it_better_than_the_last_of_the_menu() {
        let truth = Truth::stock();
        let [mut before, mut best, mut last] = [0.0; 3];
        for seed in 2..4 {
            let first = truth.recording("a", 12, 5 + seed, NOISE);
            let advice = advised(std::slice::from_ref(&first));
            assert!(advice.rivals.len() > 1 && advice.withheld.is_none(), "{:?}", advice.rivals);
            assert!(advice.manoeuvres.iter().all(|m| (0.0..=advice.entropy_bits).contains(&m.expected_bits)));
            before += advice.entropy_bits;

            let after = |m: &Manoeuvre| {
                let rows = 0..(LENGTH / 0.05) as usize;
                let command: Vec<[f64; 2]> = rows.map(|i| menu::wheels(m.wanted(i as f64 * 0.05), NOMINAL)).collect();
                let next = truth.driven("b", &command, 50 + seed, NOISE);
                advised(&[first.clone(), next]).entropy_bits
            };
            best += after(&advice.manoeuvres[0]);
            last += after(&advice.manoeuvres[advice.manoeuvres.len() - 1]);
        }
        assert!(
            best < 0.7 * before && best < 0.7 * last,
            "bits: {before} before, {best} after the first, {last} the last"
        );
    }

    #[test]
    fn a_certain_response_leaves_nothing_to_tell_apart_but_sizes_to_narrow() {
        let advice = advised(&[Truth::stock().recording("a", 60, 1, 0.02)]);
        assert!(advice.withheld.as_ref().is_some_and(|w| w.contains("the response as found")), "{advice:?}");
        let best = &advice.manoeuvres[0];
        assert!(best.narrows.is_some_and(|share| share > 0.0 && share < 1.0), "{best:?}");
    }
}
