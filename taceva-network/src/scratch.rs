//! Memory that passes lend each other.

use crate::panel::Aligned;
use crate::planes::{Picture, Planes};

/// Room that is used for a while and then by others.
#[derive(Debug)]
pub(crate) struct Scratch {
    batch: usize,
    spare: Vec<Planes>,
    /// Exchanged weights.
    pub(crate) exchanged: Aligned,
    /// The gradient of one convolution's weights.
    pub(crate) weight_gradient: Aligned,
}

impl Scratch {
    /// Room for batches of `batch` pictures and convolutions of up to `weights` weights.
    pub(crate) fn new(batch: usize, weights: usize) -> Scratch {
        Scratch {
            batch,
            spare: Vec::new(),
            exchanged: Aligned::zeros(weights),
            weight_gradient: Aligned::zeros(weights),
        }
    }

    /// A batch of pictures with a border of zeros and anything within.
    pub(crate) fn take(&mut self, picture: Picture, border: usize) -> Planes {
        let fits = |planes: &Planes| {
            planes.layout().picture == picture && planes.layout().border == border
        };
        match self.spare.iter().position(fits) {
            Some(position) => self.spare.swap_remove(position),
            None => Planes::zeros(picture, border, self.batch),
        }
    }

    /// Gives a batch back; its border is still zero.
    pub(crate) fn put(&mut self, planes: Planes) {
        self.spare.push(planes);
    }
}
