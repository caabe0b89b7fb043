//! Random numbers fixed by a path of keys, never by the order of drawing.

use rand_core::Rng;
use rand_pcg::Pcg64;

/// `SplitMix64`: one round of mixing.
pub(crate) fn mix(key: u64) -> u64 {
    let mut z = key.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// The key of a text under a key.
pub(crate) fn key(seed: u64, name: &str, index: u64) -> u64 {
    let start = mix(mix(seed) ^ index);
    name.bytes().fold(start, |k, b| mix(k ^ u64::from(b)))
}

/// A stream of random numbers of one purpose.
#[derive(Debug, Clone)]
pub(crate) struct Stream {
    rng: Pcg64,
}

impl Stream {
    /// The stream of a purpose under a seed.
    pub(crate) fn new(seed: u64, name: &str, index: u64) -> Self {
        let a = key(seed, name, index);
        let words = [mix(a), mix(a ^ 1), mix(a ^ 2), mix(a ^ 3)].map(u128::from);
        Self { rng: Pcg64::new((words[0] << 64) | words[1], (words[2] << 64) | words[3]) }
    }

    /// Uniform in 0..1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in `low..high`.
    pub(crate) fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Normal with zero mean and the given deviation, cut at three deviations.
    pub(crate) fn normal(&mut self, deviation: f64) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        let angle = std::f64::consts::TAU * self.unit();
        deviation * (radius * angle.cos()).clamp(-3.0, 3.0)
    }

    /// Plus or minus one.
    pub(crate) fn sign(&mut self) -> f64 {
        if self.unit() < 0.5 { -1.0 } else { 1.0 }
    }

    /// An index below `n`.
    pub(crate) fn index(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n.saturating_sub(1))
    }

    /// Shuffles in place.
    pub(crate) fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, self.index(last + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Stream;

    #[test]
    fn a_path_fixes_the_numbers_and_their_moments_are_right() {
        let first = |n, i| Stream::new(3, n, i).unit();
        assert_eq!(first("a", 0), first("a", 0));
        assert_ne!(first("a", 0), first("a", 1));
        assert_ne!(first("a", 0), first("b", 0));
        let mut s = Stream::new(1, "normal", 0);
        let x: Vec<f64> = (0..4000).map(|_| s.normal(2.0)).collect();
        let square = x.iter().map(|x| x * x).sum::<f64>() / 4000.0;
        assert!((square - 4.0).abs() < 0.3, "{square}");
    }
}
