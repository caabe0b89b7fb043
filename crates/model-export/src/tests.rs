//! The translation as a whole.

use std::collections::BTreeMap;

use inference::KnownEffects;
use robot_model::effects::catalogue;
use robot_model::{Chassis, EffectSpec, Robot, paper};
use testing::on_casters;
use verdict::{EffectAt, Side};

use crate::at::At;
use crate::inertia::Parts;
use crate::translate::vehicle;
use crate::{Engine, Exported, Model, Way, way};

fn robot() -> Robot<f64> {
    let mut r = Robot::from(&paper::Parameters::SET_B);
    (r.adhesion, r.slip_at_peak, r.sliding_share) = (0.64, 0.12, 1.0);
    (r.viscous, r.motor_inertia, r.com[0], r.com[1]) = ([0.1, 0.12], 0.02, 0.01, -0.02);
    (r.drive.lag, r.drive.limit) = (0.01, 15.0);
    r
}

/// An effect at a small size that no robot refuses.
fn at(spec: &EffectSpec, side: Option<Side>) -> EffectAt {
    let value = |p: &robot_model::Parameter| if p.name == "T_b" || p.name == "T_max" { 1.5 } else { p.probes[0] };
    let values: BTreeMap<String, f64> = spec.parameters.iter().map(|p| (p.name.to_owned(), value(p))).collect();
    EffectAt { effect: spec.id.to_owned(), values, side: side.filter(|_| spec.scopes.side), ..EffectAt::default() }
}

fn export(robot: &Robot<f64>, effects: &[EffectAt], engine: Engine) -> Exported {
    let model = Model { name: "tested", robot, effects, known: KnownEffects::default(), before: None, causes: &[] };
    model.export(engine).expect("a model")
}

#[test]
fn every_effect_of_the_catalogue_is_translated_for_every_engine() {
    let four_motors = Robot { chassis: Chassis::FourMotors, ..robot() };
    let robots = [robot(), four_motors, on_casters()];
    for (effect, robot) in catalogue::<f64>().into_iter().flat_map(|e| robots.map(|r| (e, r))) {
        let spec = effect.spec();
        for engine in Engine::ALL.into_iter().filter(|_| spec.is_of(robot.chassis)) {
            let plain = export(&robot, &[], engine);
            let with = export(&robot, &[at(spec, Some(Side::Left))], engine);
            let way = way(engine, spec.id).unwrap_or_else(|| panic!("{} has no translation", spec.id));
            assert!(with.text.contains(spec.id), "{}: {} does not name it", spec.id, engine.name());
            // Without comments: a held effect changes the model itself, another one leaves it as it is.
            let changed = bare(&with.text) != bare(&plain.text);
            assert_eq!(changed, matches!(way, Way::Held(_)), "{} in {}", spec.id, engine.name());
            assert_eq!(with.notes.len() > plain.notes.len(), !changed && !is_drive(spec, engine), "{}", spec.id);
            assert!(is_well_formed(&with.text), "{}", spec.id);
            assert!(!with.text.contains('{'), "{}: a number is missing in {}", spec.id, engine.name());
        }
    }
}

/// Constants of the drive have one residual for all of them where the engine has no drive.
fn is_drive(spec: &EffectSpec, engine: Engine) -> bool {
    engine != Engine::Mjcf && ["motor_lag", "transport_delay", "torque_constant"].contains(&spec.id)
}

fn bare(xml: &str) -> String {
    let mut out = String::new();
    let mut rest = xml;
    while let Some((before, after)) = rest.split_once("<!--") {
        out.push_str(before.trim_end());
        rest = after.split_once("-->").map_or("", |c| c.1);
    }
    out + rest.trim_end()
}

fn is_well_formed(xml: &str) -> bool {
    roxmltree::Document::parse(xml).is_ok()
}

fn text(node: roxmltree::Node<'_, '_>, child: &str) -> f64 {
    let child = node.children().find(|c| c.has_tag_name(child)).unwrap_or_else(|| panic!("no {child}"));
    child.text().and_then(|t| t.trim().parse().ok()).unwrap_or(f64::NAN)
}

#[test]
fn a_caster_that_counts_as_two_stands_once_and_bears_the_load_of_both() {
    let two = on_casters();
    let one = Robot { casters: [two.casters[0]; 2], ..two };
    for engine in Engine::ALL {
        let [with_two, with_one] = [two, one].map(|robot| export(&robot, &[], engine).text);
        assert!(with_two.contains("caster_1") && with_two.contains("caster_2"), "{}", engine.name());
        assert!(with_one.contains("caster_1") && !with_one.contains("caster_2"), "{}", engine.name());
    }
    // The same load on two spheres almost at one place: each is half as stiff, d / (1 − d) in MuJoCo's impedance d.
    let odds = |robot: &Robot<f64>| -> f64 {
        let text = export(robot, &[], Engine::Mjcf).text;
        let (_, pair) = text.split_once("<pair name=\"caster_1\"").expect("a pair");
        let (_, solimp) = pair.split_once("solimp=\"").expect("solimp");
        let d: f64 = solimp.split_whitespace().next().and_then(|x| x.parse().ok()).expect("a number");
        d / (1.0 - d)
    };
    let [x, y] = one.casters[0];
    let apart = Robot { casters: [[x, y + 1e-6], [x, y - 1e-6]], ..one };
    let ratio = odds(&one) / odds(&apart);
    assert!((ratio - 2.0).abs() < 1e-3, "{ratio}");
}

#[test]
fn masses_and_inertias_sum_up_to_those_of_the_robot() {
    [robot(), on_casters()].iter().for_each(sum_up);
}

fn sum_up(robot: &Robot<f64>) {
    let payload = catalogue::<f64>().into_iter().find(|e| e.spec().id == "payload").expect("payload");
    let load = at(payload.spec(), None);
    let known = KnownEffects::default();
    let model = Model { name: "tested", robot, effects: &[load], known, before: None, causes: &[] };
    let mut expected = *robot;
    payload.robot(At::new(&model.effects[0], known).expect("values").values(), &mut expected);
    for engine in Engine::ALL {
        let v = vehicle(&model, engine).expect("a vehicle");
        let total = Parts::new(&v, engine != Engine::Mjcf).total();
        approx(total.mass, expected.mass);
        approx(total.inertia[2], expected.yaw_inertia);
        for k in 0..3 {
            approx(total.centre[k], expected.com[k]);
        }
        let text = model.export(engine).expect("a model").text;
        assert!((mass_of(&text, engine) / expected.mass - 1.0).abs() < 1e-4, "{}", engine.name());
    }
}

/// The masses that a file holds.
fn mass_of(xml: &str, engine: Engine) -> f64 {
    let document = roxmltree::Document::parse(xml).expect("XML");
    let attribute =
        |n: roxmltree::Node<'_, '_>, name: &str| n.attribute(name).and_then(|a| a.parse().ok()).unwrap_or(f64::NAN);
    let inertials = document.descendants().filter(|n| n.has_tag_name("inertial"));
    inertials
        .map(|n| match engine {
            Engine::Mjcf => attribute(n, "mass"),
            Engine::Urdf => n.children().find(|c| c.has_tag_name("mass")).map_or(f64::NAN, |m| attribute(m, "value")),
            Engine::Sdf => text(n, "mass"),
        })
        .sum()
}

fn approx(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()), "{a} is not {b}");
}

#[test]
fn urdf_is_read_by_a_parser_of_urdf() {
    let all: Vec<EffectAt> = catalogue::<f64>().iter().map(|e| at(e.spec(), Some(Side::Right))).collect();
    let text = export(&robot(), &all, Engine::Urdf).text;
    let read = urdf_rs::read_from_string(&text).expect("URDF");
    let links: Vec<&str> = read.links.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(links, ["chassis", "payload", "imu", "front_left", "front_right", "rear_left", "rear_right"]);
    for joint in &read.joints {
        assert!(links.contains(&joint.child.link.as_str()) && joint.parent.link == "chassis", "{}", joint.name);
    }
    let rear = read.joints.iter().find(|j| j.name == "rear_right_joint").expect("a joint");
    let dynamics = rear.dynamics.as_ref().expect("dynamics");
    // Half of the side's: its own, and what viscous_friction adds.
    approx((dynamics.damping * 1e6).round() / 1e6, 0.08);
    approx(rear.limit.effort, 1.5);
}

#[test]
fn sdf_joints_join_links_that_are_there_and_every_link_of_the_robot_weighs() {
    let all: Vec<EffectAt> = catalogue::<f64>().iter().map(|e| at(e.spec(), Some(Side::Left))).collect();
    let text_of = export(&robot(), &all, Engine::Sdf).text;
    let document = roxmltree::Document::parse(&text_of).expect("XML");
    let robot = document.descendants().find(|n| n.attribute("name") == Some("tested")).expect("the robot");
    let links: Vec<_> = robot.children().filter(|n| n.has_tag_name("link")).collect();
    let names: Vec<&str> = links.iter().filter_map(|l| l.attribute("name")).collect();
    for link in &links {
        let inertial = link.children().find(|c| c.has_tag_name("inertial")).expect("inertial");
        let inertia = inertial.children().find(|c| c.has_tag_name("inertia")).expect("inertia");
        let [x, y, z] = ["ixx", "iyy", "izz"].map(|k| text(inertia, k));
        assert!(text(inertial, "mass") > 0.0 && x + y >= z && y + z >= x && z + x >= y, "{x} {y} {z}");
    }
    for joint in robot.children().filter(|n| n.has_tag_name("joint")) {
        // From SDF 1.7 on they share one space of names.
        assert!(!names.contains(&joint.attribute("name").expect("a name")), "{:?}", joint.attribute("name"));
        for end in ["parent", "child"] {
            let link = joint.children().find(|c| c.has_tag_name(end)).and_then(|c| c.text()).expect("a link");
            assert!(names.contains(&link), "no link {link}");
        }
    }
    let gravity = document.descendants().find(|n| n.has_tag_name("gravity")).and_then(|n| n.text()).expect("gravity");
    assert!(gravity.starts_with("0.19") && gravity.contains("-9.8"), "{gravity}");
}

#[test]
fn a_place_is_a_disc_on_the_ground_or_a_residual() {
    let patch = EffectAt {
        effect: "adhesion_patch".to_owned(),
        values: [("lost share".to_owned(), 0.5)].into(),
        place: Some([1.0, -2.0, 0.4]),
        ..EffectAt::default()
    };
    let sdf = export(&robot(), std::slice::from_ref(&patch), Engine::Sdf);
    assert!(sdf.text.contains("disc_0") && sdf.text.contains("1 -2 0 0 0 0"), "{}", sdf.text);
    let mjcf = export(&robot(), &[patch], Engine::Mjcf);
    let python = mjcf.residual.expect("a residual");
    assert!(python.contains("grip[i] *= 1.0 - 0.5 * share(i, 1, -2, 0.4)"), "{python}");
}

#[test]
fn an_effect_that_is_not_in_the_catalogue_is_refused() {
    let robot = robot();
    let stranger = [EffectAt { effect: "wind".to_owned(), ..EffectAt::default() }];
    let known = KnownEffects::default();
    let model = Model { name: "tested", robot: &robot, effects: &stranger, known, before: None, causes: &[] };
    let error = model.export(Engine::Mjcf).expect_err("refused").to_string();
    assert!(error.contains("wind"), "{error}");
}

#[test]
fn a_law_of_ones_own_has_its_lines_with_its_numbers_beside_every_engine() {
    let robot = robot();
    let exported = |formula: &str, values: &[(&str, f64)], engine: Engine| {
        let own = law::OwnEffect::new("my-law", formula.parse().expect("a law")).expect("an effect");
        let values = values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        let effects = [EffectAt { effect: "my-law".to_owned(), values, ..EffectAt::default() }];
        let known = KnownEffects::with(vec![own]);
        let model = Model { name: "tested", robot: &robot, effects: &effects, known, before: None, causes: &[] };
        model.export(engine).expect("a model")
    };
    let drag = "T_right = -0.5 [N m] * bump(omega, 5) * wave(t, 2, 0) * rise(t, 4)";
    let numbers = [("constant", -0.75), ("a of bump(omega)", 3.0), ("w of wave(t)", 2.5), ("phase of wave(t)", 0.25)];
    for engine in Engine::ALL {
        let text = exported(drag, &numbers, engine);
        assert!(text.text.contains("my-law") && !text.text.contains('{'), "{}", text.text);
        assert!(is_well_formed(&text.text), "{}", text.text);
        assert!(text.notes.iter().any(|note| note == "my-law: it has no such law"), "{:?}", text.notes);
        let lines = text.residual.unwrap_or(text.text);
        let expected = "torque[1] += (-0.75) * (exp(-min((w[1] / 3) ** 2, 60.0))) * (cos(2.5 * t + 0.25)) * \
            (1.0 - exp(-min(max(t, 0.0) / 4, 60.0)))";
        assert!(lines.contains(expected), "{lines}");
    }
    let slope = exported("slope_x = 0.1 [rad]; slope_y = 0.1 [rad]", &[("constant of slope_y", 0.05)], Engine::Mjcf);
    let python = slope.residual.expect("a residual");
    let weight = crate::number::number(robot.mass * robot.gravity);
    assert!(python.contains(&format!("rise = (0.05)\n        force[0] -= {weight} * rise * sh")), "{python}");
    let wheels = exported("radius_left = 0.01 [m]", &[("constant", 0.002)], Engine::Sdf);
    assert!(wheels.text.contains("Add it by its law: radius_left = 0.01 [m]"), "{}", wheels.text);
}
