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
fn a_write_that_fails_leaves_the_old_file_and_nothing_beside_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a");
    fs::write(&path, "old").expect("written");
    let failed = replace(&path, |staged| {
        fs::write(staged, "ne")?;
        Err(io::Error::other("full"))
    });
    assert_eq!(failed.expect_err("full").to_string(), "full");
    assert_eq!(fs::read(&path).expect("there"), b"old");
    assert_eq!(names(folder.path()), ["a"]);
    replace(&path, |staged| fs::write(staged, "new")).expect("written");
    assert_eq!(fs::read(&path).expect("there"), b"new");
    assert_eq!(names(folder.path()), ["a"]);
}

#[test]
fn a_folder_between_two_renames_is_waited_for_and_put_back_once_its_process_is_dead() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("set");
    fs::create_dir(&target).expect("made");
    fs::write(target.join("x"), "old").expect("written");
    let staged = Staged::alone(&target).expect("room").expect("alone");
    let former = staged.folder.path().join("replaced-set");
    fs::rename(&target, &former).expect("renamed");
    let waiting = std::thread::spawn({
        let target = target.clone();
        move || settle(&target).map(|()| target.exists())
    });
    std::thread::sleep(Duration::from_millis(50));
    assert!(!target.exists(), "somebody is still at work");
    // Neither a new target in the same parent nor this drop clears the folder.
    drop(staged);
    assert!(waiting.join().expect("no panic").expect("settled"));
    assert_eq!(fs::read(target.join("x")).expect("back"), b"old");
    clear_leftovers(folder.path());
    assert_eq!(names(folder.path()), ["set"]);
}

#[test]
fn one_process_at_a_time_stages_a_target_that_is_asked_for_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("set");
    let first = Staged::alone(&target).expect("room").expect("alone");
    assert!(Staged::alone(&target).expect("room").is_none());
    let other = Staged::alone(&folder.path().join("other")).expect("room");
    assert!(other.is_some());
    drop(first);
    assert!(Staged::alone(&target).expect("room").is_some());
}

#[test]
fn a_folder_takes_the_place_of_another_with_and_without_an_exchange_of_names() {
    for can_exchange in [true, false] {
        let folder = tempfile::tempdir().expect("a folder");
        let target = folder.path().join("plugin");
        fs::create_dir(&target).expect("made");
        let staged = Staged::beside(&target).expect("room");
        fs::create_dir(staged.path()).expect("made");
        fs::write(staged.path().join("new"), "").expect("written");
        let placed = staged.put_in_place_by(|one, other| match can_exchange {
            true => exchange(one, other),
            false => Ok(false),
        });
        placed.expect("in place");
        assert_eq!(names(&target), ["new"], "{can_exchange}");
        assert_eq!(names(folder.path()), ["plugin"], "{can_exchange}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_or_a_socket_is_never_replaced_by_a_file() {
    use std::os::unix::fs::FileTypeExt;

    let folder = tempfile::tempdir().expect("room");
    let socket = folder.path().join("socket");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).expect("a socket");
    let refused = replace(&socket, |staged| fs::write(staged, "result"));
    let error: io::Error = refused.expect_err("refused");
    assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
    assert!(
        error.to_string().contains("a device, a pipe or a socket"),
        "{error}"
    );
    assert!(Staged::beside(&socket).is_err());
    let kind = fs::symlink_metadata(&socket).expect("there").file_type();
    assert!(kind.is_socket());
    // A link to one is kept too, and a link to an open file of the process, as /dev/stdout is.
    let link = folder.path().join("link");
    for to in [socket.as_path(), Path::new("/proc/self/exe")] {
        std::os::unix::fs::symlink(to, &link).expect("a link");
        assert!(Staged::beside(&link).is_err(), "{}", to.display());
        fs::remove_file(&link).expect("still there");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
}
