//! "Did you mean ...?": the nearest of a list of names.

/// Below this likeness (0 to 1, a choice) a suggestion would rather confuse.
const LIKE_ENOUGH: f64 = 0.6;

/// The name of `known` that is most like `given`, when it is like enough to be worth saying.
pub fn nearest<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
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

#[cfg(test)]
mod tests {
    use super::hint;

    #[test]
    fn near_names_and_beginnings_are_suggested() {
        let known = ["payload", "grade", "husky-a200"];
        assert_eq!(hint("paylod", &known), "did you mean `payload`?");
        assert_eq!(hint("husky", &known), "did you mean `husky-a200`?");
        assert_eq!(hint("zzz", &known), "known are: payload, grade, husky-a200");
    }
}
