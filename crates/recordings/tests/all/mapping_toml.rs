//! Every mistake in a mapping is named with file, line and key.

use recordings::{Attributes, Mapping, Signal};

/// A mapping whose line 5 is the given signal.
fn with_signal(line: &str) -> String {
    format!("[[files]]\npattern = \"*.csv\"\ntime = {{ column = \"t\", unit = \"ms\" }}\n[files.signals]\n{line}\n")
}

/// The refusal without the column, which has a test of its own.
fn message(text: &str) -> String {
    let error = Mapping::parse("map.toml", text).unwrap_err();
    let (_, column) = error.spot().unwrap().at.unwrap();
    error.to_string().replacen(&format!(", column {column}"), "", 1)
}

#[test]
fn the_column_is_that_of_the_key_or_the_value() {
    let refusal = |text: &str| Mapping::parse("map.toml", text).unwrap_err().to_string();
    let unknown = refusal(&with_signal("gyro_z = { column = \"w\", unit = \"rad/s\", sgn = -1 }"));
    assert!(unknown.starts_with("map.toml: line 5, column 42: unknown key `sgn`"), "{unknown}");
    let unit = refusal(&with_signal("gyro_z = { column = \"µ\", unit = \"m/s\" }"));
    assert!(unit.starts_with("map.toml: line 5, column 33: gyro_z.unit"), "{unit}");
    let signal = refusal(&with_signal("  gyroz = { column = \"w\", unit = \"rad/s\" }"));
    assert!(signal.starts_with("map.toml: line 5, column 3: no signal"), "{signal}");
}

#[test]
fn a_good_mapping() {
    let text = with_signal(
        "torque_left = { column = \"i\", unit = \"mA\", scale = 2.5, sign = -1, dead_band = 100, kind = \"set-point\" }\n\
         gyro_z = { column = \"w\", unit = \"deg/s\" }",
    );
    let mapping = Mapping::parse("map.toml", &text).unwrap();
    assert_eq!(mapping.name, "map.toml");
    assert_eq!(mapping.files[0].time.ns_per_unit, 1_000_000);
    let torque = &mapping.files[0].columns[0];
    assert_eq!(torque.signal, Signal::TorqueLeft);
    assert!((torque.factor + 0.0025).abs() < 1e-18);
    let Attributes { magnitude_only, dead_band, set_point } = torque.attributes;
    assert!((dead_band.unwrap() - 0.25).abs() < 1e-15);
    assert!(!magnitude_only && set_point);
    assert!((mapping.files[0].columns[1].factor - 1f64.to_radians()).abs() < 1e-16);
}

#[test]
fn unknown_keys_are_refused_with_the_line() {
    let message_of = |line| message(&with_signal(line));
    let unknown = message_of("gyro_z = { column = \"w\", unit = \"rad/s\", sgn = -1 }");
    assert!(unknown.starts_with("map.toml: line 5: unknown key `sgn`; did you mean `sign`?"), "{unknown}");
    assert!(message("colour = 1\n[[files]]\n").starts_with("map.toml: line 1: unknown key `colour`"));
    assert!(message("[[files]]\npattern = \"*.csv\"\nfoo = 1\n").starts_with("map.toml: line 3: unknown key `foo`"));
}

#[test]
fn syntax_missing_keys_and_types() {
    assert!(message("[[files\n").starts_with("map.toml: line 1: "));
    assert!(message("").starts_with("map.toml: line 1: the key `files` is missing here"));
    let no_unit = message(&with_signal("gyro_z = { column = \"w\" }"));
    assert_eq!(no_unit, "map.toml: line 5: the key `unit` is missing here; add it");
    let text = message(&with_signal("gyro_z = { column = \"w\", unit = \"rad/s\", scale = \"big\" }"));
    assert!(text.starts_with("map.toml: line 5: invalid type"), "{text}");
    let kind = message(&with_signal("gyro_z = { column = \"w\", unit = \"rad/s\", kind = \"guess\" }"));
    assert!(kind.starts_with("map.toml: line 5: unknown value `guess`"), "{kind}");
}

#[test]
fn unknown_signals_and_units_get_the_nearest_name() {
    assert_eq!(
        message(&with_signal("gyroz = { column = \"w\", unit = \"rad/s\" }")),
        "map.toml: line 5: no signal is called `gyroz`; did you mean `gyro_z`?"
    );
    assert_eq!(
        message(&with_signal("gyro_z = { column = \"w\", unit = \"rads/s\" }")),
        "map.toml: line 5: gyro_z.unit: no unit is called `rads/s`; did you mean `rad/s`?"
    );
}

#[test]
fn a_wrong_unit_names_key_line_given_and_expected() {
    assert_eq!(
        message(&with_signal("gyro_z = { column = \"w\", unit = \"m/s\" }")),
        "map.toml: line 5: gyro_z.unit: wrong unit `m/s`, a speed where an angular speed is expected; \
         give a unit of that kind, such as rad/s, or add `scale` (1 / wheel radius in m)"
    );
    assert_eq!(
        message(&with_signal("torque_left = { column = \"w\", unit = \"V\" }")),
        "map.toml: line 5: torque_left.unit: wrong unit `V`, a voltage where a torque is expected; \
         give a unit of that kind, such as N m"
    );
    assert_eq!(
        message(&with_signal("torque_left = { column = \"w\", unit = \"A\" }")),
        "map.toml: line 5: torque_left.unit: wrong unit `A`, a current where a torque is expected; \
         give a unit of that kind, such as N m, or add `scale` (N m per A at the wheels)"
    );
    let time = "[[files]]\npattern = \"*.csv\"\ntime = { column = \"t\", unit = \"m\" }\n[files.signals]\n";
    assert!(message(time).starts_with("map.toml: line 3: time.unit: wrong unit `m`, a length where a time"));
}

#[test]
fn values_without_sense() {
    let cases = [
        ("sign = 2", "gyro_z.sign: 2 is neither 1 nor -1"),
        ("scale = -1.0", "gyro_z.scale: the scale must be finite and above zero; a turned sign is `sign = -1`"),
        ("scale = nan", "gyro_z.scale: the scale must be finite"),
        ("dead_band = -0.1", "gyro_z.dead_band: the dead band must be finite and not negative"),
        ("magnitude_only = true, sign = -1", "gyro_z.sign: a magnitude has no sign to turn"),
    ];
    for (key, expected) in cases {
        let text = message(&with_signal(&format!("gyro_z = {{ column = \"w\", unit = \"rad/s\", {key} }}")));
        assert!(text.starts_with(&format!("map.toml: line 5: {expected}")), "{text}");
    }
    let measured = "command_speed_left = { column = \"v\", unit = \"rad/s\", kind = \"measured\" }";
    assert!(message(&with_signal(measured)).contains("a set-point by its nature"));
    assert!(message(&with_signal("gyro_z = { column = \" \", unit = \"rad/s\" }")).contains("give the column's name"));
    assert!(message(&with_signal("")).starts_with("map.toml: line 2: signals: `*.csv` has no signal"));
}

#[test]
fn files_patterns_and_time() {
    let file = |pattern: &str, time: &str| {
        format!(
            "[[files]]\npattern = \"{pattern}\"\ntime = {time}\nsignals.gyro_z = {{ column = \"w\", unit = \"rad/s\" }}\n"
        )
    };
    let good = "{ rate_hz = 100 }";
    assert!(message("files = []").starts_with("map.toml: line 1: files: no file is described"));
    assert!(message(&file("a.csv", good)).starts_with("map.toml: line 2: pattern: `a.csv` needs one `*`"));
    assert!(message(&file("x/*.csv", good)).contains("and no folder"));
    assert!(message(&file("*.csv", "{ rate_hz = 0 }")).starts_with("map.toml: line 3: time.rate_hz"));
    assert!(message(&file("*.csv", "{}")).starts_with("map.toml: line 3: time: give `column` and `unit`"));
    assert!(message(&file("*.csv", "{ column = \"t\" }")).contains("`unit` is missing"));
    let twice = file("a_*.csv", good) + &file("b_*.csv", good);
    assert!(
        message(&twice).starts_with("map.toml: line 8: gyro_z: already read from `a_*.csv`"),
        "{}",
        message(&twice)
    );
    let same = file("a_*.csv", good) + &file("a_*.csv", good);
    assert!(message(&same).starts_with("map.toml: line 6: pattern: `a_*.csv` is given twice"));
    let delimiter = file("*.csv", good).replacen("time", "delimiter = \"ab\"\ntime", 1);
    assert!(message(&delimiter).starts_with("map.toml: line 3: delimiter: give one character"));
}
