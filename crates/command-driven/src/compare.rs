//! Forecasts of left-out windows from the commands alone, by four simulations.

use crate::controller::Law;
use crate::drive::DrivePart;
use crate::ground::{GroundPart, Poses, misses};
use crate::identify::{Identified, Simulated};
use crate::run::WINDOW;
use crate::search::{Model, Trial, attempt};
use crate::settings::SETTINGS;
use crate::windows::{FOLDS, Windows};
use inference::robust::{median, rms};
use verdict::{Element, FreeRun, Scaling};

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
    ground: Trial<()>,
}

/// As it is, re-tuned, corrected, placebo.
pub(crate) struct Comparison {
    pub(crate) all: [Simulation; 4],
    /// Free constants of the corrected and of the placebo.
    pub(crate) constants: [usize; 2],
    nominal: [f64; 2],
    largest: f64,
}

/// Wrong causes in the order in which they are given constants: what each side alone could do (friction, a torque limit).
const WRONG_DRIVE: [Element; 4] = [Element::WheelLimit, Element::Lag, Element::Ramp, Element::DeadTime];
const WRONG_GROUND: [Element; 6] =
    [Element::Radius, Element::SideRadius, Element::Offset, Element::TurnSlip, Element::BodyLag, Element::Track];

impl Comparison {
    pub(crate) fn new(windows: &Windows, base: &Simulated, found: &Identified, nominal: [f64; 2]) -> Self {
        let part = DrivePart::new(windows, 0);
        let measured = GroundPart::measured(windows, nominal);
        let as_told = attempt(&part, &base.drive, base.drive.law, &[], None);
        let plain = attempt(&measured, &base.ground, (), &[], None);
        let has_position = windows.pieces.iter().any(|p| p.position.is_some());
        let tunables: &[Element] = if has_position { &[Element::Radius, Element::Track] } else { &[Element::Track] };
        let as_commanded = GroundPart::new(windows, part.wheels(base.drive.law, &base.drive.x), nominal);
        let retuned = attempt(&as_commanded, &base.ground, (), tunables, None);
        let placebo = placebo(windows, base, found, nominal);
        let count = |d: &Trial<Law>, g: &Trial<()>| d.free.len() + g.free.len();
        let constants = [count(&found.drive, &found.ground), count(&placebo.drive, &placebo.ground)];
        let simulation = |drive: &Trial<Law>, ground: &Trial<()>| Simulation {
            drive: drive.clone(),
            powers: 0,
            ground: ground.clone(),
        };
        let all = [
            simulation(&as_told, &plain),
            simulation(&as_told, &retuned),
            simulation(&found.drive, &found.ground),
            placebo,
        ];
        Self { all, constants, nominal, largest: part.largest }
    }

    /// Errors on windows of the fit, each by a fit without its fold.
    pub(crate) fn left_out(&self, windows: &Windows) -> [Errors; 4] {
        std::array::from_fn(|k| {
            let s = &self.all[k];
            let folds: Vec<Errors> =
                (0..FOLDS).map(|f| self.errors(windows, s.powers, &s.drive.folds[f], &s.ground.folds[f])).collect();
            std::array::from_fn(|q| (0..windows.list.len()).map(|w| folds[windows.fold(w)][q][w]).collect())
        })
    }

    /// Wheel speeds of every piece and poses of every window by simulation `k`, each by a fit without its fold.
    pub(crate) fn simulated_left_out(&self, windows: &Windows, k: usize) -> (Vec<Vec<[f64; 2]>>, Vec<Poses>) {
        let s = &self.all[k];
        let folds: Vec<_> =
            (0..FOLDS).map(|f| self.simulated(windows, s.powers, &s.drive.folds[f], &s.ground.folds[f])).collect();
        let mut wheels = folds[0].0.clone();
        let mut poses = Vec::with_capacity(windows.list.len());
        for (w, window) in windows.list.iter().enumerate() {
            let (of_fold, own_poses) = &folds[windows.fold(w)];
            let rows = window.start..window.start + WINDOW;
            wheels[window.piece][rows.clone()].copy_from_slice(&of_fold[window.piece][rows]);
            poses.push(own_poses[w].clone());
        }
        (wheels, poses)
    }

    /// Errors on windows that no fit has seen.
    pub(crate) fn unseen(&self, windows: &Windows) -> [Errors; 4] {
        std::array::from_fn(|k| {
            let s = &self.all[k];
            self.errors(windows, s.powers, &s.drive.model, &s.ground.model)
        })
    }

    /// Errors when only the drive is corrected.
    pub(crate) fn drive_only(&self, windows: &Windows, held_out: bool) -> Errors {
        let (s, plain) = (&self.all[2], &self.all[0].ground.model);
        if held_out {
            return self.errors(windows, 0, &s.drive.model, plain);
        }
        let folds: Vec<Errors> = (0..FOLDS).map(|f| self.errors(windows, 0, &s.drive.folds[f], plain)).collect();
        std::array::from_fn(|q| (0..windows.list.len()).map(|w| folds[windows.fold(w)][q][w]).collect())
    }

    fn errors(&self, windows: &Windows, powers: usize, drive: &Model<Law>, ground: &Model<()>) -> Errors {
        let (wheels, poses) = self.simulated(windows, powers, drive, ground);
        errors(windows, &wheels, &poses)
    }

    /// Wheel speeds of every piece and poses of every window.
    fn simulated(
        &self,
        windows: &Windows,
        powers: usize,
        drive: &Model<Law>,
        ground: &Model<()>,
    ) -> (Vec<Vec<[f64; 2]>>, Vec<Poses>) {
        let mut part = DrivePart::new(windows, powers);
        part.largest = self.largest;
        let wheels = part.wheels(drive.law, &drive.x);
        let poses = GroundPart::new(windows, wheels.clone(), self.nominal).poses(&ground.x);
        (wheels, poses)
    }
}

/// Errors of every window.
pub(crate) fn errors(windows: &Windows, wheels: &[Vec<[f64; 2]>], poses: &[Poses]) -> Errors {
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
fn placebo(windows: &Windows, base: &Simulated, found: &Identified, nominal: [f64; 2]) -> Simulation {
    let named = &found.drive.elements;
    let count = found.drive.free.len();
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
    let ground = attempt(&GroundPart::new(windows, wheels, nominal), &base.ground, (), &wrong, None);
    Simulation { drive, powers, ground }
}

/// Root mean square and median.
pub(crate) fn summary(errors: &[f64]) -> [f64; 2] {
    let all = || errors.iter().copied();
    [rms(all()).unwrap_or(0.0), median(all()).unwrap_or(0.0)]
}

/// Rows of the answer: rms and median over windows of 2 s of every quantity that was recorded.
pub(crate) fn free_runs(name: &str, four: &[Errors; 4], has_position: bool) -> Vec<FreeRun> {
    let mut out = Vec::new();
    for (q, (what, unit)) in QUANTITIES.iter().enumerate() {
        if what.starts_with("position") && !has_position {
            continue;
        }
        let all: [[f64; 2]; 4] = std::array::from_fn(|k| summary(&four[k][q]));
        for (s, statistic) in ["rms", "median"].into_iter().enumerate() {
            out.push(FreeRun {
                recording: name.to_owned(),
                quantity: format!("{what} ({statistic}), {unit}"),
                nominal: all[0][s],
                retuned: all[1][s],
                corrected: all[2][s],
                placebo: Some(all[3][s]),
            });
        }
    }
    out
}
