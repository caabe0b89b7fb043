//! Complaints about a mapping's text: a place in it becomes a line.

use toml::Spanned;

use crate::error::RecordingError;
use crate::units::{Scale, Unit, parse_unit, unit_hint};

/// The text that is read, so that a place in it can be told as a line.
pub(crate) struct Text<'a> {
    pub(crate) source: &'a str,
    pub(crate) text: &'a str,
}

impl Text<'_> {
    /// The line (from 1) of a byte.
    pub(crate) fn line(&self, offset: usize) -> usize {
        1 + self.text.bytes().take(offset).filter(|&byte| byte == b'\n').count()
    }

    /// The complaint about a value at a byte.
    pub(crate) fn value(&self, offset: usize, key: &str, message: impl Into<String>) -> RecordingError {
        RecordingError::MappingValue {
            mapping: self.source.to_owned(),
            line: self.line(offset),
            key: key.to_owned(),
            message: message.into(),
        }
    }

    /// The unit's meaning; `bridge` may accept another quantity or tell what would be needed for it.
    pub(crate) fn unit(
        &self,
        unit: &Spanned<String>,
        key: &str,
        expected: Unit,
        bridge: impl Fn(Unit) -> Option<Result<(), &'static str>>,
    ) -> Result<Scale, RecordingError> {
        let (mapping, line) = (self.source.to_owned(), self.line(unit.span().start));
        let (key, name) = (key.to_owned(), unit.get_ref().clone());
        let Some(scale) = parse_unit(&name) else {
            let hint = unit_hint(&name);
            return Err(RecordingError::UnknownUnit { mapping, line, key, unit: name, hint });
        };
        let hint = match bridge(scale.unit) {
            _ if scale.unit == expected => return Ok(scale),
            Some(Ok(())) => return Ok(scale),
            Some(Err(needed)) => format!(", or add `scale` ({needed})"),
            None => String::new(),
        };
        Err(RecordingError::WrongUnit { mapping, line, key, unit: name, is: scale.unit, expected, hint })
    }
}
