//! Faults of sensors.

use super::{Hold, Lines, Row, never};
use crate::at::At;
use crate::engine::Engine;
use crate::engine::Way::{Added, Held};
use crate::origin::Section;
use crate::residual::Text;

const NO_BIAS: &str = "noise of its sensors has no mean";
const NO_SENSOR: &str = "it describes a robot without its sensors";
const NO_GAIN: &str = "its sensors have no gain";
const NO_CLOCK: &str = "all its sensors share one clock";
const NO_LOSS: &str = "its sensors lose nothing";

pub(super) const ROWS: [Row; 10] = [
    Row {
        id: "accelerometer_bias",
        section: Section::Sensors,
        hold: Hold::Special(|at, v| {
            for k in 0..2 {
                v.sensors.accel[k] += at.values()[k];
            }
        }),
        ways: [Added(NO_BIAS), Added(NO_SENSOR), Held("mean of the accelerometer's noise")],
        lines: Lines::Of(|at, _| {
            Text::Reading((0..2).map(|k| format!("y[\"accel\"][{k}] += {}", at.text(k))).collect())
        }),
        except: never,
    },
    Row {
        id: "gyro_bias",
        section: Section::Sensors,
        hold: Hold::Special(|at, v| v.sensors.gyro += at.values()[0]),
        ways: [Added(NO_BIAS), Added(NO_SENSOR), Held("mean of the gyro's noise")],
        lines: Lines::Of(|at, _| Text::Reading(vec![format!("y[\"gyro\"] += {}", at.text(0))])),
        except: never,
    },
    Row {
        id: "gyro_scale",
        section: Section::Sensors,
        hold: Hold::Law,
        ways: [Added(NO_GAIN), Added(NO_SENSOR), Added(NO_GAIN)],
        lines: Lines::Of(|at, _| Text::Reading(vec![format!("y[\"gyro\"] *= 1.0 + {}", at.text(0))])),
        except: never,
    },
    Row {
        id: "imu_misalignment",
        section: Section::Sensors,
        hold: Hold::Special(|at, v| v.sensors.left += at.values()[0]),
        ways: [
            Held("orientation of the accelerometer's site"),
            Held("orientation of the link imu"),
            Held("orientation of the IMU"),
        ],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "imu_tilt",
        section: Section::Sensors,
        hold: Hold::Special(|at, v| {
            for k in 0..2 {
                v.sensors.up[k] += at.values()[k];
            }
        }),
        ways: [
            Held("orientation of the accelerometer's site"),
            Held("orientation of the link imu"),
            Held("orientation of the IMU"),
        ],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "encoder_scale",
        section: Section::Sensors,
        hold: Hold::Special(|at, v| {
            for (side, _) in at.sides().iter().enumerate().filter(|(_, has)| **has) {
                v.sensors.encoder[side] *= 1.0 + at.values()[0];
            }
        }),
        ways: [Held("a tendon whose length the encoder reads"), Added(NO_SENSOR), Added(NO_GAIN)],
        lines: Lines::Of(|at, _| {
            Text::Reading(vec![
                format!("for j in {}:", at.sides_text()),
                format!("    y[\"wheel_speed\"][j] *= 1.0 + {}", at.text(0)),
            ])
        }),
        except: never,
    },
    Row {
        id: "clock_offset",
        section: Section::Sensors,
        hold: Hold::Special(|at, v| {
            for k in 0..2 {
                v.sensors.late[k] += at.values()[k];
            }
        }),
        ways: [Held("delay of the sensors"), Added(NO_SENSOR), Added(NO_CLOCK)],
        lines: Lines::Of(|at, _| {
            Text::Words(format!(
                "Shift the samples in time: write IMU samples {} s and pose samples {} s after they were taken (before, where \
                 negative).",
                at.text(0),
                at.text(1)
            ))
        }),
        except: |at: &At<'_>, engine| {
            let early = engine == Engine::Mjcf && at.values()[..2].iter().any(|late| *late < 0.0);
            early.then_some("a sensor cannot show what has not happened yet")
        },
    },
    Row {
        id: "clock_drift",
        section: Section::Sensors,
        hold: Hold::Law,
        ways: [Added(NO_CLOCK), Added(NO_SENSOR), Added(NO_CLOCK)],
        lines: Lines::Of(|at, _| {
            Text::Words(format!(
                "Stretch the clocks: write a sample that was taken at t at t (1 + {}) for the IMU and t (1 + {}) for the pose.",
                at.text(0),
                at.text(1)
            ))
        }),
        except: never,
    },
    Row {
        id: "encoder_dropout",
        section: Section::Sensors,
        hold: Hold::Law,
        ways: [Added(NO_LOSS), Added(NO_SENSOR), Added(NO_LOSS)],
        lines: Lines::Of(|at, _| {
            Text::Words(format!(
                "Freeze the {} wheel angle in short bursts that together take a share of {} of the time; the wheel itself turns on.",
                at.side_name().unwrap_or("left and right"),
                at.text(0)
            ))
        }),
        except: never,
    },
    Row {
        id: "encoder_slipped_index",
        section: Section::Sensors,
        hold: Hold::Law,
        ways: [Added(NO_LOSS), Added(NO_SENSOR), Added(NO_LOSS)],
        lines: Lines::Of(|at, _| {
            Text::Words(format!(
                "Add {} rad to the {} wheel angle from the instant at which it slips; the wheel itself turns on.",
                at.text(0),
                at.side_name().unwrap_or("left and right")
            ))
        }),
        except: never,
    },
];
