//! How long reading CSV takes: `cargo run --release -p recordings --example read_csv -- --rows 100000`.
//!
//! Fifteen columns as a recorder writes them: time with three decimals, fourteen signals with six. Prints the time on a
//! processor from bytes to a recording in SI, everything that reading checks included.

use std::error::Error;
use std::fmt::Write;

use recordings::{Input, Mapping, ReadOptions, read};

#[path = "../../../benches/shared/clock.rs"]
mod clock;

/// The columns behind time, of the built-in mapping `lacuna`.
const COLUMNS: [&str; 14] = [
    "wheel_speed_left_rad_s",
    "wheel_speed_right_rad_s",
    "wheel_angle_left_rad",
    "wheel_angle_right_rad",
    "torque_left_Nm",
    "torque_right_Nm",
    "gyro_x_rad_s",
    "gyro_y_rad_s",
    "gyro_z_rad_s",
    "accel_x_m_s2",
    "accel_y_m_s2",
    "accel_z_m_s2",
    "pose_x_m",
    "pose_y_m",
];

/// A recording as text.
fn text(rows: usize) -> Result<String, std::fmt::Error> {
    let mut text = format!("time_s,{}\n", COLUMNS.join(","));
    let mut number: u32 = 1;
    for i in 0..rows {
        write!(text, "{:.3}", i as f64 * 1e-3)?;
        for _ in COLUMNS {
            // Any digits will do: a congruential generator's.
            number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            write!(text, ",{:.6}", (f64::from(number) / f64::from(u32::MAX) - 0.5) * 20.0)?;
        }
        text.push('\n');
    }
    Ok(text)
}

fn main() -> Result<(), Box<dyn Error>> {
    let rows = clock::option("--rows", 100_000)?;
    let rounds = clock::option("--rounds", 5)?;
    let mapping = Mapping::built_in("lacuna")?;
    let text = text(rows)?;
    let input = [Input { name: "drive.csv", bytes: text.as_bytes() }];
    let (seconds, run) = clock::timed(rounds, || read(&mapping, "drive", &input, &ReadOptions::default()));
    let run = run?;
    let channels = run.recording.channels().len();
    println!(
        "parse.lacuna {:.1} ns/row   {:.0} MB/s, {rows} rows, {channels} channels, {} losses",
        1e9 * seconds / rows as f64,
        1e-6 * text.len() as f64 / seconds,
        run.losses.len()
    );
    Ok(())
}
