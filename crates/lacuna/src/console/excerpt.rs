//! The lines of a file that an error is about, with a mark below the place.

use std::fs;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use case_files::TextError;
use recordings::{RecordingError, Spot};
use robot_file::RobotFileError;

/// An error with the place that it is about, where that lies in a text that somebody has written (TOML or JSON).
pub(super) fn render(error: &anyhow::Error, sentence: &str) -> Option<String> {
    let spot = error.chain().find_map(spot)?;
    let (line, column) = spot.at?;
    // What is built in is no file, and a file that has gone has nothing to show.
    let text = fs::read_to_string(&spot.file).ok()?;
    let start = text.split_inclusive('\n').take(line as usize - 1).map(str::len).sum::<usize>();
    let shown = text[start..].lines().next()?;
    let from = shown.char_indices().nth(column as usize - 1).map_or(shown.len(), |(byte, _)| byte);
    let mark = from..from + word(&shown[from..]);
    let snippet = Snippet::source(shown).line_start(line as usize).path(&spot.file);
    let report = Level::ERROR.primary_title(sentence).element(snippet.annotation(AnnotationKind::Primary.span(mark)));
    Some(Renderer::styled().render(&[report]))
}

fn spot<'e>(error: &'e (dyn std::error::Error + 'static)) -> Option<&'e Spot> {
    let of_robot = error.downcast_ref::<RobotFileError>().and_then(RobotFileError::spot);
    let of_mapping = || error.downcast_ref::<RecordingError>().and_then(RecordingError::spot);
    of_robot.or_else(of_mapping).or_else(|| error.downcast_ref::<TextError>().map(|error| &error.spot))
}

/// The length of the word, number or quoted text at the start.
fn word(text: &str) -> usize {
    let quoted = text.strip_prefix('"').and_then(|inside| inside.find('"')).map(|end| end + 2);
    let plain = || text.find(|c: char| c.is_whitespace() || "=,:{}[]#".contains(c)).unwrap_or(text.len());
    let first = || text.chars().next().map_or(0, char::len_utf8);
    quoted.unwrap_or_else(|| plain().max(first()))
}

#[cfg(test)]
mod tests {
    use super::word;

    #[test]
    fn words_numbers_and_quoted_texts_are_marked_whole() {
        let marked = |text: &'static str| &text[..word(text)];
        assert_eq!(marked("\"rad s\", sign = 1"), "\"rad s\"");
        assert_eq!(marked("mass = 3"), "mass");
        assert_eq!(marked("-3.5 }"), "-3.5");
        assert_eq!(marked("{ value"), "{");
        assert_eq!(marked("µ"), "µ");
        assert_eq!(marked(""), "");
    }
}
