//! The next manoeuvre: which drive would tell the remaining rivals apart best.
//!
//! For every drive of a `menu`, and for short profiles made by a search (`optimise`), every rival in turn is taken for
//! true: its robot follows the drive (`follow`), and each other rival runs free over the same segments, re-tuned within
//! what is known of it (`outlook`). What the drive is expected to gain is the expected fall of the `entropy` of the
//! rivals (Box and Hill 1967; Buzzi-Ferraris, Forzatti 1983; here with the decision's own temper).

mod course;
mod follow;
mod menu;
mod optimise;
mod outlook;
mod rivals;
mod steady;
#[cfg(test)]
mod tests;

use inference::expected_information::{entropy, expected_bits, widest_pair};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::answer::Answer;
use crate::calibrate::Regimes;
use crate::decide::TEMPERATURE;
use crate::fit::{Fitted, Problem};
use crate::windows::{CHANNEL_NAMES, CHANNELS};
use course::Course;
use follow::Follower;
use menu::{Entry, Scope, Setup};
use outlook::{Outlook, Prospect};
use rivals::{Rival, rivals};

pub(crate) use steady::advise_steady;

/// Which drive would tell the remaining rivals apart.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Advice {
    /// What may still be true, the most probable first; probabilities sum to one.
    pub rivals: Vec<Contender>,
    /// How open the question is: entropy of the rivals, bits.
    pub entropy_bits: f64,
    /// Drives, the best first.
    pub manoeuvres: Vec<Manoeuvre>,
    /// Why there is none, or none worth making.
    pub withheld: Option<String>,
    /// What limits the advice.
    pub limits: Vec<String>,
}

/// A hypothesis that may be true.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Contender {
    /// Its effects by id; none of "nothing is missing".
    pub effects: Vec<String>,
    /// For people.
    pub name: String,
    /// Its probability among the rivals.
    pub probability: f64,
}

/// A drive that could be made next.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manoeuvre {
    /// What it is.
    pub name: String,
    /// Why it tells rivals apart, in a sentence.
    pub why: String,
    /// Expected fall of the entropy of the rivals, bits.
    pub expected_bits: f64,
    /// The two rivals that it tells apart best.
    pub splits: Option<[String; 2]>,
    /// One sigma of the first rival's size after the drive over that before, if it has a size.
    pub narrows: Option<f64>,
    /// Its recording can be added to the others as it is; else the robot was changed for it, and so must be its file.
    pub joins: bool,
    /// Found by a search for these rivals.
    pub optimised: bool,
    /// Pose at the start, in the frame of the recordings: x, y in m, yaw in rad.
    pub start: [f64; 3],
    /// Wanted speeds: time s, speed m/s, yaw rate rad/s; linear between points.
    pub profile: Vec<[f64; 3]>,
    /// When the drives are given no torque, s.
    pub torque_free: Vec<[f64; 2]>,
}

impl Manoeuvre {
    fn new(name: &str, course: Course, start: [f64; 3]) -> Self {
        Self {
            name: name.to_owned(),
            why: String::new(),
            expected_bits: 0.0,
            splits: None,
            narrows: None,
            joins: true,
            optimised: false,
            start,
            profile: course.points,
            torque_free: course.torque_free,
        }
    }

    fn course(&self) -> Course {
        Course { points: self.profile.clone(), torque_free: self.torque_free.clone() }
    }

    /// Length, s.
    pub fn length(&self) -> f64 {
        self.profile.last().map_or(0.0, |p| p[0])
    }

    /// Wanted speed m/s and yaw rate rad/s at a time.
    pub fn wanted(&self, t: f64) -> [f64; 2] {
        self.course().at(t)
    }

    /// Whether the drives are given no torque at a time.
    pub fn is_torque_free(&self, t: f64) -> bool {
        self.course().is_free(t)
    }
}

/// Speeds of the left and right wheel, rad/s, for a wanted speed and yaw rate: `w = (v ∓ 1.5 b ω) / r`. Wheels that skid
/// sideways turn the body less than wheels that roll; 1.5 stands for that.
pub fn wheel_speeds(wanted: [f64; 2], robot: &robot_model::Robot<f64>) -> [f64; 2] {
    course::wheel_speeds(wanted, robot.wheel_radius, robot.half_track)
}

impl Advice {
    /// No advice.
    pub fn withheld(reason: &str) -> Self {
        Self { withheld: Some(reason.to_owned()), ..Self::default() }
    }

    /// The best drive whose recording can be added to the others.
    pub fn best(&self) -> Option<&Manoeuvre> {
        self.manoeuvres.iter().find(|m| m.joins)
    }

    fn of(rivals: impl Iterator<Item = Contender>) -> Self {
        let rivals: Vec<Contender> = rivals.collect();
        let p: Vec<f64> = rivals.iter().map(|r| r.probability).collect();
        Self { entropy_bits: entropy(&p), rivals, ..Self::default() }
    }

    /// The best first: by bits, where nothing is to be split by what narrows the size most.
    fn sorted(mut self) -> Self {
        let size = |m: &Manoeuvre| m.narrows.unwrap_or(1.0);
        self.manoeuvres.sort_by(|a, b| {
            b.expected_bits.total_cmp(&a.expected_bits).then(size(a).total_cmp(&size(b))).then(a.name.cmp(&b.name))
        });
        self
    }
}

/// Probability of "unknown" from which advice among the catalogue's effects needs a word.
const DOUBT: f64 = 0.1;
/// A gain this small, bits, is none.
const LEAST_BITS: f64 = 0.005;

/// Advises on the next drive of a torque-driven robot.
pub(crate) fn advise(answer: &Answer<'_>, retuned: &Fitted, length: f64) -> Advice {
    let rivals = rivals(answer.problem, answer.decision, retuned);
    let problem = answer.problem;
    let scope = Scope::new(answer.references, problem.cuts, problem.robot, length);
    among(problem, &answer.calibration.regimes, &scope, &rivals, answer.decision.unknown)
}

/// Advice on what tells these rivals apart; `unknown` is the probability that none of them is true.
fn among(problem: &Problem<'_>, regimes: &Regimes, scope: &Scope, rivals: &[Rival], unknown: f64) -> Advice {
    let Some(follower) = Follower::new(problem) else { return Advice::withheld("no recording is long enough") };
    let contender =
        |r: &Rival| Contender { effects: r.effects.clone(), name: r.name.clone(), probability: r.probability };
    let mut out = Advice::of(rivals.iter().map(contender));
    let mut entries = scope.entries();
    entries.extend(rivals.iter().find_map(Rival::place).map(|place| scope.across(place)));
    let prospect = Prospect { problem, regimes, rivals, follower };
    let p: Vec<f64> = rivals.iter().map(|r| r.probability).collect();
    let bits = |o: &Outlook| expected_bits(&p, &o.views, TEMPERATURE);
    let mut drives: Vec<(Entry, Outlook)> =
        entries.into_par_iter().filter_map(|e| prospect.outlook(&e).map(|o| (e, o))).collect();
    if rivals.len() > 1 {
        let found = optimise::optimised(scope, |e| prospect.outlook(e).map(|o| bits(&o)));
        drives.extend(found.and_then(|(e, _)| prospect.outlook(&e).map(|o| (e, o))));
    }
    let gained: Vec<f64> = drives.par_iter().map(|(_, o)| bits(o)).collect();
    out.manoeuvres = drives.iter().zip(gained).map(|((e, o), bits)| manoeuvre(e, o, bits, rivals)).collect();
    out.withheld = nothing_to_split(&out);
    out.limits = limits(unknown, &out);
    out.sorted()
}

fn manoeuvre(entry: &Entry, outlook: &Outlook, bits: f64, rivals: &[Rival]) -> Manoeuvre {
    let p: Vec<f64> = rivals.iter().map(|r| r.probability).collect();
    let split = widest_pair(&p, &outlook.views, TEMPERATURE);
    let mut out = Manoeuvre::new(&entry.name, entry.course.clone(), entry.start);
    out.why = split.map_or_else(
        || narrowing(outlook.narrows, rivals),
        |(k, l)| apart(&rivals[k], &rivals[l], &outlook.shows[k][l]),
    );
    out.expected_bits = bits;
    out.splits = split.map(|(k, l)| [rivals[k].name.clone(), rivals[l].name.clone()]);
    out.narrows = outlook.narrows;
    out.joins = entry.setup == Setup::AsItIs;
    out.optimised = entry.optimised;
    out
}

fn apart(k: &Rival, l: &Rival, shows: &[f64; CHANNELS]) -> String {
    let (c, most) = (0..CHANNELS).map(|c| (c, shows[c])).fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
    format!(
        "Between {} and {} the {} would differ by {most:.1} times what healthy drives show, with all constants re-tuned.",
        k.name, l.name, CHANNEL_NAMES[c]
    )
}

fn narrowing(narrows: Option<f64>, rivals: &[Rival]) -> String {
    match (narrows, rivals.first()) {
        (Some(share), Some(first)) => {
            format!("The uncertainty of the size of {} would fall to {:.0} %.", first.name, 100.0 * share)
        }
        _ => "It would add to what is known of the robot.".to_owned(),
    }
}

/// Why no drive is worth making for telling rivals apart.
fn nothing_to_split(advice: &Advice) -> Option<String> {
    let most = advice.manoeuvres.iter().map(|m| m.expected_bits).fold(0.0, f64::max);
    match advice.rivals.as_slice() {
        [] => Some("no hypothesis could be fitted".to_owned()),
        [one] if one.effects.is_empty() => {
            Some("nothing is missing in the motion, and no effect rivals that".to_owned())
        }
        [one] => Some(format!(
            "nothing is left to tell apart: only {} is probable; the drives are in the order in which they narrow its size",
            one.name
        )),
        _ if most < LEAST_BITS => Some("no drive of the menu tells these rivals apart".to_owned()),
        _ => None,
    }
}

fn limits(unknown: f64, advice: &Advice) -> Vec<String> {
    let mut out = Vec::new();
    if unknown > DOUBT {
        out.push(format!(
            "with probability {unknown:.2} the cause is not in the catalogue: what would show that best cannot be \
             computed, and the bits count among the catalogue's effects only"
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
