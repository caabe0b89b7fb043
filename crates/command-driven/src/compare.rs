//! Forecasts of left-out windows from the commands alone, by four simulations.

use inference::experiment::{Comparison, Experiment, Forecast, free_run};
use inference::robust::{median, rms};
use verdict::{Element, FreeRun, Scaling};

use crate::controller::Law;
use crate::drive::DrivePart;
use crate::ground::{GroundPart, Poses, TurnSlip, misses};
use crate::identified::Identified;
use crate::identify::Base;
use crate::run::WINDOW;
use crate::search::{Timed, Trial, attempt};
use crate::settings::SETTINGS;
use crate::windows::{FOLDS, Windows};

/// What is compared: over the window, and at its end.
pub(crate) const QUANTITIES: [(&str, &str); 5] = [
    ("wheel speed", "rad/s"),
    ("position", "m"),
    ("yaw", "rad"),
    ("position at the end", "m"),
    ("yaw at the end", "rad"),
];

/// Errors of every window, per quantity: rms over the window, or size at its end.
pub(crate) type Errors = [Vec<f64>; QUANTITIES.len()];

/// A simulation of both parts, with its fits for left-out windows.
pub(crate) struct Simulation {
    drive: Trial<Law>,
    powers: usize,
    ground: Trial<TurnSlip>,
}

/// Both parts at fitted constants.
pub(crate) struct Model {
    drive: Timed<Law>,
    powers: usize,
    ground: Timed<TurnSlip>,
}

/// What a simulation says: wheel speeds by piece, poses by window.
pub(crate) struct Motion {
    pub(crate) wheels: Vec<Vec<[f64; 2]>>,
    pub(crate) poses: Vec<Poses>,
}

/// The windows by four simulations, fold by fold.
pub(crate) type Simulated = Forecast<Model, Motion>;

/// Windows of command-driven recordings, of which each fold is left out in turn.
pub(crate) struct Rivals<'a> {
    windows: &'a Windows,
    all: Comparison<Simulation>,
    /// Free constants of the corrected and of the placebo.
    pub(crate) constants: [usize; 2],
    nominal: [f64; 2],
    largest: f64,
}

/// Wrong causes in the order in which they are given constants: what each side alone could do (friction, a torque limit).
const WRONG_DRIVE: [Element; 4] = [Element::WheelLimit, Element::Lag, Element::Ramp, Element::DeadTime];
const WRONG_GROUND: [Element; 6] =
    [Element::Radius, Element::SideRadius, Element::Offset, Element::TurnSlip, Element::BodyLag, Element::Track];

impl Experiment for Rivals<'_> {
    type Model = Model;
    type Response = Motion;

    fn blocks(&self) -> usize {
        FOLDS
    }

    fn fitted_without(&self, fold: usize) -> Option<Comparison<Model>> {
        Some(self.all.map(|s| Model { drive: s.drive.without(fold), powers: s.powers, ground: s.ground.without(fold) }))
    }

    fn fitted(&self) -> Comparison<Model> {
        self.all.map(|s| Model { drive: s.drive.now(), powers: s.powers, ground: s.ground.now() })
    }

    fn response(&self, model: &Model, _: usize) -> Motion {
        self.motion(self.windows, model)
    }

    fn quantities(&self) -> Vec<String> {
        QUANTITIES.map(|(name, unit)| format!("{name}, {unit}")).to_vec()
    }

    fn errors(&self, motion: &Motion, fold: usize) -> Vec<Vec<f64>> {
        let all = errors(self.windows, motion);
        let own = |of_window: Vec<f64>| {
            of_window.into_iter().enumerate().filter(|(w, _)| self.windows.fold(*w) == fold).map(|(_, e)| e).collect()
        };
        all.into_iter().map(own).collect()
    }
}

impl<'a> Rivals<'a> {
    pub(crate) fn new(windows: &'a Windows, base: &Base, found: &Identified, nominal: [f64; 2]) -> Self {
        let part = DrivePart::new(windows, 0);
        let measured = GroundPart::measured(windows, nominal);
        let as_told = attempt(&part, &base.drive, base.drive.law, &[], None);
        let plain = attempt(&measured, &base.ground, base.ground.law, &[], None);

        let has_position = windows.pieces.iter().any(|p| p.position.is_some());
        let tunables: &[Element] = if has_position { &[Element::Radius, Element::Track] } else { &[Element::Track] };
        let as_commanded = GroundPart::new(windows, part.wheels(base.drive.law, &base.drive.x), nominal);
        let retuned = attempt(&as_commanded, &base.ground, base.ground.law, tunables, None);

        let placebo = placebo(windows, base, found, nominal);
        let count = |d: &Trial<Law>, g: &Trial<TurnSlip>| d.constants() + g.constants();
        let constants = [count(&found.drive, &found.ground), count(&placebo.drive, &placebo.ground)];
        let simulation = |drive: &Trial<Law>, ground: &Trial<TurnSlip>| Simulation {
            drive: drive.clone(),
            powers: 0,
            ground: ground.clone(),
        };
        let all = Comparison {
            nominal: simulation(&as_told, &plain),
            retuned: simulation(&as_told, &retuned),
            corrected: Some(simulation(&found.drive, &found.ground)),
            placebo: Some(placebo),
        };
        Self { windows, all, constants, nominal, largest: part.largest }
    }

    /// Errors on windows that no fit has seen.
    pub(crate) fn unseen(&self, windows: &Windows) -> Comparison<Errors> {
        self.fitted().map(|model| errors(windows, &self.motion(windows, model)))
    }

    /// Errors when only the drive is corrected, of windows that no fit has seen or each by a fit without its fold.
    pub(crate) fn drive_only(&self, unseen: Option<&Windows>) -> Errors {
        let with_plain_ground = |corrected: &Comparison<Model>| {
            let drive = corrected.best().drive.clone();
            Model { drive, powers: 0, ground: self.all.nominal.ground.now() }
        };
        if let Some(windows) = unseen {
            return errors(windows, &self.motion(windows, &with_plain_ground(&self.fitted())));
        }
        let folds: Vec<Vec<Vec<f64>>> = (0..FOLDS)
            .filter_map(|fold| self.fitted_without(fold).map(|models| (fold, with_plain_ground(&models))))
            .map(|(fold, model)| Experiment::errors(self, &self.response(&model, fold), fold))
            .collect();
        joined(folds.iter())
    }

    /// Wheel speeds of every piece and poses of every window.
    fn motion(&self, windows: &Windows, model: &Model) -> Motion {
        let mut part = DrivePart::new(windows, model.powers);
        part.largest = self.largest;
        let wheels = model.drive.wheels(&part);
        let poses = model.ground.poses(&GroundPart::new(windows, wheels.clone(), self.nominal));
        Motion { wheels, poses }
    }
}

/// Errors of all windows from those of every fold: neighbouring windows share one, so that folds follow each other.
fn joined<'a>(folds: impl Iterator<Item = &'a Vec<Vec<f64>>>) -> Errors {
    let mut out = Errors::default();
    for fold in folds {
        out.iter_mut().zip(fold).for_each(|(all, own)| all.extend(own));
    }
    out
}

/// Errors of one fold: by quantity, then by window.
type OfFold = Vec<Vec<f64>>;

/// Errors of every window, each by fits that left it out.
pub(crate) fn left_out(folds: &[Simulated]) -> Comparison<Errors> {
    let of = |which: &dyn Fn(&Comparison<OfFold>) -> Option<&OfFold>| {
        joined(folds.iter().filter_map(|fold| which(&fold.errors)))
    };
    Comparison {
        nominal: of(&|c| Some(&c.nominal)),
        retuned: of(&|c| Some(&c.retuned)),
        corrected: Some(of(&|c| c.corrected.as_ref())),
        placebo: Some(of(&|c| c.placebo.as_ref())),
    }
}

/// Errors of every window.
pub(crate) fn errors(windows: &Windows, motion: &Motion) -> Errors {
    let Motion { wheels, poses } = motion;
    let rms = |sum: f64, n: usize| (sum / n as f64).sqrt();
    let mut out: Errors = std::array::from_fn(|_| Vec::with_capacity(windows.list.len()));
    for (w, p) in windows.list.iter().zip(poses) {
        let measured = &windows.pieces[w.piece].wheel;
        let square: f64 = (w.start..w.start + WINDOW)
            .flat_map(|i| [0, 1].map(|s| (wheels[w.piece][i][s] - measured[i][s]).powi(2)))
            .sum();
        out[0].push(rms(square, 2 * WINDOW));
        let m = misses(windows, w, p);
        out[1].push(rms(m.iter().map(|m| m[0] * m[0] + m[1] * m[1]).sum(), WINDOW));
        out[2].push(rms(m.iter().map(|m| m[2] * m[2]).sum(), WINDOW));
        let last = m[WINDOW - 1];
        out[3].push(last[0].hypot(last[1]));
        out[4].push(last[2].abs());
    }
    out
}

/// The best wrong cause: wheels that answer each for themselves, by any odd law of their own command, with as many
/// constants as the corrected simulation has. Where the drive is right, constants of the ground that were not named.
fn placebo(windows: &Windows, base: &Base, found: &Identified, nominal: [f64; 2]) -> Simulation {
    let named = &found.drive.elements;
    let count = found.drive.constants();
    let law = Law { side_ramps: true, scaling: Scaling::EachSide, ..Law::default() };
    let mut elements = Vec::new();
    let mut powers = 0;
    if count > 0 {
        let usable = WRONG_DRIVE.into_iter().filter(|e| count > SETTINGS.placebo.few || !named.contains(e));
        elements.extend(usable.take(count.saturating_sub(1)));
        powers = count - elements.len();
        elements.push(Element::Gain);
    }
    let part = DrivePart::new(windows, powers);
    let mut start = base.drive.clone();
    if powers > 0 {
        start.x = part.neutral();
        start.law = Law::default();
    }
    let drive = attempt(&part, &start, law, &elements, None);
    let chosen = &found.ground.elements;
    let wrong: Vec<Element> = if count > 0 {
        chosen.clone()
    } else {
        WRONG_GROUND.into_iter().filter(|e| !chosen.contains(e)).take(chosen.len()).collect()
    };
    let wheels = part.wheels(drive.model.law, &drive.model.x);
    let ground = attempt(&GroundPart::new(windows, wheels, nominal), &base.ground, base.ground.law, &wrong, None);
    Simulation { drive, powers, ground }
}

/// Root mean square and median.
pub(crate) fn summary(errors: &[f64]) -> [f64; 2] {
    let all = || errors.iter().copied();
    [rms(all()).unwrap_or(0.0), median(all()).unwrap_or(0.0)]
}

/// Rows of the answer: rms and median over windows of 2 s of every quantity that was recorded.
pub(crate) fn free_runs(name: &str, errors: &Comparison<Errors>, has_position: bool) -> Vec<FreeRun> {
    let mut out = Vec::new();
    for (q, (what, unit)) in QUANTITIES.iter().enumerate() {
        if what.starts_with("position") && !has_position {
            continue;
        }
        let all = errors.map(|e| summary(&e[q]));
        for (s, statistic) in ["rms", "median"].into_iter().enumerate() {
            let quantity = format!("{what} ({statistic}), {unit}");
            out.push(free_run(name.to_owned(), quantity, &all.map(|a| a[s])));
        }
    }
    out
}
