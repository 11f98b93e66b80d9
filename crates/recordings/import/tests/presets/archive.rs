//! Tests of recordings in a tar archive, which are read like a folder, or rejected with a message if hostile.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::preset;
use flate2::Compression;
use flate2::write::GzEncoder;
use taceva_core::SilentProgress;
use taceva_import::{ImportMap, ImportPlan, MapDraft, UnpackedArchive};
use tar::{Builder, EntryType, Header};

use super::{drawn, import};

fn packed(folder: &Path, to: &Path) {
    let mut tar = Builder::new(File::create(to).expect("created"));
    tar.append_dir_all("run", folder).expect("packed");
    tar.finish().expect("written");
}

fn gzipped(path: &Path) -> PathBuf {
    let to = path.with_extension("tar.gz");
    let mut gzip = GzEncoder::new(File::create(&to).expect("created"), Compression::fast());
    gzip.write_all(&std::fs::read(path).expect("there"))
        .expect("written");
    gzip.finish().expect("written");
    to
}

fn refused(path: &Path) -> String {
    let beside = tempfile::tempdir().expect("a folder");
    let error = UnpackedArchive::open(path, beside.path(), &SilentProgress).expect_err("hostile");
    let left = std::fs::read_dir(beside.path()).expect("there").count();
    assert_eq!(left, 0, "{error}");
    error.to_string()
}

/// Tar header with a name that `tar` would not write.
fn header(name: &[u8], size: u64, kind: EntryType) -> Header {
    let mut header = Header::new_ustar();
    let field = &mut header.as_old_mut().name;
    field[..name.len()].copy_from_slice(name);
    header.set_size(size);
    header.set_entry_type(kind);
    header.set_cksum();
    header
}

fn written(folder: &Path, parts: &[&[u8]]) -> PathBuf {
    let path = folder.join("a.tar");
    std::fs::write(&path, parts.concat()).expect("written");
    path
}

const END: [u8; 1024] = [0; 1024];

#[test]
fn an_error_names_the_archive_and_its_member_and_not_where_it_was_unpacked() {
    let lab = tempfile::tempdir().expect("a folder");
    let folder = lab.path().join("folder");
    std::fs::create_dir(&folder).expect("made");
    std::fs::write(folder.join("labels.csv"), "file,Fz\n1.png,much\n").expect("written");
    std::fs::write(folder.join("1.png"), "no picture").expect("written");
    let plain = lab.path().join("lab.tar");
    packed(&folder, &plain);
    let map = |table: &str| {
        ImportMap::parse(
            "map.toml".as_ref(),
            &format!(
                "map_version = 2\ntable = \"{table}\"\n[frame]\ncolumn = \"file\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\n[sensor]\nmodel = \"drawn\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n"
            ),
        )
        .expect("a map")
    };
    let beside = lab.path().join("beside");
    std::fs::create_dir(&beside).expect("made");
    let archive = UnpackedArchive::open(&plain, &beside, &SilentProgress).expect("unpacked");
    let member = |name: &str| plain.join("run").join(name).display().to_string();
    let said = |error| {
        let said = archive.named(error).to_string();
        assert!(!said.contains("unpacked-"), "{said}");
        said
    };
    let wrong_cell = ImportPlan::new(archive.folder(), &map("labels.csv")).expect_err("a text");
    let wrong_cell = said(wrong_cell);
    assert!(
        wrong_cell.starts_with(&format!("{}, line 2", member("labels.csv"))),
        "{wrong_cell}"
    );
    let absent = said(ImportPlan::new(archive.folder(), &map("no*.csv")).expect_err("no table"));
    assert!(
        absent.contains(&plain.join("run").display().to_string()),
        "{absent}"
    );
    std::fs::write(archive.folder().join("labels.csv"), "file,Fz\n1.png,1\n").expect("written");
    let plan = ImportPlan::new(archive.folder(), &map("labels.csv")).expect("a plan");
    let no_picture = plan
        .run(
            &lab.path().join("dataset"),
            std::num::NonZeroUsize::MIN,
            &taceva_core::SilentProgress,
        )
        .expect_err("no picture");
    let no_picture = said(no_picture);
    assert!(no_picture.contains(&member("1.png")), "{no_picture}");
    let text = archive.text_named(&format!("in {}/x", archive.folder().display()));
    assert_eq!(text, format!("in {}", member("x")));
}

#[test]
fn an_archive_gives_the_dataset_of_the_folder_packed_or_compressed() {
    let lab = tempfile::tempdir().expect("a folder");
    let plain = lab.path().join("run.tar");
    packed(&drawn("bristol"), &plain);
    let digest = |source: &Path, name: &str| {
        let map = preset("bristol").map(source).expect("a map");
        import(source, &map, &lab.path().join(name)).digest()
    };
    let expected = digest(&drawn("bristol"), "folder");
    for path in [plain.clone(), gzipped(&plain)] {
        assert!(UnpackedArchive::is_archive(&path));
        let unpacked = UnpackedArchive::open(&path, lab.path(), &SilentProgress).expect("unpacked");
        let name = path
            .extension()
            .expect("one")
            .to_string_lossy()
            .into_owned();
        assert_eq!(digest(unpacked.folder(), &name), expected);
        let draft = MapDraft::of(unpacked.folder()).expect("a draft");
        assert!(draft.text().contains("--preset bristol"));
    }
    // The unpacked files are removed.
    assert!(!lab.path().join(".run.tar.unpacked.partial").exists());
    let names = std::fs::read_dir(lab.path()).expect("there").flatten();
    let hidden = names.filter(|entry| entry.file_name().to_string_lossy().contains("unpacked"));
    assert_eq!(hidden.count(), 0);
}

#[test]
fn long_names_of_posix_and_gnu_are_read() {
    let lab = tempfile::tempdir().expect("a folder");
    let path = lab.path().join("a.tar");
    let long = format!("{}/{}.csv", "folder".repeat(20), "name".repeat(30));
    let mut tar = Builder::new(File::create(&path).expect("created"));
    let mut about = Header::new_gnu();
    about.set_size(2);
    about.set_cksum();
    tar.append_data(&mut about, &long, &b"x\n"[..])
        .expect("packed");
    tar.append_pax_extensions([("path", "posix/Größe.csv".as_bytes())])
        .expect("packed");
    let about = header(b"short", 2, EntryType::Regular);
    tar.append(&about, &b"y\n"[..]).expect("packed");
    tar.finish().expect("written");
    let unpacked = UnpackedArchive::open(&path, lab.path(), &SilentProgress).expect("unpacked");
    assert_eq!(
        std::fs::read(unpacked.folder().join(long)).expect("there"),
        b"x\n"
    );
    assert_eq!(
        std::fs::read(unpacked.folder().join("posix/Größe.csv")).expect("there"),
        b"y\n"
    );
}

#[test]
fn hostile_archives_are_refused_by_member_and_leave_nothing_behind() {
    let lab = tempfile::tempdir().expect("a folder");
    let file = |name: &[u8], size, kind| header(name, size, kind).as_bytes().to_vec();
    let regular = EntryType::Regular;
    let mut wrong_sum = file(b"a", 0, regular);
    wrong_sum[0] = b'b';
    let mut binary_sum = file(b"a", 0, regular);
    binary_sum[148] = 0x80;
    let twice = [file(b"a", 0, regular), file(b"a", 0, regular)].concat();
    for (name, bytes, expected) in [
        (
            "leaves",
            file(b"../../etc/a", 0, regular),
            "contains `..`, expected a path inside the folder",
        ),
        ("absolute", file(b"/etc/a", 0, regular), "absolute"),
        ("link", file(b"a", 0, EntryType::Symlink), "is a link"),
        ("hard link", file(b"a", 0, EntryType::Link), "is a link"),
        (
            "device",
            file(b"a", 0, EntryType::Char),
            "neither a file nor a folder",
        ),
        (
            "sparse",
            file(b"a", 0, EntryType::GNUSparse),
            "is a sparse file",
        ),
        (
            "size",
            file(b"a", 1 << 32, regular),
            "states 4294967296 bytes",
        ),
        (
            "long name",
            file(b"a", 1 << 30, EntryType::GNULongName),
            "a name of 1073741824 bytes",
        ),
        ("sum", wrong_sum, "header at byte 0 has a wrong checksum"),
        (
            "binary sum",
            binary_sum,
            "header at byte 0 has a wrong checksum",
        ),
        ("twice", twice, "the archive holds"),
        ("no text", file(b"\xff\xfe", 0, regular), "not Unicode text"),
    ] {
        let message = refused(&written(lab.path(), &[&bytes, &END]));
        assert!(message.contains(expected), "{name}: {message}");
        assert!(message.contains("a.tar"), "{name}: {message}");
    }
    let sparse = b"22 GNU.sparse.major=1\n";
    let mut padded = sparse.to_vec();
    padded.resize(512, 0);
    let records = file(b"x", sparse.len() as u64, EntryType::XHeader);
    let message = refused(&written(lab.path(), &[&records, &padded, &END]));
    assert!(message.contains("sparse file"), "{message}");
    let cut = file(b"a", 0, regular);
    assert!(refused(&written(lab.path(), &[&cut])).contains("cut short"));
    assert!(refused(&written(lab.path(), &[&cut[..300]])).contains("cut short"));
    assert!(refused(&written(lab.path(), &[b"no tar"])).contains("cut short"));
}

#[test]
fn compressed_bombs_and_cut_ones_are_refused() {
    let lab = tempfile::tempdir().expect("a folder");
    let size = 256_u64 << 20;
    let plain = lab.path().join("a.tar");
    {
        let mut tar = Builder::new(GzEncoder::new(
            File::create(&plain).expect("created"),
            Compression::fast(),
        ));
        let about = header(b"zeros", size, EntryType::Regular);
        tar.append(&about, std::io::Read::take(std::io::repeat(0), size))
            .expect("packed");
        tar.into_inner().expect("ended").finish().expect("written");
    }
    assert!(
        refused(&plain).contains("more than 128 times"),
        "{}",
        refused(&plain)
    );
    let small = lab.path().join("b.tar");
    packed(&drawn("tacquad"), &small);
    let gzip = gzipped(&small);
    let bytes = std::fs::read(&gzip).expect("there");
    std::fs::write(&gzip, &bytes[..bytes.len() / 2]).expect("written");
    assert!(refused(&gzip).contains("b.tar.gz"));
    // The checksum of the whole follows all data.
    let mut wrong_sum = bytes.clone();
    let sum = wrong_sum.len() - 8;
    wrong_sum[sum] ^= 1;
    std::fs::write(&gzip, wrong_sum).expect("written");
    assert!(refused(&gzip).contains("b.tar.gz"));
    std::fs::write(&gzip, &bytes[..bytes.len() - 4]).expect("written");
    assert!(refused(&gzip).contains("b.tar.gz"));
}

#[test]
fn more_than_a_million_members_are_refused() {
    let lab = tempfile::tempdir().expect("a folder");
    let path = lab.path().join("a.tar");
    // Global headers count as members, not as empty files.
    let folder = header(b"pax_global_header", 0, EntryType::XGlobalHeader);
    {
        let mut file = std::io::BufWriter::new(File::create(&path).expect("created"));
        for _ in 0..=(1 << 20) {
            file.write_all(folder.as_bytes()).expect("written");
        }
    }
    assert!(refused(&path).contains("more than 1048576 members"));
}

#[test]
fn every_cut_and_every_flipped_bit_of_a_shard_is_refused_or_read() {
    let lab = tempfile::tempdir().expect("a folder");
    let own = drawn("fota").join("data-000000.tar");
    let bytes = std::fs::read(own).expect("there");
    let path = lab.path().join("data-000000.tar");
    std::fs::write(&path, &bytes).expect("written");
    let map = ImportMap::parse(
        "map.toml".as_ref(),
        &preset("fota").text(lab.path()).expect("a map"),
    )
    .expect("a map");
    let mut refused = 0;
    for number in 0..400_usize {
        let mut damaged = bytes.clone();
        match number % 4 {
            0 => damaged.truncate(bytes.len() * number / 400),
            _ => damaged[number * 7 % 2048] ^= 1 << (number % 8),
        }
        std::fs::write(&path, damaged).expect("written");
        if let Err(error) = ImportPlan::new(lab.path(), &map) {
            refused += 1;
            assert!(!error.to_string().contains("panicked"), "{error}");
        }
    }
    assert!(refused > 100, "{refused}");
}
