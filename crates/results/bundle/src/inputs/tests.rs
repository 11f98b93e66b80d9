//! Tests of the limits of recordings with pictures.

use super::*;

#[test]
fn pictures_beyond_the_limits_are_refused_before_they_are_packed() {
    let folder = tempfile::tempdir().expect("a folder");
    let pack = std::fs::File::create(folder.path().join("0000.pack")).expect("room");
    let study = |files: usize| StudyInputs {
        frames: vec![PredictionFiles {
            folder: folder.path().to_owned(),
            files: vec!["0000.pack".to_owned(); files],
        }],
        ..StudyInputs::default()
    };
    let path = Path::new("result.json");
    assert!(check_frames(path, &[study(MOST_FRAMES)]).is_ok());
    let refused = check_frames(path, &[study(MOST_FRAMES + 1)]).expect_err("too many");
    let words = "3841 files of 0 bytes, expected at most 3840 pictures";
    assert!(refused.to_string().contains(words), "{refused}");
    pack.set_len(MOST_BYTES + 1).expect("a hole");
    let refused = check_frames(path, &[study(1)]).expect_err("too large");
    assert!(refused.to_string().contains("--dataset"), "{refused}");
}
