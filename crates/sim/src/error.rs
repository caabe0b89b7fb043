//! Why a simulation did not run to its end.

/// A simulation that could not be set up, or that stopped.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimError {
    /// The robot cannot be.
    #[error("the robot: {0}")]
    Robot(#[from] robot_model::ModelError),
    /// The path or a gain cannot be used.
    #[error("the controller: {0}")]
    Controller(#[from] controller::ControllerError),
    /// A network cannot be built.
    #[error("the network: {0}")]
    Basis(#[from] nn_basis::BasisError),
    /// An identifier cannot be built.
    #[error("the identifier: {0}")]
    Identifier(#[from] identifier::IdentifierError),
    /// The recipe contradicts itself.
    #[error("the recipe: {0}")]
    Recipe(String),
    /// A value stopped being a finite number.
    #[error("{quantity} is no longer a finite number at t = {time} s; more substeps or a smaller step may help")]
    NotFinite {
        /// Which quantity.
        quantity: &'static str,
        /// When, s.
        time: f64,
    },
    /// A wheel lifted: the model holds for four wheels on the ground only.
    #[error("wheel {wheel} lifts off the ground at t = {time} s; drive slower or lower the centre of mass")]
    Lifted {
        /// The paper's number of the wheel, from 1.
        wheel: usize,
        /// When, s.
        time: f64,
    },
}
