//! The sentences around the tables.

use super::{FULL, Outcome};
use crate::document::fewer_draws;
use crate::output::Figure;

/// What the study is, what it found, and what was chosen when.
pub(super) fn introduction(o: &Outcome, figures: &[Figure]) -> Vec<String> {
    let judged: Vec<&Figure> = figures.iter().filter(|f| f.pass.is_some()).collect();
    let missed: Vec<&str> = judged.iter().filter(|f| f.pass == Some(false)).map(|f| f.name.as_str()).collect();
    let verdict = if missed.is_empty() {
        format!("All {} targets are met.", judged.len())
    } else {
        format!("{} of {} targets are missed: {}.", missed.len(), judged.len(), missed.join("; "))
    };
    vec![
        format!("Made by `cargo xtask learn`: {} draws of first layers and noise, seed {}.", o.args.draws, o.args.seed),
        verdict + &fewer_draws(FULL, o.args.draws),
        "Every law drives the paper's loop five times (set B, the rolling resistance rises at 12 s of each lap), its wheel \
         speeds measured with white noise of 0.01 rad/s, its errors counted against the true speeds. Then it is tried on laps \
         it has not seen: wider (2.0 m at 0.55 m/s), tighter (1.25 m at 0.4 m/s), and the other way round, with other ramps."
            .into(),
        "The law with memory (`identifier::Retaining`) is the paper's: the same A, gain, six random units and certificate. \
         Beside its weights it has two least-squares fits of the same network. The long one, over minutes, is what is kept; the \
         short one, over half a second, is as near to what is kept as the data allow. Their output is a \
         known part of the right-hand side, so that the Lyapunov balance holds exactly, with the memory inside epsilon."
            .into(),
        "What the figures mean. Frozen weights are nearly a test of having learned G = a x, that is, that speeds change slowly: \
         the row that is given just this and learns nothing beats every network there. Keeping it is more than the \
         paper's law does, and not yet a model of the robot. Running ahead tells more: with six random units of speeds and \
         torques, what is kept beats a frozen constant by far, but a constant that has followed until the start, and then \
         holds the speed, is about as good as the network. Only Eq. 8, with its constants learned and the body carried along, \
         predicts the robot, and only where the ground stays as it is. Part of what the memory gains online is speed of \
         adaptation, which a higher gain buys too: the row with ten times the gain is there to compare."
            .into(),
        "Disclosure. The memory's settings were first chosen on 8 to 32 draws of another seed and another unseen lap (1.2 m at \
         0.45 m/s), with all five targets in view. Two runs of this study (seeds 2026 and 2027) gave 24.2 and 22.2 for the 25 \
         asked of frozen weights and met the other four. Lead, ridge and consolidation of the long memory were then chosen \
         anew on four validation laps that are not scored here (1.2 to 1.9 m at 0.42 to 0.6 m/s, another seed, 16 draws). This \
         is the third run, with a fresh seed. The dead zone is as wide as the noise; radius, sigma and kappa are round \
         numbers, not tuned."
            .into(),
    ]
}
