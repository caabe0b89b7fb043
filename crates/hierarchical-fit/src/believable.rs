//! Answers that ask for what no owner would believe, beside those that ask for far less.
//!
//! Evidence counts what the laws of tyres and servos get wrong as noise of many rows, and may pay for it with a constant that its owner
//! knows to a hair. Where an answer without that cause, its other causes looked for anew, leaves hardly more, the drives do not need it.

use catalogue::LENGTHS;

use crate::answered::Answered;
use crate::cause::Cause;
use crate::data::{Data, Prior};
use crate::fit::Fit;
use crate::look_alikes::{exchanged, sigmas};
use crate::observed::Observed;
use crate::settings::SETTINGS;
use crate::solve::answered;

/// The answer about drives that nothing but the robot file came before, without a length that is asked for far more of its owner's
/// sigmas than another answer asks of any constant which leaves hardly more. Such a cause moves nothing from now on, and is told beside
/// what stands for it. Loads, tyres and ground change, whatever an owner is sure of; lengths do not.
pub(crate) fn believable<D: Observed>(
    data: &Data<D>,
    prior: &Prior,
    causes: &mut [Cause],
    (mut best, mut retuned): (Answered, Fit),
) -> Option<(Answered, Fit)> {
    let rules = SETTINGS.naming;
    let asked = |answer: &Answered| sigmas(prior, answer, 0..prior.mean.len());
    for _ in 0..rules.disbelieved {
        let of = |cause: usize| sigmas(prior, &best, causes[cause].moves());
        let lengths = best.named.chosen.iter().filter(|w| LENGTHS.contains(&causes[w.cause].spec));
        let farthest = lengths
            .map(|w| (of(w.cause), w.cause))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(far, _)| *far > rules.believed);
        let Some((far, cause)) = farthest else { break };

        let directions = std::mem::take(&mut causes[cause].directions);
        let (other, of_none) = answered(data, prior, causes, prior.mean.as_slice().to_vec())?;
        let mut other = exchanged(data, prior, causes, &of_none, other)?;
        if rules.nearer * asked(&other) > far || !leaves_as_much(data, [&other, &best]) {
            causes[cause].directions = directions;
            break;
        }

        let had: Vec<usize> = best.named.chosen.iter().map(|w| w.cause).collect();
        if let Some(stands_for_it) = other.named.chosen.iter_mut().find(|w| !had.contains(&w.cause)) {
            stands_for_it.class.push(cause);
        }
        (best, retuned) = (other, of_none);
    }
    Some((best, retuned))
}

/// Whether one answer leaves hardly more than another of the motion, and of no kind of reading much more.
fn leaves_as_much<D: Observed>(data: &Data<D>, both: [&Answered; 2]) -> bool {
    let rules = SETTINGS.naming;
    let [of_other, own] = both.map(|answer| data.share(&answer.fit.theta));
    let [kinds_of_other, own_kinds] = both.map(|answer| data.left(&answer.fit.theta));
    let is_seen = own_kinds.iter().zip(kinds_of_other).any(|(own, of_other)| *own < rules.seen * of_other);
    of_other < (1.0 + rules.leaves_more) * own && !is_seen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observed::Spread;
    use crate::scaled::Scaled;
    use crate::solve::{Solved, solve};
    use catalogue::CauseSpec;
    use catalogue::car::{STEERING_COMMAND_GAIN, WHEELBASE, YAW_INERTIA};

    /// Three long drives whose scale is 1.3, of which an owner is sure to a per mille; or a second constant is elsewhere, which is
    /// hardly known and does about the same, so much more to larger numbers.
    fn solved(first: &'static CauseSpec, uneven: f64) -> Solved<Scaled> {
        let spread = |sigma: f64| Spread { sigma, usual: 0.3, scatter: 0.001, bounds: [-5.0, 5.0] };
        let drive = || Scaled::changing([1.3, 1.3], 0.0).roughly(0.02).with_second(uneven);
        let data =
            Data { model: (), spreads: vec![spread(0.001), spread(0.05)], drives: vec![drive(), drive(), drive()] };
        let cause = |spec, k: usize| Cause { spec, of: None, directions: vec![(vec![(k, 1.0)], 0.3)], possible: None };
        let causes = vec![cause(first, 0), cause(&STEERING_COMMAND_GAIN, 1)];
        solve(data, None, causes).expect("solved")
    }

    /// Ids of the causes of the answer, and of what stands for them.
    fn told(solved: &Solved<Scaled>) -> Vec<&'static str> {
        solved.named.chosen.iter().flat_map(|w| w.class.iter().map(|c| solved.causes[*c].spec.id)).collect()
    }

    #[test]
    fn a_length_that_its_owner_is_sure_of_is_not_named_where_a_gain_leaves_hardly_more() {
        let alike = solved(&WHEELBASE, 0.035);
        assert_eq!(told(&alike), ["steering_command_gain", "car_wheelbase"], "{:?}", alike.named.chosen);
        assert!(alike.causes[0].directions.is_empty(), "it moves nothing from now on");
    }

    #[test]
    fn what_a_load_changes_is_named_however_sure_its_owner_is() {
        assert_eq!(told(&solved(&YAW_INERTIA, 0.035)), ["yaw_inertia"]);
    }

    #[test]
    fn it_is_named_where_the_errors_need_it() {
        let needed = solved(&WHEELBASE, 0.5);
        assert_eq!(told(&needed)[0], "car_wheelbase", "{:?}", needed.named.chosen);
    }
}
