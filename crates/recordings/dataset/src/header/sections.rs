//! Facts about the sensor, the frames and the table in a header.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use taceva_core::FrameInfo;

use super::leds::Leds;
use super::reduction::ReducedFrames;
use crate::decode::ChannelOrder;
use crate::digest::Digest;

/// Origin of the samples, stated in every report. This enum gets no further variant, because every reader must handle each variant.
///
/// ```
/// use taceva_dataset::Source;
///
/// assert_eq!(Source::default(), Source::Recorded);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// Samples of a real sensor.
    #[default]
    Recorded,
    /// Samples of a simulated bench; nothing was measured.
    Simulated,
    /// Artificial numbers for a test.
    Synthetic,
}

/// Fact that may be unknown. This enum gets no further variant.
///
/// ```
/// use taceva_dataset::Known;
///
/// assert_eq!(Known::Is(true).known(), Some(true));
/// assert_eq!(Known::<bool>::Unknown.known(), None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Known<T> {
    /// Fact stated by the lab.
    Is(T),
    /// Not stated; reports show `unknown`.
    #[default]
    Unknown,
}

impl<T: Copy> Known<T> {
    /// Returns the fact, if known.
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

/// Facts about the sensor. A header must state each key; the value `"unknown"` is accepted.
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
    /// Name of the sensor model.
    pub model: String,
    /// Serial number of the unit, or `unknown`.
    pub serial: String,
    /// Id of the gel, or `unknown`.
    pub gel: String,
    /// True if ambient light cannot reach the camera.
    pub opaque: Known<bool>,
    /// Presses on this gel before the recording; `None` if nobody counted them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub presses_since_gel: Option<u32>,
    /// Sides of the picture at which the LEDs of each colour stand, if stated.
    #[serde(default, skip_serializing_if = "Leds::is_unknown")]
    pub leds: Leds,
}

impl SensorFacts {
    /// Sensor of `model` with unknown serial number, gel, opacity, presses and LEDs.
    pub fn new(model: impl Into<String>) -> SensorFacts {
        SensorFacts {
            model: model.into(),
            serial: "unknown".to_owned(),
            gel: "unknown".to_owned(),
            opaque: Known::Unknown,
            presses_since_gel: None,
            leds: Leds::default(),
        }
    }

    /// The same sensor with the serial number of the unit.
    #[must_use]
    pub fn with_serial(self, serial: impl Into<String>) -> SensorFacts {
        SensorFacts {
            serial: serial.into(),
            ..self
        }
    }

    /// The same sensor with the id of the gel.
    #[must_use]
    pub fn with_gel(self, gel: impl Into<String>) -> SensorFacts {
        SensorFacts {
            gel: gel.into(),
            ..self
        }
    }

    /// The same sensor with known opacity: true if ambient light cannot reach the camera.
    #[must_use]
    pub fn with_opaque(self, opaque: bool) -> SensorFacts {
        SensorFacts {
            opaque: Known::Is(opaque),
            ..self
        }
    }

    /// The same sensor with the number of presses on its gel before the recording.
    #[must_use]
    pub fn with_presses_since_gel(self, presses: impl Into<Option<u32>>) -> SensorFacts {
        SensorFacts {
            presses_since_gel: presses.into(),
            ..self
        }
    }
}

/// Properties shared by all frames of a recording.
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
    /// Number of frames, not counting the reference frame.
    pub count: u64,
    /// Width, height and pixel format of every decoded frame.
    #[serde(flatten)]
    pub info: FrameInfo,
    /// Order of the colours in the image files.
    pub channel_order: ChannelOrder,
    /// Video coding of the frames if they came from a clip; the coding of the first clip if there are several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub codec: Option<FrameCodec>,
    /// Other video codings of further clips, each once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub other_codecs: Vec<FrameCodec>,
    /// Original form of reduced frames; `None` if they were recorded unchanged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reduced: Option<ReducedFrames>,
    /// Frame without contact; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<ReferenceInfo>,
}

impl FramesInfo {
    /// Properties of `count` unreduced frames that are not from a clip, with an unknown frame without contact.
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

    /// Size and format of a camera frame before any reduction.
    pub fn of_camera(&self) -> FrameInfo {
        self.reduced
            .as_ref()
            .map_or(self.info, |reduced| reduced.from)
    }
}

/// Video coding of frames in a clip, and their decoder.
///
/// ```
/// let codec: taceva_dataset::FrameCodec = toml::from_str("name = \"H.264 High\"\npixel_format = \"yuv420p\"\nlossy = true\n")?;
/// assert_eq!((codec.lossy, codec.decoder), (Some(true), None));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FrameCodec {
    /// Name of the codec, with its profile if known.
    pub name: String,
    /// Name of the pixel format in FFmpeg.
    pub pixel_format: String,
    /// True if the coding is lossy; `None` for a codec with lossy and lossless modes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lossy: Option<bool>,
    /// Decoder, with its version if known; `None` if frames are stored undecoded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub decoder: Option<String>,
    /// Bits of a pixel value in the clip, if above 8. Luma is stored in 16 bits without scaling.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bits: Option<u8>,
}

/// Bits of a pixel value in an FFmpeg pixel format, by its name, if above 8: 10 for `yuv420p10le`.
fn bits_of(pixel_format: &str) -> Option<u8> {
    let name = pixel_format.strip_suffix("le");
    let name = name.or_else(|| pixel_format.strip_suffix("be"))?;
    let digits = name
        .rsplit(|letter: char| !letter.is_ascii_digit())
        .next()?;
    digits.parse().ok().filter(|bits| (9..=16).contains(bits))
}

impl FrameCodec {
    /// The codec `name` with this pixel format, by the names of FFmpeg.
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

/// Frame without contact.
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
    /// Path of the file, relative to the dataset folder.
    pub path: String,
    /// SHA-256 of the bytes of the file.
    pub sha256: Digest,
}

impl ReferenceInfo {
    /// Reference frame at `path`, relative to the dataset folder, with the digest of its bytes.
    pub fn new(path: impl Into<String>, sha256: Digest) -> ReferenceInfo {
        ReferenceInfo {
            path: path.into(),
            sha256,
        }
    }
}

/// Number of rows and digests of `samples.parquet`.
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
    /// Digest of the table content, independent of its encoding.
    pub digest: Digest,
    /// SHA-256 of the bytes of `samples.parquet`, checked before parsing.
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
