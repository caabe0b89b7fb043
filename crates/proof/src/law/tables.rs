//! What came out, as figures and tables.

use inference::robust::median;
use verdict::Claim;

use super::adopted::Adopted;
use super::events::EventScore;
use super::judge::Judged;
use crate::blind::Rate;
use crate::document::Section;
use crate::output::{Asked, Figure};

/// Figures that the command asks for.
const KIND: f64 = 0.75;
const PLACE: f64 = 0.85;
const CLOSED: [f64; 2] = [0.90, 0.88];
const FALSE_LAWS: f64 = 0.01;

/// Of robots with a law of another grammar.
const TOLD_FOREIGN: f64 = 0.5;
const CLOSED_FOREIGN: f64 = 0.85;
const OVER_NAME: f64 = 0.1;
const ALIKE: f64 = 0.1;
const CURVES: f64 = 0.3;
const WRONG_FOREIGN: f64 = 0.03;

/// Of laws that every drive has, once adopted.
const FALLS: f64 = 0.8;
const RISES: f64 = 0.02;

const SIDE_OF_EVENTS: f64 = 0.95;
const RECALL: f64 = 0.6;
const PRECISION: f64 = 0.75;

fn hidden(all: &[Judged]) -> impl Iterator<Item = &Judged> {
    all.iter().filter(|j| j.hidden.is_some() && !j.is_outside)
}

fn told(all: &[Judged]) -> impl Iterator<Item = &Judged> {
    hidden(all).filter(|j| j.claim == Some(Claim::Law))
}

fn share(rate: Rate) -> f64 {
    rate.share().unwrap_or(0.0)
}

/// Flat list of what was measured.
pub(super) fn figures(all: &[Judged]) -> Vec<Figure> {
    let of = |name: &str, rate: Rate| Figure::free(name, share(rate), "");
    let is_told = |j: &Judged| matches!(j.claim, Some(Claim::Law));
    let are_events = |j: &Judged| matches!(j.claim, Some(Claim::Events));
    let claimed = |j: &&Judged| matches!(j.claim, Some(Claim::Law | Claim::Place));
    let lack_nothing = || all.iter().filter(|j| j.hidden.is_none());
    let mut out = vec![
        Figure::free("robots with a name left out", hidden(all).count() as f64, ""),
        of("a law is told", hidden(all).map(is_told).collect()),
        of("kind right, of laws told", told(all).map(|j| j.kind_right).collect()).asked(Asked::AtLeast(KIND)),
        of(
            "place or side right, of laws and places told",
            hidden(all).filter(claimed).map(|j| j.place_right).collect(),
        )
        .asked(Asked::AtLeast(PLACE)),
    ];
    for (q, quantity) in ["wheel speed", "yaw rate"].into_iter().enumerate() {
        for (m, model) in ["the law", "the best other name", "re-tuning"].into_iter().enumerate() {
            let middle = median(told(all).filter_map(|j| j.closed.map(|c| c[m][q]))).unwrap_or(0.0);
            let figure = Figure::free(format!("median gap closed by {model}, {quantity}"), middle, "");
            out.push(if m == 0 { figure.asked(Asked::AtLeast(CLOSED[q])) } else { figure });
        }
    }
    out.push(Figure::free("robots that lack nothing", lack_nothing().count() as f64, ""));
    out.push(
        of("told a law that lack nothing", lack_nothing().map(is_told).collect()).asked(Asked::AtMost(FALSE_LAWS)),
    );
    out.push(
        of("told events that lack nothing", lack_nothing().map(are_events).collect()).asked(Asked::AtMost(FALSE_LAWS)),
    );
    out.push(Figure::free("told events where a name was left out", share(hidden(all).map(are_events).collect()), ""));

    let outside = || all.iter().filter(|j| j.is_outside && j.events.is_none() && j.foreign.is_none());
    let has_place = |j: &&Judged| j.place.is_some();
    out.extend([
        Figure::free("robots with another cause outside the vocabulary", outside().count() as f64, ""),
        of("a place is told there", outside().map(|j| j.place.is_some()).collect()),
        of("place right, of places told there", outside().filter(has_place).map(|j| j.place_right).collect())
            .asked(Asked::AtLeast(PLACE)),
        of("told a place that lack nothing", lack_nothing().map(|j| j.place.is_some()).collect())
            .asked(Asked::AtMost(FALSE_LAWS)),
    ]);

    out.extend(of_foreign(all));
    let events: Vec<&EventScore> = all.iter().filter_map(|j| j.events.as_ref()).collect();
    let told = || events.iter().filter(|e| e.told);
    let sum = |k: usize| told().map(|e| e.windows[k]).sum::<usize>() as f64;
    out.extend([
        Figure::free("robots with short events", events.len() as f64, ""),
        of("events are told", events.iter().map(|e| e.told).collect()),
        of("side right, of events told", told().map(|e| e.side_right).collect()).asked(Asked::AtLeast(SIDE_OF_EVENTS)),
        Figure::free("windows of 0.1 s with an event that are found", sum(2) / sum(0).max(1.0), "")
            .asked(Asked::AtLeast(RECALL)),
        Figure::free("windows of 0.1 s told that have an event", sum(2) / sum(1).max(1.0), "")
            .asked(Asked::AtLeast(PRECISION)),
    ]);
    out
}

/// What was found of laws of another grammar; nothing where none was hidden.
fn of_foreign(all: &[Judged]) -> Vec<Figure> {
    let of = |name: &str, rate: Rate| Figure::free(name, share(rate), "");
    let robots: Vec<&Judged> = all.iter().filter(|j| j.foreign.is_some()).collect();
    if robots.is_empty() {
        return Vec::new();
    }
    let is_told = |j: &Judged| matches!(j.claim, Some(Claim::Law));
    let told: Vec<&Judged> = robots.iter().copied().filter(|j| is_told(j)).collect();
    let is_alike = |j: &&Judged| j.foreign.as_ref().and_then(|f| f.curve).is_some_and(|c| c <= ALIKE);
    let is_worse = |j: &Judged| j.foreign.as_ref().is_some_and(|f| f.is_worse_than_name);
    let closed =
        |of: &dyn Fn([[f64; 2]; 3]) -> f64| median(told.iter().filter_map(|j| j.closed.map(of))).unwrap_or(0.0);
    let wrong = robots.iter().map(|j| is_told(j) && (!j.place_right || is_worse(j))).collect();
    let mut out = vec![
        Figure::free("robots with a law of another grammar", robots.len() as f64, ""),
        of("a law is told there", robots.iter().map(|j| is_told(j)).collect()).asked(Asked::AtLeast(TOLD_FOREIGN)),
        of("place right, of laws told there", told.iter().map(|j| j.place_right).collect())
            .asked(Asked::AtLeast(PLACE)),
    ];
    for (q, quantity) in ["wheel speed", "yaw rate"].into_iter().enumerate() {
        out.push(
            Figure::free(format!("median gap closed by the law there, {quantity}"), closed(&|c| c[0][q]), "")
                .asked(Asked::AtLeast(CLOSED_FOREIGN)),
        );
        out.push(
            Figure::free(format!("median beyond the best name there, {quantity}"), closed(&|c| c[0][q] - c[1][q]), "")
                .asked(Asked::AtLeast(OVER_NAME)),
        );
    }
    out.push(
        of("law within 10 % of the hidden one, rms, of laws told there", told.iter().map(is_alike).collect())
            .asked(Asked::AtLeast(CURVES)),
    );
    out.push(
        of("a wrong law is told there: at another place, or worse than the best name", wrong)
            .asked(Asked::AtMost(WRONG_FOREIGN)),
    );
    out
}

/// What adopted laws are worth; nothing where none was drawn.
pub(super) fn of_adopted(all: &[Adopted]) -> Vec<Figure> {
    if all.is_empty() {
        return Vec::new();
    }
    let of = |name: &str, rate: Rate| Figure::free(name, share(rate), "");
    let told = || all.iter().filter(|a| a.told.is_some());
    vec![
        Figure::free("robots with a law of another grammar in every drive", all.len() as f64, ""),
        of("a law is told to be lacking in every drive", all.iter().map(|a| a.told.is_some()).collect()),
        of("further drives are forecast better with it", told().map(Adopted::falls).collect())
            .asked(Asked::AtLeast(FALLS)),
        of("further drives are forecast worse with it", told().map(Adopted::rises).collect())
            .asked(Asked::AtMost(RISES)),
    ]
}

/// The same by robot.
pub(super) fn adopted(all: &[Adopted]) -> Option<Section> {
    let note = "Error of the re-tuned simulation in further drives, with the law over without it.";
    let mut out = Section::new("In every drive", note, &["hidden", "told place", "formula", "wheel speed", "yaw rate"]);
    out.rows = all
        .iter()
        .map(|a| {
            let [place, formula] = a.told.clone().unwrap_or_default();
            let [wheel, yaw] = a.over_before.map_or_else(Default::default, |shares| shares.map(|s| format!("{s:.3}")));
            [a.hidden.clone(), place, formula, wheel, yaw].map(Into::into).to_vec()
        })
        .collect();
    (!out.rows.is_empty()).then_some(out)
}

/// Tables for people.
pub(super) fn all(all: &[Judged], figures: &[Figure]) -> Vec<Section> {
    let mut summary =
        Section::new("A law for what has no name", "One name of the catalogue left out.", &["what", "value"]);
    for f in figures {
        summary.rows.push(vec![f.name.as_str().into(), format!("{:.2}", f.value).into()]);
    }
    let header = ["hidden", "claim", "told place", "formula", "place", "kind", "gap closed: law", "name", "re-tuned"];
    let mut cases = Section::new("Cases", "Gap closed: wheel speed, yaw rate.", &header);
    for j in all {
        let closed = |m: usize| j.closed.map_or(String::new(), |c| format!("{:.2} {:.2}", c[m][0], c[m][1]));
        let mark = |right: bool| if right { "right" } else { "wrong" };
        cases.rows.push(vec![
            j.hidden.as_deref().unwrap_or("nothing").into(),
            j.claim
                .map_or("not asked", |c| match c {
                    Claim::Law => "law",
                    Claim::Events => "events",
                    Claim::Place => "place",
                    Claim::Nothing => "nothing",
                })
                .into(),
            j.place.as_deref().unwrap_or_default().into(),
            j.formula.as_str().into(),
            mark(j.place_right).into(),
            mark(j.kind_right).into(),
            closed(0).into(),
            closed(1).into(),
            closed(2).into(),
        ]);
    }
    vec![summary, cases]
}
