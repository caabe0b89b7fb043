//! Which column of which file is which signal, in which unit and with which sign.

use bags::Format;

use crate::channel::Attributes;
use crate::signal::Signal;
use crate::units::Scale;

/// How the files of one kind of run become signals. Made by [`Mapping::parse`] or [`Mapping::built_in`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Mapping {
    /// The mapping's name.
    pub name: String,
    /// The kinds of files of a run; each has a clock of its own.
    pub files: Vec<FileMapping>,
}

/// One kind of file of a run.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FileMapping {
    /// File name with one `*` in the place of the run's id: `imu_*.csv`; a choice of endings stands in braces:
    /// `*.{mcap,db3}`.
    pub pattern: String,
    /// The topic of a bag whose messages are the rows; `None` for CSV and Parquet.
    pub topic: Option<String>,
    /// Attributes, source columns and clocks are what the file says, where it does; and each file is a run by itself, so
    /// that the entries are alternatives.
    pub self_describing: bool,
    /// Name of the clock, where the mapping says that it is one of its own or shared with other topics.
    pub clock: Option<String>,
    /// What stands between fields of CSV.
    pub delimiter: u8,
    /// Numbers in CSV have a decimal comma.
    pub decimal_comma: bool,
    /// When a row was taken.
    pub time: TimeMapping,
    /// The signals in the file, in the order of [`Signal::ALL`].
    pub columns: Vec<ColumnMapping>,
}

/// When a row was taken.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct TimeMapping {
    /// The column with the stamp; without one, a row's time is its number times the period.
    pub column: Option<String>,
    /// Nanoseconds in one unit of the column.
    pub ns_per_unit: i64,
    /// Rows per second, as declared.
    pub rate_hz: Option<f64>,
}

/// One column that is a signal.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ColumnMapping {
    /// What it measures.
    pub signal: Signal,
    /// Its name in the header, or the field's path in a message: `angular_velocity.z`, `velocity[wheel_left_joint]`.
    pub column: String,
    /// Its unit as the mapping says it.
    pub unit: Scale,
    /// Number in SI = factor * number as written: unit, sign and scale together.
    pub factor: f64,
    /// True when a file without the column is as good.
    pub optional: bool,
    /// What the recording shall say about it; the dead band is in SI.
    pub attributes: Attributes,
}

impl Mapping {
    /// All patterns, for messages.
    pub(crate) fn patterns(&self) -> String {
        let mut patterns: Vec<&str> = Vec::new();
        for file in &self.files {
            if !patterns.contains(&file.pattern.as_str()) {
                patterns.push(&file.pattern);
            }
        }
        patterns.join(", ")
    }

    /// True for the first entry with its pattern; later ones read other topics of the same files.
    pub(crate) fn leads(&self, entry: usize) -> bool {
        self.files[..entry].iter().all(|file| file.pattern != self.files[entry].pattern)
    }

    /// True when each file is a run by itself.
    pub(crate) fn alternatives(&self) -> bool {
        self.files.iter().any(|file| file.self_describing)
    }

    /// The first entry that a file name fits, and the run's id in it.
    pub(crate) fn entry_of<'n>(&self, file: &'n str) -> Option<(usize, &'n str)> {
        self.files.iter().enumerate().find_map(|(index, entry)| Some((index, entry.whole_run_id(file)?)))
    }
}

impl FileMapping {
    /// What stands in the place of `*` in a file name (folders do not matter); `None` when it does not fit.
    ///
    /// ```
    /// # use recordings::Mapping;
    /// let husky = Mapping::built_in("husky-open")?;
    /// assert_eq!(husky.files[1].run_id("FLOORING/imu_04.csv"), Some("04"));
    /// assert_eq!(husky.files[1].run_id("FLOORING/pro_04.csv"), None);
    /// # Ok::<(), recordings::RecordingError>(())
    /// ```
    pub fn run_id<'n>(&self, file: &'n str) -> Option<&'n str> {
        run_id(&self.pattern, file)
    }

    /// The run's id of a file that may be one part of a bag: in a folder `walk`, `walk_0.mcap` and `walk_1.mcap` are
    /// parts of one run, as rosbag2 splits them.
    pub(crate) fn whole_run_id<'n>(&self, file: &'n str) -> Option<&'n str> {
        let id = self.run_id(file)?;
        let folder = base_name(file[..file.len() - base_name(file).len()].trim_end_matches(['/', '\\']));
        let prefix = self.pattern.split_once('*')?.0;
        let is_part = |number: &str| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
        let whole =
            id.rsplit_once('_').filter(|(whole, number)| is_part(number) && folder == format!("{prefix}{whole}"));
        Some(whole.filter(|_| self.topic.is_some() && !self.self_describing).map_or(id, |(whole, _)| whole))
    }

    /// The file name for a run.
    pub(crate) fn file_of(&self, run_id: &str) -> String {
        self.pattern.replacen('*', run_id, 1)
    }
}

/// What stands in the place of `*` of a pattern.
fn run_id<'n>(pattern: &str, file: &'n str) -> Option<&'n str> {
    let (prefix, suffix) = pattern.split_once('*')?;
    let rest = base_name(file).strip_prefix(prefix)?;
    let cut = |suffix: &str| rest.strip_suffix(suffix).filter(|id| !id.is_empty());
    let Some((before, choice)) = suffix.strip_suffix('}').and_then(|suffix| suffix.split_once('{')) else {
        return cut(suffix);
    };
    // The longest ending that fits leaves the shortest id.
    choice.split(',').filter_map(|ending| cut(&format!("{before}{ending}"))).min_by_key(|id| id.len())
}

/// Whether a file's name is that of a bag, in any storage of rosbag2, folders aside.
///
/// ```
/// assert!(recordings::is_bag("walk/walk_0.mcap") && recordings::is_bag("walk_0.db3.zstd"));
/// assert!(!recordings::is_bag("walk/metadata.yaml"));
/// ```
pub fn is_bag(file: &str) -> bool {
    run_id(&Format::bag_pattern(), file).is_some()
}

/// The part of a path after the last slash of either kind.
pub(crate) fn base_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}
