//! A drive for tests, of which everything is known.

use crate::observed::{Kind, Observed, Row};

/// What a scale `e^θ` shows of numbers beside what was shown of them.
#[derive(Clone)]
pub(crate) struct Scaled {
    shown: Vec<f64>,
    rows: Vec<Row>,
}

#[cfg(test)]
impl Scaled {
    pub(crate) fn by(scale: f64) -> Self {
        let row = |k: usize| Row { kind: Kind::Encoder, time: k as f64, is_moving: true, weight: 1.0 };
        Self { shown: (1..=20).map(|k| scale * f64::from(k) / 10.0).collect(), rows: (0..20).map(row).collect() }
    }
}

#[cfg(test)]
impl Observed for Scaled {
    type Model = ();
    const FLOOR: [f64; 3] = [1e-3; 3];
    const NEAR: f64 = 0.04;
    const HARDLY: f64 = 0.7;

    fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn errors(&self, (): &(), theta: &[f64]) -> Vec<f64> {
        self.shown.iter().zip(1..).map(|(shown, k)| theta[0].exp() * f64::from(k) / 10.0 - shown).collect()
    }

    fn columns(&self, (): &(), theta: &[f64]) -> Vec<Vec<f64>> {
        vec![(1..=20).map(|k| theta[0].exp() * f64::from(k) / 10.0).collect()]
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
