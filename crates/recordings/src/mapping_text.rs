//! Complaints about a mapping's text: each with its place.

use toml::Spanned;

use crate::error::RecordingError;
use crate::spot::Spot;
use crate::units::{Scale, Unit, parse_unit, unit_hint};

/// The text that is read, so that a place in it can be told.
pub(crate) struct Text<'a> {
    pub(crate) source: &'a str,
    pub(crate) text: &'a str,
}

impl Text<'_> {
    /// The place of a byte.
    pub(crate) fn spot(&self, offset: usize) -> Spot {
        Spot::of_byte(self.source, self.text, offset)
    }

    /// The complaint about a value at a byte.
    pub(crate) fn value(&self, offset: usize, key: &str, message: impl Into<String>) -> RecordingError {
        RecordingError::MappingValue { spot: self.spot(offset), key: key.to_owned(), message: message.into() }
    }

    /// The unit's meaning; `bridge` may accept another quantity or tell what would be needed for it.
    pub(crate) fn unit(
        &self,
        unit: &Spanned<String>,
        key: &str,
        expected: Unit,
        bridge: impl Fn(Unit) -> Option<Result<(), &'static str>>,
    ) -> Result<Scale, RecordingError> {
        let (spot, key, name) = (self.spot(unit.span().start), key.to_owned(), unit.get_ref().clone());
        let Some(scale) = parse_unit(&name) else {
            let hint = unit_hint(&name);
            return Err(RecordingError::UnknownUnit { spot, key, unit: name, hint });
        };
        let hint = match bridge(scale.unit) {
            _ if scale.unit == expected => return Ok(scale),
            Some(Ok(())) => return Ok(scale),
            Some(Err(needed)) => format!(", or add `scale` ({needed})"),
            None => String::new(),
        };
        Err(RecordingError::WrongUnit { spot, key, unit: name, is: scale.unit, expected, hint })
    }
}
