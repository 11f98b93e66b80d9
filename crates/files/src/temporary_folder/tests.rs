use super::*;

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("listed").flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn what_a_killed_process_left_is_cleared_and_what_is_held_is_not() {
    let parent = tempfile::tempdir().expect("a folder");
    let held = TemporaryFolder::create(parent.path(), ".x-").expect("made");
    let killed = parent.path().join(".x-killed");
    fs::create_dir(&killed).expect("made");
    fs::write(killed.join(MARKER), "").expect("written");
    fs::write(killed.join("labels.csv"), "Fz\n").expect("written");
    let second = TemporaryFolder::create(parent.path(), ".x-").expect("made");
    assert!(!killed.exists());
    assert!(held.path().exists() && second.path().exists());
    drop((held, second));
    assert_eq!(names(parent.path()), [""; 0]);
}

#[cfg(unix)]
#[test]
fn links_and_folders_without_the_marker_are_never_entered_or_removed() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let parent = tempfile::tempdir().expect("a folder");
    let theirs = tempfile::tempdir().expect("a folder");
    fs::write(theirs.path().join("dataset.toml"), "theirs").expect("written");
    fs::write(theirs.path().join(MARKER), "").expect("written");
    symlink(theirs.path(), parent.path().join(".x-linked")).expect("linked");
    let foreign = parent.path().join(".x-theirs");
    fs::create_dir(&foreign).expect("made");
    fs::write(foreign.join("thesis.tex"), "x").expect("written");
    let trap = parent.path().join(".x-trappd");
    fs::create_dir(&trap).expect("made");
    symlink(theirs.path().join(MARKER), trap.join(MARKER)).expect("linked");
    let made = TemporaryFolder::create(parent.path(), ".x-").expect("made");
    let mode = fs::metadata(made.path())
        .expect("there")
        .permissions()
        .mode();
    assert_eq!(mode & 0o777, 0o700);
    drop(made);
    assert_eq!(
        names(parent.path()),
        [".x-linked", ".x-theirs", ".x-trappd"]
    );
    assert_eq!(names(theirs.path()), [MARKER, "dataset.toml"]);
    assert!(foreign.join("thesis.tex").exists());
}

#[test]
fn what_is_read_stays_until_nobody_reads_it_and_an_empty_leftover_goes() {
    let parent = tempfile::tempdir().expect("a folder");
    let made = TemporaryFolder::create(parent.path(), ".x-").expect("made");
    let read = made.path().join("set");
    fs::create_dir(&read).expect("made");
    let reader = File::open(&read).expect("opened");
    reader.try_lock_shared().expect("locked");
    drop(made);
    assert!(read.exists(), "somebody reads it");
    fs::create_dir(parent.path().join(".x-killed")).expect("made");
    clear(parent.path(), ".x-");
    assert!(read.exists() && !parent.path().join(".x-killed").exists());
    drop(reader);
    clear(parent.path(), ".x-");
    assert_eq!(names(parent.path()), [""; 0]);
}
