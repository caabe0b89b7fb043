//! Left-out drives forecast from throttle and steering: `left_out ROBOT CSV...`.

use single_track::file::RobotFile;
use single_track::{Case, LENGTHS, examine};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let robot = args.next().ok_or("which robot?")?;
    let file = RobotFile::parse(&robot, &std::fs::read_to_string(&robot)?)?;
    let mut recordings = Vec::new();
    for path in args {
        let name = std::path::Path::new(&path).file_stem().and_then(|n| n.to_str()).unwrap_or("drive").to_owned();
        recordings.push(file.drive(&name, &std::fs::read_to_string(&path)?)?);
    }
    let case = Case { car: file.car, references: Vec::new(), recordings };
    let (findings, table) = examine(&case, &|stage| eprintln!("{stage}"))?;
    println!(
        "{:?} noise {:.4?} scatter {:.2} shares {:.3?} counts {:?}",
        findings.answer, findings.noise, findings.scatter, findings.shares, findings.counts
    );
    for cause in &findings.named {
        println!("  {} {:.2} alike {:?}", cause.label, cause.probability, cause.alike);
    }
    for e in &findings.constants {
        println!(
            "  {:44} {:9.5} -> {:9.5} +- {:.5} {} ({:.1} sigmas)",
            e.name, e.given, e.value, e.half_width, e.unit, e.sigmas
        );
    }
    for (name, errors) in &table.rows {
        print!("{name:52}");
        for errors in errors {
            let [p, h] = errors.medians().unwrap_or([f64::NAN; 2]);
            print!(" {:7.1} mm {:6.1} mrad", 1e3 * p, 1e3 * h);
        }
        println!();
    }
    println!("lengths {LENGTHS:?} s");
    for ((drive, errors), named) in table.by_drive.iter().zip(&table.named) {
        let of = |row: usize| errors[row][2].medians().map_or(f64::NAN, |m| 1e3 * m[0]);
        println!("  {drive} {:?} {named:?}", (0..errors.len()).map(|r| of(r).round()).collect::<Vec<_>>());
    }
    Ok(())
}
