//! Samples of a channel on rows of equal distance.

use recordings::Channel;

use crate::settings::SETTINGS;

/// Mean of the samples in each step; short gaps are bridged by straight lines.
pub(crate) fn binned(channel: &Channel, from_ns: i64, step_ns: f64, count: usize) -> Vec<f64> {
    let (mut sum, mut number) = (vec![0.0; count], vec![0_u32; count]);
    for (t_ns, value) in channel.samples() {
        let k = ((t_ns - from_ns) as f64 / step_ns).floor();
        if k >= 0.0 && (k as usize) < count {
            sum[k as usize] += value;
            number[k as usize] += 1;
        }
    }
    let mut out: Vec<f64> =
        sum.iter().zip(&number).map(|(s, &n)| if n > 0 { s / f64::from(n) } else { f64::NAN }).collect();
    let mut last: Option<usize> = None;
    for k in 0..count {
        if out[k].is_nan() {
            continue;
        }
        if let Some(before) = last.filter(|&before| k - before > 1 && k - before <= SETTINGS.grid.bridged) {
            let (a, b) = (out[before], out[k]);
            for i in before + 1..k {
                out[i] = a + (b - a) * (i - before) as f64 / (k - before) as f64;
            }
        }
        last = Some(k);
    }
    out
}

/// Slope over two steps; NaN at the ends.
pub(crate) fn slope(values: &[f64], period: f64) -> Vec<f64> {
    let mut out = vec![f64::NAN; values.len()];
    for k in 1..values.len().saturating_sub(1) {
        out[k] = (values[k + 1] - values[k - 1]) / (2.0 * period);
    }
    out
}
