//! Counts that an encoder lost in some windows.

use crate::constants::Quantity;
use crate::fit::columns;
use crate::settings::{Dropout, SETTINGS};
use crate::windows::Data;

const RULES: Dropout = SETTINGS.dropout;

/// Windows of a drive in which a wheel's counts fall short.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lost {
    /// Index among the measured wheels.
    pub(crate) wheel: usize,
    pub(crate) drive: usize,
    /// Windows, with the share of counts that each lost.
    pub(crate) windows: Vec<(usize, f64)>,
}

/// Finds windows far off that one wheel's missing counts account for.
pub(crate) fn lost(data: &Data<'_>, theta: &[f64], scale: f64) -> Vec<Lost> {
    let errors = data.errors(theta);
    let wheels: Vec<(usize, usize)> = data
        .constants
        .iter()
        .enumerate()
        .filter_map(|(k, c)| if let Quantity::Radius(wheel) = c.quantity { Some((k, wheel)) } else { None })
        .collect();
    let mut out: Vec<Lost> = Vec::new();
    for drive in 0..data.drives.len() {
        let size = |e: &[f64; 3]| e.iter().map(|e| (e / scale).powi(2)).sum::<f64>();
        let far: Vec<usize> =
            (0..errors[drive].len()).filter(|&w| size(&errors[drive][w]) > RULES.outlier.powi(2)).collect();
        if far.is_empty() || far.len() as f64 > RULES.most * errors[drive].len() as f64 {
            continue;
        }
        let columns = columns(data, theta, drive);
        let total: f64 = far.iter().map(|&w| size(&errors[drive][w])).sum();
        let of_wheel = |&(k, wheel): &(usize, usize)| {
            let mut explained = 0.0;
            let mut windows = Vec::new();
            for &w in &far {
                let (column, error) = (columns[k][w], errors[drive][w]);
                let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
                // Missing counts shorten what the wheels imply: the error is the column times minus the share.
                let share = -dot(column, error) / dot(column, column).max(f64::MIN_POSITIVE);
                if share > RULES.lost && share < 1.0 + RULES.lost {
                    explained += (dot(column, error).powi(2) / dot(column, column)) / (scale * scale);
                    windows.push((w, share));
                }
            }
            (explained, Lost { wheel, drive, windows })
        };
        let best = wheels.iter().map(of_wheel).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((explained, found)) = best
            && explained > RULES.share * total
            && found.windows.len() >= RULES.windows
        {
            out.push(found);
        }
    }
    // Several encoders do not fail at once: then the body slid.
    let one = out.iter().all(|found| found.wheel == out[0].wheel);
    if one { out } else { Vec::new() }
}
