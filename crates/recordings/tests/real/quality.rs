//! The defects that the descriptions of the recordings beside the workspace name are found; ignored
//! where the recordings are not there.

use std::fs;

use recordings::{FindingKind, Fingerprint, Quality, Severity, group_by_content};
use skipping::{Outcome, Skipped, beside};

/// A CSV file as columns of numbers, an empty cell as NaN.
struct Table {
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl Table {
    /// The file below the folder of recordings, with some lines above the header.
    fn read(file: &str, delimiter: char, above: usize) -> Result<Self, Skipped> {
        let text = fs::read_to_string(beside(&format!("data/{file}"))?).unwrap();
        let mut lines = text.lines().skip(above);
        let names: Vec<String> = lines.next().unwrap().split(delimiter).map(str::to_owned).collect();
        let mut columns = vec![Vec::new(); names.len()];
        for line in lines {
            for (column, cell) in columns.iter_mut().zip(line.split(delimiter)) {
                column.push(cell.trim().parse().unwrap_or(f64::NAN));
            }
        }
        Ok(Self { names, columns })
    }

    fn column(&self, name: &str) -> &[f64] {
        let index = self.names.iter().position(|other| other == name).unwrap_or_else(|| panic!("no column {name}"));
        &self.columns[index]
    }

    fn stamps(&self, name: &str, ns_per_unit: f64) -> Vec<i64> {
        self.column(name).iter().map(|t| (t * ns_per_unit).round() as i64).collect()
    }

    /// The quality of a column stamped in seconds by another.
    fn quality(&self, time: &str, name: &str) -> Quality {
        Quality::measure(&self.stamps(time, 1e9), self.column(name))
    }
}

fn kinds(quality: &Quality) -> Vec<FindingKind> {
    quality.findings("").iter().map(|finding| finding.kind).collect()
}

fn near(value: f64, expected: f64, part: f64) -> bool {
    (value / expected - 1.0).abs() < part
}

pub(crate) fn kobuki_stamps_bursts_counters_and_steps() -> Outcome {
    for run in ["a", "b", "c", "d"] {
        let core = Table::read(&format!("kobuki/run-{run}/core.csv"), ',', 0)?;
        // 50 Hz by the stamps; by the arrivals too, but in bursts.
        let stamped = core.quality("t", "left_encoder");
        assert!(near(stamped.timing.rate_hz().unwrap(), 50.0, 0.01), "{run}");
        assert_eq!(stamped.timing.late.count, 0, "{run}");
        assert!(!kinds(&stamped).contains(&FindingKind::Bunched), "{run}");
        let arrived = core.quality("t_recv", "left_encoder");
        assert!(kinds(&arrived).contains(&FindingKind::Bunched), "{run}");
        assert!(arrived.timing.late.count > 10, "{run}: {:?}", arrived.timing.late);
        assert!(arrived.timing.jitter_99_s > 2.0 * stamped.timing.jitter_99_s, "{run}");
        // The counter of 16 bits wraps; as a clock, the robot's milliseconds jump back by as much.
        let wrap = stamped.wrap.unwrap();
        assert_eq!(wrap.modulus, 65_536.0, "{run}");
        let by_robot = Quality::measure(&core.stamps("mcu_ms", 1e6), core.column("left_encoder")).timing;
        let wraps = core.quality("t", "mcu_ms").wrap.unwrap();
        assert_eq!((wraps.modulus, wraps.count), (65_536.0, by_robot.jumps_back.count), "{run}");
        assert!(near(by_robot.largest_jump_s, -65.516, 0.01), "{run}: {}", by_robot.largest_jump_s);
        // Currents in whole steps of 10 mA.
        let current = core.quality("t", "left_current_10mA");
        assert_eq!(current.grid.map(|grid| (grid.step, grid.fit)), Some((1.0, 1.0)), "{run}");
        let imu = Table::read(&format!("kobuki/run-{run}/imu.csv"), ',', 0)?;
        let gyro = imu.quality("t", "wz");
        assert!(near(gyro.grid.unwrap().step, 0.01_f64.to_radians(), 0.001), "{run}: {:?}", gyro.grid);
    }
    Ok(())
}

pub(crate) fn husky_set_points_dead_bands_and_made_up_stamps() -> Outcome {
    let runs = ["FLOORING/pro_01", "FLOORING/pro_02", "ASPHALT/pro_00", "ASPHALT/pro_01", "SANDY_LOAM/pro_08"];
    for run in runs {
        let drive = Table::read(&format!("husky-open/{run}.csv"), ',', 0)?;
        for side in ["velL", "velR"] {
            let speed = drive.quality("time", side);
            let found = kinds(&speed);
            // Multiples of 1/127 m/s that stay as they are: a set-point.
            assert!(near(speed.grid.unwrap().step, 1.0 / 127.0, 1e-6), "{run} {side}: {:?}", speed.grid);
            assert_eq!(speed.grid.unwrap().fit, 1.0);
            assert!(found.contains(&FindingKind::Stepwise) || found.contains(&FindingKind::Held), "{run} {side}");
            assert!(speed.noise.is_none_or(|noise| noise < 1.0 / 127.0), "{run} {side}: {:?}", speed.noise);
            // Sample number times the period.
            assert!(found.contains(&FindingKind::ComputedStamps), "{run} {side}");
            assert!(near(speed.timing.rate_hz().unwrap(), 6.5, 1e-6));
        }
        for side in ["curL", "curR"] {
            let grid = drive.quality("time", side).grid.unwrap();
            assert!(near(grid.step, 0.13, 0.02), "{run} {side}: {grid:?}");
        }
        let imu = Table::read(&format!("husky-open/{}.csv", run.replace("pro", "imu")), ',', 0)?;
        let shaken = imu.quality("time", "az");
        assert!(kinds(&shaken).contains(&FindingKind::ComputedStamps) && shaken.grid.is_none(), "{run}");
        assert!(near(shaken.timing.rate_hz().unwrap(), 100.0, 1e-6), "{run}");
    }
    // Exactly constant for tens of seconds.
    let drive = Table::read("husky-open/SANDY_LOAM/pro_08.csv", ',', 0)?;
    let (stretch, value) = drive.quality("time", "velL").values.longest_stuck.unwrap();
    assert!(near(stretch.seconds, 44.0, 0.01) && near(value, 80.0 / 127.0, 1e-6), "{stretch:?} {value}");
    // 0.00 A or at least 0.59 A, where zero is visited often enough to say so.
    let drive = Table::read("husky-open/ASPHALT/pro_00.csv", ',', 0)?;
    for side in ["curL", "curR"] {
        assert_eq!(drive.quality("time", side).grid.unwrap().dead_band, Some(0.59), "{side}");
    }
    Ok(())
}

pub(crate) fn drive_windows_restart_and_wheel_speeds_are_held() -> Outcome {
    for (robot, windows, held, step) in [("husky", 402, 0.5, 1e-6), ("warthog", 240, 0.8, 0.25_f64.to_radians())] {
        let table = Table::read(&format!("drive-husky/{robot}.csv"), ',', 0)?;
        for side in ["wheel_left", "wheel_right"] {
            let speed = table.quality("t", side);
            assert_eq!(speed.timing.jumps_back.count, windows - 1, "{robot}: time restarts in every window");
            assert!(near(speed.timing.rate_hz().unwrap(), 20.0, 1e-6));
            assert!(near(speed.values.held_share, held, 0.05), "{robot} {side}: {}", speed.values.held_share);
            assert!(near(speed.grid.unwrap().step, step, 1e-3), "{robot} {side}: {:?}", speed.grid);
        }
        let command = table.quality("t", "cmd_left");
        assert!(kinds(&command).contains(&FindingKind::Stepwise), "{robot}");
        let gyro = table.quality("t", "imu_yaw_rate");
        assert!(!kinds(&gyro).contains(&FindingKind::Held), "{robot}");
    }
    Ok(())
}

pub(crate) fn robotino_steps_of_speed_and_current_and_uneven_periods() -> Outcome {
    for run in ["v10_dir000", "v20_dir090", "v30_dir210"] {
        let table = Table::read(&format!("robotino-open/floor-a/{run}.csv"), ';', 2)?;
        let t_ns = table.stamps("t", 1e6);
        let quality = |name: &str| Quality::measure(&t_ns, table.column(name));
        let speed = quality("m1vel");
        assert!(near(speed.timing.period_s.unwrap(), 0.031, 0.05), "{run}: {:?}", speed.timing.period_s);
        assert!(!speed.timing.computed && speed.timing.jitter_mad_s > 1e-4, "{run}");
        assert!(near(quality("m1cur").grid.unwrap().step, 0.026, 0.02), "{run}");
        assert!(kinds(&quality("xsetspeed")).contains(&FindingKind::Constant), "{run}");
        if let Some(grid) = speed.grid {
            assert!(near(grid.step, 2.83, 0.002), "{run}: {grid:?}");
        }
    }
    Ok(())
}

pub(crate) fn no_good_channel_is_called_bad() -> Outcome {
    let imu = Table::read("husky-open/ASPHALT/imu_00.csv", ',', 0)?;
    for name in ["wx", "wy", "wz", "ax", "ay", "az"] {
        let quality = imu.quality("time", name);
        assert!(quality.findings("").iter().all(|finding| finding.severity == Severity::Note), "{name}");
    }
    Ok(())
}

pub(crate) fn each_run_is_content_of_its_own_and_a_part_belongs_to_its_whole() -> Outcome {
    let prints = |rows: std::ops::Range<usize>| {
        let of = |run| {
            let core = Table::read(&format!("kobuki/run-{run}/core.csv"), ',', 0)?;
            let t_ns = &core.stamps("t", 1e9)[rows.clone()];
            let names = ["left_encoder", "right_encoder", "left_pwm", "left_current_10mA", "battery_0p1V", "bumper"];
            let column = |name| Fingerprint::of_samples(t_ns, &core.column(name)[rows.clone()]);
            Ok(Fingerprint::union(names.map(column)))
        };
        ["a", "b", "c", "d"].map(of).into_iter().collect::<Result<Vec<_>, Skipped>>()
    };
    let mut all = prints(0..3000)?;
    let parts = prints(500..2000)?;
    all.extend(parts);
    assert_eq!(group_by_content(&all), [[0, 4], [1, 5], [2, 6], [3, 7]]);
    assert!(all[0].shared(&all[1]) < 0.05 && all[2].shared(&all[6]) > 0.95);
    Ok(())
}
