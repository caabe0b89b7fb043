use command_driven::diagnose_response;
use lacuna::case_folder::{self, CaseFolder};
use recordings::ReadOptions;
use verdict::{Diagnosis, Verdict};

use super::*;

/// A table of a robot that drives a circle; `broken` is a window before which the recording stopped.
fn table(windows: usize, broken: usize) -> String {
    let mut out = String::from(
        "window,step,t,steady_state,cmd_left,cmd_right,wheel_left,wheel_right,icp_x,icp_y,icp_z,icp_droll,icp_dpitch,\
         icp_dyaw,imu_yaw_rate,acc_x,acc_y,acc_z\n",
    );
    for w in 0..windows {
        for i in 0..WINDOW {
            // 1 m/s on a circle of 0.5 m: 2 rad/s, so that the heading wraps.
            let turned: f64 = 2.0 * i as f64 * STEP;
            let wrapped = turned.sin().atan2(turned.cos());
            let speed = if w < broken { 2.0 } else { -5.0 } + 0.1 * (i % 2) as f64;
            let _ = writeln!(
                out,
                "{w},0,{},1,1,2,{speed},3,{},{},0,0,0,{wrapped},2,0,0,9.8",
                i as f64 * STEP,
                0.5 * turned.sin(),
                0.5 * (1.0 - turned.cos())
            );
        }
    }
    out
}

fn rows(path: &Path) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|l| l.split(',').map(|c| c.parse().unwrap()).collect()).collect()
}

#[test]
fn chains_break_at_jumps_and_before_the_unseen_windows() {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("robot.csv");
    fs::write(&source, table(9, 4)).unwrap();
    let written = lay_out(&source, folder.path(), 2.0 / 3.0).unwrap();
    assert_eq!((written.windows, written.files), ([6, 3], [2, 1]));
    for name in ["recordings/chain_000.csv", "recordings/chain_004.csv", "heldout/chain_006.csv"] {
        assert!(folder.path().join(name).is_file(), "{name}");
    }
}

#[test]
fn poses_inside_a_window_are_the_sources_and_go_on_over_its_border() {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("robot.csv");
    fs::write(&source, table(4, 9)).unwrap();
    lay_out(&source, folder.path(), 1.0).unwrap();
    let rows = rows(&folder.path().join("recordings/chain_000.csv"));
    assert_eq!(rows.len(), 4 * WINDOW);
    let pose = |i: usize| [rows[i][5], rows[i][6], rows[i][7]];
    for (w, i) in [(0, 39), (2, 0), (2, 17), (3, 39)] {
        let moved = relative(pose(w * WINDOW), pose(w * WINDOW + i));
        let turned = 2.0 * i as f64 * STEP;
        let expected = [0.5 * turned.sin(), 0.5 * (1.0 - turned.cos()), turned];
        for k in 0..3 {
            assert!((moved[k] - expected[k]).abs() < 1e-7, "window {w}, row {i}: {moved:?}, not {expected:?}");
        }
    }
    // The bridge goes on as before: chained, the circle stays one.
    let turned = 2.0 * (3 * WINDOW) as f64 * STEP;
    assert!((pose(3 * WINDOW)[2] - turned).abs() < 1e-9);
    assert!((pose(3 * WINDOW)[0] - 0.5 * turned.sin()).abs() < 0.02);
}

#[test]
fn an_incomplete_window_is_named() {
    let cut = table(3, 9).lines().take(1 + 2 * WINDOW + 7).collect::<Vec<_>>().join("\n");
    let error = read(cut.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("window 2 has 7 samples"), "{error}");
}

/// A robot of the data set, diagnosed on the first two thirds of its windows and held against the last third.
fn diagnosed(name: &str) -> Option<Diagnosis> {
    let source =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/drive-husky").join(format!("{name}.csv"));
    if !source.is_file() {
        eprintln!("SKIPPED: {} is not there", source.display());
        return None;
    }
    let folder = tempfile::tempdir().unwrap();
    let written = lay_out(&source, folder.path(), 2.0 / 3.0).unwrap();
    let mapping = case_folder::mapping(&written.mapping.display().to_string()).unwrap();
    let robot = case_folder::robot(&format!("{name}-drive")).unwrap();
    let paths = ["recordings", "heldout"].map(|p| vec![folder.path().join(p)]);
    let case = CaseFolder::from_paths(robot, [&[], &paths[0], &paths[1]], &mapping, &ReadOptions::default()).unwrap();
    Some(diagnose_response(&case.command_driven().unwrap(), &|_| {}).unwrap())
}

/// As it is, re-tuned, corrected, placebo on held-out windows.
fn errors(d: &Diagnosis, quantity: &str, statistic: &str) -> [f64; 4] {
    let starts = format!("{quantity} ({statistic}), ");
    let row = d.free_runs.iter().find(|r| r.recording == "held out" && r.quantity.starts_with(&starts)).unwrap();
    [row.nominal, row.retuned, row.corrected, row.placebo.unwrap()]
}

#[test]
fn the_husky_did_not_drive_what_was_commanded() {
    let Some(d) = diagnosed("husky") else { return };
    assert_eq!(d.verdict, Verdict::Explained);
    assert_eq!(d.ranked[0].effect, "drive_command", "{:?}", d.ranked);
    assert!(
        d.sentences[0].contains("do not do what is commanded") && d.sentences[0].contains("neither slip nor friction")
    );
    let response = d.response.as_ref().unwrap();
    assert!(response.scaling.as_ref().unwrap().contains("in proportion"), "{:?}", response.scaling);
    assert!(response.scaling_is_told);
    for (quantity, most) in [("wheel speed", 0.5), ("position", 0.32), ("yaw", 0.25), ("position at the end", 0.32)] {
        for statistic in ["rms", "median"] {
            let [nominal, retuned, corrected, placebo] = errors(&d, quantity, statistic);
            let shown = format!("{quantity} {statistic}: {nominal} {retuned} {corrected} {placebo}");
            assert!(corrected < most, "{shown}");
            assert!(2.0 * corrected < nominal && 1.3 * corrected < retuned && corrected < placebo, "{shown}");
        }
    }
}

#[test]
fn the_warthogs_forecast_is_better_than_its_simulation() {
    let Some(d) = diagnosed("warthog") else { return };
    assert_eq!(d.verdict, Verdict::Explained);
    for quantity in ["wheel speed", "yaw"] {
        let [nominal, retuned, corrected, _] = errors(&d, quantity, "rms");
        assert!(2.0 * corrected < nominal && 1.3 * corrected < retuned, "{quantity}: {nominal} {retuned} {corrected}");
    }
}
