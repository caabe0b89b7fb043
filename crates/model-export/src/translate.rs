//! Effects into a vehicle: what an engine holds becomes a value, what it does not becomes a residual.

use robot_model::effect::export::{Carrier, Engine, Residual as Lines, Way};
use robot_model::effects::catalogue;

use crate::at::At;
use crate::contact::grips;
use crate::model::{ExportError, Model};
use crate::number::number;
use crate::origin;
use crate::residual::{Does, Residual};
use crate::vehicle::{Payload, Sensors, Vehicle};

/// Wheel speed over which the Stribeck rise decays, rad/s, as in `robot_model::plant`.
const STRIBECK_SPEED: f64 = 0.6;

/// How an engine gets an effect at usual values; `None` for one that is not in the catalogue.
pub fn way(engine: Engine, effect: &str) -> Option<Way> {
    let found = catalogue::<f64>().into_iter().find(|e| e.spec().id == effect);
    found.map(|e| e.spec().export.way(engine))
}

/// Sorts the effects of a model for an engine.
pub(crate) fn vehicle(model: &Model<'_>, engine: Engine) -> Result<Vehicle, ExportError> {
    let effects = model.effects.iter().map(|of| At::new(of, model.known)).collect::<Result<Vec<_>, _>>()?;
    let mut v = Vehicle {
        robot: *model.robot,
        coefficients: model.robot.coefficients(),
        payload: None,
        eccentric: [[0.0; 2]; 4],
        patches: Vec::new(),
        drag: 0.0,
        sensors: Sensors { up: [0.0; 2], left: 0.0, encoder: [1.0; 2], late: [0.0; 2], gyro: 0.0, accel: [0.0; 2] },
        origins: origin::retuned(model),
        residuals: Vec::new(),
    };

    // Constants first: the robot must be complete before the coefficients of its rest are taken.
    let mut by_law = Vec::new();
    for at in &effects {
        let (export, way) = (&at.spec().export, at.way(engine));
        v.origins.push((export.section, origin::of_effect(at, model.causes, way)));
        if matches!(way, Way::Held(_)) || export.residual == Lines::OfConstants {
            if export.carrier == Carrier::Law {
                at.law().robot(at.values(), &mut v.robot);
                by_law.push(at);
            } else {
                carry(export.carrier, at, &mut v);
            }
        }
    }
    v.robot = v.robot.checked()?;
    v.coefficients = v.robot.coefficients();
    for at in by_law {
        at.active().apply(&v.robot.at_rest(), &mut v.coefficients);
    }

    for at in &effects {
        if let Way::Added(why) = at.way(engine) {
            v.residuals.extend(added(at, why, &v));
        }
    }
    v.residuals.extend(of_constants(&v, engine));
    Ok(v)
}

/// Puts the values of an effect where the writers look for them.
fn carry(carrier: Carrier, at: &At<'_>, v: &mut Vehicle) {
    let [a, b, ..] = *at.values();
    let sides = || at.sides().into_iter().enumerate().filter(|(_, has)| *has).map(|(side, _)| side);
    match carrier {
        Carrier::Law => {}
        Carrier::OwnBody => own_body(at, v),
        // Another grip everywhere is that of the robot; at a place, that of a disc.
        Carrier::Grip => match at.place() {
            Some([x, y, radius]) => v.patches.push([x, y, radius, 1.0 - a]),
            None => v.robot.adhesion *= 1.0 - a,
        },
        Carrier::WheelCentre => {
            for side in sides() {
                // A wheel that is alone on its side has nothing that another one lacks.
                let [_, _, cosine, sine, ..] = *at.values();
                let [cosine, sine] = if v.robot.chassis.is_on_four_wheels() { [cosine, sine] } else { [0.0; 2] };
                add([a + cosine, b + sine], &mut v.eccentric[side]);
                add([a - cosine, b - sine], &mut v.eccentric[side + 2]);
            }
        }
        Carrier::Drag => v.drag += a,
        Carrier::GyroMean => v.sensors.gyro += a,
        Carrier::AccelerometerMean => add([a, b], &mut v.sensors.accel),
        Carrier::AccelerometerYaw => v.sensors.left += a,
        Carrier::AccelerometerTilt => add([a, b], &mut v.sensors.up),
        Carrier::EncoderGain => {
            for side in sides() {
                v.sensors.encoder[side] *= 1.0 + a;
            }
        }
        Carrier::SensorDelay => add([a, b], &mut v.sensors.late),
    }
}

fn add(by: [f64; 2], to: &mut [f64; 2]) {
    to[0] += by[0];
    to[1] += by[1];
}

/// What the law adds to the robot becomes a body of its own.
fn own_body(at: &At<'_>, v: &mut Vehicle) {
    let before = v.robot;
    at.law().robot(at.values(), &mut v.robot);
    let mass = v.robot.mass - before.mass;
    if mass > 0.0 {
        let height = (v.robot.mass * v.robot.com[2] - before.mass * before.com[2]) / mass;
        v.payload = Some(Payload { mass, height, yaw_inertia: v.robot.yaw_inertia - before.yaw_inertia });
    }
}

/// What is added for an effect that is not held, with its numbers.
fn added(at: &At<'_>, why: &str, v: &Vehicle) -> Option<Residual> {
    let (does, lines) = match at.spec().export.residual {
        Lines::OfConstants => return None,
        Lines::Force(lines) => (Does::Force, lines.to_vec()),
        Lines::Ground(lines) => (Does::Ground, lines.to_vec()),
        Lines::Reading(lines) => (Does::Reading, lines.to_vec()),
        Lines::Words(sentence) => (Does::Words, vec![sentence]),
    };
    let numbers = placeholders(at, v);
    let filled = |line: &str| numbers.iter().fold(line.to_owned(), |text, (name, value)| text.replace(name, value));
    let lines = lines.into_iter().map(filled).collect();
    Some(Residual { title: at.spec().id.to_owned(), why: why.to_owned(), does, lines })
}

/// What stands for what in the lines of an effect, see [`Lines`].
fn placeholders(at: &At<'_>, v: &Vehicle) -> Vec<(&'static str, String)> {
    let list = |values: &[f64]| values.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", ");
    let [a, b, c, d, e] = at.values().map(number);

    // What the law adds at rest, the heading along the world's x.
    let bare = v.robot.coefficients();
    let mut with = bare;
    at.active().apply(&v.robot.at_rest(), &mut with);
    let force = [0, 1].map(|k| with.force[k] + v.robot.mass * with.tilt[k]);
    let grips = grips(v);
    let rolling: [f64; 4] =
        std::array::from_fn(|i| (with.rolling[i] - bare.rolling[i]) * grips[i].load * v.coefficients.radius[i]);

    vec![
        ("{0}", a),
        ("{1}", b),
        ("{2}", c),
        ("{3}", d),
        ("{4}", e),
        ("{sides}", at.sides_text().to_owned()),
        ("{side}", at.side_name().unwrap_or("left and right").to_owned()),
        ("{place}", list(&at.place().unwrap_or_default())),
        ("{force x}", number(force[0])),
        ("{force y}", number(force[1])),
        ("{moment}", number(with.moment)),
        ("{rolling}", list(&rolling)),
        ("{rim}", number(v.robot.wheel_radius)),
        ("{half track}", number(v.robot.half_track)),
        ("{weight}", number(v.robot.mass * v.robot.gravity)),
        ("{law}", at.spec().law.to_owned()),
    ]
}

/// Constants that an engine does not hold, whether a robot file or an effect brought them in.
fn of_constants(v: &Vehicle, engine: Engine) -> Vec<Residual> {
    let (drive, rise) = (&v.robot.drive, v.coefficients.stribeck);
    let new =
        |title: &str, why: &str, does, lines| Residual { title: title.to_owned(), why: why.to_owned(), does, lines };
    let mut out = Vec::new();
    if engine != Engine::Mjcf && (drive.gain != 1.0 || drive.lag + drive.extra_lag != 0.0 || drive.delay != 0.0) {
        let words = format!(
            "In the controller, each side: delay the command by {} s, multiply by {}, limit to {} N m, then first-order \
             lags of {} s and {} s in series. T is what comes out.",
            number(drive.delay),
            number(drive.gain),
            number(drive.limit),
            number(drive.lag),
            number(drive.extra_lag)
        );
        out.push(new(
            "drive (delay, gain, limit, lags)",
            "a joint takes the torque that it is given",
            Does::Words,
            vec![words],
        ));
    }
    if drive.dead_band > 0.0 {
        let d = number(drive.dead_band);
        let lines = vec!["for j in (0, 1):".to_owned(), format!("    torque[j] -= min(max(T[j], -{d}), {d})")];
        out.push(new("dead band of the drive", "an actuator has no dead band", Does::Force, lines));
    }
    if rise != [0.0; 2] {
        let lines = vec![
            format!("rise = [{}]  # N m", rise.map(number).join(", ")),
            "for j in (0, 1):".to_owned(),
            format!("    torque[j] -= rise[j] * exp(-(w[j] / {}) ** 2) * sign(w[j])", number(STRIBECK_SPEED)),
        ];
        let why = "dry friction of a joint does not rise towards rest";
        out.push(new("Stribeck friction (stiction)", why, Does::Force, lines));
    }
    out
}
