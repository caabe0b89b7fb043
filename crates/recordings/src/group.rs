//! Which files make up which run: a pure function of their names.

use std::collections::BTreeMap;

use bags::Format;

use crate::mapping::{FileMapping, Mapping, TimeMapping, base_name};

/// The files of one run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// The run's id: what stood for `*`, after the folder where there is one.
    pub run: String,
    /// The files that are there, in the order of the mapping's entries.
    pub files: Vec<GroupFile>,
    /// Names of the files that the mapping expects and that are not there.
    pub missing: Vec<String>,
}

/// One file of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GroupFile {
    /// Index into [`Mapping::files`], of the first where several read topics of the same file.
    pub entry: usize,
    /// The name as it was given.
    pub name: String,
}

/// File names sorted into runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grouping {
    /// The runs, by folder and id; numbers in ids count as numbers (`run_2` before `run_10`).
    pub groups: Vec<Group>,
    /// Names that fit no pattern (or were given twice), in the order given.
    pub unmatched: Vec<String>,
}

/// Folder, id, and the entry where each file is a run by itself.
type RunKey<'a> = (&'a str, Vec<Part<'a>>, usize);

impl Mapping {
    /// Sorts file names (or paths) into runs. A name belongs to the first entry whose pattern it fits.
    ///
    /// ```
    /// # use recordings::Mapping;
    /// let husky = Mapping::built_in("husky-open")?;
    /// let sorted = husky.group(&["pro_01.csv", "imu_01.csv", "pro_04.csv", "notes.txt"]);
    /// assert_eq!(sorted.groups[0].run, "01");
    /// assert_eq!(sorted.groups[1].missing, ["imu_04.csv"]);
    /// assert_eq!(sorted.unmatched, ["notes.txt"]);
    /// # Ok::<(), recordings::RecordingError>(())
    /// ```
    pub fn group<S: AsRef<str>>(&self, names: &[S]) -> Grouping {
        // Where each file is a run by itself, its entry tells runs of one name apart.
        let alternatives = self.alternatives();
        let mut runs: BTreeMap<RunKey<'_>, Vec<Vec<&str>>> = BTreeMap::new();
        let mut unmatched = Vec::new();
        for name in names.iter().map(AsRef::as_ref) {
            let Some((entry, id)) = self.entry_of(name) else {
                unmatched.push(name.to_owned());
                continue;
            };
            let folder = &name[..name.len() - base_name(name).len()];
            let format = if alternatives { entry } else { 0 };
            let files = runs.entry((folder, parts(id), format)).or_insert_with(|| vec![Vec::new(); self.files.len()]);
            // A bag may have several parts, everything else one file.
            if files[entry].contains(&name) || (self.files[entry].topic.is_none() && !files[entry].is_empty()) {
                unmatched.push(name.to_owned());
            } else {
                files[entry].push(name);
            }
        }
        let groups = runs.into_iter().map(|((folder, id, _), mut files)| {
            let id: String = id.iter().map(|part| part.text).collect();
            let absent = |entry: &usize| files[*entry].is_empty() && self.leads(*entry) && !alternatives;
            let missing: Vec<usize> = (0..files.len()).filter(absent).collect();
            for files in &mut files {
                files.sort_by_key(|name| parts(name));
            }
            let there = files.iter().enumerate().flat_map(|(entry, files)| files.iter().map(move |name| (entry, name)));
            Group {
                run: format!("{folder}{id}"),
                missing: missing.iter().map(|&entry| format!("{folder}{}", self.files[entry].file_of(&id))).collect(),
                files: there.map(|(entry, name)| GroupFile { entry, name: (*name).to_owned() }).collect(),
            }
        });
        Grouping { groups: groups.collect(), unmatched }
    }
}

/// Sorts bags into runs whatever is in them: parts of a split one are one run. What is no bag is unmatched.
///
/// ```
/// let sorted = recordings::group_bags(&["walk/walk_1.mcap", "walk/walk_0.mcap", "run.db3", "run.csv"]);
/// let runs: Vec<(&str, usize)> = sorted.groups.iter().map(|group| (&*group.run, group.files.len())).collect();
/// assert_eq!(runs, [("run", 1), ("walk/walk", 2)]);
/// assert_eq!(sorted.unmatched, ["run.csv"]);
/// ```
pub fn group_bags<S: AsRef<str>>(names: &[S]) -> Grouping {
    let any = FileMapping {
        pattern: Format::bag_pattern(),
        topic: Some(String::new()),
        self_describing: false,
        clock: None,
        delimiter: b',',
        decimal_comma: false,
        time: TimeMapping { column: None, ns_per_unit: 1, rate_hz: None },
        columns: Vec::new(),
    };
    Mapping { name: String::new(), files: vec![any] }.group(names)
}

/// A stretch of digits or of anything else; digits compare as numbers (by length without leading zeros, then by text).
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Part<'a> {
    rank: (bool, usize, &'a str),
    text: &'a str,
}

/// The id in parts that compare as people count.
pub(crate) fn parts(id: &str) -> Vec<Part<'_>> {
    id.as_bytes()
        .chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit())
        .scan(0, |start, chunk| {
            let text = &id[*start..*start + chunk.len()];
            *start += chunk.len();
            let plain = text.trim_start_matches('0');
            let digits = chunk[0].is_ascii_digit();
            Some(Part { rank: if digits { (false, plain.len(), plain) } else { (true, 0, text) }, text })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_sorted_as_people_count_and_kept_apart_by_folder() {
        let mapping = Mapping::built_in("skid-steer-columns").unwrap();
        let names = ["b/run_10.csv", "b/run_2.csv", "a/run_2.csv", "b/run_02.csv", "b/robot.json", "a/run_2.csv"];
        let sorted = mapping.group(&names);
        let runs: Vec<&str> = sorted.groups.iter().map(|group| group.run.as_str()).collect();
        assert_eq!(runs, ["a/run_2", "b/run_02", "b/run_2", "b/run_10"]);
        assert_eq!(sorted.unmatched, ["b/robot.json", "a/run_2.csv"]);
    }

    #[test]
    fn parts_of_a_split_bag_are_one_run() {
        let text = "[[files]]\ntopic = \"/imu\"\ntime = { column = \"log_time\" }\n\
                    signals.gyro_z = { column = \"z\", unit = \"rad/s\" }";
        let mapping = Mapping::parse("m.toml", text).unwrap();
        let names =
            ["x/walk/walk_10.mcap", "x/walk/walk_2.mcap", "x/walk/metadata.yaml", "x/run_1.db3", "x/run_2.db3.zstd"];
        let sorted = mapping.group(&names);
        let runs: Vec<(&str, usize)> = sorted.groups.iter().map(|group| (&*group.run, group.files.len())).collect();
        assert_eq!(runs, [("x/run_1", 1), ("x/run_2", 1), ("x/walk/walk", 2)]);
        assert_eq!(sorted.groups[2].files[0].name, "x/walk/walk_2.mcap");
        assert_eq!(sorted.unmatched, ["x/walk/metadata.yaml"]);
    }

    #[test]
    fn a_missing_file_is_named_with_its_folder() {
        let mapping = Mapping::built_in("husky-open").unwrap();
        let sorted = mapping.group(&["FLOORING/pro_04.csv", "FLOORING/imu_01.csv", "FLOORING/pro_01.csv"]);
        assert_eq!(sorted.groups[0].run, "FLOORING/01");
        let names: Vec<&str> = sorted.groups[0].files.iter().map(|file| file.name.as_str()).collect();
        assert_eq!(names, ["FLOORING/pro_01.csv", "FLOORING/imu_01.csv"]);
        assert!(sorted.groups[0].missing.is_empty());
        assert_eq!(sorted.groups[1].missing, ["FLOORING/imu_04.csv"]);
    }
}
