//! Where kernels meet the processor.

use super::noise::RowNoise;
use super::readout::{LANES, Readout};

/// [`Readout::row`].
pub(super) fn read_out<const BYTES: usize>(
    readout: &Readout,
    light: &[f32],
    noise: RowNoise,
    into: &mut [u8],
) -> [u32; LANES] {
    readout.row::<BYTES>(light, noise, into)
}
