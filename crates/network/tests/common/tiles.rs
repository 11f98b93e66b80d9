//! Networks of convolutions of 3 × 3 that keep the size of pictures: what Winograd's form is for.

use taceva_network::{Architecture, Body, Picture, PlainLayer, Pooling};

pub(crate) const fn picture(height: usize, width: usize, channels: usize) -> Picture {
    Picture {
        height,
        width,
        channels,
    }
}

/// A network with so many channels in each of its layers.
pub(crate) fn same_size<const LAYERS: usize>(
    input: Picture,
    channels: [usize; LAYERS],
) -> Architecture {
    let layer = |channels| PlainLayer {
        channels,
        kernel: 3,
        stride: 1,
    };
    Architecture {
        input,
        body: Body::Plain {
            layers: channels.map(layer).to_vec(),
            pooling: Pooling::Average,
        },
        outputs: 2,
    }
}
