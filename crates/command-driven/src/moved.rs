//! Wheel radius and track that the robot file may have wrong: what lies within its sigma is re-tuned, not blamed.

use inference::robust::NINETY;
use verdict::{Element, Parameter, Retuned};

use crate::ResponseCase;
use crate::settings::{Answer, SETTINGS};

const ANSWER: Answer = SETTINGS.answer;

/// A constant of the robot file that these recordings want otherwise.
pub(crate) struct Moved {
    pub(crate) element: Element,
    /// Probability that the file is wrong about it, and nothing is missing there.
    pub(crate) probability: f64,
    pub(crate) retuned: Retuned,
}

impl Moved {
    /// Whether it is re-tuned rather than named as a cause; the file may as well be right about what its interval holds.
    pub(crate) fn is_retuned(&self) -> bool {
        let off = (self.retuned.to - self.retuned.from).abs();
        self.probability > 0.5 && off > self.retuned.half_width
    }
}

/// Log density of a Gaussian without its constant.
fn log_density(x: f64, sigma: f64) -> f64 {
    -0.5 * (x / sigma).powi(2) - sigma.ln()
}

/// Radius and track among the fitted constants, each with the probability that the file is wrong about it: an error of the
/// file's sigma against a change of the robot or the ground, `p = N(δ; 0, σ² + s²) / (N(δ; 0, σ² + s²) + e^{-c} N(δ; 0, τ² + s²))`
/// with a relative deviation δ known to s, the file's sigma σ, the usual change τ and the price c of a cause. Since references, a
/// constant may have moved by a share of that sigma.
pub(crate) fn moved(case: &ResponseCase, nominal: [f64; 2], parameters: &[Parameter]) -> Vec<Moved> {
    let of = |(k, (element, name)): (usize, (Element, &str))| {
        let p = parameters.iter().find(|p| p.element == element)?;
        let delta = p.value / p.simulated.filter(|s| *s > 0.0).unwrap_or(1.0) - 1.0;
        let own = p.half_width.map_or(0.0, |half| half / NINETY);
        let since = if case.references.is_empty() { 1.0 } else { ANSWER.between_visits };
        let (file, before) =
            (since * case.geometry_sigma[k], nominal[k] * p.simulated.filter(|s| *s > 0.0).unwrap_or(1.0));
        let odds = log_density(delta, file.hypot(own)) + ANSWER.cause - log_density(delta, ANSWER.change.hypot(own));
        let retuned = Retuned {
            constant: name.to_owned(),
            unit: "m".to_owned(),
            from: before,
            to: before * (1.0 + delta),
            half_width: before * NINETY * own,
            sigmas: delta / file,
        };
        Some(Moved { element, probability: inference::evidence::logistic(odds), retuned })
    };
    [(Element::Radius, "wheel_radius"), (Element::Track, "track")].into_iter().enumerate().filter_map(of).collect()
}

/// Probability that a centre of rotation that differs by this much, known to a sigma, m, is another one: with what robots slip it moves
/// from drive to drive by a share of the track.
pub(crate) fn is_another_centre(delta: f64, own: f64, track: f64) -> f64 {
    let [usual, change] = [ANSWER.centre, ANSWER.change].map(|share| (share * track).hypot(own));
    inference::evidence::logistic(log_density(delta, change) - ANSWER.cause - log_density(delta, usual))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::ResponseRun;
    use crate::testing::{Truth, robot};

    fn probability(value: f64) -> f64 {
        of_track(value, (1.0, Vec::new())).probability
    }

    /// The track found at so many times its stated length, where the simulation, or references, have it at another factor.
    fn of_track(value: f64, (simulated, references): (f64, Vec<ResponseRun>)) -> Moved {
        let case = ResponseCase {
            robot: robot(),
            geometry_sigma: [0.01, 0.02],
            references,
            recordings: vec![],
            held_out: vec![],
        };
        let parameter = Parameter {
            element: Element::Track,
            id: "track_factor".into(),
            unit: "-".into(),
            value,
            half_width: Some(0.002),
            simulated: Some(simulated),
            at_bound: false,
        };
        let mut all = moved(&case, [0.1, 0.5], &[parameter]);
        assert!(all.len() == 1 && (all[0].retuned.to - 0.5 * value).abs() < 1e-12, "{:?}", all[0].retuned);
        all.remove(0)
    }

    #[test]
    fn since_references_a_constant_moves_by_a_share_of_the_files_sigma() {
        let reference = Truth::perfect().run("reference", 4, 7);
        let found = of_track(1.53, (1.5, vec![reference]));
        assert!((found.retuned.from - 0.75).abs() < 1e-12 && found.is_retuned(), "{:?}", found.retuned);
        // 2 % of 1.5, in sigmas of 0.6 times 2 %.
        assert!((found.retuned.sigmas - 1.0 / 0.6).abs() < 1e-9, "{:?}", found.retuned);
    }

    #[test]
    fn a_centre_moves_by_some_per_cent_of_the_track_with_the_drive() {
        assert!(is_another_centre(0.02, 0.01, 0.5) < 0.1 && is_another_centre(-0.08, 0.02, 0.7) < 0.2);
        assert!(is_another_centre(0.15, 0.002, 0.5) > 0.99 && is_another_centre(-0.15, 0.002, 0.5) > 0.99);
    }

    #[test]
    fn what_lies_within_the_files_sigma_is_retuned_and_what_lies_far_beyond_is_a_cause() {
        assert!(probability(1.01) > 0.95 && probability(0.97) > 0.9);
        assert!(probability(1.2) < 1e-6 && probability(0.9) < 0.05);
    }
}
