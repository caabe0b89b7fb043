//! A robot that follows a course under torque, as a recording without noise.

use robot_model::presence::Presence;
use robot_model::{Active, Plant, Robot, State};
use sim::rollout::{Grid, Hold, Input, Rollout, Start};

use crate::channel::{Channel, Channels};
use crate::drives::Drives;
use crate::fit::Problem;
use crate::settings::next::{Follow, SETTINGS};
use crate::settings::preparation;
use crate::windows::{Cut, Segment};
use inference::hypothesis::Dose;
use verdict::{Course, wheel_speeds};

const FOLLOW: Follow = SETTINGS.follower;

/// What a drive is made with: the robot as its user knows it, and how the recordings were made.
#[derive(Debug, Clone)]
pub(crate) struct Follower {
    known: Robot<f64>,
    limit: f64,
    gain: f64,
    period: f64,
    /// Integration step, s.
    step: f64,
    /// Windows of a segment.
    windows: usize,
    rows_per_window: usize,
    /// Channels that the recordings have.
    channels: Channels<bool>,
    /// What the simulation is given beside the robot.
    given: Vec<Dose>,
}

/// What the simulation is given until the end of a drive, from the beginning of the next one on.
fn lasting(given: &[Dose], end: f64) -> Vec<Dose> {
    let lasts = given.iter().filter(|dose| dose.presence.from < end).cloned();
    lasts.map(|dose| Dose { presence: Presence { from: Presence::default().from, ..dose.presence }, ..dose }).collect()
}

impl Follower {
    /// As the recordings of a problem were made; `None` without any segment.
    pub(crate) fn new(problem: &Problem<'_>) -> Option<Self> {
        let cut = problem.cuts.iter().find(|c| !c.segments.is_empty())?;
        let known = *problem.robot;
        let limit = if known.drive.limit < FOLLOW.no_limit { known.drive.limit } else { problem.largest_torque };
        let inertia = 0.5 * known.mass * known.wheel_radius.powi(2) + 2.0 * known.wheel_inertia + known.motor_inertia;
        let shown = |c: Channel| problem.cuts.iter().flat_map(|cut| &cut.segments).any(|s| s.shows(c));
        Some(Self {
            given: lasting(&cut.given, cut.end()),
            known,
            limit,
            gain: inertia / FOLLOW.reach,
            period: cut.period,
            step: problem.step,
            windows: cut.segments[0].windows,
            rows_per_window: cut.rows_per_window,
            channels: Channels::from_fn(shown),
        })
    }

    /// Drives a robot along a course; what it shows is left to a free run. Without ground nothing holds the heading.
    pub(crate) fn drive(
        &self,
        robot: &Robot<f64>,
        doses: &[Dose],
        course: &Course,
        start: [f64; 3],
        ground: bool,
    ) -> Cut {
        let active: Vec<Active<f64>> = self.given.iter().chain(doses).map(Dose::active).collect();
        let length = course.points.last().map_or(0.0, |p| p[0]);
        let rows = (length / self.period).round() as usize;
        let grid = Grid::nearest(self.period, self.step);
        let plant = Plant::new(robot, &active, grid.step());

        let (sin, cos) = start[2].sin_cos();
        let mut s = State { position: [start[0], start[1]], heading: [cos, sin], ..State::default() };
        let mut following = Following {
            follower: self,
            course,
            ground,
            rows,
            hold: Hold::new(grid, plant.drive().delay),
            step: grid.step(),
            yaw: start[2],
            heading: 0.0,
            turned: 0.0,
            sums: [0.0; 2],
            torque: Vec::with_capacity(rows),
            segments: Vec::new(),
        };
        let Ok(()) = Rollout::new(&plant, rows, grid.substeps).run(&mut s, &mut following, &mut ());

        Cut {
            from: 0.0,
            visit: None,
            given: self.given.clone(),
            name: "next".to_owned(),
            period: self.period,
            rows_per_window: self.rows_per_window,
            torque: following.torque,
            segments: following.segments,
            path: Vec::new(),
        }
    }

    /// Torque of a side: known friction, and what brings the wheel to its speed.
    fn command(&self, j: usize, wanted: f64, speed: f64, sum: &mut f64) -> f64 {
        let error = wanted - speed;
        let known = self.known.coulomb[j] * (wanted / FOLLOW.friction_rest).tanh() + self.known.viscous[j] * wanted;
        let torque = known + self.gain * error + *sum;
        // No winding up beyond the limit.
        if torque.abs() < self.limit || torque * error < 0.0 {
            *sum += FOLLOW.integral * self.gain * error * self.period;
        }
        torque.clamp(-self.limit, self.limit)
    }

    fn segment(&self, row: usize, start: Start) -> Segment {
        let valid = vec![self.channels; self.windows];
        let count = valid.iter().flat_map(Channels::iter).filter(|v| **v).count() as f64;
        Segment {
            row,
            windows: self.windows,
            start,
            observed: vec![Channels::all(0.0); self.windows],
            valid,
            wheels: Vec::new(),
            regime: [0.0; 3],
            count,
        }
    }
}

/// A follower on its way: sets the torque of each row from the state at its start.
struct Following<'a> {
    follower: &'a Follower,
    course: &'a Course,
    ground: bool,
    rows: usize,
    hold: Hold,
    /// Integration step, s.
    step: f64,
    /// Yaw at the start; heading that is wanted and turn that is made since, rad.
    yaw: f64,
    heading: f64,
    turned: f64,
    /// Integrals of the two sides' controllers, N m.
    sums: [f64; 2],
    torque: Vec<[f64; 2]>,
    segments: Vec<Segment>,
}

impl Following<'_> {
    fn start(&self, plant: &Plant<'_, f64>, s: &State<f64>) -> Start {
        Start {
            wheel_speed: s.wheel_speed,
            wheel_angle: s.wheel_angle,
            yaw_rate: s.yaw_rate,
            velocity: plant.velocity(s),
            position: s.position,
            yaw: self.yaw + self.turned,
        }
    }
}

impl Input<f64> for Following<'_> {
    fn begin(&mut self, row: usize, plant: &Plant<'_, f64>, s: &State<f64>) {
        let f = self.follower;

        // As in a recording, a whole window is left after the last segment.
        let per_segment = f.windows * f.rows_per_window;
        if row.is_multiple_of(per_segment) && row + per_segment + f.rows_per_window <= self.rows {
            self.segments.push(f.segment(row, self.start(plant, s)));
        }

        let t = row as f64 * f.period;
        let [speed, turn] = self.course.at(t);
        self.heading += turn * f.period;
        let off = (self.heading - self.turned).clamp(-FOLLOW.largest_error, FOLLOW.largest_error);
        self.heading = self.turned + off;
        let turn = if self.ground { turn + FOLLOW.heading * off } else { turn };

        let wanted = wheel_speeds([speed, turn], f.known.wheel_radius, f.known.turning_lever());
        let command = if self.course.is_free(t) {
            self.sums = [0.0; 2];
            [0.0; 2]
        } else {
            std::array::from_fn(|j| f.command(j, wanted[j], s.wheel_speed[j], &mut self.sums[j]))
        };
        self.torque.push(command);
    }

    fn advance(&mut self, row: usize, step: usize, plant: &Plant<'_, f64>, s: &mut State<f64>) {
        let before = s.yaw_rate;
        plant.step(s, self.hold.command(&self.torque, row, step));
        self.turned += 0.5 * (before + s.yaw_rate) * self.step;
    }
}

/// Fills in what the drive showed, and what kind of driving each segment is.
pub(crate) fn observe(cut: &mut Cut, response: &[Vec<Channels<f64>>]) {
    for (segment, shown) in cut.segments.iter_mut().zip(response) {
        let of = |(shown, valid): (&Channels<f64>, &Channels<bool>)| {
            Channels::from_fn(|c| if valid[c] { shown[c] } else { 0.0 })
        };
        segment.observed = shown.iter().zip(&segment.valid).map(of).collect();
        let windows = || segment.observed.iter();
        let mean = |c: Channel| windows().map(|w| w[c].abs()).sum::<f64>() / segment.windows.max(1) as f64;
        let wheels = || windows().flat_map(|w| Channel::WHEELS.map(|wheel| w[wheel]));
        let range = wheels().fold(f64::MIN, f64::max) - wheels().fold(f64::MAX, f64::min);
        // The same measures of a kind of driving as a recording's.
        let unit = preparation::SETTINGS.windows;
        let regime =
            [mean(Channel::YawRate) / unit.turning, mean(Channel::ForwardVelocity) / unit.speed, range / unit.range];
        segment.regime = regime;
    }
}

/// A problem on one drive of a robot; nothing is known of the drive's own numbers yet.
pub(crate) fn on_drive<'a>(
    problem: &Problem<'a>,
    robot: &'a Robot<f64>,
    cut: &'a Cut,
    regime: Vec<f64>,
) -> Problem<'a> {
    Problem {
        robot,
        cuts: std::slice::from_ref(cut),
        regime: vec![regime],
        drives: Drives::default(),
        ..problem.clone()
    }
}
