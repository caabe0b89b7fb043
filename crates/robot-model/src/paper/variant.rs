//! Two readings of the plant that the paper does not take, for comparison with the one it does.

/// Which equation drives the belt-coupled wheels of a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Belt {
    /// Eq. 8 as printed: twice the equation of the rear wheel, as if the front wheel carried the same load.
    #[default]
    Literal,
    /// The sum of both wheels' equations, which the belt really enforces:
    /// `2 a1 θ̈ = τ − 2 a2 sgn θ̇ − r (F_front,x + F_rear,x) − r f_r (N_front + N_rear) sgn θ̇`.
    ///
    /// Where both wheels slip alike, load that moves between the axles moves no torque: a4, a7 and l_f cancel.
    SideSum,
}

/// How longitudinal and lateral slip share the adhesion of a wheel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Tyre {
    /// Kiencke's law in each direction by itself, `K = 2 λp λ_x/(λp² + λ_x²)` as in Eq. 8.
    #[default]
    Uncoupled,
    /// Isotropic combined slip, `K = 2 λp λ_x/(λp² + λ_x² + λ_y²)`: the whole force follows Kiencke's law.
    Combined,
}

/// The variant of the plant. The default is the paper's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields, rename_all = "snake_case")
)]
pub struct Variant {
    /// The equation of a side.
    pub belt: Belt,
    /// The tyre under combined slip.
    pub tyre: Tyre,
}
