//! The verdict, and the picture that convinces.

use catalogue::for_people;
use verdict::{Compared, Diagnosis, FreeRun, Trace};

use super::recordings::{plot, rms};
use crate::facts::Facts;
use crate::figure::{Drawing, Figure};
use crate::page::{Cell, Page};
use crate::words::{
    is_no_cause, number, percent, probability, quantities, quantity_and_unit, size_in_words as size, verdict,
    where_and_when,
};

/// Causes that get a place at the top.
const CAUSES: usize = 3;
/// A cause is likely above this.
const LIKELY: f64 = 0.5;
/// Marked stretches that the caption lists.
const SPANS: usize = 4;
/// Letters of a sentence that is too long for a heading.
const LONG: usize = 160;
/// Sentences that follow the verdict at once; the rest stands where it belongs.
const SENTENCES: usize = 2;

/// The sentences of the verdict. What explains a long one stands below the heading.
pub(super) fn heading(d: &Diagnosis) -> Vec<String> {
    if let Some((verdict, _)) = explained(d) {
        return vec![format!("{verdict}.")];
    }
    let sentences = verdict(d, usize::MAX);
    if sentences.iter().all(String::is_empty) { vec!["No answer".to_owned()] } else { sentences }
}

/// A long first sentence, taken apart where its explanation begins.
fn explained(d: &Diagnosis) -> Option<(&str, &str)> {
    let (verdict, why) = d.sentences.first().filter(|s| s.len() > LONG)?.split_once(": ")?;
    // "Missing: ..." is no sentence.
    (verdict.len() > LONG / 4).then_some((verdict, why))
}

/// Sentences that the top does not show.
pub(super) fn further_sentences(d: &Diagnosis) -> &[String] {
    d.sentences.get(heading(d).len() + SENTENCES..).unwrap_or_default()
}

/// Adds all that follows the heading.
pub(super) fn add(page: &mut Page, d: &Diagnosis) {
    if let Some((_, why)) = explained(d) {
        page.lead(&verdict::sentence_case(why));
    }
    for sentence in d.sentences.iter().skip(heading(d).len()).take(SENTENCES) {
        page.lead(sentence);
    }
    page.markup(&facts(d));
    if let Some(figure) = convincing(d) {
        page.figure(&figure);
    }
}

/// The figures that one would repeat to a colleague.
fn facts(d: &Diagnosis) -> String {
    let mut facts = Facts::default();
    let likely: Vec<_> = d.ranked.iter().filter(|c| c.probability > LIKELY).take(CAUSES).collect();
    for c in if likely.is_empty() { d.ranked.iter().take(1).collect() } else { likely } {
        let [value, interval] = size(c);
        let p = format!("probability {}", probability(c.probability));
        if value.is_empty() || is_no_cause(c) {
            facts.add("", &for_people(&c.name), &probability(c.probability), "probability");
        } else {
            let class = d.indistinguishable.iter().find(|class| class.len() > 1 && class.contains(&c.effect));
            let class = class.map_or_else(String::new, |l| format!("cannot be told from {} others", l.len() - 1));
            let parts = [p, interval, where_and_when(c), class];
            let parts: Vec<String> = parts.into_iter().filter(|s| !s.is_empty()).collect();
            facts.add("", &for_people(&c.name), &value, &parts.join(", "));
        }
    }
    if let Some(q) = quantities(&d.free_runs).first() {
        let runs = || d.free_runs.iter().filter(|r| r.quantity == *q);
        let count = runs().count().max(1) as f64;
        let mean = |f: fn(&FreeRun) -> f64| runs().map(f).sum::<f64>() / count;
        let [before, retuned, after] = [mean(|r| r.nominal), mean(|r| r.retuned), mean(|r| r.corrected)];
        let (name, unit) = quantity_and_unit(q);
        let more = format!(
            "corrected, on drives left out: from {} to {} {unit}; re-tuned only: {}",
            number(before),
            number(after),
            number(retuned)
        );
        if before > 0.0 {
            facts.add("after", &format!("error of the {name}"), &percent(after / before), &more);
        }
    }
    if let Some(share) = d.unexplained {
        facts.add("before", "still unexplained", &format!("{:.0} %", 100.0 * share), "of the mismatch");
    }
    facts.markup()
}

/// The signal whose simulation is worst, beside what is left after the correction.
fn convincing(d: &Diagnosis) -> Option<Figure> {
    let all = d.traces.iter().flat_map(|t| t.channels.iter().map(move |c| (t, c)));
    let (trace, channel, _) = all.filter_map(|(t, c)| Some((t, c, mismatch(c)?))).max_by(|a, b| a.2.total_cmp(&b.2))?;
    let mut plot = plot(d, trace, &[channel], false);
    let named: Vec<[f64; 2]> = d
        .ranked
        .iter()
        .filter(|c| c.probability > LIKELY)
        .filter_map(|c| c.intervals.as_ref()?.get(&trace.recording))
        .flatten()
        .copied()
        .collect();
    if !named.is_empty() {
        plot.rows.iter_mut().for_each(|r| r.spans.clone_from(&named));
    }
    let errors: Vec<Option<f64>> =
        [&channel.nominal, &channel.retuned, &channel.corrected].map(|y| rms(&channel.recorded, y)).to_vec();
    Some(Figure {
        title: format!("{} in {}", verdict::sentence_case(&channel.signal), trace.recording),
        caption: caption(trace, channel, &plot.rows[0].spans, &errors),
        table: (
            vec!["rms difference", "as it is", "re-tuned", "corrected"],
            vec![
                std::iter::once(Cell::from(format!("{}, {}", channel.signal, channel.unit)))
                    .chain(errors.iter().map(|e| Cell::from(e.map_or(String::new(), number))))
                    .collect(),
            ],
        ),
        drawing: Drawing::Time(plot),
    })
}

fn caption(trace: &Trace, channel: &Compared, spans: &[[f64; 2]], errors: &[Option<f64>]) -> String {
    let mut out = vec!["The signal in which the simulation as it is fails most.".to_owned()];
    match (errors[0], errors[2]) {
        (Some(before), Some(after)) => {
            out.push(format!("Its rms error falls from {} to {} {}.", number(before), number(after), channel.unit));
        }
        (Some(before), None) => out.push(format!("Its rms error is {} {}.", number(before), channel.unit)),
        _ => {}
    }
    if trace.left_out && errors[2].is_some() {
        out.push("The fit of the correction has not seen this recording.".to_owned());
    }
    if trace.restarts.len() > 1 {
        out.push("Where its line is broken, the simulation starts again from the measured state.".to_owned());
    }
    if !spans.is_empty() {
        let some: Vec<String> = spans.iter().take(SPANS).map(|[a, b]| format!("{a:.1} to {b:.1} s")).collect();
        let more = if spans.len() > SPANS { " and more" } else { "" };
        out.push(format!("Marked below: {}{more}.", some.join(", ")));
    }
    out.join(" ")
}

/// Mismatch of the simulation as it is, in units that make signals comparable: what is usual, else the signal itself.
fn mismatch(c: &Compared) -> Option<f64> {
    let known: Vec<Option<f64>> = c.recorded.clone();
    let mean = known.iter().flatten().sum::<f64>() / known.iter().flatten().count().max(1) as f64;
    let spread = rms(&known, &vec![Some(mean); known.len()]);
    let scale = c.usual.or(spread).filter(|s| *s > 0.0)?;
    Some(rms(&c.recorded, &c.nominal)? / scale)
}
