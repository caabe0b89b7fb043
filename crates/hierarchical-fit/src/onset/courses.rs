//! In which drives, and where in each, a cause may begin or end.

use inference::evidence::log_sum_exp;
use inference::robust::median;

use crate::onset::Instants;
use crate::settings::SETTINGS;
use crate::stretches::Stretch;

/// Of each drive its stretch from which on all is otherwise: the first where it is so from its start, the number of them where it is so
/// nowhere in it.
pub(crate) type Course = Vec<usize>;

/// The stretches of drives at whose borders something may change.
#[derive(Debug, Clone)]
pub(crate) struct Grid {
    /// How many each drive has.
    lengths: Vec<usize>,
    /// Stretches at either end of all drives, or of one, that have to be compared.
    least: usize,
}

impl Grid {
    /// Of these drives, whose rows may become known farther apart than stretches are long.
    pub(crate) fn new(drives: &[Vec<Stretch>]) -> Self {
        let rules = SETTINGS.onset;
        let apart = drives.iter().flat_map(|d| d.windows(2).map(|pair| pair[1].from - pair[0].from));
        let step = median(apart).map_or(rules.coarse, |apart| apart.max(rules.coarse));
        let least = ((rules.least / step).round() as usize).max(rules.least_stretches);
        Self { lengths: drives.iter().map(Vec::len).collect(), least }
    }

    /// Every course in which something changes once and stays so in the drives that follow.
    pub(crate) fn in_series(&self) -> Vec<Course> {
        let of = |(drive, from): (usize, usize)| -> Course {
            let place = |(k, length): (usize, &usize)| match k.cmp(&drive) {
                std::cmp::Ordering::Less => *length,
                std::cmp::Ordering::Equal => from,
                std::cmp::Ordering::Greater => 0,
            };
            self.lengths.iter().enumerate().map(place).collect()
        };
        let all = self.lengths.iter().enumerate().flat_map(|(k, length)| (0..*length).map(move |from| (k, from)));
        let all: Vec<(usize, usize)> = all.collect();
        let until = all.len().saturating_sub(self.least);
        all.get(self.least..until).map(|kept| kept.iter().copied().map(of).collect()).unwrap_or_default()
    }

    /// Whether something changes within half a manoeuvre of the first or of the last place at which it may in a series.
    pub(crate) fn is_at_an_end(&self, series: &[Course], course: &Course) -> bool {
        let at = series.iter().position(|other| other == course);
        let near = self.least.div_ceil(2);
        at.is_some_and(|at| at < near || at + near >= series.len())
    }

    /// Where something may change in a drive that changes anew in each.
    fn in_one(&self, drive: usize) -> Vec<usize> {
        let length = self.lengths[drive];
        std::iter::once(0).chain(self.least..(length + 1).saturating_sub(self.least)).chain([length]).collect()
    }

    /// Courses in which something changes in each drive anew: the best from `start` on, and what differs from it in one drive.
    ///
    /// `None` where that is not so in two drives at least.
    pub(crate) fn anew(&self, start: &Course, score: impl Fn(&Course) -> Option<f64>) -> Option<Instants> {
        let with = |course: &Course, drive: usize, from: usize| {
            let mut out = course.clone();
            out[drive] = from;
            out
        };
        let scored = |course: &Course, drive: usize| -> Instants {
            let courses = self.in_one(drive).into_iter().map(|from| with(course, drive, from));
            courses.filter_map(|course| Some((score(&course)?, course))).collect()
        };
        let mut best = start.clone();
        for _ in 0..=SETTINGS.onset.rounds {
            for drive in 0..self.lengths.len() {
                let found = scored(&best, drive).into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
                best = found.map_or(best, |(_, course)| course);
            }
        }
        let inside = best.iter().zip(&self.lengths).filter(|(from, length)| **from > 0 && from < length).count();
        if inside < 2 {
            return None;
        }
        let mut out = vec![(score(&best)?, best.clone())];
        let others = |drive: usize| scored(&best, drive).into_iter().filter(|(_, course)| *course != best);
        out.extend((0..self.lengths.len()).flat_map(others));
        Some(out)
    }

    /// Evidence of courses that change anew in each drive, of which the first is the best, summed over where they do, nats.
    pub(crate) fn sum_anew(&self, instants: &Instants) -> f64 {
        let Some((most, best)) = instants.first() else { return f64::NEG_INFINITY };
        let of_drive = |drive: usize| {
            let scores: Vec<f64> = differing(instants, best, drive).map(|(score, _)| *score).collect();
            log_sum_exp(&scores) - most - (self.in_one(drive).len() as f64).ln()
        };
        most + (0..self.lengths.len()).map(of_drive).sum::<f64>()
    }
}

/// Courses that are the best one, or differ from it in one drive.
pub(crate) fn differing<'a>(
    instants: &'a Instants,
    best: &'a Course,
    drive: usize,
) -> impl Iterator<Item = &'a (f64, Course)> {
    let is_same = move |course: &Course| (0..best.len()).all(|k| k == drive || course[k] == best[k]);
    instants.iter().filter(move |(_, course)| is_same(course))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::Session;

    #[test]
    fn a_series_changes_once_and_courses_that_change_anew_find_each_instant() {
        let grid = Grid { lengths: vec![20, 20], least: 4 };
        let series = grid.in_series();
        assert_eq!(series.first(), Some(&vec![4, 0]));
        assert!(series.contains(&vec![20, 0]) && series.last() == Some(&vec![20, 15]));

        let truth = [7.0, 12.0];
        let score = |course: &Course| {
            Some(-course.iter().zip(truth).map(|(from, at)| (*from as f64 - at).powi(2)).sum::<f64>())
        };
        let found = grid.anew(&vec![7, 0], score).expect("two instants");
        assert_eq!(found[0], (0.0, vec![7, 12]));
        assert!(found[1..].iter().all(|(score, course)| *score < 0.0 && (course[0] == 7 || course[1] == 12)));
        // Each instant is one of fourteen, and beside it e^-1 and e^-4 on either side.
        let width = (1.0 + 2.0 * ((-1.0_f64).exp() + (-4.0_f64).exp())).ln() - (grid.in_one(0).len() as f64).ln();
        approx::assert_relative_eq!(grid.sum_anew(&found), 2.0 * width, epsilon = 1e-3);

        let once = |course: &Course| Some(-(course[0] as f64 - 7.0).powi(2) - course[1] as f64);
        assert!(grid.anew(&vec![7, 0], once).is_none(), "the second drive is so from its start");
    }

    #[test]
    fn what_has_to_be_compared_is_so_many_seconds_and_two_stretches_at_least() {
        let drive = |count: i32, apart: f64| -> Vec<Stretch> {
            let stretch = |k| Stretch { from: f64::from(k) * apart, equations: Session::of_nothing(1) };
            (0..count).map(stretch).collect()
        };
        let least = |apart: f64| Grid::new(&[drive(9, apart), drive(7, apart)]).least;
        assert_eq!([least(1.0), least(2.0), least(4.0)], [4, 2, 2]);

        let grid = Grid::new(&[drive(9, 1.0), drive(7, 1.0)]);
        let series = grid.in_series();
        let at_an_end = |course: &Course| grid.is_at_an_end(&series, course);
        assert_eq!(
            series.iter().map(at_an_end).collect::<Vec<_>>(),
            [true, true, false, false, false, false, true, true]
        );
    }
}
