//! What misfit a segment is expected to have, from the references' segments that are driven alike.

use inference::robust::median;

use crate::fit::Problem;
use crate::settings::fit::{Calibrating, SETTINGS};
use crate::simulate::Response;
use crate::windows::{Cut, Segment};

const CALIBRATING: Calibrating = SETTINGS.calibration;

/// Expected misfit of a segment from those of the references driven alike.
#[derive(Clone, Default)]
pub(crate) struct Regimes {
    /// Features and ln(q/D) of each reference segment.
    known: Vec<([f64; 3], f64)>,
    median: f64,
    /// How hard the hardest reference segment is driven, by each measure.
    hardest: [f64; 4],
    /// By which factor the misfit of each reference segment differs from what the others let expect.
    pub(crate) scatter: Vec<f64>,
}

/// Mean of the values of segments driven like `features`: Gaussian kernel of unit width over the features, begun with a
/// few segments at `middle`.
pub(crate) fn kernel_mean(known: impl Iterator<Item = ([f64; 3], f64)>, features: [f64; 3], middle: f64) -> f64 {
    let (mut weight, mut sum) = (CALIBRATING.pseudo_counts, CALIBRATING.pseudo_counts * middle);
    for (other, value) in known {
        let distance2: f64 = other.iter().zip(features).map(|(a, b)| (a - b).powi(2)).sum();
        let k = (-0.5 * distance2).exp();
        weight += k;
        sum += k * value;
    }
    sum / weight
}

impl Regimes {
    pub(crate) fn of_references(problem: &Problem<'_>, response: &Response) -> Self {
        let mut known = Vec::new();
        let mut hardest = [0.0; 4];
        for (r, cut) in problem.cuts.iter().enumerate() {
            for (s, segment) in cut.segments.iter().enumerate() {
                if segment.count > 0.0 {
                    hardest = std::array::from_fn(|k| segment.hardness()[k].max(hardest[k]));
                    known.push((segment.regime, (problem.q(r, s, &response[r][s]) / segment.count).ln()));
                }
            }
        }
        Self::new(known, hardest)
    }

    fn new(mut known: Vec<([f64; 3], f64)>, hardest: [f64; 4]) -> Self {
        known.retain(|k| k.1.is_finite());
        let median = median(known.iter().map(|k| k.1)).unwrap_or(0.0);
        let mut out = Self { known, median, hardest, scatter: Vec::new() };
        out.scatter =
            (0..out.known.len()).map(|i| out.known[i].1.exp() / out.expected_but(out.known[i].0, Some(i))).collect();
        out
    }

    /// Expected q/D: kernel mean of ln(q/D) over features, unit bandwidth, and more where it is driven harder than any reference.
    pub(crate) fn expected(&self, segment: &Segment) -> f64 {
        self.expected_but(segment.regime, None) * self.beyond(segment).powf(CALIBRATING.beyond)
    }

    /// How many times as hard as any reference a segment is driven: as fast, as tight a turn, or as large a change of speed; 1
    /// without references.
    pub(crate) fn beyond(&self, segment: &Segment) -> f64 {
        if self.known.is_empty() {
            return 1.0;
        }
        let times = segment.hardness().into_iter().zip(self.hardest);
        times.map(|(own, hardest)| own / hardest.max(CALIBRATING.least_driving)).fold(1.0, f64::max)
    }

    fn expected_but(&self, features: [f64; 3], left_out: Option<usize>) -> f64 {
        let others = self.known.iter().enumerate().filter(|(i, _)| Some(*i) != left_out).map(|(_, k)| *k);
        kernel_mean(others, features, self.median).exp()
    }

    pub(crate) fn of(&self, cuts: &[Cut]) -> Vec<Vec<f64>> {
        cuts.iter().map(|c| c.segments.iter().map(|s| self.expected(s)).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::testing::{cutting, driven};
    use crate::windows::cut;
    use testing::robot;

    #[test]
    fn what_is_driven_harder_than_any_reference_is_expected_to_leave_more() {
        let segment = cut(&driven(&robot(), &[], 12.0), &cutting()).segments.swap_remove(1);
        let hardest = segment.hardness();
        let alike = Regimes::new(vec![(segment.regime, 0.0)], hardest);
        assert_relative_eq!(alike.expected(&segment), 1.0);
        assert_relative_eq!(Regimes::default().expected(&segment), 1.0);
        // Half as hard in the measure in which it is hardest.
        let k = (0..4).max_by(|&a, &b| hardest[a].total_cmp(&hardest[b])).unwrap_or(0);
        let mut tamer = hardest;
        tamer[k] *= 0.5;
        assert!(tamer[k] > CALIBRATING.least_driving, "{hardest:?}");
        let gentle = Regimes::new(vec![(segment.regime, 0.0)], tamer);
        assert_relative_eq!(gentle.beyond(&segment), 2.0);
        assert_relative_eq!(gentle.expected(&segment), 2_f64.powf(CALIBRATING.beyond));
    }
}
