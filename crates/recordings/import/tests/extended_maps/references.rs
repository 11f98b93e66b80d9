//! Tests of frames without contact that rows name. If all rows name the same frame, it belongs to the recording; otherwise the names become an attribute.

use std::num::NonZeroUsize;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::ImportSummary;

use super::arrays::npy;
use super::{NO_TIME, lab, planned};

/// Summary, dataset and folder of an import of three rows that name the pictures without contact `named`.
fn imported(named: [&str; 3]) -> Result<(ImportSummary, Dataset, tempfile::TempDir), String> {
    let rows = named.iter().enumerate().map(|(at, name)| {
        format!("{{\"frame\": \"{at}.png\", \"ref\": \"{name}\", \"Fz\": {at}}}\n")
    });
    let folder = lab(&[("data/labels.jsonl", &rows.collect::<String>())]);
    for (at, name) in ["0.png", "1.png", "2.png", "ref_a.png", "ref_b.png"]
        .iter()
        .enumerate()
    {
        let gray = u8::try_from(10 * at).expect("dark");
        image::GrayImage::from_pixel(8, 8, image::Luma([gray]))
            .save(folder.path().join(name))
            .expect("saved");
    }
    let map = format!(
        "table = \"data/labels.jsonl\"\n[frame]\ncolumn = \"/frame\"\nfolder = \".\"\nchannel_order = \"gray\"\nreference = {{ column = \"/ref\" }}\n[columns]\nFz = {{ from = \"/Fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    let plan = planned(folder.path(), &map)?;
    let summary = plan.summary().clone();
    let target = tempfile::tempdir().expect("a folder");
    let path = target.path().join("dataset");
    plan.run(&path, NonZeroUsize::MIN, &SilentProgress)
        .map_err(|error| error.to_string())?;
    Ok((summary, Dataset::open(&path).expect("a dataset"), target))
}

#[test]
fn a_reference_that_all_rows_name_is_that_of_the_recording() {
    let (summary, dataset, _target) = imported(["ref_a.png"; 3]).expect("imported");
    assert_eq!(summary.frames[0].references, 0);
    let reference = dataset.reference().expect("read").expect("there");
    assert_eq!(reference.bytes()[0], 30);
    assert_eq!(dataset.table().attribute_names(), [""; 0]);
    // The other file is a picture that no row names.
    assert_eq!(summary.unnamed_images, 1);
}

#[test]
fn references_that_differ_are_an_attribute_and_the_summary_says_so() {
    let (summary, dataset, _target) = imported(["ref_a.png", "ref_b.png", ""]).expect("imported");
    assert!(dataset.reference().expect("read").is_none());
    let names = dataset.table().as_text("reference").expect("an attribute");
    assert_eq!(
        names,
        [
            Some("ref_a.png".to_owned()),
            Some("ref_b.png".to_owned()),
            None
        ]
    );
    let words = summary.to_string();
    assert!(
        words.contains("2 different pictures, named by the attribute `reference`"),
        "{words}"
    );
    assert_eq!(summary.unnamed_images, 0);
    // A reference that some rows lack is not that of the recording.
    let (_, dataset, _target) = imported(["ref_a.png", "", "ref_a.png"]).expect("imported");
    assert!(dataset.reference().expect("read").is_none());
}

#[test]
fn a_reference_that_is_not_there_names_its_row() {
    let problem = imported(["ref_a.png", "ref_c.png", "ref_a.png"]).expect_err("refused");
    assert!(problem.contains("ref_c.png"), "{problem}");
    assert!(problem.contains("labels.jsonl, line 2"), "{problem}");
}

/// Level of the picture without contact after an import of arrays of three frames each, with the levels 10, 20 and 30.
fn within(arrays: &str, reference: &str) -> Result<u8, String> {
    let folder = lab(&[("labels.csv", "run,k,Fz\n0,0,1\n0,1,2\n1,0,3\n")]);
    for run in ["0.npy", "1.npy"] {
        let pixels: Vec<u8> = [10, 20, 30]
            .into_iter()
            .flat_map(|level| [level; 64])
            .collect();
        let frames = npy("|u1", "(3, 8, 8)", &pixels);
        std::fs::write(folder.path().join(run), frames).expect("written");
    }
    let map = format!(
        "table = \"labels.csv\"\n[frame]\n{arrays}\nchannel_order = \"gray\"\nreference = {reference}\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    let plan = planned(folder.path(), &map)?;
    let words = plan.summary().to_string();
    assert!(words.contains("npy#2"), "{words}");
    let path = folder.path().join("dataset");
    plan.run(&path, NonZeroUsize::MIN, &SilentProgress)
        .map_err(|error| error.to_string())?;
    let dataset = Dataset::open(&path).expect("a dataset");
    let reference = dataset.reference().expect("read").expect("there");
    Ok(reference.bytes()[0])
}

#[test]
fn a_frame_of_an_array_or_a_clip_is_the_reference_by_its_number() {
    let one = "array = { file = \"0.npy\" }\nindex = \"k\"";
    assert_eq!(within(one, "{ frame = 2 }"), Ok(30));
    for (arrays, reference, words) in [
        (one, "{ frame = 3 }", "no frame 3: there are 3"),
        (
            "array = { file = \"{run}.npy\" }\nindex = \"k\"",
            "{ frame = 2 }",
            "needs one file with all pictures",
        ),
        (
            "column = \"run\"",
            "{ frame = 2 }",
            "write the path of the picture",
        ),
        (one, "{ frames = 2 }", "{ frame = … } of the clip or array"),
    ] {
        let problem = within(arrays, reference).expect_err("refused");
        assert!(problem.contains(words), "{words}: {problem}");
    }
}
