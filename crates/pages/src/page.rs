//! A page in the making: one file that opens offline, readable in light and dark, on a phone and on paper.

use std::fmt::Write;

use crate::chart::Chart;
use crate::escape::escape;
use crate::figure::{Drawing, Figure};
use crate::shell;
use crate::table::table;

pub use crate::table::{Cell, Tone};

/// Letters of a heading that is shown large.
const ONE_LINE: usize = 90;

/// A page in the making. All text is escaped; nothing from a user becomes markup.
#[derive(Debug, Clone)]
pub struct Page {
    title: String,
    body: String,
    sections: Vec<(String, String)>,
    figures: usize,
}

impl Page {
    /// A page under its title.
    pub fn new(title: &str) -> Self {
        Self::headed(title, "", &[title.to_owned()])
    }

    /// A page whose heading says something else than its title; `eyebrow` is a line above the heading.
    pub fn headed(title: &str, eyebrow: &str, heading: &[String]) -> Self {
        let mut page = Self { title: title.into(), body: String::new(), sections: Vec::new(), figures: 0 };
        if !eyebrow.is_empty() {
            page.push(format_args!("<p class=\"eyebrow\">{}</p>\n", escape(eyebrow)));
        }
        let class = if heading.iter().map(String::len).sum::<usize>() > ONE_LINE { " class=\"several\"" } else { "" };
        let lines: Vec<String> = heading.iter().map(|line| format!("<span>{}</span> ", escape(line))).collect();
        page.push(format_args!("<h1{class}>{}</h1>\n", lines.concat()));
        page
    }

    /// Adds a section that the reader can jump to by a short name.
    pub fn section(&mut self, short: &str, heading: &str) {
        let id = format!("section-{}", self.sections.len() + 1);
        self.push(format_args!("<h2 id=\"{id}\">{}</h2>\n", escape(heading)));
        self.sections.push((id, short.to_owned()));
    }

    /// Adds a section heading.
    pub fn heading(&mut self, text: &str) {
        self.element("h2", "", text);
    }

    /// Adds a heading inside a section.
    pub fn subheading(&mut self, text: &str) {
        self.element("h3", "", text);
    }

    /// Adds a paragraph.
    pub fn paragraph(&mut self, text: &str) {
        self.element("p", "", text);
    }

    /// Adds a paragraph that leads into a page.
    pub fn lead(&mut self, text: &str) {
        self.element("p", "lead", text);
    }

    /// Adds a paragraph in a softer colour.
    pub fn note(&mut self, text: &str) {
        self.element("p", "note", text);
    }

    /// Adds a paragraph that stands out.
    pub fn aside(&mut self, text: &str) {
        self.body += "<aside>";
        self.paragraph(text);
        self.body += "</aside>\n";
    }

    /// Adds a list of sentences.
    pub fn list<S: AsRef<str>>(&mut self, sentences: &[S]) {
        self.body += "<ul class=\"plain\">\n";
        for s in sentences {
            self.element("li", "", s.as_ref());
        }
        self.body += "</ul>\n";
    }

    /// Adds a table; the first column is text, the others numbers.
    pub fn table(&mut self, header: &[&str], rows: &[Vec<Cell>]) {
        self.body += &table(header, rows, "");
    }

    /// Adds a table of words.
    pub fn table_of_words(&mut self, header: &[&str], rows: &[Vec<Cell>]) {
        self.body += &table(header, rows, " class=\"words\"");
    }

    /// Adds charts side by side where the window is wide enough.
    pub fn charts(&mut self, charts: &[Chart]) {
        let figure = |c: &Chart| Figure {
            title: String::new(),
            caption: c.caption.clone(),
            table: (Vec::new(), Vec::new()),
            drawing: Drawing::Lines(c.clone()),
        };
        self.grid(&charts.iter().map(figure).collect::<Vec<_>>());
    }

    /// Adds figures side by side where the window is wide enough.
    pub fn grid(&mut self, figures: &[Figure]) {
        self.body += "<div class=\"grid\">\n";
        for f in figures {
            self.figure(f);
        }
        self.body += "</div>\n";
    }

    /// Adds a figure with its caption and its numbers.
    pub fn figure(&mut self, f: &Figure) {
        self.figures += 1;
        let n = self.figures;
        let (title, caption) = (escape(&f.title), escape(&f.caption));
        let label = if f.title.is_empty() { &caption } else { &title };
        let (keys, role) = if f.drawing.has_cursor() {
            (" Arrow keys move the cursor, plus and minus zoom, 0 shows all.", "application")
        } else if f.drawing.zooms() {
            (" Plus and minus zoom, 0 shows all.", "application")
        } else {
            ("", "img")
        };
        let tools = if f.drawing.zooms() {
            "<div class=\"tools\"><button type=\"button\" data-zoom=\"0.5\" aria-label=\"Zoom in\">+</button>\
             <button type=\"button\" data-zoom=\"2\" aria-label=\"Zoom out\">−</button>\
             <button type=\"button\" data-zoom=\"0\">All</button></div>"
        } else {
            ""
        };
        let head = if title.is_empty() { String::new() } else { format!("<h3>{title}</h3>") };
        let head =
            if head.is_empty() && tools.is_empty() { head } else { format!("<div class=\"head\">{head}{tools}</div>") };
        let numbers = match &f.table {
            (_, rows) if rows.is_empty() => String::new(),
            (header, rows) => {
                format!("<details class=\"data\"><summary>Numbers</summary>{}</details>", table(header, rows, ""))
            }
        };
        let json = f.drawing.to_json();
        self.push(format_args!(
            "<figure>{head}<div class=\"plot\" data-chart=\"data-{n}\" tabindex=\"0\" role=\"{role}\" \
             aria-label=\"{label}.{keys}\" aria-describedby=\"caption-{n}\"></div>\
             <p class=\"readout\" aria-live=\"polite\"></p>\
             <script type=\"application/json\" id=\"data-{n}\">{json}</script>\
             <figcaption id=\"caption-{n}\">{caption}</figcaption>{numbers}</figure>\n"
        ));
    }

    /// Adds a picture that was drawn by this crate, with a caption below it.
    pub fn picture(&mut self, svg: &str, caption: &str) {
        self.body += "<figure><div class=\"picture\">";
        self.body += svg;
        self.push(format_args!("</div><figcaption>{}</figcaption></figure>\n", escape(caption)));
    }

    /// Adds what the reader may open; charts inside are drawn then.
    pub fn folded(&mut self, summary: &str, more: &str, open: bool, content: impl FnOnce(&mut Self)) {
        let open = if open { " open" } else { "" };
        self.push(format_args!("<details class=\"block\"{open}><summary>{}", escape(summary)));
        if !more.is_empty() {
            self.push(format_args!("<span>{}</span>", escape(more)));
        }
        self.body += "</summary>\n";
        content(self);
        self.body += "</details>\n";
    }

    /// Adds markup of this crate, whose parts are escaped already.
    pub fn markup(&mut self, html: &str) {
        self.body += html;
    }

    /// The finished page, which needs no network.
    pub fn render(&self) -> String {
        shell::render(&shell::Content {
            title: &self.title,
            body: &self.body,
            sections: &self.sections,
            has_charts: self.figures > 0,
        })
    }

    fn element(&mut self, name: &str, class: &str, text: &str) {
        let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
        self.push(format_args!("<{name}{class}>{}</{name}>\n", escape(text)));
    }

    fn push(&mut self, text: std::fmt::Arguments) {
        // Writing to a string cannot fail.
        let _ = self.body.write_fmt(text);
    }
}

#[cfg(test)]
mod tests {
    use super::Page;
    use crate::chart::{Chart, Line};

    /// How the library of the charts begins.
    const LIBRARY: &str = "plotly.js v";

    #[test]
    fn text_never_becomes_markup() {
        let mut page = Page::new("a<b>");
        page.table(&["<i>"], &[vec!["\"&'".into()]]);
        page.section("<s>", "<h>");
        page.folded("<d>", "<m>", true, |page| page.list(&["<l>"]));
        let html = page.render();
        assert!(html.contains("<title>a&lt;b&gt;</title>") && html.contains("&quot;&amp;&#39;"));
        for markup in ["<i>", "<s>", "<h>", "<d>", "<m>", "<l>"] {
            assert!(!html.contains(markup), "{markup} got through");
        }
        assert!(!html.contains(LIBRARY), "a page without charts carries no library");
    }

    #[test]
    fn the_library_is_embedded_once_and_names_cannot_end_the_script() {
        let line = Line::new("</script><b>", &[0.0, 1.0], &[0.0, 1.0]);
        let chart = Chart { lines: vec![line], ..Chart::default() };
        let mut page = Page::new("t");
        page.charts(&[chart.clone(), chart]);
        let html = page.render();
        assert_eq!(html.matches(LIBRARY).count(), 1);
        assert!(!html.contains("</script><b>") && html.contains("\\u003c/script"));
        assert!(html.len() < 6_000_000);
    }

    #[test]
    fn only_the_scripts_of_the_page_may_run_and_nothing_is_fetched() {
        let html = Page::new("t").render();
        let policy = html.split("Content-Security-Policy\" content=\"").nth(1).and_then(|s| s.split('"').next());
        let policy = policy.expect("there is a policy");
        assert!(policy.starts_with("default-src 'none'; script-src 'sha256-"));
        assert!(!policy.contains("http") && !policy.contains("connect-src"));
    }
}
