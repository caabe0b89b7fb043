//! A robot file of `kind = "wheeled"`, as its reader has it.

use serde::Serialize;

#[derive(Serialize)]
pub(super) struct File {
    pub(super) name: String,
    pub(super) description: String,
    pub(super) kind: &'static str,
    pub(super) mass: Stated,
    pub(super) yaw_inertia: Stated,
    pub(super) centre_of_mass: [f64; 3],
    pub(super) centre_of_mass_sigma: f64,
    pub(super) centre_of_mass_source: String,
    pub(super) wheel: Vec<WheelRow>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) caster: Vec<CasterRow>,
    pub(super) motor: Vec<MotorRow>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) joint: Vec<JointRow>,
    pub(super) ground: GroundRow,
    pub(super) known: Known,
    pub(super) point: Point,
    pub(super) columns: Columns,
}

#[derive(Serialize)]
pub(super) struct Stated {
    pub(super) value: f64,
    pub(super) sigma: f64,
    pub(super) source: String,
}

#[derive(Serialize)]
pub(super) struct WheelRow {
    pub(super) name: String,
    pub(super) place: [f64; 2],
    pub(super) direction_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) roller_deg: Option<f64>,
    pub(super) radius: f64,
    pub(super) radius_sigma: f64,
    pub(super) inertia: f64,
    /// Whether the model tells it.
    #[serde(skip)]
    pub(super) has_inertia: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) motor: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) steered_by: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) column: Option<String>,
    pub(super) source: String,
}

#[derive(Serialize)]
pub(super) struct CasterRow {
    pub(super) place: [f64; 2],
    pub(super) trail: f64,
    /// Whether the model tells it.
    #[serde(skip)]
    pub(super) has_trail: bool,
    pub(super) rolling_resistance: f64,
    pub(super) source: String,
}

#[derive(Serialize)]
pub(crate) struct MotorRow {
    pub(super) name: String,
    pub(super) column: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) inertia: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) coulomb: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) coulomb_sigma: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) viscous: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) viscous_sigma: Option<f64>,
    pub(super) source: String,
}

#[derive(Serialize)]
pub(super) struct JointRow {
    pub(super) name: String,
    pub(super) place: [f64; 2],
    pub(super) unsteered_axle_x: f64,
    pub(super) column: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) angle_per_unit: Option<f64>,
    pub(super) source: String,
}

#[derive(Serialize)]
pub(super) struct GroundRow {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) adhesion: Option<f64>,
    pub(super) rolling_resistance: f64,
    pub(super) source: String,
}

#[derive(Serialize)]
pub(super) struct Known {
    pub(super) place_share: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) adhesion_share: Option<f64>,
}

#[derive(Serialize)]
pub(super) struct Point {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) yaw_deg: f64,
}

#[derive(Serialize)]
pub(super) struct Columns {
    pub(super) time: &'static str,
    pub(super) wheels: &'static str,
    pub(super) gyro: &'static str,
    pub(super) x: &'static str,
    pub(super) y: &'static str,
    pub(super) yaw: &'static str,
}
