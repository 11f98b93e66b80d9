//! Imports the folder of a lab as a dataset, according to an import map.

mod archive;
mod copy;
mod depth_maps;
mod explain;
mod extension;
mod frame_cells;
mod frame_plan;
mod map;
mod mapping;
mod omissions;
mod pattern_column;
mod plan;
mod references;
mod resolve;
mod rows;
mod signals;
pub(crate) mod source;
mod summary;
mod suspicion;
mod warning;

pub use archive::UnpackedArchive;
pub use copy::ImportReport;
pub use extension::Addition;
pub(crate) use map::converter;
pub use map::{
    ArrayFrames, ArrayLayout, ColumnMap, DropRules, DroppedRow, FrameMap, FrameNames, IdMap,
    ImportMap, PixelRange, Placeholder, TimeMap, VideoFrames,
};
pub(crate) use pattern_column::{DIGITS_MAX, whole_number};
pub use plan::ImportPlan;
pub use summary::{Conversion, FrameSummary, ImportSummary, JoinSummary, ZeroSummary};
pub use suspicion::{Suspicion, magnitude_suspicion};
pub use warning::ImportWarning;
