//! Tests of content that MATLAB writes and Python libraries do not, and of errors.

use std::fs;

use taceva_arrays::{ArrayFile, ArrayFormat, ArrayValues};

use crate::digest::at;

/// MATLAB file of version 5 with one matrix, in either byte order.
fn file(is_big_endian: bool, class: u32, shape: [u32; 2], content: &[u8]) -> Vec<u8> {
    let word = |number: u32| {
        if is_big_endian {
            number.to_be_bytes()
        } else {
            number.to_le_bytes()
        }
    };
    let mut matrix = Vec::new();
    for number in [6, 8, class, 0, 5, 8, shape[0], shape[1]] {
        matrix.extend(word(number));
    }
    // One-letter name in the tag itself: length above type.
    matrix.extend(word(1 << 16 | 1));
    matrix.extend(b"x\0\0\0");
    matrix.extend(content);
    let mut file = vec![b' '; 124];
    file.extend(if is_big_endian {
        *b"\x01\x00MI"
    } else {
        *b"\x00\x01IM"
    });
    file.extend(word(14));
    file.extend(word(u32::try_from(matrix.len()).expect("short")));
    file.extend(matrix);
    file
}

fn opened(bytes: &[u8]) -> (ArrayFile, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("x.mat");
    fs::write(&path, bytes).expect("written");
    (
        ArrayFile::open(&path, ArrayFormat::Matlab).expect("opens"),
        folder,
    )
}

#[test]
fn doubles_that_matlab_stored_as_small_numbers_are_doubles() {
    // Class 6 is double. The content is unsigned 8-bit numbers: four in the tag itself, or more after it.
    let (four, _folder) = opened(&file(false, 6, [2, 2], b"\x02\0\x04\0\x01\x02\x03\xff"));
    let expected = ArrayValues::F64(vec![1.0, 3.0, 2.0, 255.0]);
    assert_eq!(four.read("x", 0..2).expect("reads").values, expected);
    let (six, _folder) = opened(&file(
        false,
        6,
        [2, 3],
        b"\x02\0\0\0\x06\0\0\0\x01\x02\x03\x04\x05\x06\0\0",
    ));
    let expected = ArrayValues::F64(vec![2.0, 4.0, 6.0]);
    assert_eq!(six.read("x", 1..2).expect("reads").values, expected);
}

#[test]
fn files_of_the_other_order_of_bytes_are_read() {
    let content = [
        &b"\0\0\0\x05\0\0\0\x08"[..],
        &7_i32.to_be_bytes(),
        &(-9_i32).to_be_bytes(),
    ]
    .concat();
    let (file, _folder) = opened(&file(true, 12, [1, 2], &content));
    assert_eq!(
        file.read("x", 0..1).expect("reads").values,
        ArrayValues::I32(vec![7, -9])
    );
}

#[test]
fn what_is_not_read_says_so_and_leaves_the_others_alone() {
    let path = at("refused/kinds.mat");
    let file = ArrayFile::open(&path, ArrayFormat::Matlab).expect("opens");
    assert_eq!(
        file.read("x", 0..3).expect("reads").values,
        ArrayValues::F64(vec![0.0, 1.0, 2.0])
    );
    for (name, expected) in [
        ("complex", "imag(x)"),
        ("sparse", "full(x)"),
        ("ragged", "different sizes"),
    ] {
        let message = file.read(name, 0..1).expect_err(name).to_string();
        assert!(message.contains(expected), "{name}: {message}");
    }
    let four =
        ArrayFile::open(&at("refused/four.mat"), ArrayFormat::Matlab).expect_err("version 4");
    assert!(four.to_string().contains("save('x.mat', '-v7')"), "{four}");
}
