//! Every name that a verdict can contain, with what is known about it.
//!
//! Two kinds of data meet here: the effects of the plants, each with its law in a file of `robot-model`, and causes that
//! have no law in a plant: those of command-driven robots ([`command_driven`]), of which neither torques nor currents are
//! known, of speed-driven robots ([`speed_driven`]), of robots whose wheel motion is compared with a pose ([`odometry`]), of
//! robots of any wheels under torque ([`wheeled`]), of cars ([`car`]), and the answers that name no cause ([`answer`]). A name may be both: the lag of a motor is an effect of the
//! torque-driven plant, and of a command-driven robot it is seen between command and wheel speed.

use robot_model::Effect;
use robot_model::effect::{EffectSpec, LoadTerm};
use robot_model::effects::catalogue;

pub mod answer;
pub mod car;
mod cause;
pub mod command_driven;
pub mod odometry;
pub mod speed_driven;
pub mod wheeled;

pub use cause::CauseSpec;

/// Lengths of a robot: no load, wear or ground changes them, so that what an owner states of them holds.
pub const LENGTHS: [&CauseSpec; 2] = [&car::WHEELBASE, &odometry::WHEEL_DISTANCE];

/// What is known about a name.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// The name.
    pub id: &'static str,
    /// The effect of the plants.
    pub effect: Option<&'static EffectSpec>,
    /// The cause without a law in a plant.
    pub cause: Option<&'static CauseSpec>,
}

impl Entry {
    /// What people call it.
    pub fn label(&self) -> &'static str {
        self.effect.map(|effect| effect.name).or(self.cause.map(|cause| cause.name)).unwrap_or(self.id)
    }
}

/// The effects of the plants, by their ids.
pub fn effects() -> impl Iterator<Item = &'static EffectSpec> {
    catalogue::<f64>().into_iter().map(Effect::spec)
}

/// The causes that have no law in a plant: of command-driven robots in causal order, of speed-driven ones, of odometry, of
/// robots of any wheels, of cars, then the answers that name none.
pub fn causes() -> impl Iterator<Item = &'static CauseSpec> {
    command_driven::ALL
        .into_iter()
        .chain(speed_driven::ALL)
        .chain(odometry::ALL)
        .chain(wheeled::ALL)
        .chain(car::ALL)
        .chain(answer::ALL)
}

/// Every name once: effects first.
pub fn names() -> impl Iterator<Item = &'static str> {
    let others = causes().map(|cause| cause.id).filter(|id| effects().all(|effect| effect.id != *id));
    effects().map(|effect| effect.id).chain(others)
}

/// What is known about a name; `None` where no verdict can contain it.
pub fn find(name: &str) -> Option<Entry> {
    let effect = effects().find(|effect| effect.id == name);
    let cause = causes().find(|cause| cause.id == name);
    let id = effect.map(|effect| effect.id).or(cause.map(|cause| cause.id))?;
    Some(Entry { id, effect, cause })
}

/// A label of a verdict for people: an id, `radius_of_one_wheel (left)`, as its name; anything else as it is.
pub fn for_people(label: &str) -> String {
    let (id, place) = label.split_at(label.find(' ').unwrap_or(label.len()));
    match find(id).map(|entry| entry.label()) {
        // Some names begin with their id.
        Some(name) if !label.starts_with(name) => format!("{name}{place}"),
        _ => label.to_owned(),
    }
}

/// Whether an effect needs a hand on the robot: its mass, motors and wheels do not change by themselves, and nothing hangs
/// itself on its hitch.
pub fn needs_a_hand(id: &str) -> bool {
    use robot_model::effects::{
        com_offset, constant_pull, motor_lag, payload, torque_constant, torque_saturation, wheel_eccentricity,
        wheel_radius_mismatch,
    };
    let by_hand = [
        payload::SPEC.id,
        com_offset::SPEC.id,
        constant_pull::SPEC.id,
        torque_constant::SPEC.id,
        torque_saturation::SPEC.id,
        motor_lag::SPEC.id,
        wheel_radius_mismatch::SPEC.id,
        wheel_eccentricity::SPEC.id,
    ];
    by_hand.contains(&id)
}

/// The drive that reveals a name best; `None` where none does.
pub fn revealed_by(id: &str) -> Option<&'static str> {
    let entry = find(id)?;
    let drive = entry.effect.map(|e| e.revealed_by).or(entry.cause.map(|c| c.revealed_by))?;
    (!drive.is_empty()).then_some(drive)
}

/// The effect that a term of the torque law of a speed-driven robot stands for; [`answer::UNKNOWN`]'s name where the
/// catalogue has none.
pub fn of_load_term(term: LoadTerm) -> &'static str {
    effects().find(|effect| effect.load_term == Some(term)).map_or(answer::UNKNOWN.id, |effect| effect.id)
}

/// The README's example, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
