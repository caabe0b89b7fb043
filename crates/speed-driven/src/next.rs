//! The next drive of a speed-driven robot: which steady loads would tell the remaining effects apart.
//!
//! Every rival predicts the loads of a drive by the plant; another is off by `Δμ`, and
//! `d = ½ Δμᵀ (R + S P Sᵀ)⁻¹ Δμ` with the scatter and tuning doubt of the loads in R and its own doubt of sizes in P.

use faer::Mat;
use inference::expected_information::{Forecast, expected_bits, widest_pair};
use inference::robust::NINETY;
use robot_model::Robot;
use robot_model::tunable::COUNT as NUISANCES;
use verdict::{Advice, Contender, Course, Manoeuvre, Quantity};

use crate::compare::scatter;
use crate::settings::{NAMING, naming::NextDrive};
use crate::{Named, Naming, Operating, Tuned, predicted, sensitivity};
use inference::advice::{LEAST_BITS, LEAST_RIVAL, MOST_RIVALS, among, nothing_to_split, sorted};
use inference::algebra::solve_spd;
use robot_model::tunable::tuned;

const NEXT: NextDrive = NAMING.next;

/// A drive of steady levels: speeds of the left and right side, m/s, with what each is compared in.
struct Drive {
    name: &'static str,
    levels: Vec<([f64; 2], Quantity)>,
}

fn menu(fastest: f64) -> Vec<Drive> {
    let [slow, medium, fast] = NEXT.speeds.map(|share| share * fastest);
    let straight = |v: f64| ([v, v], Quantity::StraightLoad);
    let spin = |v: f64| ([-v, v], Quantity::SpinSum);
    let arc = |v: f64| ([NEXT.inner * v, v], Quantity::TurningLoad);
    let turned = |([l, r], q): ([f64; 2], Quantity)| ([r, l], q);
    let sides = |v: f64| [straight(v), ([v, v], Quantity::Asymmetry)];
    vec![
        Drive { name: "straight at three speeds", levels: vec![straight(slow), straight(medium), straight(fast)] },
        Drive { name: "straight ahead and back, slow", levels: vec![straight(slow), straight(-slow)] },
        Drive { name: "straight ahead and back, fast", levels: vec![straight(fast), straight(-fast)] },
        Drive { name: "straight, both sides compared", levels: [sides(medium), sides(fast)].concat() },
        Drive { name: "slow spins, both ways", levels: vec![spin(slow), turned(spin(slow))] },
        Drive { name: "fast spins, both ways", levels: vec![spin(medium), turned(spin(medium))] },
        Drive {
            name: "spins, both sides compared",
            levels: vec![spin(medium), ([-medium, medium], Quantity::SpinAsymmetry)],
        },
        Drive { name: "spins at three speeds", levels: vec![spin(NEXT.slowest * slow), spin(slow), spin(medium)] },
        Drive { name: "circles of one radius, both ways", levels: vec![arc(medium), turned(arc(medium))] },
        Drive { name: "straight, then a spin", levels: vec![straight(medium), spin(medium)] },
    ]
}

/// One rival: an effect or two at fitted sizes, or nothing.
struct Rival<'a> {
    named: Option<&'a Named>,
    contender: Contender,
}

fn rivals(naming: &Naming) -> Vec<Rival<'_>> {
    let mut found: Vec<(Vec<&str>, Option<&Named>, f64)> = vec![(Vec::new(), None, 0.0)];
    found.extend(naming.causes().into_iter().map(|e| {
        let mut ids = e.ids();
        ids.sort_unstable();
        (ids, Some(e), e.score)
    }));
    let top = found.iter().map(|f| f.2).fold(f64::MIN, f64::max);
    let weight = |s: f64| (s - top).exp();
    let sum: f64 = found.iter().map(|f| weight(f.2)).sum();
    found.retain(|f| weight(f.2) >= LEAST_RIVAL * sum);
    found.sort_by(|a, b| b.2.total_cmp(&a.2));
    found.truncate(MOST_RIVALS);
    let sum: f64 = found.iter().map(|f| weight(f.2)).sum();
    let name = |named: Option<&Named>| named.map_or("nothing is missing".to_owned(), Named::name);
    found
        .into_iter()
        .map(|(ids, named, score)| Rival {
            named,
            contender: Contender {
                effects: ids.iter().map(|id| (*id).to_owned()).collect(),
                name: name(named),
                probability: weight(score) / sum,
            },
        })
        .collect()
}

/// Advises on the next drive, no faster than `fastest`, m/s; `naming` is `None` where no load could be compared.
pub(crate) fn advise_steady(
    fastest: f64,
    robot: &Robot<f64>,
    sigma: &[f64; NUISANCES],
    calibrated: &Tuned,
    naming: Option<&Naming>,
) -> Advice {
    let Some(naming) = naming else {
        return Advice::withheld(
            "no load of these recordings can be compared, so there are no \
             causes to tell apart; record longer steady driving",
        );
    };
    let rivals = rivals(naming);
    let mut out = among(rivals.iter().map(|r| r.contender.clone()));
    let p: Vec<f64> = out.rivals.iter().map(|r| r.probability).collect();
    let model = tuned(robot, sigma, &calibrated.theta);
    for drive in menu(fastest) {
        let at: Vec<Operating> =
            drive.levels.iter().map(|&(speed, quantity)| Operating { quantity, speed, right_outer: 1.0 }).collect();
        let doubt = doubt(&at, &sensitivity(robot, sigma, &calibrated.theta, &at), calibrated);
        let Some(views) = views(&model, &at, &doubt, &rivals) else { continue };
        let mut m = Manoeuvre::new(drive.name, course(&drive, robot), [0.0; 3]);
        m.expected_bits = expected_bits(&p, &views, NAMING.answer.temperature);
        if let Some((k, l)) = widest_pair(&p, &views, NAMING.answer.temperature) {
            let [a, b] = [k, l].map(|i| rivals[i].contender.name.clone());
            m.why = why(&at, &model, &rivals[k], &rivals[l]);
            m.splits = Some([a, b]);
        }
        out.manoeuvres.push(m);
    }
    let most = out.manoeuvres.iter().map(|m| m.expected_bits).fold(0.0, f64::max);
    out.withheld = nothing_to_split(&out);
    if most >= LEAST_BITS {
        out.limits.push("hold each speed for ten seconds at least, all on the same ground".to_owned());
    }
    sorted(out)
}

fn course(drive: &Drive, robot: &Robot<f64>) -> Course {
    let mut levels: Vec<[f64; 2]> = Vec::new();
    for ([l, r], _) in &drive.levels {
        let level = [0.5 * (l + r), 0.5 * (r - l) / robot.turning_lever()];
        if levels.last() != Some(&level) {
            levels.push(level);
        }
    }
    let length = NEXT.each * levels.len() as f64;
    Course::of_levels(&levels, length)
}

/// Covariance of the loads of a drive: scatter from run to run, what tuning leaves open, and what loads every straight
/// drive of a day alike.
fn doubt(at: &[Operating], by_constants: &Mat<f64>, calibrated: &Tuned) -> Mat<f64> {
    let tuning = by_constants * &calibrated.covariance * by_constants.transpose();
    let unnamed = (NAMING.priors.unnamed_straight.ln() / NINETY).powi(2);
    let straight = |o: &Operating| o.quantity == Quantity::StraightLoad;
    Mat::from_fn(at.len(), at.len(), |a, b| {
        let own = if a == b { scatter(at[a].quantity).powi(2) + NEXT.measured.powi(2) } else { 0.0 };
        own + tuning[(a, b)] + if straight(&at[a]) && straight(&at[b]) { unnamed } else { 0.0 }
    })
}

fn loads(model: &Robot<f64>, at: &[Operating], named: Option<&Named>) -> Vec<f64> {
    let doses = named.map_or_else(Vec::new, Named::doses);
    at.iter().map(|o| predicted(model, &doses, *o)).collect()
}

/// Columns of a rival's sizes times how well each is known.
fn by_sizes(model: &Robot<f64>, at: &[Operating], named: &Named, base: &[f64]) -> Mat<f64> {
    let free: Vec<_> = named.free.iter().flatten().collect();
    let columns: Vec<Vec<f64>> = free
        .iter()
        .enumerate()
        .map(|(i, f)| {
            let mut shifted = named.clone();
            let step = NEXT.shift * f.unit;
            shifted.values[i] += step;
            let known = named.sigma[i].min(NEXT.widest * f.unit);
            loads(model, at, Some(&shifted)).iter().zip(base).map(|(y, b)| (y - b) / step * known).collect()
        })
        .collect();
    Mat::from_fn(at.len(), columns.len(), |i, c| columns[c][i])
}

fn views(model: &Robot<f64>, at: &[Operating], doubt: &Mat<f64>, rivals: &[Rival<'_>]) -> Option<Vec<Forecast>> {
    let shown: Vec<Vec<f64>> = rivals.iter().map(|r| loads(model, at, r.named)).collect();
    let (n, m) = (rivals.len(), at.len());
    // What each rival itself lets expect: loads scatter, and its sizes are not known exactly.
    let weights: Vec<Mat<f64>> = rivals
        .iter()
        .zip(&shown)
        .map(|(r, base)| {
            let sizes = r.named.map_or_else(|| Mat::zeros(m, 0), |named| by_sizes(model, at, named, base));
            Some(solve_spd(&(doubt + &sizes * sizes.transpose()), &Mat::identity(m, m))?.0)
        })
        .collect::<Option<_>>()?;
    let plain = solve_spd(doubt, &Mat::identity(m, m))?.0;
    let product = |w: &Mat<f64>, a: &[f64], b: &[f64]| -> f64 {
        (0..m).map(|i| (0..m).map(|j| a[i] * w[(i, j)] * b[j]).sum::<f64>()).sum()
    };
    let views = (0..n).map(|k| {
        let off: Vec<Vec<f64>> = (0..n).map(|l| shown[k].iter().zip(&shown[l]).map(|(a, b)| a - b).collect()).collect();
        let behind: Vec<f64> = (0..n).map(|l| 0.5 * product(&weights[l], &off[l], &off[l])).collect();
        let size: Vec<f64> = (0..n).map(|l| product(&plain, &off[l], &off[l]).max(0.0).sqrt()).collect();
        let alike = |a: usize, b: usize| {
            if size[a] * size[b] > 0.0 { product(&plain, &off[a], &off[b]) / (size[a] * size[b]) } else { 0.0 }
        };
        Forecast::new(behind, alike)
    });
    Some(views.collect())
}

/// The load in which two rivals differ most.
fn why(at: &[Operating], model: &Robot<f64>, k: &Rival<'_>, l: &Rival<'_>) -> String {
    let (a, b) = (loads(model, at, k.named), loads(model, at, l.named));
    let far = |i: usize| ((a[i] - b[i]) / scatter(at[i].quantity)).abs();
    let Some(i) = (0..at.len()).max_by(|i, j| far(*i).total_cmp(&far(*j))) else { return String::new() };
    let quantity = at[i].quantity;
    let how = if quantity.is_difference() {
        format!("{:.2} {}", (a[i] - b[i]).abs(), if a[i] < b[i] { "below" } else { "above" })
    } else {
        format!("{:.2} times", (a[i] - b[i]).exp())
    };
    format!(
        "With {} the {} at {:.2} m/s would be {how} that with {}.",
        k.contender.name,
        quantity.name(),
        at[i].speed[1].abs(),
        l.contender.name
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use inference::hypothesis::{Place, Sizes, variants};
    use robot_model::tunable::usual_sigma;
    use testing::robot;

    fn named(id: &str, value: f64, score: f64) -> Named {
        let form = variants(true).into_iter().find(|v| v.spec().id == id && v.place == Place::Whole);
        let form = form.expect("in the catalogue");
        Named {
            free: vec![form.free(&Sizes { robot: Some(robot()), ..Sizes::default() })],
            parts: vec![form],
            is_soft_ground: false,
            values: vec![value],
            sigma: vec![0.1 * value],
            score,
            gain: score,
        }
    }

    fn advised(effects: Vec<Named>) -> Advice {
        let calibrated = Tuned {
            theta: [0.0; NUISANCES],
            covariance: Mat::from_fn(NUISANCES, NUISANCES, |i, j| 0.01 * f64::from(i == j)),
        };
        let naming = Naming { effects, unknown: -10.0, drift: None };
        advise_steady(0.8, &robot(), &usual_sigma(), &calibrated, Some(&naming))
    }

    #[test]
    fn what_only_turns_can_split_gets_a_turning_drive_first() {
        let advice = advised(vec![named("turning_resistance", 0.5, 0.0)]);
        approx::assert_relative_eq!(advice.entropy_bits, 1.0, epsilon = 1e-12);
        let best = advice.best().expect("a drive");
        assert!(best.profile.iter().any(|p| p[2].abs() > 0.1) && best.expected_bits > 0.2, "{best:?}");
        let straight = advice.manoeuvres.iter().find(|m| m.name == "straight at three speeds").expect("on the menu");
        assert!(straight.expected_bits < 0.2 * best.expected_bits, "{}", straight.expected_bits);
        assert!(best.why.contains("turning"), "{}", best.why);
    }

    #[test]
    fn one_rival_and_no_load_at_all_are_said_to_leave_nothing() {
        let advice = advised(vec![named("turning_resistance", 0.5, -20.0)]);
        assert!(advice.withheld.is_some_and(|w| w.contains("nothing is missing")));
        let calibrated = Tuned { theta: [0.0; NUISANCES], covariance: Mat::identity(NUISANCES, NUISANCES) };
        let advice = advise_steady(0.8, &robot(), &usual_sigma(), &calibrated, None);
        assert!(advice.manoeuvres.is_empty() && advice.withheld.is_some());
    }
}
