//! Windows of drives: how the pose moved in each, and how the wheels' motion says that it did.

use crate::constants::{Constant, Quantity};
use crate::drive::Drive;
use crate::error::OdometryError;
use crate::heading::is_rolling;
use crate::motion::{Laws, implied, relative};
use crate::settings::{SETTINGS, Windows as Rules};
use crate::wheel::WheeledRobot;
use hierarchical_fit::CaseError;
use inference::robust::{MAD_TO_SIGMA, quantile, sorted};

const RULES: Rules = SETTINGS.windows;

/// A window of a drive: its first and last row, and how the pose moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window {
    pub(crate) from: usize,
    pub(crate) to: usize,
    /// NaN along x and y where only a heading was measured.
    pub(crate) moved: [f64; 3],
    /// By a heading alone: whether a wheel turned.
    rolls: bool,
}

impl Window {
    /// A window of which the motion of the pose is known.
    pub(crate) fn of_pose(from: usize, to: usize, moved: [f64; 3]) -> Self {
        Self { from, to, moved, rolls: false }
    }

    fn is_heading(&self) -> bool {
        self.moved[0].is_nan()
    }

    /// Whether anything moved.
    pub(crate) fn is_moving(&self) -> bool {
        if self.is_heading() {
            return self.rolls;
        }
        self.moved[0].hypot(self.moved[1]) + self.moved[2].abs() > RULES.moving
    }

    /// Error of a path in metres: x, y, and yaw by its lever; none along what was not measured.
    pub(crate) fn error(&self, path: &[[f64; 3]]) -> [f64; 3] {
        let [x, y, yaw] = relative(path[self.from], path[self.to]);
        let turned = (yaw - self.moved[2]) / RULES.lever;
        if self.is_heading() { [0.0, 0.0, turned] } else { [x - self.moved[0], y - self.moved[1], turned] }
    }

    /// What of three numbers along x, y and yaw was measured.
    pub(crate) fn measured(&self, [x, y, yaw]: [f64; 3]) -> impl Iterator<Item = f64> {
        let all = !self.is_heading();
        [x, y].into_iter().filter(move |_| all).chain([yaw])
    }

    /// Motion in metres: x, y, and yaw by its lever, of which was measured.
    pub(crate) fn way(&self) -> impl Iterator<Item = f64> {
        let [x, y, yaw] = self.moved;
        self.measured([x, y, yaw / RULES.lever])
    }
}

/// Windows of `length` that begin every `every` seconds, between rows in which the pose was seen.
pub(crate) fn windows(drive: &Drive, length: f64, every: f64) -> Vec<Window> {
    windows_within(drive, length, every, [drive.time[0], drive.time[drive.time.len() - 1]])
}

/// The same from one instant to another.
fn windows_within(drive: &Drive, length: f64, every: f64, [first, last]: [f64; 2]) -> Vec<Window> {
    let time = &drive.time;
    let mut out = Vec::new();
    let mut begin = first;
    let (mut from, mut to) = (0, 0);
    let slack = SETTINGS.drive.rate;
    while begin + length <= last + f64::EPSILON {
        while from < time.len() && (time[from] < begin || !drive.is_seen(from)) {
            from += 1;
        }
        let Some(start) = time.get(from).copied() else { break };
        to = to.max(from);
        while to < time.len() && (time[to] + 1e-9 < start + length || !drive.is_seen(to)) {
            to += 1;
        }
        // A pose that was not seen for a while makes no window of another length.
        if to < time.len()
            && time[to] <= last + f64::EPSILON
            && time[to] - start <= length + slack
            && start - begin <= slack
        {
            let rolls = drive.heading_only && is_rolling(drive.rolled(from, to));
            out.push(Window { from, to, moved: relative(drive.pose[from], drive.pose[to]), rolls });
        }
        begin += every;
    }
    out
}

/// Drives with their windows, ready for fits.
#[derive(Clone)]
pub(crate) struct Data<'a> {
    pub(crate) robot: &'a WheeledRobot,
    pub(crate) drives: Vec<&'a Drive>,
    pub(crate) constants: &'a [Constant],
    pub(crate) windows: Vec<Vec<Window>>,
    /// Index of each drive's session.
    pub(crate) session: Vec<usize>,
    pub(crate) sessions: Vec<String>,
    /// Windows that are left out, by drive: those in which counts were lost.
    pub(crate) dropped: Vec<Vec<bool>>,
    /// Least scale of the errors, m.
    floor: f64,
}

impl<'a> Data<'a> {
    pub(crate) fn new(
        robot: &'a WheeledRobot,
        constants: &'a [Constant],
        drives: Vec<&'a Drive>,
    ) -> Result<Self, OdometryError> {
        let out = Self::of(robot, constants, drives);
        let moving = out.windows.iter().flatten().filter(|w| w.is_moving()).count();
        if moving < RULES.least {
            return Err(OdometryError::Case(CaseError::Short {
                windows: moving,
                length: RULES.length,
                needed: RULES.least,
            }));
        }
        Ok(out)
    }

    /// The same of any number of windows.
    pub(crate) fn of(robot: &'a WheeledRobot, constants: &'a [Constant], drives: Vec<&'a Drive>) -> Self {
        let windows: Vec<Vec<Window>> = drives.iter().map(|d| windows(d, RULES.length, RULES.length)).collect();
        let mut sessions: Vec<String> = Vec::new();
        let mut session = Vec::new();
        for drive in &drives {
            let index = sessions.iter().position(|s| *s == drive.session).unwrap_or_else(|| {
                sessions.push(drive.session.clone());
                sessions.len() - 1
            });
            session.push(index);
        }
        let dropped = windows.iter().map(|w| vec![false; w.len()]).collect();
        let floor = if drives.iter().all(|drive| drive.heading_only) {
            let moving = windows.iter().flatten().filter(|w| w.is_moving());
            let usual = inference::robust::rms(moving.flat_map(Window::way)).unwrap_or(0.0);
            RULES.floor.max(SETTINGS.heading.error * usual)
        } else {
            RULES.floor
        };
        Self { robot, drives, constants, windows, session, sessions, dropped, floor }
    }

    /// The same drives in windows of another length, of which none is left out.
    pub(crate) fn with_windows(&self, length: f64) -> Self {
        let windows: Vec<Vec<Window>> = self.drives.iter().map(|d| windows(d, length, length)).collect();
        let dropped = windows.iter().map(|w| vec![false; w.len()]).collect();
        Self { windows, dropped, ..self.clone() }
    }

    /// Leaves spans of a drive out, s, in their order: windows begin anew after each.
    pub(crate) fn leave_out(&mut self, drive: usize, spans: &[[f64; 2]]) {
        let of = self.drives[drive];
        let mut free: Vec<[f64; 2]> = Vec::new();
        let mut first = of.time[0];
        for [from, until] in spans {
            free.push([first, *from]);
            first = *until;
        }
        free.push([first, of.time[of.time.len() - 1]]);
        let within = |ends| windows_within(of, RULES.length, RULES.length, ends);
        self.windows[drive] = free.into_iter().flat_map(within).collect();
        self.dropped[drive] = vec![false; self.windows[drive].len()];
    }

    /// From when to when a window of a drive lasts, s.
    pub(crate) fn span(&self, drive: usize, window: usize) -> [f64; 2] {
        let Window { from, to, .. } = self.windows[drive][window];
        [from, to].map(|row| self.drives[drive].time[row])
    }

    /// The laws at these values of the constants.
    pub(crate) fn laws(&self, theta: &[f64]) -> Laws {
        laws(self.robot, self.constants, theta)
    }

    /// Noise of a window by neighbouring rows of the pose, m: second differences know no motion.
    pub(crate) fn pose_noise(&self) -> f64 {
        let mut second = Vec::new();
        for drive in &self.drives {
            // A row without a pose may stand between two of them, where the pose was not seen or is slower than the wheels.
            let seen: Vec<[f64; 3]> =
                (0..drive.pose.len()).filter(|&row| drive.is_seen(row)).map(|row| drive.pose[row]).collect();
            for w in seen.windows(3) {
                let bend = |axis: usize| w[2][axis] - 2.0 * w[1][axis] + w[0][axis];
                second.push(if drive.heading_only { bend(2).abs() / RULES.lever } else { bend(0).hypot(bend(1)) });
            }
        }
        // Variances of second differences are six times those of samples; two samples bound a window.
        inference::robust::median(second).unwrap_or(0.0) / 3.0_f64.sqrt()
    }

    /// Errors of all windows at these values, by drive.
    pub(crate) fn errors(&self, theta: &[f64]) -> Vec<Vec<[f64; 3]>> {
        self.errors_by_session(&vec![theta.to_vec(); self.sessions.len()])
    }

    /// Errors of all windows at the values of each session, by drive.
    pub(crate) fn errors_by_session(&self, thetas: &[Vec<f64>]) -> Vec<Vec<[f64; 3]>> {
        let laws: Vec<Laws> = thetas.iter().map(|theta| self.laws(theta)).collect();
        let of = |index: usize| {
            let path = implied(self.robot, self.drives[index], &laws[self.session[index]]);
            self.windows[index].iter().map(|w| w.error(&path)).collect()
        };
        (0..self.drives.len()).map(of).collect()
    }

    /// Scale of the errors of windows in motion, m: by their upper quantile, for a few may be outliers.
    pub(crate) fn scale(&self, errors: &[Vec<[f64; 3]>]) -> f64 {
        let sizes = self.sizes(errors);
        let limit = quantile(&sizes, RULES.quantile).unwrap_or(0.0) / RULES.quantile_sigmas;
        let cut = 2.0 * RULES.quantile_sigmas * limit;
        let clipped = inference::robust::rms(sizes.iter().map(|e| e.min(cut))).unwrap_or(0.0);
        clipped.max(self.floor)
    }

    /// The same by the median, which half of the windows may be off without moving much.
    pub(crate) fn usual_scale(&self, errors: &[Vec<[f64; 3]>]) -> f64 {
        let median = quantile(&self.sizes(errors), 0.5).unwrap_or(0.0);
        (MAD_TO_SIGMA * median).max(self.floor)
    }

    /// Sizes of the errors of windows in motion, rising.
    fn sizes(&self, errors: &[Vec<[f64; 3]>]) -> Vec<f64> {
        let moving = |drive: usize| {
            let used = self.windows[drive].iter().zip(&self.dropped[drive]).zip(&errors[drive]);
            used.filter(|((w, dropped), _)| w.is_moving() && !**dropped).flat_map(|((w, _), e)| w.measured(*e))
        };
        sorted((0..errors.len()).flat_map(moving).map(f64::abs))
    }
}

/// The laws of a robot at these values of its constants.
pub(crate) fn laws(robot: &WheeledRobot, constants: &[Constant], theta: &[f64]) -> Laws {
    let values: Vec<(Quantity, f64)> = constants.iter().map(|c| c.quantity).zip(theta.iter().copied()).collect();
    Laws::given(robot).with(&values)
}
