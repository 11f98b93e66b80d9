#![doc = include_str!("../README.md")]

mod advice;
mod csv_table;
mod draft;
mod error;
mod export;
mod foreign;
mod frame_names;
mod import;
mod instant;
mod layouts;
mod maps_file;
mod open_places;
mod preset;
mod source_folder;
mod source_sums;
mod taxel_codes;
mod unit_suffix;

pub use advice::advice;
pub use csv_table::CsvTable;
pub use csv_table::parts::CsvParts;
pub use csv_table::stream::CsvStream;
pub use draft::MapDraft;
pub use error::{ImportError, Place};
pub use export::{ExportForm, ExportPlan, ExportReport, export_csv};
pub use import::{
    Addition, ArrayFrames, ArrayLayout, ColumnMap, Conversion, DropRules, DroppedRow, FrameMap,
    FrameNames, FrameSummary, IdMap, ImportMap, ImportPlan, ImportReport, ImportSummary,
    ImportWarning, JoinSummary, PixelRange, Placeholder, Suspicion, TimeMap, UnpackedArchive,
    VideoFrames, ZeroSummary, magnitude_suspicion,
};
pub use layouts::Preset;
pub use maps_file::MapsFile;
pub use source_sums::{SourceDifference, SourceSums};
pub use taceva_video::Decoders;

/// Parts that the program `taceva` shares with the importer. The interface is not stable.
#[doc(hidden)]
pub mod internal {
    pub use crate::open_places::{OPEN, code, open_places};
}
