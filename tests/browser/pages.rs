//! The pages that are opened: diagnoses of all three kinds of robots, made here, and the parts of other pages.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use case_files::case_folder::{self, CaseFolder};
use case_files::envelope::Envelope;
use case_files::report_page;
use command_driven::diagnose_response;
use examiner::{Content, EffectId, Setting, Settings, Severity, TyreLaw};
use inference::Options;
use pages::page::Page;
use pages::reproduction::{Signals, figures};
use recordings::ReadOptions;
use report::diagnosis_page::{Provenance, render};
use report::fleet::{DiagnosedRecording, Finding, Named};
use skipping::{Skipped, beside};
use speed_driven::diagnose_steady;
use torque_driven::diagnose;
use verdict::{Advice, Compared, Diagnosis, Manoeuvre, Trace, Verdict};

/// A name that would do harm if it became markup.
pub(crate) const HOSTILE: &str = "</script><img src=x onerror=\"window.harm=1\">&\u{2028}";
/// A peak of one window in an hour.
pub(crate) const PEAK: f64 = 50.0;
/// A gap, s.
pub(crate) const GAP: [f64; 2] = [2000.0, 2030.0];

/// All pages by name, but for that of a real robot.
pub(crate) fn all() -> Vec<(&'static str, String)> {
    vec![
        ("torque", torque()),
        ("command", command()),
        ("hour", long()),
        ("reproduction", reproduction()),
        ("fleet", fleet()),
    ]
}

fn packed(diagnosis: Diagnosis, case: &CaseFolder, mapping: &str) -> String {
    let envelope = Envelope::new(diagnosis, case, &Options::default(), mapping, "normal").expect("packs");
    report_page::page(&envelope)
}

fn opened(folder: &Path, robot: Option<&str>) -> CaseFolder {
    let mapping = case_folder::mapping("skid-steer-columns").expect("built in");
    CaseFolder::open(folder, robot, &mapping, &ReadOptions::default()).expect("a case")
}

/// A torque-driven robot of the examiner's with friction hidden.
fn torque() -> String {
    let settings = Settings {
        content: Content::Effects(vec![EffectId::ViscousFriction]),
        severity: Some(Severity::Strong),
        setting: Some(Setting::Normal),
        law: Some(TyreLaw::Brush),
        recordings: Some(3),
        duration_s: 16.0,
        ..Settings::default()
    };
    let drawn = examiner::Case::draw("x", 3, &settings).expect("sensible settings");
    let folder = tempfile::tempdir().expect("a folder");
    for (path, bytes) in &drawn.files {
        let file = folder.path().join(path);
        fs::create_dir_all(file.parent().expect("a folder")).expect("writable");
        fs::write(file, bytes).expect("writable");
    }
    let case = opened(folder.path(), None);
    let d = diagnose(&case.torque_driven().expect("a case"), &Options::default(), &|_| {}).expect("a diagnosis");
    packed(d, &case, "skid-steer-columns")
}

/// A command-driven robot whose wheels lag and whose body turns on a wider track.
fn command() -> String {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir_all(folder.path().join("recordings")).expect("writable");
    let mut text = String::from(
        "time_s,command_speed_left_rad_s,command_speed_right_rad_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,\
         pose_x_m,pose_y_m,pose_yaw_rad\n",
    );
    let (mut wheel, mut yaw, mut at) = ([0.0_f64; 2], 0.0_f64, [0.0_f64; 2]);
    for k in 0..2400_u32 {
        let step = f64::from(k / 100);
        let asked = [4.0 * (1.7 * step).sin(), 4.0 * (2.9 * step).cos()];
        // Roughness that repeats nowhere: an encoder's last digits.
        let rough = |s: f64| 0.05 * (f64::from(k) * 7.3 + s).sin();
        let [l, r] = [wheel[0] + rough(0.0), wheel[1] + rough(1.0)];
        let t = f64::from(k) * 0.05;
        writeln!(text, "{t:.2},{:.4},{:.4},{l:.4},{r:.4},{:.4},{:.4},{yaw:.5}", asked[0], asked[1], at[0], at[1])
            .expect("text");
        let forward = 0.5 * 0.165 * (wheel[0] + wheel[1]);
        at = [at[0] + 0.05 * forward * yaw.cos(), at[1] + 0.05 * forward * yaw.sin()];
        yaw += 0.05 * 0.165 * (wheel[1] - wheel[0]) / 1.0;
        for s in 0..2 {
            wheel[s] += (1.0 - (-0.05_f64 / 0.3).exp()) * (asked[s] - wheel[s]);
        }
    }
    fs::write(folder.path().join("recordings/run_1.csv"), text).expect("writable");
    let case = opened(folder.path(), Some("husky-drive"));
    let d = diagnose_response(&case.command_driven().expect("a case"), &inference::Options::default(), &|_| {})
        .expect("a diagnosis");
    packed(d, &case, "skid-steer-columns")
}

/// A real speed-driven robot on sand, where its recordings lie beside the repository.
pub(crate) fn speed() -> Result<String, Skipped> {
    let data = beside("data/husky-open")?;
    let mapping = case_folder::mapping("husky-open").expect("built in");
    let robot = case_folder::robot("husky-a200").expect("built in");
    let paths = [vec![data.join("FLOORING")], vec![data.join("SANDY_LOAM")], vec![]];
    let case = CaseFolder::from_paths(robot, [&paths[0], &paths[1], &paths[2]], &mapping, &ReadOptions::default());
    let case = case.expect("readable");
    let d = diagnose_steady(&case.speed_driven().expect("speeds and currents"), &Options::default(), &|_| {})
        .expect("a diagnosis");
    Ok(packed(d, &case, "husky-open"))
}

/// An hour of recording with a gap, a peak, free runs of 2 s and names that would like to be markup.
pub(crate) fn long() -> String {
    let windows = 36_000_usize;
    let time: Vec<f64> = (0..windows).map(|i| 0.1 * i as f64 + 0.05).collect();
    let wave = |scale: f64| -> Vec<Option<f64>> {
        let value = |(i, t): (usize, &f64)| if i == 12_345 { PEAK * scale } else { scale * (0.01 * t).sin() };
        time.iter().enumerate().map(value).map(Some).collect()
    };
    let in_gap = |t: f64| (GAP[0]..GAP[1]).contains(&t);
    let recorded = wave(1.0).into_iter().zip(&time).map(|(v, t)| v.filter(|_| !in_gap(*t))).collect();
    let channel = |signal: &str| Compared {
        signal: signal.to_owned().into(),
        unit: "rad/s".into(),
        recorded: Vec::clone(&recorded),
        nominal: wave(1.3),
        corrected: wave(1.01),
        usual: Some(0.1),
        ..Compared::default()
    };
    let trace = Trace {
        recording: HOSTILE.to_owned(),
        restarts: (0..windows).step_by(20).collect(),
        channels: vec![channel(HOSTILE), channel("yaw rate")],
        path: time.iter().map(|t| [(0.01 * t).cos(), (0.02 * t).sin()]).collect(),
        before: vec![Some(90.0); windows],
        after: vec![Some(1.0); windows],
        time,
        ..Trace::default()
    };
    let d = Diagnosis {
        verdict: Verdict::Unknown,
        sentences: vec![format!("Something is missing in {HOSTILE}.")],
        traces: vec![trace],
        limits: vec![HOSTILE.to_owned()],
        next: Some(advice()),
        ..Diagnosis::withheld()
    };
    let from = Provenance { robot: HOSTILE.to_owned(), lost: vec![HOSTILE.to_owned()], ..Provenance::default() };
    render(&d, &from)
}

/// What to drive next, by a name that would do harm.
fn advice() -> Advice {
    let drive = Manoeuvre {
        name: HOSTILE.to_owned(),
        why: format!("It tells {HOSTILE}."),
        expected_bits: 0.8,
        splits: None,
        narrows: None,
        joins: true,
        optimised: false,
        start: [0.0; 3],
        profile: vec![[0.0; 3], [2.0, 0.5, 0.2], [4.0, 0.0, 0.0]],
        torque_free: Vec::new(),
        direction: 0.0,
    };
    Advice { entropy_bits: 1.0, manoeuvres: vec![drive], ..Advice::default() }
}

/// A fleet of which one robot wears, with names that would like to be markup.
pub(crate) fn fleet() -> String {
    let sized = |magnitude: f64| Named {
        effect: "coulomb_side".to_owned(),
        name: format!("dragging brake {HOSTILE}"),
        side: Some("left".to_owned()),
        probability: 0.97,
        magnitude: Some(magnitude),
        interval: Some([magnitude - 0.1, magnitude + 0.1]),
        unit: "N m".to_owned(),
    };
    let seen = (0..60_i32).map(|number| DiagnosedRecording {
        id: format!("run_{number} {HOSTILE}"),
        robot: format!("unit-{} {HOSTILE}", number % 3),
        date: Some(1_767_225_600_000 + 86_400_000 * i64::from(number)),
        finding: match number % 3 {
            0 if number > 20 => Finding::Explained(vec![sized(1.0 + 0.02 * f64::from(number))]),
            1 if number > 3 => Finding::Explained(vec![sized(0.7)]),
            2 if number < 9 => Finding::Failed(HOSTILE.to_owned()),
            _ => Finding::NoMismatch,
        },
    });
    report::fleet::render(&seen.collect::<Vec<_>>(), HOSTILE)
}

/// The figures of the page of the reproduction.
fn reproduction() -> String {
    let time: Vec<f64> = (0..5000).map(|i| 0.01 * f64::from(i)).collect();
    let pair = |scale: f64| {
        let wave = |by: f64| time.iter().map(|t| by * scale * t.sin()).collect::<Vec<f64>>();
        [wave(1.0), wave(0.7)]
    };
    let signals = Signals {
        path: [time.iter().map(|t| t.cos()).collect(), time.iter().map(|t| t.sin()).collect()],
        desired: [time.iter().map(|t| 1.1 * t.cos()).collect(), time.iter().map(|t| 1.1 * t.sin()).collect()],
        torque: pair(2.0),
        angle: pair(3.0),
        angle_estimate: pair(3.1),
        angle_error: pair(0.1),
        angle_error_estimated_speed: pair(0.2),
        speed: pair(4.0),
        speed_estimate: pair(4.1),
        speed_error: pair(0.3),
        weight: [pair(1.0).to_vec(), pair(2.0).to_vec()],
        events: vec![1.0, 5.0, 20.0, 30.0, 40.0],
        time,
    };
    let mut page = Page::new("The paper, reproduced");
    page.paragraph("Figures of a made-up draw.");
    page.table(&["index", "paper", "here"], &[vec!["E1".into(), "1.0".into(), "1.1".into()]]);
    figures(&mut page, "One draw.", &signals);
    page.render()
}
