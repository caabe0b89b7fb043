//! The next manoeuvre: which drive would tell the remaining rivals apart best.
//!
//! For every drive of a `menu`, and for short profiles made by a search (`optimise`), every rival in turn is taken for
//! true: its robot follows the drive (`follow`), and each other rival runs free over the same segments, re-tuned within
//! what is known of it (`expected_gain`). What the drive is expected to gain is the expected fall of the `entropy` of the
//! rivals (Box and Hill 1967; Buzzi-Ferraris, Forzatti 1983; here with the decision's own temperature).

mod expected_gain;
mod follow;
mod menu;
mod optimise;
mod rivals;
#[cfg(test)]
mod tests;

use rayon::prelude::*;
use verdict::{Advice, Contender, Manoeuvre};

use crate::channel::{Channel, Channels};
use crate::fit::{Fitted, Problem};
use crate::judged::Judged;
use crate::regimes::Regimes;
use crate::settings::{decision, next::SETTINGS};
use expected_gain::{ExpectedGain, Forecaster};
use follow::Follower;
use inference::advice::{among as advice_among, nothing_to_split, sorted};
use inference::expected_information::{expected_bits, widest_pair};
use menu::{Entry, Scope, Setup};
use rivals::{Rival, rivals};

/// Temperature that turned scores into the rivals' probabilities.
const TEMPERATURE: f64 = decision::SETTINGS.prices.temperature;

/// Advises on the next drive of a torque-driven robot.
pub(crate) fn advise(answer: &Judged<'_>, retuned: &Fitted, length: f64) -> Advice {
    let rivals = rivals(answer.problem, answer.decision, retuned);
    let problem = answer.problem;
    let scope = Scope::new(answer.references, problem.cuts, problem.robot, length);
    among(problem, &answer.calibration.regimes, &scope, &rivals, answer.decision.unknown)
}

/// Advice on what tells these rivals apart; `unknown` is the probability that none of them is true.
fn among(problem: &Problem<'_>, regimes: &Regimes, scope: &Scope, rivals: &[Rival], unknown: f64) -> Advice {
    let Some(follower) = Follower::new(problem) else {
        return Advice::withheld("no recording is long enough for advice; record longer");
    };
    let contender =
        |r: &Rival| Contender { effects: r.effects.clone(), name: r.name.clone(), probability: r.probability };
    let mut out = advice_among(rivals.iter().map(contender));
    let mut entries = scope.entries();
    entries.extend(rivals.iter().find_map(Rival::place).map(|place| scope.across(place)));

    let forecaster = Forecaster { problem, regimes, rivals, follower };
    let p: Vec<f64> = rivals.iter().map(|r| r.probability).collect();
    let bits = |o: &ExpectedGain| expected_bits(&p, &o.views, TEMPERATURE);
    let mut drives: Vec<(Entry, ExpectedGain)> =
        entries.into_par_iter().filter_map(|e| forecaster.expected_gain(&e).map(|o| (e, o))).collect();
    if rivals.len() > 1 {
        let found = optimise::optimised(scope, |e| forecaster.expected_gain(e).map(|o| bits(&o)));
        drives.extend(found.and_then(|(e, _)| forecaster.expected_gain(&e).map(|o| (e, o))));
    }

    let gained: Vec<f64> = drives.par_iter().map(|(_, o)| bits(o)).collect();
    out.manoeuvres = drives.iter().zip(gained).map(|((e, o), bits)| manoeuvre(e, o, bits, rivals)).collect();
    out.withheld = nothing_to_split(&out);
    out.limits = limits(unknown, &out);
    sorted(out)
}

fn manoeuvre(entry: &Entry, gain: &ExpectedGain, bits: f64, rivals: &[Rival]) -> Manoeuvre {
    let p: Vec<f64> = rivals.iter().map(|r| r.probability).collect();
    let split = widest_pair(&p, &gain.views, TEMPERATURE);
    let mut out = Manoeuvre::new(&entry.name, entry.course.clone(), entry.start);
    out.why = split
        .map_or_else(|| narrowing(gain.narrows, rivals), |(k, l)| apart(&rivals[k], &rivals[l], &gain.shows[k][l]));
    out.expected_bits = bits;
    out.splits = split.map(|(k, l)| [rivals[k].name.clone(), rivals[l].name.clone()]);
    out.narrows = gain.narrows;
    out.joins = entry.setup == Setup::AsItIs;
    out.optimised = entry.optimised;
    out
}

fn apart(k: &Rival, l: &Rival, shows: &Channels<f64>) -> String {
    let (channel, most) = Channel::ALL
        .map(|c| (c, shows[c]))
        .into_iter()
        .fold((Channel::LeftWheel, 0.0), |a, b| if b.1 > a.1 { b } else { a });
    format!(
        "Between \"{}\" and \"{}\" the {} would differ by {most:.1} times its deviation in \
         fault-free drives, even with all constants re-tuned.",
        k.name,
        l.name,
        channel.name()
    )
}

fn narrowing(narrows: Option<f64>, rivals: &[Rival]) -> String {
    match (narrows, rivals.first()) {
        (Some(share), Some(first)) => {
            format!(
                "The uncertainty of the size of {} would fall to {:.0} % of what it is now.",
                first.name,
                100.0 * share
            )
        }
        _ => "It would add to what the recordings say about the robot.".to_owned(),
    }
}

fn limits(unknown: f64, advice: &Advice) -> Vec<String> {
    let mut out = Vec::new();
    if unknown > SETTINGS.rivals.doubt {
        out.push(format!(
            "with probability {unknown:.2} the cause is not in the catalogue: which drive would \
             reveal it best cannot be computed, and the expected bits refer to the effects of the \
             catalogue only"
        ));
    }
    if advice.manoeuvres.iter().any(|m| !m.joins) {
        out.push(
            "drives with a load or with wheels off the ground cannot be added to the other recordings: diagnose them by \
             themselves, with a robot file that says so"
                .to_owned(),
        );
    }
    out
}
