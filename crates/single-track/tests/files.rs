//! Robot files and tables: what is read, and what is refused in which words.

use std::fmt::Write as _;

use single_track::Drive;
use single_track::file::RobotFile;

const CAR: &str = include_str!("../robots/dart.toml");

fn table() -> String {
    let mut out = "time_s,x_m,y_m,yaw_rad,throttle,steering,safety,car_time_s,gyro_z,speed_encoder\n".to_owned();
    for k in 0..300_u32 {
        let t = 0.01 * f64::from(k);
        let (clock, command) = if k < 25 { (0.0, 0.0) } else { (50.0 + 0.1 * f64::from(k / 10), 0.2) };
        _ = writeln!(out, "{t:.2},{t},0.0,0.0,{command},0.1,1,{clock},0.0,{command}");
    }
    out
}

fn refused(from: &str, to: &str) -> String {
    assert!(CAR.contains(from), "{from}");
    RobotFile::parse("car.toml", &CAR.replace(from, to)).expect_err("no car").to_string()
}

#[test]
fn what_is_wrong_with_a_robot_file_is_one_sentence_with_its_remedy() {
    let wheelbase = "wheelbase = { value = 0.1735, sigma = 0.001, source = \"owner\" }\n";
    assert!(refused(wheelbase, "").contains("no wheelbase; add wheelbase"));
    let limit = "full_angle = { value = 0.40, sigma = 0.06, source = \"owner\" }\n";
    assert!(refused(limit, "").contains("the steering has no limits; add [steering] with full_angle"));
    assert!(refused("value = 0.40", "value = 25.0").contains("write radians below 1.57"));
    assert!(refused("value = 0.1735", "value = -0.1735").contains("wheelbase is -0.1735; it has to be above 0"));
    assert!(refused("value = 0.1735, sigma = ", "value = 0.1735, sigma = -").contains("sigma of wheelbase is -"));
    assert!(refused("value = 0.847", "value = 1.6").contains("front_axle_mass is 1.6 kg of a mass of 1.58 kg"));
    assert!(refused("yaw = \"yaw_rad\"\n", "").contains("give x, y and yaw, or none of them"));
    assert!(refused("kind = \"car\"", "kind = \"lorry\"").contains("belong to kind = \"car\""));
    assert!(refused("sigma = 0.001", "sigma = 0.0").contains("sigma of wheelbase is 0; it has to be above 0"));
    let tyres = |row: &str| refused("[steering]", &format!("[tyres]\n{row}\n[steering]"));
    let negative = tyres("rear_compliance = { value = -0.01 }");
    assert!(negative.contains("rear_compliance of [tyres] is -0.01; it has to be 0 or above"), "{negative}");
    let sure = tyres("rear_compliance = { value = 0.01, sigma = 0.0 }");
    assert!(sure.contains("sigma of rear_compliance of [tyres] is 0; it has to be above 0"), "{sure}");
    let ratio = refused("[steering]", "[gyro]\nscale = { value = 0.0 }\n[steering]");
    assert!(ratio.contains("scale of [gyro] is 0; it has to be above 0"), "{ratio}");
    let slope = refused("[steering]", "[ground]\nslope_x = { value = nan }\n[steering]");
    assert!(slope.contains("slope_x of [ground] is NaN; it has to be a number"), "{slope}");
    let twice = refused(wheelbase, &format!("{wheelbase}yaw_inertia_over_mass = {{ value = 0.01 }}\n"));
    assert!(twice.contains("yaw_inertia and yaw_inertia_over_mass; leave one of them out"), "{twice}");
}

#[test]
fn held_channels_are_read_at_the_instants_of_their_own_clock() {
    let file = RobotFile::parse("car.toml", CAR).expect("a car");
    let drive: Drive = file.drive(&testing::table("run", &table())).expect("a drive");
    assert!(drive.has_pose());
    assert!(drive.told.iter().any(|t| t.contains("reports every 0.100 s")), "{:?}", drive.told);
    assert!(drive.told.iter().any(|t| t.contains("first message is in row 26")), "{:?}", drive.told);
}

#[test]
fn what_is_wrong_with_a_table_is_one_sentence_with_its_place() {
    let file = RobotFile::parse("car.toml", CAR).expect("a car");
    let wrong = |table: &str| file.drive(&testing::table("run", table)).expect_err("no drive").to_string();
    assert!(wrong(&table().replacen("throttle", "gas", 1)).contains("no column 'throttle'; it has time_s"));
    assert!(wrong(&table().replacen("0.00,0,", "0.00,x,", 1)).contains("row 1, column 'x_m': 'x' is no number"));
    assert!(wrong(&table().replace(",0.1,1,", ",30,1,")).contains("steering command is 30, beyond ±1"));
    assert!(wrong(&table().replacen("0.01,", "0.00,", 1)).contains("time does not rise in row 2"));
    let plain = table();
    let lines = plain.lines().map(|line| format!("{line}\n")).enumerate();
    let in_milliseconds: String =
        lines.map(|(k, line)| if k == 0 { line } else { line.replacen('.', "", 1) }).collect();
    let refused = wrong(&in_milliseconds);
    assert!(refused.contains("its rows are 1 s apart") && refused.contains("time_unit = \"ms\""), "{refused}");
    let said = CAR.replacen("time = ", "time_unit = \"ms\"\ntime = ", 1);
    assert!(
        RobotFile::parse("car.toml", &said).expect("a car").drive(&testing::table("run", &in_milliseconds)).is_ok()
    );
    let blind = table().replacen("x_m", "a", 1).replacen("gyro_z", "b", 1);
    assert!(wrong(&blind).contains("neither a pose nor both a gyro and an encoder speed"));
}
