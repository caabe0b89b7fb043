//! What is measured on: drives of the examiner, short and many, or made into one long recording.

use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use examiner::{Case, Content, EffectId, Setting, Settings, Severity, TyreLaw};

use super::fresh;

/// Drives that differ; with more recordings, they come again.
const DRAWN: usize = 20;
/// Rows per second of a long recording.
const RATE: usize = 1000;
/// Its columns besides the time.
const COLUMNS: usize = 14;

/// Drives of one robot, drawn once.
pub(super) struct Fleet {
    folder: PathBuf,
    case: PathBuf,
    /// Recordings, as text.
    drives: Vec<String>,
}

impl Fleet {
    /// Draws a robot with a payload that its simulation does not know.
    pub(super) fn new(folder: &Path) -> Result<Self> {
        let settings = Settings {
            content: Content::Effects(vec![EffectId::Payload]),
            severity: Some(Severity::Medium),
            setting: Some(Setting::Normal),
            law: Some(TyreLaw::Brush),
            duration_s: 30.0,
            references: 3,
            recordings: Some(DRAWN),
            heldout: 0,
            ..Settings::default()
        };
        let drawn = Case::draw("growth", 8, &settings)?;
        let case = fresh(folder.join("case"))?;
        let mut drives = Vec::new();
        for (path, bytes) in &drawn.files {
            if path.starts_with("recordings") {
                drives.push(String::from_utf8(bytes.clone()).context("a recording that is no text")?);
            } else {
                let file = case.join(path);
                fs::create_dir_all(file.parent().context("a file in no folder")?)?;
                fs::write(&file, bytes).with_context(|| format!("cannot write '{}'", file.display()))?;
            }
        }
        ensure!(drives.len() == DRAWN, "the examiner drew {} recordings, not {DRAWN}", drives.len());
        Ok(Self { folder: folder.to_path_buf(), case, drives })
    }

    /// Arguments: the robot and its references.
    pub(super) fn against(&self) -> Vec<std::ffi::OsString> {
        let at = |name: &str| self.case.join(name).into_os_string();
        vec!["--robot".into(), at("robot.json"), "--reference".into(), at("reference")]
    }

    /// The case with so many recordings.
    pub(super) fn case_of(&self, count: usize) -> Result<PathBuf> {
        let recordings = fresh(self.case.join("recordings"))?;
        self.write(&recordings, count)?;
        Ok(self.case.clone())
    }

    /// A folder of so many recordings.
    pub(super) fn many(&self, count: usize) -> Result<PathBuf> {
        let many = fresh(self.folder.join("many"))?;
        self.write(&many, count)?;
        Ok(many)
    }

    fn write(&self, folder: &Path, count: usize) -> Result<()> {
        for (i, text) in self.drives.iter().cycle().take(count).enumerate() {
            let file = folder.join(format!("drive_{i:05}.csv"));
            fs::write(&file, text).with_context(|| format!("cannot write '{}'", file.display()))?;
        }
        Ok(())
    }

    /// A recording of so many minutes at 1 kHz, all cells of 14 columns filled: the rows of the drives ten times each, one
    /// after the other.
    pub(super) fn long(&self, minutes: usize) -> Result<PathBuf> {
        let path = self.folder.join("long.csv");
        let failed = || format!("cannot write '{}'", path.display());
        let mut file = BufWriter::with_capacity(1 << 20, fs::File::create(&path).with_context(failed)?);
        let header = self.drives[0].lines().next().context("a drive without a header")?;
        let names = header.split(',').count();
        let more: Vec<String> = (names..=COLUMNS).map(|i| format!("more_{i}")).collect();
        writeln!(file, "{header},{}", more.join(",")).with_context(failed)?;
        let rows: Vec<String> = self.drives.iter().take(2).flat_map(|drive| filled(drive, names)).collect();
        for k in 0..minutes * 60 * RATE {
            let (row, t) = (&rows[k / 10 % rows.len()], k as f64 / RATE as f64);
            writeln!(file, "{t:.3},{row}").with_context(failed)?;
        }
        file.flush().with_context(failed)?;
        Ok(path)
    }
}

/// The cells behind the time, those that are empty as they were last, all with six decimals.
fn filled(drive: &str, names: usize) -> Vec<String> {
    let mut last = vec![0.0_f64; COLUMNS];
    drive
        .lines()
        .skip(1)
        .map(|line| {
            for (cell, last) in line.split(',').skip(1).take(names - 1).zip(&mut last) {
                *last = cell.parse().unwrap_or(*last);
            }
            last.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>().join(",")
        })
        .collect()
}
