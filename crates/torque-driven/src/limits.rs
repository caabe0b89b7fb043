//! What limits an answer: what was not recorded or stated, and what was taken for it.

use robot_model::effect::Redundancy;
use robot_model::tunable::{Tunable, tunables};

use crate::judged::Judged;
use crate::settings::decision::SETTINGS;
use crate::visit;
use crate::windows::Segment;

impl Judged<'_> {
    /// The constants of which the usual sigma was taken.
    fn usual_sigmas(&self) -> Option<String> {
        let is_usual = |(k, t): &(usize, &Tunable<f64>)| {
            t.between_visits >= SETTINGS.retune.measurable && self.case.sigma[*k] == t.sigma
        };
        let all = tunables::<f64>();
        let names: Vec<String> = all.iter().enumerate().filter(is_usual).map(|(_, t)| t.id.replace('_', " ")).collect();
        (!names.is_empty()).then(|| {
            format!(
                "the usual sigma was taken for constants of which the robot file states no sigma, or none above the usual: {}; where \
                 you know them worse than usual, state it",
                names.join(", ")
            )
        })
    }

    /// Recordings that are driven harder than any reference.
    fn beyond_references(&self) -> Option<String> {
        let hardest = |segments: &[Segment]| {
            let times = segments.iter().map(|segment| self.calibration.regimes.beyond(segment));
            times.fold(1.0, f64::max)
        };
        let harder = self.problem.cuts.iter().map(|cut| (&cut.name, hardest(&cut.segments)));
        let told: Vec<String> = harder
            .filter(|(_, times)| self.problem.has_references && *times > SETTINGS.references.harder)
            .map(|(name, times)| format!("{name} up to {times:.1} times"))
            .collect();
        (!told.is_empty()).then(|| {
            format!(
                "recordings are driven harder than any reference (faster, in tighter or faster turns, or with larger changes of speed): {}; \
                 no drive shows what the simulation leaves there, so that a mismatch there says less: give references driven as hard",
                told.join(", ")
            )
        })
    }

    /// All limits, as sentences.
    pub(crate) fn limits(&self) -> Vec<String> {
        let mut out = Vec::new();
        if !self.problem.has_references {
            if !self.case.references.is_empty() {
                out.push(
                    "the references look like a simulator's logs, for their sensors show no noise: constants \
                     were fitted to them as to logs given with --simulation, and they say nothing about noise"
                        .to_owned(),
                );
            }
            out.extend(self.usual_sigmas());
            out.push(
                "no real drive in which the simulation was right was given as reference: constants start from the robot \
                 file's values, or from those of the simulator's logs, and may move by the sigmas that it states, and the noise is estimated from these \
                 recordings. An effect so small that moving a constant explains it is not named; give a fault-free drive of \
                 two minutes as reference to find smaller ones"
                    .to_owned(),
            );
        }
        out.extend(self.beyond_references());
        let given = self.case.effects.names();
        if !given.is_empty() {
            out.push(format!("the simulation that is compared has these effects already: {}", given.join(", ")));
        }
        let factor = Some(self.calibration.moves.factor).filter(|_| self.calibration.moves.taught);
        out.extend(visit::sentence(self.visits, &visit::visits_of(&self.case.recordings), factor));
        let runs = || self.case.recordings.iter();
        if runs().all(|r| r.pose[0].iter().all(Option::is_none)) {
            out.push(
                "no pose was recorded: slip and places on the ground cannot be determined, and \
                 gyro faults cannot be told from turning"
                    .to_owned(),
            );
        }
        if runs().all(|r| r.gyro.iter().all(Option::is_none)) {
            out.push("no gyro was recorded: turning is known from the wheels only".to_owned());
        }
        if runs().all(|r| r.accel[0].iter().all(Option::is_none)) {
            out.push("no accelerometer was recorded: slopes and pulls are told apart by the motion only".to_owned());
        }
        let held: usize = runs().map(|r| r.held_torques).sum();
        if held > 0 {
            out.push(format!("{held} torque samples were missing; each was replaced by the value before it"));
        }
        if self.sensors.faults.iter().any(|f| f.spec.redundancy == Redundancy::FrozenAngle) {
            out.push("windows next to rows with a frozen encoder were left out".to_owned());
        }
        out
    }
}
