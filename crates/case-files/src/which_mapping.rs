//! Which mapping reads recordings for which nobody named one.

use std::fs::File;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use recordings::{BUILT_IN_MAPPINGS, Contents, FileMapping, Mapping, contents, contents_of_beginning, is_bag};

use crate::propose::{self, holds};
use crate::{case_folder, inputs};

/// The mapping of tables whose columns describe themselves.
pub const SELF_DESCRIBING: &str = "skid-steer-columns";

/// The bags among files, in folders and in the folders of these, which may be bags themselves.
///
/// # Errors
/// A folder that cannot be listed.
pub fn bags(paths: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let (bags, _) = bags_and_tables(paths)?;
    Ok(bags)
}

/// Bags, and whether there are tables beside them.
fn bags_and_tables(paths: &[PathBuf]) -> Result<(Vec<PathBuf>, bool)> {
    let mut files = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let (folders, own): (Vec<_>, Vec<_>) = inputs::list(path)?.into_iter().partition(|p| p.is_dir());
        files.extend(own);
        for folder in folders {
            let (below, inside): (Vec<_>, Vec<_>) = inputs::list(&folder)?.into_iter().partition(|p| p.is_dir());
            let below = below.iter().map(|bag| inputs::list(bag)).collect::<Result<Vec<_>>>()?;
            let bags = inside.into_iter().chain(below.into_iter().flatten());
            files.extend(bags.filter(|p| is_bag(&p.to_string_lossy())));
        }
    }
    let tables = files.iter().any(|p| p.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv")));
    files.retain(|path| path.is_file() && is_bag(&path.to_string_lossy()));
    Ok((files, tables))
}

/// What is inside a bag, with its name.
///
/// # Errors
/// When it cannot be read.
pub fn look(bag: &Path) -> Result<(String, Contents)> {
    let name = bag.display().to_string();
    let mut file = File::open(bag).with_context(|| format!("cannot read '{name}'"))?;
    let contents = contents(&name, &mut file)?;
    Ok((name, contents))
}

/// What a bag starts with.
pub struct Glance {
    /// The bag's name.
    pub bag: String,
    /// What is inside its beginning.
    pub contents: Contents,
    /// The bag ends there.
    pub is_whole: bool,
}

/// Looks at the beginning of a bag, at all of it where that cannot be read by itself.
///
/// # Errors
/// When it cannot be read.
pub fn glance(bag: &Path) -> Result<Glance> {
    /// Bytes: some ten seconds of a camera, which fills bags most.
    const MOST: u64 = 16 << 20;
    let name = bag.display().to_string();
    let mut file = File::open(bag).with_context(|| format!("cannot read '{name}'"))?;
    if let Ok(contents) = contents_of_beginning(&name, &mut file, MOST) {
        // A file that grows meanwhile is looked at again.
        let is_whole = contents.bytes < MOST;
        return Ok(Glance { bag: name, contents, is_whole });
    }
    let (bag, contents) = look(bag)?;
    Ok(Glance { bag, contents, is_whole: true })
}

/// Whether a bag has every topic and every field that a mapping of bags asks for: what is nearly there may be the bag of
/// another robot with joints of the same names. Of a file that describes itself, any topic with its fields will do.
pub fn fits(mapping: &Mapping, contents: &Contents) -> bool {
    let is_there = |entry: &FileMapping| {
        let topic = contents.topics.iter().find(|topic| entry.topic.as_deref() == Some(&topic.name));
        topic.is_some_and(|topic| {
            let time = entry.time.column.as_deref().filter(|column| *column != "log_time");
            let asked =
                entry.columns.iter().filter(|c| !c.optional || entry.self_describing).map(|c| c.column.as_str());
            asked.chain(time).all(|column| holds(topic, column))
        })
    };
    if mapping.files.iter().any(|entry| entry.self_describing) {
        mapping.files.iter().any(is_there)
    } else {
        mapping.files.iter().all(is_there)
    }
}

/// The names of the built-in mappings of bags.
fn built_in_for_bags() -> impl Iterator<Item = (&'static str, Mapping)> {
    let all = BUILT_IN_MAPPINGS.iter().filter_map(|(name, text)| Some((*name, Mapping::parse(name, text).ok()?)));
    all.filter(|(_, mapping)| mapping.files.iter().any(|entry| entry.topic.is_some()))
}

/// The mapping file of a case folder, if it has one.
pub fn own(folder: Option<&Path>) -> Option<PathBuf> {
    folder.map(|folder| folder.join("mapping.toml")).filter(|file| file.is_file())
}

/// The same for a case folder: what it holds as `mapping.toml` goes before what is built in.
///
/// # Errors
/// As [`named_or_built_in`].
pub fn of_case(name: Option<&str>, folder: Option<&Path>, paths: &[PathBuf]) -> Result<Mapping> {
    match (name, own(folder)) {
        (None, Some(own)) => case_folder::mapping(&own.to_string_lossy()),
        _ => named_or_built_in(name, paths),
    }
}

/// The mapping that was named, else the built-in one for these recordings: self-describing columns for tables; for bags
/// one that fits the first of a path. What nobody has looked at is not used: a mapping is proposed by `lacuna check` only.
///
/// # Errors
/// A mapping that cannot be found or parsed, and bags that no built-in mapping fits, with the commands that help.
pub fn named_or_built_in(name: Option<&str>, paths: &[PathBuf]) -> Result<Mapping> {
    if let Some(name) = name {
        return case_folder::mapping(name);
    }
    let mut seen = None;
    if let (bags, false) = bags_and_tables(paths)?
        && !bags.is_empty()
    {
        for path in paths {
            let Some(bag) = self::bags(std::slice::from_ref(path))?.into_iter().next() else { continue };
            let (shown, contents) = look(&bag)?;
            if let Some((_, mapping)) = built_in_for_bags().find(|(_, mapping)| fits(mapping, &contents)) {
                return Ok(mapping);
            }
            seen.get_or_insert((shown, contents));
        }
    }
    match seen {
        None => case_folder::mapping(SELF_DESCRIBING),
        Some((bag, contents)) => bail!("{}", refusal(&bag, &contents)),
    }
}

/// What to do with a bag that no built-in mapping fits.
fn refusal(bag: &str, contents: &Contents) -> String {
    let known: Vec<&str> = built_in_for_bags().map(|(name, _)| name).collect();
    let file = in_shell(bag);
    let problem = format!(
        "'{bag}' is a bag that no built-in mapping fits ({}), and without a mapping nobody knows which field is which signal",
        known.join(", ")
    );
    if propose::mapping("my-robot", contents).is_some() {
        format!(
            "{problem}; have one proposed with `lacuna check {file} --write-mapping my-robot.toml`, look through what was \
             inferred in it, then run this again with --mapping my-robot.toml"
        )
    } else {
        format!(
            "{problem}; none can be proposed, since no topic has wheel joints, an inertial unit or a pose: list the fields \
             with `lacuna check {file} --fields`, write a mapping by hand (docs/recordings.md says how) and name it with \
             --mapping"
        )
    }
}

/// A file name as a shell takes it.
fn in_shell(name: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/._-+:,@\\".contains(c);
    if name.chars().all(plain) { name.to_owned() } else { format!("'{}'", name.replace('\'', r"'\''")) }
}
