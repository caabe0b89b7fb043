//! Reading a mapping from TOML: every complaint names the file, the place and the key.

use bags::{Format, LOG_TIME, suggest};
use toml::Spanned;

use crate::channel::Attributes;
use crate::error::RecordingError;
use crate::mapping::{ColumnMapping, FileMapping, Mapping, TimeMapping};
use crate::mapping_raw::{Kind, RawFile, RawMapping, RawSignal, RawTime};
use crate::mapping_text::Text;
use crate::signal::Signal;
use crate::units::Unit;

/// Nanoseconds in a second.
const NS_PER_S: f64 = 1e9;

impl Mapping {
    /// Reads a mapping from TOML text; `source` is the file's name for messages, and the mapping's where it has none.
    ///
    /// # Errors
    /// On bad syntax, unknown keys, signals or units, a unit of the wrong kind, and values without sense; the message
    /// names the place and the key.
    pub fn parse(source: &str, text: &str) -> Result<Self, RecordingError> {
        let text_of = Text { source, text };
        let raw: RawMapping = toml::from_str(text).map_err(|error| RecordingError::MappingSyntax {
            spot: text_of.spot(error.span().map_or(0, |span| span.start)),
            message: suggest::in_words(error.message()),
        })?;
        let place = raw.files.span().start;
        let mut files: Vec<FileMapping> = Vec::new();
        for file in raw.files.into_inner() {
            let file = text_of.file(file, &files, raw.self_describing)?;
            files.push(file);
        }
        if files.is_empty() {
            return Err(text_of.value(place, "files", "no file is described; give at least one [[files]]"));
        }
        Ok(Self { name: raw.name.unwrap_or_else(|| source.to_owned()), files })
    }
}

impl Text<'_> {
    fn file(&self, raw: RawFile, before: &[FileMapping], self_describing: bool) -> Result<FileMapping, RecordingError> {
        let time_at = raw.time.span().start;
        let topic_at = raw.topic.as_ref().map(|topic| topic.span().start);
        let topic = raw.topic.map(Spanned::into_inner);
        let (pattern_at, pattern) = match raw.pattern {
            Some(pattern) => (pattern.span().start, pattern.into_inner()),
            None if topic.is_some() => (topic_at.unwrap_or(time_at), Format::bag_pattern()),
            None => {
                let message = "give the files' names, such as \"*.csv\", or the `topic` of a bag";
                return Err(self.value(time_at, "pattern", message));
            }
        };
        if pattern.matches('*').count() != 1 || pattern.contains(['/', '\\']) {
            let message = format!("`{pattern}` needs one `*` in the place of the run's id and no folder");
            return Err(self.value(pattern_at, "pattern", message));
        }
        let is_topic = |other: &FileMapping| topic.is_some() && other.topic.is_some() && other.topic != topic;
        if before.iter().any(|other| other.pattern == pattern && !is_topic(other)) {
            let message = match &topic {
                Some(topic) => format!("topic `{topic}` of `{pattern}` is given twice"),
                None => format!("`{pattern}` is given twice"),
            };
            return Err(self.value(pattern_at, "pattern", message));
        }
        let delimiter = match raw.delimiter.as_ref().map(|text| text.get_ref().as_bytes()) {
            None => b',',
            Some(&[byte]) if byte.is_ascii() && !byte.is_ascii_alphanumeric() && !b"\"\r\n.+-".contains(&byte) => byte,
            Some(_) => {
                let at = raw.delimiter.map_or(0, |text| text.span().start);
                return Err(self.value(at, "delimiter", "give one character such as \",\" \";\" or \"\\t\""));
            }
        };
        let decimal_comma = match raw.decimal.as_ref().map(|text| (text.get_ref().as_str(), text.span().start)) {
            None | Some((".", _)) => false,
            Some((",", at)) if delimiter == b',' => {
                let message = "a comma cannot stand both in numbers and between fields; set `delimiter`";
                return Err(self.value(at, "decimal", message));
            }
            Some((",", _)) => true,
            Some((_, at)) => return Err(self.value(at, "decimal", "give \".\" or \",\"")),
        };
        if let Some(at) = topic_at.filter(|_| decimal_comma || delimiter != b',') {
            return Err(self.value(at, "topic", "messages have neither `delimiter` nor `decimal`"));
        }
        let time = self.time(raw.time, topic.is_some())?;
        // Files that are runs by themselves have nothing to do with each other.
        let same_run = |other: &&FileMapping| !self_describing || other.pattern == pattern;
        let mut columns = Vec::new();
        for (key, signal) in raw.signals {
            let column = self.column(&key, signal)?;
            let twice = before
                .iter()
                .filter(same_run)
                .find(|file| file.columns.iter().any(|other| other.signal == column.signal));
            if let Some(file) = twice {
                let from = file.topic.as_ref().unwrap_or(&file.pattern);
                let message = format!("already read from `{from}`; a run has each signal once");
                return Err(self.value(key.span().start, key.get_ref(), message));
            }
            columns.push(column);
        }
        if columns.is_empty() {
            return Err(self.value(pattern_at, "signals", format!("`{pattern}` has no signal; give at least one")));
        }
        columns.sort_by_key(|column| column.signal);
        let clock = raw.clock;
        Ok(FileMapping { pattern, topic, self_describing, clock, delimiter, decimal_comma, time, columns })
    }

    fn time(&self, raw: Spanned<RawTime>, of_topic: bool) -> Result<TimeMapping, RecordingError> {
        let at = raw.span().start;
        let RawTime { column, unit, rate_hz } = raw.into_inner();
        let rate_at = rate_hz.as_ref().map_or(at, |rate| rate.span().start);
        let rate_hz = rate_hz.map(Spanned::into_inner);
        if rate_hz.is_some_and(|rate| !rate.is_finite() || rate <= 0.0) {
            return Err(self.value(rate_at, "time.rate_hz", "the rate must be finite and above zero"));
        }
        let is_stamp = |column: &str| column == LOG_TIME || column.ends_with("stamp");
        if let (true, Some(unit), Some(_)) = (of_topic, &unit, column.as_deref().filter(|column| is_stamp(column))) {
            return Err(self.value(unit.span().start, "time.unit", "a stamp is in ns by itself; leave out `unit`"));
        }
        let ns_per_unit = match (&column, unit) {
            (Some(_), Some(unit)) => {
                let scale = self.unit(&unit, "time.unit", Unit::Second, |_| None)?;
                (scale.factor * NS_PER_S).round() as i64
            }
            // Stamps of messages are in ns by themselves.
            (Some(_), None) if of_topic => 1,
            (None, _) if of_topic => {
                let message = "give `column`: \"header.stamp\", \"log_time\" or another field of the message";
                return Err(self.value(at, "time", message));
            }
            (Some(_), None) => {
                return Err(self.value(at, "time", "the column's `unit` is missing, such as \"s\""));
            }
            (None, None) if rate_hz.is_some() => 1,
            (None, _) => {
                return Err(self.value(at, "time", "give `column` and `unit`, or only `rate_hz` to count rows"));
            }
        };
        Ok(TimeMapping { column, ns_per_unit, rate_hz })
    }

    fn column(&self, key: &Spanned<String>, raw: RawSignal) -> Result<ColumnMapping, RecordingError> {
        let name = key.get_ref().as_str();
        let key_at = key.span().start;
        let signal = Signal::from_name(name).ok_or_else(|| RecordingError::UnknownSignal {
            spot: self.spot(key_at),
            name: name.to_owned(),
            hint: Signal::hint(name),
        })?;
        let has_scale = raw.scale.is_some();
        let unit = self.unit(&raw.unit, &format!("{name}.unit"), signal.unit(), |is| {
            is.bridge_to(signal.unit()).map(|needed| if has_scale { Ok(()) } else { Err(needed) })
        })?;
        let scale = match raw.scale {
            None => 1.0,
            Some(scale) if scale.get_ref().is_finite() && *scale.get_ref() > 0.0 => scale.into_inner(),
            Some(scale) => {
                let message = "the scale must be finite and above zero; a turned sign is `sign = -1`";
                return Err(self.value(scale.span().start, &format!("{name}.scale"), message));
            }
        };
        let sign = match raw.sign.as_ref().map(|sign| (*sign.get_ref(), sign.span().start)) {
            None | Some((1, _)) => 1.0,
            Some((-1, at)) if raw.magnitude_only => {
                let message = "a magnitude has no sign to turn; leave out `sign` or `magnitude_only`";
                return Err(self.value(at, &format!("{name}.sign"), message));
            }
            Some((-1, _)) => -1.0,
            Some((other, at)) => {
                return Err(self.value(at, &format!("{name}.sign"), format!("{other} is neither 1 nor -1")));
            }
        };
        let dead_band = match raw.dead_band {
            Some(band) if !band.get_ref().is_finite() || *band.get_ref() < 0.0 => {
                let message = "the dead band must be finite and not negative";
                return Err(self.value(band.span().start, &format!("{name}.dead_band"), message));
            }
            band => band.map(|band| band.into_inner() * unit.factor * scale),
        };
        let set_point = match raw.kind {
            Some(kind) if *kind.get_ref() == Kind::Measured && signal.is_set_point() => {
                let message = "this signal is a set-point by its nature; map a measurement to a measured signal";
                return Err(self.value(kind.span().start, &format!("{name}.kind"), message));
            }
            kind => signal.is_set_point() || kind.is_some_and(|kind| *kind.get_ref() == Kind::SetPoint),
        };
        let attributes = Attributes { magnitude_only: raw.magnitude_only, dead_band, set_point };
        let column_at = raw.column.span().start;
        let column = raw.column.into_inner();
        if column.trim().is_empty() {
            return Err(self.value(column_at, &format!("{name}.column"), "give the column's name"));
        }
        let factor = sign * scale * unit.factor;
        Ok(ColumnMapping { signal, column, unit, factor, optional: raw.optional, attributes })
    }
}
