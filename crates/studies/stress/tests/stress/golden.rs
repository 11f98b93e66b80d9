//! Tests of the digests of twelve faults, each with the five parameters of its table. If a digest changes, the list of faults needs a new version.

use std::process::Command;

use taceva_core::{Frame, Isa, PixelFormat};
use taceva_dataset::Digest;
use taceva_stress::{FAULTS, Fault, Stress};

use crate::drawing::{picture, press};

/// First sixteen digits of the digest of each fault, over its five parameters in gray and in colour. A failing test prints the new rows.
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

/// Synthetic RGB picture of 16 bits, which depends on `number`.
fn coloured(number: u32) -> Frame {
    picture([20, 14], PixelFormat::Rgb16, |x, y| {
        f64::from((x * 37 + y * 101 + number * 53) % 97) / 97.0
    })
}

/// First sixteen digits of the digest of pictures with `fault`, over its five parameters.
fn digits(fault: &'static Fault) -> String {
    let pairs = [
        [press(1.0, 9.0, 3), press(0.5, 4.0, 2)],
        [coloured(1), coloured(2)],
    ];
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
    digits[..16].to_owned()
}

/// Name of the test that other processes run.
const SIXTY: &str = "golden::digests_of_the_sixty_cells_are_the_golden_ones";

#[test]
fn digests_of_the_sixty_cells_are_the_golden_ones() {
    let rows = FAULTS.map(|fault| (fault.id, digits(fault)));
    let found = rows.each_ref().map(|(id, digits)| (*id, digits.as_str()));
    let lines = found.map(|row| format!("    {row:?},\n"));
    assert_eq!(
        found,
        GOLDEN,
        "expected rows of GOLDEN:\n{}",
        lines.concat()
    );
}

/// Starts one process for each instruction set, because a process selects its set only once.
#[test]
fn digests_of_the_sixty_cells_are_the_golden_ones_by_every_instruction_set_of_the_machine() {
    let program = std::env::current_exe().expect("this program");
    for isa in Isa::available() {
        let mut command = Command::new(&program);
        command
            .args(["--exact", SIXTY])
            .env("TACEVA_ISA", isa.name());
        let output = command.output().expect("this program runs");
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{isa}: {text}");
        assert!(text.contains("1 passed"), "{isa}: {text}");
    }
}

#[test]
fn digests_of_the_sixty_cells_are_the_golden_ones_in_any_order_and_by_sixteen_threads() {
    std::thread::scope(|scope| {
        for first in 0..16 {
            scope.spawn(move || {
                for place in 0..FAULTS.len() {
                    let at = (5 * place + first) % FAULTS.len();
                    let found = (FAULTS[at].id, digits(FAULTS[at]));
                    assert_eq!((found.0, found.1.as_str()), GOLDEN[at]);
                }
            });
        }
    });
}
