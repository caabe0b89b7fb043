//! Processor time of this program.

/// Ticks of a second in `/proc`, the same on all of Linux.
const TICKS: f64 = 100.0;

/// Processor time of all threads so far, without other programs that it started, s; `None` where `/proc` does not tell.
pub(super) fn seconds() -> Option<f64> {
    of(&std::fs::read_to_string("/proc/self/stat").ok()?)
}

fn of(stat: &str) -> Option<f64> {
    // The name of the program stands in brackets and may hold anything.
    let (_, fields) = stat.rsplit_once(')')?;
    let ticks = |k: usize| fields.split_whitespace().nth(k)?.parse::<f64>().ok();
    Some((ticks(11)? + ticks(12)?) / TICKS)
}

#[cfg(test)]
mod tests {
    use super::of;

    #[test]
    fn it_is_that_of_the_program_and_of_the_system_for_it() {
        let stat = "7 (a ) b) R 1 1 1 0 -1 4194304 100 0 0 0 250 50 900 800 20 0 1 0 5 6 7";
        assert_eq!(of(stat), Some(3.0));
        assert_eq!(of("7 (a) R 1"), None);
    }
}
