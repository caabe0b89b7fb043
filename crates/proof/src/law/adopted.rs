//! What a law that a robot follows in references and recordings alike is worth once the simulation has it, on drives that nothing was
//! fitted to.
//!
//! ```text
//! robot with a law of another grammar in every drive
//!     references and recordings --> law that both have alike (`lacuna law --in-every-drive`)
//!     further drives            --> re-tuned simulation, without the law and with it (`--adopt`): which errs less?
//! ```

use anyhow::Result;
use examiner::Plan;
use inference::robust::rms;
use inference::{KnownEffects, Options, SearchForLaw};
use law::{Law, OwnEffect};
use serde::Serialize;
use torque_driven::{Case, Run};
use verdict::{CommonLaw, FreeRun};

/// References, recordings in which the law is sought, and further drives; the law is in all of them.
const REFERENCES: usize = 3;
const RECORDINGS: usize = 3;
const FURTHER: usize = 2;

/// All drives of such a robot.
pub(super) const DRIVES: usize = REFERENCES + RECORDINGS + FURTHER;

/// Errors over those before from which on a simulation is better or worse: less is noise.
const SAME: f64 = 0.01;

/// The name of an adopted law.
const NAME: &str = "adopted";

/// Quantities that are judged, as free runs name them.
const JUDGED: [&str; 2] = ["wheel speed", "yaw rate"];

/// What came out for a robot that lacks a law in every drive.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Adopted {
    /// The kind of law.
    pub(super) hidden: String,
    /// What is told to be lacking in every drive: place and formula.
    pub(super) told: Option<[String; 2]>,
    /// With the law over without it: rms error of wheel speed and of yaw rate.
    pub(super) over_before: Option<[f64; 2]>,
}

impl Adopted {
    /// Geometric mean of both shares.
    fn share(&self) -> Option<f64> {
        self.over_before.map(|[wheel, yaw]| (wheel * yaw).sqrt())
    }

    /// Whether further drives are forecast better with the law.
    pub(super) fn falls(&self) -> bool {
        self.share().is_some_and(|share| share < 1.0 - SAME)
    }

    /// Whether they are forecast worse.
    pub(super) fn rises(&self) -> bool {
        self.share().is_some_and(|share| share > 1.0 + SAME)
    }
}

/// Draws such a robot, asks what it lacks in every drive, and adopts that.
pub(super) fn case(plan: &Plan, folder: &std::path::Path) -> Result<Adopted> {
    let (drawn, case) = super::opened(plan, folder)?;
    let hidden = drawn.truth.effects.first().and_then(|e| e.kind.clone()).unwrap_or_default();
    let [known, sought, further] = parts(&case.recordings);
    let asked = Case { references: known.clone(), recordings: sought, ..case.clone() };
    let options = Options { law: SearchForLaw::Always, ..Options::default() };
    let found = torque_driven::diagnose(&asked, &options, &|_| ())?.law.and_then(|law| law.in_every_drive);
    let told = found.as_ref().map(|law| [law.place.clone(), law.formula.clone()]);
    let judged = Case { references: known, recordings: further, ..case };
    let over_before = found.map(|law| over_before(&judged, &law)).transpose()?;
    Ok(Adopted { hidden, told, over_before })
}

/// Drives by what they are for.
fn parts(all: &[Run]) -> [Vec<Run>; 3] {
    let mut all = all.iter().cloned();
    [REFERENCES, RECORDINGS, FURTHER].map(|number| all.by_ref().take(number).collect())
}

/// Errors with the adopted law over those without it, constants re-tuned beside both, on drives left out of that.
fn over_before(case: &Case, law: &CommonLaw) -> Result<[f64; 2]> {
    let effect = OwnEffect::new(NAME, Law::of_formula(&law.formula, &law.seen)?)?;
    let known = KnownEffects::default().adopting(vec![effect]);
    let adopting = Case { effects: known.given(&known.adopted())?, ..case.clone() };
    let before = errors(case, &Options::default())?;
    let after = errors(&adopting, &Options { known, ..Options::default() })?;
    Ok([0, 1].map(|q| after[q] / before[q].max(f64::MIN_POSITIVE)))
}

/// Rms errors of the re-tuned simulation over the recordings, each left out of its fit.
fn errors(case: &Case, options: &Options) -> Result<[f64; 2]> {
    let options = Options { law: SearchForLaw::Never, ..*options };
    let runs = torque_driven::diagnose(case, &options, &|_| ())?.free_runs;
    Ok(JUDGED.map(|quantity| {
        let own = |run: &&FreeRun| run.quantity.starts_with(quantity);
        rms(runs.iter().filter(own).map(|run| run.retuned)).unwrap_or(0.0)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_simulation_is_better_or_worse_only_beyond_noise() {
        let of = |over_before| Adopted { hidden: String::new(), told: None, over_before };
        for (over_before, falls, rises) in [
            (None, false, false),
            (Some([0.8, 1.0]), true, false),
            (Some([0.9, 1.2]), false, true),
            (Some([1.005, 0.999]), false, false),
        ] {
            let one = of(over_before);
            assert_eq!((one.falls(), one.rises()), (falls, rises), "{over_before:?}");
        }
    }
}
