//! Tables of pages.

use crate::escape::escape;

/// How a table cell is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tone {
    /// Plain.
    #[default]
    Plain,
    /// Met, or good news.
    Good,
    /// Missed, or bad news.
    Bad,
}

/// A cell of a table.
#[derive(Debug, Clone, Default)]
pub struct Cell {
    /// Text, escaped by the page.
    pub text: String,
    /// How it is shown.
    pub tone: Tone,
}

impl<S: Into<String>> From<S> for Cell {
    fn from(text: S) -> Self {
        Self { text: text.into(), tone: Tone::Plain }
    }
}

/// A table as markup; a header without any name is left out.
pub(crate) fn table(header: &[&str], rows: &[Vec<Cell>], class: &str) -> String {
    let names: Vec<String> = header.iter().map(|h| format!("<th scope=\"col\">{}</th>", escape(h))).collect();
    let cell = |c: &Cell| {
        let class = match c.tone {
            Tone::Plain => "",
            Tone::Good => " class=\"good\"",
            Tone::Bad => " class=\"bad\"",
        };
        format!("<td{class}>{}</td>", escape(&c.text))
    };
    let head = if header.iter().all(|h| h.is_empty()) {
        String::new()
    } else {
        format!("<thead><tr>{}</tr></thead>", names.concat())
    };
    let row = |r: &Vec<Cell>| format!("<tr>{}</tr>\n", r.iter().map(cell).collect::<String>());
    let rows: String = rows.iter().map(row).collect();
    // What is wider than the window scrolls, and so must be reachable by keys.
    format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Table\"><table{class}>{head}<tbody>\n{rows}</tbody></table></div>\n"
    )
}
