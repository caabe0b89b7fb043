//! What a diagnosis says: plain data that serde writes and reads, and nothing else.
//!
//! Engines fill it; pages, exports, the command line and Python read it. It depends on no engine.
//!
//! # Files
//!
//! * `diagnosis`: all that a diagnosis says; `cause`: a possible cause with probability and size.
//! * `located`: where, when and how much; `trace`: recordings beside the simulation.
//! * `free_run`: errors on recordings left out of a fit; `trial`: hypotheses that were fitted.
//! * `turning`: what turns a body otherwise than its wheels say, and what shows another turning than there is.
//! * `correction`: the simulation as it should be; `prediction`: the response of a held-out drive.
//! * `law`: a law for what has no name.
//! * `loads`: steady loads of speed-driven robots.
//! * `response`, `response_constants`: the response of command-driven robots and its constants.
//! * `advice`, `course`: which drive to record next, and a drive as wanted speeds.
//! * `coverage`: which parts of long recordings a diagnosis rests on.
//! * `rehearsal`: which effects would be found on a robot's own inputs, from which size on.

mod advice;
mod cause;
mod correction;
mod course;
mod coverage;
mod diagnosis;
mod drive;
mod free_run;
mod law;
mod loads;
mod located;
mod prediction;
mod rehearsal;
mod response;
mod response_constants;
mod retuned;
mod simulator;
mod trace;
mod trial;
mod turning;

use std::borrow::Cow;

/// A word of the program's own; of another's when read from JSON.
pub type Word = Cow<'static, str>;

pub use advice::{Advice, Contender, Manoeuvre};
pub use cause::{Cause, Estimate};
pub use correction::{Correction, EffectAt, Side};
pub use course::{Course, wheel_speeds};
pub use coverage::{Chosen, ComparedWith, Coverage, Why};
pub use diagnosis::{Diagnosis, FORMAT, Verdict};
pub use drive::{BodyPull, Pulsing, Rhythm, Tipped, Unfollowed};
pub use free_run::FreeRun;
pub use law::{
    Claim, CommonLaw, Event, FoundEvents, FoundLaw, FoundPlace, LawFreeRun, LawNumber, LawOfFile, Opposed, Shared,
    UnnamedCause, one_of, sentence_case,
};
pub use loads::{
    Changes, Forecast, GroundSlope, Hidden, Load, LoadChange, Loads, OtherGround, Quantity, Ratio, RecordingGroup,
    SideChange, Standstill, Turning, TurningChange, Way, Withheld,
};
pub use located::{Cell, Finding, Located, Regime, Remainder, ResidualModel, ResidualTorque, Span, TorqueCertificate};
pub use prediction::{ErrorAhead, PredictedPath, Prediction, SimulatedPath};
pub use rehearsal::{
    Answers, FoundFrom, LookAlike, NotRehearsed, REHEARSAL_FORMAT, Rehearsal, RehearsedDrives, RehearsedEffect,
    RehearsedSize, SensorNoise,
};
pub use response::{Alternative, Earned, Element, Parameter, Response, ResponseModel, Scaling};
pub use response_constants::{DRIVE_CONSTANTS, GROUND_CONSTANTS, ResponseConstant, ResponseError};
pub use retuned::Retuned;
pub use simulator::SimulatorConstants;
pub use trace::{Compared, Trace, instant, rounded};
pub use trial::Trial;
pub use turning::{ClockError, GyroBesidePose, SideDrift, WrongSpeed};

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
