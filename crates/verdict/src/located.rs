//! What is reported about where, when and how much.

use serde::{Deserialize, Deserializer, Serialize};

use crate::Word;

/// All that was found about where the mismatch sits, before and after the verdict.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Located {
    /// When each signal mismatches: at most one fault-free case in twenty shows any.
    pub spans: Vec<Span>,
    /// Residual torque of each recording and side by the paper's identifier.
    pub torque: Vec<ResidualTorque>,
    /// What is left after the verdict.
    pub remainder: Option<Remainder>,
    /// The side on which the mismatch sits, when the wheel speeds tell.
    pub side: Option<Word>,
    /// A network that lowers what is left; not a cause.
    pub residual_model: Option<ResidualModel>,
}

/// A stretch of a recording in which a signal mismatches the calibrated simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Span {
    /// Name of the recording.
    pub recording: String,
    /// Which signal.
    pub signal: String,
    /// Side of the signal, if it has one.
    pub side: Option<Word>,
    /// From, until, s.
    pub interval: [f64; 2],
    /// 90 % interval of the onset, s; `None` when it was there from the start.
    pub onset: Option<[f64; 2]>,
    /// 90 % interval of the end, s; `None` when it lasted to the end.
    pub end: Option<[f64; 2]>,
    /// Fall of the negative log-likelihood by this stretch, nats.
    pub gain: f64,
}

/// Torque that acts on a side's wheels beyond the calibrated model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResidualTorque {
    /// Name of the recording.
    pub recording: String,
    /// Side.
    pub side: Word,
    /// Mean over the recording, N m; positive drives forward.
    pub mean: f64,
    /// Root mean square of half-second means, N m.
    pub rms: f64,
    /// Where 95 % of the references' half-second means lie in such driving, N m.
    pub band: [f64; 2],
    /// When it leaves what the references show.
    pub spans: Vec<Span>,
    /// What is proved about the identifier that followed it.
    pub certificate: TorqueCertificate,
}

/// The mean-square bound of the identifier over a recording, against zero weights.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TorqueCertificate {
    /// Whether the bound holds.
    pub holds: bool,
    /// `Σ h x̃²` of the wheel speed's part that the model does not explain, rad²/s.
    pub error_energy: f64,
    /// Its bound, rad²/s.
    pub bound: f64,
    /// Largest relative residual of the exact identity over all steps.
    pub identity: f64,
}

/// What the best answer leaves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Remainder {
    /// Share of the mismatch that is left, as in [`crate::Diagnosis::unexplained`].
    pub share: f64,
    /// Each signal's share of what is left beyond fault-free driving, largest first.
    pub by_signal: Vec<(String, f64)>,
    /// Where it shows, in words ("on the left side"); `None` when what is left does not stand out
    /// from fault-free driving.
    pub place: Option<String>,
    /// Driving that holds most of it.
    pub regime: Option<Regime>,
}

/// A kind of driving.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Regime {
    /// "speed" or "turning".
    pub by: Word,
    /// Unit of the limits.
    pub unit: Word,
    /// From, until; the last may be infinite, written as null.
    #[serde(deserialize_with = "open_ended")]
    pub range: [f64; 2],
    /// Share of what is left that sits in it.
    pub share: f64,
    /// Share of the time driven in it.
    pub time: f64,
}

fn open_ended<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    let [from, until] =
        <(f64, Option<f64>)>::deserialize(from).map(|(from, until)| [from, until.unwrap_or(f64::INFINITY)])?;
    Ok([from, until])
}

/// The paper's network as a model of what the verdict leaves: a better simulator, not a cause.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResidualModel {
    /// Always "not a cause".
    pub standing: Word,
    /// Inputs of the network with their scales: `input / scale` goes in.
    pub inputs: Vec<(Word, f64)>,
    /// First layer: threshold, then one weight per input, for each logistic unit.
    pub first_layer: Vec<Vec<f64>>,
    /// Torque of each side that adds to the command: one weight per unit, then a constant, N m.
    pub weights: [Vec<f64>; 2],
    /// Root mean squared wheel-speed error on left-out recordings without and with it, rad/s.
    pub wheel_speed: [f64; 2],
    /// The same of the yaw rate, rad/s.
    pub yaw_rate: [f64; 2],
}

/// A place in the data where the mismatch shows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Which signal.
    pub signal: String,
    /// Side of the signal, if it has one.
    pub side: Option<Word>,
    /// Mean squared mismatch of the calibrated model, divided by that of left-out references in
    /// the same kind of driving.
    pub ratio: f64,
    /// Recording and interval in which it is largest, s.
    pub recording: String,
    /// From, until, s.
    pub interval: [f64; 2],
    /// Probability that a fault-free case shows as much.
    pub p: f64,
    /// Whether it stands out from the references, with 5 % of false discoveries over all signals.
    pub significant: bool,
}

/// Mean mismatch in a range of speed, turning, slip or heading, or at a place on the ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// "speed" (|forward velocity|), "turning" (yaw rate), "slip" (the faster side's |slip speed|), "heading" or "place".
    pub by: Word,
    /// Unit of the range.
    pub unit: Word,
    /// Range; of a place, those of x and y.
    pub range: Vec<[f64; 2]>,
    /// Seconds of driving in it.
    pub seconds: f64,
    /// Mean squared mismatch of all signals, divided by that of the references in such driving.
    pub ratio: f64,
    /// Probability that fault-free driving shows as much; segments are the independent blocks.
    pub p: f64,
    /// Whether it stands out, with 5 % of false discoveries over all cells (Benjamini and Yekutieli).
    pub significant: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// JSON knows no infinity.
    #[test]
    fn the_fastest_range_of_driving_is_written_without_an_end_and_read_back_so() {
        for (range, text) in [([0.5, f64::INFINITY], "[0.5,null]"), ([0.25, 0.5], "[0.25,0.5]")] {
            let regime = Regime { by: "speed".into(), unit: "m/s".into(), range, share: 0.7, time: 0.2 };
            let json = serde_json::to_string(&regime).expect("plain data");
            assert!(json.contains(&format!(r#""range":{text}"#)), "{json}");
            assert_eq!(serde_json::from_str::<Regime>(&json).expect("as written"), regime);
        }
    }
}
