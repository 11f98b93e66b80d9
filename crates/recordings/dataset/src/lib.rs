#![doc = include_str!("../README.md")]

mod advice;
#[cfg(feature = "ndarray")]
mod arrays;
mod csv_table;
mod dataset;
mod decode;
mod difference;
mod digest;
mod draft;
mod encode;
mod error;
mod export;
mod file;
mod foreign;
mod guard;
mod header;
mod held;
mod import;
mod journal;
mod jpeg;
mod layout;
mod limits;
mod lock;
mod pack;
mod parallel;
mod preset;
mod quality;
mod recorder;
mod replaced;
mod samples;
mod scaled;
mod sensor_file;
mod signals;
mod staged;
mod store;
mod table;
mod text;
mod toml_file;
mod transcode;
mod version;

#[cfg(feature = "ndarray")]
pub use arrays::{FrameArray, FrameArrays};
pub use csv_table::CsvTable;
pub use csv_table::parts::CsvParts;
pub use csv_table::stream::CsvStream;
pub use dataset::{Dataset, JoinedRecording, Pass, StreamReport};
pub use decode::ChannelOrder;
pub use digest::{Digest, DigestError};
pub use draft::MapDraft;
pub use error::{DatasetError, Place};
pub use export::{ExportForm, ExportPlan, ExportReport, export_csv};
pub use header::reseal_header;
pub use header::{
    Extension, Footprint, FrameCodec, FramesInfo, Header, Known, LeftOut, MappedClass,
    MappedColumn, MappedJoin, MappedPictures, ReducedFrames, ReferenceInfo, SensorFacts, Shape,
    Source, StreamFacts, TableInfo,
};
pub use import::{
    Addition, ArrayFrames, ArrayLayout, ColumnMap, Conversion, DropRules, FrameMap, FrameNames,
    IdMap, ImportMap, ImportPlan, ImportReport, ImportSummary, JoinSummary, PixelRange,
    Placeholder, Suspicion, TimeMap, UnpackedArchive, VideoFrames, magnitude_suspicion,
};
pub use pack::Span;
pub use preset::Preset;
pub use quality::names_quality;
pub use recorder::{Recorder, RecordingSpec, Streamed};
pub use replaced::settle;
pub use scaled::DecodeScale;
pub use sensor_file::SensorFile;
pub use signals::{SignalsInfo, SignalsSpec};
pub use store::RecordingFacts;
pub use table::{FrameEntry, Row, Table};
pub use taceva_video::Decoders;
pub use toml_file::read_toml;
pub use transcode::write_as_jpeg;
pub use version::Version;
