#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod arrow;
mod bytes;
mod cell;
mod codec;
mod error;
mod flatbuffer;
mod growth;
mod lerobot;
mod limits;
mod mcap;
mod message;
mod parquet;
mod path;
mod protobuf;
mod recording;
mod ros;
mod rosbag1;
mod rosbag2;
mod rows;
mod scalar;
mod snappy;
mod source;
mod sqlite;

pub use arrow::ArrowTable;
pub use cell::Cell;
pub use error::{Place, TableError};
pub use lerobot::{
    DepthCodes, Feature, FeatureStats, LeRobot, LeRobotWriter, VideoFrames, WrittenFeature,
};
pub use parquet::{
    ColumnKind, ParquetTable, ParquetWriter, WrittenColumn, WrittenKind, huggingface_features,
};
pub use recording::{Recording, Topic, TopicTable};
pub use ros::{Picture, SampleForm, Samples};
