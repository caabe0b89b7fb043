//! When a cause is there that begins or ends while the drives go on.

mod hypotheses;
mod scan;
pub(crate) mod search;
mod told;

use nalgebra::DVector;

use crate::observed::Row;

/// Evidence of instants, nats: of a drive, and the stretch of it from which on all is otherwise.
pub(crate) type Instants = Vec<(f64, [usize; 2])>;

/// The border from which on a cause is there, or no longer is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gate {
    /// The drive, by its place among the drives.
    pub(crate) drive: usize,
    /// When rows become known, s from the start of that drive, whose windows hold nothing of before.
    pub(crate) known: f64,
    /// Whether the cause ends there.
    pub(crate) ends: bool,
}

impl Gate {
    /// Whether the cause is there in the window of a row that became known at an instant of a drive.
    pub(crate) fn acts(self, drive: usize, known: f64) -> bool {
        ((drive, known) >= (self.drive, self.known)) != self.ends
    }

    /// Numbers of the rows of a drive where the cause is there, and of the others where it is not.
    pub(crate) fn chosen(self, drive: usize, rows: &[Row], on: &[f64], off: &[f64]) -> Vec<f64> {
        let of = |((row, on), off): ((&Row, &f64), &f64)| if self.acts(drive, row.time) { *on } else { *off };
        rows.iter().zip(on).zip(off).map(of).collect()
    }
}

/// When a cause begins, or ends.
#[derive(Debug, Clone)]
pub struct Onset {
    /// Index among the causes.
    pub cause: usize,
    /// When, s from the start of its drive; 0 where it is between two drives.
    pub time: f64,
    /// 90 % interval of it, as far as it lies within that drive.
    pub interval: [f64; 2],
    /// Constants where it is not there.
    pub off: DVector<f64>,
    /// Factor on the usual scatter of constants between drives.
    pub factor: f64,
    /// In which drive it begins or ends, and in which row.
    pub(crate) gate: Gate,
}

impl Onset {
    /// The drive in which it begins, or ends, by its place among the drives.
    pub fn drive(&self) -> usize {
        self.gate.drive
    }

    /// Whether it ends there.
    pub fn ends(&self) -> bool {
        self.gate.ends
    }

    /// Whether the cause is there at an instant of a drive.
    pub fn acts(&self, drive: usize, time: f64) -> bool {
        Gate { known: self.time, ..self.gate }.acts(drive, time)
    }

    /// Whether it is there in a drive that was left out, from whose place on the others follow it.
    pub fn acts_in_left_out(&self, place: usize) -> bool {
        (place > self.drive()) != self.ends()
    }

    /// From when to when it is there in a drive that is so long, s.
    pub fn span(&self, drive: usize, length: f64) -> Option<[f64; 2]> {
        let is_inside = drive == self.drive() && self.time > 0.0;
        match (self.acts(drive, 0.0), is_inside) {
            (true, true) => Some([0.0, self.time.min(length)]),
            (true, false) => Some([0.0, length]),
            (false, true) => Some([self.time.min(length), length]),
            (false, false) => None,
        }
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
            assert_eq!((onset.drive(), onset.ends()), (1, ends));
            assert_relative_eq!(onset.time, 11.4, epsilon = 1e-9);
            assert!(onset.interval[0] < 11.0 && onset.interval[1] > 12.0, "{:?}", onset.interval);
            assert_relative_eq!(onset.off[0], 0.0, epsilon = 0.01);
            assert_relative_eq!(solved.named.posterior.mean[0], 1.5_f64.ln(), epsilon = 0.01);

            let spans = [0, 1, 2].map(|drive| onset.span(drive, 20.0));
            let expected = if ends {
                [Some([0.0, 20.0]), Some([0.0, onset.time]), None]
            } else {
                [None, Some([onset.time, 20.0]), Some([0.0, 20.0])]
            };
            assert_eq!(spans, expected);
            let is_on = |drive: usize, time: f64| solved.corrected(drive, time)[0] > 0.2;
            assert_eq!([is_on(0, 19.0), is_on(1, 5.0), is_on(1, 15.0), is_on(2, 0.0)], [ends, ends, !ends, !ends]);
            assert_eq!(solved.corrected_from_now_on()[0] > 0.2, !ends);
            let without = solved.without(1).expect("a fold");
            let of_left_out = |s: &Solved<Scaled>, place: usize| s.corrected_of_left_out(place)[0] > 0.2;
            // Between two drives it is not known when.
            assert!(without.onset.as_ref().is_some_and(|onset| onset.time == 0.0 && onset.drive() == 1));
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
        let began = |at, ends, others| crate::found::Began { drive: "b".to_owned(), at, ends, others }.to_string();
        let at = Some((12.0, [11.4, 12.6]));
        assert_eq!(began(at, false, false), "it is there from 12 s of drive 'b' (90 %: 11 to 13 s)");
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
