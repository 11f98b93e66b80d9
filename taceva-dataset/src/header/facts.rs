//! What a header says of the sensor, the frames and the table.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use taceva_core::FrameInfo;

use crate::decode::ChannelOrder;
use crate::digest::Digest;

/// Where the samples come from; carried into every report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// A real sensor.
    #[default]
    Recorded,
    /// A simulated bench.
    Simulated,
    /// Numbers made up for a test.
    Synthetic,
}

/// A fact that the lab may have forgotten to write down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Known<T> {
    /// Written down.
    Is(T),
    /// Nobody knows.
    #[default]
    Unknown,
}

impl<T: Copy> Known<T> {
    /// The fact, if somebody wrote it down.
    pub fn known(self) -> Option<T> {
        match self {
            Known::Is(fact) => Some(fact),
            Known::Unknown => None,
        }
    }
}

impl Serialize for Known<bool> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Known::Is(fact) => serializer.serialize_bool(*fact),
            Known::Unknown => serializer.serialize_str("unknown"),
        }
    }
}

impl<'de> Deserialize<'de> for Known<bool> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Known<bool>, D::Error> {
        struct Fact;

        impl de::Visitor<'_> for Fact {
            type Value = Known<bool>;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("true, false or \"unknown\"")
            }
            fn visit_bool<E: de::Error>(self, fact: bool) -> Result<Known<bool>, E> {
                Ok(Known::Is(fact))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Known<bool>, E> {
                match text {
                    "unknown" => Ok(Known::Unknown),
                    _ => Err(E::invalid_value(de::Unexpected::Str(text), &self)),
                }
            }
        }

        deserializer.deserialize_any(Fact)
    }
}

/// Which sensor it was. `"unknown"` is an answer, silence is not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SensorFacts {
    /// The sensor model.
    pub model: String,
    /// The serial number of the unit, or `unknown`.
    pub serial: String,
    /// The id of the gel, or `unknown`.
    pub gel: String,
    /// Whether ambient light cannot reach the camera.
    pub opaque: Known<bool>,
}

/// What all frames of a recording share.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FramesInfo {
    /// How many there are.
    pub count: u64,
    /// Size and pixel format of each, decoded.
    #[serde(flatten)]
    pub info: FrameInfo,
    /// The order of the colours in the files.
    pub channel_order: ChannelOrder,
    /// The frame without contact; absent if the lab does not know one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<ReferenceInfo>,
}

/// The frame without contact.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReferenceInfo {
    /// Relative to the folder of the dataset.
    pub path: String,
    /// Of the bytes of the file.
    pub sha256: Digest,
}

/// What `samples.parquet` must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TableInfo {
    /// Number of samples.
    pub rows: u64,
    /// Of what the table says.
    pub digest: Digest,
    /// Of the bytes of the file.
    pub sha256: Digest,
}
