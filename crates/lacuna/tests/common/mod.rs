//! A case in a temporary folder, and the program run in it.

#![allow(dead_code, unreachable_pub, reason = "every test file uses its own part")]

pub mod bags;

use std::fmt::Write as _;
use std::fs;
use std::process::{Command, Output};

use tempfile::TempDir;

/// A robot that is as it should be.
pub const ROBOT: &str = r#"name = "test"
causality = "torque-driven"

[parameters]
mass = { value = 40.0, unit = "kg", source = "test" }
yaw_inertia = { value = 1.2, unit = "kg m2", source = "test" }
com_height = { value = 150.0, unit = "mm", source = "test" }
wheelbase = { value = 0.35, unit = "m", source = "test" }
track = { value = 0.40, unit = "m", source = "test" }
wheel_radius = { value = 0.1, unit = "m", source = "test" }
wheel_inertia = { value = 0.01, unit = "kg m2", source = "test" }
adhesion = { value = 0.8, unit = "-", source = "test" }
rolling_resistance = { value = 0.03, unit = "-", source = "test" }
"#;

/// A robot of which wheel counts and a pose are recorded.
pub const CART: &str = r#"
name = "cart"
kind = "odometry"

[[wheel]]
name = "left"            # looking ahead
place = [0.0, 0.15]
radius = 0.05
radius_sigma = 0.0003
counts_per_turn = 4000.0
column = "left"

[[wheel]]
name = "right"
place = [0.0, -0.15]
radius = 0.05
radius_sigma = 0.0003
counts_per_turn = 4000.0
column = "right"

[known]
track_sigma = 0.003

[columns]
time = "t"
wheels = "counts"
x = "x"
y = "y"
yaw = "yaw"
"#;

/// Header of the recordings here.
pub const HEADER: &str = "time_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,torque_left_Nm,torque_right_Nm\n";

/// A recording of `rows` rows at 100 Hz; `phase` makes it another one.
pub fn drive(rows: u32, phase: f64) -> String {
    let mut out = HEADER.to_owned();
    for k in 0..rows {
        let t = f64::from(k) * 0.01;
        let (l, r) = (3.0 * (t + phase).sin(), 3.0 * (1.3 * t + phase).sin());
        writeln!(out, "{t:.2},{l:.4},{r:.4},{:.3},{:.3}", 0.5 * l, 0.5 * r).unwrap();
    }
    out
}

/// A folder in which everything is right.
pub struct Bench(TempDir);

impl Bench {
    /// A folder with nothing in it.
    pub fn empty() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// `case/` with `robot.toml`, `reference/ref_1.csv` and `recordings/run_1.csv`.
    pub fn new() -> Self {
        let bench = Self::empty();
        bench.write("case/robot.toml", ROBOT);
        bench.write("case/reference/ref_1.csv", &drive(300, 0.0));
        bench.write("case/recordings/run_1.csv", &drive(300, 0.5));
        bench
    }

    /// Writes a file below the folder.
    pub fn write(&self, name: &str, text: &str) {
        self.write_bytes(name, text.as_bytes());
    }

    /// Writes bytes to a file below the folder.
    pub fn write_bytes(&self, name: &str, bytes: &[u8]) {
        let path = self.0.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }

    /// Where a file below the folder is.
    pub fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    /// Reads a file below the folder.
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.path().join(name)).unwrap()
    }

    /// Removes a folder.
    pub fn remove(&self, name: &str) {
        fs::remove_dir_all(self.0.path().join(name)).unwrap();
    }

    /// Runs the program in the folder.
    pub fn run(&self, args: &[&str]) -> Run {
        let output = Command::new(env!("CARGO_BIN_EXE_lacuna")).args(args).current_dir(self.0.path()).output().unwrap();
        Run(output)
    }

    /// Diagnoses `case/`, which must fail with one message in which all `parts` occur.
    pub fn refuses(&self, parts: &[&str]) {
        self.run(&["diagnose", "case"]).failed(parts);
    }
}

/// Reads what `lacuna diagnose --json` wrote with the types of the library and compares all of it.
pub fn reads_back(written: &str) {
    let file = tempfile::NamedTempFile::new().unwrap();
    fs::write(file.path(), written).unwrap();
    let envelope = case_files::envelope::Envelope::open(file.path()).unwrap();
    envelope.robot().unwrap();
    let again = serde_json::to_value(&envelope).unwrap();
    assert!(again == serde_json::from_str::<serde_json::Value>(written).unwrap(), "not what was written");
}

/// What a run of the program did.
pub struct Run(Output);

impl Run {
    /// Exit code.
    pub fn code(&self) -> Option<i32> {
        self.0.status.code()
    }

    /// Standard output.
    pub fn out(&self) -> String {
        String::from_utf8_lossy(&self.0.stdout).into_owned()
    }

    /// Standard error.
    pub fn err(&self) -> String {
        String::from_utf8_lossy(&self.0.stderr).into_owned()
    }

    /// Exit code 1, nothing on standard output, one line on standard error in which all `parts` occur, and below it at
    /// most an excerpt of the file.
    pub fn failed(&self, parts: &[&str]) {
        let err = self.err();
        assert_eq!(self.code(), Some(1), "{err}");
        assert_eq!(self.out(), "");
        let (sentence, excerpt) = err.split_once('\n').unwrap();
        assert!(sentence.starts_with("error: "), "{err}");
        assert!(excerpt.is_empty() || excerpt.trim_start().starts_with("--> "), "{err}");
        assert!(!err.contains("panicked") && !err.contains("defect"), "{err}");
        for part in parts {
            assert!(err.contains(part), "no `{part}` in: {err}");
        }
    }
}
