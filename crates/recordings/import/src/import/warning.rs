//! Warnings of an import: valid maps with an improbable meaning.

use std::fmt;

/// Warning of an import with a stable code.
///
/// ```
/// use taceva_import::ImportWarning;
///
/// let warning = ImportWarning::ZoneUnstated { column: "stamp".to_owned() };
/// assert_eq!(warning.code(), "zone-unstated");
/// assert!(warning.to_string().contains("`zone = "));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum ImportWarning {
    /// Several channels are read from one column, with the same sign and scale.
    ColumnTwice {
        /// Column as the map names it.
        column: String,
        /// Names of the channels.
        channels: Vec<String>,
    },
    /// Numbers of a column look like integers with points between groups of three digits.
    GroupedDigits {
        /// Column as the map names it.
        column: String,
        /// Example cell.
        example: String,
        /// Number of cells with such a point.
        cells: u64,
    },
    /// Text times have no time zone, and the map states none for a clock that counts from 1970.
    ZoneUnstated {
        /// Column as the map names it.
        column: String,
    },
    /// Times of day cross midnight; later rows are assigned to the next day.
    Midnight {
        /// Column as the map names it.
        column: String,
        /// Number of midnights.
        days: u64,
    },
    /// Zero rows spread so widely that contacts may be among them.
    ZeroSpread {
        /// Name of the channel.
        channel: String,
        /// Rule of the map, in words.
        rule: String,
    },
    /// Only the complete messages before the cut of a recording are read.
    CutRecording {
        /// File, relative to the folder of the lab.
        file: String,
        /// Number of messages before the cut, of all topics.
        messages: u64,
        /// End of the complete records, byte.
        end: u64,
    },
    /// Most rows on both sides of a join by time match none of the other side.
    JoinApart {
        /// Name of the join.
        join: String,
        /// Number of rows of the main table without a match.
        unmatched: u64,
        /// Number of rows of the joined table that no row uses.
        unused: u64,
    },
    /// The map names neither pictures nor signals, and the folder has pictures.
    NoPictures {
        /// Number of pictures in the folder.
        pictures: u64,
        /// First of them, relative to the folder.
        first: String,
    },
}

impl ImportWarning {
    /// Stable code for scripts: `column-twice`, `grouped-digits`, `zone-unstated`, `midnight`, `zero-spread`, `cut-recording`,
    /// `join-apart` or `no-pictures`.
    pub fn code(&self) -> &'static str {
        match self {
            ImportWarning::ColumnTwice { .. } => "column-twice",
            ImportWarning::GroupedDigits { .. } => "grouped-digits",
            ImportWarning::ZoneUnstated { .. } => "zone-unstated",
            ImportWarning::Midnight { .. } => "midnight",
            ImportWarning::ZeroSpread { .. } => "zero-spread",
            ImportWarning::CutRecording { .. } => "cut-recording",
            ImportWarning::JoinApart { .. } => "join-apart",
            ImportWarning::NoPictures { .. } => "no-pictures",
        }
    }
}

impl fmt::Display for ImportWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.code())?;
        match self {
            ImportWarning::ColumnTwice { column, channels } => write!(
                f,
                "`{}` is read as {}: correct `from` of all but one, or delete the others",
                taceva_core::shown(column),
                channels.join(" and ")
            ),
            ImportWarning::GroupedDigits {
                column,
                example,
                cells,
            } => write!(
                f,
                "`{}` has three digits after each point in {cells} cells, such as `{example}`, and no whole number above 999: write \
                 `thousands = \".\"` in the \
                 table of the map if points group digits, `thousands = \"\"` if not",
                taceva_core::shown(column)
            ),
            ImportWarning::ZoneUnstated { column } => write!(
                f,
                "`{}` states no time zone, so its times are not converted to UTC; state the offset of its clock from UTC by `zone = \
                 \"+00:00\"` in [time]",
                taceva_core::shown(column)
            ),
            ImportWarning::Midnight { column, days } => write!(
                f,
                "`{}` holds times of day that pass midnight {}: later rows are read as times of the next day",
                taceva_core::shown(column),
                taceva_core::counted(*days, "time")
            ),
            ImportWarning::ZeroSpread { channel, rule } => write!(
                f,
                "the rows taken for the zero of {channel} ({rule}) differ by more than a fifth of all its labels: contacts may be among them; correct `from` of [zero]"
            ),
            ImportWarning::CutRecording {
                file,
                messages,
                end,
            } => write!(
                f,
                "{} was cut or not closed: its {} before byte {end} {} read, and later ones are lost",
                taceva_core::shown(file),
                taceva_core::counted(*messages, "complete message"),
                taceva_core::by_count(*messages, "is", "are")
            ),
            ImportWarning::JoinApart {
                join,
                unmatched,
                unused,
            } => write!(
                f,
                "join `{}`: {unmatched} rows match none of its rows, and {unused} of its rows match none, so that the others may match by \
                 chance: compare the first and the last time of both tables, their units and `lag_ms`",
                taceva_core::shown(join)
            ),
            ImportWarning::NoPictures { pictures, first } => write!(
                f,
                "the map has no [frame], so no row has a picture; the folder has {pictures} pictures, such as {}: name them by `column` or \
                 `pattern` of [frame] and import again",
                taceva_core::shown(first)
            ),
        }
    }
}
