//! Time on a processor, for examples that are compared with programs in other languages.

/// Time that this process has had processors, all threads together, s: other work on the machine does not count, but for
/// caches it shares.
#[cfg(unix)]
fn seconds() -> f64 {
    let t = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    t.tv_sec as f64 + 1e-9 * t.tv_nsec as f64
}

/// Time, s: where the system tells no process's own.
#[cfg(not(unix))]
fn seconds() -> f64 {
    static START: std::sync::LazyLock<std::time::Instant> = std::sync::LazyLock::new(std::time::Instant::now);
    START.elapsed().as_secs_f64()
}

/// Runs something several times; the median time of one, s, and what the last one gave.
pub(crate) fn timed<T>(rounds: usize, mut run: impl FnMut() -> T) -> (f64, T) {
    let mut once = || {
        let start = seconds();
        let result = std::hint::black_box(run());
        (seconds() - start, result)
    };
    let (first, mut result) = once();
    let mut times = vec![first];
    for _ in 1..rounds {
        let (time, next) = once();
        times.push(time);
        result = next;
    }
    times.sort_by(f64::total_cmp);
    (times[times.len() / 2], result)
}

/// The number behind an option of the command line: `--rows 12000`.
pub(crate) fn option(name: &str, otherwise: usize) -> Result<usize, String> {
    let mut arguments = std::env::args().skip_while(|a| a != name);
    match (arguments.next(), arguments.next()) {
        (None, _) => Ok(otherwise),
        (Some(_), Some(text)) => text.parse().map_err(|_| format!("{name} takes a whole number, but got '{text}'")),
        (Some(_), None) => Err(format!("{name} takes a whole number, but none follows")),
    }
}
