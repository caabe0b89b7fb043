//! What is common to all kinds of robots once each has said how it compares: forecasts of data that the fit did not see.
//!
//! A kind of robot differs in *what* is compared: windows of a free run, torques at known wheel speeds, wheels and poses
//! from commands. It says so as an [`Experiment`]: blocks of data that can be left out, four simulations fitted without a
//! block, and what each answers to it. [`leave_out`] asks them, [`free_runs`] makes the rows of a verdict, and
//! [`Standing::objection`] says what these rows hold against the correction.

use std::collections::BTreeMap;

use rayon::prelude::*;
use verdict::FreeRun;

use crate::robust::{geometric_mean, rms};
use crate::settings::SETTINGS;

/// The four simulations that every verdict compares, or something of each.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Comparison<T> {
    /// The user's simulation as it is.
    pub nominal: T,
    /// With its constants re-tuned.
    pub retuned: T,
    /// With what was found to be missing; `None` where nothing was.
    pub corrected: Option<T>,
    /// With the best wrong cause, fitted as freely; `None` where there is none.
    pub placebo: Option<T>,
}

impl<T> Comparison<T> {
    /// The same of each.
    pub fn map<U>(&self, mut of: impl FnMut(&T) -> U) -> Comparison<U> {
        Comparison {
            nominal: of(&self.nominal),
            retuned: of(&self.retuned),
            corrected: self.corrected.as_ref().map(&mut of),
            placebo: self.placebo.as_ref().map(of),
        }
    }

    /// What the recordings are answered with: corrected, or re-tuned where there is nothing to correct with.
    pub fn best(&self) -> &T {
        self.corrected.as_ref().unwrap_or(&self.retuned)
    }
}

/// How a kind of robot compares recordings with simulations.
pub trait Experiment: Sync {
    /// A simulation with its numbers.
    type Model: Send;
    /// What a simulation answers to a block.
    type Response: Send;

    /// Blocks of data, of which each is left out in turn: recordings, or folds of windows.
    fn blocks(&self) -> usize;

    /// The four simulations, fitted without a block; `None` where the rest determines no fit.
    fn fitted_without(&self, block: usize) -> Option<Comparison<Self::Model>>;

    /// The four simulations, fitted on all blocks.
    fn fitted(&self) -> Comparison<Self::Model>;

    /// What a simulation answers to the inputs of a block.
    fn response(&self, model: &Self::Model, block: usize) -> Self::Response;

    /// Quantities in which answers are compared, each with its unit.
    fn quantities(&self) -> Vec<String>;

    /// Errors of an answer: one number for each window of the block and each quantity; none where nothing was recorded.
    fn errors(&self, response: &Self::Response, block: usize) -> Vec<Vec<f64>>;
}

/// A block with what was simulated for it.
#[derive(Debug, Clone)]
pub struct Forecast<M, R> {
    /// Whether the fits left the block out.
    pub left_out: bool,
    /// The simulations.
    pub models: Comparison<M>,
    /// What they answer.
    pub responses: Comparison<R>,
    /// Errors by quantity, then by window.
    pub errors: Comparison<Vec<Vec<f64>>>,
}

/// Every block, forecast by fits that did not see it where that is possible.
pub fn leave_out<E: Experiment>(experiment: &E) -> Vec<Forecast<E::Model, E::Response>> {
    let forecast = |block: usize| {
        let without = experiment.fitted_without(block);
        let left_out = without.is_some();
        let models = without.unwrap_or_else(|| experiment.fitted());
        let responses = models.map(|model| experiment.response(model, block));
        let errors = responses.map(|response| experiment.errors(response, block));
        Forecast { left_out, models, responses, errors }
    };
    (0..experiment.blocks()).into_par_iter().map(forecast).collect()
}

/// Rows of a verdict: the root mean square of each quantity over each block that was left out, `name`d by its block.
///
/// Without a correction its column repeats the re-tuned simulation.
pub fn free_runs<E: Experiment>(
    experiment: &E,
    forecasts: &[Forecast<E::Model, E::Response>],
    name: impl Fn(usize) -> String,
) -> Vec<FreeRun> {
    let quantities = experiment.quantities();
    let left_out = forecasts.iter().enumerate().filter(|(_, forecast)| forecast.left_out);
    let of_block = |(block, forecast): (usize, &Forecast<E::Model, E::Response>)| -> Vec<FreeRun> {
        let row = |(q, quantity): (usize, &String)| {
            // A quantity that was not recorded has no row.
            let recorded = !forecast.errors.nominal[q].is_empty();
            let errors = forecast.errors.map(|errors| rms(errors[q].iter().copied()).unwrap_or(f64::NAN));
            recorded.then(|| free_run(name(block), quantity.clone(), &errors))
        };
        quantities.iter().enumerate().filter_map(row).collect()
    };
    left_out.flat_map(of_block).collect()
}

/// A row from the errors of the four simulations. What did not stay finite is as wrong as a number can be, for files hold no
/// infinities.
pub fn free_run(recording: String, quantity: String, errors: &Comparison<f64>) -> FreeRun {
    let errors = errors.map(|error| if error.is_finite() { *error } else { f64::MAX });
    let Comparison { nominal, retuned, placebo, .. } = errors;
    FreeRun { recording, quantity, nominal, retuned, corrected: *errors.best(), placebo }
}

/// How a correction stands on data that its fit did not see: its error over those of others, the geometric mean of all
/// recordings and quantities. Below 1 it forecasts better.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// Over the error of the user's simulation as it is.
    pub over_nominal: f64,
    /// Over the error of the user's simulation with re-tuned constants.
    pub over_retuned: f64,
    /// Over the error of the best wrong cause.
    pub over_placebo: Option<f64>,
}

impl Standing {
    /// Of the rows of a verdict; `None` where nothing was left out.
    pub fn new(rows: &[FreeRun]) -> Option<Self> {
        let over = |other: &dyn Fn(&FreeRun) -> Option<f64>| {
            let ratio = |row: &FreeRun| Some(row.corrected / other(row)?).filter(|r| r.is_finite() && *r > 0.0);
            geometric_mean(rows.iter().filter_map(ratio))
        };
        let over_retuned = over(&|row| Some(row.retuned))?;
        let over_nominal = over(&|row| Some(row.nominal))?;
        Some(Self { over_nominal, over_retuned, over_placebo: over(&|row| row.placebo) })
    }

    /// Whether the best wrong cause forecasts the left-out data as well: then they do not tell the two apart.
    pub fn is_matched_by_placebo(&self) -> bool {
        self.over_placebo.is_some_and(|ratio| ratio >= 1.0)
    }

    /// What these figures hold against the correction, for people; `placebo` names the wrong cause.
    pub fn objection(&self, placebo: Option<&str>) -> Option<String> {
        if let (true, Some(ratio)) = (self.is_matched_by_placebo(), self.over_placebo) {
            let wrong = placebo.unwrap_or("a wrong cause with as many constants");
            return Some(format!(
                "recordings left out of the fit are forecast as well or better with {wrong} in the place of the named cause (with \
                 the named cause the error is {ratio:.2} times as large): these recordings do not tell the two apart"
            ));
        }
        (self.over_retuned >= 1.0).then(|| {
            format!(
                "recordings left out of the fit are forecast no better with the named cause than with re-tuned constants \
                 alone ({:.2} times the error): they do not confirm the cause",
                self.over_retuned
            )
        })
    }

    /// What these figures hold against the correction, or else what quantities of these `rows` do of which the best wrong cause forecasts
    /// one clearly better, for people.
    pub fn doubt(&self, rows: &[FreeRun], placebo: Option<&str>) -> Option<String> {
        self.objection(placebo).or_else(|| better_with_placebo(rows, placebo))
    }

    /// What these figures hold against constants that were re-tuned where nothing is named, for people.
    pub fn objection_to_re_tuning(&self) -> Option<String> {
        (self.over_nominal > SETTINGS.forecasts.worse).then(|| {
            format!(
                "recordings left out of the fit are forecast worse with the re-tuned constants than as stated ({:.2} times the error): do not \
                 adopt them, for something differs between the recordings that no constant holds",
                self.over_nominal
            )
        })
    }
}

/// Quantities that the best wrong cause forecasts clearly better on recordings left out, though the named cause stands over all, for people.
fn better_with_placebo(rows: &[FreeRun], placebo: Option<&str>) -> Option<String> {
    let quantity = |row: &FreeRun| row.quantity.split(['(', ',']).next().unwrap_or_default().trim().to_owned();
    let mut ratios: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for row in rows {
        let ratio = row.placebo.map(|placebo| row.corrected / placebo).filter(|r| r.is_finite() && *r > 0.0);
        ratios.entry(quantity(row)).or_default().extend(ratio);
    }
    let better: Vec<String> = ratios
        .into_iter()
        .filter_map(|(quantity, of)| Some((quantity, geometric_mean(of)?)))
        .filter(|(_, ratio)| *ratio > SETTINGS.forecasts.worse_quantity)
        .map(|(quantity, ratio)| format!("{quantity} (with the named cause the error is {ratio:.2} times as large)"))
        .collect();
    let wrong = placebo.unwrap_or("a wrong cause with as many constants");
    (!better.is_empty()).then(|| {
        format!(
            "over all quantities recordings left out of the fit are forecast best with the named cause, but with {wrong} in its place \
             better in {}: look there for what else differs",
            better.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A level that is measured once in each block; a correction adds one number, a placebo doubles it.
    struct Levels(Vec<f64>);

    impl Experiment for Levels {
        type Model = f64;
        type Response = f64;

        fn blocks(&self) -> usize {
            self.0.len()
        }

        fn fitted_without(&self, block: usize) -> Option<Comparison<f64>> {
            let others: Vec<f64> = self.0.iter().enumerate().filter(|(i, _)| *i != block).map(|(_, y)| *y).collect();
            let mean = crate::robust::mean(others)?;
            Some(Comparison { nominal: 0.0, retuned: 0.5 * mean, corrected: Some(mean), placebo: Some(2.0 * mean) })
        }

        fn fitted(&self) -> Comparison<f64> {
            Comparison { nominal: 0.0, retuned: self.0[0], corrected: None, placebo: None }
        }

        fn response(&self, model: &f64, _: usize) -> f64 {
            *model
        }

        fn quantities(&self) -> Vec<String> {
            vec!["level, m".to_owned()]
        }

        fn errors(&self, response: &f64, block: usize) -> Vec<Vec<f64>> {
            vec![vec![self.0[block] - response]]
        }
    }

    #[test]
    fn every_block_is_forecast_by_fits_of_the_others() {
        let levels = Levels(vec![1.0, 2.0, 3.0]);
        let rows = free_runs(&levels, &leave_out(&levels), |block| format!("r{block}"));
        let corrected: Vec<f64> = rows.iter().map(|r| r.corrected).collect();
        assert_eq!(corrected, [1.5, 0.0, 1.5]);
        assert_eq!((rows[0].nominal, rows[0].placebo, &*rows[0].recording), (1.0, Some(4.0), "r0"));
    }

    #[test]
    fn a_lone_block_is_not_left_out_and_gives_no_row() {
        let levels = Levels(vec![1.0]);
        let forecasts = leave_out(&levels);
        assert!(!forecasts[0].left_out && forecasts[0].responses.best() == &1.0);
        assert!(free_runs(&levels, &forecasts, |_| String::new()).is_empty());
        assert_eq!(Standing::new(&[]), None);
    }

    fn row(retuned: f64, corrected: f64, placebo: Option<f64>) -> FreeRun {
        free_run(
            "r".to_owned(),
            "q".to_owned(),
            &Comparison { nominal: 9.0, retuned, corrected: Some(corrected), placebo },
        )
    }

    #[test]
    fn a_correction_is_objected_to_when_a_wrong_cause_or_re_tuning_forecasts_as_well() {
        let objection = |rows: &[FreeRun]| Standing::new(rows).and_then(|s| s.objection(Some("drag")));
        assert_eq!(objection(&[row(2.0, 1.0, Some(1.5)), row(2.0, 1.1, None)]), None);
        let matched = objection(&[row(2.0, 1.0, Some(0.9)), row(2.0, 1.0, Some(1.0))]).expect("an objection");
        assert!(matched.contains("forecast as well or better with drag") && matched.contains("1.05"), "{matched}");
        let idle = objection(&[row(1.0, 1.2, Some(1.5))]).expect("an objection");
        assert!(idle.contains("1.20 times"), "{idle}");
        // Over both quantities the correction is better, in one of them it is not.
        let position = FreeRun { quantity: "position (rms), m".to_owned(), ..row(2.0, 1.0, Some(0.8)) };
        let both = [row(2.0, 1.0, Some(3.0)), position];
        let standing = Standing::new(&both).expect("a standing");
        assert_eq!(standing.objection(Some("drag")), None);
        let doubt = standing.doubt(&both, Some("drag")).expect("a doubt");
        assert!(
            doubt.contains("with drag in its place better in position (with the named cause the error is 1.25"),
            "{doubt}"
        );
        assert_eq!(standing.doubt(&both[..1], Some("drag")), None);
        // Where nothing is named the re-tuned simulation is the best there is.
        let re_tuned = |error: f64| Standing::new(&[row(error, error, None)]).and_then(|s| s.objection_to_re_tuning());
        assert_eq!(re_tuned(9.5), None);
        assert!(re_tuned(13.5).is_some_and(|told| told.contains("1.50 times the error): do not adopt them")));
        // Shares count, whatever the quantities' sizes: half of one outweighs a fifth more of another.
        assert_eq!(objection(&[row(1.0, 1.2, None), row(100.0, 50.0, None)]), None);
    }
}
