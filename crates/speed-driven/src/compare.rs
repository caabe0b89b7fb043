//! Loads of the recordings over those of the references, with honest intervals.

use std::collections::BTreeMap;
use verdict::{Load, Loads, Quantity, Ratio};

use crate::model::{Operating, predicted};
use crate::pieces;
use crate::settings::{MEASURING, NAMING, measuring::Ratios, measuring::Scatter};
use inference::robust::NINETY;
use robot_model::Robot;

const RATIOS: Ratios = MEASURING.ratios;
const SCATTER: Scatter = MEASURING.scatter;

/// A reference value of a quantity: logarithm (or value), its standard error, its speeds.
#[derive(Debug, Clone)]
pub(crate) struct Reference {
    pub(crate) quantity: Quantity,
    pub(crate) class: usize,
    /// Logarithm, or the value itself for a difference.
    pub(crate) centre: f64,
    pub(crate) error: f64,
    pub(crate) speed: [f64; 2],
    /// Share of it in which the right side was the outer one.
    pub(crate) right_outer: f64,
}

impl Reference {
    /// Where and how it was driven.
    pub(crate) fn at(&self) -> Operating {
        Operating { quantity: self.quantity, speed: self.speed, right_outer: self.right_outer }
    }
}

/// What the interval of a ratio says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Judgement {
    /// It contains no difference.
    Alike,
    /// It excludes that, but drive trains between cold and warm differ as much.
    Unnamed,
    /// It excludes both.
    Differs,
}

pub(crate) fn judgement(r: &Ratio) -> Judgement {
    let [a, b] = r.interval;
    let none = no_difference(r.quantity);
    let unnamed = NAMING.priors.unnamed_straight;
    if a <= none && none <= b {
        Judgement::Alike
    } else if r.quantity == Quantity::StraightLoad && a < unnamed && b > 1.0 / unnamed {
        Judgement::Unnamed
    } else {
        Judgement::Differs
    }
}

/// The ratio, or difference, of what is alike.
pub(crate) fn no_difference(quantity: Quantity) -> f64 {
    if quantity.is_difference() { 0.0 } else { 1.0 }
}

/// Scatter of a quantity from run to run, one sigma on the scale on which it is compared.
pub(crate) fn scatter(quantity: Quantity) -> f64 {
    match quantity {
        Quantity::StraightLoad => SCATTER.straight,
        Quantity::EffectiveTrack => SCATTER.track,
        Quantity::Asymmetry => SCATTER.asymmetry,
        Quantity::SpinAsymmetry => SCATTER.spin_asymmetry,
        Quantity::Drift => SCATTER.drift,
        Quantity::TurningLoad | Quantity::ArcSum | Quantity::SpinSum => SCATTER.turning,
    }
}

/// How many sigmas a ratio is away from no difference.
pub(crate) fn sigmas(r: &Ratio) -> f64 {
    let scale = |x: f64| if r.quantity.is_difference() { x } else { x.max(1e-9).ln() };
    let [a, b] = r.interval.map(scale);
    scale(r.ratio).abs() / ((b - a) / (2.0 * NINETY)).max(1e-9)
}

/// The ratios that sentences tell: pooled ones, and of single recordings those that no pooled one stands for.
pub(crate) fn reported(loads: &Loads) -> impl Iterator<Item = &Ratio> {
    let stands_for =
        |p: &Ratio, r: &Ratio| p.quantity == r.quantity && p.recording.split(", ").any(|n| n == r.recording);
    let single = move |r: &&Ratio| !loads.pooled.iter().any(|p| stands_for(p, r));
    loads.pooled.iter().chain(loads.ratios.iter().filter(single))
}

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
        Quantity::StraightLoad | Quantity::Asymmetry => pieces::class(0.5 * (l.speed[0] + l.speed[1]).abs()),
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
            let (mut w, mut sum, mut speed, mut right_outer) = (0.0, 0.0, [0.0; 2], 0.0);
            for l in list {
                let (centre, error) = scaled(l);
                let weight = 1.0 / (error.powi(2) + scatter(quantity).powi(2));
                w += weight;
                sum += weight * centre;
                speed[0] += weight * l.speed[0];
                speed[1] += weight * l.speed[1];
                right_outer += weight * l.right_outer;
            }
            let (centre, error) = (sum / w, w.powf(-0.5));
            Reference { quantity, class, centre, error, speed: speed.map(|s| s / w), right_outer: right_outer / w }
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

/// By how much a load differs from its reference because the robot drove at other speeds, by its laws: on the scale on which they are
/// compared.
fn by_speeds(l: &Load, r: &Reference, robot: &Robot<f64>) -> f64 {
    predicted(robot, &[], Operating::of(l)) - predicted(robot, &[], r.at())
}

/// Every load over its reference, and pooled where recordings agree. Intervals hold the ratio at the speeds that were driven, and what the
/// laws of the robot make of it at those of the references.
pub(crate) fn ratios(loads: &[Load], references: &[Reference], robot: &Robot<f64>) -> (Vec<Ratio>, Vec<Ratio>) {
    let mut singles = Vec::new();
    let mut groups: BTreeMap<Quantity, Vec<(&Load, &Reference, bool)>> = BTreeMap::new();
    for l in loads {
        // The sum of arcs is for recordings whose straight load is not known.
        let parted = l.quantity == Quantity::ArcSum
            && loads.iter().any(|o| o.recording == l.recording && o.quantity == Quantity::TurningLoad);
        let Some((r, other)) = matching(l, references).filter(|_| !parted) else { continue };
        let (centre, error) = scaled(l);
        let e = (error.powi(2) + scatter(l.quantity).powi(2) + r.error.powi(2)).sqrt();
        singles.push(ratio(l.recording.clone(), l, centre - r.centre, (e, by_speeds(l, r, robot)), other));
        groups.entry(l.quantity).or_default().push((l, r, other));
    }
    let mut pooled = Vec::new();
    for (quantity, list) in groups {
        if list.len() < 2 {
            continue;
        }
        let n = list.len() as f64;

        let d: Vec<f64> = list.iter().map(|(l, r, _)| scaled(l).0 - r.centre).collect();
        let w: Vec<f64> = list.iter().map(|(l, ..)| 1.0 / (scaled(l).1.powi(2) + scatter(quantity).powi(2))).collect();
        let total: f64 = w.iter().sum();
        let mean = d.iter().zip(&w).map(|(d, w)| d * w).sum::<f64>() / total;
        let sd = (d.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
        // Recordings that differ by more than the usual scatter are not one load.
        if sd > RATIOS.most_spread * scatter(quantity) {
            continue;
        }

        let sd = sd.max(scatter(quantity));
        let inverse: f64 = list.iter().map(|(l, ..)| scaled(l).1.powi(-2)).sum();
        let reference = list.iter().map(|(_, r, _)| r.error).fold(0.0, f64::max);
        let e = (sd * sd / n + 1.0 / inverse + reference.powi(2)).sqrt();

        // One load stands for all of them.
        let mut names: Vec<&str> = list.iter().map(|(l, ..)| l.recording.as_str()).collect();
        names.dedup();
        let mut sample = list[0].0.clone();
        sample.seconds = list.iter().map(|(l, ..)| l.seconds).sum();
        sample.speed = [0, 1].map(|j| list.iter().map(|(l, ..)| l.speed[j]).sum::<f64>() / n);
        let own = list.iter().zip(&w).map(|((l, ..), w)| scaled(l).0 * w).sum::<f64>() / total;
        sample.value = if quantity.is_difference() { own } else { own.exp() };
        sample.error = (sd * sd / n + 1.0 / inverse).sqrt() * if quantity.is_difference() { 1.0 } else { sample.value };
        let shifts = list.iter().zip(&w).map(|((l, r, _), w)| w * by_speeds(l, r, robot));
        let shift = shifts.sum::<f64>() / total;
        let mut joint = ratio(names.join(", "), &sample, mean, (e, shift), list.iter().any(|l| l.2));
        let outer = || list.iter().map(|(l, ..)| l.speed[1]);
        joint.range = [outer().fold(f64::MAX, f64::min), outer().fold(0.0, f64::max)];
        pooled.push(joint);
    }
    (singles, pooled)
}

fn ratio(recording: String, l: &Load, d: f64, (e, by_speeds): (f64, f64), other_speed: bool) -> Ratio {
    let of = |x: f64| if l.quantity.is_difference() { x } else { x.exp() };
    Ratio {
        recording,
        quantity: l.quantity,
        speed: l.speed,
        range: [l.speed[1]; 2],
        value: l.value,
        half: NINETY * l.error,
        ratio: of(d),
        interval: [of(d - by_speeds.max(0.0) - NINETY * e), of(d - by_speeds.min(0.0) + NINETY * e)],
        seconds: l.seconds,
        firm: l.seconds >= RATIOS.firm,
        other_speed,
    }
}

/// Steady driving of the recordings behind the loads that are compared, straight and turning, s.
pub(crate) fn steady_seconds(loads: &Loads) -> [f64; 2] {
    let of = |straight: bool| {
        let own = loads.ratios.iter().filter(|r| match r.quantity {
            Quantity::StraightLoad => straight,
            Quantity::TurningLoad | Quantity::ArcSum | Quantity::SpinSum => !straight,
            Quantity::EffectiveTrack | Quantity::Asymmetry | Quantity::SpinAsymmetry | Quantity::Drift => false,
        });
        own.map(|r| r.seconds).fold(0.0, |sum, seconds| sum + seconds)
    };
    [of(true), of(false)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::robot;

    fn load(recording: &str, quantity: Quantity, value: f64, speed: f64) -> Load {
        let (recording, error) = (recording.to_owned(), 0.02 * value);
        Load { recording, quantity, value, error, seconds: 12.0, speed: [speed; 2], right_outer: 0.5 }
    }

    fn pooled(values: &[f64]) -> (Vec<Ratio>, Vec<Ratio>) {
        let reference = references(&[load("ref", Quantity::StraightLoad, 20.0, 0.5)]);
        let loads: Vec<Load> = values
            .iter()
            .enumerate()
            .map(|(i, v)| load(&format!("run_{i}"), Quantity::StraightLoad, *v, 0.5))
            .collect();
        ratios(&loads, &reference, &robot())
    }

    #[test]
    fn recordings_that_agree_are_pooled_and_narrow_the_interval() {
        let (singles, pooled) = pooled(&[40.0, 41.0, 39.0]);
        assert_eq!((singles.len(), pooled.len()), (3, 1));
        let p = &pooled[0];
        approx::assert_relative_eq!(p.ratio, 2.0, max_relative = 0.01);
        assert_eq!((p.recording.as_str(), p.seconds), ("run_0, run_1, run_2", 36.0));
        assert!(p.firm && !p.other_speed);
        let width = |r: &Ratio| r.interval[1] - r.interval[0];
        assert!(p.interval[0] < 2.0 && 2.0 < p.interval[1]);
        assert!(width(p) < width(&singles[0]));
    }

    #[test]
    fn recordings_that_differ_are_not_one_load() {
        // Two on the same ground, one on another: nothing is pooled.
        let (singles, pooled) = pooled(&[40.0, 41.0, 60.0]);
        assert_eq!((singles.len(), pooled.len()), (3, 0));
        let scatter = scatter(Quantity::StraightLoad);
        let (_, pooled) = self::pooled(&[40.0, 40.0 * (2.7 * scatter).exp()]);
        assert_eq!(pooled.len(), 1, "a spread below twice the scatter of runs is one load");
    }

    #[test]
    fn one_recording_is_not_pooled() {
        let (singles, pooled) = pooled(&[40.0]);
        assert_eq!((singles.len(), pooled.len()), (1, 0));
    }

    #[test]
    fn a_load_is_compared_within_its_speed_class_where_that_is_possible() {
        let refs = references(&[
            load("slow", Quantity::StraightLoad, 20.0, 0.2),
            load("fast", Quantity::StraightLoad, 30.0, 0.7),
        ]);
        let (same, other) = matching(&load("r", Quantity::StraightLoad, 1.0, 0.8), &refs).expect("a reference");
        assert!(!other);
        approx::assert_relative_eq!(same.centre, 30.0_f64.ln(), epsilon = 1e-12);
        let alone = &refs[..1];
        let (_, other) = matching(&load("r", Quantity::StraightLoad, 1.0, 0.8), alone).expect("a reference");
        assert!(other);
        assert!(matching(&load("r", Quantity::SpinSum, 1.0, 0.8), &refs).is_none());
    }

    #[test]
    fn runs_scatter_more_the_more_the_ground_and_the_drive_train_have_to_do_with_a_quantity() {
        use Quantity::{ArcSum, Asymmetry, EffectiveTrack, SpinSum, StraightLoad, TurningLoad};
        let [track, straight, turning, asymmetry] =
            [EffectiveTrack, StraightLoad, TurningLoad, Asymmetry].map(super::scatter);
        assert!(0.0 < track && track < straight && straight < turning && turning < asymmetry);
        assert_eq!([ArcSum, SpinSum].map(super::scatter), [turning; 2], "turning dominates the sums");
        // Seen between runs on one floor: 1 % (straight), 4 to 5 % (turning); a side keeps up to a fifth of its load.
        assert!(straight > 0.01 && (0.05..0.1).contains(&turning) && asymmetry < 0.2);
    }
}
