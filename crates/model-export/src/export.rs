//! One model for one engine.

use robot_model::effect::export::Engine;

use crate::model::{ExportError, Exported, Model};
use crate::residual::Residual;
use crate::{added, mjcf, sdf, translate, urdf};

impl Model<'_> {
    /// The model for an engine.
    ///
    /// # Errors
    /// An effect or value that the catalogue does not have, or a robot that cannot be.
    pub fn export(&self, engine: Engine) -> Result<Exported, ExportError> {
        let vehicle = translate::vehicle(self, engine)?;

        let text = match engine {
            Engine::Mjcf => mjcf::document(self, &vehicle)?,
            Engine::Urdf => urdf::document(self, &vehicle)?,
            Engine::Sdf => sdf::document(self, &vehicle)?,
        };
        let residual = (engine == Engine::Mjcf).then(|| added::python(self.name, &vehicle)).flatten();

        Ok(Exported { text, residual, notes: vehicle.residuals.iter().map(Residual::note).collect() })
    }
}
