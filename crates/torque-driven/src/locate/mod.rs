//! Where the mismatch shows before anything is named, and what is left after: signal, side, time, kind of driving,
//! place on the ground. False alarms are held down by the references, each seen by a calibration without it.

mod band;
mod cells;
mod change;
mod compare;
mod fault_free;
mod network;
mod null;
mod remainder;
mod side;
#[cfg(test)]
mod tests;
mod times;
mod torque;
mod traces;
mod whole;

pub(crate) use network::INPUTS;
pub(crate) use remainder::sentence;
pub(crate) use whole::locate;
