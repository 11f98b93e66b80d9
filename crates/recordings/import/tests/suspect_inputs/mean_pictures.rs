//! Tests of arrays beside pictures that are not samples: a mean background, or the picture without contact.

use super::{case, lab};
use taceva_import::MapDraft;

/// NumPy archive with one stored array.
fn npz(name: &str, array: &[u8]) -> Vec<u8> {
    let crc = !array.iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())
        })
    });
    let length = u32::try_from(array.len()).expect("small").to_le_bytes();
    let of_name = u16::try_from(name.len()).expect("short").to_le_bytes();
    let member = [
        &[20, 0, 0, 0, 0, 0, 0, 0, 0x21, 0][..],
        &crc.to_le_bytes()[..],
        &length[..],
        &length[..],
        &of_name[..],
        &[0, 0][..],
    ]
    .concat();
    let head = [&b"PK\x03\x04"[..], &member[..], name.as_bytes(), array].concat();
    let directory = [
        &b"PK\x01\x02\x14\0"[..],
        &member[..],
        &[0; 14][..],
        name.as_bytes(),
    ]
    .concat();
    let [size, start] =
        [&directory, &head].map(|part| u32::try_from(part.len()).expect("small").to_le_bytes());
    let end = [
        &b"PK\x05\x06"[..],
        &[0, 0, 0, 0, 1, 0, 1, 0][..],
        &size[..],
        &start[..],
        &[0, 0][..],
    ]
    .concat();
    [head, directory, end].concat()
}

#[test]
fn a_mean_background_in_any_form_name_and_folder_is_no_table_of_pictures() {
    let from = case("draft-takes-array-for-table");
    let read = |name: &str| std::fs::read(from.join(name)).expect("there");
    let mean = read("background.npy");
    for (array, bytes, pictures, rows) in [
        (
            "background.npz",
            npz("mean.npy", &mean),
            "frame_",
            "frame_*.png",
        ),
        ("img/mean.npy", mean.clone(), "img/00", "img/*.png"),
        ("zero.npy", mean.clone(), "touch_", "touch_*.png"),
    ] {
        let folder = lab(&[]);
        let write = |name: &str, bytes: &[u8]| {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().expect("inside")).expect("made");
            std::fs::write(path, bytes).expect("written");
        };
        write(array, &bytes);
        for number in 1..=6 {
            let picture = read(&format!("frame_{number}.png"));
            write(&format!("{pictures}{number}.png"), &picture);
        }
        let draft = MapDraft::of(folder.path()).expect(array).text().to_owned();
        let line = format!("table = {{ files = \"{rows}\" }}");
        assert!(draft.contains(&line), "{draft}");
        assert!(
            draft.contains(array) && draft.contains("`reference`"),
            "{draft}"
        );
        assert!(!draft.contains("[signals]"), "{draft}");
    }
}
