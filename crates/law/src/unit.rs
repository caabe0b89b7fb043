//! Units as exponents of m, kg, s and rad.

use std::fmt;
use std::ops::{Div, Mul};

/// A unit: exponents of the metre, kilogram, second and radian.
///
/// Made of other units by products, quotients and powers only; there is no way to write one down
/// for a constant, so that a term's constant has exactly the unit that closes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Unit {
    m: i8,
    kg: i8,
    s: i8,
    rad: i8,
}

impl Unit {
    /// The unit of a plain number.
    pub const ONE: Self = Self { m: 0, kg: 0, s: 0, rad: 0 };
    pub(crate) const METRE: Self = Self { m: 1, ..Self::ONE };
    pub(crate) const SECOND: Self = Self { s: 1, ..Self::ONE };
    pub(crate) const RADIAN: Self = Self { rad: 1, ..Self::ONE };
    pub(crate) const SPEED: Self = Self { m: 1, s: -1, ..Self::ONE };
    pub(crate) const RATE: Self = Self { rad: 1, s: -1, ..Self::ONE };
    pub(crate) const FORCE: Self = Self { m: 1, kg: 1, s: -2, rad: 0 };
    pub(crate) const TORQUE: Self = Self { m: 2, kg: 1, s: -2, rad: 0 };
    /// Of a torque times an angular rate, radians left standing.
    pub(crate) const POWER: Self = Self { m: 2, kg: 1, s: -3, rad: 1 };

    /// Its exponents of m, kg, s and rad.
    pub fn exponents(self) -> [i8; 4] {
        [self.m, self.kg, self.s, self.rad]
    }

    /// The unit of a quantity's power.
    #[must_use]
    pub fn power(self, n: u8) -> Self {
        (0..n).fold(Self::ONE, |of, _| of * self)
    }
}

impl Mul for Unit {
    type Output = Self;

    fn mul(self, o: Self) -> Self {
        let add = i8::saturating_add;
        Self { m: add(self.m, o.m), kg: add(self.kg, o.kg), s: add(self.s, o.s), rad: add(self.rad, o.rad) }
    }
}

impl Div for Unit {
    type Output = Self;

    fn div(self, o: Self) -> Self {
        let sub = i8::saturating_sub;
        Self { m: sub(self.m, o.m), kg: sub(self.kg, o.kg), s: sub(self.s, o.s), rad: sub(self.rad, o.rad) }
    }
}

impl fmt::Display for Unit {
    /// As people write it: `N m s/rad`, `rad`, `1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A newton for each kilogram.
        let n = self.kg;
        let rest = Self { m: self.m.saturating_sub(n), kg: 0, s: self.s.saturating_add(n.saturating_mul(2)), ..*self };
        let all = [("N", n), ("m", rest.m), ("s", rest.s), ("rad", rest.rad)];
        let part = |sign: i8| -> Vec<String> {
            let of = all.iter().filter(|(_, e)| e.signum() == sign);
            of.map(|(name, e)| if e.abs() == 1 { (*name).to_owned() } else { format!("{name}^{}", e.abs()) }).collect()
        };
        let (above, below) = (part(1), part(-1));
        let above = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
        match below.len() {
            0 => f.write_str(&above),
            1 => write!(f, "{above}/{}", below[0]),
            _ => write!(f, "{above}/({})", below.join(" ")),
        }
    }
}

/// The unit of a text: factors in any order, `N`, `kg`, `m`, `s`, `rad` or `1`, each with a power, as `m N`,
/// `N s^2/m^2` or `1/(N m)`; `None` where it is no unit.
pub(crate) fn read(text: &str) -> Option<Unit> {
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    let below = below.trim();
    let below = below.strip_prefix('(').and_then(|b| b.strip_suffix(')')).unwrap_or(below);
    Some(product(above)? / product(below)?)
}

/// A product of named units.
fn product(text: &str) -> Option<Unit> {
    let mut out = None;
    for factor in text.split_whitespace() {
        let (name, power) = factor.split_once('^').unwrap_or((factor, "1"));
        let of = match name {
            "1" => Unit::ONE,
            "m" => Unit::METRE,
            "kg" => Unit { kg: 1, ..Unit::ONE },
            "s" => Unit::SECOND,
            "rad" => Unit::RADIAN,
            "N" => Unit::FORCE,
            _ => return None,
        };
        let power: u8 = power.parse().ok().filter(|p| (1..=9).contains(p))?;
        out = Some(out.unwrap_or(Unit::ONE) * of.power(power));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_reads_back_in_any_order_of_its_factors() {
        for unit in
            [Unit::TORQUE, Unit::TORQUE / Unit::RATE, Unit::FORCE / Unit::SPEED.power(2), Unit::ONE / Unit::TORQUE]
        {
            assert_eq!(read(&unit.to_string()), Some(unit), "{unit}");
        }
        assert_eq!(read("m N"), Some(Unit::TORQUE));
        assert_eq!(read("kg m^2/s^2"), Some(Unit::TORQUE));
        for wrong in ["", "Nm", "N/", "m^", "m^-1", "N m)", "m/s/s"] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn units_are_written_as_people_write_them() {
        assert_eq!(Unit::TORQUE.to_string(), "N m");
        assert_eq!((Unit::TORQUE / Unit::RATE).to_string(), "N m s/rad");
        assert_eq!((Unit::FORCE / Unit::SPEED.power(2)).to_string(), "N s^2/m^2");
        assert_eq!((Unit::ONE / Unit::TORQUE).to_string(), "1/(N m)");
        assert_eq!(Unit::ONE.to_string(), "1");
    }
}
