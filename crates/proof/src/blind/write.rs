//! What a run leaves behind: files for machines, a page, Markdown, and a summary on standard output.

use anyhow::Result;
use pages::page::Page;
use pages::text_table::TextTable;
use report::reliability;

use super::figures::FEW;
use super::layout::Layout;
use super::score::{Row, bins};
use super::tables;
use crate::document::{number, to_markdown, to_page};
use crate::output::{Figure, write};

const TITLE: &str = "Blind cases";
/// The reliability diagram.
pub(super) const PICTURE: &str = "reliability.svg";
/// Wrong answers on standard output; the page has all.
const SHOWN: usize = 12;

/// Writes all files and prints the summary; the tables as Markdown.
pub(super) fn all(layout: &Layout, set: &str, rows: &[Row], figures: &[Figure]) -> Result<String> {
    let folder = layout.root();
    write(folder, "summary.json", &serde_json::to_string_pretty(figures)?)?;
    write(folder, "scores.json", &serde_json::to_string_pretty(rows)?)?;
    let sections = tables::all(rows, figures);
    let intro = format!("{set} {}", verdict(figures, rows.len() < FEW));
    let tables = to_markdown(TITLE, &intro, &sections);
    write(folder, "blind.md", &tables)?;
    let bins = bins(&rows.iter().collect::<Vec<_>>(), tables::FINE);
    write(folder, PICTURE, &reliability::svg(&bins)?)?;
    let mut page = Page::new(TITLE);
    page.paragraph(&intro);
    to_page(&mut page, &sections[..1]);
    page.heading("Reliability");
    page.charts(&[reliability::chart(&bins)]);
    to_page(&mut page, &sections[1..]);
    write(folder, "page.html", &page.render())?;
    print!("{}", summary(set, rows, figures));
    println!("\nAll of it: {}/page.html, blind.md, summary.json, scores.json", folder.display());
    Ok(tables)
}

/// How many targets are met, in a sentence.
fn verdict(figures: &[Figure], few: bool) -> String {
    let judged: Vec<bool> = figures.iter().filter_map(|f| f.pass).collect();
    let missed = judged.iter().filter(|met| !**met).count();
    let few =
        if few { " Of so few cases a target counts as missed only where its 95 % interval excludes it." } else { "" };
    if missed == 0 {
        format!("All {} targets are met.{few}", judged.len())
    } else {
        format!("{missed} of {} targets are missed.{few}", judged.len())
    }
}

/// What the terminal shows.
fn summary(set: &str, rows: &[Row], figures: &[Figure]) -> String {
    let mut judged = TextTable::new(&["figure", ">found", "", "asked", ""]);
    for f in figures {
        let Some((target, pass)) = f.target.as_ref().zip(f.pass) else { continue };
        let met = if pass { "met" } else { "MISSED" };
        judged.row([f.name.clone(), number(Some(f.value)), f.unit.clone(), target.clone(), met.to_owned()]);
    }
    let wrong: Vec<&Row> = rows.iter().filter(|r| tables::fails(r)).collect();
    let mut out = format!("\n{set}\n\n{}\n{}\n", judged.render(), verdict(figures, rows.len() < FEW));
    if wrong.is_empty() {
        return out;
    }
    let mut list = TextTable::new(&["wrong", "hidden", "answered", ">probability"]);
    for r in wrong.iter().take(SHOWN) {
        let confidence = format!("{:.2}", r.belief.confidence);
        list.row([r.case.clone(), tables::hidden(r), tables::answered(r), confidence]);
    }
    out += &["\n", &list.render()].concat();
    if wrong.len() > SHOWN {
        out += &["  and ", &(wrong.len() - SHOWN).to_string(), " more\n"].concat();
    }
    out
}
