//! The fit of wheel speeds to commands.

use crate::controller::{
    DAMPING, DEAD_TIME, FORWARD_LIMIT, FREQUENCY, GAIN, LAG, Law, POWER, RAMP, SHAPE, SIDE_GAIN, SIDE_RAMP, TURN_LIMIT,
    WHEEL_LIMIT, body, simulate,
};
use crate::run::{STEP, WINDOW};
use crate::search::{Model, Part, Timed};
use crate::settings::{DriveStarts, SETTINGS};
use crate::windows::Windows;
use inference::robust::{MAD_TO_SIGMA, median, rms, select_quantile};
use verdict::{DRIVE_CONSTANTS, Element, ResponseConstant};

const STARTS: DriveStarts = SETTINGS.drive_starts;

/// The fit of wheel speeds to commands.
pub(crate) struct DrivePart<'a> {
    pub(crate) windows: &'a Windows,
    /// Powers of each side's own command (placebo).
    powers: usize,
    constants: Vec<ResponseConstant>,
    /// Unit of the residuals, rad/s.
    pub(crate) unit: f64,
    /// Largest command, rad/s.
    pub(crate) largest: f64,
}

impl<'a> DrivePart<'a> {
    pub(crate) fn new(windows: &'a Windows, powers: usize) -> Self {
        let commands = windows.pieces.iter().flat_map(|p| p.command.iter().flatten());
        let largest = commands.fold(0.0_f64, |m, c| m.max(c.abs())).max(1e-6);
        let constants = DRIVE_CONSTANTS.into_iter().chain(std::iter::repeat_n(POWER, powers)).collect();
        Self { windows, powers, constants, unit: (SETTINGS.residuals.wheel * windows.speed()).max(1e-6), largest }
    }

    /// "The wheels do what is commanded."
    pub(crate) fn neutral(&self) -> Vec<f64> {
        let mut x: Vec<f64> = self.constants.iter().map(|c| c.neutral).collect();
        if self.powers > 0 {
            x[SHAPE] = 1.0;
        }
        x
    }

    /// Every piece's wheel speeds.
    pub(crate) fn wheels(&self, law: Law, x: &[f64]) -> Vec<Vec<[f64; 2]>> {
        self.windows.pieces.iter().map(|p| simulate(law, x, self.largest, p)).collect()
    }
}

impl DrivePart<'_> {
    /// Whether a model leaves more than noise: another law may then be as right. The scatter of neighbouring rows tells the noise.
    pub(crate) fn is_inexact(&self, model: &Model<Law>) -> bool {
        let residuals = self.residuals(model.law, &model.x);
        let apart = 2 * SETTINGS.left.apart;
        let second = |rows: &[f64]| -> Vec<f64> {
            (apart..rows.len().saturating_sub(apart))
                .map(|i| (rows[i + apart] - 2.0 * rows[i] + rows[i - apart]).abs())
                .collect()
        };
        // White noise of σ has second differences of 6 σ².
        let noise =
            median(residuals.chunks(2 * WINDOW).flat_map(second)).map_or(0.0, |m| MAD_TO_SIGMA * m / 6f64.sqrt());
        rms(residuals.iter().copied()).is_some_and(|rms| rms > SETTINGS.answer.inexact * noise)
    }
}

impl Timed<Law> {
    /// Wheel speeds of every piece, each window by the model that held in it.
    pub(crate) fn wheels(&self, part: &DrivePart<'_>) -> Vec<Vec<[f64; 2]>> {
        let mut out = part.wheels(self.model.law, &self.model.x);
        if let Some((before, early)) = &self.early {
            let then = part.wheels(before.law, &before.x);
            for (w, _) in part.windows.list.iter().zip(early).filter(|(_, early)| **early) {
                let rows = w.start..w.start + WINDOW;
                out[w.piece][rows.clone()].copy_from_slice(&then[w.piece][rows]);
            }
        }
        out
    }
}

impl Part for DrivePart<'_> {
    type Law = Law;

    fn constants(&self) -> &[ResponseConstant] {
        &self.constants
    }

    fn windows(&self) -> &Windows {
        self.windows
    }

    fn residuals(&self, law: Law, x: &[f64]) -> Vec<f64> {
        let wheels = self.wheels(law, x);
        let mut out = Vec::with_capacity(self.windows.list.len() * WINDOW * 2);
        for w in &self.windows.list {
            for i in w.start..w.start + WINDOW {
                let measured = self.windows.pieces[w.piece].wheel[i];
                out.extend([0, 1].map(|s| (wheels[w.piece][i][s] - measured[s]) / self.unit));
            }
        }
        out
    }

    fn free(&self, law: Law, element: Element) -> Vec<usize> {
        match element {
            Element::DeadTime => vec![DEAD_TIME],
            Element::Gain if self.powers > 0 => (SHAPE..SHAPE + self.powers).collect(),
            Element::Gain => GAIN.to_vec(),
            Element::TurnLimit => vec![TURN_LIMIT],
            Element::ForwardLimit => vec![FORWARD_LIMIT],
            Element::WheelLimit => vec![WHEEL_LIMIT],
            Element::Ramp if law.side_ramps => vec![SIDE_RAMP],
            Element::Ramp => RAMP.to_vec(),
            Element::Lag if law.second_order => vec![FREQUENCY, DAMPING],
            Element::Lag => vec![LAG],
            Element::SideGain => vec![SIDE_GAIN],
            _ => vec![],
        }
    }

    fn law_error(&self, model: &Model<Law>) -> f64 {
        if self.is_inexact(model) { SETTINGS.answer.law_error } else { 0.0 }
    }

    /// What wheels reach in the end, whatever their lag is.
    fn levels(&self) -> &'static [usize] {
        const { &[GAIN[0], GAIN[1], TURN_LIMIT, FORWARD_LIMIT, WHEEL_LIMIT] }
    }

    fn settled(&self, model: &Model<Law>) -> Vec<bool> {
        let span = (SETTINGS.answer.settles / STEP).round() as usize;
        let wheels = self.wheels(model.law, &model.x);
        let mut out = Vec::with_capacity(self.windows.list.len() * WINDOW * 2);
        for w in &self.windows.list {
            for i in w.start..w.start + WINDOW {
                let [before, now] = [i.saturating_sub(span), i].map(|row| wheels[w.piece][row]);
                let changes = (0..2).map(|s| (now[s] - before[s]).abs()).fold(0.0, f64::max);
                out.extend([i >= span && changes < SETTINGS.answer.settled * self.unit; 2]);
            }
        }
        out
    }

    /// Wheels that answer at once show between which rows they do, and no more.
    fn flat_over(&self, model: &Model<Law>, constant: usize) -> Option<f64> {
        (constant == DEAD_TIME && !model.law.second_order && model.x[LAG] < STEP).then_some(STEP)
    }

    /// A command is known from the row after it on.
    fn between_rows(&self, constant: usize) -> f64 {
        if constant == DEAD_TIME { STEP } else { 0.0 }
    }

    /// A law with the parts of `base` where an element is not fitted.
    fn restrict(&self, law: Law, base: Law, elements: &[Element]) -> Law {
        let has = |e| elements.contains(&e);
        let mut out = base;
        if has(Element::WheelLimit) {
            (out.scaling, out.after_ramp) = (law.scaling, law.after_ramp);
        }
        if has(Element::Ramp) {
            out.side_ramps = law.side_ramps;
        }
        if has(Element::Lag) {
            out.second_order = law.second_order;
        }
        out
    }

    /// Limits from what the wheels reach, ramps from how fast they change, usual lags.
    fn guess(&self, constant: usize) -> f64 {
        const SPAN: usize = STARTS.change_rows;
        let quantile = |mut all: Vec<f64>, q: f64| select_quantile(&mut all, q).unwrap_or(1.0);
        let of = |f: &dyn Fn([f64; 2]) -> f64| -> Vec<f64> {
            self.windows.pieces.iter().flat_map(|p| p.wheel.iter().map(|w| f(*w).abs())).collect()
        };
        let change = |k: usize| -> Vec<f64> {
            let pieces = self.windows.pieces.iter();
            pieces
                .flat_map(|p| {
                    (SPAN..p.wheel.len()).map(move |i| (body(p.wheel[i])[k] - body(p.wheel[i - SPAN])[k]).abs())
                })
                .map(|c| c / (SPAN as f64 * STEP))
                .collect()
        };

        let reached = match constant {
            TURN_LIMIT => quantile(of(&|w| body(w)[1]), STARTS.turn_limit),
            FORWARD_LIMIT => quantile(of(&|w| body(w)[0]), STARTS.forward_limit),
            WHEEL_LIMIT => quantile(of(&|[l, r]| l.abs().max(r.abs())), STARTS.wheel_limit),
            c if c == RAMP[0] || c == SIDE_RAMP => quantile(change(0), STARTS.forward_ramp),
            c if c == RAMP[1] => quantile(change(1), STARTS.turn_ramp),
            DEAD_TIME => return STARTS.dead_time,
            LAG => return STARTS.lag,
            FREQUENCY => return STARTS.frequency,
            DAMPING => return STARTS.damping,
            _ => return self.neutral()[constant],
        };
        reached.max(STARTS.least)
    }

    fn starts(&self) -> (usize, &'static [f64]) {
        (DEAD_TIME, &STARTS.dead_times)
    }
}
