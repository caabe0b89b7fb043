//! One drive that was given twice: it cannot be both right and wrong, and counts once.

use std::collections::{HashMap, HashSet};
use std::hash::{DefaultHasher, Hash, Hasher};

use anyhow::{Result, bail};
use recordings::{Read, Recording, Signal};

use crate::case_folder::{CaseFolder, FOLDERS};

/// Consecutive samples of a sensor by which a stretch of a drive is known.
const PATTERN: usize = 8;
/// Patterns that tell a drive, at least.
const LEAST: usize = 20;
/// Share of them that two recordings of one drive have in common.
const SAME: f64 = 0.9;
/// Sensors whose noise, or motion, no two drives share; commands may be the same in many.
const SENSORS: [Signal; 6] =
    [Signal::GyroZ, Signal::AccelX, Signal::PoseX, Signal::WheelAngleLeft, Signal::WheelSpeedLeft, Signal::CurrentLeft];

impl CaseFolder {
    /// Refuses a file whose bytes are those of another, and a recording whose samples are those of another: with other ends
    /// of lines, other columns beside them, or cut.
    ///
    /// # Errors
    /// Both names, and the parts that they were given for.
    pub fn refuse_twins(&self) -> Result<()> {
        let give_once = || {
            format!(
                "give it once, as what it is: reference = {}, recordings = {}, heldout = {}",
                FOLDERS[0].1, FOLDERS[1].1, FOLDERS[2].1
            )
        };
        let mut seen: HashMap<&str, (&str, &str)> = HashMap::new();
        for (role, loaded) in self.parts() {
            for source in &loaded.sources {
                if let Some((other, name)) = seen.insert(&source.sha256, (role, &source.name)) {
                    bail!(
                        "'{name}' ({other}) and '{}' ({role}) are the same recording (SHA-256 {}...); {}",
                        source.name,
                        &source.sha256[..12],
                        give_once()
                    );
                }
            }
        }

        let [reference, recordings, ..] = self.parts();
        let drives = |(role, loaded): (&'static str, &'_ crate::case_folder::Loaded)| -> Vec<(&'static str, Drive)> {
            loaded.reads.iter().map(|read| (role, Drive::of(read))).collect()
        };
        let references = drives(reference);
        for (role, drive) in drives(recordings) {
            if let Some((other, twin)) = references.iter().find(|(_, twin)| drive.is(twin)) {
                bail!(
                    "'{}' ({other}) and '{}' ({role}) are the same recording: their samples are the same; {}",
                    twin.name,
                    drive.name,
                    give_once()
                );
            }
        }
        Ok(())
    }
}

/// A drive by patterns of its sensors.
struct Drive {
    name: String,
    /// Of each sensor that is there, the hash of every pattern.
    patterns: Vec<(Signal, HashSet<u64>)>,
}

impl Drive {
    fn of(read: &Read) -> Self {
        let recording: &Recording = &read.recording;
        let of = |signal: Signal| {
            let values = recording.get(signal)?.values();
            let moves = |w: &&[f64]| w.iter().any(|x| *x != w[0]);
            let hash = |w: &[f64]| {
                let mut hasher = DefaultHasher::new();
                for x in w {
                    x.to_bits().hash(&mut hasher);
                }
                hasher.finish()
            };
            Some((signal, values.windows(PATTERN).filter(moves).map(hash).collect()))
        };
        Self { name: recording.name().to_owned(), patterns: SENSORS.into_iter().filter_map(of).collect() }
    }

    /// Whether one of both is the other, or a part of it, by the first sensor that both have.
    fn is(&self, other: &Self) -> bool {
        let both = self.patterns.iter().find_map(|(signal, own)| {
            let theirs = &other.patterns.iter().find(|(of, _)| of == signal)?.1;
            (own.len().min(theirs.len()) >= LEAST).then_some((own, theirs))
        });
        both.is_some_and(|(own, theirs)| {
            let shared = own.intersection(theirs).count() as f64;
            shared >= SAME * own.len().min(theirs.len()) as f64
        })
    }
}
