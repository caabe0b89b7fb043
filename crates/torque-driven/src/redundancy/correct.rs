//! Runs as sound sensors would have shown them.

use std::borrow::Cow;

use robot_model::effect::Redundancy;

use super::angle::jumps_of;
use super::{Fault, Redundant};
use crate::run::Run;

impl Redundant {
    /// The run without the faults that were reported, so that the motion is not blamed for them.
    ///
    /// Zero and gain of the gyro are corrected when the run is cut, and frozen angles are left out there.
    pub(crate) fn corrected<'a>(&self, run: &'a Run) -> Cow<'a, Run> {
        let mut out = Cow::Borrowed(run);
        for fault in &self.faults {
            correct(fault, &mut out);
        }
        out
    }
}

fn correct(fault: &Fault, run: &mut Cow<'_, Run>) {
    let size = fault.magnitude;
    match (fault.spec.redundancy, fault.side) {
        (Redundancy::WheelScale, Some(side)) => {
            for a in run.to_mut().angle[side].iter_mut().flatten() {
                *a /= 1.0 + size;
            }
        }
        (Redundancy::JumpingAngle, Some(side)) => {
            for (row, jump) in jumps_of(&run.angle[side], fault.spec.interest) {
                for a in run.to_mut().angle[side][row..].iter_mut().flatten() {
                    *a -= jump;
                }
            }
        }
        (Redundancy::AccelOffset, _) => {
            for a in run.to_mut().accel[fault.parameter].iter_mut().flatten() {
                *a -= size;
            }
        }
        (Redundancy::AccelTurn, _) => {
            let (s, c) = size.sin_cos();
            let [x, y] = &mut run.to_mut().accel;
            for (x, y) in x.iter_mut().zip(y) {
                if let (Some(x), Some(y)) = (x, y) {
                    (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
                }
            }
        }
        (Redundancy::Delay | Redundancy::DelayGrowth, _) => {
            let growing = fault.spec.redundancy == Redundancy::DelayGrowth;
            let shift = |channel: &mut Vec<Option<f64>>, period: f64| {
                let shown = channel.clone();
                channel.fill(None);
                for (k, v) in shown.into_iter().enumerate() {
                    let late = if growing { size * k as f64 } else { size / period };
                    let row = (k as f64 - late).round();
                    if row >= 0.0
                        && let Some(slot) = channel.get_mut(row as usize)
                    {
                        *slot = v.or(*slot);
                    }
                }
            };
            let run = run.to_mut();
            let period = run.period;
            if fault.parameter == 0 {
                shift(&mut run.gyro, period);
                run.accel.iter_mut().for_each(|a| shift(a, period));
            } else {
                run.pose.iter_mut().for_each(|p| shift(p, period));
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use robot_model::effects;

    use super::super::check;
    use super::super::pool::Measured;
    use super::*;
    use crate::testing::driven;
    use testing::robot;

    fn runs() -> Vec<Run> {
        vec![driven(&robot(), &[], 20.0); 3]
    }

    fn fault(kind: Redundancy, parameter: usize, magnitude: f64, side: Option<usize>) -> Redundant {
        let spec =
            effects::catalogue::<f64>().iter().map(|e| e.spec()).find(|c| c.redundancy == kind).expect("an effect");
        Redundant {
            faults: vec![Fault::new((spec, parameter), Measured { value: magnitude, sigma: 0.0 }, side)],
            ..Redundant::default()
        }
    }

    #[test]
    fn sound_runs_are_left_as_they_are() {
        let run = &runs()[0];
        assert!(matches!(Redundant::default().corrected(run), Cow::Borrowed(_)));
        let bias = fault(Redundancy::GyroOffset, 0, 0.1, None);
        assert!(matches!(bias.corrected(run), Cow::Borrowed(_)));
    }

    #[test]
    fn what_was_told_is_gone_after_the_correction() {
        // A fault of the opposite size is what a wrong correction would make.
        for made in [
            fault(Redundancy::AccelOffset, 0, -0.6, None),
            fault(Redundancy::AccelOffset, 1, 0.5, None),
            fault(Redundancy::AccelTurn, 0, 0.2, None),
            fault(Redundancy::Delay, 0, -0.05, None),
            fault(Redundancy::Delay, 1, -0.05, None),
            fault(Redundancy::DelayGrowth, 0, -4e-3, None),
        ] {
            let faulty: Vec<Run> = runs().iter().map(|r| made.corrected(r).into_owned()).collect();
            let told = check(&faulty, &runs(), None);
            assert_eq!(told.faults.len(), 1, "{:?}", told.faults);
            approx::assert_relative_eq!(told.faults[0].magnitude, -made.faults[0].magnitude, max_relative = 0.1);
            let mended: Vec<Run> = faulty.iter().map(|r| told.corrected(r).into_owned()).collect();
            let left = check(&mended, &runs(), None).faults;
            assert!(left.is_empty(), "{left:?}");
        }
    }

    #[test]
    fn angles_get_their_scale_and_lose_their_jumps() {
        let sound = &runs()[0];
        let mut faulty = sound.clone();
        for (k, a) in faulty.angle[0].iter_mut().enumerate() {
            *a = a.map(|a| 1.5 * (a + if k >= 1000 { 0.4 } else { 0.0 }));
        }
        let mut sensors = fault(Redundancy::WheelScale, 0, 0.5, Some(0));
        sensors.faults.extend(fault(Redundancy::JumpingAngle, 0, 0.4, Some(0)).faults);
        for (a, b) in sensors.corrected(&faulty).angle[0].iter().zip(&sound.angle[0]) {
            approx::assert_abs_diff_eq!(a.expect("there"), b.expect("there"), epsilon = 5e-3);
        }
    }
}
