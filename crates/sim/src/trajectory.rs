//! The robot under its controller on the loop.

use controller::{Gains, Loop, LoopPath, PathReference, Tracking, WheelState};
use nn_basis::{Activation, SigmoidLayer};
use robot_model::paper::{PaperRobot, Parameters, State};

use crate::network_recipe::Signals;
use crate::random::{Purpose, Stream};
use crate::recipe::Integrator;
use crate::{Recipe, RobotSet, SimError};

/// The five disturbances of the paper's Fig. 6d, in order.
pub const EVENTS: [&str; 5] = ["start", "loop entry", "rolling resistance", "loop exit", "braking"];

/// Length of the quiet part at the end of a window, s.
const QUIET: f64 = 0.5;
/// How long after an event has ended its error may still peak, s.
const RING: f64 = 0.5;

/// When the five disturbances act and when nothing should happen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Windows {
    /// Start of each event, s.
    pub start: [f64; 5],
    /// Until when the error of each event may peak, s.
    pub peak_until: [f64; 5],
    /// Start of the quiet part that ends each window, s.
    pub quiet: [f64; 5],
    /// End of each window, s.
    pub end: [f64; 5],
}

/// A recorded run of the closed loop: all that identifiers and figures need.
#[derive(Debug, Clone)]
pub struct Trajectory {
    /// Time between samples, s.
    pub step: f64,
    /// States at the samples 0..=n.
    pub states: Vec<State<f64>>,
    /// Torques τ3, τ4 held over the intervals 0..n, N m.
    pub torques: Vec<[f64; 2]>,
    /// Desired position at the samples 0..n, m.
    pub desired: Vec<[f64; 2]>,
    /// Smallest load of any wheel, N.
    pub smallest_load: f64,
    /// Largest distance from the desired position, m.
    pub largest_path_error: f64,
    /// When the disturbances act.
    pub windows: Windows,
    /// The robot before the disturbance.
    pub parameters: Parameters,
    /// Cruising speed, m/s.
    pub speed: f64,
}

impl Trajectory {
    /// Simulates the recipe with the robot of a set.
    ///
    /// # Errors
    /// [`SimError`] if the recipe cannot be used, a value stops being finite, or a wheel lifts.
    pub fn simulate(recipe: &Recipe, set: RobotSet) -> Result<Self, SimError> {
        let scenario = recipe.sets.of(set);
        Self::of(recipe, &scenario.robot, &recipe.path(scenario))
    }

    /// Simulates the recipe with any robot on any loop; the durations of the recipe's own path are not used.
    ///
    /// # Errors
    /// As [`Trajectory::simulate`].
    pub fn of(recipe: &Recipe, parameters: &Parameters, path: &Loop) -> Result<Self, SimError> {
        recipe.check()?;
        let nominal = PaperRobot::<f64>::with_variant(parameters, recipe.plant)?;
        let disturbed = nominal.with_rolling_resistance(parameters.rolling_resistance + recipe.disturbance)?;
        let checked = LoopPath::new(path)?;
        let windows = windows(recipe, path, &checked)?;
        let mut controller = tracking(recipe, parameters, path, checked)?;
        let switch = (recipe.disturbance_at / recipe.step).round() as usize;
        let h = recipe.step / recipe.substeps as f64;

        let mut state = State::<f64>::default();
        let mut run = Self {
            step: recipe.step,
            states: Vec::with_capacity(recipe.samples + 1),
            torques: Vec::with_capacity(recipe.samples),
            desired: Vec::with_capacity(recipe.samples),
            smallest_load: f64::INFINITY,
            largest_path_error: 0.0,
            windows,
            parameters: *parameters,
            speed: path.speed,
        };
        run.states.push(state);
        for k in 0..recipe.samples {
            let robot = if k < switch { &nominal } else { &disturbed };
            let measured =
                WheelState { x: state.x, y: state.y, yaw: state.yaw, angle: state.angle, speed: state.speed };
            let action = controller.step(&measured, recipe.step);
            let torque = action.torque;
            match recipe.integrator {
                Integrator::Rk4 => robot.steps_rk4(&mut state, torque, h, recipe.substeps),
                Integrator::Implicit => (0..recipe.substeps).for_each(|_| robot.step_implicit(&mut state, torque, h)),
            }
            let time = (k + 1) as f64 * recipe.step;
            if let Some(i) = state.to_array().iter().position(|v| !v.is_finite()) {
                return Err(SimError::NotFinite { quantity: State::<f64>::NAMES[i], time });
            }
            let load = robot.loads(&state);
            if let Some(wheel) = load.iter().position(|n| *n <= 0.0) {
                return Err(SimError::Lifted { wheel: wheel + 1, time });
            }
            run.smallest_load = load.into_iter().fold(run.smallest_load, f64::min);
            let [dx, dy] = [action.reference.x - measured.x, action.reference.y - measured.y];
            run.largest_path_error = run.largest_path_error.max(length(dx, dy));
            run.states.push(state);
            run.torques.push(torque);
            run.desired.push([action.reference.x, action.reference.y]);
        }
        Ok(run)
    }

    /// What the networks of both outputs may see over interval k: mean angles and speeds, and the torques held.
    #[inline]
    pub fn signals(&self, k: usize) -> [Signals; 2] {
        let (now, next, u) = (&self.states[k], &self.states[k + 1], &self.torques[k]);
        let angle = [0, 1].map(|i| 0.5 * (now.angle[i] + next.angle[i]));
        let speed = [0, 1].map(|i| 0.5 * (now.speed[i] + next.speed[i]));
        [0, 1].map(|own| {
            let other = 1 - own;
            [angle[own], angle[other], speed[own], speed[other], u[own], u[other]]
        })
    }
}

/// Length of a vector with the four basic operations and a square root only: the same bits everywhere.
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// Neurons of the controller's network.
const CONTROLLER_UNITS: usize = 8;

type LoopController = Tracking<f64, SigmoidLayer<f64, 4, CONTROLLER_UNITS>, CONTROLLER_UNITS>;

fn tracking(
    recipe: &Recipe,
    parameters: &Parameters,
    path: &Loop,
    checked: LoopPath<f64>,
) -> Result<LoopController, SimError> {
    let c = &recipe.controller;
    let gains = Gains {
        kx: c.kx,
        ky: c.ky,
        k_yaw: c.k_yaw,
        slope: c.slope,
        adaptation: c.adaptation,
        leak: c.leak,
        robust: c.robust,
        effective_track: c.track_factor * parameters.track,
        ..Gains::for_robot(parameters, c.bandwidth)
    };
    let mut stream = Stream::new(c.seed, Purpose::ControllerLayer, 0);
    let threshold = std::array::from_fn(|_| stream.uniform(-1.0, 1.0));
    let weight = std::array::from_fn(|_| std::array::from_fn(|_| stream.uniform(-1.0, 1.0)));
    let scale = recipe.identifier.network.speed_scale * path.speed / parameters.wheel_radius;
    let layer = SigmoidLayer::new(threshold, weight, [scale; 4], Activation::Logistic)?;
    Ok(Tracking::new(&gains, layer, PathReference::new(checked))?)
}

fn windows(recipe: &Recipe, path: &Loop, checked: &LoopPath<f64>) -> Result<Windows, SimError> {
    let e = checked.events();
    let start = [0.0, e.entry, recipe.disturbance_at, e.exit, e.brake];
    let duration = [path.accelerate, path.blend, 0.0, path.blend, path.brake];
    if start.windows(2).any(|pair| pair[1] - pair[0] < 2.0 * QUIET) {
        return Err(SimError::Recipe(format!(
            "the events at {start:.2?} s must follow each other with at least {} s between them",
            2.0 * QUIET
        )));
    }
    let last = recipe.samples as f64 * recipe.step;
    let end = [start[1], start[2], start[3], start[4], last];
    let peak_until = std::array::from_fn(|i| start[i] + duration[i] + RING);
    Ok(Windows { start, peak_until, quiet: end.map(|t| t - QUIET), end })
}
