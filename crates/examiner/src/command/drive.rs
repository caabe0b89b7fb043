//! The robot between command and motion.

/// Step of the plant, s.
pub(super) const STEP: f64 = 0.005;
/// Rows are recorded every so many steps: 20 Hz.
pub(super) const EVERY: usize = 10;

/// A robot of which wheel speeds are commanded.
#[derive(Debug, Clone, Copy)]
pub struct Robot {
    /// Rolling radius by the file and track, m.
    pub radius: f64,
    /// Distance of the sides, m.
    pub track: f64,
    /// Dead time from command to controller, s.
    pub dead_time: f64,
    /// Scale of forward speed and of turning.
    pub gains: [f64; 2],
    /// Largest turning: half the difference of the sides, rad/s.
    pub turn_limit: f64,
    /// Largest rates of forward speed and of turning, rad/s².
    pub ramps: [f64; 2],
    /// Lag of the wheels, s.
    pub lag: f64,
    /// What motors can: largest acceleration of a wheel at rest, rad/s², and the speed at which nothing is left of it, rad/s.
    pub strength: [f64; 2],
    /// Effective track over the track.
    pub track_factor: f64,
    /// Rolling radius over that of the file.
    pub radius_factor: f64,
    /// The left side rolls with this much more, the right side with this much less.
    pub side_radius: f64,
    /// Share of the forward speed that is lost per rad/s of yaw rate.
    pub turn_slip: f64,
}

impl Robot {
    /// A robot whose wheels do what is commanded, but for a lag of some thousandths of a second.
    pub fn ideal(radius: f64, track: f64, lag: f64) -> Self {
        Self {
            radius,
            track,
            dead_time: 0.0,
            gains: [1.0; 2],
            turn_limit: f64::INFINITY,
            ramps: [f64::INFINITY; 2],
            lag,
            strength: [f64::INFINITY; 2],
            track_factor: 1.0,
            radius_factor: 1.0,
            side_radius: 0.0,
            turn_slip: 0.0,
        }
    }
}

/// A recorded row, without noise.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) command: [f64; 2],
    pub(super) wheel: [f64; 2],
    /// x, y, yaw.
    pub(super) pose: [f64; 3],
}

/// Runs the commands, each for so many seconds.
pub(super) fn run(robot: &Robot, steps: &[([f64; 2], f64)]) -> Vec<Row> {
    let commands: Vec<[f64; 2]> =
        steps.iter().flat_map(|(c, seconds)| std::iter::repeat_n(*c, (seconds / STEP).round() as usize)).collect();
    let late = (robot.dead_time / STEP).round() as usize;
    // A damping of one: each side is two equal lags in a row.
    let keep = (-STEP / (0.5 * robot.lag)).exp();
    let (mut set, mut first, mut wheel) = ([0.0_f64; 2], [0.0_f64; 2], [0.0_f64; 2]);
    let mut pose = [0.0_f64; 3];
    let mut rows = Vec::with_capacity(commands.len() / EVERY + 1);
    for (k, command) in commands.iter().enumerate() {
        if k % EVERY == 0 {
            rows.push(Row { command: *command, wheel, pose });
        }
        let [l, r] = if k >= late { commands[k - late] } else { [0.0; 2] };
        let wanted = [
            robot.gains[0] * 0.5 * (l + r),
            (robot.gains[1] * 0.5 * (r - l)).clamp(-robot.turn_limit, robot.turn_limit),
        ];
        for i in 0..2 {
            let most = robot.ramps[i] * STEP;
            set[i] += (wanted[i] - set[i]).clamp(-most, most);
        }
        let sides = [set[0] - set[1], set[0] + set[1]];
        for j in 0..2 {
            first[j] = sides[j] + keep * (first[j] - sides[j]);
            let aim = first[j] + keep * (wheel[j] - first[j]);
            let change = aim - wheel[j];
            // Back-EMF takes the less of it the slower a wheel turns, and adds to it where it brakes.
            let share =
                if robot.strength[1].is_finite() { wheel[j] * change.signum() / robot.strength[1] } else { 0.0 };
            let most = robot.strength[0] * STEP * (1.0 - share).max(0.0);
            wheel[j] += change.clamp(-most, most);
        }
        let rolls = [wheel[0] * (1.0 + robot.side_radius), wheel[1] * (1.0 - robot.side_radius)];
        let radius = robot.radius * robot.radius_factor;
        let yaw_rate = radius * (rolls[1] - rolls[0]) / (robot.track * robot.track_factor);
        let forward = 0.5 * radius * (rolls[0] + rolls[1]) / (1.0 + robot.turn_slip * yaw_rate.abs());
        let middle = pose[2] + 0.5 * STEP * yaw_rate;
        pose[0] += STEP * forward * middle.cos();
        pose[1] += STEP * forward * middle.sin();
        pose[2] += STEP * yaw_rate;
    }
    rows
}
