//! What goes in comes out, whichever way and on however many threads.

mod lab;

use std::fs;
use std::num::NonZeroUsize;

use lab::{Lab, MAP, contents, import, png, rgb_png};
use taceva_core::{Field, FieldSet, GratingKind, Nanometre, Sample, SampleSink, Silent, SinkError};
use taceva_dataset::{ChannelOrder, Dataset, DatasetError, ImportMap, Pass, Preset, export_csv};

struct Keep {
    fields: FieldSet,
    samples: Vec<Sample>,
}

impl SampleSink for Keep {
    fn fields(&self) -> FieldSet {
        self.fields
    }
    fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
        self.samples.push(sample.clone());
        Ok(())
    }
}

fn jobs(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).expect("at least one")
}

#[test]
fn labels_are_converted_and_frames_keep_their_bytes() {
    let lab = Lab::new();
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let table = dataset.table();
    let position = |name| table.channels().position(name).expect("there");
    assert_eq!(table.truth(position("Fz")).get(1), Some(1.6005));
    assert_eq!(table.truth(position("Pz")).get(1), Some(1.2355));
    assert_eq!(table.samples()[1], "press 1");
    assert_eq!(table.point_id()[1].as_deref(), Some("1:1"));
    assert_eq!(table.repeat()[1], Some(1));
    assert_eq!(table.t_s()[1], Some(1.001));
    assert_eq!(
        table.attribute("video").expect("kept")[1].as_deref(),
        Some("clip, 1")
    );
    let copy = fs::read(lab.path("set/frames/0000/000001.png")).expect("there");
    assert_eq!(copy, png(8, 6, 1));
}

#[test]
fn import_export_and_import_give_the_same_digest() {
    let lab = Lab::new();
    let first = lab.import().expect("imported").digest;
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let mut csv = Vec::new();
    export_csv(&dataset, &mut csv).expect("exported");
    fs::write(lab.path("set/export.csv"), csv).expect("written");
    let map = MAP
        .replace("labels.csv", "export.csv")
        .replace("\"file\"", "\"frame\"")
        .replace(
            "{ from = \"force\", unit = \"mN\", sign = -1 }",
            "{ from = \"Fz\", unit = \"N\" }",
        )
        .replace(
            "{ from = \"depth\", unit = \"um\" }",
            "{ from = \"Pz\", unit = \"mm\" }",
        )
        .replace("\"name\"", "\"sample\"")
        .replace("[\"x\", \"y\"]", "\"point_id\"")
        .replace(
            "column = \"t\"\nunit = \"ms\"",
            "column = \"t_s\"\nunit = \"s\"",
        )
        .replace("quality_flags = [\"bad\"]", "");
    let map = ImportMap::parse("again.toml".as_ref(), &map).expect("a map");
    let again = import(&lab.path("set"), &map, &lab.path("again"), 2).expect("imported");
    assert_eq!(again.digest, first);
    let [once, twice] = ["set/samples.parquet", "again/samples.parquet"].map(|p| lab.path(p));
    assert_eq!(
        fs::read(once).expect("read"),
        fs::read(twice).expect("read")
    );
}

#[test]
fn any_number_of_threads_writes_the_same_bytes() {
    let lab = Lab::new();
    lab.import_to("one", 1).expect("imported");
    for count in [2, 3, 16] {
        let target = format!("set {count}");
        lab.import_to(&target, count).expect("imported");
        assert_eq!(contents(&lab.path(&target)), contents(&lab.path("one")));
    }
}

#[test]
fn a_stream_gives_the_same_samples_on_any_number_of_threads() {
    let lab = Lab::new();
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let stream = |count, fields| {
        let mut sink = Keep {
            fields,
            samples: Vec::new(),
        };
        let pass = Pass {
            rows: &[4, 0, 2],
            jobs: jobs(count),
            progress: &Silent,
        };
        let report = dataset.stream(pass, &mut sink).expect("streamed");
        (report.frames_decoded, sink.samples)
    };
    let with_frames = FieldSet::PAIRS.with(Field::Frame);
    let (decoded, samples) = stream(1, with_frames);
    assert_eq!(decoded, 3);
    assert_eq!(samples[0].id, "press 4");
    assert!(samples.iter().all(|sample| sample.frame.is_some()));
    assert_eq!(stream(2, with_frames), (3, samples));
}

#[test]
fn no_frame_is_decoded_for_a_sink_that_reads_none() {
    let lab = Lab::new();
    lab.import().expect("imported");
    fs::remove_dir_all(lab.path("set/frames")).expect("removed");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let rows = dataset.all_rows();
    let pass = Pass {
        rows: &rows,
        jobs: jobs(2),
        progress: &Silent,
    };
    let mut sink = Keep {
        fields: FieldSet::PAIRS,
        samples: Vec::new(),
    };
    let report = dataset.stream(pass, &mut sink).expect("streamed");
    assert_eq!((report.samples, report.frames_decoded), (5, 0));
}

#[test]
fn frames_of_blue_green_red_files_come_out_red_green_blue() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"gray\"", "\"bgr\"");
    for row in 0..5 {
        lab.write(&format!("source/images/{row}.png"), &rgb_png(8, 6, row));
    }
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let frames = dataset.header().frames.as_ref().expect("frames");
    assert_eq!(frames.channel_order, ChannelOrder::Bgr);
    let frame = dataset.frame(2).expect("decodes").expect("there");
    let file = image::load_from_memory(&rgb_png(8, 6, 2))
        .expect("decodes")
        .into_bytes();
    assert_eq!(frame.bytes()[..3], [file[2], file[1], file[0]]);
}

#[test]
fn frames_of_an_array_are_kept_bit_for_bit() {
    let lab = Lab::new();
    let header = "{'descr': '<u2', 'fortran_order': False, 'shape': (6, 3, 4), }";
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend_from_slice(&u16::try_from(header.len()).expect("short").to_le_bytes());
    file.extend_from_slice(header.as_bytes());
    let numbers: Vec<u16> = (0..72).map(|number| number * 911).collect();
    file.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    lab.write("source/frames.npy", &file);
    lab.replace(
        "map.toml",
        "column = \"file\"",
        "array = \"frames.npy\"\nindex = \"x\"",
    );
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    for row in 0..5 {
        let frame = dataset.frame(row).expect("decodes").expect("there");
        assert_eq!(
            frame.samples().collect::<Vec<_>>(),
            numbers[row * 12..][..12]
        );
    }
    lab.replace("source/labels.csv", "press 3,3,", "press 3,6,");
    let error = lab.import_to("other", 1).expect_err("beyond");
    let message = error.to_string();
    assert!(
        message.contains("line 5, column `x`") && message.contains("no frame 6, there are 6"),
        "{message}"
    );
}

#[test]
fn tables_of_several_runs_join_and_name_frames_by_a_pattern() {
    let lab = Lab::new();
    for run in ["run_a", "run_b"] {
        fs::create_dir_all(lab.path(&format!("source/{run}/images"))).expect("created");
        lab.write(
            &format!("source/{run}/labels.csv"),
            b"n,force\n1,1000\n2,2000\n",
        );
        for n in 1..=2 {
            lab.write(&format!("source/{run}/images/image_{n}.png"), &png(8, 6, n));
        }
    }
    lab.write(
        "map.toml",
        br#"
map_version = 1
table = "run_*/labels.csv"
[frame]
pattern = "images/image_{n}.png"
channel_order = "gray"
reference = "unknown"
[columns]
Fz = { from = "force", unit = "mN" }
[time]
clock = "unknown"
[sensor]
model = "drawn"
serial = "unknown"
gel = "unknown"
opaque = false
"#,
    );
    let report = lab.import().expect("imported");
    assert_eq!(
        (report.summary.tables.len(), report.summary.unnamed_images),
        (2, 0)
    );
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    assert_eq!(dataset.table().samples(), ["0", "1", "2", "3"]);
    assert_eq!(
        dataset.frame(0).expect("decodes"),
        dataset.frame(2).expect("decodes")
    );
}

#[test]
fn placeholders_are_left_out_only_where_all_of_them_stand() {
    let lab = Lab::new();
    lab.write("source/plain.csv", b"Fx,Fz\n0.0,0.0\n0.0,1.0\n0,0\n2,0\n");
    lab.write(
        "map.toml",
        br#"
map_version = 1
table = "plain.csv"
[columns]
Fx = { from = "Fx", unit = "N" }
Fz = { from = "Fz", unit = "N" }
[drop]
placeholders = { Fx = 0.0, Fz = 0.0 }
[time]
clock = "unknown"
[sensor]
model = "drawn"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#,
    );
    let summary = lab.import().expect("imported").summary;
    assert_eq!(
        (summary.rows_kept, summary.dropped.get("placeholders")),
        (2, Some(&2))
    );
    assert!(
        Dataset::open(&lab.path("set"))
            .expect("opens")
            .header()
            .frames
            .is_none()
    );
}

#[test]
fn the_bristol_layout_needs_no_map_in_either_generation() {
    for (images, header, forces) in [
        (
            "sensor_images",
            "sensor_image,object_label,pose_x,pose_y,pose_z,pose_Rx,pose_Ry,pose_Rz,Fx,Fy,Fz",
            "0.0,0.0,0.0",
        ),
        (
            "images",
            "sensor_image,obj_id,pose_id,pose_1,pose_2,pose_3,pose_4,pose_5,pose_6",
            "",
        ),
    ] {
        let lab = Lab::new();
        let source = lab.path("run");
        fs::create_dir_all(source.join(images)).expect("created");
        let mut table = header.to_owned();
        for n in 0..3 {
            lab.write(&format!("run/{images}/image_{n}.png"), &png(8, 6, n));
        }
        for n in 1..3 {
            let cells = header.split(',').count()
                - 1
                - forces.split(',').filter(|cell| !cell.is_empty()).count();
            table += &format!("\nimage_{n}.png{}", format!(",{n}").repeat(cells));
            if !forces.is_empty() {
                table += &format!(",{forces}");
            }
        }
        lab.write("run/targets.csv", table.as_bytes());
        let map = Preset::Bristol.map(&source).expect("a map");
        let report = import(&source, &map, &lab.path("set"), 1).expect("imported");
        let names: Vec<&str> = map
            .channels
            .iter()
            .map(taceva_core::Channel::name)
            .collect();
        assert_eq!(names, ["Px", "Py", "Pz", "Rx", "Ry", "Rz"]);
        assert_eq!(report.summary.rows_kept, 2);
        let dataset = Dataset::open(&lab.path("set")).expect("opens");
        assert!(dataset.reference().expect("decodes").is_some());
    }
}

#[test]
fn the_py3dcal_layout_needs_no_map() {
    let lab = Lab::new();
    for folder in ["annotations", "probe_images", "blank_images"] {
        fs::create_dir_all(lab.path(&format!("cal/{folder}"))).expect("created");
    }
    lab.write(
        "cal/annotations/probe_data.csv",
        b"img_name,x_mm,y_mm,penetration_depth_mm\n---,1,2,0.5\n12_X3.0Y4.5Z0.8.png,3.0,4.5,0.8\n",
    );
    lab.write("cal/probe_images/12_X3.0Y4.5Z0.8.png", &rgb_png(8, 6, 1));
    lab.write("cal/blank_images/blank.png", &rgb_png(8, 6, 0));
    let source = lab.path("cal");
    let map = Preset::Py3dcal.map(&source).expect("a map");
    let summary = import(&source, &map, &lab.path("set"), 1)
        .expect("imported")
        .summary;
    assert_eq!(
        (summary.rows_kept, summary.dropped.get("frame `---`")),
        (1, Some(&1))
    );
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    assert_eq!(dataset.table().point_id()[0].as_deref(), Some("3.0:4.5"));
    assert!(dataset.reference().expect("decodes").is_some());
}

#[test]
fn a_cancelled_import_leaves_nothing() {
    struct Stop;
    impl taceva_core::Progress for Stop {
        fn begin(&self, _: &str, _: Option<u64>) {}
        fn advance(&self, _: u64) {}
        fn end(&self) {}
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let lab = Lab::new();
    let map = ImportMap::read(&lab.path("map.toml")).expect("a map");
    let plan = taceva_dataset::ImportPlan::new(&lab.path("source"), &map).expect("a plan");
    let outcome = plan.run(&lab.path("set"), jobs(2), &Stop);
    assert!(matches!(outcome, Err(DatasetError::Cancelled)));
    assert_eq!(fs::read_dir(lab.folder.path()).expect("listed").count(), 2);
}

#[test]
fn the_leftover_of_a_killed_import_is_cleared() {
    let lab = Lab::new();
    fs::create_dir_all(lab.path(".set.partial/frames")).expect("created");
    lab.write(".set.partial/frames/junk", b"x");
    lab.import().expect("imported");
    assert!(!lab.path(".set.partial").exists());
}

/// A lab whose presses touch gratings.
fn gratings(kind: &str, spacing: &str) -> Lab {
    let lab = Lab::new();
    let map = MAP.replace(
        "[ids]",
        "[ids]\nkind = \"relief\"\nspacing_mm = \"spacing\"",
    );
    lab.write("map.toml", map.as_bytes());
    let table = fs::read_to_string(lab.path("source/labels.csv")).expect("there");
    let mut lines = table.lines();
    let header = lines.next().expect("a header");
    let rows = lines.map(|line| format!("{line},{kind},{spacing}\n"));
    let table = format!("{header},relief,spacing\n{}", rows.collect::<String>());
    lab.write("source/labels.csv", table.as_bytes());
    lab
}

#[test]
fn gratings_are_whole_nanometres_and_frames_say_how_bright_they_are() {
    let lab = gratings("dot", "0.35");
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let table = dataset.table();
    assert_eq!(table.kind()[2], Some(GratingKind::Dot));
    assert_eq!(table.spacing()[2], Some(Nanometre(350_000)));
    let frame = dataset.frame(2).expect("decodes").expect("there");
    assert_eq!(table.intensity()[2], Some(frame.mean_luma()));
}

#[test]
fn a_grating_of_no_kind_or_no_spacing_is_refused() {
    gratings("wave", "0.35").is_refused_with(&["column `relief`", "expected `line` or `dot`"]);
    for spacing in ["0", "-0.3", "0.3 mm", "nan", "1e99"] {
        let expected = ["column `spacing`", "expected a spacing in mm, such as 0.35"];
        gratings("line", spacing).is_refused_with(&expected);
    }
}
