//! A drive for tests, of which everything is known.

use crate::observed::{Kind, Observed, Row};

/// What a scale `e^θ` shows of numbers beside what was shown of them.
#[derive(Clone)]
pub(crate) struct Scaled {
    plain: Vec<f64>,
    /// By how much more, in its exponent, a second constant scales a number that is larger by one; `None` where it scales nothing.
    second: Option<f64>,
    shown: Vec<f64>,
    rows: Vec<Row>,
}

#[cfg(test)]
impl Scaled {
    pub(crate) fn by(scale: f64) -> Self {
        Self::of(20, 1.0, |_| scale)
    }

    /// Twenty seconds with another scale from some instant on.
    pub(crate) fn changing([before, after]: [f64; 2], from: f64) -> Self {
        Self::of(1000, 0.02, |time| if time < from { before } else { after })
    }

    /// The same as rows show it that are off by this share, one up, one down, in no order of theirs.
    pub(crate) fn roughly(mut self, off: f64) -> Self {
        for (k, shown) in self.shown.iter_mut().enumerate() {
            *shown *= if (k * k + k / 7) % 5 < 2 { 1.0 + off } else { 1.0 - off };
        }
        self
    }

    /// The same where a second constant scales as well, and by so much more for a number that is larger by one.
    pub(crate) fn with_second(self, uneven: f64) -> Self {
        Self { second: Some(uneven), ..self }
    }

    /// Factor on a number.
    fn factor(&self, plain: f64, theta: &[f64]) -> f64 {
        (theta[0] + self.second.map_or(0.0, |uneven| theta[1] * (1.0 + uneven * plain))).exp()
    }

    fn of(rows: usize, step: f64, scale: impl Fn(f64) -> f64) -> Self {
        let plain: Vec<f64> = (0..rows).map(|k| (k % 20 + 1) as f64 / 10.0).collect();
        let time = |k: usize| step * k as f64;
        let row = |k: usize| Row { kind: Kind::Encoder, time: time(k), is_moving: true, weight: 1.0 };
        let shown = plain.iter().enumerate().map(|(k, plain)| scale(time(k)) * plain).collect();
        Self { plain, second: None, shown, rows: (0..rows).map(row).collect() }
    }
}

#[cfg(test)]
impl Observed for Scaled {
    type Model = ();
    const WINDOW: f64 = 1.0;
    const FLOOR: [f64; 3] = [1e-3; 3];
    const NEAR: f64 = 0.04;
    const HARDLY: f64 = 0.7;
    const ANEW: bool = true;

    fn name(&self) -> &'static str {
        "scaled"
    }

    fn seconds(&self) -> f64 {
        self.rows.iter().map(|row| row.time).fold(0.0, f64::max)
    }

    fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn errors(&self, (): &(), theta: &[f64]) -> Vec<f64> {
        self.shown.iter().zip(&self.plain).map(|(shown, plain)| self.factor(*plain, theta) * plain - shown).collect()
    }

    fn columns(&self, (): &(), theta: &[f64]) -> Vec<Vec<f64>> {
        let first = || self.plain.iter().map(|plain| self.factor(*plain, theta) * plain);
        let second =
            self.second.map(|uneven| first().zip(&self.plain).map(|(f, plain)| f * (1.0 + uneven * plain)).collect());
        std::iter::once(first().collect()).chain(second).collect()
    }

    fn sizes(&self) -> Vec<f64> {
        self.shown.clone()
    }

    fn judged_by(&self) -> Kind {
        Kind::Encoder
    }

    fn apart(&self, _: Kind) -> usize {
        1
    }
}
