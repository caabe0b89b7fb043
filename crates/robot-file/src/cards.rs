//! The catalogue of effects, for programs.

use robot_model::Card;
use robot_model::effects::catalogue;
use serde_json::{Value, json};

/// Version of the JSON of cards.
pub const FORMAT: u32 = 1;

/// The cards of all effects.
pub fn cards() -> Vec<&'static Card> {
    catalogue::<f64>().iter().map(|e| e.card()).collect()
}

/// The forms in which the diagnosis looks for an effect.
pub fn wears(card: &Card) -> Vec<&'static str> {
    card.wears.forms().collect()
}

/// A card as JSON.
pub fn as_json(card: &Card) -> Value {
    let parameters: Vec<Value> = card
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
        "id": card.id, "name": card.name, "kind": card.kind.name(), "law": card.law, "seen": card.seen,
        "parameters": parameters, "signed": card.signed, "axes": card.axes, "looked_for": wears(card),
        "redundancy": card.redundancy.shows_in(), "interest": card.interest, "revealed_by": card.revealed_by,
        "resembles": card.resembles, "source": card.source,
    })
}
