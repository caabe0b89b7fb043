//! Headings and lists of text for people.

/// Bold, for headings; taken away again where colours are not wanted (`NO_COLOR`, no terminal).
const HEADING: anstyle::Style = anstyle::Style::new().bold();

/// A heading, with the codes of a terminal.
pub fn heading(text: &str) -> String {
    format!("{HEADING}{text}{HEADING:#}\n")
}

/// A list of sentences under a heading; nothing when there are none.
pub fn listed(title: &str, sentences: &[String]) -> String {
    if sentences.is_empty() {
        return String::new();
    }
    format!("\n{}  - {}\n", heading(title), sentences.join("\n  - "))
}
