//! The text of a robot file: where a key stands, and what a parser's message means to people.

use crate::RobotFileError;
use crate::suggest;

/// A robot file's name and text.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RobotText<'a> {
    pub(crate) file: &'a str,
    pub(crate) text: &'a str,
}

impl RobotText<'_> {
    /// The file with the line of a key, where it is found: `robot.toml: line 6`.
    pub(crate) fn at(&self, key: &str) -> String {
        line_of(self.text, key).map_or_else(|| self.file.to_owned(), |line| format!("{}: line {line}", self.file))
    }

    /// The file with the line of the `n`-th effect that is given, where it is found.
    pub(crate) fn at_effect(&self, n: usize) -> String {
        let mut lines = self.text.lines().enumerate().filter(|(_, line)| line_of(line, "effect").is_some());
        lines.nth(n).map_or_else(|| self.file.to_owned(), |(i, _)| format!("{}: line {}", self.file, i + 1))
    }

    /// A refusal by the TOML parser.
    pub(crate) fn toml(&self, error: &toml::de::Error) -> RobotFileError {
        let start = error.span().map_or(0, |span| span.start.min(self.text.len()));
        let before = self.text.get(..start).unwrap_or_default();
        let line = 1 + before.matches('\n').count();
        let column = 1 + before.rsplit('\n').next().unwrap_or_default().chars().count();
        self.syntax(line, column, error.message())
    }

    /// A refusal by the JSON parser.
    pub(crate) fn json(&self, error: &serde_json::Error) -> RobotFileError {
        let (line, column) = (error.line().max(1), error.column().max(1));
        let message = error.to_string();
        let end = message.rfind(" at line ").unwrap_or(message.len());
        self.syntax(line, column, &message[..end])
    }

    fn syntax(&self, line: usize, column: usize, message: &str) -> RobotFileError {
        RobotFileError::Syntax {
            place: format!("{}: line {line}, column {column}", self.file),
            message: in_words(message),
        }
    }
}

/// The line (from 1) in which a key is set, in TOML or JSON.
fn line_of(text: &str, key: &str) -> Option<usize> {
    let sets = |line: &str, first: bool| {
        line.match_indices(key).any(|(start, _)| {
            let (before, after) = (&line[..start], &line[start + key.len()..]);
            let word = |c: char| c.is_alphanumeric() || c == '_';
            let lead = before.trim_end_matches(['"', '\'']);
            let alone = !before.ends_with(word) && !after.starts_with(word);
            let sets = after.trim_start_matches(['"', '\'']).trim_start();
            let begins = lead.trim().is_empty() || lead.trim_start() == "[parameters.";
            alone && sets.starts_with(['=', ':', ']', '.']) && (begins || !first)
        })
    };
    // A line that begins with the key, before one that only mentions it.
    let find = |first: bool| {
        text.lines().position(|line| !line.trim_start().starts_with('#') && sets(line, first)).map(|index| index + 1)
    };
    find(true).or_else(|| find(false))
}

/// A parser's message in the words of a robot file, with the nearest known key.
fn in_words(message: &str) -> String {
    let message = message.trim().replace('\n', "; ");
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let Some((&given, known)) = quoted.split_first() else {
        return message
            .replace("expected f64", "expected a number")
            .replace("expected struct Quantity", "expected value, unit and source");
    };
    if message.starts_with("unknown field") {
        format!("unknown key `{given}`; {}", suggest::hint(given, known))
    } else if message.starts_with("unknown variant") {
        format!("unknown value `{given}`; {}", suggest::hint(given, known))
    } else if message.starts_with("missing field") {
        format!("the key `{given}` is missing here; add it")
    } else if message.starts_with("duplicate field") {
        format!("the key `{given}` is given twice; keep one")
    } else {
        message
            .replace("expected f64", "expected a number")
            .replace("expected struct Quantity", "expected value, unit and source")
    }
}

#[cfg(test)]
mod tests {
    use super::{in_words, line_of};

    #[test]
    fn keys_are_found_where_they_are_set() {
        let toml =
            "# mass = 1\nname = \"mass: x\"\n[parameters]\nmass = { value = 1.0 }\ncom_x = 2\n[parameters.track]\n";
        assert_eq!(line_of(toml, "mass"), Some(4));
        assert_eq!(line_of(toml, "track"), Some(6));
        assert_eq!(line_of(toml, "com"), None);
        let json = "{\n \"motor\": { \"torque_limit\": 3 },\n \"mass_kg\" : 4\n}";
        assert_eq!(line_of(json, "mass_kg"), Some(3));
        assert_eq!(line_of(json, "torque_limit"), Some(2));
    }

    #[test]
    fn parser_messages_become_advice() {
        assert_eq!(
            in_words("unknown field `mas`, expected one of `mass`, `track`"),
            "unknown key `mas`; did you mean `mass`?"
        );
        assert_eq!(in_words("missing field `source`"), "the key `source` is missing here; add it");
        assert_eq!(
            in_words("invalid type: string \"x\", expected f64"),
            "invalid type: string \"x\", expected a number"
        );
    }
}
