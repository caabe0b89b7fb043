use super::*;

fn read_as(name: &str, text: &str, defaults: &Defaults) -> Result<Vec<Unit>> {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("own.toml"), "x").expect("writes");
    let file = folder.path().join(name);
    fs::write(&file, text).expect("writes");
    let cut = |path: &PathBuf| path.strip_prefix(folder.path()).unwrap_or(path).to_owned();
    let mut units = read(&file, defaults)?;
    for unit in &mut units {
        unit.recording = unit.recording.iter().map(cut).collect();
        unit.setup.reference = unit.setup.reference.iter().map(cut).collect();
        unit.setup.robot = cut(&PathBuf::from(&unit.setup.robot)).display().to_string();
    }
    Ok(units)
}

/// The message without the folder of the list.
fn refused(name: &str, text: &str) -> String {
    let error = read_as(name, text, &Defaults::default()).expect_err(text);
    let error = format!("{error:#}");
    error.split_once(&format!("/{name}: ")).map_or(error.clone(), |(_, rest)| rest.to_owned())
}

#[test]
fn csv_and_json_lines_say_the_same() {
    let csv = "recording,robot,robot_id,reference,date,operator\n\
               a/pro_1.csv;a/imu_1.csv,husky-a200,unit-17,good;better,2026-03-01,Ann\n\
               \"b, c/run.csv\",own.toml,,,2026-03-02T08:00:00+01:00,\n";
    let json = "{\"recording\": [\"a/pro_1.csv\", \"a/imu_1.csv\"], \"robot\": \"husky-a200\", \"robot_id\": \"unit-17\", \
                \"reference\": \"good;better\", \"date\": \"2026-03-01\", \"operator\": 7}\n\n\
                {\"recording\": \"b, c/run.csv\", \"robot\": \"own.toml\", \"date\": \"2026-03-02T07:00:00Z\", \"mapping\": null}\n";
    let units = read_as("list.csv", csv, &Defaults::default()).expect("reads");
    assert_eq!(units, read_as("list.jsonl", json, &Defaults::default()).expect("reads"));
    assert_eq!((units[0].id.as_str(), units[1].id.as_str()), ("a/pro_1", "b, c/run"));
    assert_eq!(units[0].recording.len(), 2);
    assert_eq!(units[0].setup.reference, [PathBuf::from("good"), PathBuf::from("better")]);
    assert_eq!((units[0].robot_id.as_deref(), &units[1].robot_id), (Some("unit-17"), &None));
    assert_eq!(units[1].date.map(|d| d.to_string()).as_deref(), Some("2026-03-02T07:00:00Z"));
    assert_eq!(units[1].setup.robot, "own.toml");
}

#[test]
fn what_a_line_leaves_out_is_that_of_the_command_line() {
    let defaults = Defaults {
        robot: Some("kobuki".to_owned()),
        reference: vec![PathBuf::from("floor")],
        mapping: Some("kobuki-bag".to_owned()),
    };
    let units = read_as("list.csv", "recording,reference\na.mcap,\nb.mcap,own\n", &defaults).expect("reads");
    assert_eq!(units[0].setup.robot, "kobuki");
    assert_eq!(units[0].setup.reference, [PathBuf::from("floor")]);
    assert_eq!(units[1].setup.reference, [PathBuf::from("own")]);
    assert_eq!(units[1].setup.mapping.as_deref(), Some("kobuki-bag"));
}

#[test]
fn mistakes_are_reported_with_their_place_and_the_nearest_name() {
    for (text, told) in [
        ("recordings,robot\n", "line 1, column 1: unknown column `recordings`; did you mean `recording`?"),
        ("robot,robot_if,recording\n", "line 1, column 7: unknown column `robot_if`; did you mean `robot_id`?"),
        ("robot\nx\n", "line 1, column 1: the header has no column `recording`"),
        ("recording\n", "line 1, column 1: the list names no recording"),
        ("recording,robot\na.csv\n", "line 2, column 1: this line has 1 fields, the header 2"),
        (
            "recording,robot\na.csv,huskya200\n",
            "line 2, column 7: there is no robot `huskya200`; did you mean `husky-a200`?",
        ),
        ("recording,robot\na.csv,x/y.toml\n", "line 2, column 7: there is no robot file"),
        ("recording\na.csv\n", "line 2, column 1: this line names no robot"),
        ("recording,robot\n,kobuki\n", "line 2, column 1: this line names no recording"),
        (
            "recording,robot,date\na.csv,kobuki,1.3.2026\n",
            "line 2, column 14: `1.3.2026` is no date; write it as 2026-03-01",
        ),
        ("recording,robot,mapping\n\"a,b.csv\",kobuki,kobuki-bug\n", "line 2, column 18: "),
        (
            "id,recording,robot\nx,a.csv,kobuki\ny,b.csv,kobuki\nx,c.csv,kobuki\n",
            "line 4, column 1: the id `x` is that of line 2 already",
        ),
    ] {
        let message = refused("list.csv", text);
        assert!(message.starts_with(told), "{message}\n{told}");
    }
    for (text, told) in [
        ("{\"recording\": 1}", "line 1, column 2: `recording` is a text, not 1"),
        ("{\"recording\": [1]}", "line 1, column 2: `recording` is a path or a list of paths"),
        (
            "\n{\"recording\": \"a\", \"robt\": \"kobuki\"}",
            "line 2, column 20: unknown column `robt`; did you mean `robot`?",
        ),
        ("{\"recording\": \"a\"", "line 1, column 17: this line is no JSON object"),
    ] {
        let message = refused("list.jsonl", text);
        assert!(message.starts_with(told), "{message}\n{told}");
    }
}
