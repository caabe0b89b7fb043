//! Figures of a set with what is asked of them.

use examiner::speed::{Sight, SpeedKind};

use super::score::{ANGLE, EventScore, Row};
use crate::blind::drawn::List;
use crate::blind::score::statistics::median;
use crate::document::Section;
use crate::output::Asked::{AtLeast, AtMost};
use crate::output::Figure;

/// All figures.
pub(super) fn figures(rows: &[Row]) -> Vec<Figure> {
    let of = |kind: SpeedKind| rows.iter().filter(move |r| r.kind == kind);
    let hidden = || rows.iter().filter(|r| r.kind != SpeedKind::FaultFree);
    let events = |kind: SpeedKind| {
        rows.iter().flat_map(move |r| r.events.iter().filter(move |e| e.kind == kind).map(move |e| (r, e)))
    };
    let mut list = List::default();
    list.share("nothing hidden: alarmed", Some(AtMost(0.02)), of(SpeedKind::FaultFree).map(|r| r.answered));
    list.share("refused", Some(AtMost(0.0)), rows.iter().map(|r| r.verdict == "refused"));
    list.share("something hidden: answered", Some(AtLeast(0.7)), hidden().map(|r| r.answered));
    list.share("answered: headline right", Some(AtLeast(0.9)), hidden().filter(|r| r.answered).map(|r| r.right));
    list.share("headline contradicts a sentence", Some(AtMost(0.0)), rows.iter().map(|r| r.contradicts));

    list.share("standing: found", Some(AtLeast(0.95)), events(SpeedKind::Standing).map(|(_, e)| e.is_found));
    let leads = |(r, _): &(&Row, &EventScore)| r.classes.first().is_some_and(|c| c.iter().any(|id| id == "standing"));
    let stood = events(SpeedKind::Standing).filter(|(_, e)| e.is_found).collect::<Vec<_>>();
    list.share("standing, found: leads", Some(AtLeast(1.0)), stood.iter().map(leads));
    let onsets: Vec<f64> = stood.iter().filter_map(|(_, e)| e.onset).map(f64::abs).collect();
    list.value("standing: error of the onset, median", median(&onsets), "s", AtMost(2.0));
    list.share("standing: onset within 4 s", Some(AtLeast(0.9)), onsets.iter().map(|o| *o <= 4.0));

    for (sight, least) in Sight::ALL.into_iter().zip([0.95, 0.9, 0.75]) {
        let seen = events(SpeedKind::Slope).filter(move |(r, _)| r.sight == sight);
        list.share(&format!("slope, {}: found", sight.name()), Some(AtLeast(least)), seen.map(|(_, e)| e.is_found));
    }
    let told = || events(SpeedKind::Slope).filter(|(_, e)| e.is_found);
    let angles = told().filter_map(|(_, e)| e.degrees);
    list.share("slope, angle told: within 1 degree", Some(AtLeast(0.9)), angles.map(|d| d.abs() <= ANGLE));
    list.share("slope, found: wrong sign", Some(AtMost(0.0)), told().map(|(_, e)| e.wrong_sign));

    for kind in [SpeedKind::SoftGround, SpeedKind::SlipperyGround, SpeedKind::Payload, SpeedKind::DraggingSide] {
        list.share(&format!("{}: in the leading class", kind.name()), None, of(kind).map(|r| r.right));
        list.share(
            &format!("{}: in a leading class of three at most", kind.name()),
            Some(AtLeast(0.9)),
            of(kind).map(|r| r.right_class),
        );
    }
    let crossed = || events(SpeedKind::Crossing);
    list.share("crossing: found", None, crossed().map(|(_, e)| e.is_found));
    let on_time = |(_, e): (&Row, &EventScore)| e.onset.is_some_and(|o| o.abs() <= 2.5);
    list.share("crossing: found within 2.5 s", Some(AtLeast(0.9)), crossed().map(on_time));
    let grounds = || rows.iter().flat_map(|r| r.events.iter().filter_map(|e| e.ground));
    list.share("several grounds: each a finding of its own", None, grounds().map(|[found, _]| found));
    let told = || grounds().filter(|[found, _]| *found);
    list.share("several grounds, found: cause in its class", Some(AtLeast(0.9)), told().map(|[_, right]| right));
    let minutes = 2.6 * rows.len() as f64;
    let invented: usize = rows.iter().map(|r| r.invented).sum();
    list.value("invented changes per 30 min", Some(30.0 * invented as f64 / minutes.max(1.0)), "", AtMost(1.0));

    let held = rows.iter().flat_map(|r| (0..r.held[1]).map(|k| k < r.held[0]));
    let all: Vec<bool> = held.collect();
    list.share("90 % intervals of straight load and track that hold", Some(AtLeast(0.86)), all.iter().copied());
    list.share("the same, not too wide", Some(AtMost(0.94)), all.iter().copied());
    let seconds: Vec<f64> = rows.iter().filter_map(|r| r.processor_seconds).collect();
    list.value("time of a case on one core, median", median(&seconds), "s", AtMost(3.0));
    list.0
}

/// Every case that is wrong.
pub(super) fn wrong(rows: &[Row]) -> Section {
    let mut wrong = Section::new(
        "Cases that are not right",
        "Of a case in which nothing is hidden: alarmed; of others: another leading class, or none.",
        &["case", "hidden", "recorded", "verdict", "leading class"],
    );
    let is_wrong = |r: &&Row| if r.kind == SpeedKind::FaultFree { r.answered } else { !r.right };
    for r in rows.iter().filter(is_wrong) {
        let class = r.classes.first().map_or(String::new(), |c| c.join(", "));
        let cells = [r.case.clone(), r.kind.name().to_owned(), r.sight.name().to_owned(), r.verdict.clone(), class];
        wrong.rows.push(cells.map(Into::into).to_vec());
    }
    wrong
}
