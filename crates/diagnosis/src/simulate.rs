//! Free runs of the plant over the segments of recordings, eight segments side by side.

use std::array::from_fn;

use pulp::NullaryFnOnce;
use rayon::prelude::*;
use robot_model::presence::{Disc, Presence};
use robot_model::{Active, Effect, Lanes, Plant, Robot, Scalar, State, effects};

use crate::drives::Torques;
use crate::windows::{CHANNELS, Cut, PARTS, Segment};

/// Segments that are simulated side by side.
const WIDTH: usize = 8;
type Wide = Lanes<WIDTH>;

/// An effect at values, present somewhere.
#[derive(Clone)]
pub(crate) struct Dose {
    pub(crate) effect: &'static dyn Effect<f64>,
    pub(crate) values: Vec<f64>,
    pub(crate) presence: Presence<f64>,
}

impl Dose {
    pub(crate) fn active(&self) -> Active<f64> {
        Active::new(self.effect, &self.values, self.presence)
    }
}

/// A recording's robot with what it lacks.
pub(crate) struct Body {
    pub(crate) robot: Robot<f64>,
    pub(crate) doses: Vec<Dose>,
    /// What its drives deliver.
    pub(crate) torque: Torques,
}

/// Predicted windows of every recording and segment, in the layout of [`Segment::observed`].
pub(crate) type Response = Vec<Vec<Vec<f64>>>;

/// Runs each recording's body freely over every segment.
///
/// Motor lag, delay and torque history run on across restarts. With `part` given, the last dose is present only
/// during that part of each segment. `step` is the integration step, s.
pub(crate) fn free_run(cuts: &[Cut], bodies: &[Body], part: Option<usize>, step: f64) -> Response {
    let grids: Vec<Grid> = cuts.iter().map(|c| Grid::new(c, step)).collect();
    let stretches: Vec<Stretch<'_>> = (0..cuts.len())
        .flat_map(|r| {
            let (cut, body, torque, grid) = (&cuts[r], &bodies[r], &bodies[r].torque, grids[r]);
            cut.segments.iter().map(move |segment| Stretch { cut, body, segment, torque, grid })
        })
        .collect();
    let groups: Vec<&[Stretch<'_>]> = stretches
        .chunk_by(|a, b| a.grid == b.grid && a.segment.windows == b.segment.windows)
        .flat_map(|alike| alike.chunks(WIDTH))
        .collect();
    let flat: Vec<Vec<Vec<f64>>> = groups.into_par_iter().map(|g| side_by_side(g, part)).collect();
    let mut flat = flat.into_iter().flatten();
    cuts.iter().map(|c| flat.by_ref().take(c.segments.len()).collect()).collect()
}

/// How a recording's rows are divided into steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    pub(crate) substeps: usize,
    pub(crate) h: f64,
    rows_per_window: usize,
}

impl Grid {
    pub(crate) fn new(cut: &Cut, step: f64) -> Self {
        let substeps = (cut.period / step).round().max(1.0) as usize;
        Self { substeps, h: cut.period / substeps as f64, rows_per_window: cut.rows_per_window }
    }

    fn steps_per_window(&self) -> usize {
        self.rows_per_window * self.substeps
    }
}

/// One segment to be run freely.
#[derive(Clone, Copy)]
struct Stretch<'a> {
    cut: &'a Cut,
    body: &'a Body,
    segment: &'a Segment,
    torque: &'a [[f64; 2]],
    grid: Grid,
}

impl Stretch<'_> {
    fn start_time(&self) -> f64 {
        self.cut.time(self.segment.row as f64)
    }

    /// When a dose is present: as it says, and only during `part`.
    fn times(&self, dose: &Dose, part: Option<usize>) -> [f64; 2] {
        let Some(q) = part else { return [dose.presence.from, dose.presence.until] };
        let length = (self.segment.windows * self.cut.rows_per_window) as f64 * self.cut.period;
        let border = |q: usize| self.start_time() + length * q as f64 / PARTS as f64 - 1e-6;
        [border(q), border(q + 1)]
    }
}

/// The dose that each stretch holds at the same place of its list, side by side.
fn wide_dose(stretches: &[Stretch<'_>; WIDTH], d: usize, part: Option<usize>) -> Option<Active<Wide>> {
    let doses: [&Dose; WIDTH] = from_fn(|i| &stretches[i].body.doses[d]);
    let first = doses[0];
    let id = first.effect.spec().id;
    let effect = effects::catalogue::<Wide>().into_iter().find(|e| e.spec().id == id)?;
    let values: Vec<Wide> = (0..first.values.len()).map(|v| Lanes(doses.map(|d| d.values[v]))).collect();
    let times: [[f64; 2]; WIDTH] = from_fn(|i| stretches[i].times(doses[i], part));
    let disc = first.presence.disc.map(|same| {
        let of = |read: fn(&Disc<f64>) -> f64| Lanes(doses.map(|d| read(d.presence.disc.as_ref().unwrap_or(&same))));
        Disc { centre: [of(|d| d.centre[0]), of(|d| d.centre[1])], radius: of(|d| d.radius) }
    });
    let presence = Presence {
        from: Lanes(times.map(|t| t[0])),
        until: Lanes(times.map(|t| t[1])),
        disc,
        side: first.presence.side,
    };
    Some(Active::new(effect, &values, presence))
}

/// Runs up to eight stretches of one shape; the last one fills what is left over.
fn side_by_side(group: &[Stretch<'_>], part: Option<usize>) -> Vec<Vec<f64>> {
    let stretches: [Stretch<'_>; WIDTH] = from_fn(|i| group[i.min(group.len() - 1)]);
    let robot = Robot::assemble(|constant| Lanes(stretches.map(|s| constant(&s.body.robot))));
    let count = stretches[0].body.doses.len();
    let active: Vec<Active<Wide>> =
        (0..count).filter_map(|d| wide_dose(&stretches, d, part.filter(|_| d + 1 == count))).collect();
    let plant = Plant::new(&robot, &active, Lanes::real(stretches[0].grid.h));
    let mut out = vec![vec![0.0; stretches[0].segment.windows * CHANNELS]; group.len()];
    pulp::Arch::new().dispatch(Drive { plant: &plant, stretches: &stretches, out: &mut out });
    out
}

/// The free run itself, compiled for every vector unit that the machine may have.
struct Drive<'a, 'b> {
    plant: &'a Plant<'b, Wide>,
    stretches: &'a [Stretch<'a>; WIDTH],
    out: &'a mut [Vec<f64>],
}

impl Drive<'_, '_> {
    fn start(&self) -> State<Wide> {
        let of = |read: fn(&Segment) -> f64| Lanes(self.stretches.map(|s| read(s.segment)));
        let wheel_speed = [of(|s| s.start.wheel_speed[0]), of(|s| s.start.wheel_speed[1])];
        let mut state = State {
            time: Lanes(from_fn(|i| self.stretches[i].start_time())),
            position: [of(|s| s.start.position[0]), of(|s| s.start.position[1])],
            heading: [of(|s| s.start.yaw.cos()), of(|s| s.start.yaw.sin())],
            yaw_rate: of(|s| s.start.yaw_rate),
            wheel_speed,
            front_speed: wheel_speed,
            wheel_angle: [of(|s| s.start.wheel_angle[0]), of(|s| s.start.wheel_angle[1])],
            ..State::default()
        };
        self.plant.set_velocity(&mut state, [of(|s| s.start.velocity[0]), of(|s| s.start.velocity[1])]);
        state
    }
}

impl NullaryFnOnce for Drive<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let grid = self.stretches[0].grid;
        let steps = grid.steps_per_window();
        let share = 1.0 / steps as f64;
        let mut s = self.start();
        let first = self.stretches.map(|s| s.segment.row * grid.substeps);
        for w in 0..self.stretches[0].segment.windows {
            let mut sum = [Wide::zero(); CHANNELS];
            for k in w * steps..(w + 1) * steps {
                let mut torque = [Wide::zero(); 2];
                for i in 0..WIDTH {
                    let [left, right] = self.stretches[i].torque[first[i] + k];
                    torque[0].0[i] = left;
                    torque[1].0[i] = right;
                }
                self.plant.step_under(&mut s, torque);
                let mut r = self.plant.readings(&s);
                self.plant.sense(&mut r);
                let shown =
                    [r.wheel_speed[0], r.wheel_speed[1], r.gyro, r.velocity[0], r.velocity[1], r.accel[0], r.accel[1]];
                for (sum, v) in sum.iter_mut().zip(shown) {
                    *sum += v;
                }
            }
            for (i, y) in self.out.iter_mut().enumerate() {
                for (y, sum) in y[w * CHANNELS..(w + 1) * CHANNELS].iter_mut().zip(&sum) {
                    *y = sum.0[i] * share;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drives::Drives;
    use crate::testing::{cutting, driven, robot};
    use crate::windows::cut;

    #[test]
    fn a_free_run_reproduces_a_drive_of_the_plant_itself() {
        let robot = robot();
        let cut = cut(&driven(&robot, &[], 20.0), &cutting());
        let torque = Drives::default().delivered(0, &cut, &robot, &[], &Grid::new(&cut, 1e-3));
        let bodies = [Body { robot, doses: Vec::new(), torque }];
        let free = free_run(std::slice::from_ref(&cut), &bodies, None, 1e-3).remove(0);
        let (mut sum, mut size, mut n) = ([0.0; CHANNELS], [0.0; CHANNELS], 0.0);
        for (segment, free) in cut.segments.iter().zip(&free) {
            for (i, (o, p)) in segment.observed.iter().zip(free).enumerate() {
                assert!(segment.valid[i] || (segment.row == 0 && i % CHANNELS >= 5));
                sum[i % CHANNELS] += (o - p).powi(2);
                size[i % CHANNELS] += o * o;
                n += 1.0 / CHANNELS as f64;
            }
        }
        // rad/s, rad/s, rad/s, m/s, m/s, m/s², m/s²: a tenth of typical residuals of a real drive.
        let most = [0.03, 0.03, 0.01, 0.01, 0.01, 0.05, 0.05];
        for c in 0..CHANNELS {
            let rms = f64::sqrt(sum[c] / n);
            assert!(rms < most[c], "channel {c}: rms {rms}");
            assert!(f64::sqrt(size[c] / n) > most[c], "channel {c} is not driven");
        }
    }
}
