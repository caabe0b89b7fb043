//! The reproduction has the same bits on every machine, with any number of threads, in debug and in release.
//!
//! Nothing in it calls the platform's mathematics, reorders a sum or contracts a product. A hash that changes means that
//! results of earlier versions no longer come out: if that is meant, say why in the changelog and take the new hash.

use sha2::{Digest, Sha256};
use sim::learning::{Contender, Study, StudyRecipe};
use sim::{Draw, Experiment, Recipe, RobotSet};

struct Hash(Sha256);

impl Hash {
    fn new() -> Self {
        Self(Sha256::new())
    }

    fn add(&mut self, values: impl IntoIterator<Item = f64>) {
        for value in values {
            self.0.update(value.to_bits().to_le_bytes());
        }
    }

    /// The first 16 hexadecimal digits.
    fn digits(self) -> String {
        let digest = self.0.finalize();
        let first = digest.iter().take(8).fold(0_u64, |all, byte| (all << 8) | u64::from(*byte));
        format!("{first:016x}")
    }
}

fn of_draws(draws: &[Draw]) -> String {
    let mut hash = Hash::new();
    for draw in draws {
        hash.add(draw.table1());
        for output in &draw.output {
            hash.add(output.peak);
            hash.add(output.peak_at);
            hash.add([output.quiet_rms, output.mean_regressor_square]);
        }
    }
    hash.digits()
}

#[test]
fn the_runs_of_all_sets_have_their_bits() {
    let digits = RobotSet::ALL.map(|set| {
        let experiment = Experiment::new(&Recipe::default(), set).expect("runs");
        let mut hash = Hash::new();
        for state in &experiment.trajectory().states {
            hash.add(state.to_array());
        }
        hash.add(experiment.trajectory().torques.iter().flatten().copied());
        hash.digits()
    });
    assert_eq!(
        digits,
        ["c34e3e750bac64d5", "8fa1ed4c6990206f", "4f119c8becd05cb7"],
        "states and torques of the sets A, B, C"
    );
}

#[test]
fn draws_have_their_bits_with_one_thread_and_with_three() {
    let experiment = Experiment::new(&Recipe::default(), RobotSet::B).expect("runs");
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let draws = pool.install(|| experiment.ensemble(1, 6, || {})).expect("finite");
        assert_eq!(of_draws(&draws), "fc4216a0a7eded64", "{threads} threads");
    }
}

#[test]
fn the_law_with_memory_has_its_bits() {
    let study = Study::new(&StudyRecipe { laps: 1, ..StudyRecipe::default() }).expect("runs");
    let score = study.run(Contender::Memory, 1, 0).expect("finite");
    let mut hash = Hash::new();
    hash.add(score.lap.iter().chain(&score.frozen).chain(&score.online).copied());
    hash.add(score.ahead_kept.iter().chain(&score.ahead_acting).flatten().copied());
    assert_eq!(hash.digits(), "43a59f463b46c7a3");
}
