//! Everything that the experiment assumes, as data.

use controller::{Loop, Profile};
use robot_model::paper::{Parameters, Variant};
use serde::{Deserialize, Serialize};

use crate::{NetworkRecipe, SimError};

/// Neurons per output of the identifier: the paper's 6.
pub const UNITS: usize = 6;
/// Neurons per output of the wider network that the sensitivity table looks at.
pub(crate) const WIDE: usize = 12;

/// The robots that the paper's experiment can be run with; the paper does not give its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum RobotSet {
    /// 20 kg.
    A,
    /// 40 kg, the default.
    #[default]
    B,
    /// 90 kg.
    C,
}

impl RobotSet {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::A, Self::B, Self::C];

    /// Its letter.
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
        }
    }
}

/// A robot and how it is driven.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Cruising speed, m/s.
    pub speed: f64,
    /// Radius of the loop, m.
    pub radius: f64,
    /// The robot.
    pub robot: Parameters,
}

/// The three scenarios.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenarios {
    /// 20 kg at 0.4 m/s.
    #[serde(rename = "A")]
    pub a: Scenario,
    /// 40 kg at 0.5 m/s.
    #[serde(rename = "B")]
    pub b: Scenario,
    /// 90 kg at 0.6 m/s.
    #[serde(rename = "C")]
    pub c: Scenario,
}

impl Scenarios {
    /// The scenario of a set.
    pub fn of(&self, set: RobotSet) -> &Scenario {
        match set {
            RobotSet::A => &self.a,
            RobotSet::B => &self.b,
            RobotSet::C => &self.c,
        }
    }
}

/// How the speed rises and falls; see [`Profile`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SpeedProfile {
    /// Constant acceleration.
    #[default]
    Trapezoid,
    /// Continuous acceleration.
    Smoothstep,
}

/// The path in time; speed and radius come with the robot's set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathRecipe {
    /// Duration of the acceleration T_acc, s.
    pub accelerate: f64,
    /// Duration of the straight before the loop, s.
    pub lead_in: f64,
    /// Duration of the blends T_bl, s.
    pub blend: f64,
    /// Duration of the straight after the loop, s.
    pub lead_out: f64,
    /// Duration of the braking T_br, s.
    pub brake: f64,
    /// Shape of accelerating and braking.
    pub profile: SpeedProfile,
}

/// The tracking controller; see [`controller::Gains`] for the symbols.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ControllerRecipe {
    /// Bandwidth of the wheel loop ω_b, 1/s; sets the damping K_D.
    pub bandwidth: f64,
    /// k_x, 1/s.
    pub kx: f64,
    /// k_y, 1/m².
    pub ky: f64,
    /// k_φ, 1/s.
    pub k_yaw: f64,
    /// Λ, 1/s.
    pub slope: f64,
    /// Γ, N m s/rad.
    pub adaptation: f64,
    /// κ, 1/(N m).
    pub leak: f64,
    /// k_r, N m.
    pub robust: f64,
    /// Effective track over track χ.
    pub track_factor: f64,
    /// Seed of the first layer of its network, weights U(−1, 1).
    pub seed: u64,
}

/// The scheme by which the plant advances.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// [`robot_model::paper::PaperRobot::step_rk4`]: fourth order, explicit.
    #[default]
    Rk4,
    /// [`robot_model::paper::PaperRobot::step_implicit`]: second order, for steps longer than the slip takes to decay.
    Implicit,
}

/// The scheme by which the identifier advances.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scheme {
    /// [`identifier::Midpoint`].
    #[default]
    Midpoint,
    /// [`identifier::Exponential`].
    Exponential,
    /// [`identifier::Euler`].
    Euler,
}

/// The identifier.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IdentifierRecipe {
    /// a of A = −a I, 1/s.
    pub pole: f64,
    /// γ.
    pub gain: f64,
    /// How it advances.
    pub scheme: Scheme,
    /// Its network.
    pub network: NetworkRecipe,
}

/// The recipe of the experiment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recipe {
    /// Name of what is reproduced.
    pub title: String,
    /// What was chosen, when and why: to be printed with the results.
    pub disclosure: String,
    /// Time between samples, s.
    pub step: f64,
    /// Number of samples n.
    pub samples: usize,
    /// Steps of the plant per sample.
    pub substeps: usize,
    /// How the plant advances.
    #[serde(default)]
    pub integrator: Integrator,
    /// Time at which the rolling resistance rises, s.
    pub disturbance_at: f64,
    /// How much it rises, Δf_r.
    pub disturbance: f64,
    /// Which readings of the plant are taken.
    pub plant: Variant,
    /// The robots.
    pub sets: Scenarios,
    /// The path.
    pub path: PathRecipe,
    /// The controller.
    pub controller: ControllerRecipe,
    /// The identifier.
    pub identifier: IdentifierRecipe,
}

impl Default for Recipe {
    /// The frozen recipe of the reproduction, without its texts.
    fn default() -> Self {
        let scenario = |speed, radius, robot| Scenario { speed, radius, robot };
        Self {
            title: String::new(),
            disclosure: String::new(),
            step: 1e-3,
            samples: 32_000,
            substeps: 20,
            integrator: Integrator::Rk4,
            disturbance_at: 12.0,
            disturbance: 0.3,
            plant: Variant::default(),
            sets: Scenarios {
                a: scenario(0.4, 1.2, Parameters::SET_A),
                b: scenario(0.5, 1.5, Parameters::SET_B),
                c: scenario(0.6, 1.8, Parameters::SET_C),
            },
            path: PathRecipe {
                accelerate: 1.0,
                lead_in: 3.0,
                blend: 0.5,
                lead_out: 3.0,
                brake: 2.0,
                profile: SpeedProfile::Trapezoid,
            },
            controller: ControllerRecipe {
                bandwidth: 100.0,
                kx: 1.0,
                ky: 4.0,
                k_yaw: 2.0,
                slope: 4.0,
                adaptation: 20.0,
                leak: 0.05,
                robust: 0.0,
                track_factor: 1.5,
                seed: 2014,
            },
            identifier: IdentifierRecipe {
                pole: 8.0,
                gain: 500.0,
                scheme: Scheme::Midpoint,
                network: NetworkRecipe::default(),
            },
        }
    }
}

impl Recipe {
    /// Refuses a recipe that contradicts itself or this program.
    ///
    /// # Errors
    /// [`SimError::Recipe`] says what does not fit.
    pub fn check(&self) -> Result<(), SimError> {
        positive("step", self.step)?;
        positive("disturbance_at", self.disturbance_at)?;
        if self.samples == 0 || self.substeps == 0 {
            return Err(SimError::Recipe("samples and substeps must be at least 1".into()));
        }
        self.identifier.network.check()
    }

    /// Duration of the run, s.
    pub fn duration(&self) -> f64 {
        self.samples as f64 * self.step
    }

    /// The loop that a scenario drives.
    pub fn path(&self, scenario: &Scenario) -> Loop {
        let p = &self.path;
        Loop {
            speed: scenario.speed,
            radius: scenario.radius,
            accelerate: p.accelerate,
            lead_in: p.lead_in,
            blend: p.blend,
            lead_out: p.lead_out,
            brake: p.brake,
            turn: controller::Turn::Left,
            profile: match p.profile {
                SpeedProfile::Trapezoid => Profile::Trapezoid,
                SpeedProfile::Smoothstep => Profile::Smoothstep,
            },
        }
    }
}

/// Refuses what is not a finite number above zero.
pub(crate) fn positive(name: &str, value: f64) -> Result<(), SimError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(SimError::Recipe(format!("{name} is {value}, but it must be a finite number larger than zero")))
    }
}
