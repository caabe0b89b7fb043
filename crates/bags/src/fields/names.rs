//! The list of names that stands beside lists of numbers, mostly the same in every message.

use re_cdr::{ByteOrder, CdrReader};

use super::cdr::{self, Undecodable};
use super::path::MOST_NAMES;
use super::schema::{Size, Type};

/// A list of names as it stood in the last message; mostly it stands there again.
#[derive(Debug, Default)]
pub(super) struct Names {
    /// What it is in the message.
    bytes: Vec<u8>,
    /// Its place in the message to a multiple of 4, on which padding depends.
    place: usize,
    /// `bytes` and `texts` are those of a list that was read whole.
    whole: bool,
    texts: Vec<String>,
    version: u64,
}

impl Names {
    /// The names; none where there are too many.
    pub(super) fn list(&self) -> &[String] {
        &self.texts
    }

    /// Changes with the names; 0 before the first.
    pub(super) const fn version(&self) -> u64 {
        self.version
    }

    /// Reads the list of this type, whose message starts behind the head with `body`; false when it has too many names,
    /// which are passed over.
    pub(super) fn read<B: ByteOrder>(
        &mut self,
        body: &[u8],
        reader: &mut CdrReader<'_, B>,
        of: &Type,
        size: Size,
    ) -> Result<bool, Undecodable> {
        let start = reader.position();
        let rest = body.get(start..).ok_or(Undecodable)?;
        if self.whole && self.place == start % 4 && rest.starts_with(&self.bytes) {
            reader.read_bytes(self.bytes.len())?;
            return Ok(true);
        }
        self.whole = false;
        self.version += 1;
        self.texts.clear();
        let count = cdr::length(reader, size, of)?;
        if count > MOST_NAMES {
            cdr::skip_items(reader, of, count)?;
            return Ok(false);
        }
        for _ in 0..count {
            self.texts.push(reader.read_str()?.to_owned());
        }
        self.bytes.clear();
        self.bytes.extend_from_slice(rest.get(..reader.position() - start).ok_or(Undecodable)?);
        (self.place, self.whole) = (start % 4, true);
        Ok(true)
    }
}
