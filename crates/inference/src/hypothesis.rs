//! What may be missing: every way in which an effect of the catalogue can be present.

use std::fmt;

use robot_model::constants::NO_LIMIT;
use robot_model::effect::{MAX_PARAMETERS, Redundancy, Role, Scale};
use robot_model::presence::{Disc, Presence};
use robot_model::{Active, Chassis, Effect, EffectSpec, Robot};

use verdict::{EffectAt, Side};

use crate::KnownEffects;
use crate::settings::SETTINGS;

/// An effect at values, present somewhere.
#[derive(Clone)]
pub struct Dose {
    /// The effect.
    pub effect: &'static dyn Effect<f64>,
    /// One value for each parameter of its specification, in the units there.
    pub values: Vec<f64>,
    /// When, where and on which side it is present.
    pub presence: Presence<f64>,
}

impl fmt::Debug for Dose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { effect, values, presence } = self;
        f.debug_struct("Dose")
            .field("effect", &effect.spec().id)
            .field("values", values)
            .field("presence", presence)
            .finish()
    }
}

impl Dose {
    /// The effect for a plant.
    pub fn active(&self) -> Active<f64> {
        Active::new(self.effect, &self.values, self.presence)
    }
}

/// Where an effect is present.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Everywhere, all the time.
    Whole,
    /// On one side: 0 left, 1 right.
    Side(usize),
    /// Under wheels in a disc on the ground.
    Disc,
    /// From an instant of each recording on.
    Onset,
    /// On one side from an instant of each recording on: 0 left, 1 right.
    OnsetOfSide(usize),
}

/// One effect in one of its forms.
#[derive(Clone, Copy)]
pub struct Variant {
    /// The effect.
    pub effect: &'static dyn Effect<f64>,
    /// Which of its axes, where it has several.
    pub axis: Option<usize>,
    /// Where it is present.
    pub place: Place,
}

/// A number that a fit may change.
#[derive(Debug, Clone, Copy)]
pub struct Free {
    /// Index in its parameters; `None` for the disc's x, y and radius.
    pub parameter: Option<usize>,
    /// Size of one unit of it: a medium strength, a usual shape, a length on the ground.
    pub unit: f64,
    /// Least and largest value.
    pub bounds: [f64; 2],
    /// Value at which a fit starts when nothing better is known.
    pub usual: f64,
}

/// What the usual sizes of effects are in proportion to.
#[derive(Debug, Clone, Copy)]
pub struct Sizes {
    /// The largest torque commanded in the recordings, N m.
    pub largest_torque: f64,
    /// The robot; that of the catalogue's own sizes where it is `None`.
    pub robot: Option<Robot<f64>>,
}

impl Default for Sizes {
    fn default() -> Self {
        Self { largest_torque: 1.0, robot: None }
    }
}

impl Sizes {
    /// Sizes of an effect on this robot over those that its specification tells.
    pub fn factor(&self, spec: &EffectSpec) -> f64 {
        self.robot.as_ref().map_or(1.0, |robot| spec.sized_by.factor(robot))
    }

    /// Size of an effect below which nobody would act on this robot, in the unit of its magnitude.
    pub fn interest(&self, spec: &EffectSpec) -> f64 {
        spec.interest * self.factor(spec)
    }
}

/// Onsets of a hypothesis in each run, s; `None` where it does not set in.
pub type Onsets = Vec<Option<f64>>;

impl Variant {
    /// What is known about the effect.
    pub fn spec(&self) -> &'static EffectSpec {
        self.effect.spec()
    }

    /// The side that it is on, 0 left, 1 right; `None` of an effect of both.
    pub fn side(&self) -> Option<usize> {
        if let Place::Side(side) | Place::OnsetOfSide(side) = self.place { Some(side) } else { None }
    }

    /// Whether it begins at an instant of each recording.
    pub fn begins(&self) -> bool {
        matches!(self.place, Place::Onset | Place::OnsetOfSide(_))
    }

    /// Name for people and files: effect, side, axis, place.
    pub fn label(&self) -> String {
        let mut out = self.spec().id.to_owned();
        if let Some(a) = self.axis {
            out = format!("{out} ({})", self.spec().axes[a]);
        }
        match self.place {
            Place::Whole => {}
            Place::Side(s) => out += [" (left)", " (right)"][s.min(1)],
            Place::Disc => out += " (place)",
            Place::Onset => out += " (from an instant)",
            Place::OnsetOfSide(s) => out += [" (left, from an instant)", " (right, from an instant)"][s.min(1)],
        }
        out
    }

    /// Indices of the strengths that are free here.
    pub fn strengths(&self) -> Vec<usize> {
        let all: Vec<usize> = self.spec().strengths().collect();
        self.axis.map_or(all.clone(), |a| vec![all[a]])
    }

    /// Everything a fit may change, strengths first, then shapes, then the disc.
    pub fn free(&self, sizes: &Sizes) -> Vec<Free> {
        let spec = self.spec();
        let mut out = Vec::new();
        for role in [false, true] {
            for (i, p) in spec.parameters.iter().enumerate() {
                if (p.role == Role::Shape) != role || (!role && !self.strengths().contains(&i)) {
                    continue;
                }
                let of_robot = if p.role == Role::Shape { 1.0 } else { sizes.factor(spec) };
                let of_torque = if p.scale == Scale::LargestTorque { sizes.largest_torque } else { 1.0 };
                let probe = p.probes[p.probes.len() / 2] * of_robot * of_torque;
                let mut bounds = p.bounds.map(|b| if b.abs() < NO_LIMIT { b * of_robot } else { b });
                if let Some((of, robot)) = p.added_to.zip(sizes.robot.as_ref()) {
                    bounds[0] = bounds[0].max(-of(robot));
                }
                let unit = p.step.unwrap_or(probe.abs());
                out.push(Free { parameter: Some(i), unit, bounds, usual: probe });
            }
        }
        if self.place == Place::Disc {
            let disc = SETTINGS.disc;
            let anywhere = [-disc.farthest, disc.farthest];
            for bounds in [anywhere, anywhere, disc.radius] {
                out.push(Free { parameter: None, unit: disc.unit, bounds, usual: disc.start });
            }
        }
        out
    }

    /// How many values a fit may change.
    pub fn count(&self) -> usize {
        self.free(&Sizes::default()).len()
    }

    /// The doses of run `run` at the free values `e`.
    pub fn dose(&self, e: &[f64], onset: Option<f64>) -> Dose {
        let spec = self.spec();
        let mut values: Vec<f64> = spec.parameters.iter().take(MAX_PARAMETERS).map(|p| p.neutral).collect();
        let mut presence = Presence::default();
        let mut disc = Vec::new();
        // Bounds and scale do not matter here, only the order.
        for (f, &v) in self.free(&Sizes::default()).iter().zip(e) {
            match f.parameter {
                Some(i) => values[i] = v,
                None => disc.push(v),
            }
        }
        presence.side = self.side();
        if self.place == Place::Disc {
            presence.disc = Some(Disc { centre: [disc[0], disc[1]], radius: disc[2] });
        }
        if self.begins() {
            presence.from = onset.unwrap_or(f64::MAX);
        }
        Dose { effect: self.effect, values, presence }
    }

    /// The same for files: by name, with onsets by recording.
    pub fn at(&self, e: &[f64], onsets: &Onsets, recordings: &[&str]) -> EffectAt {
        let spec = self.spec();
        let mut out = EffectAt { effect: spec.id.to_owned(), ..EffectAt::default() };
        let mut disc = Vec::new();
        for (f, &v) in self.free(&Sizes::default()).iter().zip(e) {
            match f.parameter {
                Some(i) => {
                    out.values.insert(spec.parameters[i].name.to_owned(), v);
                }
                None => disc.push(v),
            }
        }
        out.side = self.side().map(Side::of);
        if self.place == Place::Disc {
            out.place = Some([disc[0], disc[1], disc[2]]);
        }
        for (name, onset) in recordings.iter().zip(onsets).filter(|_| self.begins()) {
            match onset {
                Some(t) => _ = out.from.insert((*name).to_owned(), *t),
                None => out.absent.push((*name).to_owned()),
            }
        }
        out
    }

    /// Size of the effect in its unit: the norm of its strengths, or the one that is free with its sign.
    pub fn magnitude(&self, e: &[f64]) -> f64 {
        match self.strengths().len() {
            1 => e[0],
            n => e[..n].iter().map(|x| x * x).sum::<f64>().sqrt(),
        }
    }
}

/// All forms of all effects of the catalogue that show in the motion of a skid-steer robot, in its order.
///
/// Without a pose nothing but the motion can tell a fault of the gyro from turning: then it is one of them.
pub fn variants(pose: bool) -> Vec<Variant> {
    variants_of(KnownEffects::default(), Chassis::SkidSteer, pose)
}

/// The same of robots on any chassis, with effects of one's own, which come last.
pub fn variants_of(known: KnownEffects, chassis: Chassis, pose: bool) -> Vec<Variant> {
    let mut out = Vec::new();
    for effect in known.all().filter(|effect| effect.spec().is_of(chassis)) {
        let spec = effect.spec();
        let of_gyro = matches!(spec.redundancy, Redundancy::GyroOffset | Redundancy::GyroGain);
        if spec.redundancy != Redundancy::None && (pose || !of_gyro) {
            continue;
        }
        let axes: Vec<Option<usize>> =
            if spec.axes.is_empty() { vec![None] } else { (0..spec.axes.len()).map(Some).collect() };
        for axis in axes {
            let scopes = spec.scopes;
            if scopes.side {
                out.extend((0..2).map(|s| Variant { effect, axis, place: Place::Side(s) }));
            } else if scopes.everywhere {
                out.push(Variant { effect, axis, place: Place::Whole });
            }
            if scopes.onset && scopes.side {
                out.extend((0..2).map(|s| Variant { effect, axis, place: Place::OnsetOfSide(s) }));
            } else if scopes.onset {
                out.push(Variant { effect, axis, place: Place::Onset });
            }
            if scopes.disc {
                out.push(Variant { effect, axis, place: Place::Disc });
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_chassis_has_the_effects_that_it_can_have() {
        let has = |chassis: Chassis, id: &str| {
            variants_of(KnownEffects::default(), chassis, true).iter().any(|v| v.spec().id == id)
        };
        for (id, four, on_casters) in [
            ("belt_loss", true, false),
            ("contact_loss", true, false),
            ("caster_drag", false, true),
            ("payload", true, true),
        ] {
            assert_eq!((has(Chassis::SkidSteer, id), has(Chassis::Differential, id)), (four, on_casters), "{id}");
        }
    }

    #[test]
    fn a_brake_may_begin_on_one_side() {
        let all = variants_of(KnownEffects::default(), Chassis::SkidSteer, true);
        let right = |v: &&Variant| v.spec().id == "coulomb_side" && v.place == Place::OnsetOfSide(1);
        let brake = all.iter().find(right).expect("in the catalogue");
        assert!(brake.begins() && brake.label() == "coulomb_side (right, from an instant)");
        let presence = brake.dose(&[1.5], Some(4.0)).presence;
        assert_eq!((presence.side, presence.from), (Some(1), 4.0));
        let at = brake.at(&[1.5], &vec![Some(4.0), None], &["a", "b"]);
        assert_eq!((at.side, at.from["a"], at.absent), (Some(Side::Right), 4.0, vec!["b".to_owned()]));
    }

    #[test]
    fn a_friction_cannot_be_taken_below_nothing() {
        let robot = Robot { rolling_resistance: 0.03, ..Robot::from(&robot_model::paper::Parameters::SET_A) };
        let all = variants_of(KnownEffects::default(), Chassis::SkidSteer, true);
        let rolling = all.iter().find(|v| v.spec().id == "rolling_resistance").expect("in the catalogue");
        let least = |robot| rolling.free(&Sizes { largest_torque: 1.0, robot })[0].bounds[0];
        approx::assert_relative_eq!(least(Some(robot)), -0.03);
        assert!(least(None) < -0.1);
    }
}
