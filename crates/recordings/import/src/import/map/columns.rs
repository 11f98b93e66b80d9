//! Columns of a table that an import reads.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::SourceUnit;

/// Source column of a channel.
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
    /// Name of the column, or path to a value in it: `ft[2]`, `/pose/0`, `JOIN.column`.
    pub from: String,
    /// Unit of the cells.
    pub unit: SourceUnit,
    /// True if the sign is inverted.
    pub is_negated: bool,
    /// Offset subtracted from each cell first, in the unit of the cells.
    pub offset: Option<f64>,
    /// Factor applied after the offset; `None` for no factor.
    pub scale: Option<f64>,
}

impl ColumnMap {
    /// Column `from` in `unit`, without sign inversion, offset and scale.
    pub fn new(from: impl Into<String>, unit: SourceUnit) -> ColumnMap {
        ColumnMap {
            from: from.into(),
            unit,
            is_negated: false,
            offset: None,
            scale: None,
        }
    }

    /// True if an offset or a scale is set.
    pub(crate) fn is_moved(&self) -> bool {
        self.offset.is_some() || self.scale.is_some()
    }
}

/// Columns of the ids of samples, such as the contact point.
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
    /// Column of the sample name; `None` uses the row number, from 0.
    pub sample: Option<String>,
    /// Columns of the contact point, whose cells are joined with `:`. A `:` or `\` within a cell is escaped with `\`.
    #[serde(deserialize_with = "one_or_more")]
    pub point_id: Vec<String>,
    /// Column of the sensor unit, if a recording has several units of one model.
    pub unit_id: Option<String>,
    /// Column of the light scene, or of another varied condition.
    pub scene: Option<String>,
    /// Column of the depth level within a press, a whole number from 0.
    pub depth_step: Option<String>,
    /// Column of the number of the repeat of a contact, a whole number from 0.
    pub repeat: Option<String>,
    /// Column of the phase of the press, with the cells `load` and `unload`.
    pub phase: Option<String>,
    /// Column of the gel limit that ended a press, such as `normal-force`.
    pub limited_by: Option<String>,
    /// Column of the standard uncertainty of the height from which a depth is measured, mm.
    pub zero_u_mm: Option<String>,
    /// Column of the declared part of a split.
    pub part: Option<String>,
    /// Column of the relief of a grating, with the cells `line` and `dot`.
    pub kind: Option<String>,
    /// Column of the spacing of a grating, mm, as decimal text.
    pub spacing_mm: Option<String>,
}

impl IdMap {
    /// Keys of `[ids]`. The dataset table has columns with the same names.
    pub(crate) const KEYS: [&'static str; 12] = [
        "sample",
        "point_id",
        "unit_id",
        "scene",
        "depth_step",
        "repeat",
        "phase",
        "limited_by",
        "zero_u_mm",
        "part",
        "kind",
        "spacing_mm",
    ];
}

/// Columns with the origin of rows, in a table that TacEva exported. The origin replaces the current location of the rows. An empty cell means an unknown
/// origin.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct OriginMap {
    /// Column with the path of the original table.
    pub(crate) table: Option<String>,
    /// Column with the row number in the original table, from 0.
    pub(crate) row: Option<String>,
    /// Column with the path of the original picture.
    pub(crate) frame: Option<String>,
    /// Column with the path of the original picture, for each view, if rows have several pictures.
    pub(crate) frames: BTreeMap<String, String>,
}

impl OriginMap {
    /// All columns of the table that contain an origin.
    pub(crate) fn columns(&self) -> impl Iterator<Item = &String> {
        let own = [&self.table, &self.row, &self.frame].into_iter().flatten();
        own.chain(self.frames.values())
    }
}

/// Column of the time.
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
    /// Name of the column in the table.
    pub column: String,
    /// Unit of the numbers in the column.
    pub unit: SourceUnit,
    /// UTC offset of text times without a time zone, s; positive east of Greenwich.
    pub zone_s: Option<i64>,
}

impl TimeMap {
    /// Time column `column` in `unit`.
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
