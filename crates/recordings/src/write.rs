//! A recording as CSV with self-describing columns, as the mappings `skid-steer-columns` and `lacuna` read them.

use std::fmt::Write as _;

use crate::channel::{Attributes, Channel};
use crate::recording::Recording;
use crate::units::Unit;

/// The channels on one clock of a recording as CSV text in SI: `time_s`, then one column per channel such as
/// `gyro_z_rad_s`; a row per instant at which any of them has a sample, an empty cell where one has none.
///
/// Stamps are written exactly and values so that they read back to the same bits. Attributes and the clock's name have
/// no place in CSV: the mapping that reads the file says them anew, and [`lost_in_csv`] tells where it will say others.
///
/// ```
/// use recordings::{Channel, Clock, Recording, Signal, write_csv};
/// let gyro = Channel::new(Signal::GyroZ, 0, vec![0, 10_000_000], vec![0.5, -0.25])?;
/// let clock = Clock { name: "imu".to_owned(), nominal_rate_hz: None };
/// let run = Recording::new("run", vec![clock], vec![gyro])?;
/// assert_eq!(write_csv(&run, 0), "time_s,gyro_z_rad_s\n0.000000000,0.5\n0.010000000,-0.25\n");
/// # Ok::<(), recordings::RecordingError>(())
/// ```
pub fn write_csv(recording: &Recording, clock: usize) -> String {
    let channels: Vec<&Channel> = recording.channels().iter().filter(|channel| channel.clock() == clock).collect();
    let mut stamps: Vec<i64> = channels.iter().flat_map(|channel| channel.t_ns()).copied().collect();
    stamps.sort_unstable();
    stamps.dedup();

    let mut text = String::from("time_s");
    for channel in &channels {
        text.push(',');
        text.push_str(&channel.signal().column_name());
    }
    text.push('\n');
    let mut next = vec![0; channels.len()];
    for t_ns in stamps {
        let (sign, ns) = (if t_ns < 0 { "-" } else { "" }, t_ns.unsigned_abs());
        // Writing to a string cannot fail.
        let _ = write!(text, "{sign}{}.{:09}", ns / 1_000_000_000, ns % 1_000_000_000);
        for (channel, next) in channels.iter().zip(&mut next) {
            text.push(',');
            if channel.t_ns().get(*next) == Some(&t_ns) {
                let _ = write!(text, "{:?}", channel.values()[*next]);
                *next += 1;
            }
        }
        text.push('\n');
    }
    text
}

/// The attributes that a recording loses on its way through CSV and the mapping `lacuna`, in sentences.
///
/// ```
/// use recordings::{Attributes, Channel, Clock, Recording, Signal, lost_in_csv};
/// let attributes = Attributes { magnitude_only: true, dead_band: Some(0.59), set_point: false };
/// let current = Channel::new(Signal::CurrentLeft, 0, vec![0], vec![1.5])?.with_attributes(attributes);
/// let clock = Clock { name: "drives".to_owned(), nominal_rate_hz: None };
/// let run = Recording::new("run", vec![clock], vec![current])?;
/// assert_eq!(lost_in_csv(&run), ["current_left: magnitude_only, dead_band = 0.59 A"]);
/// # Ok::<(), recordings::RecordingError>(())
/// ```
pub fn lost_in_csv(recording: &Recording) -> Vec<String> {
    let lost = |channel: &Channel| {
        let Attributes { magnitude_only, dead_band, set_point } = channel.attributes();
        // As the mapping has it: torques are what the drive is told.
        let read_as_set_point = channel.signal().is_set_point() || channel.unit() == Unit::NewtonMetre;
        let mut lost = Vec::new();
        lost.extend(magnitude_only.then(|| "magnitude_only".to_owned()));
        lost.extend(dead_band.map(|width| format!("dead_band = {width} {}", channel.unit().symbol())));
        let kind = if set_point { "set-point" } else { "measured" };
        lost.extend((set_point != read_as_set_point).then(|| format!("kind = {kind}")));
        (!lost.is_empty()).then(|| format!("{}: {}", channel.name(), lost.join(", ")))
    };
    recording.channels().iter().filter_map(lost).collect()
}
