//! The residual series as the script reads it, and what the script writes.

use std::collections::BTreeMap;

use law::Variable;
use serde::{Deserialize, Serialize};
use torque_driven::ResidualWindow;

use super::units::{Dimension, Tree};

/// Exponents of m, kg and s of a position.
const METRE: Dimension = [1.0, 0.0, 0.0];
/// Names of the two numbers of a position.
const POSITION: [&str; 2] = ["x", "y"];

/// Dimensions of the variables, in the order in which windows hold them. A radian is one, as in the SI: in favour of the peers, for
/// a law of Lacuna's keeps it apart.
pub(super) fn dimensions() -> Vec<Dimension> {
    let of = |v: Variable| {
        let [m, kg, s, _] = v.unit().exponents();
        [m, kg, s].map(f64::from)
    };
    POSITION.iter().map(|_| METRE).chain(Variable::ALL.map(of)).collect()
}

/// What is to be fitted, and predicted.
#[derive(Debug, Serialize)]
pub(super) struct Job<'a> {
    /// Symbols of the variables, as in formulas.
    variables: Vec<&'static str>,
    fit: Vec<Window<'a>>,
    /// Variables alone: what acted there is not shown.
    left_out: Vec<Vec<f64>>,
}

/// A window to fit.
#[derive(Debug, Serialize)]
struct Window<'a> {
    recording: &'a str,
    /// In SI units.
    values: Vec<f64>,
    /// What acted and its standard deviation, in the unit of the place.
    size: f64,
    sigma: f64,
}

fn values(w: &ResidualWindow) -> Vec<f64> {
    w.position.iter().chain(&w.variables).copied().collect()
}

impl<'a> Job<'a> {
    pub(super) fn new(fit: &'a [ResidualWindow], left_out: &[ResidualWindow]) -> Self {
        let window =
            |w: &'a ResidualWindow| Window { recording: &w.recording, values: values(w), size: w.size, sigma: w.sigma };
        Self {
            variables: POSITION.into_iter().chain(Variable::ALL.map(Variable::symbol)).collect(),
            fit: fit.iter().map(window).collect(),
            left_out: left_out.iter().map(values).collect(),
        }
    }
}

/// What the script writes.
#[derive(Debug, Deserialize)]
pub(super) struct Answer {
    pub(super) peers: Vec<Peer>,
    pub(super) versions: BTreeMap<String, String>,
}

/// What one peer makes of it.
#[derive(Debug, Deserialize)]
pub(super) struct Peer {
    pub(super) name: String,
    /// In each window left out, in the unit of the place.
    pub(super) predicted: Vec<f64>,
    /// Its formulas; `None` of a black box.
    pub(super) trees: Option<Vec<Tree>>,
    pub(super) parts: Option<usize>,
    pub(super) text: Option<String>,
    /// Processor time, s.
    pub(super) seconds: f64,
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use law::Input;

    /// A window in which this acted with this deviation, and nothing moved.
    pub(in super::super) fn window(recording: &str, size: f64, sigma: f64) -> ResidualWindow {
        ResidualWindow {
            recording: recording.to_owned(),
            input: Input::Moment,
            rows: [0, 10],
            size,
            sigma,
            variables: [0.0; Variable::ALL.len()],
            position: [0.0; 2],
            law: 0.0,
        }
    }

    #[test]
    fn a_series_is_written_with_its_names_and_what_acted_is_shown_of_the_fit_alone() {
        let mut first = window("run_1", -1.5, 0.25);
        first.position = [3.0, 4.0];
        first.variables[0] = 7.0;
        let job = Job::new(&[first], &[window("run_2", 99.0, 1.0)]).written();
        assert_eq!(job["variables"][2], "omega");
        assert_eq!(job["variables"].as_array().map(Vec::len), Some(dimensions().len()));
        assert_eq!(
            job["fit"][0]["values"].as_array().map(|v| v[..3].to_vec()),
            Some(vec![3.0.into(), 4.0.into(), 7.0.into()])
        );
        assert_eq!((&job["fit"][0]["size"], &job["fit"][0]["sigma"]), (&(-1.5).into(), &0.25.into()));
        assert_eq!(job["fit"][0]["recording"], "run_1");
        assert!(!job["left_out"].to_string().contains("99"), "{}", job["left_out"]);
        assert_eq!(job["left_out"][0].as_array().map(Vec::len), Some(dimensions().len()));
    }

    impl Job<'_> {
        fn written(&self) -> serde_json::Value {
            serde_json::to_value(self).expect("a job")
        }
    }

    #[test]
    fn variables_have_the_dimensions_of_their_units() {
        let job = Job::new(&[], &[]);
        let of = |symbol: &str| job.variables.iter().position(|v| *v == symbol).map(|i| dimensions()[i]);
        assert_eq!(of("x"), Some([1.0, 0.0, 0.0]));
        assert_eq!(of("omega"), Some([0.0, 0.0, -1.0]));
        assert_eq!(of("P"), Some([2.0, 1.0, -3.0]));
        assert_eq!(of("heading"), Some([0.0, 0.0, 0.0]));
    }
}
