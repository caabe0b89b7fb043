//! Tyre laws: share of the available friction over normalised combined slip.

use serde::{Deserialize, Serialize};

/// Which law the tyres of the true robot follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TyreLaw {
    /// Brush model with parabolic pressure (Pacejka, *Tyre and Vehicle Dynamics*, ch. 3).
    Brush,
    /// Magic formula with similarity of combined slip (the same book, ch. 4).
    Pacejka,
}

impl TyreLaw {
    /// Its name, which is the generator's name in the truth.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brush => "brush",
            Self::Pacejka => "pacejka",
        }
    }

    /// Share of peak friction at slip `rho` (1 at the peak); `drop` is lost when sliding fast.
    fn share(self, rho: f64, drop: f64) -> f64 {
        match self {
            Self::Brush => {
                if rho < 1.0 {
                    rho * (3.0 - rho * (3.0 - rho))
                } else {
                    1.0 - drop * (rho - 1.0) / (rho + 2.0)
                }
            }
            Self::Pacejka => {
                // C from the sliding level, E zero, B puts the peak at rho = 1.
                let shape = 2.0 - 2.0 / std::f64::consts::PI * (1.0 - drop).asin();
                let stiffness = (std::f64::consts::FRAC_PI_2 / shape).tan();
                (shape * (stiffness * rho).atan()).sin()
            }
        }
    }
}

const CELLS: usize = 1024;
/// Slip at the middle of the table.
const MIDDLE: f64 = 1.0;

/// A law tabulated as share over slip, against slip / (slip + 1).
#[derive(Debug, Clone)]
pub(crate) struct TyreTable {
    gain: Vec<f64>,
}

impl TyreTable {
    /// Tabulates a law.
    pub(crate) fn new(law: TyreLaw, drop: f64) -> Self {
        let gain = (0..CELLS + 2)
            .map(|i| {
                let t = (i as f64 / CELLS as f64).clamp(1e-6, 0.999_999);
                let rho = MIDDLE * t / (1.0 - t);
                // Over slip and times (slip + middle) the share is finite at both ends.
                law.share(rho, drop) / rho * (rho + MIDDLE)
            })
            .collect();
        Self { gain }
    }

    /// Share of friction divided by slip.
    #[inline]
    pub(crate) fn gain(&self, rho: f64) -> f64 {
        let per = 1.0 / (rho + MIDDLE);
        let place = rho * per * CELLS as f64;
        let cell = (place as usize).min(CELLS - 1);
        let part = place - cell as f64;
        (self.gain[cell] * (1.0 - part) + self.gain[cell + 1] * part) * per
    }
}

#[cfg(test)]
mod tests {
    use super::{TyreLaw, TyreTable};

    #[test]
    fn both_laws_start_linear_peak_at_one_and_slide_below() {
        for law in [TyreLaw::Brush, TyreLaw::Pacejka] {
            let table = TyreTable::new(law, 0.08);
            let share = |rho: f64| table.gain(rho) * rho;
            assert!((share(1.0) - 1.0).abs() < 1e-3, "{law:?}");
            assert!((share(0.02) / share(0.01) - 2.0).abs() < 0.05);
            assert!((share(200.0) - 0.92).abs() < 0.01, "{}", share(200.0));
            for i in 1..500 {
                let rho = f64::from(i) * 0.02;
                assert!((share(rho) - law.share(rho, 0.08)).abs() < 1e-4);
            }
        }
    }
}
