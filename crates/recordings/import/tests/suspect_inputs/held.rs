//! Tests that damage detected by a checksum, an index or a size is rejected. Unwritten data must be accepted only with a key of the map.

use super::{FACTS, NO_TIME, case, lab, map_of, planned, summary};
use taceva_core::SilentProgress;
use taceva_import::UnpackedArchive;

/// Changed copy of a file of `tests/recordings`, in a separate folder.
fn recording(name: &str, change: impl FnOnce(&mut Vec<u8>)) -> tempfile::TempDir {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../tests/recordings")
        .join(name);
    let mut bytes = std::fs::read(&path).expect("there");
    change(&mut bytes);
    let folder = lab(&[]);
    let file = path.file_name().expect("a name");
    std::fs::write(folder.path().join(file), bytes).expect("written");
    folder
}

#[test]
fn a_stored_label_of_npz_that_was_damaged_is_refused_by_its_checksum() {
    let name = "npz-stored-label-damaged";
    let problem = planned(&case(name), &map_of(name)).expect_err("damaged");
    assert!(
        problem.contains("ft.npy") && problem.contains("checksum"),
        "{problem}"
    );
}

#[test]
fn damage_in_times_and_texts_of_npz_is_refused_as_that_of_labels_is() {
    let map = std::fs::read_to_string(
        std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../../tests/recordings/npz-stored/map.toml"),
    )
    .expect("a map");
    let whole = recording("npz-stored/run.npz", |_| {});
    let kept = summary(whole.path(), &map).rows_kept;
    assert!(kept > 0);
    for name in ["ft.npy", "t.npy", "obj.npy"] {
        let folder = recording("npz-stored/run.npz", |bytes| {
            let mut heads: Vec<usize> = (0..bytes.len() - 4)
                .filter(|at| bytes[*at..*at + 4] == *b"PK\x03\x04")
                .collect();
            heads.retain(|at| bytes[at + 30..].starts_with(name.as_bytes()));
            // The NumPy header takes 128 bytes, after a member header of 30 bytes, the name and the extra field.
            if let [at] = heads.as_slice() {
                let begin = at + 30 + name.len() + usize::from(bytes[at + 28]);
                bytes[begin + 128 + 9] ^= 4;
            }
        });
        let problem = planned(folder.path(), &map).expect_err(name);
        assert!(
            problem.contains("checksum") && problem.contains(name),
            "{problem}"
        );
    }
}

#[test]
fn a_chunk_of_hdf5_whose_key_was_damaged_is_refused() {
    let name = "hdf5-chunk-index-damaged";
    let problem = planned(&case(name), &map_of(name)).map(|plan| {
        let target = tempfile::tempdir().expect("a folder");
        let jobs = std::num::NonZeroUsize::MIN;
        let run = plan.run(
            &target.path().join("ds"),
            jobs,
            &taceva_core::SilentProgress,
        );
        run.map(|_| ()).map_err(|error| error.to_string())
    });
    let problem = problem.and_then(|ran| ran).expect_err("damaged");
    assert!(problem.contains("frames"), "{problem}");
    assert!(
        problem.contains("a chunk whose key") || problem.contains("`fill = true`"),
        "{problem}"
    );
}

/// An interrupted logger leaves unwritten chunks.
#[test]
fn chunks_of_hdf5_that_were_never_written_need_fill_in_the_map() {
    let folder = lab(&[]);
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../formats/arrays/tests/data/hdf5/types.h5");
    std::fs::copy(path, folder.path().join("run.h5")).expect("copied");
    let map = |fill: &str| {
        format!(
            "map_version = 2\n{fill}table = {{ file = \"run.h5\", rows = \"/filled\" }}\n[columns]\nFz = {{ from = \"/filled\", unit = \"N\" }}\n{NO_TIME}{FACTS}"
        )
    };
    let problem = planned(folder.path(), &map("")).expect_err("not written");
    for word in ["run.h5/filled", "1 of its chunks", "`fill = true`"] {
        assert!(problem.contains(word), "no `{word}` in {problem}");
    }
    let told = summary(folder.path(), &map("fill = true\n"));
    assert_eq!(told.absent_chunks["run.h5/filled"], 1);
    assert!(told.to_string().contains("run.h5/filled"), "{told}");
}

#[test]
fn archives_of_nothing_but_empty_files_or_folders_are_refused_in_words() {
    for kind in [tar::EntryType::Regular, tar::EntryType::Directory] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.tar");
        let file = std::fs::File::create(&path).expect("made");
        let mut archive = tar::Builder::new(std::io::BufWriter::new(file));
        for number in 0..20_001 {
            let mut header = tar::Header::new_ustar();
            header.set_entry_type(kind);
            header.set_size(0);
            header.set_path(format!("f{number}")).expect("a name");
            header.set_cksum();
            archive.append(&header, std::io::empty()).expect("added");
        }
        archive.finish().expect("written");
        drop(archive);
        let problem = UnpackedArchive::open(&path, folder.path(), &SilentProgress)
            .expect_err("refused")
            .to_string();
        assert!(
            problem.contains("20000 empty files and folders"),
            "{problem}"
        );
        assert!(problem.contains("run.tar"), "{problem}");
    }
}
