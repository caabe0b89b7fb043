//! What a law is worth beside the truth.

use examiner::{EffectTruth, Outsider, Truth};
use serde::Serialize;

use super::events::{EventScore, score};
use super::foreign::{ForeignScore, is_foreign, places};
use super::peers::Compared;
use verdict::{Claim, Diagnosis, LawFreeRun};

/// Effects that are laws: id, symbols of right places, names of right factors (any of them).
///
/// A slope is a force as well, and rolling resistance of all wheels a torque or a force.
pub(super) const LAWS: [(&str, &[&str], &[&str]); 14] = [
    ("viscous_friction", &["T_both", "F_x", "F_xy"], &["pow(omega", "pow(v,", "sgn", "clip", "excess"]),
    ("coulomb_friction", &["T_both", "F_x", "F_xy"], &["sgn", "clip"]),
    ("coulomb_side", &["T_left", "T_right"], &["sgn", "clip"]),
    ("stiction", &["T_both"], &["sgn", "bump", "clip"]),
    ("rolling_resistance", &["T_both", "F_x", "F_xy"], &["sgn", "clip"]),
    ("quadratic_drag", &["F_x", "F_xy", "T_both"], &["pow(v, 2", "pow(omega, 2", "pow(v, 3", "excess", "abs"]),
    ("constant_pull", &["F_x", "slope"], &["F_x = "]),
    ("grade", &["slope", "F_x", "F_y"], &["slope", "heading"]),
    ("thermal_drift", &["T_both", "F_x", "F_xy"], &["rise", "above(t", "sgn"]),
    ("torque_constant", &["T_both"], &["pow(T, 1", "clip(T"]),
    ("drivetrain_ripple", &["T_left", "T_right"], &["cos(phi"]),
    ("adhesion_patch", &["grip"], &["disc"]),
    ("slip_stiffness", &["grip"], &["grip"]),
    ("turning_resistance", &["M_z", "T_both", "grip_lateral"], &["yaw_rate"]),
];

/// Where what is outside the vocabulary acts: beginnings of names of right places.
const OUTSIDE_PLACES: [(&str, &[&str]); 12] = [
    ("shifting_load", &["yaw moment", "grip", "lateral"]),
    ("cogging", &["torque"]),
    ("contact_loss", &["grip", "lateral grip"]),
    ("voltage_sag", &["torque"]),
    ("gusts", &["force", "fore-aft force", "lateral force"]),
    ("delay_jitter", &["torque"]),
    ("grain", &["grip", "lateral grip"]),
    ("ripple", &["torque"]),
    ("torque_dropouts", &["torque"]),
    ("cable", &["force", "fore-aft force", "lateral force"]),
    ("ratchet", &["torque"]),
    ("touching_brake", &["torque"]),
];

/// The id under which truths hold what is outside the vocabulary.
pub(super) const OUTSIDE: &str = "out_of_library";

/// Whether an effect is a law.
pub(super) fn is_law(id: &str) -> bool {
    LAWS.iter().any(|(known, ..)| *known == id)
}

/// A case with its judgement.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Judged {
    /// The hidden effect; `None` where nothing was.
    pub(super) hidden: Option<String>,
    pub(super) claim: Option<Claim>,
    pub(super) formula: String,
    pub(super) place_right: bool,
    /// The place that is told: of a law, of events, or alone.
    pub(super) place: Option<String>,
    pub(super) kind_right: bool,
    /// Share of the gap to the truth that is closed, wheel speed and yaw rate: by the law, the best other name, re-tuning.
    pub(super) closed: Option<[[f64; 2]; 3]>,
    /// Whether what is hidden is outside the vocabulary.
    pub(super) is_outside: bool,
    /// Short events that are hidden, with what was told of them.
    pub(super) events: Option<EventScore>,
    /// A law of another grammar that is hidden, with what the law that was told is worth beside it.
    pub(super) foreign: Option<ForeignScore>,
    /// What other methods made of the same residual series.
    pub(super) peers: Option<Compared>,
}

/// Whether a truth is one of short events.
fn is_short(e: &EffectTruth) -> bool {
    let kind = |o: &Outsider| serde_json::to_value(o).ok().and_then(|v| v.as_str().map(str::to_owned));
    e.id == OUTSIDE && Outsider::EVENTS.iter().any(|o| kind(o) == e.kind)
}

/// Judges a diagnosis.
pub(super) fn judged(truth: &Truth, d: &Diagnosis) -> Judged {
    let hidden = truth.effects.first();
    let law = d.law.as_ref().and_then(|l| l.law.as_ref());
    let formula = law.map_or_else(String::new, |l| l.formula.clone());
    let known = hidden.and_then(|e| LAWS.iter().find(|(id, ..)| *id == e.id));
    let outside = hidden.filter(|e| e.id == OUTSIDE).and_then(|e| e.kind.as_deref());
    let told = d.law.as_ref().and_then(|l| {
        let of_events = l.events.as_ref().map(|e| &e.place);
        l.law.as_ref().map(|l| &l.place).or(of_events).or(l.place.as_ref().map(|p| &p.place))
    });
    let is_there = |kind: &str| {
        let places = OUTSIDE_PLACES.iter().find(|(id, _)| *id == kind).map_or(&[][..], |(_, places)| places);
        told.is_some_and(|told| places.iter().any(|p| told.starts_with(p)))
    };
    let is_foreign_place = |e: &EffectTruth| told.is_some_and(|told| places(e).iter().any(|p| told.starts_with(p)));
    let is_known_place = || {
        known.is_some_and(|(_, places, _)| {
            let place = places.iter().any(|p| formula.starts_with(p));
            let side = hidden.and_then(|e| e.side.as_deref());
            let own = |side: &str| !formula.starts_with("T_") || formula.starts_with(&format!("T_{side}"));
            place && side.is_none_or(own)
        })
    };
    let place_right = match hidden.filter(|e| is_foreign(e)) {
        Some(e) => is_foreign_place(e),
        None => outside.map_or_else(is_known_place, is_there),
    };
    Judged {
        hidden: hidden.map(|e| e.kind.clone().filter(|_| e.id == OUTSIDE).unwrap_or_else(|| e.id.clone())),
        events: hidden.filter(|e| is_short(e)).map(|_| score(truth, d)),
        foreign: None,
        peers: None,
        is_outside: outside.is_some(),
        claim: d.law.as_ref().map(|l| l.claim),
        kind_right: place_right && known.is_some_and(|(.., factors)| factors.iter().any(|f| formula.contains(f))),
        place_right,
        place: told.cloned(),
        closed: law.and_then(|l| closed(truth, &l.free_runs)),
        formula,
    }
}

/// Share of the gap from the model as it is to the truth, over all recordings.
fn closed(truth: &Truth, rows: &[LawFreeRun]) -> Option<[[f64; 2]; 3]> {
    let quantity = |q: usize| {
        let name = ["wheel speed", "yaw rate"][q];
        let own: Vec<&LawFreeRun> = rows.iter().filter(|r| r.quantity.starts_with(name)).collect();
        let rms = |of: &dyn Fn(&LawFreeRun) -> Option<f64>| -> Option<f64> {
            let all: Option<Vec<f64>> = own.iter().map(|r| of(r).map(|e| e * e)).collect();
            all.filter(|all| !all.is_empty()).map(|all| (all.iter().sum::<f64>() / all.len() as f64).sqrt())
        };
        let floor = rms(&|r| truth.recordings.get(&r.recording).map(|t| t.freerun_with_effect[q]))?;
        let nominal = rms(&|r| Some(r.nominal))?;
        let gap = (nominal - floor).max(f64::MIN_POSITIVE);
        let share = |of: &dyn Fn(&LawFreeRun) -> Option<f64>| rms(of).map(|e| (nominal - e) / gap);
        Some([share(&|r| Some(r.law))?, share(&|r| r.named.or(Some(r.retuned)))?, share(&|r| Some(r.retuned))?])
    };
    let (wheel, yaw) = (quantity(0)?, quantity(1)?);
    Some([0, 1, 2].map(|model| [wheel[model], yaw[model]]))
}
