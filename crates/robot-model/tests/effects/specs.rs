//! Specifications: complete, consistent, and named after their files.

use std::collections::BTreeSet;
use std::path::Path;

use robot_model::effect::{MAX_PARAMETERS, Scale, SizedBy};
use robot_model::{EffectSpec, Parameter, Robot, Role, effects};

#[test]
fn ids_are_unique_and_equal_to_the_file_names() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/effects");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder of the effects")
        .map(|f| f.expect("readable").path().file_stem().expect("a file").to_string_lossy().into_owned())
        .collect();
    let ids: Vec<&str> = effects::catalogue::<f64>().map(|e| e.spec().id).to_vec();
    assert_eq!(ids, files.iter().map(String::as_str).collect::<Vec<_>>());
    let names: BTreeSet<&str> = effects::catalogue::<f64>().map(|e| e.spec().name).into();
    assert_eq!(names.len(), ids.len(), "names for people must differ too");
}

#[test]
fn specifications_are_sane() {
    for effect in effects::catalogue::<f64>() {
        is_sound(effect.spec());
    }
}

/// Panics where a specification is incomplete or contradicts itself.
pub(crate) fn is_sound(spec: &EffectSpec) {
    let of_size = ["m", "kg", "N", "N m", "N m s/rad", "N s²/m²", "1/(N m)"];
    let grows = |p: &&Parameter| p.role != Role::Shape && p.scale == Scale::Own && of_size.contains(&p.unit);
    let by_itself = spec.sized_by == SizedBy::Itself;
    assert_eq!(spec.parameters.iter().find(grows).is_none(), by_itself, "{}: its size grows with the robot", spec.id);
    let units = ["-", "m", "1/m", "s", "rad", "rad/s", "kg", "N", "N m", "N m s/rad", "N s²/m²", "m/s²", "1/(N m)"];
    let id = spec.id;
    for (what, text) in [
        ("name", spec.name),
        ("law", spec.law),
        ("seen", spec.seen),
        ("revealed_by", spec.revealed_by),
        ("resembles", spec.resembles),
        ("source", spec.source),
    ] {
        assert!(!text.trim().is_empty(), "{id}: {what} is empty");
    }
    assert!(spec.interest.is_finite() && spec.interest >= 0.0, "{id}: interest");
    assert!([0.0, 3.0, 6.0].contains(&spec.rarity), "{id}: rarity");
    let strengths = spec.strengths().count();
    assert!(strengths > 0 && spec.parameters.len() <= MAX_PARAMETERS, "{id}: number of parameters");
    assert!(spec.axes.is_empty() || spec.axes.len() == strengths, "{id}: one axis for each strength");
    assert!(
        spec.scopes.everywhere || spec.scopes.onset || spec.scopes.disc || spec.scopes.side,
        "{id}: present nowhere"
    );
    for p in spec.parameters {
        let (name, [low, high]) = (p.name, p.bounds);
        assert!(!name.is_empty() && units.contains(&p.unit), "{id}: unit {:?} of {name}", p.unit);
        assert!(low.is_finite() && high.is_finite() && low < high, "{id}: bounds of {name}");
        assert!((low..=high).contains(&p.neutral), "{id}: neutral value of {name} is outside its bounds");
        assert!(p.probes.iter().all(|x| x.is_finite() && *x != 0.0), "{id}: probes of {name}");
        if p.scale == Scale::Own {
            assert!(p.probes.iter().all(|x| (low..=high).contains(x)), "{id}: probes of {name} out of bounds");
        }
        match p.role {
            Role::Strength => {
                assert_eq!(p.probes.len(), 1, "{id}: a strength has one probe");
                assert_eq!(p.neutral, 0.0, "{id}: a strength is neutral at zero");
                assert!(!spec.signed || low < 0.0 && high > 0.0, "{id}: bounds of a signed strength");
                assert!(spec.interest <= 4.0 * p.probes[0].abs(), "{id}: a probe far too small to be of interest");
            }
            Role::Shaped => assert!(!p.probes.is_empty(), "{id}: {name} has no probe"),
            Role::Shape => assert!(!p.probes.is_empty(), "{id}: {name} has no usual value to probe"),
        }
    }
}

#[test]
fn sizes_grow_with_the_robot() {
    let [mass, half_wheelbase, wheel_radius, gravity] = SizedBy::REFERENCE;
    let robot = |k: f64| Robot {
        mass: k * mass,
        half_wheelbase: k * half_wheelbase,
        wheel_radius: k * wheel_radius,
        gravity,
        ..crate::common::robot()
    };
    for (of, power) in [
        (SizedBy::Itself, 0),
        (SizedBy::Mass, 1),
        (SizedBy::Weight, 1),
        (SizedBy::Traction, 2),
        (SizedBy::TractionPerSpeed, 3),
        (SizedBy::PerTraction, -2),
        (SizedBy::Wheelbase, 1),
        (SizedBy::WheelRadius, 1),
    ] {
        for k in [1.0, 2.0_f64] {
            let expected = k.powi(power);
            assert!((of.factor(&robot(k)) / expected - 1.0).abs() < 1e-12, "{of:?}");
        }
    }
}
