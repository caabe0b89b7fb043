//! Table 1 of the paper, and what counts as reproduced.
//!
//! The paper leaves open its robot, path, gains and first layer, so its digits cannot be reproduced by anybody. Judged
//! is the kind: rules (a) to (e) of [`judge`], fixed before the comparison.

use crate::statistics::{median, percentile_of, quantile, share, sorted};
use crate::{Draw, EVENTS, Windows};

/// Names of the indices of Table 1.
pub const NAMES: [&str; 4] = ["x3max", "x4max", "x3R", "x4R"];
/// The paper's values, rad/s (Table 1 of Hendzel & Trojnacki 2014).
pub const PAPER: [f64; 4] = [0.3237, 0.2517, 0.01976, 0.01917];
/// Largest relative residual of the identity that rounding explains.
pub const IDENTITY_TOLERANCE: f64 = 1e-10;
/// Smallest ratio of an event's error to the error when nothing happens.
const CONTRAST: f64 = 100.0;
/// Factor within which an index counts as near the paper's.
const FACTOR: f64 = 2.0;
/// Smallest share of draws that have all four indices within the factor, %.
const SHARE_WITHIN: f64 = 80.0;
/// Smallest share of draws with the largest error at the start, %.
const SHARE_START: f64 = 50.0;

/// How one index is distributed over the draws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distribution {
    /// Name of the index.
    pub name: &'static str,
    /// The paper's value, rad/s.
    pub paper: f64,
    /// Smallest, 5 %, median, 95 % and largest value, rad/s.
    pub quantiles: [f64; 5],
    /// Percentage of draws below the paper's value.
    pub percentile: f64,
}

/// One condition of a rule.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// The rule, a to e.
    pub rule: char,
    /// What is measured.
    pub name: String,
    /// What was found.
    pub value: f64,
    /// Unit of the value, empty if it has none.
    pub unit: &'static str,
    /// What is asked.
    pub target: String,
    /// Whether it is met.
    pub pass: bool,
}

/// The four distributions of Table 1; empty if there are no draws.
pub fn distributions(draws: &[Draw]) -> Vec<Distribution> {
    (0..4)
        .filter_map(|i| {
            let values = sorted(draws.iter().map(|d| d.table1()[i]));
            let q = |p| quantile(&values, p);
            Some(Distribution {
                name: NAMES[i],
                paper: PAPER[i],
                quantiles: [q(0.0)?, q(0.05)?, q(0.5)?, q(0.95)?, q(1.0)?],
                percentile: percentile_of(&values, PAPER[i]),
            })
        })
        .collect()
}

/// Judges an ensemble by the rules
///
/// * (a) five events at the right times: the median peak of each at least 100 times the median quiet error;
/// * (b) the error at the start is the largest in at least half of the draws;
/// * (c) the Lyapunov identity and the mean-square bound held in every step of every draw;
/// * (d) each median within a factor 2 of Table 1, the paper's two RMSE within the 5–95 % range;
/// * (e) all four indices within a factor 2 in at least 80 % of the draws.
pub fn judge(draws: &[Draw], windows: &Windows) -> Vec<Check> {
    let mut checks = Vec::new();
    events(draws, windows, &mut checks);
    for (wheel, name) in ["x3", "x4"].into_iter().enumerate() {
        let value = share(draws, |d| {
            let peak = &d.output[wheel].peak;
            peak[1..].iter().all(|p| *p < peak[0])
        });
        checks.push(at_least('b', format!("{name}: start peak largest"), value, "%", SHARE_START));
    }
    let residual = draws.iter().flat_map(|d| d.output.iter().map(|o| o.identity_residual)).fold(0.0_f64, |worst, r| {
        // `f64::max` would drop a residual that is not a number.
        if r.is_nan() || r > worst { r } else { worst }
    });
    checks.push(Check {
        rule: 'c',
        name: "Lyapunov identity, largest relative residual".into(),
        value: residual,
        unit: "",
        target: format!("<= {IDENTITY_TOLERANCE:.0e}"),
        pass: residual <= IDENTITY_TOLERANCE,
    });
    let bound = share(draws, |d| d.output.iter().all(|o| o.mean_square_bound_holds));
    checks.push(at_least('c', "mean-square bound held".into(), bound, "%", 100.0));
    for d in distributions(draws) {
        let ratio = d.quantiles[2] / d.paper;
        checks.push(Check {
            rule: 'd',
            name: format!("{}: median / paper", d.name),
            value: ratio,
            unit: "",
            target: format!("{} to {}", 1.0 / FACTOR, FACTOR),
            pass: near(ratio),
        });
        if d.name.ends_with('R') {
            checks.push(Check {
                rule: 'd',
                name: format!("{}: percentile of the paper's value", d.name),
                value: d.percentile,
                unit: "%",
                target: "5 to 95".into(),
                pass: d.quantiles[1] <= d.paper && d.paper <= d.quantiles[3],
            });
        }
    }
    let name = format!("all four within x{FACTOR}");
    checks.push(at_least('e', name, within(draws, FACTOR), "%", SHARE_WITHIN));
    checks
}

fn events(draws: &[Draw], windows: &Windows, checks: &mut Vec<Check>) {
    for (wheel, name) in ["x3", "x4"].into_iter().enumerate() {
        let median = |f: &dyn Fn(&Draw) -> f64| median(draws.iter().map(f));
        let quiet = median(&|d| d.output[wheel].quiet_rms);
        for (i, event) in EVENTS.iter().enumerate() {
            let contrast = median(&|d| d.output[wheel].peak[i]) / quiet;
            let at = median(&|d| d.output[wheel].peak_at[i]);
            let mut check = at_least('a', format!("{name}: {event}, peak / quiet"), contrast, "", CONTRAST);
            if !(windows.start[i]..=windows.peak_until[i]).contains(&at) {
                check.pass = false;
                check.target = format!("{}, but its peak at {at:.2} s is not in time", check.target);
            }
            checks.push(check);
        }
    }
}

/// Share of draws with all four indices within `factor` of the paper's, %.
pub fn within(draws: &[Draw], factor: f64) -> f64 {
    share(draws, |d| d.table1().iter().zip(PAPER).all(|(v, p)| (1.0 / factor..=factor).contains(&(v / p))))
}

fn near(ratio: f64) -> bool {
    (1.0 / FACTOR..=FACTOR).contains(&ratio)
}

fn at_least(rule: char, name: String, value: f64, unit: &'static str, target: f64) -> Check {
    Check { rule, name, value, unit, target: format!(">= {target}"), pass: value >= target }
}

/// The draw whose four indices lie nearest to the medians: a typical one for figures, not a favourable one.
pub fn typical<'a>(draws: &'a [Draw]) -> Option<&'a Draw> {
    let medians: Vec<f64> = distributions(draws).iter().map(|d| d.quantiles[2]).collect();
    let distance = |d: &'a Draw| d.table1().iter().zip(&medians).map(|(v, m)| (v - m).abs() / m).sum::<f64>();
    draws.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
