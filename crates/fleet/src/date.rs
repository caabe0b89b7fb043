//! When something was recorded.

use chrono::{DateTime, NaiveDate, NaiveTime, SecondsFormat, Utc};
use serde::{Deserialize, Serialize};

/// An instant in UTC; of a date its first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Date(DateTime<Utc>);

impl Date {
    /// An RFC 3339 date (`2026-03-01`) or date-time (`2026-03-01T08:30:00+01:00`).
    ///
    /// # Errors
    /// A sentence on what it should be.
    pub fn parse(text: &str) -> Result<Self, String> {
        if let Ok(instant) = DateTime::parse_from_rfc3339(text) {
            return Ok(Self(instant.with_timezone(&Utc)));
        }
        let day = NaiveDate::parse_from_str(text, "%Y-%m-%d");
        day.map(|day| Self(day.and_time(NaiveTime::MIN).and_utc())).map_err(|_| {
            format!("`{text}` is no date; write it as 2026-03-01, or with its time as 2026-03-01T08:30:00Z")
        })
    }

    /// The instant of a stamp in ns, if it counts from 1970; a robot that counts from its start tells no date.
    pub fn of_stamp(ns: i64) -> Option<Self> {
        diagnosis::visits::is_absolute(ns).then(|| Self(DateTime::from_timestamp_nanos(ns)))
    }

    /// Milliseconds since 1970.
    pub fn milliseconds(self) -> i64 {
        self.0.timestamp_millis()
    }
}

impl std::fmt::Display for Date {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.to_rfc3339_opts(SecondsFormat::AutoSi, true))
    }
}

impl TryFrom<String> for Date {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        Self::parse(&text)
    }
}

impl From<Date> for String {
    fn from(date: Date) -> Self {
        date.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::Date;

    #[test]
    fn dates_with_and_without_time_are_instants_in_utc() {
        let text = |s: &str| Date::parse(s).map(|d| d.to_string());
        assert_eq!(text("2026-03-01").as_deref(), Ok("2026-03-01T00:00:00Z"));
        assert_eq!(text("2026-03-01T08:30:00+01:00").as_deref(), Ok("2026-03-01T07:30:00Z"));
        assert!(text("1.3.2026").is_err_and(|e| e.contains("2026-03-01T08:30:00Z")));
        assert!(Date::parse("2026-03-01") < Date::parse("2026-03-01T00:00:00.5Z"));
    }

    #[test]
    fn stamps_that_count_from_a_start_tell_no_date() {
        assert_eq!(Date::of_stamp(12_000_000_000), None);
        let date = Date::of_stamp(1_772_352_000_250_000_000).expect("absolute");
        assert_eq!((date.to_string().as_str(), date.milliseconds()), ("2026-03-01T08:00:00.250Z", 1_772_352_000_250));
    }
}
