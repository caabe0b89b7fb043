//! The catalogue of effects and causes, for programs.

use catalogue::CauseSpec;
use robot_model::EffectSpec;
use serde_json::{Value, json};

/// Version of the JSON of the catalogue.
pub const FORMAT: u32 = 1;

/// All effects as JSON.
pub fn effects_json() -> Vec<Value> {
    catalogue::effects().map(effect_json).collect()
}

/// An effect as JSON.
pub fn effect_json(spec: &EffectSpec) -> Value {
    let parameters: Vec<Value> = spec
        .parameters
        .iter()
        .map(|p| {
            json!({
                "name": p.name, "unit": p.unit, "role": p.role.name(), "bounds": p.bounds, "neutral": p.neutral,
                "probes": p.probes, "bounds_in": p.counted_in(),
            })
        })
        .collect();
    json!({
        "id": spec.id, "name": spec.name, "kind": spec.kind.name(), "law": spec.law, "seen": spec.seen,
        "parameters": parameters, "signed": spec.signed, "axes": spec.axes, "looked_for": spec.scopes.forms().collect::<Vec<_>>(),
        "redundancy": spec.redundancy.shows_in(), "interest": spec.interest, "interest_grows_with": spec.sized_by.words().trim_start(), "revealed_by": spec.revealed_by,
        "resembles": spec.resembles, "source": spec.source,
    })
}

/// A cause without a law in a plant as JSON.
pub fn cause_json(cause: &CauseSpec) -> Value {
    json!({
        "id": cause.id, "name": cause.name, "robots": cause.robots, "meaning": cause.meaning, "size": cause.size,
        "unit": cause.unit, "recognised": cause.recognised, "revealed_by": cause.revealed_by,
        "resembles": cause.resembles,
    })
}
