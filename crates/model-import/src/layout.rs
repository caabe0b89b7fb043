//! What robot the wheels of a model make.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use nalgebra::{Point3, Vector3};

use crate::error::ImportError;
use crate::import::{Kind, Rollers};
use crate::model::Model;
use crate::settings::SETTINGS;
use crate::source::Source;
use crate::wheels::{Ground, Hangs, Slider, Wheel};

/// How a robot turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Layout {
    /// Fixed wheels on one axle; the rest follows.
    Differential,
    /// Fixed wheels on several axles: it turns by skidding.
    SkidSteer,
    /// One steered wheel and a fixed axle.
    Tricycle,
    /// A steered axle and a fixed one.
    Car,
    /// Steered wheels that are no one axle, or no fixed one beside them.
    SteeredAxles,
    /// Rollers let it move sideways.
    Rollers(Rollers),
}

impl Layout {
    /// For people.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Differential => "a differential drive",
            Self::SkidSteer => "a skid-steer robot",
            Self::Tricycle => "a tricycle",
            Self::Car => "a car",
            Self::SteeredAxles => "a robot with steered wheels on several axles, or with steered wheels alone",
            Self::Rollers(Rollers::Omni) => "a robot with omni wheels",
            Self::Rollers(Rollers::Mecanum) => "a robot with mecanum wheels",
        }
    }
}

/// A robot on its wheels. Places are measured from the model's origin: along the direction of driving, and to the left.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Robot<'a> {
    pub(crate) model: &'a Model,
    pub(crate) layout: Layout,
    /// Wheels that keep the robot's direction or steer it; casters apart.
    pub(crate) wheels: Vec<Wheel>,
    pub(crate) casters: Vec<Wheel>,
    /// Spheres that slide along the ground.
    pub(crate) sliders: Vec<Slider>,
    /// Direction of driving.
    pub(crate) forward: Vector3<f64>,
    /// Height of the ground, m.
    pub(crate) ground: f64,
    /// What was found and is no number.
    pub(crate) notes: Vec<String>,
}

impl<'a> Robot<'a> {
    /// The robot of a model; `told` are the rollers that the user knows of.
    pub(crate) fn new(
        source: &Source<'_>,
        model: &'a Model,
        ground: Ground,
        told: Option<Rollers>,
    ) -> Result<Self, ImportError> {
        let (casters, wheels): (Vec<Wheel>, Vec<Wheel>) =
            ground.wheels.into_iter().partition(|w| w.hangs == Hangs::Caster);
        if wheels.is_empty() {
            return Err(source.whole(no_wheels(&ground.without_radius)));
        }
        let mut notes = model.notes.clone();
        if !ground.without_radius.is_empty() {
            notes.push(format!(
                "joints that turn without end and have no cylinder or sphere that tells a radius are taken for no wheels: {}; if \
                 they are wheels, give --wheel-radius",
                ground.without_radius.join(", ")
            ));
        }

        let layout = layout(model, &wheels, told, &mut notes);
        let forward = forward(layout, &wheels);
        if forward.x < 1.0 - SETTINGS.layout.parallel {
            notes.push(
                "the model does not drive along its x axis; lengths are measured along the way it drives".to_owned(),
            );
        }
        let (sliders, ground) = (ground.sliders, ground.height);
        Ok(Self { model, layout, wheels, casters, sliders, forward, ground, notes })
    }

    /// What is to be known of a robot file that has no place for casters: of spheres that slide, too.
    pub(crate) fn notes_without_casters(&self) -> Vec<String> {
        let names: Vec<&str> = self.sliders.iter().map(|slider| slider.name.as_str()).collect();
        let left_out = (!names.is_empty())
            .then(|| format!("spheres that slide along the ground were left out: {}", names.join(", ")));
        self.notes.iter().cloned().chain(left_out).collect()
    }

    /// Direction to the left.
    pub(crate) fn left(&self) -> Vector3<f64> {
        Vector3::z().cross(&self.forward)
    }

    /// Place of a wheel: forward and to the left of the model's origin.
    pub(crate) fn place(&self, wheel: &Wheel) -> [f64; 2] {
        self.seen_from_origin(&wheel.centre)
    }

    /// The same of any point.
    pub(crate) fn seen_from_origin(&self, point: &Point3<f64>) -> [f64; 2] {
        [self.forward, self.left()].map(|axis| point.coords.dot(&axis))
    }

    /// Where a wheel rolls to when its joint turns on, counter-clockwise from ahead, rad.
    pub(crate) fn direction(&self, wheel: &Wheel) -> f64 {
        let ahead = wheel.axle.cross(&Vector3::z());
        ahead.dot(&self.left()).atan2(ahead.dot(&self.forward))
    }

    /// From a wheel's axle to that of its rollers, in (−π/2, π/2]; 0 without rollers.
    pub(crate) fn roller(&self, wheel: &Wheel) -> f64 {
        let Layout::Rollers(rollers) = self.layout else { return 0.0 };
        if let Some(axle) = wheel.roller {
            let along = axle.dot(&self.left()).atan2(axle.dot(&self.forward));
            let turned = along - (self.direction(wheel) + FRAC_PI_2);
            // An axle has no ends: half a turn changes nothing.
            let within = turned - (turned / PI).round() * PI;
            return if within <= -FRAC_PI_2 + f64::EPSILON { within + PI } else { within };
        }
        let [x, y] = self.place(wheel);
        match rollers {
            Rollers::Omni => FRAC_PI_2,
            Rollers::Mecanum if x * y > 0.0 => FRAC_PI_4,
            Rollers::Mecanum => -FRAC_PI_4,
        }
    }

    /// Friction coefficient of its wheels at the peak, or what one of them states that none of rubber has; `None` where none states
    /// any. A simulator has one coefficient where tyres have a peak and less beyond it, `sliding_share` of it: the middle of both.
    pub(crate) fn adhesion(&self, sliding_share: f64) -> Option<Result<f64, f64>> {
        let [low, high] = SETTINGS.fillers.friction;
        let stated: Vec<f64> = self.wheels.iter().flat_map(|w| w.friction.iter().copied()).collect();
        let real: Vec<f64> = stated.iter().copied().filter(|mu| (low..=high).contains(mu)).collect();
        let peak = || mean(real.iter().copied()) / (0.5 * (1.0 + sliding_share));
        stated.first().map(|first| if real.is_empty() { Err(*first) } else { Ok(peak()) })
    }

    /// Refuses steered wheels of several axles for a kind that knows one steering angle.
    pub(crate) fn of_many_axles(&self, source: &Source<'_>, kind: Kind) -> ImportError {
        let steered: Vec<&str> = self.steered(true).map(|w| w.name.as_str()).collect();
        source.whole(format!(
            "of its wheels {} are steered ({}) and {} fixed, which is not one axle of each, but robot files of kind {} know one \
             steering angle; leave out --kind (or write --kind wheeled, with torques), or give a model with one steered and one fixed \
             axle",
            steered.len(),
            steered.join(", "),
            self.wheels.len() - steered.len(),
            kind.name()
        ))
    }

    /// Wheels that are steered, or not.
    pub(crate) fn steered(&self, steered: bool) -> impl Iterator<Item = &Wheel> {
        self.wheels.iter().filter(move |w| matches!(w.hangs, Hangs::Steered(_)) == steered)
    }

    /// Wheels of the left side, then of the right.
    pub(crate) fn sides(&self) -> [Vec<&Wheel>; 2] {
        let middle = mean(self.wheels.iter().map(|w| self.place(w)[1]));
        let (left, right) = self.wheels.iter().partition(|w| self.place(w)[1] > middle);
        [left, right]
    }
}

/// Mean of some numbers; zero of none.
pub(crate) fn mean(of: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = of.fold((0.0, 0_usize), |(sum, count), x| (sum + x, count + 1));
    sum / count.max(1) as f64
}

fn no_wheels(without_radius: &[String]) -> String {
    if without_radius.is_empty() {
        return "no wheel was found: none of its joints turns without end about a level axis; a wheel is a continuous (URDF) or \
                unlimited joint with a cylinder or sphere below it"
            .to_owned();
    }
    format!(
        "no wheel was found: {} turn without end about a level axis, but no cylinder or sphere there tells a radius (meshes do \
         not); if these are wheels, give it with --wheel-radius",
        without_radius.join(", ")
    )
}

fn is_parallel(a: &Wheel, b: &Wheel) -> bool {
    a.axle.cross(&b.axle).norm() < SETTINGS.layout.parallel
}

fn layout(model: &Model, wheels: &[Wheel], told: Option<Rollers>, notes: &mut Vec<String>) -> Layout {
    let steered: Vec<&Wheel> = wheels.iter().filter(|w| matches!(w.hangs, Hangs::Steered(_))).collect();
    let fixed: Vec<&Wheel> = wheels.iter().filter(|w| w.hangs == Hangs::Fixed).collect();
    let is_one_axle = |of: &[&Wheel]| {
        let x = |w: &Wheel| w.centre.coords.dot(&forward_of(w));
        of.iter().all(|w| is_parallel(w, of[0]) && (x(w) - x(of[0])).abs() < SETTINGS.layout.one_axle * w.radius)
    };
    if !steered.is_empty() {
        if fixed.is_empty() || !is_one_axle(&fixed) || !is_one_axle(&steered) {
            return Layout::SteeredAxles;
        }
        if steered.len() > 1 {
            return Layout::Car;
        }
        let left = Vector3::z().cross(&forward_of(fixed[0]));
        let across = |w: &Wheel| w.centre.coords.dot(&left);
        if (across(steered[0]) - mean(fixed.iter().map(|w| across(w)))).abs() > steered[0].radius {
            notes.push(format!(
                "the only steered wheel found, '{}', is off the middle: if another belongs beside it, its joint does not turn \
                 without end, or its shapes tell no radius",
                steered[0].name
            ));
        }
        return Layout::Tricycle;
    }

    let parallel = wheels.iter().all(|w| is_parallel(w, &wheels[0]));
    let has = |word: &str| {
        let of = |name: &str| name.to_ascii_lowercase().contains(word);
        of(&model.name) || wheels.iter().any(|w| of(&w.name))
    };
    if let Some(rollers) = told {
        return Layout::Rollers(rollers);
    }
    if wheels.iter().any(|w| w.roller.is_some()) {
        return Layout::Rollers(if parallel { Rollers::Mecanum } else { Rollers::Omni });
    }
    if !parallel {
        notes.push("axles point different ways, which needs rollers: omni wheels, rollers across the wheel".to_owned());
        return Layout::Rollers(Rollers::Omni);
    }
    if wheels.len() == 4 && has("mecanum") {
        notes.push(
            "its name says mecanum: upper rollers are taken to form an X seen from above; correct roller_deg if not"
                .to_owned(),
        );
        return Layout::Rollers(Rollers::Mecanum);
    }
    if is_one_axle(&fixed) { Layout::Differential } else { Layout::SkidSteer }
}

/// Where a wheel rolls to when it turns about its axle, within half a turn of x (or of y, of one that rolls along y).
fn forward_of(wheel: &Wheel) -> Vector3<f64> {
    let ahead = wheel.axle.cross(&Vector3::z()).normalize();
    let is_ahead = if ahead.x.abs() > SETTINGS.layout.parallel { ahead.x > 0.0 } else { ahead.y > 0.0 };
    if is_ahead { ahead } else { -ahead }
}

/// The direction of driving: that of fixed wheels; x of robots that drive any way.
fn forward(layout: Layout, wheels: &[Wheel]) -> Vector3<f64> {
    if let Layout::Rollers(_) = layout {
        return Vector3::x();
    }
    let fixed = wheels.iter().find(|w| w.hangs == Hangs::Fixed);
    let ahead = fixed.map_or_else(Vector3::x, forward_of);
    // A car drives with its steered axle ahead.
    let along = |w: &Wheel| w.centre.coords.dot(&ahead);
    let steered = wheels.iter().find(|w| matches!(w.hangs, Hangs::Steered(_)));
    let is_behind = steered.zip(fixed).is_some_and(|(s, f)| along(s) < along(f));
    if is_behind && layout == Layout::Car { -ahead } else { ahead }
}
