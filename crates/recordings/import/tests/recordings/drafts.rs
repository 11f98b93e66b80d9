//! Tests of drafts for recordings in which only units, signs and the name of the sensor may remain as gaps.

use taceva_import::MapDraft;
use taceva_needs::{Need, skip};

use super::expected::differences;
use super::{copy, ffmpeg, folder, own_map};

/// Copy of the recording `name` without its map and its expected results.
fn bare(name: &str) -> tempfile::TempDir {
    let target = tempfile::tempdir().expect("a folder");
    copy(&folder(name), target.path());
    for own in ["map.toml", "expected.json"] {
        std::fs::remove_file(target.path().join(own)).expect("it was there");
    }
    target
}

/// Draft for the recording `name`, with units, signs, offsets, scales and sensor from its own map.
fn finished_draft(name: &str) -> Result<String, String> {
    let draft = MapDraft::of(bare(name).path()).map_err(|error| error.to_string())?;
    let own: toml::Table = own_map(name).parse().expect("TOML");
    let mut finished = String::new();
    for line in draft.text().lines() {
        let channel = line.split(" = ").next().unwrap_or_default();
        let facts = own.get("columns").and_then(|columns| columns.get(channel));
        let fact = |key: &str| {
            facts
                .and_then(|facts| facts.get(key))
                .map(|fact| format!(", {key} = {fact}"))
        };
        if line == "model = \"?\"" {
            finished += "model = \"a sensor of the lab\"\n";
            continue;
        }
        if line == "unit = \"?\"" {
            let unit = own.get("signals").and_then(|signals| signals.get("unit"));
            finished += &format!("unit = {}\n", unit.expect("a unit"));
            continue;
        }
        let unit = fact("unit").unwrap_or_else(|| match channel.as_bytes().first() {
            Some(b'F') => ", unit = \"N\"".to_owned(),
            Some(b'T') => ", unit = \"Nm\"".to_owned(),
            _ => ", unit = \"mm\"".to_owned(),
        });
        let others = ["sign", "offset", "scale"].map(|key| fact(key).unwrap_or_default());
        let open = line.replace(", unit = \"?\"", &unit);
        finished += &match facts.is_some() {
            true => open.replacen(" }", &format!("{} }}", others.concat()), 1),
            false => open,
        };
        finished.push('\n');
    }
    Ok(finished)
}

/// Folders whose drafts have more gaps than units and signs.
const MORE_OPEN: [&str; 8] = [
    // The lag between two clocks is not in the files.
    "join-time",
    // The columns are volts, which a matrix beside them converts to forces.
    "matrix",
    "mcap-lz4",
    "mcap-none",
    "mcap-zstd",
    // The numbers of black and full scale are unknown.
    "npy-int16",
    // Three recordings are side by side; the map selects one.
    "pickle",
    // -1 g means that nothing was weighed, and the other table holds the taxels.
    "taxels-csv",
];

/// Clips that only ffmpeg decodes in these tests. The program `taceva` decodes AV1 in a child process.
const DECODED_BY_FFMPEG: [&str; 6] = [
    "lerobot-v3-av1",
    "lerobot-v3-depth",
    "mkv-ffv1",
    "mp4-av1",
    "mp4-h264-444",
    "mp4-mpeg4",
];

#[test]
fn a_draft_needs_nothing_but_units_of_most_recordings() {
    let mut names: Vec<String> = std::fs::read_dir(folder(""))
        .expect("recordings")
        .flatten()
        .filter(|entry| entry.path().join("map.toml").is_file())
        .map(|entry| entry.file_name().into_string().expect("a name"))
        .collect();
    names.sort();
    if let Err(error) = ffmpeg() {
        skip(Need::Ffmpeg, error);
        names.retain(|name| !DECODED_BY_FFMPEG.contains(&name.as_str()));
    }
    let (mut open, mut said) = (Vec::new(), Vec::new());
    for name in &names {
        let problems = match finished_draft(name) {
            Ok(map) => differences(name, &map),
            Err(problem) => vec![problem],
        };
        if !problems.is_empty() {
            open.push(name.as_str());
            said.push(format!("{name}: {}", problems.join("; ")));
        }
    }
    assert_eq!(
        open,
        MORE_OPEN,
        "{} of {}:\n{}",
        names.len() - open.len(),
        names.len(),
        said.join("\n")
    );
}

/// Text of the draft for a folder with `files`, each with its path and content.
fn draft_of(files: &[(&str, Vec<u8>)]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    for (path, bytes) in files {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().expect("inside")).expect("made");
        std::fs::write(path, bytes).expect("written");
    }
    let draft = MapDraft::of(folder.path()).expect("a draft");
    draft.text().to_owned()
}

#[test]
fn a_draft_offers_the_groups_of_a_file_as_contacts_beside_the_column_of_objects() {
    let draft = MapDraft::of(bare("hdf5-groups").path()).expect("a draft");
    let text = draft.text();
    assert!(
        text.contains("\n# point_id = \"group\"   # only if each group"),
        "{text}"
    );
    assert!(
        text.contains("\n# point_id = \"@object\"   # only if"),
        "{text}"
    );
}

/// NumPy file of unsigned bytes with the shape `shape`.
fn npy(shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '|u1', 'fortran_order': False, 'shape': {shape}, }}");
    let length = u16::try_from(header.len()).expect("short");
    [
        b"\x93NUMPY\x01\x00",
        &length.to_le_bytes()[..],
        header.as_bytes(),
        data,
    ]
    .concat()
}

#[test]
fn a_draft_of_several_sessions_gives_each_its_own_array() {
    let frames = npy("(2, 16, 16, 3)", &[9; 2 * 16 * 16 * 3]);
    for (table, rows) in [
        ("force.npy", npy("(2, 3)", &[1, 2, 3, 4, 5, 6])),
        ("labels.csv", b"Fz\n0.5\n1.5\n".to_vec()),
    ] {
        let mut files = Vec::new();
        let names: Vec<[String; 2]> = (0..3)
            .map(|session| {
                [
                    format!("s{session}/{table}"),
                    format!("s{session}/frames.npy"),
                ]
            })
            .collect();
        for [table, array] in &names {
            files.push((table.as_str(), rows.clone()));
            files.push((array.as_str(), frames.clone()));
        }
        let draft = draft_of(&files);
        assert!(
            draft.contains("array = { file = \"s{path.s}/frames.npy\" }"),
            "{draft}"
        );
        let pattern = format!("pattern = \"s{{s:digits}}/{table}\"");
        assert!(draft.contains(&pattern), "{draft}");
    }
}

#[test]
fn a_draft_of_several_tables_over_one_array_leaves_the_index_open() {
    let draft = draft_of(&[
        ("t0.csv", b"Fz\n0.5\n1.5\n".to_vec()),
        ("t1.csv", b"Fz\n2.5\n3.5\n".to_vec()),
        ("frames.npy", npy("(4, 16, 16, 3)", &[9; 4 * 16 * 16 * 3])),
    ]);
    assert!(
        draft.contains("array = { file = \"frames.npy\" }\nindex = \"?\""),
        "{draft}"
    );
}

#[test]
fn a_draft_takes_a_header_of_positions_for_one_and_says_that_it_is_a_guess() {
    for text in [
        "0,1,2\n0.5,1.5,2.5\n3.5,4.5,5.5\n",
        ",0,1,2\n0,0.5,1.5,2.5\n1,3.5,4.5,5.5\n",
    ] {
        let draft = draft_of(&[("labels.csv", text.as_bytes().to_vec())]);
        assert!(
            draft.contains("{ file = \"labels.csv\", header = true }   # 2 rows"),
            "{draft}"
        );
        assert!(draft.contains("# A guess: the first line"), "{draft}");
        assert!(!draft.contains("from = \"\""), "{draft}");
    }
    let draft = draft_of(&[("labels.csv", b"0.0,1.0,2.0\n0.5,1.5,2.5\n".to_vec())]);
    assert!(draft.contains("header = false"), "{draft}");
}

#[test]
fn a_draft_prefers_what_was_measured_to_commands_predictions_and_deviations() {
    let text = "fz_cmd,fz_meas,fx_std,fx,fy_pred,z_target\n1.5,2.5,3.5,4.5,5.5,6.5\n2.5,1.5,4.5,3.5,6.5,5.5\n";
    let draft = draft_of(&[("labels.csv", text.as_bytes().to_vec())]);
    let line = |start: &str| {
        let mut lines = draft.lines();
        let found = lines.find(|line| line.starts_with(start));
        found.unwrap_or_default().to_owned()
    };
    assert!(line("Fz = ").starts_with("Fz = { from = \"fz_meas\", unit = \"?\" }"));
    assert!(line("Fx = ").starts_with("Fx = { from = \"fx\", unit = \"?\" }"));
    // Commanded, predicted or computed quantities are not channels.
    let excluded = line("# No channels: ");
    for (channel, name, word) in [
        ("Fy = ", "fy_pred", "`pred`"),
        ("# or: Fz = ", "fz_cmd", "`cmd`"),
        ("# or: Fx = ", "fx_std", "`std`"),
    ] {
        assert_eq!(line(channel), "", "{draft}");
        assert!(
            excluded.contains(&format!("{name} ({word} means")),
            "{excluded}"
        );
    }
}

#[test]
fn a_draft_marks_the_unit_of_times_that_it_guesses_by_their_step() {
    let times = |step: usize| {
        let rows = (0..30).map(|row| format!("{},{}.5\n", row * step, row % 7));
        let text = format!("timestamp,fz\n{}", rows.collect::<String>());
        draft_of(&[("labels.csv", text.into_bytes())])
    };
    assert!(times(33).contains("\nunit = \"ms\"   # a guess: "));
    assert!(times(33_333).contains("\nunit = \"us\"   # a guess: "));
    assert!(times(33_333_333).contains("\nunit = \"ns\"   # a guess: "));
    assert!(times(1).contains("\nunit = \"?\"   # "));
}
