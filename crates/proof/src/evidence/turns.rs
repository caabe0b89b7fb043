//! Turning inferred from the currents, beside what the gyro says.

use serde_json::{Value, json};

use super::ask::{Answer, interval};
use super::witness::Witness;

/// Yaw rates above which a sample turns and below which it is straight, rad/s.
const TURNING: f64 = 0.05;
const STRAIGHT: f64 = 0.015;
/// Mean of the set speeds below which a turn is a spin, whose way unsigned currents cannot tell, m/s.
const SPIN: f64 = 0.03;

/// Samples by what the gyro says, and what the program said of them.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Turns {
    /// Samples of arcs: all, right side, wrong side.
    pub(super) arcs: [usize; 3],
    /// Samples of spins: all, told as turning.
    pub(super) spins: [usize; 2],
    /// Samples of straight driving: all, told as turning.
    pub(super) straight: [usize; 2],
}

impl Turns {
    pub(super) fn add(&mut self, other: &Self) {
        for (a, b) in self.arcs.iter_mut().zip(other.arcs) {
            *a += b;
        }
        for (a, b) in self.spins.iter_mut().zip(other.spins) {
            *a += b;
        }
        for (a, b) in self.straight.iter_mut().zip(other.straight) {
            *a += b;
        }
    }

    pub(super) fn as_json(&self) -> Value {
        json!({
            "arcs": { "samples": self.arcs[0], "right_side": self.arcs[1], "wrong_side": self.arcs[2] },
            "spins": { "samples": self.spins[0], "told": self.spins[1] },
            "straight": { "samples": self.straight[0], "told_as_turning": self.straight[1] },
        })
    }
}

/// Share of a count; zero of nothing.
pub(super) fn share(part: usize, all: usize) -> f64 {
    part as f64 / all.max(1) as f64
}

/// Scores what the program said without a gyro.
pub(super) fn turns(answer: &Answer, witness: &Witness) -> Turns {
    let told = answer.steady("turning");
    let way = |t: f64| {
        let inside = |v: &&Value| {
            let [from, until] = interval(&v["interval"]);
            t >= from - 1e-9 && t <= until + 1e-9
        };
        told.iter().find(inside).and_then(|v| v["way"].as_str())
    };
    let mut out = Turns::default();
    for (i, &t) in witness.time.iter().enumerate() {
        let (yaw, forward, said) = (witness.yaw_rate[i], witness.forward[i], way(t));
        if yaw.abs() > TURNING && forward.abs() < SPIN {
            out.spins[0] += 1;
            out.spins[1] += usize::from(said.is_some());
        } else if yaw.abs() > TURNING {
            let (right, wrong) = if yaw > 0.0 { ("left", "right") } else { ("right", "left") };
            out.arcs[0] += 1;
            out.arcs[1] += usize::from(said == Some(right));
            out.arcs[2] += usize::from(said == Some(wrong));
        } else if yaw.abs() < STRAIGHT && forward.abs() > SPIN {
            out.straight[0] += 1;
            out.straight[1] += usize::from(said.is_some());
        }
    }
    out
}
