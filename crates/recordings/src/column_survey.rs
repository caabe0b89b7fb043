//! What a column of a table holds: numbers, gaps, and whether it looks like a time.

use crate::cell::CellError;
use crate::header::split_unit;
use crate::units::{Unit, parse_unit};

/// What a column holds.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ColumnContents {
    /// Its name in the header.
    pub name: String,
    /// Cells with a number.
    pub numbers: u64,
    /// Empty cells.
    pub empty: u64,
    /// Cells with something else: text, NaN, infinity.
    pub other: u64,
    /// The first of those others, shortened.
    pub example: Option<String>,
    /// Smallest and largest number.
    pub range: Option<(f64, f64)>,
    /// Where it looks like a time, which.
    pub time: Option<TimeLike>,
}

impl ColumnContents {
    /// True when the name says that this is a time.
    pub(crate) fn is_called_time(&self) -> bool {
        let name = self.name.to_lowercase();
        name.contains("time")
            || name.contains("stamp")
            || name == "t"
            || name.starts_with("t_")
            || name.starts_with("t [")
    }
}

/// A column that rises from row to row, as a time does.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TimeLike {
    /// From the first row to the last, in s.
    pub span_s: f64,
    /// Rows per second.
    pub rate_hz: f64,
    /// The unit for which both hold, as a mapping writes it.
    pub unit: &'static str,
    /// What the unit was inferred from.
    pub unit_by: UnitBy,
}

/// What the unit of a time was inferred from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitBy {
    /// The column's name or type, or a unit below the name.
    Name,
    /// The size of its numbers, as a time since 1970.
    Size,
    /// Nothing: seconds are most usual.
    Nothing,
}

/// Units of a time: as a mapping writes it, seconds, ends of names.
const UNITS: [(&str, f64, &[&str]); 4] = [
    ("s", 1.0, &["_s", "_sec", "_secs", "_seconds"]),
    ("ms", 1e-3, &["_ms", "_msec"]),
    ("us", 1e-6, &["_us", "_usec"]),
    ("ns", 1e-9, &["_ns", "_nsec", "_nanosec"]),
];

/// Looks at the cells of a column.
pub(crate) struct ColumnSurvey {
    seen: ColumnContents,
    first: f64,
    last: f64,
    /// Steps from number to number that rise, and that fall.
    up: u64,
    down: u64,
    /// Nanoseconds in a unit, where the column's type says them.
    pub(crate) ns_per_unit: Option<i64>,
}

impl ColumnSurvey {
    /// A survey of a column.
    pub(crate) const fn new(name: String) -> Self {
        let seen = ColumnContents { name, numbers: 0, empty: 0, other: 0, example: None, range: None, time: None };
        Self { seen, first: 0.0, last: 0.0, up: 0, down: 0, ns_per_unit: None }
    }

    /// Looks at a cell; `text` is asked for the first that is no number.
    pub(crate) fn look(&mut self, cell: Result<Option<f64>, CellError>, text: impl FnOnce() -> String) {
        let value = match cell {
            Ok(Some(value)) => value,
            Ok(None) => return self.seen.empty += 1,
            Err(_) => {
                self.seen.example.get_or_insert_with(text);
                return self.seen.other += 1;
            }
        };
        let (least, most) = self.seen.range.unwrap_or((value, value));
        self.seen.range = Some((least.min(value), most.max(value)));
        if self.seen.numbers == 0 {
            self.first = value;
        } else {
            self.up += u64::from(value > self.last);
            self.down += u64::from(value < self.last);
        }
        self.last = value;
        self.seen.numbers += 1;
    }

    /// What the column holds.
    pub(crate) fn finish(self) -> ColumnContents {
        let time = self.time();
        ColumnContents { time, ..self.seen }
    }

    fn time(&self) -> Option<TimeLike> {
        let steps = self.seen.numbers.saturating_sub(1);
        // Stamps may repeat, a few rows may be late, and units may stand below the header.
        let rises = self.last > self.first && 2 * self.up >= steps && 100 * self.down <= steps;
        if !rises || steps < 2 || 100 * self.seen.other > self.seen.numbers {
            return None;
        }
        let (unit, seconds, unit_by) = self.unit();
        let span_s = (self.last - self.first) * seconds;
        Some(TimeLike { span_s, rate_hz: steps as f64 / span_s, unit, unit_by })
    }

    fn unit(&self) -> (&'static str, f64, UnitBy) {
        let of = |known: &(&'static str, f64, &[&str]), by| (known.0, known.1, by);
        let name = self.seen.name.to_lowercase();
        let in_brackets = split_unit(&self.seen.name).map(|(_, unit)| unit).or(self.seen.example.as_deref());
        let in_brackets = in_brackets.and_then(parse_unit);
        let factor = self.ns_per_unit.map(|ns| ns as f64 * 1e-9);
        let factor = factor.or(in_brackets.filter(|scale| scale.unit == Unit::Second).map(|scale| scale.factor));
        let by_name = UNITS.iter().find(|(_, seconds, ends)| match factor {
            Some(factor) => (factor / seconds - 1.0).abs() < 1e-6,
            None => ends.iter().any(|end| name.ends_with(end)),
        });
        if let Some(known) = by_name {
            return of(known, UnitBy::Name);
        }
        // Since 1970 it is more than 1e9 s and will be less than 1e10 s for long.
        let size = UNITS.iter().find(|(_, seconds, _)| (0.5e9..1e10).contains(&(self.first * seconds)));
        size.map_or(("s", 1.0, UnitBy::Nothing), |known| of(known, UnitBy::Size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, numbers: &[f64]) -> ColumnContents {
        let mut survey = ColumnSurvey::new(name.to_owned());
        for &number in numbers {
            survey.look(Ok(Some(number)), String::new);
        }
        survey.finish()
    }

    #[test]
    fn a_time_rises_and_its_unit_is_inferred() {
        let unit = |name: &str, numbers: &[f64]| of(name, numbers).time.map(|time| (time.unit, time.unit_by));
        assert_eq!(unit("t", &[0.0, 0.1, 0.2]), Some(("s", UnitBy::Nothing)));
        assert_eq!(unit("t_ms", &[0.0, 10.0, 20.0]), Some(("ms", UnitBy::Name)));
        assert_eq!(unit("t [us]", &[0.0, 10.0, 20.0]), Some(("us", UnitBy::Name)));
        assert_eq!(unit("stamp", &[1.7e18, 1.7e18 + 1e9, 1.7e18 + 2e9]), Some(("ns", UnitBy::Size)));
        assert_eq!(unit("stamp", &[1.7e9, 1.7e9 + 0.5, 1.7e9 + 1.0]), Some(("s", UnitBy::Size)));
        assert_eq!(unit("speed", &[0.0, 1.0, 0.5, 2.0]), None);
        assert_eq!(unit("mode", &[0.0, 0.0, 0.0, 0.0, 1.0]), None);
        assert_eq!(unit("t", &[0.0, 1.0]), None);
        let mut survey = ColumnSurvey::new("Time".to_owned());
        survey.look(Err(CellError::NotANumber), || "ms".to_owned());
        for k in 0..200 {
            survey.look(Ok(Some(f64::from(k))), String::new);
        }
        let seen = survey.finish();
        assert_eq!((seen.other, seen.time.unwrap().unit, seen.example.as_deref()), (1, "ms", Some("ms")));
        let time = of("t_ms", &[0.0, 10.0, 20.0]).time.unwrap();
        assert!((time.span_s - 0.02).abs() < 1e-12 && (time.rate_hz - 100.0).abs() < 1e-9);
    }
}
