//! From logged set-points to delivered torque: delay, lag, limit, current loop, dead band.

use crate::events::{Events, inside};
use crate::hidden::Hidden;
use crate::robot::Constants;

/// The drives of both sides.
#[derive(Debug, Clone)]
pub(crate) struct Motors {
    gain: f64,
    delay: f64,
    jitter: bool,
    drops: bool,
    /// Share of the distance to the target that stays after a step.
    stay_lag: f64,
    stay_current: f64,
    limit: f64,
    dead_zone: f64,
    row: f64,
    step: f64,
    lagged: [f64; 2],
    current: [f64; 2],
}

impl Motors {
    /// Drives at rest; a set-point holds for `row` seconds, a step lasts `step`.
    pub(crate) fn new(c: &Constants, hidden: &Hidden, row: f64, step: f64) -> Self {
        let stay = |lag: f64| if lag > 0.0 { (-step / lag).exp() } else { 0.0 };
        Self {
            gain: c.torque_gain * (1.0 + hidden.torque_gain),
            delay: hidden.delay,
            jitter: hidden.foreign.jitter > 0.0,
            drops: hidden.foreign.dropout > 0.0,
            stay_lag: stay(hidden.lag),
            stay_current: stay(c.current_lag),
            limit: hidden.limit,
            dead_zone: hidden.dead_zone,
            row,
            step,
            lagged: [0.0; 2],
            current: [0.0; 2],
        }
    }

    /// Torque delivered over the step that starts at `t`.
    pub(crate) fn step(&mut self, t: f64, commands: &[[f64; 2]], events: &Events) -> [f64; 2] {
        let mut delay = self.delay;
        if self.jitter {
            delay += events.delay(t);
        }
        let row = ((t + 0.5 * self.step - delay) / self.row).floor();
        let command = if row < 0.0 { [0.0; 2] } else { commands.get(row as usize).copied().unwrap_or([0.0; 2]) };
        let mut out = [0.0; 2];
        for side in 0..2 {
            let mut target = self.gain * command[side];
            if self.drops && inside(&events.dropout[side], t) {
                target = 0.0;
            }
            let lagged = target + (self.lagged[side] - target) * self.stay_lag;
            self.lagged[side] = lagged;
            let limited = lagged.clamp(-self.limit, self.limit);
            let before = self.current[side];
            let current = limited + (before - limited) * self.stay_current;
            self.current[side] = current;
            let mean = 0.5 * (before + current);
            out[side] = mean - mean.clamp(-self.dead_zone, self.dead_zone);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::Motors;
    use crate::events::Events;
    use crate::hidden::Hidden;
    use crate::robot::Constants;
    use crate::{RobotClass, TyreLaw};

    fn settle(hidden: &Hidden, torque: f64, steps: usize) -> f64 {
        let mut c = Constants::nominal(1, RobotClass::Medium, TyreLaw::Brush);
        c.torque_gain = 1.0;
        let mut m = Motors::new(&c, hidden, 0.01, 0.00025);
        let commands = vec![[torque, -torque]; 400];
        let mut out = [0.0; 2];
        for i in 0..steps {
            out = m.step(i as f64 * 0.00025, &commands, &Events::default());
        }
        assert_eq!(out[0], -out[1]);
        out[0]
    }

    #[test]
    fn each_part_of_the_chain_does_what_its_name_says() {
        let with = |f: fn(&mut Hidden)| {
            let mut h = Hidden::default();
            f(&mut h);
            h
        };
        let near = |a: f64, b: f64| assert!((a - b).abs() < 0.01, "{a} {b}");
        near(settle(&with(|_| ()), 5.0, 4000), 5.0);
        near(settle(&with(|h| h.dead_zone = 0.3), 5.0, 4000), 4.7);
        near(settle(&with(|h| h.limit = 3.0), 5.0, 4000), 3.0);
        near(settle(&with(|h| h.torque_gain = -0.1), 5.0, 4000), 4.5);
        near(settle(&with(|h| h.delay = 0.1), 5.0, 399), 0.0);
        near(settle(&with(|h| h.lag = 0.2), 5.0, 800), 5.0 * (1.0 - (-0.96_f64).exp()));
    }
}
