//! Velocities from poses on a grid of steps: slopes of parabolas.

/// Rates at a step by a parabola through the steps from `first` to `last`: slope at the step. The way is added up in the axes
/// of the body, so that a turn does not shorten it. `step`: between two poses, s.
pub fn slope(pose: &[[f64; 3]], [first, last]: [usize; 2], at: usize, step: f64) -> Option<[f64; 3]> {
    let mut way = Vec::with_capacity(last.saturating_sub(first) + 1);
    let mut sum = [0.0; 3];
    way.push(sum);
    for k in first..last {
        let (a, b) = (pose.get(k)?, pose.get(k + 1)?);
        let (sin, cos) = (0.5 * (a[2] + b[2])).sin_cos();
        let d = [b[0] - a[0], b[1] - a[1]];
        sum = [sum[0] + d[0] * cos + d[1] * sin, sum[1] + d[1] * cos - d[0] * sin, sum[2] + b[2] - a[2]];
        way.push(sum);
    }
    let [ahead, left, turning] =
        [0, 1, 2].map(|axis| parabola(way.iter().map(|w| w[axis]), at.checked_sub(first), step));
    let (sin, cos) = pose.get(at)?[2].sin_cos();
    let out = [ahead * cos - left * sin, ahead * sin + left * cos, turning];
    out.iter().all(|r| r.is_finite()).then_some(out)
}

/// Slope, per second, at a step of the parabola through values of steps.
pub fn parabola(values: impl ExactSizeIterator<Item = f64>, at: Option<usize>, step: f64) -> f64 {
    let n = values.len() as f64;
    let x = |k: usize| k as f64 - 0.5 * (n - 1.0);
    let (mut s2, mut s4, mut sum, mut sx, mut sxx) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (k, y) in values.enumerate() {
        s2 += x(k).powi(2);
        s4 += x(k).powi(4);
        sum += y;
        sx += x(k) * y;
        sxx += x(k).powi(2) * y;
    }
    let bend = s4 - s2 * s2 / n;
    let second = if n > 3.0 { (sxx - s2 * sum / n) / bend } else { 0.0 };
    at.map_or(f64::NAN, |at| (sx / s2 + 2.0 * second * x(at)) / step)
}

/// Smoothed pose and rates at the end of the steps from `first` to `last`.
pub fn end(pose: &[[f64; 3]], last: usize, past: f64, step: f64) -> Option<([f64; 3], [f64; 3])> {
    let first = last.checked_sub((past / step).round() as usize)?;
    Some((pose[last], slope(pose, [first, last], last, step)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 0.02;

    #[test]
    fn a_fast_turn_is_not_slower_for_being_smoothed() {
        let (speed, rate): (f64, f64) = (1.5, 5.0);
        let at = |k: i32| {
            let yaw = rate * STEP * f64::from(k);
            [speed / rate * yaw.sin(), -speed / rate * yaw.cos(), yaw]
        };
        let pose: Vec<[f64; 3]> = (0..11).map(at).collect();
        let found = slope(&pose, [0, 10], 5, STEP).expect("a slope");
        assert!((found[0].hypot(found[1]) - speed).abs() < 2e-3 * speed, "{found:?}");
        assert!((found[2] - rate).abs() < 1e-9 && (found[1].atan2(found[0]) - pose[5][2]).abs() < 1e-3, "{found:?}");
    }
}
