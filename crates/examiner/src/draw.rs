//! Draws the robot, what it hides and its drives; draws again what the noise would drown.

use std::collections::BTreeMap;

use crate::course::Course;
use crate::drive::{Manoeuvre, kinds};
use crate::effect::{self, EffectId, Sizing};
use crate::events::Events;
use crate::hidden::{Hidden, Laws};
use crate::law::{self, LawKind};
use crate::outsider::{self, Outsider};
use crate::random::{Stream, key};
use crate::robot::Constants;
use crate::run::{Run, Task, record};
use crate::sensors::Sheet;
use crate::truth::{EffectTruth, RecordingTruth};
use crate::{Content, Error, Setting, Settings, Severity, TyreLaw};

/// Draws of a case at most.
const ATTEMPTS: u64 = 8;

/// A case being drawn.
pub(crate) struct Draw<'a> {
    pub seed: u64,
    pub law: TyreLaw,
    pub setting: Setting,
    pub nominal: Constants,
    pub robot: Constants,
    pub sheet: Sheet,
    pub row: f64,
    settings: &'a Settings,
    rows: usize,
    recordings: usize,
    drives: Vec<[Manoeuvre; 2]>,
    /// Factor on the gain of the controller.
    gain: f64,
}

/// What was hidden and the recordings with it.
pub(crate) struct HiddenRuns {
    pub effects: Vec<EffectTruth>,
    pub recordings: Vec<Run>,
    pub truths: BTreeMap<String, RecordingTruth>,
    pub in_heldout: Hidden,
    pub below_noise: bool,
    pub attempt: u64,
    pub drives: Vec<[Manoeuvre; 2]>,
}

/// One thing to hide.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Cause {
    Effect(EffectId),
    Outsider(Outsider),
    Law(LawKind),
}

impl HiddenRuns {
    /// The verdict that is right.
    pub(crate) fn verdict(&self) -> &'static str {
        if self.effects.is_empty() {
            "no mismatch"
        } else if self.effects.iter().any(|e| e.kind.is_some()) {
            "unknown"
        } else {
            "explained"
        }
    }
}

impl<'a> Draw<'a> {
    /// A robot and its sensors.
    pub(crate) fn new(seed: u64, settings: &'a Settings) -> Result<Self, Error> {
        let row = 1.0 / settings.row_rate_hz;
        let ticks = row / 0.0005;
        if !(0.5..=200.0).contains(&ticks) || (ticks - ticks.round()).abs() > 1e-6 {
            return Err(Error::Settings("a row must last a multiple of 0.5 ms, up to 0.1 s"));
        }
        let rows = (settings.duration_s * settings.row_rate_hz).round() as usize;
        if rows < 400 || settings.recordings == Some(0) {
            return Err(Error::Settings("a case needs runs of at least 400 rows"));
        }
        if matches!(&settings.content, Content::Effects(e) if e.len() > 3) {
            return Err(Error::Settings("at most three effects can be hidden"));
        }
        if settings.mass_kg.is_some_and(|mass| !(2.0..=500.0).contains(&mass)) {
            return Err(Error::Settings("a robot has a mass of 2 to 500 kg"));
        }
        let mut s = Stream::new(seed, "case", 0);
        let brush = s.unit() < 0.5;
        let drawn = if brush { TyreLaw::Brush } else { TyreLaw::Pacejka };
        let law = settings.law.unwrap_or(drawn);
        let weak = Stream::new(seed, "setting", 0).unit() < 0.5;
        let drawn = if weak { Setting::Weak } else { Setting::Normal };
        let setting = settings.setting.unwrap_or(drawn);
        let nominal = match settings.mass_kg {
            None => Constants::nominal(seed, settings.class, law),
            Some(mass) => Constants::of_mass(seed, mass, law),
        };
        let nominal = if settings.casters { nominal.on_casters(seed) } else { nominal };
        let recordings = settings.recordings.unwrap_or(3 + s.index(2));
        let drives = kinds(&mut s, settings.references.max(1));
        Ok(Self {
            seed,
            law,
            setting,
            robot: nominal.truth(seed),
            nominal,
            sheet: Sheet::new(settings),
            row,
            settings,
            rows,
            recordings,
            drives,
            gain: 1.0,
        })
    }

    fn run(&self, name: &str, i: usize, kinds: [Manoeuvre; 2], h: &Hidden, rows: usize) -> Run {
        self.run_on(name, i, kinds, None, h, rows)
    }

    fn run_on(
        &self,
        name: &str,
        i: usize,
        kinds: [Manoeuvre; 2],
        course: Option<&Course>,
        h: &Hidden,
        rows: usize,
    ) -> Run {
        let seed = key(self.seed, name, i as u64);
        let spread = match self.setting {
            Setting::Normal => 1.0,
            Setting::Weak => 2.5,
        };
        let robot = self.robot.on_run(&mut Stream::new(seed, "friction", 0), spread);
        let duration = rows as f64 * self.row;
        record(Task {
            seed,
            nominal: &self.nominal,
            robot: &robot,
            hidden: h,
            events: Events::draw(&h.foreign, seed, duration),
            sheet: self.sheet,
            kinds,
            course,
            gain: self.gain,
            row: self.row,
            rows,
        })
    }

    /// A further recording with what is hidden, on a course that was asked for.
    pub(crate) fn further(&self, hidden: &HiddenRuns, number: usize, course: &Course) -> Run {
        let name = format!("further {}", hidden.attempt);
        let mut h = hidden.in_heldout.clone();
        let rows = (course.duration() / self.row).round() as usize;
        if let Some((at, _)) = &mut h.onset {
            let [from, until] = self.settings.onset;
            let share = Stream::new(self.seed, &name, number as u64).uniform(from, until);
            *at = (100.0 * course.duration() * share).round() / 100.0;
        }
        self.run_on(&name, number, [Manoeuvre::Random; 2], Some(course), &h, rows)
    }

    /// The runs without anything hidden, at least one: torques are sized by them, whether they are shown or not.
    pub(crate) fn references(&mut self) -> Vec<Run> {
        let none = Hidden::default();
        let drives = self.drives.iter().enumerate();
        drives.map(|(i, kinds)| self.run("reference", i, *kinds, &none, self.rows)).collect()
    }

    /// The held-out runs, with everything that came up during a recording present throughout.
    pub(crate) fn heldout(&self, hidden: &HiddenRuns) -> Vec<Run> {
        let name = format!("held-out {}", hidden.attempt);
        let rows = self.rows * 5 / 6;
        let drives = hidden.drives[self.recordings..].iter().enumerate();
        drives.map(|(i, kinds)| self.run(&name, i, *kinds, &hidden.in_heldout, rows)).collect()
    }

    /// Hides what the settings ask for and drives the recordings, until the noise does not drown
    /// it; the clearest draw stands if none does.
    pub(crate) fn hide(&mut self, references: &[Run]) -> HiddenRuns {
        let causes = self.causes();
        self.gain = self.settings.controller_gain;
        if self.settings.moved > 0.0 {
            self.robot = self.robot.moved(self.seed, self.settings.moved);
        }
        let mut torques: Vec<f64> =
            references.iter().flat_map(|r| r.rows.iter().flat_map(|row| row.torque.map(f64::abs))).collect();
        torques.sort_by(f64::total_cmp);
        let peak_torque = torques[torques.len() * 97 / 100];
        let mut best: Option<(f64, HiddenRuns)> = None;
        for attempt in 0..ATTEMPTS {
            let drawn = self.attempt(attempt, &causes, peak_torque);
            let excess = drawn.effects.iter().map(|e| e.excess);
            let least = excess.fold(f64::INFINITY, f64::min);
            let enough = least >= self.settings.least_excess;
            if best.as_ref().is_none_or(|(before, _)| least > *before) {
                best = Some((least, drawn));
            }
            if enough || self.settings.least_excess <= 0.0 {
                break;
            }
        }
        let Some((least, mut hidden)) = best else { unreachable!("the first draw always stands") };
        hidden.below_noise = least < self.settings.least_excess.max(1.3);
        hidden
    }

    /// What to hide.
    fn causes(&self) -> Vec<Cause> {
        let mut s = Stream::new(self.seed, "causes", 0);
        let mut any = |physical: bool| {
            let all: Vec<_> =
                EffectId::of(self.settings.casters).into_iter().filter(|e| !physical || !e.is_sensor()).collect();
            all[s.index(all.len())]
        };
        match &self.settings.content {
            Content::Null => Vec::new(),
            Content::Effects(ids) => ids.iter().map(|id| Cause::Effect(*id)).collect(),
            Content::AnySingle => vec![Cause::Effect(any(false))],
            Content::AnyPair => {
                let first = any(true);
                let mut second = any(true);
                while second == first {
                    second = any(true);
                }
                vec![Cause::Effect(first), Cause::Effect(second)]
            }
            Content::Outsider(kind) => vec![Cause::Outsider(*kind)],
            Content::Law(kind) => vec![Cause::Law(*kind)],
            Content::AnyOutsider => {
                let all = Outsider::of(self.settings.casters);
                vec![Cause::Outsider(all[s.index(all.len())])]
            }
        }
    }

    fn attempt(&self, attempt: u64, causes: &[Cause], peak_torque: f64) -> HiddenRuns {
        let mut s = Stream::new(self.seed, "hidden", attempt);
        let severity = self.settings.severity;
        let severity = severity.unwrap_or_else(|| Severity::ALL[s.index(3)]);
        let sizing = Sizing {
            robot: &self.nominal,
            severity,
            setting: self.setting,
            // Later draws are a little larger, so that drowned effects come up.
            factor: self.settings.size * (1.0 + 0.05 * attempt as f64),
            peak_torque,
            place: self.settings.place,
        };
        let mut hidden = Hidden::default();
        if self.settings.other_laws {
            hidden.laws = Laws::draw(&mut Stream::new(self.seed, "laws", attempt));
        }
        let mut effects = Vec::new();
        for cause in causes {
            effects.push(match cause {
                Cause::Effect(id) => effect::hide(*id, &sizing, &mut s, &mut hidden),
                Cause::Law(kind) => law::hide(*kind, &sizing, &mut s, &mut hidden),
                Cause::Outsider(kind) => outsider::hide(*kind, &sizing, &mut s, &mut hidden),
            });
        }
        let mut drives = kinds(&mut s, self.recordings + self.settings.heldout);
        for (drive, kind) in drives.iter_mut().take(self.recordings).zip(self.settings.drives.iter().cycle()) {
            *drive = [*kind; 2];
        }
        let [from, until] = self.settings.onset;
        let duration = self.rows as f64 * self.row;
        let name = format!("recording {attempt}");
        let mut runs = Vec::new();
        let mut in_runs = Vec::new();
        for (i, kinds) in drives.iter().take(self.recordings).enumerate() {
            let mut h = hidden.clone();
            if let Some((at, _)) = &mut h.onset {
                *at = (100.0 * duration * s.uniform(from, until)).round() / 100.0;
            }
            runs.push(self.run(&name, i, *kinds, &h, self.rows));
            in_runs.push(h);
        }
        let mut drawn = HiddenRuns {
            effects,
            recordings: runs,
            truths: BTreeMap::new(),
            in_heldout: hidden,
            below_noise: false,
            attempt,
            drives,
        };
        self.measure(&mut drawn, &in_runs, causes);
        drawn
    }
}
