use super::*;

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
    let path = first.path().to_owned();
    drop(first);
    fs::create_dir(&path).expect("a leftover");
    fs::write(path.join(layout::SAMPLES), "x").expect("written");
    let third = StagedFolder::create(&target, Place::Free).expect("cleared");
    third.put_in_place(&[]).expect("in place");
    assert_eq!(fs::read_dir(&target).expect("there").count(), 0);
}

#[test]
fn a_strangers_folder_in_the_way_is_named_and_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let theirs = folder.path().join(".set.partial");
    fs::create_dir(&theirs).expect("made");
    fs::write(theirs.join("thesis.tex"), "x").expect("written");
    let refused = StagedFolder::create(&folder.path().join("set"), Place::Free);
    let message = refused.expect_err("in the way").to_string();
    assert!(message.contains("holds `thesis.tex`"), "{message}");
    assert!(theirs.join("thesis.tex").exists());
}

/// K3.
#[cfg(unix)]
#[test]
fn a_link_at_the_hidden_name_of_a_dataset_is_refused_and_what_it_leads_to_stays() {
    for name in [".set.partial", ".set.replaced"] {
        let folder = tempfile::tempdir().expect("a folder");
        let theirs = tempfile::tempdir().expect("a folder");
        let theirs = dataset(theirs.path(), "theirs");
        std::os::unix::fs::symlink(&theirs, folder.path().join(name)).expect("linked");
        let target = folder.path().join("set");
        let created = StagedFolder::create(&target, Place::Free).map(drop);
        assert_eq!(created.is_err(), name == ".set.partial");
        if let Err(error) = created {
            assert!(error.to_string().contains("a link"), "{error}");
        }
        assert!(!target.exists());
        dataset(folder.path(), "old");
        replacement::settle(&target).expect("settled");
        let header = fs::read_to_string(theirs.join(layout::HEADER));
        assert_eq!(header.expect("there"), "theirs", "{name}");
    }
}

/// A folder called `set` that looks like a dataset.
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
fn a_dataset_is_replaced_with_and_without_an_exchange_of_names() {
    for can_exchange in [true, false] {
        let folder = tempfile::tempdir().expect("a folder");
        let target = dataset(folder.path(), "old");
        let exchange = |one: &Path, other: &Path| match can_exchange {
            true => replacement::exchange(one, other),
            false => Ok(false),
        };
        let placed = successor(&target).put_in_place_by(&[], exchange);
        placed.expect("in place");
        let header = fs::read_to_string(target.join(layout::HEADER)).expect("there");
        assert_eq!(
            (header.as_str(), names(folder.path())),
            ("new", vec!["set".to_owned()])
        );
    }
}

#[test]
fn what_stops_between_two_renames_is_put_back_by_whoever_looks_for_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = dataset(folder.path(), "old");
    let staged = successor(&target);
    // As a kill between the two leaves it, but for the lock.
    replacement::move_aside(&target, &target).expect("set aside");
    let waiting = std::thread::spawn({
        let target = target.clone();
        move || replacement::settle(&target).map(|()| target.exists())
    });
    std::thread::sleep(std::time::Duration::from_millis(50));
    assert!(!target.exists(), "somebody is still at work");
    std::mem::forget(staged);
    // The lock ends with the process; here it is the only handle that is forgotten, so a second folder stands for it.
    fs::rename(
        folder.path().join(".set.partial"),
        folder.path().join("gone"),
    )
    .expect("moved");
    assert!(waiting.join().expect("no panic").expect("settled"));
    assert_eq!(
        fs::read_to_string(target.join(layout::HEADER)).expect("back"),
        "old"
    );
}

#[test]
fn a_dataset_that_is_read_is_set_aside_and_cleared_once_it_is_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = dataset(folder.path(), "old");
    let reader = crate::folder_handle::HeldFolder::open(&target).expect("held");
    successor(&target).put_in_place(&[]).expect("in place");
    assert_eq!(reader.read(layout::HEADER, 9).expect("still there"), b"old");
    assert_eq!(names(folder.path()), [".set.replaced", "set"]);
    successor(&target)
        .put_in_place(&[])
        .expect("in place again");
    assert_eq!(reader.read(layout::HEADER, 9).expect("still there"), b"old");
    drop(reader);
    replacement::settle(&target).expect("cleared");
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
