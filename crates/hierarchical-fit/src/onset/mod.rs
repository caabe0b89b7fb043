//! When a cause is there that begins or ends while the drives go on.

mod courses;
mod gated;
mod hypotheses;
mod scan;
pub(crate) mod search;
mod told;

use nalgebra::DVector;

use crate::found::Began;
use crate::observed::Row;
use courses::Course;

pub use told::interval_of_instants;

/// Evidence of courses, nats.
pub(crate) type Instants = Vec<(f64, Course)>;

/// The borders from which on a cause is there, or no longer is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Gate {
    /// Of each drive when rows become known, s from its start, whose windows hold nothing of before: 0 where all of it comes after, and
    /// infinity where nothing does.
    pub(crate) known: Vec<f64>,
    /// Whether the cause ends there.
    pub(crate) ends: bool,
}

impl Gate {
    /// Whether the cause is there in the window of a row that became known at an instant of a drive.
    pub(crate) fn acts(&self, drive: usize, known: f64) -> bool {
        (known >= self.known[drive]) != self.ends
    }

    /// Numbers of the rows of a drive where the cause is there, and of the others where it is not.
    pub(crate) fn chosen(&self, drive: usize, rows: &[Row], on: &[f64], off: &[f64]) -> Vec<f64> {
        let of = |((row, on), off): ((&Row, &f64), &f64)| if self.acts(drive, row.time) { *on } else { *off };
        rows.iter().zip(on).zip(off).map(of).collect()
    }
}

/// When a cause begins, or ends: once, or in several drives anew.
#[derive(Debug, Clone)]
pub struct Onset {
    /// Index among the causes.
    pub cause: usize,
    /// Of each drive when it does so within it, s from its start, with a 90 % interval.
    pub changes: Vec<Option<(f64, [f64; 2])>>,
    /// Constants where it is not there.
    pub off: DVector<f64>,
    /// Factor on the usual scatter of constants between drives.
    pub factor: f64,
    /// In which rows it does.
    pub(crate) gate: Gate,
}

impl Onset {
    /// The first drive in which it begins, or ends, by its place among the drives.
    pub fn drive(&self) -> usize {
        self.gate.known.iter().position(|known| known.is_finite()).unwrap_or(self.gate.known.len())
    }

    /// Whether it ends there.
    pub fn ends(&self) -> bool {
        self.gate.ends
    }

    /// Whether, of so many drives, it is there, or was there, in one alone.
    pub(crate) fn is_in_one(&self, drives: usize) -> bool {
        let first = self.drive();
        !self.is_anew() && if self.ends() { first == 0 } else { first + 1 >= drives }
    }

    /// Whether it does so in several drives anew.
    pub fn is_anew(&self) -> bool {
        self.changes.iter().flatten().count() > 1
    }

    /// Whether the cause is there at an instant of a drive.
    pub fn acts(&self, drive: usize, time: f64) -> bool {
        let changed = self.changes[drive].map_or(self.gate.known[drive] <= 0.0, |(at, _)| time >= at);
        changed != self.ends()
    }

    /// Whether it is there in a drive that was left out, from whose place on the others follow it. Of one that begins anew in each drive
    /// it is not known when: it is taken to have begun.
    pub fn acts_in_left_out(&self, place: usize) -> bool {
        (self.is_anew() || place > self.drive()) != self.ends()
    }

    /// Whether it is not there in any part of a drive.
    pub fn is_absent(&self, drive: usize) -> bool {
        self.span(drive, f64::INFINITY).is_none()
    }

    /// From when to when it is there in a drive that is so long, s.
    pub fn span(&self, drive: usize, length: f64) -> Option<[f64; 2]> {
        match (self.acts(drive, 0.0), self.changes[drive]) {
            (true, Some((at, _))) => Some([0.0, at.min(length)]),
            (true, None) => Some([0.0, length]),
            (false, Some((at, _))) => Some([at.min(length), length]),
            (false, None) => None,
        }
    }

    /// The same of all drives, by their names and lengths, s.
    pub fn spans<'a>(&self, drives: impl Iterator<Item = (&'a str, f64)>) -> Vec<(String, [f64; 2])> {
        drives.enumerate().filter_map(|(k, (name, length))| Some((name.to_owned(), self.span(k, length)?))).collect()
    }

    /// The same for people, of drives of these names.
    pub fn began(&self, names: &[&str]) -> Option<Began> {
        // Of one that begins anew, the first drive within which it does.
        let first = if self.is_anew() { self.changes.iter().position(Option::is_some)? } else { self.drive() };
        let inside = self.changes.iter().zip(names).enumerate().filter(|(k, _)| *k != first);
        let anew = inside.filter_map(|(_, (change, name))| Some(((*name).to_owned(), (*change)?))).collect();
        let others = !self.is_in_one(names.len());
        Some(Began { drive: (*names.get(first)?).to_owned(), at: self.changes[first], anew, ends: self.ends(), others })
    }
}

#[cfg(test)]
mod tests {
    use crate::cause::{Cause, Possible};
    use crate::data::Data;
    use crate::observed::Spread;
    use crate::scaled::Scaled;
    use crate::solve::{Solved, solve};
    use approx::assert_relative_eq;

    fn solved(drives: Vec<Scaled>) -> Solved<Scaled> {
        solved_by(drives, None)
    }

    fn solved_by(drives: Vec<Scaled>, possible: Option<Possible>) -> Solved<Scaled> {
        let spreads = vec![Spread { sigma: 0.01, usual: 0.3, scatter: 0.003, bounds: [-5.0, 5.0] }];
        let data = Data { model: (), spreads, drives };
        let cause = Cause {
            spec: &catalogue::odometry::RADIUS_OF_ALL_WHEELS,
            of: None,
            directions: vec![(vec![(0, 1.0)], 0.3)],
            possible,
        };
        solve(data, None, vec![cause]).expect("solved")
    }

    #[test]
    fn a_cause_that_begins_in_a_drive_is_found_with_its_instant_and_its_size() {
        for ends in [false, true] {
            let [before, after] = if ends { [1.5, 1.0] } else { [1.0, 1.5] };
            let solved = solved([[before; 2], [before, after], [after; 2]].map(|s| Scaled::changing(s, 12.0)).into());
            let onset = solved.onset.as_ref().expect("an onset");
            // The first row with it became known after 12 s, and tells of a window before.
            assert_eq!((onset.drive(), onset.ends(), onset.is_anew()), (1, ends, false));
            assert_eq!([1, 2, 3].map(|drives| onset.is_in_one(drives)), [!ends, !ends, false]);
            let (time, interval) = onset.changes[1].expect("within the second drive");
            assert_relative_eq!(time, 11.4, epsilon = 1e-9);
            assert!(interval[0] < 11.0 && interval[1] > 12.0, "{interval:?}");
            assert_relative_eq!(onset.off[0], 0.0, epsilon = 0.01);
            assert_relative_eq!(solved.named.posterior.mean[0], 1.5_f64.ln(), epsilon = 0.01);

            let spans = [0, 1, 2].map(|drive| onset.span(drive, 20.0));
            let expected = if ends {
                [Some([0.0, 20.0]), Some([0.0, time]), None]
            } else {
                [None, Some([time, 20.0]), Some([0.0, 20.0])]
            };
            assert_eq!(spans, expected);
            let is_on = |drive: usize, time: f64| solved.corrected(drive, time)[0] > 0.2;
            assert_eq!([is_on(0, 19.0), is_on(1, 5.0), is_on(1, 15.0), is_on(2, 0.0)], [ends, ends, !ends, !ends]);
            assert_eq!(solved.corrected_from_now_on()[0] > 0.2, !ends);
            let without = solved.without(1).expect("a fold");
            let of_left_out = |s: &Solved<Scaled>, place: usize| s.corrected_of_left_out(place)[0] > 0.2;
            // Between two drives it is not known when.
            assert!(without.onset.as_ref().is_some_and(|onset| onset.changes == [None, None] && onset.drive() == 1));
            assert_eq!([of_left_out(&without, 0), of_left_out(&without, 2)], [ends, !ends]);
        }
    }

    #[test]
    fn a_cause_that_is_always_there_has_no_onset_nor_has_a_sound_robot() {
        for scale in [1.0, 1.5] {
            let solved = solved(vec![Scaled::changing([scale; 2], 0.0); 3]);
            assert!(solved.onset.is_none(), "{:?}", solved.onset);
            assert_eq!(solved.named.chosen.len(), usize::from(scale > 1.0));
        }
    }

    #[test]
    fn a_step_between_two_drives_is_no_scatter_of_theirs() {
        let drives = [1.0, 1.12, 1.12, 1.12].map(|scale| Scaled::changing([scale; 2], 0.0).roughly(0.03));
        let solved = solved(drives.into());
        let onset = solved.onset.as_ref().expect("a step");
        assert!(onset.drive() == 1 && onset.changes.iter().all(Option::is_none), "{:?}", onset.changes);
        assert_relative_eq!(solved.named.posterior.mean[0], 1.12_f64.ln(), epsilon = 0.005);
    }

    #[test]
    fn a_cause_that_begins_in_each_drive_anew_is_found_in_each() {
        let at = [6.0, 12.0, 9.0];
        let solved = solved(at.map(|from| Scaled::changing([1.0, 1.5], from)).into());
        let onset = solved.onset.as_ref().expect("an onset");
        assert!(onset.is_anew() && !onset.ends());
        for (drive, from) in at.into_iter().enumerate() {
            let (time, _) = onset.changes[drive].expect("within each drive");
            assert_relative_eq!(time, from - 0.6, epsilon = 1e-9);
            assert_eq!(onset.span(drive, 20.0), Some([time, 20.0]));
        }
        assert_relative_eq!(solved.named.posterior.mean[0], 1.5_f64.ln(), epsilon = 0.01);
        assert!(solved.corrected_of_left_out(1)[0] > 0.2);
    }

    #[test]
    fn what_explains_little_of_what_is_left_does_not_begin() {
        let drives = |after: f64, off: f64| {
            [[1.0; 2], [1.0, after], [after; 2]].map(|s| Scaled::changing(s, 12.0).roughly(off)).into()
        };
        assert!(solved(drives(1.1, 0.03)).onset.is_some());
        assert!(solved(drives(1.1, 0.2)).onset.is_none());
    }

    #[test]
    fn a_share_that_cannot_be_negative_does_not_begin_to_be() {
        let falls = || vec![Scaled::changing([1.0, 0.6], 12.0)];
        assert!(solved_by(falls(), None).onset.is_some());
        assert!(solved_by(falls(), Some(Possible::at_least_zero(0))).onset.is_none());
    }

    #[test]
    fn what_is_told_of_an_onset_names_drive_and_instant() {
        let began = |at, ends, others| {
            let anew = Vec::new();
            crate::found::Began { drive: "b".to_owned(), at, anew, ends, others }.to_string()
        };
        let at = Some((12.0, [11.4, 12.6]));
        let last = began(at, false, false);
        assert!(
            last.starts_with("it is there from 12 s of drive 'b' (90 %: 11 to 13 s); no other drive shows it"),
            "{last}"
        );
        assert!(began(at, false, true).ends_with(", and in all drives after it in the order of their names"));
        let ended = began(at, true, true);
        assert!(
            ended.starts_with("it is there until 12 s of drive 'b'") && ended.contains("drives before it"),
            "{ended}"
        );
        assert!(ended.ends_with(", and predictions are made without it"), "{ended}");
        assert!(began(None, false, true).starts_with("it is there in drive 'b' and all after it"));
        assert!(began(None, true, true).starts_with("it is there in all drives before 'b', and no longer in it"));
    }
}
