//! A fitted effect as a cause of a verdict.

use catalogue::speed_driven::SOFT_GROUND;
use verdict::{Cause, Estimate};

use crate::name::Named;

/// One member of a hypothesis as a cause, with its sizes, side and intervals.
pub(crate) fn cause(e: &Named, part: usize, probability: f64) -> Cause {
    if e.is_soft_ground {
        // Its size is how much harder the ground rolls.
        let (values, sigma) = e.of(0);
        return Cause {
            magnitude: Some(e.parts[0].magnitude(values)),
            sigma: sigma.first().copied().filter(|s| s.is_finite()),
            unit: SOFT_GROUND.unit.into(),
            ..Cause::plain(SOFT_GROUND.id, SOFT_GROUND.name, probability)
        };
    }
    let variant = &e.parts[part];
    let spec = variant.spec();
    let (values, sigma) = e.of(part);
    let parameters = e.free[part]
        .iter()
        .zip(values.iter().zip(sigma))
        .filter_map(|(f, (&value, &sigma))| {
            let at_bound = value <= f.bounds[0] || value >= f.bounds[1];
            let estimate = Estimate { value, sigma: Some(sigma).filter(|s| s.is_finite()), at_bound };
            f.parameter.map(|i| (spec.parameters[i].name.to_owned(), estimate))
        })
        .collect();
    Cause {
        magnitude: Some(variant.magnitude(values)),
        sigma: sigma.first().copied().filter(|s| s.is_finite()),
        unit: inference::words::unit(spec).into(),
        parameters,
        side: variant.side().map(|s| inference::words::side(s).into()),
        ..Cause::plain(spec.id, &inference::words::variant(variant), probability)
    }
}
