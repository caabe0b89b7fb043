//! The tables of the study.

use pages::page::{Cell, Tone};
use robot_model::paper::Structured;
use sim::learning::{Contender, HORIZONS, Score, Tried};

use super::Outcome;
use super::figures::{OTHER_WAY, all_laps, median, same_way, violated};
use crate::document::{Section, number, toned};
use crate::output::Figure;

/// What is asked and what was found.
pub(super) fn judged(figures: &[Figure]) -> Section {
    let note = "Medians over the draws of ratios within a draw. Unseen laps: the two that go the same way round as the \
                training, unless said otherwise.";
    let mut section = Section::new("What is asked", note, &["figure", "found", "asked", ""]);
    for f in figures {
        let verdict = match f.pass {
            None => "".into(),
            Some(true) => toned("met", Tone::Good),
            Some(false) => toned("MISSED", Tone::Bad),
        };
        let asked = f.target.clone().unwrap_or_default();
        section.rows.push(vec![f.name.as_str().into(), number(Some(f.value)).into(), asked.into(), verdict]);
    }
    section
}

/// All others.
pub(super) fn all(o: &Outcome) -> Vec<Section> {
    let mut sections = vec![
        laps(&o.tried),
        frozen(o),
        ahead("Running ahead with what is kept, rms in rad/s", KEPT, &o.tried, |s, lap| s.ahead_kept[lap]),
        ahead("Running ahead with what acts, rms in rad/s", ACTING, &o.tried, |s, lap| s.ahead_acting[lap]),
        certificates(o),
        steady(o),
    ];
    sections.extend(constants(o));
    sections
}

const KEPT: &str = "The model runs on its own from the estimated speeds, with the torques as held and the weights that the \
    training left. Starts every 0.5 s; horizons that span the change of the ground at 12 s are left out for all, because \
    nothing announces it. Eq. 8 is also given the body's state at the start.";
const ACTING: &str = "The same with the weights that act at the start, after following the lap until then: a constant \
    regressor then simply holds the speed.";

fn row(tried: &Tried, cells: impl IntoIterator<Item = f64>) -> Vec<Cell> {
    let mut row: Vec<Cell> = vec![tried.contender.name().into()];
    row.extend(cells.into_iter().map(|v| Cell::from(pages::text_table::number(v))));
    row
}

fn laps(tried: &[Tried]) -> Section {
    let note = "RMSE against the true speeds in rad/s, five times the paper's loop; the indices of Table 1 are those of lap 1.";
    let header =
        ["law", "lap 1", "lap 2", "lap 3", "lap 4", "lap 5", "5 over 1", "all", "x3max", "x4max", "x3R", "x4R"];
    let mut section = Section::new("Five laps", note, &header);
    for t in tried {
        let mut cells: Vec<f64> = (0..5).map(|i| median(t, |s| s.lap[i])).collect();
        cells.push(median(t, |s| s.lap[4] / s.lap[0]));
        cells.push(median(t, all_laps));
        cells.extend((0..4).map(|i| median(t, |s| s.table1[i])));
        section.rows.push(row(t, cells));
    }
    section
}

fn frozen(o: &Outcome) -> Section {
    let note = "RMSE in rad/s. Frozen: d/dt x^ = -a x^ + W'phi with the weights that the training left. Hindsight: with the \
                best weights for that lap, which nobody has beforehand. Online: following and learning on.";
    let names: Vec<String> = o.study.unseen().iter().map(|c| c.name.to_owned()).collect();
    let mut header = vec!["law".to_owned()];
    header.extend(names.iter().map(|n| format!("frozen, {n}")));
    header.extend(names.iter().map(|n| format!("hindsight, {n}")));
    header.extend(names.iter().map(|n| format!("online, {n}")));
    let mut section = Section::new("Unseen laps", note, &header.iter().map(String::as_str).collect::<Vec<_>>());
    for t in &o.tried {
        let frozen = (0..names.len()).map(|lap| median(t, |s| s.frozen[lap]));
        let online = (0..names.len()).map(|lap| median(t, |s| s.online[lap]));
        let hindsight = (0..names.len()).map(|lap| median(t, |s| s.hindsight[lap]));
        section.rows.push(row(t, frozen.chain(hindsight).chain(online)));
    }
    section
}

fn ahead(
    title: &str,
    note: &str,
    tried: &[Tried],
    of: impl Fn(&Score, usize) -> [f64; HORIZONS.len()] + Copy,
) -> Section {
    let mut header = vec!["law".to_owned()];
    header.extend(HORIZONS.iter().map(|h| format!("{h} s, same way")));
    header.extend(HORIZONS.iter().map(|h| format!("{h} s, other way")));
    let mut section = Section::new(title, note, &header.iter().map(String::as_str).collect::<Vec<_>>());
    for t in tried {
        let same = (0..HORIZONS.len()).map(|h| median(t, |s| same_way(|lap| of(s, lap)[h])));
        let other = (0..HORIZONS.len()).map(|h| median(t, |s| of(s, OTHER_WAY)[h]));
        section.rows.push(row(t, same.chain(other)));
    }
    section
}

fn certificates(o: &Outcome) -> Section {
    let note = "Every step of every lap is certified against zero and against random weights: largest relative residual, and \
                runs in which a balance or a mean-square bound failed.";
    let mut section = Section::new("Certificates", note, &["law", "runs", "largest residual", "violated"]);
    for t in &o.tried {
        let largest = t.scores.iter().map(|s| s.residual).fold(0.0, f64::max);
        let violated = violated(t);
        let tone = if violated == 0 { Tone::Good } else { Tone::Bad };
        section.rows.push(vec![
            t.contender.name().into(),
            t.scores.len().to_string().into(),
            format!("{largest:.0e}").into(),
            toned(violated.to_string(), tone),
        ]);
    }
    section
}

/// The study on ground that stays as it is.
fn steady(o: &Outcome) -> Section {
    let note = "The same laps without the rise of the rolling resistance, rad/s, same way round. One set of constants of Eq. 8 \
                cannot stand for two grounds; on one ground it predicts.";
    let header =
        ["law", "lap 1", "lap 5", "frozen", "kept 0.1 s", "kept 0.5 s", "kept 2 s", "acting 0.5 s", "acting 2 s"];
    let mut section = Section::new("On ground that stays as it is", note, &header);
    for t in &o.steady {
        let kept = |h: usize| median(t, |s| same_way(|lap| s.ahead_kept[lap][h]));
        let acting = |h: usize| median(t, |s| same_way(|lap| s.ahead_acting[lap][h]));
        let frozen = median(t, |s| same_way(|lap| s.frozen[lap]));
        let cells =
            [median(t, |s| s.lap[0]), median(t, |s| s.lap[4]), frozen, kept(0), kept(1), kept(2), acting(1), acting(2)];
        section.rows.push(row(t, cells));
    }
    section
}

/// The physical constants that Eq. 8 with memory returns.
fn constants(o: &Outcome) -> Option<Section> {
    let of = |tried: &[Tried]| {
        let t = tried.iter().find(|t| t.contender == Contender::StructuredMemory)?;
        let each: Vec<[Structured<f64>; 2]> = t.scores.iter().filter_map(|s| s.constants).collect();
        let value = |side: usize, i: usize| sim::statistics::median(each.iter().map(|c| c[side].to_array()[i]));
        Some([0, 1].map(|side| std::array::from_fn::<f64, 7, _>(|i| value(side, i))))
    };
    let (steady, changing) = (of(&o.steady)?, of(&o.tried)?);
    let truth = Structured::of(o.study.training().robot.constants()).to_array();
    let note = "Medians over the noise after five laps, left and right wheel. On changing ground a2 + a6 is a mean of two \
                values (0.594 and 3.54 N m) and the others pay for it. a5, a7 and a8 hardly show on these laps: at constant \
                speed and radius their terms are constant too; there the estimate stays near its first guess, set A.";
    let header = ["constant", "true", "steady, left", "steady, right", "changing, left", "changing, right"];
    let mut section = Section::new("The constants of Eq. 8", note, &header);
    let names = ["a1, kg m2", "a3, N m", "a4, kg m", "a5, kg m", "a2 + a6, N m", "a7, kg m", "a8, kg m"];
    for (i, name) in names.into_iter().enumerate() {
        let values = [truth[i], steady[0][i], steady[1][i], changing[0][i], changing[1][i]];
        let mut row: Vec<Cell> = vec![name.into()];
        row.extend(values.map(|v| Cell::from(pages::text_table::number(v))));
        section.rows.push(row);
    }
    Some(section)
}
