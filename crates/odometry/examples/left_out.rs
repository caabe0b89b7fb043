//! Left-out sessions forecast from counts alone: `left_out ROBOT CSV...`, a built-in robot or a robot file.

use odometry::file::RobotFile;
use odometry::{Case, LENGTHS, diagnose, left_out};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let robot = args.next().ok_or("which robot?")?;
    let file = match RobotFile::built_in(&robot) {
        Some(file) => file?,
        None => RobotFile::parse(&robot, &std::fs::read_to_string(&robot)?)?,
    };
    let mut recordings = Vec::new();
    for path in args {
        let name = std::path::Path::new(&path).file_stem().and_then(|n| n.to_str()).unwrap_or("drive").to_owned();
        recordings.push(file.drive(&name, &std::fs::read_to_string(&path)?)?);
    }
    let case = Case { robot: file.robot, references: Vec::new(), recordings };
    let findings = diagnose(&case, &|_| {})?;
    println!(
        "{:?} noise {:.4} scatter {:.2} shares {:.3?}",
        findings.answer, findings.noise, findings.scatter, findings.shares
    );
    for cause in &findings.named {
        println!("  {} {:.2} alike {:?}", cause.label, cause.probability, cause.alike);
    }
    for e in &findings.constants {
        println!(
            "  {:36} {:9.5} -> {:9.5} +- {:.5} {} ({:.1} sigmas)",
            e.name, e.given, e.value, e.half_width, e.unit, e.sigmas
        );
    }
    let table = left_out(&case, &|_| {})?;
    for (name, errors) in &table.rows {
        print!("{name:52}");
        for errors in errors {
            let [p, h] = errors.medians().unwrap_or([f64::NAN; 2]);
            print!(" {:7.1} mm {:6.1} mrad", 1e3 * p, 1e3 * h);
        }
        println!();
    }
    println!("lengths {LENGTHS:?} s");
    for ((session, errors), named) in table.by_session.iter().zip(&table.named) {
        let of = |row: usize| errors[row][2].medians().map_or(f64::NAN, |m| 1e3 * m[0]);
        println!("  {session} {:?} {named:?}", (0..errors.len()).map(|r| of(r).round()).collect::<Vec<_>>());
    }
    Ok(())
}
