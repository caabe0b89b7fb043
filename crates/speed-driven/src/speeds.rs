//! Speeds that are measured with noise, and speeds that are commanded beside them.

use inference::robust::{MAD_TO_SIGMA, median};
use recordings::Channel;

use crate::clock;
use crate::settings::{MEASURING, measuring::Rows};

const ROWS: Rows = MEASURING.rows;

/// Measured speeds, averaged where they scatter so much from row to row that no speed would count as steady.
pub(crate) fn steadied(time: &[f64], speed: [Vec<f64>; 2]) -> ([Vec<f64>; 2], Option<f64>) {
    // By second differences, to which a steady acceleration adds nothing; their variance is six times that of a reading.
    let scatter = |z: &Vec<f64>| {
        let moving = z.windows(3).filter(|w| w.iter().all(|v| *v != 0.0));
        MAD_TO_SIGMA / (1.0 + 4.0 + 1.0_f64).sqrt()
            * median(moving.map(|w| (w[2] - 2.0 * w[1] + w[0]).abs())).unwrap_or(0.0)
    };
    let sigma = speed.iter().map(scatter).fold(0.0, f64::max);
    if sigma <= ROWS.speed_noise {
        return (speed, None);
    }
    let period = median(time.windows(2).map(|w| w[1] - w[0])).unwrap_or(0.0);
    let width = ((sigma / ROWS.speed_noise).powi(2).ceil() * period).min(ROWS.speed_mean);
    if width <= period {
        return (speed, None);
    }
    (speed.map(|z| clock::box_mean(time, &z, width)), Some(width))
}

/// What was commanded last at a stamp; `None` where that is too old to be still obeyed.
pub(crate) fn held(c: &Channel, t: i64) -> Option<f64> {
    let k = c.t_ns().partition_point(|own| *own <= t).checked_sub(1)?;
    ((t - c.t_ns()[k]) as f64 * 1e-9 <= ROWS.command_age).then(|| c.values()[k])
}

/// The same at each of these stamps, m/s; 0 where nothing is obeyed.
pub(crate) fn held_at(c: &Channel, stamps: &[i64], radius: f64) -> Vec<f64> {
    stamps.iter().map(|t| radius * held(c, *t).unwrap_or(0.0)).collect()
}

#[cfg(test)]
mod tests {
    use recordings::Signal;

    use super::*;

    #[test]
    fn speeds_that_scatter_are_averaged_and_those_that_change_are_not() {
        let time: Vec<f64> = (0..400).map(|k| 0.05 * f64::from(k)).collect();
        let ramp: Vec<f64> = time.iter().map(|t| 0.2 + 0.1 * t).collect();
        let (same, window) = steadied(&time, [ramp.clone(), ramp.clone()]);
        assert_eq!((&same[0], window), (&ramp, None));

        let rough = |k: usize| 0.012 * [1.0, -0.6, 0.2, -1.2, 0.9, -0.3][k % 6];
        let noisy: Vec<f64> = ramp.iter().enumerate().map(|(k, v)| v + rough(k)).collect();
        let (smooth, window) = steadied(&time, [noisy.clone(), noisy]);
        assert!(window.is_some_and(|window| window > 0.05 && window <= ROWS.speed_mean), "{window:?}");
        let off = (40..360).map(|k| (smooth[0][k] - ramp[k]).abs()).fold(0.0, f64::max);
        assert!(off < 0.006, "{off}");
    }

    #[test]
    fn a_command_is_held_until_it_is_too_old() {
        let stamps = [0, 100_000_000, 200_000_000].to_vec();
        let commands = Channel::new(Signal::CommandSpeedLeft, 0, stamps, vec![1.0, 2.0, 3.0]).expect("a channel");
        let at = [-50_000_000, 150_000_000, 900_000_000, 5_000_000_000];
        assert_eq!(held_at(&commands, &at, 0.5), [0.0, 1.0, 1.5, 0.0]);
    }
}
