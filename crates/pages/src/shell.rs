//! What surrounds the content of every page: styles, scripts, and the promise that nothing is fetched.

use std::io::Read;

use base64::prelude::{BASE64_STANDARD, Engine};
use flate2::read::DeflateDecoder;
use sha2::{Digest, Sha256};

use crate::escape::escape;

const STYLE: &str = include_str!("web/page.css");
/// What draws the charts, compressed.
const PLOTLY: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/plotly.js.deflate"));
/// First the theme, last what draws: they share one scope.
const SCRIPTS: [&str; 4] = [
    include_str!("web/theme.js"),
    include_str!("web/build.js"),
    include_str!("web/time.js"),
    include_str!("web/charts.js"),
];

/// What goes into the shell.
pub(crate) struct Content<'a> {
    pub(crate) title: &'a str,
    pub(crate) body: &'a str,
    /// Id and short name of each section that the reader may jump to.
    pub(crate) sections: &'a [(String, String)],
    pub(crate) has_charts: bool,
}

/// The whole page: one file that needs no network and forbids it. With charts it carries plotly.js (4.6 MB) once.
pub(crate) fn render(content: &Content<'_>) -> String {
    let scripts = SCRIPTS.concat();
    // Every page has the scripts, for its colours; they do nothing where there is no chart.
    let library = if content.has_charts { plotly_js() } else { String::new() };
    let blocks: Vec<&str> = [library.as_str(), scripts.as_str()].into_iter().filter(|s| !s.is_empty()).collect();
    // Only these scripts may run, whatever else gets into the page. plotly.js sets styles of its own.
    let allowed: Vec<String> = blocks.iter().map(|s| format!("'sha256-{}'", hash(s))).collect();
    let policy = format!(
        "default-src 'none'; script-src {}; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'",
        allowed.join(" ")
    );
    let jumps: Vec<String> =
        content.sections.iter().map(|(id, name)| format!("<li><a href=\"#{id}\">{}</a></li>", escape(name))).collect();
    let jumps = if jumps.is_empty() { String::new() } else { format!("<ul>{}</ul>", jumps.concat()) };
    let run: Vec<String> = blocks.iter().map(|s| format!("<script>{s}</script>\n")).collect();
    let (title, body, run) = (escape(content.title), content.body, run.concat());
    let no_script = if content.has_charts {
        "<noscript><p>The charts need JavaScript. Their numbers are in the tables below them.</p></noscript>\n"
    } else {
        ""
    };
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
         <title>{title}</title>\n<style>{STYLE}</style></head>\n\
         <body><a class=\"skip\" href=\"#content\">Skip to the content</a>\n\
         <header><div><span class=\"brand\">Lacuna</span><nav aria-label=\"Sections\">{jumps}</nav>\
         <button type=\"button\" id=\"theme\">Dark</button></div></header>\n\
         <main id=\"content\">\n{no_script}{body}</main>\n{run}</body></html>\n"
    )
}

/// plotly.js alone, as the build script has compressed it.
fn plotly_js() -> String {
    let mut code = String::new();
    // What the build script wrote can be read: a test renders a page and finds the library in it.
    DeflateDecoder::new(PLOTLY).read_to_string(&mut code).unwrap_or_default();
    code
}

fn hash(script: &str) -> String {
    // Browsers hash what they have parsed, and parsing turns every kind of line end into one.
    BASE64_STANDARD.encode(Sha256::digest(script.replace("\r\n", "\n").replace('\r', "\n").as_bytes()))
}
