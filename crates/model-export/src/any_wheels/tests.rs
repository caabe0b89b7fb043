//! Models of the built-in robots.

use roxmltree::Document;
use wheeled::file::{BUILT_IN, RobotFile};

use super::{AnyWheelsModel, Input};
use crate::{Engine, ExportError, Exported};

fn robot(name: &str) -> RobotFile {
    let (_, text) = BUILT_IN.iter().find(|(n, _)| *n == name).expect("built in");
    RobotFile::parse(name, text).expect("a robot")
}

fn exported(file: &RobotFile, engine: Engine) -> Result<Exported, ExportError> {
    let model = AnyWheelsModel {
        name: &file.robot.name,
        robot: &file.robot.plant,
        wheels: &file.robot.wheels,
        motors: &Input::in_si(&file.robot.motors),
        joints: &Input::in_si(&file.robot.joints),
        point: file.robot.point,
        told: &[],
    };
    model.export(engine)
}

/// Sum of the masses of a model.
fn mass(text: &str, engine: Engine) -> f64 {
    let document = Document::parse(text).expect("XML");
    let of = |node: roxmltree::Node<'_, '_>| {
        match engine {
            Engine::Mjcf => node.has_tag_name("inertial").then(|| node.attribute("mass")).flatten(),
            Engine::Urdf => node.has_tag_name("mass").then(|| node.attribute("value")).flatten(),
            Engine::Sdf => node.has_tag_name("mass").then(|| node.text()).flatten(),
        }
        .map(|text| text.parse::<f64>().expect("a number"))
    };
    document.descendants().filter_map(of).sum()
}

#[test]
fn parts_weigh_what_the_robot_weighs_in_every_format() {
    for (name, _) in BUILT_IN {
        let file = robot(name);
        for engine in Engine::ALL {
            let Ok(model) = exported(&file, engine) else {
                assert_eq!((*name, engine), ("torque-mecanum-4", Engine::Mjcf));
                continue;
            };
            approx::assert_relative_eq!(mass(&model.text, engine), file.robot.plant.mass, max_relative = 1e-4);
            if engine == Engine::Urdf {
                let read = urdf_rs::read_from_string(&model.text).unwrap_or_else(|e| panic!("{name}: {e}"));
                let wheels = file.robot.wheels.len();
                let continuous = read.joints.iter().filter(|j| j.joint_type == urdf_rs::JointType::Continuous);
                assert_eq!(continuous.count(), wheels, "{name}");
            }
        }
    }
}

#[test]
fn rollers_that_lie_askew_have_their_direction_in_sdf_and_are_refused_for_mujoco() {
    let file = robot("torque-mecanum-4");
    let refused = exported(&file, Engine::Mjcf).unwrap_err().to_string();
    assert!(refused.contains("wheel front_left has rollers that lie askew") && refused.contains("SDF"), "{refused}");
    let told = exported(&file, Engine::Urdf).expect("a model").notes.join("; ");
    assert!(told.contains("rollers that lie askew, those of front_left, front_right"), "{told}");

    let text = exported(&file, Engine::Sdf).expect("a model").text;
    let document = Document::parse(&text).expect("XML");
    let directions: Vec<Vec<f64>> = document
        .descendants()
        .filter(|n| {
            n.has_tag_name("fdir1") && n.attributes().any(|a| a.name() == "expressed_in" && a.value() == "chassis")
        })
        .map(|n| n.text().expect("numbers").split(' ').map(|x| x.parse().expect("a number")).collect())
        .collect();
    // Upper rollers form an X seen from above: the lower ones, which touch the ground, a rhombus. Axles of the front left wheel's point
    // to the left behind, of the right one's to the left ahead.
    assert_eq!(directions.len(), 4);
    assert!(directions[0][0] < 0.0 && directions[0][1] > 0.0, "{directions:?}");
    assert!(directions[1][0] > 0.0 && directions[1][1] > 0.0, "{directions:?}");
}

#[test]
fn inertias_of_wheels_are_of_bodies_that_can_be() {
    for (name, _) in BUILT_IN {
        let read =
            urdf_rs::read_from_string(&exported(&robot(name), Engine::Urdf).expect("a model").text).expect("URDF");
        for link in read.links.iter().filter(|l| l.inertial.mass.value > 0.0) {
            let i = &link.inertial.inertia;
            assert!(i.ixx + i.izz >= i.iyy && i.ixx + i.iyy >= i.izz, "{name} {}: {i:?}", link.name);
        }
    }
}

#[test]
fn what_a_unit_of_a_command_is_stands_in_the_actuator_or_is_told() {
    let file = robot("torque-tricycle");
    let model = |engine: Engine| {
        AnyWheelsModel {
            name: "cart",
            robot: &file.robot.plant,
            wheels: &file.robot.wheels,
            motors: &file.robot.motors.iter().map(|name| Input { name, per_unit: 0.73 }).collect::<Vec<_>>(),
            joints: &Input::in_si(&file.robot.joints),
            point: [0.0; 3],
            told: &[],
        }
        .export(engine)
        .expect("a model")
    };
    assert!(model(Engine::Mjcf).text.contains("gainprm=\"0.73\"") && model(Engine::Mjcf).notes.is_empty());
    for engine in [Engine::Urdf, Engine::Sdf] {
        let told = model(engine).notes.join("; ");
        assert!(told.contains("the command of motor front is: multiply it by 0.73 to have N m"), "{told}");
        assert!(!told.contains("to have rad"), "{told}");
    }
}

#[test]
fn a_slope_is_the_gravity_of_a_world_and_told_where_there_is_none() {
    let mut file = robot("torque-car");
    file.robot.plant.ground.slope = [-0.5, 0.0];
    assert!(exported(&file, Engine::Mjcf).expect("a model").text.contains("gravity=\"-0.5 0 -9.7939\""));
    assert!(exported(&file, Engine::Sdf).expect("a model").text.contains("<gravity>-0.5 0 -9.7939</gravity>"));
    let told = exported(&file, Engine::Urdf).expect("a model").notes.join("; ");
    assert!(told.contains("the slope of the ground: set the gravity of the world to -0.5, 0, -9.7939"), "{told}");
}

#[test]
fn parts_without_names_are_refused() {
    let mut file = robot("torque-car");
    file.robot.motors.clear();
    let refused = exported(&file, Engine::Urdf).unwrap_err().to_string();
    assert_eq!(refused, "0 names for 1 motors; give one for each");
}
