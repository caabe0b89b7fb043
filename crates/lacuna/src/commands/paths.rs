//! `lacuna predict` and `lacuna simulate` of robots whose files name their columns: the pose on the inputs of a drive.

use anyhow::{Result, bail, ensure};
use case_files::columns_case::{SimulatedDrives, kind_of, simulated};
use case_files::envelope::Program;
use case_files::predictions::{csv_of_path, write_path};
use pages::text_table::{TextTable, number};
use serde_json::{Value, json};
use verdict::SimulatedPath;

use super::{OwnEffects, Reader, predict, simulate};
use crate::console::{emit, emit_json, warning};

/// Refuses what such robots do not take.
fn ensure_plain(robot: &str, kind: &str, reader: &Reader, effects: &OwnEffects) -> Result<()> {
    if let Some(mapping) = &reader.mapping {
        bail!(
            "robot '{robot}' is of kind {kind} and names its columns itself, under [columns]; leave out --mapping {mapping}"
        );
    }
    ensure!(
        !effects.is_any(),
        "--effects and --adopt are for torque-driven robots, and robot '{robot}' is of kind {kind}; leave them out"
    );
    Ok(())
}

/// Says what was done to drives and what was not read.
fn warn(drives: &SimulatedDrives) {
    drives.told.iter().for_each(|sentence| warning(sentence));
    drives
        .ignored
        .iter()
        .for_each(|file| warning(&format!("'{file}' was not read: it is neither a table (CSV, Parquet) nor a bag")));
}

/// Predicts drives if all robots are of one of these kinds; whether they were.
pub(crate) fn predicted(args: &predict::Args) -> Result<bool> {
    let kinds = args.robot.iter().map(|robot| kind_of(robot)).collect::<Result<Vec<_>>>()?;
    let Some(kind) = kinds[0] else { return Ok(false) };
    for (robot, other) in args.robot.iter().zip(&kinds) {
        ensure!(
            *other == Some(kind),
            "robot '{}' is of kind {}, robot '{robot}' is not; compare robots of one kind",
            args.robot[0],
            kind.name()
        );
        ensure_plain(robot, kind.name(), &args.reader, &args.effects)?;
    }
    ensure!(
        args.restart.is_none(),
        "robots of kind {} are forecast over lengths of their own, anew from every second; leave out --restart",
        kind.name()
    );
    let mut of = Vec::new();
    for robot in &args.robot {
        let Some(drives) = simulated(robot, &args.drives)? else { return Ok(false) };
        if let Some(dir) = &args.out {
            let dir = if args.robot.len() > 1 { dir.join(predict::stem(robot)?) } else { dir.clone() };
            drives.paths.iter().try_for_each(|path| write_path(&dir, path))?;
        }
        of.push(drives);
    }
    warn(&of[0]);
    if let Some(target) = &args.json {
        emit_json(target, &as_json(&args.robot, &of))?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&as_text(&args.robot, &of))?;
    }
    Ok(true)
}

/// Drives, each with its path by every robot.
fn by_drive(of: &[SimulatedDrives]) -> impl Iterator<Item = Vec<&SimulatedPath>> {
    (0..of[0].paths.len()).map(|k| of.iter().map(|drives| &drives.paths[k]).collect())
}

fn as_text(robots: &[String], of: &[SimulatedDrives]) -> String {
    let lengths = of[0].paths[0].ahead.iter().map(|e| e.after);
    let quantity = |after: f64| [format!(">position after {after} s, m"), format!(">heading after {after} s, rad")];
    let header: Vec<String> =
        ["drive".to_owned(), "robot".to_owned()].into_iter().chain(lengths.flat_map(quantity)).collect();
    let mut table = TextTable::new(&header.iter().map(String::as_str).collect::<Vec<_>>());
    let cell = |e: Option<f64>| e.map_or_else(|| "-".to_owned(), number);
    for paths in by_drive(of) {
        for (robot, path) in robots.iter().zip(paths) {
            let errors = path.ahead.iter().flat_map(|e| [cell(e.position), cell(e.heading)]);
            table.row([path.name.clone(), robot.clone()].into_iter().chain(errors));
        }
    }
    format!(
        "Pose from the inputs alone against what was measured, anew from every second (medians; - where there is no run so long, or no pose)\n{}",
        table.render()
    )
}

fn as_json(robots: &[String], of: &[SimulatedDrives]) -> Value {
    let error = |path: &SimulatedPath| -> Vec<Value> {
        let one =
            |e: &verdict::ErrorAhead| json!({ "after_s": e.after, "position_m": e.position, "heading_rad": e.heading });
        path.ahead.iter().map(one).collect()
    };
    let drive = |paths: Vec<&SimulatedPath>| {
        let of: Vec<Value> =
            robots.iter().zip(&paths).map(|(robot, path)| json!({ "robot": robot, "medians": error(path) })).collect();
        json!({ "drive": paths[0].name, "of": of })
    };
    json!({
        "format": 1,
        "program": Program::default(),
        "sources": of[0].sources,
        "drives": by_drive(of).map(drive).collect::<Vec<_>>(),
    })
}

/// Simulates a drive if the robot is of one of these kinds; whether it was.
pub(crate) fn written(args: &simulate::Args) -> Result<bool> {
    let Some(kind) = kind_of(&args.robot)? else { return Ok(false) };
    ensure_plain(&args.robot, kind.name(), &args.reader, &args.effects)?;
    let Some(drives) = simulated(&args.robot, &args.recording)? else { return Ok(false) };
    warn(&drives);
    let [path] = drives.paths.as_slice() else {
        let names: Vec<&str> = drives.paths.iter().map(|path| path.name.as_str()).collect();
        bail!("give one recording at a time, not {}: {}", names.len(), names.join(", "));
    };
    if let Some(target) = &args.json {
        let column =
            |axis: usize| path.pose.iter().map(|p| p[axis]).map(|x| x.is_finite().then_some(x)).collect::<Vec<_>>();
        let whole = json!({
            "format": 1,
            "program": Program::default(),
            "robot": args.robot,
            "recording": path.name,
            "sources": drives.sources,
            "time_s": path.time,
            "columns": { "x_m": column(0), "y_m": column(1), "yaw_rad": column(2) },
        });
        emit_json(target, &whole)?;
    } else {
        let csv = csv_of_path(&path.time, &path.pose);
        if args.out == "-" {
            emit(&csv)?;
        } else {
            std::fs::write(&args.out, csv).map_err(|e| anyhow::anyhow!("cannot write '{}': {e}", args.out))?;
        }
    }
    Ok(true)
}
