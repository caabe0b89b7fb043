//! Tuned numbers, by what they are for.
//!
//! * `measuring`: rows, clocks, loads of steady driving and their comparison with the references'.
//! * `changes`: slopes, jumps of the load, turning and standstills inside recordings.
//! * `naming`: the plant in steady driving, weights of effects, the answer and the next drive.
//! * `forecasting`: the last part of a recording and the law of its torques.

pub(crate) mod changes;
pub(crate) mod forecasting;
pub(crate) mod measuring;
pub(crate) mod naming;

/// As this crate uses them.
pub(crate) const MEASURING: measuring::Settings = measuring::Settings::DEFAULT;
pub(crate) const CHANGES: changes::Settings = changes::Settings::DEFAULT;
pub(crate) const NAMING: naming::Settings = naming::Settings::DEFAULT;
pub(crate) const FORECASTING: forecasting::Settings = forecasting::Settings::DEFAULT;

/// A row for each number.
pub(crate) fn all() -> impl Iterator<Item = &'static ::settings::Setting> {
    let stages = [measuring::Settings::ALL, changes::Settings::ALL, naming::Settings::ALL, forecasting::Settings::ALL];
    stages.into_iter().flatten()
}
