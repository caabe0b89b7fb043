//! Everything that the experiment assumes, as data.

use controller::Loop;
use robot_model::paper::Parameters;
use serde::{Deserialize, Serialize};

use crate::SimError;

/// Neurons per output of the identifier: the paper's 6.
pub const UNITS: usize = 6;
/// Inputs of the identifier's network besides the threshold: own speed, other speed, own torque, other torque.
pub const INPUTS: usize = 4;
/// Neurons of the controller's network.
pub(crate) const CONTROLLER_UNITS: usize = 8;

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
    /// Parameters, cruising speed (m/s) and radius of the loop (m) of the set.
    pub fn scenario(self) -> (Parameters, f64, f64) {
        match self {
            Self::A => (Parameters::SET_A, 0.4, 1.2),
            Self::B => (Parameters::SET_B, 0.5, 1.5),
            Self::C => (Parameters::SET_C, 0.6, 1.8),
        }
    }
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

/// The identifier.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IdentifierRecipe {
    /// a of A = −a I, 1/s.
    pub pole: f64,
    /// γ.
    pub gain: f64,
    /// Neurons per output; must be [`UNITS`].
    pub units: usize,
    /// First-layer weights are uniform between minus and plus this.
    pub first_layer_range: f64,
    /// Speed inputs are divided by this times v_max/r.
    pub speed_scale: f64,
    /// Torque inputs are divided by this times μ_p m g r.
    pub torque_scale: f64,
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
    /// Runge-Kutta steps per sample.
    pub substeps: usize,
    /// Time at which the rolling resistance rises, s.
    pub disturbance_at: f64,
    /// How much it rises, Δf_r.
    pub disturbance: f64,
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
        Self {
            title: String::new(),
            disclosure: String::new(),
            step: 1e-3,
            samples: 32_000,
            substeps: 20,
            disturbance_at: 12.0,
            disturbance: 0.3,
            path: PathRecipe { accelerate: 1.0, lead_in: 3.0, blend: 0.5, lead_out: 3.0, brake: 2.0 },
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
                units: UNITS,
                first_layer_range: 1.0,
                speed_scale: 1.4,
                torque_scale: 0.5,
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
        let positive = |name: &str, value: f64| {
            if value.is_finite() && value > 0.0 {
                Ok(())
            } else {
                Err(SimError::Recipe(format!("{name} is {value}, but it must be a finite number larger than zero")))
            }
        };
        positive("step", self.step)?;
        positive("identifier.first_layer_range", self.identifier.first_layer_range)?;
        positive("identifier.speed_scale", self.identifier.speed_scale)?;
        positive("identifier.torque_scale", self.identifier.torque_scale)?;
        positive("disturbance_at", self.disturbance_at)?;
        if self.samples == 0 || self.substeps == 0 {
            return Err(SimError::Recipe("samples and substeps must be at least 1".into()));
        }
        if self.identifier.units != UNITS {
            let found = self.identifier.units;
            return Err(SimError::Recipe(format!(
                "identifier.units is {found}, but this program is built for {UNITS}"
            )));
        }
        Ok(())
    }

    pub(crate) fn path(&self, speed: f64, radius: f64) -> Loop {
        let p = &self.path;
        Loop {
            speed,
            radius,
            accelerate: p.accelerate,
            lead_in: p.lead_in,
            blend: p.blend,
            lead_out: p.lead_out,
            brake: p.brake,
            turn: controller::Turn::Left,
        }
    }
}
