//! Recording of a gripper, from a folder to scores: each row has two pictures, of which a model uses one or both.

use std::fs;

use crate::support::{Bench, MAP, SAMPLES};

/// Test folder with a lab's folder of a gripper: the pictures of the second finger are mirrored pictures of the first.
fn gripper() -> Bench {
    let bench = Bench::new();
    bench.lab();
    fs::create_dir(bench.path("lab/right")).expect("made");
    for number in 0..SAMPLES {
        let left = bench.path(&format!("lab/pictures/{number:02}.png"));
        let picture = image::open(left).expect("a picture").fliph();
        let right = bench.path(&format!("lab/right/s{number:02}.png"));
        picture.save(right).expect("written");
    }
    let rest = "channel_order = \"gray\"\nreference = \"unknown\"\n";
    let one = format!("[frame]\ncolumn = \"file\"\n{rest}");
    assert!(MAP.contains(&one));
    let two = format!(
        "[[frame]]\nname = \"left\"\ncolumn = \"file\"\n{rest}\n[[frame]]\nname = \"right\"\npattern = \"right/{{sample}}.png\"\n{rest}"
    );
    bench.write("map.toml", &MAP.replace(&one, &two));
    bench
}

#[test]
fn a_gripper_is_imported_checked_fitted_and_predicted_by_one_view_or_both() {
    let bench = gripper();
    let said = bench.ok("import lab --map map.toml --out gripper");
    for line in [
        "frames   60 of the view left, colours gray",
        "frames   60 of the view right, colours gray",
    ] {
        assert!(said.contains(line), "{said}");
    }
    let words = "--model ridge --set size=8 --split by-point";
    bench.refused(
        &format!("fit gripper {words} --out m.model"),
        2,
        "the views `left`, `right`; choose one by `--view left`",
    );
    bench.refused(
        &format!("fit gripper {words} --view up --out m.model"),
        2,
        "no view `up`, expected one of `left`, `right`",
    );
    bench.ok(&format!(
        "fit gripper {words} --view right --out right.model -q"
    ));
    // The model stores its finger, and a prediction uses it.
    bench.ok("predict gripper --with right.model --out followed.csv -q");
    bench.ok("predict gripper --with right.model --view right --out named.csv -q");
    let read = |name: &str| fs::read(bench.path(name)).expect("written");
    assert_eq!(read("followed.csv"), read("named.csv"));
    bench.refused(
        "predict gripper --with right.model --view left --out other.csv",
        3,
        "the model was fitted on the view `right`, but the pictures are of the view `left`",
    );
    let report = bench.json("evaluate gripper --with right.model --metrics accuracy");
    crate::schema::check("evaluation", &report);
    assert_eq!(report["provenance"]["view"], "right");
    let both = bench.json(&format!(
        "evaluate gripper {words} --view left+right --metrics accuracy"
    ));
    assert_eq!(both["provenance"]["view"], "left+right");
    let notes = both["provenance"]["notes"].to_string();
    assert!(
        notes.contains("the model sees the pictures of left+right, side by side"),
        "{notes}"
    );
    // A page shows the pictures that the model saw.
    bench.ok(&format!(
        "evaluate gripper {words} --view left+right --metrics accuracy --html page.html -q"
    ));
    assert!(
        fs::read_to_string(bench.path("page.html"))
            .expect("a page")
            .contains("data:image/")
    );
    let report = bench.json("check gripper");
    let findings = report.to_string();
    assert!(!findings.contains("TAC044\",\"name"), "{findings}");
    bench.refused(
        "fit drawn --model ridge --view left --out m.model",
        2,
        "each sample has one picture, without a name",
    );
}

#[test]
fn a_sweep_takes_the_view_that_its_file_names() {
    let bench = gripper();
    bench.ok("import lab --map map.toml --out gripper -q");
    let file = |view: &str| {
        bench.write(
            "sweep.toml",
            &format!(
                "sweep_version = 1\ndatasets = [\"gripper\"]\n{view}models = [\"ridge\"]\nsplits = [\"by-point\"]\nmetrics = [\"accuracy\"]\n[vary]\nsize = [\"8x8\"]\n"
            ),
        );
    };
    let tables = ["left", "left+right"].map(|view| {
        file(&format!("view = \"{view}\"\n"));
        let folder = format!("swept-{}", view.len());
        bench.ok(&format!("sweep sweep.toml --out {folder} -q"));
        fs::read_to_string(bench.path(&folder).join("table.csv")).expect("a table")
    });
    assert_ne!(tables[0], tables[1]);
    file("view = \"up\"\n");
    let refused = bench.run("sweep sweep.toml --out up -q");
    assert!(
        refused.code != 0 && refused.err.contains("no view `up`"),
        "{}",
        refused.err
    );
}
