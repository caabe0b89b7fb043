//! A mapping proposed from what a bag holds: by message types and joint names, every inference named.

use recordings::{Contents, TopicContents};

mod columns;
mod draft;
mod joints;
mod robots;
#[cfg(test)]
mod tests;
mod torques;

pub use columns::columns;
pub(crate) use draft::holds;
use draft::{Draft, Line, fields};

/// A mapping file, and what was inferred on the way and should be looked at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Proposal {
    /// The mapping as TOML, with the inferences as comments.
    pub toml: String,
    /// What was inferred, in sentences.
    pub inferred: Vec<String>,
}

const FIRST_LINE: &str =
    "Proposed by `lacuna check --write-mapping`. Look at each of these before you believe a diagnosis:";

/// Proposes a mapping; `None` if no topic holds anything that the vocabulary has a word for.
pub fn mapping(name: &str, contents: &Contents) -> Option<Proposal> {
    let mut topics: Vec<&TopicContents> = contents.topics.iter().collect();
    topics.sort_by_key(|topic| draft::rank(topic));
    let several = robots::first(&mut topics);
    let mut draft = Draft::default();
    let entries: Vec<(&TopicContents, Vec<Line>)> =
        topics.into_iter().map(|topic| (topic, draft.lines(topic))).filter(|(_, lines)| !lines.is_empty()).collect();
    if entries.is_empty() {
        return None;
    }
    let unset = entries.iter().filter(|(topic, _)| has_stamp(topic) && !stamped(topic));
    let unset = unset.map(|(topic, _)| format!("{}: log times taken, header.stamp is 0 in every message", topic.name));
    let inferred: Vec<String> = several.into_iter().chain(draft.inferred()).chain(unset).collect();
    let mut out = vec![format!("# {FIRST_LINE}")];
    out.extend(inferred.iter().map(|sentence| format!("# - {sentence}")));
    out.push(format!("name = {}", quoted(name)));
    for (topic, lines) in &entries {
        let time = if stamped(topic) { "header.stamp" } else { "log_time" };
        out.push(format!("\n[[files]]\ntopic = {}", quoted(&topic.name)));
        out.push(format!("time = {{ column = \"{time}\"{} }}\n\n[files.signals]", rate(topic)));
        out.extend(lines.iter().map(|line| {
            let optional = if line.optional { ", optional = true" } else { "" };
            format!("{} = {{ column = {}, unit = \"{}\"{optional} }}", line.signal, quoted(&line.field), line.unit)
        }));
    }
    let toml = out.join("\n") + "\n";
    Some(Proposal { toml, inferred })
}

/// The nominal rate as the mapping writes it; nothing where the stamps do not say.
fn rate(topic: &TopicContents) -> String {
    let (from, to) = topic.log_time_ns;
    let seconds = (to - from) as f64 * 1e-9;
    if topic.count < 2 || seconds <= 0.0 {
        return String::new();
    }
    let rate = (topic.count - 1) as f64 / seconds;
    // Half a hertz is what a name-plate rate is rounded to.
    let rate = if rate > 5.0 { (2.0 * rate).round() / 2.0 } else { (100.0 * rate).round() / 100.0 };
    if rate > 0.0 { format!(", rate_hz = {rate}") } else { String::new() }
}

/// Whether a topic has header stamps, and its driver sets them.
fn stamped(topic: &TopicContents) -> bool {
    let unset = topic.stamps.as_ref().is_some_and(|stamps| stamps.set == 0);
    !unset && has_stamp(topic)
}

fn has_stamp(topic: &TopicContents) -> bool {
    fields(topic).iter().any(|f| f.path == "header.stamp")
}

/// A TOML string.
fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}
