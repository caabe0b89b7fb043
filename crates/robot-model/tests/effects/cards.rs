//! Cards: complete, consistent, and named after their files.

use std::collections::BTreeSet;
use std::path::Path;

use robot_model::effect::{MAX_PARAMETERS, Scale};
use robot_model::{Role, effects};

#[test]
fn ids_are_unique_and_equal_to_the_file_names() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/effects");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder of the effects")
        .map(|f| f.expect("readable").path().file_stem().expect("a file").to_string_lossy().into_owned())
        .collect();
    let ids: Vec<&str> = effects::catalogue::<f64>().map(|e| e.card().id).to_vec();
    assert_eq!(ids, files.iter().map(String::as_str).collect::<Vec<_>>());
    let names: BTreeSet<&str> = effects::catalogue::<f64>().map(|e| e.card().name).into();
    assert_eq!(names.len(), ids.len(), "names for people must differ too");
}

#[test]
fn cards_are_sane() {
    let units = ["-", "m", "s", "rad", "rad/s", "kg", "N", "N m", "N m s/rad", "N s²/m²", "m/s²", "1/(N m)"];
    for effect in effects::catalogue::<f64>() {
        let card = effect.card();
        let id = card.id;
        for (what, text) in [
            ("name", card.name),
            ("law", card.law),
            ("seen", card.seen),
            ("revealed_by", card.revealed_by),
            ("resembles", card.resembles),
            ("source", card.source),
        ] {
            assert!(!text.trim().is_empty(), "{id}: {what} is empty");
        }
        assert!(card.interest.is_finite() && card.interest >= 0.0, "{id}: interest");
        assert!([0.0, 3.0, 6.0].contains(&card.rarity), "{id}: rarity");
        let strengths = card.strengths().count();
        assert!(strengths > 0 && card.parameters.len() <= MAX_PARAMETERS, "{id}: number of parameters");
        assert!(card.axes.is_empty() || card.axes.len() == strengths, "{id}: one axis for each strength");
        assert!(card.wears.everywhere || card.wears.onset || card.wears.disc || card.wears.side, "{id}: worn nowhere");
        for p in card.parameters {
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
                    assert!(!card.signed || low < 0.0 && high > 0.0, "{id}: bounds of a signed strength");
                    assert!(card.interest <= 4.0 * p.probes[0].abs(), "{id}: a probe far too small to be of interest");
                }
                Role::Shaped => assert!(!p.probes.is_empty(), "{id}: {name} has no probe"),
                Role::Shape => assert!(!p.probes.is_empty(), "{id}: {name} has no usual value to probe"),
            }
        }
    }
}
