//! Answers of interpreters, emulated by scripts. Tests with a real interpreter are in `python/tests`.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::{Place, Plugins, ReasonKind, SearchPath};

const MANIFEST: &str = r#"
manifest_version = 1
id = "org.example.scale"
name = "scale"
version = "1.0.0"
license = "MIT"

[program]
python = "lab_scale"
wire = 2

[[provides]]
kind = "force"
key = "scale"
title = "scale"
source = "real"
axes = ["Fz"]
"#;

struct Environment {
    folder: TempDir,
}

impl Environment {
    /// Folder with the package of a plugin and a package called `taceva`.
    fn new(manifest: &str) -> Environment {
        let folder = tempfile::tempdir().expect("a folder");
        for (file, text) in [
            ("lab_scale/__init__.py", ""),
            ("lab_scale/plugin.toml", manifest),
            ("taceva/plugin_child.py", ""),
        ] {
            let path = folder.path().join(file);
            fs::create_dir_all(path.parent().expect("in a folder")).expect("room");
            fs::write(path, text).expect("room");
        }
        Environment { folder }
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes an interpreter that runs `script`.
    fn interpreter(&self, script: &str) -> PathBuf {
        let path = self.path().join("python");
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).expect("room");
        fs::set_permissions(&path, Permissions::from_mode(0o755)).expect("ours");
        path
    }

    /// Writes an interpreter whose environment has the entry point `id` for `module`.
    fn naming(&self, id: &str, module: &str) -> PathBuf {
        let folder = self.path().display();
        self.interpreter(&format!(
            "cat <<'END'\nnoise of a start\n# taceva environment\nversion = \"3.11.0\"\nreadable = [\"{folder}\"]\npackage = \"{folder}/taceva\"\n[[plugins]]\nid = \"{id}\"\nmodule = \"{module}\"\nfolder = \"{folder}/{module}\"\nEND"
        ))
    }
}

fn found(interpreter: &Path) -> Plugins {
    Plugins::search_with(SearchPath::empty(), &[], &[interpreter.to_owned()])
}

/// Reason of the only rejection when the environment of `interpreter` is searched.
fn refused(interpreter: &Path) -> String {
    let found = found(interpreter);
    assert!(found.is_empty(), "{found:?}");
    let [rejection] = &found.rejections[..] else {
        panic!("{found:?}");
    };
    assert_eq!(rejection.place, Place::Python);
    rejection.to_string()
}

#[test]
fn a_plugin_is_found_by_the_entry_point_of_an_environment_and_run_by_its_interpreter() {
    let environment = Environment::new(MANIFEST);
    let interpreter = environment.naming("org.example.scale", "lab_scale");
    let found = found(&interpreter);
    assert!(found.rejections.is_empty(), "{found:?}");
    let plugin = found.get("org.example.scale").expect("found");
    assert_eq!(plugin.place, Place::Python);
    assert_eq!(
        plugin.module().map(|module| module.name.as_str()),
        Some("lab_scale")
    );
    let by = plugin.interpreter.as_ref().expect("known");
    assert_eq!(
        (by.program(), by.version()),
        (interpreter.as_path(), "3.11.0")
    );
}

#[test]
fn a_package_in_a_folder_is_run_by_the_first_interpreter_that_is_known() {
    let environment = Environment::new(MANIFEST);
    let path = || SearchPath::empty().given([environment.path().join("lab_scale")]);
    let alone = Plugins::search(path(), &[]);
    let plugin = alone.get("org.example.scale").expect("found");
    assert_eq!((plugin.place, &plugin.interpreter), (Place::Given, &None));
    let other = Environment::new(MANIFEST);
    let interpreter = other.interpreter(&format!(
        "echo '# taceva environment'; echo 'version = \"3.12.1\"'; echo 'readable = []'; echo 'package = \"{}/taceva\"'",
        other.path().display()
    ));
    let found = Plugins::search_with(path(), &[], std::slice::from_ref(&interpreter));
    let plugin = found.get("org.example.scale").expect("found");
    let by = plugin.interpreter.as_ref().expect("known");
    assert_eq!(by.program(), interpreter);
}

#[test]
fn an_entry_point_that_names_nothing_or_another_plugin_is_refused_with_its_name() {
    let environment = Environment::new(MANIFEST);
    let said = refused(&environment.naming("org.example.other", "lab_scale"));
    assert!(
        said.contains("the entry point `org.example.other`"),
        "{said}"
    );
    assert!(
        said.contains("the id in its manifest is `org.example.scale`"),
        "{said}"
    );
    let said = refused(&environment.naming("org.example.scale", "taceva"));
    assert!(
        said.contains(
            "it contains no plugin.toml; write it with `python -m taceva.plugin manifest taceva --write`"
        ),
        "{said}"
    );
    let newer = Environment::new(&MANIFEST.replace("wire = 2", "wire = 3"));
    let interpreter = newer.naming("org.example.scale", "lab_scale");
    let said = refused(&interpreter);
    assert!(
        said.contains("written for wire version 3, but this TacEva has 2"),
        "{said}"
    );
    assert_eq!(
        found(&interpreter).rejections[0].reason.kind(),
        ReasonKind::Wire
    );
}

#[test]
fn an_interpreter_that_is_gone_fails_says_nothing_or_lacks_the_package_is_named_with_the_remedy() {
    let environment = Environment::new(MANIFEST);
    let gone = environment.path().join("gone");
    let cases = [
        (gone.clone(), "expected the interpreter of an environment"),
        (PathBuf::from("python3"), "a relative path"),
        (environment.path().join("taceva"), "cannot be started"),
    ];
    for (interpreter, said) in cases {
        let why = refused(&interpreter);
        assert!(why.contains(said), "{why}");
    }
    for (script, said) in [
        (
            "echo 'no such option' >&2; exit 2",
            "no such option; expected Python 3.11 or later",
        ),
        ("echo hello", "it printed `hello\\n`"),
        (
            "echo '# taceva environment'; echo 'version = 3'",
            "cannot list its environment",
        ),
        (
            "echo '# taceva environment'; echo 'version = \"3.11.0\"'; echo 'readable = []'",
            "the package `taceva` is not installed in its environment",
        ),
        (
            "echo '# taceva environment'; echo 'version = \"3.11.0\"'; echo 'readable = []'; echo 'package = \"/usr\"'",
            "its package `taceva` is too old for plugins in Python",
        ),
    ] {
        let why = refused(&environment.interpreter(script));
        assert!(why.contains(said), "{script}: {why}");
    }
    let lacking = environment.interpreter(
        "echo '# taceva environment'; echo 'version = \"3.11.0\"'; echo 'readable = []'",
    );
    assert!(refused(&lacking).contains("-m pip install PATH/TO/dist/taceva-"));
    fs::set_permissions(&lacking, Permissions::from_mode(0o777)).expect("ours");
    assert!(refused(&lacking).contains("every user of this machine may write to"));
}

#[test]
fn a_manifest_that_does_not_lie_in_the_package_it_names_is_refused() {
    let environment = Environment::new(MANIFEST);
    let other = environment.path().join("lab_other");
    fs::rename(environment.path().join("lab_scale"), &other).expect("ours");
    let search = || Plugins::search(SearchPath::empty().given([other.clone()]), &[]);
    let said = search().rejections[0].to_string();
    assert!(
        said.contains("expected a folder called `lab_scale`"),
        "{said}"
    );
    let back = environment.path().join("lab_scale");
    fs::rename(&other, &back).expect("ours");
    fs::remove_file(back.join("__init__.py")).expect("ours");
    let found = Plugins::search(SearchPath::empty().given([back]), &[]);
    let said = found.rejections[0].to_string();
    assert!(
        said.contains("not a package, expected __init__.py beside the manifest"),
        "{said}"
    );
}
