//! Digests of the sixty cells: every fault with the five parameters of its table. A changed digest is another fault, so its list needs a new version.

use taceva_core::{Frame, PixelFormat};
use taceva_dataset::Digest;
use taceva_stress::{FAULTS, Stress};

use crate::drawing::{picture, press};

/// First sixteen digits of the digest of each fault, over its five parameters in gray and in colour. The test prints the rows if they differ.
const GOLDEN: [(&str, &str); 12] = [
    ("defocus", "to be filled in"),
    ("dead_pixels", "to be filled in"),
    ("exposure_low", "to be filled in"),
    ("exposure_high", "to be filled in"),
    ("sensor_noise", "to be filled in"),
    ("cable_noise", "to be filled in"),
    ("camera_shift", "to be filled in"),
    ("led_loss", "to be filled in"),
    ("scratches", "to be filled in"),
    ("tear", "to be filled in"),
    ("dust", "to be filled in"),
    ("stale_frames", "to be filled in"),
];

/// A coloured picture of 16 bits, and the one before it.
fn coloured(number: u32) -> Frame {
    picture([20, 14], PixelFormat::Rgb16, |x, y| {
        f64::from((x * 37 + y * 101 + number * 53) % 97) / 97.0
    })
}

#[test]
fn digests_of_the_sixty_cells_are_the_golden_ones() {
    let pairs = [
        [press(1.0, 9.0, 3), press(0.5, 4.0, 2)],
        [coloured(1), coloured(2)],
    ];
    let rows = FAULTS.map(|fault| {
        let mut bytes = Vec::new();
        for parameter in fault.table {
            let stress = Stress::new(fault, parameter, 5);
            for [frame, before] in &pairs {
                for sample in 0..4 {
                    let changed = stress.apply(frame, &format!("s{sample}"), Some(before));
                    bytes.extend_from_slice(changed.bytes());
                }
            }
        }
        let digest = Digest::of(&bytes).to_string();
        let digits = digest.rsplit(':').next().unwrap_or_default();
        (fault.id, digits[..16].to_owned())
    });
    let found = rows.each_ref().map(|(id, digits)| (*id, digits.as_str()));
    let lines = found.map(|row| format!("    {row:?},\n"));
    assert_eq!(
        found,
        GOLDEN,
        "expected rows of GOLDEN:\n{}",
        lines.concat()
    );
}
