//! Replicas of a case: loads of steady driving drawn about those that were measured, of which it is known what is missing.
//!
//! A replica drives as steadily as the recordings did, at the same speeds and for as long. Its loads are those of the plant at constants
//! drawn about the calibrated ones, each off by as much as the references are off the calibrated plant, and by what drives of one robot
//! differ by: the usual scatter and the standard errors of loads are wide, so that they count by the share by which the references do differ,
//! or the recordings without any.

use std::collections::BTreeMap;

use inference::hypothesis::Dose;
use inference::robust::NINETY;
use inference::{DiagnosisError, Options};
use robot_model::Robot;
use robot_model::tunable::{COUNT as NUISANCES, tuned};
use verdict::{Diagnosis, Load, Loads, Quantity};

use crate::answer::of_whole_drives;
use crate::compare::{Reference, matching, ratios, references, scaled, scatter};
use crate::comparison::Comparison;
use crate::heading::may_be_one_slope;
use crate::model::{Operating, Tuned, predicted, tune};
use crate::name::{Open, name};
use crate::settings::NAMING;
use crate::{
    SpeedRun, SteadyCase, all_loads, differences, from_file, of_reference, standstill, take_off_zeros, track_of,
};

/// What replicas of a case are drawn from.
pub struct Replicas {
    /// The case without its drives.
    case: SteadyCase,
    robot: Robot<f64>,
    /// Constants as the references have them, or the robot file without any.
    calibrated: Tuned,
    of_references: Vec<Load>,
    of_recordings: Vec<Load>,
    /// The references together, which tell what the plant's laws lack.
    right: Vec<Reference>,
    /// By how much drives differ, over what is usual.
    spread: f64,
    open: Open,
    drives: Vec<(String, f64)>,
    references: usize,
}

impl Replicas {
    /// Measures the steady loads of a case.
    ///
    /// # Errors
    /// As [`crate::diagnose_steady`].
    pub fn new(case: &SteadyCase, options: &Options, progress: &dyn Fn(&str)) -> Result<Self, DiagnosisError> {
        if case.recordings.is_empty() {
            return Err(DiagnosisError::Empty { what: "recording" });
        }
        let robot = case.robot.checked()?;
        progress("measuring steady loads");
        let mut marked = case.clone();
        take_off_zeros(&mut marked);
        let of_file = standstill::track_of_file(&robot);
        standstill::mark(&mut marked.references, of_file);
        let of_references = all_loads(&marked.references).0;
        let right = references(&of_references);
        standstill::mark(&mut marked.recordings, track_of(&right).unwrap_or(of_file));
        let (of_recordings, withheld) = all_loads(&marked.recordings);
        if of_recordings.is_empty() {
            let reason = withheld.first().map_or_else(String::new, |w| format!("{}: {}", w.recording, w.reason));
            return Err(DiagnosisError::TooCalm { reason });
        }

        progress("calibrating on the references");
        let known: Vec<_> = right.iter().map(of_reference).collect();
        let calibrated = tune(&robot, &case.sigma, &known).ok_or(DiagnosisError::Singular { stage: "calibration" })?;
        let measured = of_recordings.iter().map(|l| (l.quantity, &l.recording));
        let one_slope = may_be_one_slope(measured, &marked.recordings);
        let spread = if right.is_empty() {
            spread(&of_recordings, &references(&of_recordings))
        } else {
            spread(&of_references, &right)
        };
        Ok(Self {
            spread,
            robot,
            calibrated,
            of_references,
            of_recordings,
            right,
            open: Open { same_robot: options.same_robot, one_slope, of_ground: false },
            drives: case.recordings.iter().map(|run| (run.name.clone(), seconds(run))).collect(),
            references: case.references.len(),
            case: SteadyCase { references: Vec::new(), recordings: Vec::new(), ..marked },
        })
    }

    /// The robot about which replicas are drawn.
    pub fn robot(&self) -> &Robot<f64> {
        &self.robot
    }

    /// Names of the recordings, with their lengths, s.
    pub fn drives(&self) -> Vec<(String, f64)> {
        self.drives.clone()
    }

    /// How many references the case has.
    pub fn references(&self) -> usize {
        self.references
    }

    /// Whether an effect changes any load that was measured in the recordings.
    pub fn is_seen(&self, dose: &Dose) -> bool {
        self.of_recordings.iter().map(Operating::of).any(|at| {
            let [with, without] =
                [std::slice::from_ref(dose), &[]].map(|doses: &[Dose]| predicted(&self.robot, doses, at));
            (with - without).abs() > 0.0
        })
    }

    /// The diagnosis of a replica with an effect, if any, and with so many references: on their own driving where there are as many, else
    /// on that of the recordings. `normal` draws numbers of unit variance.
    ///
    /// # Errors
    /// Where a calibration has no solution.
    pub fn answer(
        &self,
        hidden: Option<&Dose>,
        references: usize,
        normal: &mut dyn FnMut() -> f64,
    ) -> Result<Diagnosis, DiagnosisError> {
        let drawn = Drawn::new(self, normal);
        let right: Vec<Load> = self.driven(references).iter().map(|l| drawn.load(l, &[], normal)).collect();
        let doses: Vec<Dose> = hidden.cloned().into_iter().collect();
        // A cold drive train loads every straight drive of its day.
        let cold = self.spread * NAMING.priors.unnamed_straight.ln() / NINETY;
        let mut of_the_day: BTreeMap<&str, f64> = BTreeMap::new();
        let mut recordings: Vec<Load> = Vec::new();
        for load in &self.of_recordings {
            let own = *of_the_day.entry(&load.recording).or_insert_with(|| cold * normal());
            let mut drawn = drawn.load(load, &doses, normal);
            if drawn.quantity == Quantity::StraightLoad {
                drawn.value *= own.exp();
                drawn.error *= own.exp();
            }
            recordings.push(drawn);
        }
        self.diagnosed(&right, &recordings)
    }

    /// What loads of so many drives are drawn about.
    fn driven(&self, references: usize) -> Vec<Load> {
        if references == self.references {
            return self.of_references.clone();
        }
        let of = |(place, (name, _)): (usize, &(String, f64))| {
            let own = self.of_recordings.iter().filter(|l| l.recording == *name).cloned();
            own.map(|l| Load { recording: format!("{name}_{place}"), ..l }).collect::<Vec<_>>()
        };
        self.drives.iter().cycle().take(references).enumerate().flat_map(of).collect()
    }

    fn diagnosed(&self, right: &[Load], recordings: &[Load]) -> Result<Diagnosis, DiagnosisError> {
        let Self { case, robot, .. } = self;
        let by_file = right.is_empty();
        let refs = if by_file { from_file(case, robot, recordings) } else { references(right) };
        let known: Vec<_> = if by_file { Vec::new() } else { refs.iter().map(of_reference).collect() };
        let calibrated = tune(robot, &case.sigma, &known).ok_or(DiagnosisError::Singular { stage: "calibration" })?;
        let comparison = Comparison::new(&differences(recordings, &refs), robot, &case.sigma, &calibrated);
        let naming = comparison.as_ref().and_then(|comparison| name(comparison, self.open));
        let drift = comparison.as_ref().and_then(Comparison::side_drift);
        let (ratios, pooled) = ratios(recordings, &refs, &tuned(robot, &case.sigma, &calibrated.theta));
        Ok(of_whole_drives(naming.as_ref(), &Loads { ratios, pooled, drift, ..Loads::default() }))
    }
}

/// A robot drawn about that of the references.
struct Drawn<'a> {
    of: &'a Replicas,
    /// The calibrated robot, and the drawn one.
    calibrated: Robot<f64>,
    robot: Robot<f64>,
    /// By how much torques for a current, and the geometry of turns, are off what the robot file says, in its sigmas.
    off: [f64; 2],
}

impl<'a> Drawn<'a> {
    fn new(of: &'a Replicas, normal: &mut dyn FnMut() -> f64) -> Self {
        let Tuned { theta, covariance } = &of.calibrated;
        let numbers: [f64; NUISANCES] = std::array::from_fn(|_| normal());
        let sigmas = covariance.llt(faer::Side::Lower).ok().map(|cholesky| cholesky.L().to_owned());
        let moved = |k: usize| sigmas.as_ref().map_or(0.0, |l| (0..=k).map(|i| l[(k, i)] * numbers[i]).sum());
        let drawn: [f64; NUISANCES] = std::array::from_fn(|k| theta[k] + moved(k));
        // References have shown both.
        let off = if of.references == 0 { [normal(), normal()] } else { [0.0; 2] };
        Self {
            calibrated: tuned(&of.robot, &of.case.sigma, theta),
            robot: tuned(&of.robot, &of.case.sigma, &drawn),
            off,
            of,
        }
    }

    /// A load that was measured, as this robot shows it.
    fn load(&self, measured: &Load, doses: &[Dose], normal: &mut dyn FnMut() -> f64) -> Load {
        let quantity = measured.quantity;
        let right = matching(measured, &self.of.right);
        let lacking = right.map_or(0.0, |(r, _)| r.centre - predicted(&self.calibrated, &[], r.at()));
        let off = self.off[usize::from(quantity == Quantity::EffectiveTrack)];
        let beside = off * self.of.case.sigma_beside_constants(quantity);
        let own = self.of.spread * scaled(measured).1.hypot(scatter(quantity)) * normal();
        let value = predicted(&self.robot, doses, Operating::of(measured)) + lacking + beside + own;
        if quantity.is_difference() {
            return Load { value, ..measured.clone() };
        }
        let value = value.exp();
        Load { value, error: scaled(measured).1 * value, ..measured.clone() }
    }
}

/// By how much loads differ from drive to drive, over what their standard errors and the usual scatter say: at most as much.
fn spread(loads: &[Load], pooled: &[Reference]) -> f64 {
    let usual = f64::from(NAMING.replicas.usual_drives);
    let off = |l: &Load| {
        let (value, error) = scaled(l);
        let (r, _) = matching(l, pooled)?;
        Some(((value - r.centre) / error.hypot(scatter(l.quantity))).powi(2))
    };
    let squares: f64 = loads.iter().filter_map(off).sum();
    let free = loads.len().saturating_sub(pooled.len()) as f64;
    ((squares + usual) / (free + usual)).sqrt().min(1.0)
}

fn seconds(run: &SpeedRun) -> f64 {
    run.time.last().zip(run.time.first()).map_or(0.0, |(last, first)| last - first)
}

#[cfg(test)]
mod tests {
    use inference::hypothesis::{Place, Variant, variants};
    use robot_model::effects::{rolling_resistance, transport_delay};
    use verdict::Verdict;

    use super::*;
    use crate::testing::{case, drive, rounds};

    fn replicas(references: usize) -> Replicas {
        let runs = |name: &str, count: usize| {
            (0..count).map(|k| SpeedRun { name: format!("{name}_{k}"), ..drive(&rounds(3), false) }).collect()
        };
        let case = case(runs("right", references), runs("recording", 2));
        Replicas::new(&case, &Options::default(), &|_| ()).expect("replicas")
    }

    /// An effect of a size, in its own unit.
    fn dose(id: &str, size: f64) -> Dose {
        let is_it = |v: &Variant| v.spec().id == id && v.place == Place::Whole;
        variants(true).into_iter().find(is_it).expect("in the catalogue").dose(&[size], None)
    }

    fn zeros() -> impl FnMut() -> f64 {
        || 0.0
    }

    #[test]
    fn a_replica_without_a_fault_is_a_right_one_with_references_and_without() {
        for references in [0, 2] {
            let answer = replicas(references).answer(None, references, &mut zeros()).expect("an answer");
            assert_eq!(answer.verdict, Verdict::NoMismatch, "{references} references: {:?}", answer.ranked);
        }
    }

    #[test]
    fn a_hidden_effect_is_found_with_references_of_its_own_and_on_the_drives_of_the_recordings() {
        let replicas = replicas(2);
        let hidden = dose(rolling_resistance::SPEC.id, 0.2);
        assert!(replicas.is_seen(&hidden) && !replicas.is_seen(&dose(transport_delay::SPEC.id, 0.2)));
        for references in [2, 3] {
            let answer = replicas.answer(Some(&hidden), references, &mut zeros()).expect("an answer");
            assert_eq!(answer.verdict, Verdict::Explained);
            let class = &answer.indistinguishable[0];
            assert!(class.iter().any(|id| id == rolling_resistance::SPEC.id), "{class:?}");
        }
    }

    #[test]
    fn what_a_day_adds_to_the_straight_loads_is_drawn_for_each_drive() {
        let replicas = replicas(2);
        assert_eq!((replicas.references(), replicas.drives().len()), (2, 2));
        assert!(replicas.drives().iter().all(|(_, seconds)| *seconds > 100.0));
        let driven = replicas.driven(3);
        // Drives of these tests are all alike.
        assert!((0.0..0.5).contains(&replicas.spread), "{}", replicas.spread);
        let names: std::collections::BTreeSet<&str> = driven.iter().map(|l| l.recording.as_str()).collect();
        assert_eq!(names.into_iter().collect::<Vec<_>>(), ["recording_0_0", "recording_0_2", "recording_1_1"]);
    }
}
