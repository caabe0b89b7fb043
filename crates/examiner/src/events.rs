//! What happens at random within one run: bursts, gusts, changing delays.

use crate::hidden::Foreign;
use crate::random::Stream;

/// An interval of a run.
pub(crate) type Interval = [f64; 2];

/// Random intervals that cover a share of a run.
pub(crate) fn bursts(s: &mut Stream, share: f64, lengths: [f64; 2], duration: f64) -> Vec<Interval> {
    let mut out = Vec::new();
    if share <= 0.0 {
        return out;
    }
    let gap = 0.5 * (lengths[0] + lengths[1]) * (1.0 - share) / share;
    let mut t = gap * s.uniform(0.2, 1.0);
    while t < duration {
        let end = t + s.uniform(lengths[0], lengths[1]);
        out.push([t, end.min(duration)]);
        t = end + gap * s.uniform(0.5, 1.5);
    }
    out
}

/// Whether an instant lies in one of the intervals.
pub(crate) fn inside(intervals: &[Interval], t: f64) -> bool {
    let after = intervals.partition_point(|i| i[0] <= t);
    after > 0 && t < intervals[after - 1][1]
}

/// The random events of one run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Events {
    /// When the wheel is off the ground.
    pub lifted: Vec<Interval>,
    /// When a drive delivers nothing, by side.
    pub dropout: [Vec<Interval>; 2],
    /// When a brake touches.
    pub touch: Vec<Interval>,
    /// Starts and values of the changing delay.
    delays: Vec<[f64; 2]>,
    /// Frequency, phase and share of each wave of the gusts, by world axis.
    gusts: Vec<([f64; 3], usize)>,
}

impl Events {
    /// The events of a run.
    pub(crate) fn draw(foreign: &Foreign, run: u64, duration: f64) -> Self {
        let mut events = Self::default();
        let stream = |name| Stream::new(foreign.seed, name, run);
        if foreign.lifted.is_some() {
            events.lifted = bursts(&mut stream("lift"), 0.35, [0.3, 1.2], duration);
        }
        if foreign.dropout > 0.0 {
            events.dropout =
                ["drop left", "drop right"].map(|n| bursts(&mut stream(n), foreign.dropout, [0.08, 0.3], duration));
        }
        if foreign.touch.is_some() {
            events.touch = bursts(&mut stream("touch"), 0.12, [0.1, 0.5], duration);
        }
        if foreign.jitter > 0.0 {
            let mut s = stream("jitter");
            let mut t = 0.0;
            while t < duration {
                events.delays.push([t, s.uniform(0.0, foreign.jitter)]);
                t += s.uniform(0.2, 0.8);
            }
        }
        if foreign.gust > 0.0 {
            let mut s = stream("gust");
            for axis in [0, 1, 0, 1, 0, 1] {
                let wave = [s.uniform(0.08, 0.7), s.uniform(0.0, std::f64::consts::TAU), s.uniform(0.3, 0.6)];
                events.gusts.push((wave, axis));
            }
        }
        events
    }

    /// Short events of a run with what they act on.
    pub(crate) fn short(&self, foreign: &Foreign) -> Vec<(String, Vec<Interval>)> {
        let side = |k: usize| ["left", "right"][k.min(1)];
        let drops = self.dropout.iter().enumerate().map(|(k, times)| (format!("drive_{}", side(k)), times));
        // Wheels are front and rear left, then right.
        let lifted = foreign.lifted.map(|wheel| (format!("wheels_{}", side(wheel / 2)), &self.lifted));
        let touching = foreign.touch.map(|(k, _)| (format!("drive_{}", side(k)), &self.touch));
        let all = drops.chain(lifted).chain(touching).filter(|(_, times)| !times.is_empty());
        all.map(|(of, times)| (of, times.clone())).collect()
    }

    /// The changing delay at an instant.
    pub(crate) fn delay(&self, t: f64) -> f64 {
        match self.delays.partition_point(|d| d[0] <= t) {
            0 => 0.0,
            after => self.delays[after - 1][1],
        }
    }

    /// The gust at an instant as a share of its size, world axes.
    pub(crate) fn gust(&self, t: f64) -> [f64; 2] {
        let mut force = [0.0; 2];
        for ([frequency, phase, share], axis) in &self.gusts {
            force[*axis] += share * (std::f64::consts::TAU * frequency * t + phase).sin();
        }
        force
    }
}

#[cfg(test)]
mod tests {
    use super::{bursts, inside};
    use crate::random::Stream;

    #[test]
    fn bursts_cover_about_their_share_in_order() {
        let b = bursts(&mut Stream::new(1, "b", 0), 0.3, [0.5, 1.5], 400.0);
        let covered: f64 = b.iter().map(|i| i[1] - i[0]).sum();
        assert!((covered / 400.0 - 0.3).abs() < 0.06, "{covered}");
        assert!(b.windows(2).all(|w| w[0][1] < w[1][0]));
        assert!(inside(&b, b[3][0]) && !inside(&b, b[3][1]) && !inside(&b, 0.0));
    }
}
