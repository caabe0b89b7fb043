//! Changes that the program found, beside what the accelerometer says.

use serde_json::{Value, json};

use super::ask::{Answer, interval};
use super::witness::{Tilted, Witness};

/// A stretch in which the witness tilts, and what the program made of it.
#[derive(Debug, Clone)]
pub(super) struct SeenTilt {
    pub(super) tilted: Tilted,
    pub(super) outcome: Outcome,
    /// Errors of onset and end, s; `None` where turns or stops hide the moment.
    pub(super) onset: Option<f64>,
    pub(super) end: Option<f64>,
    /// Error of the angle, degrees; `None` for a bound.
    pub(super) angle: Option<f64>,
    /// A bound that the witness contradicts.
    pub(super) contradicted: bool,
    /// One cause was left.
    pub(super) decided: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    Found,
    /// Told as a tilt that decides nothing.
    Tentative,
    /// Told as a stretch in which nothing could be seen.
    Hidden,
    Missed,
}

/// A change that the program claims.
#[derive(Debug, Clone)]
pub(super) struct Claim {
    pub(super) interval: [f64; 2],
    /// Slope and half of its 90 % interval, degrees; an upper bound if `bound`.
    pub(super) slope: f64,
    pub(super) half: f64,
    pub(super) bound: bool,
    pub(super) causes: Vec<String>,
    /// Mean of the witness over it, degrees.
    pub(super) witness: Option<f64>,
}

impl Claim {
    /// The witness averages below one degree: nothing was there.
    pub(super) fn is_false(&self) -> bool {
        self.causes.iter().any(|c| c == "grade") && self.witness.is_some_and(|w| w.abs() < 1.0)
    }

    /// Whether the stated interval holds the witness.
    pub(super) fn holds(&self) -> Option<bool> {
        let w = self.witness?;
        Some(if self.bound { w <= self.slope + ABOUT } else { (w - self.slope).abs() <= self.half })
    }
}

/// What the tilt is itself known to, degrees.
const ABOUT: f64 = 0.5;
/// A moment bracketed more widely than this was hidden, s.
const BRACKET: f64 = 1.0;
/// Share of a stretch that was reported as hidden.
const MOSTLY: f64 = 0.5;

fn overlap(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[1].min(b[1]) - a[0].max(b[0])).max(0.0)
}

/// The program's changes of a recording.
pub(super) fn claims(answer: &Answer, witness: &Witness) -> Vec<Claim> {
    let claim = |c: &Value| {
        let span = interval(&c["interval"]);
        Claim {
            interval: span,
            slope: c["slope"].as_f64().unwrap_or(f64::NAN),
            half: c["slope_half"].as_f64().unwrap_or(f64::NAN),
            bound: c["bound"].as_bool().unwrap_or(false),
            causes: c["causes"].as_array().into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect(),
            witness: witness.mean_slope(span),
        }
    };
    answer.changes("found").iter().map(claim).collect()
}

/// Every stretch in which the witness tilts, with what the program said of it; `hides` if turns hide slopes from it.
pub(super) fn seen(answer: &Answer, witness: &Witness, hides: bool) -> Vec<SeenTilt> {
    witness.tilted().into_iter().map(|t| one(t, answer, witness, hides)).collect()
}

fn one(tilted: Tilted, answer: &Answer, witness: &Witness, hides: bool) -> SeenTilt {
    let length = tilted.interval[1] - tilted.interval[0];
    let best = answer
        .changes("found")
        .iter()
        .map(|c| (overlap(interval(&c["interval"]), tilted.interval), c))
        .filter(|(o, _)| *o > 0.0)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let hidden: f64 = answer.changes("hidden").iter().map(|h| overlap(interval(&h["interval"]), tilted.interval)).sum();
    let tentative: f64 =
        answer.changes("tentative").iter().map(|c| overlap(interval(&c["interval"]), tilted.interval)).sum();
    let Some((_, change)) = best else {
        let outcome = if tentative > MOSTLY * length {
            Outcome::Tentative
        } else if hides && hidden > MOSTLY * length {
            Outcome::Hidden
        } else {
            Outcome::Missed
        };
        return SeenTilt { tilted, outcome, onset: None, end: None, angle: None, contradicted: false, decided: false };
    };
    let moment = |what: &str, truth: f64| {
        let [a, b] = interval(&change[what]);
        (b - a < BRACKET).then(|| (0.5 * (a + b) - truth).abs())
    };
    let slope = change["slope"].as_f64().unwrap_or(f64::NAN);
    let bound = change["bound"].as_bool().unwrap_or(false);
    let there = witness.mean_slope(interval(&change["interval"])).unwrap_or(tilted.slope);
    SeenTilt {
        tilted,
        outcome: Outcome::Found,
        onset: moment("onset", tilted.interval[0]),
        end: moment("end", tilted.interval[1]),
        angle: (!bound).then(|| (slope - there).abs()),
        contradicted: bound && there > slope + ABOUT,
        decided: change["causes"].as_array().is_some_and(|c| c.len() == 1),
    }
}

/// For the recording's file.
pub(super) fn as_json(seen: &[SeenTilt], claims: &[Claim]) -> Value {
    let seen: Vec<Value> = seen
        .iter()
        .map(|s| {
            json!({
                "interval": s.tilted.interval, "slope_deg": s.tilted.slope, "outcome": format!("{:?}", s.outcome).to_lowercase(),
                "onset_error_s": s.onset, "end_error_s": s.end, "angle_error_deg": s.angle,
                "bound_contradicted": s.contradicted, "cause_decided": s.decided,
            })
        })
        .collect();
    let claims: Vec<Value> = claims
        .iter()
        .map(|c| {
            json!({
                "interval": c.interval, "slope_deg": c.slope, "half_90_deg": c.half, "bound": c.bound, "causes": c.causes,
                "witness_deg": c.witness, "witness_inside": c.holds(), "false": c.is_false(),
            })
        })
        .collect();
    json!({ "witness_tilts": seen, "claims": claims })
}
