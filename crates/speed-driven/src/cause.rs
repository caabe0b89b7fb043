//! A fitted effect as a cause of a verdict.

use inference::hypothesis::{Place, Sizes};
use verdict::{Cause, Estimate};

use crate::name::Named;

/// One member of a hypothesis as a cause, with its sizes, side and intervals.
pub(crate) fn cause(e: &Named, part: usize, probability: f64) -> Cause {
    let variant = &e.parts[part];
    let spec = variant.spec();
    let (values, sigma) = e.of(part);
    let parameters = variant
        .free(&Sizes::default())
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
        side: if let Place::Side(s) = variant.place { Some(inference::words::side(s).into()) } else { None },
        ..Cause::plain(spec.id, &inference::words::variant(variant), probability)
    }
}
