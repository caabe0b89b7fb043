//! Tables that become a page and Markdown alike.

use report::page::{Cell, Page, Tone};

/// A table with its heading.
#[derive(Debug, Clone, Default)]
pub(super) struct Section {
    pub(super) title: String,
    /// What one must know to read it; may be empty.
    pub(super) note: String,
    pub(super) header: Vec<String>,
    pub(super) rows: Vec<Vec<Cell>>,
}

impl Section {
    pub(super) fn new(title: &str, note: &str, header: &[&str]) -> Self {
        Self {
            title: title.into(),
            note: note.into(),
            header: header.iter().map(|h| (*h).to_owned()).collect(),
            rows: Vec::new(),
        }
    }
}

/// Text in a tone.
pub(super) fn toned(text: impl Into<String>, tone: Tone) -> Cell {
    Cell { text: text.into(), tone }
}

/// A number in a table; `-` where there is none.
pub(super) fn number(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        // Counts, and shares that are all or nothing.
        Some(x) if x.fract() == 0.0 && x.abs() < 1e6 => format!("{x:.0}"),
        Some(x) => lacuna::text_table::number(x),
    }
}

/// Adds sections to a page; those without rows are left out.
pub(super) fn to_page(page: &mut Page, sections: &[Section]) {
    for s in filled(sections) {
        page.heading(&s.title);
        if !s.note.is_empty() {
            page.note(&s.note);
        }
        page.table(&s.header.iter().map(String::as_str).collect::<Vec<_>>(), &s.rows);
    }
}

/// Sections as Markdown; those without rows are left out.
pub(super) fn to_markdown(title: &str, intro: &str, sections: &[Section]) -> String {
    let line = |cells: &mut dyn Iterator<Item = String>| format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "));
    let mut out = format!("# {title}\n\n{intro}\n");
    for s in filled(sections) {
        out += &["\n## ", &s.title, "\n\n"].concat();
        if !s.note.is_empty() {
            out += &[&s.note, "\n\n"].concat();
        }
        out += &line(&mut s.header.iter().map(|h| plain(h)));
        out += &line(&mut (0..s.header.len()).map(|i| if i == 0 { "---" } else { "---:" }.to_owned()));
        for row in &s.rows {
            out += &line(&mut row.iter().map(marked));
        }
    }
    out
}

fn filled(sections: &[Section]) -> impl Iterator<Item = &Section> {
    sections.iter().filter(|s| !s.rows.is_empty())
}

/// Bad news are bold, as on the page.
fn marked(cell: &Cell) -> String {
    let text = plain(&cell.text);
    if cell.tone == Tone::Bad && !text.is_empty() { format!("**{text}**") } else { text }
}

/// Text that does not end a cell.
fn plain(text: &str) -> String {
    text.replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use report::page::Tone;

    use super::{Section, to_markdown, toned};

    #[test]
    fn sections_become_markdown_tables() {
        let mut s = Section::new("Found", "", &["what", "n"]);
        s.rows.push(vec!["a|b".into(), toned("3", Tone::Bad)]);
        let empty = Section::new("Nothing", "", &["what"]);
        let text = to_markdown("T", "Intro.", &[s, empty]);
        assert_eq!(text, "# T\n\nIntro.\n\n## Found\n\n| what | n |\n| --- | ---: |\n| a\\|b | **3** |\n");
    }
}
