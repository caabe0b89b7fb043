//! The mappings that are built in.

use bags::suggest;

use crate::error::RecordingError;
use crate::mapping::Mapping;

/// The mappings that are built in, by name, as the TOML text that a user can copy and change.
pub const BUILT_IN_MAPPINGS: &[(&str, &str)] = &[
    ("skid-steer-columns", include_str!("../mappings/skid-steer-columns.toml")),
    ("husky-open", include_str!("../mappings/husky-open.toml")),
    ("husky-bag", include_str!("../mappings/husky-bag.toml")),
    ("kobuki-bag", include_str!("../mappings/kobuki-bag.toml")),
    ("lacuna", include_str!("../mappings/lacuna.toml")),
];

impl Mapping {
    /// The built-in mapping of this name.
    ///
    /// # Errors
    /// When there is none; the message names the nearest, or all.
    pub fn built_in(name: &str) -> Result<Self, RecordingError> {
        if let Some((known, text)) = BUILT_IN_MAPPINGS.iter().find(|(known, _)| *known == name) {
            return Self::parse(known, text);
        }
        let known: Vec<&str> = BUILT_IN_MAPPINGS.iter().map(|(known, _)| *known).collect();
        let hint = suggest::hint(name, &known);
        Err(RecordingError::UnknownMapping { name: name.to_owned(), hint })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channel::Attributes;
    use crate::signal::Signal;
    use crate::units::Unit;

    #[test]
    fn built_in_mappings_parse_and_carry_their_name() {
        for (name, _) in BUILT_IN_MAPPINGS {
            assert_eq!(Mapping::built_in(name).unwrap().name, *name);
        }
        let message = Mapping::built_in("husky_open").unwrap_err().to_string();
        assert_eq!(message, "no built-in mapping is called `husky_open`; did you mean `husky-open`?");
    }

    #[test]
    fn self_describing_columns_cover_the_vocabulary() {
        let mapping = Mapping::built_in("skid-steer-columns").unwrap();
        let columns = &mapping.files[0].columns;
        assert_eq!(columns.len(), Signal::ALL.len());
        for (column, &signal) in columns.iter().zip(Signal::ALL) {
            assert_eq!((column.signal, column.factor), (signal, 1.0));
            assert_eq!(column.column, signal.column_name());
            assert!(column.optional);
            let set_point = signal.is_set_point() || signal.unit() == Unit::NewtonMetre;
            assert_eq!(column.attributes.set_point, set_point);
        }
    }

    #[test]
    fn what_this_crate_writes_is_covered_in_every_format() {
        let mapping = Mapping::built_in("lacuna").unwrap();
        for pattern in ["*.mcap", "*.parquet", "*.csv"] {
            let files = mapping.files.iter().filter(|file| file.pattern == pattern);
            let columns: Vec<_> =
                files.flat_map(|file| file.columns.iter().map(move |column| (file, column))).collect();
            assert_eq!(columns.len(), Signal::ALL.len(), "{pattern}");
            for ((file, column), &signal) in columns.iter().zip(Signal::ALL) {
                assert_eq!((column.signal, column.factor, column.optional), (signal, 1.0, true));
                let bag = pattern == "*.mcap";
                let name = if bag { "value".to_owned() } else { signal.column_name() };
                assert_eq!((&column.column, &file.topic), (&name, &bag.then(|| format!("/{signal}"))));
            }
        }
    }

    #[test]
    fn the_husky_mapping_says_what_the_data_set_says() {
        let mapping = Mapping::built_in("husky-open").unwrap();
        let find = |signal| {
            let mut all = mapping.files.iter().flat_map(|file| &file.columns);
            all.find(|column| column.signal == signal).unwrap()
        };
        let current = find(Signal::CurrentLeft);
        assert_eq!(current.column, "curL");
        let expected = Attributes { magnitude_only: true, dead_band: Some(0.59), set_point: false };
        assert_eq!(current.attributes, expected);
        let speed = find(Signal::CommandSpeedRight);
        assert!(speed.attributes.set_point);
        assert!((speed.factor * 0.1651 - 1.0).abs() < 1e-12);
        assert_eq!(find(Signal::GyroZ).factor, 1.0);
        assert_eq!(mapping.files[0].time.rate_hz, Some(6.5));
    }
}
