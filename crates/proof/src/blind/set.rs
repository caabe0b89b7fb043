//! Which cases are drawn.

use anyhow::{Result, ensure};
use clap::builder::{PossibleValuesParser, RangedU64ValueParser, TypedValueParser};
use clap::{Args as ClapArgs, ValueEnum};
use examiner::{Mix, Plan, RobotClass, Setting, Settings, TyreLaw};

/// Cases of `--quick`: with the usual mix at least one of each kind.
const QUICK: usize = 12;

/// What robots stand on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Robots {
    /// Four wheels, coupled by side.
    SkidSteer,
    /// Two driven wheels and casters.
    Differential,
}

/// How a set is drawn.
#[derive(Debug, ClapArgs)]
#[command(next_help_heading = "Drawing")]
#[expect(clippy::struct_excessive_bools, reason = "flags of a command")]
pub(super) struct Drawing {
    /// Seed of the set.
    #[arg(long, default_value_t = 2026)]
    seed: u64,
    /// Number of cases.
    #[arg(long, default_value_t = 300, value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    count: usize,
    /// Twelve cases, of each kind at least one.
    #[arg(long, conflicts_with = "count")]
    quick: bool,
    /// Shares of cases with nothing hidden, one effect, two, a cause outside the vocabulary, and, if given, three effects
    /// [default: 0.2,0.5,0.18,0.12].
    #[arg(long, value_name = "NULL,SINGLE,PAIR,OUTSIDER[,THREE]", value_parser = mix)]
    mix: Option<Mix>,
    /// Tyre law of the true robots; both in turn if not given.
    #[arg(long, value_parser = one_of([("brush", TyreLaw::Brush), ("pacejka", TyreLaw::Pacejka)]))]
    law: Option<TyreLaw>,
    /// Clear effects or weak ones; half and half if not given.
    #[arg(long, value_parser = one_of([("normal", Setting::Normal), ("weak", Setting::Weak)]))]
    setting: Option<Setting>,
    /// Size of the robots.
    #[arg(long, default_value = "medium", value_parser = one_of([
        ("small", RobotClass::Small), ("medium", RobotClass::Medium), ("large", RobotClass::Large),
    ]))]
    class: RobotClass,
    /// What the robots stand on: four wheels coupled by side, or two driven wheels and casters.
    #[arg(long, value_enum, default_value_t = Robots::SkidSteer)]
    robots: Robots,
    /// Rows per second.
    #[arg(long, value_name = "HZ", default_value_t = Settings::default().row_rate_hz)]
    rate: f64,
    /// Factor on sensor noise.
    #[arg(long, default_value_t = Settings::default().noise)]
    noise: f64,
    /// Length of references and recordings.
    #[arg(long, value_name = "SECONDS", default_value_t = Settings::default().duration_s)]
    duration: f64,
    /// Drives in which the simulation is right; of kinds that are not driven by torques these have what the robot file lacks in
    /// all drives [default: 3, of such kinds 0].
    #[arg(long, value_name = "NUMBER", value_parser = RangedU64ValueParser::<usize>::new().range(..=20))]
    references: Option<usize>,
    /// How far each constant of the robot moves after these at most, in the sigmas that its file states.
    #[arg(long, value_name = "SIGMAS", default_value_t = Settings::default().moved)]
    moved: f64,
    /// Robots of 5 to 300 kg, 20 to 1000 rows/s, sensors left out, none to ten references, constants that moved, heavy
    /// tails, laws by another hand, up to three effects at once: each case has its own.
    #[arg(long, conflicts_with_all = [
        "mix", "law", "setting", "class", "robots", "rate", "noise", "duration", "references", "moved", "no_pose", "no_accel",
    ])]
    wide: bool,
    /// Leave out the pose.
    #[arg(long)]
    no_pose: bool,
    /// Leave out the accelerometer.
    #[arg(long)]
    no_accel: bool,
}

impl Drawing {
    pub(super) fn is_wide(&self) -> bool {
        self.wide
    }

    /// The page of the documentation that shows such a set.
    pub(super) fn page(&self) -> &'static str {
        match self.robots {
            _ if self.wide => "blind-wide.md",
            Robots::SkidSteer => "blind.md",
            Robots::Differential => "blind-differential.md",
        }
    }

    fn count(&self) -> usize {
        if self.quick { QUICK } else { self.count }
    }

    pub(super) fn seed_and_count(&self) -> (u64, usize) {
        (self.seed, self.count())
    }

    fn references(&self) -> usize {
        self.references.unwrap_or(Settings::default().references)
    }

    /// References of kinds that are not driven by torques.
    pub(super) fn references_of_others(&self) -> usize {
        self.references.unwrap_or(0)
    }

    /// The cases that are to be drawn.
    pub(super) fn plans(&self) -> Vec<Plan> {
        if self.wide {
            return examiner::wide(self.seed, self.count());
        }
        let settings = Settings {
            setting: self.setting,
            law: self.law,
            class: self.class,
            casters: self.robots == Robots::Differential,
            row_rate_hz: self.rate,
            pose: !self.no_pose,
            accelerometer: !self.no_accel,
            noise: self.noise,
            duration_s: self.duration,
            references: self.references(),
            moved: self.moved,
            ..Settings::default()
        };
        examiner::set(self.seed, self.count(), self.mix.unwrap_or_default(), &settings)
    }

    /// One line for people.
    pub(super) fn described(&self) -> String {
        if self.wide {
            return format!("Wide set of {} cases, seed {}.", self.count(), self.seed);
        }
        let law = self.law.map_or("both tyre laws", TyreLaw::name);
        let setting = self.setting.map_or("normal and weak", Setting::name);
        let without = match (self.no_pose, self.no_accel) {
            (true, true) => ", no pose, no accelerometer",
            (true, false) => ", no pose",
            (false, true) => ", no accelerometer",
            (false, false) => "",
        };
        format!(
            "Set of {} cases, seed {}: {law}, {setting} effects, {} {} robots, {} rows/s, {} s, noise x {}, {} references, constants moved by up to {} sigma{without}.",
            self.count(),
            self.seed,
            format!("{:?}", self.class).to_lowercase(),
            if self.robots == Robots::Differential { "differential" } else { "skid-steer" },
            self.rate,
            self.duration,
            self.noise,
            self.references(),
            self.moved
        )
    }
}

/// The plans with these names; all when no name is given.
pub(super) fn chosen<'a>(plans: &'a [Plan], names: &[String]) -> Result<Vec<&'a Plan>> {
    for name in names {
        ensure!(
            plans.iter().any(|p| p.name == *name),
            "there is no case '{name}' in this set of {}; names are {} to {}",
            plans.len(),
            plans.first().map_or("", |p| &p.name),
            plans.last().map_or("", |p| &p.name)
        );
    }
    Ok(plans.iter().filter(|p| names.is_empty() || names.contains(&p.name)).collect())
}

/// A value by its name.
fn one_of<T: Clone + Send + Sync + 'static, const N: usize>(
    named: [(&'static str, T); N],
) -> impl TypedValueParser<Value = T> {
    let names = PossibleValuesParser::new(named.each_ref().map(|(name, _)| *name));
    names.try_map(move |given| {
        let found = named.iter().find(|(name, _)| *name == given);
        found.map(|(_, value)| value.clone()).ok_or_else(|| format!("'{given}' is none of the names"))
    })
}

fn mix(text: &str) -> Result<Mix, String> {
    let shares: Vec<f64> = text
        .split(',')
        .map(|s| s.trim().parse().map_err(|_| format!("'{s}' is no number")))
        .collect::<Result<_, _>>()?;
    let (null, single, pair, outsider, triple) = match shares[..] {
        [null, single, pair, outsider] => (null, single, pair, outsider, 0.0),
        [null, single, pair, outsider, triple] => (null, single, pair, outsider, triple),
        _ => return Err(format!("four or five shares are needed, these are {}", shares.len())),
    };
    let sensible = shares.iter().all(|s| s.is_finite() && *s >= 0.0) && shares.iter().sum::<f64>() > 0.0;
    if !sensible {
        return Err("shares must be finite, not negative, and not all zero".to_owned());
    }
    Ok(Mix { null, single, pair, outsider, triple })
}

#[cfg(test)]
mod tests {
    use examiner::{Content, Mix};

    use super::{QUICK, mix};

    #[test]
    fn the_quick_set_holds_every_kind() {
        let plans = examiner::set(2014, QUICK, Mix::default(), &examiner::Settings::default());
        let count = |f: &dyn Fn(&Content) -> bool| plans.iter().filter(|p| f(&p.settings.content)).count();
        assert_eq!(count(&|c| *c == Content::Null), 2);
        assert_eq!(count(&|c| matches!(c, Content::Effects(e) if e.len() == 1)), 6);
        assert_eq!(count(&|c| matches!(c, Content::Effects(e) if e.len() == 2)), 2);
        assert_eq!(count(&|c| matches!(c, Content::Outsider(_))), 2);
    }

    #[test]
    fn a_mix_is_four_sensible_shares() {
        let read = mix("0, 1,0.5,0").expect("reads");
        assert_eq!((read.null, read.single, read.pair, read.outsider, read.triple), (0.0, 1.0, 0.5, 0.0, 0.0));
        assert_eq!(mix("0,0,0,0,1").expect("reads").triple, 1.0);
        for bad in ["1,2,3", "a,0,0,0", "0,0,0,0", "-1,2,0,0", "inf,0,0,0"] {
            assert!(mix(bad).is_err(), "{bad}");
        }
    }
}
