//! When the identifier's residual torque leaves what the references show in such driving.

use inference::robust::NINETY_FIVE;

use crate::locate::change::{Reference, Sense, find};
use crate::locate::null::Null;
use crate::locate::times::span;
use crate::locate::torque::Followed;
use crate::settings::locate::{Bands, SETTINGS};
use crate::windows::{Cut, WINDOW};
use verdict::ResidualTorque;

const BANDS: Bands = SETTINGS.bands;

/// Mean over some windows of one side's estimate, with the driving it was made in.
#[derive(Debug, Clone, Copy)]
struct Bin {
    /// Not a number while the weights settle, N m.
    torque: f64,
    /// |Speed difference of the sides| and |change of this side's speed|, rad/s.
    driving: [f64; 2],
}

fn bins(f: &Followed, side: usize, rows: usize, settled: usize) -> Vec<Bin> {
    let bin = |(i, bin): (usize, &[[f64; 2]])| {
        let (from, until) = (i * rows, (i * rows + bin.len()).min(f.speed.len() - 1));
        let turning = f.speed[from..until].iter().map(|v| v[1] - v[0]).sum::<f64>() / bin.len() as f64;
        let mean = bin.iter().map(|t| t[side]).sum::<f64>() / bin.len() as f64;
        Bin {
            torque: if from >= settled { mean } else { f64::NAN },
            driving: [turning.abs(), (f.speed[until][side] - f.speed[from][side]).abs()],
        }
    };
    f.estimate.chunks(rows).enumerate().map(bin).collect()
}

/// What the references show on one side: mean, and scatter by the driving.
struct Band {
    /// Run, driving, squared deviation.
    known: Vec<(usize, [f64; 2], f64)>,
    mean: f64,
    variance: f64,
}

impl Band {
    fn new(references: &[Vec<Bin>]) -> Option<Self> {
        let all = || references.iter().flatten().filter(|b| b.torque.is_finite());
        let n = all().count() as f64;
        if n < BANDS.least_bins {
            return None;
        }
        let mean = all().map(|b| b.torque).sum::<f64>() / n;
        let of = |(r, run): (usize, &Vec<Bin>)| -> Vec<(usize, [f64; 2], f64)> {
            let valid = run.iter().filter(|b| b.torque.is_finite());
            valid.map(|b| (r, b.driving, (b.torque - mean).powi(2))).collect()
        };
        let known: Vec<(usize, [f64; 2], f64)> = references.iter().enumerate().flat_map(of).collect();
        let variance = known.iter().map(|k| k.2).sum::<f64>() / n;
        Some(Self { known, mean, variance })
    }

    /// Variance of fault-free bins driven alike: kernel mean, unit bandwidth in rad/s, begun with
    /// the overall variance.
    fn variance(&self, driving: [f64; 2], without: Option<usize>) -> f64 {
        let (mut weight, mut sum) = (BANDS.pseudo_bins, BANDS.pseudo_bins * self.variance);
        for (_, d, v) in self.known.iter().filter(|k| Some(k.0) != without) {
            let w = (-0.5 * ((d[0] - driving[0]).powi(2) + (d[1] - driving[1]).powi(2))).exp();
            weight += w;
            sum += w * v;
        }
        sum / weight + BANDS.least_sigma * BANDS.least_sigma
    }

    /// Bins in fault-free standard deviations; a reference in those of the others.
    fn scaled(&self, bins: &[Bin], without: Option<usize>) -> Vec<f64> {
        bins.iter().map(|b| (b.torque - self.mean) / self.variance(b.driving, without).sqrt()).collect()
    }
}

/// Residual torque of each recording and side, and when it leaves what the references show in such driving.
pub(crate) fn residual_torque(cuts: &[Cut], followed: &[Followed], references: &[Followed]) -> Vec<ResidualTorque> {
    let Some(cut) = cuts.first() else { return Vec::new() };
    let longest = followed.iter().map(|f| f.estimate.len()).max().unwrap_or(0);
    let usual = ((BANDS.windows as f64 * WINDOW / cut.period).round() as usize).max(1);
    let rows = usual * longest.div_ceil(usual * BANDS.most_bins).max(1);
    let settled = (BANDS.settled / cut.period) as usize;

    // What the references show, each beside the others.
    let known = [0, 1].map(|j| references.iter().map(|f| bins(f, j, rows, settled)).collect::<Vec<_>>());
    let [Some(left), Some(right)] = [Band::new(&known[0]), Band::new(&known[1])] else { return Vec::new() };
    let bands = [left, right];
    let apart = |r: usize| (references.len() > 1).then_some(r);
    let of = |(runs, band): (&Vec<Vec<Bin>>, &Band)| -> Vec<Vec<f64>> {
        runs.iter().enumerate().map(|(r, run)| band.scaled(run, apart(r))).collect()
    };
    let series: Vec<Vec<Vec<f64>>> = known.iter().zip(&bands).map(of).collect();
    let nulls = series.iter().map(|k| Null::new(k, BANDS.between, BANDS.least_within)).collect();
    let reference = Reference { series, nulls, sense: Sense::Either };

    let block = cut.segments.first().map_or(1, |s| s.windows * cut.rows_per_window / rows).max(1);
    let threshold = reference.threshold(longest.div_ceil(rows), block);

    let mut out = Vec::new();
    for (cut, f) in cuts.iter().zip(followed) {
        for (j, null) in reference.nulls.iter().enumerate() {
            let Some(null) = null else { continue };
            let bins = bins(f, j, rows, settled);
            let y = bands[j].scaled(&bins, None);
            let seconds = rows as f64 * cut.period;
            let found = find(&y, null, reference.sense, threshold);
            let valid = || bins.iter().filter(|b| b.torque.is_finite());
            let n = (valid().count() as f64).max(1.0);
            let fault_free = (valid().map(|b| bands[j].variance(b.driving, None)).sum::<f64>() / n).sqrt();
            let half = NINETY_FIVE * fault_free;
            out.push(ResidualTorque {
                recording: cut.name.clone(),
                side: inference::words::side(j).into(),
                mean: valid().map(|b| b.torque).sum::<f64>() / n,
                rms: (valid().map(|b| (b.torque - bands[j].mean).powi(2)).sum::<f64>() / n).sqrt(),
                band: [bands[j].mean - half, bands[j].mean + half],
                spans: found.iter().map(|c| span(cut, "residual torque", Some(j), c, y.len(), seconds)).collect(),
                certificate: f.certificate[j],
            });
        }
    }
    out
}
