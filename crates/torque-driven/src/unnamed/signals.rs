//! What the recordings say that a law may depend on, part by part of every window.

use inference::robust;
use law::{Input, Law, Motion, Scales, Variable};
use sim::rollout::Grid;

use super::acting::Inputs;
use crate::channel::Channel;
use crate::fit::{Fitted, Problem};
use crate::settings::law::SETTINGS;
use crate::windows::{Cut, Segment};

const PARTS: usize = SETTINGS.operator.parts;

/// Motions of every part of every window: by recording, then by window from its beginning on.
pub(crate) struct Signals(Vec<Vec<[Motion<f64>; PARTS]>>);

impl Signals {
    /// What was measured; where a channel was not, what the simulation at `base` says.
    pub(crate) fn new(problem: &Problem<'_>, base: &Fitted) -> Self {
        let of_run = |(run, cut): (usize, &Cut)| {
            let grid = Grid::nearest(cut.period, problem.step);
            let torque = problem.drives.delivered(run, cut, problem.robot, &cut.given, grid);
            let segments = cut.segments.iter().zip(&base.response[run]);
            segments
                .flat_map(|(segment, simulated)| of_segment(problem, cut, segment, simulated, &torque, grid))
                .collect()
        };
        Self(problem.cuts.iter().enumerate().map(of_run).collect())
    }

    /// Values of a variable, of both sides where it has two.
    fn values(&self, v: Variable) -> impl Iterator<Item = f64> + '_ {
        self.0.iter().flatten().flatten().flat_map(move |m| of_sides(m, v))
    }

    /// Motions in the parts of a window of a recording.
    pub(crate) fn window(&self, run: usize, window: usize) -> &[Motion<f64>] {
        self.0.get(run).and_then(|windows| windows.get(window)).map_or(&[], |parts| parts.as_slice())
    }

    /// Mean of a variable, left and right, in every window of every recording.
    pub(crate) fn means(&self, v: Variable) -> Vec<Vec<[f64; 2]>> {
        let window = |parts: &[Motion<f64>; PARTS]| {
            [0, 1].map(|side| parts.iter().map(|m| of_sides(m, v)[side]).sum::<f64>() / PARTS as f64)
        };
        self.0.iter().map(|run| run.iter().map(window).collect()).collect()
    }

    /// Least and largest value of a variable; of angles and time, which only repeat or pass, none.
    pub(crate) fn range(&self, v: Variable) -> Option<[f64; 2]> {
        let wider = |range: Option<[f64; 2]>, x: f64| {
            let [low, high] = range.unwrap_or([x; 2]);
            Some([low.min(x), high.max(x)])
        };
        if v.is_amount() { self.values(v).filter(|x| x.is_finite()).fold(None, wider) } else { None }
    }

    /// Usual sizes, for the grammar.
    pub(crate) fn scales(&self, spots: Vec<[f64; 2]>) -> Scales {
        let usual = |v| robust::rms(self.values(v)).map(|size| (v, size));
        Scales { usual: Variable::ALL.into_iter().filter_map(usual).collect(), spots }
    }

    /// Range in which a law's variables were seen; of angles and time, which only repeat or pass, none.
    pub(crate) fn seen(&self, law: &Law) -> Vec<(Variable, [f64; 2])> {
        let range = |v: Variable| {
            let mut all: Vec<f64> = self.values(v).collect();
            all.sort_by(f64::total_cmp);
            let at = |share: f64| all.get((share * (all.len().saturating_sub(1)) as f64).round() as usize).copied();
            let [low, high] = SETTINGS.proof.seen;
            Some((v, [at(low)?, at(high)?]))
        };
        law.variables().into_iter().filter(|v| v.is_amount()).filter_map(range).collect()
    }

    /// What a law does in every window, on the measured motion.
    pub(crate) fn inputs(&self, law: &Law) -> Inputs {
        let all = |input: Input| {
            let window = |parts: &[Motion<f64>; PARTS]| {
                parts.iter().map(|m| law.act(m, &[]).get(input)).sum::<f64>() / PARTS as f64
            };
            self.0.iter().map(|run| run.iter().map(window).collect()).collect()
        };
        inputs_of(law).into_iter().map(|input| (input, all(input))).collect()
    }
}

/// Values of a variable on the left and on the right.
fn of_sides(m: &Motion<f64>, v: Variable) -> [f64; 2] {
    match v {
        Variable::WheelSpeed => m.wheel_speed,
        Variable::Torque => m.torque,
        Variable::Power => [m.torque[0] * m.wheel_speed[0], m.torque[1] * m.wheel_speed[1]],
        Variable::Slip => m.slip,
        Variable::Velocity => [m.velocity[0]; 2],
        Variable::LateralVelocity => [m.velocity[1]; 2],
        Variable::YawRate => [m.yaw_rate; 2],
        Variable::WheelAngle => m.wheel_angle,
        Variable::Heading => [m.heading[1].atan2(m.heading[0]); 2],
        Variable::Time => [m.time; 2],
    }
}

/// Inputs that a law acts on.
fn inputs_of(law: &Law) -> Vec<Input> {
    let touched = |input: &Input| law.terms().iter().any(|t| t.place().acts_on(*input));
    Input::ALL.into_iter().filter(touched).collect()
}

/// Parts of the windows of a segment.
fn of_segment(
    problem: &Problem<'_>,
    cut: &Cut,
    segment: &Segment,
    simulated: &[crate::channel::Channels<f64>],
    torque: &[[f64; 2]],
    grid: Grid,
) -> Vec<[Motion<f64>; PARTS]> {
    let length = cut.rows_per_window as f64 * cut.period;
    let shown = |w: usize, c: Channel| if segment.valid[w][c] { segment.observed[w][c] } else { simulated[w][c] };
    // Between the middles of windows a channel changes linearly.
    let at = |c: Channel, w: usize, share: f64| {
        let (own, from) = (shown(w, c), share - 0.5);
        let other = if from < 0.0 { w.checked_sub(1) } else { Some(w + 1).filter(|n| *n < segment.windows) };
        other.map_or(own, |o| own + (shown(o, c) - own) * from.abs())
    };
    let mut angle = segment.start.wheel_angle;
    let first = segment.row / cut.rows_per_window;
    (0..segment.windows)
        .map(|w| {
            std::array::from_fn(|k| {
                let share = (k as f64 + 0.5) / PARTS as f64;
                let wheel_speed = Channel::WHEELS.map(|c| at(c, w, share));
                let half = 0.5 * length / PARTS as f64;
                let wheel_angle = std::array::from_fn(|j| angle[j] + half * wheel_speed[j]);
                for j in 0..2 {
                    angle[j] += 2.0 * half * wheel_speed[j];
                }
                let row = segment.row as f64 + (w as f64 + share) * cut.rows_per_window as f64;
                let step = (row * grid.substeps as f64) as usize;
                let ends = [first + w, first + w + 1].map(|i| cut.path.get(i).copied().unwrap_or_default());
                let on_path = |i: usize| ends[0][i] * (1.0 - share) + ends[1][i] * share;
                let (sin, cos) = on_path(2).sin_cos();
                let (v, yaw_rate) = (at(Channel::ForwardVelocity, w, share), at(Channel::YawRate, w, share));
                let (rim, turning) = (problem.robot.wheel_radius, yaw_rate * problem.robot.half_track);
                Motion {
                    time: cut.time(row),
                    position: [on_path(0), on_path(1)],
                    heading: [cos, sin],
                    velocity: [v, at(Channel::LateralVelocity, w, share)],
                    yaw_rate,
                    wheel_speed,
                    wheel_angle,
                    torque: torque.get(step).copied().unwrap_or_default(),
                    slip: [rim * wheel_speed[0] - v + turning, rim * wheel_speed[1] - v - turning],
                }
            })
        })
        .collect()
}
