//! A diagnosis for people: the verdict first.

#![allow(
    clippy::format_push_string,
    reason = "text for people: short, and `write!` to a string would ask for a result"
)]

use crate::words::{free_runs as title_of_free_runs, is_no_cause, probability, size, where_and_when as place};
use catalogue::for_people;
use verdict::{Advice, Cause, Claim, Diagnosis};

use crate::sections::{heading, listed};
use pages::text_table::{TextTable, number};

mod where_and_when;

/// Rows of each table at most; everything is in the JSON.
const ROWS: usize = 6;
/// Causes less probable than this are not shown.
const SHOWN: f64 = 0.005;

/// The whole answer, its headings with the codes of a terminal. `lost` and `not_used` are sentences on the input; `mapping`
/// is one that was found to fit, not named.
pub fn render(d: &Diagnosis, lost: &[String], not_used: &[String], mapping: Option<&str>) -> String {
    let mut out = String::new();
    for (i, sentence) in d.sentences.iter().enumerate() {
        out += &if i == 0 { heading(sentence) } else { format!("{sentence}\n") };
    }
    out += &causes(&d.ranked);
    out += &where_and_when::render(d);
    out += &law(d);
    out += &steady(d);
    out += &response(d);
    out += &free_runs(d);
    out += &where_and_when::network(d);
    out += &listed("Answers that the recordings do not permit", &withheld(d));
    out += &listed("The next drive", &d.next.iter().map(next).collect::<Vec<_>>());
    out += &listed("What limits this answer", &d.limits);
    out += &listed("Lost input", lost);
    out += &listed("Not used", not_used);
    let found = |name: &str| format!("{name}, which is built in and fits these bags; --mapping names another");
    out += &listed("Mapping", &mapping.map(found).into_iter().collect::<Vec<_>>());
    out
}

/// The drive that would tell the rivals apart, in a sentence.
fn next(advice: &Advice) -> String {
    let best = advice.best().map(|m| {
        format!(
            "{}: expected to resolve {:.2} of the {:.2} bits of uncertainty about the cause",
            m.name, m.expected_bits, advice.entropy_bits
        )
    });
    match (&advice.withheld, best) {
        (None, Some(best)) => best,
        (Some(reason), _) => reason.clone(),
        (None, None) => "no drive can be suggested".to_owned(),
    }
}

fn causes(ranked: &[Cause]) -> String {
    let mut table = TextTable::new(&["cause", ">probability", "size (90 %)", "where and when"]);
    let shown = ranked.iter().filter(|c| c.probability >= SHOWN || is_no_cause(c));
    for c in shown.take(ROWS + 2) {
        table.row([for_people(&c.name), probability(c.probability), size(c).join(" ").trim().to_owned(), place(c)]);
    }
    format!("\n{}{}", heading("Causes"), table.render())
}

/// A law for what has no name.
fn law(d: &Diagnosis) -> String {
    let Some(cause) = &d.law else { return String::new() };
    let title = match cause.claim {
        Claim::Law => "Not in the catalogue: a law that fits",
        Claim::Events => "Not in the catalogue: events",
        Claim::Place => "Not in the catalogue: where it acts",
        Claim::Nothing => "Not in the catalogue",
    };
    let line = |(label, text): (&str, String)| format!("  {label:<20} {text}\n");
    let lines: String = crate::law::lines(cause).into_iter().map(line).collect();
    format!("\n{}{lines}", heading(title))
}

/// Loads of steady driving over the references'.
fn steady(d: &Diagnosis) -> String {
    let Some(loads) = d.steady.as_ref().filter(|l| !l.ratios.is_empty()) else { return String::new() };
    let mut table =
        TextTable::new(&["recording", "load", ">inner, outer m/s", ">value (90 %)", ">over reference", "90 %", ">s"]);
    for r in &loads.ratios {
        let digits = (1 - r.half.log10().floor() as i32).clamp(0, 4) as usize;
        let value = format!("{:.digits$} ± {:.digits$} {}", r.value, r.half, r.quantity.unit());
        let [l, v] = r.speed;
        let [a, b] = r.interval;
        table.row([
            r.recording.clone(),
            r.quantity.name().to_owned(),
            format!("{l:.2}, {v:.2}"),
            value,
            format!("{:.2}", r.ratio),
            format!("[{a:.2}, {b:.2}]"),
            format!("{:.0}", r.seconds),
        ]);
    }
    format!(
        "\n{}{}",
        heading("Loads: torques that steady driving takes (over reference: ratio; of the asymmetry: difference)"),
        table.render()
    )
}

/// Constants of a command-driven robot's response.
fn response(d: &Diagnosis) -> String {
    let Some(response) = d.response.as_ref().filter(|r| !r.parameters.is_empty()) else { return String::new() };
    let mut table = TextTable::new(&["constant", ">value", ">90 %", "unit", ">simulated", ">error without it"]);
    for p in &response.parameters {
        let half = p.half_width.map_or(String::new(), |h| format!("± {}", number(h)));
        let simulated = p.simulated.map_or("no limit".to_owned(), number);
        let earned = response.elements.iter().find(|e| e.element == p.element);
        let rise = earned.map_or(String::new(), |e| format!("{:+.0} %", 100.0 * e.rise));
        table.row([p.id.to_string(), number(p.value), half, p.unit.to_string(), simulated, rise]);
    }
    let title = format!(
        "Response ({} windows of 2 s in {} command steps; error without it: rise on windows left \
         out of the fit)",
        response.windows, response.steps
    );
    format!("\n{}{}", heading(&title), table.render())
}

fn withheld(d: &Diagnosis) -> Vec<String> {
    let all = d.steady.iter().flat_map(|l| &l.withheld);
    all.map(|w| format!("{}: {}: {}", w.recording, w.quantity.name(), w.reason)).collect()
}

fn free_runs(d: &Diagnosis) -> String {
    let runs = &d.free_runs;
    if runs.is_empty() {
        return String::new();
    }
    let placebo = runs.iter().any(|r| r.placebo.is_some());
    let columns = ["left out", "quantity", ">as it is", ">re-tuned", ">corrected", ">placebo"];
    let mut table = TextTable::new(&columns[..if placebo { 6 } else { 5 }]);
    for r in runs {
        let errors = [Some(r.nominal), Some(r.retuned), Some(r.corrected)];
        let cells = errors.into_iter().chain(placebo.then_some(r.placebo)).map(|e| e.map_or(String::new(), number));
        table.row([r.recording.clone(), r.quantity.clone()].into_iter().chain(cells));
    }
    format!("\n{}{}", heading(title_of_free_runs(d)), table.render())
}
