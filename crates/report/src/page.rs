//! The shell that all pages share: one file that opens offline, readable in light and dark.

use std::fmt::Write;

use crate::chart::Chart;

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

/// A page in the making. All text is escaped; nothing from a user becomes markup.
#[derive(Debug, Clone)]
pub struct Page {
    title: String,
    body: String,
    charts: usize,
}

const CSS: &str = "\
:root{color-scheme:light dark;--ink:#1d2329;--soft:#5b6670;--paper:#ffffff;--line:#d5dbe0;--good:#0b6b3a;--bad:#b3261e}
@media(prefers-color-scheme:dark){:root{--ink:#e4e8eb;--soft:#9aa5ae;--paper:#14181c;--line:#343c43;--good:#62d394;--bad:#ff8a80}}
body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:1200px;margin:2rem auto;padding:0 1rem}
h1{font-size:1.6rem}h2{font-size:1.2rem;margin-top:2rem}p{max-width:75ch}p.note{color:var(--soft)}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums}
svg{max-width:100%;height:auto}th,td{padding:.25rem .7rem;border-bottom:1px solid var(--line);text-align:right}
th:first-child,td:first-child{text-align:left}.good{color:var(--good)}.bad{color:var(--bad);font-weight:600}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,480px),1fr));gap:1rem}
figure{margin:0;min-width:0}figcaption{color:var(--soft);font-size:.9rem}";

/// Follows the colours of the page, also when the reader changes them.
const THEME: &str = "\
const dark=matchMedia('(prefers-color-scheme: dark)');
function paint(){const c=getComputedStyle(document.documentElement);const ink=c.getPropertyValue('--ink').trim();
const line=c.getPropertyValue('--line').trim();
for(const d of document.querySelectorAll('.chart'))Plotly.relayout(d,{'paper_bgcolor':'rgba(0,0,0,0)',
'plot_bgcolor':'rgba(0,0,0,0)','font.color':ink,'xaxis.gridcolor':line,'yaxis.gridcolor':line});}
paint();dark.addEventListener('change',paint);";

impl Page {
    /// An empty page.
    pub fn new(title: &str) -> Self {
        Self { title: title.into(), body: String::new(), charts: 0 }
    }

    /// Adds a section heading.
    pub fn heading(&mut self, text: &str) {
        self.push(format_args!("<h2>{}</h2>\n", escape(text)));
    }

    /// Adds a paragraph.
    pub fn paragraph(&mut self, text: &str) {
        self.push(format_args!("<p>{}</p>\n", escape(text)));
    }

    /// Adds a paragraph in a softer colour.
    pub fn note(&mut self, text: &str) {
        self.push(format_args!("<p class=\"note\">{}</p>\n", escape(text)));
    }

    /// Adds a table; the first column is text, the others numbers.
    pub fn table(&mut self, header: &[&str], rows: &[Vec<Cell>]) {
        self.body += "<div class=\"scroll\"><table><thead><tr>";
        for text in header {
            self.push(format_args!("<th>{}</th>", escape(text)));
        }
        self.body += "</tr></thead><tbody>\n";
        for row in rows {
            self.body += "<tr>";
            for cell in row {
                let class = match cell.tone {
                    Tone::Plain => "",
                    Tone::Good => " class=\"good\"",
                    Tone::Bad => " class=\"bad\"",
                };
                self.push(format_args!("<td{class}>{}</td>", escape(&cell.text)));
            }
            self.body += "</tr>\n";
        }
        self.body += "</tbody></table></div>\n";
    }

    /// Adds charts side by side where the window is wide enough.
    pub fn charts(&mut self, charts: &[Chart]) {
        self.body += "<div class=\"grid\">\n";
        for chart in charts {
            self.charts += 1;
            let (n, json) = (self.charts, chart.to_json());
            let caption = escape(&chart.caption);
            self.push(format_args!(
                "<figure><div id=\"chart{n}\" class=\"chart\" role=\"img\" aria-label=\"{caption}\"></div>\
                 <script>Plotly.newPlot(\"chart{n}\",{json});</script><figcaption>{caption}</figcaption></figure>\n"
            ));
        }
        self.body += "</div>\n";
    }

    /// Adds a picture that was drawn by this crate, with a caption below it.
    pub fn picture(&mut self, svg: &str, caption: &str) {
        self.body += "<figure>";
        self.body += svg;
        self.push(format_args!("<figcaption>{}</figcaption></figure>\n", escape(caption)));
    }

    /// The finished page. With charts it carries plotly.js (4.6 MB) once and needs no network.
    pub fn render(&self) -> String {
        let title = escape(&self.title);
        let (library, theme) = if self.charts > 0 { (plotly_js(), THEME) } else { (String::new(), "") };
        let body = &self.body;
        format!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
             <title>{title}</title>\n<style>{CSS}</style>\n{library}</head>\n\
             <body><h1>{title}</h1>\n{body}<script>{theme}</script>\n</body></html>\n"
        )
    }

    fn push(&mut self, text: std::fmt::Arguments) {
        // Writing to a string cannot fail.
        let _ = self.body.write_fmt(text);
    }
}

/// plotly.js alone: the bundle's second script, MathJax, is another 2 MB that no chart here uses.
fn plotly_js() -> String {
    const END: &str = "</script>";
    let mut sources = plotly::Plot::offline_js_sources();
    if let Some(end) = sources.find(END) {
        sources.truncate(end + END.len());
    }
    sources
}

/// Text that is safe in HTML, also inside quoted attributes.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::Page;
    use crate::chart::{Chart, Line};

    #[test]
    fn text_never_becomes_markup() {
        let mut page = Page::new("a<b>");
        page.table(&["<i>"], &[vec!["\"&'".into()]]);
        let html = page.render();
        assert!(html.contains("<title>a&lt;b&gt;</title>") && html.contains("&quot;&amp;&#39;"));
        assert!(!html.contains("Plotly"), "a page without charts carries no library");
    }

    #[test]
    fn the_library_is_embedded_once_and_names_cannot_end_the_script() {
        let line = Line::new("</script><b>", &[0.0, 1.0], &[0.0, 1.0]);
        let chart = Chart { lines: vec![line], ..Chart::default() };
        let mut page = Page::new("t");
        page.charts(&[chart.clone(), chart]);
        let html = page.render();
        assert_eq!(html.matches("plotly.js v").count(), 1);
        assert!(!html.contains("</script><b>"));
        assert!(html.len() < 6_000_000);
    }
}
