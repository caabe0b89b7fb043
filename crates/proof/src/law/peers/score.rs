//! Which share of what acted a prediction explains.

use std::collections::BTreeMap;

use examiner::LawRow;
use torque_driven::ResidualWindow;

use super::super::foreign::acting;

/// Share of the mean square of a series that a prediction of its windows explains, each weighted by its deviation: 1 where it
/// is the series, 0 of nothing acting, negative where it errs more than that. The mean is not taken out, for a law says that too.
pub(super) fn of_series(series: &[ResidualWindow], predicted: &[f64]) -> f64 {
    let sum = |of: &dyn Fn(f64, f64) -> f64| {
        let each = series.iter().zip(predicted).map(|(w, p)| (of(w.size, *p) / w.sigma.max(f64::MIN_POSITIVE)).powi(2));
        each.sum::<f64>()
    };
    1.0 - sum(&|size, p| size - p) / sum(&|size, _| size).max(f64::MIN_POSITIVE)
}

/// The same of a curve without noise.
pub(super) fn of_curve(curve: &[f64], predicted: &[f64]) -> f64 {
    let missed: f64 = curve.iter().zip(predicted).map(|(c, p)| (c - p).powi(2)).sum();
    1.0 - missed / curve.iter().map(|c| c * c).sum::<f64>().max(f64::MIN_POSITIVE)
}

/// What a hidden law did in each window; `None` where the examiner does not know it, or it acts elsewhere.
pub(super) fn hidden(windows: &[ResidualWindow], rows: &BTreeMap<String, Vec<LawRow>>) -> Option<Vec<f64>> {
    let of = |w: &ResidualWindow| {
        let drive = rows.get(&w.recording)?.get(w.rows[0]..w.rows[1])?;
        Some(drive.iter().map(|row| acting(row, w.input)).sum::<f64>() / drive.len().max(1) as f64)
    };
    let all: Vec<f64> = windows.iter().map(of).collect::<Option<_>>()?;
    all.iter().any(|u| *u != 0.0).then_some(all)
}

#[cfg(test)]
mod tests {
    use super::super::job::tests::window;
    use super::*;
    use examiner::Acting;

    #[test]
    fn what_is_explained_counts_by_the_deviations_of_the_windows() {
        let series = [window("run_1", 2.0, 1.0), window("run_1", -2.0, 2.0)];
        let close = |predicted: [f64; 2], share: f64| assert!((of_series(&series, &predicted) - share).abs() < 1e-12);
        close([2.0, -2.0], 1.0);
        close([0.0, 0.0], 0.0);
        close([2.0, 0.0], 0.8);
        close([0.0, -2.0], 0.2);
        close([-2.0, 2.0], -3.0);
        assert!((of_curve(&[1.0, 2.0], &[1.0, 1.0]) - 0.8).abs() < 1e-12);
    }

    #[test]
    fn a_hidden_law_is_its_mean_over_the_rows_of_a_window() {
        let row = |k: i32| {
            let acting = Acting { moment: f64::from(k), ..Acting::default() };
            LawRow { acting, ..LawRow::default() }
        };
        let rows = [("run_1".to_owned(), (0..20).map(row).collect())].into();
        let second = ResidualWindow { rows: [10, 20], ..window("run_1", 0.0, 1.0) };
        assert_eq!(hidden(&[window("run_1", 0.0, 1.0), second.clone()], &rows), Some(vec![4.5, 14.5]));
        let elsewhere = ResidualWindow { input: law::Input::Torque(0), ..second };
        assert_eq!(hidden(&[elsewhere], &rows), None, "it is a moment");
        assert_eq!(hidden(&[window("run_2", 0.0, 1.0)], &rows), None, "nobody knows that recording");
    }
}
