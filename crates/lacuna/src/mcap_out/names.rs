//! Topics: names that stand in a message path of Foxglove without quotes.

use verdict::{Cause, Compared, Diagnosis, Trace, Verdict};

/// The topic of all sentences.
pub(super) const VERDICT: &str = "/verdict";

/// A name of the program's own with letters, digits and underscores only.
pub(super) fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect()
}

/// A recording's name, so that no two of them become one: what a message path cannot hold becomes its code point.
pub(super) fn of_recording(name: &str) -> String {
    let allowed = |c: char| c.is_ascii_alphanumeric() || "_-/".contains(c);
    name.chars().map(|c| if allowed(c) { c.to_string() } else { format!("-u{:x}-", u32::from(c)) }).collect()
}

/// The topic of something about a recording.
pub(super) fn of_run(recording: &str, what: &str) -> String {
    format!("/{}/{what}", of_recording(recording))
}

/// A signal with its side: "left wheel speed".
pub(super) fn with_side(signal: &str, side: Option<&str>) -> String {
    match side {
        Some(side) if !signal.contains(side) => format!("{side} {signal}"),
        _ => signal.to_owned(),
    }
}

/// The topic of a compared signal.
pub(super) fn of_signal(trace: &Trace, channel: &Compared) -> String {
    of_run(&trace.recording, &plain(&with_side(&channel.signal, channel.side.as_deref())))
}

/// The topic of the state of something in a recording: a signal, a cause.
pub(super) fn of_state(recording: &str, what: &str) -> String {
    of_run(recording, &format!("state/{}", plain(what)))
}

/// The causes that the verdict names: those that are more likely than not, and what the simulation is corrected by.
pub(super) fn named(diagnosis: &Diagnosis) -> impl Iterator<Item = &Cause> {
    let explained = diagnosis.verdict == Verdict::Explained;
    let effects = &diagnosis.correction.effects;
    let corrects = |c: &Cause| effects.iter().any(|e| e.effect == c.effect);
    let causes = diagnosis.ranked.iter().filter(|c| !["none", "unknown"].contains(&c.effect.as_str()));
    causes.filter(move |c| explained && (c.probability > 0.5 || corrects(c)))
}
