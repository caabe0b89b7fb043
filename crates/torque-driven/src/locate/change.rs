//! A change of level for a while: two levels, onset and end by profile likelihood, false alarms by resampling.

use inference::robust::{NINETY_FALL, sorted};

use crate::locate::null::Null;
use crate::settings::locate::{Changes, SETTINGS};

const CHANGES: Changes = SETTINGS.changes;

/// Which changes count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sense {
    /// Only upwards.
    Rise,
    /// Either way.
    Either,
}

/// A stretch `from..until` of a series at another level, with the ranges of both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Change {
    pub(crate) from: usize,
    pub(crate) until: usize,
    pub(crate) onset: [usize; 2],
    pub(crate) end: [usize; 2],
    pub(crate) gain: f64,
}

/// Sums over a series from which any stretch's likelihood follows.
struct Sums<'a> {
    null: &'a Null,
    sense: Sense,
    first: Vec<f64>,
    second: Vec<f64>,
}

impl<'a> Sums<'a> {
    fn new(series: &[f64], null: &'a Null, sense: Sense) -> Self {
        let (mut first, mut second) = (vec![0.0], vec![0.0]);
        for y in series {
            // A value that is missing says nothing: it lies at the fault-free mean.
            let z = if y.is_finite() { y - null.mean } else { 0.0 };
            first.push(first[first.len() - 1] + z);
            second.push(second[second.len() - 1] + z * z);
        }
        Self { null, sense, first, second }
    }

    fn over(&self, a: usize, b: usize) -> (f64, f64, f64) {
        ((b - a) as f64, self.first[b] - self.first[a], self.second[b] - self.second[a])
    }

    /// Mean and variance of `a..b` about it; `None` when it does not differ in the sense asked for.
    fn raised(&self, a: usize, b: usize) -> Option<(f64, f64)> {
        let (n, first, second) = self.over(a, b);
        let mean = first / n;
        let counts = self.sense == Sense::Either || mean > 0.0;
        counts.then(|| (mean, (second / n - mean * mean).max(0.0)))
    }

    /// How far `a..b` differs from fault-free runs, whose levels scatter, nats.
    fn differs(&self, a: usize, b: usize) -> f64 {
        let Some((mean, variance)) = self.raised(a, b) else { return 0.0 };
        let (s2, n) = (self.null.within.powi(2), self.null.share * (b - a) as f64);
        let wide = (variance / s2).max(1.0);
        0.5 * mean * mean / (s2 / n + self.null.apart().powi(2)) + 0.5 * n * (wide - 1.0 - wide.ln())
    }

    /// Log-likelihood of a stretch `a..b` on a level of its own, the rest of `low..high` on one
    /// fault-free level, nats.
    fn fits(&self, [a, b]: [usize; 2], [low, high]: [usize; 2]) -> f64 {
        let Some((_, variance)) = self.raised(a, b) else { return f64::MIN };
        let (s2, share) = (self.null.within.powi(2), self.null.share);
        // Driving is uneven: a mismatch scatters more than health, never less.
        let wide = (variance / s2).max(1.0);
        let inside = 0.5 * share * (b - a) as f64 * (wide.ln() + variance / s2 / wide);
        let ((n, first, second), (m, part, squares)) = (self.over(low, high), self.over(a, b));
        let (n, first, second) = (n - m, first - part, second - squares);
        // The fault-free level of this run, held to those of the references.
        let weight = s2 / (share * self.null.apart().powi(2));
        let level = first / (n + weight);
        let outside = 0.5 * share * (second - 2.0 * level * first + (n + weight) * level * level) / s2;
        -inside - outside
    }

    fn most(&self) -> f64 {
        let n = self.first.len() - 1;
        let mut most = 0.0_f64;
        for a in 0..n {
            for b in a + 1..=n {
                most = most.max(self.differs(a, b));
            }
        }
        most
    }
}

/// Stretches of a series that differ by more than the threshold.
pub(crate) fn find(series: &[f64], null: &Null, sense: Sense, threshold: f64) -> Vec<Change> {
    let sums = Sums::new(series, null, sense);
    let mut out = Vec::new();
    let mut open = vec![(0, series.len())];
    while let Some((low, high)) = open.pop() {
        let mut best: Option<Change> = None;
        let range = [low, high];
        for a in low..high {
            for b in a + 1..=high {
                if sums.differs(a, b) > threshold {
                    let gain = sums.fits([a, b], range);
                    if best.is_none_or(|c| gain > c.gain) {
                        best = Some(Change { from: a, until: b, onset: [a; 2], end: [b; 2], gain });
                    }
                }
            }
        }
        let Some(mut found) = best else { continue };

        // Profile of each end, the other one free, outwards from the best until it has fallen too far.
        let (a, b, least) = (found.from, found.until, found.gain - NINETY_FALL);
        let ends = |a: usize| (a + 1..=high).any(|b| sums.fits([a, b], range) >= least);
        let onsets = |b: usize| (low..b).any(|a| sums.fits([a, b], range) >= least);
        found.onset = [
            (low..a).rev().take_while(|&a| ends(a)).last().unwrap_or(a),
            (a + 1..high).take_while(|&a| ends(a)).last().unwrap_or(a),
        ];
        found.end = [
            (low + 1..b).rev().take_while(|&b| onsets(b)).last().unwrap_or(b),
            (b + 1..=high).take_while(|&b| onsets(b)).last().unwrap_or(b),
        ];
        found.gain = sums.differs(a, b);
        out.push(found);
        if out.len() == CHANGES.most {
            break;
        }
        // What the ends leave open belongs to this stretch, not to another one.
        open.extend([(low, found.onset[0]), (found.end[1], high)].into_iter().filter(|(a, b)| b > a));
    }
    out.sort_by_key(|c| c.from);
    out
}

/// The fault-free series of all channels, by run; every channel's null.
pub(crate) struct Reference {
    /// Channel, run, bin.
    pub(crate) series: Vec<Vec<Vec<f64>>>,
    pub(crate) nulls: Vec<Option<Null>>,
    pub(crate) sense: Sense,
}

impl Reference {
    /// What the largest value over all channels of a fault-free run of `bins` stays below in 95 of 100.
    ///
    /// Pseudo-runs are made of stretches of `block` bins of the references, all channels together, each channel moved
    /// by a draw of its scatter between runs, of which a few references tell little: Student's t.
    pub(crate) fn threshold(&self, bins: usize, block: usize) -> f64 {
        let Some(first) = self.series.first() else { return f64::INFINITY };
        let blocks: Vec<(usize, usize)> = first
            .iter()
            .enumerate()
            .flat_map(|(r, run)| (0..run.len() / block.max(1)).map(move |k| (r, k * block)))
            .collect();
        if blocks.is_empty() || bins == 0 {
            return f64::INFINITY;
        }

        let mut draws = Draws::new(CHANGES.seed);
        let largest: Vec<f64> = (0..CHANGES.pseudo_runs)
            .map(|_| {
                let chosen: Vec<(usize, usize)> =
                    (0..bins.div_ceil(block)).map(|_| blocks[draws.below(blocks.len())]).collect();
                let mut most = 0.0_f64;
                for (channel, null) in self.series.iter().zip(&self.nulls) {
                    let Some(null) = null else { continue };
                    let moved = null.apart() * draws.student(null.freedom());
                    let value = |&(r, k): &(usize, usize)| {
                        let centre = mean(&channel[r]);
                        channel[r][k..k + block].iter().map(move |y| null.mean + CHANGES.unseen * (y - centre) + moved)
                    };
                    let series: Vec<f64> = chosen.iter().flat_map(value).take(bins).collect();
                    most = most.max(Sums::new(&series, null, self.sense).most());
                }
                most
            })
            .collect();

        // The order statistic that no more than that share exceeds: a rank, not an estimate of a quantile.
        let few = CHANGES.few[first.len().clamp(1, CHANGES.few.len()) - 1];
        few * sorted(largest)[((1.0 - CHANGES.false_alarms) * CHANGES.pseudo_runs as f64) as usize]
    }
}

fn mean(values: &[f64]) -> f64 {
    let (n, sum) = values.iter().filter(|v| v.is_finite()).fold((0.0, 0.0), |(n, s), v| (n + 1.0, s + v));
    sum / f64::max(n, 1.0)
}

/// Random numbers for resampling: SplitMix64, so that the same recordings give the same answer.
pub(crate) struct Draws(u64);

impl Draws {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in 0..1.
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.uniform() * n as f64) as usize).min(n - 1)
    }

    /// Student's t with so many degrees of freedom.
    fn student(&mut self, freedom: f64) -> f64 {
        let n = freedom.round().max(1.0) as usize;
        let squares: f64 = (0..n).map(|_| self.normal().powi(2)).sum();
        self.normal() / (squares / n as f64).sqrt().max(CHANGES.least_root)
    }

    /// Standard normal: the sum of twelve uniform numbers less six.
    pub(crate) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BINS: usize = 48;
    const BLOCK: usize = 4;

    /// Fault-free runs with scatter between runs and correlation within.
    fn fault_free(draws: &mut Draws, runs: usize) -> Vec<Vec<f64>> {
        (0..runs)
            .map(|_| {
                let (own, mut last) = (0.25 * draws.normal(), 0.0);
                (0..BINS)
                    .map(|_| {
                        last = 0.4 * last + 0.8 * draws.normal();
                        own + last
                    })
                    .collect()
            })
            .collect()
    }

    fn reference(draws: &mut Draws, channels: usize) -> Reference {
        let series: Vec<Vec<Vec<f64>>> = (0..channels).map(|_| fault_free(draws, 3)).collect();
        let nulls = series.iter().map(|s| Null::new(s, 0.25, 0.1)).collect();
        Reference { series, nulls, sense: Sense::Rise }
    }

    #[test]
    fn fault_free_runs_show_a_change_in_at_most_one_of_twenty() {
        let mut draws = Draws::new(3);
        let (mut alarms, mut runs) = (0, 0);
        for _ in 0..100 {
            let reference = reference(&mut draws, 3);
            let threshold = reference.threshold(BINS, BLOCK);
            let new: Vec<Vec<Vec<f64>>> = (0..3).map(|_| fault_free(&mut draws, 3)).collect();
            for r in 0..3 {
                runs += 1;
                let any = (0..3).any(|c| {
                    let null = reference.nulls[c].expect("values");
                    !find(&new[c][r], &null, Sense::Rise, threshold).is_empty()
                });
                alarms += i32::from(any);
            }
        }
        assert!(f64::from(alarms) / f64::from(runs) <= 0.05, "{alarms} of {runs}");
    }

    #[test]
    fn a_change_is_found_between_its_ends_and_the_intervals_hold_them() {
        let mut draws = Draws::new(5);
        let (mut found, mut held, mut near) = (0, 0, 0);
        for _ in 0..50 {
            let reference = reference(&mut draws, 1);
            let threshold = reference.threshold(BINS, BLOCK);
            let mut y = fault_free(&mut draws, 1).remove(0);
            for v in &mut y[14..30] {
                *v += 3.0;
            }
            let changes = find(&y, &reference.nulls[0].expect("values"), Sense::Rise, threshold);
            if let [c] = changes.as_slice() {
                found += 1;
                held += i32::from(c.onset[0] <= 14 && 14 <= c.onset[1]);
                held += i32::from(c.end[0] <= 30 && 30 <= c.end[1]);
                near += i32::from(c.from.abs_diff(14) <= 1) + i32::from(c.until.abs_diff(30) <= 1);
            }
        }
        assert!(found >= 45, "{found} of 50");
        assert!(f64::from(near) >= 0.8 * 2.0 * f64::from(found), "{near} of {}", 2 * found);
        assert!(f64::from(held) >= 0.85 * 2.0 * f64::from(found), "{held} of {}", 2 * found);
    }

    #[test]
    fn a_fall_counts_only_where_either_way_is_asked_for() {
        let mut draws = Draws::new(9);
        let null = reference(&mut draws, 1).nulls[0].expect("values");
        let mut y = fault_free(&mut draws, 1).remove(0);
        for v in &mut y[20..] {
            *v -= 5.0;
        }
        assert!(find(&y, &null, Sense::Rise, 12.0).is_empty());
        assert_eq!(find(&y, &null, Sense::Either, 12.0).last().map(|c| c.until), Some(BINS));
    }
}
