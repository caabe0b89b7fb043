//! Two clocks that drift: the gyro's against the speeds', from the turning itself and no assumed track.

use inference::interpolate;
use inference::robust::{quantile, sorted};

use crate::settings::{MEASURING, measuring::Aligning};

const ALIGNING: Aligning = MEASURING.aligning;

/// The gyro's clock against the speeds', and how well turns that were left out of the alignment agree.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// Lag at each row, s: `yaw(t + lag)` goes with the row at `t`.
    pub lag: Vec<f64>,
    /// For each turn that can tell a lag by itself: the lag aligned without it less its own, s.
    pub left_out: Vec<f64>,
}

impl Alignment {
    /// Median and 90 % quantile of the errors on turns left out, s; `None` below three turns.
    pub fn error(&self) -> Option<[f64; 2]> {
        let sizes = sorted(self.left_out.iter().map(|e| e.abs()));
        if sizes.len() < ALIGNING.least_left_out {
            return None;
        }
        Some([quantile(&sizes, 0.5)?, quantile(&sizes, 0.9)?])
    }
}

/// Mean over `width` seconds about each sample; times ascend.
pub fn box_mean(t: &[f64], z: &[f64], width: f64) -> Vec<f64> {
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

/// Correlation, and variance of the first.
fn correlation(pairs: impl Iterator<Item = (f64, f64)> + Clone) -> Option<(f64, f64)> {
    let n = pairs.clone().count();
    if n < ALIGNING.least_rows {
        return None;
    }
    let n = n as f64;
    let (mx, my) = pairs.clone().fold((0.0, 0.0), |s, p| (s.0 + p.0 / n, s.1 + p.1 / n));
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for (x, y) in pairs {
        xx += (x - mx).powi(2) / n;
        yy += (y - my).powi(2) / n;
        xy += (x - mx) * (y - my) / n;
    }
    (yy > 0.0 && xx > 0.0).then(|| (xy / (xx * yy).sqrt(), xx))
}

/// Speeds and yaw rate of a recording, the latter at every lag of the grid.
struct Clocks<'a> {
    time: &'a [f64],
    turning: &'a [f64],
    lags: Vec<f64>,
    /// Yaw rate by lag and row.
    yaw: Vec<Vec<f64>>,
    /// Lag between the ends of both.
    end_lag: f64,
}

impl Clocks<'_> {
    /// Costs of the lags at each node, from the rows that may be used.
    fn costs(&self, used: impl Fn(usize) -> bool) -> Vec<Vec<f64>> {
        let (first, last) = (self.time[0], self.time[self.time.len() - 1]);
        let nodes = ((last - first) / ALIGNING.node).ceil() as usize + 1;
        let cost = |n: usize| {
            let centre = first + n as f64 * ALIGNING.node;
            let from = self.time.partition_point(|&t| t < centre - 0.5 * ALIGNING.window);
            let until = self.time.partition_point(|&t| t <= centre + 0.5 * ALIGNING.window);
            let window: Vec<usize> = (from..until).filter(|&i| used(i)).collect();
            let of_lag = |(&lag, yaw): (&f64, &Vec<f64>)| {
                let alike = match correlation(window.iter().map(|&i| (self.turning[i], yaw[i]))) {
                    Some((rho, spread)) if spread > ALIGNING.least_turning * ALIGNING.least_turning => {
                        let rho = rho.clamp(0.0, ALIGNING.most_correlation);
                        ALIGNING.evidence * (1.0 - rho * rho).ln()
                    }
                    _ => 0.0,
                };
                let begin = if n == 0 { ALIGNING.anchor * lag.abs() } else { 0.0 };
                let end = if n + 1 == nodes && self.end_lag.abs() <= ALIGNING.most_lag {
                    ALIGNING.anchor * (lag - self.end_lag).abs()
                } else {
                    0.0
                };
                alike + begin + end
            };
            self.lags.iter().zip(&self.yaw).map(of_lag).collect()
        };
        (0..nodes).map(cost).collect()
    }

    /// Lag at each row along the cheapest path (Viterbi) over the nodes.
    fn path(&self, cost: &[Vec<f64>]) -> Vec<f64> {
        let lags = &self.lags;
        let mut best = cost[0].clone();
        let mut from: Vec<Vec<usize>> = Vec::new();
        for row in &cost[1..] {
            let mut next = Vec::with_capacity(lags.len());
            let mut back = Vec::with_capacity(lags.len());
            for (j, &lag) in lags.iter().enumerate() {
                let (i, value) = lags
                    .iter()
                    .enumerate()
                    .map(|(i, &l)| (i, best[i] + (lag - l).abs() / ALIGNING.wander))
                    .min_by(|a, b| a.1.total_cmp(&b.1))
                    .unwrap_or((j, f64::MAX));
                next.push(value + row[j]);
                back.push(i);
            }
            best = next;
            from.push(back);
        }
        let mut at = (0..lags.len()).min_by(|&a, &b| best[a].total_cmp(&best[b])).unwrap_or(0);
        let mut at_nodes = vec![lags[at]; cost.len()];
        for n in (1..cost.len()).rev() {
            at = from[n - 1][at];
            at_nodes[n - 1] = lags[at];
        }
        let node_time: Vec<f64> = (0..cost.len()).map(|n| self.time[0] + n as f64 * ALIGNING.node).collect();
        self.time.iter().map(|&t| interpolate(&node_time, &at_nodes, t)).collect()
    }

    /// Rows of the turns, with some straight driving before and after.
    fn turns(&self) -> Vec<std::ops::Range<usize>> {
        let mut spans: Vec<[f64; 2]> = Vec::new();
        for (&t, d) in self.time.iter().zip(self.turning) {
            if d.abs() <= ALIGNING.turn {
                continue;
            }
            match spans.last_mut() {
                Some(span) if t - span[1] < ALIGNING.turn_pause => span[1] = t,
                _ => spans.push([t, t]),
            }
        }
        let rows = |[a, b]: [f64; 2]| {
            let from = self.time.partition_point(|&t| t < a - ALIGNING.turn_margin);
            from..self.time.partition_point(|&t| t <= b + ALIGNING.turn_margin)
        };
        spans.into_iter().filter(|[a, b]| b - a > ALIGNING.turn_seconds).map(rows).collect()
    }

    /// The lag that a turn tells by itself.
    fn own_lag(&self, turn: &std::ops::Range<usize>) -> Option<f64> {
        let alike = |(&lag, yaw): (&f64, &Vec<f64>)| {
            let (rho, spread) = correlation(turn.clone().map(|i| (self.turning[i], yaw[i])))?;
            (rho > ALIGNING.own_correlation && spread > (ALIGNING.own_spread * ALIGNING.turn).powi(2))
                .then_some((lag, rho))
        };
        let all = self.lags.iter().zip(&self.yaw).filter_map(alike);
        all.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(lag, _)| lag)
    }
}

/// Lag of the second clock at each time of the first: `yaw(t + lag)` goes with `turning(t)`.
///
/// The cheapest path over lags at nodes every 2 s: local correlation of speed difference and yaw rate, a cost on
/// wandering, anchors at both ends. A stretch without turning is bridged. The error is that of turns which were left
/// out of the alignment one at a time and tell a lag of their own.
pub fn align(time: &[f64], turning: &[f64], yaw_time: &[f64], yaw: &[f64]) -> Alignment {
    let (Some(&last), Some(&yaw_last)) = (time.last(), yaw_time.last()) else {
        return Alignment { lag: vec![0.0; time.len()], left_out: Vec::new() };
    };
    // Stamps of a clock that was set meanwhile: nothing to align by.
    if (last - time[0]) / ALIGNING.node > time.len() as f64 {
        return Alignment { lag: vec![0.0; time.len()], left_out: Vec::new() };
    }
    let steps = (2.0 * ALIGNING.most_lag / ALIGNING.lag_step).round() as usize;
    let lags: Vec<f64> = (0..=steps).map(|i| i as f64 * ALIGNING.lag_step - ALIGNING.most_lag).collect();
    let at = |lag: &f64| time.iter().map(|t| interpolate(yaw_time, yaw, t + lag)).collect();
    let clocks = Clocks { time, turning, yaw: lags.iter().map(at).collect(), lags, end_lag: yaw_last - last };
    let left_out = |turn: std::ops::Range<usize>| {
        let own = clocks.own_lag(&turn)?;
        let without = clocks.path(&clocks.costs(|i| !turn.contains(&i)));
        Some(without[usize::midpoint(turn.start, turn.end)] - own)
    };
    let errors = clocks.turns().into_iter().filter_map(left_out).collect();
    Alignment { lag: clocks.path(&clocks.costs(|_| true)), left_out: errors }
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
        let alignment = align(&time, &turning, &yaw_time, &yaw);
        let found = &alignment.lag;
        let error = time.iter().zip(found).map(|(&t, &l)| (l - lag(t)).abs()).fold(0.0, f64::max);
        assert!(error < 0.5, "largest error of the lag {error} s");
        let middle = found[200] - lag(time[200]);
        assert!(middle.abs() < 0.2, "error in the middle {middle} s");
        // Turns that were left out of the alignment say how good it is.
        let [median, most] = alignment.error().expect("three turns at least");
        assert!(median < 0.2 && most < 0.7, "left out: median {median} s, 90 % {most} s");
    }
}
