//! Unit names at the file border: a name becomes a factor and the SI unit of its quantity.

/// The SI unit of a quantity. Inside Lacuna every number is in one of these.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Unit {
    /// Seconds.
    Second,
    /// Metres.
    Metre,
    /// Metres per second.
    MetrePerSecond,
    /// Metres per second squared.
    MetrePerSecondSquared,
    /// Radians.
    Radian,
    /// Radians per second.
    RadianPerSecond,
    /// Newton metres.
    NewtonMetre,
    /// Amperes.
    Ampere,
    /// Volts.
    Volt,
}

impl Unit {
    /// How the unit is written: `rad/s`.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Second => "s",
            Self::Metre => "m",
            Self::MetrePerSecond => "m/s",
            Self::MetrePerSecondSquared => "m/s^2",
            Self::Radian => "rad",
            Self::RadianPerSecond => "rad/s",
            Self::NewtonMetre => "N m",
            Self::Ampere => "A",
            Self::Volt => "V",
        }
    }

    /// How the unit ends a self-describing column name: `gyro_z_rad_s`.
    pub const fn column_suffix(self) -> &'static str {
        match self {
            Self::Second => "s",
            Self::Metre => "m",
            Self::MetrePerSecond => "m_s",
            Self::MetrePerSecondSquared => "m_s2",
            Self::Radian => "rad",
            Self::RadianPerSecond => "rad_s",
            Self::NewtonMetre => "Nm",
            Self::Ampere => "A",
            Self::Volt => "V",
        }
    }

    /// The quantity that the unit measures: `an angular speed`.
    pub const fn quantity(self) -> &'static str {
        match self {
            Self::Second => "a time",
            Self::Metre => "a length",
            Self::MetrePerSecond => "a speed",
            Self::MetrePerSecondSquared => "an acceleration",
            Self::Radian => "an angle",
            Self::RadianPerSecond => "an angular speed",
            Self::NewtonMetre => "a torque",
            Self::Ampere => "a current",
            Self::Volt => "a voltage",
        }
    }

    /// What one multiplies a number in this unit with to get one in `signal`'s unit, in words, when a mapping may do
    /// so by an explicit `scale`: current to torque, tyre speed to wheel speed, tyre way to wheel angle.
    pub(crate) const fn bridge_to(self, signal: Unit) -> Option<&'static str> {
        match (self, signal) {
            (Self::Ampere, Self::NewtonMetre) => Some("N m per A at the wheels"),
            (Self::MetrePerSecond, Self::RadianPerSecond) | (Self::Metre, Self::Radian) => {
                Some("1 / wheel radius in m")
            }
            _ => None,
        }
    }
}

impl std::fmt::Display for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.symbol())
    }
}

/// What a unit name means: `number in SI = factor * number as written`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// SI unit of the quantity.
    pub unit: Unit,
    /// SI units in one of the named unit.
    pub factor: f64,
}

/// One turn in radians.
const TURN: f64 = std::f64::consts::TAU;
/// One degree in radians.
const DEGREE: f64 = TURN / 360.0;
/// Standard acceleration of free fall, m/s^2 (exact by definition, CGPM 1901).
const STANDARD_GRAVITY: f64 = 9.806_65;

/// Every unit name that is understood, spelt without blanks, dots and carets.
const NAMES: &[(&str, Unit, f64)] = &[
    ("s", Unit::Second, 1.0),
    ("ms", Unit::Second, 1e-3),
    ("us", Unit::Second, 1e-6),
    ("µs", Unit::Second, 1e-6),
    ("ns", Unit::Second, 1e-9),
    ("min", Unit::Second, 60.0),
    ("h", Unit::Second, 3600.0),
    ("m", Unit::Metre, 1.0),
    ("cm", Unit::Metre, 1e-2),
    ("mm", Unit::Metre, 1e-3),
    ("km", Unit::Metre, 1e3),
    ("m/s", Unit::MetrePerSecond, 1.0),
    ("cm/s", Unit::MetrePerSecond, 1e-2),
    ("mm/s", Unit::MetrePerSecond, 1e-3),
    ("km/h", Unit::MetrePerSecond, 1.0 / 3.6),
    ("m/s2", Unit::MetrePerSecondSquared, 1.0),
    ("mm/s2", Unit::MetrePerSecondSquared, 1e-3),
    ("g", Unit::MetrePerSecondSquared, STANDARD_GRAVITY),
    ("mg", Unit::MetrePerSecondSquared, STANDARD_GRAVITY * 1e-3),
    ("rad", Unit::Radian, 1.0),
    ("mrad", Unit::Radian, 1e-3),
    ("deg", Unit::Radian, DEGREE),
    ("°", Unit::Radian, DEGREE),
    ("rev", Unit::Radian, TURN),
    ("rad/s", Unit::RadianPerSecond, 1.0),
    ("mrad/s", Unit::RadianPerSecond, 1e-3),
    ("deg/s", Unit::RadianPerSecond, DEGREE),
    ("°/s", Unit::RadianPerSecond, DEGREE),
    ("rpm", Unit::RadianPerSecond, TURN / 60.0),
    ("rev/s", Unit::RadianPerSecond, TURN),
    ("Nm", Unit::NewtonMetre, 1.0),
    ("mNm", Unit::NewtonMetre, 1e-3),
    ("kNm", Unit::NewtonMetre, 1e3),
    ("A", Unit::Ampere, 1.0),
    ("mA", Unit::Ampere, 1e-3),
    ("V", Unit::Volt, 1.0),
    ("mV", Unit::Volt, 1e-3),
];

/// The unit with this name; blanks, `*`, `.`, `·` and `^` do not matter, capitals do (`mA` is not `MA`).
///
/// ```
/// use recordings::{Unit, parse_unit};
/// let rpm = parse_unit("rpm").unwrap();
/// assert_eq!(rpm.unit, Unit::RadianPerSecond);
/// assert!((60.0 * rpm.factor - std::f64::consts::TAU).abs() < 1e-15);
/// assert_eq!(parse_unit("N m"), parse_unit("N*m"));
/// assert_eq!(parse_unit("furlong"), None);
/// ```
pub fn parse_unit(name: &str) -> Option<Scale> {
    let plain = plain(name);
    let found = NAMES.iter().find(|(known, ..)| *known == plain);
    found.map(|&(_, unit, factor)| Scale { unit, factor })
}

/// What to write instead of an unknown unit name.
pub(crate) fn unit_hint(name: &str) -> String {
    let known: Vec<&str> = NAMES.iter().map(|&(known, ..)| known).collect();
    bags::suggest::hint(&plain(name), &known)
}

/// The name without what people write differently.
fn plain(name: &str) -> String {
    let kept = name.chars().filter(|c| !c.is_whitespace() && !"*.·^".contains(*c));
    // U+03BC (Greek mu) and U+00B5 (micro sign) look the same.
    kept.map(|c| match c {
        '²' => '2',
        'μ' => 'µ',
        other => other,
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_convert_to_si() {
        let cases = [
            ("rad/s", Unit::RadianPerSecond, 1.0),
            ("deg/s", Unit::RadianPerSecond, std::f64::consts::PI / 180.0),
            ("rpm", Unit::RadianPerSecond, std::f64::consts::PI / 30.0),
            ("km/h", Unit::MetrePerSecond, 1.0 / 3.6),
            ("mA", Unit::Ampere, 0.001),
            ("N m", Unit::NewtonMetre, 1.0),
            ("N·m", Unit::NewtonMetre, 1.0),
            ("Nm", Unit::NewtonMetre, 1.0),
            ("g", Unit::MetrePerSecondSquared, 9.80665),
            ("m/s^2", Unit::MetrePerSecondSquared, 1.0),
            ("m/s²", Unit::MetrePerSecondSquared, 1.0),
            ("mm", Unit::Metre, 0.001),
            ("μs", Unit::Second, 1e-6),
            ("V", Unit::Volt, 1.0),
        ];
        for (name, unit, factor) in cases {
            let scale = parse_unit(name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!(scale.unit, unit, "{name}");
            assert!((scale.factor / factor - 1.0).abs() < 1e-15, "{name}");
        }
    }

    #[test]
    fn capitals_matter_and_unknown_names_get_a_hint() {
        assert_eq!(parse_unit("MA"), None);
        assert_eq!(unit_hint("rads/s"), "did you mean `rad/s`?");
        assert!(unit_hint("furlong").starts_with("known are: s, ms"));
    }

    #[test]
    fn every_symbol_and_name_is_unique_and_reads_back() {
        for (index, &(name, unit, factor)) in NAMES.iter().enumerate() {
            assert!(NAMES[..index].iter().all(|(other, ..)| *other != name), "{name}");
            assert!(factor.is_finite() && factor > 0.0);
            assert_eq!(parse_unit(unit.symbol()), Some(Scale { unit, factor: 1.0 }));
        }
    }
}
