//! Replicas of a case: robots of the same file on the same commands, of which it is known what is missing.
//!
//! A replica drives by the response that the simulation has, with one constant of it changed, and its wheels and body err from it as
//! those of the recordings err from the best response to them: the same errors, later by some time and with either sign.

use catalogue::{CauseSpec, command_driven as cause};
use inference::DiagnosisError;
use inference::robust::{normal_cdf, rms};
use robot_model::Robot;
use verdict::{DRIVE_CONSTANTS, GROUND_CONSTANTS, ResponseConstant};

use crate::controller::{DAMPING, DEAD_TIME, FREQUENCY, GAIN, LAG, free_run};
use crate::ground::{BODY_LAG, OFFSET, RADIUS, SIDE_RADIUS, TRACK, TURN_SLIP, TURN_SLIP_LINEAR, TurnSlip, twist};
use crate::identified::identify;
use crate::identify::{Base, neutral};
use crate::run::{Piece, ResponseRun, STEP};
use crate::settings::{Rehearsed, SETTINGS};
use crate::{ResponseCase, enough};

const RULES: Rehearsed = SETTINGS.rehearsed;

/// What replicas of a case are made from.
pub struct Replicas {
    robot: Robot<f64>,
    geometry_sigma: [f64; 2],
    /// What the simulation says: of the references, or that the wheels do what is commanded.
    base: Base,
    references: Vec<Template>,
    recordings: Vec<Template>,
    /// What may be hidden.
    pub hideable: Vec<Hideable>,
    /// What is left of wheel speeds, and of the yaw rate, rad/s, root mean square.
    pub left: [f64; 2],
}

/// A cause that may be hidden.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hideable {
    /// The cause.
    pub spec: &'static CauseSpec,
    /// Its size of interest, in the unit of the cause.
    pub interest: f64,
    /// Whether its size can be negative.
    pub is_signed: bool,
    /// Whether these recordings hold what would show it.
    pub is_seen: bool,
    /// By how much it changes a constant at its size of interest.
    step: f64,
}

/// A recording with what the best response leaves of it.
struct Template {
    name: String,
    hold: f64,
    pieces: Vec<Left>,
}

/// A stretch with what the best response leaves of it.
struct Left {
    piece: Piece,
    /// Of the speeds of both wheels in each row, rad/s.
    wheel: Vec<[f64; 2]>,
    /// Of the body's motion to each row, m/s ahead and to the left, rad/s.
    rates: Vec<[f64; 3]>,
}

impl Replicas {
    /// Fits references, or without any takes the simulation as it is, and what is left of the recordings.
    ///
    /// # Errors
    /// As [`crate::diagnose_response`].
    pub fn new(case: &ResponseCase, progress: &dyn Fn(&str)) -> Result<Self, DiagnosisError> {
        if case.recordings.is_empty() {
            return Err(DiagnosisError::Empty { what: "recording" });
        }
        let robot = case.robot.checked()?;
        let nominal = [robot.wheel_radius, 2.0 * robot.half_track];
        let windows = enough(&case.recordings, "recordings")?;
        let plain = neutral(&windows);
        let base = if case.references.is_empty() {
            plain.clone()
        } else {
            let references = enough(&case.references, "references")?;
            let found = identify(&references, &plain, nominal, &|_| progress("fitting the references"));
            Base { drive: found.drive.model, ground: found.ground.model }
        };
        let found = identify(&windows, &base, nominal, progress);
        let best = Base { drive: found.drive.model, ground: found.ground.model };
        let templates =
            |runs: &[ResponseRun]| runs.iter().map(|run| Template::new(run, &best, nominal)).collect::<Vec<_>>();
        let recordings = templates(&case.recordings);
        let pieces = || recordings.iter().flat_map(|t| &t.pieces);
        let left = [
            rms(pieces().flat_map(|p| p.wheel.iter().flatten().copied())).unwrap_or(0.0),
            rms(pieces().flat_map(|p| p.rates.iter().map(|r| r[2]))).unwrap_or(0.0),
        ];
        let commanded = rms(pieces().flat_map(|p| p.piece.command.iter().flatten().copied())).unwrap_or(0.0);
        let has_position = case.recordings.iter().any(ResponseRun::has_position);
        Ok(Self {
            robot: case.robot,
            geometry_sigma: case.geometry_sigma,
            hideable: hideable(commanded, nominal[1], has_position),
            references: templates(&case.references),
            base,
            recordings,
            left,
        })
    }

    /// Names of the recordings, with their lengths, s.
    pub fn drives(&self) -> Vec<(String, f64)> {
        self.recordings.iter().map(|t| (t.name.clone(), t.seconds())).collect()
    }

    /// How many references the case has.
    pub fn references(&self) -> usize {
        self.references.len()
    }

    /// A replica with so many times the size of interest of a cause, if any, and with so many references: on their own commands where
    /// there are as many, else on those of the recordings; `None` where a constant would lie beyond its bounds. `normal` draws numbers of
    /// unit variance.
    pub fn replica(
        &self,
        hidden: Option<(&Hideable, f64)>,
        references: usize,
        normal: &mut dyn FnMut() -> f64,
    ) -> Option<ResponseCase> {
        let [of_radius, of_track] = self.geometry_sigma.map(|sigma| 1.0 + sigma * normal());
        let mut base = self.base.clone();
        base.ground.x[RADIUS] *= of_radius;
        base.ground.x[TRACK] *= of_track;
        let changed = match hidden {
            Some((hideable, multiple)) => hideable.changed(&base, multiple)?,
            None => base.clone(),
        };
        let nominal = [self.robot.wheel_radius, 2.0 * self.robot.half_track];
        let mut driven = |base: &Base, template: &Template, place: usize| {
            let pieces = template.pieces.iter().map(|left| left.driven(base, nominal, normal)).collect();
            ResponseRun { name: format!("{}_{place}", template.name), pieces, gyro_share: None, hold: template.hold }
        };
        let own = if references == self.references.len() { &self.references } else { &self.recordings };
        let right = own.iter().cycle().take(references).enumerate();
        Some(ResponseCase {
            robot: self.robot,
            geometry_sigma: self.geometry_sigma,
            references: right.map(|(place, template)| driven(&base, template, place)).collect(),
            recordings: self.recordings.iter().enumerate().map(|(k, template)| driven(&changed, template, k)).collect(),
            held_out: Vec::new(),
        })
    }
}

/// Causes with their sizes of interest. `commanded`: wheel speeds that are commanded, rms, rad/s; `track`: m.
fn hideable(commanded: f64, track: f64, has_position: bool) -> Vec<Hideable> {
    let of = |spec: &'static CauseSpec, step: f64, interest: f64, is_signed: bool| {
        let needs_position =
            [cause::ROLLING_RADIUS.id, cause::TURN_SLIP.id, cause::TURN_CENTRE_OFFSET.id].contains(&spec.id);
        Hideable { spec, interest, is_signed, is_seen: has_position || !needs_position, step }
    };
    vec![
        of(&cause::DRIVE_COMMAND, RULES.gain, RULES.gain * commanded, true),
        of(&cause::DEAD_TIME, RULES.delay, RULES.delay, false),
        of(&cause::LAG, RULES.delay, RULES.delay, false),
        of(&cause::EFFECTIVE_TRACK, RULES.track, RULES.track * track, true),
        of(&cause::ROLLING_RADIUS, RULES.radius, RULES.radius, true),
        of(&cause::TURN_SLIP, RULES.lost, RULES.lost, false),
        of(&cause::TURN_CENTRE_OFFSET, RULES.offset, RULES.offset, true),
        of(&cause::BODY_LAG, RULES.delay, RULES.delay, false),
        of(&cause::SIDE_RADIUS, RULES.side_radius, RULES.side_radius, true),
    ]
}

impl Hideable {
    /// The response with so many times its size of interest; `None` beyond the bounds of a constant.
    fn changed(&self, base: &Base, multiple: f64) -> Option<Base> {
        let size = multiple * self.step;
        let mut out = base.clone();
        let (drive, ground) = (&mut out.drive, &mut out.ground);
        match self.spec.id {
            id if id == cause::DRIVE_COMMAND.id => GAIN.into_iter().for_each(|k| drive.x[k] *= 1.0 + size),
            id if id == cause::DEAD_TIME.id => drive.x[DEAD_TIME] += size,
            // A second-order lag is late by 2 ζ / ω.
            id if id == cause::LAG.id && drive.law.second_order => {
                let late = 2.0 * drive.x[DAMPING] / drive.x[FREQUENCY];
                drive.x[FREQUENCY] *= late / (late + size);
            }
            id if id == cause::LAG.id => drive.x[LAG] += size,
            id if id == cause::EFFECTIVE_TRACK.id => ground.x[TRACK] *= 1.0 + size,
            id if id == cause::ROLLING_RADIUS.id => ground.x[RADIUS] *= 1.0 + size,
            id if id == cause::TURN_SLIP.id => {
                let k = if TurnSlip::of(&ground.x) == TurnSlip::Linear { TURN_SLIP_LINEAR } else { TURN_SLIP };
                ground.x[k] -= (1.0 - size).max(0.0).ln();
            }
            id if id == cause::TURN_CENTRE_OFFSET.id => ground.x[OFFSET] += size,
            id if id == cause::BODY_LAG.id => ground.x[BODY_LAG] += size,
            _ => ground.x[SIDE_RADIUS] += size,
        }
        let is_within = |(c, x): (&ResponseConstant, &f64)| *x == c.neutral || (c.bounds[0]..=c.bounds[1]).contains(x);
        let all = DRIVE_CONSTANTS.iter().zip(&out.drive.x).chain(GROUND_CONSTANTS.iter().zip(&out.ground.x));
        all.into_iter().all(is_within).then_some(out)
    }
}

impl Template {
    fn new(run: &ResponseRun, best: &Base, nominal: [f64; 2]) -> Self {
        let pieces = run.pieces.iter().map(|piece| Left::new(piece, best, nominal)).collect();
        Self { name: run.name.clone(), hold: run.hold, pieces }
    }

    fn seconds(&self) -> f64 {
        self.pieces.iter().map(|left| STEP * left.wheel.len() as f64).sum()
    }
}

impl Left {
    fn new(piece: &Piece, best: &Base, nominal: [f64; 2]) -> Self {
        let simulated = free_run(best.drive.law, &best.drive.x, piece);
        let minus = |(measured, simulated): (&[f64; 2], &[f64; 2])| [0, 1].map(|k| measured[k] - simulated[k]);
        let wheel = piece.wheel.iter().zip(&simulated).map(minus).collect();
        let implied = rates(&best.ground.x, nominal, &piece.wheel);
        let moved =
            |k: usize| measured(piece, k).map_or([0.0; 3], |m| [0, 1, 2].map(|axis| m[axis] - implied[k][axis]));
        Self { rates: (0..piece.wheel.len()).map(moved).collect(), wheel, piece: piece.clone() }
    }

    /// The same stretch driven by a response, with what was left at another time and with either sign.
    fn driven(&self, base: &Base, nominal: [f64; 2], normal: &mut dyn FnMut() -> f64) -> Piece {
        let rows = self.wheel.len();
        let late = (normal_cdf(normal()) * rows as f64) as usize;
        let sign = normal().signum();
        let left = |k: usize| (k + late) % rows;

        let mut wheel = free_run(base.drive.law, &base.drive.x, &self.piece);
        for (k, speeds) in wheel.iter_mut().enumerate() {
            for (speed, off) in speeds.iter_mut().zip(self.wheel[left(k)]) {
                *speed += sign * off;
            }
        }
        let implied = rates(&base.ground.x, nominal, &wheel);
        let begun = self.piece.heading.as_ref().map_or(0.0, |heading| heading[0]);
        let mut pose = [0.0, 0.0, begun];
        let mut poses = vec![pose];
        for (k, implied) in implied.iter().enumerate().skip(1) {
            let off = self.rates[left(k)];
            let [ahead, side, turned] = [0, 1, 2].map(|axis| STEP * (implied[axis] + sign * off[axis]));
            let (sin, cos) = (pose[2] + 0.5 * turned).sin_cos();
            pose = [pose[0] + ahead * cos - side * sin, pose[1] + ahead * sin + side * cos, pose[2] + turned];
            poses.push(pose);
        }
        Piece {
            wheel,
            heading: self.piece.heading.as_ref().map(|_| poses.iter().map(|p| p[2]).collect()),
            position: self.piece.position.as_ref().map(|_| poses.iter().map(|p| [p[0], p[1]]).collect()),
            ..self.piece.clone()
        }
    }
}

/// Motion to each row as wheel speeds imply it, m/s ahead and to the left, rad/s; none to the first.
fn rates(ground: &[f64], nominal: [f64; 2], wheel: &[[f64; 2]]) -> Vec<[f64; 3]> {
    let twists = twist(ground, nominal, wheel);
    let between = |pair: &[[f64; 2]]| {
        let [ahead, turning] = [0, 1].map(|k| 0.5 * (pair[0][k] + pair[1][k]));
        [ahead, ground[OFFSET] * turning, turning]
    };
    std::iter::once([0.0; 3]).chain(twists.windows(2).map(between)).collect()
}

/// The same as it was measured; of places that were not, nothing is left.
fn measured(piece: &Piece, row: usize) -> Option<[f64; 3]> {
    let heading = piece.heading.as_ref()?;
    let before = row.checked_sub(1)?;
    let turned = heading[row] - heading[before];
    let (sin, cos) = (heading[before] + 0.5 * turned).sin_cos();
    let moved = piece.position.as_ref().map(|p| [0, 1].map(|axis| p[row][axis] - p[before][axis]));
    let [x, y] = moved.unwrap_or_default();
    Some([(x * cos + y * sin) / STEP, (y * cos - x * sin) / STEP, turned / STEP])
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use inference::Options;
    use verdict::Verdict;

    use super::*;
    use crate::diagnose_response;
    use crate::testing::{Truth, robot};

    fn replicas(with_references: bool) -> Replicas {
        let truth = Truth::stock();
        let references = if with_references { vec![truth.run("r", 30, 3)] } else { Vec::new() };
        let recordings = vec![truth.run("a", 30, 1), truth.run("b", 20, 2)];
        let case =
            ResponseCase { robot: robot(), geometry_sigma: [0.001; 2], references, recordings, held_out: Vec::new() };
        Replicas::new(&case, &|_| ()).expect("replicas")
    }

    /// Ones, so that nothing is late by chance.
    fn ones() -> impl FnMut() -> f64 {
        || 1.0
    }

    fn named(case: &ResponseCase) -> (Verdict, Vec<String>) {
        let answer = diagnose_response(case, &Options::default(), &|_| ()).expect("an answer");
        let likely = answer.ranked.iter().filter(|c| c.probability > 0.5);
        (answer.verdict, likely.map(|c| c.effect.clone()).collect())
    }

    #[test]
    fn a_hidden_dead_time_is_named_and_a_robot_without_a_fault_is_not_alarmed() {
        let replicas = replicas(true);
        let dead_time = replicas.hideable.iter().find(|h| h.spec.id == cause::DEAD_TIME.id).expect("a cause");
        let hidden = replicas.replica(Some((dead_time, 2.0)), 1, &mut ones()).expect("a replica");
        let (verdict, names) = named(&hidden);
        assert_eq!((verdict, names.first().map(String::as_str)), (Verdict::Explained, Some(cause::DEAD_TIME.id)));
        let sound = replicas.replica(None, 1, &mut ones()).expect("a replica");
        assert_eq!(named(&sound).0, Verdict::NoMismatch);
    }

    #[test]
    fn what_is_hidden_changes_one_constant_within_its_bounds() {
        let replicas = replicas(false);
        for hideable in &replicas.hideable {
            let changed = hideable.changed(&replicas.base, 1.0).expect("within bounds");
            let all = |base: &Base| [base.drive.x.clone(), base.ground.x.clone()].concat();
            let differ = all(&changed).iter().zip(all(&replicas.base)).filter(|(a, b)| **a != *b).count();
            assert_eq!(differ, if hideable.spec.id == cause::DRIVE_COMMAND.id { 2 } else { 1 }, "{}", hideable.spec.id);
            let below = hideable.changed(&replicas.base, -1.0);
            assert_eq!(below.is_some(), hideable.is_signed, "{}", hideable.spec.id);
        }
        let lost = replicas.hideable.iter().find(|h| h.spec.id == cause::TURN_SLIP.id).expect("a cause");
        let changed = lost.changed(&replicas.base, 2.0).expect("within bounds");
        assert_relative_eq!(1.0 - (-changed.ground.x[TURN_SLIP]).exp(), 2.0 * lost.interest, max_relative = 1e-12);
        assert!(lost.changed(&replicas.base, 1.0 / lost.step).is_none(), "nothing would be left");
    }

    #[test]
    fn what_is_left_of_a_recording_comes_back_where_it_is_driven_by_the_best_response() {
        let truth = Truth { wheel_push: |t, _| 0.3 * (1.3 * t).sin(), ..Truth::stock() };
        let run = truth.run("a", 20, 1);
        let windows = enough(std::slice::from_ref(&run), "recordings").expect("windows");
        let best = neutral(&windows);
        let nominal = [0.15, 0.6];
        let piece = &run.pieces[0];
        let left = Left::new(piece, &best, nominal);
        // A normal number far below zero: late by nothing; one far above: with its own sign.
        let mut numbers = [-40.0, 40.0].into_iter();
        let again = left.driven(&best, nominal, &mut || numbers.next().unwrap_or(0.0));
        for (a, b) in again.wheel.iter().flatten().zip(piece.wheel.iter().flatten()) {
            assert_relative_eq!(a, b, epsilon = 1e-9);
        }
        let (Some(a), Some(b)) = (&again.heading, &piece.heading) else { panic!("a heading") };
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9));
        let (Some(a), Some(b)) = (&again.position, &piece.position) else { panic!("places") };
        let moved = |p: &[[f64; 2]]| [p[p.len() - 1][0] - p[0][0], p[p.len() - 1][1] - p[0][1]];
        assert_relative_eq!(moved(a)[0], moved(b)[0], epsilon = 1e-6);
        assert_relative_eq!(moved(a)[1], moved(b)[1], epsilon = 1e-6);
    }
}
