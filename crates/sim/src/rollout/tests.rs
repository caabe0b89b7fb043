//! What every rollout promises.

use robot_model::effects::{coulomb_side, free_spin, viscous_friction};
use robot_model::paper::Parameters;
use robot_model::{Active, Lanes, Plant, Presence, Robot, State};

use super::{
    AtSpeed, Commanded, Delivered, DriveAlone, Grid, Hold, Input, Ramp, Restarts, Rollout, Start, Visitor, each_row,
    each_step, lanes,
};

const GRID: Grid = Grid { period: 0.01, substeps: 10 };
const ROWS: usize = 120;

fn robot() -> Robot<f64> {
    let mut robot = Robot::from(&Parameters::SET_B);
    (robot.drive.lag, robot.drive.extra_lag, robot.drive.dead_band) = (0.02, 0.01, 0.1);
    robot
}

/// Lively commands that differ from robot to robot.
fn torque(i: usize) -> Vec<[f64; 2]> {
    let at = |k: usize| {
        let t = k as f64 * GRID.period;
        [2.5 + (3.0 * t + i as f64).sin(), 2.0 - 3.0 * (5.0 * t).sin()]
    };
    (0..ROWS).map(at).collect()
}

/// State at the start of every row.
fn states(robot: &Robot<f64>, active: &[Active<f64>], torque: &[[f64; 2]], start: State<f64>) -> Vec<State<f64>> {
    let plant = Plant::new(robot, active, GRID.step());
    let hold = Hold::new(GRID, plant.drive().delay);
    let mut out = Vec::new();
    let Ok(()) = Rollout::new(&plant, torque.len(), GRID.substeps).run(
        &mut { start },
        &mut Commanded(|row, step| hold.command(torque, row, step)),
        &mut each_row(|_, _, s| out.push(*s)),
    );
    out
}

#[test]
fn a_rollout_is_the_plant_stepped_under_held_torque() {
    let (robot, torque) = (robot(), torque(0));
    let plant = Plant::new(&robot, &[], GRID.step());
    let mut s = State::default();
    for (k, seen) in states(&robot, &[], &torque, s).into_iter().enumerate() {
        assert_eq!(s, seen, "row {k}");
        for _ in 0..GRID.substeps {
            plant.step(&mut s, torque[k]);
        }
    }
    assert!(s.position[0] > 0.1 && s.yaw_rate != 0.0);
}

#[test]
fn a_delay_that_falls_into_a_row_splits_it() {
    let mut robot = robot();
    (robot.drive.lag, robot.drive.extra_lag, robot.drive.dead_band) = (0.0, 0.0, 0.0);
    robot.drive.delay = 0.013;
    let plant = Plant::new(&robot, &[], GRID.step());
    let hold = Hold::new(GRID, plant.drive().delay);
    let mut delivered = Vec::new();
    let Ok(()) = Rollout::new(&plant, 4, GRID.substeps).run(
        &mut State::default(),
        &mut DriveAlone(|row, step| hold.command(&[[1.0, -1.0], [3.0, 0.5]], row, step)),
        &mut each_step(|_, _, plant, s| delivered.push(plant.delivered(s))),
    );
    assert_eq!(delivered[12], [0.0; 2]);
    assert_eq!(delivered[13..23], [[1.0, -1.0]; 10]);
    // The last command stays.
    assert_eq!(delivered[23..], [[3.0, 0.5]; 17]);
}

#[test]
fn what_the_drives_have_in_store_outlives_a_restart() {
    let mut robot = robot();
    robot.drive.delay = 0.02;
    // The command ends in the row of the restart; two rows of it are still on their way, and the lag holds more.
    let torque: Vec<[f64; 2]> = (0..60).map(|k| if k < 30 { [3.0; 2] } else { [0.0; 2] }).collect();
    let plant = Plant::new(&robot, &[], GRID.step());
    let hold = Hold::new(GRID, plant.drive().delay);
    let still = Start { position: [5.0, -1.0], yaw: 0.3, wheel_angle: [1.0, 2.0], ..Start::default() };
    let mut seen = Vec::new();
    let Ok(()) = Rollout::new(&plant, torque.len(), GRID.substeps).run(
        &mut State::default(),
        &mut Commanded(|row, step| hold.command(&torque, row, step)),
        &mut (Restarts::new([(30, still)], GRID.period), each_row(|_, _, s| seen.push(*s))),
    );
    let s = seen[30];
    assert_eq!((s.position, s.velocity, s.wheel_speed, s.wheel_angle), ([5.0, -1.0], [0.0; 2], [0.0; 2], [1.0, 2.0]));
    assert!((s.time - 0.3).abs() < 1e-12 && seen[29].position[0] < 2.0);
    assert!(s.torque[0] > 2.9 && s.lagged[0] > 2.9, "{s:?}");
    assert!(seen[32].wheel_speed[0] > 0.05, "the torque on its way drives on: {:?}", seen[32]);

    // Without that history nothing moves.
    let alone = states(&robot, &[], &torque[30..], State { time: 0.3, ..State::default() });
    assert_eq!(alone[29].wheel_speed, [0.0; 2]);
}

#[test]
fn restarts_count_once_and_the_first_of_a_row_counts() {
    let at = |x: f64| Start { position: [x, 0.0], ..Start::default() };
    let robot = robot();
    let plant = Plant::new(&robot, &[], GRID.step());
    let mut seen = Vec::new();
    let Ok(()) = Rollout::new(&plant, 6, GRID.substeps).run(
        &mut State::default(),
        &mut Delivered(|_, _| [0.0; 2]),
        &mut (
            Restarts::new([(1, at(1.0)), (1, at(9.0)), (4, at(4.0))], GRID.period),
            each_row(|_, _, s| seen.push(s.position[0])),
        ),
    );
    assert_eq!(seen, [0.0, 1.0, 1.0, 1.0, 4.0, 4.0]);
}

#[test]
fn an_effect_that_begins_at_an_instant_changes_nothing_before_it() {
    let (robot, torque) = (robot(), torque(0));
    let onset = Presence { from: 0.5 - 1e-6, ..Presence::default() };
    let brake = [Active::new(&coulomb_side::Law, &[1.0], Presence { side: Some(0), ..onset })];
    let (plain, braked) =
        (states(&robot, &[], &torque, State::default()), states(&robot, &brake, &torque, State::default()));
    assert_eq!(plain[..=50], braked[..=50]);
    assert!(braked[51].wheel_speed[0] < plain[51].wheel_speed[0]);
    assert!(braked[119].wheel_speed[0] < plain[119].wheel_speed[0] - 0.05);
}

#[test]
fn a_delivered_torque_is_what_the_drive_alone_would_deliver() {
    let (robot, torque) = (robot(), torque(0));
    let plant = Plant::new(&robot, &[], GRID.step());
    let hold = Hold::new(GRID, 0.0);
    let rollout = Rollout::new(&plant, ROWS, GRID.substeps);
    let mut delivered = Vec::new();
    let Ok(()) = rollout.run(
        &mut State::default(),
        &mut DriveAlone(|row, step| hold.command(&torque, row, step)),
        &mut each_step(|_, _, plant, s| delivered.push(plant.delivered(s))),
    );
    let mut s = State::default();
    let Ok(()) = rollout.run(&mut s, &mut Delivered(|row, step| delivered[row * GRID.substeps + step]), &mut ());
    let mut through = State::default();
    let Ok(()) = rollout.run(&mut through, &mut Commanded(|row, step| hold.command(&torque, row, step)), &mut ());
    assert_eq!((s.position, s.wheel_speed), (through.position, through.wheel_speed));
}

#[test]
fn every_lane_has_the_bits_that_it_has_alone() {
    const N: usize = 4;
    let robots: [Robot<f64>; N] = std::array::from_fn(|i| {
        let mut robot = robot();
        robot.mass *= 1.0 + 0.1 * i as f64;
        robot.adhesion -= 0.1 * i as f64;
        robot.drive.delay = 2e-3 * i as f64;
        robot
    });
    let presence: [Presence<f64>; N] =
        std::array::from_fn(|i| Presence { from: 0.2 + 0.1 * i as f64, ..Presence::default() });
    let values: [[f64; 1]; N] = std::array::from_fn(|i| [0.1 + 0.05 * i as f64]);
    let starts: [Start; N] = std::array::from_fn(|i| Start {
        wheel_speed: [1.0 + i as f64, 2.0],
        wheel_angle: [0.1 * i as f64, 0.0],
        yaw_rate: 0.1 * i as f64,
        velocity: [0.2, 0.01],
        position: [i as f64, 1.0],
        yaw: 0.7 * i as f64,
    });
    let torques: [Vec<[f64; 2]>; N] = std::array::from_fn(torque);

    let robot = lanes::robots(robots.each_ref());
    let active = [lanes::effect(&viscous_friction::Law, values.each_ref().map(<[f64; 1]>::as_slice), presence)
        .expect("in the catalogue")];
    let plant = Plant::new(&robot, &active, Lanes([GRID.step(); N]));
    let mut together = lanes::starts(&plant, starts.each_ref(), [0.0; N]);
    let late: [usize; N] = std::array::from_fn(|i| 2 * i);
    let Ok(()) = Rollout::new(&plant, ROWS, GRID.substeps).run_vectorised(
        &mut together,
        &mut lanes::Held::new(torques.each_ref().map(Vec::as_slice), late, GRID.substeps),
        &mut (),
    );

    for i in 0..N {
        let active = [Active::new(&viscous_friction::Law, &values[i], presence[i])];
        let plant = Plant::new(&robots[i], &active, GRID.step());
        let mut alone = State::default();
        starts[i].set(&plant, &mut alone);
        // The first command has been held for long.
        let command =
            |row: usize, step: usize| torques[i][(row * GRID.substeps + step).saturating_sub(late[i]) / GRID.substeps];
        let Ok(()) = Rollout::new(&plant, ROWS, GRID.substeps).run(&mut alone, &mut Commanded(command), &mut ());

        let lane = |x: [Lanes<N>; 2]| x.map(|x| x.0[i].to_bits());
        let bits = |x: [f64; 2]| x.map(f64::to_bits);
        assert!(alone.position[0].is_finite() && alone.position != starts[i].position);
        assert_eq!(lane(together.position), bits(alone.position), "lane {i}");
        assert_eq!(lane(together.velocity), bits(alone.velocity), "lane {i}");
        assert_eq!(lane(together.heading), bits(alone.heading), "lane {i}");
        assert_eq!(lane(together.wheel_speed), bits(alone.wheel_speed), "lane {i}");
        assert_eq!(lane(together.lagged), bits(alone.lagged), "lane {i}");
    }
}

/// Holds a wheel speed by what it sees at the start of each row.
struct Keep {
    speed: f64,
    sum: [f64; 2],
    command: [f64; 2],
}

impl Input<f64> for Keep {
    fn begin(&mut self, _: usize, _: &Plant<'_, f64>, s: &State<f64>) {
        for j in 0..2 {
            let error = self.speed - s.wheel_speed[j];
            self.sum[j] += 0.015 * error;
            self.command[j] = 0.5 * error + self.sum[j];
        }
    }

    fn advance(&mut self, _: usize, _: usize, plant: &Plant<'_, f64>, s: &mut State<f64>) {
        plant.step(s, self.command);
    }
}

#[test]
fn feedback_sees_the_state_at_the_start_of_each_row() {
    let robot = robot();
    let plant = Plant::new(&robot, &[], GRID.step());
    let (mut s, mut keep) = (State::default(), Keep { speed: 4.0, sum: [0.0; 2], command: [0.0; 2] });
    let Ok(()) = Rollout::new(&plant, 2000, GRID.substeps).run(&mut s, &mut keep, &mut ());
    assert!((s.wheel_speed[0] - 4.0).abs() < 0.02, "{:?}", s.wheel_speed);
    assert!(keep.command[0] > 0.1);
}

#[test]
fn wheel_speeds_between_rows_lie_on_a_line_and_a_drive_can_run_beside() {
    let robot = robot();
    let plant = Plant::new(&robot, &[], GRID.step());
    let ramp = Ramp::new([[1.0, 2.0], [2.0, 0.0]], GRID);
    let mut speeds = Vec::new();
    let mut s = State::default();
    let Ok(()) = Rollout::new(&plant, 1, GRID.substeps).run(
        &mut s,
        &mut (DriveAlone(|_, _| [2.0; 2]), AtSpeed(|_, step| ramp.at(step))),
        &mut each_step(|_, _, _, s| speeds.push(s.wheel_speed)),
    );
    assert!((speeds[4][0] - 1.5).abs() < 1e-12 && (speeds[4][1] - 1.0).abs() < 1e-12);
    assert!((speeds[9][0] - 2.0).abs() < 1e-12 && speeds[9][1].abs() < 1e-12);
    assert!(s.lagged[0] > 0.0 && s.needed[0] > 0.0, "{s:?}");
}

/// Stops once a wheel turns faster than allowed.
struct Limit(f64);

impl Visitor<f64> for Limit {
    type Stop = usize;

    fn begin(&mut self, row: usize, _: &Plant<'_, f64>, s: &mut State<f64>) -> Result<(), usize> {
        if s.wheel_speed[0] > self.0 { Err(row) } else { Ok(()) }
    }
}

#[test]
fn a_visitor_stops_a_rollout_where_it_wants() {
    let robot = robot();
    let plant = Plant::new(&robot, &[], GRID.step());
    let mut s = State::default();
    let stop = Rollout::new(&plant, 10_000, 10).run(&mut s, &mut Commanded(|_, _| [3.0; 2]), &mut Limit(2.0));
    let row = stop.expect_err("faster than that");
    assert!((s.time - row as f64 * GRID.period).abs() < 1e-9 && s.wheel_speed[0] > 2.0 && row > 1);
}

#[test]
fn a_grid_rounds_or_keeps_below_and_never_has_no_step() {
    assert_eq!(Grid::nearest(0.01, 3e-3).substeps, 3);
    assert_eq!(Grid::at_most(0.01, 3e-3).substeps, 4);
    assert_eq!(Grid::nearest(1e-3, 1.0).substeps, 1);
    assert_eq!(GRID.step(), 0.01 / 10.0);
}

#[test]
fn an_effect_outside_the_catalogue_has_no_lanes() {
    struct Own;
    impl robot_model::Effect<f64> for Own {
        fn spec(&self) -> &'static robot_model::EffectSpec {
            static SPEC: std::sync::LazyLock<robot_model::EffectSpec> = std::sync::LazyLock::new(|| {
                robot_model::EffectSpec { id: "own", ..*robot_model::Effect::<f64>::spec(&free_spin::Law) }
            });
            &SPEC
        }
    }
    assert!(lanes::effect::<2>(&Own, [&[1.0]; 2], [Presence::default(); 2]).is_none());
}
