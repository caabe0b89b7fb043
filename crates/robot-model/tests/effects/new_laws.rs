//! Effects against their closed-form laws, driven by the plant.

use robot_model::contact::combined;
use robot_model::effect::OperatingPoint;
use robot_model::{Active, Effect, Plant, Presence, Readings, Robot, State, effects};

use crate::battery::{H, instant};
use crate::common::robot;

/// Symmetric and flat: no load moves from wheel to wheel.
fn flat() -> Robot<f64> {
    let mut r = robot();
    r.com = [0.0, 0.0, 1e-9];
    (r.coulomb, r.viscous) = ([0.5; 2], [0.03; 2]);
    r
}

fn on(effect: &'static dyn Effect<f64>, values: &[f64], side: Option<usize>) -> Active<f64> {
    Active::new(effect, values, Presence { side, ..Presence::default() })
}

/// Torque of each side in steady straight driving at wheel speed `w`.
fn needed(active: &[Active<f64>], w: f64) -> [f64; 2] {
    let r = flat();
    let plant = Plant::new(&r, active, H);
    let mut s = State::default();
    plant.set_velocity(&mut s, [w * r.wheel_radius, 0.0]);
    for _ in 0..4000 {
        plant.step_at_speed(&mut s, [w; 2], [0.0; 2]);
    }
    s.needed
}

/// One instant of a robot that moves at `velocity` while its wheels turn at `speed`.
fn instant_of(active: &[Active<f64>], velocity: [f64; 2], speed: [f64; 2]) -> State<f64> {
    let r = flat();
    let mut s = State::default();
    let plant = Plant::new(&r, active, H);
    plant.set_velocity(&mut s, velocity);
    plant.step_at_speed(&mut s, speed, [0.0; 2]);
    s
}

#[track_caller]
fn near(got: f64, wanted: f64, bound: f64) {
    assert!((got - wanted).abs() <= bound * wanted.abs().max(1.0), "{got} instead of {wanted}");
}

#[test]
fn dry_friction_takes_the_same_torque_at_every_speed() {
    for w in [3.0, 9.0, -6.0_f64] {
        let (bare, with) = (needed(&[], w), needed(&[on(&effects::coulomb_friction::Law, &[0.4], None)], w));
        for j in 0..2 {
            near(with[j] - bare[j], 0.4 * w.signum(), 1e-9);
        }
    }
}

#[test]
fn a_weak_motor_of_one_side_needs_so_much_more_for_the_same_torque_and_spares_the_other_side() {
    let (w, kappa) = (6.0, -0.2);
    for side in [0, 1] {
        let weak = on(&effects::torque_constant_side::Law, &[kappa], Some(side));
        let (bare, with) = (needed(&[], w), needed(&[weak], w));
        near(with[side], bare[side] / (1.0 + kappa), 1e-9);
        near(with[1 - side], bare[1 - side], 1e-9);
        // Torque-driven: the step of a motor that gives so much less.
        let r = flat();
        let turning = State { wheel_speed: [w; 2], passive: [w; 2], ..State::default() };
        let after = |active: &[Active<f64>], torque: f64| {
            let mut s = turning;
            Plant::new(&r, active, H).step_under(&mut s, [torque; 2]);
            s.wheel_speed
        };
        near(after(&[weak], 5.0)[side], after(&[], 5.0 * (1.0 + kappa))[side], 1e-12);
        near(after(&[weak], 5.0)[1 - side], after(&[], 5.0)[1 - side], 1e-12);
    }
}

#[test]
fn gears_pass_their_efficiency_when_driving_and_hold_back_when_driven() {
    let beta = 0.2;
    let gears = on(&effects::load_dependent_friction::Law, &[beta], None);
    // Downhill the wheels drive the motors.
    for downhill in [0.0, 0.15] {
        let slope = on(&effects::grade::Law, &[downhill, 0.0], None);
        let (bare, with) = (needed(&[slope], 8.0), needed(&[slope, gears], 8.0));
        assert_eq!(bare[0] < 0.0, downhill > 0.0);
        for j in 0..2 {
            near(with[j], bare[j] / (1.0 - beta * bare[j].signum()), 1e-9);
        }
    }
    // Torque-driven: the friction is that of the torque of this very step.
    let r = flat();
    let turning = State { wheel_speed: [8.0; 2], passive: [8.0; 2], ..State::default() };
    let speed = |active: &[Active<f64>], torque: f64| {
        let mut s = turning;
        Plant::new(&r, active, H).step_under(&mut s, [torque; 2]);
        s.wheel_speed[0]
    };
    near(speed(&[gears], 5.0), speed(&[], 5.0 * (1.0 - beta)), 1e-12);
}

#[test]
fn a_battery_sags_with_the_torque_of_both_sides() {
    let sigma = 0.02;
    let (bare, with) = (needed(&[], 8.0)[0], needed(&[on(&effects::battery_sag::Law, &[sigma], None)], 8.0)[0]);
    // T (1 − 2 σ T) is what the robot takes.
    near(with, (1.0 - (1.0 - 8.0 * sigma * bare).sqrt()) / (4.0 * sigma), 1e-9);
    let (at, mut w) = instant(0.3);
    effects::battery_sag::Law.apply(&[sigma, 0.0, 0.0, 0.0, 0.0], &at, &mut w);
    let sum = at.torque[0].abs() + at.torque[1].abs();
    for j in 0..2 {
        near(w.torque[j], -sigma * sum * at.torque[j], 1e-15);
    }
}

#[test]
fn a_drivetrain_ripples_once_per_turn_on_its_side() {
    let ripple = on(&effects::drivetrain_ripple::Law, &[0.3, 0.2], Some(1));
    let r = flat();
    for angle in [0.0, 1.0, 4.0_f64] {
        let after = |active: &[Active<f64>]| {
            let mut s = State { wheel_angle: [2.0, angle], ..State::default() };
            Plant::new(&r, active, H).step_at_speed(&mut s, [2.0; 2], [0.0; 2]);
            s.needed
        };
        let (bare, with) = (after(&[]), after(&[ripple]));
        near(with[0], bare[0], 1e-15);
        near(with[1] - bare[1], -(0.3 * angle.cos() + 0.2 * angle.sin()), 1e-12);
    }
}

#[test]
fn wheels_that_spin_free_push_less_and_hold_sideways_as_before() {
    let spin = on(&effects::free_spin::Law, &[0.6], Some(0));
    let push = |active: &[Active<f64>]| instant_of(active, [0.5, 0.0], [8.0; 2]).specific[0];
    // One of two equal sides gives 40 %.
    near(push(&[spin]), 0.7 * push(&[]), 1e-9);
    let slide = |active: &[Active<f64>]| instant_of(active, [0.0, 0.3], [0.0; 2]).specific[1];
    near(slide(&[spin]), slide(&[]), 1e-12);
}

#[test]
fn a_wheel_that_loses_contact_gives_its_load_to_the_other_diagonal() {
    let (r, q) = (flat(), 0.8);
    let (velocity, speed) = ([0.5, 0.2], [4.0, 9.0]);
    let share = |j: usize| {
        let rim = speed[j] * r.wheel_radius;
        let rest2 = r.rest_speed * r.rest_speed;
        let slip = [rim - velocity[0], -velocity[1]];
        let (per_speed, _) = combined(slip, rim * rim + rest2, r.slip_at_peak, r.sliding_share);
        [0, 1].map(|i| per_speed * r.adhesion * slip[i] * [1.0, r.lateral_factor][i])
    };
    // The moment of one load on front left and rear right less that on the others: in length, per load.
    let (left, right) = (share(0), share(1));
    let moment = 2.0 * r.half_wheelbase * (right[1] - left[1]);
    let moved = q * r.mass * r.gravity / 4.0;
    let spin = |q: f64| instant_of(&[on(&effects::contact_loss::Law, &[q], None)], velocity, speed).rate;
    let (bare, with) = (spin(0.0), spin(q));
    near((with[2] - bare[2]) * r.yaw_inertia, moved * moment, 1e-6);
    near(spin(-q)[2] - bare[2], bare[2] - with[2], 1e-6);
    // The sum of the loads stays, and so does the push: left and right alike carry half.
    near(with[0], bare[0], 1e-6);
}

#[test]
fn a_wheel_out_of_true_presses_harder_while_its_long_side_is_down() {
    let robot = flat();
    let with = |values: &[f64], angle: f64| {
        let mut c = robot.coefficients();
        let at = OperatingPoint { wheel_angle: [angle; 2], ..robot.at_rest() };
        on(&effects::wheel_eccentricity::Law, values, Some(1)).apply(&at, &mut c);
        c
    };
    let bare = robot.coefficients();
    for (angle, rise) in [(0.0, 0.002), (std::f64::consts::PI, -0.002)] {
        let c = with(&[0.002, 0.0, 0.0, 0.0, 60.0], angle);
        for i in [1, 3] {
            near(c.radius[i] - bare.radius[i], rise, 1e-12);
            near(c.adhesion[i] / bare.adhesion[i], 1.0 + 60.0 * rise, 1e-12);
            near(c.rolling[i] / bare.rolling[i], 1.0 + 60.0 * rise, 1e-12);
        }
        assert_eq!([c.adhesion[0], c.adhesion[2]], [bare.adhesion[0], bare.adhesion[2]], "the other side");
        assert_eq!(with(&[0.002], angle).adhesion, bare.adhesion, "a body that follows every rise");
    }
    // No wheel pulls at the ground, however far out of true.
    let lifted = with(&[-0.05, 0.0, 0.0, 0.0, 200.0], 0.0);
    assert_eq!((lifted.adhesion[1], lifted.rolling[3]), (0.0, 0.0));
}

#[test]
fn grip_may_be_lost_everywhere() {
    let ice = on(&effects::adhesion_patch::Law, &[0.5], None);
    let push = |active: &[Active<f64>]| instant_of(active, [0.5, 0.2], [8.0; 2]).specific;
    for i in 0..2 {
        near(push(&[ice])[i], 0.5 * push(&[])[i], 1e-9);
    }
}

fn shown(active: &[Active<f64>]) -> Readings<f64> {
    let r = robot();
    let plant = Plant::new(&r, active, H);
    let mut y =
        Readings { wheel_speed: [3.0, 4.0], gyro: 0.5, velocity: [0.4, 0.1], accel: [0.7, -0.3], torque: [1.0, 2.0] };
    plant.sense(&mut y);
    y
}

#[test]
fn sensors_show_what_their_laws_say() {
    let bare = shown(&[]);
    let scaled = shown(&[on(&effects::encoder_scale::Law, &[0.3], Some(1))]);
    assert_eq!(scaled, Readings { wheel_speed: [3.0, 4.0 * 1.3], ..bare });
    let biased = shown(&[on(&effects::accelerometer_bias::Law, &[0.2, -0.1], None)]);
    assert_eq!(biased, Readings { accel: [0.7 + 0.2, -0.3 - 0.1], ..bare });
    let tilted = shown(&[on(&effects::imu_tilt::Law, &[0.1, -0.2], None)]);
    for (i, up) in [0.1_f64, -0.2].into_iter().enumerate() {
        near(tilted.accel[i], bare.accel[i] + 9.81 * up.sin(), 1e-6);
    }
    let turned = shown(&[on(&effects::imu_misalignment::Law, &[0.3], None)]);
    let (s, c) = 0.3_f64.sin_cos();
    near(turned.accel[0], 0.7 * c - 0.3 * s, 1e-12);
    near(turned.accel[1], -0.3 * c - 0.7 * s, 1e-12);
}
