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

/// Pose at the beginning of each step, between the instants at which it was seen by lines that bridge no gap; yaw without jumps; NaN
/// where it was not seen. `poses`: each with its time from the start of the grid, s.
pub fn on_grid(poses: impl Iterator<Item = (f64, [f64; 3])>, steps: usize, step: f64, gap: f64) -> Vec<[f64; 3]> {
    let mut seen: Vec<(f64, [f64; 3])> = Vec::new();
    for (time, mut pose) in poses {
        if pose.iter().all(|x| x.is_finite()) {
            if let Some((_, last)) = seen.last() {
                pose[2] -= ((pose[2] - last[2]) / std::f64::consts::TAU).round() * std::f64::consts::TAU;
            }
            seen.push((time, pose));
        }
    }
    let mut k = 0;
    (0..steps)
        .map(|at| {
            let time = step * at as f64;
            while k + 2 < seen.len() && seen[k + 1].0 <= time {
                k += 1;
            }
            let (Some((t0, a)), Some((t1, b))) = (seen.get(k), seen.get(k + 1)) else { return [f64::NAN; 3] };
            if t1 - t0 > gap || time < *t0 || time > *t1 {
                return [f64::NAN; 3];
            }
            let share = (time - t0) / (t1 - t0);
            [0, 1, 2].map(|axis| a[axis] + share * (b[axis] - a[axis]))
        })
        .collect()
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

    #[test]
    fn a_pose_on_the_grid_bridges_no_gap_and_its_yaw_does_not_jump() {
        let rows = [(0.0, 3.1), (0.05, -3.1), (0.1, -3.0), (0.4, -2.9), (0.45, -2.8)];
        let poses = rows.into_iter().map(|(t, yaw)| (t, [t, f64::from(t > 0.2), yaw]));
        let pose = on_grid(poses.chain([(0.5, [f64::NAN; 3])]), 25, STEP, 0.1);
        let turn = std::f64::consts::TAU;
        assert!((pose[2][2] - (3.1 + 0.8 * (turn - 6.2))).abs() < 1e-9, "{:?}", pose[2]);
        assert!((pose[4][2] - (turn - 3.04)).abs() < 1e-9 && (pose[4][0] - 0.08).abs() < 1e-12, "{:?}", pose[4]);
        assert!(pose[5..20].iter().all(|p| p[0].is_nan()) && pose[21][1] == 1.0 && pose[24][0].is_nan());
    }
}
