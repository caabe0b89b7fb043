//! One drive that was given twice: it cannot be both right and wrong, and counts once.

use std::collections::HashMap;

use anyhow::{Result, bail};
use recordings::{Fingerprint, Read, Signal};

use crate::case_folder::CaseFolder;
use crate::parts::FOLDERS;

/// Samples of a sensor that tell a drive, at least: half a second of a simulation's log (guess).
const LEAST: usize = 50;
/// Share of a sensor's content that two recordings of one drive have in common: the fingerprint's share is known to 3 %.
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

/// What the sensors of a drive show.
struct Drive {
    name: String,
    /// Of each sensor that is there and moves.
    content: Vec<(Signal, Fingerprint)>,
}

impl Drive {
    fn of(read: &Read) -> Self {
        let long = |signal: Signal| read.recording.get(signal).filter(|channel| channel.len() >= LEAST);
        let of = |signal: Signal| Some((signal, Fingerprint::of_channel(long(signal)?)));
        let content = SENSORS.into_iter().filter_map(of).filter(|(_, print)| !print.says_nothing()).collect();
        Self { name: read.recording.name().to_owned(), content }
    }

    /// Whether one of both is the other, or a part of it, by every sensor that both have.
    fn is(&self, other: &Self) -> bool {
        let theirs = |signal: Signal| other.content.iter().find(|(of, _)| *of == signal).map(|(_, print)| print);
        let mut shares = self.content.iter().filter_map(|(signal, own)| Some(own.shared(theirs(*signal)?))).peekable();
        shares.peek().is_some() && shares.all(|share| share >= SAME)
    }
}
