//! Networks of 3 × 3 convolutions that keep the size of pictures, for tests of Winograd's algorithm.

use taceva_network::{Architecture, Body, Picture, PlainLayer, Pooling};

pub(crate) const fn picture(height: usize, width: usize, channels: usize) -> Picture {
    Picture {
        height,
        width,
        channels,
    }
}

/// Network with the given number of channels in each layer.
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
