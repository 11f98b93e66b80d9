//! Tests of clips beside logs with a separate clock.

use std::path::Path;

use taceva_video::{Decoders, Video};

use super::drafts::filled;
use super::{FACTS, draft, imported, lab, line, planned, summary};

const CLIP: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../../tests/recordings/mp4-h264-baseline/clip.mp4"
);

/// Table of a force that grows by 1 N per second, with rows at 10 Hz.
fn log() -> String {
    let rows = (0..40).map(|row| format!("{0:.1},{0:.1}\n", f64::from(row) * 0.1));
    format!("t,fz\n{}", rows.collect::<String>())
}

fn folder(log: &str) -> tempfile::TempDir {
    let folder = lab(&[("force.csv", log)]);
    std::fs::copy(Path::new(CLIP), folder.path().join("clip.mp4")).expect("copied");
    folder
}

fn map(form: &str, lag: &str) -> String {
    format!(
        "map_version = 2\ntable = {{ file = \"clip.mp4\", {form} }}\n[frame]\nvideo = \"clip.mp4\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\n\
         Fz = {{ from = \"ft.fz\", unit = \"N\" }}\n[time]\ncolumn = \"t\"\nunit = \"s\"\nclock = \"monotonic\"\n[[join]]\nname = \"ft\"\ntable = \"force.csv\"\n\
         time = {{ column = \"t\", unit = \"s\" }}\npick = \"linear\"\ntolerance_ms = 100\nlag_ms = {lag}\nunmatched = \"drop\"\n{FACTS}"
    )
}

#[test]
fn frames_of_a_clip_are_joined_to_a_log_by_their_rate_start_and_lag() {
    let folder = folder(&log());
    for (form, lag, rate, start) in [
        ("format = \"clip\", rate = 30", "0", 30.0, 0.0),
        (
            "format = \"clip\", rate = 25, start_s = 0.5",
            "0",
            25.0,
            0.5,
        ),
        ("format = \"clip\", rate = 12.5", "250", 12.5, 0.25),
    ] {
        let found = imported(folder.path(), &map(form, lag), "Fz");
        assert!(found.len() > 10, "{form}");
        for (frame, force) in (0..).zip(&found) {
            let expected = start + f64::from(frame) / rate;
            assert!(
                (force - expected).abs() < 1e-9,
                "{form}: {force} for {expected}"
            );
        }
    }
}

#[test]
fn frames_of_a_clip_without_a_rate_come_at_the_times_that_the_clip_states() {
    let folder = folder(&log());
    let clip = Video::open(CLIP.as_ref(), &Decoders::default()).expect("a clip");
    let times = clip.info().times_s.clone().expect("stated");
    for (form, start) in [
        ("format = \"clip\"", 0.0),
        ("format = \"clip\", start_s = 0.25", 0.25),
    ] {
        let found = imported(folder.path(), &map(form, "0"), "Fz");
        assert!(found.len() > 10, "{form}");
        for (time, force) in times.iter().zip(&found) {
            let expected = start + time - times[0];
            assert!(
                (force - expected).abs() < 1e-9,
                "{form}: {force} for {expected}"
            );
        }
    }
    // Lost frames leave a gap: an AVI of Motion JPEG whose seventh packet is empty.
    let avi = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../tests/recordings/avi-mjpeg");
    let clip = std::fs::read_dir(avi)
        .expect("listed")
        .flatten()
        .map(|entry| entry.path());
    let clip = clip
        .filter(|path| path.extension().is_some_and(|ending| ending == "avi"))
        .min();
    let clip = clip.expect("a clip");
    std::fs::copy(&clip, folder.path().join("clip.mp4")).expect("copied");
    let times = Video::open(&clip, &Decoders::default())
        .expect("a clip")
        .info()
        .times_s
        .clone();
    let times = times.expect("stated");
    let map = map("format = \"clip\"", "0").replace("\"gray\"", "\"rgb\"");
    let found = imported(folder.path(), &map, "Fz");
    assert!(found.len() > 3);
    for (time, force) in times.iter().zip(&found) {
        assert!((force - time).abs() < 1e-9, "{force} for {time}");
    }
}

#[test]
fn a_clip_with_a_rate_of_zero_or_with_keys_of_tables_is_refused() {
    let folder = folder(&log());
    for form in [
        "format = \"clip\", rate = 0",
        "format = \"clip\", rate = 30, header = true",
        "rate = 30",
    ] {
        let problem = planned(folder.path(), &map(form, "0")).map(|_| ());
        let problem = problem.expect_err("refused");
        assert!(
            problem.contains("`rate` (frames a second, above 0;"),
            "{problem}"
        );
    }
    std::fs::write(folder.path().join("clip.mp4"), "no clip").expect("written");
    let problem = planned(folder.path(), &map("format = \"clip\", rate = 30", "0")).map(|_| ());
    assert!(problem.expect_err("refused").contains("clip.mp4"));
}

#[test]
fn a_draft_pairs_frames_and_rows_by_their_number_only_where_there_are_as_many() {
    let clip = Video::open(CLIP.as_ref(), &Decoders::default()).expect("a clip");
    let frames = u32::try_from(clip.info().frames).expect("few");
    let table = |rows: u32| {
        let rows = (0..rows).map(|row| format!("{0:.1},{0:.1}\n", f64::from(row) * 0.1));
        format!("t,fz\n{}", rows.collect::<String>())
    };
    for (rows, expected) in [
        (frames, "index = \"row\""),
        (frames / 3, "index = \"?\""),
        (frames + 1, "index = \"?\""),
    ] {
        let draft = draft(folder(&table(rows)).path());
        let found = line(&draft, "index = ");
        assert!(found.starts_with(expected), "{draft}");
        let says_form = draft.contains(
            "format = \"clip\" } above, whose rows are the frames at the times that the clip states",
        );
        assert_eq!(says_form, rows != frames, "{draft}");
    }
}

#[test]
fn a_clip_of_a_much_shorter_time_than_its_table_is_not_to_be_joined_by_its_times() {
    let rows = (0..40).map(|row| format!("{0:.1},{0:.1}\n", f64::from(row) * 50.0));
    let table = format!("t_s,fz\n{}", rows.collect::<String>());
    let draft = draft(folder(&table).path());
    let found = line(&draft, "index = ");
    assert!(
        found.starts_with("index = \"?\"") && found.ends_with("do not join them by these times."),
        "{draft}"
    );
    assert!(draft.contains("the table over 1950.0 s"), "{draft}");
    assert!(!draft.contains("format = \"clip\""), "{draft}");
}

#[test]
fn a_text_file_with_the_time_of_each_frame_is_the_table_that_others_join() {
    let clip = Video::open(CLIP.as_ref(), &Decoders::default()).expect("a clip");
    let frames = u32::try_from(clip.info().frames).expect("few");
    let folder = folder(&log());
    let stamps = (0..frames).map(|frame| format!("{:.6}\n", 0.1 + f64::from(frame) / 30.0));
    let stamps: String = stamps.collect();
    std::fs::write(folder.path().join("clip_stamps.txt"), stamps).expect("written");
    std::fs::write(folder.path().join("notes.txt"), "pressed on Monday\n").expect("written");
    let text = draft(folder.path());
    let table = line(&text, "table = ");
    assert!(
        table.starts_with("table = { file = \"clip_stamps.txt\", header = false }"),
        "{text}"
    );
    assert_eq!(line(&text, "index = "), "index = \"row\"");
    // No file is passed over without a word.
    assert!(text.contains("\n# Not read: notes.txt\n"), "{text}");
    let forces = imported(folder.path(), &filled(&text), "Fz");
    assert_eq!(u32::try_from(forces.len()), Ok(frames));
    for (frame, force) in (0..).zip(forces) {
        let expected = 0.1 + f64::from(frame) / 30.0;
        assert!((force - expected).abs() < 1e-4, "{force} for {expected}");
    }
}

#[test]
fn a_clip_alone_is_drafted_with_its_frames_as_rows_and_imports_without_labels() {
    let clip = Video::open(CLIP.as_ref(), &Decoders::default()).expect("a clip");
    let folder = lab(&[("notes.txt", "x"), ("a.mp4", "no clip")]);
    let copy = |name: &str| {
        std::fs::copy(Path::new(CLIP), folder.path().join(name)).expect("copied");
    };
    copy("press.mp4");
    let found = draft(folder.path());
    let table = "table = { file = \"press.mp4\", format = \"clip\" }   # no table: ";
    assert!(line(&found, "table = ").starts_with(table), "{found}");
    assert!(
        line(&found, "# No file has labels").contains("labels.csv"),
        "{found}"
    );
    assert!(line(&found, "# Other clips: a.mp4.").contains("Draft each"));
    let summary = summary(folder.path(), &filled(&found));
    assert_eq!(summary.rows_kept, clip.info().frames);
    // A clip that is asked for comes before the first one.
    copy("second.mp4");
    let asked = draft(&folder.path().join("second.mp4"));
    assert!(
        line(&asked, "table = ").contains("file = \"second.mp4\""),
        "{asked}"
    );
    // Tables beside such a clip are not examined.
    assert!(asked.contains("\n# Only the clip was read. "), "{asked}");
    let unreadable = taceva_import::MapDraft::of(&folder.path().join("a.mp4"));
    let problem = unreadable.expect_err("no clip").to_string();
    assert!(problem.contains("no file here has labels"), "{problem}");
}

#[test]
fn a_clip_beside_pictures_is_drafted_if_it_is_asked_for_or_there_is_one_picture() {
    let folder = lab(&[("untouched.png", "a picture")]);
    let clip = folder.path().join("press.mp4");
    std::fs::copy(Path::new(CLIP), &clip).expect("copied");
    let table = |path: &Path| line(&draft(path), "table = ").to_owned();
    assert!(table(folder.path()).contains("file = \"press.mp4\""));
    std::fs::write(folder.path().join("touched.png"), "a picture").expect("written");
    assert!(table(folder.path()).contains("files = "));
    assert!(table(&clip).contains("file = \"press.mp4\""));
}
