//! The whole way of a torque-driven case, from recordings to a verdict.

use robot_model::Robot;

use crate::calibrate::{Calibration, calibrate, problem};
use crate::case::Case;
use crate::decide::decide;
use crate::decision::Decision;
use crate::fit::{Fitted, Hypothesis, Problem};
use crate::four_motors::{self, Found, with_four_motors};
use crate::judged::Judged;
use crate::moved_constants::constants_moved;
use crate::nothing::{retune, without_effect};
use crate::own_effects::Runaway;
use crate::redundancy::{Redundant, check};
use crate::run::{Run, largest_torque};
use crate::search::search;
use crate::settings::fit::{Calibrating, SETTINGS};
use crate::simulator::{Simulator, check_inputs};
use crate::trial::Trial;
use crate::visit::{Visit, VisitNumbers, visits_of};
use crate::windows::{Cut, CutOptions, cut};
use inference::{DiagnosisError, KnownEffects, Options};
use verdict::{Diagnosis, Verdict};

use crate::{headings, next, own_effects, stand_in, unnamed};

const CALIBRATING: Calibrating = SETTINGS.calibration;

/// What the references of a case teach: enough to diagnose any number of recordings of that robot.
pub struct Calibrated {
    /// The robot, on the chassis that drives show where its file does not say it.
    pub(crate) robot: Robot<f64>,
    /// That it has a motor at each wheel, where drives show it.
    four_motors: Option<Found>,
    /// What references or logs of a simulator gain by that, nats.
    gain_of_four_motors: f64,
    /// What the user's simulator believes, where its logs were given.
    pub(crate) simulator: Option<Simulator>,
    references: Vec<Cut>,
    /// Visits of the references.
    pub(crate) visits: Vec<Option<Visit>>,
    pub(crate) calibration: Calibration,
    pub(crate) largest_torque: f64,
    /// Effects of one's own that no free run of the references can hold.
    runaways: Vec<Runaway>,
}

impl Calibrated {
    /// Calibrates the model on the references of a case; its recordings do not matter.
    ///
    /// # Errors
    /// When there is nothing to compare with, or the references do not determine the model.
    pub fn new(case: &Case, options: &Options) -> Result<Self, DiagnosisError> {
        Self::up_to(largest_torque(&case.references), case, options)
    }

    /// The same with effects that scale with the torque probed up to `largest_torque`, N m.
    fn up_to(largest_torque: f64, case: &Case, options: &Options) -> Result<Self, DiagnosisError> {
        let on_its_chassis = Self::on_its_chassis(largest_torque, case, options)?;
        let by = if on_its_chassis.simulator.is_some() { "the logs of the simulator" } else { "the references" };
        match Found::by(by, on_its_chassis.gain_of_four_motors) {
            None => Ok(on_its_chassis),
            found => {
                let (four, _) = Self::with_four_motors(largest_torque, case, options)?;
                Ok(Self { four_motors: found, ..four })
            }
        }
    }

    /// The same of the robot with a motor at each wheel, and the case of that robot.
    fn with_four_motors(largest_torque: f64, case: &Case, options: &Options) -> Result<(Self, Case), DiagnosisError> {
        let case = Case { robot: with_four_motors(&case.robot), may_have_four_motors: false, ..case.clone() };
        Ok((Self::on_its_chassis(largest_torque, &case, options)?, case))
    }

    /// The same of the robot as it is in the case.
    fn on_its_chassis(largest_torque: f64, case: &Case, options: &Options) -> Result<Self, DiagnosisError> {
        let robot = case.robot.checked()?;
        // A simulator's log says what the simulation believes, as the robot file does, and nothing about noise.
        let (simulated, references): (Vec<Run>, Vec<Run>) =
            case.references.iter().cloned().partition(Run::is_noise_free);
        let logs = [case.simulations.clone(), simulated].concat();
        let simulator = if logs.is_empty() {
            None
        } else {
            let logs: Vec<Run> = logs.iter().map(Run::as_recorded).collect();
            let mut logs = cut_all(&logs, &Redundant::default(), case, &robot, options)?;
            for log in &mut logs {
                log.given = case.effects.doses_of_simulator(&log.name);
            }
            // What a simulator believes are constants.
            let of_constants = Options { known: KnownEffects::default(), ..*options };
            Some(Simulator::new(case, &robot, &logs, largest_torque, &of_constants)?)
        };
        let mut calibration = Calibration::by_file();
        if let Some(simulator) = &simulator {
            calibration.theta = simulator.theta;
        }
        let mut out = Self {
            robot,
            four_motors: None,
            gain_of_four_motors: simulator.as_ref().map_or(0.0, |s| s.gain_of_four_motors),
            simulator,
            references: Vec::new(),
            visits: Vec::new(),
            calibration,
            largest_torque,
            runaways: Vec::new(),
        };
        if references.is_empty() {
            return Ok(out);
        }

        out.visits = visits_of(&references);
        out.references = cut_all(&references, &check(&references, &[], None), case, &robot, options)?;
        number(&mut out.references, &VisitNumbers::new(&out.visits, &[]).references);
        own_effects::ensure_given_is_stable(&robot, &out.references, options.step)?;
        out.runaways = own_effects::runaways(options.known, &robot, &out.references, options.step);
        let options = &own_effects::without(options, &out.runaways);
        out.calibration = calibrate(&robot, &case.sigma, &out.references, largest_torque, options)?;
        if four_motors::is_open(case, &robot) && out.simulator.is_none() {
            let calibrated = (&out.references[..], &out.calibration);
            out.gain_of_four_motors =
                four_motors::gain_of_references(case, &robot, calibrated, largest_torque, options);
        }
        Ok(out)
    }

    /// Diagnoses the recordings of a case with the same robot and references. `progress` is called
    /// with the stage that begins.
    ///
    /// Where they hold a larger torque than the references, the references are screened anew with that torque, so that the
    /// answer is that of [`diagnose`].
    ///
    /// # Errors
    /// When there is no recording, or one is too short.
    pub fn diagnose(
        &self,
        case: &Case,
        options: &Options,
        progress: &dyn Fn(&str),
    ) -> Result<Diagnosis, DiagnosisError> {
        let (out, is_turned) = self.diagnose_turned(case, options, progress, true)?;
        // Where no slope is found, nothing says where recordings head.
        let out = if is_turned && !headings::is_slope(&out) {
            self.diagnose_turned(case, options, progress, false)?.0
        } else {
            out
        };
        Ok(self.of_some_drives(case, options, progress, &out)?.unwrap_or(out))
    }

    /// The same with recordings that may be turned until the slopes that they show agree, and whether any is.
    fn diagnose_turned(
        &self,
        case: &Case,
        options: &Options,
        progress: &dyn Fn(&str),
        may_turn: bool,
    ) -> Result<(Diagnosis, bool), DiagnosisError> {
        if case.recordings.is_empty() {
            return Err(DiagnosisError::Empty { what: "recording" });
        }
        check_inputs(case)?;
        let robot = self.robot;
        let sensors = check(&case.recordings, &case.references, Some(robot.wheel_radius));
        let visits = VisitNumbers::new(&self.visits, &visits_of(&case.recordings));
        let mut recordings = cut_all(&case.recordings, &sensors, case, &robot, options)?;
        number(&mut recordings, &visits.recordings);
        own_effects::ensure_given_is_stable(&robot, &recordings, options.step)?;
        let known = own_effects::without(options, &self.runaways).known;
        let runaways =
            [self.runaways.clone(), own_effects::runaways(known, &robot, &recordings, options.step)].concat();
        let options = &own_effects::without(options, &runaways);
        let largest = largest_torque(&case.recordings).max(self.largest_torque);
        let taught = if largest > self.largest_torque && !self.references.is_empty() {
            calibrate(&robot, &case.sigma, &self.references, largest, options)?
        } else {
            self.calibration.clone()
        };
        let mut calibration = taught.for_visits(&visits);
        let turns = if may_turn {
            let problem = problem(&robot, case, &recordings, &calibration, largest, options);
            headings::turns(&problem, &case.recordings)
        } else {
            vec![0.0; recordings.len()]
        };
        headings::turn(&mut recordings, &turns);
        if self.references.is_empty() {
            let problem = problem(&robot, case, &recordings, &calibration, largest, options);
            let origin = problem.begin(&Hypothesis::default(), problem.origin(), None);
            calibration.learn_shaking(&problem, &without_effect(&problem, &origin));
        }
        let weigh = |calibration: &Calibration, known: &[Trial]| {
            let problem = problem(&robot, case, &recordings, calibration, largest, options);
            let found = search(&problem, known, progress);
            let decision = decide(&problem, &found, &calibration.regimes.scatter, &calibration.null_scores);
            (found, decision)
        };
        let (mut found, mut decision) = weigh(&calibration, &[]);
        let level = decision.level;
        let numbered = (&recordings[..], &visits, largest);
        if let Some((four, of_four)) =
            self.if_four_motors(case, options, numbered, (&calibration, &found.retuned, &decision))?
        {
            return four.diagnose_turned(&of_four, options, progress, may_turn);
        }
        // References of another visit, or several visits: what is found may be constants that moved between them.
        if calibration.moves.may_have_been(!self.references.is_empty()) && !decision.finds_nothing() {
            let moved = calibration.clone().on_another_visit();
            let [before, after] =
                [&calibration, &moved].map(|c| problem(&robot, case, &recordings, c, largest, options));
            if let Some(known) = constants_moved(&before, &after, &found, &decision) {
                calibration = moved;
                (found, decision) = weigh(&calibration, &known);
            }
        }
        // Without references, and with one, the noise is what the best hypothesis leaves, and hypotheses are weighed by the noise.
        let is_noise_learnt = self.references.len() < CALIBRATING.enough_references;
        // A law is compared with what a tuned simulation usually leaves of wheels and gyro: noise of theirs that is learnt holds what the
        // law is to explain. How much the body shakes its accelerometer no law explains.
        let usual = self.references.is_empty().then(|| (calibration.clone(), found.retuned.clone(), decision.clone()));
        for _ in 1..if is_noise_learnt { CALIBRATING.most_searches } else { 1 } {
            let before = problem(&robot, case, &recordings, &calibration, largest, options);
            let best = decision.scored.first().filter(|s| s.probability > decision.none);
            if !calibration.learn_noise(&before, best.map_or(&found.retuned, |s| &s.trial.fitted)) {
                break;
            }
            (found, decision) = weigh(&calibration, &[]);
            // Noise that is learnt from what is left cannot say that too much is left.
            decision = decision.with_level(level);
        }
        // What is likeliest a constant that moved is told as that constant, and as no other.
        let before = problem(&robot, case, &recordings, &calibration, largest, options);
        let made_of = (&before, &calibration);
        decision = self.weighed_again(case, options, &sensors, made_of, &decision, &found.retuned);
        let moved = decision.moved.as_ref().filter(|_| decision.finds_nothing());
        if let Some((place, usual, point)) = moved.and_then(|trial| stand_in::as_constant(&before, trial)) {
            calibration = calibration.with_free(place, usual);
            let free = problem(&robot, case, &recordings, &calibration, largest, options);
            let none = Hypothesis::default();
            found.retuned = retune(&free, &none, free.begin(&none, point, None));
        }
        let problem = problem(&robot, case, &recordings, &calibration, largest, options);
        progress("comparing on data that was not fitted");
        let answer = self.judged(case, options, &sensors, (&problem, &calibration), &decision);
        let mut out = answer.diagnosis(&found.retuned, found.screened.clone());
        out.limits.extend(self.four_motors.map(Found::sentence));
        out.limits.extend(headings::sentence(&recordings, &turns));
        out.limits.extend(runaways.into_iter().map(|r| r.sentence));
        if unnamed::Asked::of(&answer, &found.retuned, out.verdict) {
            progress("looking for a law without a name");
            let as_found = (&calibration, &found.retuned, &decision);
            let (taught, retuned, decision) = usual.as_ref().map_or(as_found, |(c, r, d)| (c, r, d));
            let problem = self::problem(&robot, case, &recordings, taught, largest, options);
            let law = unnamed::tell(&self.judged(case, options, &sensors, (&problem, taught), decision), retuned, &out);
            out.sentences.extend(law.sentence().filter(|_| out.verdict == Verdict::Unknown));
            out.law = Some(law);
        }
        if let Some(length) = options.next {
            progress("looking for the drive that tells the rivals apart");
            out.next = Some(next::advise(&answer, &found.retuned, length));
        }
        Ok((out, turns.iter().any(|turn| *turn != 0.0)))
    }

    /// What is taught of the robot with a motor at each wheel, and the case of that robot, where the recordings show that it has them.
    /// Drives that say little of the chassis leave it to them, if they show anything at all.
    fn if_four_motors(
        &self,
        case: &Case,
        options: &Options,
        (recordings, visits, largest): (&[Cut], &VisitNumbers, f64),
        (calibration, retuned, decision): (&Calibration, &Fitted, &Decision),
    ) -> Result<Option<(Self, Case)>, DiagnosisError> {
        let is_asked = self.references.is_empty() || !decision.finds_nothing();
        if !(is_asked && four_motors::is_open(case, &self.robot) && four_motors::is_unsure(self.gain_of_four_motors)) {
            return Ok(None);
        }

        let (mut four, of_four) = Self::with_four_motors(self.largest_torque, case, options)?;
        let calibrated = four.calibration.clone().for_visits(visits);
        let [coupled, motors] = [(&self.robot, calibration), (&four.robot, &calibrated)]
            .map(|(robot, calibration)| problem(robot, case, recordings, calibration, largest, options));
        let gain = four_motors::gain_of_recordings(&coupled, &motors, retuned, decision);
        four.four_motors = Found::by("the recordings", gain + self.gain_of_four_motors);
        Ok(four.four_motors.is_some().then_some((four, of_four)))
    }

    /// A decision without effects that may be nothing or that left-out recordings do not need, and on the side that these tell.
    fn weighed_again(
        &self,
        case: &Case,
        options: &Options,
        sensors: &Redundant,
        made_of: (&Problem<'_>, &Calibration),
        decision: &Decision,
        retuned: &Fitted,
    ) -> Decision {
        let decision = self.judged(case, options, sensors, made_of, decision).without_sizes_of_zero(retuned);
        let decision = self.judged(case, options, sensors, made_of, &decision).without_unconfirmed(retuned);
        let decision = self.judged(case, options, sensors, made_of, &decision).with_either_side();
        self.judged(case, options, sensors, made_of, &decision).with_what_forecasts_better()
    }

    /// What an answer is made of.
    fn judged<'a>(
        &'a self,
        case: &'a Case,
        options: &'a Options,
        sensors: &'a Redundant,
        (problem, calibration): (&'a Problem<'a>, &'a Calibration),
        decision: &'a Decision,
    ) -> Judged<'a> {
        Judged {
            case,
            options,
            problem,
            references: &self.references,
            visits: &self.visits,
            calibration,
            sensors,
            decision,
            simulator: self.simulator.as_ref(),
        }
    }
}

/// Diagnoses a torque-driven case. `progress` is called with the stage that begins.
///
/// # Errors
/// When there is nothing to compare with, or the recordings do not determine the model.
pub fn diagnose(case: &Case, options: &Options, progress: &dyn Fn(&str)) -> Result<Diagnosis, DiagnosisError> {
    if !case.references.iter().all(Run::is_noise_free) {
        progress("calibrating on the references");
    }
    let largest = largest_torque(&case.references).max(largest_torque(&case.recordings));
    Calibrated::up_to(largest, case, options)?.diagnose(case, options, progress)
}

/// Writes down which visit each run is of.
pub(crate) fn number(cuts: &mut [Cut], visits: &[usize]) {
    cuts.iter_mut().zip(visits).for_each(|(cut, visit)| cut.visit = Some(*visit));
}

/// Runs without their sensors' faults, cut into segments.
pub(crate) fn cut_all(
    runs: &[Run],
    sensors: &Redundant,
    case: &Case,
    robot: &Robot<f64>,
    options: &Options,
) -> Result<Vec<Cut>, DiagnosisError> {
    let cutting = CutOptions {
        segment: options.segment,
        pose_sigma: case.pose_sigma,
        gyro: sensors.gyro,
        wheel_radius: robot.wheel_radius,
        contacts: robot.contacts(),
    };
    runs.iter()
        .map(|run| {
            let c = cut(&sensors.corrected(run), &cutting);
            if c.segments.is_empty() {
                let needed = (2.0 * options.segment / c.period) as usize;
                return Err(DiagnosisError::TooShort { recording: c.name, rows: c.torque.len(), needed });
            }
            Ok(Cut { given: case.effects.doses(&run.name), ..c })
        })
        .collect()
}
