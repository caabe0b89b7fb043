//! ROS 2 controllers of wheels beside a pose.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use anyhow::{Result, bail, ensure};
use hierarchical_fit::telling::length_of;
use inference::robust::mean;
use model_export::ros2::{Controllers, Forecast, Geometry, Length, Scatter, Side};
use odometry::file::RobotFile;
use odometry::{Wheel, WheeledRobot};
use verdict::FreeRun;

use super::ColumnsRobot;
use super::wheels::{corrected, is_length, unheld};

/// By how much a direction may differ from the one that a controller takes for granted, rad.
const ALIGNED: f64 = 0.02;
/// By how much lengths may differ that a controller has one number for before that is told, as a share.
const ALIKE: f64 = 1e-3;
/// By how much places may differ that a controller takes for the same, m.
const NEAR: f64 = 1e-3;
/// Median of the distance of two errors of one sigma each: `√(2 ln 2)`; median of the size of one.
const MEDIAN: [f64; 2] = [1.177_41, 0.674_49];

/// Parameters of the controller that the wheels ask for.
pub(super) fn controllers(robot: &ColumnsRobot) -> Result<Controllers> {
    let stated = RobotFile::parse(&robot.name, &robot.text)?.robot;
    let wanted = corrected(&stated, &robot.tuning());
    let mut wheels = Wheels { stated: &stated, wanted: &wanted, told: Vec::new(), not_held: Vec::new() };
    let geometry = wheels.geometry()?;

    let Wheels { mut told, mut not_held, .. } = wheels;
    told.insert(
        0,
        "Joints are named after the wheels of the robot file, with _ for spaces: give them the names of your URDF."
            .to_owned(),
    );
    let controller = geometry.controller();
    if let Some(diagnosis) = robot.correction() {
        not_held.extend(unheld(&stated, diagnosis, is_length).iter().map(|u| u.sentence(controller)));
    }
    let runs = robot.diagnosis.as_ref().map_or(&[][..], |d| &d.free_runs);
    let scatter = scatter(runs, robot.correction().is_none());
    if scatter.is_some() && !not_held.is_empty() && robot.correction().is_some() {
        told.push(
            "Forecasts had all that the verdict corrects: without what is not held, errors are larger.".to_owned(),
        );
    }
    Ok(Controllers { robot: stated.name, geometry, scatter, told, not_held })
}

/// Errors of the forecasts of recordings left out of the fit, as one sigma; `None` where none were forecast.
fn scatter(runs: &[FreeRun], is_nominal: bool) -> Option<Scatter> {
    let lengths = || runs.iter().filter_map(|run| length_of(run, "position"));
    let at = |after: f64| {
        let sigma = |quantity: &str, median: f64| {
            let of = |run: &FreeRun| (length_of(run, quantity) == Some(after)).then_some(run.clone());
            let error = |run: FreeRun| if is_nominal { run.nominal } else { run.corrected };
            mean(runs.iter().filter_map(of).map(|run| (error(run) / median).powi(2))).map(f64::sqrt)
        };
        Some(Forecast { after, position: sigma("position", MEDIAN[0])?, heading: sigma("heading", MEDIAN[1])? })
    };
    let short = at(lengths().fold(f64::INFINITY, f64::min))?;
    let long = at(lengths().fold(f64::NEG_INFINITY, f64::max))?;
    let errs = |forecast: &Forecast| forecast.position > 0.0 && forecast.heading > 0.0;
    let drives = lengths().filter(|length| *length == short.after).count();
    [&short, &long].into_iter().all(errs).then_some(Scatter { short, long, drives })
}

/// Wheels as stated and as corrected, with the sentences for the user that come up while a controller is chosen for them.
struct Wheels<'a> {
    stated: &'a WheeledRobot,
    wanted: &'a WheeledRobot,
    told: Vec<String>,
    not_held: Vec<String>,
}

/// The name of a wheel's joint.
fn joint(wheel: &Wheel) -> String {
    format!("{}_joint", wheel.name.replace(' ', "_"))
}

/// Whether two directions are the same up to a multiple of `turn`.
fn is_along(a: f64, b: f64, turn: f64) -> bool {
    let apart = (a - b).rem_euclid(turn);
    apart.min(turn - apart) < ALIGNED
}

impl Wheels<'_> {
    fn geometry(&mut self) -> Result<Geometry> {
        let wheels = &self.stated.wheels;
        let measured: Vec<usize> = self.stated.measured();
        for (k, wheel) in wheels.iter().enumerate() {
            let twin = wheels[..k].iter().find(|other| joint(other) == joint(wheel));
            if let Some(twin) = twin {
                bail!("wheels '{}' and '{}' would share a joint; give one of them another name", twin.name, wheel.name);
            }
        }
        let rollers = |angle: f64| wheels.iter().all(|w| is_along(w.roller.abs(), angle, PI));
        let steered: Vec<usize> = (0..wheels.len()).filter(|&k| wheels[k].steered).collect();
        let is_ahead = |w: &Wheel| w.roller == 0.0 && (w.steered || is_along(w.direction, 0.0, PI));
        if rollers(FRAC_PI_2) && measured.len() == wheels.len() {
            return self.omni();
        }
        if rollers(FRAC_PI_4) && measured.len() == 4 && wheels.len() == 4 {
            return self.mecanum();
        }
        if !wheels.iter().all(is_ahead) {
            return self.refused("its wheels roll in directions that none of its controllers has");
        }
        match steered[..] {
            [] => self.differential(),
            [front] => self.steered(front),
            _ => self.refused("more than one wheel is steered"),
        }
    }

    fn refused<T>(&self, why: &str) -> Result<T> {
        bail!(
            "robot '{}': no controller of ros2_controllers holds it, for {why}; export it with --to toml, or correct \
             the robot file if it says so by mistake",
            self.stated.name
        )
    }

    /// The mean of a length over wheels, as stated and as corrected.
    fn length(&self, of: &[usize], length: impl Fn(&Wheel) -> f64) -> Length {
        let over = |robot: &WheeledRobot| mean(of.iter().map(|&k| length(&robot.wheels[k]))).unwrap_or(f64::NAN);
        Length { stated: over(self.stated), corrected: over(self.wanted) }
    }

    /// The one radius that a controller has for wheels, and what it does not hold if theirs differ.
    fn radius(&mut self, of: &[usize], controller: &str) -> Length {
        let one = self.length(of, |w| w.radius);
        let wheels = || of.iter().map(|&k| &self.wanted.wheels[k]);
        if wheels().any(|w| (w.radius / one.corrected - 1.0).abs() > ALIKE) {
            let each: Vec<String> = wheels().map(|w| format!("{} {:.5} m", w.name, w.radius)).collect();
            self.not_held.push(format!(
                "radii of wheels differ ({}), for which {controller} has one number: it gets their mean, {:.5} m.",
                each.join(", "),
                one.corrected
            ));
        }
        one
    }

    /// Tells of wheels that count backwards, and of a middle that is not the robot's origin.
    fn tell_of(&mut self, measured: &[usize], middle: [f64; 2], of: &str) {
        let backwards = |w: &&Wheel| w.roller.abs() < FRAC_PI_2 - ALIGNED && w.direction.cos() < 0.0;
        let names = measured.iter().map(|&k| &self.stated.wheels[k]).filter(backwards).map(|w| w.name.clone());
        let names: Vec<String> = names.collect();
        if !names.is_empty() {
            self.told.push(format!(
                "{}: counts backwards when the robot drives ahead; turn the sign in the hardware interface, or the \
                 joint's axis in the URDF.",
                names.join(", ")
            ));
        }
        let [x, y] = middle;
        if x.abs().max(y.abs()) > NEAR {
            self.not_held.push(format!(
                "{of} is at x {x:.4} m, y {y:.4} m of the robot file's origin: odometry of the controller is that of \
                 {of}, so place base_link there."
            ));
        }
    }

    fn differential(&mut self) -> Result<Geometry> {
        let measured = self.stated.measured();
        let middle = |axis: usize| mean(measured.iter().map(|&k| self.wanted.wheels[k].place[axis])).unwrap_or(0.0);
        let lateral = mean(measured.iter().map(|&k| self.stated.wheels[k].place[1])).unwrap_or(0.0);
        let (left, right): (Vec<usize>, Vec<usize>) =
            measured.iter().partition(|&&k| self.stated.wheels[k].place[1] > lateral);
        if left.is_empty() || right.is_empty() {
            return self.refused("its wheels with counts are not on two sides");
        }
        let centre = [middle(0), middle(1)];
        if left.len() + right.len() == 2 {
            self.told.push("A side with several driven wheels lists the joints of all of them.".to_owned());
        }
        let side = |wheels: &mut Self, of: &[usize]| Side {
            joints: of.iter().map(|&k| joint(&wheels.stated.wheels[k])).collect(),
            radius: wheels.radius(of, "a side of diff_drive_controller"),
        };
        let (l, r) = (self.length(&left, |w| w.place[1]), self.length(&right, |w| w.place[1]));
        let separation = Length { stated: l.stated - r.stated, corrected: l.corrected - r.corrected };
        let geometry = Geometry::Differential { left: side(self, &left), right: side(self, &right), separation };
        self.tell_of(&measured, centre, "the middle of the wheels");
        Ok(geometry)
    }

    fn steered(&mut self, front: usize) -> Result<Geometry> {
        let wheels = &self.stated.wheels;
        let all: Vec<usize> = (0..wheels.len()).filter(|&k| k != front).collect();
        let measured: Vec<usize> = all.iter().copied().filter(|&k| wheels[k].measured).collect();
        let x = |k: &usize| wheels[*k].place[0];
        if all.iter().any(|k| (x(k) - x(&all[0])).abs() > NEAR) || x(&front) <= x(&all[0]) {
            return self.refused("the steered wheel is not before one fixed axle");
        }
        let (ahead, axle) = (self.length(&[front], |w| w.place[0]), self.length(&all, |w| w.place[0]));
        let wheelbase = Length { stated: ahead.stated - axle.stated, corrected: ahead.corrected - axle.corrected };
        let sideways = self.wanted.wheels[front].place[1] - self.length(&all, |w| w.place[1]).corrected;
        if sideways.abs() > NEAR {
            self.not_held
                .push(format!("the steered wheel is {sideways:.4} m beside the middle; controllers have it there."));
        }
        let wheel = &wheels[front];
        let steering = format!("{}_steering_joint", wheel.name.replace(' ', "_"));
        let names: Vec<String> = measured.iter().map(|&k| joint(&wheels[k])).collect();
        let front_radius = self.length(&[front], |w| w.radius);
        let is_driven = wheel.measured;
        let middle = [axle.corrected, self.length(&all, |w| w.place[1]).corrected];
        let geometry = match (&measured[..], &names[..]) {
            ([], _) => Geometry::DriveAndSteer { traction: joint(wheel), steering, wheelbase, radius: front_radius },
            ([rear], [name]) => {
                let radii = [front_radius, self.length(&[*rear], |w| w.radius)];
                Geometry::Bicycle { rear: name.clone(), steering, wheelbase, radii: Some(radii) }
            }
            ([a, b], _) => {
                let (ya, yb) = (self.length(&[*a], |w| w.place[1]), self.length(&[*b], |w| w.place[1]));
                let track =
                    Length { stated: (ya.stated - yb.stated).abs(), corrected: (ya.corrected - yb.corrected).abs() };
                // The controller wants the right wheel first.
                let rear = if ya.stated > yb.stated { [1, 0] } else { [0, 1] }.map(|k| names[k].clone()).to_vec();
                let rear_radius = self.radius(&measured, "tricycle_steering_controller");
                Geometry::Tricycle { rear, steering, track, wheelbase, front_radius, rear_radius }
            }
            _ => return self.refused("more than two wheels of the fixed axle have counts"),
        };
        if is_driven && !measured.is_empty() {
            let name = &self.stated.wheels[front].name;
            self.not_held.push(format!(
                "the counts of the steered wheel '{name}' are not read: {} takes speed from the fixed axle.",
                geometry.controller()
            ));
        }
        self.tell_of(&[&measured[..], &[front]].concat(), middle, "the middle of the fixed axle");
        Ok(geometry)
    }

    fn mecanum(&mut self) -> Result<Geometry> {
        let all = [0, 1, 2, 3];
        let middle = [0, 1].map(|axis| self.length(&all, |w| w.place[axis]));
        let stated = &self.stated.wheels;
        let corner = |k: usize| [0, 1].map(|axis: usize| stated[k].place[axis] > middle[axis].stated);
        let find = |at: [bool; 2]| all.into_iter().find(|&k| corner(k) == at);
        let corners = [[true, true], [true, false], [false, true], [false, false]].map(find);
        let [Some(fl), Some(fr), Some(rl), Some(rr)] = corners else {
            return self.refused("its mecanum wheels are not at four corners");
        };
        // Upper rollers form an X seen from above: what the controller's formulas have.
        let axles = [(fl, FRAC_PI_4), (fr, -FRAC_PI_4), (rl, -FRAC_PI_4), (rr, FRAC_PI_4)];
        let is_x = |(k, axle): (usize, f64)| is_along(stated[k].direction + stated[k].roller, axle, PI);
        let rolls_ahead = all.iter().all(|&k| is_along(stated[k].direction, 0.0, PI));
        if !axles.into_iter().all(is_x) || !rolls_ahead {
            return self.refused("the upper rollers of its mecanum wheels do not form an X");
        }
        let joints = [fl, fr, rl, rr].map(|k| joint(&stated[k]));
        let reach = |robot: &WheeledRobot, middle: [f64; 2]| {
            let of = |w: &Wheel| (w.place[0] - middle[0]).abs() + (w.place[1] - middle[1]).abs();
            mean(robot.wheels.iter().map(of)).unwrap_or(f64::NAN)
        };
        let reach = Length {
            stated: reach(self.stated, middle.map(|m| m.stated)),
            corrected: reach(self.wanted, middle.map(|m| m.corrected)),
        };
        let radius = self.radius(&all, "mecanum_drive_controller");
        self.tell_of(&all, middle.map(|m| m.corrected), "the middle of the wheels");
        Ok(Geometry::Mecanum { joints, radius, reach })
    }

    fn omni(&mut self) -> Result<Geometry> {
        let stated = &self.stated.wheels;
        let angle = |k: usize| stated[k].place[1].atan2(stated[k].place[0]);
        // From x on counter-clockwise, what is at x up to rounding first.
        let order = |k: usize| (angle(k) + ALIGNED).rem_euclid(TAU);
        let mut all: Vec<usize> = (0..stated.len()).collect();
        all.sort_by(|&a, &b| order(a).total_cmp(&order(b)));
        let step = TAU / all.len() as f64;
        let first = angle(all[0]);
        let is_even = all.iter().enumerate().all(|(i, &k)| is_along(angle(k), first + step * i as f64, TAU));
        let sense = |k: usize| (stated[k].direction - angle(k)).sin();
        let tangential = all.iter().all(|&k| is_along(stated[k].direction - angle(k), FRAC_PI_2, PI));
        let alike = all.iter().all(|&k| sense(k) * sense(all[0]) > 0.0);
        let reach = self.length(&all, |w| w.place[0].hypot(w.place[1]));
        let is_round = all.iter().all(|&k| {
            let [x, y] = self.stated.wheels[k].place;
            (x.hypot(y) / reach.stated - 1.0).abs() < ALIGNED
        });
        if !(is_even && tangential && alike && is_round) {
            return self.refused("its omni wheels are not evenly on a circle about the origin, all turning it one way");
        }
        let joints = all.iter().map(|&k| joint(&stated[k])).collect();
        let way = if sense(all[0]) > 0.0 { "counter-clockwise" } else { "clockwise" };
        self.told.push(format!(
            "Turned forward, a wheel of the robot file turns the robot {way}: compare with the controller's convention \
             and the joints' axes in the URDF."
        ));
        let radius = self.radius(&all, "omni_wheel_drive_controller");
        ensure!(
            reach.stated > 0.0,
            "robot '{}': its omni wheels are all at the origin; correct their places",
            self.stated.name
        );
        Ok(Geometry::Omni { joints, radius, reach, offset: first })
    }
}
