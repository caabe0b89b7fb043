//! The samples of one column while rows arrive: in order, but for rows that were overtaken on their way.

use std::collections::BTreeMap;

/// How far (ns) a stamp may lie before the latest one and still be sorted into its place: messages overtake each other
/// on a network, by less than a second; what goes further back is a clock that was set anew.
pub(crate) const SORTED_WITHIN_NS: i64 = 1_000_000_000;

/// Instants and values of one column.
#[derive(Default)]
pub(crate) struct ColumnSamples {
    /// In strictly rising order, as rows mostly come.
    t_ns: Vec<i64>,
    values: Vec<f64>,
    /// Samples that came after later ones; few, so that a map is cheap.
    late: BTreeMap<i64, f64>,
}

impl ColumnSamples {
    /// Adds a sample; false when there is one at this instant, which stays.
    pub(crate) fn add(&mut self, now_ns: i64, value: f64) -> bool {
        if self.t_ns.last().is_none_or(|&last_ns| last_ns < now_ns) {
            self.t_ns.push(now_ns);
            self.values.push(value);
            return true;
        }
        let new = self.t_ns.binary_search(&now_ns).is_err() && !self.late.contains_key(&now_ns);
        if new {
            self.late.insert(now_ns, value);
        }
        new
    }

    /// All samples in the order of their stamps.
    pub(crate) fn finish(self) -> (Vec<i64>, Vec<f64>) {
        if self.late.is_empty() {
            return (self.t_ns, self.values);
        }
        let count = self.t_ns.len() + self.late.len();
        let (mut t_ns, mut values) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut late = self.late.into_iter().peekable();
        for (now_ns, value) in self.t_ns.into_iter().zip(self.values) {
            while let Some((late_ns, late_value)) = late.next_if(|&(late_ns, _)| late_ns < now_ns) {
                t_ns.push(late_ns);
                values.push(late_value);
            }
            t_ns.push(now_ns);
            values.push(value);
        }
        for (late_ns, late_value) in late {
            t_ns.push(late_ns);
            values.push(late_value);
        }
        (t_ns, values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn late_samples_find_their_place_and_the_first_of_an_instant_stays() {
        let mut samples = ColumnSamples::default();
        let added: Vec<bool> =
            [5, 9, 7, 9, 7, 3, 20].iter().zip(1..).map(|(&t, n)| samples.add(t, f64::from(n))).collect();
        assert_eq!(added, [true, true, true, false, false, true, true]);
        assert_eq!(samples.finish(), (vec![3, 5, 7, 9, 20], vec![6.0, 1.0, 3.0, 2.0, 7.0]));
    }
}
