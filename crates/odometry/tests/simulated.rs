//! Drawn robots with something hidden, by formulas of their own: what is named, what is not, and how wide intervals are.

mod drawn;

use drawn::{Drawn, Hidden, Kind, drawn};
use odometry::{Answer, Case, Findings, diagnose, left_out};

const KINDS: [Kind; 4] = [Kind::Differential, Kind::Tricycle, Kind::Omni3, Kind::Mecanum4];

fn expected(hidden: Hidden) -> &'static str {
    match hidden {
        Hidden::Nothing | Hidden::GainInTurns => "",
        Hidden::OneRadius => "radius_of_one_wheel",
        Hidden::AllRadii | Hidden::DoubledCounts => "radius_of_all_wheels",
        Hidden::Distance | Hidden::FarDistance => "wheel_distance",
        Hidden::SteeringZero => "steering_zero",
        Hidden::Mounting => "pose_mounting",
        Hidden::Origin => "pose_origin",
        Hidden::SlipInTurns | Hidden::SlipInSlowTurns => "slip_in_turns",
        Hidden::SlipWithSpeed | Hidden::SlipByWheels => "slip_with_speed",
        Hidden::ClockOffset => "counts_clock_offset",
        Hidden::ClockRate => "clock_rate",
        Hidden::LostCounts => "lost_counts",
        Hidden::Direction => "direction_of_one_wheel",
    }
}

#[test]
fn what_only_turns_show_gets_a_turning_drive_advised() {
    for kind in KINDS {
        let case = drawn(kind, Hidden::Distance, 3, 60.0, 7);
        let next = odometry::examine(&case.case, Some(12.0), &|_| {}).expect("an answer").next.expect("advice");
        let total: f64 = next.rivals.iter().map(|r| r.probability).sum();
        assert!((total - 1.0).abs() < 1e-9, "{:?}", next.rivals);
        let narrows = |m: &verdict::Manoeuvre| m.narrows.expect("a size");
        let straight = next.manoeuvres.iter().find(|m| m.name == "straight at three speeds").expect("on the menu");
        let turning = next.manoeuvres.iter().map(narrows).fold(1.0, f64::min);
        assert!(narrows(straight) > turning, "{kind:?}: {turning} and {}", narrows(straight));
    }
}

fn found(case: &Drawn) -> Findings {
    diagnose(&case.case, &|_| {}).expect("an answer")
}

#[test]
fn what_is_hidden_is_named_first() {
    let hidden = [
        Hidden::OneRadius,
        Hidden::AllRadii,
        Hidden::DoubledCounts,
        Hidden::Distance,
        Hidden::SteeringZero,
        Hidden::Mounting,
        Hidden::Origin,
        Hidden::SlipInTurns,
        Hidden::ClockOffset,
        Hidden::ClockRate,
        Hidden::LostCounts,
    ];
    let (mut right, mut all, mut wrong) = (0, 0, Vec::new());
    for kind in KINDS {
        for h in hidden {
            let only_steered = h == Hidden::SteeringZero && kind != Kind::Tricycle;
            let one_wheel = h == Hidden::OneRadius && kind == Kind::Tricycle;
            if only_steered || one_wheel {
                continue;
            }
            let seed = 100 * (kind as u64) + h as u64;
            let findings = found(&drawn(kind, h, 3, 60.0, seed));
            let first = findings.named.first().map_or("", |c| c.spec.id);
            let is_right = findings
                .named
                .first()
                .is_some_and(|c| c.spec.id == expected(h) || c.alike.iter().any(|a| a.starts_with(expected(h))));
            all += 1;
            right += usize::from(is_right);
            if !is_right {
                wrong.push(format!("{kind:?} {h:?}: {first} {:?}", findings.answer));
            }
        }
    }
    assert!(right * 100 >= all * 90, "{right} of {all}: {wrong:#?}");
}

#[test]
fn an_omni_wheel_that_points_another_way_is_named_with_its_angle_and_nothing_beside_it() {
    for seed in [41, 42] {
        let case = drawn(Kind::Omni3, Hidden::Direction, 3, 60.0, seed);
        let findings = found(&case);
        let labels: Vec<&str> = findings.named.iter().map(|c| c.label.as_str()).collect();
        assert_eq!(labels, ["direction_of_one_wheel (wheel 3)"], "{seed}");
        let told = &findings.named[0].estimates[0];
        assert!((told.value - case.truth.turned).abs() < 0.01, "{seed}: {told:?} of {}", case.truth.turned);
    }
}

#[test]
fn slip_that_grows_with_speed_is_one_cause_whatever_it_does_to_turning() {
    for kind in [Kind::Differential, Kind::Omni3] {
        for hidden in [Hidden::SlipWithSpeed, Hidden::SlipByWheels] {
            let case = drawn(kind, hidden, 4, 60.0, 900 + kind as u64);
            let findings = found(&case);
            let named: Vec<&str> = findings.named.iter().map(|c| c.spec.id).collect();
            assert_eq!(named, [expected(hidden)], "{kind:?} {hidden:?}: {:?}", findings.shares);
            // What straight driving loses, whichever of both laws makes it; what turning loses beside it; what of it is the wheels'.
            let [of_body, of_wheels] = case.truth.speed_slip;
            let estimates = &findings.named[0].estimates;
            let truths = [of_body + of_wheels, of_body, of_wheels];
            assert!((estimates[0].value / truths[0] - 1.0).abs() < 0.15, "{kind:?} {hidden:?}: {estimates:?}");
            for (estimate, truth) in estimates.iter().zip(truths) {
                let miss = (estimate.value - truth).abs();
                let is_told = estimate.half_width < 0.05 && miss < 0.01 + estimate.half_width;
                assert!(is_told, "{kind:?} {hidden:?}: {estimate:?}, truth {truth}");
            }
        }
    }
}

#[test]
fn columns_in_the_wrong_order_or_with_the_wrong_sign_are_no_robot() {
    type Fault = fn(&mut odometry::Drive);
    let faults: [(&str, Fault); 4] = [
        ("left and right exchanged", |d| d.turns.iter_mut().for_each(|row| row.reverse())),
        ("sign of one wheel", |d| d.turns.iter_mut().for_each(|row| row[0] = -row[0])),
        ("yaw clockwise", |d| d.pose.iter_mut().for_each(|p| p[2] = -p[2])),
        ("x and y exchanged", |d| d.pose.iter_mut().for_each(|p| p.swap(0, 1))),
    ];
    for (what, fault) in faults {
        let mut case = drawn(Kind::Differential, Hidden::Nothing, 3, 60.0, 4242);
        case.case.recordings.iter_mut().for_each(fault);
        let findings = found(&case);
        assert_eq!(findings.answer, Answer::Unknown, "{what}: {:?} of the motion", findings.shares);
        let told = odometry::diagnosis(&findings, &odometry::Table::default(), false);
        assert!(told.sentences[0].contains("check the order, the signs"), "{what}: {:?}", told.sentences);
    }
}

#[test]
fn logs_that_start_seconds_apart_by_unlike_times_are_a_time_base_and_no_slip() {
    for kind in [Kind::Differential, Kind::Omni3] {
        let mut case = drawn(kind, Hidden::Nothing, 4, 60.0, 31 + kind as u64);
        for (drive, seconds) in case.case.recordings.iter_mut().zip([1.5, 2.5, 3.0, 5.0]) {
            let rows = drive.time.partition_point(|t| t - drive.time[0] < seconds);
            let standing = vec![vec![0.0; drive.turns[0].len()]; rows];
            drive.turns = [standing.as_slice(), &drive.turns[..drive.turns.len() - rows]].concat();
        }
        let findings = found(&case);
        let named: Vec<&str> = findings.named.iter().map(|c| c.spec.id).collect();
        assert_eq!(named, ["counts_clock_offset"], "{kind:?}: {:?}", findings.shares);
        let offset = &findings.named[0].estimates[0];
        assert!((offset.value + 2.75).abs() < 0.1, "{kind:?}: {offset:?}");
        let told = findings.told.iter().find(|t| t.contains("by unlike times")).expect("a sentence");
        assert_eq!(told.matches(" s ahead in").count(), 4, "{told}");
    }
}

#[test]
fn a_frame_turned_by_a_right_angle_is_found_where_it_is() {
    let mut case = drawn(Kind::Differential, Hidden::Nothing, 3, 60.0, 77);
    for drive in &mut case.case.recordings {
        drive.pose.iter_mut().for_each(|p| p[2] += std::f64::consts::FRAC_PI_2);
    }
    let findings = found(&case);
    assert_eq!(findings.named[0].spec.id, "pose_mounting");
    let angle = &findings.named[0].estimates[0];
    assert!((angle.value - std::f64::consts::FRAC_PI_2).abs() < angle.half_width + 0.005, "{angle:?}");
}

#[test]
fn a_slip_that_is_whole_in_slow_turns_is_no_other_radius() {
    for kind in KINDS {
        let findings = found(&drawn(kind, Hidden::SlipInSlowTurns, 4, 60.0, 77 + kind as u64));
        let named: Vec<&str> = findings.named.iter().map(|c| c.spec.id).collect();
        assert_eq!(named, ["slip_in_turns"], "{kind:?}");
        let rate = findings.named[0].estimates.iter().find(|e| e.unit == "rad/s").expect("a turning rate");
        assert!((rate.value - 0.015).abs() < rate.half_width, "{kind:?}: {rate:?}");
    }
}

#[test]
fn a_distance_that_is_far_off_is_found_where_it_is() {
    for kind in KINDS {
        let findings = found(&drawn(kind, Hidden::FarDistance, 4, 60.0, 57 + kind as u64));
        let named: Vec<&str> = findings.named.iter().map(|c| c.spec.id).collect();
        let [given, _, best] = findings.shares;
        assert_eq!((findings.answer, &*named), (Answer::Named, &["wheel_distance"][..]), "{kind:?}");
        assert!(best < 0.1 * given, "{kind:?}: {:?}", findings.shares);
    }
}

#[test]
fn a_body_that_gets_ahead_of_its_wheels_is_no_slip() {
    for kind in KINDS {
        let findings = found(&drawn(kind, Hidden::GainInTurns, 4, 60.0, 91 + kind as u64));
        let is_gain = |c: &&odometry::NamedCause| {
            ["slip_in_turns", "roller_slip"].contains(&c.spec.id) && c.estimates[0].value < 0.0
        };
        let gains: Vec<&odometry::NamedCause> = findings.named.iter().filter(is_gain).collect();
        assert!(gains.is_empty() && findings.answer != Answer::Nothing, "{kind:?}: {gains:?}");
    }
}

#[test]
fn fault_free_robots_are_not_alarmed_and_intervals_hold_the_truth() {
    let (mut alarms, mut inside, mut constants, mut cases) = (Vec::new(), 0_usize, 0_usize, 0);
    for kind in KINDS {
        for seed in 0..40 {
            let case = drawn(kind, Hidden::Nothing, 3, 32.0, 1000 + 100 * (kind as u64) + seed);
            let findings = found(&case);
            cases += 1;
            if matches!(findings.answer, Answer::Named | Answer::Unknown) {
                alarms.push(format!(
                    "{kind:?} {seed}: {:?}",
                    findings.named.iter().map(|c| &c.label).collect::<Vec<_>>()
                ));
            }
            if std::env::var_os("ODOMETRY_SHOW").is_some() {
                let z: Vec<String> = case
                    .truth
                    .radius
                    .iter()
                    .copied()
                    .chain([case.truth.base])
                    .zip(&findings.constants)
                    .map(|(t, e)| format!("{:.2}", (e.value - t) / e.half_width * 1.645))
                    .collect();
                eprintln!("{kind:?} noise {:.5} factor {} z {}", findings.noise, findings.scatter, z.join(" "));
            }
            let truths = case.truth.radius.iter().copied().chain([case.truth.base]);
            for (truth, estimate) in truths.zip(&findings.constants) {
                // Only the sum of track and wheelbase shows of a mecanum robot.
                if kind == Kind::Mecanum4 && !estimate.name.starts_with("radius") {
                    continue;
                }
                constants += 1;
                inside += usize::from((estimate.value - truth).abs() <= estimate.half_width);
            }
        }
    }
    assert!(alarms.len() * 100 <= cases * 5, "{} of {cases}: {alarms:#?}", alarms.len());
    let share = inside as f64 / constants as f64;
    assert!((0.87..=0.93).contains(&share), "{share} of {constants} intervals hold the truth");
}

/// A differential drive that turns the less, the faster it turns (share per rad/s, up to 1 rad/s), and swings by another share as time
/// goes by, which no cause does.
fn behind_in_fast_turns(per_rate: f64, swing: f64) -> Case {
    let mut case = drawn(Kind::Differential, Hidden::Nothing, 4, 60.0, 21).case;
    for drive in &mut case.recordings {
        let before = drive.pose.clone();
        let mut added = 0.0_f64;
        for row in 1..before.len() {
            let [a, b] = [before[row - 1], before[row]];
            let (turned, dt) = (b[2] - a[2], drive.time[row] - drive.time[row - 1]);
            let (sin, cos) = added.sin_cos();
            let (x, y) = (b[0] - a[0], b[1] - a[1]);
            added -= turned * (per_rate * (turned / dt).abs().min(1.0) + swing * (0.3 * drive.time[row]).sin());
            let from = drive.pose[row - 1];
            drive.pose[row] = [from[0] + cos * x - sin * y, from[1] + sin * x + cos * y, b[2] + added];
        }
    }
    case
}

#[test]
fn a_little_slip_stands_only_where_drives_that_are_left_out_confirm_it() {
    let named = |findings: &Findings| findings.named.iter().map(|c| c.spec.id).collect::<Vec<_>>();
    let after = |case: &Case| {
        let findings = diagnose(case, &|_| {}).expect("findings");
        let table = left_out(case, &findings, &|_| {}).expect("forecasts");
        (named(&findings), named(&findings.after(&table)))
    };
    let slip = vec!["slip_with_turning"];
    assert_eq!(after(&behind_in_fast_turns(0.012, 0.0)), (slip.clone(), slip.clone()));
    let mut case = behind_in_fast_turns(0.08, 0.05);
    assert_eq!(
        after(&case),
        (slip.clone(), vec![]),
        "what swings is as large: sessions do not agree that it is needed"
    );
    // One drive confirms nothing.
    case.recordings.truncate(1);
    assert_eq!(after(&case), (slip.clone(), vec![]));
    assert_eq!(after(&behind_in_fast_turns(0.06, 0.04)), (slip, vec![]), "with it nothing is forecast better");
}

/// A differential drive whose left wheel is so many times as large from an instant of each drive on, s from its start, where there is one.
fn smaller_from(factor: f64, from: &[Option<f64>]) -> Case {
    let mut case = drawn(Kind::Differential, Hidden::Nothing, from.len(), 60.0, 21).case;
    for (drive, from) in case.recordings.iter_mut().zip(from) {
        let start = drive.time[0];
        for (time, turns) in drive.time.iter().zip(&mut drive.turns) {
            if from.is_some_and(|from| time - start >= from) {
                turns[0] /= factor;
            }
        }
    }
    case
}

#[test]
fn a_wheel_that_shrinks_while_the_robot_drives_is_told_with_its_instants() {
    let told = |from: &[Option<f64>]| {
        let case = smaller_from(0.94, from);
        let findings = diagnose(&case, &|_| {}).expect("findings");
        let table = left_out(&case, &findings, &|_| {}).expect("forecasts");
        let out = findings.after(&table).named;
        assert_eq!(out.iter().map(|c| c.label.as_str()).collect::<Vec<_>>(), ["radius_of_one_wheel (left)"]);
        out.into_iter().next().expect("a cause")
    };
    let lost = |cause: &hierarchical_fit::NamedCause| 1.0 - cause.estimates[0].value / cause.estimates[0].given;

    let once = told(&[None, Some(31.0), Some(0.0), Some(0.0)]);
    assert!((lost(&once) - 0.06).abs() < 0.006, "{:?}", once.estimates);
    assert_eq!(once.intervals.len(), 3, "{:?}", once.intervals);
    let began = once.onset.as_ref().expect("an onset");
    let (at, [least, most]) = began.at.expect("within the second drive");
    assert!((at - 31.0).abs() < 1.5 && least < 31.5 && most > 30.5, "{at} [{least}, {most}]");

    let anew = told(&[Some(31.0), Some(22.0), Some(31.0), Some(40.0)]);
    assert!((lost(&anew) - 0.06).abs() < 0.006, "{:?}", anew.estimates);
    let starts: Vec<f64> = anew.intervals.iter().map(|(_, [from, _])| *from).collect();
    assert_eq!(starts.len(), 4, "{:?}", anew.intervals);
    for (start, truth) in starts.iter().zip([31.0, 22.0, 31.0, 40.0]) {
        assert!((start - truth).abs() < 1.5, "{starts:?}");
    }
    assert_eq!(anew.onset.map(|began| began.anew.len()), Some(3));
}
