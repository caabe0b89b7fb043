//! Poses that a tracker writes where it sees nothing.

use inference::robust::{quantile, sorted};

use crate::settings::SETTINGS;

/// Poses that are 0, 0, 0 between others that are far from there are not seen: trackers write them where they have lost the robot. What a
/// drive begins with, or passes, stays.
pub(crate) fn without_zeros(pose: &mut [[f64; 3]], told: &mut Vec<String>) {
    let rules = SETTINGS.drive;
    let is_zero = |row: &[f64; 3]| row.iter().all(|x| *x == 0.0);
    let way = |a: &[f64; 3], b: &[f64; 3]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let steps = pose.windows(2).filter(|w| w.iter().all(|row| !is_zero(row))).map(|w| way(&w[0], &w[1]));
    let Some(usual) = quantile(&sorted(steps.filter(|step| step.is_finite())), rules.usual_step) else { return };
    let is_far = |row: Option<&[f64; 3]>| row.is_none_or(|row| way(row, &[0.0; 3]) > rules.reset * usual);

    let mut lost = 0;
    let mut row = 0;
    while row < pose.len() {
        let next = (row..pose.len()).find(|k| !is_zero(&pose[*k])).unwrap_or(pose.len());
        let before = row.checked_sub(1).map(|k| pose[k]);
        // The whole drive is another matter, and a robot that was at the origin passes near it.
        let is_between = before.is_some() || next < pose.len();
        if next > row && is_between && is_far(before.as_ref()) && is_far(pose.get(next)) {
            pose[row..next].fill([f64::NAN; 3]);
            lost += next - row;
        }
        row = next + 1;
    }
    if lost > 0 {
        told.push(format!(
            "the pose is 0, 0, 0 in {lost} rows, between others that are far from there: it is taken as not seen there"
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_of_zeros_far_from_the_origin_are_not_seen_and_those_at_a_beginning_are() {
        let along = |from: f64| move |k: i32| [from + 0.01 * f64::from(k), 0.0, 0.1];
        let mut from_origin: Vec<[f64; 3]> = vec![[0.0; 3]; 20];
        from_origin.extend((0..100).map(along(0.0)));
        let (mut pose, mut told) = (from_origin.clone(), Vec::new());
        without_zeros(&mut pose, &mut told);
        assert_eq!((pose, told.len()), (from_origin, 0));

        let mut far: Vec<[f64; 3]> = (0..100).map(along(1.0)).collect();
        far[40..43].fill([0.0; 3]);
        far[99] = [0.0; 3];
        without_zeros(&mut far, &mut told);
        let unseen: Vec<usize> = (0..100).filter(|k| far[*k][0].is_nan()).collect();
        assert_eq!(unseen, [40, 41, 42, 99]);
        assert!(told[0].contains("in 4 rows"), "{told:?}");
    }
}
