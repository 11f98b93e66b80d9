//! Table `[recording]` of a scene as it is written.

use std::fmt;

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer};

use crate::text::Setting;

/// What is kept of a recording that a scene makes.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table with `frames`")]
pub(super) struct WrittenRecording {
    /// The size to which frames are reduced before they are kept; as they come when absent.
    pub(super) frames: Option<Setting<WrittenSize>>,
}

/// A size as it was written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WrittenSize(pub(super) String);

/// A number is taken too, so that it is refused by the key and with what was expected.
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
