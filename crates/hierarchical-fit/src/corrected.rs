//! Constants with what is named, at instants of drives that were fitted or left out, and simulations by them.

use crate::observed::Observed;
use crate::solve::Solved;

impl<D: Observed> Solved<D> {
    /// Constants at an instant of a drive, s from its start, with what is named.
    pub fn corrected(&self, drive: usize, time: f64) -> &[f64] {
        let onset = self.onset.as_ref().filter(|onset| !onset.acts(drive, time));
        onset.map_or(&self.named.posterior.mean, |onset| &onset.off).as_slice()
    }

    /// The same after the last drive.
    pub fn corrected_from_now_on(&self) -> &[f64] {
        self.corrected_of_left_out(self.data.drives.len())
    }

    /// The same of a drive that was left out, from its place among all.
    pub fn corrected_of_left_out(&self, place: usize) -> &[f64] {
        let onset = self.onset.as_ref().filter(|onset| !onset.acts_in_left_out(place));
        onset.map_or(&self.named.posterior.mean, |onset| &onset.off).as_slice()
    }

    /// The same beside a fit to all drives, which may know that the cause is not there in this one where the others all have it.
    pub fn corrected_of_left_out_beside(&self, place: usize, whole: &Self) -> Vec<f64> {
        let found = if self.onset.is_none() { whole.onset.as_ref() } else { None };
        match found.filter(|onset| onset.is_absent(place)) {
            Some(onset) => self.without_cause(onset.cause),
            None => self.corrected_of_left_out(place).to_vec(),
        }
    }

    /// Constants with what is named but for a cause.
    fn without_cause(&self, cause: usize) -> Vec<f64> {
        let mut out = self.named.posterior.mean.as_slice().to_vec();
        self.causes[cause].take_from(&mut out, self.prior.mean.as_slice());
        out
    }

    /// What simulations show of a drive, as stated or as the references have it, re-tuned, and with the named causes by these constants at
    /// each instant, the last only where there are some; `run` simulates by the constants at an instant, s from the start of the drive.
    pub fn simulated<'a>(
        &'a self,
        corrected: &dyn Fn(f64) -> &'a [f64],
        run: impl Fn(&dyn Fn(f64) -> &'a [f64]) -> Vec<[f64; 3]>,
    ) -> [Vec<[f64; 3]>; 3] {
        let Self { prior, named, .. } = self;
        let corrected = if named.chosen.is_empty() { Vec::new() } else { run(corrected) };
        [run(&|_| prior.mean.as_slice()), run(&|_| named.retuned.mean.as_slice()), corrected]
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use crate::cause::Cause;
    use crate::data::Data;
    use crate::observed::Spread;
    use crate::scaled::Scaled;
    use crate::solve::{Solved, solve};

    /// Drives whose scales are these, with a cause that may change their logarithm.
    fn solved(scales: &[f64]) -> Solved<Scaled> {
        let spreads = vec![Spread { sigma: 0.03, usual: 1.0, scatter: 0.01, bounds: [-5.0, 5.0] }];
        let drives = scales.iter().map(|scale| Scaled::by(*scale).roughly(0.01)).collect();
        let directions = vec![(vec![(0, 1.0)], 1.0)];
        let scale = Cause { spec: &catalogue::odometry::GYRO_SCALE, of: None, directions, possible: None };
        solve(Data { model: (), spreads, drives }, None, vec![scale]).expect("solved")
    }

    #[test]
    fn a_drive_before_an_onset_is_forecast_without_the_cause_though_all_others_have_it() {
        let all = solved(&[1.0, 1.5, 1.5, 1.5]);
        let onset = all.onset.as_ref().expect("a step after the first drive");
        assert!(onset.is_absent(0) && !onset.is_absent(1));

        let others = all.without(0).expect("solved");
        assert!(others.onset.is_none(), "it is there in all of them");
        assert_relative_eq!(others.corrected_of_left_out(0)[0], 1.5_f64.ln(), max_relative = 0.02);
        assert_eq!(others.corrected_of_left_out_beside(0, &all)[0], 0.0);
        assert_relative_eq!(others.corrected_of_left_out_beside(1, &all)[0], 1.5_f64.ln(), max_relative = 0.02);
    }
}
