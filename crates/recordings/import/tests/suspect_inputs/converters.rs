//! Tests of files of unreadable forms. The message must name a package and a call that convert them.

use taceva_import::MapDraft;

use super::{NO_TIME, lab, planned_with};

fn refused_draft(files: &[(&str, &str)]) -> String {
    let folder = lab(files);
    let draft = MapDraft::of(folder.path());
    draft.expect_err("nothing is read").to_string()
}

#[track_caller]
fn assert_names(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "no `{word}` in {message}");
    }
}

#[test]
fn a_recording_of_rerun_leads_to_its_catalog_in_the_draft_and_in_the_map() {
    let words = [
        "rerun-sdk[catalog]",
        "datasets={\"d\": [\"run.rrd\"]}",
        "\"run.parquet\"",
    ];
    assert_names(&refused_draft(&[("run.rrd", "RRF2")]), &words);
    let folder = lab(&[("run.rrd", "RRF2")]);
    let refused = planned_with(folder.path(), &format!("table = \"run.rrd\"\n{NO_TIME}"));
    assert_names(&refused.expect_err("not read"), &words);
}

#[test]
fn a_folder_of_lance_leads_to_its_package_wherever_the_table_lies() {
    let inside = "frames.lance/data/0.lance";
    let words = [
        "lancedb.connect(\".\").open_table(\"frames\")",
        "\"frames.parquet\"",
    ];
    assert_names(&refused_draft(&[(inside, "x")]), &words);
    let deeper = refused_draft(&[("day 1/press.lance/_versions/1.manifest", "x")]);
    assert_names(
        &deeper,
        &["lancedb.connect(\"day 1\").open_table(\"press\")"],
    );
    // A JSON table inside the store is not the lab's.
    let hint = refused_draft(&[("press.lance/_versions/hint.json", "{\"Fz\": 1}")]);
    assert_names(&hint, &["open_table(\"press\")"]);
    let folder = lab(&[(inside, "x")]);
    let map = format!("table = \"frames.lance\"\n{NO_TIME}");
    let refused = planned_with(folder.path(), &map).expect_err("not read");
    assert_names(&refused, &words);
}

#[test]
fn clips_without_a_table_lead_to_the_table_that_is_missing() {
    for clip in ["a.mp4", "press.mkv", "day/1.avi"] {
        let message = refused_draft(&[(clip, "x"), ("notes.txt", "x")]);
        let video = format!("video = \"{clip}\"");
        assert_names(
            &message,
            &[
                video.as_str(),
                "index = \"frame\"",
                "labels.csv",
                "ffmpeg -i",
            ],
        );
    }
    let message = refused_draft(&[("notes.txt", "x")]);
    assert_names(&message, &["it contains no table and no picture"]);
}
