//! Tests that every form of an export contains the pictures of every view, and that its map restores them.

use std::num::NonZeroUsize;

use super::{ROWS, drafted, gripper, import, seen, two};
use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{ExportForm, ExportPlan, ImportMap, ImportPlan};

#[test]
fn every_form_brings_the_pictures_of_every_view_back() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let map = format!("{}[attributes]\nframe_left = \"note\"\n", two());
    let dataset = import(lab.path(), &map, &target.path().join("set")).expect("imported");
    for form in ExportForm::ALL {
        let folder = target.path().join(form.name());
        let plan = ExportPlan::new(&dataset, form).expect("samples");
        let report = plan
            .run(&folder, NonZeroUsize::MIN, &SilentProgress)
            .expect("exported");
        assert_eq!(
            (report.pictures, report.is_importable),
            (u64::from(2 * ROWS), true)
        );
        let map = ImportMap::read(&report.map).expect("a map");
        let again = target.path().join(format!("{}-again", form.name()));
        let plan = ImportPlan::new(&folder, &map).expect("planned");
        plan.run(&again, NonZeroUsize::MIN, &SilentProgress)
            .expect("imported");
        let again = Dataset::open(&again).expect("a dataset");
        assert_eq!(again.views(), ["left", "right"], "{}", form.name());
        for row in [0, 3, 5] {
            for view in ["left", "right", "left+right"] {
                assert_eq!(
                    seen(&again, view, row),
                    seen(&dataset, view, row),
                    "{} {view}",
                    form.name()
                );
            }
        }
        let sources = |dataset: &Dataset| {
            dataset
                .table()
                .view("right")
                .expect("a view")
                .source_frame()
                .to_vec()
        };
        assert_eq!(sources(&again), sources(&dataset), "{}", form.name());
        assert_eq!(
            again.table().attribute("frame_left"),
            dataset.table().attribute("frame_left")
        );
        // Picture files keep their bytes, and the dataset keeps its digest.
        if form != ExportForm::Hdf5 {
            assert_eq!(again.digest(), dataset.digest(), "{}", form.name());
        }
    }
}

#[test]
fn a_lerobot_dataset_of_two_cameras_and_two_arrays_of_hdf5_are_drafted_as_views() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let dataset = import(lab.path(), &two(), &target.path().join("set")).expect("imported");
    for (form, lines) in [
        (
            ExportForm::LeRobot,
            [
                "bytes = \"observation.images.left\"",
                "bytes = \"observation.images.right\"",
            ],
        ),
        (
            ExportForm::Hdf5,
            ["array = \"frames_left\"", "array = \"frames_right\""],
        ),
        (
            ExportForm::HuggingFace,
            ["bytes = \"image_left", "bytes = \"image_right"],
        ),
    ] {
        let folder = target.path().join(form.name());
        let plan = ExportPlan::new(&dataset, form).expect("samples");
        let report = plan
            .run(&folder, NonZeroUsize::MIN, &SilentProgress)
            .expect("exported");
        std::fs::remove_file(&report.map).expect("no map");
        let draft = drafted(&folder);
        for (view, line) in ["left", "right"].into_iter().zip(lines) {
            let expected = format!("[[frame]]\nname = \"{view}\"   # a guess");
            assert!(draft.contains(&expected) && draft.contains(line), "{draft}");
        }
        let map = with_units(&draft);
        let again = import(
            &folder,
            &map,
            &target.path().join(format!("{}-drafted", form.name())),
        );
        let again = again.unwrap_or_else(|problem| panic!("{problem}\n{map}"));
        for row in [0, 5] {
            for view in ["left", "right"] {
                assert_eq!(
                    seen(&again, view, row),
                    seen(&dataset, view, row),
                    "{} {view}",
                    form.name()
                );
            }
        }
    }
}

#[test]
fn two_cameras_of_lerobot_without_sides_are_drafted_as_views_and_one_is_imported_alone() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let map = two().replace("name = \"left\"", "name = \"gel\"");
    let map = map.replace("name = \"right\"", "name = \"wrist\"");
    let dataset = import(lab.path(), &map, &target.path().join("set")).expect("imported");
    let folder = target.path().join("lerobot");
    let plan = ExportPlan::new(&dataset, ExportForm::LeRobot).expect("samples");
    let report = plan.run(&folder, NonZeroUsize::MIN, &SilentProgress);
    std::fs::remove_file(&report.expect("exported").map).expect("no map");
    let draft = with_units(&drafted(&folder));
    for view in ["gel", "wrist"] {
        let frame = format!("[[frame]]\nname = \"{view}\"   # a guess");
        let feature = format!("bytes = \"observation.images.{view}\"");
        assert!(
            draft.contains(&frame) && draft.contains(&feature),
            "{draft}"
        );
    }
    let both = import(&folder, &draft, &target.path().join("both")).expect("imported");
    assert_eq!(seen(&both, "gel", 4), seen(&dataset, "gel", 4));
    assert_eq!(seen(&both, "wrist", 4), seen(&dataset, "wrist", 4));

    // One [frame] without a name, with the second key.
    let blocks: Vec<&str> = draft.split("[[frame]]\n").collect();
    let [head, _, last] = blocks.as_slice() else {
        panic!("{draft}");
    };
    let (_, last) = last.split_once('\n').expect("a name");
    let map = format!("{head}[frame]\n{last}");
    let one = import(&folder, &map, &target.path().join("one"));
    let one = one.unwrap_or_else(|problem| panic!("{problem}\n{map}"));
    assert!(one.views().is_empty());
    let picture = one.frame(4).expect("read").expect("a frame");
    let second = if last.contains("images.wrist") {
        "wrist"
    } else {
        "gel"
    };
    assert_eq!(picture.bytes(), seen(&dataset, second, 4));
}

/// Fills in the units and colours that a draft does not state.
fn with_units(draft: &str) -> String {
    let draft = draft.replace("\nunit = \"?\"", "\nunit = \"s\"");
    let draft = draft.replace("unit = \"?\"", "unit = \"N\"");
    draft.replace("channel_order = \"rgb\"", "channel_order = \"gray\"")
}
