//! Which work comes next: one robot's recordings follow each other, and few robots are prepared at a time.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use super::one::Ready;
use super::unit::{Setup, Unit};

/// Work that waits for hands.
pub(crate) struct Queue {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    /// Robots that nobody has prepared yet.
    fresh: VecDeque<Group>,
    /// Robots of which recordings are left.
    active: Vec<Active>,
    stopped: bool,
}

/// The recordings of a robot.
struct Group {
    setup: Setup,
    units: VecDeque<Unit>,
}

struct Active {
    number: usize,
    units: VecDeque<Unit>,
    /// None while it is being prepared.
    ready: Option<Ready>,
}

/// What to do next.
pub(crate) enum Job {
    /// Prepare this robot, then say so.
    Prepare(usize, Setup),
    /// Diagnose this unit.
    Diagnose(Unit, Ready),
}

impl Queue {
    /// Orders units by robot, then by id.
    pub(crate) fn new(mut units: Vec<Unit>) -> Self {
        units.sort_by(|a, b| (&a.setup, &a.id).cmp(&(&b.setup, &b.id)));
        let mut fresh: VecDeque<Group> = VecDeque::new();
        for unit in units {
            match fresh.back_mut() {
                Some(group) if group.setup == unit.setup => group.units.push_back(unit),
                _ => fresh.push_back(Group { setup: unit.setup.clone(), units: [unit].into() }),
            }
        }
        Self { state: Mutex::new(State { fresh, ..State::default() }), changed: Condvar::new() }
    }

    /// The next job; none when all is taken. Waits while the only work left is that of a robot in preparation.
    ///
    /// Robots that are ready come before new ones, so that no more are held than there are hands.
    pub(crate) fn next(&self) -> Option<Job> {
        let mut state = self.lock();
        loop {
            if state.stopped {
                return None;
            }
            if let Some(at) = state.active.iter().position(|a| a.ready.is_some()) {
                let active = &mut state.active[at];
                let job = active.units.pop_front().zip(active.ready.clone());
                if active.units.is_empty() {
                    state.active.remove(at);
                }
                if let Some((unit, ready)) = job {
                    return Some(Job::Diagnose(unit, ready));
                }
                continue;
            }
            if let Some(Group { setup, units }) = state.fresh.pop_front() {
                let number = state.fresh.len();
                state.active.push(Active { number, units, ready: None });
                return Some(Job::Prepare(number, setup));
            }
            if state.active.is_empty() {
                return None;
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// A robot is prepared.
    pub(crate) fn prepared(&self, number: usize, ready: &Ready) {
        let mut state = self.lock();
        if let Some(active) = state.active.iter_mut().find(|a| a.number == number) {
            active.ready = Some(ready.clone());
        }
        self.changed.notify_all();
    }

    /// Nothing more is given out.
    pub(crate) fn stop(&self) {
        self.lock().stopped = true;
        self.changed.notify_all();
    }

    /// Nothing is done under the lock that could leave it half done.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
