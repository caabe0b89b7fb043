//! Loads of the recordings over those of the references, with honest intervals.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::steady::extract::{CLASSES, Load, Quantity};

/// 90 % of a Gaussian lies within this many sigmas.
pub(crate) const NINETY: f64 = 1.645;

/// A load over the references'.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ratio {
    /// Recording, or several joined by a comma when they are pooled.
    pub recording: String,
    /// What is compared.
    pub quantity: Quantity,
    /// Mean speeds at the tyres of the inner and the outer side, m/s.
    pub speed: [f64; 2],
    /// Value in the unit of the quantity.
    pub value: f64,
    /// Half of its 90 % interval.
    pub half: f64,
    /// Ratio to the references (difference for the asymmetry).
    pub ratio: f64,
    /// 90 % interval of it.
    pub interval: [f64; 2],
    /// Steady driving behind it, s.
    pub seconds: f64,
    /// Ten seconds or more.
    pub firm: bool,
    /// The references were driven at another speed.
    pub other_speed: bool,
}

/// A reference value of a quantity: logarithm (or value), its standard error, its speeds.
#[derive(Debug, Clone)]
pub(crate) struct Reference {
    pub(crate) quantity: Quantity,
    pub(crate) class: usize,
    /// Logarithm, or the value itself for a difference.
    pub(crate) centre: f64,
    pub(crate) error: f64,
    pub(crate) speed: [f64; 2],
}

/// Seconds of steady driving that make an answer firm.
const FIRM: f64 = 10.0;

/// The scale on which a load is compared: its logarithm, or itself.
pub(crate) fn scaled(l: &Load) -> (f64, f64) {
    if l.quantity.is_difference() {
        (l.value, l.error)
    } else {
        (l.value.abs().max(1e-9).ln(), l.error / l.value.abs().max(1e-9))
    }
}

fn class(l: &Load) -> usize {
    match l.quantity {
        Quantity::StraightLoad | Quantity::Asymmetry => {
            let v = 0.5 * (l.speed[0] + l.speed[1]).abs();
            CLASSES.windows(2).position(|c| v >= c[0] && v < c[1]).unwrap_or(0)
        }
        _ => 0,
    }
}

/// Pools the references' loads per quantity and speed class.
pub(crate) fn references(loads: &[Load]) -> Vec<Reference> {
    let mut groups: BTreeMap<(Quantity, usize), Vec<&Load>> = BTreeMap::new();
    for l in loads {
        groups.entry((l.quantity, class(l))).or_default().push(l);
    }
    groups
        .into_iter()
        .map(|((quantity, class), list)| {
            let (mut w, mut sum, mut speed) = (0.0, 0.0, [0.0; 2]);
            for l in list {
                let (centre, error) = scaled(l);
                let weight = 1.0 / (error.powi(2) + quantity.scatter().powi(2));
                w += weight;
                sum += weight * centre;
                speed[0] += weight * l.speed[0];
                speed[1] += weight * l.speed[1];
            }
            Reference { quantity, class, centre: sum / w, error: w.powf(-0.5), speed: speed.map(|s| s / w) }
        })
        .collect()
}

/// The reference a load is compared with: of its own speed class, else of the nearest.
pub(crate) fn matching<'a>(l: &Load, references: &'a [Reference]) -> Option<(&'a Reference, bool)> {
    references
        .iter()
        .filter(|r| r.quantity == l.quantity)
        .min_by_key(|r| r.class.abs_diff(class(l)))
        .map(|r| (r, r.class != class(l)))
}

/// Every load over its reference, and pooled where recordings agree.
pub(crate) fn ratios(loads: &[Load], references: &[Reference]) -> (Vec<Ratio>, Vec<Ratio>) {
    let mut singles = Vec::new();
    let mut groups: BTreeMap<Quantity, Vec<(&Load, &Reference, bool)>> = BTreeMap::new();
    for l in loads {
        // The sum of arcs is for recordings whose straight load is not known.
        let parted = l.quantity == Quantity::ArcSum
            && loads.iter().any(|o| o.recording == l.recording && o.quantity == Quantity::TurningLoad);
        let Some((r, other)) = matching(l, references).filter(|_| !parted) else { continue };
        let (centre, error) = scaled(l);
        let e = (error.powi(2) + l.quantity.scatter().powi(2) + r.error.powi(2)).sqrt();
        singles.push(ratio(l.recording.clone(), l, centre - r.centre, e, other));
        groups.entry(l.quantity).or_default().push((l, r, other));
    }
    let mut pooled = Vec::new();
    for (quantity, list) in groups {
        if list.len() < 2 {
            continue;
        }
        let n = list.len() as f64;
        let d: Vec<f64> = list.iter().map(|(l, r, _)| scaled(l).0 - r.centre).collect();
        let w: Vec<f64> = list.iter().map(|(l, ..)| 1.0 / (scaled(l).1.powi(2) + quantity.scatter().powi(2))).collect();
        let total: f64 = w.iter().sum();
        let mean = d.iter().zip(&w).map(|(d, w)| d * w).sum::<f64>() / total;
        let sd = (d.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
        // Recordings that differ by more than twice the usual scatter are not one load.
        if sd > 2.0 * quantity.scatter() {
            continue;
        }
        let sd = sd.max(quantity.scatter());
        let inverse: f64 = list.iter().map(|(l, ..)| scaled(l).1.powi(-2)).sum();
        let reference = list.iter().map(|(_, r, _)| r.error).fold(0.0, f64::max);
        let e = (sd * sd / n + 1.0 / inverse + reference.powi(2)).sqrt();
        let names: Vec<&str> = list.iter().map(|(l, ..)| l.recording.as_str()).collect();
        let mut sample = list[0].0.clone();
        sample.seconds = list.iter().map(|(l, ..)| l.seconds).sum();
        sample.speed = [0, 1].map(|j| list.iter().map(|(l, ..)| l.speed[j]).sum::<f64>() / n);
        let own = list.iter().zip(&w).map(|((l, ..), w)| scaled(l).0 * w).sum::<f64>() / total;
        sample.value = if quantity.is_difference() { own } else { own.exp() };
        sample.error = (sd * sd / n + 1.0 / inverse).sqrt() * if quantity.is_difference() { 1.0 } else { sample.value };
        pooled.push(ratio(names.join(", "), &sample, mean, e, list.iter().any(|l| l.2)));
    }
    (singles, pooled)
}

fn ratio(recording: String, l: &Load, d: f64, e: f64, other_speed: bool) -> Ratio {
    let of = |x: f64| if l.quantity.is_difference() { x } else { x.exp() };
    Ratio {
        recording,
        quantity: l.quantity,
        speed: l.speed,
        value: l.value,
        half: NINETY * l.error,
        ratio: of(d),
        interval: [of(d - NINETY * e), of(d + NINETY * e)],
        seconds: l.seconds,
        firm: l.seconds >= FIRM,
        other_speed,
    }
}
