//! The DRIVE data set (norlab-ulaval/DRIVE, BSD-3-Clause, arXiv 2309.10718) as neutral recordings.
//!
//! The source is a table of windows of 2 s, each with a pose that begins at zero. A chain of windows that follow one
//! another without a break becomes one recording:
//! * A chain breaks where the wheel speed jumps at a window's border by more than it ever does inside a window.
//! * The pose is chained: inside a window it is the source's own, moved rigidly. The sample interval between two windows
//!   was not recorded in any frame; it is bridged by the mean motion of the half second before it. That is a guess: who
//!   compares motion must not do so over a multiple of 2 s from the recording's start, and the diagnosis does not.
//! * Windows before `share` of all go to `recordings/`, the others to `heldout/`; a chain across is cut there.

use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use serde::Deserialize;

/// Sample interval, s.
pub(super) const STEP: f64 = 0.05;
/// Samples of a window.
pub(super) const WINDOW: usize = 40;
/// Samples whose mean motion bridges the border of two windows: half a second.
const BRIDGE: usize = 10;

/// The mapping with which `lacuna diagnose` reads what is written here.
pub(crate) const MAPPING: &str = r#"# DRIVE (norlab-ulaval/DRIVE) as laid out by `cargo xtask evidence`: one uninterrupted chain of windows per file.
# * command_speed is what was sent, before the controller's own limits; wheel_speed is sample-held by the source.
# * The pose is exact within windows of 2 s from the file's start and bridged by the motion before between them.
name = "drive"

[[files]]
pattern = "*.csv"
time = { column = "time_s", unit = "s", rate_hz = 20.0 }

[files.signals]
command_speed_left = { column = "command_speed_left_rad_s", unit = "rad/s", kind = "set-point" }
command_speed_right = { column = "command_speed_right_rad_s", unit = "rad/s", kind = "set-point" }
wheel_speed_left = { column = "wheel_speed_left_rad_s", unit = "rad/s" }
wheel_speed_right = { column = "wheel_speed_right_rad_s", unit = "rad/s" }
pose_x = { column = "pose_x_m", unit = "m" }
pose_y = { column = "pose_y_m", unit = "m" }
pose_yaw = { column = "pose_yaw_rad", unit = "rad" }
gyro_z = { column = "gyro_z_rad_s", unit = "rad/s" }
"#;

const HEADER: &str = "time_s,command_speed_left_rad_s,command_speed_right_rad_s,wheel_speed_left_rad_s,\
wheel_speed_right_rad_s,pose_x_m,pose_y_m,pose_yaw_rad,gyro_z_rad_s\n";

/// A sample of the source.
#[derive(Debug, Clone, Deserialize)]
struct Sample {
    window: usize,
    cmd_left: f64,
    cmd_right: f64,
    wheel_left: f64,
    wheel_right: f64,
    icp_x: f64,
    icp_y: f64,
    icp_dyaw: f64,
    imu_yaw_rate: f64,
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// Windows in `recordings/` and in `heldout/`.
    pub windows: [usize; 2],
    /// Files in each.
    pub files: [usize; 2],
    /// The mapping.
    pub mapping: PathBuf,
}

/// Lays out one robot's table below `folder`; the first `share` of its windows is for training.
///
/// # Errors
/// A table that cannot be read or holds incomplete windows, a folder that cannot be written.
pub fn lay_out(table: &Path, folder: &Path, share: f64) -> Result<Written> {
    let shown = table.display();
    let file = File::open(table).with_context(|| format!("cannot open '{shown}'; it comes from the DRIVE data set"))?;
    let windows = read(file).with_context(|| format!("in '{shown}'"))?;
    let training = (share * windows.len() as f64).floor() as usize;
    let chains = chains(&windows, training);
    let mut written = Written { windows: [0; 2], files: [0; 2], mapping: folder.join("drive.toml") };
    for (part, name) in ["recordings", "heldout"].into_iter().enumerate() {
        fs::create_dir_all(folder.join(name)).with_context(|| format!("cannot create '{}'", folder.display()))?;
        for chain in chains.iter().filter(|c| usize::from(c[0] >= training) == part) {
            let path = folder.join(name).join(format!("chain_{:03}.csv", chain[0]));
            let of_chain: Vec<&[Sample]> = chain.iter().map(|&w| windows[w].as_slice()).collect();
            fs::write(&path, csv(&of_chain)).with_context(|| format!("cannot write '{}'", path.display()))?;
            written.windows[part] += chain.len();
            written.files[part] += 1;
        }
    }
    fs::write(&written.mapping, MAPPING).with_context(|| format!("cannot write '{}'", written.mapping.display()))?;
    Ok(written)
}

/// Windows of a table, each of 40 samples.
fn read(source: impl Read) -> Result<Vec<Vec<Sample>>> {
    let mut windows: Vec<Vec<Sample>> = Vec::new();
    for (line, sample) in csv::Reader::from_reader(source).deserialize::<Sample>().enumerate() {
        let sample = sample.with_context(|| format!("line {}", line + 2))?;
        match windows.last_mut() {
            Some(w) if w[0].window == sample.window => w.push(sample),
            _ => windows.push(vec![sample]),
        }
    }
    for w in &windows {
        ensure!(w.len() == WINDOW, "window {} has {} samples, not {WINDOW}", w[0].window, w.len());
    }
    ensure!(!windows.is_empty(), "the table holds no window");
    Ok(windows)
}

fn jump(a: &Sample, b: &Sample) -> f64 {
    (b.wheel_left - a.wheel_left).abs().max((b.wheel_right - a.wheel_right).abs())
}

/// Windows that follow one another; also cut before window number `training`.
fn chains(windows: &[Vec<Sample>], training: usize) -> Vec<Vec<usize>> {
    let usual = windows.iter().flat_map(|w| w.windows(2)).map(|p| jump(&p[0], &p[1])).fold(0.0, f64::max);
    let mut out: Vec<Vec<usize>> = Vec::new();
    for i in 0..windows.len() {
        let follows = i > 0
            && i != training
            && windows[i][0].window == windows[i - 1][0].window + 1
            && jump(&windows[i - 1][WINDOW - 1], &windows[i][0]) <= usual;
        match out.last_mut() {
            Some(chain) if follows => chain.push(i),
            _ => out.push(vec![i]),
        }
    }
    out
}

/// A pose in the plane: x, y (m), heading (rad).
type Pose = [f64; 3];

/// `b`, which is given in the frame of `a`.
fn compose(a: Pose, b: Pose) -> Pose {
    let (sin, cos) = a[2].sin_cos();
    [a[0] + cos * b[0] - sin * b[1], a[1] + sin * b[0] + cos * b[1], a[2] + b[2]]
}

/// `b` in the frame of `a`, both given in one frame.
fn relative(a: Pose, b: Pose) -> Pose {
    let (sin, cos) = a[2].sin_cos();
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    [cos * x + sin * y, cos * y - sin * x, b[2] - a[2]]
}

/// Poses of a window in its own frame, the heading without jumps by a turn.
fn own_poses(window: &[Sample]) -> Vec<Pose> {
    use std::f64::consts::{PI, TAU};
    let mut heading = window[0].icp_dyaw;
    let unwrapped = window.iter().map(|s| {
        heading += (s.icp_dyaw - heading + PI).rem_euclid(TAU) - PI;
        [s.icp_x, s.icp_y, heading]
    });
    unwrapped.collect()
}

/// The step over the border behind a window: the mean motion of its last half second.
fn bridge(own: &[Pose]) -> Pose {
    let last = own.len() - 1;
    relative(own[last - BRIDGE], own[last]).map(|m| m / BRIDGE as f64)
}

fn csv(chain: &[&[Sample]]) -> String {
    let mut out = HEADER.to_owned();
    let mut frame: Pose = [0.0; 3];
    for (k, window) in chain.iter().enumerate() {
        let own = own_poses(window);
        for (i, (s, p)) in window.iter().zip(&own).enumerate() {
            let [x, y, heading] = compose(frame, relative(own[0], *p));
            let t = (k * WINDOW + i) as f64 * STEP;
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "{t:.2},{},{},{},{},{x:.9},{y:.9},{heading:.9},{}",
                s.cmd_left, s.cmd_right, s.wheel_left, s.wheel_right, s.imu_yaw_rate
            );
        }
        frame = compose(compose(frame, relative(own[0], own[WINDOW - 1])), bridge(&own));
    }
    out
}

#[cfg(test)]
mod tests;
