//! The catalogue holds together: names that are found, texts that say something, references that lead somewhere.

use std::collections::BTreeSet;

use catalogue::{
    answer, car, causes, command_driven, effects, find, names, odometry, of_load_term, speed_driven, wheeled,
};
use robot_model::effect::LoadTerm;

#[test]
fn every_name_is_there_once_and_is_found() {
    let all: Vec<&str> = names().collect();
    assert_eq!(all.len(), all.iter().collect::<BTreeSet<_>>().len(), "{all:?}");
    for name in all {
        let entry = find(name).unwrap_or_else(|| panic!("{name} is not found"));
        assert_eq!(entry.id, name);
        assert!(entry.effect.is_some() || entry.cause.is_some());
    }
    assert!(find("wind").is_none());
}

#[test]
fn three_causes_of_command_driven_robots_are_effects_of_the_plants_too() {
    let both = names().filter(|name| find(name).is_some_and(|e| e.effect.is_some() && e.cause.is_some()));
    assert_eq!(both.collect::<Vec<_>>(), ["motor_lag", "transport_delay", "wheel_radius_mismatch"]);
    let causes = command_driven::ALL.len() - 3
        + speed_driven::ALL.len()
        + odometry::ALL.len()
        + car::ALL.len()
        + wheeled::ALL.len();
    assert_eq!(names().count(), effects().count() + causes + answer::ALL.len());
}

#[test]
fn causes_are_specified_in_full() {
    for cause in causes() {
        for (what, text) in [
            ("name", cause.name),
            ("robots", cause.robots),
            ("meaning", cause.meaning),
            ("unit", cause.unit),
            ("recognised", cause.recognised),
            ("resembles", cause.resembles),
        ] {
            assert!(!text.trim().is_empty(), "{}: {what} is empty", cause.id);
        }
        let is_answer = answer::ALL.contains(&cause);
        assert_eq!(cause.size.is_empty(), is_answer, "{}: size", cause.id);
        assert_eq!(cause.revealed_by.is_empty(), is_answer, "{}: drive that reveals it", cause.id);
    }
}

#[test]
fn names_with_an_underscore_in_texts_are_names_of_the_catalogue() {
    let all = causes().flat_map(|c| [c.meaning, c.recognised, c.resembles]).chain(effects().map(|e| e.resembles));
    for text in all {
        let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        for word in words.filter(|word| word.contains('_')) {
            assert!(find(word).is_some(), "`{word}` in: {text}");
        }
    }
}

#[test]
fn every_term_of_the_load_has_its_one_effect() {
    use LoadTerm::{Drift, Pull, Rolling, Slope, Speed, Turning};
    for term in [Slope, Rolling, Turning, Speed, Drift, Pull] {
        assert_ne!(of_load_term(term), answer::UNKNOWN.id, "{term:?}");
        assert_eq!(effects().filter(|e| e.load_term == Some(term)).count(), 1, "{term:?}");
    }
}

#[test]
fn labels_are_names_for_people() {
    assert_eq!(catalogue::for_people("radius_of_one_wheel (left)"), "radius of one wheel (left)");
    assert_eq!(catalogue::for_people("clock_rate"), "clocks of counts and pose run at unlike rates");
    // What is a name already stays as it is.
    for entry in catalogue::names().filter_map(catalogue::find) {
        assert_eq!(catalogue::for_people(entry.label()), entry.label());
        assert_eq!(catalogue::for_people(&format!("{}: left", entry.label())), format!("{}: left", entry.label()));
    }
}
