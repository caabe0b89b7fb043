//! How well straight loads agree with a pull towards one direction of the world, as a slope has it, and with what rivals that.

use crate::settings::{CHANGES, changes::Plane};

const PLANE: Plane = CHANGES.plane;

/// A stretch of straight driving: from when, s; where it goes, rad; its load and the references' at its speed, N m; whether that is only a bound.
pub(crate) struct Stretch {
    pub(crate) from: f64,
    pub(crate) direction: f64,
    pub(crate) load: f64,
    pub(crate) usual: f64,
    /// Slope uphill along the way by an accelerometer, rad; `None` without one.
    pub(crate) tilt: Option<f64>,
    pub(crate) is_bound: bool,
    /// 1 forward, −1 backward.
    pub(crate) way: f64,
}

/// How badly a stretch fits a load of level ground (over the usual) and a pull along its direction, N m, of which the drive train
/// loses an unknown share, N m; in nats, saturated.
fn misfit(s: &Stretch, is_unsigned: bool, level: f64, [pull, lost]: [f64; 2]) -> f64 {
    let sum = level * s.usual + pull;
    let expected = if is_unsigned { sum.abs() } else { sum };
    let sigma = (PLANE.scatter * s.usual).hypot(lost);
    let off = if s.is_bound { (expected - s.load).max(0.0) } else { s.load - expected };
    0.5 * (off / sigma).powi(2).min(PLANE.far_off * PLANE.far_off)
}

/// Levels of a drive train that are tried, over the usual, and what each costs.
fn levels(spread: f64) -> impl Iterator<Item = (f64, f64)> {
    let steps = PLANE.levels;
    (-steps..=steps).map(move |k| {
        let z = PLANE.widest * f64::from(k) / f64::from(steps);
        ((z * spread).exp(), 0.5 * z * z)
    })
}

/// Cost of a recording on a slope whose pull is `pull`, N m, towards each direction uphill that is tried, nats.
fn on_slope(stretches: &[Stretch], is_unsigned: bool, spread: f64, pull: f64) -> Vec<f64> {
    let towards = |uphill: f64| {
        let of_level = |(level, price): (f64, f64)| {
            let along = |s: &Stretch| pull * (s.direction - uphill).cos();
            let of =
                |s: &Stretch| misfit(s, is_unsigned, level, [1.0, CHANGES.slopes.losses].map(|share| share * along(s)));
            price + stretches.iter().map(of).sum::<f64>()
        };
        levels(spread).map(of_level).fold(f64::MAX, f64::min)
    };
    (0..PLANE.directions).map(|k| towards(direction_tried(k))).collect()
}

/// A direction uphill that is tried, rad.
fn direction_tried(k: usize) -> f64 {
    std::f64::consts::TAU / PLANE.directions as f64 * k as f64
}

/// The best fit of all recordings on one slope: its cost with the price of what it chooses, nats, and where uphill is in each of them.
/// Where all of them began to look one way, one direction serves all; else each has its own.
pub(crate) fn on_one_slope(all: &[Vec<Stretch>], is_unsigned: bool, spread: f64, pull: f64) -> (f64, Vec<Option<f64>>) {
    let costs: Vec<Vec<f64>> = all.iter().map(|stretches| on_slope(stretches, is_unsigned, spread, pull)).collect();
    let least = |of: &dyn Fn(usize) -> f64| {
        let cheapest = (0..PLANE.directions).map(|k| (of(k), k)).min_by(|a, b| a.0.total_cmp(&b.0));
        cheapest.map_or((f64::MAX, 0.0), |(cost, k)| (cost, direction_tried(k)))
    };
    let shows = |stretches: &Vec<Stretch>, uphill: f64| (!stretches.is_empty()).then_some(uphill);
    let price = |directions: usize| PLANE.per_number * (1 + directions) as f64;

    let (together, uphill) = least(&|k| costs.iter().map(|own| own[k]).sum());
    let alike = (together + price(1), all.iter().map(|own| shows(own, uphill)).collect());
    let each: Vec<(f64, f64)> = costs.iter().map(|own| least(&|k| own[k])).collect();
    let directions = all.iter().filter(|stretches| !stretches.is_empty()).count();
    let apart = each.iter().map(|(cost, _)| cost).sum::<f64>() + price(directions);
    if alike.0 <= apart {
        return alike;
    }
    (apart, all.iter().zip(&each).map(|(own, (_, uphill))| shows(own, *uphill)).collect())
}

/// The best fit of recordings on one level ground that resists `ratio` times as much, where something holds the robot back by `pull`,
/// N m, whichever way it looks, nats.
pub(crate) fn on_level_ground(all: &[Vec<Stretch>], is_unsigned: bool, spread: f64, (ratio, pull): (f64, f64)) -> f64 {
    let of_run = |stretches: &Vec<Stretch>| {
        let of_level = |(level, price): (f64, f64)| {
            price + stretches.iter().map(|s| misfit(s, is_unsigned, ratio * level, [pull * s.way, 0.0])).sum::<f64>()
        };
        levels(spread).map(of_level).fold(f64::MAX, f64::min)
    };
    all.iter().map(of_run).sum()
}

/// From which stretch on something holds a robot back by `pull` on its usual ground, whichever way it looks, and what that costs, nats: from
/// the first one on for nothing, from a later one or never for the price of a number.
pub(crate) fn onset(stretches: &[Stretch], is_unsigned: bool, spread: f64, pull: f64) -> (f64, usize) {
    let mut best = (f64::MAX, 0);
    for (level, price) in levels(spread) {
        let misfits = |pull: f64| -> Vec<f64> {
            stretches.iter().map(|s| misfit(s, is_unsigned, level, [pull * s.way, 0.0])).collect()
        };
        let (free, pulled) = (misfits(0.0), misfits(pull));
        let mut cost = price + pulled.iter().sum::<f64>();
        for k in 0..=stretches.len() {
            let chosen = if k == 0 { 0.0 } else { PLANE.per_number };
            if cost + chosen < best.0 {
                best = (cost + chosen, k);
            }
            if let (Some(free), Some(pulled)) = (free.get(k), pulled.get(k)) {
                cost += free - pulled;
            }
        }
    }
    best
}

/// The best fit of recordings on level ground of which parts resist `ratio` times as much, nats.
pub(crate) fn on_two_grounds(all: &[Vec<Stretch>], is_unsigned: bool, spread: f64, ratio: f64) -> f64 {
    let of_run = |stretches: &Vec<Stretch>| {
        let of_level = |(level, price): (f64, f64)| {
            let of = |s: &Stretch| {
                let [one, other] = [1.0, ratio].map(|r| misfit(s, is_unsigned, r * level, [0.0; 2]));
                one.min(other) + std::f64::consts::LN_2
            };
            price + stretches.iter().map(of).sum::<f64>()
        };
        levels(spread).map(of_level).fold(f64::MAX, f64::min)
    };
    all.iter().map(of_run).sum()
}

/// What a slope pulls, N m; `weight` is `m g r`, N m.
pub(crate) fn pull_of(weight: f64, degrees: f64) -> f64 {
    weight * degrees.to_radians().sin()
}

/// Ratios of two grounds that are tried.
pub(crate) fn ratios_tried() -> impl Iterator<Item = f64> {
    (1..=PLANE.ratios).flat_map(|k| {
        let ratio = (PLANE.most_ratio.ln() * k as f64 / PLANE.ratios as f64).exp();
        [ratio, 1.0 / ratio]
    })
}

/// Cost of what rivals a slope, nats: level ground, firm or soft, with a rope or without, and ground that changes. Each pays for what
/// it chooses.
pub(crate) fn rivals(all: &[Vec<Stretch>], is_unsigned: bool, spread: f64, weight: f64) -> f64 {
    let least = |costs: &mut dyn Iterator<Item = f64>| costs.fold(f64::MAX, f64::min);
    let two =
        least(&mut ratios_tried().map(|ratio| on_two_grounds(all, is_unsigned, spread, ratio))) + PLANE.per_number;
    let ropes = || {
        (0..=PLANE.ropes).map(|k| pull_of(weight, PLANE.steepest * k as f64 / PLANE.ropes as f64)).flat_map(|p| [p, -p])
    };
    let one = least(
        &mut std::iter::once(1.0).chain(ratios_tried()).flat_map(|ratio| ropes().map(move |rope| (ratio, rope))).map(
            |(ratio, rope)| {
                let chosen = f64::from(u8::from(ratio != 1.0)) + f64::from(u8::from(rope != 0.0));
                on_level_ground(all, is_unsigned, spread, (ratio, rope)) + PLANE.per_number * chosen
            },
        ),
    );
    one.min(two)
}

#[cfg(test)]
mod tests {
    use super::*;

    const USUAL: f64 = 10.0;
    const SPREAD: f64 = 0.2;

    /// Stretches in five directions on a slope that pulls 6 N m towards `uphill`.
    fn on_plane(uphill: f64) -> Vec<Stretch> {
        let at = |k: u32| {
            let direction = 1.2 * f64::from(k);
            let load = USUAL + 6.0 * (direction - uphill).cos();
            Stretch { from: 0.0, direction, load, usual: USUAL, tilt: None, is_bound: false, way: 1.0 }
        };
        (0..5).map(at).collect()
    }

    #[test]
    fn recordings_that_began_to_look_one_way_share_the_direction_uphill_and_pay_for_it_once() {
        let of = |uphill: [f64; 2]| on_one_slope(&uphill.map(on_plane), true, SPREAD, 6.0);
        let ((alike, one), (apart, two)) = (of([0.4, 0.4]), of([0.4, 2.0]));
        assert_eq!(one[0], one[1]);
        let [first, second] = [two[0], two[1]].map(|uphill| uphill.expect("a direction"));
        assert!((second - first - 1.6).abs() < 0.2, "{first} {second}");
        assert!((apart - alike - PLANE.per_number).abs() < 1.0, "{alike} {apart}");
        assert!(on_one_slope(&[on_plane(0.4), Vec::new()], true, SPREAD, 6.0).1[1].is_none(), "it shows none");
    }
}
