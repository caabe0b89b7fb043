//! Robot files of four wheels, coupled by side, and of two wheels and casters.

use robot_file::{Causality, RobotSpec, Size, Stands};
use robot_model::Robot as Plant;
use robot_model::constants::Usual;
use robot_model::tunable::{Tuning, place_of, tunables};

use crate::error::ImportError;
use crate::import::{Imported, Kind, Number};
use crate::layout::{Layout, Robot, mean};
use crate::model::Joint;
use crate::settings::SETTINGS;
use crate::solid::Solid;
use crate::source::Source;
use crate::wheels::{RadiusOf, Wheel};

/// A constant that the model states: its name, value, sigma as a share of the value (of an offset: in its unit), source.
struct Stated {
    id: &'static str,
    value: f64,
    sigma: f64,
    source: String,
}

/// The robot file of a skid-steer robot.
pub(crate) fn file(
    source: &Source<'_>,
    robot: &Robot<'_>,
    name: &str,
    kind: Kind,
    causality: Causality,
) -> Result<Imported, ImportError> {
    let sides = robot.sides();
    let casters = Caster::of(robot);
    if !stands(robot, &sides, &casters) {
        return Err(source.whole(format!(
            "the model is {} with {} wheels and {} casters, but {} robots have four fixed wheels, two on each side, or two and \
             one or two casters; make it of another kind with --kind odometry",
            robot.layout.name(),
            robot.wheels.len(),
            casters.len(),
            kind.name()
        )));
    }
    let model = robot.model;
    let Some(whole) = model.solid(&model.of_robot()) else {
        return Err(source.whole(format!(
            "no link states a mass, but {} robots need mass and inertia: add <inertial> to the links, or compare wheel motion \
             with a pose alone (--kind odometry)",
            kind.name()
        )));
    };

    let mut notes = match robot.layout {
        Layout::Differential => robot.notes.clone(),
        _ => robot.notes_without_casters(),
    };
    let size = size(robot, &sides, &casters, whole.mass);
    let cannot_be = |e: robot_model::ModelError| source.whole(format!("no robot can be so: {e}"));
    let mut spec = RobotSpec::of_size(name, &size).map_err(cannot_be)?;
    let stated = constants(robot, &sides, &casters, &whole, &spec.robot, &mut notes);
    spec.causality = causality;
    spec.description = Some(format!("Made from a model in {}, {}", model.form, robot.layout.name()));
    for constant in Plant::<f64>::CONSTANTS {
        if let Some(s) = stated.iter().rfind(|s| constant.is_called(s.id)) {
            (constant.set)(&mut spec.robot, s.value);
        }
    }
    spec.robot.caster_rolling = spec.robot.rolling_resistance;
    let spec = with_spreads(spec, &stated, model.form);
    let spec = RobotSpec { robot: spec.robot.checked().map_err(cannot_be)?, ..spec };

    let unwritable = |e: robot_file::RobotFileError| source.whole(e.to_string());
    Ok(Imported {
        kind,
        layout: robot.layout.name(),
        text: spec.to_toml().map_err(unwritable)?,
        numbers: numbers(&spec, &stated),
        spec: Some(spec),
        notes,
    })
}

/// Every number that the model states, then those that stand in for what it lacks.
fn numbers(spec: &RobotSpec, stated: &[Stated]) -> Vec<Number> {
    // What the plant itself takes when nobody says it is no news.
    let is_default = |c: &robot_model::Constant<f64>| match c.usual {
        Usual::Needed => false,
        Usual::Value(usual) => (c.get)(&spec.robot) == usual,
        Usual::Unlimited | Usual::RearAxle | Usual::As(_) => true,
    };
    let mut out: Vec<Number> = Plant::<f64>::CONSTANTS
        .iter()
        .filter(|c| c.is_of(spec.robot.chassis))
        .filter(|c| stated.iter().any(|s| c.is_called(s.id)) || !is_default(c))
        .map(|c| Number {
            name: c.id.to_owned(),
            value: (c.get)(&spec.robot),
            unit: c.unit.to_owned(),
            source: spec.sources.get(c.id).cloned().unwrap_or_default(),
            is_stated: stated.iter().any(|s| c.is_called(s.id)),
        })
        .collect();
    out.sort_by_key(|n| !n.is_stated);
    out
}

/// Middle of the wheels, forward and to the left of the model's origin.
fn middle(robot: &Robot<'_>) -> [f64; 2] {
    [0, 1].map(|axis| mean(robot.wheels.iter().map(|w| robot.place(w)[axis])))
}

/// A caster as a model has it.
struct Caster {
    /// Its pivot, ahead of the axle of the wheels and to the left of their middle, m.
    place: [f64; 2],
    /// From there to its wheel, m; `None` of a sphere that slides.
    trail: Option<f64>,
}

impl Caster {
    fn of(robot: &Robot<'_>) -> Vec<Self> {
        let [x, y] = middle(robot);
        let from_middle = |[px, py]: [f64; 2]| [px - x, py - y];
        let wheels = robot.casters.iter().map(|wheel| {
            let at = robot.place(wheel);
            let pivot = wheel.pivot.map_or(at, |pivot| robot.seen_from_origin(&pivot));
            Self { place: from_middle(pivot), trail: Some((at[0] - pivot[0]).hypot(at[1] - pivot[1])) }
        });
        let sliders = robot.sliders.iter();
        let sliders =
            sliders.map(|slider| Self { place: from_middle(robot.seen_from_origin(&slider.centre)), trail: None });
        wheels.chain(sliders).collect()
    }
}

/// Whether it stands on four wheels, or on two and casters.
fn stands(robot: &Robot<'_>, sides: &[Vec<&Wheel>; 2], casters: &[Caster]) -> bool {
    let each = |n: usize| sides.iter().all(|side| side.len() == n);
    match robot.layout {
        Layout::SkidSteer => each(2),
        Layout::Differential => each(1) && (1..=2).contains(&casters.len()),
        _ => false,
    }
}

fn size(robot: &Robot<'_>, sides: &[Vec<&Wheel>; 2], casters: &[Caster], mass: f64) -> Size {
    let y = |side: usize| mean(sides[side].iter().map(|w| robot.place(w)[1]));
    let [x, _] = middle(robot);
    let between_axles = 2.0 * mean(robot.wheels.iter().map(|w| (robot.place(w)[0] - x).abs()));
    Size {
        mass,
        wheel_radius: mean(robot.wheels.iter().map(|w| w.radius)),
        track: y(0) - y(1),
        stands: match (robot.layout, casters) {
            (Layout::Differential, [first, ..]) => {
                Stands::Casters([first.place, casters.last().map_or(first.place, |last| last.place)])
            }
            _ => Stands::Axles(between_axles),
        },
    }
}

/// What the model says of the constants; `usual` are those of a robot of this size.
fn constants(
    robot: &Robot<'_>,
    sides: &[Vec<&Wheel>; 2],
    casters: &[Caster],
    whole: &Solid,
    usual: &Plant<f64>,
    notes: &mut Vec<String>,
) -> Vec<Stated> {
    let (model, form) = (robot.model, robot.model.form);
    let all: Vec<&Wheel> = robot.wheels.iter().collect();
    let [x, y] = middle(robot);
    let Size { wheel_radius: radius, track, stands, .. } = size(robot, sides, casters, whole.mass);
    if all.iter().any(|w| (w.radius - radius).abs() > SETTINGS.spreads.stated * radius) {
        notes.push("its wheels have different radii; their mean was taken".to_owned());
    }

    let mut out = Vec::new();
    let mut say = |id: &'static str, value: f64, sigma: f64, what: &str| {
        out.push(Stated { id, value, sigma, source: format!("{form}: {what}") });
    };
    say("mass", whole.mass, SETTINGS.spreads.stated, "masses of all links");
    let yaw = whole.about_axis(&whole.centre, &nalgebra::Vector3::z());
    say("yaw_inertia", yaw, SETTINGS.spreads.stated_inertia, "inertias of all links about their centre of mass");
    let off = whole.centre.coords;
    let [com_x, com_y] = [off.dot(&robot.forward) - x, off.dot(&robot.left()) - y];
    say(
        "com_x",
        com_x,
        SETTINGS.spreads.stated * stands.length(),
        "centre of mass of all links, from the middle of the wheels",
    );
    say("com_y", com_y, SETTINGS.spreads.stated * track, "centre of mass of all links, from the middle of the wheels");
    say(
        "com_height",
        whole.centre.z - robot.ground,
        SETTINGS.spreads.stated_inertia,
        "centre of mass of all links, above the ground",
    );
    match stands {
        Stands::Axles(wheelbase) => {
            say("wheelbase", wheelbase, SETTINGS.spreads.stated, "places of the wheel joints");
        }
        Stands::Casters(places) => {
            let ids = ["caster_x", "caster_y", "second_caster_x", "second_caster_y"];
            for (id, at) in ids.into_iter().zip(places.into_iter().flatten()) {
                say(id, at, SETTINGS.spreads.stated, "place of the caster's pivot, from the middle of the wheels");
            }
        }
    }
    let trails = casters.iter().filter_map(|caster| caster.trail).filter(|trail| *trail > 0.0);
    if let Some(trail) = trails.reduce(f64::midpoint) {
        say("caster_trail", trail, SETTINGS.spreads.stated, "from a caster's pivot to its wheel");
    }
    say("track", track, SETTINGS.spreads.stated, "places of the wheel joints");
    let of = match all[0].radius_of {
        RadiusOf::Contact | RadiusOf::Rollers => "collision shapes of the wheels",
        RadiusOf::Sight => "visual shapes of the wheels",
        RadiusOf::Told => "given by the user",
    };
    say("wheel_radius", radius, SETTINGS.spreads.stated, of);

    let joint = |w: &Wheel| &model.joints[w.joint];
    let spin = |w: &&Wheel| Some(model.solid(&w.links)?.about_axis(&w.centre, &w.axle));
    let spins: Vec<f64> = all.iter().filter_map(spin).collect();
    let least = spins.iter().copied().fold(f64::INFINITY, f64::min);
    let solid_disc = 0.5 * whole.mass * radius * radius;
    if least >= solid_disc {
        notes.push(format!(
            "a wheel's inertia of {least:.3} kg m2 is more than that of a disc as heavy as the whole robot ({solid_disc:.3}); a \
             usual one was taken"
        ));
    } else if least > 0.0 && spins.len() == all.len() {
        say("wheel_inertia", least, SETTINGS.spreads.stated_inertia, "inertia of a wheel about its axle");
    }
    let armature = all.iter().filter_map(|w| joint(w).armature).sum::<f64>() / 2.0;
    let surplus = spins.iter().sum::<f64>() / 2.0 - least * spins.len() as f64 / 2.0;
    if armature > 0.0 {
        say("motor_inertia", armature, SETTINGS.spreads.stated_inertia, "armature of the joints of a side");
    } else if least < solid_disc && surplus > SETTINGS.fillers.motor_surplus * least {
        say(
            "motor_inertia",
            surplus,
            SETTINGS.spreads.stated_inertia,
            "what some wheels of a side turn with beyond the lightest one",
        );
    }

    match robot.adhesion(usual.sliding_share) {
        Some(Ok(peak)) => say(
            "adhesion",
            peak,
            SETTINGS.spreads.stated_friction,
            "friction of the wheels, as the middle of peak and sliding",
        ),
        Some(Err(filler)) => notes.push(not_of_rubber(filler)),
        None => {}
    }
    drives(robot, sides, usual, &mut say);
    out
}

/// What to say of a friction coefficient that no tyre has.
pub(crate) fn not_of_rubber(filler: f64) -> String {
    format!("friction of {filler} is none of rubber: a usual one was taken")
}

/// Friction and limits of the drives.
fn drives(
    robot: &Robot<'_>,
    sides: &[Vec<&Wheel>; 2],
    usual: &Plant<f64>,
    say: &mut impl FnMut(&'static str, f64, f64, &str),
) {
    let sum = |side: usize, of: fn(&Joint) -> Option<f64>| -> Option<f64> {
        let given: Vec<f64> = sides[side].iter().filter_map(|w| of(&robot.model.joints[w.joint])).collect();
        (!given.is_empty()).then(|| given.iter().sum()).filter(|total| *total > 0.0)
    };
    // Half of the robot rolls on each side; simulators have no rolling resistance, so joint friction stands for both.
    let rolls = |resistance: f64| 0.5 * usual.mass * usual.gravity * resistance * usual.wheel_radius;
    let dry = [0, 1].map(|side| sum(side, |j| j.friction));
    if let [Some(left), Some(right)] = dry {
        // What rolls takes at most half of the weaker side's friction.
        let resistance = usual.rolling_resistance.min(0.5 * left.min(right) / rolls(1.0));
        for (id, whole) in [("coulomb_left", left), ("coulomb_right", right)] {
            say(
                id,
                whole - rolls(resistance),
                SETTINGS.spreads.stated_friction,
                "friction of the joints of a side, less rolling resistance",
            );
        }
        say("rolling_resistance", resistance, SETTINGS.spreads.stated_friction, "share of the joints' friction");
    }
    for (side, id) in ["viscous_left", "viscous_right"].into_iter().enumerate() {
        if let Some(damping) = sum(side, |j| j.damping) {
            say(id, damping, SETTINGS.spreads.stated_friction, "damping of the joints of a side");
        }
    }
    let torque = |j: &Joint| j.effort.filter(|e| j.follows.is_none() && (0.0..SETTINGS.fillers.no_effort).contains(e));
    if let [Some(left), Some(right)] = [0, 1].map(|side| sum(side, torque)) {
        say("torque_limit", left.min(right), SETTINGS.spreads.stated, "largest torque of the joints of a side");
    }
}

/// The robot with sources and sigmas: of what the model states as it states them, of the rest as of guesses.
fn with_spreads(mut spec: RobotSpec, stated: &[Stated], form: &str) -> RobotSpec {
    for constant in Plant::<f64>::CONSTANTS {
        let said = stated.iter().rfind(|s| constant.is_called(s.id));
        let usual = format!("not in the {form}: usual value, a guess");
        spec.sources.insert(constant.id, said.map_or(usual, |s| s.source.clone()));
        let Some(tuning) = constant.tuning else { continue };
        let Some(place) = place_of(tuning.id) else { continue };
        let usual = tunables::<f64>()[place].sigma;
        spec.sigma[place] = match said {
            Some(s) => s.sigma.max(usual),
            // An offset's usual value is zero: it may be off by what it usually is.
            None if tuning.tuning == Tuning::Offset => usual,
            None => SETTINGS.spreads.lacking.max(usual),
        };
    }
    spec
}
