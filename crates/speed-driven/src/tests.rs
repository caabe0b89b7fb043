//! Whole diagnoses: what leads the answer, and that nothing below contradicts it.

use verdict::{Diagnosis, GroundSlope, Loads, Quantity, Ratio, Verdict};

use inference::Options;
use inference::robust::NINETY;
use robot_model::tunable::tunables;

use crate::run::SpeedRun;
use crate::testing::{Leg, case, diagnosis, diagnosis_with, drive, levelled, robot, rounds};
use crate::{SteadyCase, diagnose_steady};

fn ratio(d: &Diagnosis, quantity: Quantity) -> &Ratio {
    let loads = d.steady.as_ref().expect("loads");
    loads.ratios.iter().find(|r| r.quantity == quantity).expect("a ratio")
}

fn is_alike(r: &Ratio) -> bool {
    r.interval[0] <= 1.0 && 1.0 <= r.interval[1]
}

#[test]
fn the_references_drive_again_is_no_mismatch() {
    let d = diagnosis(&[&rounds(3)]);
    assert_eq!(d.verdict, Verdict::NoMismatch, "{:?}", d.sentences);
    assert!(d.sentences[0].starts_with("No mismatch"), "{:?}", d.sentences);
}

#[test]
fn a_body_that_stands_leads_the_answer_and_its_rows_touch_nothing_else() {
    let stuck = Leg { scrub: 60.0, turned: 0.05, ..Leg::turn(20.0) };
    let d = diagnosis(&[&[rounds(3), vec![stuck], rounds(1)].concat()]);
    assert_eq!((d.verdict, d.ranked[0].effect.as_str()), (Verdict::Explained, "standing"), "{:?}", d.ranked);
    assert!(d.sentences[0].starts_with("Standing: in recording 0 from 120."), "{:?}", d.sentences);
    assert!(d.ranked.iter().all(|c| c.effect != "none" || c.probability < 0.02), "{:?}", d.ranked);
    for quantity in [Quantity::StraightLoad, Quantity::TurningLoad, Quantity::EffectiveTrack] {
        assert!(is_alike(ratio(&d, quantity)), "{:?}", ratio(&d, quantity));
    }
    let loads = d.steady.expect("loads");
    assert_eq!(loads.turning_changes, []);
    // Forecasts of what moves are no worse for it.
    for f in loads.forecasts {
        assert!(f.corrected < f.retuned, "{f:?}");
    }
}

/// No headline says that nothing is wrong above a sentence that reports a difference.
fn agrees_with_itself(d: &Diagnosis) {
    let nothing = d.sentences[0].starts_with("No mismatch") || d.verdict == Verdict::NoMismatch;
    let differs = |s: &String| s.contains(": it differs.") || s.contains("Cause: ") || s.contains("times the torque");
    assert!(!nothing || !d.sentences.iter().any(differs), "{:?}", d.sentences);
}

#[test]
fn another_track_is_a_difference_though_the_loads_are_alike() {
    let slides: Vec<Leg> = rounds(3).into_iter().map(|leg| Leg { turned: 0.8, ..leg }).collect();
    let d = diagnosis(&[&slides]);
    assert_eq!(d.verdict, Verdict::Explained, "{:?}", d.sentences);
    assert!(d.sentences[0].starts_with("Difference: in recording 0 the effective track is 0.9"), "{:?}", d.sentences);
    assert!(d.sentences.iter().any(|s| s.starts_with("The body turns by 20 % less")), "{:?}", d.sentences);
    assert_eq!(d.ranked[0].effect, "effective_track", "{:?}", d.ranked);
    assert_eq!(d.indistinguishable, [["effective_track", "soft_ground", "gyro_scale"]]);
    agrees_with_itself(&d);
}

#[test]
fn a_load_of_a_few_seconds_counts_only_far_beyond_its_interval() {
    let slides: Vec<Leg> = rounds(3).into_iter().map(|leg| Leg { turned: 0.8, ..leg }).collect();
    let mut loads = diagnosis(&[&slides]).steady.expect("loads");
    let one = crate::found::strongest(&loads)[0].clone();
    let of = |firm: bool, interval: [f64; 2]| vec![verdict::Ratio { firm, interval, ratio: 1.2, ..one.clone() }];
    let (near, far) = ([1.05, 1.37], [1.15, 1.25]);
    loads.pooled = Vec::new();
    for (firm, interval, counts) in [(true, near, true), (false, near, false), (false, far, true)] {
        loads.ratios = of(firm, interval);
        assert_eq!(!crate::found::strongest(&loads).is_empty(), counts, "{firm} {interval:?}");
    }
}

#[test]
fn without_references_a_track_is_as_unsure_as_the_file_says_of_radius_and_track() {
    let width = |sigma: f64| {
        let case = SteadyCase {
            robot: robot(),
            sigma: tunables::<f64>().map(|constant| constant.sigma),
            torque_sigma: 0.1,
            geometry_sigma: [sigma, 0.0],
            references: Vec::new(),
            recordings: vec![drive(&rounds(3), false)],
        };
        let d = diagnose_steady(&case, &Options::default(), &|_| {}).expect("a diagnosis");
        let [low, high] = ratio(&d, Quantity::EffectiveTrack).interval;
        (high / low).ln() / (2.0 * NINETY)
    };
    let (sure, unsure) = (width(1e-6), width(0.03));
    assert!((unsure * unsure - sure * sure - 0.03 * 0.03).abs() < 1e-5, "{sure} {unsure}");
}

#[test]
fn a_slope_beside_loads_that_nothing_explains_leaves_these_unknown_and_is_one_class() {
    let mut d = diagnosis(&[&rounds(3)]);
    let slope = GroundSlope { slope: 3.0, half: 0.5, ratios: [0.5, 1.5], stretches: 8, is_level: false };
    let loads = Loads { slope: Some(slope), ..d.steady.take().expect("loads") };
    d.indistinguishable = vec![vec!["grade".to_owned()]];
    for before in [Verdict::Unknown, Verdict::Explained] {
        d.verdict = before;
        crate::found::add(&mut d, None, &loads);
        assert_eq!((d.verdict, d.ranked[0].effect.as_str()), (before, "grade"));
        assert_eq!(d.indistinguishable, [["grade"]]);
    }
}

#[test]
fn recordings_of_two_grounds_are_told_to_disagree_and_those_of_one_are_not() {
    let on = |times: f64| -> Vec<Leg> {
        let other = |leg: Leg| Leg { straight: times * leg.straight, scrub: times * leg.scrub, ..leg };
        rounds(3).into_iter().map(other).collect()
    };
    let d = diagnosis(&[&on(1.0), &on(2.2)]);
    assert!(matches!(d.verdict, Verdict::Explained | Verdict::Unknown), "{:?}", d.sentences);
    let [first, usual, other, together, ..] = &d.sentences[..] else { panic!("{:?}", d.sentences) };
    assert!(first.starts_with("The recordings disagree: the straight load is 1.0"), "{first}");
    assert!(first.contains(" in recording 0 and 2.") && first.contains(" times in recording 1, more than"), "{first}");
    assert_eq!(usual, "Recording 0 alone: no load differs from that of the references.");
    assert!(other.starts_with("Recording 1 alone: what fits these loads best is "), "{other}");
    assert!(together.starts_with("All recordings together: "), "{together}");
    agrees_with_itself(&d);
    let groups = |d: &Diagnosis| d.steady.as_ref().map(|loads| loads.groups.clone()).unwrap_or_default();
    // All its loads are 2.2 times as large.
    assert_eq!(groups(&d)[1].causes.first().map(String::as_str), Some("torque_constant"));

    // Each is named as if it had been recorded with those that agree with it, and no others.
    let mixed = groups(&diagnosis(&[&on(2.2), &on(1.0), &on(2.1)]));
    let of: Vec<Vec<String>> = mixed.iter().map(|g| g.recordings.clone()).collect();
    assert_eq!(of, [vec!["1"], vec!["0", "2"]]);
    assert_eq!(mixed.iter().map(|g| g.differs).collect::<Vec<_>>(), [false, true]);

    let alike = diagnosis(&[&on(2.2), &on(2.1)]);
    assert!(alike.sentences.iter().all(|s| !s.contains("disagree")), "{:?}", alike.sentences);
    assert_eq!(groups(&alike), []);
}

#[test]
fn a_motor_of_one_side_that_gives_less_is_told_by_the_spins() {
    let spin = |way: f64| Leg { speed: [-0.24 * way, 0.24 * way], ..Leg::straight(12.0) };
    let legs = [Leg::straight(20.0), spin(1.0), Leg::straight(20.0), spin(-1.0)].repeat(3);
    // The left motor needs a third more current for the same torque.
    let weak: Vec<Leg> = legs.iter().map(|leg| Leg { sides: [4.0 / 3.0, 1.0], ..*leg }).collect();
    let drives = |legs: &[Leg]| [0, 1].map(|k| SpeedRun { name: k.to_string(), ..drive(legs, false) }).to_vec();
    let case = case(drives(&legs), drives(&weak));
    let d = diagnose_steady(&case, &Options::default(), &|_| ()).expect("an answer");
    let spins = ratio(&d, Quantity::SpinAsymmetry);
    assert!((spins.ratio + 1.0 / 7.0).abs() < 0.03 && spins.interval[1] < 0.0, "{spins:?}");
    let named = &d.indistinguishable[0];
    assert!(named.iter().any(|id| id == "torque_constant_side"), "{:?}", d.ranked);
}

#[test]
fn a_drag_on_one_side_is_one_cause_though_turns_to_either_side_show_another_load() {
    let to = |turn: Leg| -> Vec<Leg> { [Leg::straight(12.0), turn].into_iter().cycle().take(16).collect() };
    // The right side takes 9 N m more in the direction of travel: the outer one in turns to the left.
    let dragged = |name: &str, legs: &[Leg]| {
        let mut run = SpeedRun { name: name.to_owned(), ..drive(legs, false) };
        let braked = |t: f64| if t > 0.0 { t + 9.0 } else { 0.0 };
        run.torque[1] = run.torque[1].iter().map(|t| braked(*t)).collect();
        run
    };
    let recordings = vec![dragged("left", &to(Leg::turn(8.0))), dragged("right", &to(Leg::right(8.0)))];
    let case = crate::testing::case(vec![drive(&rounds(3), false)], recordings);
    let d = diagnose_steady(&case, &Options::default(), &|_| {}).expect("a diagnosis");
    assert!(d.sentences[0].starts_with("Missing: "), "{:?}", d.sentences);
    assert!(d.sentences[0].contains("right by "), "{:?}", d.sentences);
    let told = "Recordings differ from one another, which the cause that is named first explains: the turning load is";
    assert!(d.sentences.iter().any(|s| s.starts_with(told)), "{:?}", d.sentences);
    let loads = d.steady.as_ref().expect("loads");
    assert!(loads.agree_by_cause && loads.groups.is_empty(), "{:?}", loads.groups);
    agrees_with_itself(&d);
}

#[test]
fn the_verdict_never_contradicts_a_sentence() {
    for (scrub, straight) in
        [(20.0, 1.0), (23.0, 1.0), (26.0, 1.0), (32.0, 1.0), (14.0, 1.0), (20.0, 1.6), (20.0, 3.0), (10.0, 0.6)]
    {
        let other = |leg: Leg| Leg { scrub, straight: straight * leg.straight, ..leg };
        let d = diagnosis(&[&rounds(3).into_iter().map(other).collect::<Vec<_>>()]);
        agrees_with_itself(&d);
        let none = d.ranked.iter().find(|c| c.effect == "none").map_or(0.0, |c| c.probability);
        assert!(d.verdict == Verdict::NoMismatch || none <= 0.1, "{scrub} {straight}: {:?}", d.ranked);
    }
}

#[test]
fn a_slope_inside_a_recording_is_a_change_and_no_quiet_verdict() {
    let d = diagnosis(&[&[rounds(2), vec![Leg::straight(15.0).slope(5.0), Leg::straight(20.0)], rounds(2)].concat()]);
    agrees_with_itself(&d);
    assert_eq!(d.verdict, Verdict::Explained, "{:?}", d.sentences);
    assert!(d.sentences.iter().any(|s| s.contains("uphill")), "{:?}", d.sentences);
}

#[test]
fn a_slope_that_sensors_measure_is_a_cause_beside_a_load_that_differs() {
    // Turning takes more in all of the recording; nothing else says why.
    for scrub in [30.0, 60.0] {
        let dear = |leg: Leg| Leg { scrub, ..leg };
        let climb = vec![Leg::straight(15.0).slope(5.0), Leg::straight(20.0)];
        let legs = [rounds(3), climb, rounds(3)].concat().into_iter().map(dear).collect::<Vec<_>>();
        let d = diagnose_steady(
            &case(vec![drive(&rounds(3), true)], vec![levelled(&legs, 0.0)]),
            &Options::default(),
            &|_| {},
        )
        .expect("an answer");
        agrees_with_itself(&d);
        let slope = d.ranked.iter().find(|c| c.effect == "grade").expect("the slope");
        assert!(slope.probability > 0.8 && slope.intervals.is_some(), "{scrub}: {:?}", d.ranked);
        assert!(d.sentences.iter().take(6).any(|s| s.starts_with("Slope inside a recording")), "{:?}", d.sentences);
    }
}

#[test]
fn one_strong_number_is_no_unknown_cause() {
    // Turning only: no straight load stands beside the sum of both.
    for scrub in [45.0, 70.0, 110.0] {
        let turns = [Leg { scrub, ..Leg::turn(30.0) }, Leg { scrub, ..Leg::right(30.0) }];
        let d = diagnosis(&[&turns]);
        let unknown = d.ranked.iter().find(|c| c.effect == "unknown").expect("ranked");
        assert!(unknown.probability < 0.05, "{scrub}: {:?}", d.ranked);
        assert_eq!(d.verdict, Verdict::Explained, "{scrub}: {:?} {:?}", d.sentences, d.ranked);
    }
}

#[test]
fn another_ground_comes_before_another_robot() {
    // Everything takes more: the signature of mass and torque constant, and of soft ground.
    for factor in [1.6, 2.0] {
        let harder = |leg: Leg| Leg { scrub: factor * leg.scrub, straight: factor * leg.straight, ..leg };
        let d = diagnosis(&[&rounds(3).into_iter().map(harder).collect::<Vec<_>>()]);
        let probability = |id: &str| d.ranked.iter().find(|c| c.effect == id).map_or(0.0, |c| c.probability);
        let ground = probability("turning_resistance").max(probability("adhesion_patch"));
        let robot = probability("payload").max(probability("torque_constant"));
        assert!(ground > robot, "{factor}: {:?}", d.ranked);
    }
}

/// Rounds on another ground: straight load and scrub over the references', share of the yaw rate.
fn ground(straight: f64, scrub: f64, turned: f64) -> Vec<Leg> {
    let other = |leg: Leg| Leg { straight: straight * leg.straight, scrub: scrub * leg.scrub, turned, ..leg };
    rounds(3).into_iter().map(other).collect()
}

fn probability(d: &Diagnosis, id: &str) -> f64 {
    d.ranked.iter().find(|c| c.effect == id).map_or(0.0, |c| c.probability)
}

#[test]
fn ground_that_rolls_harder_and_turns_the_body_less_is_soft() {
    let soft = diagnosis(&[&ground(2.0, 0.9, 0.78)]);
    assert_eq!(
        (soft.verdict, soft.ranked[0].effect.as_str()),
        (Verdict::Explained, "soft_ground"),
        "{:?}",
        soft.ranked
    );
    assert!(soft.sentences[0].starts_with("Missing: soft ground"), "{:?}", soft.sentences);
    assert_eq!(soft.indistinguishable[0][0], "soft_ground");
    // The correction simulates it by the laws that make it up.
    assert!(soft.correction.effects.iter().any(|e| e.effect == "rolling_resistance"), "{:?}", soft.correction.effects);

    // With the references' track it is no more likely than rolling resistance of any ground.
    let hard = diagnosis(&[&ground(2.0, 1.0, 1.0)]);
    assert!(probability(&hard, "soft_ground") < probability(&hard, "rolling_resistance") + 0.05, "{:?}", hard.ranked);
    // Turning that costs more beyond the rolling is no soft ground.
    let rough = diagnosis(&[&ground(1.0, 2.0, 1.0)]);
    assert!(probability(&rough, "soft_ground") < 0.02, "{:?}", rough.ranked);
}

#[test]
fn a_robot_that_nobody_touched_has_no_other_mass_or_motors() {
    let (recording, same_robot) = (ground(1.8, 1.8, 1.0), Options { same_robot: true, ..Options::default() });
    let ids = |d: &Diagnosis| d.ranked.iter().filter(|c| catalogue::needs_a_hand(&c.effect)).count();
    assert!(ids(&diagnosis(&[&recording])) > 0);
    let same = diagnosis_with(&[&recording], &same_robot);
    assert_eq!(ids(&same), 0, "{:?}", same.ranked);
    assert_eq!(same.verdict, Verdict::Explained);
}

#[test]
fn drives_in_several_headings_or_places_share_no_slope() {
    let climb = [Leg { straight: 2.0 * crate::testing::STRAIGHT, ..Leg::straight(60.0) }];
    assert!(probability(&diagnosis(&[&climb]), "grade") > 0.0);
    assert_eq!(probability(&diagnosis(&[&climb, &climb]), "grade"), 0.0);
    assert_eq!(probability(&diagnosis(&[&ground(2.0, 1.0, 1.0)]), "grade"), 0.0);
}

#[test]
fn what_changes_inside_a_recording_is_no_load_of_the_whole() {
    let climb = Leg::straight(40.0).slope(6.0);
    let d = diagnosis(&[&[rounds(2), vec![climb, Leg::straight(12.0)], rounds(1)].concat()]);
    let straight = ratio(&d, Quantity::StraightLoad);
    assert!((straight.ratio - 1.0).abs() < 0.06, "{straight:?}");
    assert!(
        d.sentences[0].starts_with("Change inside a recording. Recording 0, from between 71."),
        "{:?}",
        d.sentences
    );
    assert!(d.ranked.iter().any(|c| c.effect == "grade" && c.intervals.is_some()), "{:?}", d.ranked);
}
