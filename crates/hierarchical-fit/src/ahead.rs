//! Forecasts of a pose on a grid of steps: where they begin, and how far off they are.

/// Which forecasts are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ahead {
    /// Step of the grid, s.
    pub step: f64,
    /// Their lengths, rising, s.
    pub lengths: [f64; 3],
    /// Distance of their beginnings, s.
    pub every: f64,
    /// Past that has to be seen before each, s.
    pub past: f64,
    /// Way below which a forecast is of a robot that stands, and does not count, m.
    pub way: f64,
    /// The same of turning, rad.
    pub turn: f64,
}

impl Ahead {
    fn steps(&self, seconds: f64) -> usize {
        (seconds / self.step).round() as usize
    }

    /// Steps of the longest forecast.
    pub fn longest(&self) -> usize {
        self.steps(self.lengths[2])
    }

    /// Steps at which forecasts begin: their past and their ends were seen, and the robot moves.
    pub fn beginnings(&self, pose: &[[f64; 3]]) -> Vec<usize> {
        let longest = self.longest();
        let past = (self.past / self.step).ceil() as usize;
        let seen = |k: usize| pose[k][0].is_finite();
        let moves = |k: usize| {
            let (a, b) = (pose[k], pose[k + longest]);
            (b[0] - a[0]).hypot(b[1] - a[1]) > self.way || (b[2] - a[2]).abs() > self.turn
        };
        let usable =
            |&k: &usize| (k - past..=k).all(seen) && self.lengths.iter().all(|l| seen(k + self.steps(*l))) && moves(k);
        (past..pose.len().saturating_sub(longest + 1)).step_by(self.steps(self.every)).filter(usable).collect()
    }

    /// Errors of one forecast over each length, position, m, and heading, rad, of the pose so many steps after it began.
    pub fn judge(&self, pose: &[[f64; 3]], from: usize, forecast: impl Fn(usize) -> [f64; 3]) -> [[f64; 2]; 3] {
        self.lengths.map(|length| {
            let steps = self.steps(length);
            let ([x, y, yaw], truth) = (forecast(steps), pose[from + steps]);
            [(x - truth[0]).hypot(y - truth[1]), (yaw - truth[2]).abs()]
        })
    }

    /// The same of a twist that does not change, from a pose and its rates.
    pub fn judge_twist(
        &self,
        pose: &[[f64; 3]],
        from: usize,
        (at, [vx, vy, rate]): ([f64; 3], [f64; 3]),
    ) -> [[f64; 2]; 3] {
        self.judge(pose, from, |k| {
            let time = self.step * k as f64;
            let turned = rate * time;
            // Chord and its direction.
            let (along, across) =
                if turned == 0.0 { (time, 0.0) } else { (turned.sin() / rate, (1.0 - turned.cos()) / rate) };
            [at[0] + along * vx - across * vy, at[1] + along * vy + across * vx, at[2] + turned]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AHEAD: Ahead =
        Ahead { step: 0.02, lengths: [0.5, 1.0, 2.0], every: 1.0, past: 0.2, way: 0.05, turn: f64::INFINITY };

    #[test]
    fn a_twist_that_does_not_change_forecasts_a_circle_and_begins_where_its_past_was_seen() {
        let at = |k: usize| {
            let yaw = 0.5 * AHEAD.step * k as f64;
            [2.0 * yaw.sin(), 2.0 * (1.0 - yaw.cos()), yaw]
        };
        let mut pose: Vec<[f64; 3]> = (0..500).map(at).collect();
        let all = AHEAD.beginnings(&pose);
        assert_eq!((all.first(), all.len()), (Some(&10), 8));
        let errors = AHEAD.judge_twist(&pose, 10, (pose[10], [pose[10][2].cos(), pose[10][2].sin(), 0.5]));
        assert!(errors.iter().flatten().all(|e| e.abs() < 1e-9), "{errors:?}");
        pose[105] = [f64::NAN; 3];
        assert!(!AHEAD.beginnings(&pose).contains(&110));
        let still = vec![[1.0; 3]; 500];
        assert!(AHEAD.beginnings(&still).is_empty());
        // One that turns on the spot moves where turning counts.
        let turning: Vec<[f64; 3]> = (0..500).map(|k| [1.0, 1.0, 0.01 * f64::from(k)]).collect();
        assert!(AHEAD.beginnings(&turning).is_empty());
        assert_eq!(Ahead { turn: 0.05, ..AHEAD }.beginnings(&turning).len(), 8);
    }
}
