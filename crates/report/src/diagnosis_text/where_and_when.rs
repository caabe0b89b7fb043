//! Where and when a mismatch shows, and the torque that the model lacks, for people.

use crate::words::{borders, range};
use verdict::{Cell, Diagnosis, ResidualTorque, Span};

use crate::sections::heading;
use pages::text_table::{TextTable, number};

/// What cells are ranges of, in the order of the table.
const AXES: [&str; 5] = ["speed", "turning", "slip", "heading", "place"];

/// All of it; nothing when nothing stands out from the references.
pub(super) fn render(d: &Diagnosis) -> String {
    place(d) + &time(d) + &torque(d)
}

/// One row per axis: how many cells stand out, and the worst.
fn place(d: &Diagnosis) -> String {
    let mut table = TextTable::new(&["by", ">shows in", "most", ">ratio"]);
    let mut any = false;
    let shown: Vec<_> = d.findings.iter().filter(|f| f.significant).collect();
    if let Some(worst) = shown.first() {
        any = true;
        let count = format!("{} of {}", shown.len(), d.findings.len());
        table.row(["signal".to_owned(), count, worst.signal.clone(), format!("{:.1}", worst.ratio)]);
    }
    for by in AXES {
        let all: Vec<&Cell> = d.cells.iter().filter(|c| c.by == by).collect();
        let found: Vec<&&Cell> = all.iter().filter(|c| c.significant).collect();
        let Some(worst) = found.iter().max_by(|a, b| a.ratio.total_cmp(&b.ratio)) else { continue };
        any = true;
        let count = format!("{} of {}", found.len(), all.len());
        table.row([by.to_owned(), count, range(worst), format!("{:.1}", worst.ratio)]);
    }
    if !any {
        return String::new();
    }
    let title = "Where it shows (ratio: mean squared mismatch, divided by that of the references; \
                 5 % false discoveries)";
    format!("\n{}{}", heading(title), table.render())
}

/// Rows per recording: from when until when, by the signal that tells most.
fn time(d: &Diagnosis) -> String {
    let all = &d.located.spans;
    let gain = |signal: &str| all.iter().filter(|s| s.signal == signal).map(|s| s.gain).sum::<f64>();
    let best = |own: &[&Span]| {
        own.iter().map(|s| s.signal.clone()).max_by(|a, b| gain(a).total_cmp(&gain(b))).unwrap_or_default()
    };
    let mut table = TextTable::new(&["recording", "from (90 %)", "until (90 %)", "signal"]);
    for own in all.chunk_by(|a, b| a.recording == b.recording) {
        let own: Vec<&Span> = own.iter().collect();
        let signal = best(&own);
        for s in own.into_iter().filter(|s| s.signal == signal) {
            let [from, until] = borders(s);
            table.row([s.recording.clone(), from, until, signal.clone()]);
        }
    }
    if all.is_empty() {
        return String::new();
    }
    format!("\n{}{}", heading("When it shows"), table.render())
}

/// Recordings whose residual torque leaves the references' band.
fn torque(d: &Diagnosis) -> String {
    let all = &d.located.torque;
    let mut table = TextTable::new(&["recording", ">left, N m", ">right, N m", "outside the range of the references"]);
    let mut names: Vec<&str> = Vec::new();
    for t in all {
        let own: Vec<&ResidualTorque> = all.iter().filter(|o| o.recording == t.recording).collect();
        if names.contains(&t.recording.as_str()) || own.iter().all(|o| o.spans.is_empty()) {
            continue;
        }
        names.push(&t.recording);
        let mean =
            |side: &str| own.iter().find(|o| o.side == side).map_or(String::new(), |o| format!("{:+.2}", o.mean));
        let outside: Vec<String> = own
            .iter()
            .filter_map(|o| o.spans.first().map(|s| (o, s)))
            .map(|(o, s)| format!("{} {:.1}-{:.1} s", o.side, s.interval[0], s.interval[1]))
            .collect();
        table.row([t.recording.clone(), mean("left"), mean("right"), outside.join(", ")]);
    }
    if names.is_empty() {
        return String::new();
    }
    let certified = if all.iter().all(|t| t.certificate.holds) {
        "its proven error bound holds"
    } else {
        "its error bound DOES NOT HOLD"
    };
    let title = format!("Torque that the model lacks (mean, learnt by the online neural identifier; {certified})");
    format!("\n{}{}", heading(&title), table.render())
}

/// What the residual network does, in a sentence.
pub(super) fn network(d: &Diagnosis) -> String {
    d.located.residual_model.as_ref().map_or(String::new(), |m| {
        let [without, with] = m.wheel_speed;
        format!(
            "\nA network fitted to what is left ({}) lowers the wheel-speed error on left-out \
             recordings from {} to {} rad/s \
             (weights in the JSON).\n",
            m.standing,
            number(without),
            number(with)
        )
    })
}
