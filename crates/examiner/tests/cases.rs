//! Forms of drawn cases, their determinism, and that every effect shows.

use std::collections::BTreeMap;

use examiner::{
    Again, Case, Content, Course, DrawnCase, EffectId, Manoeuvre, Mix, Outsider, Place, RobotClass, Setting, Settings,
    Severity, TyreLaw, set,
};

/// Settings of a short case.
fn short(content: Content) -> Settings {
    Settings {
        content,
        severity: Some(Severity::Strong),
        duration_s: 5.0,
        references: 1,
        recordings: Some(1),
        heldout: 1,
        least_excess: 0.0,
        law: Some(TyreLaw::Brush),
        setting: Some(Setting::Normal),
        ..Settings::default()
    }
}

fn draw(settings: &Settings) -> DrawnCase {
    Case::draw("x", 11, settings).unwrap()
}

fn table(case: &DrawnCase, path: &str) -> (Vec<String>, Vec<Vec<Option<f64>>>) {
    let all = case.files.iter().chain(&case.truth_files);
    let bytes = &all.clone().find(|(p, _)| p.ends_with(path)).unwrap().1;
    let text = std::str::from_utf8(bytes).unwrap();
    let mut lines = text.lines();
    let split = |l: &str| l.split(',').map(str::to_owned).collect::<Vec<_>>();
    let head = split(lines.next().unwrap());
    let rows = lines.map(|l| split(l).iter().map(|c| c.parse().ok()).collect());
    (head, rows.collect())
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_any_thread() {
    let plans = set(3, 4, Mix::default(), &short(Content::Null));
    let here: Vec<_> = plans.iter().map(|p| p.draw().unwrap()).collect();
    let threads: Vec<_> = plans.into_iter().rev().map(|p| std::thread::spawn(move || p.draw().unwrap())).collect();
    let there: Vec<_> = threads.into_iter().rev().map(|t| t.join().unwrap()).collect();
    assert!(here == there);
    assert!(here[0].files != here[1].files);
}

#[test]
fn files_have_the_form_that_the_readers_expect() {
    let case = draw(&short(Content::Null));
    let (head, rows) = table(&case, "recordings/run_1.csv");
    assert_eq!(head.len(), 13);
    assert_eq!((head[0].as_str(), head[12].as_str()), ("time_s", "pose_yaw_rad"));
    assert_eq!(rows.len(), 500);
    assert!(rows.iter().all(|r| r.len() == 13 && r[..7].iter().all(Option::is_some)));
    let count = |column: usize| rows.iter().filter(|r| r[column].is_some()).count();
    assert!((484..=486).contains(&count(7)), "{}", count(7));
    assert_eq!(count(7), count(9));
    assert!((48..=50).contains(&count(10)) && count(10) == count(12));
    assert_eq!((rows[0][1], rows[0][3]), (Some(0.0), Some(0.0)));
    for pair in rows.windows(2) {
        let moved = (pair[1][3].unwrap() - pair[0][3].unwrap()) / 0.01;
        assert!((moved - pair[1][1].unwrap()).abs() < 0.02);
    }
    let (head, rows) = table(&case, "heldout/held_1.csv");
    assert_eq!((head.len(), rows.len()), (13, 416));
    for (k, row) in rows.iter().enumerate() {
        let state = row[3..].iter().all(Option::is_some);
        let none = row[3..].iter().all(Option::is_none);
        assert!(if k % 200 == 0 { state } else { none }, "row {k}");
        assert!(row[..3].iter().all(Option::is_some));
    }
    let truth = case.truth_files.iter().find(|(p, _)| p.starts_with("heldout"));
    let text = std::str::from_utf8(&truth.unwrap().1).unwrap();
    assert_eq!(text.lines().count(), 417);
    assert!(text.starts_with("time_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,yaw_rate_rad_s"));
}

#[test]
fn the_truth_has_what_the_scorer_reads() {
    let case = draw(&short(Content::Effects(vec![EffectId::Payload, EffectId::Grade])));
    let truth: serde_json::Value = serde_json::from_str(&case.truth.json().unwrap()).unwrap();
    assert_eq!(truth["verdict"], "explained");
    assert_eq!(truth["effects"][1]["id"], "grade");
    for key in ["severity", "magnitude", "side", "downhill_direction_rad"] {
        assert!(truth["effects"][1].get(key).is_some(), "{key}");
    }
    for key in ["rms", "nominal", "calibrated", "oracle"] {
        assert_eq!(truth["heldout"]["held_1"][key].as_array().unwrap().len(), 2);
    }
    assert!(truth["recordings"]["run_1"]["intervals_s"].is_object());
    assert_eq!(case.truth.seal().unwrap().len(), 64);
    let held = &case.truth.heldout["held_1"];
    assert!(held.oracle[0] < 0.5 * held.calibrated[0], "{held:?}");
    assert!(held.oracle[0] < 0.3, "{held:?}");
    let outsider = draw(&short(Content::AnyOutsider));
    assert_eq!(outsider.truth.verdict, "unknown");
    assert_eq!(outsider.truth.effects[0].id, "out_of_library");
}

#[test]
fn local_effects_say_when_they_were_present() {
    let mut seen = BTreeMap::new();
    for seed in 0..6 {
        let mut settings = short(Content::Effects(vec![EffectId::RollingResistance]));
        settings.heldout = 1;
        let case = Case::draw("x", seed, &settings).unwrap();
        let effect = &case.truth.effects[0];
        let found = &case.truth.recordings["run_1"].intervals_s["rolling_resistance"];
        assert!(found.iter().all(|i| 0.0 <= i[0] && i[0] < i[1] && i[1] <= 5.0));
        let place = effect.place.clone().unwrap();
        assert_eq!(place == "patch", effect.coverage_heldout.is_some());
        assert!(place == "patch" || found.len() == 1);
        *seen.entry(place).or_insert(0) += 1;
    }
    assert_eq!(seen.len(), 2, "{seen:?}");
}

#[test]
fn a_robot_on_casters_is_described_by_where_they_stand() {
    let described = |casters: bool| {
        let case = draw(&Settings { casters, ..short(Content::Null) });
        let (_, bytes) = case.files.into_iter().find(|(path, _)| path.ends_with("robot.json")).unwrap();
        serde_json::from_slice::<serde_json::Value>(&bytes).unwrap()
    };
    let (four, on_casters) = (described(false), described(true));
    assert!(four.get("half_wheelbase_m").is_some() && four.get("caster_x_m").is_none(), "{four}");
    assert_eq!(on_casters["chassis"], "differential");
    assert!(on_casters["caster_x_m"].is_f64() && on_casters.get("half_wheelbase_m").is_none(), "{on_casters}");
    // Its weight lies between the axle and a caster.
    let [com, first, second] =
        ["com_x_m", "caster_x_m", "second_caster_x_m"].map(|key| on_casters[key].as_f64().unwrap());
    assert!(com <= first.max(second).max(0.0) && com >= first.min(second).min(0.0), "{on_casters}");
}

#[test]
fn every_cause_changes_the_recordings_and_none_the_references() {
    let text = |case: &DrawnCase, folder: &str| {
        let of = |p: &(std::path::PathBuf, Vec<u8>)| p.0.starts_with(folder);
        case.files.iter().filter(|f| of(f)).cloned().collect::<Vec<_>>()
    };
    let plain = |casters: bool| draw(&Settings { casters, ..short(Content::Null) });
    let fault_free = [plain(false), plain(true)];
    let causes = [false, true].into_iter().flat_map(|casters| {
        let effects = EffectId::of(casters).into_iter().map(|e| Content::Effects(vec![e]));
        let outsiders = Outsider::of(casters).into_iter().map(Content::Outsider);
        effects.chain(outsiders).map(move |content| (casters, content))
    });
    for (casters, content) in causes {
        let fault_free = &fault_free[usize::from(casters)];
        let case = draw(&Settings {
            // A short drive may miss a disc or a limit: then it is drawn again.
            least_excess: 1.05,
            casters,
            ..short(content.clone())
        });
        // Compared outside of assert_eq, which would print the files.
        let same = |folder| text(&case, folder) == text(fault_free, folder);
        assert!(same("reference"), "{content:?}");
        assert!(!same("recordings"), "{content:?}");
        let rows = table(&case, "recordings/run_1.csv").1;
        assert!(rows.iter().flatten().flatten().all(|x| x.is_finite()), "{content:?}");
        let effect = &case.truth.effects[0];
        // Two visits that place a disc need more than one short drive.
        let shown = effect.excess > 1.02 || effect.x.is_some();
        assert!(shown, "{content:?} {}", effect.excess);
    }
    let settings = Settings {
        duration_s: 12.0,
        recordings: Some(2),
        least_excess: 1.3,
        ..short(Content::Effects(vec![EffectId::AdhesionPatch]))
    };
    let patch = draw(&settings);
    assert!(patch.truth.effects[0].excess >= 1.3 && !patch.truth.below_noise);
}

#[test]
fn what_changes_after_the_references_changes_the_recordings_only() {
    let files = |case: &DrawnCase, folder: &str| {
        case.files.iter().filter(|f| f.0.starts_with(folder)).cloned().collect::<Vec<_>>()
    };
    let fault_free = draw(&short(Content::Null));
    for changed in [
        Settings { controller_gain: 0.5, ..short(Content::Null) },
        Settings { moved: 1.0, ..short(Content::Null) },
        Settings { drives: vec![Manoeuvre::Spin], ..short(Content::Null) },
        short(Content::Outsider(Outsider::FrictionBox)),
        short(Content::Outsider(Outsider::ExplicitSteps)),
    ] {
        let case = draw(&changed);
        let same = |folder| files(&case, folder) == files(&fault_free, folder);
        assert!(same("reference") && same("robot.json"), "{changed:?}");
        assert!(!same("recordings"), "{changed:?}");
        let rows = table(&case, "recordings/run_1.csv").1;
        assert!(rows.iter().flatten().flatten().all(|x| x.is_finite()), "{changed:?}");
        let kinds = &case.truth.recordings["run_1"].kinds;
        assert!(changed.drives.is_empty() || *kinds == ["spin", "spin"], "{kinds:?}");
    }
}

#[test]
fn an_effect_sets_in_where_it_is_asked_to() {
    let content = Content::Effects(vec![EffectId::RollingResistance]);
    let place = |place| Settings { place: Some(place), onset: [0.9, 0.95], ..short(content.clone()) };
    let late = draw(&place(Place::Time));
    for run in late.truth.recordings.values() {
        let [[from, until]] = run.intervals_s["rolling_resistance"][..] else { panic!("{run:?}") };
        assert!((0.89..0.96).contains(&(from / until)), "{from} {until}");
    }
    assert!(draw(&place(Place::Patch)).truth.effects[0].radius.is_some());
}

#[test]
fn rates_classes_and_missing_sensors_are_as_asked() {
    for (rate, class) in [(50.0, RobotClass::Small), (200.0, RobotClass::Large)] {
        let settings = Settings {
            row_rate_hz: rate,
            class,
            pose: false,
            accelerometer: false,
            setting: Some(Setting::Weak),
            duration_s: 8.0,
            ..short(Content::Null)
        };
        let case = draw(&settings);
        let (_, rows) = table(&case, "recordings/run_1.csv");
        assert_eq!(rows.len(), (8.0 * rate) as usize);
        assert!(rows.iter().all(|r| r[8..].iter().all(Option::is_none)));
        assert!(rows.iter().any(|r| r[7].is_some()));
        let held = &case.truth.heldout["held_1"];
        assert!(held.oracle[0] < 0.6 && held.rms[0] > 1.0, "{class:?} {held:?}");
    }
    let odd = Settings { row_rate_hz: 333.0, ..Settings::default() };
    assert!(Case::draw("x", 1, &odd).is_err());
}

#[test]
fn courses_are_driven_as_asked_with_what_is_hidden() {
    let settings = short(Content::Effects(vec![EffectId::Payload]));
    let straight = Course {
        start: Some([1.0, -2.0, 0.5]),
        points: vec![[0.0; 3], [1.0, 0.4, 0.0], [5.0, 0.4, 0.0], [6.0, 0.0, 0.0]],
        torque_free: vec![[5.0, 6.0]],
    };
    let spin = Course { points: vec![[0.0; 3], [1.0, 0.0, 0.8], [5.0, 0.0, 0.8]], ..Course::default() };
    let again = Again::new(11, &settings).unwrap();
    let texts = [&straight, &spin].map(|c| again.record(0, c).unwrap());
    assert!(texts[0] == Again::new(11, &settings).unwrap().record(0, &straight).unwrap());
    assert!(texts[0] != again.record(1, &straight).unwrap(), "each run is another");
    let fault_free = short(Content::Null);
    assert!(texts[0] != Again::new(11, &fault_free).unwrap().record(0, &straight).unwrap(), "nothing is hidden in it");

    let rows = |text: &str| -> Vec<Vec<Option<f64>>> {
        text.lines().skip(1).map(|l| l.split(',').map(|c| c.parse().ok()).collect()).collect()
    };
    let [ahead, round] = [rows(&texts[0]), rows(&texts[1])];
    assert_eq!((ahead.len(), round.len()), (600, 500));
    let first: Vec<f64> = [10, 11, 12].iter().filter_map(|&c| ahead[..12].iter().find_map(|r| r[c])).collect();
    assert!((first[0] - 1.0).abs() < 0.05 && (first[1] + 2.0).abs() < 0.05 && (first[2] - 0.5).abs() < 0.05);
    let mean = |rows: &[Vec<Option<f64>>], c: usize| {
        let all: Vec<f64> = rows.iter().filter_map(|r| r[c]).collect();
        all.iter().sum::<f64>() / all.len() as f64
    };
    // Pose at 2 s and 4 s: 0.8 m along the heading.
    let at = |t: usize, c: usize| ahead[t..].iter().find_map(|r| r[c]).unwrap();
    let way = (at(400, 10) - at(200, 10)).hypot(at(400, 11) - at(200, 11));
    assert!((way - 0.8).abs() < 0.08, "{way} m");
    assert!((mean(&round[250..450], 7) - 0.8).abs() < 0.15, "{} rad/s", mean(&round[250..450], 7));
    assert!(mean(&ahead[510..590], 5).abs() < 0.02 && mean(&ahead[300..500], 5).abs() > 0.05);

    let unsound = Course { points: vec![[2.0, 0.0, 0.0], [1.0, 0.0, 0.0]], ..Course::default() };
    assert!(again.record(0, &unsound).is_err());
}
