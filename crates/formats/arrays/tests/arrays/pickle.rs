//! Tests of the accepted content of pickles, and of code that must not be run.

use std::fs;
use std::path::PathBuf;

use taceva_arrays::{ArrayFile, ArrayFormat, Problem};

use crate::digest::at;

fn refused(name: &str) -> String {
    let path = at("refused").join(name);
    ArrayFile::open(&path, ArrayFormat::of(&path).expect("known"))
        .expect_err(name)
        .to_string()
}

/// Opens `bytes` as a pickle.
fn open(
    bytes: &[u8],
) -> (
    Result<ArrayFile, taceva_arrays::ArrayError>,
    tempfile::TempDir,
) {
    let folder = tempfile::tempdir().expect("a folder");
    let path: PathBuf = folder.path().join("x.pkl");
    fs::write(&path, bytes).expect("written");
    (ArrayFile::open(&path, ArrayFormat::Pickle), folder)
}

#[test]
fn globals_beyond_numpy_are_refused_by_name_with_what_to_do() {
    let evil = refused("evil.pkl");
    assert!(
        evil.contains("needs `posix.system`, and code of a pickle is not run"),
        "{evil}"
    );
    assert!(!PathBuf::from("/tmp/pickle-was-executed").exists());
    let exec = refused("exec.pkl");
    assert!(exec.contains("needs `builtins.exec`"), "{exec}");
    let table = refused("dataframe.pkl");
    assert!(
        table.contains("needs `pandas.") && table.contains("to_csv('table.csv', index=False)"),
        "{table}"
    );
    for protocol in [0, 1] {
        let message = refused(&format!("protocol-{protocol}.pkl"));
        assert!(
            message.contains("protocol 2 to 5") && message.contains("protocol=4"),
            "{message}"
        );
    }
}

#[test]
fn a_member_that_would_run_code_leaves_the_others_readable() {
    let file = ArrayFile::open(&at("refused/exec.npz"), ArrayFormat::Npz).expect("opens");
    assert_eq!(file.names(), ["x"]);
    let error = file.read("y", 0..1).expect_err("would run");
    assert!(matches!(error.problem, Problem::Global { .. }), "{error}");
}

#[test]
fn lists_that_are_no_column_say_why() {
    let file = ArrayFile::open(&at("refused/ragged.pkl"), ArrayFormat::Pickle).expect("opens");
    assert_eq!(file.names(), ["x"]);
    for (name, expected) in [
        ("ragged", "different lengths"),
        ("mixed", "different kinds"),
        ("set", "other than numbers, strings"),
    ] {
        let message = file.read(name, 0..1).expect_err(name).to_string();
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn deep_wide_and_shared_pickles_end_soon() {
    let within = |opens: usize, tail: &[u8]| [&b"\x80\x04"[..], &vec![b']'; opens], tail].concat();
    // Two million lists, each inside the previous one.
    let deep = [within(2_000_000, b""), vec![b'a'; 1_999_999], b".".to_vec()].concat();
    let (result, _folder) = open(&deep);
    assert!(
        result.is_ok_and(|file| file.names().is_empty()),
        "nested too deep for a column"
    );
    let groups = [&b"\x80\x04"[..], &vec![b'('; 2_000_000]].concat();
    assert!(
        open(&groups)
            .0
            .expect_err("groups")
            .to_string()
            .contains("nested groups")
    );
    let wide = [&b"\x80\x04"[..], &vec![b'N'; 8_000_000]].concat();
    assert!(
        open(&wide)
            .0
            .expect_err("values")
            .to_string()
            .contains("save arrays instead of lists")
    );
    // Each list contains the previous one twice: 2^60 elements.
    let mut shared = b"\x80\x04]K\x01a\x94".to_vec();
    for level in 0..60_u8 {
        shared.extend([b']', b'(', b'h', level, b'h', level, b'e', 0x94]);
    }
    shared.push(b'.');
    assert!(
        open(&shared)
            .0
            .expect_err("shared")
            .to_string()
            .contains("counted each time")
    );
    // List that contains itself.
    let cycle = b"\x80\x04]\x94h\x00a.";
    assert!(open(cycle).0.is_ok_and(|file| file.names().is_empty()));
    // Dictionary that contains itself.
    let cycle = b"\x80\x04}\x94X\x01\x00\x00\x00ah\x00s.";
    assert!(open(cycle).0.is_err());
    // 2^63 missing bytes.
    let long = b"\x80\x04\x8e\xff\xff\xff\xff\xff\xff\xff\x7f.";
    assert!(
        open(long)
            .0
            .expect_err("cut")
            .to_string()
            .contains("expected the rest of a pickle")
    );
}

#[test]
fn a_text_that_is_encoded_again_and_again_is_refused() {
    let text = vec![b'a'; 100_000];
    let mut bytes = b"\x80\x02X\xa0\x86\x01\x00".to_vec();
    bytes.extend(&text);
    bytes.extend(b"q\x00X\x06\x00\x00\x00latin1q\x01c_codecs\nencode\nq\x02");
    for _ in 0..50 {
        bytes.extend(b"h\x02h\x00h\x01\x86R");
    }
    bytes.push(b'.');
    assert!(
        open(&bytes)
            .0
            .expect_err("a bomb")
            .to_string()
            .contains("bytes of texts")
    );
}

/// Creates an `.npy` file of objects, whose content is the bytes `pickle`.
fn of_objects(pickle: &[u8]) -> Vec<u8> {
    let mut header = b"{'descr': '|O', 'fortran_order': False, 'shape': (1,), }".to_vec();
    header.resize(117, b' ');
    header.push(b'\n');
    let mut bytes = b"\x93NUMPY\x01\0".to_vec();
    bytes.extend(118_u16.to_le_bytes());
    [bytes, header, pickle.to_vec()].concat()
}

#[test]
fn an_object_array_goes_through_the_same_machine() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("x.npy");
    let open = |pickle: &[u8]| {
        fs::write(&path, of_objects(pickle)).expect("written");
        ArrayFile::open(&path, ArrayFormat::Npy)
    };
    // Protocol 2: a list with the start of a pandas table, and a list that would run a program.
    let tables = open(b"\x80\x02]q\0ccopyreg\n_reconstructor\n.").expect_err("no array");
    assert!(
        tables
            .to_string()
            .contains("needs `copyreg._reconstructor`"),
        "{tables}"
    );
    let tables = open(b"\x80\x02]q\0cpandas.core.frame\nDataFrame\n.").expect_err("a table");
    let message = tables.to_string();
    assert!(
        message.contains("needs `pandas.core.frame.DataFrame`"),
        "{message}"
    );
    assert!(
        message.contains("each table of a list to a separate file"),
        "{message}"
    );
    let evil = open(b"\x80\x02cposix\nsystem\nX\x04\0\0\0true\x85R.").expect_err("a program");
    assert!(evil.to_string().contains("needs `posix.system`"), "{evil}");
    // A dictionary in it: {"a": [1, 2]}.
    let read = open(b"\x80\x02}X\x01\0\0\0a]K\x01aK\x02as.").expect("a dictionary");
    assert_eq!(read.names(), ["a"]);
    assert_eq!(read.info("a").expect("listed").shape, [2]);
}

#[test]
fn dictionaries_within_dictionaries_are_groups() {
    // {"t": {"0": {"x": [1]}, "1": {"x": [2]}}, "all": [3]}
    let press = |name: u8, number: u8| {
        [
            b"X\x01\0\0\0".as_slice(),
            &[name],
            b"}X\x01\0\0\0x]K",
            &[number],
            b"ass",
        ]
        .concat()
    };
    let bytes = [
        b"\x80\x02}X\x01\0\0\0t}".as_slice(),
        &press(b'0', 1),
        &press(b'1', 2),
        b"sX\x03\0\0\0all]K\x03as.",
    ]
    .concat();
    let (file, _folder) = open(&bytes);
    let file = file.expect("a dictionary");
    assert_eq!(file.names(), ["t.0.x", "t.1.x", "all"]);
    assert_eq!(file.groups("t.*"), ["t.0", "t.1"]);
    assert_eq!(file.groups("*"), ["t"]);
    assert!(file.groups("all.*").is_empty());
}
