//! Chooses the structure of both parts by forecasts of windows that were left out.

use rayon::prelude::*;
use verdict::{Alternative, Element, Scaling};

use crate::controller::{DAMPING, DEAD_TIME, FREQUENCY, LAG, Law};
use crate::drive::DrivePart;
use crate::ground::{self, GroundPart, TurnSlip};
use crate::run::STEP;
use crate::search::{Evidence, Model, OtherOrder, Part, Trial, Weighed, attempt, evidence, prune};
use crate::settings::SETTINGS;
use crate::windows::Windows;

/// What the simulation says: of the drive, of the ground.
#[derive(Debug, Clone)]
pub(crate) struct Base {
    pub(crate) drive: Model<Law>,
    pub(crate) ground: Model<TurnSlip>,
}

/// "The wheels do what is commanded, the body rolls without slip on the nominal track."
pub(crate) fn neutral(windows: &Windows) -> Base {
    Base {
        drive: Model { law: Law::default(), x: DrivePart::new(windows, 0).neutral() },
        ground: Model { law: TurnSlip::default(), x: ground::neutral() },
    }
}

/// What was found in a part.
pub(crate) struct Found<L> {
    pub(crate) trial: Trial<L>,
    pub(crate) evidence: Weighed,
    pub(crate) alternatives: Vec<Alternative>,
    pub(crate) scaling_is_told: bool,
}

/// A part of the response that is identified on its own, on any windows.
pub(crate) trait Identify {
    /// What has no size.
    type Law: Copy + PartialEq + Send + Sync + std::fmt::Debug;
    /// Its fit to some windows.
    type Of<'a>: Part<Law = Self::Law>;
    fn part<'a>(&self, windows: &'a Windows) -> Self::Of<'a>;
    /// Elements that may be others from an instant on.
    fn may_begin(&self, windows: &Windows) -> &'static [Element];
    fn identify(&self, windows: &Windows, base: &Model<Self::Law>) -> Found<Self::Law>;
}

/// From command to wheel.
pub(crate) struct OfDrive;

impl Identify for OfDrive {
    type Law = Law;
    type Of<'a> = DrivePart<'a>;

    fn part<'a>(&self, windows: &'a Windows) -> DrivePart<'a> {
        DrivePart::new(windows, 0)
    }

    fn may_begin(&self, _: &Windows) -> &'static [Element] {
        use Element::{DeadTime, Gain, Lag, Ramp, SideGain, TurnLimit, WheelLimit};
        &[DeadTime, Gain, TurnLimit, WheelLimit, Ramp, Lag, SideGain]
    }

    fn identify(&self, windows: &Windows, base: &Model<Law>) -> Found<Law> {
        drive(windows, base)
    }
}

/// From wheel to body.
pub(crate) struct OfGround {
    pub(crate) nominal: [f64; 2],
}

impl Identify for OfGround {
    type Law = TurnSlip;
    type Of<'a> = GroundPart<'a>;

    fn part<'a>(&self, windows: &'a Windows) -> GroundPart<'a> {
        GroundPart::measured(windows, self.nominal)
    }

    fn may_begin(&self, windows: &Windows) -> &'static [Element] {
        use Element::{Radius, SideRadius, Track, TurnSlip};
        let has_position = windows.pieces.iter().any(|p| p.position.is_some());
        if has_position { &[Radius, Track, TurnSlip, SideRadius] } else { &[Track, SideRadius] }
    }

    fn identify(&self, windows: &Windows, base: &Model<TurnSlip>) -> Found<TurnSlip> {
        motion(&self.part(windows), base)
    }
}

fn drive(windows: &Windows, base: &Model<Law>) -> Found<Law> {
    use Element::{DeadTime, ForwardLimit, Gain, Lag, Ramp, SideGain, TurnLimit, WheelLimit};
    let part = DrivePart::new(windows, 0);
    let full = [DeadTime, Gain, TurnLimit, WheelLimit, Ramp, Lag];
    let laws: Vec<Law> = Scaling::ALL
        .into_iter()
        .flat_map(|scaling| [true, false].map(|after_ramp| Law { scaling, after_ramp, ..Law::default() }))
        .collect();
    let mut tried: Vec<(String, Trial<Law>)> =
        laws.par_iter().map(|law| (limit_words(*law), attempt(&part, base, *law, &full, None))).collect();
    let lowest = tried.iter().map(|t| &t.1).min_by(|a, b| a.level().total_cmp(&b.level()));
    let mut best = match lowest {
        Some(t) => t.clone(),
        None => attempt(&part, base, base.law, &[], None),
    };
    let scaling_is_told = Scaling::ALL.into_iter().filter(|s| *s != best.model.law.scaling).all(|s| {
        let same = tried.iter().map(|t| &t.1).filter(|t| t.model.law.scaling == s);
        let rival = same.min_by(|a, b| a.level().total_cmp(&b.level()));
        rival.is_none_or(|r| evidence(windows, &r.loss, &best.loss).score > 0.0)
    });
    let side_ramps = attempt(&part, base, Law { side_ramps: true, ..best.model.law }, &full, None);
    tried.push(("acceleration limits on each side".to_owned(), side_ramps.clone()));
    if side_ramps.level() < best.level() {
        best = side_ramps;
    }
    let second_order = Law { second_order: true, ..best.model.law };
    let usual = attempt(&part, base, second_order, &full, None);
    // Beside dead times that only a lag of first order needs, the fit ends in another valley; of two that are as good, that with less of them.
    let alike = attempt(&part, base, second_order, &full, Some(&with_two_lags(&best)));
    let tied = 1.0 + SETTINGS.evidence.relevant;
    let second = if alike.level() < tied * usual.level() { alike } else { usual };
    tried.push(("second-order lag".to_owned(), second.clone()));
    let mut other = second.clone();
    if evidence(windows, &best.loss, &second.loss).score > 0.0 {
        other = std::mem::replace(&mut best, second);
    }
    // A lag of second order begins slowly, as a dead time does.
    let is_as_good = other.level() < tied * best.level();
    let is_near = other.level() <= SETTINGS.answer.near * best.level() && part.is_inexact(&best.model);
    let (dead_time, lag) = (other.model.x[DEAD_TIME], time_of_lag(&other.model));
    let other_order = (is_as_good || is_near).then_some(OtherOrder { dead_time, lag, is_as_good });
    let mut found = Weighed::new();
    for extra in [ForwardLimit, SideGain] {
        let more: Vec<Element> = best.elements.iter().copied().chain([extra]).collect();
        let t = attempt(&part, base, best.model.law, &more, Some(&best));
        let e = evidence(windows, &best.loss, &t.loss);
        if e.score > 0.0 {
            best = t;
        } else {
            found.push((extra, e));
        }
    }
    let (mut kept, each) = prune(&part, base, best);
    kept.other_order = other_order.filter(|_| kept.has(DeadTime));
    let mut alternatives: Vec<Alternative> =
        tried.iter().map(|(what, t)| alternative(windows, what.clone(), &t.loss, &kept.loss)).collect();
    let without = |e: Element| format!("without {}", crate::element_words::element(e));
    alternatives.extend(each.iter().filter(|(e, _)| kept.has(*e)).map(|(e, v)| Alternative {
        what: without(*e),
        rise: v.rise,
        standard_error: v.standard_error,
    }));
    found.extend(each);
    Found { trial: kept, evidence: found, alternatives, scaling_is_told }
}

/// Where a lag of second order may be looked for beside one of first order: without its dead time, two equal lags that wait as long.
fn with_two_lags(first: &Trial<Law>) -> Trial<Law> {
    let mut out = first.clone();
    let waits = out.model.x[DEAD_TIME] + time_of_lag(&first.model);
    out.model.x[DEAD_TIME] = 0.0;
    out.model.x[FREQUENCY] = 2.0 / waits.max(STEP);
    out.model.x[DAMPING] = 1.0;
    out.free.extend([FREQUENCY, DAMPING]);
    out
}

/// By how much a lag is late, s: its time constant, or of one of second order 2 ζ / ω.
fn time_of_lag(model: &Model<Law>) -> f64 {
    if model.law.second_order { 2.0 * model.x[DAMPING] / model.x[FREQUENCY] } else { model.x[LAG] }
}

fn alternative(windows: &Windows, what: String, loss: &[f64], chosen: &[f64]) -> Alternative {
    let e = evidence(windows, loss, chosen);
    Alternative { what, rise: e.rise, standard_error: e.standard_error }
}

fn limit_words(law: Law) -> String {
    format!(
        "at a wheel's limit {}, {} the acceleration limits",
        law.scaling.words(),
        if law.after_ramp { "after" } else { "before" }
    )
}

fn motion(part: &GroundPart<'_>, base: &Model<TurnSlip>) -> Found<TurnSlip> {
    use Element::{BodyLag, Offset, Radius, SideRadius, Track};
    let windows = part.windows();
    let has_position = windows.pieces.iter().any(|p| p.position.is_some());
    // Without positions only turning is known.
    let (first, extras): (&[Element], &[Element]) = if has_position {
        (&[Radius, Track], &[Offset, Element::TurnSlip, BodyLag, SideRadius])
    } else {
        (&[Track], &[BodyLag, SideRadius])
    };
    let mut best = attempt(part, base, base.law, first, None);
    let mut rejected: Weighed;
    loop {
        let mut tried: Vec<(Element, Evidence, Trial<TurnSlip>)> = extras
            .iter()
            .filter(|e| !best.has(**e))
            .map(|&e| {
                let more: Vec<Element> = best.elements.iter().copied().chain([e]).collect();
                let laws: &[TurnSlip] = if e == Element::TurnSlip { &TurnSlip::ALL } else { &[best.model.law] };
                let trials = laws.iter().map(|law| attempt(part, base, *law, &more, Some(&best)));
                let t = trials.min_by(|a, b| a.level().total_cmp(&b.level())).unwrap_or_else(|| best.clone());
                (e, evidence(windows, &best.loss, &t.loss), t)
            })
            .collect();
        tried.sort_by(|a, b| a.1.score.total_cmp(&b.1.score));
        match tried.pop() {
            Some((_, v, t)) if v.score > 0.0 => best = t,
            last => {
                rejected = tried.into_iter().chain(last).map(|(e, v, _)| (e, v)).collect();
                break;
            }
        }
    }
    let (mut kept, each) = prune(part, base, best);
    rejected.extend(each);
    // A robot file knows neither radius nor track for sure: held where it is, one would put its error into the other.
    let is_half = first.len() > 1 && first.iter().filter(|e| kept.has(**e)).count() == 1;
    if is_half {
        let mut both = kept.elements.clone();
        both.extend(first.iter().filter(|e| !kept.has(**e)));
        kept = attempt(part, base, kept.model.law, &both, Some(&kept));
    }
    Found { trial: kept, evidence: rejected, alternatives: Vec::new(), scaling_is_told: true }
}
