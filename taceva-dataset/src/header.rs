//! `dataset.toml`: what is known about a recording as a whole.

mod footprint;

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use taceva_core::{Channel, Channels, Clock, FrameInfo, PressOutcome, Unit};

use crate::decode::ChannelOrder;
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::held::HeldFolder;
use crate::layout;
use crate::limits;
use crate::toml_file::{parse_toml, toml_error, utf8};
use crate::version::Version;
use taceva_seal::{Opened, SealError};

pub use footprint::{Footprint, Shape};

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

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct ChannelInfo {
    name: String,
    unit: Unit,
}

/// Everything `dataset.toml` says.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// The format of the folder.
    pub format: Version,
    /// Real, simulated or made up.
    pub source: Source,
    /// The clock of the times.
    pub clock: Clock,
    /// Which sensor it was.
    pub sensor: SensorFacts,
    /// Where the sensor senses, if it is known.
    pub footprint: Option<Footprint>,
    /// What was measured beside the frames.
    pub channels: Channels,
    /// The names of the text columns kept for splits.
    pub attributes: Vec<String>,
    /// Columns of the imported table that no key of its map names; empty of a recording, and before format 1.4.
    pub unmentioned_columns: Vec<String>,
    /// What all frames share; `None` if there is none.
    pub frames: Option<FramesInfo>,
    /// How many presses ended in which way, those without a sample too; empty where no protocol pressed, and before format 1.2.
    pub presses: BTreeMap<PressOutcome, u64>,
    /// What the table must be.
    pub table: TableInfo,
    /// The digest of the dataset.
    pub digest: Digest,
    /// Whether the header is sealed, and the edits of it that were accepted.
    pub seal: Opened,
}

/// The header in the order in which TOML wants it: plain keys before tables.
#[derive(Serialize, Deserialize)]
struct Written {
    format: Version,
    source: Source,
    clock: Clock,
    attributes: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    unmentioned_columns: Vec<String>,
    digest: Digest,
    sensor: SensorFacts,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    footprint: Option<Footprint>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    frames: Option<FramesInfo>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    presses: BTreeMap<PressOutcome, u64>,
    table: TableInfo,
    channels: Vec<ChannelInfo>,
}

impl Header {
    /// The header of the dataset in `folder`.
    pub(crate) fn read(folder: &HeldFolder) -> Result<Header, DatasetError> {
        let bytes = folder.read(layout::HEADER, limits::TOML_BYTES)?;
        Header::parse(&folder.path().join(layout::HEADER), bytes)
    }

    /// The header that `bytes`, the content of the file at `path`, say.
    fn parse(path: &Path, bytes: Vec<u8>) -> Result<Header, DatasetError> {
        #[derive(Deserialize)]
        struct OnlyFormat {
            format: Version,
        }

        let text = utf8(path, bytes)?;
        let OnlyFormat { format } = parse_toml(path, &text)?;
        if !format.is_readable() {
            return Err(DatasetError::Version {
                path: path.to_owned(),
                found: format,
            });
        }
        let version = match format >= Version::SEALED {
            true => taceva_seal::Version::Sealed,
            false => taceva_seal::Version::BeforeSeals,
        };
        // TOML that is none is told by its line.
        parse_toml::<toml::Table>(path, &text)?;
        let seal =
            taceva_seal::toml_text::check(&text, version).map_err(|source| DatasetError::Seal {
                path: path.to_owned(),
                source,
            })?;
        let written: Written = parse_toml(path, &text)?;
        let channels = written
            .channels
            .iter()
            .map(|channel| Channel::named(&channel.name, channel.unit))
            .collect::<Result<Vec<_>, _>>()
            .and_then(Channels::new)
            .map_err(|error| toml_error(path, None, &error.to_string()))?;
        Ok(Header {
            format,
            source: written.source,
            clock: written.clock,
            sensor: written.sensor,
            footprint: written.footprint,
            channels,
            attributes: written.attributes,
            unmentioned_columns: written.unmentioned_columns,
            frames: written.frames,
            presses: written.presses,
            table: written.table,
            digest: written.digest,
            seal,
        })
    }

    /// The text of the header, sealed.
    pub(crate) fn to_toml(&self) -> String {
        taceva_seal::toml_text::seal(&self.body()).expect("what was just written is TOML")
    }

    /// What the text says.
    fn body(&self) -> String {
        let written = Written {
            format: self.format,
            source: self.source,
            clock: self.clock,
            attributes: self.attributes.clone(),
            unmentioned_columns: self.unmentioned_columns.clone(),
            digest: self.digest,
            sensor: self.sensor.clone(),
            footprint: self.footprint,
            frames: self.frames.clone(),
            presses: self.presses.clone(),
            table: self.table,
            channels: self
                .channels
                .iter()
                .map(|channel| ChannelInfo {
                    name: channel.name().to_owned(),
                    unit: channel.unit(),
                })
                .collect(),
        };
        toml::to_string(&written).expect("text, numbers and tables of them can be written as TOML")
    }
}

/// The text of an edited `dataset.toml`, accepted: sealed, with the edit in its history, and of a version that has seals.
///
/// # Errors
/// [`SealError`] if it is no TOML, or nothing but a seal.
pub fn reseal_header(text: &str, date: &str, reason: &str) -> Result<String, SealError> {
    #[derive(Deserialize)]
    struct OnlyFormat {
        format: Version,
    }

    // A description of before seals would not be missed one: it becomes one of the version that has them.
    let older = toml::from_str::<OnlyFormat>(text).ok();
    let text = match older.filter(|older| older.format < Version::SEALED) {
        Some(older) => text.replacen(
            &format!("format = \"{}\"", older.format),
            &format!("format = \"{}\"", Version::SEALED),
            1,
        ),
        None => text.to_owned(),
    };
    taceva_seal::toml_text::reseal(&text, date, reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{Limit, PixelFormat};

    fn header() -> Header {
        Header {
            format: Version::CURRENT,
            source: Source::Simulated,
            clock: Clock::Monotonic,
            sensor: SensorFacts {
                model: "a \"b\"\n[c]".to_owned(),
                serial: "unknown".to_owned(),
                gel: "g1".to_owned(),
                opaque: Known::Unknown,
            },
            footprint: Some(Footprint {
                shape: Shape::Disc,
                radius_mm: Some(10.0),
                half_x_mm: None,
                half_y_mm: None,
                depth_max_mm: Some(2.5),
            }),
            channels: Channels::new([Channel::FZ, Channel::PZ]).expect("distinct"),
            attributes: vec!["video".to_owned()],
            unmentioned_columns: vec!["quality_flags".to_owned()],
            frames: Some(FramesInfo {
                count: 3,
                info: FrameInfo {
                    width: 4,
                    height: 2,
                    format: PixelFormat::Rgb8,
                },
                channel_order: ChannelOrder::Bgr,
                reference: None,
            }),
            presses: BTreeMap::from([
                (PressOutcome::Complete, 2),
                (PressOutcome::Limited(Limit::NormalForce), 1),
            ]),
            table: TableInfo {
                rows: 3,
                digest: Digest::of(b"t"),
                sha256: Digest::of(b"f"),
            },
            digest: Digest::of(b"d"),
            seal: Opened::default(),
        }
    }

    #[test]
    fn a_header_reads_back_as_it_was_written() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("dataset.toml"), header().to_toml()).expect("written");
        let held = HeldFolder::open(folder.path()).expect("a folder");
        let read = Header::read(&held).expect("reads");
        assert!(read.seal.is_sealed);
        let unread = Header {
            seal: Opened::default(),
            ..read
        };
        assert_eq!(unread, header());
    }

    #[test]
    fn a_newer_major_is_refused_before_anything_else_is_understood() {
        let text = b"format = \"2.0\"\nnews = 1\n".to_vec();
        let message = Header::parse(Path::new("dataset.toml"), text);
        let message = message.expect_err("newer").to_string();
        assert!(
            message.ends_with("format 2.0 needs a newer TacEva; this one reads up to 1.x"),
            "{message}"
        );
    }

    #[test]
    fn a_newer_minor_may_say_more() {
        let current = format!("\"{}\"", Version::CURRENT);
        let text = header().body().replace(&current, "\"1.9\"");
        let text = taceva_seal::toml_text::seal(&format!("humidity = 40\n{text}"));
        let text = text.expect("TOML").into_bytes();
        let header = Header::parse(Path::new("dataset.toml"), text);
        assert_eq!(
            header.expect("reads").format,
            Version { major: 1, minor: 9 }
        );
    }

    #[test]
    fn an_edited_header_is_refused_by_its_key_and_an_older_one_is_read_unsealed() {
        let parse = |text: &str| Header::parse(Path::new("dataset.toml"), text.as_bytes().to_vec());
        let sealed = header().to_toml();
        let edited = sealed.replace("radius_mm = 10.0", "radius_mm = 9.0");
        let message = parse(&edited).expect_err("edited").to_string();
        assert!(
            message
                .starts_with("dataset.toml: `footprint.radius_mm` was changed after it was sealed"),
            "{message}"
        );
        let body = header().body();
        let message = parse(&body).expect_err("no seal").to_string();
        assert!(message.contains("the seal is gone"), "{message}");
        let current = format!("\"{}\"", Version::CURRENT);
        let older = parse(&body.replace(&current, "\"1.2\"")).expect("older");
        assert!(!older.seal.is_sealed);
        let (_, alone) = sealed.split_once("\n[seal]").expect("sealed");
        let alone = format!("format = {current}\n[seal]{alone}");
        assert!(parse(&alone).is_err());
    }
}
