//! What may make a car's motion differ from what throttle and steering imply: directions in the space of the constants.

use hierarchical_fit::Cause;

use crate::constants::Constant;

/// The causes that can show: each with the constants that it moves.
pub(crate) fn causes(constants: &[Constant], has_references: bool) -> Vec<Cause> {
    let mut out: Vec<Cause> = Vec::new();
    for (k, constant) in constants.iter().enumerate() {
        if !constant.can_be_wrong(has_references) {
            continue;
        }
        let direction = (vec![(k, 1.0)], constant.usual);
        match out.iter_mut().find(|cause| cause.spec == constant.cause) {
            Some(cause) => cause.directions.push(direction),
            None => {
                out.push(Cause { spec: constant.cause, of: None, directions: vec![direction], possible: None });
            }
        }
    }
    out
}
