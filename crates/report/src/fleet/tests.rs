use super::series::{day, natural};
use super::*;

/// Numbers between 0 and 1 that repeat nowhere soon (a linear congruence of Knuth's).
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A normal number: the sum of twelve uniform ones.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

fn noisy(count: usize, slope: f64, scatter: f64, noise: &mut Noise) -> Vec<[f64; 3]> {
    (0..count)
        .map(|i| {
            let (x, half) = (20_000.0 + 3.0 * i as f64 + noise.uniform(), 0.05 + 0.1 * noise.uniform());
            let sigma = half / crate::words::NINETY;
            [x, 1.0 + slope * (x - 20_000.0) + sigma * noise.normal() + scatter * noise.normal(), half]
        })
        .collect()
}

#[test]
fn on_noise_a_trend_is_claimed_at_the_stated_rate_at_most() {
    let mut noise = Noise(7);
    for (count, scatter) in [(5, 0.0), (5, 0.2), (12, 0.05), (40, 0.0), (40, 0.2)] {
        let runs = 2000;
        let told = (0..runs).filter(|_| trend(&noisy(count, 0.0, scatter, &mut noise)).is_some_and(|t| t.is_clear()));
        let share = told.count() as f64 / f64::from(runs);
        // Stated are 10 %; three sigmas of 2000 draws are 2 %.
        assert!(share < 0.12, "{count} recordings, scatter {scatter}: {share}");
        assert!(count < 40 || share > 0.05, "{count} recordings, scatter {scatter}: {share} is no 90 % interval");
    }
}

#[test]
fn intervals_of_slopes_hold_the_true_one_and_exclude_zero_where_it_is_large() {
    let mut noise = Noise(11);
    let (runs, slope) = (1000, 0.02);
    for scatter in [0.0, 0.1] {
        let trends: Vec<Trend> = (0..runs).filter_map(|_| trend(&noisy(15, slope, scatter, &mut noise))).collect();
        let held = trends.iter().filter(|t| (t.slope - slope).abs() <= t.half).count();
        assert!(held as f64 / f64::from(runs) > 0.87, "{held} of {runs} at scatter {scatter}");
        assert!(trends.iter().filter(|t| t.is_clear()).count() > 900);
    }
}

#[test]
fn what_no_line_can_be_fitted_to_has_no_trend() {
    let point = |x: f64| [x, 1.0, 0.1];
    assert_eq!(trend(&[1.0, 2.0, 3.0, 4.0].map(point)), None);
    assert_eq!(trend(&[2.0; 6].map(point)), None);
    let mut six = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(point);
    let flat = trend(&six).expect("a line");
    assert!(flat.slope.abs() < 1e-12 && flat.scatter < 1e-12 && !flat.is_clear());
    six[2][2] = 0.0;
    assert_eq!(trend(&six), None);
    six[2][2] = f64::NAN;
    assert_eq!(trend(&six), None);
}

#[test]
fn a_change_is_reported_with_its_interval_and_not_where_there_is_none() {
    let step = |before: usize, after: usize| {
        let mut named = vec![false; before];
        named.extend(vec![true; after]);
        named
    };
    let Since::Changed(change) = since(&step(8, 7)) else { panic!("a clear change") };
    assert!(change.came && change.best == 8 && change.probability > 0.99, "{change:?}");
    assert!(change.first_after[0] <= 8 && change.first_after[1] >= 8 && change.first_after[1] < 11, "{change:?}");
    let gone: Vec<bool> = step(8, 7).into_iter().rev().collect();
    assert!(matches!(since(&gone), Since::Changed(Change { came: false, best: 7, .. })));
    assert_eq!(since(&step(2, 2)), Since::TooFew);
    assert_eq!(since(&step(0, 9)), Since::Always);
    let alternating: Vec<bool> = (0..20).map(|i| i % 2 == 0).collect();
    assert!(matches!(since(&alternating), Since::Unclear(p) if p < 0.5));
    // Of recordings in which it is named by chance, few are said to change.
    let mut noise = Noise(3);
    let told = (0..1000).filter(|_| {
        let named: Vec<bool> = (0..20).map(|_| noise.uniform() < 0.4).collect();
        matches!(since(&named), Since::Changed(_))
    });
    assert!(told.count() < 50);
}

#[test]
fn dates_and_names_are_those_of_people() {
    assert_eq!(day(Some(0)), "1970-01-01");
    assert_eq!(day(Some(951_782_400_000)), "2000-02-29");
    assert_eq!(day(Some(1_772_323_199_999)), "2026-02-28");
    assert_eq!(day(None), "");
    let mut names = ["unit-10", "unit-2", "unit-02", "unit", "b", "10"];
    names.sort_by(|a, b| natural(a, b));
    assert_eq!(names, ["10", "b", "unit", "unit-02", "unit-2", "unit-10"]);
}

fn named(magnitude: f64) -> Named {
    Named {
        effect: "coulomb_side".to_owned(),
        name: "dragging brake: <left>".to_owned(),
        side: Some("left".to_owned()),
        probability: 0.97,
        magnitude: Some(magnitude),
        interval: Some([magnitude - 0.1, magnitude + 0.1]),
        unit: "N m".to_owned(),
    }
}

/// Recordings of a robot, one a week: fault-free, then with an effect that grows.
fn worn(robot: &str, fault_free: u32, ill: u32, growth: f64) -> Vec<DiagnosedRecording> {
    (0..fault_free + ill)
        .map(|week| DiagnosedRecording {
            id: format!("{robot}/run_{week}"),
            robot: robot.to_owned(),
            date: Some(1_767_225_600_000 + 604_800_000 * i64::from(week)),
            finding: match week.checked_sub(fault_free) {
                None => Finding::NoMismatch,
                Some(n) => Finding::Explained(vec![named(1.0 + growth * f64::from(n))]),
            },
        })
        .collect()
}

#[test]
fn the_page_says_who_differs_by_what_since_when_and_whether_it_grows() {
    let mut seen = worn("unit-17", 8, 9, 0.2);
    seen.extend(worn("unit-2", 6, 0, 0.0));
    seen.extend(worn("unit-3", 0, 3, 0.0));
    seen.push(DiagnosedRecording {
        id: "x".into(),
        robot: "unit-2".into(),
        date: None,
        finding: Finding::Failed("no <b>rows</b>".into()),
    });
    seen.reverse();
    let html = render(&seen, "lacuna 1");
    for part in [
        "2 of 3 robots differ from their simulation in 27 recordings.",
        "2.600 N m [2.500, 2.700]",
        "9 of 17",
        // 0.2 a week.
        "It rises by 0.02857 ±",
        "N m per day (90 %)",
        "came between 2026-02-12 and",
        "likeliest just before 2026-02-26",
        "cannot be determined from 3 recordings",
        "no &lt;b&gt;rows&lt;/b&gt;",
        "days after 2026-02-26",
        "1 failed, 0 withheld",
    ] {
        assert!(html.contains(part), "lacks {part}");
    }
    assert!(!html.contains("<b>rows") && !html.contains("brake: <left>"), "names stay text");
}

#[test]
fn a_fleet_without_findings_and_an_empty_one_still_make_pages() {
    let html = render(&worn("a", 3, 0, 0.0), "lacuna 1");
    assert!(html.contains("0 of 1 robot differ") && html.contains("No effect was named"));
    assert!(render(&[], "lacuna 1").contains("0 of 0 robots"));
}

#[test]
fn thousands_of_recordings_make_a_page_that_says_what_it_left_out() {
    let mut seen: Vec<DiagnosedRecording> = (0..400).flat_map(|i| worn(&format!("unit-{i}"), 4, 8, 0.1)).collect();
    seen.extend(worn("old", 100, 1500, 0.01));
    for one in &mut seen[..300] {
        one.finding = Finding::Failed("cut off".to_owned());
    }
    let html = render(&seen, "lacuna 1");
    for part in ["24 of ", "the first 100 of 300", "more are in the table of rows", "weighted mean of 8 recordings"] {
        assert!(html.contains(part), "lacks {part}");
    }
    assert!(html.len() < 6_500_000, "{}", html.len());
    assert_eq!(html.matches("\"kind\":\"lines\"").count(), 24);
}
