//! Recordings beside the simulation, window by window.

use crate::channel::{Channel, Channels};
use crate::fit::Problem;
use crate::leave_out::Simulated;
use crate::locate::fault_free::{Energy, FaultFree};
use crate::windows::{Cut, Segment};
use verdict::{Compared, Trace, instant, rounded};

/// Every recording with what was simulated for it.
pub(crate) fn traces(p: &Problem<'_>, fault_free: &FaultFree, simulated: &[Simulated]) -> Vec<Trace> {
    let nominal = fault_free.energy_of(p, &simulated.iter().map(|s| s.responses.nominal.clone()).collect());
    let best = simulated.iter().map(|s| s.responses.best().clone()).collect();
    let after = fault_free.energy_of(p, &best);
    let of =
        |(r, (cut, s)): (usize, (&Cut, &Simulated))| trace(p, cut, s, [mismatch(&nominal, r), mismatch(&after, r)]);
    p.cuts.iter().zip(simulated).enumerate().map(of).collect()
}

/// Mean over the channels of each window of a recording.
fn mismatch(energy: &Energy, run: usize) -> Vec<Option<f64>> {
    let mean = |window: &Channels<f64>| {
        let valid = || window.iter().filter(|e| e.is_finite());
        (valid().count() > 0).then(|| rounded(valid().sum::<f64>() / valid().count() as f64))
    };
    energy[run].iter().flatten().map(mean).collect()
}

fn trace(p: &Problem<'_>, cut: &Cut, simulated: &Simulated, [before, after]: [Vec<Option<f64>>; 2]) -> Trace {
    let window = cut.rows_per_window as f64 * cut.period;
    let places = || cut.segments.iter().flat_map(|s| (0..s.windows).map(move |w| s.row / cut.rows_per_window + w));
    let has_pose = cut.segments.iter().any(|s| s.shows(Channel::ForwardVelocity));
    let middle = |w: usize| {
        cut.path.get(w).zip(cut.path.get(w + 1)).map_or([0.0; 2], |(a, b)| [0, 1].map(|i| 0.5 * (a[i] + b[i])))
    };
    let mut restarts = Vec::with_capacity(cut.segments.len());
    let mut windows = 0;
    for s in &cut.segments {
        restarts.push(windows);
        windows += s.windows;
    }
    Trace {
        recording: cut.name.clone(),
        left_out: simulated.left_out,
        time: places().map(|w| instant(cut.from + (w as f64 + 0.5) * window)).collect(),
        restarts,
        channels: Channel::ALL.into_iter().filter_map(|c| compared(p, cut, simulated, c)).collect(),
        path: if has_pose { places().map(middle).map(|xy| xy.map(rounded)).collect() } else { Vec::new() },
        before,
        after,
    }
}

/// A channel; `None` when it was not recorded.
fn compared(p: &Problem<'_>, cut: &Cut, simulated: &Simulated, c: Channel) -> Option<Compared> {
    let of_segment = |s: &Segment| -> Vec<Option<f64>> {
        s.observed.iter().zip(&s.valid).map(|(window, valid)| valid[c].then(|| rounded(window[c]))).collect()
    };
    let recorded: Vec<Option<f64>> = cut.segments.iter().flat_map(of_segment).collect();
    recorded.iter().any(Option::is_some).then(|| {
        let of = |response: &[Vec<Channels<f64>>]| {
            response.iter().flatten().map(|y| Some(y[c]).filter(|v| v.is_finite()).map(rounded)).collect()
        };
        Compared {
            signal: c.name().into(),
            unit: c.unit().into(),
            side: c.side().map(|side| inference::words::side(side).into()),
            nominal: of(&simulated.responses.nominal),
            retuned: of(&simulated.responses.retuned),
            corrected: simulated.responses.corrected.as_deref().map_or_else(Vec::new, of),
            usual: Some(rounded(p.variance[c].sqrt())),
            recorded,
        }
    })
}
