//! Memory that passes lend each other.

use crate::convolution::TileRooms;
use crate::error::NetworkError;
use crate::panel::Aligned;
use crate::planes::{Layout, Planes};

/// Room that is used for a while and then by others.
#[derive(Debug)]
pub(crate) struct Scratch {
    spare: Vec<Aligned>,
    /// For the weights of one convolution: exchanged, and then their gradient.
    pub(crate) weights: Aligned,
    /// For the same, transformed.
    pub(crate) transformed: Aligned,
    pub(crate) tiles: TileRooms,
}

impl Scratch {
    /// Room for nothing but pictures, which comes as it is asked for.
    pub(crate) fn of_pictures() -> Scratch {
        Scratch {
            spare: Vec::new(),
            weights: Aligned::zeros(0),
            transformed: Aligned::zeros(0),
            tiles: TileRooms::default(),
        }
    }

    /// The same with room for convolutions of up to `weights` weights, and `transformed` of them transformed.
    ///
    /// # Errors
    /// [`NetworkError::Memory`] if there is no room for transformed weights.
    pub(crate) fn new(weights: usize, transformed: usize) -> Result<Scratch, NetworkError> {
        Ok(Scratch {
            weights: Aligned::zeros(weights),
            transformed: Aligned::try_zeros(transformed)?,
            ..Scratch::of_pictures()
        })
    }

    /// `count` pictures with a border of zeros and anything within, in room that pictures of any size had before.
    pub(crate) fn take(&mut self, layout: Layout, count: usize) -> Planes {
        let length = layout.len() * count;
        // The latest that was given back is the likeliest to be in a cache.
        match self.spare.iter().rposition(|room| length <= room.len()) {
            Some(position) => Planes::within(self.spare.remove(position), layout, count),
            None => {
                // Pictures grow towards the input: what is too small now is in a moment too small for all.
                self.spare.pop();
                Planes::zeros(layout.picture, layout.border, count)
            }
        }
    }

    /// Gives the room of pictures back.
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
