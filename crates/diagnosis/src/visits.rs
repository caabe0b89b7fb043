//! Which drives are of one visit, by when they were started.

use crate::settings::{SETTINGS, Visits};

const VISITS: Visits = SETTINGS.visits;

/// 2000-01-01 in Unix time, ns: stamps below it count from the start of something else.
const ABSOLUTE_FROM_NS: i64 = 946_684_800_000_000_000;

/// Whether a stamp counts from 1970, ns: a robot whose clock starts with it tells no date.
pub const fn is_absolute(stamp_ns: i64) -> bool {
    stamp_ns >= ABSOLUTE_FROM_NS
}

/// The number of the visit that each drive is of, by its first stamp in ns, the earliest first: a visit ends where no drive
/// was started for hours. `None` where all are of one visit, and where a stamp does not count from 1970.
///
/// ```
/// let hour = 3_600_000_000_000;
/// let monday = 1_772_352_000_000_000_000;
///
/// let starts = [monday + 24 * hour, monday, monday + hour];
/// assert_eq!(diagnosis::visits::by_start(&starts), Some(vec![1, 0, 0]));
/// assert_eq!(diagnosis::visits::by_start(&[monday, monday + hour]), None);
/// assert_eq!(diagnosis::visits::by_start(&[0, 24 * hour]), None);
/// ```
pub fn by_start(starts_ns: &[i64]) -> Option<Vec<usize>> {
    if !starts_ns.iter().all(|stamp| is_absolute(*stamp)) {
        return None;
    }
    let mut order: Vec<usize> = (0..starts_ns.len()).collect();
    order.sort_by_key(|&drive| starts_ns[drive]);

    let (mut visits, mut last) = (vec![0; starts_ns.len()], 0);
    for pair in order.windows(2) {
        let apart = starts_ns[pair[1]].saturating_sub(starts_ns[pair[0]]);
        last += usize::from(apart > VISITS.apart_ns);
        visits[pair[1]] = last;
    }
    (last > 0).then_some(visits)
}
