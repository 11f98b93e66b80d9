//! A lab's folder becomes a dataset, by a map that says what its columns are.

mod advice;
mod copy;
mod explain;
mod frame_cells;
mod left_out;
mod map;
mod plan;
mod planned_frames;
mod preset;
mod references;
mod resolve;
mod rows;
mod signals;
mod source;
mod summary;
mod suspicion;

pub(crate) use advice::advice;
pub use copy::ImportReport;
pub(crate) use map::converter;
pub use map::{
    ArrayFrames, ArrayLayout, ColumnMap, DropRules, FrameMap, FrameNames, IdMap, ImportMap,
    PixelRange, Placeholder, TimeMap, VideoFrames,
};
pub use plan::ImportPlan;
pub use preset::Preset;
pub use summary::{Conversion, ImportSummary, JoinSummary};
pub use suspicion::{Suspicion, magnitude_suspicion};
