//! "Did you mean ...?": the nearest of a list of names, and what a parser says in the words of people.

/// The name of `known` that is most like `given`, when it is like enough to be worth saying.
///
/// ```
/// assert_eq!(bags::suggest::nearest("gyroz", ["gyro_y", "gyro_z"]), Some("gyro_z"));
/// assert_eq!(bags::suggest::nearest("banana", ["gyro_y", "gyro_z"]), None);
/// ```
pub fn nearest<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    /// Below this likeness (0 to 1, a choice) a suggestion would rather confuse.
    const LIKE_ENOUGH: f64 = 0.6;
    let given = given.to_lowercase();
    let mut best: Option<(&str, f64)> = None;
    for name in known {
        let likeness = strsim::normalized_damerau_levenshtein(&given, &name.to_lowercase());
        // "husky" for "husky-a200": whoever leaves out the end means it too.
        let likeness = if given.len() > 2 && name.starts_with(&given) { likeness.max(LIKE_ENOUGH) } else { likeness };
        if likeness >= LIKE_ENOUGH && best.is_none_or(|(_, most)| likeness > most) {
            best = Some((name, likeness));
        }
    }
    best.map(|(name, _)| name)
}

/// ``did you mean `X`?`` where a name is near enough, the whole list otherwise.
pub fn hint(given: &str, known: &[&str]) -> String {
    nearest(given, known.iter().copied())
        .map_or_else(|| format!("known are: {}", known.join(", ")), |name| format!("did you mean `{name}`?"))
}

/// What a parser of TOML or JSON complains about, in the words of its files, with the nearest known key or value.
///
/// ```
/// let serde = "unknown field `sgn`, expected one of `sign`, `scale`";
/// assert_eq!(bags::suggest::in_words(serde), "unknown key `sgn`; did you mean `sign`?");
/// ```
pub fn in_words(message: &str) -> String {
    let message = message.trim().replace('\n', "; ");
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match quoted.split_first() {
        Some((given, known)) if message.starts_with("unknown field") => {
            format!("unknown key `{given}`; {}", hint(given, known))
        }
        Some((given, known)) if message.starts_with("unknown variant") => {
            format!("unknown value `{given}`; {}", hint(given, known))
        }
        Some((given, _)) if message.starts_with("missing field") => {
            format!("the key `{given}` is missing here; add it")
        }
        Some((given, _)) if message.starts_with("duplicate field") => {
            format!("the key `{given}` is given twice; keep one")
        }
        _ => message.replace("expected f64", "expected a number"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_names_and_beginnings_are_suggested_and_far_ones_are_not() {
        let known = ["gyro_z", "gyro_y", "torque_left", "husky-a200"];
        assert_eq!(hint("gyroz", &known), "did you mean `gyro_z`?");
        assert_eq!(hint("Torque_Left", &known), "did you mean `torque_left`?");
        assert_eq!(hint("husky", &known), "did you mean `husky-a200`?");
        assert_eq!(hint("banana", &known), "known are: gyro_z, gyro_y, torque_left, husky-a200");
    }

    #[test]
    fn parser_messages_become_advice() {
        assert_eq!(
            in_words("unknown field `mas`, expected one of `mass`, `track`"),
            "unknown key `mas`; did you mean `mass`?"
        );
        assert_eq!(
            in_words("unknown variant `x`, expected `measured` or `set-point`"),
            "unknown value `x`; known are: measured, set-point"
        );
        assert_eq!(in_words("missing field `source`"), "the key `source` is missing here; add it");
        assert_eq!(in_words("duplicate field `source`"), "the key `source` is given twice; keep one");
        assert_eq!(
            in_words("invalid type: string \"x\", expected f64"),
            "invalid type: string \"x\", expected a number"
        );
    }
}
