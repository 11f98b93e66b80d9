use super::*;

fn group(paths: &[&str]) -> FileGroup {
    FileGroup {
        paths: paths.iter().map(|path| (*path).to_owned()).collect(),
        ending: "npy".to_owned(),
        parts: super::super::path_parts::varying(paths).expect("of one depth"),
    }
}

#[test]
fn each_of_several_tables_has_the_array_beside_it_and_of_one_array_the_index_is_open() {
    let of = |tables: &[&str], files: &[&str]| {
        let found = Beside::of(&group(tables), &group(files));
        (found.file, found.comment.is_some(), found.index.is_some())
    };
    let sessions = ["s0/force.npy", "s1/force.npy", "s12/force.npy"];
    assert_eq!(
        of(
            &sessions,
            &["s0/frames.npy", "s1/frames.npy", "s12/frames.npy"]
        ),
        ("s{path.s}/frames.npy".to_owned(), false, false)
    );
    assert_eq!(
        of(&sessions, &["frames.npy"]),
        ("frames.npy".to_owned(), false, true)
    );
    // Two tables and three files do not pair up.
    assert_eq!(
        of(&sessions, &["s0/frames.npy", "s1/frames.npy"]),
        ("?".to_owned(), true, false)
    );
    let one = ["force.npy"];
    assert_eq!(
        of(&one, &["frames.npy"]),
        ("frames.npy".to_owned(), false, false)
    );
    assert_eq!(
        of(&one, &["frames_00.npy", "frames_01.npy"]),
        ("frames_*.npy".to_owned(), true, false)
    );
    // Sorted by name, 10 precedes 2.
    assert_eq!(
        of(&one, &["frames_10.npy", "frames_2.npy"]),
        ("?".to_owned(), true, false)
    );
}
