//! An effect of a given size, in the form in which a replica has it.

use inference::KnownEffects;
use inference::hypothesis::{Dose, Place, Sizes, Variant};
use law::OwnEffect;
use robot_model::effect::export::Way;
use robot_model::{Effect, EffectSpec};

use crate::random::{Purpose, Stream};

/// Why an effect whose every size matters is not rehearsed.
const NO_INTEREST: &str = "it has no size of interest to take multiples of: any size of it matters";
/// Why a fault of samples over time is not rehearsed.
const ON_SAMPLES: &str =
    "it acts on the samples of a whole drive (frozen rows, jumps, clocks), which the plant does not simulate";
/// Why an effect that is only at places or from instants on is not rehearsed.
const LOCAL: &str = "it is present only at a place or from an instant on, which a rehearsal does not draw";

/// An effect that can be hidden.
#[derive(Clone, Copy)]
pub(crate) struct Hidden {
    effect: &'static dyn Effect<f64>,
    sizes: Sizes,
}

impl Hidden {
    /// Every effect that is known on this scale of sizes, or why it cannot be hidden.
    pub(crate) fn all(
        known: KnownEffects,
        sizes: &Sizes,
    ) -> impl Iterator<Item = Result<Self, (&'static EffectSpec, &'static str)>> + use<> {
        let sizes = *sizes;
        let can_be =
            move |effect: &&dyn Effect<f64>| sizes.robot.is_none_or(|robot| effect.spec().is_of(robot.chassis));
        known.all().filter(can_be).map(move |effect| {
            let spec = effect.spec();
            if spec.export.robot_file == Way::ON_SAMPLES {
                Err((spec, ON_SAMPLES))
            } else if spec.interest <= 0.0 {
                Err((spec, NO_INTEREST))
            } else if !spec.scopes.everywhere && !spec.scopes.side {
                Err((spec, LOCAL))
            } else {
                Ok(Self { effect, sizes })
            }
        })
    }

    pub(crate) fn spec(&self) -> &'static EffectSpec {
        self.effect.spec()
    }

    /// Size of interest on this robot, in the unit of the effect.
    pub(crate) fn interest(&self) -> f64 {
        self.sizes.interest(self.spec())
    }

    /// The form of a replica: sides take turns, and so do axes.
    fn variant(&self, replica: usize) -> Variant {
        let (spec, effect) = (self.spec(), self.effect);
        let axis = (!spec.axes.is_empty()).then(|| replica % spec.axes.len());
        let place = if spec.scopes.side { Place::Side(replica % 2) } else { Place::Whole };
        Variant { effect, axis, place }
    }

    /// The effect at a multiple of its size of interest; `None` where that lies beyond the bounds
    /// of its values.
    ///
    /// A strength that may have either sign has them in turns; several components have a direction
    /// that the seed draws.
    pub(crate) fn dose(&self, multiple: f64, seed: u64, replica: usize) -> Option<Dose> {
        let (spec, variant) = (self.spec(), self.variant(replica));
        let mut free = variant.free(&self.sizes);
        let strengths = variant.strengths().len();
        // Shapes stay as usual, so does a disc, which no variant here has.
        let mut values: Vec<f64> = free.iter().map(|f| f.usual).collect();
        free.truncate(strengths);

        let direction: Vec<f64> = if strengths == 1 {
            // A law of one's own has the sign of its file: friction is not to push.
            let (is_own, usual) =
                (OwnEffect::of(self.effect).is_some(), free.first().map_or(1.0, |f| f.usual.signum()));
            vec![if spec.signed && !is_own && (replica / 2) % 2 == 1 { -usual } else { usual }]
        } else {
            let mut stream = Stream::new(seed, Purpose::Direction, &[replica]);
            let drawn: Vec<f64> = (0..strengths).map(|_| stream.normal()).collect();
            let length = drawn.iter().map(|d| d * d).sum::<f64>().sqrt();
            drawn.iter().map(|d| d / length).collect()
        };

        let size = multiple * self.interest();
        for ((value, of), part) in values.iter_mut().zip(&free).zip(&direction) {
            let within = |x: f64| (of.bounds[0]..=of.bounds[1]).contains(&x);
            // Where only the other sign is sensible, that is taken.
            *value = [size * part, -size * part].into_iter().find(|x| within(*x))?;
        }
        Some(variant.dose(&values, None))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hidden(id: &str) -> Hidden {
        let sizes = Sizes { largest_torque: 5.0, robot: Some(testing::robot()) };
        Hidden::all(KnownEffects::default(), &sizes)
            .filter_map(Result::ok)
            .find(|h| h.spec().id == id)
            .expect("can be hidden")
    }

    #[test]
    fn a_dose_has_the_size_that_was_asked_for_in_every_replica() {
        let sizes = Sizes { largest_torque: 5.0, robot: Some(testing::robot()) };
        let law = "T_right = -0.5 [N m] * sgn(omega, 0.3)".parse().expect("a law");
        let known = KnownEffects::with(vec![OwnEffect::new("my-law", law).expect("an effect")]);
        assert!(Hidden::all(known, &sizes).filter_map(Result::ok).any(|hidden| hidden.spec().id == "my-law"));
        for hidden in Hidden::all(known, &sizes).filter_map(Result::ok) {
            for replica in 0..4 {
                let Some(dose) = hidden.dose(1.0, 3, replica) else { panic!("{}: no dose", hidden.spec().id) };
                let strengths: Vec<usize> = hidden.spec().strengths().collect();
                let size = strengths.iter().map(|i| dose.values[*i].powi(2)).sum::<f64>().sqrt();
                let (id, interest) = (hidden.spec().id, hidden.interest());
                assert!((size / interest - 1.0).abs() < 1e-9, "{id}: {size}, not {interest}");
            }
        }
    }

    #[test]
    fn sides_axes_and_signs_take_turns() {
        let side = |replica| hidden("coulomb_side").dose(1.0, 1, replica).expect("a dose").presence.side;
        assert_eq!([side(0), side(1)], [Some(0), Some(1)]);
        let sign = |replica| hidden("gyro_bias").dose(1.0, 1, replica).expect("a dose").values[0].signum();
        assert_eq!([sign(0), sign(2)], [1.0, -1.0]);
        let moved = |replica| hidden("com_offset").dose(1.0, 1, replica).expect("a dose").values;
        assert!(moved(0)[1] == 0.0 && moved(1)[0] == 0.0);
    }

    #[test]
    fn sizes_beyond_what_is_sensible_are_refused() {
        assert!(hidden("contact_loss").dose(1.0, 1, 0).is_some());
        assert!(hidden("contact_loss").dose(10.0, 1, 0).is_none());
    }

    #[test]
    fn what_cannot_be_hidden_has_its_reason() {
        let why = |id: &str| {
            let refused = Hidden::all(KnownEffects::default(), &Sizes::default())
                .filter_map(Result::err)
                .find(|(spec, _)| spec.id == id);
            refused.map(|(_, why)| why)
        };
        assert_eq!(why("clock_drift"), Some(ON_SAMPLES));
        assert_eq!(why("torque_saturation"), Some(NO_INTEREST));
        assert_eq!(why("payload"), None);
    }
}
