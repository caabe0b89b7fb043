//! The last third of a recording forecast from its set speeds, with everything fitted on the first two.

use crate::extract::extract;
use crate::law::{Law, error, fit, torques};
use crate::run::SpeedRun;
use crate::settings::{FORECASTING, MEASURING, forecasting::Split};
use inference::robust::{median, rms};
use verdict::{Forecast, Quantity};

const SPLIT: Split = FORECASTING.split;

/// What the references say of the forecast: torques by the law, and the effective track in m.
pub(crate) struct Nominal {
    constants: Option<[f64; crate::law::CONSTANTS]>,
    track: f64,
    straight: f64,
}

impl Nominal {
    /// Median of the constants that fit each reference. `straight` is their straight load, N m.
    pub(crate) fn new(references: &[SpeedRun], straight: f64, track: f64) -> Self {
        let fits: Vec<_> = references
            .iter()
            .filter(|r| turning_seconds(r, 0, r.time.len()) >= SPLIT.least_turning)
            .map(|r| fit(Law::Turning, r, r.time.len(), straight))
            .collect();
        let middle = |k: usize| median(fits.iter().map(|c| c[k])).unwrap_or(f64::NAN);
        Self { constants: (!fits.is_empty()).then(|| std::array::from_fn(middle)), track, straight }
    }
}

fn turning_seconds(run: &SpeedRun, from: usize, until: usize) -> f64 {
    let turns = |i: &usize| !run.standing[*i] && run.difference(*i).abs() > MEASURING.aligning.turn;
    (from..until).filter(turns).count() as f64 * run.period()
}

/// Forecasts of torques and yaw rate; none of a recording that is short or does not turn in both parts.
pub(crate) fn forecasts(run: &SpeedRun, nominal: &Nominal) -> Vec<Forecast> {
    let rows = run.time.len();
    let (first, last) = (run.time[0], run.time[rows - 1]);
    let split = run.time.partition_point(|t| *t < first + (last - first) * SPLIT.fitted_thirds / 3.0);
    let turns = turning_seconds(run, 0, split) >= SPLIT.least_turning
        && turning_seconds(run, split, rows) >= SPLIT.least_turning;
    if last - first < SPLIT.least_seconds || !turns {
        return Vec::new();
    }

    let mut out = Vec::new();
    if let Some(constants) = &nominal.constants {
        let of = |law| error(&torques(law, &fit(law, run, split, nominal.straight), run), run, split);
        out.push(Forecast {
            recording: run.name.clone(),
            quantity: "torque of a side, N m".into(),
            interval: [run.time[split], last],
            nominal: error(&torques(Law::Turning, constants, run), run, split),
            retuned: error(&vec![level(run, split); rows], run, split),
            corrected: of(Law::Turning),
            placebos: Law::PLACEBOS.into_iter().map(|law| (law.effect().into(), of(law))).collect(),
        });
    }

    if let Some(yaw) = &run.yaw_rate {
        // By the effective track, behind the set speeds by the lag that fits best.
        let of_track = |b: f64, lag: f64, from: usize, until: usize| {
            let follow = followed(run, lag);
            rms_of_known((from..until).filter(|&i| !run.standing[i]).map(|i| follow[i] / b - yaw[i]))
        };
        let lag_of = |b: f64| {
            SPLIT
                .lags
                .into_iter()
                .min_by(|x, y| of_track(b, *x, 0, split).total_cmp(&of_track(b, *y, 0, split)))
                .unwrap_or(0.0)
        };
        let own = effective_track(&run.head(split)).unwrap_or(nominal.track);
        let moving = |i: &usize| !run.standing[*i] && yaw[*i].is_finite();
        let known: Vec<f64> = (0..split).filter(moving).map(|i| yaw[i]).collect();
        let mean = known.iter().sum::<f64>() / known.len().max(1) as f64;
        let level = rms_of_known((split..rows).filter(moving).map(|i| yaw[i] - mean));
        out.push(Forecast {
            recording: run.name.clone(),
            quantity: "yaw rate, rad/s".into(),
            interval: [run.time[split], last],
            nominal: of_track(nominal.track, 0.0, split, rows),
            retuned: level,
            corrected: of_track(own, lag_of(own), split, rows),
            placebos: Vec::new(),
        });
    }
    out
}

/// Root mean square of what is known: rows without a yaw rate are left out.
fn rms_of_known(errors: impl Iterator<Item = f64>) -> f64 {
    rms(errors.filter(|e| e.is_finite())).unwrap_or(0.0)
}

/// Effective track from steady turning, m.
fn effective_track(run: &SpeedRun) -> Option<f64> {
    extract(run).0.into_iter().find(|l| l.quantity == Quantity::EffectiveTrack).map(|l| l.value)
}

/// Mean torques of the rows before `until` at which the body moves.
fn level(run: &SpeedRun, until: usize) -> [f64; 2] {
    let moving = || (0..until).filter(|&i| !run.standing[i]);
    [0, 1].map(|j| moving().map(|i| run.torque[j][i]).sum::<f64>() / moving().count().max(1) as f64)
}

/// Difference of the speeds behind a first-order lag, m/s.
fn followed(run: &SpeedRun, lag: f64) -> Vec<f64> {
    let mut x = run.difference(0);
    (0..run.time.len())
        .map(|i| {
            let dt = if i > 0 { run.time[i] - run.time[i - 1] } else { 0.0 };
            let share = if lag > 0.0 { 1.0 - (-dt / lag).exp() } else { 1.0 };
            x += share * (run.difference(i) - x);
            x
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, STRAIGHT, drive};

    /// Straight driving and turns both ways, some rounds of it.
    fn rounds(n: usize) -> Vec<Leg> {
        let right = Leg { speed: [0.24, 0.08], ..Leg::turn(5.0) };
        (0..n).flat_map(|_| [Leg::straight(6.0), Leg::turn(5.0), Leg::straight(4.0), right]).collect()
    }

    #[test]
    fn the_last_third_is_forecast_better_than_by_a_level_or_a_wrong_law() {
        let reference = drive(&rounds(3), false);
        // A ground that scrubs more.
        let harder: Vec<Leg> = rounds(4).into_iter().map(|leg| Leg { scrub: 30.0, ..leg }).collect();
        let nominal = Nominal::new(&[reference], STRAIGHT, 0.77);
        let all = forecasts(&drive(&harder, false), &nominal);
        let torque = all.iter().find(|f| f.quantity.starts_with("torque")).expect("torques");
        assert!(torque.retuned > 2.5 * torque.corrected, "{torque:?}");
        assert!(torque.nominal > 1.3 * torque.corrected, "{torque:?}");
        assert_eq!(torque.placebos.len(), 3);
        assert!(torque.placebos.iter().all(|p| p.1 > 2.0 * torque.corrected), "{torque:?}");
        let yaw = all.iter().find(|f| f.quantity.starts_with("yaw")).expect("a yaw rate");
        assert!(yaw.corrected < 0.02 && yaw.retuned > 5.0 * yaw.corrected, "{yaw:?}");
    }

    #[test]
    fn a_run_that_does_not_turn_is_not_forecast() {
        let nominal = Nominal::new(&[drive(&rounds(2), false)], STRAIGHT, 0.77);
        assert_eq!(forecasts(&drive(&[Leg::straight(40.0)], false), &nominal), []);
        assert_eq!(forecasts(&drive(&[Leg::straight(4.0), Leg::turn(6.0)], false), &nominal), []);
    }
}
