//! Memory that passes lend each other.

use crate::panel::Aligned;
use crate::planes::{Layout, Picture, Planes};

/// Room that is used for a while and then by others.
#[derive(Debug)]
pub(crate) struct Scratch {
    batch: usize,
    spare: Vec<Aligned>,
    /// For the weights of one convolution: exchanged, and then their gradient.
    pub(crate) weights: Aligned,
}

impl Scratch {
    /// Room for batches of `batch` pictures and convolutions of up to `weights` weights.
    pub(crate) fn new(batch: usize, weights: usize) -> Scratch {
        Scratch {
            batch,
            spare: Vec::new(),
            weights: Aligned::zeros(weights),
        }
    }

    /// A batch of pictures with a border of zeros and anything within, in room that pictures of any size had before.
    pub(crate) fn take(&mut self, picture: Picture, border: usize) -> Planes {
        let layout = Layout { picture, border };
        let length = layout.len() * self.batch;
        // The latest that was given back is the likeliest to be in a cache.
        match self.spare.iter().rposition(|room| length <= room.len()) {
            Some(position) => Planes::within(self.spare.remove(position), layout, self.batch),
            None => {
                // Pictures grow towards the input: what is too small now is in a moment too small for all.
                self.spare.pop();
                Planes::zeros(picture, border, self.batch)
            }
        }
    }

    /// Gives the room of a batch back.
    pub(crate) fn put(&mut self, planes: Planes) {
        self.spare.push(planes.into_room());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_goes_round_between_sizes_and_borders_are_zero_again() {
        let mut scratch = Scratch::new(2, 0);
        let picture = |side| Picture {
            height: side,
            width: side + 1,
            channels: 16,
        };
        let mut large = scratch.take(picture(5), 0);
        large.first_mut(2).fill(7.0);
        let place = large.first(2).as_ptr();
        scratch.put(large);

        let mut small = scratch.take(picture(2), 1);
        assert_eq!(small.first(2).as_ptr(), place);
        assert_eq!(small.first(2).len(), 2 * 4 * 5 * 16);
        for image in 0..2 {
            small.set(image, &vec![0.0; picture(2).len()]);
        }
        assert!(small.first(2).iter().all(|value| *value == 0.0));
    }
}
