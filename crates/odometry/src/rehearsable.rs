//! What the drives of a case could say.

use std::collections::BTreeSet;

use hierarchical_fit::{Hideable, Rehearsable, Told};
use nalgebra::DVector;
use verdict::SensorNoise;

use crate::case::Case;
use crate::diagnose::Solved;
use crate::fit::scatter;
use crate::settings::SETTINGS;
use crate::windows::Data;

/// What sessions of these drives could say, about what was found in them.
pub(crate) fn rehearsable(case: &Case, data: &Data<'_>, solved: &Solved) -> Rehearsable {
    let Solved { constants, causes, fit, .. } = solved;
    let told = |k: usize| {
        let (constant, at) = (&constants[k], fit.theta[k]);
        let multiplied = constant.quantity.multiplied(&case.robot);
        let value = multiplied.map_or(at, |of| of * at.exp());
        let room = [f64::NEG_INFINITY, f64::INFINITY];
        Told { value, is_factor: multiplied.is_some(), unit: constant.unit, room }
    };
    let seconds = |session: usize| {
        let drives = data.drives.iter().zip(&data.session).filter(|(_, of)| **of == session);
        drives.map(|(drive, _)| drive.duration()).sum::<f64>()
    };
    let sessions = data.sessions.iter().zip(&fit.sessions).enumerate();
    let windows: usize = data.windows.iter().map(Vec::len).sum();
    let length: f64 = data.drives.iter().map(|drive| drive.duration()).sum();
    Rehearsable {
        drives: sessions.map(|(k, (name, session))| (name.clone(), seconds(k), session.clone())).collect(),
        references: case.references.iter().map(|drive| &drive.session).collect::<BTreeSet<_>>().len(),
        stated: DVector::from_iterator(constants.len(), constants.iter().map(|c| c.sigma)),
        scatter: scatter(data, fit.factors),
        between: DVector::zeros(constants.len()),
        causes: causes.iter().filter_map(|cause| Hideable::new(cause, told)).collect(),
        noise: vec![SensorNoise {
            channel: format!("the pose {} s ahead", SETTINGS.windows.length).into(),
            sigma: fit.scale,
            unit: "m".into(),
            rate: windows as f64 / length.max(f64::MIN_POSITIVE),
            source: "what the fit leaves".into(),
        }],
    }
}
