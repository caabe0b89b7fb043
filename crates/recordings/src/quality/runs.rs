//! Stretches of equal values.

/// Consecutive samples of one value; `None` where it is missing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Run {
    pub(crate) start: usize,
    pub(crate) len: usize,
    pub(crate) value: Option<f64>,
}

/// The values as runs, one after the other without a hole.
pub(crate) fn runs(values: &[f64]) -> impl Iterator<Item = Run> + '_ {
    let mut start = 0;
    let groups = values.chunk_by(|a, b| a == b || !(a.is_finite() || b.is_finite()));
    groups.map(move |group| {
        let run = Run { start, len: group.len(), value: Some(group[0]).filter(|value| value.is_finite()) };
        start += group.len();
        run
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_and_missing_values_group() {
        let runs: Vec<Run> = runs(&[1.0, 1.0, f64::NAN, f64::INFINITY, 2.0]).collect();
        let expected = [(0, 2, Some(1.0)), (2, 2, None), (4, 1, Some(2.0))];
        assert_eq!(runs, expected.map(|(start, len, value)| Run { start, len, value }));
    }
}
