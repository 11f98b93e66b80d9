//! Warnings of an import, for valid maps with an improbable meaning.

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
    /// A column contains numbers that look like integers with points between groups of three digits.
    GroupedDigits {
        /// Column as the map names it.
        column: String,
        /// Example cell.
        example: String,
        /// Number of cells with three digits after a point.
        cells: u64,
    },
    /// Text times have no time zone, and the map states no time zone for a clock that counts from 1970.
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
    /// Rows declared as zero spread so widely that contacts may be among them.
    ZeroSpread {
        /// Name of the channel.
        channel: String,
        /// Rule of the map that selects the rows at zero force, in words.
        rule: String,
    },
    /// Rows of a table that is joined by time share their times with other rows.
    RepeatedStamps {
        /// Name of the join in the map.
        join: String,
        /// Number of rows of the joined table that have a time.
        rows: u64,
        /// Number of different times in the joined table. The join uses the first row of each time.
        times: u64,
    },
    /// Only the complete messages of a truncated recording are read.
    CutRecording {
        /// File, relative to the lab's folder.
        file: String,
        /// Number of complete messages of all topics.
        messages: u64,
        /// Offset of the end of the complete records, bytes.
        end: u64,
    },
    /// The map names neither pictures nor signals, and the folder has pictures.
    NoPictures {
        /// Number of pictures in the folder.
        pictures: u64,
        /// First picture, relative to the folder.
        first: String,
    },
    /// Rows of the main table are matched with rows of a joined table across a pause.
    JoinPause {
        /// Name of the join.
        join: String,
        /// Number of rows of the main table that are matched across a pause.
        rows: u64,
        /// Maximum time difference of a match, ms.
        farthest_ms: String,
        /// Usual step between rows of the joined table, ms.
        usual_ms: String,
        /// Tolerance that would leave out the rows matched across a pause, ms.
        tolerance_ms: String,
    },
    /// A joined table has rows at the times of the main table if the lag of the map is ignored.
    JoinLag {
        /// Name of the join.
        join: String,
        /// Number of rows of the main table with a lag above 100 ms.
        rows: u64,
        /// Number of rows with a lag above 100 ms for which the joined table has a row at the same time.
        equal: u64,
    },
    /// Most rows of both tables have no match by time.
    JoinFew {
        /// Name of the join.
        join: String,
        /// Number of rows of the main table.
        rows: u64,
        /// Number of rows of the main table with a match.
        matched: u64,
        /// Spans of the times of both tables, in words.
        spans: String,
    },
    /// Times of single rows of a main table are out of order.
    TimeOrder {
        /// File and place of the first row out of order.
        at: String,
        /// Number of rows out of order.
        rows: u64,
    },
    /// A name in `frames_named` of `[drop]` excluded no row.
    DropUnmatched {
        /// Name of a picture.
        name: String,
    },
    /// Many rows of a taxel have the same number, far from all other numbers of this taxel. The map lists no placeholders.
    TaxelCode {
        /// First column with the number, as the map names it.
        column: String,
        /// Frequent number, as text.
        code: String,
    },
}

impl ImportWarning {
    /// Stable code for scripts, such as `column-twice` or `no-pictures`. The README of the crate lists them.
    pub fn code(&self) -> &'static str {
        match self {
            ImportWarning::ColumnTwice { .. } => "column-twice",
            ImportWarning::GroupedDigits { .. } => "grouped-digits",
            ImportWarning::ZoneUnstated { .. } => "zone-unstated",
            ImportWarning::Midnight { .. } => "midnight",
            ImportWarning::ZeroSpread { .. } => "zero-spread",
            ImportWarning::RepeatedStamps { .. } => "repeated-stamps",
            ImportWarning::CutRecording { .. } => "cut-recording",
            ImportWarning::NoPictures { .. } => "no-pictures",
            ImportWarning::JoinPause { .. } => "join-pause",
            ImportWarning::JoinLag { .. } => "join-lag",
            ImportWarning::JoinFew { .. } => "join-few",
            ImportWarning::TimeOrder { .. } => "time-order",
            ImportWarning::DropUnmatched { .. } => "drop-unmatched",
            ImportWarning::TaxelCode { .. } => "taxel-code",
        }
    }
}

impl fmt::Display for ImportWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.code())?;
        match self {
            ImportWarning::ColumnTwice { column, channels } => write!(
                f,
                "`{}` is read as {}: correct `from` of all but one channel, or delete the other channels",
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
            ImportWarning::RepeatedStamps { join, rows, times } => write!(
                f,
                "the {rows} rows of join `{}` have only {}, and the first row of each time is taken, so the true time between a row and its label is unknown. Join by a clock with fractions of a second, or by `on = \"row\"` if both tables were written in step",
                taceva_core::shown(join),
                taceva_core::counted(*times, "different time")
            ),
            ImportWarning::CutRecording {
                file,
                messages,
                end,
            } => write!(
                f,
                "{} was cut or not closed: its {} before byte {end} {} read, and later messages are lost",
                taceva_core::shown(file),
                taceva_core::counted(*messages, "complete message"),
                taceva_core::by_count(*messages, "is", "are")
            ),
            ImportWarning::NoPictures { pictures, first } => write!(
                f,
                "the map has no [frame], so no row has a picture. The folder has {pictures} pictures, such as {}: if they show these rows, name them by `column` or `pattern` of [frame] and import again",
                taceva_core::shown(first)
            ),
            ImportWarning::JoinPause {
                join,
                rows,
                farthest_ms,
                usual_ms,
                tolerance_ms,
            } => write!(
                f,
                "{} {} labels of `{}` from up to {farthest_ms} ms away, although its rows are usually {usual_ms} ms apart: the join bridges pauses of the table. Write `tolerance_ms = {tolerance_ms}` with `unmatched = \"drop\"` to leave these rows out, or `pick = \"before\"` if a row is valid until the next row",
                taceva_core::counted(*rows, "row"),
                taceva_core::by_count(*rows, "takes", "take"),
                taceva_core::shown(join)
            ),
            ImportWarning::JoinLag { join, rows, equal } => write!(
                f,
                "without `lag_ms`, `{}` has rows with the same time, to a microsecond, as {equal} of {}, so both have stamps of one clock. Write `lag_ms = 0`, unless the pictures are late by this lag",
                taceva_core::shown(join),
                taceva_core::counted(*rows, "row")
            ),
            ImportWarning::JoinFew {
                join,
                rows,
                matched,
                spans,
            } => write!(
                f,
                "`{}` matches {matched} of {}: {}. This is right if its times cover only a part of the rows. If not, compare `lag_ms`, `unit`, `start_s` and `tolerance_ms` with the clocks",
                taceva_core::shown(join),
                taceva_core::counted(*rows, "row"),
                taceva_core::shown(spans)
            ),
            ImportWarning::TimeOrder { at, rows } => write!(
                f,
                "the time of {} is before that of the row above, first at {}, and the next row is later than both. If stamps are swapped, correct them, because such rows are joined by a wrong time. Rows written in another order are joined correctly",
                taceva_core::counted(*rows, "row"),
                taceva_core::shown(at)
            ),
            ImportWarning::DropUnmatched { name } => write!(
                f,
                "`{}` in `frames_named` of [drop] left out no row: another rule left the row out already, or the table has another name. Write the name as in the table, or `clip.mp4#12` (from 0) for a picture in a clip or an array",
                taceva_core::shown(name)
            ),
            ImportWarning::TaxelCode { column, code } => write!(
                f,
                "`{}` is often {code}, far from all its other numbers: if this means \"nothing measured\", leave such rows out by \
                 `placeholders = [{code}]` in [signals]",
                taceva_core::shown(column)
            ),
        }
    }
}
