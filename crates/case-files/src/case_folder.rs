//! Cases: a robot, references, recordings, and perhaps held-out drives.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use inference::{GivenEffects, KnownEffects, Options};
use recordings::{Mapping, Read, ReadOptions};
use robot_file::{Causality, RobotSpec};
use robot_model::Effect;
use robot_model::effect::Redundancy;
use torque_driven::Visit;
use verdict::{Coverage, Diagnosis, EffectAt};

use crate::inputs;
pub use crate::inputs::{Loaded, mapping, robot, robot_with};
use crate::long::Budget;
use crate::parts::{FOLDERS, SIMULATION, folders, simulation_of};
use crate::visits::{self, GivenVisit};

/// A case with what was lost in reading it.
#[derive(Debug)]
pub struct CaseFolder {
    /// The robot.
    pub robot: RobotSpec,
    /// Recordings in which the simulation is right.
    pub reference: Loaded,
    /// Recordings in which it is not.
    pub recordings: Loaded,
    /// Inputs whose response is to be predicted.
    pub held_out: Loaded,
    /// Logs of the user's simulator on the inputs of references or recordings.
    pub simulation: Loaded,
    /// Of long recordings and references, what they stand for, by the name of their folder.
    pub coverage: BTreeMap<String, Coverage>,
    /// Visits that the user named.
    visits: Vec<GivenVisit>,
}

impl CaseFolder {
    /// Opens a case folder: `robot.json` or `robot.toml` (or `robot` given), `reference/`, `recordings/`, and
    /// `heldout/` if it is there.
    ///
    /// # Errors
    /// What is missing or cannot be read.
    pub fn open(folder: &Path, robot_name: Option<&str>, mapping: &Mapping, options: &ReadOptions) -> Result<Self> {
        let (robot, [reference, recordings, held_out]) = located(KnownEffects::default(), folder, robot_name)?;
        let case = Self::from_paths(robot, [&reference, &recordings, &held_out], mapping, options)?;
        case.with_simulation(&simulation_of(folder), mapping, options)
    }

    /// The same with logs of the user's simulator from files and folders; none at all is fine.
    ///
    /// # Errors
    /// What cannot be read, and robots that are not driven by torques: only these are simulated on recorded inputs.
    pub fn with_simulation(mut self, paths: &[PathBuf], mapping: &Mapping, options: &ReadOptions) -> Result<Self> {
        if paths.is_empty() {
            return Ok(self);
        }
        ensure!(
            self.robot.causality == Causality::TorqueDriven,
            "robot '{}' is {}: logs of a simulator are compared for torque-driven robots only; leave out --simulation",
            self.robot.name,
            self.robot.causality.name()
        );
        self.simulation = inputs::load(mapping, paths, options)?;
        Ok(self)
    }

    /// The same with visits that the user names: drives of one day, place and load.
    ///
    /// # Errors
    /// Robots of whose constants it is not known what moves between visits, and visits that contradict each other or are of
    /// no drive.
    pub fn with_visits(mut self, given: &[GivenVisit]) -> Result<Self> {
        if given.is_empty() {
            return Ok(self);
        }
        ensure!(
            self.robot.causality == Causality::TorqueDriven,
            "robot '{}' is {}: which of its constants move between visits is known of torque-driven robots only, so all \
             references count as one visit and all recordings as another; leave out --visit",
            self.robot.name,
            self.robot.causality.name()
        );
        visits::check(given, [&self.reference, &self.recordings])?;
        self.visits = given.to_vec();
        Ok(self)
    }

    /// A case from files and folders: references, recordings, held-out drives.
    ///
    /// # Errors
    /// What cannot be read, and a recording that is given twice.
    pub fn from_paths(
        robot: RobotSpec,
        paths: [&[PathBuf]; 3],
        mapping: &Mapping,
        options: &ReadOptions,
    ) -> Result<Self> {
        Self::within(Budget::default(), robot, paths, mapping, options)
    }

    /// The same on a budget of recorded time.
    ///
    /// # Errors
    /// As [`Self::from_paths`].
    pub fn within(
        budget: Budget,
        robot: RobotSpec,
        [reference, recordings, held_out]: [&[PathBuf]; 3],
        mapping: &Mapping,
        options: &ReadOptions,
    ) -> Result<Self> {
        let driven = robot.causality;
        let perhaps = |paths: &[PathBuf], budget: Budget| -> Result<(Loaded, Option<Coverage>)> {
            if paths.is_empty() {
                Ok((Loaded::default(), None))
            } else {
                budget.load(mapping, paths, options, (driven, &[]))
            }
        };
        let (reference, of_reference) = perhaps(reference, budget)?;
        let (recordings, of_recordings) = budget.load(mapping, recordings, options, (driven, &reference.reads))?;
        let (held_out, _) = perhaps(held_out, Budget::of_minutes(0.0))?;
        let named = FOLDERS.iter().zip([of_reference, of_recordings]);
        let coverage = named.filter_map(|((name, _), coverage)| Some(((*name).to_owned(), coverage?))).collect();
        Ok(Self { coverage, ..Self::new(robot, [reference, recordings, held_out])? })
    }

    /// A case of what was read already: references, recordings, held-out drives. A few samples that no such robot can
    /// show are left out and told as lost.
    ///
    /// # Errors
    /// A recording that is given twice, and one whose values no such robot can show.
    pub fn new(robot: RobotSpec, mut parts: [Loaded; 3]) -> Result<Self> {
        for loaded in &mut parts {
            for read in &mut loaded.reads {
                let files = file_names(read);
                let per_current = robot.torque_per_current.map(|[value, _]| value);
                let (recording, left_out) =
                    diagnosis::possible(read.recording.clone(), &robot.robot, per_current).with_context(|| files)?;
                read.recording = recording;
                loaded.impossible.extend(left_out);
            }
        }
        let [reference, recordings, held_out] = parts;
        let simulation = Loaded::default();
        let (coverage, visits) = (BTreeMap::new(), Vec::new());
        let case = Self { robot, reference, recordings, held_out, simulation, coverage, visits };
        case.refuse_twins()?;
        Ok(case)
    }

    /// All parts by the names of their folders.
    pub fn parts(&self) -> [(&'static str, &Loaded); 4] {
        let [reference, recordings, held_out] = FOLDERS.map(|(name, _)| name);
        [
            (reference, &self.reference),
            (recordings, &self.recordings),
            (held_out, &self.held_out),
            (SIMULATION, &self.simulation),
        ]
    }

    /// What was lost, in sentences.
    pub fn lost(&self) -> Vec<String> {
        self.parts().iter().flat_map(|(_, l)| l.lost()).collect()
    }

    /// What was lost of recordings and held-out drives, on which the answer rests: references stand in for each other.
    pub fn lost_of_recordings(&self) -> Vec<String> {
        self.recordings.lost().chain(self.held_out.lost()).collect()
    }

    /// Files and columns that were there and that nobody asked for, in sentences.
    pub fn not_used(&self) -> Vec<String> {
        let mut out = Vec::new();
        for (part, loaded) in self.parts() {
            if !loaded.ignored.is_empty() {
                out.push(format!("{part}: {}", loaded.ignored.join(", ")));
            }
            let unused = loaded.reads.iter().flat_map(|r| &r.unused);
            let mut columns: Vec<&str> = unused.map(|u| u.column.as_str()).collect();
            columns.sort_unstable();
            columns.dedup();
            if !columns.is_empty() {
                out.push(format!("{part}: columns {}", columns.join(", ")));
            }
        }
        out
    }

    /// When a recording begins, s: later than zero for a stretch of a long one.
    fn start_of(&self, name: &str) -> f64 {
        let chosen = self.coverage.values().flat_map(|c| &c.chosen);
        chosen.filter(|c| c.name == name).map(|c| c.interval[0]).next().unwrap_or_default()
    }

    /// What the simulation of a torque-driven robot is given beside its constants.
    ///
    /// # Errors
    /// Effects that nobody knows.
    fn given_effects(&self) -> Result<GivenEffects> {
        let acts: Vec<EffectAt> = self.robot.effects.iter().filter(|at| self.is_compared(at)).cloned().collect();
        Ok(self.robot.known.given(&acts)?)
    }

    /// Whether recordings are compared with simulations that have this effect: with free runs of the plant, and not of what sensors
    /// show, for which recordings are checked by themselves.
    fn is_compared(&self, at: &EffectAt) -> bool {
        let acts = |effect: &'static dyn Effect<f64>| effect.spec().redundancy == Redundancy::None;
        self.robot.causality == Causality::TorqueDriven && self.robot.known.find(&at.effect).is_ok_and(acts)
    }

    /// Effects of the robot file that no recording is compared with, in a sentence.
    fn not_compared(&self) -> Option<String> {
        let names = self.robot.effects.iter().filter(|at| !self.is_compared(at)).map(|at| at.effect.as_str());
        let names: Vec<&str> = names.collect();
        (!names.is_empty()).then(|| {
            format!(
                "robot '{}' gives its simulation effects that recordings are not compared with, and that may be found again: {}; do not add them to its file \
                 twice",
                self.robot.name,
                names.join(", ")
            )
        })
    }

    /// The case as the diagnosis takes it, for a torque-driven robot.
    ///
    /// # Errors
    /// Recordings without the signals that are needed.
    pub fn torque_driven(&self) -> Result<torque_driven::Case> {
        let [reference, recordings, _] = FOLDERS.map(|(name, _)| name);
        let runs = |l: &Loaded, visits: Vec<Option<Visit>>| -> Result<Vec<torque_driven::Run>> {
            let run = |(r, visit): (&Read, Option<Visit>)| {
                let run = torque_driven::Run::new(&r.recording).with_context(|| file_names(r))?;
                Ok(torque_driven::Run { from: self.start_of(r.recording.name()), visit, ..run })
            };
            l.reads.iter().zip(visits).map(run).collect()
        };
        let visited = |part: &str, l: &Loaded| runs(l, visits::of(part, l, &self.visits));
        let held_out = self
            .held_out
            .reads
            .iter()
            .map(|r| torque_driven::HeldOut::new(&r.recording).with_context(|| file_names(r)))
            .collect::<Result<Vec<_>>>()?;
        Ok(torque_driven::Case {
            robot: self.robot.robot,
            may_have_four_motors: !self.robot.is_chassis_stated,
            effects: self.given_effects()?,
            sigma: self.robot.sigma,
            pose_sigma: self.robot.pose_sigma,
            references: visited(reference, &self.reference)?,
            simulations: runs(&self.simulation, vec![None; self.simulation.reads.len()])?,
            recordings: visited(recordings, &self.recordings)?,
            held_out,
        })
    }
}

impl CaseFolder {
    /// The case as the diagnosis takes it, for a speed-driven robot.
    ///
    /// # Errors
    /// Recordings without the signals that are needed, or a robot file without torque per current.
    pub fn speed_driven(&self) -> Result<speed_driven::SteadyCase> {
        let [torque_per_current, torque_sigma] = self.robot.torque_per_current.with_context(|| {
            format!(
                "robot '{}' is speed-driven but its file has no torque_per_current (N m/A); add it",
                self.robot.name
            )
        })?;
        let radius = self.robot.robot.wheel_radius;
        let runs = |l: &Loaded| -> Result<Vec<speed_driven::SpeedRun>> {
            l.reads
                .iter()
                .map(|r| {
                    speed_driven::SpeedRun::new(&r.recording, radius, torque_per_current).with_context(|| file_names(r))
                })
                .collect()
        };
        Ok(speed_driven::SteadyCase {
            robot: self.robot.robot,
            sigma: self.robot.sigma,
            torque_sigma: torque_sigma / torque_per_current,
            geometry_sigma: self.robot.geometry_sigma,
            references: runs(&self.reference)?,
            recordings: runs(&self.recordings)?,
        })
    }
}

impl CaseFolder {
    /// The case as the diagnosis takes it, for a command-driven robot.
    ///
    /// # Errors
    /// Recordings without the signals that are needed.
    pub fn command_driven(&self) -> Result<command_driven::ResponseCase> {
        let runs = |l: &Loaded| -> Result<Vec<command_driven::ResponseRun>> {
            l.reads
                .iter()
                .map(|r| command_driven::ResponseRun::new(&r.recording).with_context(|| file_names(r)))
                .collect()
        };
        Ok(command_driven::ResponseCase {
            robot: self.robot.robot,
            geometry_sigma: self.robot.geometry_sigma,
            references: runs(&self.reference)?,
            recordings: runs(&self.recordings)?,
            held_out: runs(&self.held_out)?,
        })
    }
}

impl CaseFolder {
    /// The case as the diagnosis takes it.
    ///
    /// # Errors
    /// Recordings without the signals that are needed.
    pub fn case(&self) -> Result<diagnosis::Case> {
        Ok(match self.robot.causality {
            Causality::TorqueDriven => diagnosis::Case::TorqueDriven(Box::new(self.torque_driven()?)),
            Causality::SpeedDriven => diagnosis::Case::SpeedDriven(Box::new(self.speed_driven()?)),
            Causality::CommandDriven => diagnosis::Case::CommandDriven(Box::new(self.command_driven()?)),
        })
    }

    /// Diagnoses the case by what drives its robot; `stage` is called with what begins.
    ///
    /// # Errors
    /// Recordings without the signals that are needed, or that do not determine an answer.
    pub fn diagnose(&self, options: &Options, stage: &dyn Fn(&str)) -> Result<Diagnosis> {
        let mut out = diagnosis::diagnose(&self.case()?, options, stage)?;
        self.complete(&mut out);
        Ok(out)
    }

    /// Adds to a diagnosis what its files say: what long recordings stand for, and what of the robot file was not compared.
    pub fn complete(&self, diagnosis: &mut Diagnosis) {
        diagnosis.rest_on(&self.coverage);
        diagnosis.limits.extend(self.not_compared());
    }
}

/// The robot of a case folder (`robot.json` or `robot.toml`, or the one that is named), whose effects may be some of one's
/// own, and its three parts, of which only the recordings must be there.
///
/// # Errors
/// What is missing.
pub fn located(known: KnownEffects, folder: &Path, robot_name: Option<&str>) -> Result<(RobotSpec, [Vec<PathBuf>; 3])> {
    let shown = folder.display();
    ensure!(
        folder.is_dir(),
        "there is no case folder '{shown}'; \
         make one with robot.toml, reference/ and recordings/, or give files with --reference and --recordings"
    );
    let robot = match robot_name {
        Some(name) => robot_with(known, name)?,
        None => robot_with(known, &robot_of(folder)?.display().to_string())?,
    };
    let parts = folders(folder)?;
    let (name, what) = FOLDERS[1];
    ensure!(parts[1].is_dir(), "'{shown}' has no folder '{name}/'; make it and put {what} into it");
    Ok((robot, parts.map(|part| if part.is_dir() { vec![part] } else { Vec::new() })))
}

/// The files of a recording, for messages.
pub fn file_names(read: &Read) -> String {
    let names: Vec<&str> = read.sources.iter().map(|s| s.name.as_str()).collect();
    names.join(" + ")
}

/// The robot file of a case folder.
///
/// # Errors
/// When there is none, or both of TOML and JSON.
pub fn robot_of(folder: &Path) -> Result<PathBuf> {
    let found: Vec<PathBuf> =
        ["robot.json", "robot.toml"].iter().map(|f| folder.join(f)).filter(|f| f.exists()).collect();
    match found.as_slice() {
        [one] => Ok(one.clone()),
        [] => bail!("'{}' holds no robot.json or robot.toml; add one, or name a robot with --robot", folder.display()),
        _ => {
            bail!("'{}' holds both robot.json and robot.toml; keep one, or name a robot with --robot", folder.display())
        }
    }
}
