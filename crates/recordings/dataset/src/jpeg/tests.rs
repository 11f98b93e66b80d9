use std::path::Path;

use super::check_whole;

const END: [u8; 2] = [0xFF, 0xD9];

/// JPEG files in `tests/fixtures/jpeg`, by name.
fn drawn() -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/jpeg");
    let entries = std::fs::read_dir(folder).expect("the folder").flatten();
    let read = |entry: std::fs::DirEntry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        (name, std::fs::read(entry.path()).expect("a picture"))
    };
    let mut drawn: Vec<_> = entries.map(read).collect();
    drawn.sort();
    drawn
}

fn of(name: &str) -> Vec<u8> {
    let drawn = drawn().into_iter().find(|(known, _)| known == name);
    drawn.expect("a drawn picture").1
}

/// Offsets of the data of the first scan, and of the end marker.
fn data(bytes: &[u8]) -> (usize, usize) {
    let scan = bytes.windows(2).position(|pair| pair == [0xFF, 0xDA]);
    let scan = scan.expect("a scan");
    let end = bytes.windows(2).rposition(|pair| pair == END);
    (
        scan + 2 + usize::from(bytes[scan + 3]),
        end.expect("an end marker"),
    )
}

#[test]
fn whole_pictures_of_every_kind_are_read_to_their_end() {
    let drawn = drawn();
    assert!(drawn.len() >= 12);
    for (name, bytes) in drawn {
        assert_eq!(check_whole(&bytes), Ok(()), "{name}");
    }
}

#[test]
fn no_cut_is_hidden_by_an_end_marker() {
    for (name, bytes) in drawn() {
        let (begin, end) = data(&bytes);
        for at in begin..end {
            let closed = [&bytes[..at], &END].concat();
            assert!(check_whole(&closed).is_err(), "{name}, closed at {at}");
            assert!(check_whole(&bytes[..at]).is_err(), "{name}, cut at {at}");
        }
    }
}

#[test]
fn bytes_too_many_before_the_end_are_refused() {
    for name in ["baseline-444.jpg", "progressive-420.jpg", "restart.jpg"] {
        let mut bytes = of(name);
        let (_, end) = data(&bytes);
        bytes.splice(end..end, [0, 0]);
        let problem = check_whole(&bytes).expect_err(name);
        assert!(problem.contains("bytes are left"), "{problem}");
    }
}

#[test]
fn restart_markers_must_be_there_in_turn_and_nowhere_else() {
    let whole = of("restart.jpg");
    let (begin, _) = data(&whole);
    let marker = |bytes: &[u8]| {
        let found = bytes[begin..]
            .windows(2)
            .position(|pair| pair[0] == 0xFF && (0xD0..0xD8).contains(&pair[1]));
        begin + found.expect("a restart marker")
    };
    let at = marker(&whole);
    let mut out_of_turn = whole.clone();
    out_of_turn[at + 1] = 0xD5;
    assert!(check_whole(&out_of_turn).is_err());
    let mut missing = whole.clone();
    missing.drain(at..at + 2);
    assert!(check_whole(&missing).is_err());
    let mut astray = of("baseline-444.jpg");
    let (begin, end) = data(&astray);
    astray.splice((begin + end) / 2..(begin + end) / 2, [0xFF, 0xD0]);
    assert!(check_whole(&astray).is_err());
}

#[test]
fn a_table_and_a_size_that_contradict_the_data_are_refused_without_a_panic() {
    for (_, bytes) in drawn() {
        let (begin, _) = data(&bytes);
        for at in 0..begin {
            for bit in 0..8 {
                let mut changed = bytes.clone();
                changed[at] ^= 1 << bit;
                // Some changed headers are equivalent, so only a panic fails here.
                let _ = check_whole(&changed);
            }
        }
        let _ = check_whole(&bytes[..begin]);
    }
    assert!(check_whole(&[]).is_err());
}
