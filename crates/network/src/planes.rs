//! Batches of pictures in memory, and the layout of these pictures.

use crate::error::{NetworkError, SampleSet};
use crate::panel::Aligned;
use crate::picture::Picture;

impl Picture {
    /// Checks that `pictures` contains whole pictures of finite values, and that the length of `into` is pictures × `outputs`.
    ///
    /// # Errors
    /// [`NetworkError`] for the first violation.
    pub fn check_prediction(
        self,
        pictures: &[f32],
        outputs: usize,
        into: &[f64],
    ) -> Result<(), NetworkError> {
        if !pictures.len().is_multiple_of(self.len()) {
            return Err(NetworkError::Pictures {
                values: pictures.len(),
                expected: self,
            });
        }
        let expected = pictures.len() / self.len() * outputs;
        if into.len() != expected {
            return Err(NetworkError::Room {
                found: into.len(),
                expected,
            });
        }
        // No early exit, so the compiler vectorises the loop.
        let all = |picture: &[f32]| {
            picture
                .iter()
                .fold(true, |all, value| all & value.is_finite())
        };
        if pictures.chunks_exact(self.len()).all(all) {
            return Ok(());
        }
        match pictures.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(position) => Err(NetworkError::PictureNotFinite {
                part: SampleSet::Prediction,
                picture: position / self.len(),
                position: position % self.len(),
            }),
        }
    }
}

/// Memory layout of a picture with a border of zeros. The border makes bounds checks in loops unnecessary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) picture: Picture,
    pub(crate) border: usize,
}

impl Layout {
    /// The layout without its border.
    pub(crate) const fn bare(self) -> Layout {
        Layout { border: 0, ..self }
    }

    /// Number of values per row, including the border.
    pub(crate) const fn row(&self) -> usize {
        (self.picture.width + 2 * self.border) * self.picture.channels
    }

    /// Number of values per picture, including the border.
    pub(crate) const fn len(&self) -> usize {
        (self.picture.height + 2 * self.border) * self.row()
    }

    /// Offset of the first pixel of row `y` that is not in the border.
    pub(crate) const fn start_of_row(&self, y: usize) -> usize {
        (y + self.border) * self.row() + self.border * self.picture.channels
    }

    /// Range of row `y`, without its border.
    pub(crate) fn row_range(&self, y: usize) -> std::ops::Range<usize> {
        let start = self.start_of_row(y);
        start..start + self.picture.width * self.picture.channels
    }
}

/// A batch of pictures.
#[derive(Clone, Debug)]
pub(crate) struct Planes {
    layout: Layout,
    values: Aligned,
}

/// The first pictures of a batch.
#[derive(Clone, Copy)]
pub(crate) struct Pictures<'a> {
    pub(crate) planes: &'a Planes,
    /// Number of pictures.
    pub(crate) count: usize,
}

impl Planes {
    /// Allocates a batch of `batch` pictures of zeros.
    pub(crate) fn zeros(picture: Picture, border: usize, batch: usize) -> Planes {
        let layout = Layout { picture, border };
        let values = Aligned::zeros(layout.len() * batch);
        Planes { layout, values }
    }

    /// Stores pictures in an existing buffer, which may be longer. Sets the borders to zero; the pixels are unspecified.
    pub(crate) fn within(room: Aligned, layout: Layout, count: usize) -> Planes {
        let mut planes = Planes {
            layout,
            values: room,
        };
        let (row, border) = (layout.row(), layout.border * layout.picture.channels);
        for image in planes.first_mut(count).chunks_exact_mut(layout.len()) {
            let last = image.len() - layout.border * row;
            image[..layout.border * row].fill(0.0);
            image[last..].fill(0.0);
            for row in image[layout.border * row..last].chunks_exact_mut(row) {
                let right = row.len() - border;
                row[..border].fill(0.0);
                row[right..].fill(0.0);
            }
        }
        planes
    }

    /// Returns the underlying buffer.
    pub(crate) fn into_room(self) -> Aligned {
        self.values
    }

    pub(crate) fn layout(&self) -> Layout {
        self.layout
    }

    /// Capacity, in pictures.
    #[cfg(test)]
    pub(crate) fn batch(&self) -> usize {
        self.values.len() / self.layout.len()
    }

    /// Values of the first `count` pictures, including borders.
    pub(crate) fn first(&self, count: usize) -> &[f32] {
        self.from(0, count)
    }

    /// Values of `count` pictures, beginning with picture `first`, including borders.
    pub(crate) fn from(&self, first: usize, count: usize) -> &[f32] {
        &self.values[first * self.layout.len()..][..count * self.layout.len()]
    }

    /// Mutable values of the first `count` pictures, including borders. Callers must leave the borders zero.
    pub(crate) fn first_mut(&mut self, count: usize) -> &mut [f32] {
        &mut self.values[..count * self.layout.len()]
    }

    /// Writes the pixels of picture `position`.
    pub(crate) fn set(&mut self, position: usize, values: &[f32]) {
        let layout = self.layout;
        let image = &mut self.values[position * layout.len()..][..layout.len()];
        let rows = values.chunks_exact(layout.picture.width * layout.picture.channels);
        for (y, row) in rows.enumerate() {
            image[layout.row_range(y)].copy_from_slice(row);
        }
    }

    /// Pixels of picture `position`, without the border.
    #[cfg(test)]
    pub(crate) fn get(&self, position: usize) -> Vec<f32> {
        let image = &self.values[position * self.layout.len()..][..self.layout.len()];
        let rows = (0..self.layout.picture.height).map(|y| &image[self.layout.row_range(y)]);
        rows.flatten().copied().collect()
    }
}
