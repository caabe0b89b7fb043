//! The message types. Those called `foxglove.*` are Foxglove's own, which its panels show by themselves.

/// A message type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Schema {
    Compared,
    Mismatch,
    State,
    Pose,
    Path,
    Log,
}

/// An instant as Foxglove writes it.
const TIME: &str = r#"{ "type": "object", "title": "time", "properties": {
      "sec": { "type": "integer", "minimum": 0 }, "nsec": { "type": "integer", "minimum": 0, "maximum": 999999999 } } }"#;

const NUMBER: &str = r#"{ "type": "number" }"#;
const TEXT: &str = r#"{ "type": "string" }"#;
const WHOLE: &str = r#"{ "type": "integer" }"#;
const POSE: &str = r#"{ "type": "object", "title": "foxglove.Pose", "properties": {
      "position": { "type": "object", "title": "foxglove.Vector3", "properties": {
        "x": { "type": "number" }, "y": { "type": "number" }, "z": { "type": "number" } } },
      "orientation": { "type": "object", "title": "foxglove.Quaternion", "properties": {
        "x": { "type": "number" }, "y": { "type": "number" }, "z": { "type": "number" }, "w": { "type": "number" } } } } }"#;

impl Schema {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Compared => "lacuna.Compared",
            Self::Mismatch => "lacuna.Mismatch",
            Self::State => "lacuna.State",
            Self::Pose => "foxglove.PoseInFrame",
            Self::Path => "foxglove.PosesInFrame",
            Self::Log => "foxglove.Log",
        }
    }

    /// Its properties beside the time stamp.
    fn properties(self) -> Vec<(&'static str, String)> {
        let all = |kind: &str, names: &[&'static str]| names.iter().map(|name| (*name, kind.to_owned())).collect();
        let mut out: Vec<(&'static str, String)> = match self {
            Self::Compared => all(
                NUMBER,
                &["recorded", "nominal", "retuned", "corrected", "residual_before", "residual_after", "usual"],
            ),
            Self::Mismatch => all(NUMBER, &["before", "after"]),
            Self::State => all(TEXT, &["state"]),
            Self::Pose => vec![("pose", POSE.to_owned())],
            Self::Path => vec![("poses", format!(r#"{{ "type": "array", "items": {POSE} }}"#))],
            Self::Log => all(TEXT, &["message", "name", "file"]),
        };
        match self {
            Self::Compared => out.extend(all(TEXT, &["unit"])),
            Self::Pose | Self::Path => out.extend(all(TEXT, &["frame_id"])),
            Self::Log => out.extend(all(WHOLE, &["level", "line"])),
            Self::Mismatch | Self::State => {}
        }
        out
    }

    /// The type as JSON Schema. A number that is missing in a message is a gap.
    pub(super) fn text(self) -> String {
        let mut properties = vec![format!("    \"timestamp\": {TIME}")];
        properties.extend(self.properties().iter().map(|(name, kind)| format!("    \"{name}\": {kind}")));
        format!(
            "{{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n  \"title\": \"{}\",\n  \
             \"type\": \"object\",\n  \"properties\": {{\n{}\n  }}\n}}\n",
            self.name(),
            properties.join(",\n")
        )
    }
}
