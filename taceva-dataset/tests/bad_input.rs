//! Whatever a stranger's folder holds, it is refused in words and nothing is written.

mod lab;

use std::fs;

use lab::{Lab, MAP, jpeg, png, rgb_png};
use taceva_dataset::{Dataset, DatasetError, ImportMap};

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

/// A PNG that promises many pixels in few bytes.
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
    lab.is_refused_with(&["line 2", "more than the 268435456"]);
}

#[test]
fn paths_out_of_the_folder_are_not_followed() {
    let lab = Lab::new();
    lab.write("secret.png", &png(8, 6, 0));
    let good = fs::read_to_string(lab.path("source/labels.csv")).expect("read");
    let absolute = lab.path("secret.png");
    for (path, word) in [
        ("../secret.png", "`..` is not followed"),
        ("images/../../secret.png", "`..` is not followed"),
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
    lab.is_refused_with(&["line 5, column `file`", "through a link"]);
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
    lab.is_refused_with(&["line 5, column `file`", "through a link"]);
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
fn a_missing_column_lists_those_there_are_and_suggests_one() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"force\"", "\"forse\"");
    lab.is_refused_with(&[
        "labels.csv: no column `forse`, did you mean `force`?",
        "the columns are file, name",
    ]);
}

#[test]
fn a_label_that_is_no_finite_number_names_its_place() {
    for (cell, word) in [
        ("abc", "`abc` is no finite number"),
        ("NaN", "`NaN` is no finite number"),
        ("inf", "`inf` is no finite number"),
        ("1e400", "`1e400` is no finite number"),
        ("\"1,234.5\"", "thousands separators"),
        ("1 234", "thousands separators"),
    ] {
        let lab = Lab::new();
        lab.replace("source/labels.csv", "1236.5", cell);
        lab.is_refused_with(&["labels.csv, line 4, column `depth`", word]);
    }
}

#[test]
fn an_empty_cell_is_an_absent_value() {
    let lab = Lab::new();
    lab.replace("source/labels.csv", "1236.5", "");
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let depth = dataset.table().channels().position("Pz").expect("there");
    assert_eq!(dataset.table().truth(depth).get(2), None);
    assert_eq!(dataset.table().truth(depth).get(3), Some(1.2375));
}

#[test]
fn a_name_given_twice_is_refused() {
    let lab = Lab::new();
    lab.replace("source/labels.csv", "press 3", "press 1");
    lab.is_refused_with(&[
        "line 5, column `name`",
        "`press 1` is the name of an earlier row",
    ]);
}

#[test]
fn ids_of_the_wrong_kind_are_refused() {
    let lab = Lab::new();
    lab.replace("source/labels.csv", "2.0,load", "2.5,load");
    lab.is_refused_with(&["line 4, column `repeat`", "expected a whole number"]);
    let lab = Lab::new();
    lab.replace("source/labels.csv", "2.0,load", "2,hold");
    lab.is_refused_with(&["line 4, column `phase`", "expected `load` or `unload`"]);
}

#[test]
fn a_row_of_another_length_is_refused() {
    let lab = Lab::new();
    lab.replace("source/labels.csv", "press 3,", "press 3,,");
    lab.is_refused_with(&["labels.csv, line 5: 12 cells, expected 11"]);
}

#[test]
fn tables_in_other_encodings_are_refused_in_words() {
    let lab = Lab::new();
    let text = fs::read_to_string(lab.path("source/labels.csv")).expect("read");
    let utf16: Vec<u8> = std::iter::once(0xfeff)
        .chain(text.encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    lab.write("source/labels.csv", &utf16);
    lab.is_refused_with(&["labels.csv, line 1: UTF-16 or binary"]);
    lab.write("source/labels.csv", b"file,name\na,\xe9\n");
    lab.is_refused_with(&["labels.csv, line 2: not UTF-8"]);
    lab.write("source/labels.csv", b"");
    lab.is_refused_with(&["line 1: empty, expected a header"]);
    lab.write("source/labels.csv", b"a,\"b\nc,d\n");
    lab.is_refused_with(&["a quote is opened and never closed"]);
    lab.write("source/labels.csv", b"a,b,a\n1,2,3\n");
    lab.is_refused_with(&["line 1: the column `a` comes twice"]);
}

#[test]
fn marks_line_ends_and_delimiters_make_no_difference() {
    let lab = Lab::new();
    let expected = lab.import_to("plain", 1).expect("imported").digest;
    let text = fs::read_to_string(lab.path("source/labels.csv"))
        .expect("read")
        .replace("bad;worse", "bad worse");
    let variants = [
        format!("\u{feff}{text}"),
        text.replace('\n', "\r\n"),
        text.replace("\"clip, ", "\"clip# ")
            .replace(',', ";")
            .replace("clip#", "clip,"),
        text.replace("\"clip, ", "\"clip# ")
            .replace(',', "\t")
            .replace("clip#", "clip,"),
        text.replace('\n', "\n\n"),
    ];
    for (number, variant) in variants.iter().enumerate() {
        lab.write("source/labels.csv", variant.as_bytes());
        let report = lab.import_to(&number.to_string(), 1).expect("imported");
        assert_eq!(report.digest, expected, "{variant}");
    }
}

#[test]
fn an_existing_target_is_never_written_over() {
    let lab = Lab::new();
    fs::create_dir(lab.path("set")).expect("created");
    lab.write("set/precious", b"x");
    lab.is_refused_with(&["exists already"]);
    assert!(lab.path("set/precious").exists());
}

#[test]
fn a_dataset_of_a_newer_major_is_refused_and_says_so() {
    let lab = Lab::new();
    lab.import().expect("imported");
    lab.replace("set/dataset.toml", "format = \"1.0\"", "format = \"2.3\"");
    let error = Dataset::open(&lab.path("set")).expect_err("newer");
    assert!(matches!(error, DatasetError::Version { .. }));
    assert!(
        error
            .to_string()
            .contains("format 2.3 needs a newer TacEva"),
        "{error}"
    );
}

#[test]
fn a_map_with_an_unknown_key_names_line_and_nearest_key() {
    let lab = Lab::new();
    lab.write(
        "map.toml",
        MAP.replace("channel_order", "chanel_order").as_bytes(),
    );
    lab.is_refused_with(&["map.toml, line 6", "did you mean `channel_order`?"]);
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

#[test]
fn numbers_off_by_a_thousand_are_imported_with_a_warning() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"mN\"", "\"N\"");
    let report = lab.import().expect("imported");
    let codes: Vec<&str> = report
        .summary
        .suspicions
        .iter()
        .map(|one| one.code)
        .collect();
    assert_eq!(codes, ["magnitude-large"]);
    assert!(
        report
            .to_string()
            .contains("warning  magnitude-large: `Fz`"),
        "{report}"
    );
}

#[test]
fn images_that_no_row_names_are_counted_and_listed() {
    let lab = Lab::new();
    for number in 0..25 {
        lab.write(&format!("source/images/extra {number:02}.jpg"), b"x");
    }
    let summary = lab.import().expect("imported").summary;
    assert_eq!(
        (summary.unnamed_images, summary.first_unnamed_images.len()),
        (25, 20)
    );
    assert!(summary.first_unnamed_images[0].ends_with("extra 00.jpg"));
    assert_eq!(summary.dropped.get("bad"), Some(&1));
    assert_eq!((summary.rows_read, summary.rows_kept), (6, 5));
}

#[test]
fn a_map_whose_table_is_missing_or_matches_nothing_is_refused() {
    let lab = Lab::new();
    lab.write(
        "map.toml",
        MAP.replace("labels.csv", "other.csv").as_bytes(),
    );
    lab.is_refused_with(&["`other.csv`: no such file"]);
    lab.write(
        "map.toml",
        MAP.replace("labels.csv", "run_*/labels.csv").as_bytes(),
    );
    lab.is_refused_with(&["`run_*/labels.csv`: matches nothing"]);
}

#[test]
fn maps_are_read_from_files_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let error = ImportMap::read(folder.path()).expect_err("a folder");
    assert!(error.to_string().contains("not a regular file"), "{error}");
}
