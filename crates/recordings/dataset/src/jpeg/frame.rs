//! Frame header of a JPEG, and the coefficient bits that the parsed scans code.

use super::bits::big_endian;

/// A colour component.
#[derive(Clone, Debug)]
pub(super) struct Component {
    pub(super) id: u8,
    /// Blocks across and down in a minimum coded unit (MCU) of an interleaved scan.
    pub(super) sampling: [usize; 2],
    /// Number of the quantisation table.
    pub(super) quantiser: u8,
    /// Blocks across and down, including the padding of the last minimum coded unit.
    pub(super) padded: [usize; 2],
    /// Blocks across and down without padding.
    pub(super) blocks: [usize; 2],
    /// For each block of a progressive frame, a bit mask of its nonzero coefficients.
    pub(super) nonzero: Vec<u64>,
    /// For each coefficient, the number of its low bits not coded yet; `None` if no scan coded it.
    pub(super) missing: [Option<u8>; 64],
}

/// Frame header of a picture, with the coding state of each component.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) is_progressive: bool,
    /// Minimum coded units of an interleaved scan, across and down.
    pub(super) units: [usize; 2],
    pub(super) components: Vec<Component>,
}

impl Frame {
    /// Parses the frame header from the segment `body`.
    pub(super) fn parse(body: &[u8], is_progressive: bool) -> Result<Frame, String> {
        let cut = || "the frame header is truncated".to_owned();
        let [precision, _, _, _, _, count, rest @ ..] = body else {
            return Err(cut());
        };
        let (height, width) = (big_endian(&body[1..3]), big_endian(&body[3..5]));
        if *precision != 8 || width == 0 || height == 0 {
            return Err(format!(
                "a picture of {width}×{height} pixels of {precision} bits, expected sides of at least 1 and 8 bits"
            ));
        }
        let (coded, more) = rest.as_chunks::<3>();
        if coded.len() != usize::from(*count) || !more.is_empty() || coded.is_empty() {
            return Err(cut());
        }
        let sampling: Vec<[usize; 2]> = coded
            .iter()
            .map(|[_, sampling, _]| [usize::from(sampling >> 4), usize::from(sampling & 15)])
            .collect();
        if sampling
            .iter()
            .flatten()
            .any(|factor| !(1..=4).contains(factor))
        {
            return Err("a sampling factor outside of 1 to 4".to_owned());
        }
        let greatest = |axis: usize| {
            sampling
                .iter()
                .map(|factors| factors[axis])
                .max()
                .unwrap_or(1)
        };
        let greatest = [greatest(0), greatest(1)];
        let size = [width, height];
        let units = [0, 1].map(|axis| size[axis].div_ceil(8 * greatest[axis]));
        let components = coded
            .iter()
            .zip(&sampling)
            .map(|([id, _, quantiser], sampling)| {
                let padded = [0, 1].map(|axis| units[axis] * sampling[axis]);
                Component {
                    id: *id,
                    sampling: *sampling,
                    quantiser: *quantiser,
                    padded,
                    blocks: [0, 1].map(|axis| {
                        (size[axis] * sampling[axis])
                            .div_ceil(greatest[axis])
                            .div_ceil(8)
                    }),
                    nonzero: match is_progressive {
                        true => vec![0; padded[0] * padded[1]],
                        false => Vec::new(),
                    },
                    missing: [None; 64],
                }
            });
        Ok(Frame {
            is_progressive,
            units,
            components: components.collect(),
        })
    }

    /// Checks that every coefficient was coded to its last bit.
    pub(super) fn check_complete(&self) -> Result<(), String> {
        let mut missing = self
            .components
            .iter()
            .flat_map(|component| &component.missing);
        if missing.all(|bits| *bits == Some(0)) {
            Ok(())
        } else {
            Err("scans are missing: the picture is not coded to its last bit".to_owned())
        }
    }
}
