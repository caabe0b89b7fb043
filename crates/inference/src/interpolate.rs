//! Between the instants of a signal.

/// Linear interpolation of `z` at the instants `t`, which ascend; held beyond the ends, 0 of nothing.
pub fn interpolate(t: &[f64], z: &[f64], at: f64) -> f64 {
    match t.partition_point(|&x| x <= at) {
        0 => z.first().copied().unwrap_or(0.0),
        i if i >= t.len() => z.last().copied().unwrap_or(0.0),
        i => {
            let f = (at - t[i - 1]) / (t[i] - t[i - 1]);
            z[i - 1] * (1.0 - f) + z[i] * f
        }
    }
}
