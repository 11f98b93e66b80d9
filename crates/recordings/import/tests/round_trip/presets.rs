//! Tests that layouts of published recordings need no map.

use std::fs;

use crate::presets::preset;
use taceva_dataset::Dataset;

use crate::lab::{Lab, import, png, rgb_png};

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
        let map = preset("bristol").map(&source).expect("a map");
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
    let map = preset("py3dcal").map(&source).expect("a map");
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
