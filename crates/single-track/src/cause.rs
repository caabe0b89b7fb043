//! What may make a car's motion differ from what throttle and steering imply: directions in the space of the constants.

use hierarchical_fit::{Cause, Possible};

use crate::constants::{Constant, Quantity};

/// The causes that can show: each with the constants that it moves.
pub(crate) fn causes(constants: &[Constant], has_references: bool) -> Vec<Cause> {
    let mut out: Vec<Cause> = Vec::new();
    for (k, constant) in constants.iter().enumerate() {
        if !constant.can_be_wrong(has_references) {
            continue;
        }
        let direction = (vec![(k, 1.0)], constant.usual);
        if let Some(cause) = out.iter_mut().find(|cause| cause.spec == constant.cause) {
            cause.directions.push(direction);
            continue;
        }
        // A sensor that shows a speed before it is there is not late.
        let is_lateness = constant.quantity == Quantity::EncoderDelay;
        let possible = is_lateness.then(|| Possible::at_least_zero(k));
        out.push(Cause { spec: constant.cause, of: None, directions: vec![direction], possible });
    }
    out
}
