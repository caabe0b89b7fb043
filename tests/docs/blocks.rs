//! The commands of a page with what they show.

use pulldown_cmark::{CodeBlockKind, Event, Parser, Tag, TagEnd};
use skipping::Outcome;

/// A `sh` block with the `text` blocks below it, or a file that the reader is to write (`file=NAME` behind its language).
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Block {
    /// Line of the page, from 1.
    pub(crate) line: usize,
    /// What stands behind `sh`.
    pub(crate) marks: Vec<String>,
    /// The commands, one each.
    pub(crate) commands: Vec<String>,
    /// Name and text of a file.
    pub(crate) file: Option<(String, String)>,
    /// Lines that come out.
    pub(crate) shown: Vec<String>,
}

impl Block {
    pub(crate) fn has(&self, mark: &str) -> bool {
        self.marks.iter().any(|m| m == mark)
    }

    /// The exit code of the last command.
    pub(crate) fn exit(&self) -> i32 {
        let code = self.marks.iter().find_map(|mark| mark.strip_prefix("exit="));
        code.map_or(0, |code| code.parse().expect("exit=NUMBER"))
    }
}

/// The blocks of a page in their order.
pub(crate) fn of(markdown: &str) -> Vec<Block> {
    let mut out: Vec<Block> = Vec::new();
    let mut open: Option<(String, String)> = None;
    let mut follows = false;
    for (event, range) in Parser::new(markdown).into_offset_iter() {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                let line = 1 + markdown[..range.start].matches('\n').count();
                if let Some(block) = start(&info, line) {
                    out.push(block);
                }
                open = Some((info.to_string(), String::new()));
            }
            Event::Text(text) => {
                if let Some((_, all)) = &mut open {
                    *all += &text;
                }
            }
            Event::End(TagEnd::CodeBlock) => {
                let Some((info, text)) = open.take() else { continue };
                match (kind(&info), out.last_mut()) {
                    ("sh", Some(block)) => {
                        block.commands = commands(&text);
                        follows = true;
                    }
                    ("sh", None) => {}
                    (_, Some(block)) if block.file.as_ref().is_some_and(|(_, text)| text.is_empty()) => {
                        block.file = block.file.take().map(|(name, _)| (name, text));
                        follows = false;
                    }
                    ("text", Some(block)) if follows && info == "text" => {
                        block.shown.extend(text.lines().map(str::to_owned));
                    }
                    _ => follows = false,
                }
            }
            _ => {}
        }
    }
    out
}

fn kind(info: &str) -> &str {
    info.split([',', ' ']).next().unwrap_or_default()
}

fn start(info: &str, line: usize) -> Option<Block> {
    let marks: Vec<String> = info.split([',', ' ']).skip(1).map(str::to_owned).collect();
    let name = marks.iter().find_map(|mark| mark.strip_prefix("file="));
    let file = name.map(|name| (name.to_owned(), String::new()));
    (kind(info) == "sh" || file.is_some()).then_some(Block { line, marks, file, ..Block::default() })
}

/// Lines without comments; a backslash at the end joins the next.
fn commands(text: &str) -> Vec<String> {
    let joined = text.replace("\\\n", " ");
    let lines = joined.lines().map(|line| line.split(" #").next().unwrap_or_default().trim().to_owned());
    lines.filter(|line| !line.is_empty() && !line.starts_with('#')).collect()
}

pub(crate) fn commands_are_found_with_what_they_show() -> Outcome {
    let page = "# A\n\n```sh,exit=3\nlacuna a \\\n  b   # why\n\nlacuna c\n```\n\n```text\none\n```\n\n```text\ntwo\n```\n\n\
                ```toml\nx = 1\n```\n\n```text\nno output\n```\n\n```toml,file=a.toml\nx = 2\n```\n";
    let block = Block {
        line: 3,
        marks: vec!["exit=3".to_owned()],
        commands: vec!["lacuna a    b".to_owned(), "lacuna c".to_owned()],
        shown: vec!["one".to_owned(), "two".to_owned()],
        file: None,
    };
    assert_eq!(block.exit(), 3);
    let found = of(page);
    assert_eq!((found.len(), &found[0]), (2, &block));
    assert_eq!(found[1].file, Some(("a.toml".to_owned(), "x = 2\n".to_owned())));
    Ok(())
}
