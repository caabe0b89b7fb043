//! Random numbers fixed by a seed and a path of keys, never by the order of drawing: threads change nothing.

use rand_core::Rng;
use rand_pcg::Pcg64;
use statrs::distribution::{ContinuousCDF, Normal};

/// `SplitMix64`: one round of mixing.
fn mix(key: u64) -> u64 {
    let mut z = key.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// What a stream is drawn for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Purpose {
    /// The constants of a replica.
    Constants,
    /// By how much constants differ in a drive.
    Drive,
    /// The noise of a channel.
    Noise,
    /// The direction of an effect of several components.
    Direction,
    /// By how much constants moved to a visit.
    Visit,
}

/// A stream of random numbers of one purpose.
#[derive(Debug, Clone)]
pub(crate) struct Stream(Pcg64);

impl Stream {
    /// The stream of a purpose under a seed, at a path of numbers.
    pub(crate) fn new(seed: u64, purpose: Purpose, path: &[usize]) -> Self {
        let start = mix(mix(seed) ^ purpose as u64);
        let key = path.iter().fold(start, |key, part| mix(key ^ *part as u64));
        let words = [0, 1, 2, 3].map(|i| u128::from(mix(key ^ i)));
        Self(Pcg64::new((words[0] << 64) | words[1], (words[2] << 64) | words[3]))
    }

    /// Uniform between 0 and 1, both ends left out.
    fn unit(&mut self) -> f64 {
        ((self.0.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    /// Standard normal.
    pub(crate) fn normal(&mut self) -> f64 {
        Normal::standard().inverse_cdf(self.unit())
    }

    /// Standard normal, given that it lies within `most` of zero.
    pub(crate) fn normal_within(&mut self, most: f64) -> f64 {
        let normal = Normal::standard();
        let tail = normal.cdf(-most);
        normal.inverse_cdf(tail + (1.0 - 2.0 * tail) * self.unit())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_fixes_the_numbers_and_their_moments_are_right() {
        let first = |seed, purpose, path: &[usize]| Stream::new(seed, purpose, path).unit();
        let reference = first(3, Purpose::Noise, &[1, 2]);
        assert_eq!(reference, first(3, Purpose::Noise, &[1, 2]));
        for other in
            [first(4, Purpose::Noise, &[1, 2]), first(3, Purpose::Drive, &[1, 2]), first(3, Purpose::Noise, &[2, 1])]
        {
            assert_ne!(reference, other);
        }
        let mut stream = Stream::new(1, Purpose::Noise, &[]);
        let x: Vec<f64> = (0..4000).map(|_| stream.normal()).collect();
        let square = x.iter().map(|x| x * x).sum::<f64>() / 4000.0;
        assert!((square - 1.0).abs() < 0.08 && x.iter().any(|x| x.abs() > 2.5), "{square}");
        assert!((0..4000).all(|_| stream.normal_within(0.5).abs() <= 0.5));
    }
}
