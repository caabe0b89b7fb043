//! Tables that become a page, Markdown and plain text alike.

use crate::commit;
use pages::page::{Cell, Page, Tone};
use pages::text_table::TextTable;

/// A table with its heading.
#[derive(Debug, Clone, Default)]
pub struct Section {
    /// Its heading.
    pub title: String,
    /// What one must know to read it; may be empty.
    pub note: String,
    /// Names of the columns.
    pub header: Vec<String>,
    /// One cell for each column.
    pub rows: Vec<Vec<Cell>>,
}

impl Section {
    /// A table without rows yet.
    pub fn new(title: &str, note: &str, header: &[&str]) -> Self {
        Self {
            title: title.into(),
            note: note.into(),
            header: header.iter().map(|h| (*h).to_owned()).collect(),
            rows: Vec::new(),
        }
    }
}

/// Text in a tone.
pub fn toned(text: impl Into<String>, tone: Tone) -> Cell {
    Cell { text: text.into(), tone }
}

/// A number in a table; `-` where there is none.
pub fn number(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        // Counts, and shares that are all or nothing.
        Some(x) if x.fract() == 0.0 && x.abs() < 1e6 => format!("{x:.0}"),
        Some(x) => pages::text_table::number(x),
    }
}

/// Adds sections to a page; those without rows are left out.
pub fn to_page(page: &mut Page, sections: &[Section]) {
    for s in filled(sections) {
        page.heading(&s.title);
        if !s.note.is_empty() {
            page.note(&s.note);
        }
        page.table(&s.header.iter().map(String::as_str).collect::<Vec<_>>(), &s.rows);
    }
}

/// Sections as Markdown, with the commit at which they were printed; sections without rows are left out.
pub fn to_markdown(title: &str, intro: &str, sections: &[Section]) -> String {
    markdown(title, &format!("{intro}\n\n{}", commit::printed()), sections)
}

fn markdown(title: &str, intro: &str, sections: &[Section]) -> String {
    let line = |cells: &mut dyn Iterator<Item = String>| format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "));
    let mut out = format!("# {title}\n\n{}\n", intro.trim());
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

/// Sections as plain text for a terminal; those without rows are left out.
pub fn to_text(sections: &[Section]) -> String {
    let mut out = String::new();
    for s in filled(sections) {
        let right = |i: usize| s.rows.iter().filter_map(|r| r.get(i)).all(|c| c.text.is_empty() || is_numeric(&c.text));
        let name = |(i, h): (usize, &String)| format!("{}{h}", if i > 0 && right(i) { ">" } else { "" });
        let names: Vec<String> = s.header.iter().enumerate().map(name).collect();
        let mut table = TextTable::new(&names.iter().map(String::as_str).collect::<Vec<_>>());
        for row in &s.rows {
            table.row(row.iter().map(|cell| cell.text.clone()));
        }
        out += &["\n", &s.title, "\n", &table.render()].concat();
    }
    out
}

/// Text in lines of about a hundred letters.
pub fn wrapped(text: &str) -> String {
    const WIDTH: usize = 100;
    let mut out = String::new();
    let mut column = 0;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > WIDTH {
            out.push('\n');
            column = 0;
        } else if column > 0 {
            out.push(' ');
            column += 1;
        }
        out += word;
        column += length;
    }
    out
}

/// A sentence where fewer draws were made than a target was stated for; else nothing.
pub fn fewer_draws(stated_for: u64, draws: u64) -> String {
    if draws < stated_for {
        format!(" This was stated for {stated_for} draws; these are {draws}.")
    } else {
        String::new()
    }
}

/// Whether a cell begins like a number or a bound on one.
fn is_numeric(text: &str) -> bool {
    text.trim_start_matches(['<', '>', '=', '+', '-', ' ']).starts_with(|c: char| c.is_ascii_digit())
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
    use pages::page::Tone;

    use super::{Section, markdown, to_text, toned};

    #[test]
    fn sections_become_markdown_tables() {
        let mut s = Section::new("Found", "", &["what", "n"]);
        s.rows.push(vec!["a|b".into(), toned("3", Tone::Bad)]);
        let empty = Section::new("Nothing", "", &["what"]);
        let text = markdown("T", "Intro.", &[s, empty]);
        assert_eq!(text, "# T\n\nIntro.\n\n## Found\n\n| what | n |\n| --- | ---: |\n| a\\|b | **3** |\n");
    }

    #[test]
    fn sections_become_plain_text_with_numbers_to_the_right() {
        let mut s = Section::new("Found", "", &["what", "n"]);
        s.rows.push(vec!["a".into(), toned("30", Tone::Bad)]);
        assert_eq!(to_text(&[s]), "\nFound\n  what   n\n  a     30\n");
    }
}
