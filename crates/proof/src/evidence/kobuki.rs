//! Track and friction of a Kobuki, from its bag or its tables, with no reference but its robot file.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::ask::{Answer, Question, ask};
use super::find::{DataRun, Kind};
use super::hide::Table;
use crate::binary::Binary;

const ROBOT: &str = "kobuki";
/// Metres per tick of the encoder and ticks of its counter; wheel radius, m: constants of the maker's driver.
const METRES_PER_TICK: f64 = 8.529e-5;
const COUNTER: f64 = 65536.0;
const RADIUS: f64 = 0.035;
/// Amperes per unit of the current.
const AMPERES: f64 = 0.01;
/// Rows over which a wheel's speed is taken.
const SPAN: usize = 5;

/// What came of one recording.
pub(super) struct Examined {
    pub(super) name: String,
    pub(super) answer: Answer,
    /// Track by the heading of the inertial unit's own filter, m, where it turned enough: the witness.
    pub(super) witness: Option<f64>,
    pub(super) document: Value,
}

impl Examined {
    /// Value and half of its 90 % interval of a load.
    pub(super) fn load(&self, quantity: &str) -> Option<[f64; 2]> {
        let r = self.answer.steady("ratios").iter().find(|r| r["quantity"] == quantity)?;
        Some([r["value"].as_f64()?, r["half"].as_f64()?])
    }
}

/// Way of a wheel by its counter, unwrapped, m.
fn way(ticks: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut out = vec![0.0; ticks.len()];
    for i in 1..ticks.len() {
        let step = (ticks[i] - ticks[i - 1] + 0.5 * COUNTER).rem_euclid(COUNTER) - 0.5 * COUNTER;
        sum += step * METRES_PER_TICK;
        out[i] = sum;
    }
    out
}

const MAPPING: &str = r#"name = "kobuki-table"

[[files]]
pattern = "base_*.csv"
time = { column = "t", unit = "s", rate_hz = 50.0 }

[files.signals]
wheel_speed_left = { column = "left", unit = "rad/s" }
wheel_speed_right = { column = "right", unit = "rad/s" }
current_left = { column = "current_left", unit = "A", magnitude_only = true }
current_right = { column = "current_right", unit = "A", magnitude_only = true }

[[files]]
pattern = "imu_*.csv"
time = { column = "t", unit = "s", rate_hz = 50.0 }

[files.signals]
gyro_z = { column = "wz", unit = "rad/s" }
"#;

/// Lays out the tables as recordings: wheel speeds by the encoders, currents in A.
fn lay_out(base: &Table, inertial: &Table, id: &str, folder: &Path) -> Result<PathBuf> {
    let t = base.column("t")?;
    let ways = [way(&base.column("left_encoder")?), way(&base.column("right_encoder")?)];
    let currents = [base.column("left_current_10mA")?, base.column("right_current_10mA")?];
    let half = SPAN / 2;
    let rows = (half..t.len().saturating_sub(half)).map(|i| {
        let (a, b) = (i - half, i + half);
        let speed = |w: &[f64]| (w[b] - w[a]) / (t[b] - t[a]) / RADIUS;
        vec![t[i], speed(&ways[0]), speed(&ways[1]), currents[0][i] * AMPERES, currents[1][i] * AMPERES]
    });
    let columns = ["t", "left", "right", "current_left", "current_right"].map(str::to_owned).to_vec();
    let table = Table { columns, rows: rows.filter(|r| r.iter().all(|x| x.is_finite())).collect() };
    let file = folder.join(format!("base_{id}.csv"));
    table.write(&file)?;
    inertial.only(&["t", "wz"])?.write(&folder.join(format!("imu_{id}.csv")))?;
    Ok(file)
}

/// Seconds over which a turn is measured, and the least that it must turn, rad.
const TURN_SECONDS: f64 = 0.5;
const LEAST_TURN: f64 = 0.1;

/// Track that makes the way of the wheels turn the heading as far as the unit's own filter says; `None` below one turn.
fn track_by_heading(base: &Table, inertial: &Table) -> Result<Option<f64>> {
    let (t, its) = (base.column("t")?, inertial.column("t")?);
    let ways = [way(&base.column("left_encoder")?), way(&base.column("right_encoder")?)];
    let (z, w) = (inertial.column("qz")?, inertial.column("qw")?);
    let heading = |i: usize| 2.0 * z[i].atan2(w[i]);
    if t.is_empty() {
        return Ok(None);
    }
    let rolled = |now: f64| {
        let k = t.partition_point(|x| *x < now).min(t.len() - 1);
        ways[1][k] - ways[0][k]
    };
    let (mut wheels, mut turned, mut from) = (0.0_f64, 0.0_f64, 0);
    for i in 0..its.len() {
        if its[i] - its[from] < TURN_SECONDS {
            continue;
        }
        let step = heading(i) - heading(from);
        let step = step.sin().atan2(step.cos());
        // Both ways of turning count; signs cancel nothing, and what hardly turns is left out.
        if step.abs() > LEAST_TURN {
            wheels += (rolled(its[i]) - rolled(its[from])) * step.signum();
            turned += step.abs();
        }
        from = i;
    }
    Ok((turned > std::f64::consts::TAU).then(|| wheels / turned))
}

/// Asks about one recording of a Kobuki.
pub(super) fn examine(binary: &Binary, found: &DataRun, out: &Path) -> Result<Examined> {
    let id = examiner::sha256(format!("evidence {}", found.name).as_bytes())[..8].to_owned();
    let verdict = out.join("verdicts").join(format!("{id}-kobuki.json"));
    let say = |mapping: &Path, recording: PathBuf| {
        let recordings = [recording];
        ask(
            binary,
            &Question { robot: ROBOT, mapping, references: &[], recordings: &recordings, held_out: &[] },
            &verdict,
        )
    };
    let (answer, witness) = match &found.kind {
        Kind::KobukiBag(folder) => (say(Path::new("kobuki-bag"), folder.clone())?, None),
        Kind::KobukiTable { base, inertial } => {
            let (base, inertial) = (Table::read(base)?, Table::read(inertial)?);
            let folder = out.join("seen/kobuki");
            let file = lay_out(&base, &inertial, &id, &folder)?;
            let mapping = folder.join("mapping.toml");
            std::fs::write(&mapping, MAPPING).with_context(|| format!("cannot write '{}'", mapping.display()))?;
            (say(&mapping, file)?, track_by_heading(&base, &inertial)?)
        }
        _ => anyhow::bail!("'{}' is no Kobuki", found.name),
    };
    let document = json!({
        "name": found.name,
        "id": id,
        "sentence": answer.sentences.join(" "),
        "sentences": answer.sentences,
        "verdict": answer.diagnosis["verdict"],
        "verdict_sha256": answer.sha256,
        "ranked": super::husky::ranked(&answer.diagnosis),
        "loads": answer.diagnosis["steady"]["ratios"],
        "withheld": answer.diagnosis["steady"]["withheld"],
        "clock": answer.diagnosis["steady"]["clocks"],
        "forecasts": answer.diagnosis["steady"]["forecasts"],
        "free_runs": answer.diagnosis["free_runs"],
        "track_by_heading_m": witness,
    });
    Ok(Examined { name: found.name.clone(), answer, witness, document })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_counter_wraps_and_the_heading_gives_the_track() {
        let track = 0.24;
        let base_columns = ["t", "left_encoder", "right_encoder"].map(str::to_owned).to_vec();
        let imu_columns = ["t", "qz", "qw"].map(str::to_owned).to_vec();
        let (mut base, mut inertial) = (Vec::new(), Vec::new());
        for i in 0..2000 {
            let t = f64::from(i) * 0.02;
            let (yaw, rolled) = (0.5 * t, 0.5 * t * track / 2.0);
            let ticks = |x: f64| (65000.0 + (x / METRES_PER_TICK).round()).rem_euclid(COUNTER);
            base.push(vec![t, ticks(-rolled), ticks(rolled)]);
            inertial.push(vec![t, (0.5 * yaw).sin(), (0.5 * yaw).cos()]);
        }
        let base = Table { columns: base_columns, rows: base };
        let inertial = Table { columns: imu_columns, rows: inertial };
        let found = track_by_heading(&base, &inertial).expect("columns").expect("it turned");
        assert!((found - track).abs() < 0.002, "{found}");
    }
}
