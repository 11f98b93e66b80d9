//! Tests of archives, HDF5, object arrays and pickles, and of signals that are not numbers.

use std::fs;
use std::path::Path;

use taceva_needs::{Need, skip};

use super::crafted::{archive_of_zeros, npy};
use super::{FORCE, NO_TIME, imported, lab, refused, workspace};

#[test]
fn zip_bombs_in_npz_are_refused_before_they_are_inflated() {
    for (size, packed) in [
        (2_000_000_000, vec![0; 8_000_000]),
        (1 << 50, vec![0; 1_000]),
    ] {
        let folder = lab(&[("bomb.npz", &archive_of_zeros(size, &packed))]);
        let map = format!("table = \"bomb.npz\"\n{FORCE}{NO_TIME}");
        refused(folder.path(), &map, &["bomb.npz"]);
    }
}

#[test]
fn cyclic_and_external_links_of_hdf5_end_or_are_named() {
    let from = |file: &str| {
        let folder = tempfile::tempdir().expect("a folder");
        let path = workspace("crates/formats/arrays/tests/data/refused").join(file);
        fs::copy(path, folder.path().join("run.h5")).expect("copied");
        folder
    };
    let map = |array: &str| {
        format!(
            "table = \"run.h5\"\n[columns]\nFz = {{ from = \"{array}\", unit = \"N\" }}\n{NO_TIME}"
        )
    };
    let cycle = imported(from("cycle.h5").path(), &map("/a/b/x"));
    assert!(cycle.is_ok(), "{:?}", cycle.err());
    for (file, link, words) in [
        ("cycle-soft.h5", "/a", "`/a` leads to `/b`"),
        ("dangling.h5", "/frames", "`/frames` leads to `/nowhere`"),
    ] {
        let folder = from(file);
        refused(folder.path(), &map(link), &[words, "del f['"]);
        let other = imported(folder.path(), &map("/ft"));
        assert!(other.is_ok(), "{file}: {:?}", other.err());
    }
    // If one group is a dead link, the others are not read without it.
    let groups = map("x").replace("\"run.h5\"", "{ file = \"run.h5\", rows = \"/data/x*\" }");
    refused(
        from("dead-links.h5").path(),
        &groups,
        &["leads to `/gone`", "del f['data/x"],
    );
    refused(from("kinds.h5").path(), &map("/elsewhere"), &["/elsewhere"]);
    refused(from("links.h5").path(), &map("/elsewhere"), &["/elsewhere"]);
}

#[test]
fn a_draft_of_nothing_but_links_that_lead_nowhere_names_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = workspace("crates/formats/arrays/tests/data/refused/dangling.h5");
    fs::copy(path, folder.path().join("run.h5")).expect("copied");
    let refused = taceva_import::MapDraft::of(folder.path()).expect_err("nothing else is in it");
    let refused = refused.to_string();
    for words in [
        "the soft link `/frames` leads to `/nowhere`, which does not exist",
        "del f['frames']",
    ] {
        assert!(refused.contains(words), "{refused}");
    }
}

#[test]
fn links_of_new_groups_and_filters_of_zarr_are_refused_with_the_name_of_the_array() {
    let types = tempfile::tempdir().expect("a folder");
    let path = workspace("crates/formats/arrays/tests/data/hdf5/types.h5");
    fs::copy(path, types.path().join("run.h5")).expect("copied");
    let column = |table: &str, array: &str| {
        format!(
            "table = \"{table}\"\n[columns]\nFz = {{ from = \"{array}\", unit = \"N\" }}\n{NO_TIME}"
        )
    };
    let frames = |table: &str, array: &str| {
        format!(
            "table = \"{table}\"\n[frame]\narray = \"{array}\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n{NO_TIME}"
        )
    };
    for (array, words) in [
        ("/soft", "a soft link to `/record`"),
        ("/outside", "a link to `/x` of another file, `other.h5`"),
    ] {
        for map in [column("run.h5", array), frames("run.h5", array)] {
            refused(types.path(), &map, &["run.h5", array, words]);
        }
    }
    let described = |filters: &str| {
        format!(
            "{{\"zarr_format\": 2, \"shape\": [2], \"chunks\": [2], \"dtype\": \"<f8\", \"order\": \"C\", \"compressor\": null, \"fill_value\": 0, \"filters\": {filters}}}"
        )
    };
    let numbers: Vec<u8> = [1.0_f64, 2.0]
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    let store = lab(&[
        ("run.zarr/.zgroup", b"{\"zarr_format\": 2}"),
        ("run.zarr/plain/.zarray", described("null").as_bytes()),
        ("run.zarr/plain/0", &numbers),
        (
            "run.zarr/force/.zarray",
            described("[{\"id\": \"delta\", \"dtype\": \"<f8\"}]").as_bytes(),
        ),
        ("run.zarr/force/0", &numbers),
    ]);
    let plain = imported(store.path(), &column("run.zarr", "/plain"));
    assert!(plain.is_ok(), "{:?}", plain.err());
    for map in [
        column("run.zarr", "/force"),
        column("run.zarr", "force"),
        frames("run.zarr", "/force"),
    ] {
        refused(
            store.path(),
            &map,
            &["run.zarr", "force", "a filter `delta`", "without filters"],
        );
    }
}

#[test]
fn object_arrays_and_pickles_run_nothing() {
    let proof = std::env::temp_dir().join(format!("taceva-was-run-{}", std::process::id()));
    let code = format!("cos\nsystem\n(S'touch {}'\ntR.", proof.display());
    let array = npy("|O", "(2,)", code.as_bytes());
    let pickle = [&b"\x80\x02"[..], code.as_bytes()].concat();
    let folder = lab(&[("value.npy", &array), ("value.pkl", &pickle)]);
    for table in ["value.npy", "value.pkl"] {
        let map = format!("table = \"{table}\"\n{FORCE}{NO_TIME}");
        refused(folder.path(), &map, &[table]);
        assert!(!proof.exists(), "{table} was run");
    }
}

#[test]
fn signals_that_are_no_numbers_name_their_row() {
    let numbers = [1.0_f32, 2.0, 3.0, f32::NAN];
    let bytes: Vec<u8> = numbers
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    let folder = lab(&[
        ("labels.csv", b"value\n1\n2\n"),
        ("taxels.npy", &npy("<f4", "(2, 2)", &bytes)),
    ]);
    let map = format!(
        "table = \"labels.csv\"\n{FORCE}{NO_TIME}[signals]\nfrom = {{ file = \"taxels.npy\" }}\nunit = \"uT\"\nplaces = [2, 1]\nchannels = [\"z\"]\n"
    );
    refused(folder.path(), &map, &["taxels.npy", "row 1", "NaN"]);
}

/// The collection must not be copied into the repository, so it is read from the folder of recordings.
#[test]
fn the_public_collection_of_hdf5_files_that_broke_readers_is_refused_or_read() {
    let folder = std::env::var_os("TACEVA_DATA").map(|data| Path::new(&data).join("cve_hdf5"));
    let Some(folder) = folder.filter(|folder| folder.is_dir()) else {
        return skip(Need::HostileHdf5, "no folder `cve_hdf5` in TACEVA_DATA");
    };
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let lab = tempfile::tempdir().expect("a folder");
        fs::copy(entry.path(), lab.path().join("run.h5")).expect("copied");
        let map = format!("table = \"run.h5\"\n{FORCE}{NO_TIME}");
        drop(imported(lab.path(), &map));
    }
}
