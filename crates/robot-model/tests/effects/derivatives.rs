//! Derivatives by dual numbers are right, for every effect and both ways of driving.

use num_dual::Dual64;
use proptest::prelude::*;
use robot_model::{Active, Effect, Presence, Robot, Role, Scalar, State, effects};

use crate::battery::{H, linear_strengths, moving, robots_of};
use crate::common::{BOTH, Causality, numbers, run};

fn dual(s: &State<f64>) -> State<Dual64> {
    let two = |x: [f64; 2]| x.map(Dual64::from_re);
    State {
        time: Dual64::from_re(s.time),
        position: two(s.position),
        heading: two(s.heading),
        velocity: two(s.velocity),
        yaw_rate: Dual64::from_re(s.yaw_rate),
        wheel_speed: two(s.wheel_speed),
        passive: two(s.passive),
        wheel_angle: two(s.wheel_angle),
        torque: two(s.torque),
        lagged: two(s.lagged),
        specific: two(s.specific),
        rate: s.rate.map(Dual64::from_re),
        needed: two(s.needed),
    }
}

/// The state after `steps` steps and the readings of the gyro.
fn advance<T: Scalar>(
    effect: &'static dyn Effect<T>,
    values: &[T],
    presence: Presence<T>,
    start: State<T>,
    (robot, causality, steps): (&Robot<f64>, Causality, usize),
) -> Vec<T> {
    let active = [Active::new(effect, values, presence)];
    let mut gyro = T::zero();
    let robot = robot.cast();
    let end = run(&robot, &active, causality, (start, steps as f64 * H, H), |plant, s| {
        let mut y = plant.readings(s);
        plant.sense(&mut y);
        gyro = y.gyro;
    });
    let mut all = numbers(&end);
    all.push(gyro);
    all
}

/// Largest difference of the dual derivative from a difference of second order, relative to the largest derivative. Of
/// the central one and those of either side the nearest counts: where a law has a kink beside this strength, for example
/// where a wheel loses its last load, only the difference of the side without the kink is the derivative.
fn derivative_error(
    index: usize,
    parameter: usize,
    share: f64,
    start: &State<f64>,
    how: (&Robot<f64>, Causality, usize),
) -> f64 {
    let (plain, duals) = (effects::catalogue::<f64>()[index], effects::catalogue::<Dual64>()[index]);
    let spec = plain.spec();
    let mut values: Vec<f64> =
        spec.parameters.iter().map(|p| if p.role == Role::Shape { p.neutral } else { share * p.probes[0] }).collect();
    let mut exact: Vec<Dual64> = values.iter().map(|v| Dual64::from_re(*v)).collect();
    exact[parameter].eps = 1.0;
    let exact = advance(duals, &exact, Presence::default(), dual(start), how);
    let (at, d) = (values[parameter], 1e-3 * spec.parameters[parameter].probes[0].abs());
    let mut beside = |steps: f64| {
        values[parameter] = at + steps * d;
        advance(plain, &values, Presence::default(), *start, how)
    };
    let around = [-2.0, -1.0, 0.0, 1.0, 2.0].map(&mut beside);
    let largest = exact.iter().map(|x| x.eps.abs()).fold(1e-9, f64::max);
    let differences = exact.iter().enumerate().map(|(i, x)| {
        let [before2, before, here, after, after2] = around.each_ref().map(|values| values[i]);
        let central = after - before;
        let left = 3.0 * here - 4.0 * before + before2;
        let right = 4.0 * after - 3.0 * here - after2;
        [central, left, right].map(|rise| (rise / (2.0 * d) - x.eps).abs())
    });
    // `min` would drop a NaN.
    let nearest =
        differences.map(|all| all.into_iter().fold(f64::INFINITY, |a, b| if b < a || b.is_nan() { b } else { a }));
    nearest.fold(0.0, |worst: f64, x| if x.is_nan() { f64::NAN } else { worst.max(x) }) / largest
}

#[test]
fn dual_derivatives_equal_central_differences() {
    for (effect, parameter, spec) in linear_strengths() {
        let robots = robots_of(spec);
        for (robot, causality) in robots.iter().flat_map(|robot| BOTH.map(|how| (robot, how))) {
            for (n, start) in moving().iter().enumerate() {
                // Over many steps a central difference may straddle a kink, where one branch of a law meets the next.
                for (steps, bound) in [(1, 1e-6), (100, 1e-4)] {
                    let error = derivative_error(effect, parameter, 1.0, start, (robot, causality, steps));
                    assert!(
                        error < bound,
                        "{} {parameter}, state {n}, {causality:?}, {steps} steps: {error:e}",
                        spec.id
                    );
                }
            }
        }
    }
}

#[test]
fn dual_derivatives_exist_from_rest() {
    for (effect, parameter, spec) in linear_strengths() {
        let robots = robots_of(spec);
        for (robot, causality) in robots.iter().flat_map(|robot| BOTH.map(|how| (robot, how))) {
            let mut values = vec![Dual64::from_re(0.0); spec.parameters.len()];
            for (v, p) in values.iter_mut().zip(spec.parameters) {
                *v = Dual64::from_re(p.neutral);
            }
            values[parameter].eps = 1.0;
            let law = effects::catalogue::<Dual64>()[effect];
            let end = advance(law, &values, Presence::default(), State::default(), (robot, causality, 500));
            assert!(end.iter().all(|x| x.re.is_finite() && x.eps.is_finite()), "{} {causality:?}: {end:?}", spec.id);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]


    #[test]
    fn dual_derivatives_equal_central_differences_at_any_strength(
        pick in 0_usize..1000,
        share in 0.1..3.0_f64,
        state in 0_usize..3,
        speed_driven: bool,
        casters: bool,
    ) {
        let all: Vec<_> = linear_strengths().collect();
        let (effect, parameter, spec) = all[pick % all.len()];
        let robots = robots_of(spec);
        let how = (&robots[usize::from(casters) % robots.len()], BOTH[usize::from(speed_driven)], 1);
        let error = derivative_error(effect, parameter, share, &moving()[state], how);
        prop_assert!(error < 1e-5, "{} {parameter}: {error:e}", spec.id);
    }
}
