//! A value of a scene with its position in the text, so that later errors can name the line.

use serde::{Deserialize, Deserializer};

/// A value of a scene or rig file with its byte offset in the text; a default value has no offset.
#[derive(Clone, Copy, Debug, Default)]
pub struct Setting<T> {
    /// The value.
    pub value: T,
    at: Option<usize>,
}

impl<T> Setting<T> {
    /// Creates a default value without a position.
    pub const fn default_of(value: T) -> Setting<T> {
        Setting { value, at: None }
    }

    /// Byte offset of the value in the text; `None` for a default value.
    pub const fn at(&self) -> Option<usize> {
        self.at
    }

    /// Applies `change` to the value, and keeps its position.
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> Setting<U> {
        Setting {
            value: change(self.value),
            at: self.at,
        }
    }
}

/// Compares only the values. The position has no effect.
impl<T: PartialEq> PartialEq for Setting<T> {
    fn eq(&self, other: &Setting<T>) -> bool {
        self.value == other.value
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Setting<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Setting<T>, D::Error> {
        let written = toml::Spanned::<T>::deserialize(deserializer)?;
        let at = Some(written.span().start);
        Ok(Setting {
            value: written.into_inner(),
            at,
        })
    }
}
