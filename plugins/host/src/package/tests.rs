//! Valid packages, and invalid forged ones.

use std::path::Path;

use sha2::{Digest, Sha256};
use tar::{Builder, EntryType, Header};

use super::*;
use crate::Sha256Digest;
use crate::manifest::platform;
use crate::search::{Plugins, SearchPath};

fn manifest() -> String {
    format!(
        r#"manifest_version = 1
id = "org.example.lamp"
name = "a lamp"
version = "1.0.0"
license = "MIT"
abi = {{ major = 1, minor = 0 }}
library.{}.path = "lib/lamp.so"
library.windows-aarch64.path = "lamp.dll"

[[provides]]
kind = "lighting"
key = "lamp"
title = "lamp"
source = "real"
scenes = ["dark", "room"]
"#,
        platform()
    )
}

/// Archive entry: name, type and bytes.
type Part<'a> = (&'a str, EntryType, &'a [u8]);

fn plain<'a>(name: &'a str, bytes: &'a [u8]) -> Part<'a> {
    (name, EntryType::Regular, bytes)
}

/// Writes an archive of `parts` without checking their names.
fn archive(parts: &[Part<'_>]) -> Vec<u8> {
    let mut archive = Builder::new(Vec::new());
    for (name, kind, bytes) in parts {
        let mut header = Header::new_ustar();
        header.as_old_mut().name[..name.len()].copy_from_slice(name.as_bytes());
        header.set_entry_type(*kind);
        header.set_size(bytes.len() as u64);
        if matches!(kind, EntryType::Symlink | EntryType::Link) {
            header.set_link_name("/etc/passwd").expect("short");
        }
        header.set_cksum();
        archive.append(&header, *bytes).expect("into memory");
    }
    archive.into_inner().expect("into memory")
}

fn digests(files: &[(&str, &[u8])]) -> String {
    let line = |(name, bytes): &(&str, &[u8])| {
        format!("{}  {name}\n", Sha256Digest(Sha256::digest(bytes).into()))
    };
    files.iter().map(line).collect()
}

/// Result of unpacking the manifest, the digest of the library, the library, and `parts`.
fn with(parts: &[Part<'_>]) -> Result<(), String> {
    let (manifest, digests) = (manifest(), digests(&[("lib/lamp.so", b"code")]));
    let mut all = vec![
        plain("plugin.toml", manifest.as_bytes()),
        plain("SHA256SUMS", digests.as_bytes()),
        plain("lib/lamp.so", b"code"),
    ];
    all.extend(parts);
    unpacked(&archive(&all))
}

/// Unpacks into a folder and checks that nothing is written beside it.
fn unpacked(archive: &[u8]) -> Result<(), String> {
    let around = tempfile::tempdir().expect("a folder");
    let folder = around.path().join("folder");
    std::fs::create_dir(&folder).expect("made");
    let result = unpack(archive, &folder).map_err(|error| error.to_string());
    let beside = std::fs::read_dir(around.path()).expect("readable");
    assert_eq!(beside.count(), 1, "something was written beside the folder");
    result
}

#[test]
fn what_is_packed_is_unpacked_and_the_same_plugin_gives_the_same_bytes() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("below")).expect("made");
        std::fs::write(path, text).expect("written");
    };
    file("plugin.toml", &manifest());
    file("lib/lamp.so", "code");
    file("LICENSE-MIT", "as is");
    file("src/secret.c", "not packed");
    let found = Plugins::search(SearchPath::empty().given([folder.path().to_owned()]), &[]);
    let plugin = found.get("org.example.lamp").expect("found");
    let (mut once, mut again) = (Vec::new(), Vec::new());
    let names = pack(plugin, &mut once).expect("packed");
    assert_eq!(
        names,
        ["plugin.toml", "SHA256SUMS", "LICENSE-MIT", "lib/lamp.so"]
    );
    pack(plugin, &mut again).expect("packed");
    assert_eq!(once, again);
    let into = tempfile::tempdir().expect("a folder");
    unpack(&once[..], into.path()).expect("unpacked");
    let read = |name: &str| std::fs::read_to_string(into.path().join(name)).expect(name);
    assert_eq!(read("plugin.toml"), manifest());
    assert_eq!(read("lib/lamp.so"), "code");
    assert_eq!(read("LICENSE-MIT"), "as is");
    assert!(!into.path().join("src").exists());
}

#[test]
fn a_whole_archive_is_taken() {
    assert_eq!(with(&[]), Ok(()));
}

#[track_caller]
fn refused(result: Result<(), String>, words: &str) {
    let why = result.expect_err("it must not be taken");
    assert!(why.contains(words), "{why}");
}

#[test]
fn a_path_that_leads_out_is_refused() {
    for name in ["../lamp.so", "lib/../../lamp.so", "./../lamp.so"] {
        refused(with(&[plain(name, b"code")]), "leads out of the folder");
    }
}

#[test]
fn an_absolute_path_is_refused() {
    refused(
        with(&[plain("/opt/lamp.so", b"code")]),
        "leads out of the folder",
    );
}

#[test]
fn links_are_refused_hard_and_symbolic() {
    for kind in [EntryType::Symlink, EntryType::Link] {
        refused(with(&[("LICENSE", kind, b"")]), "a link");
    }
}

#[test]
fn folders_devices_and_pipes_are_refused() {
    for kind in [EntryType::Directory, EntryType::Char, EntryType::Fifo] {
        refused(
            with(&[("LICENSE", kind, b"")]),
            "expected only regular files",
        );
    }
}

#[test]
fn a_name_that_is_carried_by_another_entry_is_refused() {
    for kind in [
        EntryType::XHeader,
        EntryType::GNULongName,
        EntryType::XGlobalHeader,
    ] {
        refused(
            with(&[("LICENSE", kind, b"20 path=../x\n")]),
            "too long for a header",
        );
    }
}

#[test]
fn a_file_that_is_too_long_is_refused_before_it_is_read() {
    let (manifest, digests) = (manifest(), digests(&[]));
    let mut archive = archive(&[
        plain("plugin.toml", manifest.as_bytes()),
        plain("SHA256SUMS", digests.as_bytes()),
    ]);
    // Removes the end blocks and adds a header that states 100 GiB.
    archive.truncate(archive.len() - 1024);
    let mut header = Header::new_gnu();
    header.as_old_mut().name[..11].copy_from_slice(b"lib/lamp.so");
    header.set_entry_type(EntryType::Regular);
    header.set_size(100 << 30);
    header.set_cksum();
    archive.extend(header.as_bytes());
    refused(unpacked(&archive), "expected at most");
    let long = vec![b'x'; 1 << 21];
    refused(with(&[plain("LICENSE", &long)]), "expected at most");
    refused(
        unpacked(&self::archive(&[plain("plugin.toml", &long)])),
        "expected at most",
    );
}

#[test]
fn a_second_manifest_is_refused_wherever_it_lies() {
    let manifest = manifest();
    refused(
        with(&[plain("plugin.toml", manifest.as_bytes())]),
        "occurs twice",
    );
    refused(
        with(&[plain("lib/plugin.toml", manifest.as_bytes())]),
        "not named in the manifest",
    );
}

#[test]
fn what_the_manifest_does_not_name_is_refused() {
    refused(
        with(&[plain("lib/helper.so", b"code")]),
        "not named in the manifest",
    );
    refused(
        with(&[plain("lib/LICENSE", b"text")]),
        "not named in the manifest",
    );
}

#[test]
fn another_digest_none_or_one_of_nothing_is_refused() {
    let manifest = manifest();
    let parts = |digests: &str| {
        unpacked(&archive(&[
            plain("plugin.toml", manifest.as_bytes()),
            plain("SHA256SUMS", digests.as_bytes()),
            plain("lib/lamp.so", b"code"),
        ]))
    };
    refused(
        parts(&digests(&[("lib/lamp.so", b"core")])),
        "its sha256 is",
    );
    refused(parts(""), "does not name it");
    refused(parts("0  lib/lamp.so\n"), "line 1: expected 64");
    let both = digests(&[("lib/lamp.so", b"code"), ("lamp.dll", b"code")]);
    refused(parts(&both), "`lamp.dll` in the archive: it is missing");
    refused(with(&[plain("LICENSE", b"text")]), "does not name it");
}

#[test]
fn what_comes_in_another_order_is_cut_off_or_is_no_archive_is_refused() {
    let manifest = manifest();
    let library = archive(&[plain("lib/lamp.so", b"code")]);
    refused(unpacked(&library), "expected `plugin.toml` first");
    let without = archive(&[
        plain("plugin.toml", manifest.as_bytes()),
        plain("lib/lamp.so", b"code"),
    ]);
    refused(unpacked(&without), "expected `SHA256SUMS` second");
    refused(
        unpacked(&archive(&[])),
        "`plugin.toml` in the archive: it is missing",
    );
    let alone = archive(&[plain("plugin.toml", manifest.as_bytes())]);
    refused(
        unpacked(&alone),
        "`SHA256SUMS` in the archive: it is missing",
    );
    refused(unpacked(&alone[..512 + manifest.len() / 2]), "truncated");
    assert!(unpacked(&vec![b'x'; 2048]).is_err());
    let wrong = archive(&[plain("plugin.toml", b"id = 1")]);
    refused(unpacked(&wrong), "`plugin.toml` in the archive, ");
}

#[test]
fn every_cut_and_every_damaged_byte_of_a_header_is_refused_or_whole_and_never_a_panic() {
    let (manifest, digests) = (manifest(), digests(&[("lib/lamp.so", b"code")]));
    let whole = archive(&[
        plain("plugin.toml", manifest.as_bytes()),
        plain("SHA256SUMS", digests.as_bytes()),
        plain("lib/lamp.so", b"code"),
    ]);
    let folder = tempfile::tempdir().expect("a folder");
    for (number, cut) in (0..whole.len()).step_by(97).enumerate() {
        let into = folder.path().join(number.to_string());
        std::fs::create_dir(&into).expect("made");
        let taken = unpack(&whole[..cut], &into);
        let is_there = Path::new(&into).join("lib/lamp.so").exists();
        assert!(taken.is_err() || is_there, "cut at {cut}");
    }
    // Skips the checksum itself: one of its digits may become a space, which also means 0.
    for place in (0..148).chain(156..512) {
        let mut damaged = whole.clone();
        damaged[place] ^= 0x10;
        assert!(unpacked(&damaged).is_err(), "byte {place}");
    }
}
