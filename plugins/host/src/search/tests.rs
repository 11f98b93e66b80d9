//! Plugins that a search finds or rejects.

use std::os::unix::fs::{PermissionsExt, symlink};

use tempfile::TempDir;

use super::*;

const MANIFEST_TEXT: &str = r#"
manifest_version = 1
id = "ID"
name = "a lamp"
version = "1.0.0"
license = "MIT"
abi = { major = 1, minor = 0 }
library.linux-x86_64.path = "lib.so"
library.linux-aarch64.path = "lib.so"

[[provides]]
kind = "lighting"
key = "lamp"
title = "lamp"
source = "real"
scenes = ["dark"]
"#;

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

/// Writes a plugin into `within`/`name` and returns its folder.
fn plugin(within: &Path, name: &str, id: &str) -> PathBuf {
    let folder = within.join(name);
    fs::create_dir(&folder).expect("made");
    fs::write(folder.join(MANIFEST), MANIFEST_TEXT.replace("ID", id)).expect("written");
    fs::write(folder.join("lib.so"), b"never opened").expect("written");
    folder.canonicalize().expect("there")
}

fn searched(folder: &Path) -> Plugins {
    Plugins::search(SearchPath::empty().given([folder.to_owned()]), &[])
}

fn allow(path: &Path, mode: u32) {
    fs::set_permissions(path, fs::Permissions::from_mode(mode)).expect("ours");
}

/// The only rejection reason in `folder`, which has no valid plugin.
fn reason(folder: &Path) -> Reason {
    let mut plugins = searched(folder);
    assert!(plugins.is_empty());
    assert_eq!(plugins.rejections.len(), 1, "{:?}", plugins.rejections);
    plugins.rejections.remove(0).reason
}

#[test]
fn a_folder_holds_plugins_or_is_one() {
    let within = folder();
    let first = plugin(within.path(), "b", "org.example.b");
    plugin(within.path(), "a", "org.example.a");
    let ids = |plugins: &Plugins| -> Vec<String> {
        plugins
            .iter()
            .map(|plugin| plugin.id().to_string())
            .collect()
    };
    assert_eq!(
        ids(&searched(within.path())),
        ["org.example.a", "org.example.b"]
    );
    assert_eq!(ids(&searched(&first)), ["org.example.b"]);
}

#[test]
fn a_plugin_that_is_found_twice_by_its_path_is_one() {
    let within = folder();
    let lamp = plugin(within.path(), "lamp", "org.example.lamp");
    symlink(&lamp, within.path().join("link")).expect("linked");
    let path = SearchPath::empty().given([within.path().to_owned(), lamp]);
    let plugins = Plugins::search(path, &[]);
    assert_eq!((plugins.len(), plugins.rejections.len()), (1, 0));
}

#[test]
fn duplicate_ids_are_refused_naming_each_other_unless_one_is_preferred() {
    let within = folder();
    let one = plugin(within.path(), "one", "org.example.lamp");
    let two = plugin(within.path(), "two", "org.example.lamp");
    let plugins = searched(within.path());
    assert!(plugins.is_empty());
    let [first, second] = &plugins.rejections[..] else {
        panic!("both are refused: {:?}", plugins.rejections);
    };
    for (rejection, other) in [(first, &two), (second, &one)] {
        assert_eq!(rejection.reason.kind(), ReasonKind::Duplicate);
        let text = rejection.to_string();
        assert!(
            text.contains(&other.join(MANIFEST).display().to_string()),
            "{text}"
        );
    }
    let path = SearchPath::empty().given([within.path().to_owned()]);
    let plugins = Plugins::search(path, std::slice::from_ref(&two));
    assert_eq!(plugins.get("org.example.lamp").expect("chosen").folder, two);
    assert_eq!(plugins.rejections.len(), 1);
}

#[test]
fn of_duplicate_ids_the_one_whose_folder_is_given_is_used_and_the_other_says_so() {
    let within = folder();
    let installed = folder();
    let given = plugin(within.path(), "lamp", "org.example.lamp");
    let other = plugin(installed.path(), "lamp", "org.example.lamp");
    let both = SearchPath::empty().environment(installed.path().as_os_str());
    let plugins = Plugins::search(both.clone().given([given.clone()]), &[]);
    let chosen = plugins.get("org.example.lamp").expect("chosen");
    assert_eq!(chosen.folder, given);
    let [rejection] = &plugins.rejections[..] else {
        panic!("one is left out: {:?}", plugins.rejections);
    };
    assert_eq!(rejection.reason.kind(), ReasonKind::Duplicate);
    // The user's preference takes precedence over a folder from the command line.
    let plugins = Plugins::search(both.given([given]), std::slice::from_ref(&other));
    assert_eq!(
        plugins.get("org.example.lamp").expect("chosen").folder,
        other
    );
}

#[test]
fn what_every_user_may_write_is_refused() {
    let within = folder();
    let lamp = plugin(within.path(), "lamp", "org.example.lamp");
    for (path, mode) in [
        (lamp.clone(), 0o777),
        (lamp.join(MANIFEST), 0o666),
        (lamp.join("lib.so"), 0o777),
        (within.path().canonicalize().expect("there"), 0o1777),
    ] {
        let before = fs::metadata(&path).expect("there").permissions().mode();
        allow(&path, mode);
        let Reason::WorldWritable { path: refused } = reason(within.path()) else {
            panic!("{} is writable", path.display());
        };
        assert_eq!(refused, path);
        allow(&path, before);
    }
    assert_eq!(searched(within.path()).len(), 1);
}

#[test]
fn a_relative_folder_and_an_empty_one_in_the_variable_are_refused() {
    let path = SearchPath::empty().environment(std::ffi::OsStr::new("plugins::/absent"));
    let plugins = Plugins::search(path, &[]);
    let kinds: Vec<ReasonKind> = (plugins.rejections.iter())
        .map(|rejection| rejection.reason.kind())
        .collect();
    assert_eq!(kinds, [ReasonKind::Relative, ReasonKind::Relative]);
}

#[test]
fn a_library_that_is_a_folder_or_absent_is_refused() {
    let within = folder();
    let lamp = plugin(within.path(), "lamp", "org.example.lamp");
    fs::remove_file(lamp.join("lib.so")).expect("there");
    assert_eq!(reason(within.path()).kind(), ReasonKind::Library);
    fs::create_dir(lamp.join("lib.so")).expect("free");
    let reason = reason(within.path());
    assert!(
        reason.to_string().ends_with("lib.so: not a regular file"),
        "{reason}"
    );
}

#[test]
fn a_manifest_that_does_not_read_is_kept_with_its_reason() {
    let within = folder();
    let lamp = plugin(within.path(), "lamp", "org.example.lamp");
    let manifest = lamp.join(MANIFEST);
    let good = MANIFEST_TEXT.replace("ID", "org.example.lamp");
    let cases: [(Vec<u8>, ReasonKind); 6] = [
        (b"\xff\xfe".to_vec(), ReasonKind::NotText),
        (vec![b' '; (1 << 20) + 1], ReasonKind::NotText),
        (good.replace("title", "titel").into(), ReasonKind::Manifest),
        (
            good.replace("major = 1", "major = 2").into(),
            ReasonKind::Abi,
        ),
        (
            good.replace("linux-x86_64", "windows-x86_64")
                .replace("linux-aarch64", "macos-aarch64")
                .into(),
            ReasonKind::Platform,
        ),
        (
            good.replace("lib.so", "../lib.so").into(),
            ReasonKind::Manifest,
        ),
    ];
    for (bytes, kind) in cases {
        fs::write(&manifest, bytes).expect("written");
        assert_eq!(reason(within.path()).kind(), kind);
    }
    fs::remove_file(&manifest).expect("there");
    fs::create_dir(&manifest).expect("free");
    assert_eq!(reason(within.path()).kind(), ReasonKind::NotAFile);
    fs::remove_dir(&manifest).expect("empty");
    symlink("nowhere", &manifest).expect("linked");
    assert_eq!(reason(within.path()).kind(), ReasonKind::Unreadable);
}

#[test]
fn whoever_asks_for_a_plugin_that_is_not_there_hears_where_it_was_looked_for() {
    let within = folder();
    plugin(within.path(), "lamp", "org.example.lamp");
    let bad = plugin(within.path(), "bad", "org.example.bad");
    fs::write(bad.join(MANIFEST), "x = 1").expect("written");
    let error = searched(within.path())
        .get("org.example.lmap")
        .expect_err("absent");
    let text = error.to_string();
    for part in [
        "did you mean `org.example.lamp`?",
        "looked in",
        "(given)",
        "rejected",
        "bad/plugin.toml",
        "unknown key",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn a_typed_folder_must_be_there_and_any_other_need_not() {
    let absent = PathBuf::from("/nonexistent/plugins");
    assert_eq!(reason(&absent).kind(), ReasonKind::Unreadable);
    let path = SearchPath::empty().environment(absent.as_os_str());
    assert!(Plugins::search(path, &[]).rejections.is_empty());
}
