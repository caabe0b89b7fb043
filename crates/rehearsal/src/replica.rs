//! A replica: a robot drawn about the robot file, its fault-free references, and the drives of its recordings.

use std::collections::BTreeMap;

use inference::hypothesis::Dose;
use inference::{DiagnosisError, Options};
use recordings::{Channel, Clock, Recording, RecordingError, Signal};
use robot_model::tunable::{COUNT, tunables, tuned};
use robot_model::{Active, Robot};
use torque_driven::{Calibrated, Case, Run, Visit, simulate};

use crate::random::{Purpose, Stream};
use crate::score::Scored;
use crate::sensors::{Noise, Sigmas, shown};
use crate::settings::{Constants, SETTINGS};

const CONSTANTS: Constants = SETTINGS.constants;

/// A drive whose inputs are driven again.
#[derive(Debug, Clone)]
pub(crate) struct Template {
    /// What was recorded: rows, gaps and rates of its channels.
    pub(crate) run: Run,
    /// Its torques.
    inputs: Recording,
}

impl Template {
    /// The beginning of a run.
    ///
    /// # Errors
    /// When that is too short to be diagnosed.
    pub(crate) fn new(run: &Run, seconds: f64, options: &Options) -> Result<Self, DiagnosisError> {
        let run = beginning(run, seconds);
        let needed = (options.segment / run.period).ceil() as usize + 1;
        if run.rows() < needed {
            return Err(DiagnosisError::TooShort { recording: run.name.clone(), rows: run.rows(), needed });
        }
        let inputs = inputs(&run).map_err(|e| unreadable(&run, &e))?;
        Ok(Self { run, inputs })
    }

    /// The same driven on another visit.
    pub(crate) fn of_visit(&self, visit: Option<Visit>) -> Self {
        Self { run: Run { visit, ..self.run.clone() }, inputs: self.inputs.clone() }
    }

    /// What ideal sensors would show of it.
    ///
    /// # Errors
    /// When the simulation does not stay finite.
    pub(crate) fn ideal(
        &self,
        robot: &Robot<f64>,
        given: &[Dose],
        hidden: Option<&Dose>,
        options: &Options,
    ) -> Result<Recording, DiagnosisError> {
        let effects: Vec<Active<f64>> = given.iter().chain(hidden).map(Dose::active).collect();
        simulate(robot, &effects, &self.inputs, options)
    }
}

fn unreadable(run: &Run, why: &RecordingError) -> DiagnosisError {
    DiagnosisError::Impossible { recording: run.name.clone(), what: why.to_string() }
}

/// The rows of a run up to a time.
fn beginning(run: &Run, seconds: f64) -> Run {
    let rows = ((seconds / run.period).round().max(1.0) as usize).min(run.rows());
    let cut = |channel: &Vec<Option<f64>>| channel[..rows].to_vec();
    Run {
        name: run.name.clone(),
        from: 0.0,
        visit: run.visit.clone(),
        period: run.period,
        torque: run.torque[..rows].to_vec(),
        angle: run.angle.each_ref().map(cut),
        gyro: cut(&run.gyro),
        accel: run.accel.each_ref().map(cut),
        pose: run.pose.each_ref().map(cut),
        held_torques: run.held_torques,
    }
}

/// The torques of a run as a recording.
fn inputs(run: &Run) -> Result<Recording, RecordingError> {
    let stamps: Vec<i64> = (0..run.rows()).map(|k| (k as f64 * run.period * 1e9).round() as i64).collect();
    let side = |signal: Signal, j: usize| {
        let torque = run.torque.iter().map(|row| row[j]).collect();
        Channel::new(signal, 0, stamps.clone(), torque)
    };
    let channels = vec![side(Signal::TorqueLeft, 0)?, side(Signal::TorqueRight, 1)?];
    Recording::new(run.name.clone(), vec![Clock { name: run.name.clone(), nominal_rate_hz: None }], channels)
}

/// What all replicas share.
pub(crate) struct Common<'a> {
    /// The user's case; of its drives nothing but the templates is used.
    pub(crate) case: &'a Case,
    pub(crate) options: &'a Options,
    pub(crate) seed: u64,
    pub(crate) references: Vec<Template>,
    pub(crate) recordings: Vec<Template>,
    pub(crate) sigmas: Sigmas,
}

/// A robot of its own with its references, ready to be diagnosed with anything hidden in its recordings.
pub(crate) struct Replica {
    /// Its robot in each recording.
    pub(crate) robots: Vec<Robot<f64>>,
    noise: Vec<Noise>,
    /// The case without recordings.
    case: Case,
    calibrated: Calibrated,
}

impl Replica {
    /// Draws a robot, drives its references and calibrates on them.
    ///
    /// # Errors
    /// When the references do not determine the model.
    pub(crate) fn new(common: &Common<'_>, number: usize) -> Result<Self, DiagnosisError> {
        let (case, seed) = (common.case, common.seed);
        let theta = constants(common, number)?;
        let of_visits = moves_of_visits(common, number);
        let of_drive = |drive: usize, template: &Template| {
            let mut stream = Stream::new(seed, Purpose::Drive, &[number, drive]);
            let mut moved = theta.map(|x| x + CONSTANTS.between_drives * stream.normal());
            let visit = template.run.visit.as_ref().and_then(|visit| of_visits.get(visit.name.as_str()));
            visit.into_iter().flatten().zip(&mut moved).for_each(|(by, x)| *x += by);
            tuned(&case.robot, &case.sigma, &moved)
        };
        let noise = |drive: usize, template: &Template| Noise::draw(&template.run, seed, [number, drive]);

        // Recordings have the first numbers: one reference more or less leaves their noise as it is.
        let first = common.recordings.len();
        let references = common.references.iter().zip(first..).map(|(template, drive)| {
            let name = format!("reference {}", drive - first + 1);
            // What the simulation is given goes by the name under which the drive is diagnosed.
            let given = case.effects.doses(&name);
            let ideal = template.ideal(&of_drive(drive, template), &given, None, common.options)?;
            Ok(Run { name, ..shown(&template.run, &ideal, &common.sigmas, &noise(drive, template)) })
        });
        let references: Vec<Run> = references.collect::<Result<_, DiagnosisError>>()?;
        let (effects, sigma, pose_sigma) = (case.effects.clone(), case.sigma, case.pose_sigma);
        let base = Case { effects, sigma, pose_sigma, references, ..Case::new(case.robot) };

        Ok(Self {
            robots: common.recordings.iter().enumerate().map(|(drive, template)| of_drive(drive, template)).collect(),
            noise: common.recordings.iter().enumerate().map(|(drive, template)| noise(drive, template)).collect(),
            calibrated: Calibrated::new(&base, common.options)?,
            case: base,
        })
    }

    /// The recordings with an effect, or none, hidden in them.
    ///
    /// # Errors
    /// When a simulation does not stay finite.
    pub(crate) fn recordings(&self, common: &Common<'_>, hidden: Option<&Dose>) -> Result<Vec<Run>, DiagnosisError> {
        let drives = common.recordings.iter().zip(&self.robots).zip(&self.noise);
        let one = |((template, robot), noise): ((&Template, &Robot<f64>), &Noise)| {
            let given = common.case.effects.doses(&template.run.name);
            let ideal = template.ideal(robot, &given, hidden, common.options)?;
            Ok(shown(&template.run, &ideal, &common.sigmas, noise))
        };
        drives.map(one).collect()
    }

    /// The answer to these recordings, scored.
    pub(crate) fn answer(&self, common: &Common<'_>, recordings: Vec<Run>, hidden: Option<&str>) -> Scored {
        let case = Case { recordings, ..self.case.clone() };
        match self.calibrated.diagnose(&case, common.options, &|_| {}) {
            Ok(answer) => Scored::new(&answer, hidden),
            Err(why) => Scored::failed(why.to_string()),
        }
    }
}

/// How far constants moved to each visit that has a name, in the robot file's sigmas; the first is where they are without.
fn moves_of_visits<'a>(common: &Common<'a>, number: usize) -> BTreeMap<&'a str, [f64; COUNT]> {
    let mut names: Vec<&str> = Vec::new();
    for run in common.case.references.iter().chain(&common.case.recordings) {
        let name = run.visit.as_ref().map(|visit| visit.name.as_str());
        names.extend(name.filter(|name| !names.contains(name)));
    }
    let usual = tunables::<f64>().map(|t| t.between_visits);
    let moves = |visit: usize| {
        let mut stream = Stream::new(common.seed, Purpose::Visit, &[number, visit]);
        usual.map(|sigma| if visit == 0 { 0.0 } else { sigma * stream.normal() })
    };
    names.into_iter().enumerate().map(|(visit, name)| (name, moves(visit))).collect()
}

/// Constants of a robot that can exist, in the robot file's sigmas.
fn constants(common: &Common<'_>, number: usize) -> Result<[f64; COUNT], DiagnosisError> {
    let draw = |again: usize| {
        let mut stream = Stream::new(common.seed, Purpose::Constants, &[number, again]);
        [0.0; COUNT].map(|_| stream.normal_within(CONSTANTS.farthest))
    };
    let case = common.case;
    let can_be = |theta: &[f64; COUNT]| tuned(&case.robot, &case.sigma, theta).checked();
    for again in 1..CONSTANTS.tries {
        let theta = draw(again);
        if can_be(&theta).is_ok() {
            return Ok(theta);
        }
    }
    let last = draw(0);
    can_be(&last)?;
    Ok(last)
}
