//! Two clocks that drift: the gyro's against the speeds', from the turning itself and no assumed track.

/// Nodes of the warp, s.
const NODE: f64 = 2.0;
/// Largest lag and its grid, s.
const MOST_LAG: f64 = 2.0;
const LAG_STEP: f64 = 0.05;
/// Window of a local correlation, s.
const WINDOW: f64 = 8.0;
/// Least spread of the speed difference in a window, m/s: below it there is no turning to align.
const LEAST_TURNING: f64 = 0.008;
/// Correlations count as if this many windows' worth of samples were independent, per second of window and node.
const EVIDENCE: f64 = 4.0;
/// The clocks wander by about this much between nodes, s.
const WANDER: f64 = 0.15;
/// Weight of the anchors: both files begin together and end together, per second of lag.
const ANCHOR: f64 = 13.3;

/// Mean over `width` seconds about each sample.
pub(crate) fn box_mean(t: &[f64], z: &[f64], width: f64) -> Vec<f64> {
    let mut sum = vec![0.0; z.len() + 1];
    for (i, v) in z.iter().enumerate() {
        sum[i + 1] = sum[i] + v;
    }
    let (mut a, mut b) = (0, 0);
    t.iter()
        .map(|&now| {
            while t[a] < now - 0.5 * width {
                a += 1;
            }
            while b < t.len() && t[b] <= now + 0.5 * width {
                b += 1;
            }
            (sum[b] - sum[a]) / (b - a).max(1) as f64
        })
        .collect()
}

/// Linear interpolation, held beyond the ends.
pub(crate) fn interpolate(t: &[f64], z: &[f64], at: f64) -> f64 {
    match t.partition_point(|&x| x <= at) {
        0 => z.first().copied().unwrap_or(0.0),
        i if i >= t.len() => z.last().copied().unwrap_or(0.0),
        i => {
            let f = (at - t[i - 1]) / (t[i] - t[i - 1]);
            z[i - 1] * (1.0 - f) + z[i] * f
        }
    }
}

fn correlation(pairs: impl Iterator<Item = (f64, f64)> + Clone) -> Option<(f64, f64)> {
    let n = pairs.clone().count() as f64;
    if n < 20.0 {
        return None;
    }
    let (mx, my) = pairs.clone().fold((0.0, 0.0), |s, p| (s.0 + p.0 / n, s.1 + p.1 / n));
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for (x, y) in pairs {
        xx += (x - mx).powi(2) / n;
        yy += (y - my).powi(2) / n;
        xy += (x - mx) * (y - my) / n;
    }
    (yy > 0.0 && xx > 0.0).then(|| (xy / (xx * yy).sqrt(), xx))
}

/// Lag of the second clock at each time of the first: `yaw(t + lag)` goes with `turning(t)`.
///
/// The cheapest path (Viterbi) over lags at nodes every 2 s: local correlation of speed difference and yaw rate, a
/// cost on wandering, anchors at both ends. A stretch without turning is bridged.
pub(crate) fn align(time: &[f64], turning: &[f64], yaw_time: &[f64], yaw: &[f64]) -> Vec<f64> {
    let (Some(&first), Some(&last), Some(&yaw_last)) = (time.first(), time.last(), yaw_time.last()) else {
        return vec![0.0; time.len()];
    };
    let nodes = ((last - first) / NODE).ceil() as usize + 1;
    let lags: Vec<f64> =
        (0..=(2.0 * MOST_LAG / LAG_STEP).round() as usize).map(|i| i as f64 * LAG_STEP - MOST_LAG).collect();
    let end_lag = yaw_last - last;
    let mut cost: Vec<Vec<f64>> = Vec::with_capacity(nodes);
    for n in 0..nodes {
        let centre = first + n as f64 * NODE;
        let window: Vec<usize> = (0..time.len()).filter(|&i| (time[i] - centre).abs() <= 0.5 * WINDOW).collect();
        let mut row: Vec<f64> = lags
            .iter()
            .map(|&lag| {
                let pairs = window.iter().map(|&i| (turning[i], interpolate(yaw_time, yaw, time[i] + lag)));
                match correlation(pairs) {
                    Some((rho, spread)) if spread > LEAST_TURNING * LEAST_TURNING => {
                        let rho = rho.clamp(0.0, 0.99);
                        EVIDENCE * (1.0 - rho * rho).ln()
                    }
                    _ => 0.0,
                }
            })
            .collect();
        for (c, &lag) in row.iter_mut().zip(&lags) {
            if n == 0 {
                *c += ANCHOR * lag.abs();
            }
            if n + 1 == nodes {
                *c += ANCHOR * (lag - end_lag).abs();
            }
        }
        cost.push(row);
    }
    let mut best = cost[0].clone();
    let mut from: Vec<Vec<usize>> = Vec::new();
    for row in &cost[1..] {
        let mut next = Vec::with_capacity(lags.len());
        let mut back = Vec::with_capacity(lags.len());
        for (j, &lag) in lags.iter().enumerate() {
            let (i, value) = lags
                .iter()
                .enumerate()
                .map(|(i, &l)| (i, best[i] + (lag - l).abs() / WANDER))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .unwrap_or((j, f64::MAX));
            next.push(value + row[j]);
            back.push(i);
        }
        best = next;
        from.push(back);
    }
    let mut at = (0..lags.len()).min_by(|&a, &b| best[a].total_cmp(&best[b])).unwrap_or(0);
    let mut path = vec![at; nodes];
    for n in (1..nodes).rev() {
        at = from[n - 1][at];
        path[n - 1] = at;
    }
    let at_nodes: Vec<f64> = path.iter().map(|&i| lags[i]).collect();
    let node_time: Vec<f64> = (0..nodes).map(|n| first + n as f64 * NODE).collect();
    time.iter().map(|&t| interpolate(&node_time, &at_nodes, t)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_drifting_lag_from_the_turns() {
        let turn =
            |t: f64| if (t / 7.0).sin() > 0.3 { 0.2 } else { 0.0 } - if (t / 5.0).cos() > 0.8 { 0.3 } else { 0.0 };
        let lag = |t: f64| 0.8 * (t / 40.0);
        let time: Vec<f64> = (0..400).map(|i| f64::from(i) / 6.5).collect();
        let turning: Vec<f64> = time.iter().map(|&t| turn(t)).collect();
        // yaw(t + lag(t)) = turning(t): the gyro's clock runs ahead.
        let yaw_time: Vec<f64> = (0..6200).map(|i| f64::from(i) * 0.01).collect();
        let yaw: Vec<f64> = yaw_time.iter().map(|&t| 1.3 * turn(t - lag(t / 1.02))).collect();
        let found = align(&time, &turning, &yaw_time, &yaw);
        let error = time.iter().zip(&found).map(|(&t, &l)| (l - lag(t)).abs()).fold(0.0, f64::max);
        assert!(error < 0.5, "largest error of the lag {error} s");
        let middle = found[200] - lag(time[200]);
        assert!(middle.abs() < 0.2, "error in the middle {middle} s");
    }
}
