//! Duplicates by content: the same data in another file, format or at another time of day.

use crate::channel::Channel;
use crate::recording::Recording;

/// Hashes that are kept of one channel or recording: 8 KiB, and a share known to 3 %.
const KEPT: usize = 1024;
/// Fewer patterns than this say nothing: a switch that went on and off is no content.
const TELLING: usize = 8;
/// Recordings that share this part of the smaller one are of the same data. Unrelated ones share next to nothing, the
/// same one stored in single precision shares about three quarters.
const SAME: f64 = 0.5;
/// Distances in time are told to a tenth of a millisecond: formats round stamps, seconds as doubles to 0.2 µs.
const TIME_GRID_NS: i64 = 100_000;
/// Shifts the borders of that grid away from round numbers, on which stamps like to lie.
const TIME_SHIFT_NS: i64 = 31_700;
/// Bits of a value that are not told: 19 of the mantissa are left, 2e-6 of the value. Single precision has 23.
const VALUE_BITS: u32 = 33;

/// What a channel or a recording contains, whatever its file, format, clock offset and units of time.
///
/// Three values in a row that differ from each other, with the times between them, are a pattern; values that repeat
/// are passed over. The fingerprint is the set of the hashes of all patterns, thinned to the 1024 smallest. Hence it is
/// the same when all stamps are moved, and a part of a recording is found in the whole. Other units, signs or a filter
/// make other content.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Fingerprint {
    /// Smallest hashes, in rising order, each once.
    hashes: Vec<u64>,
    /// True when larger ones were left out.
    thinned: bool,
}

impl Fingerprint {
    /// The fingerprint of samples: `t_ns[i]` is the stamp of `values[i]`; values that are not finite are left out.
    pub fn of_samples(t_ns: &[i64], values: &[f64]) -> Self {
        let mut builder = FingerprintBuilder::default();
        t_ns.iter().zip(values).for_each(|(&t_ns, &value)| builder.push(t_ns, value));
        builder.finish()
    }

    /// The fingerprint of a channel.
    pub fn of_channel(channel: &Channel) -> Self {
        Self::of_samples(channel.t_ns(), channel.values())
    }

    /// The fingerprint of all channels of a recording.
    pub fn of(recording: &Recording) -> Self {
        Self::union(recording.channels().iter().map(Self::of_channel))
    }

    /// The fingerprint of several channels together.
    pub fn union(parts: impl IntoIterator<Item = Self>) -> Self {
        let (mut hashes, mut thinned) = (Vec::new(), false);
        for part in parts {
            hashes.extend(part.hashes);
            thinned |= part.thinned;
        }
        let union = Self::thin(hashes);
        Self { thinned: thinned || union.thinned, ..union }
    }

    /// True when the content is too little to tell it from other content: constant signals, a few steps.
    pub fn says_nothing(&self) -> bool {
        self.hashes.len() < TELLING
    }

    /// The share of the smaller content that is also in the other, 0 to 1, to some 3 %: 1 for the same data and for a
    /// part of them, 0 where one says nothing.
    ///
    /// ```
    /// use recordings::Fingerprint;
    /// let t_ns: Vec<i64> = (0..200).map(|i| i * 10_000_000).collect();
    /// let values: Vec<f64> = (0..200).map(|i| f64::from(i * i % 89)).collect();
    /// let later: Vec<i64> = t_ns.iter().map(|t| t + 1_700_000_000_000_000_000).collect();
    /// let run = Fingerprint::of_samples(&t_ns, &values);
    /// assert_eq!(run.shared(&Fingerprint::of_samples(&later, &values)), 1.0);
    /// assert_eq!(run.shared(&Fingerprint::of_samples(&t_ns[..50], &values[..50])), 1.0);
    /// let other: Vec<f64> = values.iter().map(|value| value.sqrt()).collect();
    /// assert!(run.shared(&Fingerprint::of_samples(&t_ns, &other)) < 0.05);
    /// ```
    pub fn shared(&self, other: &Self) -> f64 {
        if self.says_nothing() || other.says_nothing() {
            return 0.0;
        }
        // Beyond the largest hash of a thinned set nothing is known of it.
        let known = |print: &Self| if print.thinned { print.hashes.last().copied() } else { None };
        let limit = known(self).unwrap_or(u64::MAX).min(known(other).unwrap_or(u64::MAX));
        let upto = |print: &Self| print.hashes.partition_point(|&hash| hash <= limit);
        let (mine, theirs) = (&self.hashes[..upto(self)], &other.hashes[..upto(other)]);
        let common = mine.iter().filter(|hash| theirs.binary_search(hash).is_ok()).count();
        common as f64 / mine.len().min(theirs.len()).max(1) as f64
    }

    /// True when at least half of the smaller content is in the other.
    pub fn is_same(&self, other: &Self) -> bool {
        self.shared(other) >= SAME
    }

    fn thin(mut hashes: Vec<u64>) -> Self {
        hashes.sort_unstable();
        hashes.dedup();
        let thinned = hashes.len() > KEPT;
        hashes.truncate(KEPT);
        Self { hashes, thinned }
    }
}

/// Puts together what is of the same data, directly or through others: groups of indexes into `prints`, each in
/// rising order and in the order of their first; one that is like no other is a group of its own.
pub fn group_by_content(prints: &[Fingerprint]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (index, print) in prints.iter().enumerate() {
        let is_like = |group: &Vec<usize>| group.iter().any(|&other| prints[other].is_same(print));
        let (mut like, unlike): (Vec<_>, Vec<_>) = groups.into_iter().partition(is_like);
        like.push(vec![index]);
        let mut joined: Vec<usize> = like.into_iter().flatten().collect();
        joined.sort_unstable();
        groups = unlike;
        groups.push(joined);
    }
    groups.sort_unstable_by_key(|group| group.first().copied());
    groups
}

/// Makes a fingerprint of samples one by one, in memory that does not grow with them.
#[derive(Debug, Clone, Default)]
pub struct FingerprintBuilder {
    /// The last change and the one before it: stamp and rounded value.
    recent: [Option<(i64, u64)>; 2],
    hashes: Vec<u64>,
    /// The largest hash of interest, once some were left out.
    limit: Option<u64>,
}

impl FingerprintBuilder {
    /// Takes a sample; a value that is not finite is left out.
    pub fn push(&mut self, t_ns: i64, value: f64) {
        if !value.is_finite() {
            return;
        }
        let fresh = (t_ns, rounded(value));
        if self.recent[1].is_some_and(|(_, before)| before == fresh.1) {
            return;
        }
        if let [Some(first), Some(second)] = self.recent {
            let after = |from: i64, to: i64| {
                to.saturating_sub(from).saturating_add(TIME_SHIFT_NS).div_euclid(TIME_GRID_NS) as u64
            };
            let pattern = [first.1, second.1, fresh.1, after(first.0, second.0), after(second.0, fresh.0)];
            let hash = pattern.into_iter().fold(0, mixed);
            if self.limit.is_none_or(|limit| hash < limit) {
                self.hashes.push(hash);
            }
        }
        self.recent = [self.recent[1], Some(fresh)];
        if self.hashes.len() >= 8 * KEPT {
            self.thin();
        }
    }

    /// The fingerprint of all samples.
    pub fn finish(mut self) -> Fingerprint {
        self.thin();
        Fingerprint { hashes: self.hashes, thinned: self.limit.is_some() }
    }

    fn thin(&mut self) {
        let print = Fingerprint::thin(std::mem::take(&mut self.hashes));
        self.hashes = print.hashes;
        if print.thinned || self.limit.is_some() {
            self.limit = self.hashes.last().copied();
        }
    }
}

/// A value without its last digits; those with few binary digits lie in the middle of what is put together.
fn rounded(value: f64) -> u64 {
    // Minus zero is zero.
    let bits = (value + 0.0).to_bits();
    bits.saturating_add(1 << (VALUE_BITS - 1)) >> VALUE_BITS
}

/// Mixes a number into a hash: SplitMix64 (Steele, Lea, Flood 2014).
fn mixed(hash: u64, number: u64) -> u64 {
    let mut z = (hash ^ number).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
