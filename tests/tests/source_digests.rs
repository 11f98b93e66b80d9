//! A folder is compared with a list of digests before its import, and with the imported files afterwards.

use std::path::Path;
use std::process::Command;

use taceva_dataset::Digest;
use taceva_tests::{Form, Lab, scratch, taceva};

/// Exit code, standard output and standard error of a command.
fn said(arguments: &[&Path]) -> (Option<i32>, String, String) {
    let output = Command::new(taceva())
        .args(arguments)
        .output()
        .expect("the program was built");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

/// Output of `sha256sum` for the files in the folder of `lab`.
fn sums(lab: &Lab) -> String {
    let mut list = String::new();
    let frames = lab.path().join("frames");
    let mut names: Vec<String> = frames
        .read_dir()
        .expect("there")
        .flatten()
        .map(|entry| format!("frames/{}", entry.file_name().to_string_lossy()))
        .collect();
    names.extend(["labels.csv".to_owned(), "map.toml".to_owned()]);
    for name in names {
        let bytes = std::fs::read(lab.path().join(&name)).expect("there");
        let digest = Digest::of(&bytes).to_string();
        list += &format!("{}  ./{name}\n", &digest["sha256:".len()..]);
    }
    list
}

#[test]
fn changed_absent_and_unnamed_files_are_refused_by_name_before_an_import_and_named_after_it() {
    let lab = Lab::drawn(Form::Png, 6);
    let folder = scratch();
    let [list, set] = ["SHA256SUMS", "set"].map(|name| folder.path().join(name));
    std::fs::write(&list, sums(&lab)).expect("written");
    let (map, source) = (lab.map(), lab.path());
    let words = |word: &'static str| Path::new(word);
    let import = || {
        said(&[
            words("import"),
            source,
            words("--map"),
            &map,
            words("--out"),
            &set,
            words("--force"),
            words("--verify"),
            &list,
        ])
    };
    let check = || said(&[words("check"), &set, words("--source"), source]);
    let (code, _, err) = import();
    assert_eq!(code, Some(0), "{err}");
    let (code, out, err) = check();
    assert_eq!(code, Some(0), "{err}");
    assert!(out.contains("matches the imported files"), "{out}");

    let labels = source.join("labels.csv");
    let text = std::fs::read_to_string(&labels).expect("there");
    std::fs::write(&labels, text.replace("1.000", "7.000")).expect("written");
    std::fs::remove_file(lab.picture(Form::Png, 3)).expect("removed");
    std::fs::write(source.join("notes.txt"), "mine").expect("written");
    let (code, _, err) = import();
    assert_eq!(code, Some(3), "{err}");
    for part in [
        "labels.csv has changed",
        "frames/003.png is absent",
        "notes.txt is not named in the list",
    ] {
        assert!(err.contains(part), "{part}: {err}");
    }
    // No file was replaced, and the two files read are named.
    let (code, out, err) = check();
    assert_eq!(code, Some(1), "{err}");
    assert!(out.contains("labels.csv has changed"), "{out}");
    assert!(out.contains("frames/003.png is absent"), "{out}");
    assert!(out.contains("2 files of"), "{out}");
    assert!(!out.contains("notes.txt"), "{out}");
}

#[test]
fn a_dataset_with_added_rows_knows_each_folder_and_a_damaged_list_is_refused() {
    let folder = scratch();
    let set = folder.path().join("set");
    let labs = [Lab::drawn(Form::Png, 4), Lab::drawn_from(Form::Png, 500, 4)];
    let words = |word: &'static str| Path::new(word);
    for (lab, out) in labs.iter().zip(["--out", "--extend"]) {
        let map = lab.map();
        let arguments = [
            words("import"),
            lab.path(),
            words("--map"),
            &map,
            words(out),
            &set,
        ];
        let (code, _, err) = said(&arguments);
        assert_eq!(code, Some(0), "{err}");
    }
    for lab in &labs {
        let (code, out, err) = said(&[words("check"), &set, words("--source"), lab.path()]);
        assert_eq!(code, Some(0), "{out}{err}");
    }
    let list = set.join("sources.sha256");
    let text = std::fs::read_to_string(&list).expect("kept");
    assert!(text.contains("  frames/500.png\n") && text.contains("  frames/000.png\n"));
    std::fs::write(&list, text.replace("frames/500.png", "frames/501.png")).expect("written");
    let (code, _, err) = said(&[words("check"), &set, words("--source"), labs[0].path()]);
    assert_eq!(code, Some(3), "{err}");
    assert!(err.contains("sources.sha256"), "{err}");
}
