//! Robot files that are read, and those that are built in.

use std::path::Path;

use inference::KnownEffects;
use recordings::{Spot, suggest};

use crate::flat::FlatRobot;
use crate::full::File;
use crate::text::RobotText;
use crate::{RobotFileError, RobotSpec};

/// Robots that are built in, each with its file.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("husky-a200", include_str!("../robots/husky-a200.toml")),
    ("kobuki", include_str!("../robots/kobuki.toml")),
    ("husky-drive", include_str!("../robots/husky-drive.toml")),
    ("warthog-drive", include_str!("../robots/warthog-drive.toml")),
    ("hendzel-trojnacki-2014", include_str!("../robots/hendzel-trojnacki-2014.toml")),
];

impl RobotSpec {
    /// A built-in robot.
    ///
    /// # Errors
    /// When there is none of this name.
    pub fn built_in(name: &str) -> Result<Self, RobotFileError> {
        let (_, text) = BUILT_IN.iter().find(|b| b.0 == name).ok_or_else(|| {
            let hint = suggest::hint(name, &BUILT_IN.iter().map(|b| b.0).collect::<Vec<_>>());
            RobotFileError::Unknown { name: name.to_owned(), hint }
        })?;
        Self::parse(&format!("{name}.toml"), text)
    }

    /// Reads a robot file; JSON when its name ends so, else TOML.
    ///
    /// JSON without `parameters`, `name` and `causality` is taken in the flat form.
    ///
    /// # Errors
    /// Syntax, unknown keys, units and values, each with file and place.
    pub fn parse(file: &str, text: &str) -> Result<Self, RobotFileError> {
        Self::parse_with(KnownEffects::default(), file, text)
    }

    /// The same of a file whose effects may be some of one's own.
    ///
    /// # Errors
    /// As [`RobotSpec::parse`].
    pub fn parse_with(known: KnownEffects, file: &str, text: &str) -> Result<Self, RobotFileError> {
        let source = RobotText { file, text };
        if text.trim().is_empty() {
            return Err(RobotFileError::Empty { place: Spot::file(file) });
        }
        let json = Path::new(file).extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
        if !json {
            let parsed: File = toml::from_str(text).map_err(|e| source.toml(&e))?;
            return Ok(parsed.spec(source, known)?.adopting());
        }

        let value: serde_json::Value = serde_json::from_str(text).map_err(|e| source.json(&e))?;
        if ["format", "diagnosis"].iter().all(|key| value.get(key).is_some()) {
            let message = format!(
                "this is a verdict and no robot file; write its corrected robot with `lacuna export {file} --to toml -o robot.toml` \
                 and give that"
            );
            return Err(RobotFileError::Syntax { place: Spot::file(file), message });
        }
        let full = ["parameters", "name", "causality"].iter().any(|key| value.get(key).is_some());
        let robot = if full {
            let parsed: File = serde_json::from_str(text).map_err(|e| source.json(&e))?;
            parsed.spec(source, known)
        } else {
            let flat: FlatRobot = serde_json::from_str(text).map_err(|e| source.json(&e))?;
            flat.spec(source, known)
        };
        Ok(robot?.adopting())
    }
}
