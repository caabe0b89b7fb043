//! Loads of steady driving: straight, turning, effective track, each with its standard error.
//!
//! One law per side: `|torque| = sgn(v) S/2 ± T`. `S` is the drag of both sides against rolling, `T` the scrub
//! couple, plus on the outer side of a turn. In a spin both sides drive and each reads `S/2 + T`.

use crate::run::SpeedRun;
use crate::settings::MEASURING;
use crate::settings::measuring::{Scatter, Stretches, Turns};
use crate::straight::is_straight;
use inference::robust::effective_number;
use verdict::{Load, Quantity, Withheld};

const STRETCHES: Stretches = MEASURING.stretches;
const TURNS: Turns = MEASURING.turns;
const SCATTER: Scatter = MEASURING.scatter;

/// Whether the robot turns at a row, has done so for a while, and scrub is fully developed: a spin or an arc.
pub(crate) fn is_steady_turn(run: &SpeedRun, i: usize) -> bool {
    let (l, r) = (run.speed[0][i], run.speed[1][i]);
    let tight = run.spins(i) || (r - l).abs() >= TURNS.plateau * (l + r).abs().max(1e-9);
    tight && (r - l).abs() >= TURNS.difference && run.held(i, TURNS.steady, TURNS.hold * run.patience())
}

/// Mean with a standard error over pieces of steady stretches.
struct Clustered {
    mean: f64,
    error: f64,
    seconds: f64,
    speed: [f64; 2],
    right_outer: f64,
}

fn pieces(run: &SpeedRun, rows: &[usize]) -> Vec<Vec<usize>> {
    let mut out: Vec<Vec<usize>> = Vec::new();
    for &i in rows {
        match out.last_mut() {
            Some(piece)
                if piece.last().is_some_and(|&k| run.time[i] - run.time[k] <= STRETCHES.gap)
                    && run.time[i] - run.time[piece[0]] <= STRETCHES.piece =>
            {
                piece.push(i);
            }
            _ => out.push(vec![i]),
        }
    }
    out
}

/// Speeds of the inner and the outer side at a row, the outer one positive; their mean when the drive is straight.
pub(crate) fn inner_outer(run: &SpeedRun, i: usize) -> [f64; 2] {
    let (l, r) = (run.speed[0][i], run.speed[1][i]);
    if (r - l).abs() <= MEASURING.straight.difference {
        return [0.5 * (l + r).abs(); 2];
    }
    let (inner, outer) = if l.abs() < r.abs() { (l, r) } else { (r, l) };
    [inner * outer.signum(), outer.abs()]
}

/// Share of rows in which the right side is the outer one.
pub(crate) fn right_outer(run: &SpeedRun, rows: &[usize]) -> f64 {
    rows.iter().filter(|&&i| run.outer(i) == 1).count() as f64 / rows.len().max(1) as f64
}

fn clustered(run: &SpeedRun, rows: &[usize], value: impl Fn(usize) -> f64) -> Option<Clustered> {
    let seconds = rows.len() as f64 * run.period();
    if seconds < STRETCHES.least_seconds {
        return None;
    }
    let pieces = pieces(run, rows);
    let n = rows.len() as f64;
    let mean = rows.iter().map(|&i| value(i)).sum::<f64>() / n;
    let effective = effective_number(pieces.iter().map(|p| p.len() as f64));
    let scatter: f64 =
        pieces.iter().map(|p| (p.iter().map(|&i| value(i)).sum::<f64>() - p.len() as f64 * mean).powi(2)).sum();
    let small = if effective > STRETCHES.least_pieces { (effective / (effective - 1.0)).sqrt() } else { 1.0 };
    let error = (scatter.sqrt() / n * small).max(STRETCHES.piece_scatter * mean.abs() / effective.sqrt());
    let speed = [0, 1].map(|j| rows.iter().map(|&i| inner_outer(run, i)[j]).sum::<f64>() / n);
    Some(Clustered { mean, error, seconds, speed, right_outer: right_outer(run, rows) })
}

/// All loads that a recording permits, and what it does not.
pub(crate) fn extract(run: &SpeedRun) -> (Vec<Load>, Vec<Withheld>) {
    let mut loads = Vec::new();
    let mut withheld = Vec::new();
    let load = |quantity: Quantity, c: &Clustered, value: f64, error: f64| Load {
        recording: run.name.clone(),
        quantity,
        value,
        error,
        seconds: c.seconds,
        speed: c.speed,
        right_outer: c.right_outer,
    };
    let refuse = |quantity: Quantity, rows: usize, what: &str| Withheld {
        recording: run.name.clone(),
        quantity,
        reason: format!(
            "only {:.1} s of {what}; at least {:.0} s are needed",
            rows as f64 * run.period(),
            STRETCHES.least_seconds
        ),
    };
    let all = || 0..run.time.len();

    let straight: Vec<usize> = all()
        .filter(|&i| run.reads(i, 0) && run.reads(i, 1) && is_straight(run, i, MEASURING.straight.hold_of_means))
        .collect();
    let speed = |i: usize| run.forward(i).abs();
    // Straight loads with what changes inside the recording: of a turn their half is taken away, where no other is known.
    let mut whole = Vec::new();
    for class in STRETCHES.classes.windows(2) {
        let all: Vec<usize> =
            straight.iter().copied().filter(|&i| speed(i) >= class[0] && speed(i) < class[1]).collect();
        if let Some(c) = clustered(run, &all, |i| run.torque[0][i].abs() + run.torque[1][i].abs()) {
            whole.push(load(Quantity::StraightLoad, &c, c.mean, c.error));
        }
        let rows: Vec<usize> = all.into_iter().filter(|&i| !run.changed[i]).collect();
        if let Some(c) = clustered(run, &rows, |i| run.torque[0][i].abs() + run.torque[1][i].abs()) {
            loads.push(load(Quantity::StraightLoad, &c, c.mean, c.error));
            let signed = |i: usize| (run.torque[1][i].abs() - run.torque[0][i].abs()) / c.mean;
            if let Some(d) = clustered(run, &rows, signed) {
                loads.push(load(Quantity::Asymmetry, &d, d.mean, d.error));
            }
        }
    }
    if loads.is_empty() {
        withheld.push(refuse(
            Quantity::StraightLoad,
            straight.iter().filter(|&&i| !run.changed[i]).count(),
            "steady straight driving with a current on both sides",
        ));
    }

    // Arcs and spins: the outer side of an arc, both sides of a spin.
    let turning: Vec<usize> = all().filter(|&i| is_steady_turn(run, i)).collect();
    let (spins, arcs): (Vec<usize>, Vec<usize>) = turning.into_iter().partition(|&i| run.spins(i));
    if let Some(c) = clustered(run, &arcs, |i| run.torque[run.outer(i)][i].abs()) {
        let forward = 0.5 * (c.speed[0] + c.speed[1]).abs();
        let nearest = |of: &[Load]| {
            let straight = of.iter().filter(|l| l.quantity == Quantity::StraightLoad);
            straight.min_by(|a, b| gap(a, forward).total_cmp(&gap(b, forward))).cloned()
        };
        let nearest = nearest(&loads).or_else(|| nearest(&whole));
        if let Some(s) = nearest {
            // Straight driving at another speed, or at another time, takes a little more or less.
            let speeds = [0.5 * (s.speed[0] + s.speed[1]), forward].map(|v| v.max(MEASURING.drift.least_speed));
            let by_speed = SCATTER.by_speed * (speeds[0] / speeds[1]).log2().abs();
            let of_straight = s.error.hypot(s.value * SCATTER.straight.hypot(by_speed));
            let error = c.error.hypot(0.5 * of_straight);
            loads.push(load(Quantity::TurningLoad, &c, c.mean - 0.5 * s.value, error));
        }
        loads.push(load(Quantity::ArcSum, &c, c.mean, c.error));
    }
    if let Some(c) = clustered(run, &spins, |i| 0.5 * (run.torque[0][i].abs() + run.torque[1][i].abs())) {
        loads.push(load(Quantity::SpinSum, &c, c.mean, c.error));
        let signed = |i: usize| (run.torque[1][i].abs() - run.torque[0][i].abs()) / (2.0 * c.mean);
        if let Some(d) = clustered(run, &spins, signed) {
            loads.push(load(Quantity::SpinAsymmetry, &d, d.mean, d.error));
        }
    }
    if !loads.iter().any(|l| matches!(l.quantity, Quantity::TurningLoad | Quantity::ArcSum | Quantity::SpinSum)) {
        withheld.push(refuse(Quantity::TurningLoad, arcs.len().max(spins.len()), "steady turning"));
    }

    match track(run, arcs.iter().chain(&spins).copied()) {
        Ok(l) => {
            loads.extend(drift(run, l.value));
            loads.push(l);
        }
        Err(w) => withheld.push(w),
    }
    (loads, withheld)
}

/// Drift `Σ(B ω − d) v / Σv²` over straight driving, with the effective track `B`, the difference of the tyre speeds `d` and their mean
/// `v`; `None` where there is too little of it with a gyro.
fn drift(run: &SpeedRun, track: f64) -> Option<Load> {
    let yaw = run.yaw_rate.as_ref()?;
    let is_told = |i: &usize| {
        let is_fast = run.forward(*i).abs() >= MEASURING.drift.least_speed;
        is_fast && yaw[*i].is_finite() && is_straight(run, *i, MEASURING.straight.hold_of_means)
    };
    let rows: Vec<usize> = (0..run.time.len()).filter(is_told).collect();
    let seconds = rows.len() as f64 * run.period();
    let pieces = pieces(run, &rows);
    let square = |p: &[usize]| p.iter().map(|&i| run.forward(i).powi(2)).sum::<f64>();
    let effective = effective_number(pieces.iter().map(|p| square(p)));
    if seconds < STRETCHES.least_seconds || effective <= STRETCHES.least_pieces {
        return None;
    }

    let turned = |i: usize| track * yaw[i] - run.difference(i);
    let all = square(&rows);
    let value = rows.iter().map(|&i| turned(i) * run.forward(i)).sum::<f64>() / all;
    let left = |p: &Vec<usize>| p.iter().map(|&i| (turned(i) - value * run.forward(i)) * run.forward(i)).sum::<f64>();
    let scatter: f64 = pieces.iter().map(|p| left(p).powi(2)).sum();
    let random = scatter.sqrt() / all * (effective / (effective - 1.0)).sqrt();
    // The gyro's offset turns a robot that goes forward and back one way each.
    let one_way = rows.iter().map(|&i| run.forward(i)).sum::<f64>().abs();
    let error = random.hypot(track * MEASURING.track.gyro_offset * one_way / all);
    let speed = (all / rows.len() as f64).sqrt();
    let (recording, quantity) = (run.name.clone(), Quantity::Drift);
    Some(Load { recording, quantity, value, error, seconds, speed: [speed; 2], right_outer: 0.5 })
}

fn gap(l: &Load, speed: f64) -> f64 {
    (0.5 * (l.speed[0] + l.speed[1]).abs() - speed).abs()
}

/// Effective track `Σd²/Σdω` over steady turning that goes on, `d` the difference of the tyre speeds.
fn track(run: &SpeedRun, rows: impl Iterator<Item = usize>) -> Result<Load, Withheld> {
    let quantity = Quantity::EffectiveTrack;
    let refuse = |reason: String| Withheld { recording: run.name.clone(), quantity, reason };
    let Some(yaw) = &run.yaw_rate else { return Err(refuse("no gyro was recorded".to_owned())) };
    let mut rows: Vec<usize> =
        rows.filter(|&i| yaw[i].is_finite() && run.holds(i, TURNS.steady, TURNS.ahead * run.patience())).collect();
    rows.sort_unstable();
    let seconds = rows.len() as f64 * run.period();
    if seconds < STRETCHES.least_seconds {
        return Err(refuse(format!(
            "only {seconds:.1} s of steady turning with a gyro; at least {:.0} s are needed",
            STRETCHES.least_seconds
        )));
    }

    let (mut dd, mut dw, mut one_way) = (0.0, 0.0, 0.0);
    for &i in &rows {
        let d = run.difference(i);
        dd += d * d;
        dw += d * yaw[i];
        one_way += d;
    }
    if dw <= 0.0 {
        return Err(refuse("the gyro does not turn with the wheels: check its sign and clock".to_owned()));
    }
    let b = dd / dw;

    // Its error: random from piece to piece, systematic of the sensors.
    let pieces = pieces(run, &rows);
    let weight = |p: &Vec<usize>| p.iter().map(|&i| run.difference(i).powi(2)).sum::<f64>();
    let effective = effective_number(pieces.iter().map(weight));
    if effective <= STRETCHES.least_pieces {
        return Err(refuse("only one short turn: its uncertainty cannot be estimated; record more turns".to_owned()));
    }
    let scatter: f64 = pieces
        .iter()
        .map(|p| p.iter().map(|&i| run.difference(i) * (run.difference(i) - b * yaw[i])).sum::<f64>().powi(2))
        .sum();
    let random = scatter.sqrt() / dw * (effective / (effective - 1.0)).sqrt();
    // The gyro's offset adds to turns one way what it takes from turns the other way.
    let offset = MEASURING.track.gyro_offset * one_way.abs() / dw;
    let systematic = b * offset.hypot(MEASURING.track.set_point_error);
    let speed = [0, 1].map(|j| rows.iter().map(|&i| inner_outer(run, i)[j]).sum::<f64>() / rows.len() as f64);
    let (recording, error, right_outer) = (run.name.clone(), random.hypot(systematic), right_outer(run, &rows));
    Ok(Load { recording, quantity, value: b, error, seconds, speed, right_outer })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::tests::{CONSTANT, GROUND, Ground, RADIUS, recording};

    fn loads(ground: Ground, legs: &[([f64; 2], f64)], broken: Option<usize>) -> (Vec<Load>, Vec<Withheld>) {
        extract(&SpeedRun::new(&recording(ground, legs, broken), RADIUS, CONSTANT).expect("a run"))
    }

    fn one(loads: &[Load], quantity: Quantity) -> &Load {
        let found: Vec<&Load> = loads.iter().filter(|l| l.quantity == quantity).collect();
        assert_eq!(found.len(), 1, "{quantity:?} in {loads:?}");
        found[0]
    }

    /// Straight, left arc, straight, right arc, a spin each way.
    const DRIVE: [([f64; 2], f64); 6] = [
        ([0.5, 0.5], 20.0),
        ([0.35, 0.65], 8.0),
        ([0.5, 0.5], 20.0),
        ([0.65, 0.35], 8.0),
        ([-0.25, 0.25], 8.0),
        ([0.25, -0.25], 8.0),
    ];

    #[test]
    fn loads_and_track_of_a_known_ground_are_recovered() {
        let (loads, withheld) = loads(GROUND, &DRIVE, None);
        assert_eq!(withheld, []);
        for (quantity, truth) in [
            (Quantity::StraightLoad, GROUND.straight),
            (Quantity::TurningLoad, GROUND.turning),
            (Quantity::ArcSum, 0.5 * GROUND.straight + GROUND.turning),
            (Quantity::SpinSum, 0.5 * GROUND.straight + GROUND.turning),
            (Quantity::EffectiveTrack, GROUND.track),
        ] {
            let l = one(&loads, quantity);
            assert!((l.value - truth).abs() <= 1e-6_f64.max(2.0 * l.error), "{l:?}, truth {truth}");
            assert!(l.error < 0.12 * truth && l.seconds >= STRETCHES.least_seconds, "{l:?}");
        }
        assert!(one(&loads, Quantity::Asymmetry).value.abs() < 1e-9);
        assert!(one(&loads, Quantity::SpinAsymmetry).value.abs() < 1e-9);
        approx::assert_relative_eq!(one(&loads, Quantity::StraightLoad).speed[0], 0.5, epsilon = 1e-9);
        let arc = one(&loads, Quantity::TurningLoad).speed;
        approx::assert_relative_eq!(arc[0], 0.35, epsilon = 1e-9);
        approx::assert_relative_eq!(arc[1], 0.65, epsilon = 1e-9);
    }

    #[test]
    fn speeds_are_not_mixed() {
        let (loads, _) = loads(GROUND, &[([0.2, 0.2], 10.0), ([0.5, 0.5], 10.0), ([0.8, 0.8], 10.0)], None);
        let speeds: Vec<f64> =
            loads.iter().filter(|l| l.quantity == Quantity::StraightLoad).map(|l| l.speed[0]).collect();
        assert_eq!(speeds.len(), 3);
        for (s, truth) in speeds.iter().zip([0.2, 0.5, 0.8]) {
            approx::assert_relative_eq!(*s, truth, epsilon = 1e-9);
        }
    }

    #[test]
    fn too_little_steady_driving_is_withheld_with_the_reason() {
        let (loads, withheld) = loads(GROUND, &[([0.5, 0.5], 3.0), ([0.35, 0.65], 2.0), ([0.2, 0.2], 2.0)], None);
        assert_eq!(loads, []);
        let reasons: Vec<(Quantity, &str)> = withheld.iter().map(|w| (w.quantity, w.reason.as_str())).collect();
        assert_eq!(reasons.len(), 3, "{reasons:?}");
        assert_eq!(reasons[0].0, Quantity::StraightLoad);
        assert!(reasons[0].1.contains("steady straight driving") && reasons[0].1.contains("3 s are needed"));
        assert_eq!(reasons[1].0, Quantity::TurningLoad);
        assert!(reasons[1].1.contains("s of steady turning"), "{reasons:?}");
        assert_eq!(reasons[2].0, Quantity::EffectiveTrack);
        assert!(reasons[2].1.contains("with a gyro"), "{reasons:?}");
    }

    #[test]
    fn a_side_in_the_dead_band_gives_no_straight_load() {
        // One side shows nothing: the sum of both is not known, the outer side of a left arc is.
        let (found, withheld) = loads(GROUND, &DRIVE, Some(0));
        assert!(found.iter().all(|l| l.quantity != Quantity::StraightLoad && l.quantity != Quantity::TurningLoad));
        assert!(withheld.iter().any(|w| w.quantity == Quantity::StraightLoad && w.reason.contains("both sides")));
        // A load that is smaller than the dead band on both sides does not read as zero either.
        let light = Ground { straight: 3.0, ..GROUND };
        let (found, withheld) = loads(light, &[([0.5, 0.5], 30.0)], None);
        assert_eq!(found, []);
        assert!(withheld.iter().any(|w| w.quantity == Quantity::StraightLoad));
    }

    #[test]
    fn one_short_turn_gives_no_track() {
        let (found, withheld) = loads(GROUND, &[([0.5, 0.5], 10.0), ([0.35, 0.65], 5.5)], None);
        assert!(found.iter().all(|l| l.quantity != Quantity::EffectiveTrack));
        let track = withheld.iter().find(|w| w.quantity == Quantity::EffectiveTrack).expect("withheld");
        assert!(track.reason.contains("one short turn"), "{track:?}");
    }
}
