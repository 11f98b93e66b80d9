//! Tests of complete and of forged packed bundles.

use super::*;

/// Entry of a forged archive.
struct Forged<'a> {
    name: &'a str,
    kind: EntryType,
    bytes: &'a [u8],
}

fn plain<'a>(name: &'a str, bytes: &'a [u8]) -> Forged<'a> {
    Forged {
        name,
        kind: EntryType::Regular,
        bytes,
    }
}

/// Writes an archive of `entries` without checking their names.
fn forge(path: &Path, entries: &[Forged<'_>]) {
    let file = File::create(path).expect("room");
    let mut archive = Builder::new(GzEncoder::new(file, Compression::fast()));
    for entry in entries {
        let mut header = Header::new_ustar();
        header.as_old_mut().name[..entry.name.len()].copy_from_slice(entry.name.as_bytes());
        header.set_entry_type(entry.kind);
        header.set_size(entry.bytes.len() as u64);
        if entry.kind == EntryType::Symlink {
            header.set_link_name("/etc/passwd").expect("short");
        }
        header.set_cksum();
        archive.append(&header, entry.bytes).expect("room");
    }
    let packed = archive.into_inner().expect("room");
    packed.finish().expect("room");
}

/// Result of unpacking a forged archive, in words.
fn unpacked(entries: &[Forged<'_>]) -> Result<(), String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("b.tar.gz");
    forge(&path, entries);
    let into = folder.path().join("into");
    fs::create_dir(&into).expect("made");
    let outcome = unpack(&path, &into, u64::MAX).map_err(|error| error.to_string());
    let beside = fs::read_dir(folder.path()).expect("readable").count();
    assert_eq!(beside, 2, "something was written beside the folder");
    outcome
}

#[track_caller]
fn refused(entries: &[Forged<'_>], words: &str) {
    let why = unpacked(entries).expect_err("it must be refused");
    assert!(why.contains(words), "{why}");
}

#[test]
fn what_is_packed_is_unpacked_and_equal_files_give_equal_bytes() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path().join("root");
    fs::create_dir_all(root.join("states")).expect("made");
    fs::write(root.join("bundle.json"), "{}").expect("room");
    fs::write(root.join("states/0.json"), "[1]").expect("room");
    let names = ["bundle.json", "states/0.json"].map(str::to_owned);
    let one = folder.path().join("one.tar.gz");
    let other = folder.path().join("other.tar.gz");
    pack(&root, &names, &one).expect("packed");
    pack(&root, &names, &other).expect("packed");
    assert_eq!(
        fs::read(&one).expect("there"),
        fs::read(&other).expect("there")
    );
    let into = folder.path().join("into");
    fs::create_dir(&into).expect("made");
    unpack(&one, &into, u64::MAX).expect("unpacked");
    assert_eq!(fs::read(into.join("states/0.json")).expect("there"), b"[1]");
}

#[test]
fn links_devices_and_paths_that_lead_out_are_refused() {
    for kind in [EntryType::Symlink, EntryType::Link, EntryType::Fifo] {
        let entry = Forged {
            name: "x",
            kind,
            bytes: b"",
        };
        refused(&[entry], "expected a regular file");
    }
    for name in ["../x", "a/../../x", "/etc/x", "a//x"] {
        refused(&[plain(name, b"1")], "leads out of the bundle");
    }
    let folder = Forged {
        name: "x/",
        kind: EntryType::Directory,
        bytes: b"hidden",
    };
    refused(&[folder], "a folder with 6 bytes");
    refused(
        &[plain("a", b"1"), plain("a/b", b"2")],
        "a file has the name of its folder",
    );
}

#[test]
fn files_and_bytes_behind_the_end_of_an_archive_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    forge(&at("one.tar.gz"), &[plain("a", b"1")]);
    forge(&at("other.tar.gz"), &[plain("b", b"2")]);
    let one = fs::read(at("one.tar.gz")).expect("there");
    let other = fs::read(at("other.tar.gz")).expect("there");
    let mut zeros = GzEncoder::new(Vec::new(), Compression::fast());
    zeros.write_all(&[0; 512]).expect("into memory");
    let zeros = zeros.finish().expect("into memory");
    for (number, (behind, words)) in [
        (other, Some("bytes after the end of the archive")),
        (b"trailing".to_vec(), Some("not a complete .tar.gz")),
        (zeros, None),
    ]
    .into_iter()
    .enumerate()
    {
        let path = at("joined.tar.gz");
        fs::write(&path, [one.clone(), behind].concat()).expect("room");
        let into = at(&number.to_string());
        fs::create_dir(&into).expect("made");
        let outcome = unpack(&path, &into, u64::MAX).map_err(|error| error.to_string());
        match words {
            None => assert_eq!(outcome, Ok(())),
            Some(words) => {
                let why = outcome.expect_err("it must be refused");
                assert!(why.contains(words), "{why}");
            }
        }
    }
}

#[test]
fn an_archive_that_is_cut_off_breaks_the_rule_of_the_packed_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("b.tar.gz");
    forge(&path, &[plain("a", b"1")]);
    let whole = fs::read(&path).expect("there");
    fs::write(&path, &whole[..whole.len() / 2]).expect("room");
    let into = folder.path().join("into");
    fs::create_dir(&into).expect("made");
    match unpack(&path, &into, u64::MAX) {
        Err(BundleError::Damaged(damage)) => assert_eq!(damage.rule, WHOLE, "{damage}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn names_that_come_twice_or_differ_in_case_alone_are_refused() {
    refused(&[plain("a", b"1"), plain("a", b"2")], "file occurs twice");
    refused(
        &[plain("a.json", b"1"), plain("A.json", b"2")],
        "lower case only",
    );
    refused(&[plain("a/1", b"1"), plain("A/2", b"2")], "lower case only");
}

#[test]
fn a_file_of_many_zeros_ends_at_the_limit_for_its_size() {
    let zeros = vec![0; 200 << 20];
    refused(&[plain("zeros", &zeros)], "the limit for a file of");
}

#[test]
fn too_many_files_are_refused() {
    let names: Vec<String> = (0..=crate::layout::MOST_FILES)
        .map(|at| at.to_string())
        .collect();
    let entries: Vec<Forged<'_>> = names.iter().map(|name| plain(name, b"")).collect();
    refused(&entries, "more than 4096 files");
}

#[test]
fn every_cut_is_refused_and_a_damaged_byte_changes_no_content_unnoticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("b.tar.gz");
    let content = b"[1, 2, 3]";
    forge(&path, &[plain("bundle.json", content)]);
    let whole = fs::read(&path).expect("there");
    let tried = |bytes: &[u8], number: usize| {
        let path = folder.path().join("damaged.tar.gz");
        fs::write(&path, bytes).expect("room");
        let into = folder.path().join(number.to_string());
        fs::create_dir(&into).expect("made");
        let outcome = unpack(&path, &into, u64::MAX);
        outcome.map(|()| fs::read(into.join("bundle.json")).unwrap_or_default())
    };
    for cut in 1..whole.len() {
        assert!(tried(&whole[..cut], cut).is_err(), "cut at {cut}");
    }
    // Some bits are of no meaning: the time in the header of gzip, and those after the last block.
    for place in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[place] ^= 0x10;
        if let Ok(found) = tried(&damaged, whole.len() + place) {
            assert_eq!(found, content, "byte {place}");
        }
    }
}

/// Writer that fails like a full disk.
struct Full;

impl Write for Full {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(io::ErrorKind::StorageFull.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_no_fault_of_the_archive() {
    let fault = copy(&mut [7_u8; 9].as_slice(), &mut Full);
    assert!(matches!(fault, Err(Fault::Write(_))));
    let mut copied = Vec::new();
    let whole = copy(&mut [7_u8; 9].as_slice(), &mut copied);
    assert!(matches!(whole, Ok(9)) && copied == [7; 9]);
}
