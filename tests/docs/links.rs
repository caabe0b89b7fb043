//! Links of a page to other pages, to files and to headings.

use skipping::Outcome;
use std::fs;
use std::path::Path;

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

use crate::shown;

/// The links of a page that lead nowhere.
pub(crate) fn dead(page: &Path) -> Vec<String> {
    let text = fs::read_to_string(page).expect("a page");
    let mut out = Vec::new();
    for event in Parser::new_ext(&text, Options::ENABLE_TABLES) {
        let Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) = event else {
            continue;
        };
        if dest_url.contains(':') {
            continue;
        }
        let (file, anchor) = dest_url.split_once('#').unwrap_or((&dest_url, ""));
        let target = if file.is_empty() { page.to_path_buf() } else { page.with_file_name("").join(file) };
        let is_page = target.extension().is_some_and(|ending| ending == "md");
        if !target.exists() || (is_page && !anchor.is_empty() && !has_anchor(&target, anchor)) {
            out.push(format!("{}: {dest_url}", shown(page)));
        }
    }
    out
}

/// Whether a page has a heading, or an element with an id, of this name.
fn has_anchor(page: &Path, anchor: &str) -> bool {
    let text = fs::read_to_string(page).expect("a page");
    let mut heading: Option<String> = None;
    let by_heading = Parser::new_ext(&text, Options::ENABLE_TABLES).any(|event| {
        match event {
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::Text(text) | Event::Code(text) => {
                if let Some(all) = &mut heading {
                    *all += &text;
                }
            }
            Event::End(TagEnd::Heading(_)) => return heading.take().is_some_and(|text| slug(&text) == anchor),
            _ => {}
        }
        false
    });
    by_heading || text.contains(&format!("id=\"{anchor}\""))
}

/// A heading as the name of its anchor.
fn slug(heading: &str) -> String {
    let kept = heading.to_lowercase();
    kept.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c)).map(|c| if c == ' ' { '-' } else { c }).collect()
}

pub(crate) fn headings_are_named_as_pages_name_them() -> Outcome {
    assert_eq!(slug("What it cannot do, first"), "what-it-cannot-do-first");
    assert_eq!(slug("com_offset"), "com_offset");
    Ok(())
}
