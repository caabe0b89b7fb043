//! What a drive shows, row by row: windows of pose, wheels and gyro against a free run of the plant.

use hierarchical_fit::CaseError as WheeledError;
use std::sync::Arc;

use hierarchical_fit::{Data, Kind, Observed, Row};
use inference::robust::rms;
use odometry::rates::slope;
use pulp::NullaryFnOnce;
use robot_model::{Lanes, real};

use crate::constants::{Constant, Has, constants};
use crate::drive::{Drive, STEP};
use crate::model::{LANES, Model, PerLane};
use crate::robot::AnyWheels;
use crate::settings::{SETTINGS, Windows};

const RULES: Windows = SETTINGS.windows;

/// Rows of the pose in a window: place and heading in its middle and at its end.
const POSE_ROWS: usize = 6;

/// A robot and its constants.
#[derive(Debug, Clone)]
pub(crate) struct Constants {
    pub(crate) robot: Arc<AnyWheels>,
    pub(crate) all: Vec<Constant>,
}

/// A drive with its windows.
#[derive(Debug, Clone)]
pub(crate) struct Shown<'a> {
    pub(crate) drive: &'a Drive,
    /// Steps at which windows begin, with the rates of the pose there.
    pub(crate) windows: Vec<(usize, [f64; 3])>,
    rows: Vec<Row>,
    /// Radii of the measured wheels as stated, m.
    radii: Vec<f64>,
}

fn window_steps() -> usize {
    (RULES.length / STEP).round() as usize
}

impl<'a> Shown<'a> {
    pub(crate) fn new(drive: &'a Drive, robot: &AnyWheels) -> Self {
        let radii = robot.measured.iter().map(|&k| robot.plant.wheels[k].map_or(0.0, |w| w.radius)).collect();
        let mut out = Self { drive, windows: Vec::new(), rows: Vec::new(), radii };
        let (length, every) = (window_steps(), (RULES.every / STEP).round() as usize);
        let half = (SETTINGS.grid.smoothing / STEP).round() as usize;
        let mut from = half;
        while from + length + half < drive.steps {
            if let Some(rates) = rates(drive, from, half).filter(|_| drive.is_whole(from - half, from + length)) {
                out.windows.push((from, rates));
                out.add_rows(from);
            }
            from += every;
        }
        out
    }

    fn add_rows(&mut self, from: usize) {
        let until = from + window_steps();
        let drive = self.drive;
        let way = if drive.has_pose() {
            let (a, b) = (drive.pose[from], drive.pose[until]);
            (b[0] - a[0]).hypot(b[1] - a[1]).max(RULES.lever * (b[2] - a[2]).abs())
        } else {
            self.rims(from, until).fold(0.0, |most, way| f64::max(most, way.abs()))
        };
        let is_moving = way > RULES.moving * RULES.length;
        let weight = RULES.shared * RULES.every / RULES.length;
        let row = |kind| Row { kind, time: STEP * until as f64, is_moving, weight };
        if drive.has_pose() {
            self.rows.extend([row(Kind::Pose); POSE_ROWS]);
        }
        for _ in 0..RULES.parts {
            self.rows.extend(drive.wheels.iter().map(|_| row(Kind::Encoder)));
            self.rows.extend(drive.gyro.iter().map(|_| row(Kind::Gyro)));
        }
    }

    /// Way of the rim of each measured wheel from one step to another, m.
    fn rims(&self, from: usize, until: usize) -> impl Iterator<Item = f64> + '_ {
        let turned =
            move |wheel: &odometry::held::Command| wheel.sum(STEP * until as f64) - wheel.sum(STEP * from as f64);
        self.drive.wheels.iter().zip(&self.radii).map(move |(wheel, radius)| radius * turned(wheel))
    }

    /// Errors of all rows at one value of the constants in each lane.
    #[inline(always)]
    fn errors_of<T: PerLane>(&self, model: &Constants, theta: &[T]) -> Vec<T> {
        let robot = model.robot.as_ref();
        let at = Model::at(robot, &model.all, theta);
        let (length, drive) = (window_steps(), self.drive);
        let part = length / RULES.parts;
        let mut out = Vec::with_capacity(self.rows.len());
        for &(from, rates) in &self.windows {
            let start = if drive.has_pose() {
                at.of_pose(drive, robot, from, (drive.pose[from], rates))
            } else {
                at.of_wheels(drive, robot, from)
            };
            let (mut poses, mut speeds) = (Vec::with_capacity(POSE_ROWS), Vec::new());
            let (mut angle, mut turned) = (start.wheel_angle, start.turned);
            at.run(start, drive, from, length, |k, s| {
                if drive.has_pose() && (k == length / 2 || k == length) {
                    poses.extend(pose_error(at.tracked(s), drive.pose[from], drive.pose[from + k]));
                }
                if k % part == 0 {
                    let seconds = STEP * part as f64;
                    let span = [from + k - part, from + k].map(|step| STEP * step as f64);
                    let shown = |of: &odometry::held::Command| {
                        at.clock.per_lane(|late| (of.sum(span[1] + late) - of.sum(span[0] + late)) / seconds)
                    };
                    let per = real::<T>(1.0 / seconds);
                    for ((&i, wheel), &radius) in robot.measured.iter().zip(&drive.wheels).zip(&self.radii) {
                        speeds.push(((s.wheel_angle[i] - angle[i]) * per - shown(wheel)) * real(radius));
                    }
                    if let Some(gyro) = &drive.gyro {
                        let [scale, bias] = at.gyro;
                        speeds.push(scale * (s.turned - turned) * per + bias - shown(gyro));
                    }
                    (angle, turned) = (s.wheel_angle, s.turned);
                }
            });
            out.extend(poses);
            out.extend(speeds);
        }
        // A law that runs away is as wrong as can be, and still a number.
        let held = |e: f64| if e.is_nan() { RULES.ceiling } else { e.clamp(-RULES.ceiling, RULES.ceiling) };
        out.into_iter().map(|e| e.per_lane(held)).collect()
    }
}

/// Rates of the pose at a step; nothing, of a drive without a pose.
fn rates(drive: &Drive, from: usize, half: usize) -> Option<[f64; 3]> {
    if !drive.has_pose() {
        return Some([0.0; 3]);
    }
    let seen = |k: usize| drive.pose.get(k).is_some_and(|p| p[0].is_finite());
    let length = window_steps();
    let usable = seen(from) && seen(from + length / 2) && seen(from + length);
    usable.then(|| slope(&drive.pose, [from.checked_sub(half)?, from + half], from, STEP)).flatten()
}

/// Error of a pose in m: ahead and to the side of the measured one, and heading by its lever.
fn pose_error<T: PerLane>([x, y, turned]: [T; 3], begun: [f64; 3], measured: [f64; 3]) -> [T; 3] {
    let (sin, cos) = measured[2].sin_cos();
    let d = [x - real(measured[0]), y - real(measured[1])];
    let (sin, cos): (T, T) = (real(sin), real(cos));
    let turn = turned - real(measured[2] - begun[2]);
    [d[0] * cos + d[1] * sin, d[1] * cos - d[0] * sin, turn * real(RULES.lever)]
}

/// Errors of several values of the constants, which [`pulp`] compiles once for each vector unit.
struct Vectorised<'s, 'a> {
    shown: &'s Shown<'a>,
    model: &'s Constants,
    values: &'s [Lanes<LANES>],
}

impl NullaryFnOnce for Vectorised<'_, '_> {
    type Output = Vec<Lanes<LANES>>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        self.shown.errors_of(self.model, self.values)
    }
}

impl Observed for Shown<'_> {
    type Model = Constants;

    const WINDOW: f64 = RULES.length;

    const FLOOR: [f64; 3] = RULES.floor;
    const NEAR: f64 = RULES.near;
    const HARDLY: f64 = SETTINGS.unexplained.hardly;

    fn name(&self) -> &str {
        &self.drive.name
    }

    fn seconds(&self) -> f64 {
        STEP * self.drive.steps as f64
    }

    fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn errors(&self, model: &Constants, theta: &[f64]) -> Vec<f64> {
        self.errors_of(model, theta)
    }

    fn columns(&self, model: &Constants, theta: &[f64]) -> Vec<Vec<f64>> {
        let step = |k: usize| RULES.difference * model.all[k].spread.usual;
        let mut out = Vec::with_capacity(theta.len());
        // As they are in the first lane, one constant farther on in each of the others: none goes below what it can be.
        let others = LANES - 1;
        for first in (0..theta.len()).step_by(others) {
            let lanes = |k: usize| {
                let at = |lane: usize| if lane > 0 && first + lane - 1 == k { theta[k] + step(k) } else { theta[k] };
                Lanes(std::array::from_fn(at))
            };
            let values: Vec<Lanes<LANES>> = (0..theta.len()).map(lanes).collect();
            let errors = pulp::Arch::new().dispatch(Vectorised { shown: self, model, values: &values });
            for lane in 1..=others.min(theta.len() - first) {
                let per = 1.0 / step(first + lane - 1);
                out.push(errors.iter().map(|e| (e.0[lane] - e.0[0]) * per).collect());
            }
        }
        out
    }

    fn sizes(&self) -> Vec<f64> {
        let (length, drive) = (window_steps(), self.drive);
        let mut out = Vec::new();
        for (k, &(from, _)) in self.windows.iter().enumerate() {
            let per_window = self.rows.len() / self.windows.len();
            if !self.rows[k * per_window].is_moving {
                continue;
            }
            if drive.has_pose() {
                for steps in [length / 2, length] {
                    let (a, b) = (drive.pose[from], drive.pose[from + steps]);
                    out.extend([b[0] - a[0], b[1] - a[1], RULES.lever * (b[2] - a[2])]);
                }
            } else {
                out.extend(self.rims(from, from + length).map(|way| way / RULES.length));
            }
        }
        out
    }

    fn noise(&self) -> f64 {
        if !self.drive.has_pose() {
            return 0.0;
        }
        let noise = self.drive.noise;
        let [ahead, left, turning] = noise.share_of_wheels(false);
        let [wheels, gyro] =
            [!self.drive.wheels.is_empty(), self.drive.gyro.is_some()].map(|is| f64::from(u8::from(is)));
        let shares = [wheels * ahead, wheels * left, gyro * turning];
        let [middle, end] = [0.5, 1.0].map(|share| noise.after(share * RULES.length, shares));
        let of = |[ahead, left, heading]: [f64; 3]| [ahead, left, RULES.lever * heading];
        rms([of(middle), of(end)].into_iter().flatten()).unwrap_or(0.0)
    }

    fn judged_by(&self) -> Kind {
        if self.drive.has_pose() { Kind::Pose } else { Kind::Encoder }
    }

    fn apart(&self, kind: Kind) -> usize {
        match kind {
            Kind::Pose => POSE_ROWS,
            Kind::Gyro => RULES.parts,
            Kind::Encoder => RULES.parts * self.drive.wheels.len().max(1),
        }
    }
}

/// Drives with the constants of a robot.
///
/// # Errors
/// When there is too little motion.
pub(crate) fn data<'a>(
    robot: &Arc<AnyWheels>,
    has: Has,
    drives: &[&'a Drive],
) -> Result<Data<Shown<'a>>, WheeledError> {
    let shown: Vec<Shown<'a>> = drives.iter().map(|d| Shown::new(d, robot)).collect();
    let moving = |s: &Shown<'_>| {
        let per_window = s.rows.len() / s.windows.len().max(1);
        s.rows.chunks(per_window.max(1)).filter(|rows| rows[0].is_moving).count()
    };
    let windows: usize = shown.iter().map(moving).sum();
    let (length, needed) = (RULES.length, RULES.least);
    if windows < needed {
        return Err(WheeledError::Short { windows, length, needed });
    }
    let all = constants(robot, has.pose, has.gyro);
    let spreads = all.iter().map(|c| c.spread).collect();
    Ok(Data { model: Constants { robot: Arc::clone(robot), all }, spreads, drives: shown })
}
