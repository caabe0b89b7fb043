//! The keys of a robot file: the constants of [`Robot`], and what a file says beside them.

use std::sync::LazyLock;

use robot_model::Robot;
use robot_model::tunable::{COUNT, Tunable, Tuning, tunables};

/// Torque at the wheels of a side per ampere.
pub(crate) const TORQUE_PER_CURRENT: &str = "torque_per_current";
/// Constants that are measured with a tape and known to a share of themselves.
pub(crate) const GEOMETRY: [&str; 2] = ["wheel_radius", "track"];
/// One sigma of these where a file states none, as a share: tyre pressure and a tape measure.
pub(crate) const USUAL_GEOMETRY_SIGMA: f64 = 0.01;
/// Noise of the pose sensor.
pub(crate) const POSE_NOISE: &str = "pose_noise";

/// A key with the unit that its value must be in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Key {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
}

/// Every key in the order in which files are written; what both sides have before what one has.
pub(crate) static KEYS: LazyLock<Vec<Key>> = LazyLock::new(|| {
    let mut keys: Vec<Key> = Vec::new();
    for constant in Robot::<f64>::CONSTANTS {
        for name in constant.both.into_iter().chain([constant.id]) {
            if !keys.iter().any(|key| key.name == name) {
                keys.push(Key { name, unit: constant.unit });
            }
        }
    }
    keys.push(Key { name: TORQUE_PER_CURRENT, unit: "N m/A" });
    keys.push(Key { name: POSE_NOISE, unit: "m" });
    keys
});

/// Their names, as messages list them.
pub(crate) static NAMES: LazyLock<Vec<&'static str>> = LazyLock::new(|| KEYS.iter().map(|key| key.name).collect());

/// Whether a key is a constant of the robot.
pub(crate) fn is_constant(name: &str) -> bool {
    Robot::<f64>::CONSTANTS.iter().any(|constant| constant.is_called(name))
}

/// The keys whose spread is that of a tuning; the first that has one counts, and it is written under the first.
pub(crate) fn keys_of(tuning: &Tunable<f64>) -> Vec<&'static str> {
    let row = Robot::<f64>::CONSTANTS.iter().find(|c| c.tuning.is_some_and(|t| t.id == tuning.id));
    let names = row.into_iter().flat_map(|row| [Some(row.id), row.both]).flatten();
    let mut out: Vec<&'static str> = names.collect();
    // Where both sides are re-tuned as one, what is said of both comes first.
    out.sort_by_key(|name| *name != tuning.id);
    if out == ["torque_gain"] {
        // A torque that is measured as a current is as uncertain as what it is multiplied with.
        out.push(TORQUE_PER_CURRENT);
    }
    out
}

/// A number that a file gives, in the unit of its key.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Given {
    pub(crate) key: &'static str,
    pub(crate) value: f64,
    /// One sigma in that unit.
    pub(crate) sigma: Option<f64>,
}

impl Given {
    /// The spread as a tuning has it: relative for a factor.
    fn spread(&self, tuning: Tuning) -> Option<f64> {
        let least = 1e-12;
        let sigma = self.sigma?;
        Some(if tuning == Tuning::Factor { sigma / self.value.abs().max(least) } else { sigma })
    }
}

/// One sigma of every tuning: what the file gives, or the usual one.
pub(crate) fn spreads(given: &[Given]) -> [f64; COUNT] {
    tunables::<f64>().map(|tuning| {
        let of = |key: &'static str| given.iter().find(|g| g.key == key)?.spread(tuning.tuning);
        keys_of(&tuning).into_iter().find_map(of).unwrap_or(tuning.sigma)
    })
}
