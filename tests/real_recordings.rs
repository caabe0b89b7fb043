//! Real recordings: a Husky A200 on labelled ground, and a development case of the blind examiner.
//!
//! These data lie beside the repository; without them the tests are ignored.

use speed_driven::diagnose_steady;
use std::process::Command;
use verdict::{Diagnosis, Verdict};
use verdict::{Quantity, Ratio};

use case_files::case_folder::{self, CaseFolder};
use inference::Options;
use recordings::ReadOptions;
use skipping::{Outcome, Skipped, beside};
use torque_driven::diagnose;

/// The Husky's runs on a ground against those on the floor of a building.
fn husky(ground: &str) -> Result<Diagnosis, Skipped> {
    let data = beside("data/husky-open")?;
    let mapping = case_folder::mapping("husky-open").expect("built in");
    let robot = case_folder::robot("husky-a200").expect("built in");
    let paths = [vec![data.join("FLOORING")], vec![data.join(ground)], vec![]];
    let case = CaseFolder::from_paths(robot, [&paths[0], &paths[1], &paths[2]], &mapping, &ReadOptions::default());
    let case = case.expect("readable").speed_driven().expect("speeds and currents");
    Ok(diagnose_steady(&case, &Options::default(), &|_| {}).expect("a diagnosis"))
}

fn pooled(d: &Diagnosis, quantity: Quantity) -> &Ratio {
    let loads = d.steady.as_ref().expect("loads");
    loads.pooled.iter().find(|r| r.quantity == quantity).expect("pooled")
}

fn told(d: &Diagnosis) -> String {
    let causes: Vec<String> = d.ranked.iter().take(6).map(|c| format!("{} {:.3}", c.effect, c.probability)).collect();
    format!("{:?}: {}; classes {:?}", d.verdict, causes.join(", "), d.indistinguishable)
}

/// What these data's defects do to any answer.
fn tells_its_limits(d: &Diagnosis) {
    let limits = d.limits.join("\n");
    for part in ["set-points", "no sign", "dead band", "another clock"] {
        assert!(limits.contains(part), "no `{part}` in: {limits}");
    }
    assert!(!d.steady.as_ref().expect("loads").withheld.is_empty());
}

fn sandy_loam_loads_straight_driving() -> Outcome {
    let d = husky("SANDY_LOAM")?;
    let straight = pooled(&d, Quantity::StraightLoad);
    assert!((straight.ratio - 2.05).abs() <= 0.25, "{straight:?}");
    let [low, high] = straight.interval;
    assert!(low >= 0.8 * straight.ratio && high <= 1.2 * straight.ratio, "{straight:?}");
    assert_eq!(d.verdict, Verdict::Explained, "{}", told(&d));
    // The track is longer where straight driving takes more: soft ground, or rolling resistance by another law. One slope
    // for drives at several places is not weighed.
    let class = d.indistinguishable.first().expect("a class");
    assert!(class.len() <= 3 && !class.iter().any(|c| c == "grade"), "{}", told(&d));
    for id in ["soft_ground", "rolling_resistance"] {
        assert!(class.iter().any(|c| c == id), "{}", told(&d));
    }
    tells_its_limits(&d);
    Ok(())
}

fn asphalt_loads_turning() -> Outcome {
    let d = husky("ASPHALT")?;
    let loads = d.steady.as_ref().expect("loads");
    let turning: Vec<&Ratio> = loads.ratios.iter().filter(|r| r.quantity == Quantity::TurningLoad).collect();
    assert!(!turning.is_empty());
    for r in &turning {
        assert!((r.ratio - 1.6).abs() <= 0.35 && r.interval[0] > 1.0, "{r:?}");
    }
    let fast: Vec<&Ratio> = loads
        .ratios
        .iter()
        .filter(|r| r.quantity == Quantity::StraightLoad && (r.speed[0] - 0.79).abs() < 0.05)
        .collect();
    assert!(!fast.is_empty());
    for r in &fast {
        assert!((0.9..=1.2).contains(&r.ratio), "{r:?}");
    }
    let named = d.ranked.first().expect("a cause");
    assert_ne!(named.effect, "viscous_friction", "{}", told(&d));
    assert!(!d.indistinguishable.iter().flatten().any(|id| id == "viscous_friction"), "{}", told(&d));
    tells_its_limits(&d);
    Ok(())
}

fn a_development_case_of_the_blind_examiner_names_its_payload() -> Outcome {
    let archive = beside("blind/dev/cases/d06.tar.gz")?;
    let folder = tempfile::tempdir().expect("a folder");
    let unpacked = Command::new("tar").arg("-xzf").arg(&archive).arg("-C").arg(folder.path()).status();
    if !unpacked.is_ok_and(|s| s.success()) {
        return Err(Skipped::because(format!("`tar` cannot unpack {}", archive.display())));
    }
    let mapping = case_folder::mapping("skid-steer-columns").expect("built in");
    let case = CaseFolder::open(&folder.path().join("d06"), None, &mapping, &ReadOptions::default());
    let case = case.expect("readable");
    assert_eq!(case.lost(), Vec::<String>::new());
    let d = diagnose(&case.torque_driven().expect("signals"), &Options::default(), &|_| {}).expect("a diagnosis");
    assert_eq!(d.verdict, Verdict::Explained, "{}", told(&d));
    assert_eq!(d.ranked[0].effect, "payload", "{}", told(&d));
    assert!(d.ranked[0].magnitude.is_some_and(|kg| kg > 0.0), "{:?}", d.ranked[0]);
    assert_eq!(d.predictions.len(), case.held_out.reads.len());
    Ok(())
}

skipping::tests![
    sandy_loam_loads_straight_driving,
    asphalt_loads_turning,
    a_development_case_of_the_blind_examiner_names_its_payload,
];
