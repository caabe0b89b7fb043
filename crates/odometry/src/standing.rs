//! An encoder that counts nothing while its wheel rolls: what a cable that comes loose leaves of it.
//!
//! Its column stands exactly still while another wheel's counts go on, and the pose says that the wheel rolled a way: what the body
//! moved by, along what that wheel rules ([`Kinematics::turns`]). Such spans are shorter than the windows of the fit, which they would
//! spoil one by one, so that they are found first and windows begin anew after them.

use crate::drive::Drive;
use crate::dropout::Lost;
use crate::kinematics::Kinematics;
use crate::motion::{Laws, of_robot, relative};
use crate::settings::{SETTINGS, Standing};
use crate::windows::Data;

const RULES: Standing = SETTINGS.standing;

/// Spans in which the column of one and the same wheel stands still while that wheel rolls, by drive; none where several wheels' do.
pub(crate) fn lost(data: &Data<'_>, theta: &[f64]) -> Vec<Lost> {
    let laws = data.laws(theta);
    let least = RULES.noises * data.pose_noise();
    let mut out = Vec::new();
    for (index, drive) in data.drives.iter().enumerate() {
        let kinematics = Kinematics::new(data.robot, &laws.geometry);
        for (wheel, spans) in of_drive(data, drive, (&laws, &kinematics), least).into_iter().enumerate() {
            let stood: f64 = spans.iter().map(|[from, until]| until - from).sum();
            if spans.is_empty() || stood > SETTINGS.dropout.most * drive.duration() {
                continue;
            }
            let evidence = vec![(wheel, RULES.nats * spans.len() as f64)];
            let spans = spans.into_iter().map(|span| (span, 1.0)).collect();
            out.push(Lost { wheel, drive: index, spans, evidence });
        }
    }
    // Several encoders do not fail at once, and what shows once may be a wheel that was blocked.
    let is_one = out.iter().all(|found| found.wheel == out[0].wheel);
    let often = out.iter().map(|found| found.spans.len()).sum::<usize>() >= SETTINGS.dropout.windows;
    if is_one && often { out } else { Vec::new() }
}

/// Such spans of each measured wheel in a drive, s.
fn of_drive(
    data: &Data<'_>,
    drive: &Drive,
    (laws, kinematics): (&Laws, &Kinematics<'_>),
    least: f64,
) -> Vec<Vec<[f64; 2]>> {
    let measured = data.robot.measured();
    let radius: Vec<f64> = measured.iter().map(|&wheel| data.robot.wheels[wheel].radius).collect();
    let still = |wheel: usize| -> Vec<[f64; 2]> {
        let mut out = Vec::new();
        for [from, to] in still_rows(drive, wheel) {
            let inside = [drive.time[from] + RULES.edge, drive.time[to] - RULES.edge];
            let Some(rolled) = rolled(drive, (laws, kinematics), inside) else { continue };
            let way: Vec<f64> = rolled.iter().zip(&radius).map(|(turn, radius)| (turn * radius).abs()).collect();
            let counted = |other: usize| -> f64 {
                let turns = drive.turns[from + 1..=to].iter().map(|turns| turns[other]);
                (turns.sum::<f64>() * radius[other]).abs()
            };
            let largest = way.iter().fold(0.0_f64, |a, b| a.max(*b));
            let others = (0..radius.len()).filter(|other| *other != wheel).map(counted).fold(0.0, f64::max);
            let of_counts = RULES.counts * one_count(drive, wheel) * radius[wheel];
            let is_rolling = way[wheel] > least.max(of_counts) && way[wheel] > RULES.share * largest;
            if is_rolling && others > RULES.share * way[wheel] {
                out.push([drive.time[from], drive.time[to]]);
            }
        }
        out
    };
    (0..radius.len()).map(still).collect()
}

/// First and last row of spans in which a wheel's column stands still for long enough.
fn still_rows(drive: &Drive, wheel: usize) -> Vec<[usize; 2]> {
    let mut out = Vec::new();
    let mut from = 0;
    for row in 1..=drive.time.len() {
        if row < drive.time.len() && drive.turns[row][wheel] == 0.0 {
            continue;
        }
        if drive.time[row - 1] - drive.time[from] >= RULES.least {
            out.push([from, row - 1]);
        }
        from = row;
    }
    out
}

/// What a wheel turns by in one count, rad: the least that it ever does.
fn one_count(drive: &Drive, wheel: usize) -> f64 {
    let turns = drive.turns[1..].iter().map(|turns| turns[wheel].abs()).filter(|turn| *turn > 0.0);
    turns.fold(f64::INFINITY, f64::min)
}

/// By how much the pose says that each measured wheel turned between two instants of the counts, rad; `None` where it was not seen.
fn rolled(drive: &Drive, (laws, kinematics): (&Laws, &Kinematics<'_>), [from, until]: [f64; 2]) -> Option<Vec<f64>> {
    let of_pose = |time: f64| drive.time_of_pose(time, laws.clock, laws.clock_zero);
    let [from, until] = [from, until].map(of_pose);
    let mut rows: Vec<usize> = Vec::new();
    for row in 0..drive.time.len() {
        let is_next = rows.last().is_none_or(|last| drive.time[row] - drive.time[*last] >= RULES.step);
        if (from..=until).contains(&drive.time[row]) && drive.is_seen(row) && is_next {
            rows.push(row);
        }
    }
    let mut out: Option<Vec<f64>> = None;
    for ends in rows.windows(2) {
        let seen = relative(drive.pose[ends[0]], drive.pose[ends[1]]);
        let steering = drive.steering.as_ref().map_or(0.0, |s| s[ends[1]]);
        let turns = kinematics.turns(of_robot(laws, seen), steering);
        match &mut out {
            Some(sum) => sum.iter_mut().zip(turns).for_each(|(sum, turn)| *sum += turn),
            None => out = Some(turns),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constants::{Measured, constants};
    use crate::motion::implied;
    use crate::wheel::WheeledRobot;

    /// A drive of 60 s of a robot on two wheels that drives straight on, pivots about its left wheel for 3 s and goes on, again and again;
    /// the pose is `late` seconds after the counts, of which some may be `missing`.
    fn drive(robot: &WheeledRobot, late: f64, missing: impl Fn(usize, f64) -> bool) -> Drive {
        let step = 0.02;
        let time: Vec<f64> = (0..3000).map(|k| step * f64::from(k)).collect();
        let count = std::f64::consts::TAU / 500.0;
        let rate = |t: f64| if t.rem_euclid(9.0) < 6.0 { [6.0, 6.0] } else { [0.0, 4.0] };
        let mut angle = [0.0; 2];
        let mut true_turns = Vec::new();
        let mut turns = Vec::new();
        for t in &time {
            let mut row = [0.0; 2];
            for wheel in 0..2 {
                let before = (angle[wheel] / count).floor();
                angle[wheel] += rate(*t)[wheel] * step;
                row[wheel] = ((angle[wheel] / count).floor() - before) * count;
            }
            true_turns.push(rate(*t).map(|rate| rate * step).to_vec());
            turns.push(row.iter().enumerate().map(|(k, turn)| if missing(k, *t) { 0.0 } else { *turn }).collect());
        }
        let mut out = Drive {
            name: "run".into(),
            session: "one".into(),
            turns: true_turns,
            steering: None,
            pose: vec![[0.0; 3]; time.len()],
            heading_only: false,
            told: Vec::new(),
            time,
        };
        let laws = Laws { clock: [late, 0.0], ..Laws::given(robot) };
        out.pose = implied(robot, &out, &laws);
        out.turns = turns;
        out
    }

    fn found(late: f64, missing: impl Fn(usize, f64) -> bool) -> Vec<Lost> {
        let robot = WheeledRobot::differential(0.05, 0.3);
        let constants = constants(&robot, Measured::POSE);
        let drive = drive(&robot, late, missing);
        let data = Data::new(&robot, &constants, vec![&drive]).expect("windows");
        let theta: Vec<f64> = constants
            .iter()
            .map(|c| if matches!(c.quantity, crate::constants::Quantity::ClockOffset) { late } else { 0.0 })
            .collect();
        lost(&data, &theta)
    }

    #[test]
    fn a_column_that_stands_while_its_wheel_rolls_is_found_and_a_wheel_that_the_robot_turns_about_is_not() {
        for late in [0.0, 0.7] {
            assert!(found(late, |_, _| false).is_empty(), "late by {late} s");
            let unplugged = |wheel: usize, t: f64| wheel == 1 && (t - 20.0).rem_euclid(18.0) < 0.8;
            let lost = found(late, unplugged);
            assert_eq!(lost.len(), 1, "late by {late} s: {lost:?}");
            assert_eq!((lost[0].wheel, lost[0].spans.len()), (1, 4), "{lost:?}");
            let [from, until] = lost[0].spans[1].0;
            assert!((from - 20.0).abs() < 0.05 && (until - 20.8).abs() < 0.05, "{from} {until}");
        }
        // Both encoders at once are no encoder, and one span alone may be a wheel that was blocked.
        assert!(found(0.0, |_, t| (t - 20.0).rem_euclid(18.0) < 0.8).is_empty());
        assert!(found(0.0, |wheel, t| wheel == 0 && (t - 21.0).abs() < 0.5).is_empty());
        // Nor is a body that is pushed while the other wheel hardly counts.
        let is_rare = |t: f64| (t / 0.02).round() as i64 % 15 == 0;
        assert!(found(0.0, |wheel, t| (t - 20.0).rem_euclid(18.0) < 0.8 && (wheel == 1 || !is_rare(t))).is_empty());
    }

    #[test]
    fn windows_begin_anew_after_what_is_left_out() {
        let robot = WheeledRobot::differential(0.05, 0.3);
        let constants = constants(&robot, Measured::POSE);
        let drive = drive(&robot, 0.0, |_, _| false);
        let mut data = Data::new(&robot, &constants, vec![&drive]).expect("windows");
        let all = data.windows[0].len();
        let spans = [[10.0, 11.0], [30.0, 30.5]];
        data.leave_out(0, &spans);
        let windows: Vec<[f64; 2]> = (0..data.windows[0].len()).map(|window| data.span(0, window)).collect();
        assert!(windows.iter().all(|[from, until]| spans.iter().all(|[a, b]| until <= a || from >= b)), "{windows:?}");
        assert!(windows.iter().any(|[from, _]| *from == 11.0), "one begins where the first span ends: {windows:?}");
        assert!(windows.len() >= all - 3 && data.dropped[0].len() == windows.len());
    }
}
