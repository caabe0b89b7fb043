//! Values that no robot of the file can show: told before anything is diagnosed, with the unit that would explain them.

use recordings::{Channel, Recording, Signal, Unit, parse_unit};
use robot_model::Robot;

use crate::columns::{OF_THEIR_OWN, consistent};
use crate::settings::{Possible, SETTINGS};
use inference::DiagnosisError;
use inference::robust::{median, rms};

const POSSIBLE: Possible = SETTINGS.possible;

/// Standard acceleration of free fall, m/s² (CGPM 1901).
const GRAVITY: f64 = 9.806_65;

/// A recording of which what cannot be was left out, and a sentence on each channel that lost samples. Currents are judged
/// by the torque at the wheels that they give, N m/A, where it is known.
///
/// # Errors
/// When more than a few samples of a channel cannot be, or a channel as a whole contradicts the wheels or gravity: its
/// unit is wrong, or the robot file is of another robot.
pub fn possible(
    recording: Recording,
    robot: &Robot<f64>,
    torque_per_current: Option<f64>,
) -> Result<(Recording, Vec<String>), DiagnosisError> {
    let mut told = Vec::new();
    let mut channels = Vec::new();
    for channel in recording.channels() {
        let bound = Bound::of(channel, robot, torque_per_current);
        let inside = bound.as_ref().map_or(channel.len(), |b| channel.samples().filter(|s| b.holds(s.1)).count());
        let outside = channel.len() - inside;
        if let (Some(bound), 1..) = (&bound, outside) {
            if outside as f64 > POSSIBLE.spikes * channel.len() as f64 {
                return Err(bound.refusal(&recording, channel, outside));
            }
            told.push(bound.left_out(&recording, channel, outside));
            channels.push(bound.inside(channel)?);
        } else {
            channels.push(channel.clone());
        }
    }
    if !told.is_empty() {
        let clocks = recording.clocks().to_vec();
        let name = recording.name().to_owned();
        let kept = Recording::new(name, clocks, channels).map_err(|e| unusable(&recording, e.to_string()))?;
        told.extend(contradictions(&kept, robot)?);
        return Ok((kept, told));
    }
    told.extend(contradictions(&recording, robot)?);
    Ok((recording, told))
}

fn unusable(recording: &Recording, what: String) -> DiagnosisError {
    DiagnosisError::Impossible { recording: recording.name().to_owned(), what }
}

/// What the values of a channel can be at most.
struct Bound {
    /// Values lie this far around [`Self::middle`] at most, in the channel's unit.
    largest: f64,
    middle: f64,
    /// Why not more.
    because: String,
}

impl Bound {
    fn of(channel: &Channel, robot: &Robot<f64>, torque_per_current: Option<f64>) -> Option<Self> {
        let span = channel.span_ns().map_or(0, |(from, to)| to - from) as f64 * 1e-9;
        let speed = POSSIBLE.fastest;
        let wheel = speed / robot.wheel_radius;
        let around = |largest: f64, because: String| {
            let middle = median(channel.values().iter().copied()).unwrap_or_default();
            Some(Self { largest, middle, because })
        };
        let at_most = |largest: f64, because: String| Some(Self { largest, middle: 0.0, because });
        let fastest = format!("a robot on wheels drives {speed} m/s at most");
        match channel.signal() {
            Signal::WheelAngleLeft | Signal::WheelAngleRight => around(wheel * (span + 1.0), fastest),
            Signal::PoseX | Signal::PoseY => around(speed * (span + 1.0), fastest),
            Signal::PoseYaw => around(
                POSSIBLE.fastest_turn * (span + 1.0),
                format!("a robot on wheels turns at {} rad/s at most", POSSIBLE.fastest_turn),
            ),
            signal => match signal.unit() {
                Unit::RadianPerSecond if is_wheel(signal) => at_most(wheel, fastest),
                Unit::RadianPerSecond => at_most(
                    POSSIBLE.fastest_turn,
                    format!("a robot on wheels turns at {} rad/s at most", POSSIBLE.fastest_turn),
                ),
                Unit::MetrePerSecond => at_most(speed, fastest),
                Unit::MetrePerSecondSquared => at_most(
                    POSSIBLE.hardest_hit,
                    format!("accelerometers of robots end at {} m/s² or before", POSSIBLE.hardest_hit),
                ),
                Unit::NewtonMetre => {
                    let holds = robot.mass * GRAVITY * robot.wheel_radius;
                    at_most(
                        POSSIBLE.torque * holds,
                        format!(
                            "{:.3} N m, the weight times the wheels' radius, are as much as tyres hold, and this is more \
                             than {} times that",
                            holds, POSSIBLE.torque
                        ),
                    )
                }
                Unit::Ampere => {
                    let per_current = torque_per_current.filter(|k| *k > 0.0)?;
                    let holds = robot.mass * GRAVITY * robot.wheel_radius;
                    at_most(
                        POSSIBLE.torque * holds / per_current,
                        format!(
                            "with {per_current} N m/A (torque_per_current in the robot file) it would be more than {} times \
                             {holds:.3} N m, the weight times the wheels' radius, which is as much as tyres hold",
                            POSSIBLE.torque
                        ),
                    )
                }
                _ => None,
            },
        }
    }

    fn holds(&self, value: f64) -> bool {
        (value - self.middle).abs() <= self.largest
    }

    /// The channel without what cannot be.
    fn inside(&self, channel: &Channel) -> Result<Channel, DiagnosisError> {
        let (t_ns, values) = channel.samples().filter(|s| self.holds(s.1)).unzip();
        Channel::new(channel.signal(), channel.clock(), t_ns, values)
            .map(|kept| kept.with_attributes(channel.attributes()).with_column(channel.column()))
            .map_err(|e| DiagnosisError::Impossible { recording: channel.name().to_owned(), what: e.to_string() })
    }

    fn left_out(&self, recording: &Recording, channel: &Channel, outside: usize) -> String {
        format!(
            "recording '{}': {outside} of {} samples of {} (column '{}') were left out: {}",
            recording.name(),
            channel.len(),
            channel.name(),
            channel.column(),
            self.because
        )
    }

    fn refusal(&self, recording: &Recording, channel: &Channel, outside: usize) -> DiagnosisError {
        let unit = channel.unit();
        let worst = channel.values().iter().map(|v| (v - self.middle).abs()).fold(0.0, f64::max);
        let units = explaining(unit, |factor| worst * factor <= self.largest);
        let worst = if worst < POSSIBLE.readable { format!("{worst:.4}") } else { format!("{worst:.3e}") };
        let what = format!(
            "{outside} of {} samples of {} (column '{}') cannot be, the largest is {worst} {unit}: {}; {}",
            channel.len(),
            channel.name(),
            channel.column(),
            self.because,
            remedy(&units, "correct the recording or the robot file")
        );
        unusable(recording, what)
    }
}

fn is_wheel(signal: Signal) -> bool {
    matches!(
        signal,
        Signal::WheelSpeedLeft | Signal::WheelSpeedRight | Signal::CommandSpeedLeft | Signal::CommandSpeedRight
    )
}

/// Units smaller than `unit` that would make a value possible, by the factor to `unit`.
fn explaining(unit: Unit, possible: impl Fn(f64) -> bool) -> Vec<&'static str> {
    const SMALLER: [&str; 12] =
        ["deg/s", "rpm", "mrad/s", "deg", "mrad", "mm", "cm", "mm/s", "km/h", "mm/s2", "mNm", "mA"];
    let of_unit = |name: &&str| parse_unit(name).is_some_and(|s| s.unit == unit && possible(s.factor));
    SMALLER.into_iter().filter(of_unit).collect()
}

/// What to do about a column whose unit is wrong.
fn remedy(units: &[&str], otherwise: &str) -> String {
    match units {
        [] => otherwise.to_owned(),
        units => {
            let named: Vec<String> = units.iter().map(|u| format!("`unit = \"{u}\"`")).collect();
            format!(
                "in {} it could be: if so, write {} for this column in the mapping",
                units.join(" or "),
                named.join(" or ")
            )
        }
    }
}

/// Refuses channels that as a whole contradict the wheels or gravity by so much that no fault of a sensor explains it.
/// A sentence on an accelerometer that is no level, though the rest can be used.
fn contradictions(recording: &Recording, robot: &Robot<f64>) -> Result<Option<String>, DiagnosisError> {
    if let Some([drive, turn]) = wheel_motion(recording, robot) {
        let moved = |signal: Signal| recording.get(signal).and_then(Moved::of);
        let gyro = recording.get(Signal::GyroZ).and_then(|c| rms(c.values().iter().copied()));
        let yaw = moved(Signal::PoseYaw).map(|m| m.median);
        let along = moved(Signal::PoseX).zip(moved(Signal::PoseY)).map(|(x, y)| x.median.hypot(y.median));
        let compared = [
            (Signal::GyroZ, gyro, turn, "rad/s", "turn"),
            (Signal::PoseYaw, yaw, turn, "rad/s", "turn"),
            (Signal::PoseX, along, drive, "m/s", "move"),
        ];
        for (signal, shown, wheels, unit, verb) in compared {
            let (Some(shown), Some(channel)) = (shown, recording.get(signal)) else { continue };
            let limit = POSSIBLE.beyond_wheels * (wheels + if verb == "turn" { POSSIBLE.turn } else { POSSIBLE.drive });
            if shown > limit {
                let units = explaining(channel.unit(), |factor| shown * factor <= limit);
                let what = format!(
                    "by {signal} (column '{}') the robot would {verb} at {shown:.4} {unit} (typical value of this \
                     recording), but its wheels {verb} it at {wheels:.4} {unit}; {}",
                    channel.column(),
                    remedy(&units, "correct wheel_radius and track in the robot file, or the recording")
                );
                return Err(unusable(recording, what));
            }
        }
    }
    // A sensor that hangs upside down also turns to the other side than the wheels: first what explains both.
    let told = gravity(recording)?;
    consistent(recording, robot)?;
    Ok(told)
}

/// Typical speed (m/s) and yaw rate (rad/s, root mean square) that the wheels give the body if they roll.
fn wheel_motion(recording: &Recording, robot: &Robot<f64>) -> Option<[f64; 2]> {
    let speeds = |[speed, angle, command]: [Signal; 3]| -> Option<Vec<(i64, f64)>> {
        let by_angle = || Some(Moved::of(recording.get(angle)?)?.rates);
        let of = |signal: Signal| recording.get(signal).map(|channel| channel.samples().collect());
        of(speed).or_else(by_angle).or_else(|| of(command))
    };
    let left = speeds([Signal::WheelSpeedLeft, Signal::WheelAngleLeft, Signal::CommandSpeedLeft])?;
    let right = speeds([Signal::WheelSpeedRight, Signal::WheelAngleRight, Signal::CommandSpeedRight])?;
    // Each sample of the left side with the next of the right one.
    let mut later = right.iter().peekable();
    let both: Vec<[f64; 2]> = left
        .iter()
        .map_while(|&(t, left)| {
            while later.next_if(|r| r.0 < t).is_some() {}
            later.peek().map(|right| [left, right.1])
        })
        .collect();
    let r = robot.wheel_radius;
    let drive = rms(both.iter().map(|[left, right]| 0.5 * r * (left.abs() + right.abs())))?;
    let turn = rms(both.iter().map(|[left, right]| r * (right - left) / (2.0 * robot.half_track)))?;
    Some([drive, turn])
}

/// How far a channel moved within a fixed time, per second.
struct Moved {
    rates: Vec<(i64, f64)>,
    /// Median of their sizes.
    median: f64,
}

impl Moved {
    fn of(channel: &Channel) -> Option<Self> {
        let lag = (POSSIBLE.lag * 1e9) as i64;
        let (t, v) = (channel.t_ns(), channel.values());
        let mut later = 0;
        let mut rates = Vec::new();
        for i in 0..t.len() {
            while later < t.len() && t[later] - t[i] < lag {
                later += 1;
            }
            if later == t.len() {
                break;
            }
            rates.push((t[i], (v[later] - v[i]) / ((t[later] - t[i]) as f64 * 1e-9)));
        }
        let median = median(rates.iter().map(|r| r.1.abs()))?;
        Some(Self { rates, median })
    }
}

/// Refuses an inertial sensor that is not mounted as the mapping says: its yaw rate is none. A sentence on one that shows
/// no gravity for other reasons.
fn gravity(recording: &Recording) -> Result<Option<String>, DiagnosisError> {
    let typical = |signal: Signal| {
        let channel = recording.get(signal)?;
        Some((channel, median(channel.values().iter().copied())?))
    };
    let Some((up, shown)) = typical(Signal::AccelZ) else { return Ok(None) };
    let is_gravity = |a: f64| (a.abs() / GRAVITY).ln().abs() < POSSIBLE.gravity.ln();
    if shown > 0.0 && is_gravity(shown) {
        return Ok(None);
    }
    let shows = format!(
        "accel_z (column '{}') is {shown:.4} m/s² in the middle, but an upward accelerometer of a robot on the ground \
         shows about {GRAVITY:.2}",
        up.column()
    );
    if is_gravity(shown) {
        let what = format!(
            "{shows}: the inertial sensor hangs upside down; write `sign = -1` for accel_z, gyro_z and one of accel_x and \
             accel_y in the mapping (which of the two depends on the axis that it was turned about){OF_THEIR_OWN}"
        );
        return Err(unusable(recording, what));
    }
    let aside = [Signal::AccelX, Signal::AccelY].into_iter().filter_map(typical).find(|(_, a)| is_gravity(*a));
    if let Some((channel, a)) = aside {
        let sign = if a < 0.0 { " with `sign = -1`" } else { "" };
        let what = format!(
            "{shows}, and {} (column '{}') shows that instead: the inertial sensor is mounted on its side; in the mapping, \
             read accel_z from that column{sign}, and gyro_z from the gyro of the same axis{sign}",
            channel.name(),
            channel.column()
        );
        return Err(unusable(recording, what));
    }
    let guess = if is_gravity(shown * GRAVITY) {
        "it may be in g: if so, write `unit = \"g\"` for all accelerations in the mapping"
    } else if is_gravity(shown / GRAVITY) {
        "it may be in m/s² already: if so, write `unit = \"m/s2\"` for all accelerations in the mapping"
    } else {
        "its unit or scale is not what the mapping says, or gravity was taken off: correct the mapping, or leave the \
         accelerations out of it"
    };
    Ok(Some(format!("recording '{}': {shows}; {guess}", recording.name())))
}

#[cfg(test)]
mod tests;
