//! Random numbers that depend on what they are for, not on when they are drawn.

use rand_core::Rng;
use rand_pcg::Pcg64;

/// Comparison weights are drawn between minus and plus this, rad/s²: the size that weights really take.
const COMPARISON_RANGE: f64 = 30.0;

/// What random numbers are used for. Streams of different purposes are independent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// First layer of the identifier's network.
    IdentifierLayer,
    /// First layer of the controller's network.
    ControllerLayer,
    /// Comparison weights of a certificate.
    Comparison,
    /// Noise of sensors.
    SensorNoise,
    /// Candidates of a search.
    Search,
}

/// A stream of random numbers, fixed by seed, purpose and draw.
#[derive(Debug, Clone)]
pub struct Stream {
    rng: Pcg64,
}

impl Stream {
    /// The stream of a draw.
    pub fn new(seed: u64, purpose: Purpose, draw: u64) -> Self {
        // Streams of a PCG with nearby keys are correlated, so the key is hashed first.
        let mut key = mix(mix(mix(seed) ^ (purpose as u64 + 1)) ^ draw);
        let mut word = || {
            key = mix(key);
            u128::from(key)
        };
        let state = (word() << 64) | word();
        let stream = (word() << 64) | word();
        Self { rng: Pcg64::new(state, stream) }
    }

    /// The next number, uniform in `low..high`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// The next number of a standard normal distribution, by Box and Muller with the same bits everywhere.
    pub fn normal(&mut self) -> f64 {
        // 1 − u is never zero.
        let radius = (-2.0 * nalgebra::ComplexField::ln(1.0 - self.uniform(0.0, 1.0))).sqrt();
        radius * nalgebra::ComplexField::cos(self.uniform(0.0, std::f64::consts::TAU))
    }
}

/// Comparison weights W* for the certificates of a draw, one set per output, rad/s².
pub fn comparison<const N: usize>(seed: u64, draw: u64) -> [[f64; N]; 2] {
    let mut stream = Stream::new(seed, Purpose::Comparison, draw);
    std::array::from_fn(|_| std::array::from_fn(|_| stream.uniform(-COMPARISON_RANGE, COMPARISON_RANGE)))
}

/// SplitMix64: one round of mixing.
fn mix(key: u64) -> u64 {
    let mut z = key.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::{Purpose, Stream};

    #[test]
    fn a_key_fixes_its_numbers_and_other_keys_give_others() {
        let first = |seed, purpose, draw| Stream::new(seed, purpose, draw).uniform(-1.0, 1.0);
        let base = first(1, Purpose::IdentifierLayer, 3);
        assert_eq!(base, first(1, Purpose::IdentifierLayer, 3));
        assert_ne!(base, first(2, Purpose::IdentifierLayer, 3));
        assert_ne!(base, first(1, Purpose::ControllerLayer, 3));
        assert_ne!(base, first(1, Purpose::IdentifierLayer, 4));
    }

    #[test]
    fn normal_numbers_have_the_moments_of_the_distribution() {
        let mut stream = Stream::new(1, Purpose::SensorNoise, 0);
        let n = 20_000;
        let values: Vec<f64> = (0..n).map(|_| stream.normal()).collect();
        let moment = |p| values.iter().map(|v| v.powi(p)).sum::<f64>() / f64::from(n);
        let found = [1, 2, 3, 4].map(moment);
        for (found, expected) in found.into_iter().zip([0.0, 1.0, 0.0, 3.0]) {
            assert!((found - expected).abs() < 0.15, "{found} {expected}");
        }
    }

    #[test]
    fn first_numbers_of_neighbouring_draws_are_uniform() {
        let n = 4000;
        let values: Vec<f64> = (0..n).map(|d| Stream::new(0, Purpose::IdentifierLayer, d).uniform(-1.0, 1.0)).collect();
        let mean = values.iter().sum::<f64>() / n as f64;
        let neighbours = values.windows(2).map(|p| p[0] * p[1]).sum::<f64>() / n as f64;
        assert!(mean.abs() < 0.05 && neighbours.abs() < 0.03, "{mean} {neighbours}");
    }
}
