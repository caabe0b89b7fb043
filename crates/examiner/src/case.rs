//! A case from a seed: files and truth.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::draw::{Draw, HiddenRuns};
use crate::free::{error, predict, restarts, rms, shown};
use crate::law::LawRow;
use crate::measure::note_coverage;
use crate::random::Stream;
use crate::run::{Run, shown_rate};
use crate::truth::{HeldoutTruth, Truth};
use crate::{Course, Error, Settings, csv, robot_json};

/// Draws cases.
#[derive(Debug, Clone, Copy)]
pub struct Case;

/// A drawn case.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DrawnCase {
    /// What the diagnoser gets: paths within the case's folder, and contents.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// True responses of the held-out runs: paths within the truth's folder, and contents.
    pub truth_files: Vec<(PathBuf, Vec<u8>)>,
    /// What was hidden.
    pub truth: Truth,
    /// Rows of the recordings with a hidden law of another grammar, by recording.
    pub law_rows: BTreeMap<String, Vec<LawRow>>,
}

impl Case {
    /// Draws a case. The same name, seed and settings give the same bytes.
    ///
    /// # Errors
    /// If the settings make no case: a row that is no multiple of 0.5 ms, no runs, runs shorter
    /// than four segments, or a fourth effect.
    pub fn draw(name: &str, seed: u64, settings: &Settings) -> Result<DrawnCase, Error> {
        let mut draw = Draw::new(seed, settings)?;
        let references: Vec<Run> = draw.references();
        let mut hidden = draw.hide(&references);
        let heldout = draw.heldout(&hidden);
        note_coverage(&mut hidden.effects, &heldout);
        let row = draw.row;
        let mut files = Vec::new();
        let mut truth_files = Vec::new();
        let mut put = |path: String, text: String| {
            files.push((PathBuf::from(path), text.into_bytes()));
        };
        let described = robot_json::describe(&draw.nominal, &draw.sheet, settings.row_rate_hz);
        put("robot.json".to_owned(), serde_json::to_string_pretty(&described)?);
        let text = |run: &Run| csv::recording(run, &draw.sheet, row, settings.pose, settings.accelerometer);
        for (i, run) in references.iter().take(settings.references).enumerate() {
            put(format!("reference/ref_{}.csv", i + 1), text(run));
        }
        for (i, run) in hidden.recordings.iter().enumerate() {
            put(format!("recordings/run_{}.csv", i + 1), text(run));
        }
        let mut truth = Truth {
            case: name.to_owned(),
            generator: draw.law.name().to_owned(),
            verdict: hidden.verdict().to_owned(),
            effects: hidden.effects.clone(),
            recordings: hidden.truths.clone(),
            heldout: BTreeMap::new(),
            setting: draw.setting.name().to_owned(),
            robot: draw.robot.against(&draw.nominal).into_iter().map(|(name, x)| (name.to_owned(), x)).collect(),
            below_noise: hidden.below_noise,
        };
        for (i, run) in heldout.iter().enumerate() {
            let name = format!("held_{}", i + 1);
            let h = &hidden.in_heldout;
            let noise = Stream::new(draw.seed, "held restart", i as u64);
            let starts = restarts(run, &draw.sheet, noise);
            let rate = |w| shown_rate(h, w);
            put(format!("heldout/{name}.csv"), csv::heldout(run, &starts, rate, &draw.sheet, row));
            let real = shown(run, h);
            truth_files.push((PathBuf::from(format!("heldout/{name}.csv")), csv::responses(&real, row).into_bytes()));
            let none = crate::hidden::Hidden::default();
            let calibrated = predict(&draw.robot, &none, run, &starts, row);
            let calibrated = error(&real, &calibrated);
            let oracle =
                if *h == none { calibrated } else { error(&real, &predict(&draw.robot, h, run, &starts, row)) };
            let kinds = run.kinds.iter().map(|k| k.name().to_owned()).collect();
            truth.heldout.insert(
                name,
                HeldoutTruth {
                    kinds,
                    rms: rms(real.iter().copied()),
                    nominal: error(&real, &predict(&draw.nominal, &none, run, &starts, row)),
                    calibrated,
                    oracle,
                },
            );
        }
        truth_files.push((PathBuf::from("truth.json"), truth.json()?.into_bytes()));
        let of_law = hidden.in_heldout.foreign.law.map(|law| {
            let rows = |(i, run): (usize, &Run)| (format!("run_{}", i + 1), law.rows(run, row));
            hidden.recordings.iter().enumerate().map(rows).collect()
        });
        Ok(DrawnCase { files, truth_files, truth, law_rows: of_law.unwrap_or_default() })
    }
}

/// A drawn robot with what it hides, for further recordings.
pub struct Again<'a> {
    draw: Draw<'a>,
    hidden: HiddenRuns,
    settings: &'a Settings,
}

impl<'a> Again<'a> {
    /// The robot of a case, as [`Case::draw`] draws it from the same seed and settings.
    ///
    /// # Errors
    /// As [`Case::draw`].
    pub fn new(seed: u64, settings: &'a Settings) -> Result<Self, Error> {
        let mut draw = Draw::new(seed, settings)?;
        let references: Vec<Run> = draw.references();
        let hidden = draw.hide(&references);
        Ok(Self { draw, hidden, settings })
    }

    /// A further recording on a course that was asked for: its text, in the form of the case's recordings. What differs
    /// from run to run is fixed by `number`, so that two courses can be compared on the same run.
    ///
    /// # Errors
    /// When the course has no points, is shorter than 400 rows, or runs back in time.
    pub fn record(&self, number: usize, course: &Course) -> Result<String, Error> {
        if !course.is_sound() || course.duration() * self.settings.row_rate_hz < 400.0 {
            return Err(Error::Settings("a course needs points in the order of time and at least 400 rows"));
        }
        let run = self.draw.further(&self.hidden, number, course);
        Ok(csv::recording(&run, &self.draw.sheet, self.draw.row, self.settings.pose, self.settings.accelerometer))
    }
}

impl DrawnCase {
    /// Writes what the diagnoser gets into a folder.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), Error> {
        write_all(folder, &self.files)
    }

    /// Writes the truth into a folder, which the diagnoser must not see.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write_truth(&self, folder: &Path) -> Result<(), Error> {
        write_all(folder, &self.truth_files)
    }
}

fn write_all(folder: &Path, files: &[(PathBuf, Vec<u8>)]) -> Result<(), Error> {
    for (path, bytes) in files {
        let path = folder.join(path);
        let result = path.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&path, bytes));
        result.map_err(|source| Error::Write { path, source })?;
    }
    Ok(())
}
