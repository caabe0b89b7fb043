//! Models in, robot files of any wheels out.

use model_export::{AnyWheelsModel, Engine, Input};
use robot_file::RobotSpec;
use wheeled::file::RobotFile;

use crate::tests::{car, exported, of_kind, refused, urdf, wheel};
use crate::{Asked, Imported, Kind, import};

const LIMIT: &str = "<limit lower=\"-0.4\" upper=\"0.4\" effort=\"1\" velocity=\"1\"/>";

fn made(text: &str) -> (Imported, RobotFile) {
    let made = import("mine.urdf", text, &of_kind(Kind::Wheeled)).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let file = RobotFile::parse("mine.toml", &made.text).unwrap_or_else(|e| panic!("{e}\n{}", made.text));
    (made, file)
}

/// A car whose rear wheels have drives.
fn driven_car() -> String {
    let rear = |name: &str| format!("<parent link=\"base_link\"/><child link=\"{name}\"/>");
    let drive = "<limit effort=\"2\" velocity=\"9\"/><dynamics friction=\"0.1\" damping=\"0.02\"/>";
    let with_drives = |text: String, name: &str| text.replace(&rear(name), &(drive.to_owned() + &rear(name)));
    with_drives(with_drives(car(LIMIT), "rl"), "rr")
}

#[test]
fn a_car_has_a_joint_for_each_steered_wheel_and_a_motor_for_each_driven_one() {
    let (made, file) = made(&driven_car());
    let robot = &file.robot;
    assert_eq!(
        (robot.motors.as_slice(), robot.joints.len()),
        (["rl_joint".to_owned(), "rr_joint".to_owned()].as_slice(), 2)
    );
    assert_eq!((robot.plant.mass, robot.plant.com), (3.0, [0.1, 0.0, 0.1]));
    let steered = robot.plant.wheels[0].expect("a wheel");
    assert_eq!((steered.place, steered.joint, steered.motor), ([0.3, 0.1], Some(0), None));
    let joint = robot.plant.joints[0].expect("a joint");
    assert_eq!((joint.place, joint.about), ([0.3, 0.1], -0.02));
    assert_eq!(robot.measured, [2, 3], "wheels without a motor have no column");

    // What rolls takes a part of the joints' friction, and the weight is on four wheels.
    let motor = robot.plant.motors[0].expect("a motor");
    let rolls = robot.plant.ground.rolling * 3.0 * 9.806_65 / 4.0 * 0.05;
    approx::assert_relative_eq!(motor.coulomb + rolls, 0.1, max_relative = 1e-4);
    assert_eq!((motor.viscous, robot.sigmas.viscous[0]), (0.02, 0.01));
    assert!(rolls > 0.0 && made.text.contains("column = \"angle_left_steering\""), "{}", made.text);
    // Its wheels weigh nothing in the model.
    let guessed: Vec<&str> = made.numbers.iter().filter(|n| !n.is_stated).map(|n| n.name.as_str()).collect();
    assert_eq!(guessed.len(), 5, "{guessed:?}");
}

#[test]
fn an_axis_that_points_down_and_a_wheel_that_is_mounted_backwards_are_turned() {
    let (_, up) = made(&driven_car());
    let text = driven_car().replace("xyz=\"0 0 1\"", "xyz=\"0 0 -1\"").replacen("xyz=\"0 1 0\"", "xyz=\"0 -1 0\"", 1);
    let (_, down) = made(&text);
    assert_eq!((up.columns.joints[0].1, down.columns.joints[0].1), (1.0, -1.0));
    let direction = |file: &RobotFile| file.robot.plant.wheels[0].expect("a wheel").direction.abs();
    approx::assert_abs_diff_eq!(direction(&up), 0.0);
    approx::assert_abs_diff_eq!(direction(&down), std::f64::consts::PI, epsilon = 1e-6);
}

#[test]
fn wheels_that_follow_another_have_its_motor() {
    let robot = RobotSpec::built_in("husky-a200").expect("built in").robot;
    for engine in [Engine::Urdf, Engine::Sdf, Engine::Mjcf] {
        let (made, file) = made(&exported("mine", &robot, engine));
        let plant = &file.robot.plant;
        assert_eq!(file.robot.motors.len(), 2, "{}", made.text);
        let of = |k: usize| plant.wheels.iter().flatten().filter(|w| w.motor == Some(k)).count();
        assert_eq!((of(0), of(1), file.robot.measured.len()), (2, 2, 2), "{}", made.text);
        let resists: f64 = plant.motors.iter().flatten().map(|m| m.coulomb).sum::<f64>()
            + plant.ground.rolling * plant.mass * plant.ground.gravity * robot.wheel_radius;
        let told = robot.coulomb[0]
            + robot.coulomb[1]
            + robot.rolling_resistance * robot.mass * robot.gravity * robot.wheel_radius;
        approx::assert_relative_eq!(resists, told, max_relative = 2e-2);
    }
}

#[test]
fn casters_hang_at_their_pivots_and_spheres_get_a_trail() {
    let swivel = "<link name=\"fork\"/><joint name=\"swivel\" type=\"continuous\"><parent link=\"base_link\"/><child \
                  link=\"fork\"/><origin xyz=\"-0.15 0.01 0.08\"/><axis xyz=\"0 0 1\"/></joint>\n";
    let trailing = wheel("back", "-0.03 0 -0.03", "").replace("parent link=\"base_link\"", "parent link=\"fork\"");
    let ball = "<link name=\"ball\"><collision><geometry><sphere radius=\"0.02\"/></geometry></collision></link>\n<joint \
                name=\"ball_joint\" type=\"fixed\"><parent link=\"base_link\"/><child link=\"ball\"/><origin xyz=\"0.12 0 \
                0.02\"/></joint>\n";
    let body = "<link name=\"base_link\"><inertial><mass value=\"9\"/><inertia ixx=\"0.2\" iyy=\"0.2\" izz=\"0.2\" ixy=\"0\" \
                ixz=\"0\" iyz=\"0\"/></inertial></link>";
    let wheels = [wheel("left", "0 0.2 0.05", ""), wheel("right", "0 -0.2 0.05", "")].concat();
    let model = |parts: &[&str]| urdf(&(wheels.clone() + &parts.concat())).replace("<link name=\"base_link\"/>", body);

    let (made_of_both, file) = made(&model(&[swivel, &trailing, ball]));
    let [hung, slides] = [0, 1].map(|k| file.robot.plant.casters[k].expect("a caster"));
    assert_eq!((hung.pivot, hung.trail, slides.pivot, slides.trail), ([-0.15, 0.01], 0.03, [0.12, 0.0], 0.02));
    let says = |made: &Imported, what: &str| made.notes.iter().any(|n| n.contains(what));
    assert!(says(&made_of_both, "taken for casters with a trail of 0.02 m"), "{:?}", made_of_both.notes);
    assert!(says(&made_of_both, "does not say which wheels are driven"), "{:?}", made_of_both.notes);

    let asked = of_kind(Kind::Wheeled);
    assert!(
        refused(&model(&[]), &asked).contains("no robot of kind wheeled can be so"),
        "{}",
        refused(&model(&[]), &asked)
    );
    assert!(refused(&urdf(&wheels), &asked).contains("no link states a mass, but wheeled robots need mass"));
    let many: String =
        (0..9).map(|k| wheel(&format!("w{k}"), &format!("{} 0.2 0.05", 0.1 * f64::from(k)), "")).collect();
    let nine = refused(&urdf(&many).replace("<link name=\"base_link\"/>", body), &asked);
    assert!(nine.contains("the model has 9 wheels, but a robot of kind wheeled has 8 at most"), "{nine}");
}

#[test]
fn an_axle_that_turns_as_a_whole_is_refused() {
    let wagon = driven_car().replace("<parent link=\"right_hinge\"/>", "<parent link=\"left_hinge\"/>").replace(
        "<child link=\"right_front\"/><origin xyz=\"0 0 0\"/>",
        "<child link=\"right_front\"/><origin xyz=\"0 -0.2 0\"/>",
    );
    let refusal = refused(&wagon, &of_kind(Kind::Wheeled));
    assert!(refusal.contains("steering joint 'left_steering' carries several wheels"), "{refusal}");
}

#[test]
fn wheels_that_are_all_steered_are_of_this_kind_and_of_no_other() {
    let hinged = |side: &str, x: f64, y: f64| {
        format!(
            "<link name=\"{side}_hinge\"/><joint name=\"{side}_steering\" type=\"revolute\"><parent link=\"base_link\"/><child \
             link=\"{side}_hinge\"/><origin xyz=\"{x} {y} 0.05\"/><axis xyz=\"0 0 1\"/>{LIMIT}</joint>\n"
        ) + &wheel(side, "0 0 0", "").replace("base_link", &format!("{side}_hinge"))
    };
    let corners = [("fl", 0.3, 0.2), ("fr", 0.3, -0.2), ("rl", -0.3, 0.2), ("rr", -0.3, -0.2)];
    let body = "<link name=\"base_link\"><inertial><mass value=\"9\"/><inertia ixx=\"0.2\" iyy=\"0.2\" izz=\"0.2\" ixy=\"0\" \
                ixz=\"0\" iyz=\"0\"/></inertial></link>";
    let text =
        urdf(&corners.map(|(side, x, y)| hinged(side, x, y)).concat()).replace("<link name=\"base_link\"/>", body);
    let usual = import("mine.urdf", &text, &Asked::default()).expect("a robot");
    assert_eq!(usual.kind, Kind::Wheeled);
    let file = RobotFile::parse("mine.toml", &usual.text).unwrap_or_else(|e| panic!("{e}\n{}", usual.text));
    assert_eq!((file.robot.joints.len(), file.robot.motors.len()), (4, 4));
    for kind in [Kind::Odometry, Kind::Car] {
        let refusal = refused(&text, &of_kind(kind));
        assert!(
            refusal.contains("4 are steered (fl, fr, rl, rr) and 0 fixed") && refusal.contains("--kind wheeled"),
            "{refusal}"
        );
    }
    assert!(
        refused(&text, &of_kind(Kind::TorqueDriven)).contains("--kind"),
        "{}",
        refused(&text, &of_kind(Kind::TorqueDriven))
    );
}

/// A built-in robot, exported.
fn exported_of_any_wheels(name: &str, engine: Engine) -> (String, RobotFile) {
    let (_, text) = wheeled::file::BUILT_IN.iter().find(|(n, _)| *n == name).expect("built in");
    let file = RobotFile::parse(name, text).expect("a robot");
    let model = AnyWheelsModel {
        name,
        robot: &file.robot.plant,
        wheels: &file.robot.wheels,
        motors: &Input::in_si(&file.robot.motors),
        joints: &Input::in_si(&file.robot.joints),
        point: file.robot.point,
        told: &[],
    };
    (model.export(engine).expect("a model").text, file)
}

#[test]
fn robots_of_any_wheels_that_were_exported_read_back_the_same() {
    for name in ["torque-tricycle", "torque-car", "torque-omni-3", "torque-six-wheel"] {
        for engine in [Engine::Mjcf, Engine::Urdf, Engine::Sdf] {
            let (text, file) = exported_of_any_wheels(name, engine);
            let asked = of_kind(Kind::Wheeled);
            let made = import("again.xml", &text, &asked).unwrap_or_else(|e| panic!("{name} {engine:?}: {e}"));
            let again = RobotFile::parse("again.toml", &made.text).expect("a robot file").robot;
            let (got, wanted) = (&again.plant, &file.robot.plant);
            let near = |what: &str, got: f64, wanted: f64| {
                assert!(
                    (got - wanted).abs() < 2e-3 * wanted.abs() + 1e-3,
                    "{name} {engine:?} {what}: {got}, not {wanted}"
                );
            };
            near("mass", got.mass, wanted.mass);
            near("yaw inertia", got.yaw_inertia, wanted.yaw_inertia);
            (0..3).for_each(|k| near("centre of mass", got.com[k], wanted.com[k]));
            let turning = |robot: &wheeled::AnyWheels| robot.plant.wheels.iter().flatten().count();
            assert_eq!(turning(&again), turning(&file.robot), "{name} {engine:?}");
            for (at, name) in file.robot.wheels.iter().enumerate() {
                let name = name.replace(' ', "_");
                let of = again
                    .wheels
                    .iter()
                    .position(|n| n.starts_with(&name))
                    .unwrap_or_else(|| panic!("{:?}", again.wheels));
                let (Some(got), Some(wanted)) = (got.wheels[of], wanted.wheels[at]) else { panic!("{name}") };
                (0..2).for_each(|k| near("place", got.place[k], wanted.place[k]));
                near("radius", got.radius, wanted.radius);
                near("direction", (got.direction - wanted.direction).sin(), 0.0);
                assert_eq!(got.motor.is_some(), wanted.motor.is_some(), "{name} {engine:?}");
                assert_eq!(got.joint.is_some(), wanted.joint.is_some(), "{name} {engine:?}");
            }
        }
    }
}
