//! Draws a case: the car, what is hidden, drives and sensors.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::PathBuf;

use super::plant::{Car, Driven, GRAVITY, Motion, STEP, Tyres};
use super::{CarCase, CarHidden, CarPlan, CarTruth};
use crate::random::Stream;

/// Drives.
const RECORDINGS: usize = 4;
/// Seconds of a drive, at least and at most.
const SECONDS: [f64; 2] = [35.0, 55.0];
/// Errors of the robot file, one sigma: distances and steering angle as shares, centre of the steering, rad, its times, s.
const KNOWN: Known = Known {
    distance: 0.008,
    full: 0.02,
    centre: 0.008,
    time: 0.008,
    drive: 0.06,
    dead_zone: 0.01,
    point: 0.003,
    axes: 0.008,
    radius: 0.008,
};

/// Sideways acceleration of hard cornering, m/s².
const HARD: f64 = 5.0;
/// A servo that reads its pulse at 50 Hz is late by this, s, on average.
const HALF_PULSE: f64 = 0.01;

struct Known {
    distance: f64,
    full: f64,
    centre: f64,
    time: f64,
    drive: f64,
    dead_zone: f64,
    point: f64,
    axes: f64,
    radius: f64,
}

/// What sensors and clocks do.
#[derive(Debug, Clone)]
struct Sensors {
    point: [f64; 2],
    axes: f64,
    clock: f64,
    /// By how much later the car's channels come with every second.
    clock_rate: f64,
    gyro_scale: f64,
    gyro_bias: f64,
    gyro_delay: f64,
    encoder_scale: f64,
    encoder_delay: f64,
    /// Share by which driven wheels are ahead where the car corners at [`HARD`], and the power of the acceleration that it grows
    /// with.
    wheel_slip: [f64; 2],
}

/// Car and sensors.
#[derive(Debug, Clone)]
struct Whole {
    car: Car,
    sensors: Sensors,
    /// Throttle from which the driver expects the car to move, and what is given beyond it, about.
    throttle: [f64; 2],
}

/// The case of a plan.
pub(super) fn case(plan: &CarPlan) -> CarCase {
    let stream = |name: &str| Stream::new(plan.seed, name, plan.index);
    let stated = stated(&mut stream("car robot"));
    let mut whole = as_built(&stated, &mut stream("car errors"));
    let nothing =
        CarTruth { case: plan.name.clone(), hidden: plan.hidden.clone(), has_tyres: false, numbers: BTreeMap::new() };
    if let Some(flaw) = plan.in_all {
        hide(flaw, &mut whole, &mut nothing.clone(), &mut stream("car flaw"));
    }
    let sound = whole.clone();
    let mut truth = nothing;
    let mut s = stream("car sizes");
    for hidden in &plan.hidden {
        hide(*hidden, &mut whole, &mut truth, &mut s);
    }
    truth.has_tyres = whole.car.tyres.is_some() && sound.car.tyres.is_none();

    let mut files = vec![(PathBuf::from("robot.toml"), robot_file(&stated).into_bytes())];
    let every = [20, 20, 40, 10][stream("car rows").index(4)];
    for number in 1..=plan.references {
        let mut s = Stream::new(plan.seed, "car reference", plan.index * 100 + number as u64);
        let text = sheet(&of_drive(&sound, &mut s), every, &mut s);
        files.push((PathBuf::from(format!("references/ref_{number}.csv")), text.into_bytes()));
    }
    for number in 1..=RECORDINGS {
        let mut s = Stream::new(plan.seed, "car drive", plan.index * 100 + number as u64);
        let text = sheet(&of_drive(&whole, &mut s), every, &mut s);
        files.push((PathBuf::from(format!("recordings/run_{number}.csv")), text.into_bytes()));
    }
    CarCase { files, truth }
}

/// The car as its owner states it.
fn stated(s: &mut Stream) -> Whole {
    let wheelbase = s.uniform(0.2, 0.5);
    // What moves alike on every scale has speeds that grow with the root of lengths.
    let size = (wheelbase / 0.26_f64).sqrt();
    let rear = wheelbase * s.uniform(0.42, 0.58);
    let car = Car {
        wheelbase,
        rear,
        height: wheelbase * s.uniform(0.1, 0.25),
        gyration: wheelbase * wheelbase * s.uniform(0.09, 0.14),
        full: s.uniform(0.35, 0.5),
        centre: 0.0,
        bend: 0.0,
        servo: s.uniform(60.0, 120.0),
        delay: s.uniform(0.0, 0.02),
        lag: 0.0,
        slowness: s.uniform(0.05, 0.1),
        play: 0.0,
        tyres: None,
        drive: s.uniform(5.0, 12.0),
        dead_zone: s.uniform(0.02, 0.1),
        top_speed: size * s.uniform(5.0, 10.0),
        dry: s.uniform(0.2, 0.6),
        drag: s.uniform(0.01, 0.05) / wheelbase,
        motor_lag: s.uniform(0.02, 0.08),
        slope: [0.0; 2],
    };
    let sensors = Sensors {
        point: [wheelbase * s.uniform(0.0, 0.6), 0.0],
        axes: 0.0,
        clock: 0.0,
        clock_rate: 0.0,
        gyro_scale: 1.0,
        gyro_bias: 0.0,
        gyro_delay: 0.0,
        encoder_scale: 1.0,
        encoder_delay: 0.0,
        wheel_slip: [0.0, 2.0],
    };
    let throttle = [car.dead_zone, s.uniform(0.1, 0.2)];
    Whole { car, sensors, throttle }
}

/// The car as it is: within what its owner states.
fn as_built(stated: &Whole, s: &mut Stream) -> Whole {
    let mut out = stated.clone();
    let (car, sensors) = (&mut out.car, &mut out.sensors);
    car.wheelbase *= 1.0 + s.normal(KNOWN.distance);
    car.full *= 1.0 + s.normal(KNOWN.full);
    car.centre += s.normal(KNOWN.centre);
    car.delay = (car.delay + s.normal(0.5 * KNOWN.time)).max(0.0);
    car.drive *= 1.0 + s.normal(KNOWN.drive);
    car.dead_zone = (car.dead_zone + s.normal(KNOWN.dead_zone)).max(0.0);
    sensors.point = sensors.point.map(|p| p + s.normal(KNOWN.point));
    sensors.axes += s.normal(KNOWN.axes);
    sensors.gyro_scale *= 1.0 + s.normal(0.01);
    sensors.gyro_bias += s.normal(0.006);
    sensors.encoder_scale *= 1.0 + s.normal(KNOWN.radius);
    out
}

/// The same in one drive: battery, trims and clocks differ a little.
fn of_drive(whole: &Whole, s: &mut Stream) -> Whole {
    let mut out = whole.clone();
    out.car.drive *= 1.0 + s.normal(0.03);
    out.car.full *= 1.0 + s.normal(0.004);
    out.car.centre += s.normal(0.002);
    out.car.dry *= 1.0 + s.normal(0.05);
    out.sensors.gyro_bias += s.normal(0.002);
    out.sensors.clock += s.normal(0.002);
    // Two devices are started by hand, one after the other.
    if out.sensors.clock_rate != 0.0 {
        out.sensors.clock += s.uniform(-1.0, 1.0);
    }
    if let Some(tyres) = &mut out.car.tyres {
        tyres.friction *= 1.0 + s.normal(0.02);
    }
    out
}

/// Sets a number and gives it.
fn set(number: &mut f64, to: f64) -> f64 {
    *number = to;
    to
}

/// Hides something in the car, and notes its numbers.
fn hide(hidden: CarHidden, whole: &mut Whole, truth: &mut CarTruth, s: &mut Stream) {
    let mut note = |name: &str, value: f64| {
        truth.numbers.insert(name.to_owned(), value);
    };
    let (car, sensors) = (&mut whole.car, &mut whole.sensors);
    match hidden {
        CarHidden::SteeringGain => {
            car.full *= 1.0 + s.sign() * s.uniform(0.12, 0.3);
            note("gain", car.full);
        }
        CarHidden::SteeringCentre => {
            car.centre += s.sign() * s.uniform(0.04, 0.12);
            note("centre", car.centre);
        }
        CarHidden::SteeringBend => car.bend = s.uniform(0.2, 0.45),
        CarHidden::SteeringDelay => {
            car.delay += s.uniform(0.07, 0.2);
            note("delay", car.delay + HALF_PULSE);
        }
        CarHidden::SteeringLag => note("lag", set(&mut car.lag, s.uniform(0.1, 0.25))),
        CarHidden::SteeringRate => note("rate", set(&mut car.slowness, s.uniform(0.5, 1.2))),
        CarHidden::SteeringPlay => note("play", set(&mut car.play, s.uniform(0.025, 0.06))),
        CarHidden::Wheelbase => {
            let factor = 1.0 + s.sign() * s.uniform(0.08, 0.2);
            car.wheelbase *= factor;
            car.rear *= factor;
            note("wheelbase", car.wheelbase);
        }
        CarHidden::TyreSlip => {
            let stiffness = [s.uniform(40.0, 120.0), s.uniform(60.0, 150.0)];
            car.tyres = Some(Tyres { stiffness, friction: s.uniform(0.9, 1.3) });
            note("front_compliance", 1.0 / stiffness[0]);
            note("rear_compliance", 1.0 / stiffness[1]);
        }
        CarHidden::GripLimit => {
            let stiffness = [s.uniform(60.0, 120.0), s.uniform(80.0, 150.0)];
            car.tyres = Some(Tyres { stiffness, friction: s.uniform(0.25, 0.45) });
            // It is driven faster than it holds.
            whole.throttle[1] *= 1.5;
        }
        CarHidden::DriveGain => {
            let factor = 1.0 + s.sign() * s.uniform(0.25, 0.5);
            car.drive *= factor;
            note("drive", car.drive);
            // Its driver gives more until it moves.
            whole.throttle[1] /= factor.min(1.0);
        }
        CarHidden::DeadZone => {
            car.dead_zone += s.uniform(0.06, 0.12);
            note("dead_zone", car.dead_zone);
            // Its driver gives more until it moves.
            whole.throttle[1] += 0.06;
        }
        CarHidden::TrackedPoint => {
            let [x, y] = sensors.point;
            sensors.point = [x + s.sign() * s.uniform(0.03, 0.1), y + s.sign() * s.uniform(0.02, 0.06)];
            note("point_x", sensors.point[0]);
            note("point_y", sensors.point[1]);
        }
        CarHidden::TrackedAxes => {
            sensors.axes += s.sign() * s.uniform(0.05, 0.15);
            note("axes", sensors.axes);
        }
        CarHidden::ClockDelay => {
            sensors.clock = s.uniform(0.08, 0.25);
            note("clock", sensors.clock);
        }
        CarHidden::ClockRate => {
            sensors.clock = s.uniform(-1.0, 1.0);
            sensors.clock_rate = s.sign() * s.uniform(0.01, 0.03);
            // The car's clock shows `t` at `t - (clock + clock_rate t)` of the pose's.
            note("clock_rate", 1.0 - 1.0 / (1.0 - sensors.clock_rate));
        }
        CarHidden::GyroScale => {
            sensors.gyro_scale *= 1.0 + s.sign() * s.uniform(0.1, 0.3);
            note("gyro_scale", sensors.gyro_scale);
        }
        CarHidden::GyroBias => {
            sensors.gyro_bias += s.sign() * s.uniform(0.05, 0.15);
            note("gyro_bias", sensors.gyro_bias);
        }
        CarHidden::GyroDelay => {
            sensors.gyro_delay = s.uniform(0.08, 0.25);
            note("gyro_delay", sensors.gyro_delay);
        }
        CarHidden::EncoderScale => {
            sensors.encoder_scale *= [2.0, 0.5, 1.0 + s.uniform(0.1, 0.3), 1.0 - s.uniform(0.1, 0.3)][s.index(4)];
            note("encoder_scale", sensors.encoder_scale);
        }
        CarHidden::EncoderDelay => {
            sensors.encoder_delay = s.uniform(0.1, 0.25);
            note("encoder_delay", sensors.encoder_delay);
        }
        CarHidden::WheelSlip => {
            sensors.wheel_slip = [s.uniform(0.06, 0.15), s.uniform(1.6, 2.6)];
            // It is driven fast, or nothing slips.
            whole.throttle[1] *= 1.3;
        }
        CarHidden::Slope => {
            let (rise, towards) = (s.uniform(0.025, 0.08), s.uniform(-PI, PI));
            car.slope = [rise * towards.cos(), rise * towards.sin()];
            note("slope_x", car.slope[0]);
            note("slope_y", car.slope[1]);
            // Its driver gives what climbs it.
            whole.throttle[1] += GRAVITY * rise / car.drive;
        }
    }
}

/// Commands of a drive, step by step: levels that are held, steps and sweeps of the steering.
fn commands(whole: &Whole, steps: usize, s: &mut Stream) -> Vec<[f64; 2]> {
    let mut out = Vec::with_capacity(steps);
    let (mut throttle, mut level, mut sweep) = (0.0, 0.0, [0.0, 1.0]);
    let mut until = [0, 0];
    for k in 0..steps {
        if k >= until[0] {
            until[0] = k + (s.uniform(1.0, 4.0) / STEP) as usize;
            let [moves, beyond] = whole.throttle;
            // It rolls out now and then.
            throttle = if s.unit() < 0.12 { 0.0 } else { moves + beyond * s.uniform(0.7, 1.7) };
        }
        if k >= until[1] {
            until[1] = k + (s.uniform(0.7, 3.0) / STEP) as usize;
            level = s.uniform(-0.9, 0.9);
            sweep = if s.unit() < 0.4 { [s.uniform(0.1, 0.4), s.uniform(2.0, 8.0)] } else { [0.0, 1.0] };
        }
        let time = STEP * k as f64;
        let steering: f64 = level + sweep[0] * (sweep[1] * time).sin();
        out.push([throttle, steering.clamp(-1.0, 1.0)]);
    }
    out
}

/// Rows as the car and the cameras show them; a row every so many steps.
fn sheet(whole: &Whole, every: usize, s: &mut Stream) -> String {
    let (car, sensors) = (&whole.car, &whole.sensors);
    let steps = (s.uniform(SECONDS[0], SECONDS[1]) / STEP) as usize;
    let given = commands(whole, steps, s);
    let start =
        Motion { x: s.uniform(-2.0, 2.0), y: s.uniform(-2.0, 2.0), yaw: s.uniform(-PI, PI), ..Motion::default() };
    let noise = [s.uniform(0.000_5, 0.002), s.uniform(0.001, 0.004), s.uniform(0.01, 0.04), s.uniform(0.01, 0.04)];

    let mut driven = Driven::new(car, start);
    let mut motions = Vec::with_capacity(steps);
    // Commands are held from row to row, as a program sends them.
    for k in 0..steps {
        let [throttle, steering] = given[k - k % every];
        motions.push(driven.motion);
        driven.step(throttle, steering);
    }

    let mut out = String::from("time_s,duty,servo,x_m,y_m,yaw_rad,gyro_z,speed\n");
    let before =
        |k: usize, delay: f64| (k as f64 - delay / STEP).round().clamp(0.0, steps.saturating_sub(1) as f64) as usize;
    let at = |k: usize, delay: f64| &motions[before(k, delay)];
    for k in (0..steps).step_by(every) {
        let time = STEP * k as f64;
        // What the car says in this row is of so long ago; the pose is of now.
        let late = sensors.clock + sensors.clock_rate * time;
        let then = before(k, late);
        let command = given[then - then % every];
        let now = &motions[k];
        let (sin, cos) = now.yaw.sin_cos();
        let [px, py] = sensors.point;
        let x = now.x + cos * px - sin * py + s.normal(noise[0]);
        let y = now.y + sin * px + cos * py + s.normal(noise[0]);
        let yaw = (now.yaw + sensors.axes + s.normal(noise[1]) + PI).rem_euclid(TAU) - PI;
        let gyro = sensors.gyro_scale * at(k, late + sensors.gyro_delay).rate + sensors.gyro_bias;
        let counted = at(k, late + sensors.encoder_delay);
        let [slip, power] = sensors.wheel_slip;
        let ahead = slip * ((counted.speed * counted.rate).abs() / HARD).powf(power);
        let speed = sensors.encoder_scale * counted.speed * (1.0 + ahead);
        let [gyro, speed] = [gyro + s.normal(noise[2]), speed + s.normal(noise[3])];
        let [throttle, steering] = command;
        let _ = writeln!(out, "{time:.4},{throttle:.4},{steering:.4},{x:.5},{y:.5},{yaw:.5},{gyro:.4},{speed:.4}");
    }
    out
}

/// The robot file.
fn robot_file(stated: &Whole) -> String {
    let (car, sensors) = (&stated.car, &stated.sensors);
    let mut out = String::from("name = \"drawn\"\nkind = \"car\"\n");
    line(&mut out, "wheelbase", car.wheelbase, KNOWN.distance * car.wheelbase);
    line(&mut out, "centre_of_mass", car.rear, KNOWN.distance * car.wheelbase);
    line(&mut out, "wheel_radius", 0.05, KNOWN.radius * 0.05);
    out += "\n[steering]\n";
    line(&mut out, "full_angle", car.full, KNOWN.full * car.full);
    line(&mut out, "centre", 0.0, KNOWN.centre);
    // Half a pulse and a servo of second order, as a dead time and a lag.
    line(&mut out, "delay", car.delay + HALF_PULSE, KNOWN.time);
    line(&mut out, "lag", 2.0 / car.servo, KNOWN.time);
    out += "\n[drive]\n";
    line(&mut out, "full_acceleration", car.drive, KNOWN.drive * car.drive);
    line(&mut out, "dead_zone", car.dead_zone, KNOWN.dead_zone);
    out += "\n[point]\n";
    line(&mut out, "x", sensors.point[0], KNOWN.point);
    line(&mut out, "y", 0.0, KNOWN.point);
    line(&mut out, "yaw", 0.0, KNOWN.axes);
    out += "\n[columns]\ntime = \"time_s\"\nthrottle = \"duty\"\nsteering = \"servo\"\nx = \"x_m\"\ny = \"y_m\"\n\
            yaw = \"yaw_rad\"\ngyro = \"gyro_z\"\nencoder = \"speed\"\n";
    out
}

fn line(out: &mut String, key: &str, value: f64, sigma: f64) {
    let _ = writeln!(out, "{key} = {{ value = {value:.5}, sigma = {sigma:.5}, source = \"drawn\" }}");
}
