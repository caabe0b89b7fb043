//! The samples of one column while rows arrive: in order, but for rows that were overtaken on their way.

use std::collections::BTreeMap;

use crate::column::{Keep, Series};

/// Instants and values of one column.
#[derive(Clone, Default)]
pub(crate) struct ColumnSamples {
    /// In strictly rising order, as rows mostly come.
    t_ns: Vec<i64>,
    values: Vec<f64>,
    /// Samples that came after later ones; few, so that a map is cheap.
    late: BTreeMap<i64, f64>,
}

impl ColumnSamples {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.t_ns.len() + self.late.len()
    }

    /// Takes out, in order, what lies more than `within_ns` before the latest stamp; the earlier half where there are
    /// `most` even so.
    pub(crate) fn take_before(&mut self, within_ns: i64, most: usize) -> Series {
        let before_ns = self.t_ns.last().map_or(i64::MIN, |last_ns| last_ns.saturating_sub(within_ns));
        let mut count = self.t_ns.partition_point(|&t_ns| t_ns < before_ns);
        let sorted_late = self.late.range(..before_ns).count();
        let before_ns = if self.len() - count - sorted_late >= most {
            count = self.t_ns.len() / 2;
            // All late ones: a single stamp may be the latest for long.
            i64::MAX
        } else {
            before_ns
        };
        self.take(count, before_ns)
    }

    /// The earliest stamp.
    pub(crate) fn first_ns(&self) -> Option<i64> {
        let late = self.late.first_key_value().map(|(&t_ns, _)| t_ns);
        self.t_ns.first().copied().into_iter().chain(late).min()
    }

    /// Takes out, in order, what lies before an instant.
    pub(crate) fn take_until(&mut self, before_ns: i64) -> Series {
        self.take(self.t_ns.partition_point(|&t_ns| t_ns < before_ns), before_ns)
    }

    /// Takes out, in order, the first `count` of those that came in order, and the late ones before an instant.
    fn take(&mut self, count: usize, late_before_ns: i64) -> Series {
        let later = self.late.split_off(&late_before_ns);
        let late = std::mem::replace(&mut self.late, later);
        let early =
            Self { t_ns: self.t_ns.drain(..count).collect(), values: self.values.drain(..count).collect(), late };
        early.sorted()
    }

    /// All samples in the order of their stamps.
    fn sorted(self) -> Series {
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

impl Keep for ColumnSamples {
    type Kept = Series;
    const HOLDS_ALL: bool = true;

    fn add(&mut self, now_ns: i64, value: f64) -> bool {
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

    fn finish(self) -> Option<Series> {
        Some(self.sorted()).filter(|(t_ns, _)| !t_ns.is_empty())
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
        assert_eq!(samples.len(), 5);
        let mut parts = samples.clone();
        assert_eq!(parts.take_before(13, 100), (vec![3, 5], vec![6.0, 1.0]));
        assert_eq!(parts.take_before(13, 3), (vec![7, 9], vec![3.0, 2.0]));
        assert_eq!(parts.finish(), Some((vec![20], vec![7.0])));
        assert_eq!(samples.finish(), Some((vec![3, 5, 7, 9, 20], vec![6.0, 1.0, 3.0, 2.0, 7.0])));
        assert_eq!(ColumnSamples::default().finish(), None);
    }
}
