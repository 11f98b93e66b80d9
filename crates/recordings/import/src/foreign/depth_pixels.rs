//! Converts the codes of a depth map to pixels.

use taceva_tables::DepthCodes;

use crate::frame_names::PixelRange;

/// Pixel for each code of a depth map: the distance in whole millimetres, or in the range of a map.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DepthPixels {
    /// Pixel of each code; `None` for a distance outside the range.
    pixels: Vec<Option<u16>>,
    codes: DepthCodes,
    range: PixelRange,
}

impl DepthPixels {
    /// Pixels of `codes` in `range`, mm. Without a range, pixels are whole millimetres, and an error is returned for distances that whole millimetres
    /// cannot represent.
    pub(crate) fn new(codes: DepthCodes, range: Option<PixelRange>) -> Result<DepthPixels, String> {
        let [least, greatest] = codes.ends_mm();
        let whole = PixelRange::new([0.0, 65_535.0], 16)
            .filter(|range| !codes.is_finer_than_millimetres() && range.pixel(greatest).is_some());
        let range = range.or(whole).ok_or_else(|| {
            format!(
                "a depth map from {least} mm to {greatest} mm, which whole millimetres of 16 bits cannot represent: write `range = \
                 [{least}, {greatest}]` and `bits = 16` under [frame], the distances of black and of full in mm"
            )
        })?;
        let pixels = (0..).map_while(|code| codes.millimetres(code));
        Ok(DepthPixels {
            pixels: pixels.map(|distance| range.pixel(distance)).collect(),
            codes,
            range,
        })
    }

    /// Bits of a pixel: 8 or 16.
    pub(crate) fn bits(&self) -> u8 {
        self.range.bits()
    }

    /// Converts codes of `bits` bits to pixels.
    pub(crate) fn of(&self, codes: &[u16], bits: u32) -> Result<Vec<u16>, String> {
        if bits != 12 {
            return Err(format!(
                "a depth map of {bits} bits, expected 12 (gray12le): the clip was re-encoded, or another program wrote it"
            ));
        }
        let pixel = |code: &u16| {
            let known = self.pixels.get(usize::from(*code)).copied();
            known.flatten().ok_or_else(|| {
                let [black, full] = self.range.ends();
                match self.codes.millimetres(*code) {
                    Some(distance) => format!(
                        "{distance:.3} mm (code {code}) is outside of `range = [{black}, {full}]`"
                    ),
                    None => format!("depth code {code} exceeds 4095"),
                }
            })
        };
        codes.iter().map(pixel).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn codes(ends: [f64; 2], shift: f64) -> DepthCodes {
        DepthCodes::new(ends, shift, true).expect("a range")
    }

    #[test]
    fn codes_are_whole_millimetres_unless_they_are_finer() {
        let pixels = DepthPixels::new(codes([0.01, 10.0], 3.5), None).expect("coarse");
        assert_eq!(pixels.of(&[0, 9, 4095], 12), Ok(vec![10, 20, 10_000]));
        assert!(pixels.of(&[4096], 12).is_err() && pixels.of(&[0], 10).is_err());
        for fine in [codes([0.01, 0.1], 0.0), codes([1.0, 100.0], 0.0)] {
            let refused = DepthPixels::new(fine, None).expect_err("whole millimetres lose it");
            assert!(refused.contains("`range = ["), "{refused}");
        }
    }

    #[test]
    fn a_range_keeps_fine_codes_and_refuses_those_outside() {
        let range = PixelRange::new([10.0, 60.0], 16);
        let pixels = DepthPixels::new(codes([0.01, 0.1], 0.0), range).expect("a range");
        let near = pixels.of(&[0, 1], 12).expect("inside");
        assert!(near[0] == 0 && near[1] > 5, "{near:?}");
        let refused = pixels.of(&[4095], 12).expect_err("100 mm");
        assert!(refused.contains("100.000 mm (code 4095)"), "{refused}");
    }
}
