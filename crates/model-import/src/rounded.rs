//! Numbers as a robot file writes them: no finer than a model knows.

/// To a ten-thousandth of a degree, without a minus before zero.
pub(crate) fn degrees(angle: f64) -> f64 {
    to(1e4, angle.to_degrees())
}

/// To a micrometre.
pub(crate) fn metres(length: f64) -> f64 {
    to(1e6, length)
}

/// Six digits.
pub(crate) fn digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value) + 0.0
}

fn to(fine: f64, value: f64) -> f64 {
    (value * fine).round() / fine + 0.0
}
