//! Pixel layouts of raw frames, by the names that ffmpeg uses for pixel formats.

/// Pixel layout of a raw frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// Luma plane and two chroma planes, with one byte per sample, or two bytes in little-endian order.
    Planar {
        shifts: [u32; 2],
        bits: u32,
        is_full_range: bool,
    },
    /// Luma plane, then a plane of chroma pairs, with red first if `is_red_first`.
    Paired { is_red_first: bool },
    /// Luma and chroma of two pixels in four bytes, with the offsets of luma, blue chroma and red chroma.
    Woven {
        luma: usize,
        blue: usize,
        red: usize,
    },
    /// Luma plane only.
    Gray { bits: u32 },
    /// Pixels of `step` bytes, with the offsets of red, green and blue.
    Packed { step: usize, order: [usize; 3] },
    /// Planes of green, blue and red, with one byte per sample.
    Planes,
}

impl Layout {
    /// Layout of the format `name`; `None` if it is not supported.
    pub(super) fn of(name: &str) -> Option<Layout> {
        if let Some(planar) = planar(name) {
            return Some(planar);
        }
        Some(match name {
            "gray" | "gray8" => Layout::Gray { bits: 8 },
            "gray10le" | "gray12le" | "gray14le" | "gray16le" => Layout::Gray {
                bits: bits_of(&name[4..])?,
            },
            "nv12" => Layout::Paired {
                is_red_first: false,
            },
            "nv21" => Layout::Paired { is_red_first: true },
            "yuyv422" => Layout::Woven {
                luma: 0,
                blue: 1,
                red: 3,
            },
            "yvyu422" => Layout::Woven {
                luma: 0,
                blue: 3,
                red: 1,
            },
            "uyvy422" => Layout::Woven {
                luma: 1,
                blue: 0,
                red: 2,
            },
            "rgb24" => Layout::Packed {
                step: 3,
                order: [0, 1, 2],
            },
            "bgr24" => Layout::Packed {
                step: 3,
                order: [2, 1, 0],
            },
            "rgb0" | "rgba" => Layout::Packed {
                step: 4,
                order: [0, 1, 2],
            },
            "bgr0" | "bgra" => Layout::Packed {
                step: 4,
                order: [2, 1, 0],
            },
            "0rgb" | "argb" => Layout::Packed {
                step: 4,
                order: [1, 2, 3],
            },
            "0bgr" | "abgr" => Layout::Packed {
                step: 4,
                order: [3, 2, 1],
            },
            "gbrp" => Layout::Planes,
            _ => return None,
        })
    }

    /// Size of a frame, bytes; `None` on overflow, or if the layout does not allow the width.
    pub(super) fn frame_bytes(self, width: u32, height: u32) -> Option<usize> {
        let (width, height) = (width as usize, height as usize);
        let pixels = width.checked_mul(height)?;
        match self {
            Layout::Planar { shifts, bits, .. } => {
                let chroma =
                    chroma_side(width, shifts[0]).checked_mul(chroma_side(height, shifts[1]))?;
                chroma
                    .checked_mul(2)?
                    .checked_add(pixels)?
                    .checked_mul(bytes_of(bits))
            }
            Layout::Paired { .. } => chroma_side(width, 1)
                .checked_mul(chroma_side(height, 1))?
                .checked_mul(2)?
                .checked_add(pixels),
            Layout::Woven { .. } if width % 2 == 1 => None,
            Layout::Woven { .. } => pixels.checked_mul(2),
            Layout::Gray { bits } => pixels.checked_mul(bytes_of(bits)),
            Layout::Packed { step, .. } => pixels.checked_mul(step),
            Layout::Planes => pixels.checked_mul(3),
        }
    }
}

/// Number of chroma samples along a side of `length` luma samples.
pub(super) fn chroma_side(length: usize, shift: u32) -> usize {
    length.div_ceil(1 << shift)
}

/// Size of a sample, bytes.
pub(super) fn bytes_of(bits: u32) -> usize {
    if bits > 8 { 2 } else { 1 }
}

/// Parses a planar format such as `yuv420p`, `yuvj422p` or `yuv444p10le`.
fn planar(name: &str) -> Option<Layout> {
    let (is_full_range, rest) = match name.strip_prefix("yuvj") {
        Some(rest) => (true, rest),
        None => (false, name.strip_prefix("yuv")?),
    };
    let (sampling, depth) = rest.split_once('p')?;
    let shifts = match sampling {
        "420" => [1, 1],
        "422" => [1, 0],
        "444" => [0, 0],
        "440" => [0, 1],
        "411" => [2, 0],
        "410" => [2, 2],
        _ => return None,
    };
    let bits = if depth.is_empty() { 8 } else { bits_of(depth)? };
    Some(Layout::Planar {
        shifts,
        bits,
        is_full_range,
    })
}

/// Bits of a sample in a suffix such as `10le`.
fn bits_of(depth: &str) -> Option<u32> {
    let bits: u32 = depth.strip_suffix("le")?.parse().ok()?;
    (9..=16).contains(&bits).then_some(bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_how_large_a_frame_is() {
        for (name, width, height, expected) in [
            ("yuv420p", 64, 48, 4608),
            ("yuv420p", 3, 3, 9 + 2 * 4),
            ("yuvj422p", 5, 2, 10 + 2 * 6),
            ("yuv444p10le", 4, 4, 96),
            ("yuv410p", 5, 5, 25 + 2 * 4),
            ("nv12", 3, 3, 17),
            ("yuyv422", 4, 2, 16),
            ("gray", 7, 3, 21),
            ("gray16le", 7, 3, 42),
            ("bgr0", 64, 48, 12_288),
            ("rgb24", 3, 1, 9),
            ("gbrp", 3, 1, 9),
        ] {
            let layout = Layout::of(name).expect(name);
            assert_eq!(layout.frame_bytes(width, height), Some(expected), "{name}");
        }
        for unknown in [
            "pal8",
            "yuv420p10be",
            "yuva420p",
            "p010le",
            "yuv420p7le",
            "gbrp10le",
            "",
        ] {
            assert_eq!(Layout::of(unknown), None, "{unknown}");
        }
        assert_eq!(
            Layout::of("yuyv422").and_then(|layout| layout.frame_bytes(3, 3)),
            None
        );
    }
}
