#![doc = include_str!("../README.md")]

mod absence;
#[cfg(feature = "ndarray")]
mod arrays;
mod dataset;
mod decode;
mod decoder_panic;
mod difference;
mod digest;
mod encode;
mod error;
mod file;
mod folder_handle;
mod frame_retries;
mod header;
mod journal;
mod jpeg;
mod later_facts;
#[doc(hidden)]
pub mod layout;
#[doc(hidden)]
pub mod limits;
mod lock;
mod maps;
mod pack;
mod parallel;
mod quality;
mod recorder;
mod replacement;
mod rotation_vector;
mod samples;
mod sensor_file;
mod session_table;
mod shell;
mod signals;
#[doc(hidden)]
pub mod staging;
mod store;
mod table;
mod task;
mod text;
mod toml_file;
mod version;
mod view_names;
mod zero_table;

#[cfg(feature = "ndarray")]
pub use arrays::{FrameArray, FrameArrays};
pub use dataset::{Dataset, JoinedRecording, Pass, StreamReport};
pub use decode::ChannelOrder;
pub use digest::{Digest, DigestError};
pub use error::{DatasetError, Place};
pub use frame_retries::{add_frame_retries, add_frozen_frames, frame_retries, frozen_frames};
pub use header::{
    Extension, Footprint, FrameCodec, FramesInfo, Header, Known, Leds, LeftOut, LivePredictions,
    MappedClass, MappedColumn, MappedJoin, MappedPictures, PictureSide, RecordingFacts,
    ReducedFrames, ReferenceInfo, SensorFacts, Shape, Source, SourcesInfo, StreamFacts, TableInfo,
    ViewInfo,
};
pub use later_facts::{add_device_warnings, add_measured_settings};
pub use maps::StoredMap;
pub use pack::Span;
pub use quality::names_quality;
pub use recorder::{Recorder, RecordingSpec, Streamed};
pub use replacement::settle;
pub use rotation_vector::RotationVector;
pub use sensor_file::SensorFile;
pub use session_table::{RecordedSessions, Session, SessionTable};
pub use signals::{SignalsInfo, SignalsSpec};
pub use table::{FrameEntry, Row, RowFrame, Table, TaskColumn, ViewFrames};
pub use task::{MapEntry, MapFacts, PoseThresholds, Task, TaskKind, TaskLabel};
pub use toml_file::read_toml;
pub use version::Version;
pub use zero_table::{PressZero, add_press_zero, press_zeros, zero_settings};

/// Parts that the importer shares with the reader and the recorder. The interface is not stable.
#[doc(hidden)]
pub mod internal {
    pub use crate::absence::{is_foreign_folder, quoted};
    pub use crate::dataset::{Difference, differences_of_added};
    pub use crate::decode::{ImageKind, check_to_the_end, decode};
    pub use crate::decoder_panic::guarded;
    pub use crate::digest::PartsDigest;
    pub use crate::encode::encode_png;
    pub use crate::file::{check_relative, open_regular, read_capped, write_durable};
    pub use crate::header::{Mapping, Misread, add_left_out};
    pub use crate::maps::{MapForm, MapPack, MapParts, map_of_numbers, map_of_png, parts_of_map};
    pub use crate::parallel::{all_cores, each_part, ordered_map};
    pub use crate::shell::shell_word;
    pub use crate::signals::{SignalsReader, SignalsWriter};
    pub use crate::store::{Beside, write_table_and_header};
    pub use crate::table::{
        Cells, NamedColumn, RESERVED, RowNames, column_kind, column_of, is_attribute_name,
    };
    pub use crate::task::is_task_column;
    pub use crate::text::{first_names, listed, shown, shown_path};
    pub use crate::toml_file::{line_of, parse_toml, read_toml_text, toml_error, utf8};
    pub use crate::{layout, limits, staging};
}
