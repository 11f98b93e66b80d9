//! Shape of a picture.

/// Shape of a picture in memory.
///
/// # Shapes
/// Pictures are stored as `[height, width, channels]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub struct Picture {
    /// Number of rows.
    pub height: usize,
    /// Number of columns.
    pub width: usize,
    /// Number of values per pixel.
    pub channels: usize,
}

impl Picture {
    /// Number of values per picture.
    pub const fn len(&self) -> usize {
        self.height * self.width * self.channels
    }

    /// True if a picture has no values.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of pixels per picture.
    pub(crate) const fn pixels(&self) -> usize {
        self.height * self.width
    }
}

impl std::fmt::Display for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}×{}×{}", self.height, self.width, self.channels)
    }
}
