//! Plants side by side: every lane must have the bits of a plant of its own.

use robot_model::effect::MAX_PARAMETERS;
use robot_model::paper::Parameters;
use robot_model::{Active, Disc, Effect, Lanes, Plant, Presence, Robot, State, effects};

const N: usize = 4;
const H: f64 = 1e-3;
const STEPS: usize = 700;

/// Four robots that differ.
fn robots() -> [Robot<f64>; N] {
    std::array::from_fn(|i| {
        let mut r = Robot::from(&Parameters::SET_B);
        (r.drive.lag, r.drive.dead_band, r.stribeck) = (0.02, 0.1, 0.1);
        r.mass *= 1.0 + 0.1 * i as f64;
        r.adhesion -= 0.1 * i as f64;
        r.coulomb[1] += 0.05 * i as f64;
        r.sliding_share = 0.4;
        r
    })
}

/// Present on one side, in a disc, and for a while that differs from lane to lane.
fn presences(i: usize) -> [Presence<f64>; 4] {
    let from = 0.1 * i as f64;
    let all = Presence::default();
    [
        all,
        Presence { side: Some(1), ..all },
        Presence { disc: Some(Disc { centre: [0.2, 0.1], radius: 0.3 }), ..all },
        Presence { from, until: from + 0.3, ..all },
    ]
}

fn wide(list: [Presence<f64>; N]) -> Presence<Lanes<N>> {
    let disc = list[0].disc.map(|d| Disc { centre: d.centre.map(|x| Lanes([x; N])), radius: Lanes([d.radius; N]) });
    Presence { from: Lanes(list.map(|p| p.from)), until: Lanes(list.map(|p| p.until)), disc, side: list[0].side }
}

fn values(effect: &dyn Effect<f64>, i: usize) -> [f64; MAX_PARAMETERS] {
    let mut out = [0.0; MAX_PARAMETERS];
    for (v, p) in out.iter_mut().zip(effect.spec().parameters) {
        let probe = p.probes.get(p.probes.len() / 2).copied().unwrap_or(p.neutral);
        *v = probe * (1.0 + 0.2 * i as f64);
    }
    out
}

fn torque(k: usize, i: usize) -> [f64; 2] {
    let t = k as f64 * H;
    [2.5 + (3.0 * t + i as f64).sin(), 2.0 - 3.0 * (5.0 * t).sin()]
}

#[test]
fn every_lane_has_the_bits_of_a_plant_of_its_own() {
    let robots = robots();
    let side_by_side = Robot::assemble(robots[0].chassis, |constant| Lanes(robots.each_ref().map(constant)));
    for (effect, in_lanes) in effects::catalogue::<f64>().into_iter().zip(effects::catalogue::<Lanes<N>>()) {
        let doses: [_; N] = std::array::from_fn(|i| values(effect, i));
        for kind in 0..4 {
            let lists: [Presence<f64>; N] = std::array::from_fn(|i| presences(i)[kind]);
            let all: Vec<Lanes<N>> = (0..MAX_PARAMETERS).map(|p| Lanes(doses.map(|v| v[p]))).collect();
            let active = [Active::new(in_lanes, &all, wide(lists))];
            let plant = Plant::new(&side_by_side, &active, Lanes([H; N]));
            let mut s = State::default();
            for k in 0..STEPS {
                let t: [_; N] = std::array::from_fn(|i| torque(k, i));
                plant.step(&mut s, [Lanes(t.map(|t| t[0])), Lanes(t.map(|t| t[1]))]);
            }
            let mut shown = plant.readings(&s);
            plant.sense(&mut shown);
            for i in 0..N {
                let active = [Active::new(effect, &doses[i], lists[i])];
                let plant = Plant::new(&robots[i], &active, H);
                let mut alone = State::default();
                for k in 0..STEPS {
                    plant.step(&mut alone, torque(k, i));
                }
                let mut seen = plant.readings(&alone);
                plant.sense(&mut seen);
                let id = effect.spec().id;
                let bits = |x: [f64; 2]| x.map(f64::to_bits);
                let lane = |x: [Lanes<N>; 2]| x.map(|x| x.0[i].to_bits());
                assert!(alone.position[0].is_finite() && alone.position[0] != 0.0, "{id} {kind} {i}");
                assert_eq!(lane(s.position), bits(alone.position), "{id} {kind} {i}");
                assert_eq!(lane(s.wheel_speed), bits(alone.wheel_speed), "{id} {kind} {i}");
                assert_eq!(lane(shown.accel), bits(seen.accel), "{id} {kind} {i}");
                assert_eq!(shown.gyro.0[i].to_bits(), seen.gyro.to_bits(), "{id} {kind} {i}");
            }
        }
    }
}
