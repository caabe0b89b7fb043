//! What acts on the robot beside the catalogue's effects: a law, or inputs given window by window.

use std::array::from_fn;
use std::sync::Arc;

use inference::hypothesis::Free;
use law::{Action, Input, Law, Motion};
use robot_model::{Coefficients, Disturbance, Lanes, OperatingPoint};

use crate::settings::law::SETTINGS;
use crate::simulate::{WIDTH, Wide};

/// Inputs of every window of every recording.
pub(crate) type Inputs = Vec<(Input, Vec<Vec<f64>>)>;

/// What acts on the robot beside the catalogue's effects.
#[derive(Clone)]
pub(crate) enum Acting {
    /// A law in what the simulated robot does, and the size of one unit of each of its terms' constants.
    Law { law: Law, units: Vec<f64> },
    /// Inputs of each recording, window by window, times a number, and the size of one unit of it.
    Given { inputs: Arc<Inputs>, times: f64, unit: f64 },
}

/// Which recording a stretch is of, and where its time begins.
#[derive(Clone, Copy)]
pub(crate) struct InRecording {
    pub(crate) run: usize,
    /// Time of the first window, s.
    pub(crate) from: f64,
    /// Length of a window, s.
    pub(crate) window: f64,
}

impl Acting {
    /// Its numbers that a fit may change.
    pub(crate) fn free(&self) -> Vec<Free> {
        let most = SETTINGS.refit.most;
        let strength = |unit: f64| Free { parameter: None, unit, bounds: [-most * unit, most * unit], usual: unit };
        match self {
            Self::Given { unit, .. } => vec![strength(*unit)],
            Self::Law { law, units } => {
                let numbers = law.numbers();
                let mut at = 0;
                let mut out = Vec::with_capacity(numbers.len());
                for (term, unit) in law.terms().iter().zip(units) {
                    let shapes: usize = term.factors().iter().map(|f| f.shapes().len()).sum();
                    out.push(strength(*unit));
                    out.extend(numbers[at + 1..=at + shapes].iter().map(|s| Free {
                        parameter: None,
                        unit: s.unit,
                        bounds: s.bounds,
                        usual: s.value,
                    }));
                    at += shapes + 1;
                }
                out
            }
        }
    }

    /// The same with other numbers.
    pub(crate) fn at(&self, numbers: &[f64]) -> Self {
        match self {
            Self::Law { law, units } => Self::Law { law: law.with(numbers), units: units.clone() },
            Self::Given { inputs, times, unit } => Self::Given {
                inputs: Arc::clone(inputs),
                times: numbers.first().copied().unwrap_or(*times),
                unit: *unit,
            },
        }
    }

    /// As a disturbance of robots side by side.
    pub(crate) fn side_by_side<'a>(&'a self, at: &[InRecording; WIDTH]) -> SideBySide<'a> {
        SideBySide { acting: self, at: *at }
    }
}

/// Something that acts on robots side by side.
pub(crate) struct SideBySide<'a> {
    acting: &'a Acting,
    at: [InRecording; WIDTH],
}

impl Disturbance<Wide> for SideBySide<'_> {
    fn act(&self, at: &OperatingPoint<Wide>, c: &mut Coefficients<Wide>) {
        let action = match self.acting {
            Acting::Law { law, .. } => law.act(&Motion::seen_at(at, c), &[]),
            Acting::Given { inputs, times, .. } => self.given(inputs, *times, at.time),
        };
        action.change(at, c);
    }
}

impl SideBySide<'_> {
    fn given(&self, inputs: &Inputs, times: f64, time: Wide) -> Action<Wide> {
        // A hair of slack: borders of windows are exact multiples of the step up to rounding.
        let window: [usize; WIDTH] =
            from_fn(|i| ((time.0[i] - self.at[i].from) / self.at[i].window + 1e-6).max(0.0) as usize);
        let mut out = Action::default();
        for (input, runs) in inputs {
            let value = |i: usize| runs.get(self.at[i].run).and_then(|run| run.get(window[i])).copied();
            out.add(*input, Lanes(from_fn(|i| times * value(i).unwrap_or_default())));
        }
        out
    }
}
