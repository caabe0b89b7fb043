//! Draws a set of cases into one folder and their truth into another.

use std::path::PathBuf;
use std::time::Instant;

use clap::{Parser, ValueEnum};
use examiner::{Mix, RobotClass, Setting, Settings, TyreLaw, set};

#[derive(Parser)]
struct Args {
    /// Seed of the set.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of cases.
    #[arg(long, default_value_t = 20)]
    count: usize,
    /// Folder for the cases.
    #[arg(long)]
    out: PathBuf,
    /// Folder for the truth.
    #[arg(long)]
    truth: PathBuf,
    /// Rows per second.
    #[arg(long, default_value_t = 100.0)]
    rate: f64,
    /// Factor on sensor noise.
    #[arg(long, default_value_t = 1.0)]
    noise: f64,
    /// Seconds of a run.
    #[arg(long, default_value_t = 24.0)]
    duration: f64,
    /// Size of the robot.
    #[arg(long, value_enum, default_value_t = Size::Medium)]
    class: Size,
    /// Tyre law; both in turn if not given.
    #[arg(long, value_enum)]
    law: Option<Law>,
    /// Only normal or only weak cases; half and half if not given.
    #[arg(long, value_enum)]
    setting: Option<Strength>,
    /// Leave out the pose.
    #[arg(long)]
    no_pose: bool,
    /// Leave out the accelerometer.
    #[arg(long)]
    no_accel: bool,
    /// Shares of null, single, pair and outsider.
    #[arg(long, value_delimiter = ',')]
    mix: Option<Vec<f64>>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Size {
    Small,
    Medium,
    Large,
}

#[derive(Clone, Copy, ValueEnum)]
enum Law {
    Brush,
    Pacejka,
}

#[derive(Clone, Copy, ValueEnum)]
enum Strength {
    Normal,
    Weak,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args = Args::parse();
    let settings = Settings {
        row_rate_hz: args.rate,
        noise: args.noise,
        duration_s: args.duration,
        class: match args.class {
            Size::Small => RobotClass::Small,
            Size::Medium => RobotClass::Medium,
            Size::Large => RobotClass::Large,
        },
        law: args.law.map(|law| match law {
            Law::Brush => TyreLaw::Brush,
            Law::Pacejka => TyreLaw::Pacejka,
        }),
        setting: args.setting.map(|setting| match setting {
            Strength::Normal => Setting::Normal,
            Strength::Weak => Setting::Weak,
        }),
        pose: !args.no_pose,
        accelerometer: !args.no_accel,
        ..Settings::default()
    };
    let mix = match args.mix.as_deref() {
        Some(&[null, single, pair, outsider]) => Mix { null, single, pair, outsider },
        _ => Mix::default(),
    };
    for plan in set(args.seed, args.count, mix, &settings) {
        let start = Instant::now();
        let case = plan.draw()?;
        case.write(&args.out.join(&plan.name))?;
        case.write_truth(&args.truth.join(&plan.name))?;
        let effects = &case.truth.effects;
        let hidden: Vec<_> = effects
            .iter()
            .map(|e| {
                let name = e.kind.as_ref().unwrap_or(&e.id);
                format!("{name} {:.4} (excess {:.1})", e.magnitude, e.excess)
            })
            .collect();
        println!(
            "{} {} {} {} [{}] {:.2} s{}",
            plan.name,
            case.truth.generator,
            case.truth.setting,
            case.truth.verdict,
            hidden.join(", "),
            start.elapsed().as_secs_f64(),
            if case.truth.below_noise { " below noise" } else { "" },
        );
    }
    Ok(())
}
