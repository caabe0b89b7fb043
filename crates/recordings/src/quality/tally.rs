//! How often something happened, and where first.

/// How many places are named one by one.
const PLACES_NAMED: usize = 5;

/// One sample of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct At {
    /// Its index, in the order of the file, from 0.
    pub sample: usize,
    /// Its stamp in ns.
    pub t_ns: i64,
}

impl At {
    /// The same sample, counted from `offset` samples earlier.
    pub(super) const fn moved(self, offset: usize) -> Self {
        Self { sample: self.sample + offset, ..self }
    }
}

/// A count and the first few places.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tally {
    /// How often.
    pub count: usize,
    /// Where, at most five times.
    pub first: Vec<At>,
}

impl Tally {
    /// Counts one.
    pub(crate) fn add(&mut self, at: At) {
        self.count += 1;
        if self.first.len() < PLACES_NAMED {
            self.first.push(at);
        }
    }

    /// This and a later one, whose samples are counted from `offset` on.
    pub(super) fn joined(mut self, later: Self, offset: usize) -> Self {
        self.count += later.count;
        self.first.extend(later.first.into_iter().map(|at| at.moved(offset)));
        self.first.truncate(PLACES_NAMED);
        self
    }

    /// Takes the first one back.
    pub(super) fn forget_first(&mut self) {
        self.count = self.count.saturating_sub(1);
        if !self.first.is_empty() {
            self.first.remove(0);
        }
    }
}
