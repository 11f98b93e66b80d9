//! What a header says of the sensor, the frames and the table.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use taceva_core::FrameInfo;

use super::reduction::ReducedFrames;
use crate::decode::ChannelOrder;
use crate::digest::Digest;

/// Where the samples come from; carried into every report. It gets no further variant in a compatible version, because every reader must say
/// what it makes of each.
///
/// ```
/// use taceva_dataset::Source;
///
/// assert_eq!(Source::default(), Source::Recorded);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// A real sensor.
    #[default]
    Recorded,
    /// A simulated bench: nothing was measured.
    Simulated,
    /// Numbers made up for a test.
    Synthetic,
}

/// A fact that a lab may not know. It gets no further variant: a fact is known or it is not.
///
/// ```
/// use taceva_dataset::Known;
///
/// assert_eq!(Known::Is(true).known(), Some(true));
/// assert_eq!(Known::<bool>::Unknown.known(), None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Known<T> {
    /// The lab wrote it down.
    Is(T),
    /// Nobody wrote it down; reports carry `unknown`.
    #[default]
    Unknown,
}

impl<T: Copy> Known<T> {
    /// The fact, if it is known.
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

/// Which sensor it was. A file must state each fact; `"unknown"` is accepted, a missing key is not.
///
/// ```
/// use taceva_dataset::{Known, SensorFacts};
///
/// let sensor = SensorFacts::new("DIGIT").with_serial("D20123").with_opaque(true);
/// assert_eq!(sensor.gel, "unknown");
/// assert_eq!(sensor.opaque, Known::Is(true));
/// ```
#[non_exhaustive]
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

impl SensorFacts {
    /// A sensor of `model`; its serial number, its gel and whether it is opaque are unknown.
    pub fn new(model: impl Into<String>) -> SensorFacts {
        SensorFacts {
            model: model.into(),
            serial: "unknown".to_owned(),
            gel: "unknown".to_owned(),
            opaque: Known::Unknown,
        }
    }

    /// The same with the serial number of the unit.
    #[must_use]
    pub fn with_serial(self, serial: impl Into<String>) -> SensorFacts {
        SensorFacts {
            serial: serial.into(),
            ..self
        }
    }

    /// The same with the id of the gel.
    #[must_use]
    pub fn with_gel(self, gel: impl Into<String>) -> SensorFacts {
        SensorFacts {
            gel: gel.into(),
            ..self
        }
    }

    /// The same, where it is known whether ambient light cannot reach the camera.
    #[must_use]
    pub fn with_opaque(self, opaque: bool) -> SensorFacts {
        SensorFacts {
            opaque: Known::Is(opaque),
            ..self
        }
    }
}

/// What all frames of a recording share.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
/// # use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// # let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my gel"));
/// # let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, Channels::new([Channel::FZ])?))?;
/// # let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// # for number in 0..2_u8 {
/// #     let sample = Sample::new(number.to_string()).with_truth(Readings::from_values([0.5]));
/// #     recorder.append(&sample.with_frame(Frame::new(info, vec![number, 90])?))?;
/// # }
/// let frames = recorder.close()?.frames.ok_or("two frames were recorded")?;
/// assert_eq!((frames.count, frames.info.width), (2, 2));
/// assert_eq!(frames.reference, None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FramesInfo {
    /// How many frames there are, that without contact aside.
    pub count: u64,
    /// Width and height, pixels, and the pixel format of every frame once it is decoded.
    #[serde(flatten)]
    pub info: FrameInfo,
    /// The order of the colours in the files.
    pub channel_order: ChannelOrder,
    /// How the frames were coded and decoded, if they came as a clip; of several clips, how those of the first were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub codec: Option<FrameCodec>,
    /// How the frames of other clips were coded and decoded, where that differs, each way once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub other_codecs: Vec<FrameCodec>,
    /// From what frames were reduced before they were recorded; absent where they are as they came.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reduced: Option<ReducedFrames>,
    /// The frame without contact; absent if the lab does not know one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<ReferenceInfo>,
}

impl FramesInfo {
    /// So many frames, neither coded as a clip nor reduced, without a frame without contact.
    pub fn new(count: u64, info: FrameInfo, channel_order: ChannelOrder) -> FramesInfo {
        FramesInfo {
            count,
            info,
            channel_order,
            codec: None,
            other_codecs: Vec::new(),
            reduced: None,
            reference: None,
        }
    }

    /// A frame as the camera gave it: what was reduced, or what is there.
    pub fn of_camera(&self) -> FrameInfo {
        self.reduced
            .as_ref()
            .map_or(self.info, |reduced| reduced.from)
    }
}

/// How frames were coded in the clips that they came in, and what decoded them.
///
/// ```
/// let codec: taceva_dataset::FrameCodec = toml::from_str("name = \"H.264 High\"\npixel_format = \"yuv420p\"\nlossy = true\n")?;
/// assert_eq!((codec.lossy, codec.decoder), (Some(true), None));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FrameCodec {
    /// The codec, with its profile where that is known.
    pub name: String,
    /// How its pixels are stored, by the names of FFmpeg.
    pub pixel_format: String,
    /// Whether it loses detail; absent where it can do either.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lossy: Option<bool>,
    /// What decoded it, with its version where it says one; absent where frames are kept as they came.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub decoder: Option<String>,
    /// The bits of a sample in the clip, where they are more than 8: luma keeps its numbers in 16 bits and is not scaled up to their full range.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bits: Option<u8>,
}

/// The bits of a sample by the name of a pixel format of FFmpeg, where they are more than 8: 10 of `yuv420p10le`.
fn bits_of(pixel_format: &str) -> Option<u8> {
    let name = pixel_format.strip_suffix("le");
    let name = name.or_else(|| pixel_format.strip_suffix("be"))?;
    let digits = name
        .rsplit(|letter: char| !letter.is_ascii_digit())
        .next()?;
    digits.parse().ok().filter(|bits| (9..=16).contains(bits))
}

impl FrameCodec {
    /// The codec `name` with this pixel format, in the words of FFmpeg.
    pub fn new(name: &str, pixel_format: &str) -> FrameCodec {
        FrameCodec {
            name: name.to_owned(),
            pixel_format: pixel_format.to_owned(),
            lossy: None,
            decoder: None,
            bits: bits_of(pixel_format),
        }
    }
}

/// The frame without contact.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
/// # use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// # let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my gel"));
/// # let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, Channels::new([Channel::FZ])?))?;
/// # let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// # for number in 0..2_u8 {
/// #     let sample = Sample::new(number.to_string()).with_truth(Readings::from_values([0.5]));
/// #     recorder.append(&sample.with_frame(Frame::new(info, vec![number, 90])?))?;
/// # }
/// recorder.append_reference(&Frame::new(info, vec![7, 7])?)?;
/// let frames = recorder.close()?.frames.ok_or("frames were recorded")?;
/// let reference = frames.reference.ok_or("a frame without contact was recorded")?;
/// assert!(path.join(&reference.path).is_file());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReferenceInfo {
    /// Its file, relative to the folder of the dataset.
    pub path: String,
    /// The SHA-256 of the bytes of its file.
    pub sha256: Digest,
}

impl ReferenceInfo {
    /// The file at `path`, relative to the folder of the dataset, whose bytes have this digest.
    pub fn new(path: impl Into<String>, sha256: Digest) -> ReferenceInfo {
        ReferenceInfo {
            path: path.into(),
            sha256,
        }
    }
}

/// What `samples.parquet` must be.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
/// # use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// # let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my gel"));
/// # let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, Channels::new([Channel::FZ])?))?;
/// # let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// # for number in 0..2_u8 {
/// #     let sample = Sample::new(number.to_string()).with_truth(Readings::from_values([0.5]));
/// #     recorder.append(&sample.with_frame(Frame::new(info, vec![number, 90])?))?;
/// # }
/// use taceva_dataset::Digest;
///
/// let table = recorder.close()?.table;
/// assert_eq!(table.rows, 2);
/// assert_eq!(table.sha256, Digest::of(&std::fs::read(path.join("samples.parquet"))?));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TableInfo {
    /// Number of samples.
    pub rows: u64,
    /// The digest of what the table says, whatever bytes it is written as.
    pub digest: Digest,
    /// The SHA-256 of the bytes of `samples.parquet`, which is checked before it is read.
    pub sha256: Digest,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bits_of_a_sample_stand_in_the_name_of_its_format() {
        for (name, bits) in [
            ("yuv420p", None),
            ("yuv420p10le", Some(10)),
            ("gray16be", Some(16)),
            ("gray", None),
            ("rgb24", None),
            ("yuv444p12le", Some(12)),
        ] {
            assert_eq!(bits_of(name), bits, "{name}");
        }
    }
}
