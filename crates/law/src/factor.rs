//! Factors: how a variable enters a term.

use scalar::{Scalar, real};

use crate::error::LawError;
use crate::motion::Motion;
use crate::settings::SETTINGS;
use crate::unit::Unit;
use crate::variable::{Of, Variable, held};

/// Shape numbers of a factor, at most.
pub(crate) const MOST_SHAPES: usize = 3;

/// How a variable enters a term. Shape numbers are in the variable's unit unless said otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Factor {
    /// `sgn(x) |x|^p`, p = 1, 2, 3.
    Power(Variable, u8),
    /// `|x|^p`, p = 1, 2, 3.
    EvenPower(Variable, u8),
    /// `tanh(x/x₀)`: dry friction; x₀ is fixed.
    Sign(Variable, f64),
    /// `sgn(x) max(|x| − a, 0)`.
    Excess(Variable, f64),
    /// `min(max(x, −a), a)`.
    Clip(Variable, f64),
    /// `exp(−(x/a)²)`.
    Bump(Variable, f64),
    /// 1 where |x| > a, else 0, with a smooth edge.
    Above(Variable, f64),
    /// `cos(n x + φ)` of an angle; φ in rad.
    Turn(Variable, u8, f64),
    /// `cos(w t + φ)`; w in rad/s, φ in rad.
    Oscillation(f64, f64),
    /// `1 − exp(−t/τ)`; τ in s.
    Rise(f64),
    /// Hidden state `τ ẏ = x − y`; τ in s.
    Lag(Variable, f64),
    /// Hidden state `τ ẏ = |x|^q − y`; τ in s.
    Heat(Variable, u8, f64),
    /// 1 in a disc on the ground, 0 outside: x, y, radius in m.
    Disc(f64, f64, f64),
}

/// A shape number that a fit may change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Its value.
    pub value: f64,
    /// Size of a usual change.
    pub unit: f64,
    /// Least and largest value.
    pub bounds: [f64; 2],
}

impl Factor {
    /// Its name in formulas, its variable, its numbers.
    pub(crate) fn parts(self) -> (&'static str, Option<Variable>, Vec<f64>) {
        let whole = f64::from;
        match self {
            Self::Power(v, p) => ("pow", Some(v), vec![whole(p)]),
            Self::EvenPower(v, p) => ("abs", Some(v), vec![whole(p)]),
            Self::Sign(v, x) => ("sgn", Some(v), vec![x]),
            Self::Excess(v, a) => ("excess", Some(v), vec![a]),
            Self::Clip(v, a) => ("clip", Some(v), vec![a]),
            Self::Bump(v, a) => ("bump", Some(v), vec![a]),
            Self::Above(v, a) => ("above", Some(v), vec![a]),
            Self::Turn(v, n, phase) => ("cos", Some(v), vec![whole(n), phase]),
            Self::Oscillation(w, phase) => ("wave", Some(Variable::Time), vec![w, phase]),
            Self::Rise(tau) => ("rise", Some(Variable::Time), vec![tau]),
            Self::Lag(v, tau) => ("lag", Some(v), vec![tau]),
            Self::Heat(v, q, tau) => ("heat", Some(v), vec![whole(q), tau]),
            Self::Disc(x, y, radius) => ("disc", None, vec![x, y, radius]),
        }
    }

    /// Names of all kinds, for messages.
    pub(crate) const KINDS: &'static str = "pow, abs, sgn, excess, clip, bump, above, cos, wave, rise, lag, heat, disc";

    /// The factor of this name, variable and numbers; `None` where they do not belong together.
    pub(crate) fn of_parts(name: &str, v: Option<Variable>, numbers: &[f64]) -> Option<Self> {
        let whole = |x: f64| ((1.0..=9.0).contains(&x) && x.fract() == 0.0).then_some(x as u8);
        let factor = match (name, v, numbers) {
            ("pow", Some(v), &[p]) => Self::Power(v, whole(p)?),
            ("abs", Some(v), &[p]) => Self::EvenPower(v, whole(p)?),
            ("sgn", Some(v), &[x]) => Self::Sign(v, x),
            ("excess", Some(v), &[a]) => Self::Excess(v, a),
            ("clip", Some(v), &[a]) => Self::Clip(v, a),
            ("bump", Some(v), &[a]) => Self::Bump(v, a),
            ("above", Some(v), &[a]) => Self::Above(v, a),
            ("cos", Some(v), &[n, phase]) => Self::Turn(v, whole(n)?, phase),
            ("wave", Some(Variable::Time), &[w, phase]) => Self::Oscillation(w, phase),
            ("rise", Some(Variable::Time), &[tau]) => Self::Rise(tau),
            ("lag", Some(v), &[tau]) => Self::Lag(v, tau),
            ("heat", Some(v), &[q, tau]) => Self::Heat(v, whole(q)?, tau),
            ("disc", None, &[x, y, radius]) => Self::Disc(x, y, radius),
            _ => return None,
        };
        Some(factor)
    }

    /// Whether every number is finite and the variable may enter.
    pub(crate) fn checked(self) -> Result<Self, LawError> {
        let (name, variable, numbers) = self.parts();
        if numbers.iter().any(|x| !x.is_finite()) {
            return Err(LawError::NotFinite(name.to_owned()));
        }
        let fits = match self {
            Self::Turn(v, ..) => v.is_angle(),
            Self::Above(v, _) => !v.is_angle(),
            Self::Power(v, p) | Self::EvenPower(v, p) => v.is_amount() && (1..=3).contains(&p),
            Self::Heat(v, q, _) => v.is_amount() && (1..=3).contains(&q),
            Self::Sign(v, _) | Self::Excess(v, _) | Self::Clip(v, _) | Self::Bump(v, _) | Self::Lag(v, _) => {
                v.is_amount()
            }
            Self::Oscillation(..) | Self::Rise(_) | Self::Disc(..) => true,
        };
        let wrong = || LawError::Variable {
            factor: name.to_owned(),
            variable: variable.map_or("position", Variable::symbol).to_owned(),
        };
        if fits { Ok(self) } else { Err(wrong()) }
    }

    /// The variable; `None` of a place on the ground.
    pub fn variable(self) -> Option<Variable> {
        self.parts().1
    }

    /// Whether it is of the same kind of the same variable, whatever its numbers.
    pub fn is_alike(self, other: Self) -> bool {
        let ((a, v, _), (b, w, _)) = (self.parts(), other.parts());
        (a, v) == (b, w)
    }

    /// Its unit.
    pub fn unit(self) -> Unit {
        match self {
            Self::Power(v, p) | Self::EvenPower(v, p) | Self::Heat(v, p, _) => v.unit().power(p),
            Self::Excess(v, _) | Self::Clip(v, _) | Self::Lag(v, _) => v.unit(),
            _ => Unit::ONE,
        }
    }

    /// Whether it remembers what was before.
    pub fn is_state(self) -> bool {
        matches!(self, Self::Lag(..) | Self::Heat(..))
    }

    /// What its hidden state follows, and its time constant, s.
    pub(crate) fn followed(self, m: &Motion<f64>, of: Of) -> Option<(f64, f64)> {
        match self {
            Self::Lag(v, tau) => Some((v.value(m, of), tau)),
            Self::Heat(v, q, tau) => Some((v.value(m, of).abs().powi(i32::from(q)), tau)),
            _ => None,
        }
    }

    /// Shape numbers that a fit may change, in the order of [`Factor::with`].
    pub fn shapes(self) -> Vec<Shape> {
        let s = SETTINGS.shapes;
        let amount = |value: f64| {
            let size = value.abs().max(s.least);
            Shape { value, unit: s.unit * size, bounds: [s.least, s.most] }
        };
        let phase = |value: f64| Shape { value, unit: s.phase, bounds: [-s.most, s.most] };
        match self {
            Self::Excess(_, a) | Self::Clip(_, a) | Self::Bump(_, a) | Self::Above(_, a) | Self::Rise(a) => {
                vec![amount(a)]
            }
            Self::Turn(_, _, p) => vec![phase(p)],
            Self::Oscillation(w, p) => vec![Shape { unit: s.frequency, ..amount(w) }, phase(p)],
            Self::Lag(_, tau) | Self::Heat(_, _, tau) => vec![amount(tau)],
            Self::Disc(x, y, radius) => {
                let anywhere = |value| Shape { value, unit: s.place, bounds: [-s.most, s.most] };
                vec![anywhere(x), anywhere(y), Shape { unit: s.place, ..amount(radius) }]
            }
            _ => Vec::new(),
        }
    }

    /// Units of the shape numbers, in the order of [`Factor::shapes`].
    pub fn shape_units(self) -> Vec<Unit> {
        match self {
            Self::Excess(v, _) | Self::Clip(v, _) | Self::Bump(v, _) | Self::Above(v, _) => vec![v.unit()],
            Self::Rise(_) | Self::Lag(..) | Self::Heat(..) => vec![Unit::SECOND],
            Self::Turn(..) => vec![Unit::RADIAN],
            Self::Oscillation(..) => vec![Unit::RATE, Unit::RADIAN],
            Self::Disc(..) => vec![Unit::METRE; 3],
            Self::Power(..) | Self::EvenPower(..) | Self::Sign(..) => Vec::new(),
        }
    }

    /// Symbols of the shape numbers, in the order of [`Factor::shapes`].
    pub(crate) fn shape_symbols(self) -> &'static [&'static str] {
        match self {
            Self::Excess(..) | Self::Clip(..) | Self::Bump(..) | Self::Above(..) => &["a"],
            Self::Rise(_) | Self::Lag(..) | Self::Heat(..) => &["tau"],
            Self::Turn(..) => &["phase"],
            Self::Oscillation(..) => &["w", "phase"],
            Self::Disc(..) => &["x", "y", "radius"],
            Self::Power(..) | Self::EvenPower(..) | Self::Sign(..) => &[],
        }
    }

    /// The same with other shape numbers, those of [`Factor::shapes`].
    #[must_use]
    pub fn with(self, shapes: &[f64]) -> Self {
        match (self, shapes) {
            (Self::Excess(v, _), &[a]) => Self::Excess(v, a),
            (Self::Clip(v, _), &[a]) => Self::Clip(v, a),
            (Self::Bump(v, _), &[a]) => Self::Bump(v, a),
            (Self::Above(v, _), &[a]) => Self::Above(v, a),
            (Self::Rise(_), &[a]) => Self::Rise(a),
            (Self::Turn(v, n, _), &[p]) => Self::Turn(v, n, p),
            (Self::Oscillation(..), &[w, p]) => Self::Oscillation(w, p),
            (Self::Lag(v, _), &[tau]) => Self::Lag(v, tau),
            (Self::Heat(v, q, _), &[tau]) => Self::Heat(v, q, tau),
            (Self::Disc(..), &[x, y, radius]) => Self::Disc(x, y, radius),
            _ => self,
        }
    }

    /// Its shape numbers, in the order of [`Factor::shapes`], and how many there are: without an allocation.
    #[inline(always)]
    pub(crate) fn shape_values(self) -> ([f64; MOST_SHAPES], usize) {
        match self {
            Self::Excess(_, a) | Self::Clip(_, a) | Self::Bump(_, a) | Self::Above(_, a) | Self::Rise(a) => {
                ([a, 0.0, 0.0], 1)
            }
            Self::Turn(_, _, phase) => ([phase, 0.0, 0.0], 1),
            Self::Oscillation(w, phase) => ([w, phase, 0.0], 2),
            Self::Lag(_, tau) | Self::Heat(_, _, tau) => ([tau, 0.0, 0.0], 1),
            Self::Disc(x, y, radius) => ([x, y, radius], 3),
            Self::Power(..) | Self::EvenPower(..) | Self::Sign(..) => ([0.0; MOST_SHAPES], 0),
        }
    }

    /// Its value at an instant, with variables limited by `limit`, shape numbers `shapes` instead of its own (in the
    /// order of [`Factor::shapes`]) and its hidden state `memory`.
    #[inline(always)]
    pub(crate) fn value<T: Scalar>(
        self,
        m: &Motion<T>,
        of: Of,
        limit: &impl Fn(Variable, T) -> T,
        shapes: [T; MOST_SHAPES],
        memory: T,
    ) -> T {
        let s = SETTINGS.shapes;
        let (zero, one) = (T::zero(), T::one());
        let x = |v: Variable| limit(v, v.value(m, of));
        // A shape that is a size: positive, whatever was written.
        let size = |a: T| a.abs().max(real(s.least));
        let [first, second, third] = shapes;
        let power = |x: T, p: u8| (1..p).fold(x, |y, _| y * x);
        match self {
            Self::Power(v, p) => {
                let x = x(v);
                if p % 2 == 1 { power(x, p) } else { x * x.abs() }
            }
            Self::EvenPower(v, p) => power(x(v).abs(), p),
            Self::Sign(v, x0) => (x(v) / size(real(x0))).tanh(),
            Self::Excess(v, _) => {
                let (x, a) = (x(v), size(first));
                (x - a).max(zero) + (x + a).min(zero)
            }
            Self::Clip(v, _) => x(v).max(-size(first)).min(size(first)),
            Self::Bump(v, _) => {
                let y = x(v) / size(first);
                (-(y * y).min(real(s.deepest))).exp()
            }
            Self::Above(v, _) => {
                let over = (x(v).abs() - size(first)) / (size(first) * real(s.edge));
                (one + over.tanh()) * real(0.5)
            }
            Self::Turn(v, n, _) => {
                let (cos, sin) = if v == Variable::Heading {
                    let [c, s] = m.heading;
                    (1..n).fold((c, s), |(a, b), _| (a * c - b * s, a * s + b * c))
                } else {
                    let (sin, cos) = (x(v) * real(f64::from(n))).sin_cos();
                    (cos, sin)
                };
                let (sin_of_phase, cos_of_phase) = first.sin_cos();
                cos * cos_of_phase - sin * sin_of_phase
            }
            Self::Oscillation(..) => (held(m.time) * first + second).sin_cos().1,
            Self::Rise(_) => one - (-(held(m.time).max(zero) / size(first)).min(real(s.deepest))).exp(),
            Self::Lag(..) | Self::Heat(..) => held(memory),
            Self::Disc(..) => {
                let (dx, dy) = (held(m.position[0]) - first, held(m.position[1]) - second);
                let inside = third - (dx * dx + dy * dy).sqrt();
                (one + (inside / real(s.border)).tanh()) * real(0.5)
            }
        }
    }
}
