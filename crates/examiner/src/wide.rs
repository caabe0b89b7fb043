//! Sets of robots, sensors and visits of every sort: what a user may come with who stands far from the bench.

use crate::random::{Stream, key};
use crate::turns::Turns;
use crate::{Content, EffectId, Outsider, Plan, Setting, Settings, Severity, TyreLaw};

/// Shares of what is hidden: nothing, one effect, two, three, a cause outside the vocabulary.
const SHARES: [f64; 5] = [0.34, 0.34, 0.1, 0.06, 0.16];
/// Masses, kg: drawn so that every ratio is as likely as another.
const MASSES: [f64; 2] = [5.0, 300.0];
/// Rows per second.
const RATES: [f64; 6] = [20.0, 50.0, 100.0, 200.0, 500.0, 1000.0];
/// Numbers of reference runs: one case in five has none.
const REFERENCES: [usize; 10] = [0, 0, 1, 2, 3, 3, 3, 4, 6, 10];
/// Lengths of references and recordings, s.
const DURATIONS: [f64; 4] = [24.0, 24.0, 36.0, 60.0];
/// How far constants move at most after the references, in the sigmas of the robot file.
const MOVED: [f64; 4] = [0.0, 0.3, 1.0, 1.0];
/// Factors on sensor noise.
const NOISE: [f64; 2] = [0.5, 2.0];

/// Plans a set of `n` cases, each with its own size, sensors, rate, length, references and visit; the same seed and number
/// give the same plans.
pub fn wide(seed: u64, n: usize) -> Vec<Plan> {
    let mut s = Stream::new(seed, "wide set", 0);
    let mut contents = contents(seed, n);
    s.shuffle(&mut contents);
    contents
        .into_iter()
        .enumerate()
        .map(|(i, content)| Plan {
            name: format!("w{:03}", i + 1),
            seed: key(seed, "case of wide set", i as u64),
            settings: one(content, Stream::new(seed, "settings of wide set", i as u64)),
        })
        .collect()
}

/// Effects and outsiders in turn, so that each comes up about as often as another.
fn contents(seed: u64, n: usize) -> Vec<Content> {
    let of_the_robot: Vec<EffectId> = EffectId::ALL.into_iter().filter(|e| !e.is_sensor()).collect();
    let stream = |name| Stream::new(seed, name, 0);
    let mut effects = Turns::new(&EffectId::ALL, stream("effects of wide set"));
    let mut together = Turns::new(&of_the_robot, stream("effects together of wide set"));
    let mut outsiders = Turns::new(&Outsider::ALL, stream("outsiders of wide set"));
    let counts = SHARES.map(|share| (share * n as f64).round() as usize);
    let mut out = vec![Content::Null; counts[0]];
    out.extend((0..counts[1]).map(|_| Content::Effects(effects.different(1))));
    out.extend((0..counts[2]).map(|_| Content::Effects(together.different(2))));
    out.extend((0..counts[3]).map(|_| Content::Effects(together.different(3))));
    out.extend((0..counts[4]).flat_map(|_| outsiders.different(1)).map(Content::Outsider));
    // Rounded shares may miss a case or have one too many.
    out.resize(n, Content::Null);
    out
}

/// Everything else about a case.
fn one(content: Content, mut s: Stream) -> Settings {
    let [least, most] = MASSES.map(f64::ln);
    let [quiet, loud] = NOISE.map(f64::ln);
    let mut settings = Settings {
        content,
        severity: Some(Severity::ALL[s.index(3)]),
        setting: Some(if s.unit() < 0.5 { Setting::Normal } else { Setting::Weak }),
        law: Some(if s.unit() < 0.5 { TyreLaw::Brush } else { TyreLaw::Pacejka }),
        mass_kg: Some(s.uniform(least, most).exp()),
        row_rate_hz: RATES[s.index(RATES.len())],
        pose: s.unit() < 0.8,
        accelerometer: s.unit() < 0.8,
        noise: s.uniform(quiet, loud).exp(),
        heavy_tails: s.unit() < 0.3,
        duration_s: DURATIONS[s.index(DURATIONS.len())],
        references: REFERENCES[s.index(REFERENCES.len())],
        moved: MOVED[s.index(MOVED.len())],
        other_laws: s.unit() < 0.3,
        ..Settings::default()
    };
    // Without references there is nothing from which constants could have moved: they are off as the robot file states.
    if settings.references == 0 {
        settings.moved = 0.0;
    }
    settings
}

#[cfg(test)]
mod tests {
    use super::{MASSES, wide};
    use crate::Content;

    #[test]
    fn a_wide_set_has_everything_and_is_stable() {
        let plans = wide(3, 300);
        assert_eq!(plans, wide(3, 300));
        assert_ne!(plans, wide(4, 300));
        let count = |f: &dyn Fn(&crate::Plan) -> bool| plans.iter().filter(|p| f(p)).count();
        assert_eq!(plans.len(), 300);
        assert_eq!(count(&|p| p.settings.content == Content::Null), 102);
        for size in 1..=3 {
            let of_size = count(&|p| matches!(&p.settings.content, Content::Effects(e) if e.len() == size));
            assert!(of_size >= 18, "{size}: {of_size}");
        }
        let apart = |p: &crate::Plan| match &p.settings.content {
            Content::Effects(e) => (1..e.len()).all(|i| !e[..i].contains(&e[i])),
            _ => true,
        };
        assert!(plans.iter().all(apart), "effects of a case differ");
        let mass = |p: &crate::Plan| p.settings.mass_kg.unwrap_or(0.0);
        assert!(plans.iter().all(|p| (MASSES[0]..=MASSES[1]).contains(&mass(p))));
        assert!(count(&|p| mass(p) < 15.0) > 50 && count(&|p| mass(p) > 100.0) > 50);
        assert!(count(&|p| p.settings.references == 0) > 30 && count(&|p| p.settings.moved > 0.9) > 60);
        assert!(plans.iter().all(|p| p.settings.references > 0 || p.settings.moved == 0.0));
    }

    #[test]
    fn cases_far_from_the_bench_can_be_drawn() {
        for plan in wide(5, 40).into_iter().filter(|p| p.settings.row_rate_hz <= 50.0).take(3) {
            let case = plan.draw().expect("draws");
            let shown = case.files.iter().filter(|(path, _)| path.starts_with("reference")).count();
            assert_eq!(shown, plan.settings.references);
        }
    }
}
