//! When what was named is there, by recording.

use std::collections::BTreeMap;

use crate::judged::Judged;
use crate::settings::decision::SETTINGS;

impl Judged<'_> {
    /// When at least half of the wheels were inside the disc, in each recording.
    pub(crate) fn inside(&self, disc: [f64; 3]) -> BTreeMap<String, Vec<[f64; 2]>> {
        const FINE: usize = SETTINGS.answer.path_parts;
        let wheels = self.problem.robot.wheels();
        let mut out = BTreeMap::new();
        for cut in self.problem.cuts {
            let window = cut.rows_per_window as f64 * cut.period;
            let mut list: Vec<[f64; 2]> = Vec::new();
            for (w, ends) in cut.path.windows(2).enumerate() {
                for i in 0..FINE {
                    let f = (i as f64 + 0.5) / FINE as f64;
                    let at = |k: usize| ends[0][k] * (1.0 - f) + ends[1][k] * f;
                    let (sin, cos) = at(2).sin_cos();
                    let inside = wheels
                        .clone()
                        .filter(|[x, y]| {
                            let wheel = [at(0) + cos * x - sin * y, at(1) + sin * x + cos * y];
                            (wheel[0] - disc[0]).hypot(wheel[1] - disc[1]) < disc[2]
                        })
                        .count();
                    if 2 * inside >= wheels.len() {
                        let from = cut.from + (w as f64 + i as f64 / FINE as f64) * window;
                        let until = from + window / FINE as f64;
                        match list.last_mut() {
                            Some(last) if from - last[1] < 1e-6 => last[1] = until,
                            _ => list.push([from, until]),
                        }
                    }
                }
            }
            out.insert(cut.name.clone(), list);
        }
        out
    }

    pub(crate) fn after(&self, onsets: &[Option<f64>]) -> BTreeMap<String, Vec<[f64; 2]>> {
        self.problem
            .cuts
            .iter()
            .zip(onsets)
            .map(|(c, t)| (c.name.clone(), t.map(|t| vec![[t, c.end()]]).unwrap_or_default()))
            .collect()
    }
}
