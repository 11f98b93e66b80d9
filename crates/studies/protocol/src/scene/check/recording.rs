//! Table `[recording]` of a scene, as parsed before any check.

use std::fmt;

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer};

use crate::text::Setting;

/// Settings of the recording of a scene.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table with `frames`")]
pub(super) struct WrittenRecording {
    /// Size to which frames are reduced before storage; `None` stores full frames.
    pub(super) frames: Option<Setting<WrittenSize>>,
}

/// Size of a frame as written, such as `64x48`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WrittenSize(pub(super) String);

/// Reads a text. Also accepts a number, so that the check can reject it with the key and the expected form.
impl<'de> Deserialize<'de> for WrittenSize {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<WrittenSize, D::Error> {
        struct Size;

        impl Visitor<'_> for Size {
            type Value = WrittenSize;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a size such as `frames = \"64x48\"`")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<WrittenSize, E> {
                Ok(WrittenSize(text.to_owned()))
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<WrittenSize, E> {
                Ok(WrittenSize(number.to_string()))
            }
        }

        deserializer.deserialize_any(Size)
    }
}
