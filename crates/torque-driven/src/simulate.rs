//! Free runs of the plant over the segments of recordings, eight segments side by side.

use std::array::from_fn;
use std::convert::Infallible;

use inference::hypothesis::Dose;
use law::OwnEffect;
use rayon::prelude::*;
use robot_model::presence::Presence;
use robot_model::{Active, Disturbance, Lanes, Plant, Robot, Scalar, State};
use sim::rollout::{Delivered, Grid, Rollout, Visitor, lanes};

use crate::channel::{Channel, Channels};
use crate::drives::Torques;
use crate::unnamed::{Acting, InRecording};
use crate::windows::{Cut, PARTS, Segment};

/// Segments that are simulated side by side.
pub(crate) const WIDTH: usize = 8;
pub(crate) type Wide = Lanes<WIDTH>;

/// A recording's robot with what it lacks.
pub(crate) struct Body {
    pub(crate) robot: Robot<f64>,
    pub(crate) doses: Vec<Dose>,
    /// What acts beside the catalogue's effects, if anything does.
    pub(crate) acting: Option<Acting>,
    /// What its drives deliver.
    pub(crate) torque: Torques,
}

/// Predicted windows of every recording and segment, in the layout of [`Segment::observed`].
pub(crate) type Response = Vec<RunResponse>;

/// Predicted windows of one recording, segment by segment.
pub(crate) type RunResponse = Vec<Vec<Channels<f64>>>;

/// Runs each recording's body freely over every segment.
///
/// Motor lag, delay and torque history run on across restarts. With `part` given, the last dose is present only
/// during that part of each segment. `step` is the integration step, s.
///
/// `first` is the place of the first of these recordings among all.
pub(crate) fn free_run(cuts: &[Cut], bodies: &[Body], first: usize, part: Option<usize>, step: f64) -> Response {
    let grids: Vec<Grid> = cuts.iter().map(|c| Grid::nearest(c.period, step)).collect();
    let stretches: Vec<Stretch<'_>> = (0..cuts.len())
        .flat_map(|r| {
            let (cut, body, torque, grid) = (&cuts[r], &bodies[r], &bodies[r].torque, grids[r]);
            cut.segments.iter().map(move |segment| Stretch { run: first + r, cut, body, segment, torque, grid })
        })
        .collect();
    let groups: Vec<&[Stretch<'_>]> =
        stretches.chunk_by(|a, b| a.shape() == b.shape()).flat_map(|alike| alike.chunks(WIDTH)).collect();
    let flat: Vec<RunResponse> = groups.into_par_iter().map(|g| side_by_side(g, part)).collect();
    let mut flat = flat.into_iter().flatten();
    cuts.iter().map(|c| flat.by_ref().take(c.segments.len()).collect()).collect()
}

/// One segment to be run freely.
#[derive(Clone, Copy)]
struct Stretch<'a> {
    run: usize,
    cut: &'a Cut,
    body: &'a Body,
    segment: &'a Segment,
    torque: &'a [[f64; 2]],
    grid: Grid,
}

impl Stretch<'_> {
    /// What segments that run side by side have in common: grid, rows of a window, windows.
    fn shape(&self) -> (Grid, usize, usize) {
        (self.grid, self.cut.rows_per_window, self.segment.windows)
    }

    /// Which recording it is of, and where its time begins.
    fn at(self) -> InRecording {
        InRecording { run: self.run, from: self.cut.from, window: self.cut.period * self.cut.rows_per_window as f64 }
    }

    fn start_time(&self) -> f64 {
        self.cut.time(self.segment.row as f64)
    }

    /// Where and when a dose is present: as it says, with `part` given only during that part.
    fn presence(&self, dose: &Dose, part: Option<usize>) -> Presence<f64> {
        let Some(q) = part else { return dose.presence };
        let length = (self.segment.windows * self.cut.rows_per_window) as f64 * self.cut.period;
        let border = |q: usize| self.start_time() + length * q as f64 / PARTS as f64 - 1e-6;
        Presence { from: border(q), until: border(q + 1), ..dose.presence }
    }
}

/// The dose that each stretch holds at the same place of its list, side by side.
fn wide_dose(stretches: &[Stretch<'_>; WIDTH], d: usize, part: Option<usize>) -> Option<Active<Wide>> {
    let doses: [&Dose; WIDTH] = from_fn(|i| &stretches[i].body.doses[d]);
    let values = doses.map(|d| d.values.as_slice());
    let presence = from_fn(|i| stretches[i].presence(doses[i], part));
    match OwnEffect::of(doses[0].effect) {
        Some(own) => Some(lanes::effect_of(own, values, presence)),
        None => lanes::effect(doses[0].effect, values, presence),
    }
}

/// Runs up to eight stretches of one shape; the last one fills what is left over.
fn side_by_side(group: &[Stretch<'_>], part: Option<usize>) -> RunResponse {
    let stretches: [Stretch<'_>; WIDTH] = from_fn(|i| group[i.min(group.len() - 1)]);
    let (grid, rows_per_window, windows) = stretches[0].shape();
    let count = stretches[0].body.doses.len();
    let active: Vec<Active<Wide>> =
        (0..count).filter_map(|d| wide_dose(&stretches, d, part.filter(|_| d + 1 == count))).collect();
    let robot = lanes::robots(stretches.map(|s| &s.body.robot));
    let acting = stretches[0].body.acting.as_ref().map(|a| a.side_by_side(&stretches.map(Stretch::at)));
    let plant = Plant::new(&robot, &active, Lanes::real(grid.step()))
        .disturbed(acting.as_ref().map(|a| a as &dyn Disturbance<Wide>));

    let steps = rows_per_window * grid.substeps;
    let torque = stretches.map(|s| &s.torque[s.segment.row * grid.substeps..]);
    let mut state = lanes::starts(&plant, stretches.map(|s| &s.segment.start), stretches.map(|s| s.start_time()));
    let mut means = Means {
        sum: Channels::all(Wide::zero()),
        share: 1.0 / steps as f64,
        out: vec![vec![Channels::all(0.0); windows]; group.len()],
    };
    let Ok(()) = Rollout::new(&plant, windows, steps).run_vectorised(
        &mut state,
        &mut Delivered(
            #[inline(always)]
            |window, step| lanes::pick(&torque, |_| window * steps + step),
        ),
        &mut means,
    );
    means.out
}

/// Takes the mean of every channel over each window.
struct Means {
    sum: Channels<Wide>,
    /// Of a step in a window.
    share: f64,
    out: RunResponse,
}

impl Visitor<Wide> for Means {
    type Stop = Infallible;

    #[inline(always)]
    fn begin(&mut self, _: usize, _: &Plant<'_, Wide>, _: &mut State<Wide>) -> Result<(), Infallible> {
        self.sum = Channels::all(Wide::zero());
        Ok(())
    }

    #[inline(always)]
    fn step(&mut self, _: usize, _: usize, plant: &Plant<'_, Wide>, s: &State<Wide>) {
        let mut r = plant.readings(s);
        plant.sense(&mut r);
        for channel in Channel::ALL {
            self.sum[channel] += match channel {
                Channel::LeftWheel => r.wheel_speed[0],
                Channel::RightWheel => r.wheel_speed[1],
                Channel::YawRate => r.gyro,
                Channel::ForwardVelocity => r.velocity[0],
                Channel::LateralVelocity => r.velocity[1],
                Channel::ForwardAcceleration => r.accel[0],
                Channel::LateralAcceleration => r.accel[1],
            };
        }
    }

    #[inline(always)]
    fn end(&mut self, window: usize, _: &Plant<'_, Wide>, _: &State<Wide>) {
        for (i, y) in self.out.iter_mut().enumerate() {
            y[window] = self.sum.map(|sum| sum.0[i] * self.share);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channel::ByQuantity;
    use crate::drives::Drives;
    use crate::testing::{cutting, driven};
    use crate::windows::cut;
    use testing::robot;

    #[test]
    fn a_free_run_reproduces_a_drive_of_the_plant_itself() {
        let robot = robot();
        let cut = cut(&driven(&robot, &[], 20.0), &cutting());
        let torque = Drives::default().delivered(0, &cut, &robot, &[], Grid::nearest(cut.period, 1e-3));
        let bodies = [Body { robot, doses: Vec::new(), acting: None, torque }];
        let free = free_run(std::slice::from_ref(&cut), &bodies, 0, None, 1e-3).remove(0);
        let (mut sum, mut size, mut n) = (Channels::all(0.0), Channels::all(0.0), 0.0);
        for (segment, free) in cut.segments.iter().zip(&free) {
            for ((o, p), valid) in segment.observed.iter().zip(free).zip(&segment.valid) {
                n += 1.0;
                for c in Channel::ALL {
                    let acceleration = matches!(c, Channel::ForwardAcceleration | Channel::LateralAcceleration);
                    assert!(valid[c] || (segment.row == 0 && acceleration));
                    sum[c] += (o[c] - p[c]).powi(2);
                    size[c] += o[c] * o[c];
                }
            }
        }
        // A tenth of typical residuals of a real drive.
        let most = Channels::from(ByQuantity {
            wheel_speed: 0.03,
            yaw_rate: 0.01,
            forward_velocity: 0.01,
            lateral_velocity: 0.01,
            forward_acceleration: 0.05,
            lateral_acceleration: 0.05,
        });
        for c in Channel::ALL {
            let rms = f64::sqrt(sum[c] / n);
            assert!(rms < most[c], "{}: rms {rms}", c.name());
            assert!(f64::sqrt(size[c] / n) > most[c], "{} is not driven", c.name());
        }
    }
}
