//! Links that lead out of the book, to sources beside it, become plain text: a book that is passed on has no sources.

use std::path::{Component, Path};

use pulldown_cmark::{Event, Options, Parser, Tag};

/// The page without links out of the book; `page` is its place in the book.
pub(super) fn inward(markdown: &str, page: &Path) -> String {
    let mut out = String::with_capacity(markdown.len());
    let mut done = 0;
    for (event, range) in Parser::new_ext(markdown, Options::ENABLE_TABLES).into_offset_iter() {
        let Event::Start(Tag::Link { dest_url, .. }) = event else { continue };
        let link = &markdown[range.clone()];
        let Some(text) = link.rfind("](").and_then(|end| link.get(1..end)) else { continue };
        if leads_out(&dest_url, page) {
            out += &markdown[done..range.start];
            out += text;
            done = range.end;
        }
    }
    out + &markdown[done..]
}

/// Whether a link of a page leads out of the book.
fn leads_out(link: &str, page: &Path) -> bool {
    if link.contains(':') || link.starts_with('#') {
        return false;
    }
    let mut depth = page.parent().map_or(0, |folder| folder.components().count());
    for part in Path::new(link).components() {
        match part {
            Component::ParentDir if depth == 0 => return true,
            Component::ParentDir => depth -= 1,
            Component::Normal(_) => depth += 1,
            _ => {}
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::inward;

    #[test]
    fn links_to_sources_become_text_and_others_stay() {
        let text = "| a | b |\n|---|---|\n| [`net.rs`](../../crates/net.rs), [e1](errata.md#e1) | ![](../x.svg) |\n\n\
                    [out](../../README.md) [web](https://example.org) `[code](../../x)`";
        let expected = "| a | b |\n|---|---|\n| `net.rs`, [e1](errata.md#e1) | ![](../x.svg) |\n\n\
                        out [web](https://example.org) `[code](../../x)`";
        assert_eq!(inward(text, "paper/equations.md".as_ref()), expected);
        assert_eq!(inward("[in](../limits.md)", "paper/a.md".as_ref()), "[in](../limits.md)");
        assert_eq!(inward("[out](../limits.md)", "a.md".as_ref()), "out");
    }
}
