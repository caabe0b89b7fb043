//! The one list of formats that recordings come in.

use crate::source::ZSTD_MAGIC;

/// Endings of files that are compressed with zstd as a whole, behind the ending of their format.
const ZSTD: [&str; 2] = [".zstd", ".zst"];

/// A format of recorded files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// MCAP: messages in chunks with checksums.
    Mcap,
    /// rosbag2's sqlite3.
    Sqlite,
    /// Parquet tables.
    Parquet,
    /// Tables as text.
    Csv,
}

/// What is known of a format; what reads it is the exhaustive `match` of its kind of reader.
struct Row {
    format: Format,
    /// How its files begin; empty where nothing tells.
    magic: &'static [u8],
    /// How their names end, in small letters; the first one is the usual one.
    endings: &'static [&'static str],
    /// Holds messages of topics; otherwise it is one table.
    is_bag: bool,
}

const FORMATS: [Row; 4] = [
    Row { format: Format::Mcap, magic: mcap::MAGIC, endings: &[".mcap"], is_bag: true },
    Row { format: Format::Sqlite, magic: b"SQLite format 3\0", endings: &[".db3"], is_bag: true },
    Row { format: Format::Parquet, magic: b"PAR1", endings: &[".parquet"], is_bag: false },
    Row { format: Format::Csv, magic: b"", endings: &[".csv", ".tsv", NOTE], is_bag: false },
];

/// What the beginning and the name of a file tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stored {
    /// The format as it is.
    As(Format),
    /// Compressed with zstd as a whole: what is inside shows when it is unpacked.
    Compressed,
}

impl Stored {
    /// By the first bytes, and by the name where these are damaged; text where neither says anything.
    pub fn of(name: &str, head: &[u8]) -> Self {
        let begins = |row: &&Row| !row.magic.is_empty() && head.starts_with(row.magic);
        if let Some(row) = FORMATS.iter().find(begins) {
            return Self::As(row.format);
        }
        if head.starts_with(ZSTD_MAGIC) {
            return Self::Compressed;
        }
        match Format::of_name(name) {
            Some(format) => Self::As(format),
            None if ZSTD.iter().any(|end| name.to_ascii_lowercase().ends_with(end)) => Self::Compressed,
            None => Self::As(Format::Csv),
        }
    }
}

/// The ending of tables that notes have, too.
const NOTE: &str = ".txt";

/// What is before an ending, in letters of either size.
fn before<'a>(name: &'a str, ending: &str) -> Option<&'a str> {
    let (stem, end) = name.split_at_checked(name.len().checked_sub(ending.len())?)?;
    end.eq_ignore_ascii_case(ending).then_some(stem)
}

impl Format {
    /// The format that the ending of a name means.
    ///
    /// ```
    /// use bags::Format;
    /// assert_eq!(Format::of_name("walk/Walk_0.MCAP"), Some(Format::Mcap));
    /// assert_eq!(Format::of_name("metadata.yaml"), None);
    /// ```
    pub fn of_name(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        let ends = |row: &&Row| row.endings.iter().any(|end| name.ends_with(end));
        FORMATS.iter().find(ends).map(|row| row.format)
    }

    /// The name of a table without its endings, that of compression too; `None` of what is called like no table. Text that is called
    /// `.txt` lies beside recordings as a note more often than as a table, and is none by its name alone.
    ///
    /// ```
    /// use bags::Format;
    /// assert_eq!(Format::stem_of_table("run_1.CSV.zst"), Some("run_1"));
    /// assert_eq!(Format::stem_of_table("drive.parquet"), Some("drive"));
    /// assert_eq!([Format::stem_of_table("notes.txt"), Format::stem_of_table("run.mcap")], [None, None]);
    /// ```
    pub fn stem_of_table(name: &str) -> Option<&str> {
        let plain = ZSTD.iter().find_map(|end| before(name, end)).unwrap_or(name);
        let mut endings = FORMATS.iter().filter(|row| !row.is_bag).flat_map(|row| row.endings);
        endings.find_map(|end| before(plain, end).filter(|_| *end != NOTE))
    }

    /// Whether its files hold messages of topics; otherwise each is one table.
    pub fn is_bag(self) -> bool {
        FORMATS.iter().any(|row| row.format == self && row.is_bag)
    }

    /// The pattern of names of bags, plain and compressed.
    ///
    /// ```
    /// assert_eq!(bags::Format::bag_pattern(), "*.{mcap,db3,mcap.zstd,db3.zstd}");
    /// ```
    pub fn bag_pattern() -> String {
        let endings = || FORMATS.iter().filter(|row| row.is_bag).flat_map(|row| row.endings);
        let plain = endings().map(|end| end[1..].to_owned());
        let compressed = endings().map(|end| format!("{}{}", &end[1..], ZSTD[0]));
        format!("*.{{{}}}", plain.chain(compressed).collect::<Vec<_>>().join(","))
    }
}
