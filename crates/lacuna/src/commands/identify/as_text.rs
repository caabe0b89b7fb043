//! An identification for people.

use pages::text_table::{TextTable, number};

use super::Identification;
use super::follow::{COMPARISONS, Errors, Indices, SETTLED};
use super::lines::GAP_PERIODS;
use crate::commands::listed;
use crate::console::heading;

const SIDES: [&str; 2] = ["left", "right"];

/// The whole answer.
pub(super) fn render(done: &Identification, lost: &[String]) -> String {
    let (f, s) = (&done.followed, &done.samples);
    let certified = if f.holds() { "held" } else { "DID NOT HOLD" };
    let mut out = heading(&format!(
        "{}: exact identity to {:.1e} in every step, mean-square bound {certified}",
        done.recording,
        f.residual()
    ));
    out += &format!("  robot    {} ({})\n  state    {}\n  input    {}\n", done.robot, done.causality, s.state, s.input);
    out += &format!("  samples  {}\n", sampling(done));
    out += &format!(
        "  network  6 logistic units per side, seed {}; A = -{} I, gamma {}; speeds / {} rad/s, torques / {} N m\n",
        done.seed,
        f.pole,
        f.gain,
        number(f.speed_scale),
        number(f.torque_scale)
    );

    let settled = format!(">rmse after {SETTLED:.0} s");
    let mut table =
        TextTable::new(&["error", "side", ">max", ">at, s", ">rmse", &format!(">max after {SETTLED:.0} s"), &settled]);
    for (i, side) in SIDES.into_iter().enumerate() {
        table.row(errors("wheel speed, rad/s", side, &f.sides[i].errors));
    }
    for (i, side) in SIDES.into_iter().enumerate() {
        table.row(errors("same, constant regressor", side, &f.baseline[i]));
    }
    for (i, side) in SIDES.into_iter().enumerate() {
        if let Some(angles) = &f.angles {
            table.row(errors("wheel angle, rad", side, &angles[i]));
        }
    }
    out += &format!("\n{}{}", heading("Error indices"), table.render());

    let mut table =
        TextTable::new(&["comparison weights", "side", ">rms error, rad/s", ">bound, rad/s", "held", ">L rose in"]);
    for (c, what) in COMPARISONS.into_iter().enumerate() {
        for (i, side) in SIDES.into_iter().enumerate() {
            let b = &f.sides[i].bounds[c];
            let rms = |energy: f64| number((energy / f.duration).sqrt());
            let held = if b.holds { "yes" } else { "NO" };
            table.row([
                what.to_owned(),
                side.to_owned(),
                rms(b.error_energy),
                rms(b.limit),
                held.to_owned(),
                format!("{} steps", b.rises),
            ]);
        }
    }
    let title = "Certificate: mean-square bound, which holds for any comparison weights";
    out += &format!("\n{}{}", heading(title), table.render());
    out + &listed("Lost input", lost)
}

fn sampling(done: &Identification) -> String {
    let s = &done.samples;
    let period = number(1e3 * s.period);
    let mut out = match s.resampled {
        Some(_) => format!("{} at {period} ms: states by linear interpolation, inputs held", s.len()),
        None => format!("{} of the recording's own, usually {period} ms apart; inputs held", s.len()),
    };
    out += &match s.gaps() {
        0 => "; no gap".to_owned(),
        1 => "; 1 gap, after which the identifier started anew".to_owned(),
        n => format!("; {n} gaps, after each of which the identifier started anew"),
    };
    if s.gaps() > 0 {
        out += &format!(" (longer than {GAP_PERIODS} periods, or a signal missing)");
    }
    if s.dropped > 0 {
        out += &format!("; {} instants without all signals left out", s.dropped);
    }
    out
}

fn errors(what: &str, side: &str, e: &Errors) -> [String; 7] {
    let rmse = |i: &Indices| i.rmse().map_or("-".to_owned(), number);
    let late = if e.settled.rmse().is_some() { number(e.settled.max) } else { "-".to_owned() };
    [
        what.to_owned(),
        side.to_owned(),
        number(e.all.max),
        format!("{:.2}", e.all.max_at),
        rmse(&e.all),
        late,
        rmse(&e.settled),
    ]
}
