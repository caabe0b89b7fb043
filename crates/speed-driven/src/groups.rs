//! Recordings that show no one value of a load, or of the track: which of them agree, and what could be behind each group.
//!
//! Recordings on two grounds, or before and after a payload was taken on, have no cause together. Those whose intervals overlap
//! in every quantity of which the recordings show no one value are one group, named by its own differences alone.

use verdict::{Loads, Quantity, Ratio, RecordingGroup};

use crate::compare::{Judgement, judgement};
use crate::comparison::Comparison;
use crate::found::{fitting, tracks as tracks_alone};
use crate::grounds::Usual;
use crate::name::{Difference, Named, Open, name};

/// A quantity of which the recordings show no one value: those that show least and most of it.
pub(crate) struct Disagreement<'a> {
    pub(crate) quantity: Quantity,
    pub(crate) least: &'a Ratio,
    pub(crate) most: &'a Ratio,
}

/// Quantities of which the recordings show no one value, more than they vary from run to run.
pub(crate) fn disagreements(loads: &Loads) -> Vec<Disagreement<'_>> {
    let mut quantities: Vec<Quantity> = loads.ratios.iter().map(|r| r.quantity).collect();
    quantities.sort_unstable();
    quantities.dedup();
    let is_pooled = |quantity: &Quantity| loads.pooled.iter().any(|r| r.quantity == *quantity);
    // Sides differ with what lies under each: that is no ground of its own.
    quantities.retain(|quantity| !quantity.is_difference() && !is_pooled(quantity));

    let of = |quantity: Quantity| {
        let own: Vec<&Ratio> = loads.ratios.iter().filter(|r| r.quantity == quantity && r.firm).collect();
        let pairs = own.iter().flat_map(|least| own.iter().map(move |most| (*least, *most)));
        // What one recording shows at two speeds is no disagreement of recordings.
        let apart = pairs.filter(|(least, most)| {
            least.recording != most.recording && least.ratio < most.ratio && !overlap(least, most)
        });
        let (least, most) = apart.max_by(|a, b| (a.1.ratio / a.0.ratio).total_cmp(&(b.1.ratio / b.0.ratio)))?;
        Some(Disagreement { quantity, least, most })
    };
    quantities.into_iter().filter_map(of).collect()
}

/// Whether recordings that show no one value of a load agree once an answer is taken off each: a drag on one side shows in
/// turns to one side the other way round.
pub(crate) fn explains(named: &Named, comparison: &Comparison, loads: &Loads) -> bool {
    let rest = |r: &Ratio| {
        let expected = comparison.expected(named, r)?;
        Some(Ratio { interval: r.interval.map(|end| end / expected.exp()), ..r.clone() })
    };
    let agree =
        |d: &Disagreement<'_>| rest(d.least).zip(rest(d.most)).is_some_and(|(least, most)| overlap(&least, &most));
    disagreements(loads).iter().all(agree)
}

fn overlap(a: &Ratio, b: &Ratio) -> bool {
    a.interval[0] <= b.interval[1] && b.interval[0] <= a.interval[1]
}

/// Groups of recordings that agree, and what could be behind each; none where all agree. A recording that is too short to show
/// what the others disagree about is in no group.
pub(crate) fn groups(loads: &Loads, differences: &[Difference], usual: &Usual<'_>, open: Open) -> Vec<RecordingGroup> {
    let of = |recordings: Vec<String>| {
        let own: Vec<Difference> = differences.iter().filter(|d| recordings.contains(&d.recording)).cloned().collect();
        let differing: Vec<&Ratio> =
            loads.ratios.iter().filter(|r| recordings.contains(&r.recording) && is_difference(r)).collect();
        let (tracks, of_loads): (Vec<&Ratio>, Vec<&Ratio>) =
            differing.iter().copied().partition(|r| r.quantity == Quantity::EffectiveTrack);
        let causes = match (tracks.first(), of_loads.is_empty()) {
            (None, true) => Vec::new(),
            // A track is no load: no effect of the robot's loads is to be asked for.
            (Some(track), true) => tracks_alone(track, loads.gyro.is_some()).into_iter().map(|c| c.effect).collect(),
            (_, false) => {
                let comparison = Comparison::new(&own, usual.robot, usual.sigma, usual.calibrated);
                let naming = comparison.and_then(|c| name(&c, open));
                fitting(naming.as_ref()).into_iter().flat_map(Named::ids).map(str::to_owned).collect()
            }
        };
        RecordingGroup { recordings, differs: !differing.is_empty(), causes }
    };
    agreeing(loads).into_iter().map(of).collect()
}

/// Whether a ratio asks for a cause.
fn is_difference(r: &Ratio) -> bool {
    r.firm && judgement(r) == Judgement::Differs
}

/// Recordings each of which agrees with all others of its group about everything that some disagree about.
fn agreeing(loads: &Loads) -> Vec<Vec<String>> {
    let disagreements = disagreements(loads);
    let Some(first) = disagreements.first() else { return Vec::new() };
    let of = |recording: &str, quantity: Quantity| -> Vec<&Ratio> {
        loads.ratios.iter().filter(|r| r.recording == recording && r.quantity == quantity && r.firm).collect()
    };
    let agree = |a: &str, b: &str| {
        disagreements.iter().all(|d| {
            let (here, there) = (of(a, d.quantity), of(b, d.quantity));
            here.iter().all(|a| there.iter().all(|b| overlap(a, b)))
        })
    };

    // Neighbours on the scale of the first quantity are the likeliest to agree.
    let mut known: Vec<&Ratio> = loads.ratios.iter().filter(|r| r.quantity == first.quantity && r.firm).collect();
    known.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
    let others = loads.ratios.iter().filter(|r| r.firm && disagreements.iter().any(|d| d.quantity == r.quantity));
    let mut out: Vec<Vec<String>> = Vec::new();
    for recording in known.into_iter().chain(others).map(|r| &r.recording) {
        if out.iter().any(|group| group.contains(recording)) {
            continue;
        }
        match out.iter_mut().find(|group| group.iter().all(|other| agree(other, recording))) {
            Some(group) => group.push(recording.clone()),
            None => out.push(vec![recording.clone()]),
        }
    }
    // Told in the order in which they were given.
    let place = |recording: &String| loads.ratios.iter().position(|r| r.recording == *recording);
    for group in &mut out {
        group.sort_by_key(place);
    }
    out
}
