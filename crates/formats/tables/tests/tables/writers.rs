//! Tests that written data is read back: columns of every kind, and LeRobot folders with several data files.

use std::collections::BTreeMap;

use taceva_tables::{
    Cell, FeatureStats, LeRobot, LeRobotWriter, ParquetTable, ParquetWriter, TableError,
    WrittenColumn, WrittenFeature, WrittenKind,
};

/// Row with a cell of each kind of column. A cell is null if `number` is a multiple of a divisor that differs by column.
fn row(number: i16) -> Vec<Cell> {
    let unless = |every: i16, cell: Cell| match number % every {
        0 => Cell::Null,
        _ => cell,
    };
    let value = f64::from(number) / 7.0;
    let exact = f64::from(number) / 8.0;
    let text = format!("テスト {number}");
    let picture = vec![
        (
            "bytes".to_owned(),
            Cell::Bytes(vec![number.to_le_bytes()[0]; 9]),
        ),
        ("path".to_owned(), Cell::Text(text.clone())),
    ];
    let many = (0..number % 4).map(|_| Cell::Text(text.clone()));
    vec![
        unless(3, Cell::Integer(i128::from(number) << 40)),
        unless(4, Cell::Number(value)),
        unless(5, Cell::Number(exact)),
        unless(6, Cell::Text(text.clone())),
        unless(
            7,
            Cell::List(vec![unless(2, Cell::Number(value)), Cell::Number(-0.0)]),
        ),
        unless(8, Cell::List(vec![Cell::Number(exact)])),
        unless(9, Cell::List(many.collect())),
        unless(10, Cell::Struct(picture)),
    ]
}

fn columns() -> Vec<WrittenColumn> {
    let kinds = [
        WrittenKind::Integer,
        WrittenKind::Number,
        WrittenKind::Single,
        WrittenKind::Text,
        WrittenKind::Numbers(Some(2)),
        WrittenKind::Singles(None),
        WrittenKind::Texts,
        WrittenKind::Picture,
    ];
    let named = kinds.into_iter().enumerate();
    named
        .map(|(at, kind)| WrittenColumn::new(format!("c{at}"), kind))
        .collect()
}

#[test]
fn every_kind_of_cell_is_read_back_over_several_row_groups() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("written.parquet");
    let mut writer = ParquetWriter::create(&path, &columns(), &[("a", "ö")]).expect("new");
    for number in 0..2500 {
        writer.push(row(number)).expect("written");
    }
    assert!(writer.size_bytes() > 0, "two groups are written");
    writer.finish().expect("whole");
    let table = ParquetTable::open(&path).expect("a table");
    assert_eq!((table.rows(), table.metadata("a")), (2500, Some("ö")));
    for (at, column) in columns().iter().enumerate() {
        let read = table.column(&column.name).expect("a column");
        for number in 0..2500 {
            let expected = &row(number)[at];
            assert_eq!(
                &read[usize::try_from(number).expect("small")],
                expected,
                "{number}"
            );
        }
    }
}

#[test]
fn what_does_not_fit_is_refused_by_its_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("written.parquet");
    let mut writer = ParquetWriter::create(&path, &columns(), &[]).expect("new");
    let mut wrong = row(1);
    wrong[4] = Cell::List(vec![Cell::Number(1.0)]);
    let refused = writer.push(wrong).expect_err("one number").to_string();
    assert!(
        refused.contains("`c4`: `[1]`, expected a list of 2 numbers"),
        "{refused}"
    );
    let short = writer.push(Vec::new()).expect_err("no cell").to_string();
    assert!(short.contains("0 cells for 8 columns"), "{short}");
    let again = ParquetWriter::create(&path, &columns(), &[]).expect_err("there");
    assert!(matches!(again, TableError::Write { .. }), "{again}");
    let twice = [columns(), columns()].concat();
    let other = folder.path().join("other.parquet");
    let refused = ParquetWriter::create(&other, &twice, &[]).expect_err("twice");
    assert!(
        refused.to_string().contains("two columns have this name"),
        "{refused}"
    );
    assert!(!other.exists());
}

#[test]
fn a_folder_of_lerobot_is_read_with_its_tasks_episodes_and_stats() {
    let folder = tempfile::tempdir().expect("a folder");
    let column = |name: &str, kind| WrittenColumn::new(name, kind);
    let features = vec![
        WrittenFeature::new(
            column("observation.state", WrittenKind::Numbers(Some(2))),
            [2],
        )
        .with_names(["Fx", "Fz"]),
        WrittenFeature::new(column("depth", WrittenKind::Singles(Some(1))), [1]).with_unit("mm"),
        WrittenFeature::new(
            column("observation.images.gel", WrittenKind::Picture),
            [1, 1, 1],
        ),
    ];
    let mut writer = LeRobotWriter::create(folder.path(), "bench", 2.0, features).expect("new");
    let early = writer.push(Vec::new()).expect_err("no episode").to_string();
    assert!(
        early.contains("a row was added before the first episode"),
        "{early}"
    );
    // Incompressible pictures of 1 MiB: the first data file is full after two episodes.
    let mut state = 1_u32;
    let mut noise = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        state.to_le_bytes()[3]
    };
    for episode in 0..3_u8 {
        writer
            .begin_episode(["press", "drag"][usize::from(episode % 2)])
            .expect("begun");
        for frame in 0..55_u8 {
            let bytes: Vec<u8> = (0..1 << 20).map(|_| noise()).collect();
            let force = f64::from(frame) / 3.0;
            let picture = vec![
                ("bytes".to_owned(), Cell::Bytes(bytes)),
                ("path".to_owned(), Cell::Text("x.png".to_owned())),
            ];
            writer
                .push(vec![
                    Cell::List(vec![Cell::Number(f64::NAN), Cell::Number(force)]),
                    Cell::List(vec![Cell::Number(f64::from(frame))]),
                    Cell::Struct(picture),
                ])
                .expect("written");
        }
    }
    let mut gray = FeatureStats::new(1);
    gray.add_picture([0.0, 0.5, 1.0]);
    let pictures = BTreeMap::from([("observation.images.gel".to_owned(), gray)]);
    writer.finish(&pictures).expect("whole");
    let data = |file: u8| {
        folder
            .path()
            .join(format!("data/chunk-000/file-00{file}.parquet"))
    };
    assert!(data(1).is_file() && !data(2).exists());
    let read = LeRobot::open(folder.path()).expect("a dataset");
    assert_eq!(read.rows(), 165);
    let depths = read.column("depth").expect("a column");
    assert_eq!(depths[56], Cell::Number(1.0));
    let column = |name: &str| read.column(name).expect("a column");
    assert_eq!(
        (&column("episode_index")[110], &column("task")[55]),
        (&Cell::Integer(2), &Cell::Text("drag".into()))
    );
    assert_eq!(
        (&column("frame_index")[111], &column("timestamp")[112]),
        (&Cell::Integer(1), &Cell::Number(1.0))
    );
    let stats = std::fs::read_to_string(folder.path().join("meta/stats.json")).expect("there");
    let stats: serde_json::Value = serde_json::from_str(&stats).expect("JSON");
    let mean = stats["depth"]["mean"][0].as_f64().expect("a number");
    // Rounded with each row, as its own library does.
    assert!((mean - 27.0).abs() < 1e-12, "{mean}");
    assert_eq!(
        stats["observation.images.gel"]["max"],
        serde_json::json!([[[1.0]]])
    );
    // A channel without numbers has no statistics.
    assert_eq!(stats["observation.state"], serde_json::Value::Null);
    let episodes = ParquetTable::open(
        &folder
            .path()
            .join("meta/episodes/chunk-000/file-000.parquet"),
    );
    let files = episodes
        .expect("a table")
        .column("data/file_index")
        .expect("a column");
    assert_eq!(files, [0, 0, 1].map(Cell::Integer));
}
