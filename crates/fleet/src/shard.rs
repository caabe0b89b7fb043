//! Which of several machines works on a unit.

use std::str::FromStr;

use sha2::{Digest, Sha256};

/// One of several equal parts of a fleet, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    index: u64,
    count: u64,
}

/// What is no shard.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("a shard is written I/N, from 1/N to N/N, such as 3/64; not `{0}`")]
pub struct ShardError(String);

impl Default for Shard {
    /// All of it.
    fn default() -> Self {
        Self { index: 1, count: 1 }
    }
}

impl Shard {
    /// Whether the unit of this id belongs to it. A hash of the id decides, so that units which come or go move no other.
    pub fn holds(self, id: &str) -> bool {
        let digest = Sha256::digest(id.as_bytes());
        let number = digest.iter().take(8).fold(0, |n, byte| n << 8 | u64::from(*byte));
        number % self.count == self.index - 1
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err(ShardError(text.to_owned())),
        }
    }
}

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::Shard;

    #[test]
    fn every_unit_belongs_to_one_shard_and_shards_are_about_equal() {
        let shards: Vec<Shard> = (1..=7).map(|i| format!("{i}/7").parse().expect("a shard")).collect();
        let mut counts = [0; 7];
        for unit in 0..7000 {
            let id = format!("unit-{unit}/run");
            let holders: Vec<usize> = (0..7).filter(|i| shards[*i].holds(&id)).collect();
            assert_eq!(holders.len(), 1);
            counts[holders[0]] += 1;
        }
        // Five sigmas of a fair deal.
        assert!(counts.iter().all(|n| (850..1150).contains(n)), "{counts:?}");
        assert!(Shard::default().holds("anything"));
    }

    #[test]
    fn what_is_no_shard_is_refused() {
        for text in ["0/3", "4/3", "3", "a/3", "1/0", "-1/3", "1/3/5"] {
            let error = text.parse::<Shard>().expect_err(text).to_string();
            assert!(error.contains(text) && error.contains("3/64"), "{error}");
        }
    }
}
