//! A value of a scene with its position in the text, so that an error after parsing names the line.

use serde::{Deserialize, Deserializer};

/// A value, and the byte of the scene where it was written; defaults were written nowhere.
#[derive(Clone, Copy, Debug, Default)]
pub struct Setting<T> {
    /// The value.
    pub value: T,
    at: Option<usize>,
}

impl<T> Setting<T> {
    /// A default value, which stands nowhere in the text.
    pub const fn default_of(value: T) -> Setting<T> {
        Setting { value, at: None }
    }

    /// The byte of the scene where it begins; `None` for a default.
    pub const fn at(&self) -> Option<usize> {
        self.at
    }

    /// Another value, written at the same place.
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> Setting<U> {
        Setting {
            value: change(self.value),
            at: self.at,
        }
    }
}

/// Two settings are equal if their values are: moving a line changes no meaning.
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
