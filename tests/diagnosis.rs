//! Whole diagnoses of blind cases: drawn by the examiner's plant, read as files, diagnosed, compared with the truth.

use std::path::Path;

use diagnosis::{Case, Diagnosis, HeldOut, Options, Prediction, Run, Verdict, diagnose};
use examiner::{Content, DrawnCase, EffectId, Outsider, Setting, Settings, Severity, TyreLaw};
use lacuna::RobotSpec;
use recordings::{Input, Mapping, Policy, ReadOptions, Recording, read};

fn draw(content: Content, seed: u64, duration_s: f64) -> DrawnCase {
    let settings = Settings {
        content,
        severity: Some(Severity::Strong),
        setting: Some(Setting::Normal),
        law: Some(TyreLaw::Brush),
        recordings: Some(3),
        heldout: 1,
        duration_s,
        ..Settings::default()
    };
    examiner::Case::draw("x", seed, &settings).expect("sensible settings")
}

/// The recordings below a folder of a drawn case, read strictly.
fn recordings_of(drawn: &DrawnCase, folder: &str) -> Vec<Recording> {
    let mapping = Mapping::built_in("skid-steer-columns").expect("built in");
    let options = ReadOptions { policy: Policy::Strict };
    let files = drawn.files.iter().filter(|(path, _)| path.starts_with(folder));
    files
        .map(|(path, bytes)| {
            let stem = path.file_stem().and_then(|s| s.to_str()).expect("a name");
            let name = path.to_str().expect("text");
            let read = read(&mapping, stem, &[Input { name, bytes }], &options).expect("readable");
            assert!(read.losses.is_empty(), "{:?}", read.losses);
            read.recording
        })
        .collect()
}

fn case_of(drawn: &DrawnCase) -> Case {
    let (_, robot) = drawn.files.iter().find(|(p, _)| p == Path::new("robot.json")).expect("a robot file");
    let robot = RobotSpec::parse("robot.json", std::str::from_utf8(robot).expect("text")).expect("a robot");
    let runs = |folder| recordings_of(drawn, folder).iter().map(|r| Run::new(r).expect("a run")).collect::<Vec<_>>();
    Case {
        robot: robot.robot,
        sigma: robot.sigma,
        pose_sigma: robot.pose_sigma,
        references: runs("reference"),
        recordings: runs("recordings"),
        held_out: recordings_of(drawn, "heldout").iter().map(|r| HeldOut::new(r).expect("inputs")).collect(),
    }
}

fn answer(content: Content, seed: u64) -> (DrawnCase, Diagnosis) {
    let drawn = draw(content, seed, 24.0);
    let out = diagnose(&case_of(&drawn), &Options::default(), &|_| {}).expect("a diagnosis");
    for c in &out.ranked {
        assert!((0.0..=1.0).contains(&c.probability), "{c:?}");
    }
    assert!(!out.sentences.is_empty());
    (drawn, out)
}

fn told(d: &Diagnosis) -> String {
    let causes: Vec<String> = d.ranked.iter().take(5).map(|c| format!("{} {:.3}", c.effect, c.probability)).collect();
    let trials: Vec<String> = d.trials.iter().take(4).map(|t| format!("{:?} {:.0}", t.hypothesis, t.score)).collect();
    format!("{:?}: {}; {}; costs {:.0?}", d.verdict, causes.join(", "), trials.join(", "), d.costs)
}

/// The first cause is the only effect that was hidden, with its size.
fn names(effect: EffectId, seed: u64, tolerance: f64) -> (DrawnCase, Diagnosis) {
    let (drawn, d) = answer(Content::Effects(vec![effect]), seed);
    assert_eq!(d.verdict, Verdict::Explained, "{}", told(&d));
    assert_eq!(d.ranked[0].effect, effect.id(), "{}", told(&d));
    assert!(d.ranked[0].probability > 0.5, "{}", told(&d));
    let (found, truth) = (d.ranked[0].magnitude.expect("a size"), drawn.truth.effects[0].magnitude);
    assert!((found / truth - 1.0).abs() < tolerance, "found {found}, truth {truth}");
    (drawn, d)
}

/// Rms error of predicted wheel speeds (rad/s) and yaw rate (rad/s) against the true response.
fn errors(drawn: &DrawnCase, p: &Prediction) -> [f64; 2] {
    let file = format!("heldout/{}.csv", p.name);
    let (_, bytes) = drawn.truth_files.iter().find(|(path, _)| path == Path::new(&file)).expect("a true response");
    let text = std::str::from_utf8(bytes).expect("text");
    let (mut wheel, mut yaw, mut n) = (0.0, 0.0, 0.0);
    for (k, line) in text.lines().skip(1).enumerate() {
        let v: Vec<f64> = line.split(',').map(|c| c.parse().expect("a number")).collect();
        assert!((v[0] - p.time[k]).abs() < 1e-6);
        wheel += 0.5 * ((v[1] - p.wheel_speed[k][0]).powi(2) + (v[2] - p.wheel_speed[k][1]).powi(2));
        yaw += (v[3] - p.yaw_rate[k]).powi(2);
        n += 1.0;
    }
    assert!(n > 1000.0);
    [(wheel / n).sqrt(), (yaw / n).sqrt()]
}

#[test]
fn nothing_hidden_is_no_mismatch() {
    let (_, d) = answer(Content::Null, 2);
    assert_eq!(d.verdict, Verdict::NoMismatch, "{}", told(&d));
    assert_eq!(d.ranked[0].effect, "none", "{}", told(&d));
}

#[test]
fn viscous_friction_is_named_and_improves_what_was_not_fitted() {
    let (drawn, d) = names(EffectId::ViscousFriction, 3, 0.15);
    let (corrected, plain) = &d.predictions[0];
    let (corrected, plain) = (errors(&drawn, corrected), errors(&drawn, plain));
    assert!(corrected[0] < 0.5 * plain[0], "wheel speed: corrected {corrected:?}, plain {plain:?}");
    assert!(corrected[1] < plain[1], "yaw rate: corrected {corrected:?}, plain {plain:?}");
    // The same on recordings that were left out one at a time.
    assert_eq!(d.free_runs.len(), 2 * 3);
    for f in d.free_runs.iter().filter(|f| f.quantity.starts_with("wheel")) {
        assert!(f.corrected < f.retuned && f.retuned < f.nominal, "{f:?}");
    }
    assert!(d.unexplained.is_some_and(|u| u < 0.2), "{:?}", d.unexplained);
}

#[test]
fn payload_is_named_and_improves_what_was_not_fitted() {
    let (drawn, d) = names(EffectId::Payload, 5, 0.15);
    let (corrected, plain) = &d.predictions[0];
    let (corrected, plain) = (errors(&drawn, corrected), errors(&drawn, plain));
    assert!(corrected[0] < 0.5 * plain[0], "wheel speed: corrected {corrected:?}, plain {plain:?}");
}

#[test]
fn a_gyro_bias_is_a_fault_of_the_sensor_and_not_of_the_physics() {
    let (drawn, d) = names(EffectId::GyroBias, 2, 0.25);
    let second = d.ranked.iter().find(|c| !["gyro_bias", "none", "unknown"].contains(&c.effect.as_str()));
    assert!(second.is_none_or(|c| c.probability < 0.5), "{}", told(&d));
    let (corrected, plain) = &d.predictions[0];
    let (corrected, plain) = (errors(&drawn, corrected), errors(&drawn, plain));
    assert!(corrected[1] < plain[1], "yaw rate: corrected {corrected:?}, plain {plain:?}");
}

#[test]
fn what_is_not_in_the_catalogue_is_unknown() {
    let (_, d) = answer(Content::Outsider(Outsider::Cogging), 13);
    assert_eq!(d.verdict, Verdict::Unknown, "{}", told(&d));
}

#[test]
fn both_of_a_pair_are_named() {
    let pair = [EffectId::Payload, EffectId::CoulombSide];
    let (drawn, d) = answer(Content::Effects(pair.to_vec()), 17);
    assert_eq!(d.verdict, Verdict::Explained, "{}", told(&d));
    let first: Vec<&str> = d.ranked.iter().take(2).map(|c| c.effect.as_str()).collect();
    for (effect, truth) in pair.iter().zip(&drawn.truth.effects) {
        assert!(first.contains(&effect.id().as_str()), "{}", told(&d));
        let found = d.ranked.iter().find(|c| c.effect == truth.id).expect("named");
        assert_eq!(found.side.map(str::to_owned), truth.side, "{}", told(&d));
    }
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let case = case_of(&draw(Content::Effects(vec![EffectId::ConstantPull]), 19, 9.0));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| diagnose(&case, &Options::default(), &|_| {}).expect("a diagnosis"))
    };
    let (one, two) = (on(1), on(2));
    assert_eq!(one.verdict, two.verdict);
    assert_eq!(one.ranked, two.ranked);
    assert_eq!(one.trials, two.trials);
    assert_eq!(one.costs, two.costs);
    assert_eq!(one.predictions, two.predictions);
}
