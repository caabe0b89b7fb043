//! Effects of one's own: law files, as `lacuna law --save` writes them or as somebody has written them.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use inference::KnownEffects;
use law::{Law, LawError, OwnEffect, OwnEffectError, Variable};
use recordings::{Recording, Signal, Spot};
use robot_file::{Causality, RobotSpec};
use serde::Deserialize;
use serde::de::IgnoredAny;
use toml::Spanned;
use verdict::Prediction;

use crate::TextError;

/// A law file: the formula and the range seen at its top, or in a table `law`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LawFile {
    name: Option<Spanned<String>>,
    formula: Option<Spanned<String>>,
    #[serde(default)]
    seen: BTreeMap<String, Spanned<[f64; 2]>>,
    law: Option<Written>,
    // What `lacuna law --save` tells beside: for people.
    #[serde(rename = "place")]
    _place: Option<IgnoredAny>,
    #[serde(rename = "left")]
    _left: Option<IgnoredAny>,
    #[serde(rename = "verdict")]
    _verdict: Option<IgnoredAny>,
    #[serde(rename = "numbers")]
    _numbers: Option<IgnoredAny>,
}

/// A formula with the range in which it was seen.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    formula: Spanned<String>,
    #[serde(default)]
    seen: BTreeMap<String, Spanned<[f64; 2]>>,
}

/// The catalogue with the effects of law files, and beside them laws that the simulation of every robot is given.
///
/// # Errors
/// Files that cannot be read or hold no law that can be an effect, each with its place, and names that are taken.
pub fn read(files: &[PathBuf], adopted: &[PathBuf]) -> Result<KnownEffects> {
    let mut own: Vec<(&Path, &'static OwnEffect)> = Vec::new();
    for file in files.iter().chain(adopted) {
        let shown = file.display().to_string();
        let text = fs::read_to_string(file).with_context(|| {
            format!("cannot read the law file '{shown}'; `lacuna law VERDICT.json --save {shown}` writes such a file")
        })?;
        let stem = file.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        let effect = parse(&shown, &text, &stem)?;
        if let Some((other, _)) = own.iter().find(|(_, o)| o.name() == effect.name()) {
            let name = effect.name();
            bail!(
                "'{}' and '{shown}' both hold an effect called '{name}'; give one of them another name, as name = \"{name}-2\"",
                other.display()
            );
        }
        own.push((file, effect));
    }
    if own.is_empty() {
        return Ok(KnownEffects::default());
    }
    let mut own: Vec<&'static OwnEffect> = own.into_iter().map(|(_, effect)| effect).collect();
    let adopted = own.split_off(files.len());
    Ok(KnownEffects::with(own).adopting(adopted))
}

/// The effect of a law file's text, called `stem` where the file gives no name.
///
/// # Errors
/// As [`read`].
pub fn parse(file: &str, text: &str, stem: &str) -> Result<&'static OwnEffect, TextError> {
    let at = |span: Option<Range<usize>>, message: String| TextError {
        spot: span.map_or_else(|| Spot::file(file), |span| Spot::of_byte(file, text, span.start)),
        message,
    };
    let parsed: LawFile =
        toml::from_str(text).map_err(|e| at(e.span(), format!("{}; see docs/law.md", e.message())))?;
    let written = match (parsed.formula, parsed.law) {
        (Some(formula), None) => Written { formula, seen: parsed.seen },
        (None, Some(law)) if parsed.seen.is_empty() => law,
        (None, None) => {
            return Err(at(
                None,
                "there is no law; write formula = \"T_right = -0.5 [N m] * sgn(omega, 0.3)\"".to_owned(),
            ));
        }
        _ => return Err(at(None, "formula and seen stand twice; keep those at the top or those in [law]".to_owned())),
    };

    let of_formula = || Some(written.formula.span());
    let law: Law = written.formula.get_ref().parse().map_err(|e: LawError| at(of_formula(), e.to_string()))?;
    let seen = written.seen.iter().map(|(symbol, range)| {
        let variable = Variable::seen(symbol, *range.get_ref()).map_err(|e| at(Some(range.span()), e.to_string()))?;
        Ok((variable, *range.get_ref()))
    });
    let law = law.seen_within(&seen.collect::<Result<Vec<_>, TextError>>()?);

    let name = parsed.name.as_ref().map_or(stem, |name| name.get_ref());
    let of_name = || parsed.name.as_ref().map(Spanned::span);
    if catalogue::find(name).is_some() {
        let what = format!("'{name}' is a name of the catalogue; give this law another one, as name = \"my-{name}\"");
        return Err(at(of_name(), what));
    }
    OwnEffect::new(name, law).map_err(|e| {
        let span = if matches!(e, OwnEffectError::Name(_)) { of_name() } else { of_formula() };
        at(span, e.to_string())
    })
}

/// Refuses effects of one's own for a robot that no free run of the plant is compared with.
///
/// # Errors
/// Such robots, with their kind.
pub fn ensure_torque_driven(robot: &RobotSpec) -> Result<()> {
    if robot.causality != Causality::TorqueDriven {
        robot.known.refused_for(robot.causality.name())?;
    }
    Ok(())
}

/// A sentence for each effect of one's own that a robot file does not name, with what to write there.
pub fn unused(robot: &RobotSpec) -> Vec<String> {
    let of = |own: &&OwnEffect| {
        let value = |p: &robot_model::Parameter| format!("\"{}\" = {}", p.name, p.probes[0]);
        let values: Vec<String> = own.spec().parameters.iter().map(value).collect();
        format!(
            "robot '{}' does not name '{name}', so that it is simulated without it; add effects = [{{ effect = \"{name}\", \
             values = {{ {} }} }}] to its file",
            robot.name,
            values.join(", "),
            name = own.name()
        )
    };
    robot.known.own().iter().filter(|own| !is_named(robot, own)).map(of).collect()
}

fn is_named(robot: &RobotSpec, own: &OwnEffect) -> bool {
    robot.effects.iter().any(|e| e.effect == own.name())
}

/// A sentence for each variable that a simulated drive takes beyond the range in which a law of one's own was seen.
pub fn beyond_seen(robot: &RobotSpec, shown: &Recording) -> Vec<String> {
    let both = |signals: &[Signal]| {
        let channels = signals.iter().filter_map(|s| shown.get(*s));
        range(channels.flat_map(|c| c.values().iter().copied()))
    };
    beyond(robot, &|variable| match variable {
        Variable::WheelSpeed => both(&[Signal::WheelSpeedLeft, Signal::WheelSpeedRight]),
        Variable::Torque => both(&[Signal::TorqueLeft, Signal::TorqueRight]),
        Variable::Velocity => both(&[Signal::BodyVx]),
        Variable::LateralVelocity => both(&[Signal::BodyVy]),
        Variable::YawRate => both(&[Signal::GyroZ]),
        _ => None,
    })
}

/// The same of a forecast, which holds wheel speeds and the yaw rate.
pub fn beyond_seen_in_forecast(robot: &RobotSpec, forecast: &Prediction) -> Vec<String> {
    beyond(robot, &|variable| match variable {
        Variable::WheelSpeed => range(forecast.wheel_speed.iter().flatten().copied()),
        Variable::YawRate => range(forecast.yaw_rate.iter().copied()),
        _ => None,
    })
}

fn beyond(robot: &RobotSpec, of: &dyn Fn(Variable) -> Option<[f64; 2]>) -> Vec<String> {
    let named = robot.known.laws_of_files().filter(|own| is_named(robot, own));
    named.flat_map(|own| own.beyond_seen(of)).collect()
}

/// Least and largest of some values.
fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |range, x| {
        let [low, high] = range.unwrap_or([x; 2]);
        Some([low.min(x), high.max(x)])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: &str = "formula = \"T_right = -0.5 [N m] * sgn(omega, 0.3)\"\n[seen]\nomega = [-8, 8]\n";

    fn refusal(text: &str) -> String {
        parse("my-law.toml", text, "my-law").expect_err("refused").to_string()
    }

    #[test]
    fn a_law_file_is_an_effect_under_its_name_or_that_of_the_file() {
        let effect = parse("dir/my-law.toml", LAW, "my-law").expect("an effect");
        assert_eq!((effect.name(), effect.law().seen()), ("my-law", &[(Variable::WheelSpeed, [-8.0, 8.0])][..]));
        let named = parse("a.toml", &format!("name = \"right-drag\"\n{LAW}"), "a").expect("an effect");
        assert_eq!(named.name(), "right-drag");
        let saved = "name = \"drag\"\nplace = \"torque on the right side\"\nleft = 0.1\nverdict = \"v.json\"\n[law]\n\
            formula = \"T_right = -0.5 [N m] * sgn(omega, 0.3)\"\n[law.seen]\nomega = [-8.0, 8.0]\n[[numbers]]\nof = \"constant\"\n\
            value = -0.5\nhalf = 0.1\nunit = \"N m\"\n";
        assert_eq!(parse("a.toml", saved, "a").expect("an effect").law(), effect.law());
    }

    #[test]
    fn what_no_law_file_may_say_is_refused_in_one_sentence_with_its_place() {
        let with = |formula: &str| format!("name = \"a\"\nformula = \"{formula}\"\n");
        let unit = refusal(&with("T_left = 1 [N s/rad] * pow(omega, 1)"));
        assert!(
            unit.starts_with("my-law.toml: line 2, column 11: ") && unit.contains("closes with N m s/rad only"),
            "{unit}"
        );
        let variable = refusal(&with("T_left = 1 [N m] * sgn(speed, 1)"));
        assert!(variable.contains("line 2, column 11: no variable is called 'speed'"), "{variable}");
        let place = refusal(&with("T_rear = 1 [N m]"));
        assert!(place.contains("no place is called 'T_rear'; known are T_left"), "{place}");
        let number = refusal(&with("T_left = 1 [N m] * bump(omega, -2)"));
        assert!(number.contains("line 2, column 11: 'bump(omega, -2)' has -2"), "{number}");
        let range = refusal("formula = \"T_left = 1 [N m] * sgn(omega, 1)\"\n[seen]\nomega = [5, -4]\n");
        assert!(range.contains("line 3, column 9: the range of 'omega' is 5 to -4"), "{range}");
        let unknown = refusal("formula = \"T_left = 1 [N m]\"\nsean = 1\n");
        assert!(unknown.contains("line 2, column 1: unknown field `sean`") && !unknown.contains('\n'), "{unknown}");
        let taken = refusal(&format!("name = \"payload\"\n{LAW}"));
        assert!(taken.contains("line 1, column 8: 'payload' is a name of the catalogue"), "{taken}");
        assert!(refusal("name = \"a\"\n").contains("there is no law"));
        assert!(refusal(&format!("name = \"A b\"\n{LAW}")).contains("line 1, column 8: 'A b' cannot be the name"));
        let state = refusal(&with("T_both = 2 [1] * lag(T, 0.5)"));
        assert!(state.contains("'lag(T, 0.5)' has a hidden state"), "{state}");
    }

    #[test]
    fn two_laws_of_one_name_are_refused_with_both_files() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = ["a.toml", "b.toml"].map(|name| folder.path().join(name));
        fs::write(&files[0], format!("name = \"drag\"\n{LAW}")).expect("writes");
        fs::write(&files[1], format!("name = \"drag\"\n{LAW}")).expect("writes");
        let error = read(&files, &[]).expect_err("refused").to_string();
        assert!(error.contains("a.toml' and '") && error.contains("both hold an effect called 'drag'"), "{error}");
        assert_eq!(read(&files[..1], &[]).expect("reads").own().len(), 1);
        assert!(
            read(&[folder.path().join("none.toml")], &[])
                .expect_err("refused")
                .to_string()
                .contains("cannot read the law file")
        );
    }
}
