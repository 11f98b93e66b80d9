use super::*;
use taceva_core::Channel;

fn table(rows: impl IntoIterator<Item = Row>) -> Table {
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let mut table = Table::new(channels, vec!["video".to_owned()]);
    rows.into_iter().for_each(|row| table.push(row));
    table
}

fn row(name: &str, force: Option<f64>) -> Row {
    Row {
        sample: name.to_owned(),
        truth: vec![force],
        attributes: vec![None],
        ..Row::default()
    }
}

#[test]
fn the_digest_distinguishes_absent_from_zero_and_one_order_from_another() {
    let digest = |rows: Vec<Row>| table(rows).digest();
    let some = digest(vec![row("a", Some(0.0)), row("b", None)]);
    assert_ne!(some, digest(vec![row("a", None), row("b", Some(0.0))]));
    assert_ne!(some, digest(vec![row("b", None), row("a", Some(0.0))]));
    assert_ne!(some, digest(vec![row("a", Some(-0.0)), row("b", None)]));
    assert_eq!(some, digest(vec![row("a", Some(0.0)), row("b", None)]));
}

#[test]
fn the_digest_does_not_depend_on_where_a_frame_lies() {
    let with = |path: &str, bytes: &[u8]| {
        let entry = FrameEntry {
            path: path.to_owned(),
            span: None,
            digest: Digest::of(bytes),
        };
        table([Row {
            frame: Some(entry),
            ..row("a", None)
        }])
        .digest()
    };
    assert_eq!(with("x.png", b"1"), with("y.png", b"1"));
    assert_ne!(with("x.png", b"1"), with("x.png", b"2"));
}

#[test]
fn columns_that_say_nothing_are_not_there_and_channels_always_are() {
    let names: Vec<String> = table([row("a", None)])
        .columns()
        .iter()
        .map(|column| column.name.to_owned())
        .collect();
    assert_eq!(names, ["sample", "Fz"]);
}

#[test]
fn fields_are_those_that_a_row_carries() {
    let fields = table([Row {
        repeat: Some(1),
        ..row("a", None)
    }])
    .fields();
    assert_eq!(
        fields,
        FieldSet::EMPTY.with(Field::Truth).with(Field::Repeat)
    );
}
