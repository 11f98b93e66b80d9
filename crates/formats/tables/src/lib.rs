#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod arrow;
mod bytes;
mod cell;
mod codec;
mod error;
mod flatbuffer;
mod lerobot;
mod limits;
mod mcap;
mod parquet;
mod path;
mod ros;
mod rows;
mod scalar;
mod snappy;
mod source;

pub use arrow::ArrowTable;
pub use cell::Cell;
pub use error::{Place, TableError};
pub use lerobot::{
    DepthCodes, Feature, FeatureStats, LeRobot, LeRobotWriter, VideoFrames, WrittenFeature,
};
pub use mcap::{Mcap, McapTable, Topic};
pub use parquet::{
    ColumnKind, ParquetTable, ParquetWriter, WrittenColumn, WrittenKind, huggingface_features,
};
pub use ros::{Picture, SampleForm, Samples};
