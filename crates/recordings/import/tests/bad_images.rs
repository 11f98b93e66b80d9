//! Tests that damaged, too large, misplaced or unequal pictures are rejected with a message, and that nothing is written.

use std::fs;

use crate::lab::{Lab, MAP, jpeg, png, rgb_png};
use taceva_dataset::internal::decode;
use taceva_dataset::{ChannelOrder, Dataset};

#[test]
fn a_missing_image_names_the_row_and_the_column() {
    let lab = Lab::new();
    fs::remove_file(lab.path("source/images/2.png")).expect("removed");
    lab.is_refused_with(&[
        "labels.csv, line 4, column `file`",
        "images/2.png",
        "no such file",
    ]);
}

#[test]
fn an_empty_image_cell_names_the_row() {
    let lab = Lab::new();
    lab.replace("source/labels.csv", "images/1.png", "");
    lab.is_refused_with(&["line 3, column `file`", "empty, expected a path"]);
}

#[test]
fn a_png_truncated_anywhere_is_refused() {
    let whole = png(8, 6, 1);
    for end in 0..whole.len() {
        let lab = Lab::new();
        lab.write("source/images/1.png", &whole[..end]);
        lab.is_refused_with(&["labels.csv, line 3", "1.png"]);
    }
}

#[test]
fn a_jpeg_truncated_at_every_third_byte_is_refused() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"gray\"", "\"rgb\"");
    let whole = jpeg(40, 30, 1);
    for end in (0..whole.len()).step_by(3) {
        lab.write("source/images/0.png", &whole[..end]);
        lab.is_refused_with(&["labels.csv, line 2", "0.png"]);
    }
}

#[test]
fn a_flipped_bit_never_imports_a_png_with_other_pixels() {
    let original = png(8, 6, 1);
    let pixels = image::load_from_memory(&original)
        .expect("decodes")
        .into_bytes();
    let lab = Lab::new();
    for at in 0..original.len() {
        let mut flipped = original.clone();
        flipped[at] ^= 1 << (at % 8);
        lab.write("source/images/1.png", &flipped);
        if lab.import().is_ok() {
            let dataset = Dataset::open(&lab.path("set")).expect("opens");
            let frame = dataset.frame(1).expect("decodes").expect("there");
            assert_eq!(frame.bytes(), pixels, "byte {at}");
            fs::remove_dir_all(lab.path("set")).expect("removed");
        }
    }
}

#[test]
fn a_picture_bomb_is_refused_before_it_is_unpacked() {
    let lab = Lab::new();
    lab.write("source/images/0.png", &bomb(30_000, 30_000));
    lab.is_refused_with(&["line 2, column `file`", "0.png"]);
    lab.write("source/images/0.png", &bomb(16_384, 16_384 + 1));
    lab.is_refused_with(&["line 2, column `file`"]);
}

#[test]
fn a_small_picture_that_becomes_very_many_pixels_is_refused_and_a_flat_one_of_a_camera_is_not() {
    let lab = Lab::new();
    lab.write("source/images/0.png", &flat(8_000, 8_000));
    lab.is_refused_with(&[
        "line 2, column `file`",
        "64000000 bytes when decoded",
        "write it with less compression",
    ]);
    let camera = flat(3_840, 2_160);
    let (_, frame) = decode(&camera, ChannelOrder::Gray).expect("a flat picture");
    assert_eq!(frame.info().width, 3_840);
}

/// PNG of a black picture of `width` × `height` pixels.
fn flat(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture = image::GrayImage::new(width, height);
    let written = picture.write_to(&mut bytes, image::ImageFormat::Png);
    written.expect("encoded");
    bytes.into_inner()
}

/// PNG that declares many pixels in few bytes.
fn bomb(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = png(8, 6, 0);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let check = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&check.to_be_bytes());
    bytes
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            sum >> 1 ^ if sum & 1 == 1 { 0xedb8_8320 } else { 0 }
        })
    })
}

#[test]
fn a_jpeg_bomb_is_refused() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"gray\"", "\"rgb\"");
    let mut bytes = jpeg(40, 30, 1);
    let frame = bytes
        .windows(2)
        .position(|pair| pair == [0xff, 0xc0])
        .expect("a frame header");
    bytes[frame + 5..frame + 9].copy_from_slice(&[0xff, 0xff, 0xff, 0xff]);
    lab.write("source/images/0.png", &bytes);
    lab.is_refused_with(&["line 2, column `file`", "0.png"]);
}

#[test]
fn an_image_file_beyond_the_byte_cap_is_refused() {
    let lab = Lab::new();
    let file = fs::File::create(lab.path("source/images/0.png")).expect("created");
    file.set_len((256 << 20) + 1).expect("sparse");
    lab.is_refused_with(&["line 2", "expected at most 268435456"]);
}

#[test]
fn paths_out_of_the_folder_are_not_followed() {
    let lab = Lab::new();
    lab.write("secret.png", &png(8, 6, 0));
    let good = fs::read_to_string(lab.path("source/labels.csv")).expect("read");
    let absolute = lab.path("secret.png");
    for (path, word) in [
        ("../secret.png", "contains `..`"),
        ("images/../../secret.png", "contains `..`"),
        (absolute.to_str().expect("text"), "absolute"),
    ] {
        lab.write(
            "source/labels.csv",
            good.replace("images/3.png", path).as_bytes(),
        );
        lab.is_refused_with(&["labels.csv, line 5, column `file`", word]);
    }
}

#[cfg(unix)]
#[test]
fn a_link_out_of_the_folder_is_not_followed_and_one_inside_is() {
    let lab = Lab::new();
    lab.write("secret.png", &png(8, 6, 0));
    let link = lab.path("source/images/3.png");
    fs::remove_file(&link).expect("removed");
    std::os::unix::fs::symlink(lab.path("secret.png"), &link).expect("linked");
    lab.is_refused_with(&["line 5, column `file`", "a link leads out"]);
    fs::remove_file(&link).expect("removed");
    std::os::unix::fs::symlink("2.png", &link).expect("linked");
    lab.import().expect("a link inside");
    let copy = fs::symlink_metadata(lab.path("set/frames/0000/000003.png")).expect("there");
    assert!(copy.is_file());
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_refused_without_waiting() {
    let lab = Lab::new();
    let path = lab.path("source/images/3.png");
    fs::remove_file(&path).expect("removed");
    fs::create_dir(&path).expect("created");
    lab.is_refused_with(&["line 5, column `file`", "not a regular file"]);
    fs::remove_dir(&path).expect("removed");
    let made = std::process::Command::new("mkfifo").arg(&path).status();
    assert!(made.expect("mkfifo runs").success());
    lab.is_refused_with(&["line 5, column `file`", "not a regular file"]);
    fs::remove_file(&path).expect("removed");
    std::os::unix::fs::symlink("/dev/zero", &path).expect("linked");
    lab.is_refused_with(&["line 5, column `file`", "a link leads out"]);
}

#[test]
fn a_size_that_changes_within_the_set_names_the_row() {
    let lab = Lab::new();
    lab.write("source/images/3.png", &png(9, 6, 0));
    lab.is_refused_with(&["line 5, column `file`", "9×6 gray8, expected png 8×6 gray8"]);
}

#[test]
fn a_file_format_that_changes_within_the_set_names_the_row() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"gray\"", "\"rgb\"");
    for row in 0..5 {
        lab.write(&format!("source/images/{row}.png"), &rgb_png(8, 6, row));
    }
    lab.write("source/images/4.png", &jpeg(8, 6, 4));
    lab.is_refused_with(&[
        "line 6, column `file`",
        "jpg 8×6 rgb8, expected png 8×6 rgb8",
    ]);
}

#[test]
fn an_image_of_another_format_is_refused() {
    let lab = Lab::new();
    lab.write("source/images/0.png", b"GIF89a and more");
    lab.is_refused_with(&["line 2, column `file`", "neither PNG nor JPEG"]);
}

#[test]
fn a_reference_frame_must_be_there_and_be_alike() {
    let lab = Lab::new();
    lab.write(
        "map.toml",
        MAP.replace("reference = \"unknown\"", "reference = \"none.png\"")
            .as_bytes(),
    );
    lab.is_refused_with(&["`none.png`: no such file"]);
    lab.write("source/none.png", &png(9, 9, 0));
    lab.is_refused_with(&["none.png: 9×9 gray8, expected 8×6 gray8"]);
    lab.write("source/none.png", &png(8, 6, 77));
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    assert!(dataset.reference().expect("decodes").is_some());
}
