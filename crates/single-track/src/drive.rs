//! A drive: commands, pose and what the car reports, brought to one grid of steps.

use crate::car::Car;
use crate::model::STEP;
use crate::settings::{Grid, SETTINGS};
use hierarchical_fit::CaseError as CarError;
use inference::robust::{median, quantile, sorted};
use odometry::held::Command;
use odometry::pose_jumps::without_jumps;
use odometry::rates::on_grid;

const RULES: Grid = SETTINGS.grid;

/// Columns of a recording; channels that are not there are empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Columns {
    /// Time of each row, s.
    pub time: Vec<f64>,
    /// Measured x, y, m, and yaw, rad; NaN where it was not seen.
    pub pose: Vec<[f64; 3]>,
    /// Throttle, −1 to 1.
    pub throttle: Vec<f64>,
    /// Steering command, −1 to 1, positive to the left.
    pub steering: Vec<f64>,
    /// Whether the throttle is passed on, 0 or 1.
    pub enabled: Vec<f64>,
    /// Clock of the car's channels where they are held between its messages, s; 0 before the first.
    pub car_time: Vec<f64>,
    /// Yaw rate, rad/s.
    pub gyro: Vec<f64>,
    /// Speed by the encoder, m/s.
    pub encoder: Vec<f64>,
}

/// What the car reported at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Message {
    /// s from the start of the drive.
    pub(crate) time: f64,
    pub(crate) gyro: Option<f64>,
    pub(crate) encoder: Option<f64>,
}

/// A drive of a car on the grid of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// Its name in messages.
    pub name: String,
    pub(crate) steering: Command,
    pub(crate) throttle: Command,
    /// Pose at the beginning of each step; NaN where it was not seen. Empty of a drive without pose.
    pub(crate) pose: Vec<[f64; 3]>,
    pub(crate) messages: Vec<Message>,
    steps: usize,
    /// Time of the first row, s.
    pub(crate) start: f64,
    /// What was done to it before the comparison, for people.
    pub told: Vec<String>,
}

impl Drive {
    /// A drive from its columns.
    ///
    /// # Errors
    /// Columns that are missing or of unlike length, time that does not rise, commands out of range, a drive that has neither
    /// pose nor both gyro and encoder, channels that contradict each other by the factor of a unit or by a sign.
    pub fn new(name: &str, table: &Columns) -> Result<Self, CarError> {
        if !has_pose(table) && (table.gyro.is_empty() || table.encoder.is_empty()) {
            let what = "there is neither a pose nor both a gyro and an encoder speed; map one of them".to_owned();
            return Err(CarError::Drive { drive: name.to_owned(), what });
        }
        let drive = Self::held_out(name, table)?;
        match crate::units::mistaken(table) {
            Some(what) => Err(CarError::Drive { drive: name.to_owned(), what }),
            None => Ok(drive),
        }
    }

    /// A drive of a car that turns about as its steering and its wheelbase say.
    ///
    /// # Errors
    /// As [`Drive::new`], and one that turns the other way, or by the factor of a unit less or more.
    pub fn of_car(name: &str, table: &Columns, car: &Car) -> Result<Self, CarError> {
        let drive = Self::new(name, table)?;
        match crate::units::mistaken_by_steering(table, car) {
            Some(what) => Err(CarError::Drive { drive: name.to_owned(), what }),
            None => Ok(drive),
        }
    }

    /// A drive whose pose is to be predicted, with or without a pose to begin at.
    ///
    /// # Errors
    /// As [`Drive::new`], but for what was not measured.
    pub fn held_out(name: &str, table: &Columns) -> Result<Self, CarError> {
        let wrong = |what: String| CarError::Drive { drive: name.to_owned(), what };
        let rows = table.time.len();
        if rows < RULES.rows {
            return Err(wrong(format!("{rows} rows, but at least {} are needed; record longer", RULES.rows)));
        }
        let given = [&table.throttle, &table.steering, &table.enabled, &table.car_time, &table.gyro, &table.encoder];
        let lengths = given.iter().map(|c| c.len()).chain([table.pose.len()]);
        if let Some(other) = { lengths }.find(|n| *n != rows && *n != 0) {
            return Err(wrong(format!("a column of {other} rows beside {rows} rows of time")));
        }
        if table.throttle.is_empty() || table.steering.is_empty() {
            return Err(wrong("throttle or steering command is missing; map both under [columns]".to_owned()));
        }
        if let Some(row) =
            (1..rows).find(|&k| table.time[k].partial_cmp(&table.time[k - 1]) != Some(std::cmp::Ordering::Greater))
        {
            return Err(wrong(format!(
                "time does not rise in row {}; sort the rows, or remove repeated ones",
                row + 1
            )));
        }
        let apart = median(table.time.windows(2).map(|t| t[1] - t[0])).unwrap_or(0.0);
        if apart > RULES.apart {
            return Err(wrong(format!(
                "its rows are {apart:.0} s apart, at most {} can be compared; if the time is in another unit, state it under \
                 [columns]: time_unit = \"ms\" (or us, ns)",
                RULES.apart
            )));
        }
        for (what, column) in [("throttle", &table.throttle), ("steering command", &table.steering)] {
            if let Some(row) = column.iter().position(|u| u.is_nan() || u.abs() > 1.0 + RULES.command) {
                return Err(wrong(format!(
                    "row {}: {what} is {}, beyond ±1; state its range in [columns], or cut the drive there",
                    row + 1,
                    column[row]
                )));
            }
        }
        let start = table.time[0];
        let steps = ((table.time[rows - 1] - start) / STEP) as usize;
        let mut told = Vec::new();
        let reported = messages(table, start, &mut told, name);
        let Some(first) = reported.first() else {
            return Err(wrong("the car's clock is zero throughout; the car sent nothing".to_owned()));
        };
        if first.1 > 0 {
            told.push(format!(
                "recording '{name}': the car's first message is in row {}; before it, its channels are taken as not there",
                first.1 + 1
            ));
        }
        let times: Vec<f64> = reported.iter().map(|m| m.0).collect();
        let command = |column: &[f64], enabled: &[f64]| {
            let value = |&(_, row): &(f64, usize)| {
                column[row] * enabled.get(row).map_or(1.0, |e| f64::from(u8::from(*e > 0.5)))
            };
            Command::held((&times, &reported.iter().map(value).collect::<Vec<f64>>()), steps, STEP)
        };
        let cell = |column: &[f64], row: usize| column.get(row).copied().filter(|x| x.is_finite());
        let messages = reported
            .iter()
            .map(|&(time, row)| Message { time, gyro: cell(&table.gyro, row), encoder: cell(&table.encoder, row) })
            .collect();
        let mut pose = table.pose.clone();
        told.extend(without_jumps(&table.time, &mut pose).map(|what| format!("recording '{name}': {what}")));
        let seen = table.time.iter().zip(pose).map(|(time, pose)| (time - start, pose));
        Ok(Self {
            name: name.to_owned(),
            steering: command(&table.steering, &[]),
            throttle: command(&table.throttle, &table.enabled),
            pose: if has_pose(table) { on_grid(seen, steps, STEP, RULES.gap) } else { Vec::new() },
            messages,
            steps,
            start,
            told,
        })
    }

    /// From its first row to its last, s.
    pub fn duration(&self) -> f64 {
        STEP * self.steps as f64
    }

    /// Brings the car's channels to the pose's clock, which the car's is behind by `offset + rate t`.
    pub(crate) fn set_clock(&mut self, [offset, rate]: [f64; 2]) {
        let pace = 1.0 - rate;
        self.steering = self.steering.retimed(-offset, pace);
        self.throttle = self.throttle.retimed(-offset, pace);
        for message in &mut self.messages {
            message.time = (message.time + offset) / pace;
        }
    }

    /// The same by a clock that was measured, with a sentence on it; the pose is taken as not seen where the car sent nothing.
    pub(crate) fn correct_clock(&mut self, clock: [f64; 2]) {
        let [offset, rate] = clock;
        self.set_clock(clock);
        let ends = [self.messages.first(), self.messages.last()].map(|m| m.map_or(0.0, |m| m.time));
        for (step, pose) in self.pose.iter_mut().enumerate() {
            let time = STEP * step as f64;
            if time < ends[0] || time > ends[1] {
                *pose = [f64::NAN; 3];
            }
        }
        self.told.push(format!(
            "recording '{}': by gyro and encoder beside the pose the car's channels are {:.2} s {} at the start and their clock is {:.2} % \
             {}; they were brought to the pose's clock before the comparison",
            self.name,
            offset.abs(),
            if offset < 0.0 { "late" } else { "early" },
            100.0 * rate.abs(),
            if rate < 0.0 { "fast" } else { "slow" }
        ));
    }

    /// Steps of the grid.
    pub(crate) fn steps(&self) -> usize {
        self.steps
    }

    /// Whether its pose was measured.
    pub fn has_pose(&self) -> bool {
        !self.pose.is_empty()
    }
}

/// Whether a pose was seen in any row.
fn has_pose(table: &Columns) -> bool {
    table.pose.iter().any(|p| p.iter().all(|x| x.is_finite()))
}

/// Instants of the car's messages, s from the start, with the row in which each arrived.
fn messages(table: &Columns, start: f64, told: &mut Vec<String>, name: &str) -> Vec<(f64, usize)> {
    let rows = table.time.len();
    if table.car_time.is_empty() {
        return (0..rows).map(|row| (table.time[row] - start, row)).collect();
    }
    let fresh = |row: usize| table.car_time[row] > 0.0 && (row == 0 || table.car_time[row] != table.car_time[row - 1]);
    let arrived: Vec<usize> = (0..rows).filter(|&row| fresh(row)).collect();
    let behind = sorted(arrived.iter().map(|&row| table.time[row] - table.car_time[row]));
    let Some(offset) = quantile(&behind, 0.5) else { return Vec::new() };
    let between = median(arrived.windows(2).map(|w| table.time[w[1]] - table.time[w[0]])).unwrap_or(0.0);
    let row_every = (table.time[rows - 1] - start) / (rows - 1) as f64;
    if between > 2.0 * row_every {
        told.push(format!(
            "recording '{name}': the car reports every {between:.3} s in a table of a row every {row_every:.3} s; values are \
             taken at the instants of its own clock"
        ));
    }
    // The car's own clock is free of the jitter of transport, unless it jumps.
    let instant = |row: usize| {
        let own = table.car_time[row] + offset;
        if (own - table.time[row]).abs() <= between { own } else { table.time[row] }
    };
    arrived.into_iter().map(|row| (instant(row) - start, row)).collect()
}
