//! A drive: turns of the wheels, steering and the measured pose on one grid of rows.

use crate::constants::ClockZero;
use crate::counter;
use crate::error::OdometryError;
use crate::lost_pose::without_zeros;
use crate::settings::{DriveRules, SETTINGS};
use crate::units;
use crate::wheel::{Wheel, WheeledRobot};
use hierarchical_fit::CaseError;

const RULES: DriveRules = SETTINGS.drive;

/// A drive of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// Its name in messages.
    pub name: String,
    /// Session without a change on the robot; constants may differ between sessions.
    pub session: String,
    /// Time of each row, s, rising.
    pub time: Vec<f64>,
    /// Turns of each measured wheel since the row before, rad; of the first row they do not count.
    pub turns: Vec<Vec<f64>>,
    /// Steering angle during each row, rad; needed where a wheel is steered.
    pub steering: Option<Vec<f64>>,
    /// Measured x, y, m, and yaw, rad, unwrapped; NaN where the pose was not seen. By a gyro alone, x and y are never seen.
    pub pose: Vec<[f64; 3]>,
    /// The heading is that of a gyro from the first row on, and no place was measured.
    pub heading_only: bool,
    /// What was done to it before the comparison, for people.
    pub told: Vec<String>,
}

/// What the columns of the wheels hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WheelData {
    /// Counts since the row before.
    Counts,
    /// Counts since any instant, of a counter that may wrap around.
    Counter,
    /// Angle, rad.
    Angle,
    /// Speed, rad/s.
    Speed,
}

/// What was done to a recording, with its name.
pub(crate) fn of_recording(name: &str, told: Vec<String>) -> Vec<String> {
    told.into_iter().map(|said| format!("recording '{name}': {said}")).collect()
}

/// Refuses a drive of too few rows, or of rows that are too far apart.
pub(crate) fn enough_rows(name: &str, time: &[f64]) -> Result<(), OdometryError> {
    let rows = time.len();
    let what = if rows < RULES.rows {
        format!("{rows} rows, but at least {} are needed; record longer", RULES.rows)
    } else {
        let apart = inference::robust::median(time.windows(2).map(|t| t[1] - t[0])).unwrap_or(0.0);
        if apart <= RULES.apart {
            return Ok(());
        }
        format!(
            "its rows are {apart:.0} s apart, at most {} can be compared; if the time is in another unit, state it under \
             [columns]: time_unit = \"ms\" (or us, ns)",
            RULES.apart
        )
    };
    Err(OdometryError::Case(CaseError::Drive { drive: name.to_owned(), what }))
}

/// Radians in one unit of the column of a wheel.
pub(crate) fn radians(robot: &WheeledRobot, wheel: &Wheel, data: WheelData) -> Result<f64, OdometryError> {
    let lacks = || {
        OdometryError::Wheel {
        robot: robot.name.clone(),
        wheel: wheel.name.clone(),
        what: "counts are recorded, but counts_per_turn is missing; give the counts of one turn of the wheel, gear included"
            .to_owned(),
    }
    };
    match data {
        WheelData::Angle | WheelData::Speed => Ok(1.0),
        WheelData::Counts | WheelData::Counter => Ok(std::f64::consts::TAU / wheel.counts_per_turn.ok_or_else(lacks)?),
    }
}

impl Drive {
    /// A drive from columns: one of each measured wheel, in the order of the robot's wheels.
    ///
    /// Counters and angles that wrap around are unwrapped, and columns that can only be in millimetres, degrees, turns or turns
    /// per minute are taken as such; all of it is told in [`Drive::told`].
    ///
    /// # Errors
    /// When columns are missing, of unlike length or not finite, when counts lack `counts_per_turn`, or when the unit of the
    /// pose cannot be told.
    pub fn new(
        name: &str,
        robot: &WheeledRobot,
        time: Vec<f64>,
        (data, wheels): (WheelData, &[Vec<f64>]),
        steering: Option<Vec<f64>>,
        pose: Vec<[f64; 3]>,
    ) -> Result<Self, OdometryError> {
        let mut out = Self::of_columns(name, robot, time, (data, wheels), steering, pose)?;
        units::guess(&mut out, robot, data)?;
        Ok(out)
    }

    /// A drive in which a gyro alone shows how the body turned: yaw is its heading, x and y are NaN.
    ///
    /// # Errors
    /// As [`Drive::new`].
    pub fn by_gyro(
        name: &str,
        robot: &WheeledRobot,
        time: Vec<f64>,
        (data, wheels): (WheelData, &[Vec<f64>]),
        steering: Option<Vec<f64>>,
        heading: Vec<[f64; 3]>,
    ) -> Result<Self, OdometryError> {
        let mut out = Self::of_columns(name, robot, time, (data, wheels), steering, heading)?;
        out.heading_only = true;
        units::guess(&mut out, robot, data)?;
        Ok(out)
    }

    /// A drive whose pose is to be predicted, and may be seen in some rows or in none.
    ///
    /// # Errors
    /// As [`Drive::new`], but for a pose that was never seen.
    pub fn held_out(
        name: &str,
        robot: &WheeledRobot,
        time: Vec<f64>,
        (data, wheels): (WheelData, &[Vec<f64>]),
        steering: Option<Vec<f64>>,
        pose: Vec<[f64; 3]>,
    ) -> Result<Self, OdometryError> {
        let mut out = Self::of_columns(name, robot, time, (data, wheels), steering, pose)?;
        // One pose is a beginning; only motion tells units.
        if (0..out.pose.len()).filter(|&row| out.is_seen(row)).nth(RULES.rows).is_some() {
            units::guess(&mut out, robot, data)?;
        }
        Ok(out)
    }

    pub(crate) fn of_columns(
        name: &str,
        robot: &WheeledRobot,
        time: Vec<f64>,
        (data, wheels): (WheelData, &[Vec<f64>]),
        steering: Option<Vec<f64>>,
        mut pose: Vec<[f64; 3]>,
    ) -> Result<Self, OdometryError> {
        let wrong = |what: String| OdometryError::Case(CaseError::Drive { drive: name.to_owned(), what });
        let measured = robot.measured();
        if wheels.len() != measured.len() {
            let what =
                format!("{} columns of wheels, but the robot has {} measured wheels", wheels.len(), measured.len());
            return Err(wrong(what));
        }
        if robot.is_steered() && steering.is_none() {
            return Err(wrong("the robot has a steered wheel, but no steering angle is mapped".to_owned()));
        }
        let rows = time.len();
        let lengths = wheels.iter().map(Vec::len).chain(steering.iter().map(Vec::len)).chain([pose.len()]);
        if let Some(other) = { lengths }.find(|n| *n != rows) {
            return Err(wrong(format!("a column of {other} rows beside {rows} rows of time")));
        }
        if let Some(row) = (1..rows).find(|&k| time[k].partial_cmp(&time[k - 1]) != Some(std::cmp::Ordering::Greater)) {
            return Err(wrong(format!("time does not rise in row {row}; sort the rows, or remove repeated ones")));
        }
        enough_rows(name, &time)?;
        let finite = wheels.iter().flatten().chain(steering.iter().flatten()).all(|x| x.is_finite());
        if !finite {
            return Err(wrong(
                "wheel or steering columns hold values that are no numbers; cut the drive there".to_owned(),
            ));
        }

        let mut told = Vec::new();
        without_zeros(&mut pose, &mut told);
        let mut turns = vec![vec![0.0; wheels.len()]; rows];
        for (k, column) in wheels.iter().enumerate() {
            let wheel = &robot.wheels[measured[k]];
            let unit = radians(robot, wheel, data)?;
            let column = counter::unwrapped(column, data, wheel, &mut told);
            for row in 1..rows {
                turns[row][k] = unit
                    * match data {
                        WheelData::Counts => column[row],
                        WheelData::Counter | WheelData::Angle => column[row] - column[row - 1],
                        WheelData::Speed => 0.5 * (column[row] + column[row - 1]) * (time[row] - time[row - 1]),
                    };
            }
        }
        let told = of_recording(name, told);
        let (name, session) = (name.to_owned(), name.to_owned());
        Ok(Self { name, session, time, turns, steering, pose, heading_only: false, told })
    }

    /// The same drive of a session.
    #[must_use]
    pub fn of_session(mut self, session: &str) -> Self {
        session.clone_into(&mut self.session);
        self
    }

    /// How long it is, s.
    pub fn duration(&self) -> f64 {
        self.time.last().zip(self.time.first()).map_or(0.0, |(last, first)| last - first)
    }

    /// Whether the pose is seen in a row.
    pub(crate) fn is_seen(&self, row: usize) -> bool {
        let pose = &self.pose[row];
        pose[2].is_finite() && (self.heading_only || pose.iter().all(|x| x.is_finite()))
    }

    /// Rates about each row of what goes on by `steps` from row to row, per s: means over the rows that are near enough.
    pub(crate) fn rates<const N: usize>(&self, steps: impl Fn(usize) -> [f64; N]) -> Vec<[f64; N]> {
        let rows = self.time.len();
        let mut sums = vec![[0.0; N]; rows];
        for row in 1..rows {
            let step = steps(row);
            sums[row] = std::array::from_fn(|k| sums[row - 1][k] + step[k]);
        }

        let (mut first, mut last) = (1, 1);
        let about = |row: usize| {
            // The first row has no step of its own.
            while first < row && self.time[row] - self.time[first] > RULES.rate {
                first += 1;
            }
            last = last.max(row);
            while last + 1 < rows && self.time[last + 1] - self.time[row] <= RULES.rate {
                last += 1;
            }
            let span = self.time[last] - self.time[first - 1];
            std::array::from_fn(|k| (sums[last][k] - sums[first - 1][k]) / span)
        };
        std::iter::once([0.0; N]).chain((1..rows).map(about)).collect()
    }

    /// A path by rows as it is at the instants of the pose when the counts' clock is `offset` behind and slow by `rate` from `zero`
    /// on: row `t` shows what the counts have at `t − offset − rate (t − t₀)`.
    pub(crate) fn at_shifted_clock(
        &self,
        path: &[[f64; 3]],
        [offset, rate]: [f64; 2],
        zero: ClockZero,
    ) -> Vec<[f64; 3]> {
        let start = self.zero(zero);
        let mut k = 0;
        let at = |t: f64| {
            let t = t - offset - rate * (t - start);
            while k + 2 < self.time.len() && self.time[k + 1] < t {
                k += 1;
            }
            while k > 0 && self.time[k] > t {
                k -= 1;
            }
            // Outside the recording the wheels are taken to go on as in its last row.
            let share = (t - self.time[k]) / (self.time[k + 1] - self.time[k]);
            [0, 1, 2].map(|axis| path[k][axis] + share * (path[k + 1][axis] - path[k][axis]))
        };
        self.time.iter().copied().map(at).collect()
    }

    /// Where clocks agree, s.
    fn zero(&self, zero: ClockZero) -> f64 {
        match zero {
            ClockZero::Start => self.time[0],
            ClockZero::Middle => 0.5 * (self.time[0] + self.time[self.time.len() - 1]),
        }
    }

    /// When the pose shows what the counts have at an instant: the inverse of [`at_shifted_clock`](Self::at_shifted_clock).
    pub(crate) fn time_of_pose(&self, counts: f64, [offset, rate]: [f64; 2], zero: ClockZero) -> f64 {
        let start = self.zero(zero);
        start + (counts - start + offset) / (1.0 - rate)
    }

    /// Moves counts and steering to `by` seconds later; where none were recorded the wheels stand.
    pub(crate) fn shift_counts(&mut self, by: f64) {
        let time = &self.time;
        let last = time.len() - 1;
        // Row and share of the way to the next, of an instant.
        let place = |t: f64| {
            let row = time.partition_point(|x| *x <= t).clamp(1, last) - 1;
            (row, ((t - time[row]) / (time[row + 1] - time[row])).clamp(0.0, 1.0))
        };
        let between = |column: &[f64], t: f64| {
            let (row, share) = place(t);
            column[row] + share * (column[row + 1] - column[row])
        };

        let wheels = self.turns[0].len();
        let mut turned = vec![vec![0.0; wheels]; time.len()];
        for wheel in 0..wheels {
            let mut sum = 0.0;
            let sums: Vec<f64> = (0..time.len())
                .map(|row| {
                    sum += if row == 0 { 0.0 } else { self.turns[row][wheel] };
                    sum
                })
                .collect();
            for row in 1..time.len() {
                turned[row][wheel] = between(&sums, time[row] - by) - between(&sums, time[row - 1] - by);
            }
        }
        let steering = self.steering.as_ref().map(|s| time.iter().map(|t| between(s, t - by)).collect());
        self.turns = turned;
        self.steering = steering;
    }

    /// Takes the pose as not seen where the counts end: their clock is `offset` behind and slow by `rate`, and they were moved
    /// by `moved` seconds.
    pub(crate) fn forget_pose_beyond(&mut self, [offset, rate]: [f64; 2], moved: f64) {
        let (first, last) = (self.time[0], self.time[self.time.len() - 1]);
        for (t, pose) in self.time.iter().zip(&mut self.pose) {
            let counted = t - offset - rate * (t - first);
            if [counted, counted - moved].iter().any(|t| !(first..=last).contains(t)) {
                *pose = [f64::NAN; 3];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot() -> WheeledRobot {
        WheeledRobot::differential(0.05, 0.3).with_wheels(|_, w| crate::Wheel { counts_per_turn: Some(1000.0), ..w })
    }

    fn straight(data: WheelData, column: impl Fn(usize) -> f64, scale: f64) -> Result<Drive, OdometryError> {
        let time: Vec<f64> = (0..100).map(|k| 0.05 * f64::from(k)).collect();
        let wheel: Vec<f64> = (0..100).map(column).collect();
        let metres = std::f64::consts::TAU * 0.05 / 1000.0;
        let pose = (0..100).map(|k| [scale * metres * 300.0 * f64::from(k), 0.0, 0.0]).collect();
        Drive::new("a", &robot(), time, (data, &[wheel.clone(), wheel]), None, pose)
    }

    #[test]
    fn a_counter_that_wraps_around_is_unwrapped_and_told() {
        let drive = straight(WheelData::Counter, |k| ((k * 300) % 65_536) as f64, 1.0).expect("no wrap");
        assert!(drive.told.is_empty());
        let start = 50_000;
        let wrapped = straight(WheelData::Counter, |k| ((start + k * 300) % 65_536) as f64, 1.0).expect("a wrap");
        assert_eq!(wrapped.turns, drive.turns);
        assert!(wrapped.told[0].contains("wraps around at 65536 1 times"), "{:?}", wrapped.told);
        // Set to zero at 50: the step in between is the one before.
        let reset =
            straight(WheelData::Counter, |k| (if k < 50 { k } else { k - 50 } * 300) as f64, 1.0).expect("a reset");
        assert_eq!(reset.turns, drive.turns);
        assert!(reset.told[0].contains("begins anew at 0 1 times"), "{:?}", reset.told);
        let counts = straight(WheelData::Counts, |_| 300.0, 1.0).expect("counts");
        assert_eq!(counts.turns[1..], drive.turns[1..]);
    }

    #[test]
    fn a_pose_in_millimetres_is_told_and_a_nonsense_one_refused() {
        let drive = straight(WheelData::Counts, |_| 300.0, 1000.0).expect("millimetres");
        assert!(drive.told[0].contains("millimetres"), "{:?}", drive.told);
        let length = drive.pose[99][0];
        approx::assert_relative_eq!(length, std::f64::consts::TAU * 0.05 * 0.3 * 99.0, epsilon = 1e-9);
        assert!(straight(WheelData::Counts, |_| 300.0, 1e6).unwrap_err().to_string().contains("state its unit"));
    }

    #[test]
    fn counts_without_counts_per_turn_are_refused_by_wheel() {
        let robot = robot().with_wheels(|_, w| crate::Wheel { counts_per_turn: None, ..w });
        let time: Vec<f64> = (0..100).map(|k| 0.1 * f64::from(k)).collect();
        let column = vec![1.0; 100];
        let refused =
            Drive::new("a", &robot, time, (WheelData::Counts, &[column.clone(), column]), None, vec![[0.0; 3]; 100]);
        assert!(
            refused
                .unwrap_err()
                .to_string()
                .contains("wheel 'left': counts are recorded, but counts_per_turn is missing")
        );
    }
}
