//! Which mapping reads the recordings, and what a survey by it finds.
//!
//! A mapping of bags is chosen by their beginnings, so that one pass tells what is inside and measures the channels.
//! Where the whole shows that another one is to be taken, there is a second pass.

use std::path::Path;

use anyhow::{Result, ensure};
use recordings::{BUILT_IN_MAPPINGS, Contents, Mapping, TableContents};

use super::{Listener, Request, Used, tables};
use crate::case_folder;
use crate::inputs::{self, Surveyed};
use crate::propose::{self, Proposal};
use crate::which_mapping::{self, Glance};

/// All that was found in the recordings.
pub(super) struct Discovery {
    pub(super) mapping: Used,
    pub(super) surveyed: Surveyed,
    /// Tables that no mapping fits.
    pub(super) tables: Vec<(String, TableContents)>,
}

/// Bags and what is inside, before anybody has said what it means.
pub(super) type Bags = Vec<(String, Contents)>;

/// Looks into bags and measures what a mapping reads of all recordings.
pub(super) fn find(request: &Request<'_>, listener: &Listener<'_>) -> Result<(Bags, Discovery)> {
    let mut glances = Vec::new();
    for path in which_mapping::bags(request.paths)? {
        (listener.stage)(&path.display().to_string());
        glances.push(which_mapping::glance(&path)?);
    }
    (listener.stage)("channels");
    let first = Candidates::of(request, glances.iter().map(|glance| (glance.bag.as_str(), &glance.contents)))?;
    let mut found = first.try_all(request, listener)?;
    let passed = found.surveyed.surveys.iter_mut().flat_map(|survey| std::mem::take(&mut survey.contents));
    let bags = whole(glances, passed.collect())?;
    let right = Candidates::of(request, bags.iter().map(|(bag, contents)| (bag.as_str(), contents)))?;
    if right.are_same(&first) {
        found.mapping = right.told_of(found.mapping);
    } else {
        (listener.stage)("channels, by another mapping");
        found = right.try_all(request, listener)?;
    }
    Ok((bags, found))
}

/// What is inside whole bags: of those that nobody passed over yet, after a pass.
fn whole(glances: Vec<Glance>, mut passed: Bags) -> Result<Bags> {
    let mut bags = Vec::new();
    for Glance { bag, contents, is_whole } in glances {
        bags.push(match passed.iter().position(|(name, _)| *name == bag) {
            Some(index) => passed.swap_remove(index),
            None if is_whole => (bag, contents),
            None => which_mapping::look(Path::new(&bag))?,
        });
    }
    Ok(bags)
}

/// The mappings that come into question, in the order in which they are tried.
struct Candidates {
    /// The only one, where the user named one.
    named: Option<(String, Mapping)>,
    built_in: Vec<(&'static str, Mapping)>,
    /// The one proposed for a bag, with the bag's name.
    proposed: Option<(String, Proposal)>,
    /// There is no bag.
    tables_only: bool,
}

impl Candidates {
    fn of<'c>(request: &Request<'_>, bags: impl Iterator<Item = (&'c str, &'c Contents)> + Clone) -> Result<Self> {
        let tables_only = bags.clone().next().is_none();
        if let Some(name) = request.mapping {
            let named = Some((name.to_owned(), case_folder::mapping(name)?));
            return Ok(Self { named, built_in: Vec::new(), proposed: None, tables_only });
        }
        let mut built_in = Vec::new();
        for (name, _) in BUILT_IN_MAPPINGS {
            let mapping = case_folder::mapping(name)?;
            let reads_bags = mapping.files.iter().any(|entry| entry.topic.is_some());
            let reads_tables = mapping.files.iter().any(|entry| entry.topic.is_none());
            let fits = || bags.clone().any(|(_, contents)| which_mapping::fits(&mapping, contents));
            let comes_into_question = if tables_only { reads_tables } else { !reads_bags || fits() };
            if comes_into_question {
                built_in.push((*name, mapping));
            }
        }
        let proposed = bags
            .map(|(bag, contents)| Some((bag.to_owned(), propose::mapping("proposed", contents)?)))
            .find_map(|proposed| proposed);
        Ok(Self { named: None, built_in, proposed, tables_only })
    }

    /// Whether the same mappings come into question, and the same one is proposed: nominal rates aside, of which the
    /// beginning of a bag knows little and which no measurement uses.
    fn are_same(&self, other: &Self) -> bool {
        let names = |candidates: &Self| candidates.built_in.iter().map(|(name, _)| *name).collect::<Vec<_>>();
        let reading = |candidates: &Self| {
            let (bag, proposal) = candidates.proposed.as_ref()?;
            let mut mapping = Mapping::parse("proposed", &proposal.toml).ok()?;
            mapping.files.iter_mut().for_each(|file| file.time.rate_hz = None);
            Some((bag.clone(), mapping))
        };
        names(self) == names(other) && reading(self) == reading(other)
    }

    /// The mapping that was used, with what is inferred by these candidates.
    fn told_of(self, used: Used) -> Used {
        match (used, self.proposed) {
            (Used::Proposed { .. }, Some((bag, proposal))) => Used::Proposed { bag, inferred: proposal.inferred },
            (used, _) => used,
        }
    }

    /// The recordings by the mapping that was named, else by the first built-in one that fits all, else by the one that
    /// is proposed.
    fn try_all(&self, request: &Request<'_>, listener: &Listener<'_>) -> Result<Discovery> {
        let survey = |mapping: &Mapping| inputs::survey(mapping, request.paths, &request.options, listener.bytes);
        let found = |mapping, surveyed| Ok(Discovery { mapping, surveyed, tables: Vec::new() });
        if let Some((name, mapping)) = &self.named {
            return found(Used::Named(name.clone()), survey(mapping)?);
        }
        let (mut failures, mut broken) = (Vec::new(), false);
        for (name, mapping) in &self.built_in {
            match survey(mapping) {
                Ok(surveyed) if surveyed.unmatched.is_empty() => {
                    return found(Used::BuiltIn((*name).to_owned()), surveyed);
                }
                Ok(_) => {}
                Err(error) => {
                    broken |= !tables::is_another_ones(&error);
                    failures.push(format!("{name}: {error:#}"));
                }
            }
        }
        if self.tables_only {
            // A table that has the right columns and is broken is no unknown table.
            let tables = if broken { Vec::new() } else { tables::look(request.paths)? };
            ensure!(
                !tables.is_empty(),
                "no built-in mapping fits; name one with --mapping\n  {}",
                failures.join("\n  ")
            );
            return Ok(Discovery { mapping: Used::Nothing(None), surveyed: Surveyed::default(), tables });
        }
        let Some((bag, Proposal { toml, inferred })) = &self.proposed else {
            return found(Used::Nothing(None), Surveyed::default());
        };
        match Mapping::parse("proposed", toml).map_err(Into::into).and_then(|mapping| survey(&mapping)) {
            Ok(surveyed) => found(Used::Proposed { bag: bag.clone(), inferred: inferred.clone() }, surveyed),
            Err(error) => {
                let why = format!("a mapping proposed for {bag} does not read the recordings: {error:#}");
                found(Used::Nothing(Some(why)), Surveyed::default())
            }
        }
    }
}
