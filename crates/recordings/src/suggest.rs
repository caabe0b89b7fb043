//! "Did you mean ...?": the nearest of a list of names.

/// The name of `known` that is most like `given`, when it is like enough to be worth saying.
pub(crate) fn nearest<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    /// Below this likeness (0 to 1, a choice) a suggestion would rather confuse.
    const LIKE_ENOUGH: f64 = 0.6;
    let given = given.to_lowercase();
    let mut best: Option<(&str, f64)> = None;
    for name in known {
        let likeness = strsim::normalized_damerau_levenshtein(&given, &name.to_lowercase());
        if likeness >= LIKE_ENOUGH && best.is_none_or(|(_, most)| likeness > most) {
            best = Some((name, likeness));
        }
    }
    best.map(|(name, _)| name)
}

/// `did you mean X?` where a name is near enough, the whole list otherwise.
pub(crate) fn hint(given: &str, known: &[&str]) -> String {
    nearest(given, known.iter().copied())
        .map_or_else(|| format!("known are: {}", known.join(", ")), |name| format!("did you mean `{name}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_near_name_is_suggested_and_a_far_one_is_not() {
        let known = ["gyro_z", "gyro_y", "torque_left"];
        assert_eq!(hint("gyroz", &known), "did you mean `gyro_z`?");
        assert_eq!(hint("Torque_Left", &known), "did you mean `torque_left`?");
        assert_eq!(hint("banana", &known), "known are: gyro_z, gyro_y, torque_left");
    }
}
