//! Drawn robots of which a gyro alone shows how the body turns.

#[expect(dead_code, reason = "shared with tests that hide more")]
mod drawn;

use drawn::{Hidden, Kind, drawn};
use odometry::{Answer, Case, Drive, Findings, diagnose, diagnosis, left_out};

/// The heading of a drive as a gyro of this scale and bias shows it, with noise that adds up.
fn heard(drive: &mut Drive, [scale, bias]: [f64; 2], seed: f64) {
    let (start, first) = (drive.time[0], drive.pose[0][2]);
    let mut drifted = 0.0;
    for (row, (pose, time)) in drive.pose.iter_mut().zip(&drive.time).enumerate() {
        drifted += 2e-4 * (12.9 * row as f64 + seed).sin() * (7.3 * row as f64).cos();
        *pose = [f64::NAN, f64::NAN, scale * (pose[2] - first) + bias * (time - start) + drifted];
    }
    drive.heading_only = true;
}

fn by_gyro(kind: Kind, hidden: Hidden, gyro: [f64; 2], seed: u64) -> Case {
    let mut case = drawn(kind, hidden, 3, 90.0, seed).case;
    for (k, drive) in case.recordings.iter_mut().enumerate() {
        heard(drive, gyro, k as f64);
    }
    case
}

fn found(case: &Case) -> Findings {
    diagnose(case, &|_| {}).expect("an answer")
}

/// The first cause that is named, with those that cannot be told from it, each without what it is about.
fn first_class(findings: &Findings) -> Vec<&str> {
    let Some(first) = findings.named.first() else { return Vec::new() };
    let alike = first.alike.iter().map(|label| label.split(' ').next().unwrap_or(label));
    std::iter::once(first.spec.id).chain(alike).collect()
}

const ANY_FACTOR: [&str; 3] = ["heading_gyro_scale", "radius_of_all_wheels", "wheel_distance"];

#[test]
fn what_changes_turning_alone_is_named_first() {
    for (hidden, id) in [
        (Hidden::ClockOffset, "counts_clock_offset"),
        (Hidden::ClockRate, "clock_rate"),
        (Hidden::LostCounts, "lost_counts"),
    ] {
        // What one of three omni wheels loses turns the body little more than a gyro errs.
        let kinds = [Kind::Differential, Kind::Tricycle, Kind::Omni3];
        for kind in kinds.into_iter().filter(|kind| hidden != Hidden::LostCounts || *kind != Kind::Omni3) {
            let found = found(&by_gyro(kind, hidden, [1.0, 0.0], 11));
            assert_eq!(first_class(&found), [id], "{kind:?}, {hidden:?}");
        }
    }
    // A gyro alone does not tell an omni wheel that is larger from one that points another way.
    let classes: [(Kind, &[&str]); 2] = [
        (Kind::Differential, &["radius_of_one_wheel"]),
        (Kind::Omni3, &["radius_of_one_wheel", "direction_of_one_wheel"]),
    ];
    for (kind, class) in classes {
        let found = found(&by_gyro(kind, Hidden::OneRadius, [1.0, 0.0], 11));
        assert_eq!(first_class(&found), class, "{kind:?}");
    }
    let found = found(&by_gyro(Kind::Tricycle, Hidden::SteeringZero, [1.0, 0.0], 11));
    assert_eq!(first_class(&found), ["steering_zero"]);
}

#[test]
fn one_factor_on_turning_is_a_class_of_three_causes() {
    for kind in [Kind::Differential, Kind::Tricycle, Kind::Omni3] {
        for (hidden, scale) in [(Hidden::AllRadii, 1.0), (Hidden::Distance, 1.0), (Hidden::Nothing, 1.08)] {
            let found = found(&by_gyro(kind, hidden, [scale, 0.0], 11));
            let mut class = first_class(&found);
            class.sort_unstable();
            assert_eq!(class, ANY_FACTOR, "{kind:?}, {hidden:?}");
        }
    }
}

#[test]
fn a_bias_is_named_with_its_size_and_nothing_where_nothing_is_wrong() {
    for kind in [Kind::Differential, Kind::Tricycle, Kind::Omni3] {
        let biased = found(&by_gyro(kind, Hidden::Nothing, [1.0, 0.06], 12));
        assert_eq!(first_class(&biased), ["heading_gyro_bias"], "{kind:?}");
        let bias = &biased.named[0].estimates[0];
        assert!((bias.value - 0.06).abs() < bias.half_width, "{kind:?}: {bias:?}");

        let right = found(&by_gyro(kind, Hidden::Nothing, [1.0, 0.0], 11));
        // However quiet the gyro, a window counts as known to a per cent of the usual turning, which is some tenths of a radian here.
        assert!(right.noise > 3e-3, "{kind:?}: {}", right.noise);
        assert!(matches!(right.answer, Answer::Nothing | Answer::Retune), "{kind:?}: {:?}", right.named);
    }
}

/// A differential drive whose gyro turns the farther, the faster it turns (share per rad/s, up to 1 rad/s), and swings by
/// another share as time goes by, which no cause does.
fn ahead_in_fast_turns(per_rate: f64, swing: f64) -> Findings {
    let mut case = by_gyro(Kind::Differential, Hidden::Nothing, [1.0, 0.0], 13);
    for drive in &mut case.recordings {
        let before: Vec<f64> = drive.pose.iter().map(|pose| pose[2]).collect();
        let mut added = 0.0;
        for row in 1..before.len() {
            let (turned, dt) = (before[row] - before[row - 1], drive.time[row] - drive.time[row - 1]);
            added += turned * (per_rate * (turned / dt).abs().min(1.0) + swing * (0.3 * drive.time[row]).sin());
            drive.pose[row][2] += added;
        }
    }
    found(&case)
}

#[test]
fn a_slip_by_turning_alone_is_named_where_it_takes_much_of_the_error_away_and_listed_where_little() {
    let plain = ahead_in_fast_turns(0.09, 0.0);
    assert_eq!(first_class(&plain)[0], "slip_with_turning");
    let blurred = ahead_in_fast_turns(0.09, 0.05);
    assert!(blurred.named.is_empty(), "{:?}", blurred.named);
    let listed = blurred.others.iter().find(|(label, _)| label == "slip_with_turning");
    assert!(listed.is_some_and(|(_, p)| (0.05..=0.5).contains(p)), "{:?}", blurred.others);
}

#[test]
fn forecasts_are_of_headings_and_no_place_is_told() {
    let case = by_gyro(Kind::Differential, Hidden::OneRadius, [1.0, 0.0], 11);
    let findings = found(&case);
    let told = diagnosis(&findings, &left_out(&case, &findings, &|_| {}).expect("forecasts"), false);
    let forecast = told.sentences.last().expect("a sentence");
    assert!(forecast.starts_with("Heading 30 s ahead") && !forecast.contains(" cm"), "{forecast}");
    assert!(!forecast.contains("UMBmark"), "{forecast}");
    assert!(told.free_runs.iter().all(|run| run.quantity.starts_with("heading")));
    assert!(told.limits[0].starts_with("a gyro shows how the body turns"), "{:?}", told.limits);
    let channels = told.traces.iter().flat_map(|trace| &trace.channels);
    assert!(channels.clone().count() > 0 && channels.into_iter().all(|channel| channel.signal == "heading"));
}

#[test]
fn what_a_gyro_shows_at_rest_is_taken_off() {
    let text = |rate: f64| {
        use std::fmt::Write;
        let mut out = "t,l,r,g\n".to_owned();
        for k in 0..600 {
            let speed = if k < 200 { 0.0 } else { 2.0 };
            _ = writeln!(out, "{:.2},{speed},{speed},{rate}", 0.05 * f64::from(k));
        }
        out
    };
    let robot = odometry::file::BUILT_IN[0].1.replace("wheels = \"counts\"", "wheels = \"speed\"");
    let robot = robot.replace("x = \"x_m\"\ny = \"y_m\"\nyaw = \"yaw_rad\"", "gyro = \"g\"");
    let robot =
        robot.replace("\"tick_left\"", "\"l\"").replace("\"tick_right\"", "\"r\"").replace("\"time_s\"", "\"t\"");
    let file = odometry::file::RobotFile::parse("robot.toml", &robot).expect("a robot");
    let drive = file.drive(&testing::table("a", &text(0.02))).expect("a drive");
    assert!(drive.told[0].contains("the gyro shows 0.02000 rad/s, which was taken off"), "{:?}", drive.told);
    let last = drive.pose[599];
    assert!(last[0].is_nan() && last[2].abs() < 1e-9, "{last:?}");
}

#[test]
fn the_next_drive_is_told_by_the_turning_that_it_would_show() {
    let case = by_gyro(Kind::Differential, Hidden::Distance, [1.0, 0.0], 7);
    let next = odometry::examine(&case, Some(12.0), &|_| {}).expect("an answer").next.expect("advice");
    let best = next.best().expect("a drive");
    assert!(best.why.contains("the turning over 4 s differs by") && best.why.contains(" rad ("), "{}", best.why);
}
