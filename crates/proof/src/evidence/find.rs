//! What a folder of data holds: recordings of known kinds, whatever they are called.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use case_files::which_mapping;
use recordings::Mapping;

/// A recording and its files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Kind {
    /// Husky with currents and set speeds, and its inertial unit where it was recorded.
    Husky { speeds: PathBuf, inertial: Option<PathBuf> },
    /// Commands, wheel speeds and lidar pose in windows.
    Drive(PathBuf),
    /// Kobuki as tables: base and inertial unit.
    KobukiTable { base: PathBuf, inertial: PathBuf },
    /// Kobuki as a ROS 2 bag.
    KobukiBag(PathBuf),
}

/// A recording of a data set.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct DataRun {
    /// Folder and number: `ASPHALT_00`, `case-07`.
    pub(super) name: String,
    /// The folder's name; a ground where the folders are labelled.
    pub(super) label: String,
    pub(super) kind: Kind,
}

impl DataRun {
    /// Labelled as ground on which wheels do not sink.
    pub(super) fn is_hard(&self) -> bool {
        ["FLOORING", "ASPHALT"].contains(&self.label.as_str())
    }

    /// The files of a Husky: set speeds and currents, inertial unit.
    pub(super) fn husky(&self) -> Option<(&Path, Option<&Path>)> {
        match &self.kind {
            Kind::Husky { speeds, inertial } => Some((speeds, inertial.as_deref())),
            _ => None,
        }
    }
}

/// Folders below folders are looked into this deep.
const DEPTH: usize = 4;

/// All recordings below a folder, by name.
pub(super) fn find(folder: &Path) -> Result<Vec<DataRun>> {
    ensure!(folder.is_dir(), "there is no folder '{}'; name one with --data", folder.display());
    let mut out = Vec::new();
    look(folder, DEPTH, &mut out)?;
    // A bag has a folder, however many parts it is split into.
    out.dedup_by(|a, b| matches!(a.kind, Kind::KobukiBag(_)) && a.kind == b.kind);
    // A folder that holds one table gives it its name.
    let alone = |found: &DataRun| {
        matches!(found.kind, Kind::Drive(_)) && out.iter().filter(|o| o.label == found.label).count() == 1
    };
    let names: Vec<String> = out.iter().map(|f| if alone(f) { f.label.clone() } else { f.name.clone() }).collect();
    for (found, name) in out.iter_mut().zip(names) {
        found.name = name;
    }
    out.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(out)
}

fn look(folder: &Path, depth: usize, out: &mut Vec<DataRun>) -> Result<()> {
    let mut inside: Vec<PathBuf> = fs::read_dir(folder)
        .and_then(|all| all.map(|e| e.map(|e| e.path())).collect())
        .with_context(|| format!("cannot list '{}'", folder.display()))?;
    inside.sort();
    for path in inside {
        if path.is_dir() {
            if depth > 0 {
                look(&path, depth - 1, out)?;
            }
            continue;
        }
        let Some(kind) = kind(&path)? else { continue };
        let label = folder.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
        let stem = path.file_stem().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
        let name = match &kind {
            Kind::Husky { .. } => {
                let number = stem.trim_start_matches("pro").trim_start_matches('_');
                if number.is_empty() { label.clone() } else { format!("{label}_{number}") }
            }
            Kind::Drive(_) => format!("{label}_{stem}"),
            Kind::KobukiTable { .. } | Kind::KobukiBag(_) => label.clone(),
        };
        out.push(DataRun { name, label, kind });
    }
    Ok(())
}

/// What a file is by its first line, a bag by its topics.
fn kind(path: &Path) -> Result<Option<Kind>> {
    let name = path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    if recordings::is_bag(&name) {
        // By what it holds: names are hidden.
        let (_, contents) = which_mapping::look(path)?;
        let kobuki = which_mapping::fits(&Mapping::built_in("kobuki-bag")?, &contents);
        return Ok(kobuki.then(|| Kind::KobukiBag(path.parent().unwrap_or(path).to_path_buf())));
    }
    if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("csv")) {
        return Ok(None);
    }
    let file = fs::File::open(path).with_context(|| format!("cannot read '{}'", path.display()))?;
    let mut header = String::new();
    BufReader::new(file).read_line(&mut header).with_context(|| format!("cannot read '{}'", path.display()))?;
    let has = |columns: &[&str]| columns.iter().all(|c| header.trim().split(',').any(|h| h == *c));
    Ok(if has(&["time", "curL", "curR", "velL", "velR"]) {
        let partner = path.with_file_name(name.replace("pro", "imu"));
        let inertial = (partner != path && partner.is_file()).then_some(partner);
        Some(Kind::Husky { speeds: path.to_path_buf(), inertial })
    } else if has(&["window", "cmd_left", "wheel_left", "icp_x"]) {
        Some(Kind::Drive(path.to_path_buf()))
    } else if has(&["left_encoder", "right_encoder", "left_current_10mA"]) {
        let inertial = path.with_file_name("imu.csv");
        inertial.is_file().then(|| Kind::KobukiTable { base: path.to_path_buf(), inertial })
    } else {
        None
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_are_known_by_what_they_hold() {
        let folder = tempfile::tempdir().expect("a folder");
        let put = |name: &str, text: &str| {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
            fs::write(path, text).expect("writes");
        };
        put("case-07/pro.csv", "time,curL,curR,velL,velR\n");
        put("case-07/imu.csv", "time,wx,wy,wz,ax,ay,az\n");
        put("ASPHALT/pro_03.csv", "time,curL,curR,velL,velR\n");
        put("other/notes.csv", "a,b\n");
        put("d/husky.csv", "window,step,t,steady_state,cmd_left,cmd_right,wheel_left,wheel_right,icp_x\n");
        let found = find(folder.path()).expect("finds");
        let names: Vec<&str> = found.iter().map(|f| f.name.as_str()).collect();
        assert_eq!(names, ["ASPHALT_03", "case-07", "d"]);
        assert!(found[0].is_hard() && found[0].husky().is_some_and(|(_, inertial)| inertial.is_none()));
        assert!(!found[1].is_hard() && found[1].husky().is_some_and(|(_, inertial)| inertial.is_some()));
        assert!(find(&folder.path().join("nowhere")).is_err());
    }
}
