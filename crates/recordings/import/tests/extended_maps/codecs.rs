//! Tests of clips of several codecs in one import. The dataset must record the codec of each.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;

use super::{NO_TIME, lab, planned};

#[test]
fn clips_of_two_codecs_are_each_named_and_their_unused_frames_counted() {
    let folder = lab(&[(
        "labels.csv",
        "clip,k,Fz\nbaseline,0,1\nbaseline,1,2\nhigh,3,3\n",
    )]);
    for (name, recording) in [
        ("baseline", "mp4-h264-baseline"),
        ("high", "mp4-h264-high-b"),
    ] {
        let recordings = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../tests/recordings");
        let mut clips = fs::read_dir(recordings.join(recording)).expect("a folder");
        let clip = clips.find_map(|entry| {
            let path = entry.expect("readable").path();
            path.extension()
                .is_some_and(|ending| ending == "mp4")
                .then_some(path)
        });
        let to = folder.path().join(format!("{name}.mp4"));
        fs::copy(clip.expect("a clip"), to).expect("copied");
    }
    let map = format!(
        "table = \"labels.csv\"\n[frame]\nvideo = \"{{clip}}.mp4\"\nindex = \"k\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    let plan = planned(folder.path(), &map).expect("planned");
    let target = tempfile::tempdir().expect("a folder");
    let path = target.path().join("dataset");
    plan.run(&path, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&path).expect("a dataset");
    let frames = dataset.header().frames.as_ref().expect("frames");
    let first = frames.codec.as_ref().expect("of a clip");
    let [other] = frames.other_codecs.as_slice() else {
        panic!("{:?}", frames.other_codecs)
    };
    assert_ne!(first.name, other.name);
    assert_eq!((first.lossy, other.lossy), (Some(true), Some(true)));
    assert_eq!((first.bits, other.bits), (None, None));
    let unused = &dataset.header().left_out.frames;
    assert_eq!(
        unused.keys().collect::<Vec<_>>(),
        ["baseline.mp4", "high.mp4"]
    );
    assert_eq!(unused["high.mp4"], unused["baseline.mp4"] + 1);
}
