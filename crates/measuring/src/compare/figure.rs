//! The figure that a program prints: `plant.scalar 158.2 ns/step ...`.

use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};

/// A measured number with its unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Figure {
    pub(super) value: f64,
    pub(super) unit: String,
}

/// Where a figure stands in what a program prints.
#[derive(Debug, Clone, Copy)]
pub(super) enum Place {
    /// In the last line whose first word has a dot, as `plant.scalar 158.2 ns/step`.
    First,
    /// Behind this word.
    Behind(&'static str),
}

impl Figure {
    /// Reads the figure.
    pub(super) fn read(printed: &str, place: Place) -> Result<Self> {
        let found = match place {
            Place::First => {
                let named = |line: &&str| line.split_whitespace().next().is_some_and(|word| word.contains('.'));
                printed.lines().rev().find(named).and_then(|line| number_in(line.split_whitespace().skip(1)))
            }
            Place::Behind(word) => number_in(printed.split_whitespace().skip_while(|w| *w != word).skip(1)),
        };
        let (value, unit) = found.with_context(|| format!("no figure in what it printed: '{}'", printed.trim()))?;
        Ok(Self { value, unit: unit.to_owned() })
    }

    /// The value in the unit that this one stands for: times in seconds, everything else as it is.
    pub(super) fn in_si(&self) -> f64 {
        let prefix = self.unit.split(['/', ' ']).next().unwrap_or_default();
        let factor = match prefix {
            "ns" => 1e-9,
            "us" | "µs" => 1e-6,
            "ms" => 1e-3,
            _ => 1.0,
        };
        self.value * factor
    }
}

/// The first word as a finite number, and the next one as its unit.
fn number_in<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<(f64, &'a str)> {
    let value = words.next()?.parse().ok().filter(|x: &f64| x.is_finite())?;
    Some((value, words.next().unwrap_or("").trim_end_matches([',', ';'])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(value: f64, unit: &str) -> Figure {
        Figure { value, unit: unit.into() }
    }

    #[test]
    fn the_first_figure_of_a_named_line_is_read() {
        let read = |text| Figure::read(text, Place::First).ok();
        assert_eq!(read("plant.scalar 158.20 ns/step \n"), Some(figure(158.2, "ns/step")));
        assert_eq!(read("warming up\nfit.lanes 209.0 ms   6 Jacobians, cost/n 1.0\n"), Some(figure(209.0, "ms")));
        assert_eq!(read("peak.fma4 72.0 Gflop/s"), Some(figure(72.0, "Gflop/s")));
        // The last one counts where there are several: earlier ones may be warnings with a dot.
        assert_eq!(read("a.b 1 ms\nc.d 2 ms\n"), Some(figure(2.0, "ms")));
        assert_eq!(read("no figure here"), None);
        assert_eq!(read("plant.scalar nan ns"), None);
        assert_eq!(read("plant.scalar fast ns"), None);
        assert_eq!(read(""), None);
    }

    #[test]
    fn a_figure_behind_a_word_is_read() {
        let text = "stiff v0 0.020: RK4x1 159 ns err 8.5e-05; ROS2x1 189 ns err 8.1e-06; ROS2x2 378 ns err 2.8e-06;";
        assert_eq!(Figure::read(text, Place::Behind("ROS2x1")).ok(), Some(figure(189.0, "ns")));
        assert!(Figure::read(text, Place::Behind("ROS2x4")).is_err());
    }

    #[test]
    fn times_of_different_units_can_be_compared() {
        assert_eq!(figure(2.0, "us/step").in_si(), 2e-6);
        assert_eq!(figure(7.0, "ms").in_si(), 7e-3);
        assert_eq!(figure(41.0, "GB/s").in_si(), 41.0);
    }
}
