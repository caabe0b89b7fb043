//! The text of a robot file: where a key stands, and what a parser's message means to people.

use recordings::{Spot, suggest};

use crate::RobotFileError;

/// A robot file's name and text.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RobotText<'a> {
    pub(crate) file: &'a str,
    pub(crate) text: &'a str,
}

impl RobotText<'_> {
    /// The place of a key, where it is found: `robot.toml: line 6, column 1`.
    pub(crate) fn at(&self, key: &str) -> Spot {
        byte_of(self.text, key).map_or_else(|| Spot::file(self.file), |byte| Spot::of_byte(self.file, self.text, byte))
    }

    /// The place of the `n`-th effect that is given, where it is found.
    pub(crate) fn at_effect(&self, n: usize) -> Spot {
        let mut start = 0;
        let mut places = self.text.split_inclusive('\n').filter_map(|line| {
            let begin = start;
            start += line.len();
            byte_of(line, "effect").map(|at| begin + at)
        });
        places.nth(n).map_or_else(|| Spot::file(self.file), |byte| Spot::of_byte(self.file, self.text, byte))
    }

    /// A refusal by the TOML parser.
    pub(crate) fn toml(&self, error: &toml::de::Error) -> RobotFileError {
        let place = Spot::of_byte(self.file, self.text, error.span().map_or(0, |span| span.start));
        RobotFileError::Syntax { place, message: in_words(error.message()) }
    }

    /// A refusal by the JSON parser.
    pub(crate) fn json(&self, error: &serde_json::Error) -> RobotFileError {
        let at = Some((error.line().max(1) as u32, error.column().max(1) as u32));
        let message = error.to_string();
        let end = message.rfind(" at line ").unwrap_or(message.len());
        let place = Spot { file: self.file.to_owned(), at };
        RobotFileError::Syntax { place, message: in_words(&message[..end]) }
    }
}

/// The byte at which a key is set, in TOML or JSON.
fn byte_of(text: &str, key: &str) -> Option<usize> {
    let sets = |line: &str, first: bool| {
        line.match_indices(key).map(|(start, _)| start).find(|&start| {
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
        let mut start = 0;
        text.split_inclusive('\n').find_map(|line| {
            let (begin, comment) = (start, line.trim_start().starts_with('#'));
            start += line.len();
            if comment { None } else { sets(line, first).map(|at| begin + at) }
        })
    };
    find(true).or_else(|| find(false))
}

/// A parser's message in the words of a robot file.
fn in_words(message: &str) -> String {
    suggest::in_words(message).replace("expected struct Quantity", "expected value, unit and source")
}

#[cfg(test)]
mod tests {
    use super::byte_of;

    #[test]
    fn keys_are_found_where_they_are_set() {
        let line_of = |text: &str, key: &str| Some(text[..byte_of(text, key)?].matches('\n').count() + 1);
        let toml =
            "# mass = 1\nname = \"mass: x\"\n[parameters]\nmass = { value = 1.0 }\ncom_x = 2\n[parameters.track]\n";
        assert_eq!(line_of(toml, "mass"), Some(4));
        assert_eq!(line_of(toml, "track"), Some(6));
        assert_eq!(line_of(toml, "com"), None);
        let json = "{\n \"motor\": { \"torque_limit\": 3 },\n \"mass_kg\" : 4\n}";
        assert_eq!(line_of(json, "mass_kg"), Some(3));
        assert_eq!(line_of(json, "torque_limit"), Some(2));
    }
}
