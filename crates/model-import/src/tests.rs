//! Models in, robot files out: what is read, what is guessed, what is refused.

use model_export::{Engine, Model};
use robot_file::RobotSpec;

use crate::{Asked, ImportError, Imported, Kind, Rollers, import};

/// A link with a cylinder that lies along y, and its continuous joint.
pub(crate) fn wheel(name: &str, xyz: &str, more: &str) -> String {
    format!(
        "<link name=\"{name}\"><collision><origin rpy=\"1.5707963267948966 0 0\"/><geometry><cylinder radius=\"0.05\" \
         length=\"0.02\"/></geometry></collision></link>\n<joint name=\"{name}_joint\" type=\"continuous\"><parent \
         link=\"base_link\"/><child link=\"{name}\"/><origin xyz=\"{xyz}\"/><axis xyz=\"0 1 0\"/>{more}</joint>\n"
    )
}

pub(crate) fn urdf(inside: &str) -> String {
    format!("<robot name=\"mine\">\n<link name=\"base_link\"/>\n{inside}</robot>")
}

fn read(text: &str) -> Imported {
    import("mine.urdf", text, &Asked::default()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

pub(crate) fn refused(text: &str, asked: &Asked) -> String {
    import("mine.urdf", text, asked).expect_err("refused").to_string()
}

/// A robot as a model of another simulator.
pub(crate) fn exported(name: &str, robot: &robot_model::Robot<f64>, engine: Engine) -> String {
    let known = inference::KnownEffects::default();
    let model = Model { name, robot, effects: &[], known, before: None, causes: &[] };
    model.export(engine).expect("exported").text
}

pub(crate) fn of_kind(kind: Kind) -> Asked {
    Asked { kind: Some(kind), ..Asked::default() }
}

#[test]
fn a_robot_that_was_exported_reads_back_the_same() {
    for name in ["hendzel-trojnacki-2014", "husky-a200"] {
        let spec = RobotSpec::built_in(name).expect("built in");
        for engine in [Engine::Urdf, Engine::Sdf, Engine::Mjcf] {
            let text = exported(name, &spec.robot, engine);
            let made = import("again.xml", &text, &Asked::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!((made.kind, made.layout), (Kind::TorqueDriven, "a skid-steer robot"), "{name}");
            let again = RobotSpec::parse("again.toml", &made.text).expect("a robot file").robot;
            let robot = &spec.robot;
            for (what, a, b) in [
                ("mass", again.mass, robot.mass),
                ("yaw_inertia", again.yaw_inertia, robot.yaw_inertia),
                ("com_height", again.com[2], robot.com[2]),
                ("half_wheelbase", again.half_wheelbase, robot.half_wheelbase),
                ("half_track", again.half_track, robot.half_track),
                ("wheel_radius", again.wheel_radius, robot.wheel_radius),
                ("wheel_inertia", again.wheel_inertia, robot.wheel_inertia),
                ("motor_inertia", again.motor_inertia, robot.motor_inertia),
                // A damping of zero is a filler: a usual one stands in its place.
                ("viscous", if robot.viscous[0] > 0.0 { again.viscous[0] } else { 0.0 }, robot.viscous[0]),
            ] {
                assert!((a - b).abs() <= 2e-3 * b.abs() + 1e-9, "{name} {what}: {a}, {b}");
            }
            for axis in 0..2 {
                approx::assert_abs_diff_eq!(again.com[axis], robot.com[axis], epsilon = 1e-4);
            }
            // Joint friction holds rolling resistance too: what both take together is what comes back.
            let resists = |r: &robot_model::Robot<f64>| {
                r.coulomb[0] + r.coulomb[1] + r.rolling_resistance * r.mass * r.gravity * r.wheel_radius
            };
            approx::assert_relative_eq!(resists(&again), resists(robot), max_relative = 2e-2);
        }
    }
}

#[test]
fn a_robot_on_casters_that_was_exported_reads_back_the_same() {
    let robot = testing::on_casters();
    for engine in [Engine::Urdf, Engine::Sdf, Engine::Mjcf] {
        let text = exported("mine", &robot, engine);
        let made = import("again.xml", &text, &of_kind(Kind::TorqueDriven)).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let again = RobotSpec::parse("again.toml", &made.text).expect("a robot file").robot;
        assert_eq!(again.chassis, robot.chassis);
        let pairs = [(again.mass, robot.mass), (again.yaw_inertia, robot.yaw_inertia), (again.com[0], robot.com[0])];
        let places = again.casters.into_iter().flatten().zip(robot.casters.into_iter().flatten());
        // URDF and SDF know no rotors: the wheel that a motor turns holds it.
        let rotor = if engine == Engine::Mjcf { 0.0 } else { robot.motor_inertia };
        let wheel = (again.wheel_inertia, robot.wheel_inertia + rotor);
        for (a, b) in pairs.into_iter().chain(places).chain([wheel]) {
            assert!((a - b).abs() <= 2e-3 * b.abs() + 1e-4, "{}: {a}, {b}\n{text}", made.text);
        }
    }
}

#[test]
fn two_wheels_and_a_caster_are_a_differential_drive_without_any_mass() {
    let caster = "<link name=\"fork\"/><joint name=\"swivel\" type=\"continuous\"><parent link=\"base_link\"/><child \
                  link=\"fork\"/><origin xyz=\"-0.15 0 0.08\"/><axis xyz=\"0 0 1\"/></joint>\n";
    let trailing = wheel("back", "-0.03 0 -0.03", "").replace("parent link=\"base_link\"", "parent link=\"fork\"");
    let parts =
        [wheel("left", "0 0.2 0.05", ""), wheel("right", "0 -0.2 0.05", ""), caster.to_owned(), trailing].concat();
    let made = read(&urdf(&parts));
    assert_eq!((made.kind, made.layout), (Kind::Odometry, "a differential drive"));
    let file =
        odometry::file::RobotFile::parse("mine.toml", &made.text).unwrap_or_else(|e| panic!("{e}\n{}", made.text));
    let wheels = &file.robot.wheels;
    assert_eq!((wheels.len(), wheels[0].place, wheels[0].radius), (2, [0.0, 0.2], 0.05));
    assert!(made.text.contains("caster = true") && made.text.contains("column = \"left_joint\""), "{}", made.text);

    let refusal = refused(&urdf(&parts), &of_kind(Kind::TorqueDriven));
    assert!(
        refusal.contains("no link states a mass, but torque-driven robots need mass") && refusal.contains("--kind"),
        "{refusal}"
    );
    let alone = refused(
        &urdf(&[wheel("left", "0 0.2 0.05", ""), wheel("right", "0 -0.2 0.05", "")].concat()),
        &of_kind(Kind::TorqueDriven),
    );
    assert!(alone.contains("a differential drive with 2 wheels and 0 casters"), "{alone}");
}

/// Mass and inertia of a link, its centre of mass at a height.
fn weighs(mass: f64, inertia: f64, height: f64) -> String {
    let [kind, number] = ["ixx", "iyy"].map(|axis| format!("{axis}=\"{inertia}\""));
    format!(
        "<inertial><origin xyz=\"-0.02 0 {height}\"/><mass value=\"{mass}\"/><inertia {kind} {number} izz=\"{inertia}\" \
         ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>"
    )
}

#[test]
fn two_wheels_and_casters_with_masses_are_a_torque_driven_robot_on_casters() {
    let swivel = "<link name=\"fork\"/><joint name=\"swivel\" type=\"continuous\"><parent link=\"base_link\"/><child \
                  link=\"fork\"/><origin xyz=\"-0.15 0.01 0.08\"/><axis xyz=\"0 0 1\"/></joint>\n";
    let trailing = wheel("back", "-0.03 0 -0.03", "").replace("parent link=\"base_link\"", "parent link=\"fork\"");
    let slider = "<link name=\"ball\"><collision><geometry><sphere radius=\"0.02\"/></geometry></collision></link>\n<joint \
                  name=\"ball_joint\" type=\"fixed\"><parent link=\"base_link\"/><child link=\"ball\"/><origin \
                  xyz=\"0.12 0 0.02\"/></joint>\n";
    let wheels = [wheel("left", "0 0.2 0.05", ""), wheel("right", "0 -0.2 0.05", "")].concat();
    let model = |parts: &[&str]| {
        let parts = urdf(&(wheels.clone() + &parts.concat()));
        parts.replace(
            "<link name=\"base_link\"/>",
            &format!("<link name=\"base_link\">{}</link>", weighs(9.0, 0.2, 0.1)),
        )
    };
    let made = |text: &str| import("mine.urdf", text, &of_kind(Kind::TorqueDriven)).unwrap_or_else(|e| panic!("{e}"));

    let both = made(&model(&[swivel, &trailing, slider]));
    let robot = RobotSpec::parse("mine.toml", &both.text).unwrap_or_else(|e| panic!("{e}\n{}", both.text)).robot;
    assert_eq!((robot.chassis, robot.mass), (robot_model::Chassis::Differential, 9.0));
    for (found, placed) in robot.casters.as_flattened().iter().zip([-0.15, 0.01, 0.12, 0.0]) {
        approx::assert_abs_diff_eq!(*found, placed, epsilon = 1e-12);
    }
    approx::assert_abs_diff_eq!(robot.caster_trail, 0.03, epsilon = 1e-12);
    assert!((robot.half_wheelbase - 0.075).abs() < 1e-12 && !both.text.contains("wheelbase"), "{}", both.text);
    assert!(both.numbers.iter().any(|n| n.name == "caster_x" && n.is_stated), "{:?}", both.numbers);

    // A sphere that slides is a caster whose trail nobody states; one caster counts twice.
    let ball = made(&model(&[&slider.replace("0.12 0 0.02", "-0.12 0 0.02")]));
    let robot = RobotSpec::parse("mine.toml", &ball.text).expect("a robot file").robot;
    assert_eq!((robot.casters, robot.caster_trail), ([[-0.12, 0.0]; 2], 0.025));
}

#[test]
fn a_wheel_that_is_mounted_backwards_counts_backwards() {
    let right = wheel("right", "0 -0.2 0.05", "").replace("xyz=\"0 1 0\"", "xyz=\"0 -1 0\"");
    let made = read(&urdf(&(wheel("left", "0 0.2 0.05", "") + &right)));
    let file = odometry::file::RobotFile::parse("mine.toml", &made.text).expect("a robot file");
    approx::assert_abs_diff_eq!(file.robot.wheels[0].direction, 0.0);
    approx::assert_abs_diff_eq!(file.robot.wheels[1].direction.abs(), std::f64::consts::PI, epsilon = 1e-9);
}

/// Front wheels that are steered, and rear ones that are not.
pub(crate) fn car(limit: &str) -> String {
    let hinge = |side: &str, y: f64| {
        let kind = if limit.is_empty() { "continuous" } else { "revolute" };
        format!(
            "<link name=\"{side}_hinge\"/><joint name=\"{side}_steering\" type=\"{kind}\"><parent link=\"base_link\"/><child \
             link=\"{side}_hinge\"/><origin xyz=\"0.3 {y} 0.05\"/><axis xyz=\"0 0 1\"/>{limit}</joint>\n"
        ) + &wheel(&format!("{side}_front"), "0 0 0", "").replace("base_link", &format!("{side}_hinge"))
    };
    let body = "<link name=\"body\"><inertial><origin xyz=\"0.1 0 0.1\"/><mass value=\"3\"/><inertia ixx=\"0.01\" ixy=\"0\" \
                ixz=\"0\" iyy=\"0.02\" iyz=\"0\" izz=\"0.03\"/></inertial></link><joint name=\"body\" type=\"fixed\"><parent \
                link=\"base_link\"/><child link=\"body\"/></joint>\n";
    let rear = [wheel("rl", "-0.02 0.1 0.05", ""), wheel("rr", "-0.02 -0.1 0.05", "")].concat();
    urdf(&[body, &hinge("left", 0.1), &hinge("right", -0.1), &rear].concat())
}

#[test]
fn a_steered_and_a_fixed_axle_are_a_car() {
    let made = read(&car("<limit lower=\"-0.4\" upper=\"0.4\" effort=\"1\" velocity=\"1\"/>"));
    assert_eq!((made.kind, made.layout), (Kind::Car, "a car"));
    let car = single_track::file::RobotFile::parse("mine.toml", &made.text).unwrap_or_else(|e| panic!("{e}")).car;
    approx::assert_relative_eq!(car.wheelbase.value, 0.32, epsilon = 1e-9);
    approx::assert_relative_eq!(car.full_steering.value, 0.4, epsilon = 1e-9);
    approx::assert_relative_eq!(car.centre_of_mass.value, 0.12, epsilon = 1e-9);
    approx::assert_relative_eq!(car.gyration.value, 0.01, epsilon = 1e-9);
    approx::assert_relative_eq!(car.point_x.value, 0.02, epsilon = 1e-9);
}

#[test]
fn a_car_whose_steering_has_no_limits_is_refused() {
    let refusal = refused(&car(""), &Asked::default());
    assert!(refusal.contains("steering joint 'left_steering' has no limits; add them in rad"), "{refusal}");
}

#[test]
fn limits_of_a_steering_joint_that_no_wheel_has_are_refused() {
    for limit in ["<limit effort=\"1\" velocity=\"1\"/>", "<limit lower=\"0.0\" upper=\"0.0\"/>"] {
        let refusal = refused(&car(limit), &Asked::default());
        assert!(refusal.contains("steering joint 'left_steering' has no limits"), "{refusal}");
    }
    for limit in ["<limit lower=\"0.4\" upper=\"-0.4\"/>", "<limit lower=\"-30\" upper=\"30\"/>"] {
        let refusal = refused(&car(limit), &Asked::default());
        assert!(refusal.contains("are they in degrees?"), "{refusal}");
    }
}

#[test]
fn wheels_that_all_roll_along_one_line_are_refused() {
    let line = ["0.15 0 0.05", "-0.15 0 0.05", "0 0 0.05"];
    let wheels: String = line.iter().enumerate().map(|(k, xyz)| wheel(&format!("w{k}"), xyz, "")).collect();
    let refusal = refused(&urdf(&wheels), &of_kind(Kind::Odometry));
    assert!(refusal.contains("all wheels roll along one line"), "{refusal}");
}

/// Four wheels at the corners.
fn four(more: &str) -> String {
    let at = [("fl", "0.15 0.2 0.05"), ("fr", "0.15 -0.2 0.05"), ("rl", "-0.15 0.2 0.05"), ("rr", "-0.15 -0.2 0.05")];
    urdf(&at.map(|(name, xyz)| wheel(name, xyz, more)).concat())
}

#[test]
fn four_wheels_need_masses_for_forces_and_none_for_wheel_motion() {
    let refusal = refused(&four(""), &Asked::default());
    assert!(refusal.contains("no link states a mass") && refusal.contains("--kind odometry"), "{refusal}");
    let made = import("mine.urdf", &four(""), &of_kind(Kind::Odometry)).expect("wheels are enough");
    let file = odometry::file::RobotFile::parse("mine.toml", &made.text).expect("a robot file");
    // Sides that skid turn as if they were wider.
    approx::assert_relative_eq!(file.robot.wheels[0].place[1], 1.4 * 0.2, epsilon = 1e-9);
    assert!(file.robot.sigmas.across.expect("stated") > 0.2);
}

#[test]
fn rollers_are_told_or_follow_from_axles_that_point_different_ways() {
    let asked = Asked { rollers: Some(Rollers::Mecanum), ..Asked::default() };
    let made = import("mine.urdf", &four(""), &asked).expect("a robot");
    let mecanum = odometry::file::RobotFile::parse("mine.toml", &made.text).expect("a robot file").robot;
    let known = odometry::WheeledRobot::mecanum_4(0.05, 0.3, 0.4);
    for (a, b) in mecanum.wheels.iter().zip(&known.wheels) {
        approx::assert_abs_diff_eq!(a.roller, b.roller, epsilon = 1e-9);
    }

    let third = |k: f64, name: &str| {
        let angle = std::f64::consts::TAU * k / 3.0;
        wheel(name, &format!("{} {} 0.05", 0.2 * angle.cos(), 0.2 * angle.sin()), "")
            .replace("<axis", "<!-- turned --><axis")
            .replace(
                "rpy=\"1.5707963267948966 0 0\"",
                &format!("rpy=\"1.5707963267948966 0 {}\"", angle + std::f64::consts::FRAC_PI_2),
            )
            .replace("xyz=\"0 1 0\"", &format!("xyz=\"{} {} 0\"", angle.cos(), angle.sin()))
    };
    let made = read(&urdf(&[third(0.5, "a"), third(1.5, "b"), third(2.5, "c")].concat()));
    assert_eq!(made.layout, "a robot with omni wheels");
    let omni =
        odometry::file::RobotFile::parse("mine.toml", &made.text).unwrap_or_else(|e| panic!("{e}\n{}", made.text));
    assert_eq!(omni.robot.wheels.len(), 3);
    assert!(made.notes.iter().any(|n| n.contains("needs rollers")), "{:?}", made.notes);
}

#[test]
fn what_is_wrong_is_one_sentence_with_its_line() {
    let wrong = |text: &str| refused(text, &Asked::default());
    assert!(wrong("<robot").contains("this is no XML"));
    assert!(wrong("<html/>").contains("line 1: <html> is no model; URDF begins with <robot>"));
    assert!(wrong("<robot name=\"r\"/>").contains("the model has no links"));
    assert!(wrong(&urdf("")).contains("no wheel was found"));
    let xacro = "<robot xmlns:xacro=\"http://ros.org/wiki/xacro\">\n<xacro:include filename=\"a\"/></robot>";
    assert!(wrong(xacro).contains("line 2: <include> is a macro, which xacro has to expand first"));
    let mesh = four("").replace("<cylinder radius=\"0.05\" length=\"0.02\"/>", "<mesh filename=\"w.dae\"/>");
    assert!(wrong(&mesh).contains("fl_joint, fr_joint, rl_joint, rr_joint turn without end"), "{}", wrong(&mesh));
    let told = Asked { wheel_radius: Some(0.05), kind: Some(Kind::Odometry), ..Asked::default() };
    assert!(import("mine.urdf", &mesh, &told).is_ok());
    let lost = four("")
        .replace("<parent link=\"base_link\"/><child link=\"fl\"/>", "<parent link=\"bas\"/><child link=\"fl\"/>");
    assert!(wrong(&lost).contains("there is no link 'bas'; correct the name"), "{}", wrong(&lost));
    let number = four("").replace("xyz=\"0.15 0.2 0.05\"", "xyz=\"0.15 O.2 0.05\"");
    assert!(wrong(&number).contains("line 4: xyz is 'O.2', which is no number"), "{}", wrong(&number));
    let error = import("mine.urdf", "<a/>", &Asked::default()).expect_err("refused");
    assert!(matches!(error, ImportError::At { line: 1, .. }));
}

#[test]
fn what_is_nested_without_end_is_refused_and_no_text_makes_it_panic() {
    let nested = |n: usize| {
        format!("<mujoco><worldbody>{}{}</worldbody></mujoco>", "<body><joint/>".repeat(n), "</body>".repeat(n))
    };
    assert!(refused(&nested(2000), &Asked::default()).contains("nested more than 1000 deep"));
    assert!(refused(&nested(900), &Asked::default()).contains("no wheel was found"));
    let classes =
        format!("<mujoco>{}{}<worldbody/></mujoco>", "<default class=\"c\">".repeat(900), "</default>".repeat(900));
    assert!(refused(&classes, &Asked::default()).contains("no <body> with joints"));
    let link = |k: usize| format!("<link name=\"l{k}\"><pose relative_to=\"l{}\">1 0 0 0 0 0</pose></link>", k + 1);
    let chain: String = (0..20_000).map(link).collect();
    let chain = format!("<sdf><model name=\"m\">{chain}<link name=\"l20000\"/></model></sdf>");
    assert!(refused(&chain, &Asked::default()).contains("no wheel was found"));
    let ring = "<sdf><model name=\"m\"><link name=\"a\"><pose relative_to=\"b\">0 0 0 0 0 0</pose></link><link name=\"b\"><pose \
                relative_to=\"a\">0 0 0 0 0 0</pose></link></model></sdf>";
    assert!(refused(ring, &Asked::default()).contains("is told relative to itself"));
    assert!(
        refused(&four("").replace("0.15 0.2 0.05", "inf 0.2 0.05"), &Asked::default())
            .contains("'inf', which is no number")
    );

    // Every byte in turn taken out, or another in its place: a robot or one sentence.
    let robot = RobotSpec::built_in("husky-a200").expect("built in").robot;
    for engine in [Engine::Urdf, Engine::Sdf, Engine::Mjcf] {
        let text = exported("mine", &robot, engine);
        for k in (0..text.len()).step_by(7).filter(|&k| text.is_char_boundary(k) && text.is_char_boundary(k + 1)) {
            for other in ["", "0", "-", "<", "\""] {
                let changed = [&text[..k], other, &text[k + 1..]].concat();
                for kind in [None, Some(Kind::Odometry)] {
                    let asked = Asked { kind, ..Asked::default() };
                    if let Err(e) = import("mine.xml", &changed, &asked) {
                        assert!(!e.to_string().contains('\n'), "{e}");
                    }
                }
            }
        }
    }
}

#[test]
fn default_classes_and_shapes_of_mjcf_give_what_mujoco_compiles() {
    // Mass and inertia as MuJoCo 3 compiles them: cylinders of 1000 kg/m³, a box of 4 kg.
    let wheel = |name: &str, x: f64, y: f64| {
        format!("<body name=\"{name}\" pos=\"{x} {y} 0\" childclass=\"wheel\"><joint name=\"{name}\"/><geom/></body>")
    };
    let corners = [("fl", 0.2, 0.15), ("fr", 0.2, -0.15), ("rl", -0.2, 0.15), ("rr", -0.2, -0.15)];
    let text = format!(
        "<mujoco model=\"cart\"><compiler angle=\"degree\"/><default><default class=\"wheel\"><joint axis=\"0 1 0\" \
         damping=\"0.1\" frictionloss=\"0.4\" armature=\"0.002\"/><geom type=\"cylinder\" size=\"0.08 0.02\" euler=\"90 0 0\" \
         friction=\"0.8 0 0\"/></default></default><worldbody><body name=\"base\" pos=\"0 0 0.08\"><freejoint/><geom \
         type=\"box\" size=\"0.25 0.1 0.05\" mass=\"4\" pos=\"0 0 0.05\"/>{}</body></worldbody><actuator><motor joint=\"rl\" \
         ctrlrange=\"-5 5\"/><motor joint=\"rr\" ctrlrange=\"-5 5\"/></actuator></mujoco>",
        corners.map(|(name, x, y)| wheel(name, x, y)).concat()
    );
    let made = import("cart.xml", &text, &Asked::default()).unwrap_or_else(|e| panic!("{e}"));
    let robot = made.spec.expect("one plant").robot;
    let disc = 1000.0 * std::f64::consts::PI * 0.08 * 0.08 * 0.04;
    approx::assert_relative_eq!(robot.mass, 4.0 + 4.0 * disc, max_relative = 1e-9);
    approx::assert_relative_eq!(robot.wheel_inertia, 0.5 * disc * 0.08 * 0.08, max_relative = 1e-9);
    approx::assert_relative_eq!(robot.motor_inertia, 0.004, max_relative = 1e-9);
    approx::assert_relative_eq!(robot.viscous[0], 0.2, max_relative = 1e-9);
    approx::assert_relative_eq!(robot.drive.limit, 5.0, max_relative = 1e-9);
    approx::assert_relative_eq!(robot.com[2], 0.08 + 4.0 * 0.05 / robot.mass, max_relative = 1e-9);
}
