//! From turning wheels to the motion of the body.
//!
//! A wheel at `p` that rolls in direction `d` with radius `r` touches the ground at the velocity
//! `v_c = v + ω (−p_y, p_x)`. Its rollers turn about an axle `a`, and along `a` nothing slides: `a·v_c = a·d r q̇`. A wheel
//! without rollers slides in no direction: `d·v_c = r q̇`, and `d⊥·v_c = 0`, which parallel wheels on the body say once, at
//! the middle of their contacts: what differs there is skidded away. The motion is the least-squares solution of all rows
//! (Muir & Neuman 1987, eq. 39 on; Campion, Bastin & D'Andréa-Novel 1996, section II).

use faer::Mat;
use nalgebra::{Matrix3, Vector3};

use crate::error::OdometryError;
use crate::settings::SETTINGS;
use crate::wheel::{Wheel, WheeledRobot};

/// Geometry that a fit may change, neutral as given.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Geometry {
    /// Factor on the radius of each measured wheel.
    pub(crate) radius: Vec<f64>,
    /// Added to the direction of each measured wheel, rad.
    pub(crate) direction: Vec<f64>,
    /// Factor on the places of all wheels across the robot.
    pub(crate) across: f64,
    /// Factor on the places of all wheels along the robot.
    pub(crate) along: f64,
    /// Added to the steering angle, rad.
    pub(crate) steering_offset: f64,
    /// Factor on the steering angle.
    pub(crate) steering_gain: f64,
}

impl Geometry {
    /// As the robot file has it.
    pub(crate) fn given(robot: &WheeledRobot) -> Self {
        Self {
            radius: vec![1.0; robot.measured().len()],
            direction: vec![0.0; robot.measured().len()],
            across: 1.0,
            along: 1.0,
            steering_offset: 0.0,
            steering_gain: 1.0,
        }
    }
}

/// A rule that a wheel sets for the motion: `row · (v_x, v_y, ω) = Σ`, with what turns of a measured wheel add.
struct Rule {
    row: [f64; 3],
    /// Index among the measured wheels, and metres per radian.
    turn: Option<(usize, f64)>,
}

/// Motion of the body from turns of the wheels, m and rad from rad.
pub(crate) struct Kinematics<'a> {
    robot: &'a WheeledRobot,
    geometry: &'a Geometry,
    /// Rules of the wheels that are not steered.
    fixed: Rules,
    /// What they and no other rules determine: inverse of their normal matrix.
    inverse: Option<Matrix3<f64>>,
}

/// A sum of rules: their normal matrix, and for each measured wheel what a radian of it adds to the right side.
#[derive(Clone)]
struct Rules {
    normal: Matrix3<f64>,
    right: Vec<Vector3<f64>>,
}

impl Rules {
    fn add(&mut self, rule: &Rule) {
        let row = Vector3::from(rule.row);
        self.normal += row * row.transpose();
        if let Some((k, metres)) = rule.turn {
            self.right[k] += row * metres;
        }
    }
}

impl<'a> Kinematics<'a> {
    pub(crate) fn new(robot: &'a WheeledRobot, geometry: &'a Geometry) -> Self {
        let nothing = Rules { normal: Matrix3::zeros(), right: vec![Vector3::zeros(); geometry.radius.len()] };
        let mut out = Self { robot, geometry, fixed: nothing, inverse: None };
        for rule in out.rules(0.0, |wheel| !wheel.steered) {
            out.fixed.add(&rule);
        }
        if !robot.is_steered() {
            out.inverse = Some(out.fixed.normal.try_inverse().unwrap_or_else(Matrix3::zeros));
        }
        out
    }

    /// Motion in the frame of the body: forward and left, m, and turned, rad: `(AᵀA)⁻¹ Aᵀ b`.
    pub(crate) fn motion(&self, turns: &[f64], steering: f64) -> [f64; 3] {
        let mut right = Vector3::zeros();
        for (column, turn) in self.fixed.right.iter().zip(turns) {
            right += column * *turn;
        }
        let inverse = self.inverse.unwrap_or_else(|| {
            let mut normal = self.fixed.normal;
            self.each_rule(
                steering,
                |wheel| wheel.steered,
                |rule| {
                    let row = Vector3::from(rule.row);
                    normal += row * row.transpose();
                    if let Some((k, metres)) = rule.turn {
                        right += row * (metres * turns[k]);
                    }
                },
            );
            normal.try_inverse().unwrap_or_else(Matrix3::zeros)
        });
        (inverse * right).into()
    }

    /// Turns of the measured wheels, rad, in a motion of the body, m and rad: its way along what each of them rules, over what a turn
    /// adds to that.
    pub(crate) fn turns(&self, motion: [f64; 3], steering: f64) -> Vec<f64> {
        let mut out = vec![0.0; self.fixed.right.len()];
        for rule in self.rules(steering, |_| true) {
            if let Some((wheel, metres)) = rule.turn {
                let along: f64 = rule.row.iter().zip(motion).map(|(row, way)| row * way).sum();
                out[wheel] = if metres == 0.0 { 0.0 } else { along / metres };
            }
        }
        out
    }

    /// The recorded steering angle, rad, at which the steered wheel rolls where the body moves so, within a right angle; as it was where
    /// that wheel stands.
    pub(crate) fn steering(&self, [ahead, left, turning]: [f64; 3], before: f64) -> f64 {
        let Some(wheel) = self.robot.wheels.iter().find(|wheel| wheel.steered) else { return before };
        let [x, y] = [wheel.place[0] * self.geometry.along, wheel.place[1] * self.geometry.across];
        let along = [ahead - turning * y, left + turning * x];
        if along[0].hypot(along[1]) < f64::EPSILON {
            return before;
        }
        // A wheel rolls backward as well as forward.
        let twice = 2.0 * (along[1].atan2(along[0]) - wheel.direction);
        let angle = 0.5 * twice.sin().atan2(twice.cos());
        (angle - self.geometry.steering_offset) / self.geometry.steering_gain
    }

    fn rules(&self, steering: f64, of: impl Fn(&Wheel) -> bool) -> Vec<Rule> {
        let mut out = Vec::new();
        self.each_rule(steering, of, |rule| out.push(rule));
        out
    }

    /// Tells every rule of some wheels at a steering angle.
    fn each_rule(&self, steering: f64, of: impl Fn(&Wheel) -> bool, mut tell: impl FnMut(Rule)) {
        let mut plain: Vec<(f64, Vec<[f64; 2]>)> = Vec::new();
        let mut measured = 0;
        for wheel in &self.robot.wheels {
            let place = [wheel.place[0] * self.geometry.along, wheel.place[1] * self.geometry.across];
            let angle = if wheel.steered {
                self.geometry.steering_gain * steering + self.geometry.steering_offset
            } else {
                0.0
            };
            let turn = wheel.measured.then(|| {
                measured += 1;
                (measured - 1, wheel.radius * self.geometry.radius[measured - 1])
            });
            let turned = turn.map_or(0.0, |(k, _)| self.geometry.direction[k]);
            let direction = wheel.direction + angle + turned;
            let (sin, cos) = direction.sin_cos();
            if !of(wheel) {
                continue;
            }

            if wheel.roller == 0.0 {
                if turn.is_some() {
                    tell(Rule { row: along(place, [cos, sin]), turn });
                }
                if wheel.steered {
                    tell(Rule { row: along(place, [-sin, cos]), turn: None });
                } else {
                    parallel(&mut plain, wheel, place);
                }
            } else if let Some((k, metres)) = turn {
                let axle = [-(direction + wheel.roller).sin(), (direction + wheel.roller).cos()];
                let rolled = metres * (axle[0] * cos + axle[1] * sin);
                tell(Rule { row: along(place, axle), turn: Some((k, rolled)) });
            }
        }
        for (direction, places) in plain {
            let n = places.len() as f64;
            let middle = [0, 1].map(|axis| places.iter().map(|p| p[axis]).sum::<f64>() / n);
            tell(Rule { row: along(middle, [-direction.sin(), direction.cos()]), turn: None });
        }
    }

    /// Refuses a robot whose wheels leave a motion open, and says which.
    pub(crate) fn determines(robot: &WheeledRobot) -> Result<(), OdometryError> {
        let geometry = Geometry::given(robot);
        let kinematics = Kinematics::new(robot, &geometry);
        let size = robot.wheels.iter().map(|w| w.place[0].hypot(w.place[1])).fold(0.0, f64::max);
        if size <= 0.0 {
            return Err(open(robot, "its turning: all wheels stand at the origin"));
        }
        let mut angles = vec![0.0];
        if robot.is_steered() {
            angles.extend(SETTINGS.wheels.steering);
        }
        for angle in angles {
            let rules = kinematics.rules(angle, |_| true);
            let rows = Mat::from_fn(rules.len().max(3), 3, |i, j| {
                // Turning counts by the way that it moves the outermost wheel.
                rules.get(i).map_or(0.0, |rule| rule.row[j] / if j == 2 { size } else { 1.0 })
            });
            let Ok(svd) = rows.thin_svd() else { continue };
            let values = svd.S().column_vector();
            if values[2] > SETTINGS.wheels.least_rank * values[0] {
                continue;
            }
            // What no wheel resists: the direction of the least singular value.
            let motion = [0, 1, 2].map(|i| svd.V()[(i, 2)]);
            return Err(open(robot, name_of(motion)));
        }
        Ok(())
    }
}

/// The row of the velocity of a contact along `direction`.
fn along(place: [f64; 2], direction: [f64; 2]) -> [f64; 3] {
    [direction[0], direction[1], place[0] * direction[1] - place[1] * direction[0]]
}

/// Puts a plain wheel of the body to those that are parallel to it.
fn parallel(plain: &mut Vec<(f64, Vec<[f64; 2]>)>, wheel: &Wheel, place: [f64; 2]) {
    let is_parallel = |direction: f64| (direction - wheel.direction).sin().abs() < SETTINGS.wheels.least_rank;
    match plain.iter_mut().find(|(direction, _)| is_parallel(*direction)) {
        Some((_, places)) => places.push(place),
        None => plain.push((wheel.direction, vec![place])),
    }
}

fn open(robot: &WheeledRobot, motion: &str) -> OdometryError {
    OdometryError::Undetermined { robot: robot.name.clone(), motion: motion.to_owned() }
}

fn name_of(motion: [f64; 3]) -> &'static str {
    let [x, y, turning] = motion.map(f64::abs);
    if turning >= x && turning >= y {
        "its turning (all wheels act on one line through the same place)"
    } else if y >= x {
        "its motion sideways"
    } else {
        "its motion forward"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn motion(robot: &WheeledRobot, turns: &[f64], steering: f64) -> [f64; 3] {
        let geometry = Geometry::given(robot.checked().expect("a robot"));
        Kinematics::new(robot, &geometry).motion(turns, steering)
    }

    fn assert_near(found: [f64; 3], expected: [f64; 3]) {
        for (a, b) in found.iter().zip(expected) {
            assert_relative_eq!(*a, b, epsilon = 1e-12);
        }
    }

    /// Formulas of Sousa et al. (2022) in the words of the open data's page: w = r q.
    #[test]
    fn formulas_of_the_four_kinds_are_special_cases() {
        let (l, r, track) = (0.7, 1.1, 0.2);
        let of = motion(&WheeledRobot::differential(0.042, track), &[l, r], 0.0);
        assert_near(of, [0.042 * (l + r) / 2.0, 0.0, 0.042 * (r - l) / track]);

        for steering in [0.0, 0.4, -1.2, std::f64::consts::FRAC_PI_2] {
            let w = 0.0325 * 0.9;
            let of = motion(&WheeledRobot::tricycle(0.0325, 0.15), &[0.9], steering);
            assert_near(of, [w * steering.cos(), 0.0, w * steering.sin() / 0.15]);
        }

        let q = [0.3, -0.8, 1.7];
        let w = q.map(|q| 0.051 * q);
        let of = motion(&WheeledRobot::omni_3(0.051, 0.195), &q, 0.0);
        let turned = -(w[0] + w[1] + w[2]) / (3.0 * 0.195);
        assert_near(of, [(w[1] - w[0]) / 3.0_f64.sqrt(), (2.0 * w[2] - w[0] - w[1]) / 3.0, turned]);
    }

    #[test]
    fn turns_of_a_motion_make_that_motion() {
        for (robot, wanted) in [
            (WheeledRobot::differential(0.042, 0.2), [0.3, 0.0, -0.8]),
            (WheeledRobot::omni_3(0.051, 0.195), [0.3, -0.2, 0.5]),
            (WheeledRobot::mecanum_4(0.03, 0.2, 0.22), [-0.3, 0.1, 0.5]),
            (WheeledRobot::tricycle(0.0325, 0.15), [-0.3, 0.0, 0.5]),
        ] {
            let geometry = Geometry::given(&robot);
            let kinematics = Kinematics::new(&robot, &geometry);
            let steering = if robot.is_steered() { kinematics.steering(wanted, 0.0) } else { 0.0 };
            assert!(steering.abs() < std::f64::consts::FRAC_PI_2);
            assert_near(kinematics.motion(&kinematics.turns(wanted, steering), steering), wanted);
            assert_eq!(kinematics.steering([0.0; 3], 0.3), 0.3, "as it was");
        }
    }

    /// The open data number the wheels front left, front right, rear left, rear right, the right ones turned about.
    #[test]
    fn a_mecanum_robot_with_reversed_right_wheels_follows_the_formula_of_the_open_data() {
        let robot = WheeledRobot::mecanum_4(0.03, 0.2, 0.22).with_wheels(|k, wheel| {
            let direction = if k % 2 == 1 { std::f64::consts::PI } else { 0.0 };
            Wheel { direction, ..wheel }
        });
        let q = [0.3, -0.8, 1.7, 0.4];
        let w = q.map(|q| 0.03 * q);
        let of = motion(&robot, &q, 0.0);
        let sum: f64 = w.iter().sum();
        let expected =
            [(w[0] - w[1] + w[2] - w[3]) / 4.0, (-w[0] - w[1] + w[2] + w[3]) / 4.0, -sum / (2.0 * (0.2 + 0.22))];
        assert_near(of, expected);
    }

    #[test]
    fn four_omni_wheels_and_sides_that_skid_move_the_body() {
        let of = motion(&WheeledRobot::omni_4(0.05, 0.3), &[2.0; 4], 0.0);
        assert_near(of, [0.0, 0.0, 0.05 * 2.0 / 0.3]);

        // Four wheels in two rows: no lateral rule stops the turning, for it is skidded.
        let mut skid = WheeledRobot::differential(0.1, 0.5);
        skid.wheels = [("a", 0.3, 0.25), ("b", -0.3, 0.25), ("c", 0.3, -0.25), ("d", -0.3, -0.25)]
            .map(|(name, x, y)| Wheel::new(name, [x, y], 0.1))
            .to_vec();
        assert_near(motion(&skid, &[-1.0, -1.0, 1.0, 1.0], 0.0), [0.0, 0.0, 0.1 * 2.0 / 0.5]);
    }

    #[test]
    fn a_robot_whose_wheels_leave_a_motion_open_is_refused_by_name() {
        let mut line = WheeledRobot::differential(0.1, 0.5);
        line.wheels[0].place = [0.3, 0.0];
        line.wheels[1].place = [-0.3, 0.0];
        let refusal = line.checked().unwrap_err().to_string();
        assert!(refusal.contains("differential") && refusal.contains("turning"), "{refusal}");

        let two = WheeledRobot { wheels: WheeledRobot::omni_3(0.05, 0.2).wheels[..2].to_vec(), ..line.clone() };
        assert!(matches!(two.checked(), Err(OdometryError::Undetermined { .. })));
        let mut none = WheeledRobot::differential(0.1, 0.5);
        none.wheels[1].radius = -0.1;
        assert!(none.checked().unwrap_err().to_string().contains("wheel 'right': radius -0.1 m"));
        none.wheels.iter_mut().for_each(|w| w.measured = false);
        assert!(none.checked().unwrap_err().to_string().contains("no wheel's turning is recorded"));

        let one_way = WheeledRobot::mecanum_4(0.05, 0.3, 0.3)
            .with_wheels(|_, w| Wheel { roller: std::f64::consts::FRAC_PI_4, ..w });
        let refusal = one_way.checked().unwrap_err().to_string();
        assert!(refusal.contains("the axles of all rollers point one way") && refusal.contains("-45"), "{refusal}");
        let mut many = WheeledRobot::differential(0.1, 0.5);
        many.wheels = (0..9).map(|k| Wheel::new(&format!("wheel {k}"), [0.1 * f64::from(k), 0.2], 0.1)).collect();
        assert!(many.checked().unwrap_err().to_string().contains("9 wheels, but 8 are the most"));
    }
}
