//! A cause that begins or ends while the drives go on: windows as the rows of [`hierarchical_fit`], which finds it.

use nalgebra::DVector;

use crate::constants::Constant;
use crate::drive::Drive;
use crate::fit::{Factors, columns_of, loss, scatter};
use crate::motion::{Laws, implied, moved_on};
use crate::settings::SETTINGS;
use crate::wheel::WheeledRobot;
use crate::windows::{Data, Window, laws};
use hierarchical_fit::{Cause, Kind, Named, Observed, Onset, Prior, Row, Spread, begun, interval_of_instants};

/// A drive by its windows.
#[derive(Clone)]
struct Windowed<'a> {
    robot: &'a WheeledRobot,
    constants: &'a [Constant],
    drive: &'a Drive,
    windows: Vec<Window>,
    rows: Vec<Row>,
}

impl<'a> Windowed<'a> {
    fn new(data: &Data<'a>, index: usize) -> Self {
        let drive = data.drives[index];
        let kept = data.windows[index].iter().zip(&data.dropped[index]).filter(|(_, dropped)| !**dropped);
        let windows: Vec<Window> = kept.map(|(window, _)| *window).collect();
        let of = |window: &Window| {
            // All of a window is known at its end.
            let time = drive.time[window.to] - drive.time[0];
            [Row { kind: Kind::Pose, time, is_moving: window.is_moving(), weight: 1.0 }; 3]
        };
        let rows = windows.iter().flat_map(of).collect();
        Self { robot: data.robot, constants: data.constants, drive, windows, rows }
    }
}

impl Observed for Windowed<'_> {
    type Model = ();

    const WINDOW: f64 = SETTINGS.windows.length;
    const FLOOR: [f64; 3] = [SETTINGS.windows.floor; 3];
    const NEAR: f64 = SETTINGS.unexplained.share;
    const HARDLY: f64 = SETTINGS.unexplained.of_retuned;
    const ANEW: bool = true;

    fn name(&self) -> &str {
        &self.drive.name
    }

    fn seconds(&self) -> f64 {
        self.drive.duration()
    }

    fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn errors(&self, (): &(), theta: &[f64]) -> Vec<f64> {
        let path = implied(self.robot, self.drive, &laws(self.robot, self.constants, theta));
        self.windows.iter().flat_map(|window| window.error(&path)).collect()
    }

    fn columns(&self, (): &(), theta: &[f64]) -> Vec<Vec<f64>> {
        let columns = columns_of((self.robot, self.constants), (self.drive, &self.windows), theta);
        columns.into_iter().map(|column| column.into_iter().flatten().collect()).collect()
    }

    fn sizes(&self) -> Vec<f64> {
        self.windows.iter().filter(|window| window.is_moving()).flat_map(Window::way).collect()
    }

    fn judged_by(&self) -> Kind {
        Kind::Pose
    }

    fn apart(&self, _: Kind) -> usize {
        3
    }
}

/// Looks for a cause that begins or ends while these drives go on, where that says more of them than what was named.
pub(crate) fn onset(
    data: &Data<'_>,
    prior: &Prior,
    causes: &[Cause],
    (factors, named): (Factors, &Named),
) -> Option<(Onset, Named)> {
    let drives: Vec<Windowed<'_>> = (0..data.drives.len()).map(|index| Windowed::new(data, index)).collect();
    let scatter = scatter(data, Factors { others: 1.0, ..factors });
    let spread = |(constant, scatter): (&Constant, &f64)| Spread {
        sigma: constant.sigma,
        usual: constant.usual,
        scatter: *scatter,
        bounds: [f64::NEG_INFINITY, f64::INFINITY],
    };
    let spreads = data.constants.iter().zip(scatter.iter()).map(spread).collect();
    let drives = hierarchical_fit::Data { model: (), spreads, drives };
    let (mut onset, named) = begun(&drives, prior, causes, named)?;
    let scale = data.scale(&errors(data, &named.posterior.mean, &onset));
    let known = onset.changes.clone();
    for (index, (at, _)) in known.into_iter().enumerate().filter_map(|(index, change)| Some((index, change?))) {
        onset.changes[index] = Some(instant(data, index, (&named.posterior.mean, &onset), (at, scale)));
    }
    Some((onset, named))
}

/// When a cause begins or ends in a drive, s from its start, with a 90 % interval: by its windows' errors, in units of `scale`, with paths
/// that change at each instant about one that is known to a window.
fn instant(
    data: &Data<'_>,
    index: usize,
    (on, onset): (&DVector<f64>, &Onset),
    (at, scale): (f64, f64),
) -> (f64, [f64; 2]) {
    let rules = SETTINGS.onset;
    let drive = data.drives[index];
    let [on, off] = [on, &onset.off].map(|theta| implied(data.robot, drive, &data.laws(theta.as_slice())));
    let windows = || data.windows[index].iter().zip(&data.dropped[index]).filter(|(_, dropped)| !**dropped);
    let evidence = |time: f64| -> f64 {
        let path = stitched(drive, [&on, &off], |t| (t >= time) != onset.ends());
        -windows().map(|(window, _)| loss(window.error(&path), scale)).sum::<f64>()
    };
    let steps = (rules.reach / rules.step).round() as i32;
    let times = (-steps..=steps).map(|k| at + rules.step * f64::from(k));
    let tried = times.filter(|time| (0.0..=drive.duration()).contains(time));
    let weighed: Vec<(f64, f64)> = tried.map(|time| (evidence(time), time)).collect();
    let best = weighed.iter().max_by(|a, b| a.0.total_cmp(&b.0)).map_or(at, |(_, time)| *time);
    (best, interval_of_instants(weighed, rules.step))
}

/// Errors of all windows of these drives with a cause that is not always there, whose constants are `on` where it is.
pub(crate) fn errors(data: &Data<'_>, on: &DVector<f64>, onset: &Onset) -> Vec<Vec<[f64; 3]>> {
    let laws = [on, &onset.off].map(|theta| data.laws(theta.as_slice()));
    let of_drive = |index: usize| {
        let path = path(data.robot, data.drives[index], [&laws[0], &laws[1]], |time| onset.acts(index, time));
        data.windows[index].iter().map(|window| window.error(&path)).collect()
    };
    (0..data.drives.len()).map(of_drive).collect()
}

/// The pose that the wheels imply in each row of a drive where a cause is there, `acts`, at some of its instants, s from its start.
pub(crate) fn path(
    robot: &WheeledRobot,
    drive: &Drive,
    [on, off]: [&Laws; 2],
    acts: impl Fn(f64) -> bool,
) -> Vec<[f64; 3]> {
    stitched(drive, [on, off].map(|laws| implied(robot, drive, laws)).each_ref(), acts)
}

/// Of two paths of a drive each where it holds.
fn stitched(drive: &Drive, [on, off]: [&Vec<[f64; 3]>; 2], acts: impl Fn(f64) -> bool) -> Vec<[f64; 3]> {
    let mut out = vec![on[0]];
    for row in 1..on.len() {
        let of = if acts(drive.time[row] - drive.time[0]) { on } else { off };
        out.push(moved_on(out[row - 1], of[row - 1], of[row]));
    }
    out
}
