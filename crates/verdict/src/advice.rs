//! Which drive to record next.

use serde::{Deserialize, Serialize};

use crate::course::Course;

/// Which drive would tell the remaining rivals apart.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Advice {
    /// What may still be true, the most probable first; probabilities sum to one.
    pub rivals: Vec<Contender>,
    /// How open the question is: entropy of the rivals, bits.
    pub entropy_bits: f64,
    /// Drives, the best first.
    pub manoeuvres: Vec<Manoeuvre>,
    /// Why there is none, or none worth making.
    pub withheld: Option<String>,
    /// What limits the advice.
    pub limits: Vec<String>,
}

/// A hypothesis that may be true.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Contender {
    /// Its effects by id; none of "nothing is missing".
    pub effects: Vec<String>,
    /// For people.
    pub name: String,
    /// Its probability among the rivals.
    pub probability: f64,
}

/// A drive that could be made next.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manoeuvre {
    /// What it is.
    pub name: String,
    /// Why it tells rivals apart, in a sentence.
    pub why: String,
    /// Expected fall of the entropy of the rivals, bits.
    pub expected_bits: f64,
    /// The two rivals that it tells apart best.
    pub splits: Option<[String; 2]>,
    /// One sigma of the first rival's size after the drive over that before, if it has a size.
    pub narrows: Option<f64>,
    /// Its recording can be added to the others as it is; else the robot was changed for it, and so must be its file.
    pub joins: bool,
    /// Found by a search for these rivals.
    pub optimised: bool,
    /// Pose at the start, in the frame of the recordings: x, y in m, yaw in rad.
    pub start: [f64; 3],
    /// Wanted speeds: time s, speed m/s, yaw rate rad/s; linear between points.
    pub profile: Vec<[f64; 3]>,
    /// When the drives are given no torque, s.
    pub torque_free: Vec<[f64; 2]>,
    /// Where the speed points in the robot's axes, rad: 0 forward, π/2 to the left.
    #[serde(default, skip_serializing_if = "is_forward")]
    pub direction: f64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the form that serde asks for")]
fn is_forward(direction: &f64) -> bool {
    *direction == 0.0
}

impl Manoeuvre {
    /// A drive along a course, of which nothing is known yet.
    pub fn new(name: &str, course: Course, start: [f64; 3]) -> Self {
        Self {
            name: name.to_owned(),
            why: String::new(),
            expected_bits: 0.0,
            splits: None,
            narrows: None,
            joins: true,
            optimised: false,
            start,
            profile: course.points,
            torque_free: course.torque_free,
            direction: 0.0,
        }
    }

    fn course(&self) -> Course {
        Course { points: self.profile.clone(), torque_free: self.torque_free.clone() }
    }

    /// Length, s.
    pub fn length(&self) -> f64 {
        self.profile.last().map_or(0.0, |p| p[0])
    }

    /// Wanted speed m/s and yaw rate rad/s at a time.
    pub fn wanted(&self, t: f64) -> [f64; 2] {
        self.course().at(t)
    }

    /// Wanted speed forward and to the left, m/s, and yaw rate, rad/s, at a time.
    pub fn wanted_twist(&self, t: f64) -> [f64; 3] {
        let [speed, turning] = self.wanted(t);
        [speed * self.direction.cos(), speed * self.direction.sin(), turning]
    }

    /// Whether the drives are given no torque at a time.
    pub fn is_torque_free(&self, t: f64) -> bool {
        self.course().is_free(t)
    }
}

impl Advice {
    /// No advice.
    pub fn withheld(reason: &str) -> Self {
        Self { withheld: Some(reason.to_owned()), ..Self::default() }
    }

    /// The best drive whose recording can be added to the others.
    pub fn best(&self) -> Option<&Manoeuvre> {
        self.manoeuvres.iter().find(|m| m.joins)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drive(name: &str, torque_free: Vec<[f64; 2]>) -> Manoeuvre {
        let points = vec![[0.0, 0.0, 0.0], [2.0, 0.8, -0.6], [6.0, 0.8, -0.6], [7.0, 0.0, 0.0]];
        Manoeuvre::new(name, Course { points, torque_free }, [1.0, 2.0, 0.5])
    }

    #[test]
    fn a_drive_wants_the_speeds_of_its_course_and_lasts_as_long() {
        let coasting = drive("coasting", vec![[5.0, 6.5]]);
        assert_eq!(coasting.length(), 7.0);
        assert_eq!(coasting.wanted(1.0), [0.4, -0.3]);
        assert_eq!(coasting.wanted(4.0), [0.8, -0.6]);
        assert_eq!([4.9, 5.0, 6.4, 6.5].map(|t| coasting.is_torque_free(t)), [false, true, true, false]);
        assert!(!drive("driven throughout", Vec::new()).is_torque_free(5.5));
    }

    #[test]
    fn the_best_drive_is_the_first_whose_recording_joins_the_others() {
        let heavier = Manoeuvre { joins: false, ..drive("with a mass on top", Vec::new()) };
        let mut advice = Advice { manoeuvres: vec![heavier], ..Advice::default() };
        assert_eq!(advice.best(), None);
        advice.manoeuvres.extend([drive("circles", Vec::new()), drive("spins", Vec::new())]);
        assert_eq!(advice.best().map(|m| m.name.as_str()), Some("circles"));
    }

    #[test]
    fn withheld_advice_says_why_and_nothing_else() {
        let advice = Advice::withheld("no rival is left");
        assert_eq!(advice.withheld.as_deref(), Some("no rival is left"));
        assert!(advice.rivals.is_empty() && advice.manoeuvres.is_empty() && advice.limits.is_empty(), "{advice:?}");
    }
}
