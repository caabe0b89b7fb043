//! A process that is watched: how long it takes and how much memory it holds at most.

use std::process::{Command, ExitStatus};
use std::thread::sleep;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};

/// How often the process is looked at.
const LOOK: Duration = Duration::from_millis(10);
/// After this time it is stopped.
const LIMIT: Duration = Duration::from_mins(10);

/// How a process ended.
#[derive(Debug)]
pub struct Ended {
    /// Its exit code, or the signal that ended it.
    pub status: ExitStatus,
    /// From start to end, s.
    pub seconds: f64,
    /// Time on a processor, s, where the system tells.
    pub processor: Option<f64>,
    /// Most memory that it held, bytes, where the system tells.
    pub memory: Option<u64>,
}

/// What the system tells about a process.
#[derive(Debug, Clone, Copy, Default)]
struct Usage {
    processor: Option<f64>,
    memory: Option<u64>,
}

/// Runs a command to its end.
///
/// # Errors
///
/// When it cannot be started or asked how it ended, and when it takes longer than ten minutes: then it is stopped.
pub fn run(command: &mut Command) -> Result<Ended> {
    let start = Instant::now();
    let mut child =
        command.spawn().with_context(|| format!("cannot start '{}'", command.get_program().to_string_lossy()))?;
    let (mut processor, mut memory) = (None, None);
    loop {
        let now = usage(child.id());
        // Once it has ended there is no memory to be told of; the time stays until it is asked for its status.
        (processor, memory) = (now.processor.or(processor), now.memory.max(memory));
        if let Some(status) = child.try_wait().context("cannot ask how the process ended")? {
            return Ok(Ended { status, seconds: start.elapsed().as_secs_f64(), processor, memory });
        }
        if start.elapsed() > LIMIT {
            child.kill().and_then(|()| child.wait()).context("cannot stop the process")?;
            bail!("stopped after {} s", LIMIT.as_secs());
        }
        sleep(LOOK);
    }
}

/// Time on processors that all ended children of this process took, and theirs, s; where the system tells.
#[cfg(target_os = "linux")]
pub fn processor_of_children() -> Option<f64> {
    let stat = procfs::process::Process::myself().and_then(|this| this.stat()).ok()?;
    Some((stat.cutime + stat.cstime) as f64 / procfs::ticks_per_second() as f64)
}

/// Time on processors that all ended children of this process took, and theirs, s; where the system tells.
#[cfg(not(target_os = "linux"))]
pub fn processor_of_children() -> Option<f64> {
    None
}

/// Time on processors that this process took, all its threads, s; where the system tells.
pub fn processor_of_this() -> Option<f64> {
    usage(std::process::id()).processor
}

#[cfg(target_os = "linux")]
fn usage(id: u32) -> Usage {
    let Some(process) = i32::try_from(id).ok().and_then(|id| procfs::process::Process::new(id).ok()) else {
        return Usage::default();
    };
    let ticks = procfs::ticks_per_second() as f64;
    Usage {
        processor: process.stat().ok().map(|s| (s.utime + s.stime) as f64 / ticks),
        // In kB. The peak of this program only: it begins anew when a process becomes another program.
        memory: process.status().ok().and_then(|s| s.vmhwm).map(|kb| 1024 * kb),
    }
}

#[cfg(not(target_os = "linux"))]
fn usage(_: u32) -> Usage {
    Usage::default()
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn work_of_this_process_takes_time_on_processors() {
        let before = processor_of_this().expect("Linux tells it");
        let begun = Instant::now();
        let mut sum = 0_u64;
        // Ticks are of ten milliseconds.
        while begun.elapsed() < Duration::from_secs(5) && processor_of_this().is_some_and(|now| now <= before) {
            sum = std::hint::black_box(sum.wrapping_add(1));
        }
        assert!(processor_of_this().expect("still") > before, "{sum}");
    }
}
