//! What a drive shows, row by row: windows of its pose against the model, and the car's reports against pose or model.

use std::ops::Range;
use std::sync::Arc;

use crate::constants::{Constant, Quantity};
use crate::drive::{Drive, Message};
use crate::model::{Inputs, Laws, STEP, State};
use crate::settings::{SETTINGS, Windows};
use hierarchical_fit::{Kind, Row};
use odometry::rates::{parabola, slope};

const RULES: Windows = SETTINGS.windows;

/// Rows of the pose in a window: place and heading in its middle and at its end.
pub(crate) const POSE_ROWS: usize = 6;

/// A stretch that the model is run over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window {
    pub(crate) from: usize,
    pub(crate) steps: usize,
}

/// A drive with its windows.
#[derive(Debug, Clone)]
pub(crate) struct Shown<'a> {
    pub(crate) drive: &'a Drive,
    pub(crate) windows: Vec<Window>,
    /// World velocities and yaw rate of the tracked point at each step, from poses about it.
    pub(crate) rates: Arc<[[f64; 3]]>,
    pub(crate) rows: Vec<Row>,
    /// What the car reported, its gyro flattened as the pose's rates are, which is compared with these.
    reported: Arc<[Message]>,
    /// The messages that are compared with the pose.
    messages: Range<usize>,
    /// Steps of which steering and drive are needed.
    span: Range<usize>,
    encoder_window: f64,
}

impl<'a> Shown<'a> {
    pub(crate) fn new(drive: &'a Drive, encoder_window: f64) -> Self {
        let half = (SETTINGS.grid.smoothing / STEP).round() as usize;
        let steps = drive.steps();
        let rate = |k: usize| {
            let inside = k >= half && k + half < steps;
            inside.then(|| slope(&drive.pose, [k - half, k + half], k, STEP)).flatten().unwrap_or([f64::NAN; 3])
        };
        let rates = (0..if drive.has_pose() { steps } else { 0 }).map(rate).collect();
        let mut out = Self {
            drive,
            windows: Vec::new(),
            rates,
            rows: Vec::new(),
            reported: if drive.has_pose() { flattened(&drive.messages) } else { Arc::from([]) },
            messages: if drive.has_pose() { 0..drive.messages.len() } else { 0..0 },
            span: 0..steps,
            encoder_window,
        };
        let (length, every) = ((RULES.length / STEP).round() as usize, (RULES.every / STEP).round() as usize);
        let mut from = half;
        while from + length + half < steps {
            let window = Window { from, steps: length };
            if out.is_usable(window) {
                out.windows.push(window);
                out.add_rows(window);
            }
            from += every;
        }
        if drive.has_pose() {
            // Their errors are those of the smoothed pose, which is one and the same within its smoothing.
            let seconds = drive.messages.last().zip(drive.messages.first()).map_or(0.0, |(b, a)| b.time - a.time);
            let period = seconds / drive.messages.len().max(1) as f64;
            let weight = (0.5 * period / SETTINGS.grid.smoothing).min(1.0);
            for message in &drive.messages {
                for (kind, there) in [(Kind::Gyro, message.gyro), (Kind::Encoder, message.encoder)] {
                    if there.is_some() {
                        let moving = out.rate_at(message.time).is_some_and(|r| r[0].hypot(r[1]) > RULES.moving);
                        let time = message.time + SETTINGS.grid.smoothing;
                        out.rows.push(Row { kind, time, is_moving: moving, weight });
                    }
                }
            }
        }
        out
    }

    /// What becomes known of a drive with a pose after one instant and until another, s, by a model that has run so long before.
    pub(crate) fn part(&self, after: f64, until: f64, warm: f64) -> Self {
        let is_in = |time: f64| time > after && time <= until;
        let end = |w: &Window| STEP * (w.from + w.steps) as f64;
        let windows: Vec<Window> = self.windows.iter().copied().filter(|w| is_in(end(w))).collect();
        let messages = self.first_unknown(after)..self.first_unknown(until);
        let (first, last) = (windows.first().map_or(0, |w| w.from), windows.last().map_or(0, |w| w.from + w.steps));
        let span = first.saturating_sub((warm / STEP) as usize)..last + 1;
        let rows = self.rows.iter().copied().filter(|r| is_in(r.time)).collect();
        Self {
            drive: self.drive,
            windows,
            rates: Arc::clone(&self.rates),
            rows,
            reported: Arc::clone(&self.reported),
            messages,
            span,
            encoder_window: self.encoder_window,
        }
    }

    /// The first message that cannot be compared with the pose yet, because poses after it are not there.
    fn first_unknown(&self, now: f64) -> usize {
        self.drive.messages.partition_point(|m| m.time + SETTINGS.grid.smoothing <= now)
    }

    fn is_usable(&self, window: Window) -> bool {
        if self.drive.has_pose() {
            let Window { from, steps } = window;
            let seen = |k: usize| self.drive.pose[k].iter().all(|x| x.is_finite());
            return self.rates[from][0].is_finite() && seen(from) && seen(from + steps / 2) && seen(from + steps);
        }
        self.report_at(STEP * window.from as f64).is_some() && self.reports(window).next().is_some()
    }

    fn reports(&self, window: Window) -> impl Iterator<Item = &'a Message> + use<'a> {
        let (from, until) = (STEP * window.from as f64, STEP * (window.from + window.steps) as f64);
        self.drive.messages.iter().filter(move |m| m.time > from && m.time <= until)
    }

    fn add_rows(&mut self, window: Window) {
        let time = STEP * (window.from + window.steps) as f64;
        let weight = RULES.every / RULES.length;
        if self.drive.has_pose() {
            let (a, b) = (self.drive.pose[window.from], self.drive.pose[window.from + window.steps]);
            let is_moving = (b[0] - a[0]).hypot(b[1] - a[1]) > RULES.moving;
            let weight = RULES.shared * weight;
            self.rows.extend([Row { kind: Kind::Pose, time, is_moving, weight }; POSE_ROWS]);
            return;
        }
        let reports: Vec<&Message> = self.reports(window).collect();
        for message in reports {
            for (kind, there) in [(Kind::Gyro, message.gyro), (Kind::Encoder, message.encoder)] {
                let is_moving = message.encoder.is_some_and(|e| e.abs() > RULES.moving);
                if there.is_some() {
                    self.rows.push(Row { kind, time, is_moving, weight });
                }
            }
        }
    }

    /// Rates of the tracked point at an instant.
    fn rate_at(&self, time: f64) -> Option<[f64; 3]> {
        let place = time / STEP;
        if place < 0.0 || place as usize + 1 >= self.rates.len() {
            return None;
        }
        let k = place as usize;
        let share = place - k as f64;
        let out = [0, 1, 2].map(|axis| self.rates[k][axis] + share * (self.rates[k + 1][axis] - self.rates[k][axis]));
        out[0].is_finite().then_some(out)
    }

    /// Encoder speed and yaw rate as reported about an instant: means of the messages next to it.
    fn report_at(&self, time: f64) -> Option<[f64; 2]> {
        let after = self.drive.messages.partition_point(|m| m.time < time);
        let near = self.drive.messages.get(after.saturating_sub(1)..(after + 1).min(self.drive.messages.len()))?;
        let count = near.len() as f64;
        let encoder: Option<f64> = near.iter().map(|m| m.encoder).sum();
        let gyro: Option<f64> = near.iter().map(|m| m.gyro).sum();
        Some([encoder? / count, gyro? / count]).filter(|_| count > 0.0)
    }

    /// The state at the beginning of a window.
    fn start(&self, laws: &Laws, inputs: &Inputs, from: usize) -> State {
        if self.drive.has_pose() {
            let mut out = laws.state(self.drive.pose[from], self.rates[from]);
            out.speed -= smoothed_too_fast(laws, inputs, from, out.speed);
            return out;
        }
        let [encoder, gyro] = self.report_at(STEP * from as f64 + laws.clock).unwrap_or_default();
        let rate = (gyro - laws.gyro_bias) / laws.gyro_scale;
        State { place: [0.0; 2], yaw: 0.0, speed: laws.speed_of_encoder(encoder, rate), side: laws.rear * rate, rate }
    }

    /// Errors of all rows, in the unit of their kinds: model minus measurement; 0 where there is none.
    pub(crate) fn errors_of(&self, laws: &Laws) -> Vec<f64> {
        // Nobody knows where a car without a pose heads on a slope.
        let laws = &if self.drive.has_pose() { *laws } else { Laws { slope: [0.0; 2], ..*laws } };
        let inputs = laws.inputs_between(self.drive, self.span.start, self.span.end);
        let mut out = Vec::with_capacity(self.rows.len());
        for &window in &self.windows {
            let states = laws.run(self.start(laws, &inputs, window.from), &inputs, window.from, window.steps);
            if self.drive.has_pose() {
                for steps in [window.steps / 2, window.steps] {
                    out.extend(pose_error(laws.tracked(&states[steps - 1]), self.drive.pose[window.from + steps]));
                }
            } else {
                for message in self.reports(window) {
                    let at = |delay: f64| {
                        let place = (message.time - laws.clock - delay) / STEP - window.from as f64 - 1.0;
                        between(&states, place)
                    };
                    if let Some(gyro) = message.gyro {
                        out.push(laws.gyro_scale * at(laws.gyro_delay)[1] + laws.gyro_bias - gyro);
                    }
                    if let Some(encoder) = message.encoder {
                        let delay = laws.encoder_delay + 0.5 * self.encoder_window;
                        let [speed, rate] = at(delay);
                        out.push(laws.encoder(speed, rate) - encoder);
                    }
                }
            }
        }
        for message in &self.reported[self.messages.clone()] {
            let at = |delay: f64| self.rate_at(message.time - laws.clock - delay);
            if let Some(gyro) = message.gyro {
                out.push(at(laws.gyro_delay).map_or(0.0, |r| laws.gyro_scale * r[2] + laws.gyro_bias - gyro));
            }
            if let Some(encoder) = message.encoder {
                let delay = laws.encoder_delay + 0.5 * self.encoder_window;
                let speed = |r: [f64; 3]| {
                    let k = (((message.time - laws.clock - delay) / STEP) as usize).min(self.drive.pose.len() - 1);
                    laws.encoder(laws.state(self.drive.pose[k], r).speed, r[2]) - encoder
                };
                out.push(at(delay).map_or(0.0, speed));
            }
        }
        // A law that runs away is as wrong as can be, and still a number.
        let ceiling = RULES.ceiling;
        for e in &mut out {
            *e = if e.is_nan() { ceiling } else { e.clamp(-ceiling, ceiling) };
        }
        out
    }

    /// What gyro and encoder show, in the order of their rows.
    pub(crate) fn shown_by_sensors(&self) -> impl Iterator<Item = f64> {
        self.reported[self.messages.clone()].iter().flat_map(|m| [m.gyro, m.encoder]).flatten()
    }

    /// Changes of the errors with each constant, by central differences.
    pub(crate) fn columns_of(&self, constants: &[Constant], theta: &[f64]) -> Vec<Vec<f64>> {
        let of = |k: usize| {
            let is_rate = constants[k].quantity == Quantity::Slowness;
            let difference = if is_rate { RULES.difference_of_rate } else { RULES.difference };
            let step = difference * constants[k].usual;
            let at = |sign: f64| {
                let mut moved = theta.to_vec();
                moved[k] += sign * step;
                self.errors_of(&Laws::at(constants, &moved))
            };
            let (below, above) = (at(-1.0), at(1.0));
            above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * step)).collect()
        };
        (0..theta.len()).map(of).collect()
    }
}

/// Messages with what smoothing takes from quick turns taken from the gyro, `g − S g + S S g`: the rates of the pose are flattened so, and
/// alone would make the gyro read too much.
fn flattened(messages: &[Message]) -> Arc<[Message]> {
    let once = smoothed(messages);
    let twice = smoothed(&once);
    let taken = |(at, (once, twice)): (&Message, (&Message, &Message))| {
        let gyro = at.gyro.zip(once.gyro.zip(twice.gyro)).map(|(gyro, (once, twice))| gyro - once + twice);
        Message { gyro, ..*at }
    };
    messages.iter().zip(once.iter().zip(&twice)).map(taken).collect()
}

/// Messages with the gyro as its mean over those about each, by the weights with which a parabola through a way takes its rates:
/// `1 − (Δt/h)²`.
fn smoothed(messages: &[Message]) -> Vec<Message> {
    let half = SETTINGS.grid.smoothing + 0.5 * STEP;
    let about = |at: &Message| {
        let first = messages.partition_point(|m| m.time <= at.time - half);
        let last = messages.partition_point(|m| m.time < at.time + half);
        let weight = |m: &Message| 1.0 - ((m.time - at.time) / half).powi(2);
        let weighed = messages[first..last].iter().filter_map(|m| Some((weight(m), m.gyro?)));
        let (count, sum, weights) =
            weighed.fold((0, 0.0, 0.0), |(n, sum, weights), (w, value)| (n + 1, sum + w * value, weights + w));
        // What is reported too rarely is compared as it is.
        let gyro = if count < RULES.smoothed { at.gyro } else { at.gyro.map(|_| sum / weights) };
        Message { gyro, ..*at }
    };
    messages.iter().map(about).collect()
}

/// By how much the parabola about a step shows another speed than that of the step where the push changes about it, m/s: the
/// same parabola through the way of the model. Without this every change of the throttle seems to come late.
fn smoothed_too_fast(laws: &Laws, inputs: &Inputs, from: usize, speed: f64) -> f64 {
    let half = (SETTINGS.grid.smoothing / STEP).round() as usize;
    let Some(efforts) = from.checked_sub(half).and_then(|first| inputs.throttle.get(first..from + half)) else {
        return 0.0;
    };
    // Speed and way of a straight drive with these pushes; only how they change matters.
    let (mut v, mut way, mut at) = (speed, 0.0, speed);
    let mut ways = Vec::with_capacity(2 * half + 1);
    ways.push(way);
    for (k, effort) in efforts.iter().enumerate() {
        if k == half {
            at = v;
        }
        let next = laws.speed_after(v, *effort, 0.0);
        way += 0.5 * STEP * (v + next);
        v = next;
        ways.push(way);
    }
    parabola(ways.into_iter(), Some(half), STEP) - at
}

/// Error of a pose in m: ahead and to the side of the measured one, and heading by its lever.
fn pose_error(model: [f64; 3], measured: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = measured[2].sin_cos();
    let d = [model[0] - measured[0], model[1] - measured[1]];
    [d[0] * cos + d[1] * sin, d[1] * cos - d[0] * sin, RULES.lever * (model[2] - measured[2])]
}

/// Speed and yaw rate between states of steps.
fn between(states: &[State], place: f64) -> [f64; 2] {
    let place = place.clamp(0.0, (states.len() - 1) as f64);
    let k = (place as usize).min(states.len().saturating_sub(2));
    let share = place - k as f64;
    let (a, b) = (&states[k], &states[(k + 1).min(states.len() - 1)]);
    [a.speed + share * (b.speed - a.speed), a.rate + share * (b.rate - a.rate)]
}

impl Shown<'_> {
    /// What a car that keeps still would err by: ways of windows of the pose, or speeds.
    pub(crate) fn ways(&self) -> Vec<f64> {
        let pose = &self.drive.pose;
        let of = |w: &Window| {
            if !self.drive.has_pose() {
                return self.reports(*w).filter_map(|m| m.encoder).filter(|e| e.abs() > RULES.moving).collect();
            }
            let way = |steps: usize| {
                let (a, b) = (pose[w.from], pose[w.from + steps]);
                [b[0] - a[0], b[1] - a[1], RULES.lever * (b[2] - a[2])]
            };
            let moved = way(w.steps);
            if moved[0].hypot(moved[1]) > RULES.moving { [way(w.steps / 2), moved].concat() } else { Vec::new() }
        };
        self.windows.iter().flat_map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::car::Car;
    use crate::constant_table::constants;
    use crate::drive::Columns;

    fn laws() -> Laws {
        let all = constants(&Car::new("drawn", 0.25));
        Laws::at(&all, &vec![0.0; all.len()])
    }

    #[test]
    fn a_step_of_the_throttle_is_not_anticipated_by_smoothing() {
        let laws = laws();
        let inputs =
            Inputs { steering: vec![0.0; 100], throttle: (0..100).map(|k| if k < 50 { 0.1 } else { 0.5 }).collect() };
        let start = State { place: [0.0; 2], yaw: 0.0, speed: 1.0, side: 0.0, rate: 0.0 };
        let states = laws.run(start, &inputs, 0, 100);
        // State k is that after k steps.
        let pose: Vec<[f64; 3]> = std::iter::once(&start).chain(&states).map(|s| laws.tracked(s)).collect();
        let half = (SETTINGS.grid.smoothing / STEP).round() as usize;
        for k in 45..=55 {
            let rates = slope(&pose, [k - half, k + half], k, STEP).expect("a slope");
            let (shown, truth) = (rates[0].hypot(rates[1]), states[k - 1].speed);
            let corrected = shown - smoothed_too_fast(&laws, &inputs, k, shown);
            assert!((corrected - truth).abs() < 2e-3, "step {k}: {corrected} for {truth}");
            assert!(k != 50 || shown - truth > 0.03, "there is nothing to correct: {shown} for {truth}");
        }
    }

    #[test]
    fn messages_within_one_smoothing_count_once() {
        let rows: Vec<f64> = (0..1000).map(f64::from).collect();
        let table = Columns {
            time: rows.iter().map(|k| 0.005 * k).collect(),
            pose: rows.iter().map(|k| [0.005 * k, 0.0, 0.0]).collect(),
            throttle: vec![0.2; 1000],
            steering: vec![0.0; 1000],
            gyro: vec![0.0; 1000],
            ..Columns::default()
        };
        let drive = Drive::new("drawn", &table).expect("a drive");
        let shown = Shown::new(&drive, 0.0);
        let weight: f64 = shown.rows.iter().filter(|r| r.kind == Kind::Gyro).map(|r| r.weight).sum();
        let once = 5.0 / (2.0 * SETTINGS.grid.smoothing);
        assert!((weight - once).abs() < 0.02 * once, "{weight} for {once}");
    }
}
