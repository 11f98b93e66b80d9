//! The columns of a table that an import reads.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::SourceUnit;

/// The column a channel comes from.
///
/// ```
/// use taceva_core::SourceUnit;
/// use taceva_import::ColumnMap;
///
/// let mut column = ColumnMap::new("force", SourceUnit::parse("mN")?);
/// column.is_negated = true;
/// assert_eq!(column.from, "force");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ColumnMap {
    /// The name of the column in the table, or the way to it: `ft[2]`, `/pose/0`, `JOIN.column`.
    pub from: String,
    /// The unit of its numbers.
    pub unit: SourceUnit,
    /// Whether its sign is inverted.
    pub is_negated: bool,
    /// What is subtracted from each cell first, in the unit of the cells.
    pub offset: Option<f64>,
    /// What the difference is then multiplied by.
    pub scale: Option<f64>,
}

impl ColumnMap {
    /// The column `from`, in `unit`, with its sign as it is.
    pub fn new(from: impl Into<String>, unit: SourceUnit) -> ColumnMap {
        ColumnMap {
            from: from.into(),
            unit,
            is_negated: false,
            offset: None,
            scale: None,
        }
    }

    /// Whether a cell is more than its number in its unit.
    pub(crate) fn is_moved(&self) -> bool {
        self.offset.is_some() || self.scale.is_some()
    }
}

/// The columns of the ids.
///
/// ```
/// use taceva_import::IdMap;
///
/// let mut ids = IdMap::default();
/// ids.point_id = vec!["x".into(), "y".into()];
/// assert_eq!(ids.sample, None);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[non_exhaustive]
#[serde(deny_unknown_fields, default)]
pub struct IdMap {
    /// The name of a sample; absent: the number of its row, from 0.
    pub sample: Option<String>,
    /// The contact point; several columns are joined with `:`, where a `:` or `\` within a cell stands behind a `\`.
    #[serde(deserialize_with = "one_or_more")]
    pub point_id: Vec<String>,
    /// Which unit of the sensor it is, of several of one model.
    pub unit_id: Option<String>,
    /// The scene of the lighting, or whatever else of the surroundings was varied.
    pub scene: Option<String>,
    /// The level of depth within a press, a whole number from 0.
    pub depth_step: Option<String>,
    /// The number of the repeat of one contact, a whole number from 0.
    pub repeat: Option<String>,
    /// Whether the press deepens or lifts: cells are `load` or `unload`.
    pub phase: Option<String>,
    /// The limit of the gel that ended a press: `normal-force` and the like.
    pub limited_by: Option<String>,
    /// The part of a declared split.
    pub part: Option<String>,
    /// The relief of a grating: `line` or `dot`.
    pub kind: Option<String>,
    /// The spacing of a grating, in mm as decimal text.
    pub spacing_mm: Option<String>,
}

/// The columns that say where rows first came from. A map that has them is of a table that was exported: what they say stands in the place of
/// where the rows lie now, and what they do not say is not known.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct OriginMap {
    /// The table of the lab.
    pub(crate) table: Option<String>,
    /// The row in it, from 0.
    pub(crate) row: Option<String>,
    /// The picture.
    pub(crate) frame: Option<String>,
    /// The picture of each view, where rows have several.
    pub(crate) frames: BTreeMap<String, String>,
}

impl OriginMap {
    /// The columns that it names.
    pub(crate) fn columns(&self) -> impl Iterator<Item = &String> {
        let own = [&self.table, &self.row, &self.frame].into_iter().flatten();
        own.chain(self.frames.values())
    }
}

/// The column of the time.
///
/// ```
/// use taceva_core::SourceUnit;
/// use taceva_import::TimeMap;
///
/// let time = TimeMap::new("t", SourceUnit::parse("ms")?);
/// assert_eq!(time.column, "t");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct TimeMap {
    /// The name of the column in the table.
    pub column: String,
    /// The unit of its numbers.
    pub unit: SourceUnit,
    /// Seconds that the clock of times as text is before UTC, where they say no time zone.
    pub zone_s: Option<i64>,
}

impl TimeMap {
    /// The column `column`, in `unit`.
    pub fn new(column: impl Into<String>, unit: SourceUnit) -> TimeMap {
        TimeMap {
            column: column.into(),
            unit,
            zone_s: None,
        }
    }
}

fn one_or_more<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<Vec<String>, D::Error> {
    struct Names;

    impl<'de> serde::de::Visitor<'de> for Names {
        type Value = Vec<String>;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.write_str("a column or a list of columns")
        }
        fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Vec<String>, E> {
            Ok(vec![name.to_owned()])
        }
        fn visit_seq<A: serde::de::SeqAccess<'de>>(
            self,
            mut names: A,
        ) -> Result<Vec<String>, A::Error> {
            let mut list = Vec::new();
            while let Some(name) = names.next_element()? {
                list.push(name);
            }
            Ok(list)
        }
    }

    deserializer.deserialize_any(Names)
}
