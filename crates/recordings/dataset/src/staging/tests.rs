use super::*;
use crate::layout;

#[test]
fn nothing_is_left_of_a_folder_that_is_not_put_in_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let staged = StagedFolder::create(&folder.path().join("set"), Place::Free).expect("created");
    fs::write(staged.path().join("x"), "x").expect("written");
    drop(staged);
    assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 0);
}

#[test]
fn a_second_writer_is_refused_and_a_leftover_is_cleared() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("set");
    let first = StagedFolder::create(&target, Place::Free).expect("created");
    let second = StagedFolder::create(&target, Place::Free);
    assert!(
        matches!(second, Err(DatasetError::Busy { .. })),
        "{second:?}"
    );
    drop(first);
    let dead = folder.path().join(".taceva-staged-a1b2c3");
    fs::create_dir_all(dead.join("set")).expect("a leftover");
    fs::write(dead.join("set").join(layout::SAMPLES), "x").expect("written");
    fs::write(dead.join(".taceva-temporary"), "").expect("written");
    let third = StagedFolder::create(&target, Place::Free).expect("cleared");
    third.put_in_place(&[]).expect("in place");
    assert_eq!(fs::read_dir(&target).expect("there").count(), 0);
    assert_eq!(names(folder.path()), ["set"]);
}

#[cfg(unix)]
#[test]
fn links_and_folders_of_strangers_at_hidden_names_stay_as_they_are() {
    for name in [".set.partial", ".set.replaced", ".taceva-staged-a1b2c3"] {
        for is_link in [true, false] {
            let folder = tempfile::tempdir().expect("a folder");
            let elsewhere = tempfile::tempdir().expect("a folder");
            let theirs = dataset(elsewhere.path(), "theirs");
            fs::write(theirs.join("thesis.tex"), "x").expect("written");
            let hidden = folder.path().join(name);
            match is_link {
                true => std::os::unix::fs::symlink(&theirs, &hidden).expect("linked"),
                false => fs::rename(&theirs, &hidden).expect("moved"),
            }
            let target = folder.path().join("set");
            let staged = StagedFolder::create(&target, Place::Free).expect("created");
            staged.put_in_place(&[]).expect("in place");
            fs::remove_dir(&target).expect("empty");
            let target = dataset(folder.path(), "old");
            successor(&target).put_in_place(&[]).expect("in place");
            let header = fs::read_to_string(hidden.join(layout::HEADER));
            assert_eq!(header.expect("there"), "theirs", "{name}");
            assert!(hidden.join("thesis.tex").exists());
            assert_eq!(names(folder.path()), [name, "set"]);
        }
    }
}

/// Folder called `set` with a dataset header that contains `words`.
fn dataset(folder: &Path, words: &str) -> PathBuf {
    let target = folder.join("set");
    fs::create_dir(&target).expect("made");
    fs::write(target.join(layout::HEADER), words).expect("written");
    target
}

fn successor(target: &Path) -> StagedFolder {
    let staged = StagedFolder::create(target, Place::OfDataset).expect("created");
    fs::write(staged.path().join(layout::HEADER), "new").expect("written");
    staged
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("there").flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_dataset_that_is_read_is_set_aside_and_cleared_once_it_is_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = dataset(folder.path(), "old");
    let reader = crate::folder_handle::HeldFolder::open(&target).expect("held");
    successor(&target).put_in_place(&[]).expect("in place");
    assert_eq!(reader.read(layout::HEADER, 9).expect("still there"), b"old");
    assert_eq!(names(folder.path()).len(), 2);
    successor(&target)
        .put_in_place(&[])
        .expect("in place again");
    assert_eq!(reader.read(layout::HEADER, 9).expect("still there"), b"old");
    drop(reader);
    taceva_files::clear_leftovers(folder.path());
    assert_eq!(names(folder.path()), ["set"]);
}

#[test]
fn nothing_but_a_dataset_is_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = dataset(folder.path(), "old");
    fs::write(target.join("notes.txt"), "mine").expect("written");
    let message = check_place(&target, Place::OfDataset)
        .expect_err("notes")
        .to_string();
    assert!(message.contains("holds `notes.txt`"), "{message}");
    let other = check_place(folder.path(), Place::OfDataset).expect_err("no dataset");
    assert!(
        other.to_string().contains("replaces only datasets"),
        "{other}"
    );
}
