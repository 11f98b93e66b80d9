//! Columns of a table as cells of one type each, shared by digests, storage and export.

use taceva_core::{Channel, Column, GratingKind, Limit, Nanometre, Phase, Unit};

use super::FrameEntry;
use crate::digest::PartsDigest;
use crate::task::MapEntry;

/// Reserved column names on disk. Channels and attributes must have other names.
pub const RESERVED: [&str; 19] = [
    "sample",
    "point_id",
    "unit_id",
    "scene",
    "depth_step",
    "repeat",
    "phase",
    "limited_by",
    "zero_u_mm",
    "source_table",
    "source_row",
    "source_frame",
    "part",
    "t_s",
    "kind",
    "spacing_mm",
    "intensity",
    "frame",
    "frame_sha256",
];

/// True if a text column may have the name `name`.
pub fn is_attribute_name(name: &str) -> bool {
    !RESERVED.contains(&name) && Channel::named(name, Unit::One).is_ok()
}

/// Column with its name on disk.
#[doc(hidden)]
pub struct NamedColumn<'a> {
    /// Name on disk.
    pub name: &'a str,
    /// Cells of the column.
    pub cells: Cells<'a>,
}

/// Cells of a column, by type.
#[doc(hidden)]
pub enum Cells<'a> {
    Name(&'a [String]),
    Text(&'a [Option<String>]),
    Count(&'a [Option<u32>]),
    Phase(&'a [Option<Phase>]),
    Limit(&'a [Option<Limit>]),
    Kind(&'a [Option<GratingKind>]),
    Spacing(&'a [Option<Nanometre>]),
    Measured(&'a [Option<f64>]),
    Number(&'a Column),
    FramePath(&'a [Option<FrameEntry>]),
    FrameDigest(&'a [Option<FrameEntry>]),
    /// Positions of classes, and the names of the classes.
    Class(&'a [Option<u32>], &'a [String]),
    MapPlace(&'a [Option<MapEntry>]),
    MapDigest(&'a [Option<MapEntry>]),
}

impl Cells<'_> {
    pub(super) fn is_present(&self, row: usize) -> bool {
        match self {
            Cells::Name(_) => true,
            Cells::Text(cells) => cells[row].is_some(),
            Cells::Count(cells) | Cells::Class(cells, _) => cells[row].is_some(),
            Cells::Phase(cells) => cells[row].is_some(),
            Cells::Limit(cells) => cells[row].is_some(),
            Cells::Kind(cells) => cells[row].is_some(),
            Cells::Spacing(cells) => cells[row].is_some(),
            Cells::Measured(cells) => cells[row].is_some(),
            Cells::Number(cells) => cells.get(row).is_some(),
            Cells::FramePath(cells) | Cells::FrameDigest(cells) => cells[row].is_some(),
            Cells::MapPlace(cells) | Cells::MapDigest(cells) => cells[row].is_some(),
        }
    }

    /// True for free text.
    pub fn is_text(&self) -> bool {
        matches!(self, Cells::Name(_) | Cells::Text(_))
    }

    /// Floating-point number in a row; `None` if missing, and for columns of other types, such as counts.
    pub fn number(&self, row: usize) -> Option<f64> {
        match self {
            Cells::Spacing(cells) => cells[row].map(Nanometre::to_millimetres),
            Cells::Measured(cells) => cells[row],
            Cells::Number(cells) => cells.get(row),
            _ => None,
        }
    }

    /// Cell as text. Numbers have the shortest form that parses back to the same binary64.
    pub fn text(&self, row: usize) -> Option<String> {
        match self {
            Cells::Name(cells) => Some(cells[row].clone()),
            Cells::Text(cells) => cells[row].clone(),
            Cells::Count(cells) => cells[row].map(|count| count.to_string()),
            Cells::Class(cells, names) => names.get(cells[row]? as usize).cloned(),
            Cells::Phase(cells) => cells[row].map(|phase| phase.to_string()),
            Cells::Limit(cells) => cells[row].map(|limit| limit.to_string()),
            Cells::Kind(cells) => cells[row].map(|kind| kind.to_string()),
            Cells::Spacing(_) | Cells::Measured(_) | Cells::Number(_) => {
                self.number(row).map(|number| format!("{number:?}"))
            }
            Cells::FramePath(cells) => cells[row].as_ref().map(|entry| entry.place().into_owned()),
            Cells::FrameDigest(cells) => cells[row].as_ref().map(|entry| entry.digest.to_string()),
            Cells::MapPlace(cells) => cells[row].map(|entry| entry.to_string()),
            Cells::MapDigest(cells) => cells[row].map(|entry| entry.digest().to_string()),
        }
    }

    pub(super) fn digest(&self, row: usize, digest: &mut PartsDigest) {
        digest.fixed(&[u8::from(self.is_present(row))]);
        match self {
            Cells::Spacing(_) | Cells::Measured(_) | Cells::Number(_) => {
                if let Some(number) = self.number(row) {
                    digest.fixed(&number.to_le_bytes());
                }
            }
            Cells::Name(cells) => digest.part(cells[row].as_bytes()),
            Cells::Text(cells) => {
                if let Some(text) = &cells[row] {
                    digest.part(text.as_bytes());
                }
            }
            _ => {
                if let Some(text) = self.text(row) {
                    digest.part(text.as_bytes());
                }
            }
        }
    }
}
