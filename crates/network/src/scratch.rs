//! Buffers that passes share.

use crate::convolution::TileRooms;
use crate::error::NetworkError;
use crate::panel::Aligned;
use crate::planes::{Layout, Planes};

/// Pool of buffers for temporary use.
#[derive(Debug)]
pub(crate) struct Scratch {
    spare: Vec<Aligned>,
    /// Buffer for one convolution: first the weights with inputs and outputs exchanged, then the weight gradient.
    pub(crate) weights: Aligned,
    /// Buffer for transformed weights.
    pub(crate) transformed: Aligned,
    pub(crate) tiles: TileRooms,
}

impl Scratch {
    /// Pool of buffers for pictures only, which are allocated on demand.
    pub(crate) fn of_pictures() -> Scratch {
        Scratch {
            spare: Vec::new(),
            weights: Aligned::zeros(0),
            transformed: Aligned::zeros(0),
            tiles: TileRooms::default(),
        }
    }

    /// Pool with buffers for convolutions of up to `weights` weights and `transformed` transformed weights.
    ///
    /// # Errors
    /// [`NetworkError::Memory`] if the transformed weights do not fit into memory.
    pub(crate) fn new(weights: usize, transformed: usize) -> Result<Scratch, NetworkError> {
        Ok(Scratch {
            weights: Aligned::zeros(weights),
            transformed: Aligned::try_zeros(transformed)?,
            ..Scratch::of_pictures()
        })
    }

    /// Takes or allocates a buffer for `count` pictures. The border is zero, and the pixels are unspecified.
    pub(crate) fn take(&mut self, layout: Layout, count: usize) -> Planes {
        let length = layout.len() * count;
        // The last returned buffer is most likely in a cache.
        match self.spare.iter().rposition(|room| length <= room.len()) {
            Some(position) => Planes::within(self.spare.remove(position), layout, count),
            None => {
                // In the backward pass, pictures grow towards the input. A buffer that is too small now will not fit later pictures either.
                self.spare.pop();
                Planes::zeros(layout.picture, layout.border, count)
            }
        }
    }

    /// Returns the buffer of `planes` to the pool.
    pub(crate) fn put(&mut self, planes: Planes) {
        self.spare.push(planes.into_room());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Picture;

    #[test]
    fn room_goes_round_between_sizes_and_borders_are_zero_again() {
        let mut scratch = Scratch::of_pictures();
        let layout = |side, border| Layout {
            picture: Picture {
                height: side,
                width: side + 1,
                channels: 16,
            },
            border,
        };
        let mut large = scratch.take(layout(5, 0), 2);
        large.first_mut(2).fill(7.0);
        let place = large.first(2).as_ptr();
        scratch.put(large);

        let inner = layout(2, 1);
        let mut small = scratch.take(inner, 2);
        assert_eq!(small.first(2).as_ptr(), place);
        assert_eq!(small.first(2).len(), 2 * 4 * 5 * 16);
        for image in 0..2 {
            small.set(image, &vec![0.0; inner.picture.len()]);
        }
        assert!(small.first(2).iter().all(|value| *value == 0.0));
    }
}
