//! Tests of wrenches and poses whose coordinate frame changes from row to row.

use taceva_import::Preset;

use super::{FACTS, NO_TIME, case, imported, lab, map_of, mean, planned, planned_with, summary};

const CASE: &str = "wrench-frame-changes";

/// MCAP recording of one topic of JSON messages, without chunks and without a summary.
fn json_recording(topic: &str, messages: &[String]) -> Vec<u8> {
    let text = |text: &str| {
        let mut bytes = u32::try_from(text.len())
            .expect("short")
            .to_le_bytes()
            .to_vec();
        bytes.extend_from_slice(text.as_bytes());
        bytes
    };
    let mut file = b"\x89MCAP0\r\n".to_vec();
    let mut record = |code: u8, fields: &[u8]| {
        file.push(code);
        file.extend_from_slice(&(fields.len() as u64).to_le_bytes());
        file.extend_from_slice(fields);
    };
    record(1, &[text(""), text("by hand")].concat());
    let channel = [
        &[1, 0, 0, 0][..],
        &text(topic),
        &text("json"),
        &0_u32.to_le_bytes(),
    ];
    record(4, &channel.concat());
    for (at, message) in messages.iter().enumerate() {
        let time = (1_000_000_000 * (at as u64 + 1)).to_le_bytes();
        let head = [&[1, 0, 0, 0, 0, 0][..], &time, &time, message.as_bytes()];
        record(5, &head.concat());
    }
    record(15, &[0; 4]);
    record(2, &[0; 20]);
    file.extend_from_slice(b"\x89MCAP0\r\n");
    file
}

fn json_wrenches(frames: &[&str]) -> Vec<String> {
    let message = |(at, frame): (usize, &&str)| {
        format!(
            "{{\"header\": {{\"frame_id\": \"{frame}\"}}, \"wrench\": {{\"force\": {{\"z\": {at}.5}}}}}}"
        )
    };
    frames.iter().enumerate().map(message).collect()
}

#[track_caller]
fn refused(problem: &Result<taceva_import::ImportPlan, String>, words: &[&str]) {
    let problem = problem.as_ref().expect_err("two frames");
    for word in words {
        assert!(problem.contains(word), "no `{word}` in {problem}");
    }
}

#[test]
fn a_joined_topic_whose_frame_changes_is_refused_with_both_frames_and_the_key_that_takes_one() {
    let folder = case(CASE);
    let map = map_of(CASE);
    let words = [
        "`ft.header.frame_id` has 2 frames: `base` here, at ",
        "`tool0` before",
        "`frame_id = \"tool0\"` in the [[join]] `ft`",
    ];
    refused(&planned(&folder, &map), &words);
    let preset = Preset::from_name("rosbag").expect("known").map(&folder);
    let by_preset = taceva_import::ImportPlan::new(&folder, &preset.expect("a map"));
    let problem = by_preset.expect_err("two frames").to_string();
    assert!(
        problem.contains("`base`") && problem.contains("`tool0`"),
        "{problem}"
    );
}

#[test]
fn the_frame_that_the_map_names_is_taken_alone_and_the_rest_is_counted() {
    let folder = case(CASE);
    let one = map_of(CASE).replace("name = \"ft\"", "name = \"ft\"\nframe_id = \"tool0\"");
    let summary = summary(&folder, &one);
    let counts = (summary.rows_kept, summary.joins[0].in_other_frames);
    assert_eq!(counts.0, 22, "{summary}");
    assert!(counts.1 > 100, "{summary}");
    assert!(
        summary
            .to_string()
            .contains("in other frames than tool0 left out"),
        "{summary}"
    );
    let forces = imported(&folder, &one, "Fz");
    assert!(forces.iter().all(|force| *force > 0.0), "{forces:?}");
    assert!(mean(&forces) > 0.5);
    let absent = one.replace("\"tool0\"", "\"flange\"");
    refused(
        &planned(&folder, &absent),
        &["`frame_id = \"flange\"`: its frames are `base`, `tool0`"],
    );
}

#[test]
fn a_topic_that_is_the_table_itself_has_one_frame_too() {
    let folder = case(CASE);
    let map = format!(
        "map_version = 2\ntable = {{ file = \"run.mcap\", rows = \"/ft/wrench\" }}\n[columns]\nFz = {{ from = \"wrench.force.z\", unit = \"N\" }}\n\
         [time]\nclock = \"unix\"\ncolumn = \"header.stamp\"\nunit = \"s\"\n{FACTS}"
    );
    refused(
        &planned(&folder, &map),
        &[
            "`header.frame_id` has 2 frames",
            "`frame_id = \"tool0\"` below `table`",
        ],
    );
    let one = map.replace("\n[columns]", "\nframe_id = \"tool0\"\n[columns]");
    let kept = summary(&folder, &one);
    let left_out = kept.dropped.get("frame_id other than tool0").copied();
    assert_eq!(kept.rows_kept + left_out.unwrap_or(0), 340, "{kept}");
    assert!(kept.rows_kept > 100 && left_out > Some(100), "{kept}");
}

#[test]
fn messages_of_json_have_one_frame_and_ros_1_writes_it_with_a_slash() {
    let map = format!(
        "table = {{ file = \"run.mcap\", rows = \"/ft\" }}\n[columns]\nFz = {{ from = \"wrench.force.z\", unit = \"N\" }}\n{NO_TIME}"
    );
    for (frames, is_refused) in [
        (["tool0", "tool0", "base"], true),
        (["tool0", "", "tool0"], true),
        (["/tool0", "tool0", "/tool0"], false),
    ] {
        let folder = lab(&[]);
        let file = json_recording("/ft", &json_wrenches(&frames));
        std::fs::write(folder.path().join("run.mcap"), file).expect("written");
        let plan = planned_with(folder.path(), &map);
        match is_refused {
            true => refused(&plan, &["`header.frame_id` has 2 frames", "`tool0`"]),
            false => assert_eq!(plan.expect("one frame").summary().rows_kept, 3),
        }
    }
}

#[test]
fn tables_and_json_lines_with_a_column_of_frames_have_one_frame_in_all_files() {
    let columns = "[columns]\nFz = { from = \"fz\", unit = \"N\" }\n";
    let table = "fz,frame_id\n1,tool0\n2,tool0\n3,base\n";
    let folder = lab(&[("ft.csv", table)]);
    let map = format!("table = \"ft.csv\"\n{columns}{NO_TIME}");
    refused(
        &planned_with(folder.path(), &map),
        &["line 4", "`base` here", "`tool0` before (", "line 2"],
    );
    let one = format!("table = \"ft.csv\"\nframe_id = \"base\"\n{columns}{NO_TIME}");
    let plan = planned_with(folder.path(), &one).expect("one frame");
    assert_eq!((plan.summary().rows_kept, plan.summary().rows_read), (1, 3));

    // A row without a number has no frame.
    let folder = lab(&[("ft.csv", "fz,frame_id\n1,tool0\n,base\n3,tool0\n")]);
    assert!(planned_with(folder.path(), &map).is_ok());

    let folder = lab(&[
        ("a.csv", "fz,frame_id\n1,tool0\n2,tool0\n"),
        ("b.csv", "fz,frame_id\n1,base\n2,base\n"),
    ]);
    let both = format!("table = \"*.csv\"\n{columns}{NO_TIME}");
    refused(
        &planned_with(folder.path(), &both),
        &["b.csv", "a.csv", "`base`"],
    );

    let lines = "{\"fz\": 1, \"header\": {\"frame_id\": \"world\"}}\n{\"fz\": 2, \"header\": {\"frame_id\": \"gel\"}}\n";
    let folder = lab(&[("ft.jsonl", lines)]);
    let map = format!(
        "table = \"ft.jsonl\"\n[columns]\nFz = {{ from = \"/fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    refused(
        &planned_with(folder.path(), &map),
        &[
            "`/header/frame_id` has 2 frames",
            "line 2",
            "`world`",
            "`gel`",
        ],
    );
}

#[test]
fn columns_that_name_a_frame_in_other_words_have_one_frame_too() {
    let map =
        format!("table = \"ft.csv\"\n[columns]\nFz = {{ from = \"fz\", unit = \"N\" }}\n{NO_TIME}");
    for column in [
        "reference_frame",
        "child_frame",
        "Coordinate_Frame",
        "wrench_frame",
        "ft.force_frame",
        "fz_frame",
    ] {
        let table = format!("fz,{column}\n1,tool0\n2,tool0\n3,base\n");
        let folder = lab(&[("ft.csv", &table)]);
        refused(
            &planned_with(folder.path(), &map),
            &["line 4", "`base` here", "`tool0` before"],
        );
    }
}

#[test]
fn counters_names_of_pictures_and_frames_of_other_columns_are_no_coordinate_frames() {
    let columns = "[columns]\nFz = { from = \"fz\", unit = \"N\" }\n";
    let map = format!("table = \"ft.csv\"\n{columns}{NO_TIME}");
    let pictures: String = (0..9).map(|at| format!("{at},view_{at}\n")).collect();
    for table in [
        "fz,frame_id\n1,0\n2,1\n3,2\n".to_owned(),
        format!("fz,frame_id\n{pictures}"),
        "fz,camera.frame_id\n1,left\n2,right\n3,left\n".to_owned(),
        "fz,camera_frame\n1,left\n2,right\n3,left\n".to_owned(),
    ] {
        let folder = lab(&[("ft.csv", &table)]);
        let plan = planned_with(folder.path(), &map);
        assert!(plan.is_ok(), "{table}: {plan:?}");
    }
    let folder = lab(&[(
        "ft.csv",
        "camera.frame_id,ft.frame_id,ft.fz\nleft,tool0,1\nright,tool0,2\nleft,base,3\n",
    )]);
    let map = map.replace("\"fz\"", "\"ft.fz\"");
    refused(
        &planned_with(folder.path(), &map),
        &["`ft.frame_id` has 2 frames"],
    );
}

#[test]
fn a_frame_between_two_rows_that_are_given_in_two_frames_is_refused() {
    let folder = lab(&[
        ("t.csv", "t\n1.5\n"),
        ("ft.csv", "t,fz,frame_id\n1,1,tool0\n2,2,base\n"),
    ]);
    let map = format!(
        "map_version = 2\ntable = \"t.csv\"\n[columns]\nFz = {{ from = \"ft.fz\", unit = \"N\" }}\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n\
         [[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = {{ column = \"t\", unit = \"s\" }}\npick = \"linear\"\ntolerance_ms = 1000\nlag_ms = 0\n{FACTS}"
    );
    refused(
        &planned(folder.path(), &map),
        &[
            "`ft.frame_id` has 2 frames",
            "`base` here, at 2 s",
            "`tool0`",
        ],
    );
}
