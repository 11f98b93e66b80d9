//! Tests of groups, attributes and errors of HDF5.

use std::fs;

use taceva_arrays::{ArrayFile, ArrayFormat, ArrayValues, Problem};

use crate::digest::at;

fn opened(name: &str) -> ArrayFile {
    ArrayFile::open(&at(name), ArrayFormat::Hdf5).expect("opens")
}

fn why(file: &ArrayFile, name: &str) -> String {
    file.read(name, 0..1).expect_err(name).to_string()
}

#[test]
fn groups_are_found_by_pattern_with_their_attributes() {
    let file = opened("hdf5-groups/all.hdf5");
    let groups = file.groups("/data/demo_*");
    assert_eq!(
        groups,
        [
            "/data/demo_0",
            "/data/demo_1",
            "/data/demo_2",
            "/data/demo_3"
        ]
    );
    let objects: Vec<Option<String>> = groups
        .iter()
        .map(|group| file.attribute(group, "object"))
        .collect();
    let expected = ["cube", "ball", "cube", "ball"].map(|object| Some(object.to_owned()));
    assert_eq!(objects, expected);
    assert_eq!(file.attribute("/data/demo_0", "weight"), None);
    assert_eq!(file.groups("/data/*/obs").len(), 4);
    assert_eq!(
        file.info("/data/demo_3/obs/ft").expect("listed").shape,
        [6, 6]
    );
}

#[test]
fn attributes_of_every_kind_are_the_shortest_text() {
    let file = opened("hdf5/types.h5");
    for (owner, name, expected) in [
        ("/", "sensor", "drawn gel"),
        ("", "sensor", "drawn gel"),
        ("/record", "rate_hz", "0.1"),
        ("/plain", "scale", "0.1"),
        ("plain", "offset", "[1, -2, 3]"),
    ] {
        assert_eq!(
            file.attribute(owner, name).as_deref(),
            Some(expected),
            "{owner} {name}"
        );
    }
    assert_eq!(file.attribute("/no/such", "x"), None);
}

/// File with layout version `version` in place of version 5, and unchanged checksums.
fn with_layout_of(version: u8) -> Vec<u8> {
    let mut bytes = fs::read(at("hdf5/latest.h5")).expect("readable");
    let found = bytes
        .windows(8)
        .filter(|window| window.starts_with(&[8]) && window[4..6] == [5, 2]);
    assert!(found.count() > 3, "messages of layout 5 are there");
    for place in 0..bytes.len() - 6 {
        if bytes[place] == 8 && bytes[place + 2] == 0 && bytes[place + 4..place + 6] == [5, 2] {
            bytes[place + 4] = version;
        }
    }
    bytes
}

#[test]
fn a_layout_message_of_another_version_behind_an_old_checksum_is_an_error_and_no_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("run.h5");
    fs::write(&copy, with_layout_of(6)).expect("written");
    let read = ArrayFile::open(&copy, ArrayFormat::Hdf5)
        .map(|file| file.read("/rgb", 0..6).map(|read| read.values));
    assert!(!matches!(read, Ok(Ok(_))), "{read:?}");
}

#[test]
fn two_axes_that_grow_in_a_layout_of_hdf5_2_are_refused_with_the_setting_that_mends_it() {
    let file = opened("refused/two-growing-axes.h5");
    assert_eq!(
        file.info("/rgb").map(|info| info.shape.clone()),
        Some(vec![6, 40]),
        "it is listed"
    );
    let message = why(&file, "/rgb");
    assert!(
        message.contains("two growing axes") && message.contains("libver=('earliest', 'v108')"),
        "{message}"
    );
    let time = file.read("/t", 0..6).expect("others are read").values;
    assert_eq!(time, ArrayValues::F64(vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0]));
}

#[test]
fn what_is_not_read_says_so_and_leaves_the_others_alone() {
    let file = opened("refused/kinds.h5");
    assert_eq!(
        file.read("/x", 1..3).expect("plain").values,
        ArrayValues::I64(vec![1, 2])
    );
    for (name, expected) in [
        ("/lists", "lists of variable length"),
        ("/reference", "references"),
        ("/elsewhere", "are in another file"),
        ("/virtual", "virtual dataset"),
    ] {
        for name in [name, name.trim_start_matches('/')] {
            let message = why(&file, name);
            assert!(message.contains(expected), "{name}: {message}");
        }
    }
}

#[test]
fn links_are_not_followed_and_cycles_end() {
    let file = opened("hdf5/types.h5");
    for (name, words) in [
        ("/soft", "a soft link to `/record`"),
        ("/outside", "a link to `/x` of another file, `other.h5`"),
    ] {
        let error = file.read(name, 0..1).expect_err("a link").to_string();
        assert!(error.contains(words), "{error}");
    }
    let absent = file.read("/none", 0..1).expect_err("no such array");
    assert!(matches!(absent.problem, Problem::Absent { .. }), "{absent}");
    let file = opened("refused/cycle.h5");
    let names = file.names();
    assert!(names.len() < 1_000, "{}", names.len());
    assert_eq!(
        file.read("/a/b/x", 0..2).expect("there").values,
        ArrayValues::I64(vec![0, 1])
    );
    assert_eq!(
        file.read("/a/b/up/b/x", 1..2).expect("the same").values,
        ArrayValues::I64(vec![1])
    );
}

#[test]
fn soft_links_of_the_default_layout_lead_to_what_they_name() {
    let file = opened("refused/soft-links.h5");
    let names = file.names();
    for name in [
        "/run/frames",
        "/frames",
        "/latest/frames",
        "/latest/ft",
        "/twice",
        "/run/first",
    ] {
        assert!(
            names.iter().any(|known| known == name),
            "{name} of {names:?}"
        );
    }
    let own = file.read("/run/frames", 2..5).expect("there");
    assert_eq!(file.read("/frames", 2..5).expect("linked"), own);
    assert_eq!(file.read("/latest/frames", 2..5).expect("linked"), own);
    assert_eq!(
        file.read("/twice", 1..3).expect("linked").values,
        ArrayValues::F64(vec![1.0, 2.0])
    );
    assert_eq!(file.groups("/*"), ["/latest", "/run"]);
}

#[test]
fn a_soft_link_that_leads_nowhere_is_refused_when_it_is_read_and_leaves_the_others_alone() {
    for (name, link, words) in [
        (
            "refused/dangling.h5",
            "/frames",
            "`/frames` leads to `/nowhere`",
        ),
        ("refused/cycle-soft.h5", "/a", "`/a` leads to `/b`"),
        ("refused/cycle-soft.h5", "/b", "`/b` leads to `/a`"),
    ] {
        let file = opened(name);
        assert_eq!(file.names(), ["/ft"], "{name}");
        let forces = file.read("/ft", 0..6).expect("there").values;
        assert_eq!(forces, ArrayValues::F64(vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0]));
        for asked in [link, &link[1..], &format!("{link}/behind")] {
            let error = why(&file, asked);
            assert!(error.contains(words), "{asked}: {error}");
            assert!(error.contains("del f['"), "{error}");
        }
        let dead = file.dead_links();
        assert!(
            dead.iter()
                .any(|(own, reason)| own == link && reason.contains(words)),
            "{dead:?}"
        );
    }
}

#[test]
fn dead_links_between_others_of_a_large_group_leave_all_others_where_they_were() {
    let file = opened("refused/dead-links.h5");
    let names = file.names();
    assert_eq!(names.len(), 21, "{names:?}");
    for number in 0..20_u8 {
        let name = format!("/data/x{number:02}");
        let read = file.read(&name, 0..2).expect(&name).values;
        assert_eq!(read, ArrayValues::U8(vec![number, number + 1]), "{name}");
    }
    assert_eq!(
        file.read("/data/live", 0..2).expect("a link").values,
        ArrayValues::U8(vec![7, 8])
    );
    assert_eq!(file.dead_links().len(), 8);
    assert!(file.check_groups("/press_*").is_ok());
    let error = file.check_groups("/data/x*").expect_err("x00-dead is one");
    assert!(
        error.to_string().contains("del f['data/x00-dead']"),
        "{error}"
    );
    let error = file.check_groups("data/x05-dead/*").expect_err("above");
    assert!(error.to_string().contains("leads to `/gone`"), "{error}");
}

#[test]
fn links_of_the_newer_layout_are_refused_by_what_they_lead_to() {
    let file = opened("refused/links.h5");
    assert!(why(&file, "/frames").contains("request `/run/frames` directly"));
    let elsewhere = why(&file, "elsewhere");
    assert!(
        elsewhere.contains("`/x` of another file, `other.h5`"),
        "{elsewhere}"
    );
    assert!(elsewhere.contains("h5py.File(path, 'a')"), "{elsewhere}");
}

#[test]
fn files_with_soft_links_that_are_damaged_are_errors() {
    let whole = fs::read(at("refused/soft-links.h5")).expect("readable");
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("run.h5");
    for position in 0..whole.len().min(4_000) {
        let mut bytes = whole.clone();
        bytes[position] ^= 1 << (position % 8);
        fs::write(&copy, &bytes).expect("written");
        let opened = std::panic::catch_unwind(|| {
            ArrayFile::open(&copy, ArrayFormat::Hdf5).map(|file| file.names().len())
        });
        assert!(opened.is_ok(), "bit {} of byte {position}", position % 8);
    }
}

#[test]
fn chunks_that_were_never_written_are_counted() {
    let file = opened("hdf5/types.h5");
    for (name, absent) in [
        ("/unwritten", 4),
        ("/filled", 1),
        ("/half-chunk", 0),
        ("/plain/i4", 0),
    ] {
        if file.info(name).is_some() {
            assert_eq!(file.absent_chunks(name).expect(name), absent, "{name}");
        }
    }
    assert!(file.info("/unwritten").is_some() && file.info("/filled").is_some());
}

#[test]
fn checksums_of_chunks_are_compared() {
    let path = at("hdf5-fletcher-earliest/run.h5");
    let mut bytes = fs::read(path).expect("readable");
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("run.h5");
    let mut refused = 0;
    // Some of these are in chunks, at positions that the library chose.
    for at in (20_000..50_000).step_by(5_000) {
        bytes[at] ^= 4;
        fs::write(&copy, &bytes).expect("written");
        bytes[at] ^= 4;
        let file = ArrayFile::open(&copy, ArrayFormat::Hdf5).expect("structures are elsewhere");
        refused += usize::from(file.read("/tactile/left/rgb", 0..24).is_err());
    }
    assert!(refused >= 5, "{refused} of 6 were found");
}
