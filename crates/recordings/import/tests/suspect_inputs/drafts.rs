//! Tests of drafts of folders with columns that look like a channel but are none.

use super::{case, draft, imported, lab, line, planned};

/// Draft of a folder with one table of 40 rows, whose cells `row` writes.
pub(super) fn drafted(header: &str, row: impl Fn(usize) -> String) -> String {
    let rows: Vec<String> = (0..40).map(row).collect();
    let folder = lab(&[("labels.csv", &format!("{header}\n{}\n", rows.join("\n")))]);
    draft(folder.path())
}

/// Number that does not count up with the row.
pub(super) fn wave(row: usize) -> f64 {
    ((row * 37 % 40) as f64 * 0.13 - 2.0) * 1.01
}

/// Text of `count` numbers that do not count up with the row.
pub(super) fn waves(row: usize, count: usize) -> String {
    let cells: Vec<String> = (0..count).map(|at| wave(row + at).to_string()).collect();
    cells.join(",")
}

/// Column that the draft assigns to `channel`.
fn taken(draft: &str, channel: &str) -> String {
    let line = line(draft, &format!("{channel} = "));
    let from = line.split("from = \"").nth(1).unwrap_or_default();
    from.split('"').next().unwrap_or_default().to_owned()
}

pub(super) fn filled(draft: &str) -> String {
    draft
        .replace("model = \"?\"", "model = \"gel\"")
        .replace("unit = \"?\"", "unit = \"N\"")
}

#[test]
fn a_counter_beside_the_force_is_no_force() {
    for (header, expected) in [
        ("force_frame,Fz_N", "Fz_N"),
        ("force_index,force_z", "force_z"),
        ("load_id,load_cell_N", "load_cell_N"),
        ("force_seq,normal_force", "normal_force"),
    ] {
        let draft = drafted(header, |row| format!("{},{}", row + 7, wave(row)));
        assert_eq!(taken(&draft, "Fz"), expected, "{draft}");
        let (counter, _) = header.split_once(',').expect("two");
        assert!(line(&draft, "# No channels: ").contains(counter), "{draft}");
    }
}

#[test]
fn a_column_of_slip_is_suggested_as_a_task_in_a_comment() {
    let draft = drafted("Fz_N,slip_label", |row| {
        format!("{},{}", wave(row), row / 7 % 2)
    });
    let comment = line(&draft, "# \"slip_label\" can be a task: [task.slip]");
    assert!(
        comment.contains("kind = \"event\", from = \"slip_label\""),
        "{draft}"
    );
    let draft = drafted("Fz_N,slippery", |row| {
        format!("{},{}", wave(row), row / 7 % 2)
    });
    assert!(!draft.contains("[task."), "{draft}");
}

#[test]
fn a_force_that_counts_up_is_no_force_whatever_its_name() {
    let draft = drafted("force_z,Fx", |row| format!("{row},{}", wave(row)));
    assert_eq!(taken(&draft, "Fz"), "");
    assert!(draft.contains("force_z (counts up by one)"), "{draft}");
    assert_eq!(taken(&draft, "Fx"), "Fx");
}

#[test]
fn magnitudes_accelerations_fields_velocities_and_commands_are_never_taken() {
    let header = "force_magnitude,force_norm,acc_x,mag_y,vel_z,gyro_x,B_z,fz_cmd,fx_setpoint,fy_target,Fz_max,fz_std,quat_x,joint_torque_x,marker_x_px";
    let draft = drafted(header, |row| waves(row, 15));
    for channel in ["Fx", "Fy", "Fz", "Tx", "Px", "Py", "Pz"] {
        assert_eq!(taken(&draft, channel), "", "{draft}");
    }
    let real = drafted(&format!("{header},force_z"), |row| waves(row, 16));
    assert_eq!(taken(&real, "Fz"), "force_z", "{real}");
}

#[test]
fn filtered_beside_raw_and_one_of_two_sensors_leave_the_line_open_with_both_named() {
    for header in [
        "fz_raw,fz_filtered",
        "left_fz,right_fz",
        "force1_z,force2_z",
        "/a/force/z,/b/force/z",
    ] {
        let draft = drafted(header, |row| waves(row, 2));
        assert_eq!(taken(&draft, "Fz"), "?", "{draft}");
        let said = line(&draft, "Fz = ");
        for name in header.split(',') {
            assert!(said.contains(&format!("{name:?}")), "{said}");
        }
        // An import refuses the draft, and quotes its open value.
        let folder = lab(&[("labels.csv", "a\n1\n")]);
        let problem = planned(folder.path(), &filled(&draft)).expect_err("refused");
        assert!(problem.contains("`\"?\"`"), "{problem}");
    }
}

#[test]
fn a_plain_name_comes_before_names_with_more_words() {
    for (header, expected) in [
        ("fz_filtered,fz", "fz"),
        ("left_Fz,Fz_N", "Fz_N"),
        ("wrench.force.z,Fz", "Fz"),
        ("load,force_z", "force_z"),
    ] {
        let draft = drafted(header, |row| waves(row, 2));
        assert_eq!(taken(&draft, "Fz"), expected, "{draft}");
    }
}

#[test]
fn units_in_headers_are_filled_in_and_say_where_they_stand() {
    let header = "Fx_N,Force Y (mN),Fz [lbf],Tz (lbf-in),pose_x_mm,Depth [um]";
    let draft = drafted(header, |row| waves(row, 6));
    for (channel, from, unit) in [
        ("Fx", "Fx_N", "N"),
        ("Fy", "Force Y (mN)", "mN"),
        ("Fz", "Fz [lbf]", "lbf"),
        ("Tz", "Tz (lbf-in)", "lbf-in"),
        ("Px", "pose_x_mm", "mm"),
        ("Pz", "Depth [um]", "um"),
    ] {
        let found = line(&draft, &format!("{channel} = "));
        let expected = format!("{channel} = {{ from = {from:?}, unit = {unit:?} }}   # ");
        assert!(found.starts_with(&expected), "{draft}");
        assert!(found.contains("unit by its name"), "{found}");
    }
}

#[test]
fn zeros_and_forces_that_are_not_valid_are_left_open_with_the_reason() {
    let zeros = drafted("fx,fz", |row| format!("{},0.0", wave(row)));
    assert_eq!(taken(&zeros, "Fz"), "?", "{zeros}");
    assert!(
        line(&zeros, "Fz = ").contains("is 0 in all 40 rows"),
        "{zeros}"
    );
    assert_eq!(taken(&zeros, "Fx"), "fx");
    let invalid = drafted("force_valid,force_z", |row| format!("false,{}", wave(row)));
    assert_eq!(taken(&invalid, "Fz"), "?", "{invalid}");
    assert!(
        line(&invalid, "Fz = ").contains("`force_valid`"),
        "{invalid}"
    );
    let valid = drafted("force_valid,force_z", |row| format!("true,{}", wave(row)));
    assert_eq!(taken(&valid, "Fz"), "force_z", "{valid}");
    // A force that begins after the sampled rows is a channel.
    let rows: String = (0..900)
        .map(|row| format!("{}\n", if row < 600 { 0 } else { row % 7 }))
        .collect();
    let late = lab(&[("t.csv", &format!("fz\n{rows}"))]);
    assert_eq!(taken(&draft(late.path()), "Fz"), "fz");
}

#[test]
fn numbers_without_names_are_no_wrench_and_are_listed() {
    for (name, text) in [
        (
            "t.json",
            "[{\"state\": [1, 2, 3, 4, 5, 6]}, {\"state\": [2, 2, 3, 4, 5, 7]}]",
        ),
        ("t.csv", "state\n\"[1, 2, 3]\"\n\"[2, 2, 4]\"\n"),
        (
            "t.jsonl",
            "{\"obs\": {\"state\": [1, 2, 3]}}\n{\"obs\": {\"state\": [1, 2, 4]}}\n",
        ),
    ] {
        let folder = lab(&[(name, text)]);
        let draft = draft(folder.path());
        assert!(!draft.contains("Fz = "), "{draft}");
        let listed = line(&draft, "# Numbers with unknown names: ");
        assert!(listed.contains("state"), "{draft}");
    }
}

#[test]
fn pictures_come_before_an_array_beside_them() {
    let draft = draft(&case("draft-takes-array-for-table"));
    assert!(
        draft.contains("table = { files = \"frame_*.png\" }"),
        "{draft}"
    );
    assert!(
        draft.contains("background.npy") && draft.contains("`reference`"),
        "{draft}"
    );
    assert!(!draft.contains("[signals]"), "{draft}");
    // Results name the pictures, not their positions.
    assert!(draft.contains("[ids]\nsample = \"file\""), "{draft}");
}

#[test]
fn every_column_is_listed_as_used_as_a_candidate_or_as_neither() {
    let draft = drafted("Fz_N,fz_cmd,gain,frame_no,note,fz_left", |row| {
        let (force, count) = (wave(row), row * 3);
        format!("{force},{force},{force},{count},text {row},{force}")
    });
    assert_eq!(line(&draft, "# Not used: "), "# Not used: frame_no, note");
    let numbers = line(&draft, "# Numbers with unknown names: ");
    assert_eq!(numbers, "# Numbers with unknown names: gain");
    assert!(
        line(&draft, "# No channels: ").contains("fz_cmd ("),
        "{draft}"
    );
    assert!(
        line(&draft, "# or: Fz = ").contains("\"fz_left\""),
        "{draft}"
    );
}

#[test]
fn a_column_of_repeats_is_drafted_as_an_id_and_refused_as_an_attribute_with_the_section() {
    let text = drafted("repeat,Fz_N", |row| format!("{},{}", row % 5, wave(row)));
    assert!(
        text.contains("\nrepeat = \"repeat\"   # by its name\n"),
        "{text}"
    );
    assert!(!text.contains("unknown names"), "{text}");
    let folder = lab(&[("labels.csv", "repeat,Fz_N\n1,0.5\n2,1.5\n")]);
    let as_attribute = filled(&text).replace("[ids]", "[attributes]");
    let problem = planned(folder.path(), &as_attribute).expect_err("refused");
    let expected = "`repeat` is a key of [ids]: write this line there";
    assert!(problem.contains(expected), "{problem}");
    planned(folder.path(), &filled(&text)).expect("an import");
}

const PICTURE: &[u8] = include_bytes!("../cases/times-as-text/img/00.png");

/// Folder with `files`, and a copy of one picture at each path in `pictures`.
pub(super) fn with_pictures(files: &[(&str, &str)], pictures: &[&str]) -> tempfile::TempDir {
    let folder = lab(files);
    for path in pictures {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().expect("inside")).expect("made");
        std::fs::write(path, PICTURE).expect("written");
    }
    folder
}

#[test]
fn pictures_whose_paths_begin_in_folders_above_are_found_by_the_end_of_their_paths() {
    for before in ["data/run1/", "/home/lab/data/", "../"] {
        let table = format!("file,fz\n{before}img/a.png,1.5\n{before}img/b.png,2.5\n");
        let folder = with_pictures(&[("labels.csv", &table)], &["img/a.png", "img/b.png"]);
        let draft = draft(folder.path());
        assert!(
            draft.contains("pattern = \"img/{path.picture}\""),
            "{draft}"
        );
        assert_eq!(
            imported(folder.path(), &filled(&draft), "Fz"),
            [1.5, 2.5],
            "{draft}"
        );
    }
}

#[test]
fn rows_that_name_no_picture_are_counted_and_drafted_to_be_left_out() {
    let table = format!("file,fz\na.png,1.5\nb.png,2.5\n{}", ",\n".repeat(30));
    let folder = with_pictures(&[("labels.csv", &table)], &["a.png", "b.png"]);
    let draft = draft(folder.path());
    assert!(
        draft.contains("frames_named = [\"\"]   # 30 of 32 rows"),
        "{draft}"
    );
    assert_eq!(imported(folder.path(), &filled(&draft), "Fz"), [1.5, 2.5]);
    let without = filled(&draft).replace("[drop]\nframes_named = [\"\"]", "");
    let problem = planned(folder.path(), &without).expect_err("refused");
    assert!(problem.contains("`frames_named = [\"\"]`"), "{problem}");
}

#[test]
fn a_dataset_within_the_folder_is_no_part_of_it() {
    let folder = with_pictures(
        &[
            ("labels.csv", "file,fz\na.png,1.5\nb.png,2.5\n"),
            ("ds/dataset.toml", "x = 1\n"),
            ("ds/t.csv", "a\n1\n"),
        ],
        &["a.png", "b.png", "ds/frames/000.png"],
    );
    let draft = draft(folder.path());
    assert!(!draft.contains("ds/"), "{draft}");
    let plan = planned(folder.path(), &filled(&draft)).expect("an import");
    assert_eq!(plan.summary().unnamed_images, 0);
}

#[test]
fn a_preset_is_named_only_where_its_map_fits() {
    let folder = lab(&[
        ("labels.csv", "Fz\n1.5\n2.5\n"),
        ("store.zarr/zarr.json", "{}"),
    ]);
    let draft = draft(folder.path());
    assert!(!draft.contains("--preset"), "{draft}");
}

#[test]
fn what_rows_share_is_offered_as_the_point_that_intervals_go_by() {
    let draft = drafted("session,Fz", |row| format!("{},{}", row / 10, wave(row)));
    assert!(draft.contains("# point_id = \"session\""), "{draft}");
    let files = ["ball_0.csv", "ball_1.csv", "ball_2.csv"];
    let files = files.map(|name| (name, "Fz\n1.5\n2.5\n3.5\n"));
    let folder = lab(&files);
    let draft = super::draft(folder.path());
    assert!(line(&draft, "# point_id = ").contains("path."), "{draft}");
}

#[test]
fn cells_that_are_names_of_pictures_without_their_ending_are_drafted_as_a_pattern() {
    let folder = with_pictures(
        &[("labels.csv", "fz,id\n1.5,000012\n2.5,000013\n")],
        &["img/000012.png", "img/000013.png"],
    );
    let draft = super::draft(folder.path());
    assert!(
        draft.contains("pattern = \"img/{id}.png\"   # a guess"),
        "{draft}"
    );
    let forces = imported(folder.path(), &filled(&draft), "Fz");
    assert_eq!(forces, [1.5, 2.5], "{draft}");
    // One name without a picture: the column is a number like others.
    std::fs::remove_file(folder.path().join("img/000013.png")).expect("removed");
    let draft = super::draft(folder.path());
    assert!(!draft.contains("pattern = "), "{draft}");
}

#[test]
fn a_counter_of_another_table_names_no_pictures_and_other_folders_that_match_are_named() {
    let names: Vec<String> = (0..12).map(|row| format!("{row}.png")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    // Six forces beside twelve pictures, whose own table names them.
    let rows = |count: u32, row: fn(u32) -> String| (0..count).map(row).collect::<String>();
    let log = format!(
        "seq,fz\n{}",
        rows(6, |row| format!("{row},{}.5\n", row * row))
    );
    let camera = format!("file\n{}", rows(12, |row| format!("{row}.png\n")));
    let folder = with_pictures(&[("camera.csv", &camera), ("log.csv", &log)], &names);
    let text = draft(folder.path());
    assert!(text.contains("table = \"camera.csv\""), "{text}");
    let folder = with_pictures(&[("log.csv", &log)], &names);
    let text = draft(folder.path());
    assert!(!text.contains("{seq}.png"), "{text}");
    let folder = with_pictures(
        &[("labels.csv", "fz,id\n1.5,a\n2.5,b\n")],
        &["left/a.png", "left/b.png", "right/a.png", "right/b.png"],
    );
    let text = draft(folder.path());
    assert!(
        text.contains("\npattern = \"left/{id}.png\"   # a guess")
            && text.contains("\n# or: pattern = \"right/{id}.png\"\n"),
        "{text}"
    );
}
