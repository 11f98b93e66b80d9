//! Digests of the sixty cells: every fault with the five parameters of its table. A changed digest is another fault, so its list needs a new version.

use taceva_core::{Frame, PixelFormat};
use taceva_dataset::Digest;
use taceva_stress::{FAULTS, Stress};

use crate::drawing::{picture, press};

/// First sixteen digits of the digest of each fault, over its five parameters in gray and in colour. The test prints the rows if they differ.
const GOLDEN: [(&str, &str); 12] = [
    ("defocus", "16ece641ee79781a"),
    ("dead_pixels", "87b84580c6aa6c8a"),
    ("exposure_low", "3d9cc32da6347d85"),
    ("exposure_high", "7fe7f5f8b0354f9c"),
    ("sensor_noise", "38c3a51f818b91af"),
    ("cable_noise", "6ca4c242d422f0a5"),
    ("camera_shift", "6cf3a01c475b1e26"),
    ("led_loss", "c3c4f055536c4aa3"),
    ("scratches", "3f9ab1e610b37d34"),
    ("tear", "ac7f7e560caa10c1"),
    ("dust", "8b52d442df7f7eba"),
    ("stale_frames", "5303e7c267a48cc1"),
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
